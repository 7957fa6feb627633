/* Gauss quadrature over the knot spans of a patch. */
#ifndef NURBS_PATCH_QUADRATURE_H
#define NURBS_PATCH_QUADRATURE_H

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

/* Number of non-empty knot spans of a direction. */
size_t patch_spans(const nurbs_surface *surface, int direction);

#endif
