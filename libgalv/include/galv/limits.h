/**
 * @file limits.h
 * What is known of a latent point before its hull is built: half breadths, the entrance of its
 * waterline and its volume, each in microseconds, so that a search may ask thousands of times
 * before it builds one hull.
 *
 * Grids are structured: `sections` sections along x of `girth` points each, girth fast, of the half
 * y >= 0; z up, z = 0 the still water.
 */
#ifndef GALV_LIMITS_H
#define GALV_LIMITS_H

#include <galv/model.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Volume below z = 0 of both sides: twice the integral of y over the projection on the centre
 * plane, cells taken as two triangles. Negative for a grid of the other orientation (with x along
 * the sections and the girth downwards it is positive).
 * @param xyz  sections x girth triples, m
 * @param[out] volume  m^3, filled
 */
GALV_API galv_status galv_grid_volume(size_t sections, size_t girth, const double *xyz,
                                      double *volume);

/**
 * Entrance of the waterline, largest |nu_x| of its normal: the sine of the angle between the
 * waterline and the centre plane. Taken piece by piece between the sections that cross z = 0.
 * @param most  pieces steeper than this (by more than 1 %) belong to a round stem and do not count;
 *              1: all count
 * @param[out] entrance  0..1, filled
 * @return GALV_ERROR_GEOMETRY when fewer than two sections cross z = 0.
 */
GALV_API galv_status galv_grid_entrance(size_t sections, size_t girth, const double *xyz,
                                        double most, double *entrance);

/** Limits of the latent points of a model whose points are a grid. Immutable but for the gradient,
 * so several threads may use one. */
typedef struct galv_limits galv_limits;

/**
 * @param model   borrowed, must outlive the limits; its points are the grid
 * @param most    as in galv_grid_entrance(), of the parent: what belongs to its stem never counts
 * @param[out] limits created
 * @return GALV_ERROR_ARGUMENT when the model has other than sections x girth points,
 * GALV_ERROR_GEOMETRY when the parent has no volume. A parent that crosses z = 0 nowhere has no
 * entrance: its ratio is 1.
 */
GALV_API galv_status galv_limits_create(const galv_model *model, size_t sections, size_t girth,
                                        double most, galv_limits **limits);
/** NULL is allowed. */
GALV_API void galv_limits_free(galv_limits *limits);

/**
 * What becomes of the half breadths.
 * @param u  m latent coordinates
 * @param[out] least  least y of the moved points, m; negative: across the centre plane
 * @param[out] share  least y over the parent's, of the points below z = 0 and off the centre plane;
 * infinity without such points. Either may be NULL.
 */
GALV_API galv_status galv_limits_breadth(const galv_limits *limits, const double *u, double *least,
                                         double *share);

/** Entrance of the moved waterline over that of the parent, outside the stem of the parent: between
 * those sections that cross z = 0 in the parent and still do. */
GALV_API galv_status galv_limits_entrance(const galv_limits *limits, const double *u,
                                          double *ratio);

/** How far the surface turns: the least cosine between the normals of a cell of the grid before and
 * after. Below 0 a cell lies on its back, and the moved grid is folded. 1 where points move along y
 * alone, which is not looked at. */
GALV_API galv_status galv_limits_turn(const galv_limits *limits, const double *u, double *least);

/** Volume over that of the parent. Where points move along y alone: 1 + g u with a gradient g, else
 * that of the moved grid. Where they move along x or z too: that of the moved grid, and with a
 * gradient what is lacking to g of the grid's own slope at the parent, times u. */
GALV_API galv_status galv_limits_volume(const galv_limits *limits, const double *u, double *ratio);

/** The volume, m^3, of the hull built on moved points (3 per point); NaN when it cannot be built.
 */
typedef double (*galv_built_volume)(void *user_data, const double *moved);

/**
 * Finds the gradient of the volume ratio. Points that move along y alone leave the projection of
 * the hull on the centre plane as it is: the volume is then linear in u but for how the hull is
 * built on the points. Central differences over a quarter of the latent box, of the hulls as they
 * are built; of the grid where one cannot be built.
 * @param volume     called 2 m + 1 times
 * @param user_data  borrowed for the call
 */
GALV_API galv_status galv_limits_linearise(galv_limits *limits, galv_built_volume volume,
                                           void *user_data);

/** The gradient (m numbers), borrowed; NULL: there is none. */
GALV_API const double *galv_limits_gradient(const galv_limits *limits);

/** Gives the limits a gradient that was found earlier: m finite numbers, copied. */
GALV_API galv_status galv_limits_set_gradient(galv_limits *limits, const double *gradient);

#ifdef __cplusplus
}
#endif

#endif
