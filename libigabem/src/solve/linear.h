/* The dense linear systems of a solve: LU, or GMRES with the entries near the diagonal, in order of
 * x, as preconditioner. Matrices are row by row, rows `stride` doubles apart. */
#ifndef LINEAR_H
#define LINEAR_H

#include "core/progress.h"
#include "solve/gmres.h"

struct matrix {
    size_t n, stride;
    double *rows;
    int threads;
    struct progress *progress; /* told of blocks of LU and of iterations; NULL: nobody listens */
};

/* Solves matrix x = right (replaced by x; the matrix by its factors) and estimates the condition
 * number in the 1-norm (NULL: not wanted). */
igabem_status linear_lu(const struct matrix *matrix, double *right, double *condition);
/* The same for `count` right-hand sides, each contiguous. */
igabem_status linear_lu_many(const struct matrix *matrix, size_t count, double *right,
                             double *condition);

/* Factors in place of the matrix, with which linear_lu_solve() solves: matrix x = right, or with
 * its transpose, for `count` right-hand sides, each contiguous. pivots[n]. */
igabem_status linear_lu_factor(const struct matrix *matrix, int *pivots, double *condition);
igabem_status linear_lu_solve(const struct matrix *factors, const int *pivots, bool transposed,
                              size_t count, double *right);

/* What iterations need besides the matrix, which stays as it is and is borrowed. */
struct iteration;

/* point[n][3]: unknowns with neighbouring points depend on each other. */
igabem_status iteration_create(const struct matrix *matrix, const double *point,
                               struct iteration **iteration);
void iteration_free(struct iteration *iteration);

/* A second matrix: y += A x. */
struct addend {
    gmres_product add;
    const void *data;
};

/* Solves (matrix + addend) x = right from the x given; NULL: no addend. */
igabem_status iteration_solve(const struct iteration *iteration, const struct addend *addend,
                              const double *right, double *x, struct gmres_result *result);

/* Estimates the condition number in the 1-norm (Higham, ACM Trans. Math. Softw. 14, 1988). */
igabem_status iteration_condition(const struct iteration *iteration, double *condition);

/* Bytes that grow faster than the unknowns. */
double iteration_memory(const struct iteration *iteration);

#endif
