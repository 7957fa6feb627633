/* Runs of one problem by several methods, each with several seeds: how the best allowed design came
 * down with evaluations and with time. */
#ifndef HULLOPT_COMPARE_H
#define HULLOPT_COMPARE_H

#include "core/sentence.h"

#include <stddef.h>

enum { COMPARE_LEVELS = 3 };
/* Within so much of the best known. */
static const double COMPARE_LEVEL[COMPARE_LEVELS] = {0.1, 0.05, 0.01};

/* One run: after k + 1 evaluations, the parent not counted. */
struct course {
    char *label;   /* "bayesian, 15 variables" */
    char *group;   /* what its configuration says but for seed and name */
    char *problem; /* the part of that which all runs must share */
    size_t n;
    double *best;    /* least objective over the parent's, of the designs that are allowed; <= 1 */
    double *seconds; /* spent until then */
};

struct comparison {
    size_t n, groups;
    struct course *course;
    size_t *group; /* [n] of each run, in the order of their first */
    double least;  /* best known: of all runs */
};

/* Reads the records at n paths. */
bool comparison_read(size_t n, char *const *paths, struct comparison *c);
void comparison_free(struct comparison *c);

/* Lower quartile, median, upper quartile (linear between order statistics) of n numbers, which are
 * sorted; infinity is a number. */
void comparison_quartiles(size_t n, double *values, double quartile[3]);

/* Of the runs of a group: how many there are, their last best values, and how many evaluations, or
 * seconds, they needed to come within a level; infinity: never. Arrays of c->n. Returns the count.
 */
size_t comparison_last(const struct comparison *c, size_t group, double *values);
size_t comparison_needed(const struct comparison *c, size_t group, size_t level, bool seconds,
                         double *values);

#endif
