/**
 * @file integrals.h
 * Area, volume and moments of patches by Gauss quadrature over knot spans; volumes by the
 * divergence theorem.
 */
#ifndef NURBS_INTEGRALS_H
#define NURBS_INTEGRALS_H

#include <nurbs/patches.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Integrals over a half hull (y >= 0) that closes at y = 0 and z = level, doubled for both sides.
 */
typedef struct nurbs_hydrostatics {
    double wetted_area;       /**< m^2, both sides, without transom */
    double volume;            /**< m^3, displaced below the level */
    double centroid[3];       /**< of that volume, m; y = 0 */
    double waterplane_area;   /**< m^2 */
    double waterplane_centre; /**< x of its centroid (LCF), m */
    double waterplane_inertia_x,
        waterplane_inertia_y; /**< m^4 about the x axis, and about y through LCF */
    double beam;              /**< largest breadth at the level, m (of the body when submerged) */
    double draft;             /**< depth of the deepest point below the level, m */
    double keel_draft;    /**< depth of the keel amidships (x halfway along the waterline), m; NAN:
                               nothing lies there */
    double x_aft, x_fore; /**< ends of the waterline, m (of the body when submerged) */
    double transom_area; /**< m^2, both sides: immersed area of an open stern end, or of the patches
                            that close it (nurbs_transom_patches()); 0 without either */
    double section_area_max, section_area_max_x; /**< m^2, both sides, and where */
    double error;       /**< relative, estimated from a second quadrature order */
    double reserved[8]; /**< 0: room for members of later releases */
} nurbs_hydrostatics;

/** Wetted patches as made by nurbs_surface_wetted, or a submerged body (level above it). Patches
 * may have any orientation: those whose edges run together, within 1e-4 of the length, are turned
 * alike. Error: NURBS_ERROR_GEOMETRY if they cannot be, or enclose no volume. */
NURBS_API nurbs_status nurbs_hydrostatics_compute(size_t n, const nurbs_surface *const *wetted,
                                                  double level, nurbs_hydrostatics *result);

/** The same of a body whose patches cover both sides, each of them one side: the sum of the two
 * halves, the section of the starboard one. Error: also NURBS_ERROR_GEOMETRY for a patch that runs
 * across y = 0 by more than 1e-6 of the length. */
NURBS_API nurbs_status nurbs_hydrostatics_whole(size_t n, const nurbs_surface *const *wetted,
                                                double level, nurbs_hydrostatics *result);

/** Which of several patches close the stern: flat, facing along x, within 5 % of the length of the
 * aft end, and with an edge at the level. Their area is the immersed transom's and no part of the
 * wetted area. Fills closes[n] with 1 or 0. */
NURBS_API nurbs_status nurbs_transom_patches(size_t n, const nurbs_surface *const *wetted,
                                             double level, int *closes);

/** Area of one surface, m^2, relative error estimate in *error (NULL allowed). */
NURBS_API nurbs_status nurbs_surface_area(const nurbs_surface *surface, double *area,
                                          double *error);

/** Integrals over patches with their own orientation, n = Su x Sv. The volume is that between the
 * surface and the plane y = 0, seen along y: for a closed body with normals outwards its volume,
 * for a wetted half hull half the displacement (centre plane and waterplane carry no n_y). */
typedef struct nurbs_moments {
    double area;        /**< m^2 */
    double volume;      /**< int y n_y dS, m^3 */
    double moment[3];   /**< int (x, y, z) dV = int (x, y/2, z) y n_y dS, m^4 */
    double second[6];   /**< int (xx, yy, zz, xy, yz, zx) dV
                             = int (x^2, y^2/3, z^2, xy/2, yz/2, zx) y n_y dS, m^5 */
    double reserved[8]; /**< 0: room for members of later releases */
} nurbs_moments;

/** Number of quantities in nurbs_moments, in their order: rows of a gradient. */
#define NURBS_MOMENTS 11

/** Fills moments and, if gradient is not NULL, gradient[NURBS_MOMENTS][3 * size[0] * size[1]]: the
 * derivatives with respect to the coordinates of the control points, in the order of
 * nurbs_surface_points(). Same quadrature for both, so the gradient is exact for the sums; for a
 * polynomial patch volume and moments are exact to rounding. (The derivative of a point is the row
 * of nurbs_surface_rows().) */
NURBS_API nurbs_status nurbs_surface_moments(const nurbs_surface *surface, nurbs_moments *moments,
                                             double *gradient);

/** Sums over all patches. Quadrature is repeated with twice as many points until the two agree to
 * 1e-12 or the patch has 2e6 points (about a second).
 * @param error  fills an estimate of the absolute error of every quantity: the sum over the patches
 * of what the last two changes leave to expect, and rounding; NULL allowed */
NURBS_API nurbs_status nurbs_patches_moments(const nurbs_patches *patches, nurbs_moments *moments,
                                             nurbs_moments *error);

#ifdef __cplusplus
}
#endif

#endif
