/* Curves that follow each other as one. */
#ifndef NURBS_CURVE_JOIN_H
#define NURBS_CURVE_JOIN_H

#include <nurbs/curve.h>

#include <stdbool.h>

/* One curve of the highest degree, exact, with a knot of multiplicity degree at every joint. Where
 * the end of one and the start of the next differ, the end counts. */
nurbs_status curves_join(size_t n, const nurbs_curve *const *curves, nurbs_curve **joined);

#endif
