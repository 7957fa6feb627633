#include "eigen.h"
#include "error.h"

#include <cblas.h>
#include <lapacke.h>
#include <stdlib.h>

/* LAPACK does all of it at once up to this order, in a tenth of a second. */
enum { AT_ONCE = 512, PANEL = 32, COLUMNS = 512 };
/* Shares of the time: reduction, divide and conquer, vectors. */
static const double REDUCED = 0.6, CONQUERED = 0.75;

static void reverse(double *v, size_t n)
{
    for (size_t i = 0; i < n / 2; i++) {
        double t = v[i];
        v[i] = v[n - 1 - i];
        v[n - 1 - i] = t;
    }
}

/* LAPACK's ascending order becomes descending, columns with their values. */
static void reverse_columns(double *a, size_t n)
{
    for (size_t i = 0; i < n / 2; i++)
        cblas_dswap((blasint)n, a + i * n, 1, a + (n - 1 - i) * n, 1);
}

static void times(CBLAS_TRANSPOSE trans, size_t m, size_t k, double alpha, const double *a,
                  size_t ld, const double *x, size_t step, double beta, double *y)
{
    if (m && k)
        cblas_dgemv(CblasColMajor, trans, (blasint)m, (blasint)k, alpha, a, (blasint)ld, x,
                    (blasint)step, beta, y, 1);
}

/* Column k of a panel that begins at j, by the reflectors before it: LAPACK's dlatrd, which is not
 * part of LAPACKE. a = column-major lower triangle of order n, w = n x PANEL, h = PANEL numbers. */
static int reduce_column(size_t n, double *a, size_t j, size_t k, double *w, double *h, double *d,
                         double *e, double *tau)
{
    size_t c = j + k, rest = n - c - 1;
    double *column = a + c * n, *v = a + j * n, *image = w + k * n;
    /* a(c:, c) -= V W^T + W V^T; rows c of V and W are n apart. */
    times(CblasNoTrans, n - c, k, -1, v + c, n, w + c, n, 1, column + c);
    times(CblasNoTrans, n - c, k, -1, w + c, n, v + c, n, 1, column + c);
    d[c] = column[c];
    if (rest == 0)
        return 0;
    double *x = column + c + 1;
    int info = LAPACKE_dlarfg((lapack_int)rest, x, rest > 1 ? x + 1 : x, 1, tau + c);
    if (info)
        return info;
    e[c] = x[0];
    x[0] = 1;
    /* image = tau (A - V W^T - W V^T) x, then less half its part along x. */
    cblas_dsymv(CblasColMajor, CblasLower, (blasint)rest, 1, a + (c + 1) * n + c + 1, (blasint)n, x,
                1, 0, image + c + 1, 1);
    times(CblasTrans, rest, k, 1, w + c + 1, n, x, 1, 0, h);
    times(CblasNoTrans, rest, k, -1, v + c + 1, n, h, 1, 1, image + c + 1);
    times(CblasTrans, rest, k, 1, v + c + 1, n, x, 1, 0, h);
    times(CblasNoTrans, rest, k, -1, w + c + 1, n, h, 1, 1, image + c + 1);
    cblas_dscal((blasint)rest, tau[c], image + c + 1, 1);
    double along = cblas_ddot((blasint)rest, image + c + 1, 1, x, 1);
    cblas_daxpy((blasint)rest, -0.5 * tau[c] * along, x, 1, image + c + 1, 1);
    return 0;
}

/* To tridiagonal form as dsytrd does, panel by panel (Golub and Van Loan, Matrix Computations,
 * 8.3.1), so that it can be cancelled after each column. */
static galv_status reduce(size_t n, double *a, double *w, double *d, double *e, double *tau,
                          galv_stage *stage)
{
    double h[PANEL];
    for (size_t j = 0; j < n; j += PANEL) {
        size_t columns = n - j < PANEL ? n - j : PANEL, next = j + columns;
        for (size_t k = 0; k < columns; k++) {
            double left = (double)(n - j - k) / (double)n;
            galv_status status = galv_stage_report(stage, REDUCED * (1 - left * left * left));
            if (!status)
                status =
                    galv_lapack(reduce_column(n, a, j, k, w, h, d, e, tau), "tridiagonal form");
            if (status)
                return status;
        }
        if (next < n)
            cblas_dsyr2k(CblasColMajor, CblasLower, CblasNoTrans, (blasint)(n - next),
                         (blasint)columns, -1, a + j * n + next, (blasint)n, w + next, (blasint)n,
                         1, a + next * n + next, (blasint)n);
    }
    return galv_stage_report(stage, REDUCED);
}

static galv_status in_stages(size_t n, double *a, double *values, double *vectors,
                             galv_stage *stage)
{
    lapack_int order = (lapack_int)n;
    double *e = malloc((PANEL + 2) * n * sizeof *e), *tau = e + n, *w = tau + n;
    if (!e)
        return galv_fail(GALV_ERROR_MEMORY, "tridiagonal form of order %zu", n);
    galv_status status = reduce(n, a, w, values, e, tau, stage);
    /* Divide and conquer gives orthogonal vectors also for clusters. */
    if (!status)
        status =
            galv_lapack(LAPACKE_dstedc(LAPACK_COL_MAJOR, 'I', order, values, e, vectors, order),
                        "eigenvalues of a tridiagonal matrix");
    if (!status)
        status = galv_stage_report(stage, CONQUERED);
    for (size_t c = 0; c < n && !status; c += COLUMNS) {
        size_t count = n - c < COLUMNS ? n - c : COLUMNS;
        status =
            galv_lapack(LAPACKE_dormtr(LAPACK_COL_MAJOR, 'L', 'L', 'N', order, (lapack_int)count, a,
                                       order, tau, vectors + c * n, order),
                        "eigenvectors of a symmetric matrix");
        if (!status)
            status = galv_stage_report(stage, CONQUERED + (1 - CONQUERED) * (double)(c + count) /
                                                              (double)n);
    }
    free(e);
    return status;
}

galv_status galv_eigen_dense(size_t n, double *a, double *values, double *vectors,
                             galv_stage *stage)
{
    lapack_int order = (lapack_int)n;
    galv_status status;
    if (n > AT_ONCE) {
        status = in_stages(n, a, values, vectors, stage);
    } else {
        status = galv_lapack(LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'L', order, a, order, values),
                             "eigenvalues of a symmetric matrix");
        if (!status)
            cblas_dcopy((blasint)(n * n), a, 1, vectors, 1);
    }
    if (status)
        return status;
    reverse_columns(vectors, n);
    reverse(values, n);
    return GALV_OK;
}
