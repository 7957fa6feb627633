/**
 * @file section.h
 * Planes through surfaces: where a hull meets the still water, and the wetted hull below it.
 */
#ifndef NURBS_SECTION_H
#define NURBS_SECTION_H

#include <nurbs/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The part of a hull below z = level as one surface with v = 0 exactly on the waterline.
 *
 * Every section (u = constant) is cut where it crosses the level, re-parametrised from there to the
 * lower end of the section, and the cut sections are skinned again on common knots. The wetted
 * surface runs along the same u (interior u knots kept), v from the waterline (v = 0, z = level
 * exactly) to the keel (v = 1). Edges in the plane y = 0 stay in it exactly and y never becomes
 * negative on a half hull. Sections of u that do not reach the level at an end of the hull (an
 * overhanging bow or stern) are left out: the surface then starts where the profile meets the
 * level. A half hull that reaches across the centre plane is lifted first, by
 * nurbs_surface_raise_side(). Errors (with the place): NURBS_ERROR_GEOMETRY: the hull does not
 * cross the level, a section crosses it more than once, or the surface is folded;
 * NURBS_ERROR_NUMERIC: the tolerance cannot be kept.
 * @param tolerance  metres; how far the cut surface may lie from the (lifted) original, measured
 *                   after the last step on 7 x 7 places a span (1e-5 of the length)
 */
NURBS_API nurbs_status nurbs_surface_wetted(const nurbs_surface *hull, double level,
                                            double tolerance, nurbs_surface **wetted);

/** Checks for folds: the normal Su x Sv must not reverse against its neighbours. Fills the first
 * place (u,v) if there is one and returns NURBS_ERROR_GEOMETRY; uv may be NULL. */
NURBS_API nurbs_status nurbs_surface_check_fold(const nurbs_surface *surface, double uv[2]);

/** A half hull lifted onto y >= 0: where the surface lies across the centre plane, control points
 * near that place move by the least change that brings it back; edges in y = 0 and everything else
 * stay. That no place is left is proved by Bernstein coefficients, to 1e-12 of the breadth.
 * Polynomial surfaces only.
 * @param moved  fills the largest change of a control point in metres, a bound of the surface's
 *               change; NULL allowed */
NURBS_API nurbs_status nurbs_surface_raise_side(const nurbs_surface *surface,
                                                nurbs_surface **result, double *moved);

/** Lines in which a surface meets a plane, as points that lie on both. */
typedef struct nurbs_contour {
    size_t lines;       /**< number of lines */
    size_t *first;      /**< [lines + 1]: line k has the points first[k] ... first[k + 1] - 1 */
    double *points;     /**< x,y,z triples */
    double *uv;         /**< their parameters, pairs */
    double reserved[8]; /**< 0: room for members of later releases */
} nurbs_contour;

/** Fills the lines where normal . p = offset. The surface is searched on `parts` x `parts` cells a
 * knot span (1 to 64; 0: 128 a direction, at least 6 a span): smaller islands are missed; the
 * points on the cells' edges are found to rounding. A closed line repeats its first point. A plane
 * that only touches gives no line. Complexity: evaluation of all cells' corners. */
NURBS_API nurbs_status nurbs_surface_contour(const nurbs_surface *surface, const double normal[3],
                                             double offset, int parts, nurbs_contour *contour);
/** Frees the arrays; the struct itself is the caller's. */
NURBS_API void nurbs_contour_free(nurbs_contour *contour);

#ifdef __cplusplus
}
#endif

#endif
