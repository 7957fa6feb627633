/* Displacement of a hull straight from its grid, in microseconds. */
#ifndef HULLOPT_VOLUME_H
#define HULLOPT_VOLUME_H

#include <stddef.h>

/* Twice the integral of y over the projection on the centre plane of the part below z = 0, quads
 * taken as two triangles: the volume of both sides, signed by the orientation of the grid. */
double volume_of_grid(size_t rows, size_t columns, const double *points);

#endif
