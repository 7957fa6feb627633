/* Settings that solve for the potential on hull and free surface (exterior/system.h): what of them
 * has the same free surface shares its integrals. */
#ifndef POTENTIAL_H
#define POTENTIAL_H

#include "core/progress.h"
#include "influence/influence.h"
#include "solve/solution.h"

igabem_status potential_solve(struct influence *influence, size_t n,
                              igabem_solution *const *solutions, double share,
                              struct progress *progress);

#endif
