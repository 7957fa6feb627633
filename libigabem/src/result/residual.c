/* C_w as sums over wave angles and over points of the hull (docs/theory.md, sections 6 and 7). */
#include "result/residual.h"

#include "core/error.h"
#include "result/kochin.h"
#include "result/radiation.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>

enum { PANEL = 8, PANELS = RESIDUAL_ANGLES / PANEL, LINE_SHARE = 2 };

/* Panels grow with the angle, as waves of large t are short but weak. */
igabem_status residual_angles(const igabem_solution *solution, double t[RESIDUAL_ANGLES],
                              double scale[RESIDUAL_ANGLES])
{
    double node[PANEL], share[PANEL], limit = radiation_limit(solution);
    if (nurbs_gauss_legendre(PANEL, node, share) != NURBS_OK)
        return hull_nurbs_fail(NURBS_ERROR_NUMERIC, "wave angles");
    for (int p = 0; p < PANELS; p++) {
        double from = limit * p * p / (PANELS * PANELS);
        double to = limit * (p + 1) * (p + 1) / (PANELS * PANELS);
        for (int k = 0; k < PANEL; k++) {
            double angle = from + (to - from) * node[k], weight = (to - from) * share[k];
            t[p * PANEL + k] = angle;
            scale[p * PANEL + k] =
                sqrt(2.0 * weight * kochin_coefficient(solution) * sqrt(1.0 + angle * angle));
        }
    }
    return IGABEM_OK;
}

igabem_status igabem_wave_residuals(const igabem_solution *solution, double *r)
{
    double t[RESIDUAL_ANGLES], scale[RESIDUAL_ANGLES], h[RESIDUAL_ANGLES][2];
    if (!solution || !r)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_wave_residuals");
    if (!solution->density->symmetric)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "wave residuals of a hull given whole, expected a half");
    igabem_status status = residual_angles(solution, t, scale);
    if (!status)
        status = igabem_kochin(solution, RESIDUAL_ANGLES, t, h, NULL);
    for (size_t k = 0; k < RESIDUAL_ANGLES && !status; k++) {
        r[2 * k] = scale[k] * h[k][0];
        r[2 * k + 1] = scale[k] * h[k][1];
    }
    return status;
}

static size_t line_samples(const struct density_patch *patch, int edge, size_t n_u, size_t n_v)
{
    if (patch->hull.edge[edge] != HULL_EDGE_WATERLINE)
        return 0;
    return LINE_SHARE * (edge == HULL_U0 || edge == HULL_U1 ? n_v : n_u);
}

size_t samples_of_patch(const struct density_patch *patch, size_t n_u, size_t n_v)
{
    size_t n = n_u * n_v;
    for (int e = 0; e < HULL_EDGES; e++)
        n += line_samples(patch, e, n_u, n_v);
    return n;
}

int samples_edge(const struct density_patch *patch, size_t n_u, size_t n_v, size_t at,
                 double *share)
{
    size_t end = n_u * n_v;
    for (int e = 0; at >= end && e < HULL_EDGES; e++) {
        size_t n = line_samples(patch, e, n_u, n_v);
        end += n;
        *share = 1.0 / (double)n;
        if (at < end)
            return e;
    }
    return -1;
}

/* Those of the hull first, then those of the waterlines. */
void samples_place(const struct density_patch *patch, size_t n_u, size_t n_v, double (*uv)[2])
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
        size_t n = line_samples(patch, e, n_u, n_v);
        for (size_t k = 0; k < n; k++, uv++)
            hull_edge_parameters(&patch->hull, e, ((double)k + 0.5) / (double)n, *uv);
    }
}

struct sample_scale samples_scale(const igabem_solution *solution)
{
    double speed = solution->speed, area = solution->info.hydrostatics.wetted_area;
    double sides = solution->density->symmetric ? 2.0 : 1.0;
    return (struct sample_scale){2.0 * sides / area,
                                 2.0 * sides * speed * speed / (solution->options.gravity * area)};
}

void samples_measure(const struct density_patch *patch, size_t n_u, size_t n_v, const double *jet,
                     struct sample_scale scale, igabem_pressure_sample *sample)
{
    const double(*domain)[2] = patch->hull.domain;
    double part =
        (domain[0][1] - domain[0][0]) * (domain[1][1] - domain[1][0]) / ((double)n_u * (double)n_v);
    size_t n = samples_of_patch(patch, n_u, n_v);
    for (size_t at = 0; at < n; at++) {
        double share = 0.0, normal[3], area, nu[2], dl;
        int edge = samples_edge(patch, n_u, n_v, at, &share);
        sample[at] = (igabem_pressure_sample){.area = 0.0};
        if (edge < 0) {
            hull_normal(&patch->hull, jet + 9 * at, normal, &area);
            sample[at].area = scale.area * normal[0] * area * part;
        } else {
            hull_waterline_normal(&patch->hull, edge, jet + 9 * at, nu, &dl);
            sample[at].rise = scale.rise * nu[0] * dl * share;
        }
    }
}

static igabem_status sample_patch(const igabem_solution *solution, size_t p, size_t n_u, size_t n_v,
                                  size_t n, igabem_pressure_sample *sample)
{
    const struct density_patch *patch = &solution->density->patch[p];
    double(*uv)[2] = malloc(n * 14 * sizeof(double));
    if (!uv)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu samples of the pressure", n);
    double *velocity = uv[n], *jet = velocity + 3 * n;
    samples_place(patch, n_u, n_v, uv);
    igabem_status status = igabem_surface_velocity(solution, p, n, uv[0], velocity, NULL);
    if (!status && nurbs_surface_eval(patch->surface, 1, n, uv[0], jet) != NURBS_OK)
        status = hull_nurbs_fail(NURBS_ERROR_NUMERIC, "samples of the pressure");
    if (!status)
        samples_measure(patch, n_u, n_v, jet, samples_scale(solution), sample);
    for (size_t k = 0; k < n && !status; k++)
        for (size_t c = 0; c < 3; c++)
            sample[k].v[c] = velocity[3 * k + c] / solution->speed;
    free(uv);
    return status;
}

igabem_status samples_check(size_t n_u, size_t n_v)
{
    enum { MOST = 1000 };
    if (n_u < 1 || n_v < 1 || n_u > MOST || n_v > MOST)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "%zu x %zu samples of the pressure, expected 1 to %d a direction", n_u,
                           n_v, MOST);
    return IGABEM_OK;
}

igabem_status igabem_pressure_samples(const igabem_solution *solution, size_t n_u, size_t n_v,
                                      size_t *n, igabem_pressure_sample **sample)
{
    if (!solution || !n)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_pressure_samples");
    igabem_status status = samples_check(n_u, n_v);
    if (status)
        return status;
    const struct density *density = solution->density;
    *n = 0;
    for (size_t p = 0; p < density->patches; p++)
        *n += samples_of_patch(&density->patch[p], n_u, n_v);
    if (!sample)
        return IGABEM_OK;
    igabem_pressure_sample *all = malloc(*n * sizeof *all);
    if (!all)
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu samples of the pressure", *n);
    for (size_t p = 0, at = 0; p < density->patches && !status; p++) {
        size_t count = samples_of_patch(&density->patch[p], n_u, n_v);
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
