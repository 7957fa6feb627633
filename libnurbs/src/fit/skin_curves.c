/* Skinning of section curves with their own knots.
 *
 * Exactly: all curves are raised to one degree and given the union of all knots; knots closer than
 * MERGE are one knot. Within a tolerance: every section is sampled, and one knot vector is grown,
 * from knots spread like those of the sections, until least squares on it is within the tolerance
 * of every section. The size then depends on the shapes, not on how many knots the sections have
 * between them. */
#include "core/error.h"
#include "core/knot_list.h"
#include "fit/interpolate.h"
#include "fit/least_squares.h"
#include "fit/skin_common.h"

#include <nurbs/basis.h>
#include <nurbs/fit.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 16 };

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

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* All interior knots of all curves, sorted; the caller frees them. */
static double *gather_knots(size_t n, const nurbs_curve *const *curves, size_t *count)
{
    size_t total = 1;
    for (size_t k = 0; k < n; k++)
        total += nurbs_curve_size(curves[k]);
    double *knots = malloc(total * sizeof *knots);
    *count = 0;
    for (size_t k = 0; knots && k < n; k++) {
        const double *t = nurbs_curve_knots(curves[k]);
        for (size_t i = (size_t)nurbs_curve_degree(curves[k]) + 1; i < nurbs_curve_size(curves[k]);
             i++)
            knots[(*count)++] = t[i];
    }
    if (knots)
        qsort(knots, *count, sizeof *knots, compare_doubles);
    return knots;
}

/* Samples a section: a dozen for each knot span of an average section, and some for the rest. */
static size_t sample_count(size_t gathered, size_t n)
{
    size_t average = gathered / n + 1;
    return 12 * average + 64;
}

/* Knots at equal shares of the gathered ones, half of them evenly spread for safety. */
static nurbs_status start_knots(size_t count, const double *gathered, size_t spans, int degree,
                                knot_list *list)
{
    nurbs_status status = knot_list_start(list, degree, (const double[]){0, 1});
    for (size_t k = 1; k < spans && status == NURBS_OK; k++) {
        double share = (double)k / (double)spans, at = share * (double)count;
        size_t i = at < (double)count ? (size_t)at : count - 1;
        double knot = count ? 0.5 * (gathered[i] + share) : share;
        if (knot > list->knots[list->size - 1] + 1e-6 && knot < 1 - 1e-6)
            status = knot_list_append(list, knot);
    }
    return status;
}

static nurbs_status sample_sections(size_t n, const nurbs_curve *const *curves, size_t samples,
                                    const double *u, double *data)
{
    double *line = malloc(3 * samples * sizeof *line);
    nurbs_status status =
        line ? NURBS_OK : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu samples", samples);
    for (size_t k = 0; k < n && status == NURBS_OK; k++) {
        status = nurbs_curve_eval(curves[k], 0, samples, u, line);
        for (size_t i = 0; i < samples && status == NURBS_OK; i++)
            memcpy(data + 3 * (i * n + k), line + 3 * i, 3 * sizeof *data);
    }
    free(line);
    return status;
}

/* One least-squares fit of all sections; marks the spans that hold a datum farther off than the
 * tolerance. */
static nurbs_status fit_round(const knot_list *list, size_t n, size_t samples, const double *u,
                              const double *data, double tolerance, double *net,
                              unsigned char *parts, int *divided)
{
    fit_matrix fit;
    *divided = 0;
    nurbs_status status =
        fit_matrix_create(list->degree, list->size, list->knots, samples, u, &fit);
    if (status != NURBS_OK)
        return status;
    fit_matrix_solve(&fit, 3 * n, data, net);
    for (size_t k = 0; k < samples; k++)
        if (fit_matrix_deviation(&fit, 3 * n, k, data, net) > tolerance) {
            parts[fit.first[k] + (size_t)list->degree] = 2;
            *divided = 1;
        }
    fit_matrix_free(&fit);
    return NURBS_OK;
}

/* From the order of a fit, [size][n][3], to that of sections. */
static nurbs_status turn_net(size_t n, common *sections)
{
    double *net = malloc(3 * n * sections->size * sizeof *net);
    if (!net)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu control points", n,
                          sections->size);
    for (size_t j = 0; j < sections->size; j++)
        for (size_t i = 0; i < n; i++)
            memcpy(net + 3 * (i * sections->size + j), sections->net + 3 * (j * n + i),
                   3 * sizeof *net);
    free(sections->net);
    sections->net = net;
    return NURBS_OK;
}

static nurbs_status within_tolerance(size_t n, const nurbs_curve *const *curves, double tolerance,
                                     common *sections)
{
    size_t count, largest = 0;
    double *gathered = gather_knots(n, curves, &count);
    size_t samples = sample_count(count, n);
    double *u = malloc(samples * (1 + 3 * n) * sizeof *u), *data = u + samples;
    knot_list list = {0};
    nurbs_status status =
        gathered && u ? NURBS_OK
                      : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu samples", samples * n);
    for (size_t k = 0; k < n; k++)
        largest = nurbs_curve_size(curves[k]) > largest ? nurbs_curve_size(curves[k]) : largest;
    for (size_t k = 0; k < samples && status == NURBS_OK; k++)
        u[k] = (double)k / (double)(samples - 1);
    if (status == NURBS_OK)
        status = sample_sections(n, curves, samples, u, data);
    if (status == NURBS_OK)
        status = start_knots(count, gathered, largest - (size_t)sections->degree, sections->degree,
                             &list);
    int divided = 1;
    for (int round = 0; round < ROUNDS && divided && status == NURBS_OK; round++) {
        unsigned char *parts = calloc(list.size + (size_t)list.degree, 1);
        double *net = realloc(sections->net, 3 * list.size * n * sizeof *net);
        sections->net = net ? net : sections->net;
        if (!parts || !net)
            status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu control points", list.size);
        if (status == NURBS_OK)
            status = fit_round(&list, n, samples, u, data, tolerance, net, parts, &divided);
        sections->size = list.size;
        if (status == NURBS_OK && divided)
            status = knot_list_divide(&list, parts);
        free(parts);
    }
    if (status == NURBS_OK && divided)
        status =
            nurbs_fail(NURBS_ERROR_NUMERIC,
                       "the sections cannot be brought to one knot vector within %g m", tolerance);
    sections->knots = list.knots;
    if (status == NURBS_OK)
        status = turn_net(n, sections);
    free(gathered);
    free(u);
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
        status = tolerance > 0 ? within_tolerance(n, curves, tolerance, result)
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
