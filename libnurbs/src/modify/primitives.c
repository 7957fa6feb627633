#include "core/error.h"

#include <nurbs/primitives.h>

#include <math.h>

static nurbs_status check_lengths(const char *body, size_t n, const double *values)
{
    for (size_t k = 0; k < n; k++)
        if (!(isfinite(values[k]) && values[k] > 0))
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s: length %zu is %g, expected > 0", body, k,
                              values[k]);
    return NURBS_OK;
}

/* A half circle from (-1,0) over (0,1) to (1,0) as one rational quartic, -1 <= t <= 1:
 *     s + i c = q^2/|q|^2,  q = 1 - b t^2 + i a t,  a = 1 - b.
 * The angle is 2 arg q, smooth over the whole arc. Two rational quadratic quarters (The NURBS Book,
 * section 7.5) would be C1 only where they meet: a limit to the order of anything expanded in these
 * parameters. The speed of the angle is 2 a in the middle and (1 + b)/a at the ends; b makes their
 * ratio that of `grading`, 1 for a speed constant within 1.1 %. Control points are blossoms on the
 * knots -1 (five times), 0, 1 (five times). */
enum { ARC_POINTS = 6, ARC_DEGREE = 4 };
static const double arc_knots[11] = {0, 0, 0, 0, 0, 0.5, 1, 1, 1, 1, 1};

struct arc {
    double c[ARC_POINTS], s[ARC_POINTS], w[ARC_POINTS];
};

static void fill_arc(double grading, struct arc *arc)
{
    const double b = 0.25 * (4 + grading - sqrt(grading * grading + 16 * grading)), a = 1 - b;
    const double even = a * a - 2 * b, odd = a * a + 2 * b;
    const double w[3] = {2 * a * a, 1 + even / 2, 1 - even / 6};
    const double s[3] = {0, 1 - odd / 2, 1 + odd / 6};
    const double c[3] = {-2 * a * a, -a * (3 - b) / 2, -a * (1 + b) / 2};
    for (int i = 0; i < 3; i++) {
        int mirror = ARC_POINTS - 1 - i;
        arc->w[i] = arc->w[mirror] = w[i] / w[0];
        arc->s[i] = arc->s[mirror] = s[i] / w[i];
        arc->c[i] = c[i] / w[i];
        arc->c[mirror] = -arc->c[i];
    }
}

nurbs_status nurbs_make_ellipsoid(double length, double beam, double height, double depth,
                                  nurbs_surface **surface)
{
    NURBS_NEED(surface);
    *surface = NULL;
    nurbs_status status = check_lengths("ellipsoid", 3, (const double[]){length, beam, height});
    if (status != NURBS_OK)
        return status;
    if (!isfinite(depth))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "ellipsoid: depth is %g", depth);
    /* The meridian from the aft to the fore end, turned about the axis: v runs from the top
     * (-c = 1) to the bottom; both factors carry their weights. Knot spans of equal length are
     * shorter where the body is curved more. */
    struct arc u, v;
    double points[3 * ARC_POINTS * ARC_POINTS], weights[ARC_POINTS * ARC_POINTS];
    fill_arc(sqrt(length / sqrt(beam * height)), &u);
    fill_arc(sqrt(height / beam), &v);
    for (size_t i = 0; i < ARC_POINTS; i++)
        for (size_t j = 0; j < ARC_POINTS; j++) {
            double *p = points + 3 * (ARC_POINTS * i + j);
            p[0] = 0.5 * length * u.c[i];
            p[1] = 0.5 * beam * u.s[i] * v.s[j];
            p[2] = -depth - 0.5 * height * u.s[i] * v.c[j];
            weights[ARC_POINTS * i + j] = u.w[i] * v.w[j];
        }
    return nurbs_surface_create((const int[]){ARC_DEGREE, ARC_DEGREE},
                                (const size_t[]){ARC_POINTS, ARC_POINTS}, arc_knots, arc_knots,
                                points, weights, surface);
}

nurbs_status nurbs_make_wigley(double length, double beam, double draft, nurbs_surface **surface)
{
    NURBS_NEED(surface);
    *surface = NULL;
    nurbs_status status = check_lengths("Wigley hull", 3, (const double[]){length, beam, draft});
    if (status != NURBS_OK)
        return status;
    static const double knots[6] = {0, 0, 0, 1, 1, 1};
    /* Bernstein coefficients: x is linear, 1 - (2x/L)^2 = 4u(1-u) -> 0,2,0; z = -T v,
     * 1 - v^2 -> 1,1,0. */
    static const double along[3] = {0, 2, 0}, down[3] = {1, 1, 0};
    double points[27];
    for (size_t i = 0; i < 3; i++)
        for (size_t j = 0; j < 3; j++) {
            double *p = points + 3 * (3 * i + j);
            p[0] = 0.5 * length * ((double)i - 1);
            p[1] = 0.5 * beam * along[i] * down[j];
            p[2] = -0.5 * draft * (double)j;
        }
    return nurbs_surface_create((const int[]){2, 2}, (const size_t[]){3, 3}, knots, knots, points,
                                NULL, surface);
}
