/* What a search lowers: C_w, or the resistance of waves or of the ship in newtons, at one speed or
 * weighted over several, by the model that sees the least gain; and what else stands beside it in a
 * search for the Pareto set. */
#ifndef HULLOPT_OBJECTIVE_H
#define HULLOPT_OBJECTIVE_H

#include "core/evaluate.h"

/* Total resistance of a design by its C_w at flow.froude, ITTC-57 and flow.form_factor, N; NAN
 * where the correlation line does not hold (Re <= 1000). length: problem_length(). */
double objective_total_resistance(const struct config *config, double length,
                                  const struct evaluation *e);

/* (1 + k) C_f at flow.froude where it is lowered, else 0. */
double objective_friction(const struct config *config, double length);

/* The parent's C_w times the ratio of the objectives of the two; NAN where either has none. */
double objective_of(const struct config *config, double length, const struct evaluation *e,
                    const struct evaluation *parent);

/* "C_w 1.5193e-03", "R_t 72.98 N", "weighted R_t 102.1 N": a value of objective_of() for people. */
void objective_print(const struct config *config, double length, double value,
                     const struct evaluation *parent, char *text, size_t size);

/* How many, objective.quantity the first of them. */
size_t objectives_count(const struct config *config);
/* What one of them is called: with its SI unit, and as it is shown, times scale. */
struct objective {
    char name[100], label[120];
    double scale;
    bool maximise;
};
void objectives_describe(const struct config *config, size_t k, struct objective *objective);
/* Its value, in SI units; NAN where there is none. The first is that of objective_of(). */
double objectives_value(const struct config *config, size_t k, double length,
                        const struct evaluation *e, const struct evaluation *parent);
/* Whether one of them is about another speed than flow.froude. */
bool objectives_ask_speeds(const struct config *config);

#endif
