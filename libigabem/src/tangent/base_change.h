/* How the double-body flow of a double model changes at the middles of the surface's cells while
 * hull and surface move (docs/theory.md, section 15). */
#ifndef BASE_CHANGE_H
#define BASE_CHANGE_H

#include "influence/influence.h"
#include "tangent/shape.h"

/* Creates change[cells][5][fields]: of gradient and second derivatives of Phi. hull: of the
 * tangent's mesh. */
igabem_status base_change(const igabem_tangent *tangent, const struct shape *shape,
                          const struct influence *hull, double **change);

#endif
