/* Spline interpolation on plain arrays: control "points" are rows of m numbers, so that all lines
 * of a grid are solved at once. */
#ifndef NURBS_INTERPOLATE_H
#define NURBS_INTERPOLATE_H

#include "core/banded.h"

/* Interior knots at the sites themselves for odd degrees, midway for even ones; the sites nearest
 * to the ends carry none (not-a-knot ends). Fills knots[n + degree + 1]; n > degree. */
void interpolation_knots(int degree, size_t n, const double *sites, double *knots);

/* The same by averaging `degree` sites: The NURBS Book eq. 9.8. */
void averaged_knots(int degree, size_t n, const double *sites, double *knots);

/* Factors of the matrix B_j(sites[i]); sites increase. */
nurbs_status collocation_factor(int degree, size_t n, const double *knots, const double *sites,
                                banded *factors);

/* Boehm (1980): inserts u once into a spline of *n rows; knots and rows have room for one more. */
void spline_insert_rows(int degree, size_t *n, double *knots, size_t m, double *rows, double u);

/* Interpolation along one axis of a grid in which some lines have a kink at some sites. */
typedef struct kinked_axis {
    int degree;
    size_t sites, kinks;
    const double *u;    /* borrowed: the sites, increasing from 0 to 1 */
    const size_t *kink; /* borrowed: interior site indices, increasing */
    size_t size;        /* control rows of the result */
    double *knots;      /* of the result: `degree` equal knots at every kink */
} kinked_axis;

nurbs_status kinked_axis_create(int degree, size_t n, const double *u, size_t kinks,
                                const size_t *kink, kinked_axis *axis);
void kinked_axis_free(kinked_axis *axis);

/* Interpolates data[sites][m]: C^0 at the kinks with active[k] != 0, C^(degree-1) elsewhere. Fills
 * control[axis->size][m]. */
nurbs_status kinked_axis_solve(const kinked_axis *axis, const unsigned char *active, size_t m,
                               const double *data, double *control);

#endif
