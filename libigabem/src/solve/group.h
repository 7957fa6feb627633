/* Settings that have unknowns and quadrature in common, and what they therefore share. */
#ifndef GROUP_H
#define GROUP_H

#include "core/progress.h"
#include "solve/solution.h"

bool group_has_both(const igabem_options *a, const igabem_options *b);

/* Solves the settings of a group; each is this share of the whole progress. */
igabem_status group_solve(size_t n, igabem_solution *const *solutions, double share,
                          struct progress *progress);

#endif
