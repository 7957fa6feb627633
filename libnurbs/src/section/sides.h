#ifndef NURBS_SIDES_H
#define NURBS_SIDES_H

#include <nurbs/status.h>

/* Moves control points of a polynomial half hull as little as needed where the surface has y < 0,
 * until it has none (to 1e-12 of its breadth). Edges that lie in y = 0 stay there. *moved: the
 * largest change of a control point, which bounds how far any point of the surface moves. */
nurbs_status raise_to_side(const int degree[2], const size_t size[2], const double *knots_u,
                           const double *knots_v, double *points, double *moved);

#endif
