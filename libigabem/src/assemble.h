/* From influences to the linear system of one setting, and back to velocities on the hull. */
#ifndef ASSEMBLE_H
#define ASSEMBLE_H

#include "influence.h"

/* Parts of the Green function with the weights that a formulation gives them, row by row:
 *     velocity_i = rankine + image_weight_i image + wave_weight_i (local + wave). */
struct system {
    const struct influence *influence;
    const double *rankine, *image, *local; /* NULL where all weights are zero */
    const double *wave;                    /* waterline and wave part together */
    double *image_weight, *wave_weight;    /* [n] */
};

/* Row of the basis at a collocation point: adds the values of the functions to row[unknowns]. */
void basis_row(const struct influence *influence, size_t point, double *row);

/* Fills matrix[n][n] of sigma/2 + dphi/dn. */
igabem_status system_matrix(const struct system *system, double *matrix);

/* Velocities on the fluid side at the collocation points, [3][n]. */
igabem_status system_velocity(const struct system *system, const double *sigma, double *velocity);

/* Solves matrix x = right (replaced by x; the matrix by its factors) and estimates the condition
 * number in the 1-norm (NULL: not wanted). */
igabem_status system_solve(size_t n, double *matrix, double *right, double *condition);

#endif
