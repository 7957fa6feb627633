/**
 * @file particulars.h
 * Particulars and fairness of a hull by its grid, in microseconds: what a search may ask before a
 * hull is built. Grids as in limits.h.
 */
#ifndef GALV_PARTICULARS_H
#define GALV_PARTICULARS_H

#include <galv/limits.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How a set of plane curves bends. Sums over polygons: the turn is the angle between two pieces,
 * taken without sign, so that of a convex curve it is the difference of its end slopes and every
 * inflection adds. */
typedef struct galv_fairness {
    double turning;     /**< sum of the turns, rad */
    double energy;      /**< integral of the squared curvature, 1/m */
    double radius;      /**< least radius of curvature, m; infinity for straight lines */
    double inflections; /**< changes of the turn's sign, turns below 1e-3 rad left out */
    double reserved[8]; /**< 0: room for members of later releases */
} galv_fairness;

/** Particulars below z = 0, both sides, m. Cells are two triangles each, sections and waterlines
 * polygons, so areas and volumes are low by O(h^2): ratios of two grids are good to far more than
 * the figures. */
typedef struct galv_particulars {
    double volume;             /**< m^3, magnitude */
    double lcb, vcb;           /**< x and z of its centre */
    double wetted_area;        /**< m^2, without transom */
    double waterplane_area;    /**< m^2 */
    double waterplane_inertia; /**< about the centre line, m^4 */
    double beam;               /**< of the waterline */
    double draft;              /**< of the deepest point */
    double section_area;       /**< of the largest section, m^2 */
    double transom_beam;       /**< at z = 0, of the section farthest aft */
    double transom_draft;      /**< of the same section; 0 above the water */
    double reserved[8];        /**< 0: room for members of later releases */
} galv_particulars;

/**
 * @param xyz  sections x girth triples, m
 * @param[out] particulars  filled
 * @return GALV_ERROR_GEOMETRY without volume below z = 0, or with fewer than two sections that
 * cross it. Complexity O(sections girth).
 */
GALV_API galv_status galv_grid_particulars(size_t sections, size_t girth, const double *xyz,
                                           galv_particulars *particulars);

/**
 * @param xyz  sections x girth triples, m
 * @param[out] waterlines  of those at z = 0 and at four levels down to 0.8 of the deepest point;
 * filled
 * @param[out] stations    of the wet parts of all sections; filled. Either may be NULL.
 * Complexity O(sections girth).
 */
GALV_API galv_status galv_grid_fairness(size_t sections, size_t girth, const double *xyz,
                                        galv_fairness *waterlines, galv_fairness *stations);

/** Half breadth at a station x and a level z, linear between the points; NaN where the hull has
 * none or the grid is refused. */
GALV_API double galv_grid_half_breadth(size_t sections, size_t girth, const double *xyz, double x,
                                       double z);

#ifdef __cplusplus
}
#endif

#endif
