#ifndef NURBS_WETTED_H
#define NURBS_WETTED_H

#include <nurbs/surface.h>

/* nurbs_surface_wetted(), which fills besides the largest distance of the result from the hull at
 * equal parameters as tensor_measure() finds it, at most the tolerance. */
nurbs_status surface_wetted(const nurbs_surface *hull, double level, double tolerance,
                            nurbs_surface **wetted, double *deviation);

#endif
