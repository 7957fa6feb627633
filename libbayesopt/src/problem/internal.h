/* The optimisation object and what its source files share. */
#ifndef BAYESOPT_INTERNAL_H
#define BAYESOPT_INTERNAL_H

#include "core/front.h"
#include "core/random.h"
#include "design/region.h"
#include "problem/condition.h"
#include "problem/surrogate.h"

#include <bayesopt/bayesopt.h>

struct store;

/* Attributes with texts of their own. */
struct attributes {
    size_t n;
    bayesopt_attribute *items;
};

/* A point of the history. Arrays are owned. */
struct point {
    uint64_t id;
    bayesopt_phase phase;
    bayesopt_state state;
    int level;
    double *x;           /* [d] the caller's units */
    double *u;           /* [d] the same in [0,1]^d */
    double f;            /* to be minimised: with options.maximise minus what was told */
    double *constraints; /* [n_constraints] or NULL */
    double *gradient;    /* [d] or NULL, as it was told */
    double variance;
    char *note;
    struct attributes attributes;
    int64_t session; /* that asked it; 0: none any more, to be asked again */
    bool detached;   /* pending, to be told by another session */
    bool outside;    /* of the bounds: for the model only */
};

/* An ask under way; wanted is 0 between asks. */
struct progress {
    bayesopt_ask_progress callback;
    void *user_data;
    size_t found, wanted;
    bool cancelled;
};

struct bayesopt {
    size_t d;
    double *lower, *upper;
    bayesopt_options options; /* pointers in it refer to the copies below; n_constraints counts the
                                 other objectives too, which are the last outcomes */
    double *initial_x, *constraint_lower, *constraint_upper, *linear_a, *linear_b;
    size_t *group;       /* [d] or NULL */
    bayesopt_kind *kind; /* [d] */
    bool *categorical;   /* [d], NULL: none is */
    char **names;        /* [d] */
    bool named;          /* by the caller */
    size_t n_discrete;   /* variables of few values: integer, categorical, fixed */
    double *first_x;     /* [n_first x d] or NULL */
    struct conditions conditions;

    struct region region; /* linear and callback constraints on [0,1]^d */
    bool maximise[FRONT_MOST_OBJECTIVES];
    double *constraint_x;     /* [d] scratch of the region's callback */
    bool constraints_missing; /* opened from a store without its callback */

    double *design; /* [initial_n x d] in [0,1]^d, made when first needed */
    struct point *points;
    size_t n_points, room;

    struct surrogates surrogates;
    struct progress progress;
    struct store *store;
    int64_t session;
};

/* create.c: what is left of it once its store is closed. */
void problem_free(struct bayesopt *bo);

/* options.c */
bayesopt_status options_check(size_t d, const double *lower, const double *upper,
                              const bayesopt_options *o);

/* problem.c */
size_t problem_budget(const struct bayesopt *bo);
/* Points of the initial phase. With two levels the design is evaluated at the cheap one, and the
 * first quarter of it at the dear one too. */
size_t problem_initial(const struct bayesopt *bo);
/* Refuses points outside of the bounds, or with values that no point of the kind has. */
bayesopt_status problem_check_points(const struct bayesopt *bo, size_t n, const double *x);
/* The latter alone. */
bayesopt_status problem_check_values(const struct bayesopt *bo, size_t n, const double *x);
bool problem_inside(const struct bayesopt *bo, const double *x);
/* The objective as it is searched, which is minimised, from what was told, and back. */
double problem_sign(const struct bayesopt *bo);
void problem_to_unit(const struct bayesopt *bo, const double *x, double *u);
void problem_from_unit(const struct bayesopt *bo, const double *u, double *x);
/* dx/du [d] at x; 0 for discrete variables. */
void problem_unit_slope(const struct bayesopt *bo, const double *x, double *slope);
/* Whether variable j takes few values; how many those are; u moved to the nearest point there is.
 */
bool problem_is_discrete(const struct bayesopt *bo, size_t j);
double problem_values(const struct bayesopt *bo, size_t j);
double problem_value_unit(const struct bayesopt *bo, size_t j, double k);
void problem_snap(const struct bayesopt *bo, double *u);
/* The same for points spread evenly over the box, so that every value gets its share. */
void problem_spread(const struct bayesopt *bo, double *u);
/* How many points there are, at most BAYESOPT_MOST_POINTS + 1. */
size_t problem_size(const struct bayesopt *bo);
/* Point i of them, when there are no more than BAYESOPT_MOST_POINTS. */
void problem_point(const struct bayesopt *bo, size_t i, double *u);

/* pareto.c: the outcome (from 1, as models are numbered) that objective k is, 0 for the first; 1,
 * or -1 for one to be maximised; objectives of a point, to be minimised. */
size_t objective_model(const struct bayesopt *bo, size_t k);
double objective_sign(const struct bayesopt *bo, size_t k);
void objectives_of(const struct bayesopt *bo, const struct point *point, double *values);
/* Rows of the Pareto set [n_points], in the order of asking; false: out of memory. */
bool pareto_rows(const struct bayesopt *bo, size_t *n, size_t *rows);

/* history.c */
/* Of the level whose value is the objective's. */
bool point_is_dear(const struct bayesopt *bo, const struct point *point);
/* Done, at the dear level: a value of the objective proper. */
bool point_counts(const struct bayesopt *bo, const struct point *point);
/* Told, and its outcome is the point's own. */
bool point_judged(const struct point *point);
bool point_feasible(const struct bayesopt *bo, const struct point *point);
/* Index of the best point: feasible with least f, else least violation; SIZE_MAX if none is done.
 */
size_t history_best(const struct bayesopt *bo, bool *feasible);
/* How good a done point is: less violation first, then less f. */
struct merit {
    double violation, f;
};
struct merit point_merit(const struct bayesopt *bo, const struct point *point);
bool merit_better(struct merit a, struct merit b);
/* That of no point. */
extern const struct merit merit_worst;
double history_violation(const struct bayesopt *bo, const struct point *point);
/* Appends a pending point at u (copied); NULL: out of memory. */
struct point *history_append(struct bayesopt *bo, uint64_t id, const double *x,
                             bayesopt_phase phase);
/* Whether u was asked before, lost points left aside. */
bool history_was_asked(const struct bayesopt *bo, const double *u);
struct point *history_find(struct bayesopt *bo, uint64_t id);
void history_truncate(struct bayesopt *bo, size_t n);
void point_clear(struct point *point);
size_t history_count_state(const struct bayesopt *bo, bayesopt_state state);

/* progress.c: whether the caller wants no more of the ask under way, and the failure that says so.
 */
bool ask_is_cancelled(struct bayesopt *bo);
bayesopt_status ask_cancelled(const struct bayesopt *bo);

/* attributes.c: append copies; false: out of memory. check finds what no list may hold. */
bool attributes_append(struct attributes *list, const bayesopt_attribute *attribute);
bool attributes_copy(struct attributes *list, size_t n, const bayesopt_attribute *from);
void attributes_free(struct attributes *list);
bayesopt_status attributes_check(size_t n, const bayesopt_attribute *attributes);

#endif
