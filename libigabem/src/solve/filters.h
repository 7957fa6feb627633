/* The densities that go with the cut-off of a setting and, where its sensitivity is asked for, with
 * 0.85 and 1.15 of it: one matrix and what further filters change in it. */
#ifndef FILTERS_H
#define FILTERS_H

#include "influence/filter_change.h"
#include "solve/linear.h"
#include "solve/solution.h"

enum { FILTERS_MOST = 3 };

/* Number of filters of a setting, and their cut-offs. */
size_t filters_of(const igabem_options *options, double cutoff[FILTERS_MOST]);

/* Solves for solution->sigma and the further densities by the solver asked for; automatic choice
 * turns to LU where GMRES fails. The matrix may be replaced by its factors. */
igabem_status filters_solve(const struct matrix *matrix, igabem_solution *solution, size_t filters,
                            const struct filter_change *change);

#endif
