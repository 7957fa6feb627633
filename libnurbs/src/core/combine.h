/* Linear combinations of rows, the inner loop of band solvers and of maps between knot vectors. */
#ifndef NURBS_COMBINE_H
#define NURBS_COMBINE_H

#include <stddef.h>

/* to[c] = own * to[c] + the sum over k < count of weight[k] * from[k * stride + c], c < columns.
 * With own 0 the old values are not read. */
void combine(size_t count, const double *weight, const double *from, ptrdiff_t stride,
             size_t columns, double own, double *to);

/* Largest squared Euclidean norm, over the planes, of target - row, both [planes][lines]; raises
 * worst[lines], if not NULL, to the norms of the lines. */
double largest_square(size_t planes, size_t lines, const double *target, const double *row,
                      double *worst);

#endif
