/* What a search may gain, before anything is searched: the problem of a descent's step over the
 * whole box, from one Jacobian at the parent. */
#ifndef HULLOPT_FORECAST_H
#define HULLOPT_FORECAST_H

#include "core/problem.h"

enum { FORECAST_SHARES = 5, FORECAST_ROWS = 32 };
/* Of the gain that the other models must see; 1: the worst of all models is the objective. */
static const double FORECAST_SHARE[FORECAST_SHARES] = {0, 0.25, 0.5, 0.75, 1};

/* Ratios of the objective to the parent's; NAN: not asked for, INFINITY: no step was found that
 * keeps the limits. */
struct forecast {
    double asked;                      /* as configured */
    double confirmed[FORECAST_SHARES]; /* with search.confirm of each share */
    double without[FORECAST_ROWS]; /* as configured, but for that row of constraints_figures() */
    size_t settings, tangents;     /* how many had their derivatives by tangents */
    size_t solves;                 /* on the coarse mesh, for the others */
};

bool forecast_run(struct problem *problem, struct forecast *forecast);

/* Fills u[n x modes] with designs to begin a search of another kind with: where the model of one
 * step, at the original, promises most about points all over the box, within all limits by it. */
bool forecast_design(struct problem *problem, size_t n, double *u);

#endif
