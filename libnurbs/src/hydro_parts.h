/* Pieces of the hydrostatics page. */
#ifndef NURBS_HYDRO_PARTS_H
#define NURBS_HYDRO_PARTS_H

#include <nurbs/integrals.h>

#include <math.h>

/* Sums over one patch of quantities times its area element dS or its oriented normal n dS =
 * (Su x Sv) du dv. */
typedef struct patch_sums {
    double area;
    double normal[3];
    double y_ny, x_y_ny, y_y_ny, z_y_ny;
    double depth_nz;        /* (level - z) n_z */
    double low[3], high[3]; /* of the quadrature points */
} patch_sums;

static const patch_sums no_sums = {.low = {INFINITY, INFINITY, INFINITY},
                                   .high = {-INFINITY, -INFINITY, -INFINITY}};

/* Hands over rows of n points S, Su, Sv of the Gauss rule with `order` points a span and direction,
 * with weights wu * wv[n]. */
typedef void patch_row(void *context, size_t n, const double *triples, double wu, const double *wv);
nurbs_status patch_visit(const nurbs_surface *surface, size_t order, patch_row *row, void *context);

/* Gauss quadrature with `order` points a span and direction. */
nurbs_status patch_integrate(const nurbs_surface *surface, double level, size_t order,
                             patch_sums *sums);

/* Signs that turn the patches' normals outwards: patches whose edges run together alike, and every
 * connected part so that it encloses a positive volume with y = 0 and the level. Fills sign[n]. */
nurbs_status outward_signs(size_t n, const nurbs_surface *const *patches, double level, int *sign);

/* Number of non-empty knot spans of a direction. */
size_t patch_spans(const nurbs_surface *surface, int direction);

/* Integrals along the edges at the level: 2 y dx and its moments. */
typedef struct waterplane {
    size_t edges;                                  /* 0: the body does not reach the level */
    double area, moment_x, inertia_xx, inertia_yy; /* 2y, 2xy, 2y^3/3, 2x^2 y times dx */
    double beam, aft, fore;
} waterplane;
/* Whether all control points of edge e (u first, u last, v first, v last) lie at the level. */
int edge_at_level(const nurbs_surface *surface, int e, double level);
nurbs_status waterplane_integrate(size_t n, const nurbs_surface *const *patches, double level,
                                  waterplane *plane);

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
