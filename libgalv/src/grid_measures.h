/* Volume and waterline of a structured grid, in the pieces that limits.c shares. */
#ifndef GALV_GRID_MEASURES_H
#define GALV_GRID_MEASURES_H

#include <galv/limits.h>

/* Adds the integral of y over the wet part of the cell whose corners are a point of one section, a
 * point of the next, and those that follow them along the girth. */
void galv_add_cell(const double *point, const double *next, double *sum);

/* The corners of the part of a triangle at z <= 0: returns how many, up to four. */
size_t galv_wet_polygon(const double *const corner[3], double polygon[4][3]);

/* A grid with cells, all its numbers finite. */
galv_status galv_grid_check(size_t sections, size_t girth, const double *xyz);

/* Where the sections cross z = 0: share[i] of the way from point above[i] to below[i]. */
typedef struct galv_crossings {
    size_t n;
    size_t *above, *below;
    double *share;
} galv_crossings;

galv_status galv_crossings_find(size_t sections, size_t girth, const double *xyz,
                                galv_crossings *crossings);
void galv_crossings_free(galv_crossings *crossings);

/* x and y at z = 0 between two points. */
void galv_crossing_at(double share, const double *above, const double *below, double xy[2]);

/* |nu_x| of the piece between two points of the waterline; 0 without length. */
double galv_piece_slope(const double a[2], const double b[2]);

/* The parent's waterline runs between points: a piece may be this much above the limit. */
#define GALV_STEM_SLACK 1.01

#endif
