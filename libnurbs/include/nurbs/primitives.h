/**
 * @file primitives.h
 * Bodies with exact NURBS forms, as half bodies (y >= 0) of one patch with outward normals, and
 * ships made of a dozen numbers.
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

/** A ship by numbers. Axes: x from the transom (0) to the stem (length), z = 0 the still water. */
typedef struct nurbs_ship_form {
    double length, beam, draft; /**< m */
    double fullest;       /**< place of the greatest beam, share of the length from aft, (0, 1) */
    double transom_beam;  /**< share of the beam, 0 to 1 */
    double transom_draft; /**< share of the draft, 0 to 1 */
    double run;           /**< the keel rises aft of this share of the length, > 0 */
    double entrance;      /**< exponent of the waterline forward of the greatest beam, > 0 */
    double section[3];    /**< superellipse exponents of the sections: aft, middle, bow; > 0 */
    double rake;          /**< forefoot behind the stem, share of the length */
    double bulb_length; /**< reach ahead of the stem at the waterline, share of the length, >= 0 */
    double bulb_beam;   /**< half breadth of the bulb, share of the beam, >= 0 */
    double reserved[8]; /**< 0: room for members of later releases */
} nurbs_ship_form;

/** Fill the numbers of a fast round-bilge form with a wide immersed transom, and of a bulbous bow
 * over a narrow one. */
NURBS_API nurbs_status nurbs_ship_form_fast(double length, double beam, double draft,
                                            nurbs_ship_form *form);
/** Fills the numbers of a ship with a bulbous bow and a narrow transom. */
NURBS_API nurbs_status nurbs_ship_form_bulb(double length, double beam, double draft,
                                            nurbs_ship_form *form);

/** Creates the wetted half (y >= 0) as one bicubic patch, u from stern to bow, v from the waterline
 * to the keel: control points are the form at the Greville abscissae (Schoenberg's
 * variation-diminishing spline), so that no side of the form overshoots y = 0 or z = 0. Errors:
 * NURBS_ERROR_ARGUMENT with the number out of its range. */
NURBS_API nurbs_status nurbs_make_ship(const nurbs_ship_form *form, nurbs_surface **surface);

#ifdef __cplusplus
}
#endif

#endif
