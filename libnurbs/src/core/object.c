#include "core/object.h"

#include "core/basis_kernel.h"
#include "core/error.h"

#include <nurbs/basis.h>

#include <float.h>
#include <math.h>
#include <string.h>

/* Two parts for each span keep the walk of axis_span to about one step. */
static size_t bucket_count(int degree, size_t size)
{
    return 2 * (size - (size_t)degree);
}

size_t axis_bytes(int degree, size_t size)
{
    return padded((size + (size_t)degree + 1) * sizeof(double)) +
           padded((size_t)degree * (size + (size_t)degree) * sizeof(double)) +
           padded((bucket_count(degree, size) + 1) * sizeof(uint32_t));
}

void axis_place(struct axis *axis, int degree, size_t size, const double *knots, char **cursor)
{
    const size_t n_knots = size + (size_t)degree + 1;
    axis->degree = degree;
    axis->size = size;
    axis->knots = take(cursor, n_knots * sizeof(double));
    memcpy(axis->knots, knots, n_knots * sizeof(double));
    axis->inverse = take(cursor, (size_t)degree * axis_stride(axis) * sizeof(double));
    for (size_t q = 1; q <= (size_t)degree; q++)
        for (size_t e = 0; e < axis_stride(axis); e++) {
            const double h = e + 1 >= q ? knots[e + 1] - knots[e + 1 - q] : 0.0;
            axis->inverse[(q - 1) * axis_stride(axis) + e] = h > 0.0 ? reciprocal(h) : 0.0;
        }
    axis->buckets = bucket_count(degree, size);
    axis->bucket = take(cursor, (axis->buckets + 1) * sizeof(uint32_t));
    const double length = knots[size] - knots[0];
    axis->scale = (double)axis->buckets / length;
    size_t span = (size_t)degree;
    for (size_t k = 0; k <= axis->buckets; k++) {
        const double u = knots[0] + length * ((double)k / (double)axis->buckets);
        while (span + 1 < size && u >= knots[span + 1])
            span++;
        axis->bucket[k] = (uint32_t)span;
    }
}

/* Whether all n values are finite; without an early exit, so that it runs in vector registers. */
NURBS_MULTIVERSION
static int all_finite(size_t n, const double *values)
{
    int finite = 1;
    for (size_t i = 0; i < n; i++)
        finite &= fabs(values[i]) <= DBL_MAX;
    return finite;
}

nurbs_status points_check(size_t n, const double *points, const double *weights)
{
    if (!points)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "points is NULL, expected %zu x,y,z triples", n);
    if (!all_finite(3 * n, points))
        for (size_t i = 0; i < 3 * n; i++)
            if (!isfinite(points[i]))
                return nurbs_fail(NURBS_ERROR_ARGUMENT,
                                  "control point %zu has %c = %g, expected a finite number", i / 3,
                                  "xyz"[i % 3], points[i]);
    for (size_t i = 0; weights && i < n; i++) {
        if (!isfinite(weights[i]) || weights[i] <= 0.0)
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "weight %zu is %g, expected a positive finite number", i, weights[i]);
        for (size_t c = 0; c < 3; c++)
            if (!isfinite(weights[i] * points[3 * i + c]))
                return nurbs_fail(NURBS_ERROR_ARGUMENT,
                                  "control point %zu times its weight %g is not finite", i,
                                  weights[i]);
    }
    return NURBS_OK;
}

void homogenize(size_t n, const double *points, const double *weights, double *net)
{
    for (size_t i = 0; i < n; i++) {
        const double w = weights ? weights[i] : 1.0;
        for (size_t c = 0; c < 3; c++)
            net[4 * i + c] = w * points[3 * i + c];
        net[4 * i + 3] = w;
    }
}
