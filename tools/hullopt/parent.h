/* The hull of a run and the grid of points on it that designs move. */
#ifndef HULLOPT_PARENT_H
#define HULLOPT_PARENT_H

#include "config.h"

#include <nurbs/nurbs.h>

struct parent {
    nurbs_patches *file;
    const nurbs_surface *surface; /* borrowed from file: the whole side up to the deck */
    double length;                /* Lpp of the file, or that of the waterline */
    nurbs_grid *grid;             /* sections x girth points of the surface */
};

/* Reads the hull and samples the grid. On failure prints the sentence and returns false. */
bool parent_read(const struct config *config, struct parent *parent);
void parent_free(struct parent *parent);

/* n parameters of a knot vector, spaced like its Greville abscissae so that they crowd where the
 * model has detail, with a parameter on every kink (a knot of multiplicity `degree`). */
bool parent_parameters(int degree, size_t size, const double *knots, size_t n, double *out);

#endif
