/* Skinning of section curves with their own knots.
 * Exactly: all curves are raised to one degree and given the union of all knots (skin_union.c).
 * Within a tolerance: skin_within.c. */
#include "core/error.h"
#include "fit/interpolate.h"
#include "fit/skin_common.h"

#include <nurbs/basis.h>
#include <nurbs/fit.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void common_free(common *sections)
{
    free(sections->knots);
    free(sections->net);
}

/* The curve with its domain moved to [0,1] and its degree raised: itself, or a new one, also in
 * *made. */
static nurbs_status normalize(const nurbs_curve *curve, int degree, nurbs_curve **made,
                              const nurbs_curve **result)
{
    size_t n = nurbs_curve_size(curve), count = n + (size_t)nurbs_curve_degree(curve) + 1;
    const double *t = nurbs_curve_knots(curve);
    const double first = t[0], last = t[count - 1];
    *result = curve;
    *made = NULL;
    if (nurbs_curve_degree(curve) == degree && first == 0.0 && last == 1.0)
        return NURBS_OK;
    double *knots = malloc(count * sizeof *knots);
    nurbs_curve *scaled = NULL;
    if (!knots)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", count);
    for (size_t k = 0; k < count; k++)
        knots[k] = t[k] == last ? 1 : (t[k] - first) / (last - first);
    nurbs_status status =
        nurbs_curve_create(nurbs_curve_degree(curve), n, knots, nurbs_curve_points(curve),
                           nurbs_curve_weights(curve), &scaled);
    free(knots);
    if (status == NURBS_OK)
        status = nurbs_curve_elevate(scaled, degree - nurbs_curve_degree(curve), made);
    nurbs_curve_free(scaled);
    *result = *made;
    return status;
}

/* Distances of the control points of two neighbouring sections. */
static void chords_between(const common *sections, size_t k, double *chord)
{
    const size_t dimension = sections->dimension;
    const double *a = sections->net + k * sections->size * dimension,
                 *b = a + sections->size * dimension;
    for (size_t i = 0; i < sections->size; i++, a += dimension, b += dimension) {
        const double wa = dimension == 4 ? a[3] : 1, wb = dimension == 4 ? b[3] : 1;
        double square = 0;
        for (size_t c = 0; c < 3; c++)
            square += (b[c] / wb - a[c] / wa) * (b[c] / wb - a[c] / wa);
        chord[i] = sqrt(square);
    }
}

/* Chord lengths between the control points of neighbouring sections as shares of their sum over the
 * sections, averaged over the control points. */
static nurbs_status average_chords(size_t n, const common *sections, double *u)
{
    const size_t m = sections->size;
    double *chords = malloc(n * m * sizeof *chords), *total = chords + (n - 1) * m;
    size_t used = 0;
    if (!chords)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu chords", n * m);
    memset(total, 0, m * sizeof *total);
    for (size_t k = 0; k + 1 < n; k++) {
        chords_between(sections, k, chords + k * m);
        for (size_t i = 0; i < m; i++)
            total[i] += chords[k * m + i];
    }
    for (size_t i = 0; i < m; i++) {
        used += total[i] > 0;
        total[i] = total[i] > 0 ? 1.0 / total[i] : 0.0;
    }
    u[0] = 0.0;
    for (size_t k = 0; k + 1 < n; k++) {
        double share = 0.0;
        for (size_t i = 0; i < m; i++)
            share += chords[k * m + i] * total[i];
        u[k + 1] = u[k] + share / (double)used;
    }
    free(chords);
    u[n - 1] = 1;
    if (used == 0)
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "all sections coincide");
    for (size_t k = 1; k < n; k++)
        if (!(u[k] > u[k - 1]))
            return nurbs_fail(NURBS_ERROR_GEOMETRY, "sections %zu and %zu coincide", k - 1, k);
    return NURBS_OK;
}

/* Interpolates every row of control points over the sections, in place. */
static nurbs_status skin_rows(size_t n, const double *u, int degree, common *sections,
                              nurbs_surface **surface)
{
    size_t m = sections->size, dimension = sections->dimension, p = (size_t)degree;
    const int rational = dimension == 4;
    double *knots = malloc((n + p + 1 + (rational ? 4 * n * m : 0)) * sizeof *knots);
    if (!knots)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu control points", n, m);
    double *points = rational ? knots + n + p + 1 : sections->net,
           *weights = rational ? points + 3 * n * m : NULL;
    averaged_knots(degree, n, u, knots);
    banded factors;
    nurbs_status status = collocation_factor(degree, n, knots, u, &factors);
    if (status == NURBS_OK) {
        banded_solve(&factors, m * dimension, sections->net);
        banded_free(&factors);
        for (size_t k = 0; rational && k < n * m; k++) {
            weights[k] = sections->net[4 * k + 3];
            for (size_t c = 0; c < 3; c++)
                points[3 * k + c] = sections->net[4 * k + c] / weights[k];
        }
        status =
            nurbs_surface_create((const int[]){degree, sections->degree}, (const size_t[]){n, m},
                                 knots, sections->knots, points, weights, surface);
    }
    free(knots);
    return status;
}

static nurbs_status check_sections(size_t n, const nurbs_curve *const *sections, const double *u,
                                   int degree, double tolerance)
{
    if (degree < 1 || degree > NURBS_MAX_DEGREE || n <= (size_t)degree)
        return nurbs_fail(
            NURBS_ERROR_ARGUMENT,
            "%zu sections for degree %d, expected more sections than the degree and a "
            "degree from 1 to %d",
            n, degree, NURBS_MAX_DEGREE);
    if (!(tolerance >= 0 && isfinite(tolerance)))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "tolerance %g, expected a length >= 0", tolerance);
    for (size_t k = 0; k < n; k++) {
        if (!sections[k])
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "section %zu is NULL", k);
        if (u && (!isfinite(u[k]) || (k > 0 && !(u[k] > u[k - 1]))))
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "section parameter %zu is %g: they must be finite and increase", k,
                              u[k]);
    }
    return NURBS_OK;
}

/* Sections on one knot vector, exactly or within the tolerance. */
static nurbs_status make_common(size_t n, const nurbs_curve *const *sections, double tolerance,
                                common *result)
{
    nurbs_curve **made = calloc(n, sizeof(nurbs_curve *));
    const nurbs_curve **curves = calloc(n, sizeof(nurbs_curve *));
    nurbs_status status =
        made && curves ? NURBS_OK : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu sections", n);
    *result = (common){.dimension = 3};
    for (size_t k = 0; k < n; k++) {
        int degree = nurbs_curve_degree(sections[k]);
        result->degree = degree > result->degree ? degree : result->degree;
        if (nurbs_curve_weights(sections[k]) && tolerance == 0)
            result->dimension = 4;
    }
    for (size_t k = 0; k < n && status == NURBS_OK; k++)
        status = normalize(sections[k], result->degree, &made[k], &curves[k]);
    if (status == NURBS_OK)
        status = tolerance > 0 ? common_within(n, curves, tolerance, result)
                               : common_union(n, curves, result);
    for (size_t k = 0; made && k < n; k++)
        nurbs_curve_free(made[k]);
    free(made);
    free(curves);
    return status;
}

nurbs_status nurbs_skin_curves(size_t n, const nurbs_curve *const *sections, const double *u,
                               int degree, double tolerance, nurbs_surface **surface)
{
    NURBS_NEED(surface && (n == 0 || sections));
    common shared = {0};
    *surface = NULL;
    nurbs_status status = check_sections(n, sections, u, degree, tolerance);
    if (status != NURBS_OK)
        return status;
    double *chords = malloc(n * sizeof *chords);
    if (!chords)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu sections", n);
    status = make_common(n, sections, tolerance, &shared);
    if (status == NURBS_OK && !u)
        status = average_chords(n, &shared, chords);
    if (status == NURBS_OK)
        status = skin_rows(n, u ? u : chords, degree, &shared, surface);
    common_free(&shared);
    free(chords);
    return status;
}
