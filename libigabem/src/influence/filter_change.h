/* What another short-wave filter changes in the normal velocities of the wave part, as an operator
 * without a matrix. Unknowns wholly ahead of a point act on it through sums over wave angles that
 * grow while marching from bow to stern; those that reach to its x or beyond, a few columns of the
 * mesh, have entries of their own. */
#ifndef FILTER_CHANGE_H
#define FILTER_CHANGE_H

#include <igabem/status.h>

#include <stdbool.h>
#include <stddef.h>

struct filter_change_entry {
    size_t unknown;
    double value[2]; /* by filter */
};

struct filter_change_row {
    size_t point; /* the row of the matrix */
    size_t ahead; /* leading unknowns of `order` that are wholly ahead */
    size_t entries;
    struct filter_change_entry *entry;
};

struct filter_change {
    size_t n, points, width, filters; /* filters: at most two beyond the first */
    int threads;
    double *filter;                /* [filters][width] difference from the first filter */
    double *moments;               /* [n][width] of the unknowns */
    double *factor;                /* [points][width] of the points, without filter */
    size_t *order, *rank;          /* [n] unknowns from bow to stern, and their places there */
    struct filter_change_row *row; /* [points] from bow to stern */
    double *partial;               /* [threads][points] */
    double *storage;
};

/* All arrays zero; order and rank empty. */
igabem_status filter_change_create(size_t n, size_t points, size_t width, size_t filters,
                                   int threads, struct filter_change **change);
void filter_change_free(struct filter_change *change);

/* Moves what buffer[filters][n] holds of unknowns that are not wholly ahead to the entries of a
 * row, and clears it. Returns 0 when out of memory. */
bool filter_change_collect(struct filter_change *change, size_t row, double *buffer);

/* y += D x of a filter. Not for several threads at once. */
void filter_change_add(const struct filter_change *change, size_t filter, const double *x,
                       double *y);

/* Fills matrix[n][n] with D of a filter. */
void filter_change_expand(const struct filter_change *change, size_t filter, double *matrix);

double filter_change_memory(const struct filter_change *change);

#endif
