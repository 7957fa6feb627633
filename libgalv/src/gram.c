/* The Gram side, for fewer samples than coordinates: inner products of all pairs of samples have
 * the eigenvalues of the covariance, and D^T v / sqrt(N lambda) are its eigenvectors. */
#include "error.h"
#include "spectrum.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Products of the kept rows (width coordinates each) with the rows in the stream. Coordinates
 * discovered since the kept rows were read are zero in them. */
static void multiply(const galv_stream *stream, const double *kept, size_t width, size_t i,
                     size_t nkept, size_t j, size_t count, double *gram)
{
    size_t samples = stream->source->samples;
    if (width)
        cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, (blasint)count, (blasint)nkept,
                    (blasint)width, 1 / (double)samples, stream->rows, (blasint)stream->active,
                    kept, (blasint)width, 0, gram + i * samples + j, (blasint)samples);
}

static galv_status fill(galv_stream *stream, double *gram, galv_sums *sums)
{
    size_t samples = stream->source->samples, block = stream->block;
    size_t blocks = (samples + block - 1) / block, pairs = blocks * (blocks + 1) / 2, done = 0;
    double *kept = malloc(block * stream->source->stored * sizeof *kept);
    galv_status status =
        kept ? GALV_OK : galv_fail(GALV_ERROR_MEMORY, "a second block of %zu samples", block);
    for (size_t i = 0; i < samples && !status; i += block) {
        size_t nkept = samples - i < block ? samples - i : block, width = 0;
        for (size_t j = i; j < samples && !status; j += block) {
            size_t count = samples - j < block ? samples - j : block;
            status = galv_stream_read(stream, j, count);
            if (status)
                break;
            if (i == 0)
                galv_sums_add(sums, stream, count);
            if (j == i) {
                width = stream->active;
                memcpy(kept, stream->rows, count * width * sizeof *kept);
            }
            multiply(stream, kept, width, i, nkept, j, count, gram);
            status = galv_stage_report(&stream->stage, (double)++done / (double)pairs);
        }
    }
    free(kept);
    return status;
}

/* H G H with H = I - 1 1^T / N, lower triangle. */
static galv_status centre_gram(size_t n, double *gram)
{
    double *mean = calloc(n, sizeof *mean), all = 0;
    if (!mean)
        return galv_fail(GALV_ERROR_MEMORY, "means of %zu samples", n);
    for (size_t j = 0; j < n; j++)
        for (size_t i = j; i < n; i++) {
            mean[i] += gram[j * n + i];
            if (i != j)
                mean[j] += gram[j * n + i];
        }
    for (size_t i = 0; i < n; i++)
        all += mean[i] /= (double)n;
    all /= (double)n;
    for (size_t j = 0; j < n; j++)
        for (size_t i = j; i < n; i++)
            gram[j * n + i] += all - mean[i] - mean[j];
    free(mean);
    return GALV_OK;
}

/* Columns in order of falling eigenvalue: the QR factor cleans each of what rounding left of the
 * larger ones. */
static galv_status orthonormalise(size_t n, size_t known, double *w)
{
    double *tau = malloc(known * sizeof *tau);
    if (!tau)
        return galv_fail(GALV_ERROR_MEMORY, "orthonormal eigenvectors");
    lapack_int info =
        LAPACKE_dgeqrf(LAPACK_COL_MAJOR, (lapack_int)n, (lapack_int)known, w, (lapack_int)n, tau);
    if (!info)
        info = LAPACKE_dorgqr(LAPACK_COL_MAJOR, (lapack_int)n, (lapack_int)known, (lapack_int)known,
                              w, (lapack_int)n, tau);
    free(tau);
    return galv_lapack(info, "QR factorisation of the eigenvectors");
}

static galv_status back_to_coordinates(galv_stream *stream, const double *v,
                                       galv_spectrum *spectrum)
{
    size_t samples = stream->source->samples, known = spectrum->known;
    size_t active = spectrum->active;
    spectrum->vectors = calloc(active * known, sizeof *spectrum->vectors);
    if (!spectrum->vectors)
        return galv_fail(GALV_ERROR_MEMORY, "%zu eigenvectors of %zu coordinates", known, active);
    galv_stage_next(&stream->stage, GALV_STAGE_BACK);
    for (size_t first = 0; first < samples; first += stream->block) {
        size_t rest = samples - first, count = rest < stream->block ? rest : stream->block;
        galv_status status = galv_stream_read(stream, first, count);
        if (status)
            return status;
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, (blasint)active, (blasint)known,
                    (blasint)count, 1, stream->rows, (blasint)active, v + first, (blasint)samples,
                    1, spectrum->vectors, (blasint)active);
        status = galv_stream_report(stream, first + count);
        if (status)
            return status;
    }
    for (size_t k = 0; k < known; k++)
        cblas_dscal((blasint)active, 1 / sqrt((double)samples * spectrum->values[k]),
                    spectrum->vectors + k * active, 1);
    return orthonormalise(active, known, spectrum->vectors);
}

galv_status galv_spectrum_gram(galv_stream *stream, const galv_goal *goal, galv_spectrum *spectrum)
{
    size_t samples = stream->source->samples;
    galv_sums sums;
    double *gram = malloc(samples * samples * sizeof *gram), *v = NULL;
    *spectrum = (galv_spectrum){.passes = 2 + (samples - 1) / (2 * stream->block)};
    galv_status status = galv_sums_start(&sums, stream->source->stored);
    if (!status && !gram)
        status = galv_fail(GALV_ERROR_MEMORY, "inner products of %zu samples", samples);
    if (!status)
        status = fill(stream, gram, &sums);
    if (!status)
        status = galv_sums_finish(&sums, stream, goal->centre, spectrum);
    if (!status && goal->centre)
        status = centre_gram(samples, gram);
    if (!status)
        status = galv_spectrum_matrix(samples, gram, spectrum->trace, goal, &spectrum->known,
                                      &spectrum->values, &v, &spectrum->residuals, &stream->stage);
    free(gram);
    free(sums.sum);
    if (!status) {
        /* The rank cannot exceed the coordinates, whatever rounding says. */
        if (spectrum->known > spectrum->active)
            spectrum->known = spectrum->active;
        status = back_to_coordinates(stream, v, spectrum);
    }
    free(v);
    if (status)
        galv_spectrum_free(spectrum);
    return status;
}
