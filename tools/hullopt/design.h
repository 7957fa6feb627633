/* From a moved grid to the light wetted patch that the solver sees. */
#ifndef HULLOPT_DESIGN_H
#define HULLOPT_DESIGN_H

#include "parent.h"

#include <nurbs/nurbs.h>

enum { REASON_SIZE = 256 };

/* Why a design could not be built or solved: the stage and the library's sentence. */
struct failure {
    const char *stage;
    char reason[REASON_SIZE];
};

struct design {
    nurbs_surface *full;             /* skinned whole side, up to the deck */
    nurbs_surface *wetted;           /* below z = 0 */
    nurbs_surface *light;            /* the same with redundant knots removed */
    double bound;                    /* certified distance of light from wetted, m */
    nurbs_hydrostatics hydrostatics; /* of wetted */
};

/* Builds the hull of the parent grid moved by displacement (3 x points, NULL: the parent itself).
 * tolerance as a share of the length. On failure fills failure and leaves the design empty. */
bool design_build(const struct parent *parent, const double *displacement, double tolerance,
                  struct design *design, struct failure *failure);
void design_free(struct design *design);

__attribute__((format(printf, 3, 4))) bool failure_set(struct failure *failure, const char *stage,
                                                       const char *format, ...);

#endif
