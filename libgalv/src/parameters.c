/* The full space of a shape as a model: its modes are the fields of the parameters themselves. */
#include "error.h"
#include "model.h"
#include "shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The derivative of the displacement with respect to parameter k at the parent: exact for shapes
 * that are linear and for sine products of either combination, which are linear along an axis. */
static galv_status field(const galv_shape *shape, size_t k, const galv_model *model, double *x,
                         double *mode)
{
    size_t length = model->coordinates;
    double step = (shape->upper[k] - shape->lower[k]) / 4, *side = malloc(length * sizeof *side);
    if (!side)
        return galv_fail(GALV_ERROR_MEMORY, "field of %zu coordinates", length);
    x[k] = step;
    galv_status status = galv_shape_displace(shape, model->points, model->parent, x, mode);
    x[k] = -step;
    if (!status)
        status = galv_shape_displace(shape, model->points, model->parent, x, side);
    x[k] = 0;
    for (size_t i = 0; i < length && !status; i++)
        mode[i] = (mode[i] - side[i]) / (2 * step);
    free(side);
    return status;
}

/* What parameter k, uniform between its bounds, adds to the trace. */
static double contribution(const galv_model *model, size_t k)
{
    const double *mode = model->vectors + k * model->coordinates;
    double width = model->upper[k] - model->lower[k], sum = 0;
    for (size_t i = 0; i < model->coordinates; i++)
        sum += mode[i] * mode[i];
    return sum * width * width / 12;
}

/* The ends of the box as samples: bounds, box and regression x = u follow from them. */
static void set_samples(galv_model *model)
{
    size_t n = model->modes;
    for (size_t k = 0; k < n; k++) {
        model->latent[2 * k * n + k] = model->lower[k];
        model->latent[(2 * k + 1) * n + k] = model->upper[k];
        model->regression[k * (1 + n) + 1 + k] = 1;
    }
}

static galv_status fill(const galv_shape *shape, const double *xyz, galv_model *model)
{
    size_t n = model->modes;
    double *x = calloc(n, sizeof *x);
    galv_status status = x ? GALV_OK : galv_fail(GALV_ERROR_MEMORY, "%zu parameters", n);
    memcpy(model->parent, xyz, model->coordinates * sizeof *xyz);
    for (size_t k = 0; k < n && !status; k++) {
        model->lower[k] = shape->lower[k];
        model->upper[k] = shape->upper[k];
        status = field(shape, k, model, x, model->vectors + k * model->coordinates);
        model->eigenvalues[k] = contribution(model, k);
        model->trace += model->eigenvalues[k];
    }
    model->trace_geometry = model->trace;
    for (size_t i = 0; i < model->coordinates && !status; i++) {
        bool moves = false;
        for (size_t k = 0; k < n; k++)
            moves = moves || model->vectors[k * model->coordinates + i] != 0;
        model->active += moves;
    }
    set_samples(model);
    free(x);
    return status;
}

galv_status galv_build_parameters(const galv_shape *shape, size_t npoints, const double *xyz,
                                  galv_model **out)
{
    if (!shape || !out)
        return galv_fail(GALV_ERROR_ARGUMENT, "shape and result must be given");
    *out = NULL;
    galv_status status = galv_points_check(npoints, xyz);
    size_t n = shape->n;
    for (size_t k = 0; k < n && !status; k++)
        if (!(shape->lower[k] < 0 && shape->upper[k] > 0))
            status =
                galv_fail(GALV_ERROR_ARGUMENT, "parameter %zu: bounds [%g, %g], expected 0 inside",
                          k, shape->lower[k], shape->upper[k]);
    if (status)
        return status;
    galv_model sizes = {.samples = 2 * n,
                        .points = npoints,
                        .coordinates = 3 * npoints,
                        .parameters = n,
                        .modes = n,
                        .spectrum = n,
                        .kept = n,
                        .passes = 1,
                        .method = GALV_METHOD_PARAMETERS,
                        .retained = 1,
                        .retained_geometry = 1,
                        .confidence = {NAN, NAN, NAN, {0}}};
    galv_model *model = galv_model_new(&sizes, false);
    if (!model)
        return galv_fail(GALV_ERROR_MEMORY, "model of %zu parameters on %zu points", n, npoints);
    status = fill(shape, xyz, model);
    if (!status && model->active == 0)
        status = galv_fail(GALV_ERROR_GEOMETRY, "no parameter moves a point");
    if (status) {
        galv_model_free(model);
        return status;
    }
    *out = model;
    return GALV_OK;
}
