/* Conic arcs 104, copious data 106 and parametric splines 112 as NURBS curves. */
#include "core/constants.h"
#include "core/error.h"
#include "core/vector.h"
#include "io/form.h"
#include "io/iges.h"

#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_POINTS = 1000000 };

static const double turn = 2 * PI;

static nurbs_status refuse(const iges_file *file, size_t entity, const char *what)
{
    return nurbs_fail(NURBS_ERROR_FORMAT, "%s: entity %d at D%zu: %s", file->path,
                      file->entity[entity].type, iges_number(entity), what);
}

static nurbs_status read_reals(const iges_file *file, size_t entity, size_t at, size_t n,
                               double *values)
{
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < n && status == NURBS_OK; k++) {
        if (at + k >= iges_parameters(file, entity))
            return refuse(file, entity, "fewer parameters than its sizes ask for");
        status = iges_real(file, entity, at + k, 0, &values[k]);
    }
    return status;
}

/* Centre and semi-axes of the ellipse A x^2 + B x y + C y^2 + D x + E y + F = 0. */
static bool ellipse_axes(const double v[6], double center[2], double x[2], double y[2])
{
    double det = 4 * v[0] * v[2] - v[1] * v[1];
    if (!(det > 0))
        return false;
    center[0] = (v[1] * v[4] - 2 * v[2] * v[3]) / det;
    center[1] = (v[1] * v[3] - 2 * v[0] * v[4]) / det;
    double value = v[5] + 0.5 * (v[3] * center[0] + v[4] * center[1]),
           angle = 0.5 * atan2(v[1], v[0] - v[2]), mean = 0.5 * (v[0] + v[2]),
           spread = 0.5 * hypot(v[0] - v[2], v[1]);
    double a = -value / (mean + spread), b = -value / (mean - spread);
    if (!(a > 0 && b > 0))
        return false;
    x[0] = sqrt(a) * cos(angle);
    x[1] = sqrt(a) * sin(angle);
    y[0] = -sqrt(b) * sin(angle);
    y[1] = sqrt(b) * cos(angle);
    return true;
}

/* Angle of a point on the ellipse. */
static double ellipse_angle(const double center[2], const double x[2], const double y[2],
                            const double p[2])
{
    double dx = p[0] - center[0], dy = p[1] - center[1];
    return atan2((dx * y[0] + dy * y[1]) / (y[0] * y[0] + y[1] * y[1]),
                 (dx * x[0] + dy * x[1]) / (x[0] * x[0] + x[1] * x[1]));
}

/* Hyperbola or parabola: one quadratic piece, the middle control point where the end tangents meet,
 * its weight from the point of the conic on the line from there to the middle of the chord. */
static nurbs_status open_conic(const iges_file *file, size_t entity, const double v[6],
                               const double ends[4], double z, double metres, nurbs_curve **curve)
{
    static const double knots[6] = {0, 0, 0, 1, 1, 1};
    double n[2][2], c[2], q[2];
    for (int e = 0; e < 2; e++) {
        const double *p = ends + 2 * e;
        n[e][0] = 2 * v[0] * p[0] + v[1] * p[1] + v[3];
        n[e][1] = v[1] * p[0] + 2 * v[2] * p[1] + v[4];
        c[e] = n[e][0] * p[0] + n[e][1] * p[1];
    }
    double det = n[0][0] * n[1][1] - n[0][1] * n[1][0];
    if (fabs(det) < 1e-12 * hypot(n[0][0], n[0][1]) * hypot(n[1][0], n[1][1]))
        return refuse(file, entity, "its end tangents are parallel");
    q[0] = (c[0] * n[1][1] - c[1] * n[0][1]) / det;
    q[1] = (n[0][0] * c[1] - n[1][0] * c[0]) / det;
    /* f(m + s (q - m)) = 0 for 0 < s < 1; the weight is s / (1 - s). */
    double m[2] = {0.5 * (ends[0] + ends[2]), 0.5 * (ends[1] + ends[3])},
           d[2] = {q[0] - m[0], q[1] - m[1]};
    double a = v[0] * d[0] * d[0] + v[1] * d[0] * d[1] + v[2] * d[1] * d[1],
           b = (2 * v[0] * m[0] + v[1] * m[1] + v[3]) * d[0] +
               (v[1] * m[0] + 2 * v[2] * m[1] + v[4]) * d[1],
           f = v[0] * m[0] * m[0] + v[1] * m[0] * m[1] + v[2] * m[1] * m[1] + v[3] * m[0] +
               v[4] * m[1] + v[5];
    double root = sqrt(fmax(b * b - 4 * a * f, 0)), denominator = b < 0 ? root - b : -root - b,
           s = 2 * f / denominator;
    if (!(s > 0 && s < 1))
        s = denominator / (2 * a);
    if (!(s > 0 && s < 1))
        return refuse(file, entity, "its ends lie on different branches");
    const double weights[3] = {1, s / (1 - s), 1},
                 points[9] = {metres * ends[0], metres * ends[1], metres * z,
                              metres * q[0],    metres * q[1],    metres * z,
                              metres * ends[2], metres * ends[3], metres * z};
    return nurbs_curve_create(2, 3, knots, points, weights, curve);
}

/* Conic arc 104: A to F, ZT, start, end; an ellipse runs counterclockwise. */
nurbs_status iges_conic(const iges_file *file, size_t entity, double metres, nurbs_curve **curve)
{
    double v[11], c[2], x[2], y[2];
    nurbs_status status = read_reals(file, entity, 0, 11, v);
    *curve = NULL;
    if (status != NURBS_OK)
        return status;
    if (4 * v[0] * v[2] - v[1] * v[1] <= 1e-12 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]))
        return open_conic(file, entity, v, v + 7, v[6], metres, curve);
    if (!ellipse_axes(v, c, x, y))
        return refuse(file, entity, "its conic has no points");
    double a = ellipse_angle(c, x, y, v + 7), b = ellipse_angle(c, x, y, v + 9);
    if (b <= a + 1e-12)
        b += turn;
    const double center[3] = {metres * c[0], metres * c[1], metres * v[6]},
                 first[3] = {metres * x[0], metres * x[1], 0},
                 second[3] = {metres * y[0], metres * y[1], 0};
    return arc_create(center, first, second, a, b, curve);
}

/* Copious data 106, forms 11, 12, 13 and 63: points joined by lines. */
nurbs_status iges_polyline(const iges_file *file, size_t entity, double metres, nurbs_curve **curve)
{
    long kind, n;
    double z = 0;
    nurbs_status status = iges_integer(file, entity, 0, 0, &kind);
    *curve = NULL;
    if (status == NURBS_OK)
        status = iges_integer(file, entity, 1, 0, &n);
    if (status == NURBS_OK && kind == 1)
        status = iges_real(file, entity, 2, 0, &z);
    if (status != NURBS_OK)
        return status;
    if (n < 2 || n > MAX_POINTS || kind < 1 || kind > 3)
        return refuse(file, entity, "is no polyline of at least two points");
    size_t count = (size_t)n,
           each = kind == 1   ? 2
                  : kind == 2 ? 3
                              : 6,
           at = kind == 1 ? 3 : 2, kept = 0;
    if (at + each * count > iges_parameters(file, entity))
        return refuse(file, entity, "fewer parameters than its sizes ask for");
    double *points = malloc((4 * count + 2) * sizeof *points), *knots = points + 3 * count;
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu points", file->path, count);
    for (size_t k = 0; k < count && status == NURBS_OK; k++) {
        double p[3] = {0, 0, z};
        status = read_reals(file, entity, at + each * k, each == 2 ? 2 : 3, p);
        for (size_t c = 0; c < 3; c++)
            points[3 * kept + c] = metres * p[c];
        double step = kept ? distance3(points + 3 * kept - 3, points + 3 * kept) : 0;
        if (kept && !(step > 0))
            continue;
        knots[kept + 1] = kept ? knots[kept] + step : 0;
        kept++;
    }
    if (status == NURBS_OK && kept < 2)
        status = refuse(file, entity, "all its points coincide");
    if (status == NURBS_OK) {
        knots[0] = 0;
        knots[kept + 1] = knots[kept];
        status = nurbs_curve_create(1, kept, knots, points, NULL, curve);
    }
    free(points);
    return status;
}

/* Parametric spline 112: CTYPE, H, NDIM, N, N + 1 breakpoints, then per segment four coefficients
 * for each of x, y, z. Cubic Bezier pieces side by side. */
nurbs_status iges_parametric(const iges_file *file, size_t entity, double metres,
                             nurbs_curve **curve)
{
    long n = 0;
    nurbs_status status = iges_integer(file, entity, 3, 0, &n);
    *curve = NULL;
    if (status != NURBS_OK)
        return status;
    if (n < 1 || n > MAX_POINTS)
        return refuse(file, entity, "number of segments out of range");
    size_t segments = (size_t)n, size = 3 * segments + 1;
    if (4 + segments + 1 + 12 * segments > iges_parameters(file, entity))
        return refuse(file, entity, "fewer parameters than its sizes ask for");
    double *breaks = malloc((segments + 1 + 3 * size + size + 4) * sizeof *breaks);
    if (!breaks)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu segments", file->path,
                          segments);
    double *points = breaks + segments + 1, *knots = points + 3 * size;
    status = read_reals(file, entity, 4, segments + 1, breaks);
    for (size_t s = 0; s < segments && status == NURBS_OK; s++) {
        double a[12], h = breaks[s + 1] - breaks[s];
        status = read_reals(file, entity, 4 + segments + 1 + 12 * s, 12, a);
        if (status == NURBS_OK && !(h > 0))
            status = refuse(file, entity, "its breakpoints do not increase");
        for (size_t c = 0; c < 3; c++) {
            const double *v = a + 4 * c;
            double b1 = h * v[1] / 3, b2 = h * h * v[2] / 3, b3 = h * h * h * v[3],
                   *to = points + 9 * s + c;
            to[0] = metres * v[0];
            to[3] = metres * (v[0] + b1);
            to[6] = metres * (v[0] + 2 * b1 + b2);
            to[9] = metres * (v[0] + 3 * b1 + 3 * b2 + b3);
        }
    }
    for (size_t k = 0; k < size + 4; k++)
        knots[k] = breaks[k < 4 ? 0 : k >= size ? segments : (k - 1) / 3];
    if (status == NURBS_OK)
        status = nurbs_curve_create(3, size, knots, points, NULL, curve);
    free(breaks);
    return status;
}
