/**
 * @file design.h
 * Designs of experiments on a box: where to evaluate before anything is known.
 *
 * Points are rows of an n x d array in [0,1]^d. Everything is determined by the seed.
 */
#ifndef BAYESOPT_DESIGN_H
#define BAYESOPT_DESIGN_H

#include <bayesopt/status.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Kinds of design. */
typedef enum bayesopt_design_kind {
    BAYESOPT_DESIGN_UNIFORM,      /**< independent uniform points */
    BAYESOPT_DESIGN_LHS,          /**< random Latin hypercube */
    BAYESOPT_DESIGN_ANNEALED_LHS, /**< Latin hypercube, column swaps annealed on the Audze-Eglais
                                     energy */
    BAYESOPT_DESIGN_SOBOL,        /**< Sobol sequence with Owen scrambling */
    BAYESOPT_DESIGN_STLBO, /**< teaching-learning sampling, Khan and Gunpinar, CAD 100 (2018) 52-67
                            */
} bayesopt_design_kind;

/** Name ("annealed-lhs") of a kind, "unknown" outside the list. */
BAYESOPT_API const char *bayesopt_design_name(bayesopt_design_kind kind);

/**
 * A constraint known without evaluating the objective (a displacement to keep, a linkage that must
 * close). Fills value[m]; value[i] <= 0 is feasible. A non-zero return means that x cannot be
 * judged and is treated as infeasible. Called often: some thousand times per proposal; must be
 * re-entrant and give the same values for the same x.
 */
typedef int (*bayesopt_input_constraint)(void *user_data, size_t d, const double *x, double *value);

/** Options of bayesopt_design(); fill with bayesopt_design_options_init(). */
typedef struct bayesopt_design_options {
    uint64_t seed; /**< default 1 */
    size_t swaps;  /**< annealing moves; default 0 = 100 n, at least 20000 */
    double
        power; /**< energy sum 1/dist^power; default 2 (Audze-Eglais); 50 = phi_p, near maximin */
    size_t n_constraints;                 /**< values of constraint; default 0 */
    bayesopt_input_constraint constraint; /**< on points of [0,1]^d; default NULL */
    void *constraint_user_data;           /**< passed to constraint */
    double latin_weight; /**< BAYESOPT_DESIGN_STLBO and constrained designs: weight of the Latin
                              hypercube term over the mean energy of a point; default 1 */
    size_t n_existing;   /**< points already there, which the design keeps away from; default 0 */
    const double *existing; /**< [n_existing x d] borrowed */
    double reserved[8];     /**< 0: room for members of later releases */
} bayesopt_design_options;

/** Fills the defaults. */
BAYESOPT_API void bayesopt_design_options_init(bayesopt_design_options *options);

/**
 * Fills x [n x d] with a design.
 * @param options  NULL: the defaults
 * @return BAYESOPT_ERROR_ARGUMENT; BAYESOPT_ERROR_INFEASIBLE if no point was found that satisfies
 *         the constraints
 */
BAYESOPT_API bayesopt_status bayesopt_design(bayesopt_design_kind kind, size_t n, size_t d,
                                             const bayesopt_design_options *options, double *x);

/** How well a design fills the box. */
typedef struct bayesopt_design_quality {
    double audze_eglais; /**< sum over pairs of 1/dist^2; small is good */
    double phi_p;        /**< (sum over pairs of 1/dist^50)^(1/50); small is good */
    double min_distance; /**< least distance of two points; large is good */
    double discrepancy;  /**< centred L2 discrepancy, Hickernell, Math. Comp. 67 (1998) 299 */
    double occupied;    /**< share of the n d one-dimensional bins of width 1/n that hold a point */
    double reserved[8]; /**< 0: room for members of later releases */
} bayesopt_design_quality;

/** Measures n points of [0,1]^d; O(n^2 d). Infinite energies are returned for coincident points. */
BAYESOPT_API bayesopt_status bayesopt_design_measure(size_t n, size_t d, const double *x,
                                                     bayesopt_design_quality *quality);

#ifdef __cplusplus
}
#endif

#endif
