/**
 * @file basis.h
 * B-spline basis functions and knot vectors on plain arrays: no object needed.
 *
 * n control points of degree p have knots[n + p + 1], non-decreasing, the first and the last p + 1
 * equal (clamped), interior multiplicity at most p + 1. The span of u is the index s with knots[s]
 * <= u < knots[s+1], p <= s <= n - 1; the end of the domain belongs to the last span. Source: Piegl
 * and Tiller, The NURBS Book, 2nd ed., chapter 2.
 */
#ifndef NURBS_BASIS_H
#define NURBS_BASIS_H

#include <nurbs/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Highest degree the library accepts. */
#define NURBS_MAX_DEGREE 25

/** Checks a knot vector: finite, non-decreasing, clamped, multiplicities; names the knot at fault.
 */
NURBS_API nurbs_status nurbs_knots_check(int degree, size_t n, const double *knots);

/** Span of u. u outside the domain is taken at the nearer end. O(log n); O(1) when u lies in or
 * next to the span *hint (NULL: no hint), which is updated. */
NURBS_API size_t nurbs_basis_span(int degree, size_t n, const double *knots, double u,
                                  size_t *hint);

/** Fills values[degree + 1]: the basis functions span - degree ... span at u. */
NURBS_API void nurbs_basis(int degree, const double *knots, size_t span, double u, double *values);

/** Fills values[(order + 1) * (degree + 1)], row k the k-th derivatives; zero rows above the
 * degree. */
NURBS_API void nurbs_basis_derivatives(int degree, const double *knots, size_t span, double u,
                                       int order, double *values);

/** Fills greville[n]: (knots[i+1] + ... + knots[i+p]) / p, the knot span's middle for degree 0. */
NURBS_API void nurbs_greville(int degree, size_t n, const double *knots, double *greville);

/** Fills breaks (distinct knots, at most n - degree + 1) and, if not NULL, their multiplicities;
 * returns their number. */
NURBS_API size_t nurbs_knots_distinct(int degree, size_t n, const double *knots, double *breaks,
                                      int *multiplicities);

/** Makes interior knots equal that differ by at most `tolerance` (parameter units, >= 0), so that
 * knots equal only to rounding stop counting twice: each group, begun at its lowest knot and of at
 * most `degree` copies, moves to its mean. The ends stay; knots within the tolerance of an end stay
 * as they are. Returns the number of knots that moved. Control points are not changed: a spline
 * moves by about its speed times the tolerance. */
NURBS_API size_t nurbs_knots_merge(int degree, size_t n, double *knots, double tolerance);

/** Gauss-Legendre rule on [0,1]; n from 1 to 64. Fills nodes[n] (increasing) and weights[n] (sum
 * 1), to 1e-15. */
NURBS_API nurbs_status nurbs_gauss_legendre(size_t n, double *nodes, double *weights);

#ifdef __cplusplus
}
#endif

#endif
