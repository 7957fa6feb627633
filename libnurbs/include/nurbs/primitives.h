/**
 * @file primitives.h
 * Bodies with exact NURBS forms, as half bodies (y >= 0) of one patch with outward normals.
 *
 * Axes: x forward, y to port, z up. Bodies of revolution and ellipsoids: centre at x = 0, axis at
 * z = -depth; u runs from the aft to the fore end (collapsed edges), v over the half girth from the
 * top to the bottom. Wigley: midship at x = 0, waterline at z = 0, u from stern to bow, v from
 * waterline to keel.
 */
#ifndef NURBS_PRIMITIVES_H
#define NURBS_PRIMITIVES_H

#include <nurbs/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Ellipsoid with semi-axes length/2, beam/2, height/2, exact: rational of degree 4 x 4, smooth in
 * its parameters, which run slower where the body is curved more; a sphere or a spheroid is the
 * case of equal axes. */
NURBS_API nurbs_status nurbs_make_ellipsoid(double length, double beam, double height, double depth,
                                            nurbs_surface **surface);

/** y = (B/2) (1 - (2x/L)^2) (1 - (z/T)^2), polynomial of degree 2 x 2, exact. */
NURBS_API nurbs_status nurbs_make_wigley(double length, double beam, double draft,
                                         nurbs_surface **surface);

#ifdef __cplusplus
}
#endif

#endif
