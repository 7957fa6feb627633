/* Settings that solve for the potential on hull and free surface (exterior/system.h): what of them
 * has the same free surface shares its integrals. */
#ifndef POTENTIAL_H
#define POTENTIAL_H

#include "core/progress.h"
#include "influence/influence.h"
#include "solve/solution.h"

/* All unknowns of a solution: those on its hull, its free surface and its strip. */
size_t potential_unknowns(const igabem_solution *solution);

/* Creates the factors of a solution's system and their pivots, as it keeps them where it is told
 * to.
 */
igabem_status potential_factors(const struct influence *influence, const igabem_solution *solution,
                                double **factors, int **pivots);

igabem_status potential_solve(struct influence *influence, size_t n,
                              igabem_solution *const *solutions, double share,
                              struct progress *progress);

#endif
