/* A search for the most likely hyper-parameters of one model of a regression. */
#ifndef BAYESOPT_GP_SEARCH_H
#define BAYESOPT_GP_SEARCH_H

#include "gp/gp_internal.h"

#include <nlopt.h>

enum { GP_MOST_PARAMETERS = BAYESOPT_MOST_VARIABLES + 2 };

/* Variances of the own part of log l_j that are compared: scales within a factor of about 1.4 and
 * of 2.7 of each other; chosen on the first table of tests/bench/bayesopt_regret. */
extern const double gp_tight_variance, gp_wide_variance;

struct gp_noise_prior {
    double centre, deviation, least, most;
};

/* One of the models compared: how the length scales are tied and how far they may differ. */
struct gp_model {
    bool isotropic;
    double variance;
};

struct gp_search {
    bayesopt_gp *gp;
    struct gp_model model;
    const struct gp_noise_prior *noise;
    size_t groups, parameters; /* log l per group, log sf2, log sn2 if learned */
    const size_t *group;       /* [d] */
    struct gp_scratch scratch;
    double *lengthscale, *gradient; /* [d], [d + 2] */
    double *best;                   /* [parameters] */
    double best_value;
    bool cancelled;
    size_t evaluations, flat; /* flat: at the best value but for rounding */
    nlopt_opt search;
};

/* isotropic_groups: [d] zeros, borrowed. */
bayesopt_status gp_search_create(struct gp_search *fit, bayesopt_gp *gp, struct gp_model model,
                                 const size_t *isotropic_groups);
void gp_search_free(struct gp_search *fit);
/* Present hyper-parameters in the coordinates of a search; groups get their members' mean. */
void gp_search_pack(const struct gp_search *fit, double *theta);
/* Start s in those coordinates. */
void gp_search_start(const struct gp_search *fit, size_t s, double *theta);
/* Leaves the best point seen, of this climb and earlier ones, in fit->best. */
bayesopt_status gp_search_climb(struct gp_search *fit, const double *start, size_t evaluations);
/* The regression takes the best point. */
void gp_search_adopt(struct gp_search *fit);
/* Laplace's approximation of the log evidence at the best point; where the posterior has none, its
 * density there. */
bayesopt_status gp_search_evidence(struct gp_search *fit, double *evidence);

#endif
