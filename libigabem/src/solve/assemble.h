/* The linear system of one setting, in place of its velocity rows: seen along the normal they are
 * its matrix, and along two tangents they turn its solution into velocities. */
#ifndef ASSEMBLE_H
#define ASSEMBLE_H

#include "influence/influence.h"

/* Turns rows[n][3][n], velocity components x, y, z of a unit density, into the matrix of sigma/2 +
 * dphi/dn and the components along two tangents. */
void assemble_turn(const struct influence *influence, double *rows);

/* Velocities on the fluid side at the collocation points, [3][n], from the turned rows, of which
 * the first component is not read: the normal velocities are those that the density was solved
 * for. */
void assemble_velocity(const struct influence *influence, const double *rows,
                       const double *normal_velocity, const double *sigma, double *velocity);

#endif
