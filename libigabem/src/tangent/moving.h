/* Quadrature nodes that move with the hull, under sources of a given density. A kernel K of
 * P - Q and the strength q = sigma dS of a node contribute K q to a velocity. Along a field with
 * the moves V of the node and V_P of the point they change it by K_y q (V_P - V) + K q',      q' =
 * sigma (l_s V_s + l_t V_t) weight, l_s and l_t as in struct area_change. All but the first term is
 * linear in the control values of V on the element: it is summed over the nodes as moments against
 * Bernstein polynomials, whatever the number of fields. */
#ifndef MOVING_H
#define MOVING_H

#include "space/line.h"
#include "tangent/tangent.h"

struct moving {
    size_t n, capacity, side[2];
    double *strength;       /* q */
    double *place;          /* of the moments: q over the homogeneous weight w of the shape */
    double *along, *across; /* of V_s and V_t in q', over w */
    double *stretch;        /* what the change of w along the parameters takes from them */
    double *du, *dv;        /* derivatives of the Bernstein polynomials */
};

/* The density on the elements in Bernstein form, from the offsets of the field on. Creates
 * *bernstein. */
igabem_status moving_density(const igabem_tangent *tangent, double **bernstein);

/* Fills the columns for nodes with jets; false: no memory. */
bool moving_fill(const igabem_tangent *tangent, const double *bernstein, const struct nodes *nodes,
                 struct moving *moving);
/* The same for nodes of line_nodes() with normals, all of one segment, of strength
 * -scale chi sigma n_x nu_x dl. */
bool moving_fill_line(const igabem_tangent *tangent, const double *bernstein,
                      const struct line *line, const struct line_segment *segment, double scale,
                      const struct nodes *nodes, struct moving *moving);
void moving_free(struct moving *moving);

/* The strength -chi n_x nu_x dl of a place on the waterline for unit density and parameter, and
 * what V_s and V_t there change in it. */
struct line_change {
    double strength, change[2], dl;
};

void line_change(const struct line *line, const struct line_segment *segment, const double local[2],
                 struct line_change *change);

/* Changes along the fields of node i, of the given element: of its strength, and its strength times
 * its move. Fills change[2][fields]. */
void moving_changes(const struct field *field, const struct nodes *nodes,
                    const struct moving *moving, const struct element *element, size_t i,
                    double *change);

/* Adds to out[3][fields], given k and its derivative slope with respect to y of the point, [3][n]
 * each, the terms of K q' and -K_y q V. */
void moving_add(const struct field *field, const struct nodes *nodes, const struct moving *moving,
                const double *k, const double *slope, double *out);

#endif
