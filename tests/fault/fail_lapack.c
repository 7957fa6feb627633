/* Preloaded (LD_PRELOAD) into a program, makes its k-th call of LAPACKE fail:
 *
 * - FAULT_AT=k: the calls below are counted from the start of main(); the k-th answers as if the
 *   matrix were singular or the iteration had not converged (info 1), its arguments as they were. 0
 *   or unset: none.
 * - FAULT_TRACE=1 prints the calls that led to it on standard error.
 * - FAULT_COUNT=FILE receives the number of calls when the program ends.
 *
 * Those that cannot fail (norms, exchanges of rows, reflectors) are let through. Needs glibc. */
#include "start.h"

#include <lapacke.h>

static void prepare(void)
{
}

static bool fails(void)
{
    if (!atomic_load(&armed) || atomic_fetch_add(&count, 1) + 1 != fault_at)
        return false;
    trace();
    return true;
}

#define FAIL(name, parameters, arguments)                                                          \
    lapack_int name parameters                                                                     \
    {                                                                                              \
        static __typeof__(&name) real;                                                             \
        if (!real)                                                                                 \
            *(void **)&real = dlsym(RTLD_NEXT, #name);                                             \
        return fails() ? 1 : real arguments;                                                       \
    }

typedef lapack_int in;
typedef double *out;
typedef const double *from;

FAIL(LAPACKE_dgbtrf_work, (int o, in m, in n, in kl, in ku, out a, in lda, in *p),
     (o, m, n, kl, ku, a, lda, p))
FAIL(LAPACKE_dgbtrs_work,
     (int o, char t, in n, in kl, in ku, in nrhs, from a, in lda, const in *p, out b, in ldb),
     (o, t, n, kl, ku, nrhs, a, lda, p, b, ldb))
FAIL(LAPACKE_dgecon, (int o, char norm, in n, from a, in lda, double anorm, out rcond),
     (o, norm, n, a, lda, anorm, rcond))
FAIL(LAPACKE_dgels, (int o, char t, in m, in n, in nrhs, out a, in lda, out b, in ldb),
     (o, t, m, n, nrhs, a, lda, b, ldb))
FAIL(LAPACKE_dgelsd,
     (int o, in m, in n, in nrhs, out a, in lda, out b, in ldb, out s, double rcond, in *rank),
     (o, m, n, nrhs, a, lda, b, ldb, s, rcond, rank))
FAIL(LAPACKE_dgeqp3, (int o, in m, in n, out a, in lda, in *p, out tau), (o, m, n, a, lda, p, tau))
FAIL(LAPACKE_dgeqrf, (int o, in m, in n, out a, in lda, out tau), (o, m, n, a, lda, tau))
FAIL(LAPACKE_dgesdd,
     (int o, char job, in m, in n, out a, in lda, out s, out u, in ldu, out vt, in ldvt),
     (o, job, m, n, a, lda, s, u, ldu, vt, ldvt))
FAIL(LAPACKE_dgesv, (int o, in n, in nrhs, out a, in lda, in *p, out b, in ldb),
     (o, n, nrhs, a, lda, p, b, ldb))
FAIL(LAPACKE_dgetrf, (int o, in m, in n, out a, in lda, in *p), (o, m, n, a, lda, p))
FAIL(LAPACKE_dgetrf_work, (int o, in m, in n, out a, in lda, in *p), (o, m, n, a, lda, p))
FAIL(LAPACKE_dgetrs, (int o, char t, in n, in nrhs, from a, in lda, const in *p, out b, in ldb),
     (o, t, n, nrhs, a, lda, p, b, ldb))
FAIL(LAPACKE_dgetrs_work,
     (int o, char t, in n, in nrhs, from a, in lda, const in *p, out b, in ldb),
     (o, t, n, nrhs, a, lda, p, b, ldb))
FAIL(LAPACKE_dorgqr, (int o, in m, in n, in k, out a, in lda, from tau), (o, m, n, k, a, lda, tau))
FAIL(LAPACKE_dormtr,
     (int o, char side, char uplo, char t, in m, in n, from a, in lda, from tau, out c, in ldc),
     (o, side, uplo, t, m, n, a, lda, tau, c, ldc))
FAIL(LAPACKE_dposv, (int o, char uplo, in n, in nrhs, out a, in lda, out b, in ldb),
     (o, uplo, n, nrhs, a, lda, b, ldb))
FAIL(LAPACKE_dpotrf, (int o, char uplo, in n, out a, in lda), (o, uplo, n, a, lda))
FAIL(LAPACKE_dpotrf_work, (int o, char uplo, in n, out a, in lda), (o, uplo, n, a, lda))
FAIL(LAPACKE_dpotri_work, (int o, char uplo, in n, out a, in lda), (o, uplo, n, a, lda))
FAIL(LAPACKE_dstedc, (int o, char z, in n, out d, out e, out v, in ldv), (o, z, n, d, e, v, ldv))
FAIL(LAPACKE_dsyev, (int o, char job, char uplo, in n, out a, in lda, out w),
     (o, job, uplo, n, a, lda, w))
FAIL(LAPACKE_dsyevd, (int o, char job, char uplo, in n, out a, in lda, out w),
     (o, job, uplo, n, a, lda, w))
