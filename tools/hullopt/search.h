/* The search: ask, evaluate, record, tell. */
#ifndef HULLOPT_SEARCH_H
#define HULLOPT_SEARCH_H

#include "entrance.h"
#include "evaluate.h"
#include "limits.h"
#include "store.h"

#include <bayesopt/bayesopt.h>

struct search {
    const struct config *config;
    struct evaluator *evaluator;
    struct store *store;
    struct limits limits;
    struct entrance entrance;
    bayesopt *bo;
    struct evaluation parent; /* without its latent point */
};

/* The optimisation of a run on its own store at path (created or resumed), search->store not yet
 * set. volume_gradient as in limits_create(). On failure prints the sentence. */
bool search_create(const struct config *config, struct evaluator *evaluator, const char *path,
                   const double *volume_gradient, struct search *search);
void search_free(struct search *search);

/* Evaluates the parent unless that is recorded, then runs until the budget is spent. */
bool search_run(struct search *search);

#endif
