#include "core/matrix.h"

#include "core/error.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sizes of LAPACK; n is bounded by memory long before this. */
static lapack_int number(size_t n)
{
    return (lapack_int)n;
}

double matrix_dot(size_t n, const double *x, const double *y)
{
    return cblas_ddot(number(n), x, 1, y, 1);
}

void matrix_axpy(size_t n, double a, const double *x, double *y)
{
    cblas_daxpy(number(n), a, x, 1, y, 1);
}

void matrix_scale(size_t n, double a, double *x)
{
    cblas_dscal(number(n), a, x, 1);
}

bool matrix_cholesky(size_t n, double *a, size_t ld)
{
    if (n && LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'U', number(n), a, number(ld)) != 0)
        return false;
    /* A pivot that is NAN passes for positive there. */
    for (size_t i = 0; i < n; i++)
        if (!isfinite(a[i * ld + i]))
            return false;
    return true;
}

void matrix_solve_lower(size_t n, const double *l, size_t ld, size_t m, double *b, size_t ldb)
{
    if (n && m)
        cblas_dtrsm(CblasRowMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, number(n),
                    number(m), 1, l, number(ld), b, number(ldb));
}

void matrix_forward(size_t n, const double *l, size_t ld, double *b)
{
    if (n)
        cblas_dtrsv(CblasRowMajor, CblasLower, CblasNoTrans, CblasNonUnit, number(n), l, number(ld),
                    b, 1);
}

void matrix_backward(size_t n, const double *l, size_t ld, double *b)
{
    if (n)
        cblas_dtrsv(CblasRowMajor, CblasLower, CblasTrans, CblasNonUnit, number(n), l, number(ld),
                    b, 1);
}

bool matrix_inverse(size_t n, const double *l, size_t ld, double *inverse)
{
    for (size_t i = 0; i < n; i++)
        memcpy(inverse + i * ld, l + i * ld, (i + 1) * sizeof *l);
    return !n || LAPACKE_dpotri_work(LAPACK_COL_MAJOR, 'U', number(n), inverse, number(ld)) == 0;
}

bayesopt_status matrix_solve(size_t n, double *a, double *b, double least, bool *ok)
{
    lapack_int *pivots = malloc(n * sizeof *pivots);
    *ok = false;
    if (!pivots)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "no memory to solve for %zu unknowns", n);
    double largest = fabs(a[cblas_idamax(number(n * n), a, 1)]);
    /* Columns first, so A' is what is factored. */
    *ok = LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, number(n), number(n), a, number(n), pivots) == 0;
    for (size_t i = 0; i < n && *ok; i++)
        *ok = fabs(a[i * n + i]) > least * largest;
    *ok = *ok && LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'T', number(n), 1, a, number(n), pivots, b,
                                     number(n)) == 0;
    free(pivots);
    return BAYESOPT_OK;
}

bool matrix_eigenvalues(size_t n, double *a, double *values, double *work)
{
    return LAPACKE_dsyev_work(LAPACK_COL_MAJOR, 'N', 'U', number(n), a, number(n), values, work,
                              number(3 * n)) == 0;
}
