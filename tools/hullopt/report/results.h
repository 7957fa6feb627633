/* Everything a finished or interrupted run knows: what the summary and the report are written from.
 */
#ifndef HULLOPT_RESULTS_H
#define HULLOPT_RESULTS_H

#include "core/record.h"
#include "core/waves.h"
#include "report/verdict.h"

struct results {
    const struct problem *problem; /* with both hulls */
    char *stop;                    /* why the search ended, NULL while it has not */
    bool complete;                 /* search, verification and wave patterns are all there */
    struct evaluation *evaluations;
    size_t n, failed;
    const struct evaluation *baseline, *best; /* of evaluations */
    struct verification *rows;
    size_t n_rows;
    struct verdict verdict;
    struct waves waves[2]; /* elevation NULL when not there */
    double *parameters;    /* of the optimum, NULL when not there; residual in metres */
    size_t n_parameters;
    double residual;
    double seconds;
    size_t sessions;
};

/* Builds the best design of the problem unless it is built. Borrows problem and record. */
bool results_read(struct problem *problem, const struct record *record, struct results *results);
void results_free(struct results *results);

/* Hull of the parent (0) and of the best (1). */
const nurbs_hull *results_hull(const struct results *results, int which);

/* Total resistance of the parent and of the best, N: objective_total_resistance(). */
void results_total_resistance(const struct results *results, double total[2]);

/* Mean seconds of one evaluation: whole, geometry, solve, proposal. Failed ones count. */
struct results_times {
    double evaluation, geometry, solve, propose;
};
struct results_times results_times(const struct results *results);

#endif
