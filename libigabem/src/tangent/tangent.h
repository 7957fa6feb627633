/* What the derivatives of a solution are made of. */
#ifndef TANGENT_H
#define TANGENT_H

#include "solve/solution.h"
#include "tangent/field.h"

#include <igabem/tangent.h>

struct igabem_tangent {
    const igabem_solution *solution; /* borrowed */
    struct mesh *mesh;               /* of its density */
    struct field *field;
    double *area;        /* [n] of the wetted area of both sides, m^2 */
    double *point;       /* [unknowns][n] moves of the collocation points along y */
    double *normal;      /* [n][unknowns][3] of the unit normals at the collocation points */
    double *sigma;       /* [n][unknowns] coefficients of the density */
    double *velocity;    /* [n][3][unknowns] coefficients; NULL: the solution has no velocity */
    struct shape *shape; /* of a potential, else NULL: what else the hull enters it by, */
    double *change;      /* and its changes while phi stays, [size][width of the field] */
    double *cells;       /* of what a double model's cells radiate (shape_cells()); else NULL */
};

igabem_status tangent_no_memory(size_t fields);

/* Refuses what has no tangents. */
igabem_status tangent_check(const igabem_solution *solution);

/* Fills area, which is all 0. */
igabem_status tangent_area(igabem_tangent *tangent);

/* tangent->sigma and tangent->velocity of a formulation that solves. */
igabem_status tangent_solve(igabem_tangent *tangent);

#endif
