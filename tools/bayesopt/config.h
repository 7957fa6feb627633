/* The YAML file of 'bayesopt run', and what its command line adds. */
#ifndef BAYESOPT_TOOL_CONFIG_H
#define BAYESOPT_TOOL_CONFIG_H

#include "names.h"
#include "result.h"
#include "settings.h"

#include <bayesopt/bayesopt.h>

#include <regex.h>
#include <stdbool.h>

enum { MOST_OBJECTIVES = 3 };
enum { MOST_TEMPLATES = 16, MOST_LABELS = 100, MOST_CONDITIONS = 100 };

/* As the file calls it. */
enum config_kind {
    CONFIG_REAL,
    CONFIG_LOG,
    CONFIG_INTEGER,
    CONFIG_ORDINAL,
    CONFIG_CATEGORICAL,
    CONFIG_FIXED
};

struct config_variable {
    char *name;
    enum config_kind kind;
    double lower, upper, value;
    bool bounded_below, bounded_above, valued, grouped;
    char *labels[MOST_LABELS];
    size_t n_labels, group;
};

struct config_constraint {
    char *name;
    double lower, upper;
    size_t output; /* of a model, from 1; 0: the next one */
};

/* Of several. */
struct config_objective {
    char *name;
    bool maximise;
    size_t output; /* of a model, from 1; 0: the next one */
};

struct config {
    char *path, *store, *store_given; /* the file; its store and that of the command line */
    struct config_variable *variables;
    size_t n_variables;
    struct config_constraint *constraints;
    size_t n_constraints;
    struct config_objective *objectives; /* when there are several */
    size_t n_objectives;
    bool maximise_others[MOST_OBJECTIVES];
    char *command, *key, *gradient, *file, *folder, *cheap;
    char *url, *model, *model_config; /* in place of a command */
    size_t output;                    /* of the model, from 1 */
    bool use_gradient;                /* of a model that has one */
    char *templates[MOST_TEMPLATES];
    size_t n_templates;
    char *conditions[MOST_CONDITIONS];
    size_t n_conditions;
    char *first; /* file of points */
    enum result_match match;
    double timeout; /* seconds, INFINITY: none */
    double *transient_status;
    size_t n_transient_status;
    char *transient_pattern;
    bool compiled;   /* pattern */
    regex_t pattern; /* of transient_pattern, when that is given */
    bool transient_timeout;
    size_t retries, workers;
    size_t stop_after; /* equal failures, 0: never */
    bool json;
    bayesopt_options options;
    struct names names; /* borrowed from variables and constraints */
    double *bounds;     /* of variables, of constraints, each lower then upper */
    size_t *group;
    bayesopt_kind *kind;
    double *first_x;
};

extern const struct settings CONFIG;
/* config_check.c: the check of that table. */
void config_check(struct settings_source *source, void *target);

/* config_start() first, config_free() in any case. Reading prints the sentences with line and field
 * on failure, all at once. */
void config_start(struct config *config);
bool config_read(const char *path, struct config *config);
void config_free(struct config *config);
/* Where its store is; the caller frees. NULL: out of memory. */
char *config_store(const struct config *config);
/* Where the working folders are; the caller frees. NULL: out of memory. */
char *config_folder(const struct config *config);
/* What stands before the objective's number in the output; NULL: nothing. */
const char *config_key(const struct config *config);
/* Output of a model that constraint k is, from 1. */
size_t config_output(const struct config *config, size_t k);
/* Whether the file tells transient failures from permanent ones. */
bool config_knows_transient(const struct config *config);
/* The optimisation it describes, on the store; refuses a store of another study. */
bool config_create(const struct config *config, const char *store, bayesopt **bo);

#endif
