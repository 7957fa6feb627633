/* What moves of quadrature nodes count for, turned into what the numbers that move them count for:
 * the control values of a hull's element, the inner edge of the free surface, the rim of a
 * transom. A node counts with place . v for its own move v and with h . a' for the change of its
 * area vector, which is a' = sign (v_s x S_t + S_s x v_t). */
#ifndef FOLD_H
#define FOLD_H

#include "tangent/shape.h"

/* Nodes on the hull, with jets, and what their elements' control values V, over the homogeneous
 * weight, are to them. */
struct hull_nodes {
    const struct nodes *nodes;
    double *du, *dv;     /* [n][side] derivatives of the Bernstein polynomials */
    double *w, *ws, *wt; /* homogeneous weight of the shape and its derivatives */
    size_t capacity;
};

/* Fills them; false: no memory. */
bool hull_nodes_fill(const struct nodes *nodes, struct hull_nodes *hull);
void hull_nodes_free(struct hull_nodes *hull);

/* Adds to moment[(pu+1)(pv+1)] of the element of nodes begin to end: y of place, x and z of h, the
 * first of them that of node `first`. */
void fold_hull(const struct hull_nodes *hull, const struct block *block, size_t first,
               const double *place, const double *hx, const double *hz, double *moment);
/* The same of one place, whose move, V_s and V_t count for place and slope[2]. */
void fold_point(const struct element *element, const double local[2], double place,
                const double slope[2], double *moment);

/* Adds one node of an element of the face to the numbers of a shape. */
void fold_face(const struct shape *shape, size_t part, const double local[2], const double jet[6],
               double sign, const double place[3], const double h[3], double *numbers);

#endif
