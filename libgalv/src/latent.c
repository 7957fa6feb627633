#include "latent.h"

#include "eigen.h"
#include "error.h"
#include "products.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Samples are dealt to the groups in turn, so that a sorted list of samples is no worse than a
 * shuffled one. */
enum { GROUPS = 10, ALL_GROUPS = (1 << GROUPS) - 1 };
/* Of tenfold cross-validation, of four splits in half, and of every other sample. */
enum { GROUP_SOLUTIONS = GROUPS + 4 + 1 };
enum { COLUMNS = 512 }; /* of a product at once */

typedef struct latent_pass {
    const galv_spectrum *spectrum;
    size_t pairs;
    double *offset; /* pairs: projection of the mean, subtracted when centring */
    double *w;      /* the leading eigenvectors, active x pairs, padded */
    double *v;      /* block x pairs, padded: projections on them */
    double *sorted; /* pairs x block: the same, group after group */
    double *moment; /* GROUPS matrices pairs x pairs, lower triangles of sums of v v^T */
    double energy[GROUPS];
    size_t count[GROUPS];
    double mean_square; /* |mean|^2 */
    double appended;    /* energy of the appended quantities */
    size_t nappended, *places;
    double *x; /* parameters of a sample */
    double *sum_x, *sum_u, *sum_xu, *sum_uu;
} latent_pass;

static void latent_free(latent_pass *pass)
{
    free(pass->offset);
    free(pass->w);
    free(pass->v);
    free(pass->sorted);
    free(pass->moment);
    free(pass->places);
    free(pass->x);
    free(pass->sum_x);
    free(pass->sum_u);
    free(pass->sum_xu);
    free(pass->sum_uu);
}

static galv_status latent_start(latent_pass *pass, const galv_stream *stream,
                                const galv_spectrum *spectrum, const galv_model *model)
{
    size_t n = model->parameters, m = model->modes, pairs = model->kept, ld = galv_padded(pairs);
    *pass = (latent_pass){.spectrum = spectrum, .pairs = pairs};
    pass->offset = calloc(pairs, sizeof(double));
    pass->w = malloc(ld * spectrum->active * sizeof(double));
    pass->v = malloc(ld * stream->block * sizeof(double));
    pass->sorted = malloc(pairs * stream->block * sizeof(double));
    pass->moment = calloc(GROUPS * pairs * pairs, sizeof(double));
    pass->x = calloc(n + 1, sizeof(double));
    pass->sum_x = calloc(n + 1, sizeof(double));
    pass->sum_u = calloc(m, sizeof(double));
    pass->sum_xu = calloc(n * m + 1, sizeof(double));
    pass->sum_uu = calloc(m * m, sizeof(double));
    if (!pass->offset || !pass->w || !pass->v || !pass->sorted || !pass->moment || !pass->x ||
        !pass->sum_x || !pass->sum_u || !pass->sum_xu || !pass->sum_uu) {
        latent_free(pass);
        return galv_fail(GALV_ERROR_MEMORY, "projection of a block on %zu eigenvectors", pairs);
    }
    galv_status status =
        galv_latent_appended(stream, model->points, &pass->places, &pass->nappended);
    if (status) {
        latent_free(pass);
        return status;
    }
    galv_pad(spectrum->active, pairs, spectrum->vectors, pass->w);
    if (model->centred) {
        blasint active = (blasint)spectrum->active;
        cblas_dgemv(CblasColMajor, CblasTrans, active, (blasint)pairs, 1, spectrum->vectors, active,
                    spectrum->mean, 1, 0, pass->offset, 1);
        pass->mean_square = cblas_ddot(active, spectrum->mean, 1, spectrum->mean, 1);
    }
    return GALV_OK;
}

/* Sums of v v^T and of squared norms, group by group. */
static void add_moments(latent_pass *pass, const galv_stream *stream, const galv_model *model,
                        size_t first, size_t count)
{
    size_t pairs = pass->pairs, ld = galv_padded(pairs), active = pass->spectrum->active;
    for (size_t g = 0; g < GROUPS; g++) {
        size_t members = 0;
        for (size_t r = (g + GROUPS - first % GROUPS) % GROUPS; r < count; r += GROUPS) {
            memcpy(pass->sorted + members++ * pairs, pass->v + r * ld,
                   pairs * sizeof *pass->sorted);
            pass->energy[g] += stream->energy[r];
            if (model->centred)
                pass->energy[g] +=
                    pass->mean_square - 2 * cblas_ddot((blasint)active, pass->spectrum->mean, 1,
                                                       stream->rows + r * active, 1);
        }
        pass->count[g] += members;
        if (members)
            cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, (blasint)pairs, (blasint)members,
                        1, pass->sorted, (blasint)pairs, 1, pass->moment + g * pairs * pairs,
                        (blasint)pairs);
    }
}

static void add_appended(latent_pass *pass, const galv_stream *stream, const galv_model *model,
                         size_t count)
{
    for (size_t r = 0; r < count; r++)
        for (size_t i = 0; i < pass->nappended; i++) {
            size_t a = pass->places[i];
            double value = stream->rows[r * stream->active + a];
            value -= model->centred ? pass->spectrum->mean[a] : 0;
            pass->appended += value * value;
        }
}

static void add_sample(latent_pass *pass, galv_model *model, const galv_shape_source *parameters,
                       size_t r, const double *u)
{
    size_t n = model->parameters, m = model->modes;
    memcpy(model->latent + r * m, u, m * sizeof *u);
    if (!parameters)
        return;
    galv_shape_source_parameters(parameters, r, pass->x);
    cblas_daxpy((blasint)n, 1, pass->x, 1, pass->sum_x, 1);
    cblas_daxpy((blasint)m, 1, u, 1, pass->sum_u, 1);
    cblas_dger(CblasColMajor, (blasint)n, (blasint)m, 1, pass->x, 1, u, 1, pass->sum_xu,
               (blasint)n);
    cblas_dsyr(CblasColMajor, CblasLower, (blasint)m, 1, u, 1, pass->sum_uu, (blasint)m);
}

static galv_status project_samples(latent_pass *pass, galv_stream *stream,
                                   const galv_shape_source *parameters, galv_model *model)
{
    size_t samples = model->samples, pairs = pass->pairs, active = pass->spectrum->active;
    for (size_t first = 0; first < samples; first += stream->block) {
        size_t rest = samples - first, count = rest < stream->block ? rest : stream->block;
        galv_status status = galv_stream_read(stream, first, count);
        if (!status && stream->active != active)
            status =
                galv_fail(GALV_ERROR_ARGUMENT,
                          "samples %zu...: other coordinates move than in the first pass", first);
        if (status)
            return status;
        galv_rows_times(count, active, 1, stream->rows, pairs, pass->w, pass->v);
        for (size_t r = 0; r < count; r++) {
            double *v = pass->v + r * galv_padded(pairs);
            for (size_t k = 0; k < pairs; k++)
                v[k] -= pass->offset[k];
            add_sample(pass, model, parameters, first + r, v);
        }
        add_moments(pass, stream, model, first, count);
        add_appended(pass, stream, model, count);
        status = galv_stream_report(stream, first + count);
        if (status)
            return status;
    }
    return GALV_OK;
}

/* x ~ mean x + Cov(x, u) Cov(u, u)^-1 (u - mean u): the embedded linear map from latent points to
 * parameters that starts the search of galv_backmap(). */
static galv_status regress(latent_pass *pass, galv_model *model)
{
    size_t n = model->parameters, m = model->modes;
    double samples = (double)model->samples, *cuu = pass->sum_uu, *cxu = pass->sum_xu, trace = 0;
    for (size_t k = 0; k < m; k++)
        for (size_t l = k; l < m; l++)
            cuu[k * m + l] =
                cuu[k * m + l] / samples - pass->sum_u[k] / samples * (pass->sum_u[l] / samples);
    for (size_t k = 0; k < m; k++)
        trace += cuu[k * m + k];
    /* A latent coordinate that does not vary gets the coefficient 0 instead of a division by 0. */
    for (size_t k = 0; k < m; k++)
        cuu[k * m + k] += 1e-12 * trace + 1e-300;
    for (size_t k = 0; k < m; k++)
        for (size_t i = 0; i < n; i++)
            cxu[k * n + i] =
                cxu[k * n + i] / samples - pass->sum_x[i] / samples * (pass->sum_u[k] / samples);
    lapack_int info = LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', (lapack_int)m, cuu, (lapack_int)m);
    galv_status status = galv_lapack(info, "covariance of the latent coordinates");
    if (status)
        return status;
    /* B = Cxu Cuu^-1 by two triangular solves from the right. */
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, (blasint)n,
                (blasint)m, 1, cuu, (blasint)m, cxu, (blasint)n);
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, (blasint)n,
                (blasint)m, 1, cuu, (blasint)m, cxu, (blasint)n);
    for (size_t i = 0; i < n; i++) {
        double *row = model->regression + i * (1 + m);
        row[0] = pass->sum_x[i] / samples;
        for (size_t k = 0; k < m; k++) {
            row[1 + k] = cxu[k * n + i];
            row[0] -= row[1 + k] * pass->sum_u[k] / samples;
        }
    }
    return GALV_OK;
}

/* Room for the eigenproblem of some of the groups. */
typedef struct group_work {
    double *matrix, *vectors, *other, *values; /* pairs x pairs each, and 2 pairs */
    galv_stage *stage;
    int solved; /* of GROUP_SOLUTIONS */
} group_work;

/* Sums the groups in `mask`: a lower triangle. Returns their energy. */
static double add_groups(const latent_pass *pass, unsigned mask, double *matrix)
{
    size_t size = pass->pairs * pass->pairs;
    double energy = 0;
    memset(matrix, 0, size * sizeof *matrix);
    for (size_t g = 0; g < GROUPS; g++)
        if (mask >> g & 1) {
            cblas_daxpy((blasint)size, 1, pass->moment + g * size, 1, matrix, 1);
            energy += pass->energy[g];
        }
    return energy;
}

/* The solutions left share what is left of the work; the last tenth of each is for the products. */
static galv_status group_eigen(const latent_pass *pass, unsigned mask, group_work *w)
{
    add_groups(pass, mask, w->matrix);
    galv_stage_share(w->stage, 0.9 / (GROUP_SOLUTIONS - w->solved++), 1);
    galv_status status = galv_eigen_dense(pass->pairs, w->matrix, w->values, w->vectors, w->stage);
    return status ? status : galv_stage_report(w->stage, 1);
}

/* Energy of the groups outside `mask`, and what of it the leading m modes of the groups inside
 * hold: samples that had no part in finding the modes. */
typedef struct held_out {
    double kept, energy;
} held_out;

static galv_status hold_out(const latent_pass *pass, unsigned mask, size_t m, group_work *w,
                            held_out *result)
{
    blasint pairs = (blasint)pass->pairs;
    size_t samples = 0;
    for (size_t g = 0; g < GROUPS; g++)
        samples += mask >> g & 1 ? pass->count[g] : 0;
    m = m < samples ? m : samples;
    galv_status status = group_eigen(pass, mask, w);
    if (status)
        return status;
    result->energy = add_groups(pass, ALL_GROUPS & ~mask, w->matrix);
    for (size_t c = 0; c < m && !status; c += COLUMNS) {
        size_t count = m - c < COLUMNS ? m - c : COLUMNS, at = c * pass->pairs;
        cblas_dsymm(CblasColMajor, CblasLeft, CblasLower, pairs, (blasint)count, 1, w->matrix,
                    pairs, w->vectors + at, pairs, 0, w->other + at, pairs);
        status = galv_stage_report(w->stage, 1); /* to hear of a cancellation */
    }
    if (status)
        return status;
    result->kept = cblas_ddot((blasint)(pass->pairs * m), w->vectors, 1, w->other, 1);
    return GALV_OK;
}

/* Sine of the greatest angle between the first m columns of the orthogonal matrix y and the first m
 * unit vectors: the norm of the block below. */
static galv_status greatest_angle(size_t pairs, size_t m, const double *y, double *work,
                                  double *angle)
{
    size_t below = pairs - m;
    double *block = work, *values = work + below * m;
    *angle = 0;
    if (below == 0)
        return GALV_OK;
    for (size_t c = 0; c < m; c++)
        memcpy(block + c * below, y + c * pairs + m, below * sizeof *block);
    lapack_int info = LAPACKE_dgesdd(LAPACK_COL_MAJOR, 'N', (lapack_int)below, (lapack_int)m, block,
                                     (lapack_int)below, values, NULL, 1, NULL, 1);
    if (!info)
        *angle = asin(fmin(values[0], 1));
    return galv_lapack(info, "angle between subspaces");
}

/* What the modes will retain of fresh samples. Tenfold cross-validation tells it for modes found
 * from nine tenths of the samples, splits in half for modes from half of them; what is lacking
 * falls like 1/N, so the two lead to N. The error joins the spread between the groups with a
 * quarter of the difference of the two, which is what the extrapolation can be wrong by; tests hold
 * it to fresh samples. */
static galv_status estimate_fresh(const latent_pass *pass, size_t m, group_work *w,
                                  galv_confidence *result)
{
    static const unsigned halves[] = {0x155, 0x2aa, 0x01f, 0x3e0};
    held_out group[GROUPS], tenth = {0, 0}, half = {0, 0};
    double square = 0;
    for (unsigned g = 0; g < GROUPS; g++) {
        galv_status status = hold_out(pass, ALL_GROUPS & ~(1u << g), m, w, &group[g]);
        if (status)
            return status;
        tenth.kept += group[g].kept;
        tenth.energy += group[g].energy;
    }
    for (size_t k = 0; k < sizeof halves / sizeof *halves; k++) {
        held_out other;
        galv_status status = hold_out(pass, halves[k], m, w, &other);
        if (status)
            return status;
        half.kept += other.kept;
        half.energy += other.energy;
    }
    if (!(tenth.energy > 0 && half.energy > 0))
        return GALV_OK;
    double share = tenth.kept / tenth.energy, fewer = half.kept / half.energy;
    for (unsigned g = 0; g < GROUPS; g++) {
        double deviation = (group[g].kept - share * group[g].energy) / (tenth.energy / GROUPS);
        square += deviation * deviation;
    }
    /* share = R - c / 0.9 and fewer = R - c / 0.5 lead to R - c. */
    result->retained_fresh = fmax(fmin(share + (share - fewer) / 8, 1), 0);
    result->retained_error = hypot(sqrt(square / (GROUPS * (GROUPS - 1))), (share - fewer) / 4);
    return GALV_OK;
}

/* The angle is that from the modes of every other sample to those of all. All within the span of
 * the pairs known. */
static galv_status estimate_confidence(const latent_pass *pass, galv_stage *stage,
                                       galv_model *model)
{
    size_t pairs = pass->pairs, square = pairs * pairs;
    galv_confidence *result = &model->confidence;
    *result = (galv_confidence){NAN, NAN, NAN, {0}};
    if (model->samples < 2 * GROUPS)
        return GALV_OK;
    double *room = malloc((3 * square + 2 * pairs) * sizeof *room);
    if (!room)
        return galv_fail(GALV_ERROR_MEMORY, "confidence of %zu pairs", pairs);
    group_work w = {room, room + square, room + 2 * square, room + 3 * square, stage, 0};
    galv_status status = estimate_fresh(pass, model->modes, &w, result);
    if (!status)
        status = group_eigen(pass, 0x155, &w);
    if (!status)
        status = greatest_angle(pairs, model->modes, w.vectors, w.other, &result->angle);
    free(room);
    return status;
}

void galv_latent_box(galv_model *model)
{
    size_t m = model->modes;
    for (size_t k = 0; k < m; k++) {
        model->lower[k] = INFINITY;
        model->upper[k] = -INFINITY;
    }
    for (size_t r = 0; r < model->samples; r++)
        for (size_t k = 0; k < m; k++) {
            model->lower[k] = fmin(model->lower[k], model->latent[r * m + k]);
            model->upper[k] = fmax(model->upper[k], model->latent[r * m + k]);
        }
}

galv_status galv_latent_appended(const galv_stream *stream, size_t points, size_t **places,
                                 size_t *count)
{
    *count = 0;
    *places = malloc((stream->active + 1) * sizeof **places);
    if (!*places)
        return galv_fail(GALV_ERROR_MEMORY, "places of the appended quantities");
    for (size_t a = 0; points && a < stream->active; a++)
        if (stream->source->index[stream->place[a]] >= 3 * points)
            (*places)[(*count)++] = a;
    return GALV_OK;
}

/* Reconstructing by mode k leaves lambda_k |w_k|^2 less of the displacements' variance, w_k the
 * part of the mode that is displacement: sum over modes of C w_k = lambda_k w_k. */
void galv_latent_geometry(const galv_spectrum *spectrum, size_t count, const size_t *places,
                          double trace_appended, galv_model *model)
{
    model->trace_geometry = model->trace - trace_appended;
    model->retained_geometry = model->retained;
    if (count == 0)
        return;
    double sum = 0;
    for (size_t k = 0; k < model->modes; k++) {
        double part = 1;
        for (size_t i = 0; i < count; i++) {
            double component = spectrum->vectors[k * spectrum->active + places[i]];
            part -= component * component;
        }
        sum += model->eigenvalues[k] * part;
    }
    model->retained_geometry = model->trace_geometry > 0 ? fmin(sum / model->trace_geometry, 1) : 0;
}

/* Of what is left, the share of the projection: 2 N L p + N p^2 operations, and the reading of N L
 * numbers at some 50 each, beside the 15 dense decompositions of the confidence at 10 p^3. */
static double projection_share(const latent_pass *pass, size_t samples)
{
    double n = (double)samples, p = (double)pass->pairs, l = (double)pass->spectrum->active;
    double project = n * l * (2 * p + 50) + n * p * p;
    double confidence = samples < 2 * GROUPS ? 0 : GROUP_SOLUTIONS * 10 * p * p * p;
    return project / (project + confidence);
}

galv_status galv_latent_pass(galv_stream *stream, const galv_spectrum *spectrum,
                             const galv_shape_source *parameters, galv_model *model)
{
    latent_pass pass;
    galv_status status = latent_start(&pass, stream, spectrum, model);
    if (status)
        return status;
    galv_stage_share(&stream->stage, projection_share(&pass, model->samples), 1);
    status = project_samples(&pass, stream, parameters, model);
    if (!status) {
        galv_latent_box(model);
        galv_latent_geometry(spectrum, pass.nappended, pass.places,
                             pass.appended / (double)model->samples, model);
    }
    if (!status && parameters)
        status = regress(&pass, model);
    if (!status)
        status = estimate_confidence(&pass, &stream->stage, model);
    latent_free(&pass);
    return status;
}
