/**
 * @file hull.h
 * The wetted body as the solver sees it: NURBS patches with outward normals, their waterline, their
 * hydrostatics and the waterline figures that the formulation needs.
 *
 * Axes: x forward (the body advances towards +x, stream -U e_x), y to port, z up, z = 0 the still
 * water.
 */
#ifndef IGABEM_HULL_H
#define IGABEM_HULL_H

#include <igabem/status.h>
#include <nurbs/hull.h>
#include <nurbs/integrals.h>
#include <nurbs/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct igabem_hull igabem_hull;

enum {
    IGABEM_SYMMETRIC = 1 /**< patches cover y >= 0 only; the other side is their mirror image */
};

/** Creates a hull; copies the patches, turns their normals outwards, finds the edges on z = 0, y =
 * 0, collapsed edges and the transom. Patches may have any orientation and knots of their own on
 * either side of an edge, and one edge may meet several (a T junction); edges within 1e-4 of the
 * length of each other run together. Without IGABEM_SYMMETRIC no patch may cross the centre plane.
 * Errors (IGABEM_ERROR_GEOMETRY, with patch and place): a patch above z = 0 (clearance 1e-6 of the
 * length), y < 0 on a symmetric half, a fold, a normal that vanishes inside a patch, an edge that
 * is open elsewhere than at the stern, patches that no orientation suits or that overlap (three at
 * an edge, two at the waterline, no volume enclosed). */
IGABEM_API igabem_status igabem_hull_create(const nurbs_surface *const *patches, size_t n,
                                            unsigned flags, igabem_hull **hull);

/** The same from the light surfaces of a hull read or rebuilt by libnurbs (nurbs/hull.h), with its
 * reference length; copies them. Errors as above. */
IGABEM_API igabem_status igabem_hull_from(const nurbs_hull *source, igabem_hull **hull);
/** Frees a hull; takes NULL. */
IGABEM_API void igabem_hull_free(igabem_hull *hull);

/** Reference length of Froude number and coefficients, m; default: waterline length, or the body's
 * length when submerged. */
IGABEM_API igabem_status igabem_hull_set_length(igabem_hull *hull, double length);

/** How an immersed stern ends. */
typedef enum igabem_transom {
    IGABEM_TRANSOM_NONE,
    IGABEM_TRANSOM_OPEN,  /**< a free edge at the stern: no face there */
    IGABEM_TRANSOM_CLOSED /**< by a flat face of its own (nurbs_transom_patches()) */
} igabem_transom;

/** What is known of the hull before any solve. */
typedef struct igabem_hull_info {
    double length;                   /**< reference length, m */
    nurbs_hydrostatics hydrostatics; /**< at z = 0 */
    int surface_piercing;            /**< has an edge on z = 0 */
    int transom;                     /**< igabem_transom */
    double nu_s; /**< largest |x component| of the waterline normal outside stem arcs */
    size_t patches;
    double reserved[8]; /**< 0: room for members of later releases */
} igabem_hull_info;

/** Fills info; with zeros for a hull that is NULL. */
IGABEM_API void igabem_hull_get_info(const igabem_hull *hull, igabem_hull_info *info);

/** What its user must know of a hull before any solve, sentence by sentence: a closed transom, a
 * full waterline entrance, a reference length that is not the hull's. NULL from the first number on
 * that has none. Borrowed: valid until the next such call of this thread. */
IGABEM_API const char *igabem_hull_warning(const igabem_hull *hull, size_t number);

#ifdef __cplusplus
}
#endif

#endif
