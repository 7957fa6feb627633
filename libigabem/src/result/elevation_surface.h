/* Elevation of a solution that knows the potential of its free surface. */
#ifndef ELEVATION_SURFACE_H
#define ELEVATION_SURFACE_H

#include "solve/solution.h"

/* Fills zeta[n], m; NAN inside the water plane. Refuses points off the surface. */
igabem_status elevation_surface(const igabem_solution *solution, size_t n, const double *x,
                                const double *y, double *zeta);

#endif
