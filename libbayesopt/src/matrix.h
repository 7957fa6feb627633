/* Dense factorisation and solves for matrices of a few hundred to a few thousand rows, row-major,
 * lower triangles.
 *
 * All in the calling thread: results are the same whatever thread setting a BLAS has, and callers
 * that run side by side do not oversubscribe the machine. Work is done on 64 x 64 tiles that stay
 * in the first-level caches, the products in register blocks. */
#ifndef BAYESOPT_MATRIX_H
#define BAYESOPT_MATRIX_H

#include <stdbool.h>
#include <stddef.h>

/* sum x[i] y[i]; y += a x; x *= a, over n entries. */
double matrix_dot(size_t n, const double *x, const double *y);
void matrix_axpy(size_t n, double a, const double *x, double *y);
void matrix_scale(size_t n, double a, double *x);

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

#endif
