#include "eigen.h"
#include "error.h"

#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

static void reverse(double *v, size_t n)
{
    for (size_t i = 0; i < n / 2; i++) {
        double t = v[i];
        v[i] = v[n - 1 - i];
        v[n - 1 - i] = t;
    }
}

/* LAPACK's ascending order becomes descending, columns with their values. */
static void reverse_columns(double *a, size_t n, size_t columns)
{
    for (size_t i = 0; i < columns / 2; i++) {
        double *left = a + i * n, *right = a + (columns - 1 - i) * n;
        for (size_t r = 0; r < n; r++) {
            double t = left[r];
            left[r] = right[r];
            right[r] = t;
        }
    }
}

galv_status galv_eigen_dense(size_t n, double *a, size_t nev, double *values, double *vectors)
{
    lapack_int order = (lapack_int)n, info;
    if (nev == 0) {
        info = LAPACKE_dsyev(LAPACK_COL_MAJOR, 'N', 'L', order, a, order, values);
    } else {
        /* Divide and conquer gives orthogonal vectors also for clusters and costs little more than
         * the reduction to tridiagonal form. */
        info = LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'L', order, a, order, values);
        if (!info) {
            memcpy(vectors, a + (n - nev) * n, n * nev * sizeof *vectors);
            reverse_columns(vectors, n, nev);
        }
    }
    if (!info)
        reverse(values, n);
    return galv_lapack(info, "eigenvalues of a symmetric matrix");
}
