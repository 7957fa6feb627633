/**
 * @file curve.h
 * NURBS curves in space. Objects are immutable after creation, so any number of threads may read
 * one.
 */
#ifndef NURBS_CURVE_H
#define NURBS_CURVE_H

#include <nurbs/status.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nurbs_curve nurbs_curve;

/** Creates a curve of n control points; copies all arrays. weights NULL: polynomial; else all > 0.
 * Errors: bad knots, NaN or Inf anywhere, weight <= 0 (each named by its index). */
NURBS_API nurbs_status nurbs_curve_create(int degree, size_t n, const double *knots,
                                          const double *points, const double *weights,
                                          nurbs_curve **curve);
/** Creates a copy. */
NURBS_API nurbs_status nurbs_curve_copy(const nurbs_curve *curve, nurbs_curve **copy);
/** Takes NULL. */
NURBS_API void nurbs_curve_free(nurbs_curve *curve);

/** Degree; 0 of NULL. */
NURBS_API int nurbs_curve_degree(const nurbs_curve *curve);
/** Number of control points; 0 of NULL. */
NURBS_API size_t nurbs_curve_size(const nurbs_curve *curve);
/** Borrowed from the curve: knots[size + degree + 1], points[3 * size], weights[size] or NULL. */
NURBS_API const double *nurbs_curve_knots(const nurbs_curve *curve);
/** Control points, x,y,z triples. Borrowed; NULL of NULL. */
NURBS_API const double *nurbs_curve_points(const nurbs_curve *curve);
/** Weights, or NULL when all are 1. Borrowed. */
NURBS_API const double *nurbs_curve_weights(const nurbs_curve *curve);

/** Points and derivatives at n parameters: fills out[n][order + 1][3], order 0 to 50. u outside the
 * domain is an error. At an interior knot the right-hand limit, at the end of the domain the
 * left-hand one. */
NURBS_API nurbs_status nurbs_curve_eval(const nurbs_curve *curve, int order, size_t n,
                                        const double *u, double *out);

/** The same with the left-hand limit at interior knots. */
NURBS_API nurbs_status nurbs_curve_eval_left(const nurbs_curve *curve, int order, size_t n,
                                             const double *u, double *out);

#ifdef __cplusplus
}
#endif

#endif
