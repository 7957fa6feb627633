/* Linear shapes: D = X B with B the n functions on the points, so that C = B^T A B with A = X^T X /
 * N. With B^T = Q R the non-zero eigenvalues are those of the n x n matrix R A R^T and the modes Q
 * times its eigenvectors. */
#include "error.h"
#include "shape.h"
#include "spectrum.h"

#include <cblas.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

enum { PARAMETER_BLOCK = 256 };

/* Mean of x and the lower triangle of A, about the mean when centring. Two passes: A is then
 * accurate for any ratio of mean to spread. */
static galv_status parameter_moments(const galv_shape_source *source, bool centre, double *mean,
                                     double *a, galv_stage *stage)
{
    size_t n = galv_shape_parameters(source->shape), samples = source->head.samples;
    double *x = malloc(PARAMETER_BLOCK * n * sizeof *x);
    if (!x)
        return galv_fail(GALV_ERROR_MEMORY, "a block of parameters");
    galv_status status = GALV_OK;
    for (size_t r = 0; r < samples && !status; r++) {
        galv_shape_source_parameters(source, r, x);
        cblas_daxpy((blasint)n, 1 / (double)samples, x, 1, mean, 1);
        if (r % PARAMETER_BLOCK == 0)
            status = galv_stage_report(stage, 0.5 * (double)r / (double)samples);
    }
    for (size_t first = 0; first < samples && !status; first += PARAMETER_BLOCK) {
        size_t rest = samples - first, count = rest < PARAMETER_BLOCK ? rest : PARAMETER_BLOCK;
        for (size_t r = 0; r < count; r++) {
            galv_shape_source_parameters(source, first + r, x + r * n);
            if (centre)
                cblas_daxpy((blasint)n, -1, mean, 1, x + r * n, 1);
        }
        cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, (blasint)n, (blasint)count,
                    1 / (double)samples, x, (blasint)n, 1, a, (blasint)n);
        status = galv_stage_report(stage, 0.5 + 0.5 * (double)(first + count) / (double)samples);
    }
    free(x);
    return status;
}

/* R A R^T from the upper triangle in qr (active x n); b: n x n, full, on return. */
static void congruence(size_t n, size_t active, const double *qr, const double *a, double *b)
{
    for (size_t c = 0; c < n; c++)
        for (size_t i = 0; i < n; i++)
            b[c * n + i] = i >= c ? a[c * n + i] : a[i * n + c];
    cblas_dtrmm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, (blasint)n,
                (blasint)n, 1, qr, (blasint)active, b, (blasint)n);
    cblas_dtrmm(CblasColMajor, CblasRight, CblasUpper, CblasTrans, CblasNonUnit, (blasint)n,
                (blasint)n, 1, qr, (blasint)active, b, (blasint)n);
}

/* qr becomes Q. */
static galv_status factor(size_t active, size_t n, const double *a, double *qr, double *b)
{
    double *tau = malloc(n * sizeof *tau);
    if (!tau)
        return galv_fail(GALV_ERROR_MEMORY, "factors of %zu functions", n);
    lapack_int rows = (lapack_int)active, columns = (lapack_int)n;
    lapack_int info = LAPACKE_dgeqrf(LAPACK_COL_MAJOR, rows, columns, qr, rows, tau);
    if (!info) {
        congruence(n, active, qr, a, b);
        info = LAPACKE_dorgqr(LAPACK_COL_MAJOR, rows, columns, columns, qr, rows, tau);
    }
    free(tau);
    return galv_lapack(info, "QR factorisation of the functions");
}

/* Column i of qr: function i on the active coordinates, scaled. */
static void load_functions(const galv_stream *stream, const double *functions, size_t n, double *qr)
{
    size_t stored = stream->source->stored, active = stream->active;
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < active; c++) {
            size_t s = stream->place[c];
            double value = functions[i * stored + s];
            qr[i * active + c] = stream->scale ? value * stream->scale[s] : value;
        }
}

/* Mean of the stream's rows: B^T mean(x) less the shift. */
static void find_mean(const galv_stream *stream, size_t n, const double *qr, const double *x,
                      double *mean)
{
    size_t active = stream->active;
    cblas_dgemv(CblasColMajor, CblasNoTrans, (blasint)active, (blasint)n, 1, qr, (blasint)active, x,
                1, 0, mean, 1);
    for (size_t c = 0; stream->shift && c < active; c++) {
        size_t s = stream->place[c];
        mean[c] -= stream->shift[s] * (stream->scale ? stream->scale[s] : 1);
    }
}

galv_status galv_spectrum_factored(galv_stream *stream, const galv_shape_source *source,
                                   const galv_goal *goal, galv_spectrum *spectrum)
{
    const double *functions = galv_plan_basis(source->plan);
    size_t n = galv_shape_parameters(source->shape), samples = source->head.samples;
    *spectrum = (galv_spectrum){.passes = 0};
    galv_stream_expect(stream, n, functions);
    size_t active = stream->active;
    if (active < n)
        return galv_spectrum_covariance(stream, goal, spectrum);
    /* The first sample is the shift of a centred stream. */
    galv_status status = galv_stream_read(stream, 0, 1);
    spectrum->active = active;
    double *qr = malloc(active * n * sizeof *qr), *a = calloc(n * n, sizeof *a);
    double *b = malloc(n * n * sizeof *b), *x = calloc(n, sizeof *x), *v = NULL;
    spectrum->mean = calloc(active, sizeof *spectrum->mean);
    if (!qr || !a || !b || !x || !spectrum->mean) {
        free(qr);
        free(a);
        free(b);
        free(x);
        galv_spectrum_free(spectrum);
        return galv_fail(GALV_ERROR_MEMORY, "%zu functions on %zu coordinates", n, active);
    }
    if (!status)
        status = parameter_moments(source, goal->centre, x, a, &stream->stage);
    if (!status) {
        load_functions(stream, functions, n, qr);
        find_mean(stream, n, qr, x, spectrum->mean);
        status = factor(active, n, a, qr, b);
    }
    for (size_t i = 0; i < n && !status; i++)
        spectrum->trace += b[i * n + i];
    double square = cblas_ddot((blasint)n, x, 1, x, 1), spread = 0;
    for (size_t i = 0; i < n; i++)
        spread += a[i * n + i];
    /* Equal samples differ from their mean by its rounding. */
    if (!status && (!(spectrum->trace > 0) || spread <= 1e-28 * square))
        status = galv_fail(GALV_ERROR_GEOMETRY, "nothing varies over the %zu samples", samples);
    if (!status)
        status = galv_spectrum_matrix(n, b, spectrum->trace, goal, &spectrum->known,
                                      &spectrum->values, &v, &spectrum->residuals, &stream->stage);
    if (!status) {
        spectrum->vectors = malloc(active * spectrum->known * sizeof *spectrum->vectors);
        if (!spectrum->vectors)
            status = galv_fail(GALV_ERROR_MEMORY, "%zu modes", spectrum->known);
        else
            cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, (blasint)active,
                        (blasint)spectrum->known, (blasint)n, 1, qr, (blasint)active, v, (blasint)n,
                        0, spectrum->vectors, (blasint)active);
    }
    free(qr);
    free(a);
    free(b);
    free(x);
    free(v);
    if (status)
        galv_spectrum_free(spectrum);
    return status;
}
