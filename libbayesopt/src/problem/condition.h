/* Input constraints that were given as texts. */
#ifndef BAYESOPT_CONDITION_H
#define BAYESOPT_CONDITION_H

#include <bayesopt/expression.h>

#include <stdbool.h>

struct bayesopt;

struct conditions {
    size_t n;
    bayesopt_expression **expressions;
    double *tolerance; /* of equalities */
    char **texts;
    size_t rows; /* values <= 0: one of an inequality, two of an equality */
};

/* From the options; bounds, kinds and names are set. */
bayesopt_status conditions_create(struct bayesopt *bo, size_t n, const char *const *texts);
void conditions_free(struct conditions *conditions);
/* Fills value [rows] at x in the caller's units. */
void conditions_values(const struct conditions *conditions, const double *x, double *value);

#endif
