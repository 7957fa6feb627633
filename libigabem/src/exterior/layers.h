/* Layer potentials of the double-body kernel G = -1/(4 pi r) - 1/(4 pi r'), r' to the image in the
 * still water, and with the mirror image in y of a half hull: rows of
 *     single[j] = Int G B_j dS,  dipole[j] = Int dG/dn B_j dS,  flow = Int G n_x dS
 * at a point, n the outward normal of the surface integrated over. */
#ifndef LAYERS_H
#define LAYERS_H

#include "influence/influence.h"

enum { LAYER_HOMES = 4 };

/* A point at which rows are wanted, and the elements of the surface that it lies on. */
struct layer_point {
    double at[3];
    size_t homes; /* 0: not on this surface */
    size_t home[LAYER_HOMES];
    double local[LAYER_HOMES][2];
};

/* A collocation point of the density, the elements that it lies on, and there half the basis, which
 * is added to the row: the solid angle of the other side. */
void layer_collocation(const struct influence *influence, size_t i, struct layer_point *point,
                       double *row);

/* The surface, by its mesh and far rules, and how it is seen. */
struct layer_surface {
    const struct influence *influence;
    bool flat;      /* in z = 0, where the image coincides: twice the direct part */
    bool symmetric; /* has a mirror image in y */
};

struct layer_rows {
    double *single, *dipole; /* accumulated; NULL: not wanted */
    double flow;
};

/* Scratch of one thread. */
struct layer_work {
    struct nodes nodes, singular;
    unsigned char *far; /* of the panels */
    int (*class)[2];
    double *kernel;
    size_t capacity;
};

igabem_status layer_work_create(const struct layer_surface *surface, struct layer_work *work);
void layer_work_free(struct layer_work *work);
/* Room in kernel for two numbers a node; false: no memory, for them or for the nodes. */
bool layer_work_reserve(struct layer_work *work, const struct nodes *nodes);

/* Adds the rows of a point. */
igabem_status layer_add(const struct layer_surface *surface, const struct layer_point *point,
                        struct layer_work *work, struct layer_rows *rows);

#endif
