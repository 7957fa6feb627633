/* What the command keeps in a store beside the history: names of variables and constraints, and
 * what else must be the same when a study goes on. */
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

#endif
