/* How a design floats while it is solved: as it was placed, or free to sink and trim. */
#ifndef HULLOPT_ATTITUDE_H
#define HULLOPT_ATTITUDE_H

#include "core/problem.h"

struct attitude {
    const igabem_hull *body; /* what is solved: the design's own, or `placed` */
    igabem_hull *placed;
    double area; /* its wetted surface over that at rest: C_w times this is on the latter */
    double sinkage, trim; /* m, downward; degrees, bow up; 0 at rest */
};

/* That of a design at one of the problem's speeds: with flow.free_to_trim the equilibrium of
 * weight, buoyancy and pressure by solver.formulation, for any other formulation at that speed too.
 * Borrows the design; to be freed whatever comes of it. */
bool attitude_find(const struct problem *problem, const struct design *design, double froude,
                   struct attitude *attitude);
void attitude_free(struct attitude *attitude);

#endif
