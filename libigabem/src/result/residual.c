/* C_w as sums over wave angles and over points of the hull (docs/theory.md, sections 6 and 7). */
#include "core/error.h"
#include "result/radiation.h"

#include <igabem/residual.h>
#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>

enum { PANEL = 8, PANELS = IGABEM_WAVE_RESIDUALS / (2 * PANEL), LINE_SHARE = 2 };

/* Panels grow with the angle, as waves of large t are short but weak. */
static igabem_status wave_angles(double limit, double *t, double *weight)
{
    double node[PANEL], share[PANEL];
    if (nurbs_gauss_legendre(PANEL, node, share) != NURBS_OK)
        return hull_nurbs_fail(NURBS_ERROR_NUMERIC, "wave angles");
    for (int p = 0; p < PANELS; p++) {
        double from = limit * p * p / (PANELS * PANELS);
        double to = limit * (p + 1) * (p + 1) / (PANELS * PANELS);
        for (int k = 0; k < PANEL; k++) {
            t[p * PANEL + k] = from + (to - from) * node[k];
            weight[p * PANEL + k] = (to - from) * share[k];
        }
    }
    return IGABEM_OK;
}

igabem_status igabem_wave_residuals(const igabem_solution *solution, double *r)
{
    enum { ANGLES = PANEL * PANELS };
    double t[ANGLES], weight[ANGLES], h[ANGLES][2], density[ANGLES];
    if (!solution || !r)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_wave_residuals");
    if (!solution->density->symmetric)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "wave residuals of a hull given whole, expected a half");
    igabem_status status = wave_angles(radiation_limit(solution), t, weight);
    if (!status)
        status = igabem_kochin(solution, ANGLES, t, h, density);
    for (size_t k = 0; k < ANGLES && !status; k++) {
        double square = h[k][0] * h[k][0] + h[k][1] * h[k][1];
        double scale = square > 0 ? sqrt(2.0 * weight[k] * density[k] / square) : 0.0;
        r[2 * k] = scale * h[k][0];
        r[2 * k + 1] = scale * h[k][1];
    }
    return status;
}

static bool in_waterline(const struct density_patch *patch, int edge)
{
    return patch->hull.edge[edge] == HULL_EDGE_WATERLINE;
}

static size_t line_samples(int edge, size_t n_u, size_t n_v)
{
    return LINE_SHARE * (edge == HULL_U0 || edge == HULL_U1 ? n_v : n_u);
}

static size_t count_samples(const struct density *density, size_t n_u, size_t n_v)
{
    size_t n = 0;
    for (size_t p = 0; p < density->patches; p++) {
        n += n_u * n_v;
        for (int e = 0; e < HULL_EDGES; e++)
            n += in_waterline(&density->patch[p], e) ? line_samples(e, n_u, n_v) : 0;
    }
    return n;
}

/* Parameters of the samples of a patch: the hull's first, then those of its waterlines. */
static void place(const struct density_patch *patch, size_t n_u, size_t n_v, double (*uv)[2])
{
    const double(*domain)[2] = patch->hull.domain;
    for (size_t i = 0; i < n_u; i++)
        for (size_t j = 0; j < n_v; j++, uv++) {
            (*uv)[0] =
                domain[0][0] + (domain[0][1] - domain[0][0]) * ((double)i + 0.5) / (double)n_u;
            (*uv)[1] =
                domain[1][0] + (domain[1][1] - domain[1][0]) * ((double)j + 0.5) / (double)n_v;
        }
    for (int e = 0; e < HULL_EDGES; e++) {
        size_t n = in_waterline(patch, e) ? line_samples(e, n_u, n_v) : 0;
        for (size_t k = 0; k < n; k++, uv++)
            hull_edge_parameters(&patch->hull, e, ((double)k + 0.5) / (double)n, *uv);
    }
}

/* What a sample of each kind counts for. */
struct scale {
    double area, rise;
};

static void fill(const struct density_patch *patch, size_t n_u, size_t n_v, const double *jet,
                 const double *velocity, double speed, struct scale scale,
                 igabem_pressure_sample *sample)
{
    const double(*domain)[2] = patch->hull.domain;
    double part =
        (domain[0][1] - domain[0][0]) * (domain[1][1] - domain[1][0]) / ((double)n_u * (double)n_v);
    size_t at = 0;
    for (; at < n_u * n_v; at++) {
        double normal[3], area;
        hull_normal(&patch->hull, jet + 9 * at, normal, &area);
        sample[at] = (igabem_pressure_sample){.area = scale.area * normal[0] * area * part};
    }
    for (int e = 0; e < HULL_EDGES; e++) {
        size_t n = in_waterline(patch, e) ? line_samples(e, n_u, n_v) : 0;
        for (size_t k = 0; k < n; k++, at++) {
            double nu[2], dl;
            hull_waterline_normal(&patch->hull, e, jet + 9 * at, nu, &dl);
            sample[at] = (igabem_pressure_sample){.rise = scale.rise * nu[0] * dl / (double)n};
        }
    }
    for (size_t k = 0; k < at; k++)
        for (size_t c = 0; c < 3; c++)
            sample[k].v[c] = velocity[3 * k + c] / speed;
}

static igabem_status sample_patch(const igabem_solution *solution, size_t p, size_t n_u, size_t n_v,
                                  size_t n, igabem_pressure_sample *sample)
{
    const struct density_patch *patch = &solution->density->patch[p];
    double speed = solution->speed, area = solution->info.hydrostatics.wetted_area;
    double sides = solution->density->symmetric ? 2.0 : 1.0;
    const struct scale scale = {2.0 * sides / area,
                                2.0 * sides * speed * speed / (solution->options.gravity * area)};
    double(*uv)[2] = malloc(n * 14 * sizeof(double));
    if (!uv)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu samples of the pressure", n);
    double *velocity = uv[n], *jet = velocity + 3 * n;
    place(patch, n_u, n_v, uv);
    igabem_status status = igabem_surface_velocity(solution, p, n, uv[0], velocity, NULL);
    if (!status && nurbs_surface_eval(patch->surface, 1, n, uv[0], jet) != NURBS_OK)
        status = hull_nurbs_fail(NURBS_ERROR_NUMERIC, "samples of the pressure");
    if (!status)
        fill(patch, n_u, n_v, jet, velocity, speed, scale, sample);
    free(uv);
    return status;
}

igabem_status igabem_pressure_samples(const igabem_solution *solution, size_t n_u, size_t n_v,
                                      size_t *n, igabem_pressure_sample **sample)
{
    enum { MOST = 1000 };
    if (!solution || !n)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_pressure_samples");
    if (n_u < 1 || n_v < 1 || n_u > MOST || n_v > MOST)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "%zu x %zu samples of the pressure, expected 1 to %d a direction", n_u,
                           n_v, MOST);
    const struct density *density = solution->density;
    *n = count_samples(density, n_u, n_v);
    if (!sample)
        return IGABEM_OK;
    igabem_pressure_sample *all = malloc(*n * sizeof *all);
    igabem_status status = IGABEM_OK;
    if (!all)
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu samples of the pressure", *n);
    for (size_t p = 0, at = 0; p < density->patches && !status; p++) {
        size_t count = n_u * n_v;
        for (int e = 0; e < HULL_EDGES; e++)
            count += in_waterline(&density->patch[p], e) ? line_samples(e, n_u, n_v) : 0;
        status = sample_patch(solution, p, n_u, n_v, count, all + at);
        at += count;
    }
    if (status) {
        free(all);
        all = NULL;
    }
    *sample = all;
    return status;
}

double igabem_pressure_sum(size_t n, const igabem_pressure_sample *sample,
                           igabem_pressure_sample *gradient)
{
    double sum = 0.0;
    if (n && !sample)
        return NAN;
    for (size_t k = 0; k < n; k++) {
        const double *v = sample[k].v;
        double pressure = v[0] - 0.5 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        double rise = 0.5 * v[0] * v[0];
        sum += pressure * sample[k].area + rise * sample[k].rise;
        if (gradient)
            gradient[k] = (igabem_pressure_sample){
                .v = {(1.0 - v[0]) * sample[k].area + v[0] * sample[k].rise, -v[1] * sample[k].area,
                      -v[2] * sample[k].area},
                .area = pressure,
                .rise = rise};
    }
    return sum;
}
