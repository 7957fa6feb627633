#ifndef NURBS_PARAMETRIZE_H
#define NURBS_PARAMETRIZE_H

#include <nurbs/fit.h>

/* Parameters of n points averaged over `lines` lines of a grid (point k of line l is the triple at
 * index l*line_stride + k*point_stride); lines that collapse to a point are left out. Fails unless
 * the result increases. */
nurbs_status nurbs_parametrize_lines(nurbs_parametrization kind, size_t lines, size_t n,
                                     size_t line_stride, size_t point_stride, const double *points,
                                     double *u);

/* Angle between b - a and c - b, in [0, pi]; 0 where they coincide. */
double nurbs_turning_angle(const double *a, const double *b, const double *c);

#endif
