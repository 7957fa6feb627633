/* What the configuration asks of a design, a row of a table for each constraint: what bounds it,
 * what is known of it before a design is built, and the figure that decides afterwards. */
#ifndef HULLOPT_CONSTRAINTS_H
#define HULLOPT_CONSTRAINTS_H

#include "core/evaluate.h"

enum { OUTCOME_MOST = 4 + CONFIG_MODELS_MOST + SPEEDS_MOST + 2 * PARTICULARS };

/* Limits known before a design is built: how many, and their values, <= 0 where allowed. Of a hull
 * that a command makes nothing is: all are outcomes. The second is a bayesopt_input_constraint with
 * a struct problem for its user_data. */
size_t limits_count(const struct config *config);
int limits_evaluate(void *problem, size_t d, const double *u, double *value);

/* The largest of them; infinity where they are not known. */
double limits_excess(struct problem *problem, const double *u);
/* Up to here a design is inside: steps end on limits. */
#define OUTSIDE 2e-4

/* Whether a built design keeps what decides before it is solved; else says why not. */
bool limits_kept(const struct config *config, const struct evaluation *e,
                 const struct evaluation *parent);

/* What only the solve tells: writes the bounds of every ratio to the parent that is in use, and
 * returns how many there are. */
size_t outcome_bounds(const struct config *config, double lower[OUTCOME_MOST],
                      double upper[OUTCOME_MOST]);
/* Writes as many ratios of e to the parent, and returns how many. */
size_t outcome_ratios(const struct config *config, const struct evaluation *e,
                      const struct evaluation *parent, double ratio[OUTCOME_MOST]);
/* Whether a design can be the best: evaluated, and within its bounds. The parent always is. */
bool outcome_allowed(const struct config *config, const struct evaluation *e,
                     const struct evaluation *parent);
/* The best of a list whose first is the parent; NULL when that failed too. */
const struct evaluation *outcome_best(const struct config *config, size_t n,
                                      const struct evaluation *list);

/* A constraint for people. At several speeds the figures are those of the largest ratio. */
struct constraint_figures {
    const char *name, *label, *unit;
    double scale;   /* of before and after in that unit, */
    int decimals;   /* and how many to show */
    double allowed; /* as it stands in the configuration; NAN: not constrained */
    double before, after, ratio;
    double excess; /* of the ratio over what is allowed, <= 0 where kept; NAN: not constrained */
    double change; /* ratio - 1, or the change that is bounded */
    bool kept;
    bool is_optional; /* a particular: of interest where it is constrained */
    char limit[32];   /* "±2 %", "≥ 0.2", "≤ +25 %", "none" */
};
size_t constraints_count(void);
const char *constraints_name(size_t k);
/* How many of n designs that were evaluated break constraint k; parent: the first. */
size_t constraints_violations(const struct config *config, size_t k, size_t n,
                              const struct evaluation *list);
/* Takes constraint k out of a configuration; false: it has none. */
bool constraints_drop(struct config *config, size_t k);
void constraints_figures(const struct config *config, size_t k, const struct evaluation *parent,
                         const struct evaluation *e, struct constraint_figures *figures);

#endif
