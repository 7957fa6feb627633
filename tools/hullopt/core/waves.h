/* Wave patterns of the parent and the optimum on one half of the free surface, kept with the run so
 * that the report can be drawn again without a solve. */
#ifndef HULLOPT_WAVES_H
#define HULLOPT_WAVES_H

#include "core/record.h"

/* nx x ny points, x slow: x[i] = x0 + i dx, y[j] = y0 + j dy; elevations in metres, NAN inside the
 * hull. */
struct waves {
    size_t nx, ny;
    double x0, dx, y0, dy;
    double *elevation;
};

/* Computes both patterns unless the record holds them; without a best design the parent's alone. */
bool waves_run(const struct problem *problem, struct record *record,
               const struct core_watch *watch);

/* Of the parent or the best; elevation is NULL when it is not there. Free it. */
bool waves_read(const struct record *record, bool best, struct waves *waves);

#endif
