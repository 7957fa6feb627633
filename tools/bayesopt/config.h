/* The YAML file of 'bayesopt run', and what its command line adds. */
#ifndef BAYESOPT_TOOL_CONFIG_H
#define BAYESOPT_TOOL_CONFIG_H

#include "names.h"
#include "settings.h"

#include <bayesopt/bayesopt.h>

#include <stdbool.h>

struct config_variable {
    char *name;
    double lower, upper;
    size_t group;
    bool grouped;
};

struct config_constraint {
    char *name;
    double lower, upper;
};

struct config {
    char *path, *store, *store_given; /* the file; its store and that of the command line */
    struct config_variable *variables;
    size_t n_variables;
    struct config_constraint *constraints;
    size_t n_constraints;
    char *command, *key, *gradient, *folder, *cheap;
    double timeout; /* seconds, INFINITY: none */
    size_t retries, workers;
    bool json;
    bayesopt_options options;
    struct names names; /* borrowed from variables and constraints */
    double *bounds;     /* of variables, of constraints, each lower then upper */
    size_t *group;
};

extern const struct settings CONFIG;

/* config_start() first, config_free() in any case. Reading prints the sentences with line and field
 * on failure, all at once. */
void config_start(struct config *config);
bool config_read(const char *path, struct config *config);
void config_free(struct config *config);
/* Where its store is; the caller frees. NULL: out of memory. */
char *config_store(const struct config *config);
/* The optimisation it describes, on the store; refuses a store of another study. */
bool config_create(const struct config *config, const char *store, bayesopt **bo);

#endif
