/**
 * @file bayesopt.h
 * Bayesian optimisation of expensive functions, driven by the caller: ask for points, evaluate
 * them, tell the results.
 *
 *     bayesopt *bo;
 *     bayesopt_create(d, lower, upper, NULL, &bo);
 *     bayesopt_open_store(bo, "run.db");            (optional: durable and resumable)
 *     while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK) {
 *         if (simulate(x, &f)) bayesopt_tell(bo, id, f, NULL);
 *         else                 bayesopt_tell_failed(bo, id, "grid folded at the bulb");
 *     }
 *     bayesopt_best(bo, x, &f, NULL);
 *
 * The objective is minimised, or with an option maximised. All points are in the caller's units;
 * scaling to [0,1]^d is internal. What is proposed depends on the options, the seed and the history
 * alone, so an interrupted run that is resumed from its store continues with the points it would
 * have proposed uninterrupted.
 *
 * One object is used by one thread at a time. Several objects, in one process or many, may share
 * one store. Words on ownership: creates (the caller frees with the named function), borrows,
 * copies, fills (the caller's buffer).
 */
#ifndef BAYESOPT_BAYESOPT_H
#define BAYESOPT_BAYESOPT_H

#include <bayesopt/acquisition.h>
#include <bayesopt/descent.h>
#include <bayesopt/design.h>
#include <bayesopt/expression.h>
#include <bayesopt/gp.h>
#include <bayesopt/status.h>
#include <bayesopt/store.h>
#include <bayesopt/version.h>

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** An optimisation: bounds, options, history, model. */
typedef struct bayesopt bayesopt;

/** Where a point came from. */
typedef enum bayesopt_phase {
    BAYESOPT_PHASE_INITIAL,  /**< the initial design */
    BAYESOPT_PHASE_GLOBAL,   /**< maximiser of the acquisition over the whole box */
    BAYESOPT_PHASE_LOCAL,    /**< maximiser of the acquisition over the trust region */
    BAYESOPT_PHASE_POLISH,   /**< minimiser of the model's mean over the trust region */
    BAYESOPT_PHASE_EXTERNAL, /**< told by the caller without having been asked */
    BAYESOPT_PHASE_DESCENT,  /**< minimiser of a quadratic through the nearest points */
} bayesopt_phase;

/** What became of a point. */
typedef enum bayesopt_state {
    BAYESOPT_STATE_PENDING, /**< asked, not told */
    BAYESOPT_STATE_DONE,    /**< told with a finite value */
    BAYESOPT_STATE_FAILED,  /**< told as failed, or with a value that is not finite */
    BAYESOPT_STATE_LOST,    /**< told as failed for a reason that is not the point's; not learnt */
} bayesopt_state;

/** What values a variable takes. */
typedef enum bayesopt_kind {
    BAYESOPT_KIND_REAL,        /**< all between its bounds; one that equals the other fixes it */
    BAYESOPT_KIND_LOG,         /**< the same, searched on a scale of logarithms; positive bounds */
    BAYESOPT_KIND_INTEGER,     /**< whole numbers, or ranks of values in order; whole bounds */
    BAYESOPT_KIND_CATEGORICAL, /**< names without order, numbered by whole bounds */
} bayesopt_kind;

/** Which proposals follow the initial design. */
typedef enum bayesopt_strategy {
    BAYESOPT_STRATEGY_AUTO, /**< global, trust-region and polishing steps as the history suggests */
    BAYESOPT_STRATEGY_GLOBAL, /**< global steps only (classical efficient global optimisation) */
    BAYESOPT_STRATEGY_LOCAL,  /**< trust-region steps only, with restarts */
} bayesopt_strategy;

/** What a global or local step maximises. */
typedef enum bayesopt_acquisition {
    BAYESOPT_ACQUISITION_EI,  /**< log expected improvement; with noise its expectation over the
                                   unknown values at the evaluated points (Letham et al., Bayesian
                                   Analysis 14 (2019) 495), by quasi-Monte Carlo */
    BAYESOPT_ACQUISITION_LCB, /**< minus the lower confidence bound mean - lcb_factor sd */
} bayesopt_acquisition;

/** Name of a phase ("global"), state ("done") or strategy ("auto"); "unknown" outside the list. */
BAYESOPT_API const char *bayesopt_phase_name(bayesopt_phase phase);
/** Name of a state, static; "unknown" for none. */
BAYESOPT_API const char *bayesopt_state_name(bayesopt_state state);
/** Name of a strategy, static; "unknown" for none. */
BAYESOPT_API const char *bayesopt_strategy_name(bayesopt_strategy strategy);
/** Name of a kind ("integer"); "unknown" outside the list. */
BAYESOPT_API const char *bayesopt_kind_name(bayesopt_kind kind);

/** Options of bayesopt_create(); fill with bayesopt_options_init() first. Arrays are borrowed until
 * bayesopt_create() returns, which copies them; input_user_data is borrowed for the object's life.
 */
typedef struct bayesopt_options {
    uint64_t seed;          /**< of every random stream; default 1 */
    size_t max_evaluations; /**< budget: initial, failed and told points included; default 0 = twice
                                 the initial design plus 10. bayesopt_ask() then stops */

    bayesopt_design_kind initial_kind; /**< default BAYESOPT_DESIGN_ANNEALED_LHS */
    size_t initial_n;        /**< points of the initial design; default 0 = min(10 d, 200) */
    const double *initial_x; /**< own initial design, initial_n x d, instead; default NULL */

    size_t n_constraints;           /**< outcome constraints told with each value; default 0 */
    const double *constraint_lower; /**< [n_constraints], -INFINITY allowed; NULL = all -INFINITY */
    const double *constraint_upper; /**< [n_constraints], +INFINITY allowed; NULL = all 0. A narrow
                                         band lower < c < upper expresses an equality */

    size_t n_input_constraints;                 /**< values of input_constraint; default 0 */
    bayesopt_input_constraint input_constraint; /**< known before evaluation; see design.h */
    void *input_user_data;                      /**< passed to input_constraint */
    size_t n_linear;                            /**< rows of linear_a x <= linear_b; default 0 */
    const double *linear_a;                     /**< [n_linear x d], row by row */
    const double *linear_b;                     /**< [n_linear] */

    bayesopt_noise noise;   /**< default BAYESOPT_NOISE_DETERMINISTIC */
    bayesopt_kernel kernel; /**< default BAYESOPT_KERNEL_MATERN52 */
    bayesopt_scales scales; /**< default BAYESOPT_SCALES_AUTO: isotropic or ARD, the likelier */
    const size_t *group;    /**< [d] BAYESOPT_SCALES_TIED: group of each variable, see gp.h */
    bayesopt_mean mean;     /**< of the objective; default BAYESOPT_MEAN_CONSTANT, or LINEAR */
    bayesopt_choice choice; /**< between models; default BAYESOPT_CHOICE_POSTERIOR */
    bayesopt_transform transform; /**< of the objective; default BAYESOPT_TRANSFORM_AUTO */
    bayesopt_strategy strategy;   /**< default BAYESOPT_STRATEGY_AUTO */
    bool polish; /**< allow polishing steps with BAYESOPT_STRATEGY_AUTO; default true */
    bayesopt_acquisition acquisition; /**< default BAYESOPT_ACQUISITION_EI */
    double lcb_factor;                /**< sd below the mean; positive, default 2 */

    size_t n_levels; /**< 1, or 2: a cheap level 0 beside the dear level 1, whose value counts; the
                          initial design is then evaluated at level 0 and its first quarter at level
                          1 too (ordered so that it covers the box, unless initial_x is given);
                        every evaluation counts against the budget; default 1 */
    double level_cost_ratio; /**< cost of the cheap level over that of the dear one; default 0.1 */

    size_t stop_no_improvement; /**< stop after so many proposals in a row without improvement;
                                     default 0 = never */
    double stop_expected_improvement; /**< stop when the largest expected improvement over the box
                                         is below this many units of f, judged at global steps of
                                         BAYESOPT_ACQUISITION_EI; default 0 = never */

    const bayesopt_kind *kind; /**< [d] of the variables; default NULL = all real */
    bool maximise;            /**< the objective is maximised: values are told, kept and returned as
                                   they are; default false */
    const char *const *names; /**< [d] of the variables, for conditions and messages; default NULL =
                                   x1, x2, ... */
    size_t n_conditions;      /**< default 0 */
    const char *const *conditions; /**< [n_conditions] input constraints as texts, "a + b <= 2" or
                                        "a == 3 * b": see expression.h. They are kept in the store,
                                        which therefore needs no callback. An equality holds to 1e-6
                                        of what its two sides differ by over the box */
    size_t n_first;                /**< points to be evaluated first; default 0 */
    const double *first_x; /**< [n_first x d]; they take the first places of the initial design,
                                whose others keep away from them */
    bool told_count; /**< points told before the first ask take places of the initial design too,
                          whose others keep away from them; one level; default false */

    size_t
        n_objectives; /**< 1 to 3; default 1, which 0 means too. With more than one the Pareto set
                         is sought by expected hypervolume improvement, and the others are told as
                         the last n_objectives - 1 of the outcomes, behind the constraints */
    const bool *maximise_others; /**< [n_objectives - 1] default NULL = all are minimised */
    double threads;     /**< of the BLAS of the whole process during asks and tells, a whole
                             number up to 1024; default 0 = as OpenBLAS decides. Not kept in
                             the store */
    double reserved[5]; /**< 0: room for members of later releases */
} bayesopt_options;

/** Fills the defaults. */
BAYESOPT_API void bayesopt_options_init(bayesopt_options *options);

/**
 * Creates an optimisation over the box lower <= x <= upper; release with bayesopt_free().
 * @param d        number of variables, 1 to 1000
 * @param lower    [d] copied, finite
 * @param upper    [d] copied, finite, not less than lower; equal: the variable is fixed
 * @param options  NULL: the defaults
 * @return BAYESOPT_ERROR_ARGUMENT with the field at fault, BAYESOPT_ERROR_MEMORY
 */
BAYESOPT_API bayesopt_status bayesopt_create(size_t d, const double *lower, const double *upper,
                                             const bayesopt_options *options, bayesopt **bo);

/** Releases the object and closes its store. Points asked and not told are offered again by the
 * next session on the store, unless bayesopt_detach() was called. NULL is allowed. */
BAYESOPT_API void bayesopt_free(bayesopt *bo);

/**
 * Keeps the history in the SQLite file @p path: creates it, or resumes from it. Call it before the
 * first ask or tell. From then on every ask and tell is on disk before it returns, whatever happens
 * to the process afterwards; points asked by a session that died are asked again, under their old
 * ids.
 *
 * What the caller wants to keep beside the history goes through store.h. All tables are called
 * bayesopt_*; after this call the caller may still add tables of its own to the same file through
 * its own connection (set a busy timeout: an ask holds the write lock while it computes); they are
 * left alone. Stores of older versions are brought up to date.
 *
 * @return BAYESOPT_ERROR_FILE, BAYESOPT_ERROR_FORMAT for a damaged file, a database that is not
 *         such a store or one that a newer version wrote, BAYESOPT_ERROR_ARGUMENT if its problem
 * (d, bounds, seed, initial design, constraints) is not this one's
 */
BAYESOPT_API bayesopt_status bayesopt_open_store(bayesopt *bo, const char *path);

/**
 * Creates an optimisation from an existing store alone.
 * @param input_constraint  the callback the store was created with, if any; NULL then still allows
 *                          everything except new proposals
 */
BAYESOPT_API bayesopt_status bayesopt_open(const char *path,
                                           bayesopt_input_constraint input_constraint,
                                           void *input_user_data, bayesopt **bo);

/**
 * Creates an optimisation from an existing store, for looking only: nothing in the file or its
 * folder is written, which both may forbid; only what a process that died left unfinished is undone
 * first, for which they must allow it. History, best point, model and records are there; ask, tell
 * and whatever else would write return BAYESOPT_ERROR_ARGUMENT.
 */
BAYESOPT_API bayesopt_status bayesopt_open_read(const char *path, bayesopt **bo);

/** Leaves the points asked in this session pending after bayesopt_free(): they will be told later,
 * perhaps by another process. Without a store there is nothing to leave and nothing happens. */
BAYESOPT_API bayesopt_status bayesopt_detach(bayesopt *bo);

/** A sign of life for a pending point, or with id 0 for all that this session holds: whoever works
 * for long gives one from time to time, and bayesopt_reclaim_stale() leaves the point alone.
 * @return BAYESOPT_ERROR_ARGUMENT if the id is unknown or not pending */
BAYESOPT_API bayesopt_status bayesopt_heartbeat(bayesopt *bo, uint64_t id);

/** Who holds a pending point of a store. */
typedef struct bayesopt_holder {
    char host[256];      /**< name of the machine that asked it, "" if nobody holds it any more */
    long long process;   /**< number of the process there */
    double asked, heard; /**< seconds since it was asked, and since the last sign of life */
    bool alive;    /**< the process runs on this host, or may on another: that cannot be seen */
    bool detached; /**< the session has ended and left the point to be told by another */
    double reserved[8]; /**< 0: room for members of later releases */
} bayesopt_holder;

/** Fills the holder of a pending point; without a store this process holds it.
 * @return BAYESOPT_ERROR_ARGUMENT if the id is unknown or not pending */
BAYESOPT_API bayesopt_status bayesopt_get_holder(bayesopt *bo, uint64_t id,
                                                 bayesopt_holder *holder);

/** Makes every pending point whose session is over, detached or not, to be asked again. */
BAYESOPT_API bayesopt_status bayesopt_reclaim(bayesopt *bo);

/** The same for those whose holder gave its last sign of life (its ask, or bayesopt_heartbeat())
 * @p seconds ago or longer, by the clock of the machine; with seconds > 0 also those of sessions
 * on other hosts, of which nothing else is known. Never a point that a process of this host still
 * holds. Not negative; 0: all. */
BAYESOPT_API bayesopt_status bayesopt_reclaim_stale(bayesopt *bo, double seconds);

/**
 * The next points to evaluate: first those left over by a dead session, then new ones.
 * @param n    how many
 * @param x    [n x d] filled, within the bounds and the input constraints
 * @param ids  [n] filled; greater than 0. If fewer than n points remain of the budget the rest of
 * ids is 0 and the rest of x untouched
 * @return BAYESOPT_OK with at least one point; BAYESOPT_STOP_BUDGET, BAYESOPT_STOP_NO_IMPROVEMENT,
 * BAYESOPT_STOP_EXPECTED_IMPROVEMENT or, without noise, BAYESOPT_STOP_EXHAUSTED (all positive) with
 * none; BAYESOPT_ERROR_INFEASIBLE if no point satisfies the input constraints
 */
BAYESOPT_API bayesopt_status bayesopt_ask(bayesopt *bo, size_t n, double *x, uint64_t *ids);

/** bayesopt_ask() for two levels of fidelity: levels [n] filled with 0 (cheap) or 1 (dear). With
 * one level every entry is 0. */
BAYESOPT_API bayesopt_status bayesopt_ask_levels(bayesopt *bo, size_t n, double *x, uint64_t *ids,
                                                 int *levels);

/**
 * Called by bayesopt_ask() many times per proposal, with the number of points found so far
 * of those wanted. A non-zero return cancels: nothing is asked, and the call returns
 * BAYESOPT_ERROR_CANCELLED.
 */
typedef int (*bayesopt_ask_progress)(void *user_data, size_t found, size_t wanted);

/** Sets the callback of bayesopt_ask(); NULL: none, which is the default. */
BAYESOPT_API bayesopt_status bayesopt_set_ask_progress(bayesopt *bo, bayesopt_ask_progress progress,
                                                       void *user_data);

/** All that may be known about one evaluation. */
typedef struct bayesopt_result {
    double f; /**< the objective; not finite = failed */
    const double
        *constraints; /**< [n_constraints + n_objectives - 1] borrowed; NULL if there are none */
    const double
        *gradient;    /**< [d] df/dx borrowed; NULL if not known. The best 400/d points' are used */
    double variance;  /**< of f, with BAYESOPT_NOISE_KNOWN; else 0 */
    const char *note; /**< copied into the history; NULL for none */
    bool transient; /**< a failure that says nothing of the point (a licence, a full disk): nothing
                         is learnt from it */
    size_t n_attributes;                  /**< default 0 */
    const bayesopt_attribute *attributes; /**< [n_attributes] copied, kept with the value or the
                                             failure and written in the same transaction */
    bool outside; /**< bayesopt_tell_point_result(): the point may lie outside of the bounds. If it
                       does it serves the model alone: it is never the best and costs no budget */
    double reserved[8]; /**< 0: room for members of later releases */
} bayesopt_result;

/**
 * The value at an asked point.
 * @param f            objective; a value that is not finite counts as a failed evaluation
 * @param constraints  [n_constraints + n_objectives - 1] outcomes, NULL if there are none; a value
 * that is not finite makes the evaluation failed
 * @return BAYESOPT_ERROR_ARGUMENT if the id is unknown or was told before
 */
BAYESOPT_API bayesopt_status bayesopt_tell(bayesopt *bo, uint64_t id, double f,
                                           const double *constraints);

/** bayesopt_tell() with everything that is known. */
BAYESOPT_API bayesopt_status bayesopt_tell_result(bayesopt *bo, uint64_t id,
                                                  const bayesopt_result *result);

/** The evaluation at an asked point failed; @p reason is copied, NULL allowed. The neighbourhood is
 * learnt to be risky; the value of the objective there stays unknown. */
BAYESOPT_API bayesopt_status bayesopt_tell_failed(bayesopt *bo, uint64_t id, const char *reason);

/**
 * Makes a point to be asked again, before new ones: a pending one, whoever holds it, or a failed or
 * lost one, whose failure is forgotten and no longer counts.
 * @return BAYESOPT_ERROR_ARGUMENT if the id is unknown or the point has a value
 */
BAYESOPT_API bayesopt_status bayesopt_release(bayesopt *bo, uint64_t id);

/**
 * An evaluation made elsewhere (a parent design, an earlier study). It counts against the budget
 * and joins the data; the point may lie outside the input constraints, and outside the bounds only
 * if result.outside allows it.
 * @param x            [d] copied
 * @param f            as in bayesopt_tell()
 * @param constraints  as in bayesopt_tell()
 */
BAYESOPT_API bayesopt_status bayesopt_tell_point(bayesopt *bo, const double *x, double f,
                                                 const double *constraints);

/** bayesopt_tell_point() with everything that is known.
 * @param id  filled with the id it got; NULL allowed */
BAYESOPT_API bayesopt_status bayesopt_tell_point_result(bayesopt *bo, const double *x,
                                                        const bayesopt_result *result,
                                                        uint64_t *id);

/**
 * The best evaluated point so far: least f among those that satisfy the outcome constraints. With
 * noise f is the model's mean there and the constraints are judged by their models' means, since
 * the least of many noisy values owes more to luck than to the point.
 * @param x   [d] filled; NULL allowed
 * @param f   filled; NULL allowed
 * @param id  filled; NULL allowed
 * @return BAYESOPT_OK; BAYESOPT_NONE_FEASIBLE (positive) with the point of least constraint
 *         violation; BAYESOPT_ERROR_ARGUMENT if nothing has been evaluated successfully
 */
BAYESOPT_API bayesopt_status bayesopt_best(bayesopt *bo, double *x, double *f, uint64_t *id);

/** The same by the values as they were told: without noise what bayesopt_best() gives, with noise
 * the luckiest evaluation. */
BAYESOPT_API bayesopt_status bayesopt_best_told(const bayesopt *bo, double *x, double *f,
                                                uint64_t *id);

/** One row of the history. Pointers are borrowed until the next call that changes the object. */
typedef struct bayesopt_point {
    uint64_t id;               /**< 1, 2, ... in the order of asking */
    bayesopt_phase phase;      /**< where it came from */
    bayesopt_state state;      /**< what became of it */
    int level;                 /**< fidelity level */
    const double *x;           /**< [d] */
    double f;                  /**< NAN unless done */
    const double *constraints; /**< [n_constraints], NULL unless done or if there are none */
    const double *gradient;    /**< [d] or NULL */
    double variance;           /**< of f */
    const char *note;          /**< reason of the failure, or the caller's note; "" if none */
    bool feasible;             /**< done, and within the outcome constraints */
    size_t n_attributes;
    const bayesopt_attribute *attributes; /**< [n_attributes] what was told beside the value */
    bool outside;                         /**< of the bounds: known to the model only */
    double reserved[8];                   /**< 0: room for members of later releases */
} bayesopt_point;

/** Number of points in the history, pending ones included. */
BAYESOPT_API size_t bayesopt_count(const bayesopt *bo);

/** Fills row i, 0 <= i < bayesopt_count(), in the order of asking. */
BAYESOPT_API bayesopt_status bayesopt_get(const bayesopt *bo, size_t i, bayesopt_point *point);

/** Reads what other processes have added to the store since; ask and tell do so themselves. */
BAYESOPT_API bayesopt_status bayesopt_refresh(bayesopt *bo);

/** Number of variables; fills the bounds ([d] each, NULL allowed). */
BAYESOPT_API size_t bayesopt_dimension(const bayesopt *bo, double *lower, double *upper);

/** Number of objectives. */
BAYESOPT_API size_t bayesopt_objective_count(const bayesopt *bo);

/**
 * The Pareto set of what was told: points within the outcome constraints of which none is better in
 * one objective without being worse in another.
 * @param n     filled with their number
 * @param rows  [bayesopt_count()] filled with their rows in the history, by increasing first
 * objective as it was told; NULL: only count
 */
BAYESOPT_API bayesopt_status bayesopt_pareto(const bayesopt *bo, size_t *n, size_t *rows);

/** Volume that n points [n x m] of objectives to be minimised dominate below a reference point [m],
 * 1 <= m <= 8; points that are not below it add nothing. By slices, O(n^(m-1)). */
BAYESOPT_API bayesopt_status bayesopt_hypervolume(size_t m, size_t n, const double *points,
                                                  const double *reference, double *volume);

/** Number of outcomes told beside f: constraints, then, with bounds of -INFINITY and INFINITY, the
 * other objectives. Fills their bounds ([n] each, NULL allowed). */
BAYESOPT_API size_t bayesopt_constraint_count(const bayesopt *bo, double *lower, double *upper);

/** Budget, size of the initial design, and seed. */
BAYESOPT_API size_t bayesopt_budget(const bayesopt *bo);
/** Points of the initial design; 0 of NULL. */
BAYESOPT_API size_t bayesopt_initial_count(const bayesopt *bo);
/** The seed of the run; 0 of NULL. */
BAYESOPT_API uint64_t bayesopt_seed(const bayesopt *bo);

/** Kind of variable j; BAYESOPT_KIND_REAL outside of the list. */
BAYESOPT_API bayesopt_kind bayesopt_variable_kind(const bayesopt *bo, size_t j);

/** Name of variable j, borrowed for the object's life; "" outside of the list. */
BAYESOPT_API const char *bayesopt_variable_name(const bayesopt *bo, size_t j);

/** Whether the objective is maximised. */
BAYESOPT_API bool bayesopt_maximises(const bayesopt *bo);

/** Levels of fidelity, 1 or 2. */
BAYESOPT_API size_t bayesopt_level_count(const bayesopt *bo);

/** Replaces the budget (0 = the default); a finished run may go on. */
BAYESOPT_API bayesopt_status bayesopt_set_budget(bayesopt *bo, size_t max_evaluations);

/**
 * The model's opinion of the objective, fitted to the present history.
 * @param x     [n x d] within the bounds
 * @param mean  [n] filled: posterior median in units of f
 * @param sd    [n] filled: half the central 68 % interval in units of f; NULL allowed
 * @return BAYESOPT_ERROR_ARGUMENT with fewer than two successful evaluations
 */
BAYESOPT_API bayesopt_status bayesopt_predict(bayesopt *bo, size_t n, const double *x, double *mean,
                                              double *sd);

/** The same of outcome k, counted from 1 in the order they are told in; k = 0 is the objective. */
BAYESOPT_API bayesopt_status bayesopt_predict_outcome(bayesopt *bo, size_t k, size_t n,
                                                      const double *x, double *mean, double *sd);

/**
 * Sobol' indices of the model's mean over the box, every value of a variable equally likely (on a
 * scale of logarithms where it has one): shares of the variance, to about 1/sqrt(n).
 * @param k      outcome as in bayesopt_predict_outcome(), 0: the objective
 * @param n      samples, 64 to 65536; 1024 is usual. n (d + 2) predictions
 * @param first  [d] filled: the share that the variable explains alone
 * @param total  [d] filled: the share that it has a part in
 * @return BAYESOPT_ERROR_ARGUMENT, also with more than 500 variables
 */
BAYESOPT_API bayesopt_status bayesopt_sensitivity(bayesopt *bo, size_t k, size_t n, double *first,
                                                  double *total);

/**
 * What the model of the objective, with its hyper-parameters kept, expects at each evaluated point
 * from the others alone.
 * @param n     filled: how many points; values told at one point count as one
 * @param told  [bayesopt_count()] filled, in units of f; likewise the predicted median and half its
 * central 68 % interval with noise
 */
BAYESOPT_API bayesopt_status bayesopt_leave_one_out(bayesopt *bo, size_t *n, double *told,
                                                    double *mean, double *sd);

/** What the current model is, for reports. */
typedef struct bayesopt_model_info {
    size_t n;                     /**< evaluations it is fitted to */
    bool isotropic;               /**< one length scale for all variables */
    bool wide;                    /**< the wide prior won over the tight one */
    bayesopt_transform transform; /**< of the objective */
    double log_posterior;         /**< of the hyper-parameters */
    double jitter;          /**< what the factorisation needed, relative to the signal variance */
    double signal_variance; /**< in squared units of the standardised objective */
    double noise_variance;  /**< likewise */
    double loo_rms;         /**< leave-one-out error over the standard deviation of the data */
    double repeat_sd;       /**< of values told at the same point, in units of f; NAN: there are
                                 none. With BAYESOPT_NOISE_DETERMINISTIC their mean is modelled */
    double trust_length;    /**< side of the trust region in [0,1] units */
    double reserved[8];     /**< 0: room for members of later releases */
} bayesopt_model_info;

/** Fits the model to the present history and describes it.
 * @param lengthscale  [d] filled, in the caller's units of x: with BAYESOPT_KIND_LOG of log x, with
 * BAYESOPT_KIND_CATEGORICAL of the distance 1 of two that differ; NULL allowed */
BAYESOPT_API bayesopt_status bayesopt_model(bayesopt *bo, bayesopt_model_info *info,
                                            double *lengthscale);

/** The objective for bayesopt_minimise(): fills *f and constraints [n_constraints] and returns 0,
 * or returns another number if it could not be evaluated. */
typedef int (*bayesopt_objective)(void *user_data, size_t d, const double *x, double *f,
                                  double *constraints);

/** Called after every evaluation with the history so far; a non-zero return cancels. */
typedef int (*bayesopt_progress)(void *user_data, const bayesopt *bo);

/**
 * The loop of ask and tell until the options say stop.
 * @return the positive reason for stopping, BAYESOPT_ERROR_CANCELLED, or another error
 */
BAYESOPT_API bayesopt_status bayesopt_minimise(bayesopt *bo, bayesopt_objective objective,
                                               void *user_data, bayesopt_progress progress,
                                               void *progress_user_data);

#ifdef __cplusplus
}
#endif

#endif
