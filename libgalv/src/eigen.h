/* Leading eigenpairs of symmetric positive semi-definite matrices. Column-major, values descending.
 */
#ifndef GALV_EIGEN_H
#define GALV_EIGEN_H

#include "stage.h"

#include <stddef.h>
#include <stdint.h>

/* All n eigenvalues and eigenvectors (n x n) of the lower triangle of a, which is destroyed. stage:
 * told of columns and of blocks of vectors; NULL: nobody listens. */
galv_status galv_eigen_dense(size_t n, double *a, double *values, double *vectors,
                             galv_stage *stage);

/* y = A v for a block of b vectors (n x b). */
typedef struct galv_operator {
    size_t n;
    galv_status (*apply)(void *user_data, size_t b, const double *v, double *y);
    void *user_data;
} galv_operator;

typedef struct galv_krylov {
    size_t nev;       /* eigenpairs wanted */
    size_t block;     /* vectors per application */
    size_t basis;     /* most basis vectors kept, >= nev + 2 block */
    size_t most;      /* most applications */
    double tolerance; /* residual norm wanted, relative to the largest eigenvalue */
    double variance; /* stop early once the pairs that reach this share of `trace` are converged; 0:
                        never */
    double trace;
    uint64_t seed;
    galv_stage *stage; /* told of each application; NULL: nobody listens */
    /* Results. */
    size_t found;        /* pairs returned, fewer than nev when the rank is */
    size_t converged;    /* of them, leading pairs within the tolerance */
    size_t applications; /* of the operator */
} galv_krylov;

/* Block Lanczos with full orthogonalisation, a random start and thick restarts (Golub and Underwood
 * 1977; Wu and Simon, SIAM J. Matrix Anal. Appl. 22, 2000). values: nev; vectors: n x nev;
 * residuals: nev norms |A w - value w|. Each interval value +- residual holds an eigenvalue, and no
 * value exceeds the eigenvalue of its index. start: n x block vectors to begin with, or NULL for
 * random ones. */
galv_status galv_eigen_krylov(const galv_operator *a, galv_krylov *run, const double *start,
                              double *values, double *vectors, double *residuals);

#endif
