/* Sections on one knot vector within a tolerance: it begins with knots spread like those of the
 * sections and with all their corners, and is divided until least squares on it is within the
 * tolerance of every section. Its size depends on the shapes, not on how many knots the sections
 * have between them. Every span keeps samples enough to determine its control points. */
#include "core/error.h"
#include "core/knot_list.h"
#include "fit/least_squares.h"
#include "fit/skin_common.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 24, LEAST_SAMPLES = 8 /* a span */ };

static const double merge = 1e-9;      /* of the domain: knots nearer than this are one */
static const double least_step = 1e-6; /* between knots that are spread */

/* A knot to begin with. */
typedef struct start {
    double knot;
    int times;
} start;

static int compare_starts(const void *a, const void *b)
{
    double x = ((const start *)a)->knot, y = ((const start *)b)->knot;
    return (x > y) - (x < y);
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

/* Corners of a curve: interior knots of multiplicity `degree` or more. */
static size_t add_corners(const nurbs_curve *curve, int degree, start *list)
{
    const double *t = nurbs_curve_knots(curve);
    size_t count = 0, p = (size_t)degree, size = nurbs_curve_size(curve);
    for (size_t i = p + 1; degree > 1 && i + p <= size; i++)
        if (t[i] == t[i + p - 1] && t[i] != t[i - 1])
            list[count++] = (start){t[i], degree};
    return count;
}

/* Corners of all curves, and knots at equal shares of the gathered ones, half of them evenly spread
 * for safety. */
static nurbs_status start_knots(size_t n, const nurbs_curve *const *curves, size_t count,
                                const double *gathered, size_t spans, int degree, knot_list *list)
{
    start *starts = malloc((count + spans + 1) * sizeof *starts);
    if (!starts)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", count + spans);
    size_t found = 0;
    for (size_t k = 0; k < n; k++)
        found += add_corners(curves[k], degree, starts + found);
    for (size_t k = 1; k < spans; k++) {
        double share = (double)k / (double)spans, at = share * (double)count;
        size_t i = at < (double)count ? (size_t)at : count - 1;
        starts[found++] = (start){count ? 0.5 * (gathered[i] + share) : share, 1};
    }
    qsort(starts, found, sizeof *starts, compare_starts);
    nurbs_status status = knot_list_start(list, degree, (const double[]){0, 1});
    for (size_t k = 0; k < found && status == NURBS_OK; k++) {
        double last = list->knots[list->size - 1], step = starts[k].times > 1 ? merge : least_step;
        bool crowded = starts[k].times == 1 && k + 1 < found && starts[k + 1].times > 1 &&
                       starts[k + 1].knot - starts[k].knot < least_step;
        if (crowded || !(starts[k].knot > last + step) || !(starts[k].knot < 1 - step))
            continue;
        for (int i = 0; i < starts[k].times && status == NURBS_OK; i++)
            status = knot_list_append(list, starts[k].knot);
    }
    free(starts);
    return status;
}

/* Samples of all sections, [samples][n][3]. */
typedef struct samples {
    size_t n;
    double *u, *data;
} samples;

static void samples_free(samples *set)
{
    free(set->u);
    free(set->data);
    *set = (samples){0};
}

/* Equal steps in every span, at least LEAST_SAMPLES and as many as `density` says: from its left
 * end, or with `between` from half a step behind it. */
static nurbs_status samples_create(const knot_list *list, double density, bool between, size_t n,
                                   const nurbs_curve *const *curves, samples *set)
{
    size_t room = 1;
    for (int pass = 0; pass < 2; pass++) {
        set->n = 0;
        for (size_t k = (size_t)list->degree; k < list->size; k++) {
            double length = list->knots[k + 1] - list->knots[k];
            size_t steps = (size_t)fmax(LEAST_SAMPLES, ceil(length * density));
            for (size_t i = 0; i < steps && length > 0; i++, set->n++)
                if (pass)
                    set->u[set->n] =
                        list->knots[k] + length * ((double)i + (between ? 0.5 : 0)) / (double)steps;
        }
        if (pass)
            break;
        room = set->n + 1;
        set->u = malloc(room * sizeof(double));
        set->data = malloc(3 * (room + 1) * (n + 1) * sizeof(double));
        if (!set->u || !set->data)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu samples", room * n);
    }
    if (!between)
        set->u[set->n++] = 1;
    double *line = malloc(3 * room * sizeof *line);
    nurbs_status status =
        line ? NURBS_OK : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu samples", room);
    for (size_t k = 0; k < n && status == NURBS_OK; k++) {
        status = nurbs_curve_eval(curves[k], 0, set->n, set->u, line);
        for (size_t i = 0; i < set->n && status == NURBS_OK; i++)
            memcpy(set->data + 3 * (i * n + k), line + 3 * i, 3 * sizeof *line);
    }
    free(line);
    return status;
}

/* Marks the spans that hold a sample farther off than the tolerance. */
static void mark_spans(const fit_matrix *fit, const knot_list *list, size_t n, const samples *set,
                       double tolerance, const double *net, unsigned char *parts, bool *divided)
{
    for (size_t k = 0; k < set->n; k++)
        if (!(fit_matrix_deviation(fit, 3 * n, k, set->data, net) <= tolerance)) {
            parts[fit->first[k] + (size_t)list->degree] = 2;
            *divided = true;
        }
}

/* One least-squares fit of all sections, looked at where it was fitted and halfway between. */
static nurbs_status fit_round(const knot_list *list, size_t n, const nurbs_curve *const *curves,
                              double density, double tolerance, double *net, unsigned char *parts,
                              bool *divided)
{
    nurbs_status status = NURBS_OK;
    *divided = false;
    for (int between = 0; between < 2 && !*divided && status == NURBS_OK; between++) {
        samples set = {0};
        fit_matrix fit = {0};
        status = samples_create(list, density, between, n, curves, &set);
        if (status == NURBS_OK)
            status = fit_matrix_create(list->degree, list->size, list->knots, set.n, set.u, &fit);
        if (status == NURBS_OK && !between)
            fit_matrix_solve(&fit, 3 * n, set.data, net);
        if (status == NURBS_OK)
            mark_spans(&fit, list, n, &set, tolerance, net, parts, divided);
        fit_matrix_free(&fit);
        samples_free(&set);
    }
    return status;
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

static nurbs_status refine(size_t n, const nurbs_curve *const *curves, double density,
                           double tolerance, knot_list *list, common *sections)
{
    bool divided = true;
    nurbs_status status = NURBS_OK;
    for (int round = 0; round < ROUNDS && divided && status == NURBS_OK; round++) {
        unsigned char *parts = calloc(list->size + (size_t)list->degree, 1);
        double *net = realloc(sections->net, 3 * list->size * n * sizeof *net);
        sections->net = net ? net : sections->net;
        if (!parts || !net)
            status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu control points", list->size);
        if (status == NURBS_OK)
            status = fit_round(list, n, curves, density, tolerance, net, parts, &divided);
        sections->size = list->size;
        if (status == NURBS_OK && divided)
            status = knot_list_divide(list, parts);
        free(parts);
    }
    if (status == NURBS_OK && divided)
        status =
            nurbs_fail(NURBS_ERROR_NUMERIC,
                       "the sections cannot be brought to one knot vector within %g m", tolerance);
    return status;
}

nurbs_status common_within(size_t n, const nurbs_curve *const *curves, double tolerance,
                           common *sections)
{
    size_t count, largest = 0;
    double *gathered = gather_knots(n, curves, &count);
    knot_list list = {0};
    nurbs_status status =
        gathered ? NURBS_OK : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu sections", n);
    for (size_t k = 0; k < n; k++)
        largest = nurbs_curve_size(curves[k]) > largest ? nurbs_curve_size(curves[k]) : largest;
    if (status == NURBS_OK)
        status = start_knots(n, curves, count, gathered, largest - (size_t)sections->degree,
                             sections->degree, &list);
    /* A dozen for each knot span of an average section, and some for the rest. */
    double density = 12 * (double)(count / n + 1) + 64;
    if (status == NURBS_OK)
        status = refine(n, curves, density, tolerance, &list, sections);
    sections->knots = list.knots;
    if (status == NURBS_OK)
        status = turn_net(n, sections);
    free(gathered);
    return status;
}
