/* Integrals over an element that contains the singular point of the kernel (P - Q)/(4 pi r^3).
 *
 * The element is divided into triangles from the point to its edges. On a triangle, lambda in [0,1]
 * runs from the point to the edge and tau along the edge (Duffy), so that dS carries a factor
 * lambda; tau = tau* + d sinh(mu) moves the nearly singular dependence on the direction, which is
 * that of the distance from the point to the edge line in the tangent plane, out of the way
 * (Johnston and Elliott, IJNME 62, 2005). What is left behaves like g(tau)/lambda: its normal
 * component vanishes and the tangential ones have a principal value. With the circle that a
 * principal value leaves out measured in space, not in parameters (Guiggiani and Gigante, J. Appl.
 * Mech. 57, 1990), it is
 *     Int dtau { Int_0^1 (F - g/lambda) dlambda + g ln A },
 * A(tau) the distance to the edge in the tangent plane. */
#ifndef QUADRATURE_SINGULAR_H
#define QUADRATURE_SINGULAR_H

#include "space/cell.h"

/* Appends the nodes of the rule for the point at the local parameters (s, t), inside the element or
 * on its edge, `order` points along lambda and along each panel of mu; their positions are relative
 * to the point, free of the rounding error of a difference. Fills correction[3]: to be
 * multiplied by the Bernstein polynomials at (s, t) and added to the moments of the kernel. slope
 * (NULL: not wanted) is its change with the derivatives along s and t there of a move of the
 * element along y, the nodes keeping their parameters. */
void singular_nodes(const struct element *element, double s, double t, int order,
                    const struct gauss *gauss, struct nodes *nodes, double correction[3],
                    double slope[2][3]);

/* Points that reach the tolerance. */
int singular_order(double tolerance);

#endif
