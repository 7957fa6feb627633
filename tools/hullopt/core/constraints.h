/* What the configuration asks of a design: limits that are known of a latent point before it is
 * built, and ratios to the parent that only the solve tells. */
#ifndef HULLOPT_CONSTRAINTS_H
#define HULLOPT_CONSTRAINTS_H

#include "core/evaluate.h"

enum { OUTCOME_MOST = 1 + CONFIG_FROUDE_MOST };

/* The built hull is a spline through the moved points and its nu_s is taken between them: it may be
 * above the limit by this factor. */
#define ENTRANCE_SLACK 1.05

/* Limits known before a design is built: how many, and their values, <= 0 where allowed. The second
 * is a bayesopt_input_constraint with a struct problem for its user_data. */
size_t limits_count(const struct config *config);
int limits_evaluate(void *problem, size_t d, const double *u, double *value);

/* Writes the bound of every ratio in use, the pressure's first, then one for each of the speeds,
 * and returns how many there are. */
size_t outcome_bounds(const struct config *config, double bound[OUTCOME_MOST]);
/* Writes as many ratios of e to the parent. */
void outcome_ratios(const struct config *config, const struct evaluation *e,
                    const struct evaluation *parent, double ratio[OUTCOME_MOST]);
/* Whether a design can be the best: evaluated, and within its bounds. The parent always is. */
bool outcome_allowed(const struct config *config, const struct evaluation *e,
                     const struct evaluation *parent);
/* The best of a list whose first is the parent; NULL when that failed too. */
const struct evaluation *outcome_best(const struct config *config, size_t n,
                                      const struct evaluation *list);

#endif
