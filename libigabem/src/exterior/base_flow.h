/* The double-body flow past the hull on z = 0 as the flow about which the free surface is
 * linearised (docs/theory.md, section 14): w = -e_x + grad Phi, Phi of unit speed without flow
 * through z = 0, from Green's identity on the hull and on the face of a dry transom, which the
 * stream runs through. */
#ifndef BASE_FLOW_H
#define BASE_FLOW_H

#include "exterior/layers.h"
#include "exterior/operator.h"
#include "exterior/transom.h"

/* Creates points[nx ny] and fills on_hull, the coefficients of Phi on the hull. face: of the
 * transom, NULL without one; edge: phi of the hull beside the cells, from its coefficients. */
igabem_status base_flow_create(const struct influence *hull, const struct free_surface *surface,
                               const struct transom *transom, const struct influence *face,
                               double *on_hull, struct base_point **points);

/* The system of Phi on the hull: fills rows[n][n] and right[n]. */
igabem_status base_flow_system(const struct influence *hull, const struct transom *transom,
                               const struct influence *face, double *rows, double *right);

/* What is known in the condition on the surface, over the speed: it holds second(phi) less this, in
 * place of phi_xx. */
double base_flow_known(const struct base_point *point);
/* Its change with gradient and second derivatives of the point. */
double base_flow_known_change(const struct base_point *point, const double change[5]);

/* grad Phi at a place. */
void base_flow_at(const struct free_surface *surface, const struct base_point *points,
                  const struct free_surface_place *place, double gradient[2]);

/* What the cells radiate, in so many parts to a side of each: fills part[nx ny SIDE^2], columns as
 * those of sources_append(), with
 *     strength  (a.grad phi - U b) dS/k0,   a_i = w_k Phi_ki,
 *     dipole    (w (w.grad phi) - e_x phi_x) dS/k0
 * (docs/theory.md, section 14). phi: the unknowns and after them the hull's edge. Returns what the
 * surface takes of the momentum along x, over rho, on this side,
 *     (1/k0) Int D Phi_xi phi_i + phi_x (a.grad phi - U b) dS,   D = w.grad phi,
 * and along a strip less phi_x D w_y. */
enum { BASE_FLOW_SIDE = 3 };
double base_flow_radiate(const struct free_surface *surface, const struct base_point *points,
                         const double *phi, double speed, double k0, double (*part)[7]);

#endif
