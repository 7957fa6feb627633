/* The Kochin function of a solution and the wave resistance R = (rho k0^2 / 2 pi) Int |H|^2
 * sqrt(1+t^2) dt, t over both signs (docs/theory.md, section 6). */
#include "result/kochin.h"

#include "core/constants.h"
#include "core/error.h"
#include "result/amplitude.h"
#include "result/radiation.h"
#include "solve/resolution.h"

#include <math.h>

/* C_w = |H|^2 changes by 2 H . dH at most when H becomes H - dH on half the knots; this share of
 * that bound is its error, within a factor of 3 for three meshes out of five (docs/validation.md).
 */
static const double error_share = 0.06;

double kochin_coefficient(const igabem_solution *solution)
{
    double area = solution->info.hydrostatics.wetted_area, speed = solution->speed;
    return solution->k0 * solution->k0 / (PI * speed * speed * area);
}

igabem_status kochin_resistance(const igabem_solution *solution, struct kochin_resistance *result)
{
    *result = (struct kochin_resistance){NAN, NAN, NAN, NAN, NAN};
    if (!solution->waves)
        return IGABEM_OK;
    enum radiation_cutoff cutoff[AMPLITUDE_SETS] = {RADIATION_AS_SOLVED};
    struct sources *sources[AMPLITUDE_SETS] = {NULL};
    const struct sources *carriers[AMPLITUDE_SETS];
    struct amplitude_sum sum[AMPLITUDE_SETS];
    bool several = solution->sigma_lower && solution->sigma_upper;
    size_t sets = 1;
    if (solution->sigma_change)
        cutoff[sets++] = RADIATION_CHANGE;
    if (several) {
        cutoff[sets++] = RADIATION_LOWER;
        cutoff[sets++] = RADIATION_UPPER;
    }
    double limit = radiation_limit(solution), length, beam;
    igabem_status status = IGABEM_OK;
    radiation_extent(solution, &length, &beam);
    for (size_t l = 0; l < sets && !status; l++) {
        status = radiation_sources(solution, cutoff[l], limit, 0, NULL, &sources[l]);
        carriers[l] = sources[l];
    }
    if (!status)
        status = amplitude_integrate(sets, carriers, solution->k0, length, beam, limit,
                                     radiation_cutoff_angle(solution), sum);
    for (size_t l = 0; l < sets; l++)
        sources_free(sources[l]);
    if (status)
        return status;
    double scale = kochin_coefficient(solution);
    result->cw = scale * sum[0].total;
    result->share_beyond_cutoff = sum[0].total > 0 ? sum[0].beyond / sum[0].total : 0.0;
    if (solution->sigma_change)
        result->cw_error = error_share * 2.0 * scale * sqrt(sum[0].total * sum[1].total);
    if (several) {
        result->cw_lower = scale * sum[sets - 2].total;
        result->cw_upper = scale * sum[sets - 1].total;
    }
    return IGABEM_OK;
}

igabem_status kochin_check_angles(const igabem_solution *solution, size_t n, const double *t,
                                  double *largest)
{
    if (!solution->waves)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "this solution has no free surface, expected the Kelvin kernel");
    *largest = 0.0;
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(t[i]))
            return igabem_fail(IGABEM_ERROR_ARGUMENT, "wave angle %zu is %g, expected a number", i,
                               t[i]);
        *largest = fmax(*largest, fabs(t[i]));
    }
    double length, beam;
    radiation_extent(solution, &length, &beam);
    return resolution_check_angle(solution->k0, length, beam, *largest, "wave angle");
}

igabem_status igabem_kochin(const igabem_solution *solution, size_t n, const double *t,
                            double h[][2], double *dcw)
{
    if (!solution || (n && (!t || !h)))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_kochin");
    double largest;
    igabem_status status = kochin_check_angles(solution, n, t, &largest);
    if (status)
        return status;
    struct sources *sources;
    status = radiation_sources(solution, RADIATION_AS_SOLVED, largest, 0, NULL, &sources);
    if (status)
        return status;
    double scale = kochin_coefficient(solution);
#pragma omp parallel for schedule(dynamic, 8)
    for (size_t i = 0; i < n; i++) {
        amplitude(sources, solution->k0, t[i], h[i]);
        if (dcw)
            dcw[i] = scale * (h[i][0] * h[i][0] + h[i][1] * h[i][1]) * sqrt(1.0 + t[i] * t[i]);
    }
    sources_free(sources);
    return IGABEM_OK;
}
