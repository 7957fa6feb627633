/* A clamped knot vector that grows. */
#ifndef NURBS_KNOT_LIST_H
#define NURBS_KNOT_LIST_H

#include <nurbs/status.h>

typedef struct knot_list {
    int degree;
    size_t size; /* control points: size + degree + 1 knots */
    size_t room;
    size_t most; /* control points it may grow to */
    double *knots;
} knot_list;

/* No interior knots. */
nurbs_status knot_list_start(knot_list *list, int degree, const double range[2]);
void knot_list_free(knot_list *list);

/* Adds an interior knot not below the others. */
nurbs_status knot_list_append(knot_list *list, double knot);

/* Divides the knot interval k, k + 1 into parts[k] equal parts (0 and 1: left as it is). */
nurbs_status knot_list_divide(knot_list *list, const unsigned char *parts);

#endif
