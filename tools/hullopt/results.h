/* Everything a finished or interrupted run knows, read back from its database: what the summary and
 * the report are written from. */
#ifndef HULLOPT_RESULTS_H
#define HULLOPT_RESULTS_H

#include "evaluate.h"
#include "store.h"
#include "verify.h"
#include "waves.h"

struct results {
    char *settings; /* the canonical configuration */
    char *solver;   /* the solver's options as frozen on the parent, same form */
    char *stop;     /* why the search ended, NULL while it has not */
    bool complete;  /* search, verification and wave patterns are all there */
    struct outcome_limits limits;
    struct latent latent;
    struct parent parent; /* length and grid; no file */
    struct evaluation *evaluations;
    size_t n, failed;
    const struct evaluation *baseline, *best; /* of evaluations; NULL before the first */
    double nu_s[2]; /* of the waterlines of parent and best; NAN: cannot be told */
    double breadth; /* least share of its half breadth that a wet point of the best keeps */
    struct verification *rows;
    size_t n_rows;
    struct verdict verdict;
    struct design designs[2]; /* parent, best */
    struct waves waves[2];    /* elevation NULL when not there */
    double *parameters;       /* of the optimum, NULL when not there; residual in metres */
    size_t n_parameters;
    double residual;
    double seconds;
    size_t sessions;
};

/* On failure prints the sentence. */
bool results_load(struct store *store, struct results *results);
void results_free(struct results *results);

/* Value of "key = value" in a text of settings; false when it is not there. */
bool results_text(const char *settings, const char *key, char *value, size_t size);
/* The same as a number, NAN when it is none. */
double results_number(const char *settings, const char *key);

/* Mean seconds of one evaluation: whole, geometry, solve, proposal. Failed ones count. */
struct results_times {
    double evaluation, geometry, solve, propose;
};
struct results_times results_times(const struct results *results);

#endif
