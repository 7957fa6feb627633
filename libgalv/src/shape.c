#include "shape.h"

#include "error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

galv_status galv_shape_start(galv_shape *shape, const galv_shape_class *class, size_t n,
                             const double *lower, const double *upper)
{
    if (n == 0)
        return galv_fail(GALV_ERROR_ARGUMENT, "a shape needs at least one parameter");
    if (!lower || !upper)
        return galv_fail(GALV_ERROR_ARGUMENT, "the bounds of the %zu parameters are NULL", n);
    for (size_t i = 0; i < n; i++)
        if (!isfinite(lower[i]) || !isfinite(upper[i]) || lower[i] > upper[i])
            return galv_fail(GALV_ERROR_ARGUMENT,
                             "parameter %zu: bounds [%g, %g] must be finite and in order", i,
                             lower[i], upper[i]);
    double *bounds = malloc(2 * n * sizeof *bounds);
    if (!bounds)
        return galv_fail(GALV_ERROR_MEMORY, "bounds of %zu parameters", n);
    memcpy(bounds, lower, n * sizeof *bounds);
    memcpy(bounds + n, upper, n * sizeof *bounds);
    shape->class = class;
    shape->n = n;
    shape->lower = bounds;
    shape->upper = bounds + n;
    return GALV_OK;
}

void galv_shape_free(galv_shape *shape)
{
    if (!shape)
        return;
    free(shape->lower);
    shape->class->destroy(shape);
}

size_t galv_shape_parameters(const galv_shape *shape)
{
    return shape ? shape->n : 0;
}

const double *galv_shape_lower(const galv_shape *shape)
{
    return shape ? shape->lower : NULL;
}

const double *galv_shape_upper(const galv_shape *shape)
{
    return shape ? shape->upper : NULL;
}

bool galv_shape_is_linear(const galv_shape *shape)
{
    return shape && shape->class->linear;
}

galv_status galv_points_check(size_t npoints, const double *xyz)
{
    if (npoints == 0 || !xyz)
        return galv_fail(GALV_ERROR_ARGUMENT, "no points to displace");
    for (size_t i = 0; i < 3 * npoints; i++)
        if (!isfinite(xyz[i]))
            return galv_fail(GALV_ERROR_GEOMETRY, "point %zu: coordinate %c is %g", i / 3,
                             "xyz"[i % 3], xyz[i]);
    return GALV_OK;
}

galv_status galv_shape_displace(const galv_shape *shape, size_t npoints, const double *xyz,
                                const double *x, double *d)
{
    if (!shape || !x || !d)
        return galv_fail(GALV_ERROR_ARGUMENT, "shape, parameters and displacements must be given");
    galv_status status = galv_points_check(npoints, xyz);
    if (status)
        return status;
    for (size_t i = 0; i < shape->n; i++)
        if (!isfinite(x[i]))
            return galv_fail(GALV_ERROR_ARGUMENT, "parameter %zu is %g", i, x[i]);
    status = shape->class->displace(shape, npoints, xyz, x, d);
    if (status)
        return status;
    for (size_t i = 0; i < 3 * npoints; i++)
        if (!isfinite(d[i]))
            return galv_fail(GALV_ERROR_NUMERIC, "point %zu: displacement along %c is %g", i / 3,
                             "xyz"[i % 3], d[i]);
    return GALV_OK;
}

galv_status galv_box_around(size_t npoints, const double *xyz, galv_box *box)
{
    static const char axis[] = "xyz";
    if (!npoints || !xyz || !box)
        return galv_fail(GALV_ERROR_ARGUMENT, "points and a box must be given");
    for (size_t a = 0; a < 3; a++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t k = 0; k < npoints; k++) {
            low = fmin(low, xyz[3 * k + a]);
            high = fmax(high, xyz[3 * k + a]);
        }
        if (!isfinite(high - low) || !(high > low))
            return galv_fail(GALV_ERROR_GEOMETRY, "%zu points from %c = %g to %g have no extent",
                             npoints, axis[a], low, high);
        box->origin[a] = low;
        box->length[a] = high - low;
    }
    return GALV_OK;
}
