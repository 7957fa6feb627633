#ifndef NURBS_SIDES_H
#define NURBS_SIDES_H

#include <nurbs/status.h>

/* Raises control points of a polynomial half hull from y < 0 to y = 0 where the surface itself
 * (sampled five times a knot span and direction) has y < 0. Returns the largest rise in *moved,
 * which bounds how far any point of the surface moves. Edges that lie in y = 0 stay there. */
nurbs_status raise_to_side(const int degree[2], const size_t size[2], const double *knots_u,
                           const double *knots_v, double *points, double *moved);

#endif
