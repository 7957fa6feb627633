/* What the rows of a verification say together. */
#ifndef HULLOPT_VERDICT_H
#define HULLOPT_VERDICT_H

#include "core/verification.h"

#include <stdbool.h>

struct verdict {
    double claimed;    /* reduction that the objective sees, share of the parent's C_w */
    bool asked;        /* another formulation was */
    size_t models;     /* other formulations with a result */
    size_t confirm;    /* of these: at least half of the claimed reduction */
    size_t partly;     /* some reduction, less than half of the claimed one */
    size_t deny;       /* none, or an increase */
    bool formulations; /* most confirm and none denies */
    bool resolution;   /* the finer solve keeps at least 80 % of the reduction */
    bool speeds;       /* no increase at another speed, by the objective or outside of the hull */
    bool filter;       /* with a filter by the rule on each hull, not the parent's, half remains */
    bool sterns;       /* with the stern treated over other lengths half remains */
    bool has_resolution, has_speeds, has_filter, has_sterns;
    bool only_objective; /* no other model confirms even half */
    double pressure;     /* reduction by the pressure integral of the same solutions; NAN: none */
    char statement[1000];
};
void verdict_reach(const struct verification *rows, size_t n, struct verdict *verdict);

#endif
