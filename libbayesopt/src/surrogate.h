/* The models of an optimisation: objective, outcome constraints, feasibility. */
#ifndef BAYESOPT_SURROGATE_H
#define BAYESOPT_SURROGATE_H

#include <bayesopt/gp.h>

struct bayesopt;

/* What a warm fit starts from. Proposals depend on it, so it is kept with the history. */
struct model_state {
    bool known, isotropic, wide;
    double cold_n; /* data at the last cold fit */
    bayesopt_transform transform;
    double signal, noise;
    double *lengthscale; /* [d] */
};

struct surrogates {
    size_t count; /* objective, outcome constraints, feasibility */
    struct model_state *states;
    bayesopt_gp **gps; /* NULL where there is nothing to model */
    bool fitted;       /* for the present history */
};

bool surrogates_create(struct surrogates *surrogates, size_t d, size_t n_constraints);
void surrogates_free(struct surrogates *surrogates);

/* States as count * (7 + d) numbers, to keep and to restore. */
size_t surrogates_state_size(const struct surrogates *surrogates, size_t d);
void surrogates_save(const struct surrogates *surrogates, size_t d, double *values);
void surrogates_restore(struct surrogates *surrogates, size_t d, const double *values);

/* Fits all models to the history. keep: the new hyper-parameters become the next warm start. */
bayesopt_status surrogates_fit(struct bayesopt *bo, bool keep);

#endif
