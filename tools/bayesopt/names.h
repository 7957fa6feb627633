/* Names of variables and constraints, kept in the store's file in a table of the command's own. */
#ifndef BAYESOPT_TOOL_NAMES_H
#define BAYESOPT_TOOL_NAMES_H

#include <bayesopt/bayesopt.h>

#include <stdbool.h>
#include <stddef.h>

struct names {
    size_t d, m;
    char **variables;   /* [d] */
    char **constraints; /* [m] */
};

/* Writes the names if the store has none yet. Prints the sentence on failure. */
bool names_write(const char *store, const struct names *names);
/* Fills from the store; without a table x1, x2, ... and c1, c2, ... */
bool names_read(const char *store, const bayesopt *bo, struct names *names);
void names_free(struct names *names);

/* Opens STORE as it is; prints the sentence on failure. */
bool store_open(const char *path, bayesopt **bo, struct names *names);

#endif
