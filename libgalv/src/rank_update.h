/* The rank-k update that accumulates a covariance. */
#ifndef GALV_RANK_UPDATE_H
#define GALV_RANK_UPDATE_H

#include <galv/status.h>

#include <stddef.h>

/* c += alpha a a^T on the lower triangle of c (n x n, column-major, ld n); a: n x k, column-major,
 * ld n.
 *
 * BLAS has this as dsyrk. It is written out here because it is nearly all of the work of a
 * covariance, and the usual OpenBLAS falls back to SSE kernels, a fifth of the speed, on processors
 * newer than itself. The result does not depend on the number of threads. */
galv_status galv_rank_update(size_t n, size_t k, double alpha, const double *a, double *c);

#endif
