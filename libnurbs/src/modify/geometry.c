#include "core/error.h"
#include "core/object.h"

#include <nurbs/geometry.h>

#include <float.h>
#include <math.h>

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *out)
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Unit vector along a x b; 0 when they are parallel to rounding, measured against the given lengths
 * so that a derivative that is nothing but rounding counts as zero. */
static int unit_cross(const double *a, const double *b, double length_a, double length_b,
                      double *out)
{
    double c[3];
    cross(a, b, c);
    const double length = sqrt(dot(c, c));
    if (!(length > 64.0 * DBL_EPSILON * length_a * length_b) || !isfinite(length))
        return 0;
    for (int x = 0; x < 3; x++)
        out[x] = c[x] / length;
    return 1;
}

/* Near a collapsed edge v = v0, Su = (v - v0) Suv + ..., so the limit of the normal is along
 * +-(Suv x Sv), the sign that of v - v0 inside the patch; for u likewise. */
static int limit_normal(const nurbs_surface *surface, const double *uv, const double *s,
                        const double size[2], double *out)
{
    const double *su = s + 3, *sv = s + 6, *suv = s + 12;
    double inward[2], twist = sqrt(dot(suv, suv));
    for (int d = 0; d < 2; d++)
        inward[d] = uv[d] >= surface->axis[d].knots[surface->axis[d].size] ? -1.0 : 1.0;
    const double length_u = sqrt(dot(su, su)), length_v = sqrt(dot(sv, sv));
    const int u_vanishes = length_u * size[0] <= length_v * size[1];
    if (u_vanishes ? !unit_cross(suv, sv, twist, length_v, out)
                   : !unit_cross(su, suv, length_u, twist, out))
        return 0;
    for (int x = 0; x < 3; x++)
        out[x] *= inward[u_vanishes ? 1 : 0];
    return 1;
}

/* What Su and Sv are compared with to tell a collapsed edge from rounding: the diagonal of the net
 * over the length of the domain. */
static void typical_speeds(const nurbs_surface *surface, double speed[2])
{
    const size_t n = surface->axis[0].size * surface->axis[1].size;
    double diagonal = 0.0;
    for (size_t c = 0; c < 3; c++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (size_t i = 0; i < n; i++) {
            low = fmin(low, surface->points[3 * i + c]);
            high = fmax(high, surface->points[3 * i + c]);
        }
        diagonal = hypot(diagonal, high - low);
    }
    for (int d = 0; d < 2; d++) {
        const struct axis *axis = &surface->axis[d];
        speed[d] = diagonal / (axis->knots[axis->size] - axis->knots[0]);
    }
}

/* Unit normal where Su and Sv span a plane. */
static int regular_normal(const double *s, const double speed[2], double *normal)
{
    const double length_u = sqrt(dot(s + 3, s + 3)), length_v = sqrt(dot(s + 6, s + 6));
    return length_u > 256.0 * DBL_EPSILON * speed[0] && length_v > 256.0 * DBL_EPSILON * speed[1] &&
           unit_cross(s + 3, s + 6, length_u, length_v, normal);
}

nurbs_status nurbs_surface_normals(const nurbs_surface *surface, size_t n, const double *uv,
                                   double *normals)
{
    if (!surface || (n && !normals))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", surface ? "normals" : "surface");
    double speed[2], size[2];
    typical_speeds(surface, speed);
    for (int d = 0; d < 2; d++)
        size[d] = surface->axis[d].knots[surface->axis[d].size] - surface->axis[d].knots[0];
    for (size_t i = 0; i < n; i++) {
        double s[18];
        nurbs_status status = nurbs_surface_eval(surface, 2, 1, uv + 2 * i, s);
        if (status != NURBS_OK)
            return status;
        if (!regular_normal(s, speed, normals + 3 * i) &&
            !limit_normal(surface, uv + 2 * i, s, size, normals + 3 * i))
            return nurbs_fail(NURBS_ERROR_GEOMETRY,
                              "parameter %zu: the surface has no normal at u = %.17g, v = %.17g", i,
                              uv[2 * i], uv[2 * i + 1]);
    }
    return NURBS_OK;
}

nurbs_status nurbs_surface_curvatures(const nurbs_surface *surface, size_t n, const double *uv,
                                      double *out)
{
    if (!surface || (n && !out))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", surface ? "out" : "surface");
    double speed[2];
    typical_speeds(surface, speed);
    for (size_t i = 0; i < n; i++, out += 4) {
        double s[18], normal[3];
        nurbs_status status = nurbs_surface_eval(surface, 2, 1, uv + 2 * i, s);
        if (status != NURBS_OK)
            return status;
        const double *su = s + 3, *sv = s + 6;
        const double e = dot(su, su), f = dot(su, sv), g = dot(sv, sv);
        if (!regular_normal(s, speed, normal))
            return nurbs_fail(NURBS_ERROR_GEOMETRY,
                              "parameter %zu: Su x Sv vanishes at u = %.17g, v = %.17g", i,
                              uv[2 * i], uv[2 * i + 1]);
        const double l = dot(s + 9, normal), m = dot(s + 12, normal), k = dot(s + 15, normal);
        const double area = e * g - f * f;
        const double mean = (e * k - 2.0 * f * m + g * l) / (2.0 * area);
        const double gaussian = (l * k - m * m) / area;
        /* The discriminant as a sum of squares does not turn negative by rounding (umbilics):
         * in the basis Su, Sv - (f/e) Su the two halves of the difference are orthogonal. */
        const double turned = m - f / e * l, across = k - 2.0 * f / e * m + f * f / (e * e) * l;
        const double root = hypot(0.5 * (l / e - across * e / area), turned / sqrt(area));
        out[0] = mean;
        out[1] = gaussian;
        out[2] = mean - root;
        out[3] = mean + root;
    }
    return NURBS_OK;
}

nurbs_status nurbs_curve_curvatures(const nurbs_curve *curve, size_t n, const double *u,
                                    double *out)
{
    if (!curve || (n && !out))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", curve ? "out" : "curve");
    for (size_t i = 0; i < n; i++, out += 2) {
        double c[12], binormal[3];
        nurbs_status status = nurbs_curve_eval(curve, 3, 1, u + i, c);
        if (status != NURBS_OK)
            return status;
        const double speed = sqrt(dot(c + 3, c + 3));
        if (!(speed > 0.0))
            return nurbs_fail(NURBS_ERROR_GEOMETRY, "parameter %zu: C' vanishes at u = %.17g", i,
                              u[i]);
        cross(c + 3, c + 6, binormal);
        const double area = sqrt(dot(binormal, binormal));
        const double noise = 64.0 * DBL_EPSILON * speed * sqrt(dot(c + 6, c + 6));
        out[0] = area / (speed * speed * speed);
        out[1] = area > noise ? dot(binormal, c + 9) / (area * area) : 0.0;
    }
    return NURBS_OK;
}
