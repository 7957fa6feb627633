/* The Pareto set of a run with several objectives. */
#ifndef HULLOPT_FRONT_H
#define HULLOPT_FRONT_H

#include "core/record.h"

/* Fills the places [n] in a list of record_evaluations() of the designs of which none is better in
 * one objective without being worse in another, by increasing first objective. */
bool front_of(const struct record *record, size_t n, const struct evaluation *list, size_t *count,
              size_t *places);

/* The design that stands for a run: outcome_best(), or of several objectives that of the front
 * nearest to the best of each, by the range of each over the front; the parent only when nothing
 * else is there. *best NULL: the parent failed, and nothing else is there. */
bool front_best(const struct record *record, const struct config *config, double length, size_t n,
                const struct evaluation *list, const struct evaluation **best);

#endif
