/* Wave patterns of the parent and the optimum on one half of the free surface, kept with the run so
 * that the report can be drawn again without a solve. */
#ifndef HULLOPT_WAVES_H
#define HULLOPT_WAVES_H

#include "evaluate.h"
#include "store.h"

/* nx x ny points, x slow: x[i] = x0 + i dx, y[j] = y0 + j dy; elevations in metres, NAN inside the
 * hull. */
struct waves {
    size_t nx, ny;
    double x0, dx, y0, dy;
    double *elevation;
};

/* Computes both patterns unless the store holds them. best NULL: the parent alone. */
bool waves_run(const struct config *config, struct evaluator *evaluator, const double *best,
               struct store *store);

/* which: "parent" or "best"; false when it is not there. Free waves->elevation. */
bool waves_load(struct store *store, const char *which, struct waves *waves);

#endif
