/**
 * @file invert.h
 * Closest points: the parameters of the point of a curve or surface that is nearest to a given one.
 * For a point on the surface this is inversion.
 */
#ifndef NURBS_INVERT_H
#define NURBS_INVERT_H

#include <nurbs/curve.h>
#include <nurbs/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Bounding boxes of the parts of a surface, for many searches. Immutable after creation. */
typedef struct nurbs_locator nurbs_locator;

/** Creates a locator; copies the surface. Memory and time are proportional to its control points.
 */
NURBS_API nurbs_status nurbs_locator_create(const nurbs_surface *surface, nurbs_locator **locator);
/** Takes NULL. */
NURBS_API void nurbs_locator_free(nurbs_locator *locator);

/** Closest points of the whole surface.
 *
 * Branch and bound on Bezier patches. Boxes leave out most; in a part that is left Newton's method
 * finds a local minimum, and Bernstein coefficients of the squared distance prove that the part
 * holds nothing nearer (or nothing nearer by more than 5e-10 of the distance), else the part is cut
 * in four. The result is the global minimum, except that the work for a point ends after 20000
 * parts, which takes a region that is almost equally far everywhere; it is then the best found.
 * Among equally near points any one is found. No allocation.
 * @param points    n x,y,z triples
 * @param uv        fills n pairs
 * @param distance  fills n distances in metres; NULL: not wanted
 * Errors: NaN or Inf in a point, named by its index. */
NURBS_API nurbs_status nurbs_locator_closest(const nurbs_locator *locator, size_t n,
                                             const double *points, double *uv, double *distance);

/** The same with a locator made for this call. */
NURBS_API nurbs_status nurbs_surface_closest(const nurbs_surface *surface, size_t n,
                                             const double *points, double *uv, double *distance);

/** A local minimum of the distance, by Newton's method from the given uv (replaced): for points
 * that moved little since they were found. uv outside the domain is an error. No allocation. */
NURBS_API nurbs_status nurbs_surface_closest_near(const nurbs_surface *surface, size_t n,
                                                  const double *points, double *uv,
                                                  double *distance);

/** Closest points of a curve, global as above: fills u[n] and, if not NULL, distance[n]. */
NURBS_API nurbs_status nurbs_curve_closest(const nurbs_curve *curve, size_t n, const double *points,
                                           double *u, double *distance);

#ifdef __cplusplus
}
#endif

#endif
