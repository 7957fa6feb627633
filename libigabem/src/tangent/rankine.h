/* How the velocities of given sources change at the collocation points while the hull moves, part
 * by part of the Green function (influence.h). */
#ifndef TANGENT_RANKINE_H
#define TANGENT_RANKINE_H

#include "influence/influence.h"
#include "tangent/moving.h"

/* What the parts have in common. Velocities are [unknowns][3][fields]. */
struct change {
    const igabem_tangent *tangent;
    const struct influence *influence;
    const double *bernstein; /* of moving_density() */
    const double *point;     /* [unknowns][fields] moves of the collocation points */
};

/* Adds the change of the principal value of -1/r and, image[i] times in row i (NULL: not at all),
 * of +1/r'. */
igabem_status change_rankine(const struct change *change, const double *image, double *velocity);

#endif
