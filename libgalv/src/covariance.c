/* The covariance side: the active x active matrix of eq. 6, accumulated block by block. */
#include "error.h"
#include "spectrum.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

typedef struct covariance {
    size_t order;
    double *c; /* lower triangle, column-major */
} covariance;

/* Coordinates that start to move later get rows and columns of zeros: so far they were zero. */
static galv_status grow(covariance *matrix, size_t order)
{
    double *c = calloc(order * order, sizeof *c);
    if (!c)
        return galv_fail(GALV_ERROR_MEMORY, "covariance of %zu coordinates", order);
    for (size_t j = 0; j < matrix->order; j++)
        memcpy(c + j * order, matrix->c + j * matrix->order, matrix->order * sizeof *c);
    free(matrix->c);
    matrix->c = c;
    matrix->order = order;
    return GALV_OK;
}

static galv_status accumulate(galv_stream *stream, covariance *matrix, galv_sums *sums)
{
    size_t samples = stream->source->samples;
    for (size_t first = 0; first < samples; first += stream->block) {
        size_t rest = samples - first, count = rest < stream->block ? rest : stream->block;
        galv_status status = galv_stream_read(stream, first, count);
        if (!status && stream->active > matrix->order)
            status = grow(matrix, stream->active);
        if (status)
            return status;
        galv_sums_add(sums, stream, count);
        blasint order = (blasint)matrix->order;
        if (order)
            cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, order, (blasint)count,
                        1 / (double)samples, stream->rows, order, 1, matrix->c, order);
        status = galv_stream_report(stream, first + count);
        if (status)
            return status;
    }
    return GALV_OK;
}

galv_status galv_spectrum_covariance(galv_stream *stream, const galv_goal *goal,
                                     galv_spectrum *spectrum)
{
    covariance matrix = {.order = 0};
    galv_sums sums;
    *spectrum = (galv_spectrum){.passes = 1};
    galv_status status = galv_sums_start(&sums, stream->source->stored);
    if (!status)
        status = accumulate(stream, &matrix, &sums);
    if (!status)
        status = galv_sums_finish(&sums, stream, goal->centre, spectrum);
    if (!status && goal->centre)
        cblas_dsyr(CblasColMajor, CblasLower, (blasint)matrix.order, -1, spectrum->mean, 1,
                   matrix.c, (blasint)matrix.order);
    if (!status)
        status = galv_spectrum_matrix(matrix.order, matrix.c, spectrum->trace, goal,
                                      &spectrum->known, &spectrum->values, &spectrum->vectors,
                                      &spectrum->residuals, &stream->stage);
    free(matrix.c);
    free(sums.sum);
    if (status)
        galv_spectrum_free(spectrum);
    return status;
}
