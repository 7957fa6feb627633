/* The Gauss-Newton search of a run: designs by their wave residuals and velocities, on a coarse
 * mesh for the derivatives. */
#ifndef HULLOPT_DESCENT_H
#define HULLOPT_DESCENT_H

#include "core/search.h"

/* Runs until nothing is gained or search.iterations designs are valued, and writes "stop". u: room
 * for a latent point. A run that was interrupted repeats its steps; designs that are on record are
 * not told again. */
bool descent_run(struct search *search, double *u);

/* Fills u[n x modes] with designs to begin a search of another kind with: where the model of one
 * step, at the original, promises most about points all over the box, within all limits by it. */
bool descent_design(struct problem *problem, size_t n, double *u);

/* Seconds of one solve on the mesh of the derivatives, here of the original; NAN: there is none. */
double descent_coarse_seconds(const struct problem *problem);

#endif
