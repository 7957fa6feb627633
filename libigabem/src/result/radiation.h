/* The sources that a solution radiates from, formulation by formulation. */
#ifndef RADIATION_H
#define RADIATION_H

#include "result/sources.h"
#include "solve/solution.h"

/* Points of the rule on an element of the face of a dry transom: across, and up from its rim. */
enum { FACE_ACROSS = 3, FACE_UP = 12 };

/* Which of the solution's densities. */
enum radiation_cutoff { RADIATION_AS_SOLVED, RADIATION_LOWER, RADIATION_UPPER, RADIATION_CHANGE };

/* Sources that carry the far-field waves up to angle t_max. Without a solve they are U n_x, taken
 * from the exact normals, else they carry the solved density. Elements are divided at the planes
 * x = cut[i]. */
igabem_status radiation_sources(const igabem_solution *solution, enum radiation_cutoff cutoff,
                                double t_max, size_t cuts, const double *cut,
                                struct sources **sources);

/* The largest wave angle that counts: options.spectrum_limit of a hull that reaches the surface,
 * where e^{2 k0 z (1+t^2)} has gone to rounding for a submerged one. */
double radiation_limit(const igabem_solution *solution);

/* Extent of the sources: length and beam, m, of both sides. */
void radiation_extent(const igabem_solution *solution, double *length, double *beam);

/* Whether the formulation filters its waves: the angle t_c, 0 if not. */
double radiation_cutoff_angle(const igabem_solution *solution);

#endif
