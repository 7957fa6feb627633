/* Simplification with another parametrisation. The parameters of each direction are replaced by the
 * mean length of the lines along it, piecewise linear between knots: as Bezier patches a spline
 * keeps its degree and its exact shape under such a change, only its knots move. The copies of
 * knots that this costs are then removed like any others, and the certificate of that removal, at
 * equal new parameters, bounds the distance of the two as sets of points. */
#include "core/error.h"
#include "core/object.h"

#include <nurbs/basis.h>
#include <nurbs/modify.h>
#include <nurbs/simplify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Shares of the tolerance for removal on the old parametrisation and for a first pass on the new
 * one, which keep the work small; the rest is for a second pass. */
static const double first_share = 0.05, even_share = 0.15;
/* Divisions of a span before it is stretched: how closely speed within a span is evened out. */
enum { DIVISIONS = 3, SAMPLES = 4, LINES = 24 };

static double distance(const double *a, const double *b)
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* New knots: lengths of curve segments between distinct knots (chords between samples), each kept
 * above a small part of the mean so that knots stay apart. */
static void stretch(size_t count, const double *lengths, double *breaks)
{
    double total = 0.0;
    for (size_t k = 0; k < count; k++)
        total += lengths[k];
    breaks[0] = 0.0;
    for (size_t k = 0; k < count; k++) {
        const double share = total > 0.0 ? lengths[k] / total : 0.0;
        breaks[k + 1] = breaks[k] + 0.999 * share + 0.001 / (double)count;
    }
    const double end = breaks[count];
    for (size_t k = 0; k <= count; k++)
        breaks[k] = k == count ? 1.0 : breaks[k] / end;
}

/* Replaces every knot by the new value of its distinct place. */
static void move_knots(const struct axis *axis, const double *breaks, double *knots)
{
    size_t place = 0;
    for (size_t k = 0; k < axis->size + (size_t)axis->degree + 1; k++) {
        if (k > 0 && axis->knots[k] != axis->knots[k - 1])
            place++;
        knots[k] = breaks[place];
    }
}

/* Mean lengths over lines along a direction, between distinct knots: fills lengths. */
static nurbs_status mean_lengths(const nurbs_surface *s, int direction, const double *breaks,
                                 size_t spans, double *lengths)
{
    const struct axis *across = &s->axis[1 - direction];
    const double low = across->knots[0], high = across->knots[across->size];
    memset(lengths, 0, spans * sizeof *lengths);
    for (int line = 0; line < LINES; line++) {
        double previous[3];
        for (size_t k = 0; k < spans * SAMPLES + 1; k++) {
            const size_t span = k / SAMPLES;
            const double part = (double)(k % SAMPLES) / SAMPLES;
            double uv[2], point[3];
            uv[direction] = span == spans ? breaks[spans]
                                          : breaks[span] + part * (breaks[span + 1] - breaks[span]);
            uv[1 - direction] = low + (high - low) * ((line + 0.5) / LINES);
            nurbs_status status = nurbs_surface_eval(s, 0, 1, uv, point);
            if (status != NURBS_OK)
                return status;
            if (k > 0)
                lengths[(k - 1) / SAMPLES] += distance(point, previous);
            memcpy(previous, point, sizeof previous);
        }
    }
    return NURBS_OK;
}

static nurbs_status stretched_knots(const nurbs_surface *s, int direction, double **knots)
{
    const struct axis *axis = &s->axis[direction];
    const size_t count = axis->size + (size_t)axis->degree + 1;
    *knots = malloc(count * sizeof **knots);
    double *breaks = malloc(3 * count * sizeof *breaks);
    if (!*knots || !breaks) {
        free(breaks);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", count);
    }
    double *lengths = breaks + count, *stretched = lengths + count;
    const size_t spans =
        nurbs_knots_distinct(axis->degree, axis->size, axis->knots, breaks, NULL) - 1;
    nurbs_status status = mean_lengths(s, direction, breaks, spans, lengths);
    if (status == NURBS_OK) {
        stretch(spans, lengths, stretched);
        move_knots(axis, stretched, *knots);
    }
    free(breaks);
    return status;
}

static nurbs_status even_surface(const nurbs_surface *surface, nurbs_surface **even)
{
    nurbs_surface *divided = NULL, *bezier = NULL;
    double *knots[2] = {NULL, NULL};
    nurbs_status status = nurbs_surface_refine(surface, DIVISIONS, &divided);
    if (status == NURBS_OK)
        status = nurbs_surface_to_bezier(divided, &bezier);
    for (int d = 0; d < 2 && status == NURBS_OK; d++)
        status = stretched_knots(bezier, d, &knots[d]);
    if (status == NURBS_OK) {
        const int degree[2] = {bezier->axis[0].degree, bezier->axis[1].degree};
        const size_t size[2] = {bezier->axis[0].size, bezier->axis[1].size};
        status = nurbs_surface_create(degree, size, knots[0], knots[1], bezier->points,
                                      bezier->weights, even);
    }
    nurbs_surface_free(divided);
    nurbs_surface_free(bezier);
    free(knots[0]);
    free(knots[1]);
    return status;
}

static size_t net_size(const nurbs_surface *s)
{
    return s->axis[0].size * s->axis[1].size;
}

nurbs_status nurbs_surface_simplify_geometric(const nurbs_surface *surface, double tolerance,
                                              unsigned flags, nurbs_surface **result, double *bound)
{
    if (!surface || !result)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", surface ? "result" : "surface");
    *result = NULL;
    if (flags & ~(unsigned)NURBS_SIMPLIFY_KEEP_EDGES)
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "flags are %#x, expected 0 or NURBS_SIMPLIFY_KEEP_EDGES", flags);
    /* The even net has most of its knots from the change itself: the quick search takes those. */
    const unsigned thrifty = flags | NURBS_SIMPLIFY_THRIFTY;
    nurbs_surface *plain = NULL, *first = NULL, *even = NULL, *fewer = NULL, *second = NULL;
    double bounds[4] = {0.0};
    nurbs_status status = nurbs_surface_simplify(surface, tolerance, thrifty, &plain, &bounds[0]);
    if (status == NURBS_OK)
        status =
            nurbs_surface_simplify(surface, first_share * tolerance, thrifty, &first, &bounds[1]);
    if (status == NURBS_OK)
        status = even_surface(first, &even);
    if (status == NURBS_OK)
        status = nurbs_surface_simplify(even, even_share * tolerance, flags, &fewer, &bounds[2]);
    if (status == NURBS_OK)
        status = nurbs_surface_simplify(fewer, tolerance - bounds[1] - bounds[2], thrifty, &second,
                                        &bounds[3]);
    nurbs_surface_free(first);
    nurbs_surface_free(even);
    nurbs_surface_free(fewer);
    if (status != NURBS_OK) {
        nurbs_surface_free(plain);
        return status;
    }
    const int smaller = net_size(second) < net_size(plain);
    *result = smaller ? second : plain;
    nurbs_surface_free(smaller ? plain : second);
    if (bound)
        *bound = smaller ? bounds[1] + bounds[2] + bounds[3] : bounds[0];
    return NURBS_OK;
}

/* The curve with every span divided, as Bezier segments. */
static nurbs_status divided_curve(const nurbs_curve *curve, nurbs_curve **bezier)
{
    const struct axis *axis = &curve->axis;
    const double *t = axis->knots;
    double *u = malloc((DIVISIONS - 1) * axis->size * sizeof *u);
    nurbs_curve *divided = NULL;
    size_t n = 0;
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to divide %zu spans", axis->size);
    for (size_t s = (size_t)axis->degree; s < axis->size; s++)
        for (int k = 1; k < DIVISIONS; k++) {
            const double knot = t[s] + (t[s + 1] - t[s]) * ((double)k / DIVISIONS);
            if (knot > t[s] && knot < t[s + 1] && (n == 0 || knot > u[n - 1]))
                u[n++] = knot;
        }
    nurbs_status status = nurbs_curve_insert(curve, n, u, &divided);
    if (status == NURBS_OK)
        status = nurbs_curve_to_bezier(divided, bezier);
    nurbs_curve_free(divided);
    free(u);
    return status;
}

/* Lengths between distinct knots by chords. */
static nurbs_status curve_lengths(const nurbs_curve *curve, const double *breaks, size_t spans,
                                  double *lengths)
{
    for (size_t s = 0; s < spans; s++) {
        double u[SAMPLES + 1], points[3 * (SAMPLES + 1)];
        for (int k = 0; k <= SAMPLES; k++)
            u[k] = k == SAMPLES ? breaks[s + 1]
                                : breaks[s] + (breaks[s + 1] - breaks[s]) * ((double)k / SAMPLES);
        nurbs_status status = nurbs_curve_eval(curve, 0, SAMPLES + 1, u, points);
        if (status != NURBS_OK)
            return status;
        lengths[s] = 0.0;
        for (size_t k = 0; k < SAMPLES; k++)
            lengths[s] += distance(points + 3 * k, points + 3 * (k + 1));
    }
    return NURBS_OK;
}

static nurbs_status even_curve(const nurbs_curve *curve, nurbs_curve **even)
{
    nurbs_curve *bezier;
    nurbs_status status = divided_curve(curve, &bezier);
    if (status != NURBS_OK)
        return status;
    const struct axis *axis = &bezier->axis;
    const size_t count = axis->size + (size_t)axis->degree + 1;
    double *knots = malloc(4 * count * sizeof *knots);
    if (knots) {
        double *breaks = knots + count, *lengths = breaks + count, *stretched = lengths + count;
        const size_t spans =
            nurbs_knots_distinct(axis->degree, axis->size, axis->knots, breaks, NULL) - 1;
        status = curve_lengths(bezier, breaks, spans, lengths);
        if (status == NURBS_OK) {
            stretch(spans, lengths, stretched);
            move_knots(axis, stretched, knots);
            status = nurbs_curve_create(axis->degree, axis->size, knots, bezier->points,
                                        bezier->weights, even);
        }
    } else {
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", count);
    }
    free(knots);
    nurbs_curve_free(bezier);
    return status;
}

nurbs_status nurbs_curve_simplify_geometric(const nurbs_curve *curve, double tolerance,
                                            nurbs_curve **result, double *bound)
{
    if (!curve || !result)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", curve ? "result" : "curve");
    *result = NULL;
    nurbs_curve *plain = NULL, *first = NULL, *even = NULL, *second = NULL;
    double bounds[3] = {0.0};
    nurbs_status status = nurbs_curve_simplify(curve, tolerance, &plain, &bounds[0]);
    if (status == NURBS_OK)
        status = nurbs_curve_simplify(curve, first_share * tolerance, &first, &bounds[1]);
    if (status == NURBS_OK)
        status = even_curve(first, &even);
    if (status == NURBS_OK)
        status = nurbs_curve_simplify(even, tolerance - bounds[1], &second, &bounds[2]);
    nurbs_curve_free(first);
    nurbs_curve_free(even);
    if (status != NURBS_OK) {
        nurbs_curve_free(plain);
        return status;
    }
    const int smaller = second->axis.size < plain->axis.size;
    *result = smaller ? second : plain;
    nurbs_curve_free(smaller ? plain : second);
    if (bound)
        *bound = smaller ? bounds[1] + bounds[2] : bounds[0];
    return NURBS_OK;
}
