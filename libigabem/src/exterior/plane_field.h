/* Derivatives along the still water, off the hull, of the potential of given layers,
 *     Phi = Int G n_x dS - Int Phi dG/dn dS
 * with the double-body kernel G of layers.h. */
#ifndef PLANE_FIELD_H
#define PLANE_FIELD_H

#include "exterior/layers.h"

/* One surface, with the strengths of the nodes of its far rules. */
struct plane_layer {
    const struct influence *influence;
    const double *phi; /* coefficients of Phi, borrowed */
    bool flux;         /* the first integral runs over it too */
    double *strength;  /* of all rules one behind the other: Phi dS */
    size_t *offset;    /* of a rule there */
};

igabem_status plane_layer_create(const struct influence *influence, const double *phi, bool flux,
                                 struct plane_layer *layer);
void plane_layer_free(struct plane_layer *layer);

/* Adds x, y, xx, xy and yy of a layer and its mirror image in y at a point of z = 0. */
igabem_status plane_layer_add(const struct plane_layer *layer, const double at[2],
                              struct layer_work *work, double derivative[5]);

#endif
