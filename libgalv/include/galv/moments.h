/**
 * @file moments.h
 * Geometric moments of a hull grid, the quantities to append for a shape-supervised reduction.
 *
 * The solid is what lies between the hull surface and the centre plane y = 0, swept along y: the
 * half hull, closed by lines along y from the deck edge and from the transom's outline.
 */
#ifndef GALV_MOMENTS_H
#define GALV_MOMENTS_H

#include <galv/model.h>
#include <galv/status.h>

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Number of monomials x^p y^q z^r with p + q + r <= order: 1, 4, 10, 20, ... */
GALV_API size_t galv_moments_count(unsigned order);

/**
 * Moments M_pqr = integral of x^p y^q z^r over the half hull, for p + q + r <= order, ordered by p
 * + q + r, then falling p, then falling q: volume; x, y, z; xx, xy, xz, yy, ... Exact for the
 * surface of bilinear cells through the grid.
 * @param sections,girth  grid, girth fast; each >= 2
 * @param order  0..8
 * @param[out] moments  galv_moments_count(order) numbers, m^(3+p+q+r), filled. The sign is that of
 * the orientation that makes the volume positive.
 */
GALV_API galv_status galv_moments(size_t sections, size_t girth, const double *xyz, unsigned order,
                                  double *moments);

/**
 * Moments of one section: integral of y^q z^r over the area between the polygon through its points
 * and the centre line, q + r <= order, ordered by q + r, then falling q.
 * @param points  n triples, of which y and z are used; n >= 2
 * @param[out] moments  (order + 1)(order + 2)/2 numbers, m^(2+q+r), filled
 */
GALV_API galv_status galv_section_moments(size_t n, const double *points, unsigned order,
                                          double *moments);

/** What galv_moments_extra() evaluates. */
typedef struct galv_moment_set {
    size_t sections, girth;
    unsigned order;         /**< of the moments of the hull */
    unsigned section_order; /**< of the moments of sections */
    size_t section_first;   /**< moments of sections first, first + stride, ... (counted from 0; one
                               without area, as at a stem, has none to balance) */
    size_t section_stride;  /**< 0: none */
    double reserved[8];     /**< 0: room for members of later releases */
} galv_moment_set;

/** The moments of a set as appended quantities, their weights left NULL. set: borrowed, must
 * outlive them. GALV_ERROR_ARGUMENT for NULL. */
GALV_API galv_status galv_moments_extra(galv_moment_set *set, galv_extra *extra);

#ifdef __cplusplus
}
#endif

#endif
