/* Derivatives of the results: the chain rule on what the Kochin function, the residuals and the
 * samples of the pressure are made of. */
#include "core/constants.h"
#include "core/error.h"
#include "result/amplitude.h"
#include "result/kochin.h"
#include "result/radiation.h"
#include "result/residual.h"
#include "tangent/radiate.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>

static size_t fields_of(const igabem_tangent *tangent)
{
    return tangent->field->n;
}

/* Fills dh[n][m][2]. */
static igabem_status kochin(const igabem_tangent *tangent, double largest, size_t m,
                            const double *t, double (*dh)[2])
{
    size_t n = fields_of(tangent);
    struct radiators *radiators;
    igabem_status status = radiators_create(tangent, largest, &radiators);
    if (status != IGABEM_OK)
        return status;
    bool failed = false;
#pragma omp parallel reduction(| : failed)
    {
        double(*one)[2] = malloc(n * sizeof *one);
        failed |= !one;
#pragma omp for schedule(dynamic, 4)
        for (size_t i = 0; i < m; i++) {
            if (failed)
                continue;
            radiators_sum(radiators, tangent->solution->k0, t[i], one);
            for (size_t f = 0; f < n; f++)
                for (size_t c = 0; c < 2; c++)
                    dh[f * m + i][c] = one[f][c];
        }
        free(one);
    }
    radiators_free(radiators);
    return failed ? tangent_no_memory(n) : IGABEM_OK;
}

igabem_status igabem_tangent_kochin(const igabem_tangent *tangent, size_t m, const double *t,
                                    double dh[][2])
{
    if (!tangent || (m && (!t || !dh)))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_tangent_kochin");
    THREADS(tangent->solution->options.threads);
    double largest;
    igabem_status status = kochin_check_angles(tangent->solution, m, t, &largest);
    return status == IGABEM_OK ? kochin(tangent, largest, m, t, dh) : status;
}

igabem_status igabem_tangent_residuals(const igabem_tangent *tangent, double *dr)
{
    if (!tangent || !dr)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_tangent_residuals");
    const igabem_solution *solution = tangent->solution;
    THREADS(solution->options.threads);
    size_t n = fields_of(tangent);
    double t[RESIDUAL_ANGLES], scale[RESIDUAL_ANGLES], r[IGABEM_WAVE_RESIDUALS];
    igabem_status status = residual_angles(solution, t, scale);
    if (status == IGABEM_OK)
        status = igabem_wave_residuals(solution, r);
    /* [n][angles][2] is [n][IGABEM_WAVE_RESIDUALS] */
    if (status == IGABEM_OK)
        status = kochin(tangent, radiation_limit(solution), RESIDUAL_ANGLES, t,
                        (double(*)[2])(void *)dr);
    double area = solution->info.hydrostatics.wetted_area;
    for (size_t f = 0; f < n && status == IGABEM_OK; f++)
        for (size_t k = 0; k < IGABEM_WAVE_RESIDUALS; k++) {
            double *to = dr + f * IGABEM_WAVE_RESIDUALS + k;
            *to = scale[k / 2] * *to - 0.5 * r[k] * tangent->area[f] / area;
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
        status = igabem_kochin(solution, m, t, h, NULL);
    if (status == IGABEM_OK)
        status = kochin(tangent, limit, m, t, dh);
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
