/* Pieces of the hydrostatics page. */
#ifndef NURBS_HYDRO_PARTS_H
#define NURBS_HYDRO_PARTS_H

#include <nurbs/integrals.h>

/* Signs that turn the patches' normals outwards: patches whose edges run together alike, and every
 * connected part so that it encloses a positive volume with y = 0 and the level. Fills sign[n]. */
nurbs_status outward_signs(size_t n, const nurbs_surface *const *patches, double level, int *sign);

/* Integrals along the edges at the level, directed as the boundary of the outward surface, so that
 * the inner side of a hull beside the centre plane subtracts: 2 y dx and its moments. */
typedef struct waterplane {
    size_t edges;                                  /* 0: the body does not reach the level */
    double area, moment_x, inertia_xx, inertia_yy; /* 2y, 2xy, 2y^3/3, 2x^2 y times dx */
    double beam, aft, fore;
} waterplane;
/* Whether all control points of edge e (u first, u last, v first, v last) lie at the level. */
int edge_at_level(const nurbs_surface *surface, int e, double level);
nurbs_status waterplane_integrate(size_t n, const nurbs_surface *const *patches, const int *sign,
                                  double level, waterplane *plane);

/* Largest value of sign * coordinate (0 x, 1 y, 2 z) over the patches, times sign. */
nurbs_status extreme_point(size_t n, const nurbs_surface *const *patches, int coordinate,
                           double sign, double *value);

/* Area of both sides and lowest z of the section x = constant; sign[n] turns the patches outwards.
 */
nurbs_status section_area(size_t n, const nurbs_surface *const *patches, const int *sign, double x,
                          double *area, double *low);
/* Largest such area between aft and fore. */
nurbs_status section_area_largest(size_t n, const nurbs_surface *const *patches, const int *sign,
                                  double aft, double fore, double *area, double *at);

#endif
