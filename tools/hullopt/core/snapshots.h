/* A latent space of hulls that a command made, and the way back from it to the command's
 * parameters. */
#ifndef HULLOPT_SNAPSHOTS_H
#define HULLOPT_SNAPSHOTS_H

#include "core/evaluate.h"

/* Runs the command for parameters.snapshots points of a Latin hypercube, and finds the latent space
 * of the hulls that it made, with problem.map. */
bool snapshots_reduce(struct problem *problem, const galv_options *options,
                      const struct core_watch *watch, galv_model **model);

/* Fills problem.back from problem.map: the least parameters of each latent coordinate. */
bool snapshots_invert(struct problem *problem);

/* How far those of a latent point are beyond their ends, in halves of their ranges, <= 0 inside:
 * the box of a latent space holds hulls that the command cannot make. Returns how many values there
 * are, none of other families. */
size_t snapshots_excess(const struct problem *problem, const double *u, double *value);

/* The hull of the command that is nearest to that of a latent point. */
struct snapshots_match {
    double *x;              /* [n_parameters] as the command takes them */
    double residual;        /* root mean square of the distances of the grid's points, m */
    char made[CONFIG_PATH]; /* file of the hull */
    double cw;              /* of that hull; NAN: it cannot be solved */
};
/* By secant steps from the map of the snapshots, a run of the command each, STEPS at most. */
bool snapshots_match(struct problem *problem, const double *u, struct snapshots_match *match);

#endif
