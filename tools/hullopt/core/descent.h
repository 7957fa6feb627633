/* The Gauss-Newton search of a run: designs by their wave residuals and velocities. */
#ifndef HULLOPT_DESCENT_H
#define HULLOPT_DESCENT_H

#include "core/search.h"

/* Runs until nothing is gained or search.iterations designs are valued, and writes "stop". u: room
 * for a latent point. A run that was interrupted repeats its steps; designs that are on record are
 * not told again. */
bool descent_run(struct search *search, double *u);

/* What derivatives cost: seconds of one solve on the mesh of the differences, here of the original,
 * of the settings that are differenced (0: none is; NAN: there is no value), and solves on the mesh
 * of the values that those by tangents are worth (0: there are none). sideways: points move along y
 * alone, else all settings are differenced. */
void descent_cost(const struct problem *problem, bool sideways, double *coarse_seconds,
                  double *solves);

#endif
