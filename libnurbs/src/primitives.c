#include "error.h"
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

/* A half circle as two quarter arcs: points (c, s) from (-1,0) over (0,1) to (1,0), The NURBS Book
 * section 7.5. */
static const double arc_c[5] = {-1, -1, 0, 1, 1};
static const double arc_s[5] = {0, 1, 1, 1, 0};
static const double arc_w[5] = {1, 0.70710678118654752440, 1, 0.70710678118654752440, 1};
static const double arc_knots[8] = {0, 0, 0, 0.5, 0.5, 1, 1, 1};

nurbs_status nurbs_make_ellipsoid(double length, double beam, double height, double depth,
                                  nurbs_surface **surface)
{
    *surface = NULL;
    nurbs_status status = check_lengths("ellipsoid", 3, (const double[]){length, beam, height});
    if (status != NURBS_OK)
        return status;
    if (!isfinite(depth))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "ellipsoid: depth is %g", depth);
    /* The meridian (c_i, s_i) from the aft to the fore end, turned about the axis: v runs from the
     * top (-c = 1) to the bottom; both factors carry their weights. */
    double points[75], weights[25];
    for (size_t i = 0; i < 5; i++)
        for (size_t j = 0; j < 5; j++) {
            double *p = points + 3 * (5 * i + j);
            p[0] = 0.5 * length * arc_c[i];
            p[1] = 0.5 * beam * arc_s[i] * arc_s[j];
            p[2] = -depth - 0.5 * height * arc_s[i] * arc_c[j];
            weights[5 * i + j] = arc_w[i] * arc_w[j];
        }
    return nurbs_surface_create((const int[]){2, 2}, (const size_t[]){5, 5}, arc_knots, arc_knots,
                                points, weights, surface);
}

nurbs_status nurbs_make_wigley(double length, double beam, double draft, nurbs_surface **surface)
{
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
