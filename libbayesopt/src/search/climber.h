/* A search under way, and what it improves on. */
#ifndef BAYESOPT_CLIMBER_H
#define BAYESOPT_CLIMBER_H

#include "search/noisy.h"
#include "search/search.h"

struct climber {
    struct bayesopt *bo;
    const struct search *search;
    bool improvement;    /* there is a feasible point to improve on */
    double best;         /* its value in modelled units */
    struct noisy *noisy; /* replaces best with noise and one level, else NULL */
    struct front front;  /* replaces both with several objectives */
    bool several;
    double unit; /* what the quadratic's values are measured in */
    double *work, *dmean, *dvar;
    double *constraint_lower, *constraint_upper; /* modelled units */
    double *best_u, best_value;                  /* of the present ascent */
};

/* incumbent.c: fill best and improvement, then what takes the place of best with noise and with
 * several objectives. */
bayesopt_status climber_find_incumbent(struct climber *climber);
bayesopt_status climber_prepare_noisy(struct climber *climber);
bayesopt_status climber_prepare_front(struct climber *climber);

#endif
