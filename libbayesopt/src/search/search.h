/* The point of a box that promises most under the fitted models. */
#ifndef BAYESOPT_SEARCH_H
#define BAYESOPT_SEARCH_H

#include "core/quadratic.h"
#include "problem/internal.h"

enum search_goal {
    SEARCH_IMPROVEMENT, /* log expected improvement, constrained */
    SEARCH_MEAN,        /* least posterior mean, with probable feasibility */
    SEARCH_QUADRATIC,   /* least value of the quadratic, with probable feasibility */
};

struct search {
    enum search_goal goal;
    const double *lower, *upper; /* [d] the box within [0,1]^d */
    uint64_t id;                 /* names the random stream */
    size_t candidates, starts;   /* uniform candidates, ascents */
    const struct quadratic *quadratic;
    const double *apart; /* [d] how far from a pending point a proposal lies at least; NULL: any */
};

/* Whether u keeps that distance in some variable from every pending point. */
bool search_is_apart(const struct bayesopt *bo, const double *apart, const double *u);

/* Fills u [d] with the best point found and *value with its acquisition (logarithm of the expected
 * improvement in modelled units, or minus the mean). The models must be fitted. */
bayesopt_status search_run(struct bayesopt *bo, const struct search *search, double *u,
                           double *value);

/* candidates.c: fills x [(candidates + SEARCH_NEIGHBOURS) x d] with points of the box, first some
 * spread over it, then some near the best points; *n is how many. */
enum { SEARCH_NEIGHBOURS = 200 };
bayesopt_status search_candidates(struct bayesopt *bo, const struct search *search, double *x,
                                  size_t *n);

/* Adds pending points to the models at their posterior means (Kriging believer: Ginsbourger, Le
 * Riche, Carraro 2010), so that they are not proposed again. */
bayesopt_status search_believe_pending(struct bayesopt *bo);

#endif
