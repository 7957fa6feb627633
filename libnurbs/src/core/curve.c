#include "core/error.h"
#include "core/object.h"

#include <nurbs/basis.h>

#include <stdlib.h>
#include <string.h>

nurbs_status nurbs_curve_create(int degree, size_t n, const double *knots, const double *points,
                                const double *weights, nurbs_curve **curve)
{
    if (!curve)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "curve is NULL, expected a place for the result");
    *curve = NULL;
    nurbs_status status = nurbs_knots_check(degree, n, knots);
    if (status == NURBS_OK && n > NURBS_MAX_POINTS)
        status = nurbs_fail(NURBS_ERROR_ARGUMENT, "%zu control points are too many", n);
    if (status == NURBS_OK)
        status = points_check(n, points, weights);
    if (status != NURBS_OK)
        return status;

    const size_t header = padded(sizeof(nurbs_curve));
    nurbs_curve *c = aligned_alloc(64, header + axis_bytes(degree, n) + net_bytes(n));
    if (!c)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a curve of %zu control points", n);
    char *cursor = (char *)c + header;
    axis_place(&c->axis, degree, n, knots, &cursor);
    c->net = take(&cursor, 4 * n * sizeof(double));
    c->points = take(&cursor, 3 * n * sizeof(double));
    c->weights = weights ? take(&cursor, n * sizeof(double)) : NULL;
    memcpy(c->points, points, 3 * n * sizeof(double));
    if (weights)
        memcpy(c->weights, weights, n * sizeof(double));
    homogenize(n, points, weights, c->net);
    *curve = c;
    return NURBS_OK;
}

nurbs_status nurbs_curve_copy(const nurbs_curve *curve, nurbs_curve **copy)
{
    NURBS_NEED(curve && copy);
    return nurbs_curve_create(curve->axis.degree, curve->axis.size, curve->axis.knots,
                              curve->points, curve->weights, copy);
}

void nurbs_curve_free(nurbs_curve *curve)
{
    free(curve);
}

int nurbs_curve_degree(const nurbs_curve *curve)
{
    return curve ? curve->axis.degree : 0;
}

size_t nurbs_curve_size(const nurbs_curve *curve)
{
    return curve ? curve->axis.size : 0;
}

const double *nurbs_curve_knots(const nurbs_curve *curve)
{
    return curve ? curve->axis.knots : NULL;
}

const double *nurbs_curve_points(const nurbs_curve *curve)
{
    return curve ? curve->points : NULL;
}

const double *nurbs_curve_weights(const nurbs_curve *curve)
{
    return curve ? curve->weights : NULL;
}
