/* The double-body flow past the hull on z = 0 as the flow about which the free surface is
 * linearised (docs/theory.md, section 14): w = -e_x + grad Phi, Phi of unit speed without flow
 * through z = 0, from Green's identity on the hull and on the face of a dry transom, which the
 * stream runs through. */
#ifndef BASE_FLOW_H
#define BASE_FLOW_H

#include "exterior/layers.h"
#include "exterior/operator.h"
#include "exterior/transom.h"

/* Creates points[nx ny]. face: of the transom, NULL without one; edge: phi of the hull beside the
 * cells, from its coefficients. */
igabem_status base_flow_create(const struct influence *hull, const struct free_surface *surface,
                               const struct transom *transom, const struct influence *face,
                               const struct sparse *edge, struct base_point **points);

/* What is known in the condition on the surface, over the speed: it holds second(phi) less this, in
 * place of phi_xx. */
double base_flow_known(const struct base_point *point);

/* grad Phi at a place. */
void base_flow_at(const struct free_surface *surface, const struct base_point *points,
                  const struct free_surface_place *place, double gradient[2]);

/* Beyond the waterline, the cells radiate by what their strength differs from phi_xx: fills
 * excess[nx ny], m^3/s. second: the operator's rows; phi: the unknowns and after them the hull's
 * edge. */
igabem_status base_flow_excess(const struct free_surface *surface, const struct base_point *points,
                               const struct sparse *second, const double *phi, double speed,
                               double k0, double *excess);

#endif
