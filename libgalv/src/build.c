#include "build.h"

#include "error.h"
#include "latent.h"
#include "shape.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void galv_options_init(galv_options *options)
{
    if (!options)
        return;
    *options = (galv_options){.variance = 0.95,
                              .spectrum = 64,
                              .method = GALV_METHOD_AUTO,
                              .workspace = (size_t)512 << 20,
                              .seed = 1};
}

galv_status galv_options_check(const galv_options *options)
{
    if (options->threads < 0 || options->threads > MOST_THREADS)
        return galv_fail(GALV_ERROR_ARGUMENT, "threads is %d, expected 0 to %d", options->threads,
                         MOST_THREADS);
    if (options->modes == 0 && !(options->variance > 0 && options->variance <= 1))
        return galv_fail(GALV_ERROR_ARGUMENT,
                         "variance to retain %g, expected more than 0, at most 1",
                         options->variance);
    if (options->method < GALV_METHOD_AUTO || options->method > GALV_METHOD_FACTORED)
        return galv_fail(GALV_ERROR_ARGUMENT, "unknown method %d", (int)options->method);
    return GALV_OK;
}

galv_status galv_sampling_check(const galv_sampling *sampling, size_t n)
{
    if (sampling->count == 0)
        return galv_fail(GALV_ERROR_ARGUMENT, "no samples");
    for (size_t i = 0; sampling->x && i < sampling->count * n; i++)
        if (!isfinite(sampling->x[i]))
            return galv_fail(GALV_ERROR_ARGUMENT, "sample %zu: parameter %zu is %g", i / n, i % n,
                             sampling->x[i]);
    return GALV_OK;
}

size_t galv_block_rows(size_t samples, size_t coordinates, size_t workspace)
{
    size_t block = workspace / 4 / (2 * sizeof(double) * coordinates);
    block = block > 512 ? 512 : block < 16 ? 16 : block;
    return block < samples ? block : samples;
}

galv_goal galv_goal_from(const galv_options *options, bool centre)
{
    return (galv_goal){.variance = options->variance,
                       .modes = options->modes,
                       .spectrum = options->spectrum ? options->spectrum : 1,
                       .centre = centre,
                       .seed = options->seed};
}

/* The exact side with the smallest matrix that takes at most half of the workspace. */
galv_status galv_method_choose(const galv_job *job, galv_method *method)
{
    const galv_options *options = job->options;
    size_t samples = job->source->samples, stored = job->source->stored;
    bool linear = job->shape && !job->shape->extra && galv_plan_basis(job->shape->plan);
    *method = options->method;
    if (*method == GALV_METHOD_FACTORED && !linear)
        return galv_fail(GALV_ERROR_ARGUMENT,
                         "the factored method is for linear shapes without appended quantities");
    if (*method != GALV_METHOD_AUTO)
        return GALV_OK;
    double room = (double)options->workspace / 2;
    bool covariance = 8.0 * (double)stored * (double)stored <= room;
    bool gram = 8.0 * (double)samples * (double)samples <= room;
    *method = GALV_METHOD_RANDOMISED;
    if (linear && galv_shape_parameters(job->shape->shape) < (samples < stored ? samples : stored))
        *method = GALV_METHOD_FACTORED;
    else if (covariance && (stored <= samples || !gram))
        *method = GALV_METHOD_COVARIANCE;
    else if (gram)
        *method = GALV_METHOD_GRAM;
    return GALV_OK;
}

galv_status galv_spectrum_find(galv_stream *stream, const galv_job *job, galv_method method,
                               const galv_goal *goal, galv_spectrum *spectrum)
{
    switch (method) {
    case GALV_METHOD_GRAM:
        return galv_spectrum_gram(stream, goal, spectrum);
    case GALV_METHOD_RANDOMISED:
        return galv_spectrum_randomised(stream, goal, spectrum);
    case GALV_METHOD_FACTORED:
        return galv_spectrum_factored(stream, job->shape, goal, spectrum);
    default:
        return galv_spectrum_covariance(stream, goal, spectrum);
    }
}

/* Vector k of the model from eigenvector k: unscaled, at its coordinates, its largest component
 * positive. The eigenvector takes the same sign. */
static void store_vector(const galv_stream *stream, galv_spectrum *spectrum, size_t k,
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
        model->mean[stream->source->index[s]] = value + (stream->shift ? stream->shift[s] : 0);
    }
}

static void store_spectrum(const galv_spectrum *spectrum, galv_model *model)
{
    double sum = 0;
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

/* Vectors to keep: beyond the modes, the neighbours that other samples would mix them with. */
static size_t vectors_to_keep(size_t modes, size_t known)
{
    size_t kept = 2 * modes + 8;
    return kept < known ? kept : known;
}

galv_status galv_model_assemble(const galv_stream *stream, galv_spectrum *spectrum,
                                const galv_goal *goal, const galv_job *job, size_t samples,
                                size_t parameters, galv_model **out)
{
    size_t modes = galv_goal_modes(goal, spectrum->known, spectrum->values, spectrum->trace);
    if (modes == 0)
        modes = spectrum->known;
    galv_model sizes = {.samples = samples,
                        .points = job->points,
                        .coordinates = job->source->coordinates,
                        .active = spectrum->active,
                        .parameters = parameters,
                        .modes = modes,
                        .spectrum = spectrum->known,
                        .kept = vectors_to_keep(modes, spectrum->known),
                        .centred = goal->centre,
                        .passes = spectrum->passes + 1,
                        .trace = spectrum->trace};
    galv_model *model = galv_model_new(&sizes, job->weights != NULL);
    if (!model)
        return galv_fail(GALV_ERROR_MEMORY, "model of %zu modes, %zu coordinates, %zu samples",
                         modes, sizes.coordinates, samples);
    if (job->points)
        memcpy(model->parent, job->xyz, 3 * job->points * sizeof *model->parent);
    if (job->weights)
        memcpy(model->weights, job->weights, model->coordinates * sizeof *model->weights);
    store_spectrum(spectrum, model);
    for (size_t k = 0; k < model->kept; k++)
        store_vector(stream, spectrum, k, model);
    if (goal->centre)
        store_mean(stream, spectrum, model);
    *out = model;
    return GALV_OK;
}

static galv_status check_weights(const char *what, size_t n, const double *weights)
{
    for (size_t i = 0; i < n; i++)
        if (!(weights[i] > 0) || !isfinite(weights[i]))
            return galv_fail(GALV_ERROR_ARGUMENT, "weight of %s %zu is %g, expected more than 0",
                             what, i, weights[i]);
    return GALV_OK;
}

galv_status galv_weights_spread(size_t npoints, const double *weights, const galv_extra *extra,
                                double **out)
{
    size_t appended = extra ? extra->count : 0;
    *out = NULL;
    if (!weights && !extra)
        return GALV_OK;
    galv_status status = weights ? check_weights("point", npoints, weights) : GALV_OK;
    if (!status && extra && !extra->weights)
        status = galv_fail(GALV_ERROR_ARGUMENT, "the appended quantities have no weights");
    if (!status && extra)
        status = check_weights("appended quantity", appended, extra->weights);
    if (status)
        return status;
    *out = malloc((3 * npoints + appended) * sizeof **out);
    if (!*out)
        return galv_fail(GALV_ERROR_MEMORY, "weights of %zu points", npoints);
    for (size_t i = 0; i < 3 * npoints; i++)
        (*out)[i] = weights ? weights[i / 3] : 1;
    for (size_t i = 0; i < appended; i++)
        (*out)[3 * npoints + i] = extra->weights[i];
    return GALV_OK;
}

static galv_status run(const galv_job *job, galv_model **out)
{
    const galv_options *options = job->options;
    galv_goal goal = galv_goal_from(options, options->centre);
    galv_method method;
    galv_stream stream;
    galv_spectrum spectrum = {.active = 0};
    galv_model *model = NULL;
    galv_status status = galv_method_choose(job, &method);
    if (!status)
        status = galv_stream_start(&stream, job->source, job->block, job->weights, options->centre);
    if (status)
        return status;
    stream.stage.tell = options->progress;
    stream.stage.user_data = options->progress_user_data;
    status = galv_spectrum_find(&stream, job, method, &goal, &spectrum);
    if (!status)
        status =
            galv_model_assemble(&stream, &spectrum, &goal, job, job->source->samples,
                                job->shape ? galv_shape_parameters(job->shape->shape) : 0, &model);
    if (!status)
        status = galv_latent_pass(&stream, &spectrum, job->shape, model);
    galv_stage_next(&stream.stage, 1);
    if (!status)
        status = galv_stage_report(&stream.stage, 1);
    if (!status) {
        model->method = method;
        *out = model;
    } else {
        galv_model_free(model);
    }
    galv_spectrum_free(&spectrum);
    galv_stream_end(&stream);
    return status;
}

galv_status galv_build(const galv_shape *shape, size_t npoints, const double *xyz,
                       galv_sampling sampling, const galv_options *options, galv_model **model)
{
    galv_options defaults;
    galv_options_init(&defaults);
    if (!options)
        options = &defaults;
    THREADS(options->threads);
    if (!shape || !model)
        return galv_fail(GALV_ERROR_ARGUMENT, "shape and result must be given");
    galv_status status = galv_points_check(npoints, xyz);
    if (!status)
        status = galv_options_check(options);
    if (!status)
        status = galv_sampling_check(&sampling, galv_shape_parameters(shape));
    double *weights = NULL;
    if (!status)
        status = galv_weights_spread(npoints, options->weights, options->extra, &weights);
    if (status)
        return status;
    size_t appended = options->extra ? options->extra->count : 0;
    galv_job job = {.points = npoints, .xyz = xyz, .weights = weights, .options = options};
    job.block = galv_block_rows(sampling.count, 3 * npoints + appended, options->workspace);
    galv_shape_source source;
    status =
        galv_shape_source_start(&source, shape, npoints, xyz, sampling, options->extra, job.block);
    if (!status) {
        job.source = &source.head;
        job.shape = &source;
        status = run(&job, model);
        galv_shape_source_end(&source);
    }
    free(weights);
    return status;
}

typedef struct data_source {
    galv_source head;
    const galv_data *data;
} data_source;

static galv_status data_rows(galv_source *head, size_t first, size_t count, double *rows)
{
    const galv_data *data = ((data_source *)head)->data;
    int refused = data->rows(data->user_data, first, count, rows);
    if (refused)
        return galv_fail(GALV_ERROR_NUMERIC, "samples %zu to %zu: the data function returned %d",
                         first, first + count - 1, refused);
    return GALV_OK;
}

/* Whether the rows can be displacements of the points. */
static galv_status check_points_of(const galv_data *data)
{
    galv_status status = galv_points_check(data->npoints, data->xyz);
    if (!status && (data->coordinates % 3 || data->coordinates / 3 != data->npoints))
        status =
            galv_fail(GALV_ERROR_ARGUMENT, "%zu coordinates, expected 3 for each of %zu points",
                      data->coordinates, data->npoints);
    return status;
}

galv_status galv_build_data(const galv_data *data, const galv_options *options, galv_model **model)
{
    galv_options defaults;
    galv_options_init(&defaults);
    if (!options)
        options = &defaults;
    THREADS(options->threads);
    if (!data || (!data->rows && !data->values) || !model || data->count == 0 ||
        data->coordinates == 0)
        return galv_fail(GALV_ERROR_ARGUMENT, "data of at least one sample must be given");
    galv_status status = galv_options_check(options);
    if (!status && data->weights)
        status = check_weights("coordinate", data->coordinates, data->weights);
    if (!status && (data->npoints || data->xyz))
        status = check_points_of(data);
    double *spread = NULL;
    if (!status && data->npoints && !data->weights)
        status = galv_weights_spread(data->npoints, options->weights, NULL, &spread);
    if (status)
        return status;
    size_t *index = malloc(data->coordinates * sizeof *index);
    if (!index) {
        free(spread);
        return galv_fail(GALV_ERROR_MEMORY, "%zu coordinates", data->coordinates);
    }
    for (size_t i = 0; i < data->coordinates; i++)
        index[i] = i;
    data_source source = {.head = {.samples = data->count,
                                   .coordinates = data->coordinates,
                                   .stored = data->coordinates,
                                   .index = index,
                                   .values = data->values,
                                   .rows = data_rows},
                          .data = data};
    galv_job job = {.source = &source.head,
                    .points = data->npoints,
                    .xyz = data->xyz,
                    .weights = spread ? spread : data->weights,
                    .options = options};
    job.block = galv_block_rows(data->count, data->coordinates, options->workspace);
    status = run(&job, model);
    free(index);
    free(spread);
    return status;
}
