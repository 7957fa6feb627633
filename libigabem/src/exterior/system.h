/* Green's identity on hull, free surface and the face of a dry transom (docs/theory.md, section
 * 11):
 *     phi/2 + Int phi dG/dn dS - (1/k0) Int_F G phi_xx dS = Int G phi_n dS      on the hull,
 *     phi   + (the same)                                  = (the same)         on z = 0,
 * the first and the last integral over hull and face. Unknowns: the coefficients of phi in the
 * density's space, then those on the free surface, then those on the strip aft of the transom. */
#ifndef SYSTEM_H
#define SYSTEM_H

#include "exterior/base_flow.h"
#include "exterior/transom.h"

/* (fixed - wave/k0 - damping odd/sqrt(k0)) q = U (right + k0 slope - known/k0), row by row. */
struct exterior_system {
    size_t n, hull, cells; /* unknowns, those on the hull and on the free surface */
    double *fixed, *wave, *odd, *right, *slope, *known;
    struct base_point *base; /* of each cell; NULL: linearised about the free stream */
    double *base_on_hull;    /* [hull] coefficients of that flow's Phi on the hull, likewise */
};

/* transom: NULL without one. double_model: linearised about the double-body flow. */
igabem_status exterior_system_create(const struct influence *hull,
                                     const struct free_surface *surface,
                                     const struct transom *transom, bool double_model,
                                     struct exterior_system *system);
void exterior_system_free(struct exterior_system *system);

#endif
