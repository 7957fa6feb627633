/* Figures of a design by its grid, before it is built: what a configuration may bound by name. */
#ifndef HULLOPT_CORE_PARTICULARS_H
#define HULLOPT_CORE_PARTICULARS_H

#include "core/problem.h"

/* One row of a table in particulars.c each; the order is that of config.particular. */
enum particular {
    PARTICULAR_SURFACE,
    PARTICULAR_BEAM,
    PARTICULAR_LCB,
    PARTICULAR_KM,
    PARTICULAR_GM,
    PARTICULAR_MIDSHIP,
    PARTICULAR_WATERPLANE,
    PARTICULAR_TRANSOM_BREADTH,
    PARTICULAR_TRANSOM_DEPTH,
    PARTICULAR_WATERLINES,
    PARTICULAR_SECTIONS,
    PARTICULAR_RADIUS,
    PARTICULAR_WATERLINES_ENERGY,
    PARTICULAR_SECTIONS_ENERGY,
    PARTICULAR_WATERLINES_INFLECTIONS,
    PARTICULAR_SECTIONS_INFLECTIONS,
    PARTICULAR_STATIONS,
    PARTICULAR_HARD,
    PARTICULAR_BOXES
};
_Static_assert(PARTICULAR_BOXES + 1 == PARTICULARS, "config.h has their number");

struct particular_row {
    const char *key, *label, *unit;
    int decimals;
    bool shift; /* what is bounded is the difference to the parent, else the ratio */
};
const struct particular_row *particular_row(enum particular p);

/* The figures of the points of a grid. Those at several places (stations, hard points,
 * boxes) are the least and the greatest of their ratios to the parent; for all others value[0] and
 * value[1] are the same. all: also those that nobody bounds, else NAN there. False for points
 * without a hull. */
bool particulars_of(const struct problem *problem, const double *points, bool all,
                    double value[PARTICULARS][2]);

#endif
