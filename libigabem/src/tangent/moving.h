/* Quadrature nodes that move with the hull, under sources of a given density. A kernel K of
 * P - Q and the strength q = sigma dS of a node contribute K q to a velocity. Along a field with
 * the moves V of the node and V_P of the point they change it by K_y q (V_P - V) + K q',      q' =
 * sigma (l_s V_s + l_t V_t) weight, l_s and l_t as in struct area_change. All but the first term is
 * linear in the control values of V on the element: it is summed over the nodes as moments against
 * Bernstein polynomials, whatever the number of fields. */
#ifndef MOVING_H
#define MOVING_H

#include "tangent/tangent.h"

struct moving {
    size_t n, capacity, side[2];
    double *strength;       /* q */
    double *place;          /* of the moments: q over the homogeneous weight w of the shape */
    double *along, *across; /* of V_s and V_t in q', over w */
    double *stretch;        /* what the change of w along the parameters takes from them */
    double *du, *dv;        /* derivatives of the Bernstein polynomials */
};

/* The density on an element in Bernstein form, for all elements: offsets are those of the fields
 * over their number. Creates *bernstein. */
igabem_status moving_density(const igabem_tangent *tangent, double **bernstein);

/* Fills the columns for nodes with jets; false: no memory. */
bool moving_fill(const igabem_tangent *tangent, const double *bernstein, const struct nodes *nodes,
                 struct moving *moving);
void moving_free(struct moving *moving);

/* Adds to out[3][fields], given k and its derivative slope with respect to y of the point, [3][n]
 * each, the terms of K q' and -K_y q V. */
void moving_add(const struct field *field, const struct nodes *nodes, const struct moving *moving,
                const double *k, const double *slope, double *out);

#endif
