/* In which order knots of one parameter direction can go, and the error to expect. */
#ifndef NURBS_KNOT_ORDER_H
#define NURBS_KNOT_ORDER_H

#include "simplify/reduction.h"
#include "simplify/thinning.h"

/* Control points along a direction: rows[size][planes][lines] to fit and, of the same shape, target
 * to compare with. A line is a curve; all share their knots. Distances are Euclidean over the
 * planes. */
struct strip {
    size_t size, planes, lines;
    double *rows, *target;
};

/* knot[k]: index, among the knots, of the one that goes as the k-th; error[k]: largest distance
 * of the control polygons of the lines once `k` of them are gone, not decreasing. */
struct knot_order {
    size_t count;
    size_t *knot;
    double *error; /* count + 1 */
};

struct knot_order_request {
    int degree;
    const double *knots;
    const struct strip *strip;
    double limit; /* of the error */
    int keep_kinks;
    const struct wall *wall;        /* of each of three planes */
    const struct knot_order *begin; /* an order whose first knots go first; NULL: none */
    size_t begin_count;
};

/* Orders the knots that can go until the error would be above the limit. */
nurbs_status knot_order_create(const struct knot_order_request *request, struct knot_order *order);
void knot_order_free(struct knot_order *order);

/* Moves the control points of a row that lie behind a wall onto it. */
void respect_walls(const struct wall wall[3], size_t planes, size_t lines, double *row);

#endif
