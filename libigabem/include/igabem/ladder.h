/**
 * @file ladder.h
 * The same solve on finer and finer meshes: which ones, and what the sequence says of its limit.
 */
#ifndef IGABEM_LADDER_H
#define IGABEM_LADDER_H

#include <igabem/solve.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Sets refine and refine_v to those of a level: level 0 leaves options as they are, each further
 * one is half as fine again as the one before, at least by one part; surface_cells and
 * surface_rows likewise where they are not 0. */
IGABEM_API void igabem_ladder_level(size_t level, igabem_options *options);

/** Unknowns for igabem_options_refine() on level 0 of a ladder of so many levels, so that the last
 * level but one has the 400 of a single solve. */
IGABEM_API size_t igabem_ladder_unknowns(size_t levels);

/** Observed order p of c_k = c + a h_k^p through three values on mesh widths that decrease, and
 * Richardson's c (Roache 1994). NAN, both, where the values fit no such law with 0.02 < p < 19.9:
 * differences of opposite sign, or growing.
 * @param h three mesh widths, h[0] > h[1] > h[2] > 0; any unit, 1/refine will do
 * @param c three values
 * @param order,limit (fill)
 * Errors: IGABEM_ERROR_ARGUMENT: widths that do not decrease or are not positive. */
IGABEM_API igabem_status igabem_ladder_order(const double h[3], const double c[3], double *order,
                                             double *limit);

#ifdef __cplusplus
}
#endif

#endif
