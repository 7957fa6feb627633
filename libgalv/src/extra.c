/* Appended quantities: their change under a displacement, and weights that balance them. */
#include "error.h"
#include "shape.h"
#include "source.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

galv_status galv_extra_change(const galv_extra *extra, size_t npoints, const double *xyz,
                              const double *d, double *values)
{
    if (!extra || !extra->evaluate || !d || !values)
        return galv_fail(GALV_ERROR_ARGUMENT, "quantities, displacement and result must be given");
    if (extra->given)
        return galv_fail(GALV_ERROR_ARGUMENT,
                         "%zu of the appended quantities are known for samples only, not for any "
                         "displacement",
                         extra->given);
    galv_status status = galv_points_check(npoints, xyz);
    if (status)
        return status;
    double *moved = malloc(3 * npoints * sizeof *moved);
    double *parent = malloc((extra->count + 1) * sizeof *parent);
    if (!moved || !parent)
        status = galv_fail(GALV_ERROR_MEMORY, "%zu moved points", npoints);
    for (size_t i = 0; i < 3 * npoints && !status; i++)
        moved[i] = xyz[i] + d[i];
    int refused = 0;
    if (!status)
        refused = extra->evaluate(extra->user_data, npoints, xyz, parent);
    if (!status && !refused)
        refused = extra->evaluate(extra->user_data, npoints, moved, values);
    if (refused)
        status = galv_fail(GALV_ERROR_NUMERIC, "the appended quantities gave %d", refused);
    for (size_t i = 0; i < extra->count && !status; i++) {
        values[i] -= parent[i];
        if (!isfinite(values[i]))
            status =
                galv_fail(GALV_ERROR_NUMERIC, "appended quantity %zu changes by %g", i, values[i]);
    }
    free(moved);
    free(parent);
    return status;
}

/* Second moments of the appended quantities and of the displacement as a whole, times N. */
static galv_status sum_squares(galv_shape_source *source, double *row, double *energy,
                               double *squares)
{
    size_t planned = source->plan->stored, count = source->extra->count;
    for (size_t r = 0; r < source->head.samples; r++) {
        galv_status status = source->head.rows(&source->head, r, 1, row);
        if (status)
            return status;
        for (size_t s = 0; s < planned; s++)
            *energy += row[s] * row[s];
        for (size_t i = 0; i < count; i++)
            squares[i] += row[planned + i] * row[planned + i];
    }
    return GALV_OK;
}

galv_status galv_extra_balance(const galv_shape *shape, size_t npoints, const double *xyz,
                               galv_sampling sampling, const galv_extra *extra, double share,
                               double *weights)
{
    if (!shape || !extra || extra->count == 0 || !weights || sampling.count == 0)
        return galv_fail(GALV_ERROR_ARGUMENT,
                         "shape, samples, quantities and weights must be given");
    if (!(share > 0) || !isfinite(share))
        return galv_fail(GALV_ERROR_ARGUMENT, "share %g of the variance, expected more than 0",
                         share);
    galv_status status = galv_points_check(npoints, xyz);
    if (status)
        return status;
    galv_shape_source source;
    status = galv_shape_source_start(&source, shape, npoints, xyz, sampling, extra, 1);
    if (status)
        return status;
    double *row = malloc(source.head.stored * sizeof *row), energy = 0;
    memset(weights, 0, extra->count * sizeof *weights);
    status = row ? sum_squares(&source, row, &energy, weights)
                 : galv_fail(GALV_ERROR_MEMORY, "one sample");
    for (size_t i = 0; i < extra->count && !status; i++) {
        if (!(weights[i] > 0))
            status = galv_fail(GALV_ERROR_GEOMETRY,
                               "appended quantity %zu changes in none of the %zu samples", i,
                               sampling.count);
        else
            weights[i] = share * energy / ((double)extra->count * weights[i]);
    }
    free(row);
    galv_shape_source_end(&source);
    return status;
}
