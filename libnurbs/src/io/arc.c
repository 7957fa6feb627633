#include "core/constants.h"
#include "core/error.h"
#include "core/vector.h"
#include "io/form.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double quarter = PI / 2;

static size_t arc_pieces(double a, double b)
{
    double pieces = ceil((b - a) / quarter - 1e-9);
    return pieces < 1 ? 1 : (size_t)pieces;
}

static void arc_knots(double a, double b, size_t pieces, double *knots)
{
    size_t n = 2 * pieces + 1;
    for (size_t k = 0; k < n + 3; k++)
        knots[k] = k < 3 ? a : k >= n ? b : a + (b - a) * (double)((k - 1) / 2) / (double)pieces;
}

nurbs_status arc_create(const double center[3], const double x[3], const double y[3], double a,
                        double b, nurbs_curve **curve)
{
    double knots[16], points[3 * 11], weights[11];
    *curve = NULL;
    if (!(b > a && b - a <= 4 * quarter + 1e-9))
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "an arc from angle %g to %g", a, b);
    size_t pieces = arc_pieces(a, b), n = 2 * pieces + 1;
    double half = 0.5 * (b - a) / (double)pieces;
    for (size_t k = 0; k < n; k++) {
        /* Middle control points lie where the tangents at both ends of a piece meet. */
        double angle = a + (double)k * half, w = k % 2 ? cos(half) : 1;
        for (size_t c = 0; c < 3; c++)
            points[3 * k + c] = center[c] + (cos(angle) * x[c] + sin(angle) * y[c]) / w;
        weights[k] = w;
    }
    arc_knots(a, b, pieces, knots);
    return nurbs_curve_create(2, n, knots, points, weights, curve);
}

double arc_parameter(double a, double b, double angle)
{
    size_t pieces = arc_pieces(a, b);
    double length = (b - a) / (double)pieces, place = floor((angle - a) / length);
    if (angle <= a || angle >= b)
        return angle <= a ? a : b;
    place = fmin(fmax(place, 0), (double)(pieces - 1));
    /* A piece with weights 1, cos h, 1 is the stereographic image of the line tan(angle / 2). */
    double start = a + place * length, from_middle = angle - start - 0.5 * length;
    return start + 0.5 * length * (1 + tan(0.5 * from_middle) / tan(0.25 * length));
}

nurbs_status curve_transform(const nurbs_curve *curve, const double matrix[9],
                             const double shift[3], nurbs_curve **result)
{
    size_t n = nurbs_curve_size(curve);
    const double *from = nurbs_curve_points(curve);
    double *points = malloc(3 * n * sizeof *points);
    *result = NULL;
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", n);
    for (size_t k = 0; k < n; k++)
        for (size_t c = 0; c < 3; c++)
            points[3 * k + c] = dot3(matrix + 3 * c, from + 3 * k) + shift[c];
    nurbs_status status = nurbs_curve_create(nurbs_curve_degree(curve), n, nurbs_curve_knots(curve),
                                             points, nurbs_curve_weights(curve), result);
    free(points);
    return status;
}

/* Row k of a revolved net: the profile turned by `angle`, its distance from the axis by 1 / w. */
static void turn_profile(const nurbs_curve *profile, const double origin[3],
                         const double (*frame)[3], double angle, double w, double *points,
                         double *weights)
{
    size_t m = nurbs_curve_size(profile);
    const double *p = nurbs_curve_points(profile), *own = nurbs_curve_weights(profile),
                 co = cos(angle) / w, si = sin(angle) / w;
    for (size_t j = 0; j < m; j++) {
        double q[3];
        minus3(p + 3 * j, origin, q);
        double x = dot3(q, frame[0]), y = dot3(q, frame[1]), z = dot3(q, frame[2]);
        along3(origin, co * x - si * y, frame[0], q);
        along3(q, si * x + co * y, frame[1], q);
        along3(q, z, frame[2], points + 3 * j);
        weights[j] = w * (own ? own[j] : 1);
    }
}

nurbs_status revolve(const nurbs_curve *profile, const double origin[3], const double (*frame)[3],
                     double a, double b, nurbs_surface **surface)
{
    *surface = NULL;
    if (!(b > a && b - a <= 4 * quarter + 1e-9))
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "a revolution from angle %g to %g", a, b);
    size_t pieces = arc_pieces(a, b), n = 2 * pieces + 1, m = nurbs_curve_size(profile);
    double *points = malloc(4 * n * m * sizeof *points), knots[16],
           half = 0.5 * (b - a) / (double)pieces;
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu points", n, m);
    double *weights = points + 3 * n * m;
    for (size_t k = 0; k < n; k++)
        turn_profile(profile, origin, frame, a + (double)k * half, k % 2 ? cos(half) : 1,
                     points + 3 * k * m, weights + k * m);
    arc_knots(a, b, pieces, knots);
    nurbs_status status =
        nurbs_surface_create((const int[]){2, nurbs_curve_degree(profile)}, (const size_t[]){n, m},
                             knots, nurbs_curve_knots(profile), points, weights, surface);
    free(points);
    return status;
}
