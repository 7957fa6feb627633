#include "integrals/quadrature.h"

#include "core/error.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rows evaluated together: enough to share the work per column, few enough for the cache. */
#define ROWS ((size_t)16)

size_t patch_spans(const nurbs_surface *surface, int direction)
{
    const double *t = nurbs_surface_knots(surface, direction);
    size_t spans = 0;
    for (size_t k = (size_t)nurbs_surface_degree(surface, direction);
         k < nurbs_surface_size(surface, direction); k++)
        spans += t[k + 1] > t[k];
    return spans;
}

/* Nodes and weights of all spans of a direction one after the other. */
static void composite_rule(const nurbs_surface *surface, int direction, size_t order,
                           const double *nodes, const double *weights, double *t, double *w)
{
    const double *knots = nurbs_surface_knots(surface, direction);
    size_t at = 0;
    for (size_t k = (size_t)nurbs_surface_degree(surface, direction);
         k < nurbs_surface_size(surface, direction); k++) {
        double length = knots[k + 1] - knots[k];
        for (size_t g = 0; g < order && length > 0; g++, at++) {
            t[at] = knots[k] + length * nodes[g];
            w[at] = length * weights[g];
        }
    }
}

static void add_point(const double *s, double weight, double level, patch_sums *sums)
{
    const double *p = s, *a = s + 3, *b = s + 6;
    double n[3] = {weight * (a[1] * b[2] - a[2] * b[1]), weight * (a[2] * b[0] - a[0] * b[2]),
                   weight * (a[0] * b[1] - a[1] * b[0])};
    double flux = p[1] * n[1];
    sums->area += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int c = 0; c < 3; c++) {
        sums->normal[c] += n[c];
        sums->low[c] = fmin(sums->low[c], p[c]);
        sums->high[c] = fmax(sums->high[c], p[c]);
    }
    sums->y_ny += flux;
    sums->x_y_ny += p[0] * flux;
    sums->y_y_ny += p[1] * flux;
    sums->z_y_ny += p[2] * flux;
    sums->depth_nz += (level - p[2]) * n[2];
}

/* Sums a row of points first, then rows: rounding stays far below the quadrature error. */
static void add_sums(const patch_sums *row, patch_sums *sums)
{
    sums->area += row->area;
    for (int c = 0; c < 3; c++) {
        sums->normal[c] += row->normal[c];
        sums->low[c] = fmin(sums->low[c], row->low[c]);
        sums->high[c] = fmax(sums->high[c], row->high[c]);
    }
    sums->y_ny += row->y_ny;
    sums->x_y_ny += row->x_y_ny;
    sums->y_y_ny += row->y_y_ny;
    sums->z_y_ny += row->z_y_ny;
    sums->depth_nz += row->depth_nz;
}

nurbs_status patch_visit(const nurbs_surface *surface, size_t order, patch_row *row, void *context)
{
    size_t nu = order * patch_spans(surface, 0), nv = order * patch_spans(surface, 1);
    double nodes[64], weights[64];
    nurbs_status status = nurbs_gauss_legendre(order, nodes, weights);
    if (status != NURBS_OK)
        return status;
    double *u = malloc((2 * nu + 2 * nv + 9 * ROWS * nv) * sizeof *u);
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu quadrature points", nv);
    double *wu = u + nu, *v = wu + nu, *wv = v + nv, *block = wv + nv;
    composite_rule(surface, 0, order, nodes, weights, u, wu);
    composite_rule(surface, 1, order, nodes, weights, v, wv);
    for (size_t first = 0; first < nu && status == NURBS_OK; first += ROWS) {
        size_t rows = nu - first < ROWS ? nu - first : ROWS;
        status = nurbs_surface_eval_grid(surface, 1, rows, u + first, nv, v, block);
        for (size_t i = 0; i < rows && status == NURBS_OK; i++)
            row(context, nv, block + 9 * i * nv, wu[first + i], wv);
    }
    free(u);
    return status;
}

struct sums_at_level {
    double level;
    patch_sums *sums;
};

static void sum_row(void *context, size_t n, const double *triples, double wu, const double *wv)
{
    const struct sums_at_level *at = context;
    patch_sums line = no_sums;
    for (size_t j = 0; j < n; j++)
        add_point(triples + 9 * j, wu * wv[j], at->level, &line);
    add_sums(&line, at->sums);
}

nurbs_status patch_integrate(const nurbs_surface *surface, double level, size_t order,
                             patch_sums *sums)
{
    *sums = no_sums;
    struct sums_at_level at = {level, sums};
    return patch_visit(surface, order, sum_row, &at);
}

nurbs_status nurbs_surface_area(const nurbs_surface *surface, double *area, double *error)
{
    NURBS_NEED(surface && area);
    patch_sums coarse, fine;
    size_t order = 4;
    double relative;
    do {
        nurbs_status status = patch_integrate(surface, 0, order, &coarse);
        if (status == NURBS_OK)
            status = patch_integrate(surface, 0, order + 3, &fine);
        if (status != NURBS_OK)
            return status;
        relative = fine.area > 0 ? fabs(fine.area - coarse.area) / fine.area : 0;
        order *= 2;
    } while (relative > 1e-12 && order <= 32 &&
             order * order * patch_spans(surface, 0) * patch_spans(surface, 1) < 1000000);
    *area = fine.area;
    if (error)
        *error = relative;
    return NURBS_OK;
}
