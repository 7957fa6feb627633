/* Single bicubic elements, and slow integrals over them in long double arithmetic that share
 * nothing with the modules under test but the shape. */
#ifndef QUADRATURE_REFERENCE_H
#define QUADRATURE_REFERENCE_H

#include "space/cell.h"

enum { PLATE_DEGREE = 3, PLATE_SIDE = PLATE_DEGREE + 1, PLATE_NET = PLATE_SIDE * PLATE_SIDE };

enum plate_shape {
    PLATE_BENT,      /* flat rectangle 1.2 x 0.4, inner parameter lines moved */
    PLATE_LONG,      /* the same, 1 x 0.01 */
    PLATE_CURVED,    /* half a tube that narrows and leans */
    PLATE_COLLAPSED, /* a curved triangle: the edge t = 0 is a point */
    PLATE_STRIP,     /* a quarter of a tube, a hundred times as long as wide */
    PLATE_SHAPES
};

struct plate {
    double net[PLATE_NET * 4], extraction[PLATE_NET];
    double diagonal;
    struct element element;
    struct mesh mesh;
};

/* The element refers to the plate's own arrays: do not copy. */
void plate_make(enum plate_shape shape, struct plate *plate);

const char *plate_name(enum plate_shape shape);

/* Unknown moments: the density 1 and one Bernstein polynomial. */
enum { MOMENTS = 2, FIELDS = 3 * MOMENTS };

/* Int (P - Q)/(4 pi r^3) B dS for a point off the element: fills v[MOMENTS][3]. */
void reference_near(const struct plate *plate, const double point[3], double v[FIELDS]);

/* The same, principal value, for the point at the parameters (s, t). */
void reference_singular(const struct plate *plate, double s, double t, double v[FIELDS]);

/* The same sums over nodes. */
void nodes_velocity(const struct nodes *nodes, const double point[3], double v[FIELDS]);

/* The closed form of the rectangle [x0,x1] x [y0,y1] of the plane z = 0, density 1; principal value
 * in its plane. */
void rectangle_velocity(const double p[3], double x0, double x1, double y0, double y1, double v[3]);

/* The Bernstein polynomial of the second moment at a node. */
double node_polynomial(const struct nodes *nodes, size_t i);

/* The Bernstein polynomial of the second moment at local parameters. */
double reference_polynomial(double s, double t);

/* Largest difference of two sets of moments. */
double moments_difference(const double a[FIELDS], const double b[FIELDS]);

#endif
