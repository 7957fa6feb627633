/* The waterline of a hull as a line of sources (Brard 1972): strength per length
 *     -(1/k0) chi sigma n_x nu_x,  chi = 1/(1 + (|nu_x|/nu_c)^4),
 * with the density of the patch's own edge, n the normal of the hull and nu that of the waterline.
 */
#ifndef LINE_H
#define LINE_H

#include "space/quadrature_near.h"

/* A part of an element's edge on which the strength for unit density is smooth enough for a few
 * Gauss points: near a stem the normal turns within a fraction of a knot span. */
struct line_segment {
    const struct element *element;
    int fixed, end;  /* local parameter `fixed` of the element is 0 (end 0) or 1 on the line */
    double range[2]; /* of the other local parameter */
    double box[2];   /* bounds of x over the element's whole edge */
};

struct line {
    size_t n, capacity;
    struct line_segment *segment;
    double limit; /* nu_c */
};

igabem_status line_create(const struct density *density, const struct mesh *mesh, double limit,
                          struct line **line);
void line_free(struct line *line);

struct line_point {
    double x, y, dl; /* m; length per unit of the local parameter */
    double nu_x;
    double strength; /* -chi n_x nu_x */
    double weight;   /* homogeneous */
};

void line_evaluate(const struct line *line, const struct line_segment *segment, double a,
                   struct line_point *point);

/* Appends a Gauss rule of n points on a range of the segment's parameter; g holds the strength
 * for unit density times length over the homogeneous weight: velocities still want the factor
 * 1/k0. */
void line_nodes(const struct line *line, const struct line_segment *segment, const double range[2],
                int n, const struct gauss *gauss, struct nodes *nodes);

/* Parts of a segment on either side of x: fills stops (with the ends of its range), returns their
 * number. */
size_t line_cut(const struct line_segment *segment, double x, double stops[ELEMENT_SIDE + 2]);

/* Appends the nodes of a rule adapted to a point near the line. */
void line_near(const struct line *line, const struct line_segment *segment, const double range[2],
               const struct near_rule *rule, struct nodes *nodes);

#endif
