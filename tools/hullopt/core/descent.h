/* The Gauss-Newton search of a run: designs by their wave residuals and velocities, on a coarse
 * mesh for the derivatives. */
#ifndef HULLOPT_DESCENT_H
#define HULLOPT_DESCENT_H

#include "core/search.h"

/* Runs until nothing is gained or search.iterations designs are valued, and writes "stop". u: room
 * for a latent point. A run that was interrupted repeats its steps; designs that are on record are
 * not told again. */
bool descent_run(struct search *search, double *u);

#endif
