/* Section curves on one knot vector, what skinning starts from. */
#ifndef NURBS_SKIN_COMMON_H
#define NURBS_SKIN_COMMON_H

#include "core/object.h"

/* Control points [sections][size][dimension]. */
typedef struct common {
    int degree;
    size_t size, dimension; /* 3, or 4: homogeneous */
    double *knots, *net;
} common;

/* Exactly: the union of all knots. The n curves have the domain [0,1] and the degree of `sections`;
 * knots closer than 1e-9 are one. Fills size, knots and net, which the caller frees. */
nurbs_status common_union(size_t n, const nurbs_curve *const *curves, common *sections);

/* Within a tolerance in metres, three-dimensional. Fills the same. */
nurbs_status common_within(size_t n, const nurbs_curve *const *curves, double tolerance,
                           common *sections);

#endif
