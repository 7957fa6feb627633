/* The ways to search, a row each. */
#ifndef HULLOPT_METHODS_H
#define HULLOPT_METHODS_H

#include <bayesopt/design.h>

#include <nlopt.h>
#include <stdbool.h>

enum method_kind {
    METHOD_GAUSSIAN_PROCESS, /* ask and tell of libbayesopt */
    METHOD_DESIGN,           /* its initial design alone */
    METHOD_DESCENT,          /* core/descent.c */
    METHOD_NLOPT,            /* core/conventional.c */
    METHOD_SWARM             /* core/swarm.c */
};

struct method_row {
    const char *name;
    enum method_kind kind;
    nlopt_algorithm algorithm;   /* of METHOD_NLOPT */
    bayesopt_design_kind design; /* of METHOD_DESIGN */
    bool gradient;               /* by differences, recorded as evaluations */
    bool constraints;            /* takes them; else they are a penalty on the objective */
    bool seeded;                 /* another search.seed is another search */
    double outside; /* how far outside of the limits that are known beforehand it values designs:
                       ratios. 0: such a design costs nothing and is worse than any other */
    const char *sentence;
};

/* NULL after the last. */
const struct method_row *method_row(int method);

#endif
