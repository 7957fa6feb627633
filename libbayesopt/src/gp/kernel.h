/* The stationary correlations and what their derivatives need. */
#ifndef BAYESOPT_KERNEL_H
#define BAYESOPT_KERNEL_H

#include <bayesopt/gp.h>

#include <stddef.h>

/* For n squared scaled distances: the correlations g and, unless w is NULL, the factors
 * w = -2 dg/d(r2), so that dg/dx_j = -w (x_j - x'_j)/l_j^2 and dg/dlog l_j = w ((x_j -
 * x'_j)/l_j)^2. r2 and g may be the same array. */
void kernel_values(bayesopt_kernel kernel, size_t n, const double *r2, double *g, double *w);

/* r2[k] = sum_j (columns[j ld + k] - point[j])^2 for k < n: columns holds n points variable by
 * variable. Where jump[j] > 0 (jump NULL: nowhere) the square is jump[j] for values that differ. */
void kernel_distances(size_t n, size_t d, const double *columns, size_t ld, const double *point,
                      const double *jump, double *r2);

/* sum[j] += sum_{k < n} weight[k] times that square */
void kernel_weighted_squares(size_t n, size_t d, const double *columns, size_t ld,
                             const double *point, const double *jump, const double *weight,
                             double *sum);

#endif
