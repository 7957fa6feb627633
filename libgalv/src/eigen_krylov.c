#include "eigen.h"
#include "error.h"
#include "random.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* The Lanczos basis V (n x size) and its projected matrix T = V^T A V. The last `width` columns of
 * V are the block whose image is next; A V = V T + (next block) B^T on the columns already applied.
 */
typedef struct lanczos {
    const galv_operator *a;
    size_t n, room, block;
    size_t applied;   /* columns of V with known image */
    size_t width;     /* columns after them */
    double *v;        /* n x room */
    double *t;        /* room x room, leading applied x applied used */
    double *w;        /* n x block: image, then the next block */
    double *coupling; /* block x block: w = (next block) coupling */
    double *h;        /* room x block */
    double *ritz, *y; /* room; room x room */
    double scale;     /* largest norm of an image column: |A| from below */
} lanczos;

static void lanczos_free(lanczos *l)
{
    free(l->v);
    free(l->t);
    free(l->w);
    free(l->coupling);
    free(l->h);
    free(l->ritz);
    free(l->y);
}

static galv_status lanczos_allocate(lanczos *l)
{
    l->v = malloc(l->n * l->room * sizeof(double));
    l->t = calloc(l->room * l->room, sizeof(double));
    l->w = malloc(l->n * l->block * sizeof(double));
    l->coupling = malloc(l->block * l->block * sizeof(double));
    l->h = malloc(l->room * l->block * sizeof(double));
    l->ritz = malloc(l->room * sizeof(double));
    l->y = malloc(l->room * l->room * sizeof(double));
    if (!l->v || !l->t || !l->w || !l->coupling || !l->h || !l->ritz || !l->y) {
        lanczos_free(l);
        return galv_fail(GALV_ERROR_MEMORY, "a Krylov basis of %zu vectors of %zu numbers", l->room,
                         l->n);
    }
    return GALV_OK;
}

static void product(CBLAS_TRANSPOSE ta, size_t m, size_t n, size_t k, double alpha, const double *a,
                    size_t lda, const double *b, size_t ldb, double beta, double *c, size_t ldc)
{
    if (m && n)
        cblas_dgemm(CblasColMajor, ta, CblasNoTrans, (blasint)m, (blasint)n, (blasint)k, alpha, a,
                    (blasint)lda, b, (blasint)ldb, beta, c, (blasint)ldc);
}

/* x -= V V^T x for the first `columns` columns of V; the coefficients are added to h when given. */
static void project_out(lanczos *l, size_t columns, size_t width, double *x, double *h)
{
    double *coefficients = l->y; /* free between Rayleigh-Ritz steps */
    product(CblasTrans, columns, width, l->n, 1, l->v, l->n, x, l->n, 0, coefficients, l->room);
    product(CblasNoTrans, l->n, width, columns, -1, l->v, l->n, coefficients, l->room, 1, x, l->n);
    for (size_t c = 0; h && c < width; c++)
        for (size_t i = 0; i < columns; i++)
            h[c * l->room + i] += coefficients[c * l->room + i];
}

/* Pivoted QR of the n x width block x: x becomes Q, *rank columns of it, and r (width x width, ld
 * width) the factor with the columns put back in place, so that the old x = Q r. Columns below
 * `tiny` are dropped. */
static galv_status orthonormalise(const lanczos *l, size_t width, double *x, double *r, double tiny,
                                  size_t *rank)
{
    size_t n = l->n, most = width < n ? width : n;
    lapack_int *pivot = calloc(width, sizeof *pivot);
    double *tau = malloc(most * sizeof *tau);
    lapack_int info = pivot && tau ? LAPACKE_dgeqp3(LAPACK_COL_MAJOR, (lapack_int)n,
                                                    (lapack_int)width, x, (lapack_int)n, pivot, tau)
                                   : LAPACK_WORK_MEMORY_ERROR;
    if (!info) {
        memset(r, 0, width * width * sizeof *r);
        for (size_t c = 0; c < width; c++)
            for (size_t i = 0; i <= c && i < most; i++)
                r[(size_t)(pivot[c] - 1) * width + i] = x[c * n + i];
        for (*rank = 0; *rank < most && fabs(x[*rank * n + *rank]) > tiny; (*rank)++)
            ;
        if (*rank)
            info = LAPACKE_dorgqr(LAPACK_COL_MAJOR, (lapack_int)n, (lapack_int)*rank,
                                  (lapack_int)*rank, x, (lapack_int)n, tau);
    }
    free(pivot);
    free(tau);
    return galv_lapack(info, "orthonormal block of vectors");
}

/* Makes w the next block: orthogonal to V and orthonormal, with w_old = w coupling + V(...).
 * Orthogonalising again after the first QR removes what cancellation left ("twice is enough",
 * Giraud et al. 2005). */
static galv_status next_block(lanczos *l, size_t columns, size_t width, size_t *rank)
{
    double tiny = l->scale * 1e-14 * sqrt((double)l->n);
    double *r2 = malloc(l->block * l->block * sizeof *r2);
    if (!r2)
        return galv_fail(GALV_ERROR_MEMORY, "coupling block");
    size_t first = 0;
    *rank = 0;
    galv_status status = orthonormalise(l, width, l->w, l->coupling, tiny, &first);
    if (!status && first) {
        project_out(l, columns, first, l->w, NULL);
        /* The columns have unit norm: what survives below 1e-8 is noise of the basis. */
        status = orthonormalise(l, first, l->w, r2, 1e-8, rank);
    }
    if (!status && *rank) {
        /* coupling = r2 (first x first) * r1 (rows 0..first-1). */
        for (size_t c = 0; c < width; c++) {
            double *column = l->coupling + c * width, *sum = l->h;
            for (size_t i = 0; i < *rank; i++) {
                sum[i] = 0;
                for (size_t k = 0; k < first; k++)
                    sum[i] += r2[k * first + i] * column[k];
            }
            memcpy(column, sum, *rank * sizeof *column);
        }
    }
    free(r2);
    return status;
}

static void random_block(lanczos *l, uint64_t seed)
{
    galv_random random;
    for (size_t c = 0; c < l->block; c++) {
        galv_random_start(&random, seed, c);
        for (size_t i = 0; i < l->n; i++)
            l->w[c * l->n + i] = galv_random_normal(&random);
    }
}

/* One application: extends T by the pending block and makes the following one pending. */
static galv_status lanczos_step(lanczos *l, size_t *coupled)
{
    size_t n = l->n, width = l->width, columns = l->applied + width;
    double *block = l->v + l->applied * n;
    galv_status status = l->a->apply(l->a->user_data, width, block, l->w);
    if (status)
        return status;
    for (size_t c = 0; c < width; c++) {
        double norm = cblas_dnrm2((blasint)n, l->w + c * n, 1);
        if (!isfinite(norm))
            return galv_fail(GALV_ERROR_NUMERIC,
                             "the covariance times a unit vector is not finite");
        l->scale = fmax(l->scale, norm);
    }
    memset(l->h, 0, l->room * l->block * sizeof *l->h);
    project_out(l, columns, width, l->w, l->h);
    project_out(l, columns, width, l->w, l->h);
    for (size_t c = 0; c < width; c++)
        for (size_t i = 0; i < columns; i++) {
            double value = l->h[c * l->room + i];
            size_t j = l->applied + c;
            /* The diagonal block is symmetric up to rounding: average it. */
            if (i >= l->applied)
                value = 0.5 * (value + l->h[(i - l->applied) * l->room + j]);
            l->t[j * l->room + i] = l->t[i * l->room + j] = value;
        }
    l->applied = columns;
    l->width = 0;
    size_t rank;
    status = next_block(l, columns, width, &rank);
    l->width = status ? 0 : rank;
    *coupled = width;
    return status;
}

static galv_status rayleigh_ritz(lanczos *l)
{
    size_t size = l->applied;
    for (size_t c = 0; c < size; c++)
        memcpy(l->y + c * size, l->t + c * l->room, size * sizeof *l->y);
    double *copy = malloc(size * size * sizeof *copy);
    if (!copy)
        return galv_fail(GALV_ERROR_MEMORY, "projected matrix of order %zu", size);
    memcpy(copy, l->y, size * size * sizeof *copy);
    galv_status status = galv_eigen_dense(size, copy, l->ritz, l->y, NULL);
    free(copy);
    return status;
}

/* |A w - value w| of Ritz pair k = |coupling times the last rows of its eigenvector|, never less
 * than what rounding alone makes of it. */
static double ritz_residual(const lanczos *l, size_t k, size_t coupled)
{
    const double *last = l->y + k * l->applied + l->applied - coupled;
    double sum = 0;
    for (size_t i = 0; i < l->width; i++) {
        double row = 0;
        for (size_t c = 0; c < coupled; c++)
            row += l->coupling[c * coupled + i] * last[c];
        sum += row * row;
    }
    return fmax(sqrt(sum), l->ritz[0] * 0x1p-52);
}

/* x (n x count) = V y. */
static void ritz_vectors(const lanczos *l, size_t count, double *x)
{
    product(CblasNoTrans, l->n, count, l->applied, 1, l->v, l->n, l->y, l->applied, 0, x, l->n);
}

/* Thick restart: V becomes its leading `keep` Ritz vectors, T their values. */
static galv_status restart(lanczos *l, size_t keep)
{
    double *x = malloc(l->n * keep * sizeof *x);
    if (!x)
        return galv_fail(GALV_ERROR_MEMORY, "restart with %zu vectors", keep);
    ritz_vectors(l, keep, x);
    memcpy(l->v, x, l->n * keep * sizeof *x);
    free(x);
    memset(l->t, 0, l->room * l->room * sizeof *l->t);
    for (size_t k = 0; k < keep; k++)
        l->t[k * l->room + k] = l->ritz[k];
    l->applied = keep;
    return GALV_OK;
}

/* How many leading pairs have to be converged. */
static size_t needed(const lanczos *l, const galv_krylov *run, size_t available)
{
    if (run->variance > 0) {
        double sum = 0;
        for (size_t k = 0; k < available; k++) {
            sum += l->ritz[k];
            if (sum >= run->variance * run->trace)
                return k + 1;
        }
    }
    return run->nev;
}

static void judge(lanczos *l, galv_krylov *run, size_t coupled, double *values, double *residuals)
{
    run->found = l->applied < run->nev ? l->applied : run->nev;
    run->converged = 0;
    for (size_t k = 0; k < run->found; k++) {
        values[k] = l->ritz[k];
        residuals[k] = ritz_residual(l, k, coupled);
        if (run->converged == k && residuals[k] <= run->tolerance * l->ritz[0])
            run->converged++;
    }
}

/* So many applications are half of the way, for those who ask how far it has come. */
enum { USUAL_APPLICATIONS = 8 };

static galv_status iterate(lanczos *l, galv_krylov *run, double *values, double *residuals)
{
    for (run->applications = 0;;) {
        size_t coupled = 0;
        /* The pending block is copied behind the basis before its image overwrites it. */
        memcpy(l->v + l->applied * l->n, l->w, l->n * l->width * sizeof *l->w);
        galv_status status = lanczos_step(l, &coupled);
        if (!status)
            status = rayleigh_ritz(l);
        if (status)
            return status;
        run->applications++;
        judge(l, run, coupled, values, residuals);
        double done = (double)run->applications;
        status = galv_stage_report(run->stage, done / (done + USUAL_APPLICATIONS));
        if (status)
            return status;
        bool exhausted = l->width == 0 || l->applied == l->n;
        if (exhausted || run->converged >= needed(l, run, run->found) ||
            run->applications == run->most)
            return GALV_OK;
        if (l->applied + l->width > l->room) {
            size_t keep = run->nev + l->block / 2;
            status = restart(l, keep < l->applied ? keep : l->applied);
            if (status)
                return status;
        }
    }
}

galv_status galv_eigen_krylov(const galv_operator *a, galv_krylov *run, const double *start,
                              double *values, double *vectors, double *residuals)
{
    lanczos l = {.a = a, .n = a->n};
    l.block = run->block < a->n ? run->block : a->n;
    l.room = run->basis > run->nev + 3 * l.block ? run->basis : run->nev + 3 * l.block;
    galv_status status = lanczos_allocate(&l);
    if (status)
        return status;
    if (start)
        memcpy(l.w, start, l.n * l.block * sizeof *l.w);
    else
        random_block(&l, run->seed);
    l.scale = 0;
    size_t rank = 0;
    if (!status)
        status = next_block(&l, 0, l.block, &rank);
    l.width = rank;
    if (!status && rank == 0)
        status = galv_fail(GALV_ERROR_NUMERIC, "the start block is zero");
    if (!status)
        status = iterate(&l, run, values, residuals);
    if (!status)
        ritz_vectors(&l, run->found, vectors);
    lanczos_free(&l);
    return status;
}
