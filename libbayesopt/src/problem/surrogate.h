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
    size_t count;               /* objective, outcome constraints, feasibility */
    struct model_state *states; /* [count + 1], the last of the cheap level */
    bayesopt_gp **gps;          /* [count], NULL where there is nothing to model */
    /* With two levels f = share * cheap + difference (Kennedy and O'Hagan, Biometrika 87 (2000) 1):
     * cheap is modelled by this, the difference by gps[0]. */
    bayesopt_gp *cheap;
    double share;
    bool fitted; /* for the present history */
};

bool surrogates_create(struct surrogates *surrogates, size_t d, size_t n_constraints);
void surrogates_free(struct surrogates *surrogates);

/* States as count * (7 + d) numbers, to keep and to restore. */
size_t surrogates_state_size(const struct surrogates *surrogates, size_t d);
void surrogates_save(const struct surrogates *surrogates, size_t d, double *values);
bool surrogates_restore(struct surrogates *surrogates, size_t d, const double *values);

/* Fits all models to the history. keep: the new hyper-parameters become the next warm start. */
bayesopt_status surrogates_fit(struct bayesopt *bo, bool keep);

/* Standard deviation of values told at the same point; NAN if there are none. */
double surrogates_repeat_deviation(const struct bayesopt *bo);

/* Posterior of the objective at n points of [0,1]^d in units of gps[0], both levels combined. */
bayesopt_status surrogates_predict(const struct bayesopt *bo, size_t n, const double *x,
                                   double *mean, double *var);
/* The same at one point with gradients [d]; work [surrogates_work_size()]. */
bayesopt_status surrogates_predict_gradient(const struct bayesopt *bo, const double *x,
                                            double *mean, double *var, double *dmean, double *dvar,
                                            double *work);
/* Scratch that predictions with gradients of any of the models need, in doubles. */
size_t surrogates_work_size(const struct bayesopt *bo);
/* Share of the posterior variance at a point that an evaluation of the cheap level would remove. */
bayesopt_status surrogates_cheap_share(const struct bayesopt *bo, const double *x, double *share);

#endif
