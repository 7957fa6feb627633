/**
 * @file model.h
 * The latent space of a shape modification: covariance of sampled displacements, its leading
 * eigenpairs, projection, reconstruction and the way back to the original parameters (eqs. 3-10).
 *
 * A galv_model is immutable once built, so several threads may use one.
 */
#ifndef GALV_MODEL_H
#define GALV_MODEL_H

#include <galv/shape.h>
#include <galv/status.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct galv_model galv_model;

/** Where the parameter vectors x_r, r = 0..count-1, come from. Make one with galv_uniform() or
 * galv_samples(). */
typedef struct galv_sampling {
    size_t count;    /**< N >= 1 */
    uint64_t seed;   /**< of the uniform stream; unused when x is given */
    const double *x; /**< N rows of n parameters, borrowed for the call; NULL: uniform stream */
} galv_sampling;

/** N independent uniform draws from the box of the shape's bounds. Sample r depends on (seed, r, n)
 * only: not on N, not on the number of threads, not on the order of evaluation. */
GALV_API galv_sampling galv_uniform(size_t count, uint64_t seed);

/** The caller's N rows of n parameters. */
GALV_API galv_sampling galv_samples(size_t count, const double *x);

/** Fills x (n) with sample `index` of the uniform stream over [lower, upper]. */
GALV_API void galv_uniform_sample(uint64_t seed, size_t index, size_t n, const double *lower,
                                  const double *upper, double *x);

/** How the spectrum is found. */
typedef enum galv_method {
    GALV_METHOD_AUTO, /**< the cheapest of the exact ones that fits the workspace, else randomised
                       */
    GALV_METHOD_COVARIANCE, /**< the L x L matrix of eq. 6, zero rows dropped */
    GALV_METHOD_GRAM,       /**< the N x N matrix of inner products */
    GALV_METHOD_RANDOMISED, /**< block Krylov iteration on the stream, error bounds a posteriori */
} galv_method;

/** Called between blocks of samples with the fraction done, 0..1; non-zero cancels. */
typedef int (*galv_progress)(void *context, double fraction);

/** Options of galv_build(); fill with galv_options_init() first. */
typedef struct galv_options {
    double variance; /**< share of the trace to retain, (0, 1]; default 0.95 (section V.B) */
    size_t modes; /**< keep exactly this many modes instead (fewer when the rank is); default 0: by
                     variance */
    size_t spectrum;       /**< eigenvalues to report at least, beyond the modes kept; default 64 */
    bool centre;           /**< subtract the sample mean; default false (eq. 6) */
    galv_method method;    /**< default GALV_METHOD_AUTO */
    const double *weights; /**< npoints positive weights of the points in the inner product,
                              borrowed for the call; default NULL: equal measure (eq. 3) */
    size_t workspace;      /**< bytes for matrices and blocks of samples; default 512 MiB */
    uint64_t seed;         /**< of the randomised start block; default 1 */
    galv_progress progress; /**< default NULL */
    void *progress_context; /**< default NULL */
} galv_options;

GALV_API void galv_options_init(galv_options *options);

/**
 * Weights of true area for a structured grid: a quarter of the area of the cells around each point,
 * scaled to a mean of 1 so that traces stay comparable with equal weights.
 * @param xyz  sections x girth triples, girth fast
 * @param[out] weights  sections x girth numbers, filled
 * @return GALV_ERROR_GEOMETRY names a point none of whose cells has an area.
 */
GALV_API galv_status galv_grid_weights(size_t sections, size_t girth, const double *xyz,
                                       double *weights);

/**
 * Samples the shape on npoints points and builds its latent space. Displacements are streamed in
 * blocks; no N x L array exists.
 * @param shape    borrowed for the call
 * @param xyz      npoints triples, metres; copied
 * @param options  NULL: defaults
 * @param[out] model created
 * @return GALV_ERROR_NUMERIC names the sample whose displacement is not finite; GALV_ERROR_GEOMETRY
 * when every displacement is zero; GALV_ERROR_CANCELLED. Complexity: min(N L^2, N^2 L) for the
 * exact methods, N L b per pass (b the block) for the randomised one; L counts the coordinates that
 * move.
 */
GALV_API galv_status galv_build(const galv_shape *shape, size_t npoints, const double *xyz,
                                galv_sampling sampling, const galv_options *options,
                                galv_model **model);

/** NULL is allowed. */
GALV_API void galv_model_free(galv_model *model);

/** @name Sizes
 * @{ */
GALV_API size_t galv_model_samples(const galv_model *model);     /**< N */
GALV_API size_t galv_model_points(const galv_model *model);      /**< E */
GALV_API size_t galv_model_coordinates(const galv_model *model); /**< L = 3 E */
GALV_API size_t
galv_model_active(const galv_model *model); /**< coordinates that move in some sample */
GALV_API size_t galv_model_parameters(const galv_model *model); /**< n of the shape sampled */
GALV_API size_t galv_model_modes(const galv_model *model);      /**< m */
GALV_API size_t galv_model_spectrum(const galv_model *model);   /**< eigenvalues known, >= m */
/** @} */

/** @name Numbers
 * Arrays are borrowed from the model.
 * @{ */
GALV_API double galv_model_retained(const galv_model *model); /**< eq. 9 for the m modes, 0..1 */
GALV_API double galv_model_trace(const galv_model *model);    /**< exact trace of C, m^2 */
/** The leading eigenvalues, descending, m^2; galv_model_spectrum() of them. */
GALV_API const double *galv_model_eigenvalues(const galv_model *model);
/** |C w - lambda w| of each: some eigenvalue lies that close to the one reported, and the one
 * reported is not above the true one of its index. At rounding for the exact methods. */
GALV_API const double *galv_model_residuals(const galv_model *model);
/** MSE of eq. 10 with 1, 2, ... galv_model_spectrum() modes, m^2: trace minus the eigenvalues kept.
 */
GALV_API const double *galv_model_mse(const galv_model *model);
/** The modes W1, one after another: mode k is the L numbers from vectors + k L, displacements in
 * the order of the points. Orthonormal in the weighted inner product; the component of largest
 * magnitude is positive. */
GALV_API const double *galv_model_vectors(const galv_model *model);
/** Mean displacement (L), zeros when not centred. */
GALV_API const double *galv_model_mean(const galv_model *model);
/** The points of the parent, npoints triples. */
GALV_API const double *galv_model_parent(const galv_model *model);
/** Weights of the coordinates (L), or NULL when all are 1. */
GALV_API const double *galv_model_weights(const galv_model *model);
/** The projected samples u_r: N rows of m numbers. */
GALV_API const double *galv_model_latent(const galv_model *model);
/** The method that found the spectrum (never GALV_METHOD_AUTO). */
GALV_API galv_method galv_model_method(const galv_model *model);
/** Box of the projected samples (m each): least and greatest u_k over the samples. */
GALV_API const double *galv_model_lower(const galv_model *model);
GALV_API const double *galv_model_upper(const galv_model *model);
/** @} */

/** Whether N was enough. Both figures are NaN for N < 20. */
typedef struct galv_confidence {
    double retained_error; /**< standard error of the retained share (jackknife over ten groups) */
    double angle; /**< greatest principal angle, radians, between the modes of every other sample
                     and those of all: for independent samples also the size of the angle between
                     the modes found and those of infinitely many samples */
} galv_confidence;

GALV_API galv_confidence galv_model_confidence(const galv_model *model);

/** Latent coordinates of a displacement, u = W1^T (d - mean): d has L numbers, u m, filled. */
GALV_API galv_status galv_project(const galv_model *model, const double *d, double *u);

/** Displacement of a latent point, d = mean + W1 u: u has m numbers, d L, filled. */
GALV_API galv_status galv_reconstruct(const galv_model *model, const double *u, double *d);

/**
 * The parameters whose shape is nearest to a latent point's: minimises |d(x) - W1 u - mean| within
 * the bounds of the shape, from the linear regression of x on u over the samples, by bounded
 * Levenberg-Marquardt.
 * @param shape    the shape the model was built from (same number of parameters); borrowed
 * @param u        m latent coordinates
 * @param[out] x   n parameters, filled
 * @param[out] residual root mean square distance of the points of d(x) from the shape of u, metres;
 * may be NULL
 */
GALV_API galv_status galv_backmap(const galv_model *model, const galv_shape *shape, const double *u,
                                  double *x, double *residual);

#ifdef __cplusplus
}
#endif

#endif
