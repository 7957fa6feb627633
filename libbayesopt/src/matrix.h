/* Dense factorisation and solves, row-major, lower triangles.
 *
 * Work is cut into 64 x 64 tiles whose products OpenBLAS computes in the calling thread whatever
 * its thread setting, so results do not depend on that setting and concurrent callers do not
 * oversubscribe the machine. */
#ifndef BAYESOPT_MATRIX_H
#define BAYESOPT_MATRIX_H

#include <stdbool.h>
#include <stddef.h>

/* A = L L' in place (lower triangle of n x n, row length ld); the strict upper triangle is neither
 * read nor written. false: not positive definite, A is spoilt. O(n^3/3). */
bool matrix_cholesky(size_t n, double *a, size_t ld);

/* B := L^-1 B for m columns, B n x m with row length ldb. O(n^2 m). */
void matrix_solve_lower(size_t n, const double *l, size_t ld, size_t m, double *b, size_t ldb);

/* b := L^-1 b and b := L^-T b for one vector. O(n^2). */
void matrix_forward(size_t n, const double *l, size_t ld, double *b);
void matrix_backward(size_t n, const double *l, size_t ld, double *b);

/* inverse := (L L')^-1, lower triangle (tiles on the diagonal whole); work: n x n. Row lengths ld
 * for all. O(2 n^3/3). */
void matrix_inverse(size_t n, const double *l, size_t ld, double *inverse, double *work);

/* C := A B, A n x k (lda), B k x m (ldb), C n x m (ldc). */
void matrix_product(size_t n, size_t k, size_t m, const double *a, size_t lda, const double *b,
                    size_t ldb, double *c, size_t ldc);

#endif
