/* Knot insertion that evens out the spans of a hull. */
#include "error.h"
#include "hull.h"

#include <nurbs/basis.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>

enum {
    ACROSS = 5, /* lines on which a span is measured */
    CHORDS = 8, /* of a span on each line */
    DIVIDE_MAX = 1000
};

/* Spans are divided evenly; one that is this much too long is left alone. */
static const double SLACK = 0.1;

/* Length of the longest of a few lines over the span [from, to] of one direction, and its share
 * along x. */
static nurbs_status span_length(const struct hull_patch *patch, int direction, double from,
                                double to, double *length, double *along_x)
{
    *length = *along_x = 0.0;
    const double *across = patch->domain[1 - direction];
    for (int line = 0; line < ACROSS; line++) {
        double uv[CHORDS + 1][2], at[CHORDS + 1][3], sum = 0.0, x = 0.0;
        for (int i = 0; i <= CHORDS; i++) {
            uv[i][direction] = i == CHORDS ? to : from + (to - from) * i / CHORDS;
            uv[i][1 - direction] = across[0] + (across[1] - across[0]) * line / (ACROSS - 1.0);
        }
        nurbs_status status = nurbs_surface_eval(patch->surface, 0, CHORDS + 1, uv[0], at[0]);
        if (status)
            return status;
        for (int i = 1; i <= CHORDS; i++) {
            double d[3];
            for (int k = 0; k < 3; k++)
                d[k] = at[i][k] - at[i - 1][k];
            sum += sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            x += fabs(d[0]);
        }
        if (sum > *length) {
            *length = sum;
            *along_x = x;
        }
    }
    return NURBS_OK;
}

/* Half girth of the largest section: of the box around the body. */
static double half_girth(const struct igabem_hull *hull)
{
    double side = fmax(fabs(hull->lower[1]), fabs(hull->upper[1]));
    return side + hull->upper[2] - hull->lower[2];
}

static igabem_status divide_direction(const struct igabem_hull *hull, struct hull_patch *patch,
                                      int direction, int along, int around)
{
    size_t size = nurbs_surface_size(patch->surface, direction), n = 0;
    int degree = nurbs_surface_degree(patch->surface, direction);
    double *breaks = malloc((size + 1) * sizeof *breaks), *knots = NULL;
    double *length = malloc((size + 1) * sizeof *length), total = 0.0, total_x = 0.0;
    if (!breaks || !length) {
        free(breaks);
        free(length);
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu knots", size);
    }
    size_t count = nurbs_knots_distinct(
        degree, size, nurbs_surface_knots(patch->surface, direction), breaks, NULL);
    nurbs_status status = NURBS_OK;
    for (size_t s = 0; !status && s + 1 < count; s++) {
        double x;
        status = span_length(patch, direction, breaks[s], breaks[s + 1], &length[s], &x);
        total += length[s];
        total_x += x;
    }
    double most = total_x > 0.5 * total ? hull->extent / along : half_girth(hull) / around;
    if (!status)
        knots = malloc((count + 1) * DIVIDE_MAX * sizeof *knots);
    for (size_t s = 0; knots && s + 1 < count; s++) {
        int parts = (int)fmin(fmax(1.0, ceil(length[s] / most - SLACK)), DIVIDE_MAX);
        for (int k = 1; k < parts; k++)
            knots[n++] = breaks[s] + (breaks[s + 1] - breaks[s]) * k / parts;
    }
    nurbs_surface *divided = NULL;
    if (knots && n > 0)
        status = nurbs_surface_insert(patch->surface, direction, n, knots, &divided);
    if (divided) {
        nurbs_surface_free(patch->surface);
        patch->surface = divided;
    }
    int no_memory = !status && !knots;
    free(breaks);
    free(length);
    free(knots);
    if (no_memory)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for new knots");
    return status ? hull_nurbs_fail(status, "dividing knot spans") : IGABEM_OK;
}

igabem_status igabem_hull_divide(igabem_hull *hull, int along, int around)
{
    if (!hull || along < 1 || around < 1 || along > DIVIDE_MAX || around > DIVIDE_MAX)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "%d x %d elements, expected a hull and counts from 1 to %d", along,
                           around, DIVIDE_MAX);
    for (size_t p = 0; p < hull->n; p++)
        for (int direction = 0; direction < 2; direction++) {
            igabem_status status =
                divide_direction(hull, &hull->patches[p], direction, along, around);
            if (status)
                return status;
        }
    return IGABEM_OK;
}
