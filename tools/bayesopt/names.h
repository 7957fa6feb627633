/* What the command keeps in a store beside the history: names of variables and constraints, and
 * what else must be the same when a study goes on. */
#ifndef BAYESOPT_TOOL_NAMES_H
#define BAYESOPT_TOOL_NAMES_H

#include "cli.h"

#include <bayesopt/bayesopt.h>

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

struct names {
    size_t d, m;
    char **variables;   /* [d] */
    char **constraints; /* [m] */
};

/* Keeps a text under a name, or refuses with the sentence if the store has another one there. */
bool store_keep(bayesopt *bo, const char *what, const char *text);
/* The same for all names. */
bool names_keep(bayesopt *bo, const struct names *names);
/* Fills from the store; what has no name there is called x1, x2, ... and c1, c2, ... */
bool names_read(const bayesopt *bo, struct names *names);
void names_free(struct names *names);

/* Opens STORE for looking, or as it is to be added to; prints the sentence on failure. */
bool store_open(const char *path, bayesopt **bo, struct names *names);
bool store_open_to_write(const char *path, bayesopt **bo, struct names *names);

/* {"angle": 5, ...}; what is not finite is null. NULL values give {}. */
json_t *named_json(size_t n, char *const *names, const double *values);
json_t *number_json(double value);
/* Writes and releases; true, so that it may end a function. */
bool print_json(FILE *stream, json_t *root);

/* Standard output, or a file that appears whole when it is closed. PATH NULL: the former. */
struct output {
    FILE *stream;
    const char *path;
    struct cli_file file;
};
bool output_open(struct output *output, const char *path);
bool output_close(struct output *output);

#endif
