/* Knot spans of the density space in Bezier form: the piece of surface over one span as homogeneous
 * Bezier points, and the extraction matrices that turn integrals against Bernstein polynomials into
 * integrals against the spline basis (Borden et al., IJNME 87, 2011). Local parameters s, t in
 * [0,1]. */
#ifndef ELEMENT_H
#define ELEMENT_H

#include "space/density.h"

enum {
    ELEMENT_MAX_DEGREE = 9,
    ELEMENT_SIDE = ELEMENT_MAX_DEGREE + 1,
    ELEMENT_FUNCTIONS = ELEMENT_SIDE * ELEMENT_SIDE
};

struct element {
    size_t patch;
    int degree[2];
    double lower[2], upper[2];   /* parameters of the span */
    const double *extraction[2]; /* [p+1][p+1]: spline function a = sum_k E[a][k] Bernstein_k */
    const double *weight;        /* of the first function, stride as below; NULL: polynomial */
    const double *net;           /* [pu+1][pv+1][4]: wx, wy, wz, w */
    size_t first;                /* unknown that belongs to the function (0, 0) of the span */
    size_t stride;               /* from function (i, j) to (i+1, j) */
    int rational;                /* of the density: weight != NULL */
    const double *shape[2];      /* the same extraction for the functions of the surface, */
    const double *shape_weight;  /* their weights, NULL: polynomial, */
    size_t control;              /* and its first control point, of those of all patches */
    size_t control_stride;
    double sign;      /* outward normal = sign * S_s x S_t */
    double box[2][3]; /* bounds of the Bezier points, hence of the piece */
};

/* Elements that see the same functions of the density: what a distant point sees as one. */
struct panel {
    size_t first, count; /* elements */
    double lower[2], upper[2];
};

struct mesh {
    size_t n, panels;
    struct element *element; /* panel by panel, patch by patch */
    struct panel *panel;
    double *storage;
    size_t degree[2];   /* largest of all elements */
    size_t *patch_base; /* first element of each patch, and their number */
};

igabem_status mesh_create(const struct density *density, struct mesh **mesh);
/* The same elements on other surfaces, one for each patch, of the degrees, knots and weights of
 * those of the density (density_conform). */
igabem_status mesh_create_on(const struct density *density, const nurbs_surface *const *surface,
                             struct mesh **mesh);
void mesh_free(struct mesh *mesh);

/* Bernstein polynomials of degree p at s, and their derivatives if not NULL. */
void bernstein(int p, double s, double *values, double *derivatives);

struct jet {
    double s[3], ds[3], dt[3]; /* point and derivatives with respect to s and t */
    double weight;             /* homogeneous weight of the density there, 1 when polynomial */
};

void element_jet(const struct element *element, double s, double t, struct jet *jet);

/* S_s x S_t turned outwards; returns its length. */
double jet_area(const struct jet *jet, double sign, double area[3]);

/* Adds integrals against the spline basis to rows[c * stride + unknown], c < fields, given those
 * against Bernstein polynomials over the homogeneous weight: moments[c][pu+1][pv+1]. */
void element_scatter(const struct element *element, size_t fields, const double *moments,
                     double *rows, size_t stride);

/* Coefficients of a field in the Bernstein basis of the element, weights included: the field at
 * (s,t) is sum B_a(s) B_b(t) out[a][b] / jet.weight. */
void element_gather(const struct element *element, const double *coefficients, double *out);

/* The element that holds parameters of a patch, and the local ones. */
const struct element *mesh_locate(const struct mesh *mesh, size_t patch, const double uv[2],
                                  double local[2]);

/* Turns factors of homogeneous Bezier values over the element, [pu+1][pv+1], into factors of the
 * values at control points of its surface: adds them to point[]. */
void element_controls(const struct element *element, const double *factor, double *point);

/* Derivatives of a field along the local parameters. */
void element_slope(const struct element *element, const double *coefficients, const double local[2],
                   double slope[2]);

#endif
