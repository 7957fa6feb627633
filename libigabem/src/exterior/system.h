/* Green's identity on hull and free surface (docs/theory.md, section 11):
 *     phi/2 + Int_S phi dG/dn dS - (1/k0) Int_F G phi_xx dS = U Int_S G n_x dS   on the hull,
 *     phi   + (the same)                                    = (the same)         on z = 0.
 * Unknowns: the coefficients of phi in the density's space, then those of phi on the free surface.
 */
#ifndef SYSTEM_H
#define SYSTEM_H

#include "exterior/operator.h"

/* (fixed - wave/k0) q = speed right, row by row. */
struct exterior_system {
    size_t n, hull; /* unknowns, and those on the hull */
    double *fixed, *wave, *right;
};

igabem_status exterior_system_create(const struct influence *hull,
                                     const struct free_surface *surface, double damping,
                                     struct exterior_system *system);
void exterior_system_free(struct exterior_system *system);

#endif
