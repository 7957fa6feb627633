/**
 * @file geometry.h
 * Normals and curvatures of curves and surfaces. Source: do Carmo, Differential Geometry of Curves
 * and Surfaces, chapters 1 and 3. No allocation.
 */
#ifndef NURBS_GEOMETRY_H
#define NURBS_GEOMETRY_H

#include <nurbs/curve.h>
#include <nurbs/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Unit normals Su x Sv / |Su x Sv| at n parameter pairs: fills normals[n][3]. Where an edge has
 * collapsed to a point the limit from inside the patch along that parameter line, from second
 * derivatives. Errors: uv outside the domain; NURBS_ERROR_GEOMETRY where even the limit does not
 * exist (the place is named). */
NURBS_API nurbs_status nurbs_surface_normals(const nurbs_surface *surface, size_t n,
                                             const double *uv, double *normals);

/** Curvatures in 1/m, positive where the surface bends towards its normal: fills out[n][4] with the
 * mean, the Gaussian and the two principal curvatures (smaller first). Errors as above, and where
 * Su x Sv = 0. */
NURBS_API nurbs_status nurbs_surface_curvatures(const nurbs_surface *surface, size_t n,
                                                const double *uv, double *out);

/** Curvature (>= 0, 1/m) and torsion (1/m, 0 where the curvature is) at n parameters: fills
 * out[n][2]. Error: NURBS_ERROR_GEOMETRY where C' = 0. */
NURBS_API nurbs_status nurbs_curve_curvatures(const nurbs_curve *curve, size_t n, const double *u,
                                              double *out);

#ifdef __cplusplus
}
#endif

#endif
