#include "quadrature_singular.h"

#include "constants.h"

#include <math.h>

static const double panel_length = 1.2; /* in mu; the kernel's poles are at +- i pi/2 */

int singular_order(double tolerance)
{
    double n = 3.0 - 0.85 * log10(tolerance);
    return n < 4 ? 4 : n > GAUSS_MAX ? GAUSS_MAX : (int)ceil(n);
}

struct triangle {
    double corner[2], edge[2]; /* local: first end of the edge from the point, and along the edge */
    double foot, height;       /* tau* and d */
    double area;               /* twice the triangle's, in local parameters */
    double tangent[2][3];      /* images of corner and edge in the tangent plane */
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static int make_triangle(const struct jet *jet, const double a[2], const double b[2],
                         struct triangle *triangle)
{
    triangle->corner[0] = a[0];
    triangle->corner[1] = a[1];
    triangle->edge[0] = b[0] - a[0];
    triangle->edge[1] = b[1] - a[1];
    triangle->area = fabs(a[0] * b[1] - a[1] * b[0]);
    if (triangle->area < 1e-13)
        return 0;
    for (int c = 0; c < 3; c++) {
        triangle->tangent[0][c] = jet->ds[c] * a[0] + jet->dt[c] * a[1];
        triangle->tangent[1][c] = jet->ds[c] * triangle->edge[0] + jet->dt[c] * triangle->edge[1];
    }
    const double *p = triangle->tangent[0], *q = triangle->tangent[1];
    const double cross[3] = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
                             p[0] * q[1] - p[1] * q[0]};
    double square = dot(q, q);
    triangle->foot = -dot(p, q) / square;
    triangle->height = sqrt(dot(cross, cross)) / square;
    return 1;
}

static void triangle_nodes(const struct triangle *triangle, const struct element *element,
                           const double at[2], double strength, int order,
                           const struct gauss *gauss, struct nodes *nodes, double correction[3])
{
    double mu0 = asinh(-triangle->foot / triangle->height);
    double mu1 = asinh((1.0 - triangle->foot) / triangle->height);
    int panels = (int)ceil((mu1 - mu0) / panel_length);
    const double *node = gauss->node[order], *weight = gauss->weight[order];
    double inverse = 0.0; /* the rule's value of Int dlambda / lambda */
    for (int i = 0; i < order; i++)
        inverse += weight[i] / node[i];
    double step = (mu1 - mu0) / panels;
    for (int k = 0; k < panels * order; k++) {
        double mu = mu0 + step * (k / order + node[k % order]);
        double tau = triangle->foot + triangle->height * sinh(mu);
        double w = step * weight[k % order] * triangle->height * cosh(mu) * triangle->area;
        double ray[2], image[3];
        for (int d = 0; d < 2; d++)
            ray[d] = triangle->corner[d] + tau * triangle->edge[d];
        for (int i = 0; i < order; i++)
            point_node(element, at[0] + node[i] * ray[0], at[1] + node[i] * ray[1],
                       w * weight[i] * node[i], nodes);
        for (int c = 0; c < 3; c++)
            image[c] = triangle->tangent[0][c] + tau * triangle->tangent[1][c];
        double square = dot(image, image), length = sqrt(square);
        double factor = -w * strength * (log(length) - inverse) / (4.0 * PI * square * length);
        for (int c = 0; c < 3; c++)
            correction[c] += factor * image[c];
    }
}

void singular_nodes(const struct element *element, double s, double t, int order,
                    const struct gauss *gauss, struct nodes *nodes, double correction[3])
{
    struct jet jet;
    double area[3], at[2] = {s, t};
    element_jet(element, s, t, &jet);
    double strength = jet_area(&jet, 1.0, area) / jet.weight;
    const double corner[5][2] = {
        {-s, -t}, {1.0 - s, -t}, {1.0 - s, 1.0 - t}, {-s, 1.0 - t}, {-s, -t}};
    correction[0] = correction[1] = correction[2] = 0.0;
    for (int k = 0; k < 4; k++) {
        struct triangle triangle;
        if (make_triangle(&jet, corner[k], corner[k + 1], &triangle))
            triangle_nodes(&triangle, element, at, strength, order, gauss, nodes, correction);
    }
}
