/* Everything a finished or interrupted run knows: what the summary and the report are written from.
 */
#ifndef HULLOPT_RESULTS_H
#define HULLOPT_RESULTS_H

#include "core/record.h"
#include "core/waves.h"
#include "report/model.h"
#include "report/verdict.h"

struct results {
    const struct problem *problem; /* with both hulls */
    char *stop;                    /* why the search ended, NULL while it has not */
    bool complete;                 /* search, verification and wave patterns are all there */
    struct evaluation *evaluations;
    size_t n, failed;
    const struct evaluation *baseline, *best; /* of evaluations */
    bool chosen;                              /* by somebody: nothing verifies that design */
    size_t *front, n_front;                   /* places in evaluations of the Pareto set */
    struct verification *rows;
    size_t n_rows;
    struct verdict verdict;
    struct search_model model;
    struct waves waves[2]; /* elevation NULL when not there */
    double *parameters;    /* of the optimum, NULL when not there; residual in metres */
    size_t n_parameters;
    double residual;
    char *made; /* of snapshots: file of the command's hull nearest to the optimum, or NULL */
    double made_cw;
    double seconds;
    size_t sessions;
};

/* Builds the design that the results are about unless it is built: that of an id, or of 0 the best.
 * Borrows problem and record. */
bool results_read(struct problem *problem, const struct record *record, size_t design,
                  struct results *results);
void results_free(struct results *results);

/* Of the family: those of the command, where one makes it. */
size_t results_parameters(const struct results *results);

/* Value k of a design as it is shown: objectives_value() times the scale of objective k. */
double results_objective(const struct results *results, size_t k, const struct evaluation *e);

/* Hull of the parent (0) and of the best (1). */
const nurbs_hull *results_hull(const struct results *results, int which);

/* What the verification says, or why there is none. */
const char *results_statement(const struct results *results);

/* Total resistance of the parent and of the best, N: objective_total_resistance(). */
void results_total_resistance(const struct results *results, double total[2]);

/* C_w of the optimum on two thirds of the resolution, on that of the search, and on the finer one;
 * observed order and limit, NAN where the three fit no power of the width. */
struct results_ladder {
    double cw[3], refine, order, limit;
};
/* False: not all three were solved. */
bool results_ladder(const struct results *results, struct results_ladder *ladder);

/* Mean seconds of one evaluation: whole, geometry, solve, proposal. Failed ones count. */
struct results_times {
    double evaluation, geometry, solve, propose;
};
struct results_times results_times(const struct results *results);

#endif
