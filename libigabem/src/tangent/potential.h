/* Derivatives of a potential: A q' = (b - A q)' with q fixed on the right, and from q' and the
 * moves those of velocity and Kochin function (docs/theory.md, section 15). */
#ifndef POTENTIAL_TANGENT_H
#define POTENTIAL_TANGENT_H

#include "tangent/shape.h"

/* tangent->sigma, velocity, shape and change. */
igabem_status potential_tangent(igabem_tangent *tangent);

/* The Kochin function at m wave angles, the largest of them given, and its derivatives: fills
 * h[m][2] and dh[fields][m][2]. */
igabem_status potential_kochin(const igabem_tangent *tangent, double largest, size_t m,
                               const double *t, double (*h)[2], double (*dh)[2]);

#endif
