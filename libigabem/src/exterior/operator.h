/* The discrete free-surface operator. phi on the free surface is a biquadratic spline over the
 * cell coordinates with a coefficient per cell and one beyond the last downstream. Unknown (i, j)
 * is the coefficient of cell (i + 1, j): this shift is what sends the waves downstream. The others
 * are upstream     linear continuation (phi_xx = 0), centre line  the mirror image, waterline a
 * parabola through phi of the hull's edge, outer edge   linear continuation. Green's identity is
 * taken at the middles of the cells, and phi_xx from values there as a biquadratic spline of its
 * own. The surface may be linearised about another flow than the free stream. */
#ifndef OPERATOR_H
#define OPERATOR_H

#include "exterior/free_surface.h"
#include "exterior/sparse.h"

/* The flow about which the surface is linearised, at the middle of a cell, over the speed: w = -e_x
 * + gradient, and the second derivatives xx, xy, yy of its potential Phi. */
struct base_point {
    double gradient[2], second[3];
};

struct surface_operator {
    /* Columns: the unknowns, then phi of the hull's edge at the middles of the cells beside it. */
    struct sparse value;  /* phi at the middle of a cell */
    struct sparse second; /* phi_xx there, or what stands in its place (docs/theory.md, 14):
                             w_i w_j phi_ij + 2 w_k Phi_ki phi_i + Phi_kk w_i phi_i */
    /* Times sqrt(k0): what damping adds to that, Rayleigh's 2 mu w_i phi_i (-2 mu phi_x) with mu =
     * w/dx times the sixth difference across over 64, w = (1/2) sqrt(k0 dx^2/(pi dy)): a wave
     * across loses a factor e before it has strayed half its length (docs/theory.md, section 12).
     */
    struct sparse odd;
};

/* base: of each cell; NULL: the free stream. */
igabem_status operator_create(const struct free_surface *surface, const struct base_point *base,
                              struct surface_operator *operator_);
/* phi of the hull's edge at the middles of the cells beside it, from the coefficients on the hull.
 */
igabem_status operator_edge(const struct free_surface *surface, const struct density *density,
                            const struct mesh *mesh, struct sparse *edge);

/* grad phi at a place of the free surface; phi: the unknowns and after them the hull's edge. */
void operator_gradient(const struct free_surface *surface, const struct free_surface_place *place,
                       const double *phi, double gradient[2]);

void operator_free(struct surface_operator *operator_);

/* Value, second and odd of phi, which is the unknowns and after them the hull's edge: fills three
 * arrays [cells]. base: NULL for the free stream. */
void operator_apply(const struct free_surface *surface, const struct base_point *base,
                    const double *phi, double *value, double *second, double *odd);

/* Changes of the lines and of the base flow, `count` of them, while phi stays. */
struct operator_change {
    const struct free_surface *surface;
    const double *phi;
    size_t count;
    const double *breadth;         /* [2 nx + 1][count] of the inner edge, at every half cell */
    const struct base_point *base; /* NULL: the free stream */
    const double *base_change;     /* [cells][5][count] */
};

/* What they change in those three: fills [cells][count]. */
igabem_status operator_change(const struct operator_change *change, double *value, double *second,
                              double *odd);

/* The spline's coefficients from its values at the middles of the cells, which lie as below, in
 * place. */
void operator_interpolate(const struct free_surface *surface, double *values, double *scratch);

/* Turns factors of the coefficients of phi_xx, (nx + 2) (ny + 2) in rows of surface->columns, into
 * factors of its values at the middles of the cells: that of cell (i, j) is then at
 * (i + 1) columns + j + 1. scratch has room for nx and ny. */
void operator_fold(const struct free_surface *surface, double *coefficients, double *scratch);

#endif
