/* Quadratic splines over cells of equal size in cell coordinates, and meshes of such cells. */
#ifndef SPLINE_H
#define SPLINE_H

#include "space/element.h"

enum { SPLINE_SIDE = 4, SPLINE_STENCIL = 5 };

/* Of the coefficients about the middle of a cell: phi and its first and second derivative, of order
 * 4 as values (the spline's own derivatives are of order 2); and the spline's own, for a cell that
 * has no second neighbour. */
extern const double spline_along[3][SPLINE_STENCIL], spline_last[3][SPLINE_STENCIL];

/* The three splines that a cell sees, in Bernstein polynomials of degree 3, and no fourth. */
extern const double spline_quadratic[SPLINE_SIDE * SPLINE_SIDE];

/* Those three at s in [0,1], and their derivatives. */
void spline_evaluate(double s, double value[3], double derivative[3]);

/* Transposed interpolation: factors of the n + 2 coefficients of a spline through n values at the
 * middles of cells, linear beyond them, become factors of the values, from the second on, in place;
 * `step` apart. scratch[n]. */
void spline_fold(size_t n, double *factor, size_t step, double *scratch);

/* The interpolation: values, from the second on, become the n + 2 coefficients, in place. */
void spline_interpolate(size_t n, double *value, size_t step, double *scratch);

/* A mesh of bicubic elements, one per panel, to be filled; NULL: no memory. */
struct mesh *spline_mesh(size_t elements);

/* Stores and returns the Bezier points of the bicubic through point[4][4][3] at thirds. */
const double *spline_net(struct mesh *mesh, size_t element, const double *point);

/* Box and panel of an element that is filled. */
void spline_panel(struct mesh *mesh, size_t element);

/* Adds the hull's basis at parameters of a patch to a row over its unknowns. */
void spline_hull_basis(const struct mesh *hull, size_t patch, const double uv[2], double *row);

#endif
