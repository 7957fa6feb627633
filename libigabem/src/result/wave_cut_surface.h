/* The wave cut of a solution whose waves are known on its own free surface alone. */
#ifndef WAVE_CUT_SURFACE_H
#define WAVE_CUT_SURFACE_H

#include "solve/solution.h"

/* Along y; NAN: a twentieth of the length off the side. */
igabem_status wave_cut_surface(const igabem_solution *solution, double y, double *cw);

#endif
