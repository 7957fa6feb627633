/* The free surface beside a half hull: one block of cells on z = 0, i = 0 .. nx-1 along the stream
 * and j = 0 .. ny-1 outwards, whose inner edge is the waterline, ahead and aft of it the centre
 * line. In cell coordinates (xi, eta), whole numbers on the lines of the grid,
 *     x = x_0 - dx xi,  y = y_w(x) (1 - S(eta)/S(ny)) + S(eta),
 * S a geometric series. Bow and stern are lines of the grid. */
#ifndef FREE_SURFACE_H
#define FREE_SURFACE_H

#include "exterior/edge.h"
#include "exterior/layers.h"

struct free_surface_rule {
    double cells;      /* along the body */
    double rows;       /* outwards */
    double first;      /* width of the first row as a share of a cell's length */
    double upstream;   /* extent ahead of the body as a share of its length */
    double downstream; /* aft of it */
    double side;       /* from the centre line */
    bool transom;      /* the stern ends in a dry one */
};

struct free_surface {
    size_t nx, ny;
    size_t bow, stern;         /* cells from bow to before stern lie beside the body */
    double x0, dx;             /* m */
    double first, growth;      /* S(eta) = first (growth^eta - 1)/(growth - 1) */
    double *offset;            /* [2 ny + 1] S at every half cell */
    struct edge waterline;     /* empty over a submerged body */
    double transom;            /* half breadth that the inner edge keeps aft of the stern, m */
    struct mesh *mesh;         /* an element per cell, j fast */
    size_t columns;            /* coefficients of a row: (i, j) is i columns + j */
    size_t coefficients;       /* of the source density, padded for elements of degree 3 */
    struct layer_point *point; /* [nx ny] centres of the cells */
};

/* ends: aft and fore, of a submerged body. */
igabem_status free_surface_create(const struct free_surface_rule *rule,
                                  const struct density *density, const double ends[2],
                                  struct free_surface **surface);
/* Half breadth of the hull at x; ahead and aft of it that of the inner edge of the grid. */
double free_surface_breadth(const struct free_surface *surface, double x);

/* S(eta). */
double free_surface_offset(const struct free_surface *surface, double eta);

void free_surface_free(struct free_surface *surface);

/* y in cell coordinates; two_eta = 2 eta is a whole number. */
double free_surface_y(const struct free_surface *surface, double xi, size_t two_eta);

/* Cell coordinates of a point and eta_x and eta_y there; false inside the water plane and beyond
 * the grid. */
struct free_surface_place {
    double xi, eta, eta_x, eta_y;
};
bool free_surface_locate(const struct free_surface *surface, double x, double y,
                         struct free_surface_place *place);

#endif
