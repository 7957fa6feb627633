/* Knots for a tensor spline that follows a given map (u,w) -> space within a tolerance. */
#ifndef NURBS_TENSOR_REFINE_H
#define NURBS_TENSOR_REFINE_H

#include "core/knot_list.h"

#include <nurbs/surface.h>

/* A map given section by section: fills out[n][3] with the points at u and w[n]. */
typedef struct tensor_map {
    nurbs_status (*section)(void *context, double u, size_t n, const double *w, double *out);
    void *context;
} tensor_map;

/* Fills out[n[0]][n[1]][3] with the map on u[n[0]] x w[n[1]], or out[n[1]][n[0]][3] when `turned`.
 */
nurbs_status tensor_sample(const tensor_map *map, int turned, const size_t n[2],
                           const double *const parameters[2], double *out);

/* Divides spans of along[0] (u) and along[1] (w) until interpolation at the Greville points, one
 * direction at a time, is within `target` metres of the map inside every span. */
nurbs_status tensor_refine(const tensor_map *map, double target, knot_list along[2]);

/* How far a tensor spline is from the map, on several places a span and direction, none of them a
 * knot. Creates parts[d], for knot_list_divide(): 2 for the intervals in which the distance is more
 * than the tolerance, else 1; the caller frees them, also after a failure. */
nurbs_status tensor_measure(const tensor_map *map, const nurbs_surface *spline, double tolerance,
                            unsigned char *parts[2], double *deviation);

/* Interpolates rows[n][m] given at the sites, in place. */
nurbs_status tensor_solve(int degree, size_t n, const double *knots, const double *sites, size_t m,
                          double *rows);

/* Control points across: replaces net[rows][columns][3], values at the sites of the second
 * direction, by control points. */
nurbs_status tensor_solve_across(const knot_list *along, size_t rows, const double *sites,
                                 double *net);

#endif
