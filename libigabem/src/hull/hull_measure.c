/* How long the patches are along the hull and around it, so that numbers of elements stated for the
 * hull can be shared among them. */
#include "core/error.h"
#include "hull/hull.h"

#include <math.h>
#include <stdlib.h>

enum { LINES = 9, POINTS = 33 };

/* A patch whose lines gain less in x than this share of their length runs across the hull. */
static const double TRANSVERSE = 0.05;

struct lines {
    double longest; /* of the polylines, m */
    double gain;    /* mean |x| between their ends, m */
    double x[2];    /* mean at the two ends, m */
};

static igabem_status find_lines(const struct hull_patch *patch, int d, struct lines *lines)
{
    double at[2][POINTS], points[LINES * POINTS * 3];
    const size_t n[2] = {d == 0 ? POINTS : LINES, d == 0 ? LINES : POINTS};
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < n[k]; i++)
            at[k][i] = i + 1 == n[k]
                           ? patch->domain[k][1]
                           : patch->domain[k][0] + (patch->domain[k][1] - patch->domain[k][0]) *
                                                       (double)i / (double)(n[k] - 1);
    nurbs_status status =
        nurbs_surface_eval_grid(patch->surface, 0, n[0], at[0], n[1], at[1], points);
    if (status)
        return hull_nurbs_fail(status, "measuring a patch");
    *lines = (struct lines){.longest = 0.0};
    size_t step = d == 0 ? LINES : 1, next = d == 0 ? 1 : POINTS;
    for (size_t line = 0; line < LINES; line++) {
        const double *first = points + 3 * line * next, *last = first + 3 * (POINTS - 1) * step;
        double length = 0.0;
        for (size_t i = 1; i < POINTS; i++) {
            const double *p = first + 3 * i * step, *q = p - 3 * step;
            length += sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) +
                           (p[2] - q[2]) * (p[2] - q[2]));
        }
        lines->longest = fmax(lines->longest, length);
        lines->gain += fabs(last[0] - first[0]) / LINES;
        lines->x[0] += first[0] / LINES;
        lines->x[1] += last[0] / LINES;
    }
    return IGABEM_OK;
}

static void count_spans(struct hull_patch *patch, int d)
{
    size_t last =
        nurbs_surface_size(patch->surface, d) + (size_t)nurbs_surface_degree(patch->surface, d);
    const double *knots = nurbs_surface_knots(patch->surface, d);
    double smallest = INFINITY, largest = 0.0;
    patch->spans[d] = 0;
    for (size_t k = 0; k < last; k++) {
        double span = knots[k + 1] - knots[k];
        if (!(span > 0))
            continue;
        smallest = fmin(smallest, span);
        largest = fmax(largest, span);
        patch->spans[d]++;
    }
    patch->span_ratio[d] = largest / smallest;
}

bool hull_is_around(const struct hull_patch *patch, int d)
{
    return patch->along != d;
}

/* Sum of a property of the patches that lie one below the other on one side at x. */
static double sum_around(const struct igabem_hull *hull, double x, const struct hull_patch *side,
                         double (*value)(const struct hull_patch *, int))
{
    double sum = 0.0;
    for (size_t p = 0; p < hull->n; p++) {
        const struct hull_patch *patch = &hull->patches[p];
        if (patch->along >= 0 && patch->x[0] < x && x < patch->x[1] && hull_same_side(side, patch))
            sum += value(patch, 1 - patch->along);
    }
    return sum;
}

/* Largest density of a property per metre of length among the patches at x. */
static double largest_along(const struct igabem_hull *hull, double x,
                            double (*value)(const struct hull_patch *, int))
{
    double largest = 0.0;
    for (size_t p = 0; p < hull->n; p++) {
        const struct hull_patch *patch = &hull->patches[p];
        if (patch->along >= 0 && patch->x[0] < x && x < patch->x[1])
            largest = fmax(largest, value(patch, patch->along) / (patch->x[1] - patch->x[0]));
    }
    return largest;
}

/* Ends of the patches in x, increasing. */
static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Totals of a property over the hull: from one end to the other, and around it where it is
 * largest. */
static igabem_status find_totals(const struct igabem_hull *hull,
                                 double (*value)(const struct hull_patch *, int), double total[2])
{
    double *stop = malloc(2 * hull->n * sizeof *stop);
    if (!stop)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu patches", hull->n);
    for (size_t p = 0; p < hull->n; p++)
        for (size_t end = 0; end < 2; end++)
            stop[2 * p + end] = hull->patches[p].x[end];
    qsort(stop, 2 * hull->n, sizeof *stop, by_value);
    total[0] = total[1] = 0.0;
    for (size_t k = 0; k + 1 < 2 * hull->n; k++) {
        double x = 0.5 * (stop[k] + stop[k + 1]);
        total[0] += (stop[k + 1] - stop[k]) * largest_along(hull, x, value);
        for (size_t p = 0; p < hull->n; p++)
            total[1] = fmax(total[1], sum_around(hull, x, &hull->patches[p], value));
    }
    free(stop);
    return IGABEM_OK;
}

static double length_of(const struct hull_patch *patch, int d)
{
    return patch->length[d];
}

static double spans_of(const struct hull_patch *patch, int d)
{
    return (double)patch->spans[d];
}

igabem_status hull_measure(struct igabem_hull *hull)
{
    for (size_t p = 0; p < hull->n; p++) {
        struct hull_patch *patch = &hull->patches[p];
        struct lines lines[2];
        for (int d = 0; d < 2; d++) {
            igabem_status status = find_lines(patch, d, &lines[d]);
            if (status)
                return status;
            patch->length[d] = lines[d].longest;
            count_spans(patch, d);
        }
        int along = lines[1].gain > lines[0].gain;
        patch->x[0] = fmin(lines[along].x[0], lines[along].x[1]);
        patch->x[1] = fmax(lines[along].x[0], lines[along].x[1]);
        int lengthwise = patch->x[1] - patch->x[0] > TRANSVERSE * lines[along].longest;
        patch->along = lengthwise || hull->n == 1 ? along : -1;
    }
    igabem_status status = find_totals(hull, length_of, hull->run);
    return status ? status : find_totals(hull, spans_of, hull->run_spans);
}

int hull_share(const struct igabem_hull *hull, size_t p, int d, int elements)
{
    const struct hull_patch *patch = &hull->patches[p];
    double run = hull->run[hull_is_around(patch, d)];
    if (elements <= 0)
        return 0;
    double share = run > 0 ? elements * patch->length[d] / run : elements;
    return share > 1.0 ? (int)lround(share) : 1;
}
