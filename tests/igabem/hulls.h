/* Bodies that several tests of libigabem use. Each function returns NULL after a failed assertion.
 */
#ifndef TESTS_IGABEM_HULLS_H
#define TESTS_IGABEM_HULLS_H

#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

/* Wigley hull of unit length with its knot spans divided in parts[0] along and parts[1] in depth.
 */
nurbs_surface *wigley_surface(double beam, double draft, int parts_u, int parts_v);
igabem_hull *wigley_hull(double beam, double draft, int parts_u, int parts_v);

/* Ellipsoid of given axes, axis at z = -depth, each of its spans divided likewise. */
nurbs_surface *ellipsoid_surface(double length, double beam, double height, double depth,
                                 int parts_u, int parts_v);
igabem_hull *ellipsoid_hull(double length, double beam, double height, double depth, int parts_u,
                            int parts_v);

/* Bilinear half hull with a full-depth open stern: a wedge from the stem (1, 0) to the transom at
 * x = 0 of half breadth b, keel at z = -draft, y = 0. */
nurbs_surface *wedge_surface(double half_breadth, double draft);

#endif
