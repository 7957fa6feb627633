/* Derivatives of the results: the chain rule on what the Kochin function, the residuals and the
 * samples of the pressure are made of. */
#include "core/constants.h"
#include "core/error.h"
#include "result/amplitude.h"
#include "result/kochin.h"
#include "result/radiation.h"
#include "result/residual.h"
#include "tangent/potential.h"
#include "tangent/radiate.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t fields_of(const igabem_tangent *tangent)
{
    return tangent->field->n;
}

/* Fills h[m][2] and dh[n][m][2]. */
static igabem_status kochin(const igabem_tangent *tangent, double largest, size_t m,
                            const double *t, double (*h)[2], double (*dh)[2])
{
    size_t n = fields_of(tangent);
    struct radiators *radiators;
    if (tangent->solution->potential)
        return potential_kochin(tangent, largest, m, t, h, dh);
    igabem_status status = radiators_create(tangent, largest, &radiators);
    if (status != IGABEM_OK)
        return status;
    bool failed = false;
#pragma omp parallel reduction(| : failed)
    {
        double(*one)[2] = malloc(ANGLES_AT_ONCE * n * sizeof *one);
        failed |= !one;
#pragma omp for schedule(dynamic, 1)
        for (size_t first = 0; first < m; first += ANGLES_AT_ONCE) {
            size_t count = m - first < ANGLES_AT_ONCE ? m - first : ANGLES_AT_ONCE;
            if (failed)
                continue;
            radiators_sum(radiators, tangent->solution->k0, count, t + first, h + first, one);
            for (size_t i = 0; i < count; i++)
                for (size_t f = 0; f < n; f++)
                    memcpy(dh[f * m + first + i], one[i * n + f], sizeof *one);
        }
        free(one);
    }
    radiators_free(radiators);
    if (failed)
        return tangent_no_memory(n);
    for (size_t k = 0; k < n * m; k++)
        if (!isfinite(dh[k][0]) || !isfinite(dh[k][1]))
            return igabem_fail(IGABEM_ERROR_NUMERIC,
                               "the Kochin function's derivative along field %zu is not finite",
                               k / m);
    return IGABEM_OK;
}

igabem_status igabem_tangent_kochin(const igabem_tangent *tangent, size_t m, const double *t,
                                    double dh[][2])
{
    if (!tangent || (m && (!t || !dh)))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_tangent_kochin");
    THREADS(tangent->solution->options.threads);
    double largest;
    igabem_status status = kochin_check_angles(tangent->solution, m, t, &largest);
    if (status != IGABEM_OK)
        return status;
    double(*h)[2] = malloc((m + 1) * sizeof *h);
    status = h ? kochin(tangent, largest, m, t, h, dh) : tangent_no_memory(fields_of(tangent));
    free(h);
    return status;
}

igabem_status igabem_tangent_residuals(const igabem_tangent *tangent, double *dr)
{
    if (!tangent || !dr)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_tangent_residuals");
    const igabem_solution *solution = tangent->solution;
    THREADS(solution->options.threads);
    size_t n = fields_of(tangent);
    double t[RESIDUAL_ANGLES], scale[RESIDUAL_ANGLES], h[RESIDUAL_ANGLES][2];
    igabem_status status = residual_angles(solution, t, scale);
    /* [n][angles][2] is [n][IGABEM_WAVE_RESIDUALS] */
    if (status == IGABEM_OK)
        status = kochin(tangent, radiation_limit(solution), RESIDUAL_ANGLES, t, h,
                        (double(*)[2])(void *)dr);
    double area = solution->info.hydrostatics.wetted_area;
    for (size_t f = 0; f < n && status == IGABEM_OK; f++)
        for (size_t k = 0; k < IGABEM_WAVE_RESIDUALS; k++) {
            double *to = dr + f * IGABEM_WAVE_RESIDUALS + k;
            *to = scale[k / 2] * (*to - 0.5 * h[k / 2][k % 2] * tangent->area[f] / area);
        }
    return status;
}

igabem_status igabem_tangent_cw(const igabem_tangent *tangent, double *dcw)
{
    if (!tangent || !dcw)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_tangent_cw");
    const igabem_solution *solution = tangent->solution;
    THREADS(solution->options.threads);
    size_t n = fields_of(tangent), m = 0;
    double limit = radiation_limit(solution), *t = NULL, *weight = NULL, length, beam;
    double(*h)[2] = NULL, (*dh)[2] = NULL;
    radiation_extent(solution, &length, &beam);
    igabem_status status = amplitude_rule(solution->k0, length, beam, limit,
                                          radiation_cutoff_angle(solution), &m, &t, &weight);
    if (status == IGABEM_OK) {
        h = malloc(m * sizeof *h);
        dh = malloc(n * m * sizeof *dh);
        if (!h || !dh)
            status = tangent_no_memory(n);
    }
    if (status == IGABEM_OK)
        status = kochin(tangent, limit, m, t, h, dh);
    double scale = kochin_coefficient(solution), area = solution->info.hydrostatics.wetted_area;
    for (size_t f = 0; f < n && status == IGABEM_OK; f++) {
        double sum = 0.0, change = 0.0;
        for (size_t i = 0; i < m; i++) {
            const double *d = dh[f * m + i];
            double part = 2.0 * weight[i] * sqrt(1.0 + t[i] * t[i]); /* both signs of t */
            sum += part * (h[i][0] * h[i][0] + h[i][1] * h[i][1]);
            change += 2.0 * part * (h[i][0] * d[0] + h[i][1] * d[1]);
        }
        dcw[f] = scale * (change - sum * tangent->area[f] / area);
    }
    free(t);
    free(weight);
    free(h);
    free(dh);
    return status;
}

igabem_status igabem_tangent_wetted_area(const igabem_tangent *tangent, double *darea)
{
    if (!tangent || !darea)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_tangent_wetted_area");
    for (size_t f = 0; f < fields_of(tangent); f++)
        darea[f] = tangent->area[f];
    return IGABEM_OK;
}

/* Changes of n_x dS and nu_x dl of one sample: `dsample` is [fields] with the given stride. */
static void change_measure(const igabem_tangent *tangent, size_t p, const double uv[2],
                           const double jet[9], int edge, double part, struct sample_scale scale,
                           double *v, size_t stride, igabem_pressure_sample *dsample)
{
    const struct density_patch *patch = &tangent->solution->density->patch[p];
    size_t n = fields_of(tangent);
    double local[2], width[2];
    const struct element *element = mesh_locate(tangent->mesh, p, uv, local);
    for (int d = 0; d < 2; d++)
        width[d] = element->upper[d] - element->lower[d];
    field_at(tangent->field, element, local, v);
    if (edge < 0) {
        struct area_change area;
        area_change(jet + 3, jet + 6, patch->hull.sign, &area);
        for (size_t f = 0; f < n; f++)
            dsample[f * stride].area =
                scale.area * part *
                (area.inflow[0] * v[n + f] / width[0] + area.inflow[1] * v[2 * n + f] / width[1]);
        return;
    }
    /* nu_x dl is the y component of the tangent, with a sign */
    int along = edge < HULL_V0 ? 1 : 0;
    double nu[2], dl, range = patch->hull.domain[along][1] - patch->hull.domain[along][0];
    hull_waterline_normal(&patch->hull, edge, jet, nu, &dl);
    double turn = nu[0] * jet[3 + 3 * along + 1] < 0 ? -1.0 : 1.0;
    if (nu[0] == 0.0) /* the stream runs along it: the sign by the other component */
        turn = nu[1] * jet[3 + 3 * along] > 0 ? -1.0 : 1.0;
    for (size_t f = 0; f < n; f++)
        dsample[f * stride].rise =
            scale.rise * part * turn * range * v[(1 + (size_t)along) * n + f] / width[along];
}

/* The samples of one patch, whose first has the index `first` of `total`. */
static igabem_status sample_patch(const igabem_tangent *tangent, size_t p, size_t n_u, size_t n_v,
                                  size_t first, size_t total, igabem_pressure_sample *dsample)
{
    const igabem_solution *solution = tangent->solution;
    const struct density_patch *patch = &solution->density->patch[p];
    const double(*domain)[2] = patch->hull.domain;
    const struct sample_scale scale = samples_scale(solution);
    size_t n = fields_of(tangent), m = samples_of_patch(patch, n_u, n_v);
    double wetted = solution->info.hydrostatics.wetted_area;
    double part =
        (domain[0][1] - domain[0][0]) * (domain[1][1] - domain[1][0]) / ((double)n_u * (double)n_v);
    double(*uv)[2] = malloc((11 * m + 3 * n * m + 3 * n) * sizeof(double));
    igabem_pressure_sample *own = malloc(m * sizeof *own);
    igabem_status status = uv && own ? IGABEM_OK : tangent_no_memory(n);
    if (status == IGABEM_OK) {
        double *jet = uv[m], *velocity = jet + 9 * m, *v = velocity + 3 * n * m;
        samples_place(patch, n_u, n_v, uv);
        status =
            density_evaluate(solution->density, p, 3 * n, tangent->velocity, m, uv[0], velocity);
        if (status == IGABEM_OK && nurbs_surface_eval(patch->surface, 1, m, uv[0], jet) != NURBS_OK)
            status = hull_nurbs_fail(NURBS_ERROR_NUMERIC, "samples of the pressure");
        if (status == IGABEM_OK)
            samples_measure(patch, n_u, n_v, jet, scale, own);
        for (size_t k = 0; k < m && status == IGABEM_OK; k++) {
            igabem_pressure_sample *to = dsample + first + k;
            double share = part;
            int edge = samples_edge(patch, n_u, n_v, k, &share);
            for (size_t f = 0; f < n; f++) {
                const double *dv = velocity + 3 * (n * k + f);
                to[f * total] =
                    (igabem_pressure_sample){.v = {dv[0] / solution->speed, dv[1] / solution->speed,
                                                   dv[2] / solution->speed}};
            }
            change_measure(tangent, p, uv[k], jet + 9 * k, edge, edge < 0 ? part : share, scale, v,
                           total, to);
            for (size_t f = 0; f < n; f++) {
                double growth = tangent->area[f] / wetted;
                to[f * total].area -= own[k].area * growth;
                to[f * total].rise -= own[k].rise * growth;
            }
        }
    }
    free(uv);
    free(own);
    return status;
}

igabem_status igabem_tangent_samples(const igabem_tangent *tangent, size_t n_u, size_t n_v,
                                     igabem_pressure_sample *dsample)
{
    if (!tangent || !dsample)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_tangent_samples");
    const igabem_solution *solution = tangent->solution;
    igabem_status status = samples_check(n_u, n_v);
    if (status == IGABEM_OK && !tangent->velocity)
        status = igabem_fail(IGABEM_ERROR_ARGUMENT, "formulation %s has no velocity on the hull",
                             igabem_formulation_name(solution->options.formulation));
    size_t total, at = 0;
    if (status == IGABEM_OK)
        status = igabem_pressure_samples(solution, n_u, n_v, &total, NULL);
    for (size_t p = 0; p < solution->density->patches && status == IGABEM_OK; p++) {
        status = sample_patch(tangent, p, n_u, n_v, at, total, dsample);
        at += samples_of_patch(&solution->density->patch[p], n_u, n_v);
    }
    return status;
}
