/* What only the solve tells of a design: its ratios to the parent that the configuration bounds, as
 * the search is told them and as they decide which design can be the best. */
#ifndef HULLOPT_OUTCOME_H
#define HULLOPT_OUTCOME_H

#include "evaluate.h"

enum { OUTCOME_MOST = 1 + CONFIG_FROUDE_MOST };

/* Writes the bound of every ratio in use, the pressure's first, then one for each of the speeds,
 * and returns how many there are. */
size_t outcome_bounds(const struct outcome_limits *limits, size_t speeds,
                      double bound[OUTCOME_MOST]);
/* Writes as many ratios of e to the parent. */
void outcome_ratios(const struct outcome_limits *limits, const struct evaluation *e,
                    const struct evaluation *parent, double ratio[OUTCOME_MOST]);
/* Whether a design can be the best: evaluated, and within its bounds. The parent always is. */
bool outcome_allowed(const struct outcome_limits *limits, const struct evaluation *e,
                     const struct evaluation *parent);

#endif
