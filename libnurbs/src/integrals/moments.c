/* Moments of one patch and their derivatives with respect to its control points. */
#include "core/error.h"
#include "integrals/quadrature.h"

#include <nurbs/basis.h>

#include <stdlib.h>
#include <string.h>

enum { MAX_FUNCTIONS = (NURBS_MAX_DEGREE + 1) * (NURBS_MAX_DEGREE + 1), RATIONAL_ORDER = 20 };
enum { VOLUMES = NURBS_MOMENTS - 1, MOST_POINTS = 2000000, MOST_ORDER = 64 };

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

/* Densities g of the volume integrals int g n_y dS, in the order of nurbs_moments behind the area:
 * dg/dy is 1, x, y, z, xx, yy, zz, xy, yz, zx. */
static void densities(const double p[3], double g[VOLUMES])
{
    const double x = p[0], y = p[1], z = p[2];
    const double all[VOLUMES] = {
        y,         x * y,         y * y / 2,     z * y,    x * x * y, y * y * y / 3,
        z * z * y, x * y * y / 2, y * y * z / 2, x * y * z};
    memcpy(g, all, sizeof all);
}

/* Their derivatives with respect to x, y and z. */
static void density_slopes(const double p[3], double g[VOLUMES][3])
{
    const double x = p[0], y = p[1], z = p[2];
    const double all[VOLUMES][3] = {{0, 1, 0},
                                    {y, x, 0},
                                    {0, y, 0},
                                    {0, z, y},
                                    {2 * x * y, x * x, 0},
                                    {0, y * y, 0},
                                    {0, z * z, 2 * y * z},
                                    {y * y / 2, x * y, 0},
                                    {0, y * z, y * y / 2},
                                    {y * z, x * z, x * y}};
    memcpy(g, all, sizeof all);
}

static void add_values(const place *at, double weight, double sums[NURBS_MOMENTS])
{
    double g[VOLUMES];
    densities(at->p, g);
    sums[0] += weight * at->length;
    for (int m = 0; m < VOLUMES; m++)
        sums[1 + m] += weight * at->n[1] * g[m];
}

static void store(const double sums[NURBS_MOMENTS], nurbs_moments *moments)
{
    moments->area = sums[0];
    moments->volume = sums[1];
    memcpy(moments->moment, sums + 2, sizeof moments->moment);
    memcpy(moments->second, sums + 5, sizeof moments->second);
}

/* Adds the derivatives for the control point with basis function r and derivatives ru, rv.
 * Moving it by e_c changes the tangents by ru e_c and rv e_c, so the normal by
 * e_c x (ru b - rv a). `row` is that of the area at this control point, the next one `stride`
 * further. */
static void add_derivatives(const place *at, double weight, double r, double ru, double rv,
                            size_t stride, double *row)
{
    double t[3], g[VOLUMES], slope[VOLUMES][3];
    for (int c = 0; c < 3; c++)
        t[c] = ru * at->b[c] - rv * at->a[c];
    /* Component y of e_x x t, e_y x t, e_z x t. */
    const double dny[3] = {-t[2], 0, t[0]};
    for (int c = 0; c < 3 && at->length > 0; c++) {
        int d = (c + 1) % 3, e = (c + 2) % 3; /* (e_c x t)_d = -t_e, (e_c x t)_e = t_d */
        row[c] += weight * (at->n[e] * t[d] - at->n[d] * t[e]) / at->length;
    }
    densities(at->p, g);
    density_slopes(at->p, slope);
    for (int m = 0; m < VOLUMES; m++) {
        row += stride;
        for (int c = 0; c < 3; c++)
            row[c] += weight * (g[m] * dny[c] + slope[m][c] * r * at->n[1]);
    }
}

typedef struct sums {
    const nurbs_surface *surface;
    size_t order[2], nv, count; /* order: degree + 1; count: control points */
    double values[NURBS_MOMENTS], *gradient, *basis;
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
    add_values(&at, weight, work->values);
    if (!work->gradient)
        return NURBS_OK;
    status = nurbs_surface_basis(work->surface, 1, u, v, span, work->basis);
    for (size_t k = 0; k < functions && status == NURBS_OK; k++) {
        size_t i = span[0] + 1 - work->order[0] + k / work->order[1],
               j = span[1] + 1 - work->order[1] + k % work->order[1];
        add_derivatives(&at, weight, work->basis[k], work->basis[functions + k],
                        work->basis[2 * functions + k], 3 * work->count,
                        work->gradient + 3 * (i * work->nv + j));
    }
    return status;
}

nurbs_status nurbs_surface_moments(const nurbs_surface *surface, nurbs_moments *moments,
                                   double *gradient)
{
    NURBS_NEED(surface && moments);
    const double *t[2] = {nurbs_surface_knots(surface, 0), nurbs_surface_knots(surface, 1)};
    const size_t size[2] = {nurbs_surface_size(surface, 0), nurbs_surface_size(surface, 1)};
    int degree[2] = {nurbs_surface_degree(surface, 0), nurbs_surface_degree(surface, 1)};
    int largest = degree[0] > degree[1] ? degree[0] : degree[1];
    double nodes[64], weights[64];
    /* Exact for second moments of polynomial patches, of degree 5 p - 1. */
    size_t rule = nurbs_surface_weights(surface) ? RATIONAL_ORDER : (5 * (size_t)largest + 1) / 2;
    nurbs_status status = nurbs_gauss_legendre(rule, nodes, weights);
    sums work = {.surface = surface,
                 .order = {(size_t)degree[0] + 1, (size_t)degree[1] + 1},
                 .nv = size[1],
                 .count = size[0] * size[1],
                 .gradient = gradient,
                 .basis = malloc(3 * MAX_FUNCTIONS * sizeof(double))};
    *moments = (nurbs_moments){0};
    if (!work.basis)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for basis functions");
    if (gradient)
        memset(gradient, 0, 3 * NURBS_MOMENTS * work.count * sizeof *gradient);
    for (size_t i = work.order[0] - 1; i < size[0]; i++)
        for (size_t j = work.order[1] - 1; j < size[1]; j++) {
            double du = t[0][i + 1] - t[0][i], dv = t[1][j + 1] - t[1][j];
            for (size_t k = 0; k < rule * rule && du * dv > 0 && status == NURBS_OK; k++)
                status =
                    add_point(&work, t[0][i] + du * nodes[k / rule], t[1][j] + dv * nodes[k % rule],
                              du * dv * weights[k / rule] * weights[k % rule]);
        }
    store(work.values, moments);
    free(work.basis);
    return status;
}

/* Sums, and those of the magnitudes for the rounding error. */
typedef struct moment_sums {
    double value[NURBS_MOMENTS], magnitude[NURBS_MOMENTS];
} moment_sums;

static void sum_row(void *context, size_t n, const double *triples, double wu, const double *wv)
{
    moment_sums *all = context;
    double row[NURBS_MOMENTS] = {0};
    for (size_t j = 0; j < n; j++) {
        place at;
        find_place(triples + 9 * j, &at);
        add_values(&at, wv[j], row);
    }
    for (int m = 0; m < NURBS_MOMENTS; m++) {
        all->value[m] += wu * row[m];
        all->magnitude[m] += fabs(wu * row[m]);
    }
}

/* What may be left after doubling changed a sum by `before` and then by `last`. Where convergence
 * is fast this is far above the error; where the integrand is not smooth (area about a crease), the
 * error falls like a power of the order and wavers, and `last` alone may be small by accident. */
static double remainder_of(double before, double last)
{
    return last + sqrt(before * last);
}

/* Twice the order, twice at least, until nothing changes. */
static nurbs_status add_patch(const nurbs_surface *surface, moment_sums *total,
                              double error[NURBS_MOMENTS])
{
    const size_t spans = patch_spans(surface, 0) * patch_spans(surface, 1);
    moment_sums sums_at[3] = {{{0}, {0}}};
    size_t order = 2;
    nurbs_status status = NURBS_OK;
    for (int level = 0, settled = 0; status == NURBS_OK && !settled; level++, order *= 2) {
        moment_sums *fine = &sums_at[level % 3];
        const moment_sums *coarse = &sums_at[(level + 2) % 3], *older = &sums_at[(level + 1) % 3];
        *fine = (moment_sums){{0}, {0}};
        status = patch_visit(surface, order, sum_row, fine);
        settled = level >= 2;
        for (int m = 0; m < NURBS_MOMENTS; m++)
            settled &= fabs(fine->value[m] - coarse->value[m]) <= 1e-12 * fine->magnitude[m];
        settled |=
            level >= 2 && (2 * order > MOST_ORDER || 4 * order * order * spans > MOST_POINTS);
        for (int m = 0; m < NURBS_MOMENTS && settled; m++) {
            total->value[m] += fine->value[m];
            error[m] += remainder_of(fabs(coarse->value[m] - older->value[m]),
                                     fabs(fine->value[m] - coarse->value[m])) +
                        1e-15 * fine->magnitude[m];
        }
    }
    return status;
}

nurbs_status nurbs_patches_moments(const nurbs_patches *patches, nurbs_moments *moments,
                                   nurbs_moments *error)
{
    NURBS_NEED(patches && moments);
    moment_sums total = {{0}, {0}};
    double errors[NURBS_MOMENTS] = {0};
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < nurbs_patches_count(patches) && status == NURBS_OK; k++)
        status = add_patch(nurbs_patches_get(patches, k), &total, errors);
    if (status != NURBS_OK)
        return status;
    store(total.value, moments);
    if (error)
        store(errors, error);
    return NURBS_OK;
}
