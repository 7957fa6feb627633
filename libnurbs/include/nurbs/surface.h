/**
 * @file surface.h
 * Tensor-product NURBS surfaces. Objects are immutable after creation, so any number of threads may
 * read one. Direction 0 is u, direction 1 is v.
 */
#ifndef NURBS_SURFACE_H
#define NURBS_SURFACE_H

#include <nurbs/status.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nurbs_surface nurbs_surface;

/** Creates a surface of size[0] x size[1] control points (u slow, v fast); copies all arrays.
 * @param degree   degree[2], 1 to NURBS_MAX_DEGREE
 * @param size     size[2], each > its degree
 * @param knots_u  size[0] + degree[0] + 1 knots; knots_v likewise
 * @param points   3 * size[0] * size[1], Cartesian, metres
 * @param weights  size[0] * size[1], all > 0; NULL: polynomial
 * Errors: bad knots, NaN or Inf anywhere, weight <= 0 (each named by its index). */
NURBS_API nurbs_status nurbs_surface_create(const int degree[2], const size_t size[2],
                                            const double *knots_u, const double *knots_v,
                                            const double *points, const double *weights,
                                            nurbs_surface **surface);
/** Creates a copy. */
NURBS_API nurbs_status nurbs_surface_copy(const nurbs_surface *surface, nurbs_surface **copy);
/** Takes NULL. */
NURBS_API void nurbs_surface_free(nurbs_surface *surface);

/** Degree in one direction (0: u, 1: v); 0 of NULL. */
NURBS_API int nurbs_surface_degree(const nurbs_surface *surface, int direction);
/** Control points in one direction (0: u, 1: v); 0 of NULL. */
NURBS_API size_t nurbs_surface_size(const nurbs_surface *surface, int direction);
/** Borrowed from the surface. weights: NULL when polynomial. */
NURBS_API const double *nurbs_surface_knots(const nurbs_surface *surface, int direction);
/** Control net, x,y,z triples, u slow and v fast. Borrowed; NULL of NULL. */
NURBS_API const double *nurbs_surface_points(const nurbs_surface *surface);
/** Weights in the same order, or NULL when all are 1. Borrowed. */
NURBS_API const double *nurbs_surface_weights(const nurbs_surface *surface);

/** Derivatives of a point up to an order, by total order and then by the number of v derivatives:
 * S, Su, Sv, Suu, Suv, Svv, Suuu, Suuv, ... */
#define NURBS_SURFACE_TRIPLES(order) (((order) + 1) * ((order) + 2) / 2)

/** Points and derivatives at n scattered parameters.
 * @param order  0 to 50; up to 2 is the fast path. Above the degree of a polynomial: zero
 * @param uv     n pairs u,v inside the domain (else an error naming the index)
 * @param out    fills out[n][NURBS_SURFACE_TRIPLES(order)][3]
 * At interior knots the right-hand limit, at the end of the domain the left-hand one. Spans are
 * found by a table in constant time, so no hint is needed. */
NURBS_API nurbs_status nurbs_surface_eval(const nurbs_surface *surface, int order, size_t n,
                                          const double *uv, double *out);

/** The same with a choice of limit at interior knots: left & 1 takes the left-hand limit in u, left
 * & 2 in v. */
NURBS_API nurbs_status nurbs_surface_eval_sided(const nurbs_surface *surface, int order,
                                                unsigned left, size_t n, const double *uv,
                                                double *out);

/** The same on the tensor grid u[nu] x v[nv]: fills out[nu][nv][triples][3]. Basis functions are
 * evaluated once per axis, so this is several times faster than scattered points. u and v must each
 * be non-decreasing. Needs no memory beyond out. */
NURBS_API nurbs_status nurbs_surface_eval_grid(const nurbs_surface *surface, int order, size_t nu,
                                               const double *u, size_t nv, const double *v,
                                               double *out);

/** Basis functions that do not vanish at (u,v), rational when the surface is, with derivatives:
 * fills values[triples][(pu+1)*(pv+1)] for the functions (span[0]-pu+a, span[1]-pv+b), a slow, b
 * fast, and span[2]. order 0, 1 or 2. */
NURBS_API nurbs_status nurbs_surface_basis(const nurbs_surface *surface, int order, double u,
                                           double v, size_t span[2], double *values);

/** Derivatives of points with respect to control points as sparse rows, for n parameters at once.
 *
 * S and its derivatives are linear in the control points, the same for x, y and z: derivative k at
 * parameter i is the sum over c of values[i][k][c] * P[columns[i][c]].
 * @param order    0, 1 or 2
 * @param columns  fills columns[n][count], count = (pu+1)(pv+1): indices of control points
 * @param values   fills values[n][NURBS_SURFACE_TRIPLES(order)][count]
 * Weights are held fixed; dS/dw_c = R_c (P_c - S) / w_c with R_c = values[i][0][c]. */
NURBS_API nurbs_status nurbs_surface_rows(const nurbs_surface *surface, int order, size_t n,
                                          const double *uv, size_t *columns, double *values);

#ifdef __cplusplus
}
#endif

#endif
