/* How steeply the waterline of a latent point runs to the stream, before it is built. The solver's
 * short-wave filter and stem limiter are set once, on the parent: they hold for hulls whose
 * waterline is about as fine. */
#ifndef HULLOPT_ENTRANCE_H
#define HULLOPT_ENTRANCE_H

#include "latent.h"

#include <nurbs/grid.h>

#include <stdbool.h>
#include <stddef.h>

/* Where the sections of the design grid cross z = 0: share[i] of the way from point above[i] to
 * below[i]. */
struct entrance {
    const nurbs_grid *grid;
    size_t n;
    size_t *above, *below;
    double *share;
    bool *counts;   /* [n - 1]: the piece between sections i and i + 1 is not in a stem arc */
    double largest; /* |nu_x| over those pieces of the parent */
};

/* nu_s: the largest |nu_x| of the parent outside stem arcs, as the solver has it; a piece of the
 * parent's waterline above it belongs to an arc. Borrows the grid. */
bool entrance_create(const nurbs_grid *grid, double nu_s, struct entrance *entrance);
void entrance_free(struct entrance *entrance);

/* The built hull is a spline through the moved points and its nu_s is taken between them: it may be
 * above the limit by this factor. */
#define ENTRANCE_SLACK 1.05

/* Largest |nu_x| of the moved waterline outside the parent's stem arcs, over that of the parent. */
double entrance_ratio(const struct entrance *entrance, const struct latent *latent,
                      const double *u);

#endif
