/* B-spline data as IGES files hold it: unclamped ends and odd last knots included. */
#ifndef NURBS_IGES_SPLINE_H
#define NURBS_IGES_SPLINE_H

#include <nurbs/status.h>

/* Control rows of m numbers (homogeneous) along one direction, any knots. Inserts the ends of the
 * domain [knots[p], knots[n]] until they are clamped and drops what lies outside. knots and rows
 * have room for n + 2 p rows; the domain has a length. Returns 1 when anything changed. */
int clamp_spline(int degree, size_t *n, double *knots, size_t m, double *rows);

#endif
