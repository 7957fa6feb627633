/* What the tests of libgalv share: a Wigley half hull as the grid, the 27 sine products of the
 * experiment on it, samples, and the slow oracle: a dense SVD of the stored sample matrix. */
#ifndef TESTS_GALV_FIXTURE_H
#define TESTS_GALV_FIXTURE_H

#include <galv/galv.h>

#include <stdbool.h>
#include <stddef.h>

enum { SECTIONS = 21, GIRTH = 11, POINTS = SECTIONS * GIRTH, FUNCTIONS = 27 };

/* xyz: POINTS triples; x from 0 to 6 m, y from 0 to 0.4 m, z from -0.3 to 0 m, i (x) slow. */
void fixture_grid(double *xyz);
extern const galv_box fixture_box;

/* The 27 triples of orders 1..3 along y with bounds +-bound, phases 0. */
void fixture_functions(galv_sine *functions);
galv_shape *fixture_shape(galv_combination combination, double bound);

/* N rows of n parameters of the uniform stream. */
double *fixture_samples(const galv_shape *shape, size_t count, uint64_t seed);

/* Rows d(x_r), N x 3 npoints, by galv_shape_displace(). */
double *fixture_rows(const galv_shape *shape, size_t npoints, const double *xyz, size_t count,
                     const double *x);

/* Eigenvalues of rows^T rows / N, descending, all min(N, L) of them, by SVD; centred or not,
 * columns multiplied by sqrt(weight) when weights (one per column) are given. modes, when not NULL:
 * right singular vectors, `keep` rows of L. Destroys nothing. */
double *fixture_spectrum(size_t count, size_t length, const double *rows, bool centre,
                         const double *weights, size_t keep, double *modes);

#endif
