/* Hulls and grids that several tests of libnurbs use. */
#ifndef TESTS_NURBS_HULLS_H
#define TESTS_NURBS_HULLS_H

#include <nurbs/nurbs.h>

/* The DTMB 5415 shipped in examples/hulls, its 90 x 25 design grid, and the parameters of it. */
struct hull5415 {
    nurbs_patches *file;
    const nurbs_surface *surface;
    nurbs_grid *grid;
    const double *u, *v;
};
int hull5415_load(struct hull5415 *hull);
void hull5415_free(struct hull5415 *hull);

/* A hull of rows x columns points, x from 1 to 0, z from 0.2 to the keel at -0.5, whose keel line
 * rises with a kink at row `kink`; y = 0 on the stem row and the keel column. */
nurbs_grid *kinked_grid(size_t rows, size_t columns, size_t kink);

/* Largest distance between two surfaces on n x n parameters of the unit square. */
double surface_distance(const nurbs_surface *a, const nurbs_surface *b, size_t n);

/* Smallest y on n x n parameters of the unit square. */
double lowest_y(const nurbs_surface *surface, size_t n);

/* A file in TMPDIR or /tmp, which the test removes; the name is kept until the next call. */
const char *scratch_file(const char *name);

/* Writes text to a scratch file and returns its path. */
const char *write_scratch(const char *name, const char *text);

#endif
