/* The regression object and what its source files share. */
#ifndef BAYESOPT_GP_INTERNAL_H
#define BAYESOPT_GP_INTERNAL_H

#include "gp/transform.h"

#include <bayesopt/gp.h>

struct bayesopt_gp {
    size_t d;
    bayesopt_gp_options options;
    size_t *group;     /* [d] with BAYESOPT_SCALES_TIED */
    bool *categorical; /* [d] or NULL */

    size_t n, capacity;
    double *x;        /* [n x d] */
    double *y;        /* [n] the caller's units */
    double *variance; /* [n] the caller's squared units, zero unless the noise is known */

    bool has_parameters;
    double *lengthscale; /* [d] */
    double signal, noise, fixed_mean;
    bool isotropic, wide;
    struct transform transform;

    /* Conditioning. H is the basis of the mean, n x p; p = 0 (fixed), 1 or d + 1. */
    bool conditioned;
    size_t p;
    double *scaled; /* [d x capacity] x_ij/l_j, of a categorical variable x_ij; by variables */
    double *jump;   /* [d] 1/l_j^2 of a categorical variable, else 0; NULL: there are none */
    double *t;      /* [n] modelled outputs */
    double *factor; /* [capacity x capacity] L of K = L L' */
    double *alpha;  /* [n] K^-1 (t - H beta) */
    double *solved; /* [p x capacity] L^-1 H, column by column */
    double *basis;  /* [p x capacity] K^-1 H */
    double *gram;   /* [p x p] Cholesky factor of H' K^-1 H */
    double *beta;   /* [p] */
    double jitter;  /* absolute */
    double log_likelihood, log_posterior;
    size_t evaluations;

    /* Asked at every likelihood evaluation of a fit; true ends it as cancelled. NULL: never. */
    bool (*is_cancelled)(void *user_data);
    void *cancel_data;
};

/* Hyper-parameters of one likelihood evaluation. */
struct gp_theta {
    const double *lengthscale;
    double signal, noise;
};

/* K with w (n x n, may be NULL) beside it; lower triangles, row length n. Uses scaled coordinates.
 */
void gp_covariance(const struct bayesopt_gp *gp, double signal, double *k, double *w);
/* Noise variance of point i in modelled squared units. */
double gp_noise(const struct bayesopt_gp *gp, size_t i, double noise);
void gp_scale_inputs(struct bayesopt_gp *gp, const double *lengthscale);
/* Coordinate j of a point as it stands in gp->scaled. */
double gp_scaled(const struct bayesopt_gp *gp, size_t j, double x);
/* Row of H at a point. */
void gp_basis_row(const struct bayesopt_gp *gp, const double *x, double *row);
/* Everything from the factorisation on, with the jitter ladder. false: not positive definite. */
bool gp_condition(struct bayesopt_gp *gp);
bayesopt_status gp_reserve(struct bayesopt_gp *gp, size_t n);
/* Scratch of gp_likelihood(): two capacity x capacity matrices. */
struct gp_scratch {
    double *inverse, *w;
};
bool gp_scratch_create(struct gp_scratch *scratch, size_t capacity);
void gp_scratch_free(struct gp_scratch *scratch);
/* Log marginal likelihood at theta, gradient in (log l, log sf2, log sn2) [d + 2] or NULL. Uses t
 * and overwrites the conditioning. false: K is not positive definite within a short jitter ladder.
 */
bool gp_likelihood(struct bayesopt_gp *gp, const struct gp_theta *theta, struct gp_scratch *scratch,
                   double *value, double *gradient);
/* The gradient alone, from the present factor; need_w: compute w first. false: no inverse. */
bool gp_likelihood_gradient(const struct bayesopt_gp *gp, const struct gp_theta *theta,
                            struct gp_scratch *scratch, bool need_w, double *gradient);

#endif
