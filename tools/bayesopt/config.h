/* The YAML file of 'bayesopt run'. */
#ifndef BAYESOPT_TOOL_CONFIG_H
#define BAYESOPT_TOOL_CONFIG_H

#include "names.h"

#include <bayesopt/bayesopt.h>

#include <stdbool.h>

/* As the file has it: numbers are text until they are checked. */
struct config_variable {
    char *name, *lower, *upper, *group;
};
struct config_objective {
    char *command, *key, *gradient, *folder, *timeout, *retries;
};
struct config_levels {
    char *cheap, *cost;
};
struct config_constraint {
    char *name, *lower, *upper;
};
struct config_search {
    char *evaluations, *initial, *design, *seed, *strategy, *noise, *workers;
    char *kernel, *scales, *mean, *choice, *transform, *acquisition, *lcb_factor;
    char *stop_no_improvement, *stop_expected_improvement;
};
struct config_file {
    char *store;
    struct config_variable *variables;
    unsigned variables_count;
    struct config_objective objective;
    struct config_levels levels;
    struct config_constraint *constraints;
    unsigned constraints_count;
    struct config_search search;
};

/* Checked. */
struct config {
    const char *path;
    struct config_file *file;
    struct names names;
    double *lower, *upper;                       /* [d] */
    double *constraint_lower, *constraint_upper; /* [m] */
    double timeout;                              /* seconds */
    size_t retries, workers;
    size_t *group; /* [d] tied length scales, or NULL */
    bayesopt_options options;
};

/* Prints the sentence with line and field on failure. The path is borrowed. */
bool config_read(const char *path, struct config *config);
void config_free(struct config *config);
/* The optimisation it describes, on the store; refuses a store of another study. */
bool config_create(const struct config *config, const char *store, bayesopt **bo);

#endif
