/* What the regressions ask of BLAS and LAPACK: row-major matrices of which the lower triangle is
 * meant, row length ld, with what the calls return checked. LAPACK counts columns first: its upper
 * triangle is this lower one, and nothing is copied or transposed. */
#ifndef BAYESOPT_MATRIX_H
#define BAYESOPT_MATRIX_H

#include <bayesopt/status.h>

#include <stdbool.h>
#include <stddef.h>

/* sum x[i] y[i]; y += a x; x *= a, over n entries. */
double matrix_dot(size_t n, const double *x, const double *y);
void matrix_axpy(size_t n, double a, const double *x, double *y);
void matrix_scale(size_t n, double a, double *x);

/* A = L L' in place; the strict upper triangle is neither read nor written. false: not positive
 * definite or not finite, A is spoilt. O(n^3/3). */
bool matrix_cholesky(size_t n, double *a, size_t ld);

/* B := L^-1 B for m columns, B n x m with row length ldb. O(n^2 m). */
void matrix_solve_lower(size_t n, const double *l, size_t ld, size_t m, double *b, size_t ldb);

/* b := L^-1 b and b := L^-T b for one vector. O(n^2). */
void matrix_forward(size_t n, const double *l, size_t ld, double *b);
void matrix_backward(size_t n, const double *l, size_t ld, double *b);

/* inverse := lower triangle of (L L')^-1. false: L has a zero on its diagonal. O(2 n^3/3). */
bool matrix_inverse(size_t n, const double *l, size_t ld, double *inverse);

/* b := A^-1 b for a full n x n matrix, which is overwritten. *ok false: a pivot is at most `least`
 * times the largest entry of A. O(2 n^3/3).
 * @return BAYESOPT_ERROR_MEMORY */
bayesopt_status matrix_solve(size_t n, double *a, double *b, double least, bool *ok);

/* Eigenvalues of a symmetric matrix, ascending, into values [n]; A is spoilt. work [3 n]. false: no
 * convergence. */
bool matrix_eigenvalues(size_t n, double *a, double *values, double *work);

#endif
