/**
 * @file descent.h
 * A Gauss-Newton search over a box for objectives that are the worst of several sums of squares,
 * |r_m|^2, of residuals r_m that are nearly linear in x though their squares are not: amplitudes of
 * waves, misfits, field values. Other such sums may be bounded, functions known beforehand too, and
 * one more quantity that is a smooth function b of a vector s, the state, nearly linear in x.
 *
 * The caller has a fine evaluation, whose values count, and derivatives of it, or a coarse one
 * whose differences stand for them. Each step solves, about the fine values of the best point so
 * far,
 *
 *     min tau + penalty e   s.t.  |r_m + J_m d|^2 / C_m <= tau                       (objective),
 *                                 |r_m + J_m d|^2 / C_m <= offset_m + share_m tau + e   (others),
 *                                 b(s + S d) / B <= bound + e,
 *                                 known limits,   box,   |d| <= radius,   e >= 0
 *
 * C_m and B being the values at the start (Fletcher's Sl1QP, with the largest excess for their
 * sum). A step counts by its own fine values, in the same penalty function, and corrects the
 * derivatives by Broyden's update: a fine evaluation costs less than new derivatives, which are
 * taken where that no longer leads on. Nothing is random. It finds one optimum, that nearest to the
 * start.
 */
#ifndef BAYESOPT_DESCENT_H
#define BAYESOPT_DESCENT_H

#include <bayesopt/design.h>
#include <bayesopt/status.h>

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How the sum of squares of a setting, over that at the start, is bounded: offset + share tau. */
typedef struct bayesopt_descent_setting {
    double offset, share; /**< 0 and 1: part of the objective; b and 0: a limit b; 1 - f and f: it
                               must see at least the part f of the objective's gain */
} bayesopt_descent_setting;

/** What an evaluation says of a point. The arrays are the library's, to be filled. */
typedef struct bayesopt_descent_sample {
    double *residual; /**< [n_settings x n_residuals] */
    double *value;    /**< [n_settings] of a fine evaluation: the sums of squares, perhaps by a
                           better rule than that of the residuals */
    double *state;    /**< [n_state] */
    double bounded;   /**< of a fine evaluation: b, likewise */
    const struct bayesopt_descent_slopes *known; /**< of a coarse evaluation: whose derivatives are
                                                      known, and need no residuals or state; NULL:
                                                      none are. Borrowed */
    double reserved[4];                          /**< 0: room for members of later releases */
} bayesopt_descent_sample;

/** What became of an evaluation. */
typedef enum bayesopt_descent_answer {
    BAYESOPT_DESCENT_VALUED, /**< the sample is filled */
    BAYESOPT_DESCENT_FAILED, /**< there is no value here: a step gets shorter, a difference is taken
                                  to the other side. Numbers that are not finite count as this */
    BAYESOPT_DESCENT_STOP,   /**< end the search */
} bayesopt_descent_answer;

/** Fills a sample at x [d]. */
typedef bayesopt_descent_answer (*bayesopt_descent_evaluate)(void *user_data, const double *x,
                                                             bayesopt_descent_sample *sample);

/** Derivatives that need no differences. The arrays are the library's, to be filled. */
typedef struct bayesopt_descent_slopes {
    double *residual;   /**< [n_settings x d x n_residuals] of setting m, by variable k */
    double *state;      /**< [d x n_state] */
    bool *known;        /**< [n_settings] false before: true where a setting's are filled */
    bool state_known;   /**< likewise */
    double reserved[4]; /**< 0: room for members of later releases */
} bayesopt_descent_slopes;

/** Fills what is known of the derivatives of a fine evaluation at x [d], where there was one
 * before; the rest is left to differences. BAYESOPT_DESCENT_FAILED leaves all of it. */
typedef bayesopt_descent_answer (*bayesopt_descent_differentiate)(void *user_data, const double *x,
                                                                  bayesopt_descent_slopes *slopes);

/** b of a state [n_state]. gradient: [n_state] filled with db/ds; NULL: not wanted. */
typedef double (*bayesopt_descent_function)(void *user_data, const double *state, double *gradient);

/** A problem; fill with bayesopt_descent_problem_init() first. Everything is borrowed for the call,
 * and by a model for its life. */
typedef struct bayesopt_descent_problem {
    size_t d;                                /**< variables, 1 to 1000 */
    const double *lower, *upper;             /**< [d] finite, increasing */
    size_t n_settings;                       /**< sums of squares, at least 1 */
    const bayesopt_descent_setting *setting; /**< [n_settings] one of them at least is part of the
                                                  objective; numbers, share not negative */
    size_t n_residuals;                      /**< of each setting, at least 1 */
    size_t n_state;                          /**< default 0: no state */
    bayesopt_descent_function function;      /**< b; NULL without a state */
    double bound;                     /**< of b over that at the start; default NAN: not bounded */
    size_t n_limits;                  /**< values of limit; default 0 */
    bayesopt_input_constraint limit;  /**< known without evaluating, <= 0 allowed; default NULL */
    bayesopt_descent_evaluate fine;   /**< values that count: some for each derivative */
    bayesopt_descent_evaluate coarse; /**< for differences: d + 1 for each derivative; NULL with
                                           derivatives that are all known */
    bayesopt_descent_differentiate derivatives;          /**< default NULL: all by differences */
    void (*tell)(void *user_data, const char *sentence); /**< hears of each step; default NULL */
    void *user_data;                                     /**< passed to all of these */
    double reserved[8]; /**< 0: room for members of later releases */
} bayesopt_descent_problem;

/** Fills the defaults, everything else with 0; nothing when NULL. */
BAYESOPT_API void bayesopt_descent_problem_init(bayesopt_descent_problem *problem);

/**
 * Searches until new derivatives led to less than 0.5 % of the objective at the start and promise
 * less than 0.1 %, or an evaluation says stop.
 * @param x      [d] the start, within the bounds; filled with the best point within all limits, or
 *               with that of the least objective when there is none
 * @param ratio  filled with the objective there over that at the start; NULL allowed
 * @return BAYESOPT_OK; BAYESOPT_STOP_BUDGET when an evaluation said stop; BAYESOPT_NONE_FEASIBLE;
 *         BAYESOPT_ERROR_ARGUMENT; BAYESOPT_ERROR_NUMERIC if the start has no value, or one that is
 *         not positive; BAYESOPT_ERROR_MEMORY
 */
BAYESOPT_API bayesopt_status bayesopt_descend(const bayesopt_descent_problem *problem, double *x,
                                              double *ratio);

/** The model of the first step: what a search may gain, from one fine evaluation and one
 * derivative. */
typedef struct bayesopt_descent_model bayesopt_descent_model;

/** Creates the model at start [d] (NULL: 0), within the bounds; release with
 * bayesopt_descent_model_free(). Errors as those of bayesopt_descend(), BAYESOPT_ERROR_CANCELLED
 * when an evaluation said stop. */
BAYESOPT_API bayesopt_status bayesopt_descent_model_create(const bayesopt_descent_problem *problem,
                                                           const double *start,
                                                           bayesopt_descent_model **model);
/** Releases a model; NULL is allowed. */
BAYESOPT_API void bayesopt_descent_model_free(bayesopt_descent_model *model);

/**
 * Minimises the model over the part of the box around a centre, stretched so far that it holds the
 * start too; no evaluation is made.
 * @param problem  that of the model, or one with other settings, bound, limits or bounds of the
 *                 variables: d, n_settings, n_residuals, n_state and function are to be the same.
 *                 NULL: that of the model
 * @param centre   [d] NULL: the start
 * @param radius   around it, in half widths of the box; positive, INFINITY: the whole box
 * @param margin   by which the limits that only evaluations tell are tightened, on the scale of
 *                 their ratios
 * @param x        [d] filled
 * @param ratio    filled with the objective there over that at the start
 * @param broken   filled with the largest excess over the tightened limits; 0: they are kept; NULL
 *                 allowed
 * @return BAYESOPT_ERROR_INFEASIBLE if no point was found that keeps the known limits
 */
BAYESOPT_API bayesopt_status bayesopt_descent_model_minimise(
    bayesopt_descent_model *model, const bayesopt_descent_problem *problem, const double *centre,
    double radius, double margin, double *x, double *ratio, double *broken);

#ifdef __cplusplus
}
#endif

#endif
