/* A dry transom: its face, from the rim up to the still water, and the strip of free surface aft of
 * it. The strip is divided in columns along the stream, in each of which phi is a quadratic spline
 * of x alone that starts with phi of the hull's rim (Kutta) and with the slope
 *     phi_x = (g/U) z_rim = U k0 z_rim,
 * the surface leaving the rim at atmospheric pressure. The face carries that flux, phi_n = n_x
 * phi_x, and phi of the rim. */
#ifndef TRANSOM_H
#define TRANSOM_H

#include "exterior/edge.h"
#include "exterior/layers.h"
#include "exterior/sparse.h"

enum { TRANSOM_FACE_PARTS = 4 }; /* elements of the face in a column */

struct transom {
    size_t n;       /* columns */
    size_t cells;   /* of the strip, downstream */
    double x, dx;   /* where it starts; length of a cell, m */
    double breadth; /* half, m */
    struct edge rim_edge;
    double *depth; /* [n] z of the rim at the middles of the columns, m */
    double *turn;  /* [n] n_x of the face there */
    struct mesh *face, *strip;
    size_t stride;             /* of the coefficients of the strip's phi_xx, j fast */
    size_t coefficients;       /* their number, padded */
    struct layer_point *point; /* [cells n] middles of the strip's cells */
    struct sparse rim; /* phi of the rim at the columns, from the coefficients on the hull */
    /* By the columns: the unknowns (i n + j stands for cell i + 1), phi of the rim, its slope. */
    struct sparse value, second; /* phi and phi_xx at the middles */
};

/* The strip has the cells of the free surface aft of the waterline's end at x. */
igabem_status transom_create(const struct density *density, const struct mesh *hull, double length,
                             double x, double breadth, double dx, size_t cells, double width,
                             struct transom **transom);
void transom_free(struct transom *transom);

/* Turns factors of the coefficients of the strip's phi_xx into factors of its values, in place:
 * that of cell (i, j) is then at (i + 1) stride + j. */
void transom_fold(const struct transom *transom, double *coefficients, double *scratch);

/* The coefficients of the spline through values, which lie as above, in place. */
void transom_interpolate(const struct transom *transom, double *values, double *scratch);

/* phi_x at a place of the strip; phi: the unknowns, phi of the rim, its slope. */
double transom_slope(const struct transom *transom, double x, double y, const double *phi);

#endif
