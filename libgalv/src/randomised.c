/* Block Krylov iteration with one pass over the samples per application: for data whose covariance
 * and Gram matrices are both too large. */
#include "eigen.h"
#include "error.h"
#include "products.h"
#include "random.h"
#include "spectrum.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

/* Vectors beyond those wanted speed up the convergence of the last ones (Halko, Martinsson and
 * Tropp, SIAM Review 53, 2011). */
enum { OVERSAMPLING = 8, MOST_PASSES = 24 };
/* A pass, of what is left: nobody knows how many there will be. */
#define SHARE_OF_A_PASS 0.1

/* Residual, relative to the largest eigenvalue; the eigenvalue's own error is of the order of its
 * square. */
static const double stream_tolerance = 1e-7;

typedef struct pass {
    galv_stream *stream;
    const galv_spectrum *spectrum;
    bool centre;
    double *v, *y; /* active x b, padded: the vectors and their images */
    double *t;     /* block x b, padded */
} pass;

static galv_status covariance_apply(void *user_data, size_t b, const double *v, double *y)
{
    pass *p = user_data;
    galv_stream *stream = p->stream;
    size_t samples = stream->source->samples, n = p->spectrum->active;
    galv_stage_share(&stream->stage, SHARE_OF_A_PASS, GALV_STAGE_SOLVED);
    galv_pad(n, b, v, p->v);
    memset(p->y, 0, n * galv_padded(b) * sizeof *p->y);
    for (size_t first = 0; first < samples; first += stream->block) {
        size_t rest = samples - first, count = rest < stream->block ? rest : stream->block;
        galv_status status = galv_stream_read(stream, first, count);
        if (!status && stream->active != n)
            status =
                galv_fail(GALV_ERROR_ARGUMENT,
                          "samples %zu...: other coordinates move than in the first pass", first);
        if (!status) {
            galv_rows_times(count, n, 1 / (double)samples, stream->rows, b, p->v, p->t);
            galv_rows_add_transposed(count, n, stream->rows, b, p->t, p->y);
            status = galv_stream_report(stream, first + count);
        }
        if (status)
            return status;
    }
    galv_unpad(n, b, p->y, y);
    for (size_t c = 0; p->centre && c < b; c++) {
        const double *mean = p->spectrum->mean;
        double dot = cblas_ddot((blasint)n, mean, 1, v + c * n, 1);
        cblas_daxpy((blasint)n, -dot, mean, 1, y + c * n, 1);
    }
    return GALV_OK;
}

/* First pass: the sums, and D^T Omega with Omega Gaussian, N x b, as the start block (active x b).
 * Coordinates are in the stream's order of discovery, so those not yet discovered are zero and
 * last.
 */
static galv_status sketch(galv_stream *stream, size_t b, uint64_t seed, double *start,
                          galv_sums *sums)
{
    size_t samples = stream->source->samples, ld = galv_padded(b);
    galv_stage_share(&stream->stage, SHARE_OF_A_PASS, GALV_STAGE_SOLVED);
    double *omega = calloc(stream->block * ld, sizeof *omega);
    double *image = calloc(stream->source->stored * ld, sizeof *image);
    galv_status status =
        omega && image ? GALV_OK : galv_fail(GALV_ERROR_MEMORY, "random start block");
    for (size_t first = 0; first < samples && !status; first += stream->block) {
        size_t rest = samples - first, count = rest < stream->block ? rest : stream->block;
        status = galv_stream_read(stream, first, count);
        if (status)
            break;
        galv_sums_add(sums, stream, count);
        for (size_t r = 0; r < count; r++) {
            galv_random random;
            galv_random_start(&random, seed, first + r);
            for (size_t c = 0; c < b; c++)
                omega[r * ld + c] = galv_random_normal(&random);
        }
        galv_rows_add_transposed(count, stream->active, stream->rows, b, omega, image);
        status = galv_stream_report(stream, first + count);
    }
    if (!status)
        galv_unpad(stream->active, b, image, start);
    free(omega);
    free(image);
    return status;
}

static galv_status iterate(galv_stream *stream, const galv_goal *goal, size_t nev, size_t b,
                           const double *start, galv_spectrum *spectrum)
{
    pass p = {.stream = stream, .spectrum = spectrum, .centre = goal->centre};
    galv_operator op = {.n = spectrum->active, .apply = covariance_apply, .user_data = &p};
    galv_krylov run = {.nev = nev,
                       .block = b,
                       .basis = nev + 4 * b,
                       .most = MOST_PASSES,
                       .tolerance = stream_tolerance,
                       .variance = goal->modes ? 0 : goal->variance,
                       .trace = spectrum->trace,
                       .seed = goal->seed};
    size_t ld = galv_padded(b);
    p.v = malloc(spectrum->active * ld * sizeof *p.v);
    p.y = malloc(spectrum->active * ld * sizeof *p.y);
    p.t = malloc(stream->block * ld * sizeof *p.t);
    spectrum->values = malloc(nev * sizeof *spectrum->values);
    spectrum->residuals = malloc(nev * sizeof *spectrum->residuals);
    spectrum->vectors = malloc(spectrum->active * nev * sizeof *spectrum->vectors);
    galv_status status = GALV_OK;
    if (!p.v || !p.y || !p.t || !spectrum->values || !spectrum->residuals || !spectrum->vectors)
        status = galv_fail(GALV_ERROR_MEMORY, "%zu eigenvectors of %zu coordinates", nev,
                           spectrum->active);
    if (!status)
        status = galv_eigen_krylov(&op, &run, start, spectrum->values, spectrum->vectors,
                                   spectrum->residuals);
    free(p.v);
    free(p.y);
    free(p.t);
    if (status)
        return status;
    spectrum->passes += run.applications;
    spectrum->known = run.found;
    double floor = (double)spectrum->active * 0x1p-52 * spectrum->values[0];
    while (spectrum->known && spectrum->values[spectrum->known - 1] <= floor)
        spectrum->known--;
    return GALV_OK;
}

static void free_pairs(galv_spectrum *spectrum)
{
    free(spectrum->values);
    free(spectrum->vectors);
    free(spectrum->residuals);
    spectrum->values = spectrum->vectors = spectrum->residuals = NULL;
}

galv_status galv_spectrum_randomised(galv_stream *stream, const galv_goal *goal,
                                     galv_spectrum *spectrum)
{
    size_t stored = stream->source->stored, samples = stream->source->samples;
    size_t most = samples < stored ? samples : stored;
    size_t nev = goal->modes > goal->spectrum ? goal->modes : goal->spectrum;
    nev = nev < most ? nev : most;
    size_t b = nev + OVERSAMPLING < most ? nev + OVERSAMPLING : most;
    galv_sums sums;
    double *start = malloc(stored * b * sizeof *start);
    *spectrum = (galv_spectrum){.passes = 1};
    galv_status status = galv_sums_start(&sums, stored);
    if (!status && !start)
        status = galv_fail(GALV_ERROR_MEMORY, "a block of %zu vectors", b);
    if (!status)
        status = sketch(stream, b, goal->seed, start, &sums);
    if (!status)
        status = galv_sums_finish(&sums, stream, goal->centre, spectrum);
    if (!status) {
        nev = nev < spectrum->active ? nev : spectrum->active;
        b = b < spectrum->active ? b : spectrum->active;
        status = iterate(stream, goal, nev, b, start, spectrum);
    }
    /* More pairs when these do not reach the variance and there may be more. */
    while (!status && spectrum->known == nev && nev < spectrum->active && nev < samples &&
           !galv_goal_modes(goal, nev, spectrum->values, spectrum->trace)) {
        free_pairs(spectrum);
        nev = 2 * nev < spectrum->active ? 2 * nev : spectrum->active;
        b = nev + OVERSAMPLING < spectrum->active ? nev + OVERSAMPLING : spectrum->active;
        status = iterate(stream, goal, nev, b, NULL, spectrum);
    }
    free(start);
    free(sums.sum);
    if (status)
        galv_spectrum_free(spectrum);
    return status;
}
