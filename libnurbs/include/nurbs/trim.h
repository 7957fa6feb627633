/**
 * @file trim.h
 * Trimmed surfaces as untrimmed patches.
 */
#ifndef NURBS_TRIM_H
#define NURBS_TRIM_H

#include <nurbs/curve.h>
#include <nurbs/patches.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Resamples the part of a surface inside a four-sided loop as a patch of its own.
 *
 * The loop's corners, the four places where it turns by more than 20 degrees, become the corners of
 * the patch; a Coons map (1967) of the parameter plane carries the unit square to the inside of the
 * loop; a polynomial tensor spline of the surface's degrees (at least 3, at most 5) interpolates
 * the surface over that map, its spans divided until a part of the tolerance is kept; knot removal
 * then uses the rest. Domain [0,1] x [0,1],
 * u and v and the normal directed as on the surface.
 * @param n          number of curves
 * @param loop       curves in the parameter plane (u,v, third coordinate unused), in the order in
 *                   which they follow each other, each in either direction; they meet, or end at
 *                   one point of the surface, within a quarter of the tolerance
 * @param tolerance  metres, > 0
 * @param deviation  fills the largest distance in metres between patch and surface at equal
 *                   parameters, on 16 samples a span, plus the proven bound of knot removal and the
 *                   largest gap that was closed in the loop; at most the tolerance; NULL allowed
 * Errors: NURBS_ERROR_GEOMETRY: the loop is open, has not four corners, leaves the surface, or the
 * map folds; NURBS_ERROR_NUMERIC: more than 600 control points a direction would be needed (a
 * surface with a kink across the patch). */
NURBS_API nurbs_status nurbs_surface_untrim(const nurbs_surface *surface, size_t n,
                                            const nurbs_curve *const *loop, double tolerance,
                                            nurbs_surface **patch, double *deviation);

/** The same for loops with any number of corners, and holes: the inside is divided by straight
 * lines of the parameter plane into four-sided pieces. A loop with fewer than four corners gets
 * some in the middle of its longest sides; with up to ten, the four that give the most even map
 * count, the others become kinks in a side.
 * @param loops      number of loops; the one that encloses most is the outer one
 * @param count      [loops] curves of each
 * @param loop       [loops][count] as above
 * @param patches    the pieces are added; nothing is added after a failure */
NURBS_API nurbs_status nurbs_surface_untrim_parts(const nurbs_surface *surface, size_t loops,
                                                  const size_t *count,
                                                  const nurbs_curve *const *const *loop,
                                                  double tolerance, nurbs_patches *patches,
                                                  double *deviation);

#ifdef __cplusplus
}
#endif

#endif
