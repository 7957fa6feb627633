/* How alike the formulations rank the designs of a run. A run by `random` or `lhs` with
 * search.models asks just this; any other run with them tells it of the designs that it looked at.
 */
#ifndef HULLOPT_AGREEMENT_H
#define HULLOPT_AGREEMENT_H

#include "report/results.h"

enum { FORMULATIONS_MOST = 1 + CONFIG_MODELS_MOST };

struct agreement {
    double froude;
    size_t n,
        models; /* designs that were solved, without the parent; formulations, the solver's first */
    const char *name[FORMULATIONS_MOST];
    double *ratio[FORMULATIONS_MOST]; /* of C_w to the parent's, n each */
    double rank[FORMULATIONS_MOST]
               [FORMULATIONS_MOST]; /* Spearman's correlation; NAN below 3 designs */
};

/* At the speed of the search (0) or one of verification.froude (1, ...). False where nothing is to
 * be told: no search.models, or not solved at this speed. */
bool agreement_of(const struct results *results, size_t speed, struct agreement *agreement);
void agreement_free(struct agreement *agreement);

#endif
