/* What the Gaussian process of a search says of it: how well it predicts what it was not told, and
 * which latent directions matter. */
#ifndef HULLOPT_REPORT_MODEL_H
#define HULLOPT_REPORT_MODEL_H

#include "core/record.h"

struct search_model {
    bool known; /* false: the search has none, or too few designs */
    bayesopt_model_info info;
    size_t d, objectives;
    double *scale;            /* [d] lengths, m, of the first objective */
    double *first, *total;    /* [objectives x d] Sobol' indices: alone, with others */
    size_t n;                 /* leave-one-out of the first objective, over the original's: */
    double *told, *mean, *sd; /* [n] */
};
/* parent: C_w of the original, in units of which the search has the first objective. */
bool model_read(const struct record *record, const struct config *config, double parent,
                struct search_model *model);
void model_free(struct search_model *model);

#endif
