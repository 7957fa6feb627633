/* Moments of one patch and their derivatives with respect to its control points. */
#include "error.h"
#include "hydro_parts.h"
#include <nurbs/basis.h>

#include <stdlib.h>
#include <string.h>

enum { MAX_FUNCTIONS = (NURBS_MAX_DEGREE + 1) * (NURBS_MAX_DEGREE + 1), RATIONAL_ORDER = 20 };

/* Point, tangents and normal at a quadrature point. */
typedef struct place {
    double p[3], a[3], b[3], n[3], length;
} place;

static void find_place(const double *s, place *at)
{
    memcpy(at->p, s, sizeof at->p);
    memcpy(at->a, s + 3, sizeof at->a);
    memcpy(at->b, s + 6, sizeof at->b);
    const double *a = at->a, *b = at->b;
    at->n[0] = a[1] * b[2] - a[2] * b[1];
    at->n[1] = a[2] * b[0] - a[0] * b[2];
    at->n[2] = a[0] * b[1] - a[1] * b[0];
    at->length = sqrt(at->n[0] * at->n[0] + at->n[1] * at->n[1] + at->n[2] * at->n[2]);
}

static void add_values(const place *at, double weight, nurbs_moments *moments)
{
    double flux = weight * at->p[1] * at->n[1];
    moments->area += weight * at->length;
    moments->volume += flux;
    moments->moment[0] += at->p[0] * flux;
    moments->moment[1] += 0.5 * at->p[1] * flux;
    moments->moment[2] += at->p[2] * flux;
}

/* Adds the derivatives for the control point with basis function r and derivatives ru, rv.
 * Moving it by e_c changes the tangents by ru e_c and rv e_c, so the normal by
 * e_c x (ru b - rv a). g[m] is the row of moment m at this control point. */
static void add_derivatives(const place *at, double weight, double r, double ru, double rv,
                            double *const g[5])
{
    double t[3];
    for (int c = 0; c < 3; c++)
        t[c] = ru * at->b[c] - rv * at->a[c];
    const double x = at->p[0], y = at->p[1], z = at->p[2], ny = at->n[1];
    /* Component y of e_x x t, e_y x t, e_z x t. */
    const double dny[3] = {-t[2], 0, t[0]};
    for (int c = 0; c < 3 && at->length > 0; c++) {
        int d = (c + 1) % 3, e = (c + 2) % 3; /* (e_c x t)_d = -t_e, (e_c x t)_e = t_d */
        g[0][c] += weight * (at->n[e] * t[d] - at->n[d] * t[e]) / at->length;
    }
    for (int c = 0; c < 3; c++) {
        double dflux = y * dny[c] + (c == 1 ? r * ny : 0);
        g[1][c] += weight * dflux;
        g[2][c] += weight * (x * dflux + (c == 0 ? r * y * ny : 0));
        g[3][c] += weight * 0.5 * (y * dflux + (c == 1 ? r * y * ny : 0));
        g[4][c] += weight * (z * dflux + (c == 2 ? r * y * ny : 0));
    }
}

typedef struct sums {
    const nurbs_surface *surface;
    size_t order[2], nv, count; /* order: degree + 1; count: control points */
    nurbs_moments *moments;
    double *gradient, *basis;
} sums;

static nurbs_status add_point(sums *work, double u, double v, double weight)
{
    double s[9], uv[2] = {u, v};
    size_t span[2], functions = work->order[0] * work->order[1];
    place at;
    nurbs_status status = nurbs_surface_eval(work->surface, 1, 1, uv, s);
    if (status != NURBS_OK)
        return status;
    find_place(s, &at);
    add_values(&at, weight, work->moments);
    if (!work->gradient)
        return NURBS_OK;
    status = nurbs_surface_basis(work->surface, 1, u, v, span, work->basis);
    for (size_t k = 0; k < functions && status == NURBS_OK; k++) {
        size_t i = span[0] + 1 - work->order[0] + k / work->order[1],
               j = span[1] + 1 - work->order[1] + k % work->order[1];
        double *g[5];
        for (size_t m = 0; m < 5; m++)
            g[m] = work->gradient + 3 * (m * work->count + i * work->nv + j);
        add_derivatives(&at, weight, work->basis[k], work->basis[functions + k],
                        work->basis[2 * functions + k], g);
    }
    return status;
}

nurbs_status nurbs_surface_moments(const nurbs_surface *surface, nurbs_moments *moments,
                                   double *gradient)
{
    const double *t[2] = {nurbs_surface_knots(surface, 0), nurbs_surface_knots(surface, 1)};
    const size_t size[2] = {nurbs_surface_size(surface, 0), nurbs_surface_size(surface, 1)};
    int degree[2] = {nurbs_surface_degree(surface, 0), nurbs_surface_degree(surface, 1)};
    int largest = degree[0] > degree[1] ? degree[0] : degree[1];
    double nodes[64], weights[64];
    /* Exact for moments of polynomial patches: four factors of the degree. */
    size_t rule = nurbs_surface_weights(surface) ? RATIONAL_ORDER : 2 * (size_t)largest + 1;
    nurbs_status status = nurbs_gauss_legendre(rule, nodes, weights);
    sums work = {.surface = surface,
                 .order = {(size_t)degree[0] + 1, (size_t)degree[1] + 1},
                 .nv = size[1],
                 .count = size[0] * size[1],
                 .moments = moments,
                 .gradient = gradient,
                 .basis = malloc(3 * MAX_FUNCTIONS * sizeof(double))};
    *moments = (nurbs_moments){0};
    if (!work.basis)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for basis functions");
    if (gradient)
        memset(gradient, 0, 15 * work.count * sizeof *gradient);
    for (size_t i = work.order[0] - 1; i < size[0]; i++)
        for (size_t j = work.order[1] - 1; j < size[1]; j++) {
            double du = t[0][i + 1] - t[0][i], dv = t[1][j + 1] - t[1][j];
            for (size_t k = 0; k < rule * rule && du * dv > 0 && status == NURBS_OK; k++)
                status =
                    add_point(&work, t[0][i] + du * nodes[k / rule], t[1][j] + dv * nodes[k % rule],
                              du * dv * weights[k / rule] * weights[k % rule]);
        }
    free(work.basis);
    return status;
}
