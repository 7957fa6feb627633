/**
 * @file gp.h
 * Gaussian-process regression with few hundred to few thousand points: exact inference, analytic
 * gradients, maximum a posteriori hyper-parameters. Usable alone.
 *
 * Covariance of the data: K = sf2 g(r) + (sn2 + jitter) I, r^2 = sum_j ((x_j - x'_j)/l_j)^2, with g
 * one of bayesopt_kernel; for a categorical variable the difference is 0 or 1, which keeps r a
 * Euclidean distance and K positive definite. Rasmussen and Williams, Gaussian Processes for
 * Machine Learning, 2006, ch. 2, 5. Matrices are worked on by OpenBLAS and LAPACK: with the same
 * number of threads results have the same bits, with another they agree to rounding. A few hundred
 * points gain nothing from more than one.
 */
#ifndef BAYESOPT_GP_H
#define BAYESOPT_GP_H

#include <bayesopt/status.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Correlation as a function of the scaled distance r. */
typedef enum bayesopt_kernel {
    BAYESOPT_KERNEL_SE,       /**< exp(-r^2/2) */
    BAYESOPT_KERNEL_MATERN32, /**< (1 + s) exp(-s), s = sqrt(3) r */
    BAYESOPT_KERNEL_MATERN52, /**< (1 + s + s^2/3) exp(-s), s = sqrt(5) r */
} bayesopt_kernel;

/** Which length scales are free. */
typedef enum bayesopt_scales {
    BAYESOPT_SCALES_ISOTROPIC, /**< one for all variables */
    BAYESOPT_SCALES_TIED,      /**< one per group of variables */
    BAYESOPT_SCALES_ARD,       /**< one per variable */
    BAYESOPT_SCALES_AUTO,      /**< isotropic or ARD, whichever bayesopt_gp_choice prefers */
} bayesopt_scales;

/** Mean of the process. */
typedef enum bayesopt_mean {
    BAYESOPT_MEAN_FIXED,    /**< a constant given by the caller */
    BAYESOPT_MEAN_CONSTANT, /**< unknown constant, generalised least squares */
    BAYESOPT_MEAN_LINEAR,   /**< unknown constant and slope, generalised least squares */
} bayesopt_mean;

/** What is known of the noise. */
typedef enum bayesopt_noise {
    BAYESOPT_NOISE_DETERMINISTIC, /**< sn2 = 1e-6 sf2-free units of the standardised data, a guard
                                     only */
    BAYESOPT_NOISE_KNOWN,         /**< a variance per point given with the data */
    BAYESOPT_NOISE_LEARNED,       /**< one variance, estimated */
} bayesopt_noise;

/** Monotone maps of the outputs applied before standardising. */
typedef enum bayesopt_transform {
    BAYESOPT_TRANSFORM_NONE,
    BAYESOPT_TRANSFORM_LOG,         /**< log(y - min y + c), c = 0.01 (median y - min y) */
    BAYESOPT_TRANSFORM_YEO_JOHNSON, /**< Yeo and Johnson, Biometrika 87 (2000) 954, of (y -
                                       median)/IQR */
    BAYESOPT_TRANSFORM_RANK,        /**< normal scores of the ranks, linear between the data */
    BAYESOPT_TRANSFORM_WINSORISED,  /**< values above q75 + 5 (q75 - q25) pulled down to there */
    BAYESOPT_TRANSFORM_AUTO,        /**< none, unless the logarithm or Yeo-Johnson gain more than 2
                                         in log marginal likelihood, Jacobian included, and lower the
                                         leave-one-out error (in normal scores of the ranks, common
                                         to all), or winsorising or ranks halve that error */
} bayesopt_transform;

/** How bayesopt_gp_fit() prefers one model to another. */
typedef enum bayesopt_choice {
    BAYESOPT_CHOICE_POSTERIOR, /**< log posterior of the hyper-parameters */
    BAYESOPT_CHOICE_LOO,       /**< leave-one-out log predictive density */
} bayesopt_choice;

/** Name of a kernel, static. */
BAYESOPT_API const char *bayesopt_kernel_name(bayesopt_kernel kernel);
/** Name of a transform, static. */
BAYESOPT_API const char *bayesopt_transform_name(bayesopt_transform transform);

/** A regression: options, data, hyper-parameters, factorisation. */
typedef struct bayesopt_gp bayesopt_gp;

/** Options of bayesopt_gp_create(); fill with bayesopt_gp_options_init(). */
typedef struct bayesopt_gp_options {
    bayesopt_kernel kernel;       /**< default BAYESOPT_KERNEL_MATERN52 */
    bayesopt_scales scales;       /**< default BAYESOPT_SCALES_ARD */
    const size_t *group;          /**< [d] BAYESOPT_SCALES_TIED: group of each variable, numbered
                                       from 0 without gaps; copied */
    bayesopt_mean mean;           /**< default BAYESOPT_MEAN_CONSTANT */
    bayesopt_noise noise;         /**< default BAYESOPT_NOISE_DETERMINISTIC */
    bayesopt_transform transform; /**< default BAYESOPT_TRANSFORM_NONE */
    bayesopt_choice choice;       /**< default BAYESOPT_CHOICE_POSTERIOR */
    /** Prior log l_j = log(d)/2 + prior_shift + c + e_j with c ~ N(0, prior_common) shared by all
     * variables and e_j ~ N(0, prior_variance), in units of a unit box: scales grow like sqrt(d)
     * and are alike until the data say otherwise. */
    double prior_shift;    /**< default 0 */
    double prior_common;   /**< default 1 */
    double prior_variance; /**< default NAN: 0.1 or 1, the likelier */
    size_t starts;         /**< starts with one length scale of a cold fit; default 3 */
    size_t evaluations;    /**< likelihood evaluations per start; default 60 */
    uint64_t seed;         /**< of the random starts; default 1 */
    const bool
        *categorical;   /**< [d] copied; variables whose values are names without order: any
                           two that differ are 1 apart in r, that is 1/l_j, which is the
                           distance of their one-hot codes up to a factor; default NULL: none */
    double threads;     /**< of the BLAS of the whole process during a call, a whole number up to
                             1024; default 0: as OpenBLAS decides */
    double reserved[7]; /**< 0: room for members of later releases */
} bayesopt_gp_options;

/** Fills the defaults; nothing when NULL. */
BAYESOPT_API void bayesopt_gp_options_init(bayesopt_gp_options *options);

/** Creates an empty regression in d variables; release with bayesopt_gp_free(). */
BAYESOPT_API bayesopt_status bayesopt_gp_create(size_t d, const bayesopt_gp_options *options,
                                                bayesopt_gp **gp);
/** Frees a model; takes NULL. */
BAYESOPT_API void bayesopt_gp_free(bayesopt_gp *gp);

/**
 * Replaces the data. Any earlier factorisation is dropped, the hyper-parameters are kept.
 * @param x         [n x d] copied; best scaled to [0,1]^d, for which the priors are made
 * @param y         [n] copied, finite
 * @param variance  [n] copied, noise variances in squared units of y (BAYESOPT_NOISE_KNOWN); else
 * NULL
 */
BAYESOPT_API bayesopt_status bayesopt_gp_set_data(bayesopt_gp *gp, size_t n, const double *x,
                                                  const double *y, const double *variance);

/** Hyper-parameters. Variances and mean refer to the outputs as modelled: transformed and
 * standardised by bayesopt_gp_fit(), the caller's units after bayesopt_gp_set_parameters(). */
typedef struct bayesopt_gp_parameters {
    double *lengthscale; /**< [d] borrowed or filled */
    double signal;       /**< sf2 > 0 */
    double noise;        /**< sn2 >= 0 */
    double mean;         /**< constant mean; read only with BAYESOPT_MEAN_FIXED */
} bayesopt_gp_parameters;

/** Conditions on the data with the given hyper-parameters, in the units of y, without transform.
 * @return BAYESOPT_ERROR_NUMERIC if K is not positive definite even with the largest jitter */
BAYESOPT_API bayesopt_status bayesopt_gp_set_parameters(bayesopt_gp *gp,
                                                        const bayesopt_gp_parameters *parameters);

/**
 * Maximum a posteriori hyper-parameters on standardised, transformed outputs, then conditions.
 * Starts from the present hyper-parameters when there are any (a warm fit: one start), else from
 * options.starts starts with one length scale, refined for every model compared. Never fails for
 * lack of positive definiteness: jitter is raised, at worst the previous hyper-parameters stay.
 * O(n^3) per likelihood evaluation.
 */
BAYESOPT_API bayesopt_status bayesopt_gp_fit(bayesopt_gp *gp);

/** Forgets the hyper-parameters so that the next fit is a cold one. */
BAYESOPT_API void bayesopt_gp_forget(bayesopt_gp *gp);

/** Adds points to the conditioning set with the hyper-parameters, transform and standardisation
 * kept: O(n^2) each. Arguments as in bayesopt_gp_set_data(). */
BAYESOPT_API bayesopt_status bayesopt_gp_append(bayesopt_gp *gp, size_t n, const double *x,
                                                const double *y, const double *variance);

/** Present hyper-parameters; parameters->lengthscale [d] is filled unless NULL. */
BAYESOPT_API bayesopt_status bayesopt_gp_get_parameters(const bayesopt_gp *gp,
                                                        bayesopt_gp_parameters *parameters);

/** What was fitted. */
typedef struct bayesopt_gp_info {
    size_t n;       /**< points */
    bool isotropic; /**< one length scale */
    bool wide;      /**< the wide prior was preferred */
    bayesopt_transform transform;
    double offset, scale;  /**< modelled output = (transform(y) - offset)/scale */
    double jitter;         /**< added to the diagonal, relative to its mean */
    double log_likelihood; /**< log p(modelled outputs | X) */
    double log_posterior;  /**< with the priors; equal to log_likelihood after set_parameters */
    double mean;           /**< constant mean: fixed, or estimated by generalised least squares */
    size_t evaluations;    /**< likelihood evaluations of the last fit */
    double reserved[8];    /**< 0: room for members of later releases */
} bayesopt_gp_info;

/** Fills info with what the fit found. */
BAYESOPT_API bayesopt_status bayesopt_gp_get_info(const bayesopt_gp *gp, bayesopt_gp_info *info);

/**
 * Posterior of the latent function, in modelled units.
 * @param x     [m x d]
 * @param mean  [m] filled
 * @param var   [m] filled, without noise; NULL allowed
 */
BAYESOPT_API bayesopt_status bayesopt_gp_predict(const bayesopt_gp *gp, size_t m, const double *x,
                                                 double *mean, double *var);

/** Posterior at one point with gradients: x [d]; mean, var filled; dmean, dvar [d] filled.
 * @param work  [2 n] the caller's scratch, n from bayesopt_gp_get_info() */
BAYESOPT_API bayesopt_status bayesopt_gp_predict_gradient(const bayesopt_gp *gp, const double *x,
                                                          double *mean, double *var, double *dmean,
                                                          double *dvar, double *work);

/** Modelled value of an output and back; the transform of the last fit, monotone. */
BAYESOPT_API double bayesopt_gp_to_model(const bayesopt_gp *gp, double y);
/** The way back: the output whose modelled value is value. */
BAYESOPT_API double bayesopt_gp_from_model(const bayesopt_gp *gp, double value);

/**
 * Log marginal likelihood of the modelled outputs and its gradient in (log l_1..d, log sf2, log
 * sn2) at the present hyper-parameters. gradient [d + 2] filled; NULL allowed.
 */
BAYESOPT_API bayesopt_status bayesopt_gp_log_likelihood(const bayesopt_gp *gp, double *value,
                                                        double *gradient);

/** Leave-one-out predictions of the modelled outputs with the hyper-parameters and the mean kept;
 * var includes the noise. mean, var [n] filled. Rasmussen and Williams, eqs. 5.10-5.12. */
BAYESOPT_API bayesopt_status bayesopt_gp_loo(const bayesopt_gp *gp, double *mean, double *var);

/** The modelled outputs (transformed, standardised) of the data; t [n] filled. */
BAYESOPT_API bayesopt_status bayesopt_gp_outputs(const bayesopt_gp *gp, double *t);

/** Writes data and hyper-parameters as text; numbers round-trip exactly. */
BAYESOPT_API bayesopt_status bayesopt_gp_save(const bayesopt_gp *gp, const char *path);
/** Creates a regression that predicts as the saved one did. */
BAYESOPT_API bayesopt_status bayesopt_gp_load(const char *path, bayesopt_gp **gp);

#ifdef __cplusplus
}
#endif

#endif
