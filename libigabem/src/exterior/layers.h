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

/* A collocation point of the density and the elements that it lies on. */
void layer_place(const struct influence *influence, size_t i, struct layer_point *point);
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

/* The point and its reflections, which stand for the images of the surface: fills image[4][3] and
 * whether y is turned round in it, returns their number. The first is the point itself. */
int layer_images(const struct layer_surface *surface, const struct layer_point *point,
                 double image[4][3], bool turned[4]);
/* Which panels see which images from afar, by which rules: fills far and class of the work. */
void layer_look(const struct layer_surface *surface, const struct layer_point *point, int images,
                const double image[4][3], struct layer_work *work);
/* Appends the nodes of the others, seen by image i, to the work's; of the point's own elements not
 * for the point itself: those are its singular ones, relative to the point. */
void layer_near_nodes(const struct layer_surface *surface, const struct layer_point *point, int i,
                      const double image[3], struct layer_work *work);
void layer_singular_nodes(const struct layer_surface *surface, const struct layer_point *point,
                          struct layer_work *work);

/* Adds the rows of a point. */
igabem_status layer_add(const struct layer_surface *surface, const struct layer_point *point,
                        struct layer_work *work, struct layer_rows *rows);

#endif
