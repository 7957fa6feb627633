/**
 * @file simplify.h
 * Fewer control points within a certified Euclidean tolerance, by knot removal (Tiller 1992; Lyche
 * and Morken 1987) on the hull's own parametrisation.
 */
#ifndef NURBS_SIMPLIFY_H
#define NURBS_SIMPLIFY_H

#include <nurbs/curve.h>
#include <nurbs/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Flags of nurbs_surface_simplify. */
enum {
    NURBS_SIMPLIFY_KEEP_EDGES =
        1, /**< the four boundary curves keep their planes: an edge that lies in y = 0 or
                z = 0 (any coordinate plane) stays in it exactly, and control points that lie on
                one side of that plane stay there; corners stay exactly in any case */
    NURBS_SIMPLIFY_KEEP_KINKS = 2, /**< knots of multiplicity >= degree are not touched */
    NURBS_SIMPLIFY_THRIFTY = 4 /**< one knot at a time with the largest difference balanced: 10 to
                           60 times as long for 0.5 to 0.9 of the control points */
};

/** Removes as many knots as the tolerance allows.
 * @param tolerance  metres, > 0; largest Euclidean distance at equal parameters
 * @param bound      fills a proven upper bound of that distance, <= tolerance; NULL allowed */
NURBS_API nurbs_status nurbs_curve_simplify(const nurbs_curve *curve, double tolerance,
                                            nurbs_curve **result, double *bound);
/** The same for a surface, in both directions. */
NURBS_API nurbs_status nurbs_surface_simplify(const nurbs_surface *surface, double tolerance,
                                              unsigned flags, nurbs_surface **result,
                                              double *bound);

/** Simplifies the shape instead of the mapping: parameters are evened out to the mean length of the
 * lines along each direction first, so that a simple shape whose parametrisation wobbles becomes
 * small. The domain of the result is then [0,1] x [0,1], and a kink stays within the tolerance
 * only; where evening out does not pay, the result is that of a thrifty nurbs_surface_simplify.
 * @param flags  0 or NURBS_SIMPLIFY_KEEP_EDGES
 * @param bound  fills a proven upper bound, <= tolerance, of the distance of each point of either
 *               surface from the other (Hausdorff distance); NULL allowed
 * Slower than a thrifty nurbs_surface_simplify: the net grows before it shrinks. */
NURBS_API nurbs_status nurbs_surface_simplify_geometric(const nurbs_surface *surface,
                                                        double tolerance, unsigned flags,
                                                        nurbs_surface **result, double *bound);
/** The same for curves; the parameter becomes about the length over its total. */
NURBS_API nurbs_status nurbs_curve_simplify_geometric(const nurbs_curve *curve, double tolerance,
                                                      nurbs_curve **result, double *bound);

/** Removes an interior knot (exactly as stored) `times` times whatever the distance, both end
 * points (corners) kept: least squares, then the largest distance lowered by alternating
 * projections. bound (NULL allowed) is filled as above; it is of the order of rounding when the
 * knot was redundant. Errors: the knot is not that often inside the domain. */
NURBS_API nurbs_status nurbs_curve_remove(const nurbs_curve *curve, double knot, int times,
                                          nurbs_curve **result, double *bound);
/** Takes a knot out of one direction as often as times. */
NURBS_API nurbs_status nurbs_surface_remove(const nurbs_surface *surface, int direction,
                                            double knot, int times, nurbs_surface **result,
                                            double *bound);

#ifdef __cplusplus
}
#endif

#endif
