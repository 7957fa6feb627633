#include "error.h"
#include "latent.h"
#include "model.h"
#include "shape.h"
#include "spectrum.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void galv_options_init(galv_options *options)
{
    *options = (galv_options){.variance = 0.95,
                              .spectrum = 64,
                              .method = GALV_METHOD_AUTO,
                              .workspace = (size_t)512 << 20,
                              .seed = 1};
}

static galv_status check_options(const galv_options *options, size_t npoints)
{
    if (options->modes == 0 && !(options->variance > 0 && options->variance <= 1))
        return galv_fail(GALV_ERROR_ARGUMENT,
                         "variance to retain %g, expected more than 0, at most 1",
                         options->variance);
    if (options->method < GALV_METHOD_AUTO || options->method > GALV_METHOD_RANDOMISED)
        return galv_fail(GALV_ERROR_ARGUMENT, "unknown method %d", (int)options->method);
    for (size_t p = 0; options->weights && p < npoints; p++)
        if (!(options->weights[p] > 0) || !isfinite(options->weights[p]))
            return galv_fail(GALV_ERROR_ARGUMENT, "weight of point %zu is %g, expected more than 0",
                             p, options->weights[p]);
    return GALV_OK;
}

static galv_status check_sampling(const galv_sampling *sampling, size_t n)
{
    if (sampling->count == 0)
        return galv_fail(GALV_ERROR_ARGUMENT, "no samples");
    for (size_t i = 0; sampling->x && i < sampling->count * n; i++)
        if (!isfinite(sampling->x[i]))
            return galv_fail(GALV_ERROR_ARGUMENT, "sample %zu: parameter %zu is %g", i / n, i % n,
                             sampling->x[i]);
    return GALV_OK;
}

/* The exact side with the smaller matrix that takes at most half of the workspace. */
static galv_method choose_method(size_t samples, size_t stored, size_t workspace)
{
    double room = (double)workspace / 2;
    bool covariance = 8.0 * (double)stored * (double)stored <= room;
    bool gram = 8.0 * (double)samples * (double)samples <= room;
    if (covariance && (stored <= samples || !gram))
        return GALV_METHOD_COVARIANCE;
    return gram ? GALV_METHOD_GRAM : GALV_METHOD_RANDOMISED;
}

/* Rows per block: enough for matrix products to run at speed, within an eighth of the workspace. */
static size_t block_rows(size_t samples, size_t coordinates, size_t workspace)
{
    size_t block = workspace / 8 / (2 * sizeof(double) * coordinates);
    block = block > 512 ? 512 : block < 16 ? 16 : block;
    return block < samples ? block : samples;
}

static galv_status find_spectrum(galv_stream *stream, galv_method method, const galv_goal *goal,
                                 galv_spectrum *spectrum)
{
    switch (method) {
    case GALV_METHOD_GRAM:
        return galv_spectrum_gram(stream, goal, spectrum);
    case GALV_METHOD_RANDOMISED:
        return galv_spectrum_randomised(stream, goal, spectrum);
    default:
        return galv_spectrum_covariance(stream, goal, spectrum);
    }
}

/* Mode k of the model from eigenvector k: unscaled, at its coordinates, its largest component
 * positive. The eigenvector takes the same sign. */
static void store_mode(const galv_stream *stream, galv_spectrum *spectrum, size_t k,
                       galv_model *model)
{
    const galv_source *source = stream->source;
    double *vector = spectrum->vectors + k * spectrum->active, largest = 0;
    double *mode = model->vectors + k * model->coordinates;
    for (size_t a = 0; a < spectrum->active; a++) {
        size_t s = stream->place[a];
        double value = stream->scale ? vector[a] / stream->scale[s] : vector[a];
        mode[source->index[s]] = value;
        if (fabs(value) > fabs(largest))
            largest = value;
    }
    if (largest > 0)
        return;
    for (size_t i = 0; i < model->coordinates; i++)
        mode[i] = -mode[i];
    for (size_t a = 0; a < spectrum->active; a++)
        vector[a] = -vector[a];
}

static void store_mean(const galv_stream *stream, const galv_spectrum *spectrum, galv_model *model)
{
    for (size_t a = 0; a < spectrum->active; a++) {
        size_t s = stream->place[a];
        double value = spectrum->mean[a];
        if (stream->scale)
            value /= stream->scale[s];
        model->mean[stream->source->index[s]] = value + stream->shift[s];
    }
}

static void store_spectrum(const galv_spectrum *spectrum, galv_model *model)
{
    double sum = 0;
    model->trace = spectrum->trace;
    model->passes = spectrum->passes + 1;
    model->active = spectrum->active;
    for (size_t k = 0; k < model->spectrum; k++) {
        model->eigenvalues[k] = spectrum->values[k];
        model->residuals[k] = spectrum->residuals[k];
        sum += spectrum->values[k];
        /* Rounding must not make an error negative. */
        model->mse[k] = fmax(spectrum->trace - sum, 0);
        if (k + 1 == model->modes)
            model->retained = fmin(sum / spectrum->trace, 1);
    }
}

/* Pairs the second pass projects on: beyond the modes, the neighbours that samples mix them with.
 */
static size_t pairs_to_project(const galv_goal *goal, size_t modes, size_t known)
{
    size_t pairs = 2 * modes + 8;
    if (goal->spectrum > pairs)
        pairs = goal->spectrum;
    return pairs < known ? pairs : known;
}

static galv_status finish(galv_stream *stream, galv_spectrum *spectrum, const galv_goal *goal,
                          const galv_shape_source *source, size_t npoints, const double *xyz,
                          const double *weights, galv_model **out)
{
    size_t n = galv_shape_parameters(source->shape);
    size_t modes = galv_goal_modes(goal, spectrum->known, spectrum->values, spectrum->trace);
    if (modes == 0)
        modes = spectrum->known;
    galv_model *model = galv_model_new(source->head.samples, npoints, source->head.coordinates, n,
                                       modes, spectrum->known, weights != NULL);
    if (!model)
        return galv_fail(GALV_ERROR_MEMORY, "model of %zu modes, %zu coordinates, %zu samples",
                         modes, source->head.coordinates, source->head.samples);
    model->centred = goal->centre;
    memcpy(model->parent, xyz, 3 * npoints * sizeof *xyz);
    if (weights)
        memcpy(model->weights, weights, model->coordinates * sizeof *weights);
    store_spectrum(spectrum, model);
    for (size_t k = 0; k < modes; k++)
        store_mode(stream, spectrum, k, model);
    if (goal->centre)
        store_mean(stream, spectrum, model);
    galv_status status = galv_latent_pass(
        stream, spectrum, pairs_to_project(goal, modes, spectrum->known), source, model);
    if (status) {
        galv_model_free(model);
        return status;
    }
    *out = model;
    return GALV_OK;
}

/* One weight per coordinate from one per point. */
static galv_status spread_weights(size_t npoints, const double *weights, double **out)
{
    *out = NULL;
    if (!weights)
        return GALV_OK;
    *out = malloc(3 * npoints * sizeof **out);
    if (!*out)
        return galv_fail(GALV_ERROR_MEMORY, "weights of %zu points", npoints);
    for (size_t i = 0; i < 3 * npoints; i++)
        (*out)[i] = weights[i / 3];
    return GALV_OK;
}

static galv_status build_from(galv_shape_source *source, size_t npoints, const double *xyz,
                              size_t block, const galv_options *options, galv_model **model)
{
    galv_goal goal = {.variance = options->variance,
                      .modes = options->modes,
                      .spectrum = options->spectrum ? options->spectrum : 1,
                      .centre = options->centre,
                      .workspace = options->workspace,
                      .seed = options->seed};
    galv_method method = options->method;
    if (method == GALV_METHOD_AUTO)
        method = choose_method(source->head.samples, source->head.stored, options->workspace);
    double *weights;
    galv_stream stream = {.source = NULL};
    galv_spectrum spectrum = {.active = 0};
    galv_status status = spread_weights(npoints, options->weights, &weights);
    if (!status)
        status = galv_stream_start(&stream, &source->head, block, weights, options->centre);
    if (!status) {
        stream.progress = options->progress;
        stream.progress_context = options->progress_context;
        stream.progress_share = 0.5;
        status = find_spectrum(&stream, method, &goal, &spectrum);
    }
    if (!status) {
        stream.progress_done = 0.5;
        status = finish(&stream, &spectrum, &goal, source, npoints, xyz, weights, model);
    }
    if (!status)
        (*model)->method = method;
    galv_spectrum_free(&spectrum);
    galv_stream_end(&stream);
    free(weights);
    return status;
}

galv_status galv_build(const galv_shape *shape, size_t npoints, const double *xyz,
                       galv_sampling sampling, const galv_options *options, galv_model **model)
{
    galv_options defaults;
    galv_options_init(&defaults);
    if (!options)
        options = &defaults;
    if (!shape || !model)
        return galv_fail(GALV_ERROR_ARGUMENT, "shape and result must be given");
    galv_status status = galv_points_check(npoints, xyz);
    if (!status)
        status = check_options(options, npoints);
    if (!status)
        status = check_sampling(&sampling, galv_shape_parameters(shape));
    if (status)
        return status;
    size_t block = block_rows(sampling.count, 3 * npoints, options->workspace);
    galv_shape_source source;
    status = galv_shape_source_start(&source, shape, npoints, xyz, sampling, block);
    if (status)
        return status;
    status = build_from(&source, npoints, xyz, block, options, model);
    galv_shape_source_end(&source);
    return status;
}
