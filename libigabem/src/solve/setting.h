/* One setting: its rows of the matrix from the parts of the Green function, its density and its
 * velocities. */
#ifndef SETTING_H
#define SETTING_H

#include "influence/influence.h"
#include "solve/solution.h"

/* Parts of the Green function that several settings share, [n][3][n]; all NULL for one setting,
 * whose weights are applied as the parts are integrated. */
struct parts {
    double *rankine, *image, *local;
    double local_k0; /* that local is for; 0: none */
};

/* Fills sigma, velocity and what qualifies them; share of the whole progress. */
igabem_status setting_solve(const struct influence *influence, const struct parts *parts,
                            double share, igabem_solution *solution);

/* Fills rows[n][3][n] with the system of a solution, as assemble_turn() leaves it. */
igabem_status setting_system(const struct influence *influence, const igabem_solution *solution,
                             double *rows);

#endif
