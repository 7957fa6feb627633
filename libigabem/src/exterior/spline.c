#include "exterior/spline.h"

#include <math.h>
#include <stdlib.h>

enum { SIDE = SPLINE_SIDE };

const double spline_along[3][SPLINE_STENCIL] = {{0.0, 0.125, 0.75, 0.125, 0.0},
                                                {1.0 / 48, -13.0 / 24, 0.0, 13.0 / 24, -1.0 / 48},
                                                {1.0 / 24, 5.0 / 6, -1.75, 5.0 / 6, 1.0 / 24}};
const double spline_last[3][SPLINE_STENCIL] = {
    {0.0, 0.125, 0.75, 0.125, 0.0}, {0.0, -0.5, 0.0, 0.5, 0.0}, {0.0, 1.0, -2.0, 1.0, 0.0}};

const double spline_quadratic[SIDE * SIDE] = {1.0 / 2, 1.0 / 6, 0.0, 0.0, 1.0 / 2, 5.0 / 6,
                                              5.0 / 6, 1.0 / 2, 0.0, 0.0, 1.0 / 6, 1.0 / 2,
                                              0.0,     0.0,     0.0, 0.0};

void spline_evaluate(double s, double value[3], double derivative[3])
{
    double r = 1.0 - s;
    value[0] = 0.5 * r * r;
    value[1] = 0.5 + s * r;
    value[2] = 0.5 * s * s;
    derivative[0] = -r;
    derivative[1] = 1.0 - 2.0 * s;
    derivative[2] = s;
}

void spline_fold(size_t n, double *factor, size_t step, double *scratch)
{
    double *c = factor, *x = factor + step, *ratio = scratch;
    c[step] += 2.0 * c[0];
    c[2 * step] -= c[0];
    c[n * step] += 2.0 * c[(n + 1) * step];
    c[(n - 1) * step] -= c[(n + 1) * step];
    /* Thomas' algorithm for the transposed matrix; the end values are their coefficients. */
    for (size_t k = 0; k < n; k++) {
        double diagonal = k == 0 || k == n - 1 ? 1.0 : 0.75;
        double below = k > 1 ? 0.125 : 0.0, above = k + 2 < n ? 0.125 : 0.0;
        double pivot = diagonal - (k ? below * ratio[k - 1] : 0.0);
        ratio[k] = above / pivot;
        x[k * step] = (x[k * step] - (k ? below * x[(k - 1) * step] : 0.0)) / pivot;
    }
    for (size_t k = n - 1; k-- > 0;)
        x[k * step] -= ratio[k] * x[(k + 1) * step];
}

void spline_interpolate(size_t n, double *value, size_t step, double *scratch)
{
    double *c = value, *x = value + step, *ratio = scratch;
    for (size_t k = 0; k < n; k++) {
        bool end = k == 0 || k == n - 1;
        double diagonal = end ? 1.0 : 0.75, side = end ? 0.0 : 0.125;
        double pivot = diagonal - (k ? side * ratio[k - 1] : 0.0);
        ratio[k] = side / pivot;
        x[k * step] = (x[k * step] - (k ? side * x[(k - 1) * step] : 0.0)) / pivot;
    }
    for (size_t k = n - 1; k-- > 0;)
        x[k * step] -= ratio[k] * x[(k + 1) * step];
    c[0] = 2.0 * c[step] - c[2 * step];
    c[(n + 1) * step] = 2.0 * c[n * step] - c[(n - 1) * step];
}

struct mesh *spline_mesh(size_t elements)
{
    struct mesh *mesh = calloc(1, sizeof *mesh);
    if (!mesh)
        return NULL;
    *mesh = (struct mesh){.n = elements,
                          .panels = elements,
                          .element = calloc(elements, sizeof *mesh->element),
                          .panel = calloc(elements, sizeof *mesh->panel),
                          .storage = malloc(elements * 4 * SIDE * SIDE * sizeof *mesh->storage),
                          .degree = {SIDE - 1, SIDE - 1},
                          .patch_base = calloc(2, sizeof *mesh->patch_base)};
    if (mesh->element && mesh->panel && mesh->storage && mesh->patch_base)
        return mesh;
    mesh_free(mesh);
    return NULL;
}

/* Bezier points of the cubic through values at 0, 1/3, 2/3, 1. */
static void bezier(const double *value, size_t step, double *out, size_t out_step)
{
    double a = value[0], b = value[step], c = value[2 * step], d = value[3 * step];
    out[0] = a;
    out[out_step] = (-5.0 * a + 18.0 * b - 9.0 * c + 2.0 * d) / 6.0;
    out[2 * out_step] = (2.0 * a - 9.0 * b + 18.0 * c - 5.0 * d) / 6.0;
    out[3 * out_step] = d;
}

const double *spline_net(struct mesh *mesh, size_t element, const double *point)
{
    double *net = mesh->storage + 4 * SIDE * SIDE * element, half[SIDE * SIDE];
    for (size_t c = 0; c < 3; c++) {
        for (size_t a = 0; a < SIDE; a++)
            bezier(point + 3 * a * SIDE + c, 3, half + a * SIDE, 1);
        for (size_t b = 0; b < SIDE; b++)
            bezier(half + b, SIDE, net + 4 * b + c, 4 * SIDE);
    }
    for (size_t k = 0; k < SIDE * SIDE; k++)
        net[4 * k + 3] = 1.0;
    return net;
}

void spline_panel(struct mesh *mesh, size_t index)
{
    struct element *element = &mesh->element[index];
    for (size_t c = 0; c < 3; c++) {
        element->box[0][c] = INFINITY;
        element->box[1][c] = -INFINITY;
        for (size_t k = 0; k < SIDE * SIDE; k++) {
            element->box[0][c] = fmin(element->box[0][c], element->net[4 * k + c]);
            element->box[1][c] = fmax(element->box[1][c], element->net[4 * k + c]);
        }
    }
    mesh->panel[index] = (struct panel){.first = index, .count = 1, .upper = {1.0, 1.0}};
}

void spline_hull_basis(const struct mesh *hull, size_t patch, const double uv[2], double *row)
{
    size_t e = hull->patch_base[patch], end = hull->patch_base[patch + 1];
    const struct element *element = &hull->element[e];
    while (++e < end && (uv[0] < element->lower[0] || uv[0] > element->upper[0] ||
                         uv[1] < element->lower[1] || uv[1] > element->upper[1]))
        element = &hull->element[e];
    double local[2], bu[ELEMENT_SIDE], bv[ELEMENT_SIDE], value[ELEMENT_FUNCTIONS];
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    for (int d = 0; d < 2; d++)
        local[d] = (uv[d] - element->lower[d]) / (element->upper[d] - element->lower[d]);
    struct jet jet;
    element_jet(element, local[0], local[1], &jet);
    bernstein(element->degree[0], local[0], bu, NULL);
    bernstein(element->degree[1], local[1], bv, NULL);
    for (size_t k = 0; k < m * n; k++)
        value[k] = bu[k / n] * bv[k % n] / jet.weight;
    element_scatter(element, 1, value, row, 0);
}
