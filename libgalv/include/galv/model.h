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
    size_t count; /**< N >= 1 */
    size_t first; /**< index of the first sample in the uniform stream, 0 unless an earlier run used
                     it */
    uint64_t seed;      /**< of the uniform stream; unused when x is given */
    const double *x;    /**< N rows of n parameters, borrowed for the call; NULL: uniform stream */
    double reserved[4]; /**< 0: room for members of later releases */
} galv_sampling;

/** N independent uniform draws from the box of the shape's bounds. Sample r depends on (seed, r, n)
 * only: not on N, not on the number of threads, not on the order of evaluation. */
GALV_API galv_sampling galv_uniform(size_t count, uint64_t seed);

/** The caller's N rows of n parameters; none for NULL, which galv_build() refuses. */
GALV_API galv_sampling galv_samples(size_t count, const double *x);

/** Fills x (n) with sample `index` of the uniform stream over [lower, upper]; nothing
 * when one of the three is NULL. */
GALV_API void galv_uniform_sample(uint64_t seed, size_t index, size_t n, const double *lower,
                                  const double *upper, double *x);

/** How the spectrum is found. */
typedef enum galv_method {
    GALV_METHOD_AUTO, /**< the cheapest of the exact ones that fits the workspace, else randomised
                       */
    GALV_METHOD_COVARIANCE, /**< the L x L matrix of eq. 6, zero rows dropped */
    GALV_METHOD_GRAM,       /**< the N x N matrix of inner products */
    GALV_METHOD_RANDOMISED, /**< block Krylov iteration on the stream, error bounds a posteriori */
    GALV_METHOD_FACTORED,   /**< linear shapes only: the n x n matrix of their functions */
    GALV_METHOD_PARAMETERS, /**< none: the modes are the parameters, see galv_build_parameters() */
} galv_method;

/** Quantities of the moved hull that are appended to d(x), so that modes also account for their
 * variance: geometric moments (moments.h), or anything else of physical meaning. This is the
 * shape-supervised reduction of Khan et al., Computer-Aided Design 2022, 103327. They are evaluated
 * on the moved points, or the caller knows them for every sample, or both. */
typedef struct galv_extra {
    size_t count; /**< quantities */
    /** Fills values (count - given) for the moved points. Returns 0, or non-zero to report a
     * failure. NULL when all are given. */
    int (*evaluate)(void *user_data, size_t npoints, const double *xyz, double *values);
    void *user_data;       /**< borrowed */
    const double *weights; /**< count weights in the inner product, > 0; borrowed. See
                              galv_extra_balance(). */
    bool concurrent;       /**< whether evaluate may run in several threads at once */
    size_t given;          /**< how many of them, the last ones, are not evaluated but given */
    const double *values;  /**< of the given ones: a row of `given` changes from the parent for each
                              sample of the call; borrowed */
    double reserved[8];    /**< 0: room for members of later releases */
} galv_extra;

/** Called with the fraction done, 0..1, which never falls: after each block of samples, and after
 * each column, block of vectors or iteration of a decomposition; non-zero cancels. */
typedef int (*galv_progress)(void *user_data, double fraction);

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
    const galv_extra *extra;  /**< appended quantities, as changes from the parent; borrowed for the
                                 call; default NULL */
    size_t workspace;         /**< bytes for matrices and blocks of samples; default 512 MiB */
    uint64_t seed;            /**< of the randomised start block; default 1 */
    galv_progress progress;   /**< default NULL */
    void *progress_user_data; /**< default NULL */
    int threads; /**< of loops over points and samples, and of the BLAS of the whole process during
                    the call; default 0: as they decide; at most 1024 */
    double reserved[7]; /**< 0: room for members of later releases */
} galv_options;

/** Fills the defaults; nothing when NULL. */
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

/**
 * Weights for appended quantities under which each of them has the same variance and all together
 * `share` times that of the displacements, by trying the samples.
 * @param sampling a few hundred samples are enough
 * @param extra    its weights are not used
 * @param share    > 0
 * @param[out] weights  extra->count numbers, filled
 * @return GALV_ERROR_GEOMETRY names a quantity that no sample changes.
 */
GALV_API galv_status galv_extra_balance(const galv_shape *shape, size_t npoints, const double *xyz,
                                        galv_sampling sampling, const galv_extra *extra,
                                        double share, double *weights);

/** Fills values (extra->count) with the change of the appended quantities under a displacement d of
 * the parent: what follows the 3 npoints displacements in a vector of all coordinates. Refuses
 * quantities that are given per sample. */
GALV_API galv_status galv_extra_change(const galv_extra *extra, size_t npoints, const double *xyz,
                                       const double *d, double *values);

/**
 * The full space of a shape as a model, for what takes a model: u are the parameters, mode k is the
 * displacement by a unit of parameter k, lower and upper are the bounds of the shape. Of a shape
 * that is not linear these are its derivatives at the parent: u is the displacement linear in the
 * parameters. Eigenvalues are what each uniform parameter adds to the trace, in their order. The
 * modes are not orthonormal: galv_project(), galv_backmap() and galv_extend() refuse such a model.
 * @param xyz  npoints triples, m; copied
 * @param[out] model created
 * @return GALV_ERROR_ARGUMENT where 0 is not between the bounds of a parameter
 */
GALV_API galv_status galv_build_parameters(const galv_shape *shape, size_t npoints,
                                           const double *xyz, galv_model **model);

/** Samples that do not come from a galv_shape: any N x L matrix, in memory or produced row by row.
 */
typedef struct galv_data {
    size_t count;       /**< N */
    size_t coordinates; /**< L */
    /** Fills count rows of L numbers with samples first..first+count-1; the same ones each time it
     * is asked. Returns 0, or non-zero to report a failure. Called from one thread. */
    int (*rows)(void *user_data, size_t first, size_t count, double *rows);
    void *user_data;       /**< borrowed */
    const double *weights; /**< L weights, or NULL */
    const double *values;  /**< the N rows themselves, borrowed for the call; then `rows` is not
                              called. NULL: ask `rows` */
    size_t npoints;        /**< the rows are displacements of so many points, L = 3 npoints; 0: of
                              nothing */
    const double *xyz;     /**< the points of the parent, npoints triples, metres; copied; NULL
                              without */
    double reserved[6];    /**< 0: room for members of later releases */
} galv_data;

/** The latent space of a data set: as galv_build(), without parameters, so galv_backmap() and
 * galv_extend() are not possible. With points the model displaces them as any other
 * (galv_displace()), and options->weights are theirs unless data->weights are given; without,
 * options->weights is not used. options->extra is not used.
 * @return GALV_ERROR_ARGUMENT where coordinates are not 3 npoints; else as galv_build() */
GALV_API galv_status galv_build_data(const galv_data *data, const galv_options *options,
                                     galv_model **model);

/**
 * The latent space of a model's samples and more. The old samples enter through their known
 * eigenpairs, so this costs as much as building from the new samples alone; what the old spectrum
 * had beyond its pairs is lost to the modes (not to the trace) and bounded by
 * galv_model_truncation().
 * @param shape     the shape of the model; borrowed
 * @param sampling  the new samples: sampling.first continues a uniform stream
 * @param options   variance, modes, spectrum, method, extra, workspace; centring and weights are
 * the model's
 * @param[out] extended created
 */
GALV_API galv_status galv_extend(const galv_model *model, const galv_shape *shape,
                                 galv_sampling sampling, const galv_options *options,
                                 galv_model **extended);

/** NULL is allowed. */
GALV_API void galv_model_free(galv_model *model);

/** @name Sizes
 * 0 for a model NULL.
 * @{ */
GALV_API size_t galv_model_samples(const galv_model *model); /**< N */
GALV_API size_t galv_model_points(const galv_model *model);  /**< E */
GALV_API size_t
galv_model_coordinates(const galv_model *model); /**< L = 3 E + appended quantities */
GALV_API size_t
galv_model_active(const galv_model *model); /**< coordinates that move in some sample */
GALV_API size_t galv_model_parameters(const galv_model *model); /**< n of the shape sampled */
GALV_API size_t galv_model_modes(const galv_model *model);      /**< m */
GALV_API size_t galv_model_spectrum(const galv_model *model);   /**< eigenvalues known, >= m */
GALV_API size_t galv_model_passes(const galv_model *model); /**< over the samples while building */
/** Whether the mean of the samples is subtracted. */
GALV_API bool galv_model_centred(const galv_model *model);
/** @} */

/** @name Numbers
 * Arrays are borrowed from the model. NaN or NULL for a model NULL.
 * @{ */
GALV_API double galv_model_retained(const galv_model *model); /**< eq. 9 for the m modes, 0..1 */
GALV_API double galv_model_trace(const galv_model *model);    /**< exact trace of C, m^2 */
/** Eq. 9 for the displacements alone: what the modes retain of their variance. Equal to
 * galv_model_retained() without appended quantities. */
GALV_API double galv_model_retained_geometry(const galv_model *model);
/** How much an eigenvalue may be too low because galv_extend() dropped the tail of a spectrum, m^2;
 * 0 for a model from galv_build(). */
GALV_API double galv_model_truncation(const galv_model *model);
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
/** The points of the parent, npoints triples; NULL without points. */
GALV_API const double *galv_model_parent(const galv_model *model);
/** Weights of the coordinates (L), or NULL when all are 1. */
GALV_API const double *galv_model_weights(const galv_model *model);
/** The projected samples u_r: N rows of m numbers. */
GALV_API const double *galv_model_latent(const galv_model *model);
/** The method that found the spectrum (never GALV_METHOD_AUTO). */
GALV_API galv_method galv_model_method(const galv_model *model);
/** Box of the projected samples (m each): least and greatest u_k over the samples. */
GALV_API const double *galv_model_lower(const galv_model *model);
/** Upper ends of the same. Borrowed; NULL of NULL. */
GALV_API const double *galv_model_upper(const galv_model *model);
/** @} */

/** Whether N was enough. All figures are NaN for N < 20. */
typedef struct galv_confidence {
    double retained_fresh; /**< share of the variance of fresh samples that the modes retain, by
                                cross-validation over ten groups: galv_model_retained() tells of the
                                samples that the modes were fitted to, and flatters a small N */
    double retained_error; /**< standard error of that share */
    double angle; /**< greatest principal angle, radians, between the modes of every other sample
                     and those of all: for independent samples also the size of the angle between
                     the modes found and those of infinitely many samples */
    double reserved[4]; /**< 0: room for members of later releases */
} galv_confidence;

/** What fresh samples say of the modes; NAN of NULL and of models without samples. */
GALV_API galv_confidence galv_model_confidence(const galv_model *model);

/**
 * Bounds of the latent coordinates that hold a share of the samples, coordinate by coordinate: the
 * box for coverage 1, the (1 - coverage)/2 quantiles from both ends otherwise.
 * @param coverage (0, 1]
 * @param[out] lower,upper  m each, filled
 */
GALV_API galv_status galv_latent_bounds(const galv_model *model, double coverage, double *lower,
                                        double *upper);

/** Radius r of the ellipsoid sum_k u_k^2 / lambda_k <= r^2 that holds a share (0, 1] of the
 * samples. */
GALV_API galv_status galv_latent_ellipsoid(const galv_model *model, double coverage,
                                           double *radius);

/** How far a latent point is from what was sampled, in the metric sum_k u_k^2 / lambda_k: from the
 * origin, and from the nearest sample. Either result may be NULL. Cost O(N m). */
GALV_API galv_status galv_latent_distance(const galv_model *model, const double *u, double *radius,
                                          double *nearest);

/** Latent coordinates of a displacement, u = W1^T (d - mean): d has L numbers, u m, filled.
 * Here and in the calls below GALV_ERROR_NUMERIC: finite numbers whose sum is not. */
GALV_API galv_status galv_project(const galv_model *model, const double *d, double *u);

/** Displacement of a latent point, d = mean + W1 u: u has m numbers, d L, filled. The same bits on
 * every machine and for any number of threads. */
GALV_API galv_status galv_reconstruct(const galv_model *model, const double *u, double *d);

/** The points of a latent point's hull: parent + d, npoints triples, filled. */
GALV_API galv_status galv_displace(const galv_model *model, const double *u, double *moved);

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

/** @name A model as a table
 * Everything a model holds, as fields with names: what is written to a file or a database in a loop
 * over the fields, and made into the same model again, bit for bit.
 * @{ */

/** What a field holds. */
typedef enum galv_type {
    GALV_TYPE_DOUBLE,
    GALV_TYPE_SIZE, /**< size_t */
    GALV_TYPE_BOOL,
} galv_type;

/** A named field of a model. */
typedef struct galv_field {
    const char *name; /**< static: "samples", "vectors", ... */
    galv_type type;   /**< arrays are of doubles */
    int dimensions;   /**< 0 a number, 1 an array of `rows`, 2 a matrix, row by row */
    size_t rows, columns;
    const void *values; /**< rows x columns of them; NULL: the model has no such field (weights all
                           1, no points, no parameters) */
} galv_field;

/** Fields of every model. */
GALV_API size_t galv_model_field_count(void);

/** Field `index` of a model, its values borrowed from it. model NULL: name, type and dimensions
 * alone, as a reader needs them. An index too large gives the name "". */
GALV_API galv_field galv_model_field(const galv_model *model, size_t index);

/** The value (the first of an array) as a double, whatever the type; NaN without values. */
GALV_API double galv_field_number(const galv_field *field);

/**
 * A model from its fields.
 * @param n,fields  in any order; numbers of any type may be given as doubles; absent ones may be
 * left out or have the values NULL; all are copied
 * @param[out] model created
 * @return GALV_ERROR_ARGUMENT names the field that is missing, unknown, of another size, or has a
 * value that no model has.
 */
GALV_API galv_status galv_model_restore(size_t n, const galv_field *fields, galv_model **model);
/** @} */

#ifdef __cplusplus
}
#endif

#endif
