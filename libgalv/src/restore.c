/* A model as plain numbers and back. */
#include "error.h"
#include "model.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

galv_model_data galv_model_view(const galv_model *model)
{
    return (galv_model_data){.samples = model->samples,
                             .points = model->points,
                             .coordinates = model->coordinates,
                             .active = model->active,
                             .parameters = model->parameters,
                             .modes = model->modes,
                             .spectrum = model->spectrum,
                             .kept = model->kept,
                             .passes = model->passes,
                             .centred = model->centred,
                             .method = model->method,
                             .retained = model->retained,
                             .retained_geometry = model->retained_geometry,
                             .trace = model->trace,
                             .trace_geometry = model->trace_geometry,
                             .truncation = model->truncation,
                             .confidence = model->confidence,
                             .eigenvalues = model->eigenvalues,
                             .residuals = model->residuals,
                             .mse = model->mse,
                             .vectors = model->vectors,
                             .mean = model->mean,
                             .parent = model->points ? model->parent : NULL,
                             .weights = model->weights,
                             .latent = model->latent,
                             .lower = model->lower,
                             .upper = model->upper,
                             .regression = model->regression};
}

static galv_status check_sizes(const galv_model_data *data)
{
    if (data->samples == 0 || data->modes == 0 || data->kept < data->modes ||
        data->spectrum < data->kept || data->coordinates < data->active ||
        data->active < data->spectrum || data->coordinates < 3 * data->points)
        return galv_fail(
            GALV_ERROR_ARGUMENT,
            "no model has %zu samples, %zu modes, %zu vectors, %zu eigenvalues, %zu of "
            "%zu coordinates moving, %zu points",
            data->samples, data->modes, data->kept, data->spectrum, data->active, data->coordinates,
            data->points);
    if (!data->eigenvalues || !data->residuals || !data->mse || !data->vectors || !data->mean ||
        !data->latent || !data->lower || !data->upper || (data->points && !data->parent) ||
        (data->parameters && !data->regression))
        return galv_fail(GALV_ERROR_ARGUMENT, "an array of the model is missing");
    return GALV_OK;
}

static galv_status check_array(const char *name, size_t n, const double *values)
{
    for (size_t i = 0; values && i < n; i++)
        if (!isfinite(values[i]))
            return galv_fail(GALV_ERROR_ARGUMENT, "%s: entry %zu is %g", name, i, values[i]);
    return GALV_OK;
}

static galv_status check_values(const galv_model_data *data)
{
    const struct {
        const char *name;
        size_t n;
        const double *values;
    } arrays[] = {
        {"eigenvalues", data->spectrum, data->eigenvalues},
        {"residuals", data->spectrum, data->residuals},
        {"mse", data->spectrum, data->mse},
        {"vectors", data->kept * data->coordinates, data->vectors},
        {"mean", data->coordinates, data->mean},
        {"parent", 3 * data->points, data->parent},
        {"weights", data->coordinates, data->weights},
        {"latent", data->samples * data->modes, data->latent},
        {"lower", data->modes, data->lower},
        {"upper", data->modes, data->upper},
        {"regression", data->parameters * (1 + data->modes), data->regression},
    };
    galv_status status = GALV_OK;
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0] && !status; i++)
        status = check_array(arrays[i].name, arrays[i].n, arrays[i].values);
    for (size_t k = 0; k < data->spectrum && !status; k++)
        if (!(data->eigenvalues[k] > 0) ||
            (k > 0 && data->eigenvalues[k] > data->eigenvalues[k - 1]))
            status =
                galv_fail(GALV_ERROR_ARGUMENT, "eigenvalue %zu is %g: not positive and falling", k,
                          data->eigenvalues[k]);
    for (size_t i = 0; data->weights && i < data->coordinates && !status; i++)
        if (!(data->weights[i] > 0))
            status = galv_fail(GALV_ERROR_ARGUMENT, "weight %zu is %g", i, data->weights[i]);
    if (!status && !(data->trace > 0 && isfinite(data->trace)))
        status = galv_fail(GALV_ERROR_ARGUMENT, "the trace is %g", data->trace);
    return status;
}

static void copy(double *to, const double *from, size_t n)
{
    if (from && n)
        memcpy(to, from, n * sizeof *to);
}

galv_status galv_model_restore(const galv_model_data *data, galv_model **out)
{
    if (!data || !out)
        return galv_fail(GALV_ERROR_ARGUMENT, "data and result must be given");
    galv_status status = check_sizes(data);
    if (!status)
        status = check_values(data);
    if (status)
        return status;
    galv_model sizes = {.samples = data->samples,
                        .points = data->points,
                        .coordinates = data->coordinates,
                        .active = data->active,
                        .parameters = data->parameters,
                        .modes = data->modes,
                        .spectrum = data->spectrum,
                        .kept = data->kept,
                        .centred = data->centred,
                        .method = data->method,
                        .passes = data->passes,
                        .retained = data->retained,
                        .retained_geometry = data->retained_geometry,
                        .trace = data->trace,
                        .trace_geometry = data->trace_geometry,
                        .truncation = data->truncation,
                        .confidence = data->confidence};
    galv_model *model = galv_model_new(&sizes, data->weights != NULL);
    if (!model)
        return galv_fail(GALV_ERROR_MEMORY, "model of %zu modes, %zu coordinates", data->modes,
                         data->coordinates);
    copy(model->eigenvalues, data->eigenvalues, data->spectrum);
    copy(model->residuals, data->residuals, data->spectrum);
    copy(model->mse, data->mse, data->spectrum);
    copy(model->vectors, data->vectors, data->kept * data->coordinates);
    copy(model->mean, data->mean, data->coordinates);
    copy(model->parent, data->parent, 3 * data->points);
    copy(model->weights, data->weights, data->coordinates);
    copy(model->latent, data->latent, data->samples * data->modes);
    copy(model->lower, data->lower, data->modes);
    copy(model->upper, data->upper, data->modes);
    copy(model->regression, data->regression, data->parameters * (1 + data->modes));
    *out = model;
    return GALV_OK;
}
