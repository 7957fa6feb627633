/* Does another model see the gain? The optimum beside the parent in every other formulation, at a
 * finer resolution, with the short-wave filter that its own waterline asks for, and at other
 * speeds. */
#ifndef HULLOPT_VERIFY_H
#define HULLOPT_VERIFY_H

#include "evaluate.h"
#include "store.h"

enum { VERIFY_MOST = 24 };

/* The rows of a verification with their settings; results NAN. speeds: the options at each of
 * config->verify_froude. Returns how many. */
size_t verify_plan(const struct config *config, const igabem_options *frozen,
                   const igabem_options *speeds, struct verification rows[VERIFY_MOST],
                   igabem_options options[VERIFY_MOST]);

/* Solves what the store does not hold yet, a row at a time. best NULL: the parent is the best. */
bool verify_run(const struct config *config, struct evaluator *evaluator, const double *best,
                struct store *store);

/* What the rows say together. */
struct verdict {
    double claimed;    /* reduction that the objective sees, share of the parent's C_w */
    size_t models;     /* other formulations and stern lengths with a result */
    size_t confirm;    /* of these: at least half of the claimed reduction */
    size_t partly;     /* some reduction, less than half of the claimed one */
    size_t deny;       /* none, or an increase */
    bool formulations; /* most confirm and none denies */
    bool resolution;   /* the finer solve keeps at least 80 % of the reduction */
    bool speeds;       /* no increase at another speed */
    bool filter;       /* with a filter by the rule on each hull, not the parent's, half remains */
    bool has_resolution, has_speeds, has_filter;
    bool only_objective; /* no other model confirms even half */
    double pressure;     /* reduction by the pressure integral of the same solutions; NAN: none */
    char statement[800];
};
void verify_judge(const struct verification *rows, size_t n, struct verdict *verdict);

#endif
