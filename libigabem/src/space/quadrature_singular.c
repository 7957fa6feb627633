#include "space/quadrature_singular.h"

#include "core/constants.h"

#include <math.h>
#include <string.h>

static const double panel_length = 1.2; /* in mu; the kernel's poles are at +- i pi/2 */

int singular_order(double tolerance)
{
    double n = 1.7 - 0.85 * log10(tolerance);
    return n < 4 ? 4 : n > GAUSS_MAX ? GAUSS_MAX : (int)ceil(n);
}

/* The shape about the point P of the element: coefficients of ds^k dt^l in (w (Q - P), w), without
 * the rounding error of a difference of positions. */
struct expansion {
    int degree[2];
    double term[ELEMENT_SIDE][ELEMENT_SIDE][4];
};

/* Taylor coefficients at s of a polynomial of degree p in Bernstein form, four at once; `step` in
 * doubles from one coefficient to the next on either side. */
static void taylor(int p, double s, const double *bezier, size_t step, double *out, size_t out_step)
{
    double difference[ELEMENT_SIDE][4], basis[ELEMENT_SIDE], binomial = 1.0;
    for (int i = 0; i <= p; i++)
        memcpy(difference[i], bezier + (size_t)i * step, sizeof difference[i]);
    for (int k = 0; k <= p; k++, out += out_step) {
        bernstein(p - k, s, basis, NULL);
        for (int c = 0; c < 4; c++) {
            out[c] = 0.0;
            for (int i = 0; i <= p - k; i++)
                out[c] += basis[i] * difference[i][c];
            out[c] *= binomial;
            for (int i = 0; i < p - k; i++)
                difference[i][c] = difference[i + 1][c] - difference[i][c];
        }
        binomial *= (double)(p - k) / (double)(k + 1);
    }
}

static void expand(const struct element *element, double s, double t, const double point[3],
                   struct expansion *expansion)
{
    int p = element->degree[0], q = element->degree[1];
    double net[ELEMENT_SIDE][4], half[ELEMENT_SIDE][ELEMENT_SIDE][4];
    expansion->degree[0] = p;
    expansion->degree[1] = q;
    for (int i = 0; i <= p; i++) {
        const double *h = element->net + 4 * (size_t)(i * (q + 1));
        for (int j = 0; j <= q; j++, h += 4) {
            for (int c = 0; c < 3; c++)
                net[j][c] = h[c] - h[3] * point[c];
            net[j][3] = h[3];
        }
        taylor(q, t, net[0], 4, half[i][0], 4);
    }
    for (int l = 0; l <= q; l++)
        taylor(p, s, half[0][l], 4 * ELEMENT_SIDE, expansion->term[0][l], 4 * ELEMENT_SIDE);
    for (int c = 0; c < 3; c++)
        expansion->term[0][0][c] = 0.0;
}

/* The expansion and its two derivatives along (ds, dt) = lambda ray: polynomials in lambda. */
struct ray {
    int degree;
    double value[2 * ELEMENT_SIDE][4], ds[2 * ELEMENT_SIDE][4], dt[2 * ELEMENT_SIDE][4];
};

static void restrict_to(const struct expansion *expansion, const double direction[2],
                        struct ray *ray)
{
    int p = expansion->degree[0], q = expansion->degree[1];
    double power[2][ELEMENT_SIDE + 1];
    for (int d = 0; d < 2; d++) {
        power[d][0] = 1.0;
        for (int k = 1; k <= expansion->degree[d]; k++)
            power[d][k] = power[d][k - 1] * direction[d];
    }
    ray->degree = p + q;
    size_t used = (size_t)(p + q + 1) * sizeof ray->value[0];
    memset(ray->value, 0, used);
    memset(ray->ds, 0, used);
    memset(ray->dt, 0, used);
    for (int k = 0; k <= p; k++)
        for (int l = 0; l <= q; l++) {
            double v = power[0][k] * power[1][l], u = k ? k * power[0][k - 1] * power[1][l] : 0.0;
            double w = l ? l * power[0][k] * power[1][l - 1] : 0.0;
            const double *term = expansion->term[k][l];
            int m = k + l, n = m ? m - 1 : 0;
            for (int c = 0; c < 4; c++) {
                ray->value[m][c] += v * term[c];
                ray->ds[n][c] += u * term[c];
                ray->dt[n][c] += w * term[c];
            }
        }
}

static void horner(int degree, const double (*coefficient)[4], double x, double out[4])
{
    memcpy(out, coefficient[degree], 4 * sizeof *out);
    for (int m = degree - 1; m >= 0; m--)
        for (int c = 0; c < 4; c++)
            out[c] = out[c] * x + coefficient[m][c];
}

/* Point relative to P and its derivatives at lambda. */
static void ray_jet(const struct ray *ray, int rational, double lambda, struct jet *jet)
{
    double h[4], hs[4], ht[4];
    horner(ray->degree, (const double(*)[4])ray->value, lambda, h);
    horner(ray->degree - 1, (const double(*)[4])ray->ds, lambda, hs);
    horner(ray->degree - 1, (const double(*)[4])ray->dt, lambda, ht);
    double inverse = 1.0 / h[3];
    jet->weight = rational ? h[3] : 1.0;
    for (int c = 0; c < 3; c++) {
        jet->s[c] = h[c] * inverse;
        jet->ds[c] = (hs[c] - jet->s[c] * hs[3]) * inverse;
        jet->dt[c] = (ht[c] - jet->s[c] * ht[3]) * inverse;
    }
}

/* Nodes along one ray, `weight` times those of the Gauss rule times lambda. */
static void ray_nodes(const struct element *element, const struct ray *ray, const double at[2],
                      const double direction[2], int order, double weight,
                      const struct gauss *gauss, struct nodes *nodes)
{
    size_t n = nodes_append(nodes, element, (size_t)order);
    if (nodes->failed)
        return;
    for (int i = 0; i < order; i++, n++) {
        double lambda = gauss->node[order][i], area[3];
        struct jet jet;
        ray_jet(ray, element->rational, lambda, &jet);
        nodes->x[n] = jet.s[0];
        nodes->y[n] = jet.s[1];
        nodes->z[n] = jet.s[2];
        double size = jet_area(&jet, element->sign, area);
        nodes->g[n] = weight * gauss->weight[order][i] * lambda * size / jet.weight;
        nodes_jet(nodes, n, &jet);
        for (size_t c = 0; c < 3 && nodes->with_normals; c++)
            nodes->normal[3 * n + c] = area[c] / size;
        bernstein(element->degree[0], at[0] + lambda * direction[0], nodes->bu + n * nodes->side[0],
                  NULL);
        bernstein(element->degree[1], at[1] + lambda * direction[1], nodes->bv + n * nodes->side[1],
                  NULL);
    }
}

struct triangle {
    double edge[2];      /* along the edge, in local parameters */
    double foot, height; /* tau* and d */
    double foot_ray[2];  /* from the point to the edge at tau* */
    double area;         /* twice the triangle's, in local parameters */
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static int make_triangle(const struct jet *jet, const double a[2], const double b[2],
                         struct triangle *triangle)
{
    triangle->edge[0] = b[0] - a[0];
    triangle->edge[1] = b[1] - a[1];
    triangle->area = fabs(a[0] * b[1] - a[1] * b[0]);
    if (triangle->area < 1e-13)
        return 0;
    double p[3], q[3]; /* images of the corner and the edge in the tangent plane */
    for (int c = 0; c < 3; c++) {
        p[c] = jet->ds[c] * a[0] + jet->dt[c] * a[1];
        q[c] = jet->ds[c] * triangle->edge[0] + jet->dt[c] * triangle->edge[1];
    }
    double square = dot(q, q), normal[3];
    triangle->foot = -dot(p, q) / square;
    triangle->height = triangle->area * jet_area(jet, 1.0, normal) / square;
    for (int d = 0; d < 2; d++)
        triangle->foot_ray[d] = a[d] + triangle->foot * triangle->edge[d];
    return 1;
}

/* Adds the derivatives of one direction's part of the correction, -w J (ln l - inverse)/(4 pi l^3)
 * times the image of length l, J the area element over the weight: the image moves by
 * e_y (direction . (V_s, V_t)). */
static void add_slope(const struct jet *jet, const double direction[2], const double image[3],
                      double length, double w, double inverse, double slope[2][3])
{
    const double *a = jet->ds, *b = jet->dt;
    double normal[3], size = jet_area(jet, 1.0, normal);
    const double growth[2] = {(normal[0] * b[2] - normal[2] * b[0]) / size,
                              (normal[2] * a[0] - normal[0] * a[2]) / size};
    double cube = length * length * length, f = (log(length) - inverse) / cube;
    double df = (1.0 - 3.0 * (log(length) - inverse)) / (cube * length);
    double scale = -w / (4.0 * PI * jet->weight);
    for (int d = 0; d < 2; d++) {
        double along = growth[d] * f + size * df * image[1] * direction[d] / length;
        for (int c = 0; c < 3; c++)
            slope[d][c] += scale * along * image[c];
        slope[d][1] += scale * size * f * direction[d];
    }
}

static void triangle_nodes(const struct triangle *triangle, const struct element *element,
                           const struct expansion *expansion, const struct jet *jet,
                           const double at[2], double strength, int order,
                           const struct gauss *gauss, struct nodes *nodes, double correction[3],
                           double slope[2][3])
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
        double tau = triangle->height * sinh(mu); /* from the foot, where rounding would show */
        double w = step * weight[k % order] * triangle->height * cosh(mu) * triangle->area;
        double direction[2], image[3];
        struct ray ray;
        for (int d = 0; d < 2; d++)
            direction[d] = triangle->foot_ray[d] + tau * triangle->edge[d];
        restrict_to(expansion, direction, &ray);
        ray_nodes(element, &ray, at, direction, order, w, gauss, nodes);
        for (int c = 0; c < 3; c++)
            image[c] = jet->ds[c] * direction[0] + jet->dt[c] * direction[1];
        double square = dot(image, image), length = sqrt(square);
        double factor = -w * strength * (log(length) - inverse) / (4.0 * PI * square * length);
        for (int c = 0; c < 3; c++)
            correction[c] += factor * image[c];
        if (slope)
            add_slope(jet, direction, image, length, w, inverse, slope);
    }
}

void singular_nodes(const struct element *element, double s, double t, int order,
                    const struct gauss *gauss, struct nodes *nodes, double correction[3],
                    double slope[2][3])
{
    struct jet jet;
    struct expansion expansion;
    double area[3], at[2] = {s, t};
    element_jet(element, s, t, &jet);
    expand(element, s, t, jet.s, &expansion);
    double strength = jet_area(&jet, 1.0, area) / jet.weight;
    const double corner[5][2] = {
        {-s, -t}, {1.0 - s, -t}, {1.0 - s, 1.0 - t}, {-s, 1.0 - t}, {-s, -t}};
    correction[0] = correction[1] = correction[2] = 0.0;
    for (int c = 0; slope && c < 3; c++)
        slope[0][c] = slope[1][c] = 0.0;
    for (int k = 0; k < 4; k++) {
        struct triangle triangle;
        if (make_triangle(&jet, corner[k], corner[k + 1], &triangle))
            triangle_nodes(&triangle, element, &expansion, &jet, at, strength, order, gauss, nodes,
                           correction, slope);
    }
}
