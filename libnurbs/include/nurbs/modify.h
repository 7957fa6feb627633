/**
 * @file modify.h
 * Exact changes of representation: knot insertion, degree elevation, splitting, reversal. The shape
 * stays the same to rounding; knot vectors stay minimal. Every function creates its result.
 */
#ifndef NURBS_MODIFY_H
#define NURBS_MODIFY_H

#include <nurbs/curve.h>
#include <nurbs/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Inserts knots u[n] (non-decreasing, inside the domain; resulting multiplicity at most degree).
 */
NURBS_API nurbs_status nurbs_curve_insert(const nurbs_curve *curve, size_t n, const double *u,
                                          nurbs_curve **result);
/** Inserts n knots in one direction (0: u, 1: v); the surface stays. */
NURBS_API nurbs_status nurbs_surface_insert(const nurbs_surface *surface, int direction, size_t n,
                                            const double *knots, nurbs_surface **result);

/** Splits every non-empty knot span of both directions into `parts` equal parts (h refinement). */
NURBS_API nurbs_status nurbs_surface_refine(const nurbs_surface *surface, int parts,
                                            nurbs_surface **result);

/** Inserts knots until every non-empty span is one Bezier segment (patch): interior knots of
 * multiplicity degree, degree * segments + 1 control points. */
NURBS_API nurbs_status nurbs_curve_to_bezier(const nurbs_curve *curve, nurbs_curve **result);
/** Every knot as often as the degree: Bezier patches in one net. */
NURBS_API nurbs_status nurbs_surface_to_bezier(const nurbs_surface *surface,
                                               nurbs_surface **result);

/** Raises the degree by `by` >= 0; every distinct knot gains exactly `by` in multiplicity. */
NURBS_API nurbs_status nurbs_curve_elevate(const nurbs_curve *curve, int by, nurbs_curve **result);
/** Raises the degree in one direction; the surface stays. */
NURBS_API nurbs_status nurbs_surface_elevate(const nurbs_surface *surface, int direction, int by,
                                             nurbs_surface **result);

/** The part with parameters in [from, to]; keeps the parametrisation. */
NURBS_API nurbs_status nurbs_curve_part(const nurbs_curve *curve, double from, double to,
                                        nurbs_curve **result);
/** The part between two parameters of one direction. */
NURBS_API nurbs_status nurbs_surface_part(const nurbs_surface *surface, int direction, double from,
                                          double to, nurbs_surface **result);

/** The parts below and above an interior parameter. */
NURBS_API nurbs_status nurbs_curve_split(const nurbs_curve *curve, double u, nurbs_curve **left,
                                         nurbs_curve **right);
/** Both parts, below and above a parameter of one direction. */
NURBS_API nurbs_status nurbs_surface_split(const nurbs_surface *surface, int direction,
                                           double value, nurbs_surface **low, nurbs_surface **high);

/** The same curve run from its end. */
NURBS_API nurbs_status nurbs_curve_reverse(const nurbs_curve *curve, nurbs_curve **result);
/** The same surface with one direction reversed: its normals turn. */
NURBS_API nurbs_status nurbs_surface_reverse(const nurbs_surface *surface, int direction,
                                             nurbs_surface **result);
/** Exchanges u and v (flips the normal Su x Sv). */
NURBS_API nurbs_status nurbs_surface_swap(const nurbs_surface *surface, nurbs_surface **result);
/** Applies p -> matrix p + shift; matrix is 3 x 3 row by row (NULL: identity), shift NULL: none. */
NURBS_API nurbs_status nurbs_surface_transform(const nurbs_surface *surface, const double *matrix,
                                               const double shift[3], nurbs_surface **result);

/** Curve of constant parameter: direction 0 gives u = value (a curve in v), 1 gives v = value. */
NURBS_API nurbs_status nurbs_surface_iso_curve(const nurbs_surface *surface, int direction,
                                               double value, nurbs_curve **curve);

#ifdef __cplusplus
}
#endif

#endif
