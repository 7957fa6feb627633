/* The optimisation object and what its source files share. */
#ifndef BAYESOPT_INTERNAL_H
#define BAYESOPT_INTERNAL_H

#include "random.h"
#include "region.h"
#include "surrogate.h"

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
    double *x; /* [d] the caller's units */
    double *u; /* [d] the same in [0,1]^d */
    double f;
    double *constraints; /* [n_constraints] or NULL */
    double *gradient;    /* [d] or NULL, the caller's units */
    double variance;
    char *note;
    struct attributes attributes;
    int64_t session; /* that asked it; 0: none any more, to be asked again */
    bool detached;   /* pending, to be told by another session */
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
    bayesopt_options options; /* pointers in it refer to the copies below */
    double *initial_x, *constraint_lower, *constraint_upper, *linear_a, *linear_b;
    size_t *group; /* [d] or NULL */

    struct region region;     /* linear and callback constraints on [0,1]^d */
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

/* options.c */
bayesopt_status options_check(size_t d, const double *lower, const double *upper,
                              const bayesopt_options *o);

/* problem.c */
size_t problem_budget(const struct bayesopt *bo);
/* Points of the initial phase. With two levels the design is evaluated at the cheap one, and the
 * first quarter of it at the dear one too. */
size_t problem_initial(const struct bayesopt *bo);
/* Refuses points outside of the bounds. */
bayesopt_status problem_check_points(const struct bayesopt *bo, size_t n, const double *x);
void problem_to_unit(const struct bayesopt *bo, const double *x, double *u);
void problem_from_unit(const struct bayesopt *bo, const double *u, double *x);

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
struct point *history_find(struct bayesopt *bo, uint64_t id);
void history_truncate(struct bayesopt *bo, size_t n);
void point_clear(struct point *point);
size_t history_count_state(const struct bayesopt *bo, bayesopt_state state);

/* attributes.c: append copies; false: out of memory. check finds what no list may hold. */
bool attributes_append(struct attributes *list, const bayesopt_attribute *attribute);
bool attributes_copy(struct attributes *list, size_t n, const bayesopt_attribute *from);
void attributes_free(struct attributes *list);
bayesopt_status attributes_check(size_t n, const bayesopt_attribute *attributes);

/* ask.c: whether the caller wants no more of the ask under way, and the failure that says so. */
bool ask_is_cancelled(struct bayesopt *bo);
bayesopt_status ask_cancelled(const struct bayesopt *bo);

/* strategy.c: the next point in [0,1]^d, as proposal number id. */
bayesopt_status strategy_propose(struct bayesopt *bo, uint64_t id, double *u, bayesopt_phase *phase,
                                 int *level);
double strategy_trust_length(const struct bayesopt *bo);

#endif
