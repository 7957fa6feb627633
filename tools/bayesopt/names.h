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
    char **variables;      /* [d] */
    char **constraints;    /* [m] */
    struct labels *labels; /* [d], or NULL: every value is a number */
};

/* What the values 0, 1, ... of a categorical or ordinal variable are called; n is 0 for the others.
 */
struct labels {
    size_t n;
    char **texts;
};

/* Value of variable j as a text, in a buffer where it is a number: a label, or all digits. */
enum { VALUE_SIZE = 32 };
const char *names_value(const struct names *names, size_t j, double value, char buffer[VALUE_SIZE]);
/* The value that a text stands for; false: none. */
bool names_parse(const struct names *names, size_t j, const char *text, double *value);
/* The same for "1,steel,3", all d of them; OPTION begins the sentence otherwise. */
bool names_parse_point(const struct names *names, const char *option, const char *text, double *x);
/* {"angle": 5, "material": "steel"} */
json_t *point_json(const struct names *names, const double *x);

/* Keeps a text under a name, or refuses with the sentence if the store has another one there. */
bool store_keep(bayesopt *bo, const char *what, const char *text);
/* The same for all names, but those of variables, which the library keeps. */
bool names_keep(bayesopt *bo, const struct names *names);
/* Fills from the store; what has no name there is called x1, x2, ... and c1, c2, ... */
bool names_read(const bayesopt *bo, struct names *names);
void names_free(struct names *names);
/* Of these two the part that is about the labels of variable j. */
bool labels_keep(bayesopt *bo, const struct names *names, size_t j);
bool labels_read(const bayesopt *bo, struct names *names, size_t j);

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
