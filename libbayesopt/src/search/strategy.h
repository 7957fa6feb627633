/* Which point comes next. */
#ifndef BAYESOPT_STRATEGY_H
#define BAYESOPT_STRATEGY_H

#include "problem/internal.h"

/* initial.c: points told before the first ask that take places of the initial design, which are the
 * first ones; row i of the design in both units. */
size_t initial_told(const struct bayesopt *bo);
bayesopt_status initial_point(struct bayesopt *bo, size_t i, double *u, double *x);

/* The next point in [0,1]^d, as proposal number id. */
bayesopt_status strategy_propose(struct bayesopt *bo, uint64_t id, double *u, bayesopt_phase *phase,
                                 int *level);
double strategy_trust_length(const struct bayesopt *bo);

#endif
