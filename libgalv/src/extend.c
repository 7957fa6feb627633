/* More samples for a model: its eigenpairs stand for the samples it has seen. */
#include "build.h"
#include "error.h"
#include "latent.h"
#include "shape.h"
#include "threads.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rows of all coordinates whose second moment, over K + 1 + M rows, is that of the N + M samples
 * about the new mean: sqrt(N lambda_k) w_k for the K pairs kept, sqrt(N) (old mean - new mean), and
 * the M new samples less the new mean; all times sqrt((K + 1 + M)/(N + M)). */
typedef struct extension_source {
    galv_source head;
    const galv_model *model;
    galv_shape_source *samples;
    const double *mean; /* the new one */
    double factor;
    double *stored; /* a block of the shape's rows */
} extension_source;

static void scatter(const extension_source *source, size_t count, double *rows)
{
    const galv_source *shape = &source->samples->head;
    size_t length = source->head.stored;
    for (size_t r = 0; r < count; r++) {
        double *row = rows + r * length;
        memset(row, 0, length * sizeof *row);
        for (size_t s = 0; s < shape->stored; s++)
            row[shape->index[s]] = source->stored[r * shape->stored + s];
        for (size_t i = 0; i < length; i++)
            row[i] = source->factor * (row[i] - source->mean[i]);
    }
}

static void summary_row(const extension_source *source, size_t k, double *row)
{
    const galv_model *model = source->model;
    double scale = source->factor * sqrt((double)model->samples);
    if (k < model->kept) {
        scale *= sqrt(model->eigenvalues[k]);
        for (size_t i = 0; i < model->coordinates; i++)
            row[i] = scale * model->vectors[k * model->coordinates + i];
    } else {
        for (size_t i = 0; i < model->coordinates; i++)
            row[i] = scale * (model->mean[i] - source->mean[i]);
    }
}

static galv_status extension_rows(galv_source *head, size_t first, size_t count, double *rows)
{
    extension_source *source = (extension_source *)head;
    size_t summary = source->model->kept + 1, done = 0;
    for (; done < count && first + done < summary; done++)
        summary_row(source, first + done, rows + done * head->stored);
    if (done == count)
        return GALV_OK;
    galv_source *shape = &source->samples->head;
    galv_status status = shape->rows(shape, first + done - summary, count - done, source->stored);
    if (!status)
        scatter(source, count - done, rows + done * head->stored);
    return status;
}

/* Mean of the N + M samples; zeros unless centring. */
static galv_status new_mean(const galv_model *model, galv_shape_source *samples, size_t block,
                            double *stored, double *mean)
{
    galv_source *shape = &samples->head;
    double total = (double)(model->samples + shape->samples);
    if (!model->centred)
        return GALV_OK;
    for (size_t i = 0; i < model->coordinates; i++)
        mean[i] = model->mean[i] * ((double)model->samples / total);
    for (size_t first = 0; first < shape->samples; first += block) {
        size_t rest = shape->samples - first, count = rest < block ? rest : block;
        galv_status status = shape->rows(shape, first, count, stored);
        if (status)
            return status;
        for (size_t r = 0; r < count; r++)
            for (size_t s = 0; s < shape->stored; s++)
                mean[shape->index[s]] += stored[r * shape->stored + s] / total;
    }
    return GALV_OK;
}

/* t (new modes x old modes, column-major) = W_new^T W_old, and offset = W_new^T (old mean - new
 * mean), in the weighted inner product. */
static void transition(const galv_model *old, const galv_model *new, double *t, double *offset)
{
    size_t length = old->coordinates;
    for (size_t k = 0; k < new->modes; k++) {
        const double *w = new->vectors + k *length;
        offset[k] = 0;
        for (size_t i = 0; i < length; i++)
            offset[k] +=
                (old->weights ? old->weights[i] : 1) * w[i] * (old->mean[i] - new->mean[i]);
        for (size_t l = 0; l < old->modes; l++) {
            const double *v = old->vectors + l * length;
            double sum = 0;
            for (size_t i = 0; i < length; i++)
                sum += (old->weights ? old->weights[i] : 1) * w[i] * v[i];
            t[l * new->modes + k] = sum;
        }
    }
}

/* Old samples are carried over from their m coordinates; the regression follows. */
static galv_status carry_over(const galv_model *old, galv_model *new)
{
    size_t m = new->modes, p = old->modes;
    double *t = malloc(m * p * sizeof *t), *offset = malloc(m * sizeof *offset);
    if (!t || !offset) {
        free(t);
        free(offset);
        return galv_fail(GALV_ERROR_MEMORY, "transition of %zu modes", m);
    }
    transition(old, new, t, offset);
    for (size_t r = 0; r < old->samples; r++)
        for (size_t k = 0; k < m; k++) {
            double sum = offset[k];
            for (size_t l = 0; l < p; l++)
                sum += t[l * m + k] * old->latent[r * p + l];
            new->latent[r * m + k] = sum;
        }
    for (size_t i = 0; i < new->parameters; i++) {
        const double *from = old->regression + i * (1 + p);
        double *to = new->regression + i *(1 + m);
        to[0] = from[0];
        for (size_t k = 0; k < m; k++) {
            to[1 + k] = 0;
            for (size_t l = 0; l < p; l++)
                to[1 + k] += from[1 + l] * t[l * m + k];
            to[0] -= to[1 + k] * offset[k];
        }
    }
    free(t);
    free(offset);
    return GALV_OK;
}

/* Second pass over the new samples: their coordinates, and the trace due to appended quantities. */
static galv_status project_new(galv_stream *stream, const galv_spectrum *spectrum,
                               const extension_source *source, galv_model *new)
{
    const galv_model *old = source->model;
    size_t summary = old->kept + 1, m = new->modes, active = spectrum->active;
    size_t appended, *places;
    double square = 0, n = (double)old->samples, total = (double)new->samples;
    galv_status status = galv_latent_appended(stream, new->points, &places, &appended);
    galv_stage_next(&stream->stage, 1);
    for (size_t first = 0; first < source->head.samples && !status; first += stream->block) {
        size_t rest = source->head.samples - first;
        size_t count = rest < stream->block ? rest : stream->block;
        status = galv_stream_read(stream, first, count);
        for (size_t r = 0; r < count && !status; r++) {
            const double *row = stream->rows + r * active;
            for (size_t i = 0; i < appended && first + r >= old->kept; i++)
                square += row[places[i]] * row[places[i]];
            if (first + r < summary)
                continue;
            cblas_dgemv(CblasColMajor, CblasTrans, (blasint)active, (blasint)m, 1 / source->factor,
                        spectrum->vectors, (blasint)active, row, 1, 0,
                        new->latent + (old->samples + first + r - summary) * m, 1);
        }
        if (!status)
            status = galv_stream_report(stream, first + count);
    }
    square /= source->factor * source->factor;
    if (!status)
        galv_latent_geometry(spectrum, appended, places,
                             (n * (old->trace - old->trace_geometry) + square) / total, new);
    free(places);
    return status;
}

/* Greatest angle between the first modes of both, as many as the smaller model has. */
static double subspace_angle(const galv_model *old, const galv_model *new)
{
    size_t length = old->coordinates, m = old->modes < new->modes ? old->modes : new->modes;
    double *cross = malloc(m * m * sizeof *cross), *v = malloc(2 * m * sizeof *v), value = NAN;
    for (size_t k = 0; cross && k < m; k++)
        for (size_t l = 0; l < m; l++) {
            double sum = 0;
            for (size_t i = 0; i < length; i++)
                sum += (old->weights ? old->weights[i] : 1) * new->vectors[k * length + i] *
                       old->vectors[l * length + i];
            cross[l * m + k] = sum;
        }
    /* Power iteration on I - M^T M, whose largest eigenvalue is the square of the sine. */
    for (size_t l = 0; v && l < m; l++)
        v[l] = 1 + 0.1 * (double)(l % 7);
    for (int step = 0; cross && v && step < 200; step++) {
        double *mv = v + m, norm;
        cblas_dgemv(CblasColMajor, CblasNoTrans, (blasint)m, (blasint)m, 1, cross, (blasint)m, v, 1,
                    0, mv, 1);
        cblas_dgemv(CblasColMajor, CblasTrans, (blasint)m, (blasint)m, -1, cross, (blasint)m, mv, 1,
                    1, v, 1);
        norm = cblas_dnrm2((blasint)m, v, 1);
        value = asin(fmin(sqrt(norm), 1));
        if (!(norm > 1e-30))
            break;
        cblas_dscal((blasint)m, 1 / norm, v, 1);
    }
    free(cross);
    free(v);
    return value;
}

/* What the kept pairs miss of the old covariance: its norm is at most the last pair's, and at most
 * what the trace leaves. */
static double old_tail(const galv_model *model, double *lost)
{
    double sum = 0;
    for (size_t k = 0; k < model->kept; k++)
        sum += model->eigenvalues[k];
    *lost = fmax(model->trace - sum, 0);
    return fmin(model->eigenvalues[model->kept - 1], *lost) + model->truncation;
}

static galv_status extend(const galv_model *old, const galv_job *job, extension_source *source,
                          galv_model **out)
{
    galv_goal goal = galv_goal_from(job->options, false);
    galv_method method;
    galv_stream stream;
    galv_spectrum spectrum = {.active = 0};
    galv_model *new = NULL;
    size_t added = source->samples->head.samples;
    double n = (double)old->samples, total = n + (double)added, lost, tail = old_tail(old, &lost);
    galv_status status = galv_method_choose(job, &method);
    if (!status)
        status = galv_stream_start(&stream, job->source, job->block, job->weights, false);
    if (status)
        return status;
    stream.stage.tell = job->options->progress;
    stream.stage.user_data = job->options->progress_user_data;
    status = galv_spectrum_find(&stream, job, method, &goal, &spectrum);
    spectrum.trace += lost * n / total;
    if (!status)
        status = galv_model_assemble(&stream, &spectrum, &goal, job, old->samples + added,
                                     old->parameters, &new);
    if (!status) {
        memcpy(new->mean, source->mean, new->coordinates * sizeof *new->mean);
        new->centred = old->centred;
        new->method = method;
        new->truncation = tail *n / total;
        /* How far the share of fresh samples is below falls like 1/N. */
        new->confidence.retained_fresh =
            new->retained - (old->retained - old->confidence.retained_fresh) * n / total;
        new->confidence.retained_error = old->confidence.retained_error *sqrt(n / total);
        new->confidence.angle = subspace_angle(old, new);
        status = carry_over(old, new);
    }
    if (!status)
        status = project_new(&stream, &spectrum, source, new);
    if (!status) {
        galv_latent_box(new);
        *out = new;
    } else {
        galv_model_free(new);
    }
    galv_spectrum_free(&spectrum);
    galv_stream_end(&stream);
    return status;
}

static galv_status check(const galv_model *model, const galv_shape *shape,
                         const galv_sampling *sampling, const galv_options *options)
{
    size_t appended = options->extra ? options->extra->count : 0;
    if (galv_shape_parameters(shape) != model->parameters)
        return galv_fail(GALV_ERROR_ARGUMENT,
                         "the shape has %zu parameters, the model was built from %zu",
                         galv_shape_parameters(shape), model->parameters);
    if (3 * model->points + appended != model->coordinates)
        return galv_fail(GALV_ERROR_ARGUMENT,
                         "the model has %zu appended quantities, %zu are given",
                         model->coordinates - 3 * model->points, appended);
    galv_status status = galv_options_check(options);
    return status ? status : galv_sampling_check(sampling, model->parameters);
}

galv_status galv_extend(const galv_model *model, const galv_shape *shape, galv_sampling sampling,
                        const galv_options *options, galv_model **extended)
{
    galv_options defaults;
    galv_options_init(&defaults);
    if (!options)
        options = &defaults;
    THREADS(options->threads);
    if (!model || !shape || !extended)
        return galv_fail(GALV_ERROR_ARGUMENT, "model, shape and result must be given");
    if (model->method == GALV_METHOD_PARAMETERS)
        return galv_fail(GALV_ERROR_ARGUMENT, "the modes of this model are the parameters");
    galv_status status = check(model, shape, &sampling, options);
    if (status)
        return status;
    size_t length = model->coordinates, rows = model->kept + 1 + sampling.count;
    size_t block = galv_block_rows(rows, length, options->workspace);
    galv_shape_source samples;
    status = galv_shape_source_start(&samples, shape, model->points, model->parent, sampling,
                                     options->extra, block);
    if (status)
        return status;
    size_t *index = malloc(length * sizeof *index);
    double *mean = calloc(length, sizeof *mean);
    double *stored = malloc(block * samples.head.stored * sizeof *stored);
    if (!index || !mean || !stored)
        status = galv_fail(GALV_ERROR_MEMORY, "a block of %zu samples", block);
    else
        status = new_mean(model, &samples, block, stored, mean);
    for (size_t i = 0; i < length && !status; i++)
        index[i] = i;
    extension_source source = {.head = {.samples = rows,
                                        .coordinates = length,
                                        .stored = length,
                                        .index = index,
                                        .rows = extension_rows},
                               .model = model,
                               .samples = &samples,
                               .mean = mean,
                               .factor =
                                   sqrt((double)rows / (double)(model->samples + sampling.count)),
                               .stored = stored};
    galv_job job = {.source = &source.head,
                    .points = model->points,
                    .xyz = model->parent,
                    .weights = model->weights,
                    .block = block,
                    .options = options};
    if (!status)
        status = extend(model, &job, &source, extended);
    free(index);
    free(mean);
    free(stored);
    galv_shape_source_end(&samples);
    return status;
}
