/**
 * @file offsets.h
 * Offset tables and station files as naval architects type them, read into a grid for nurbs_skin().
 *
 * An offset table is CSV with # comments and blank lines anywhere. First come settings, one a line:
 *
 *     length,<Lpp in metres>          draft,<m>            breadth,<m>         (told, not used)
 *     x_origin,<m>  x_scale,<m per station unit>    x = x_origin + x_scale * station
 *     y_scale,<m>                                   y = y_scale * entry
 *     z_origin,<m>  z_scale,<m>                     z = z_origin + z_scale * waterline
 *
 * with origins 0 and scales 1 where they are not given. Then the header
 *
 *     station,<waterline>,<waterline>,...
 *
 * whose waterlines may stand in any order; columns may also be called keel (height of the keel
 * there, in waterline units), deck_z and deck_y (deck edge), knuckle_z and knuckle_y. Then one line
 * a station in any order: its number, and half breadths. An empty entry is a reading that is not
 * there: above the deck, below the keel, or not taken. Two kinds of lines more, anywhere behind the
 * header:
 *
 *     max,<value>,...     entries of a column are shares of this value
 *     stem,<station>,...  and  stern,<station>,...
 *
 * The last two give the profile of the ends: where each waterline has half breadth 0, in station
 * units. Where such an entry is empty the end is open there (a transom), as broad as the outermost
 * station; without the line that station is the end. A profile that touches the outermost station
 * on the centre line takes its place.
 */
#ifndef NURBS_OFFSETS_H
#define NURBS_OFFSETS_H

#include <nurbs/grid.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a table says of itself. */
typedef struct nurbs_offsets_info {
    size_t sections;               /**< rows of the grid, profiles of the ends included */
    size_t chine;                  /**< column of the knuckle, for nurbs_skin_options; 0: none */
    double length, breadth, draft; /**< as set in the file; 0: not given */
    double reserved[8];            /**< 0: room for members of later releases */
} nurbs_offsets_info;

/** Reads an offset table.
 *
 * Every section runs from its deck edge (or highest entry) through its entries to the centre line
 * at the keel (or lowest entry): shape-preserving cubics (Fritsch and Carlson, 1980) over the chord
 * length, so that what is flat stays flat and nothing overshoots; a knuckle breaks them. Each is
 * sampled at equal shares of its length, above and below the knuckle separately. Rows run from
 * small to large x, columns from deck to keel.
 * @param columns  of the grid, 4 or more; 0: four for every waterline, at least 40
 * @param info     NULL: not wanted
 * Errors name the line. */
NURBS_API nurbs_status nurbs_offsets_read(const char *path, size_t columns, nurbs_grid **grid,
                                          nurbs_offsets_info *info);

/** Reads a station file: lines with one number, x of a station, each followed by lines with two, y
 * and z of its points in order, from deck to keel or from keel to deck; commas or blanks between
 * numbers, # comments. Sections as above; the points' ends are kept, not drawn to the centre line.
 */
NURBS_API nurbs_status nurbs_stations_read(const char *path, size_t columns, nurbs_grid **grid);

/** Reads the sections that an IGES file holds as curves (nurbs_curves_read_iges()): those that keep
 * within 5 % of the length in x, in any order and direction. Pieces whose ends meet within 1e-4 of
 * the length are one section; of sections from side to side the port half is taken, sections to
 * starboard alone are mirrored. Points of polylines are joined by cubics as above; corners of other
 * curves are passed at equal shares of the length.
 * @param left_out  fills the number of other curves, as waterlines and profiles; NULL: not wanted
 * Errors: NURBS_ERROR_GEOMETRY: fewer than two sections, pieces of one that do not meet. */
NURBS_API nurbs_status nurbs_sections_read_iges(const char *path, size_t columns, nurbs_grid **grid,
                                                size_t *left_out);

#ifdef __cplusplus
}
#endif

#endif
