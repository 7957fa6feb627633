/* The wetted hull: the cut sections T(u,w) of cut.h interpolated by a tensor spline.
 *
 * Along w the knots of the hull are carried over at the mean crossing, along u the hull's own knots
 * are kept; spans of either direction are halved until the spline follows T within a part of the
 * tolerance inside every span. Where the hull may break (u knots of full multiplicity)
 * only those lines w = constant break that have a kink there. */
#include "section/wetted.h"

#include "core/error.h"
#include "fit/interpolate.h"
#include "fit/tensor_refine.h"
#include "section/cut.h"
#include "section/sides.h"

#include <nurbs/basis.h>
#include <nurbs/section.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct build {
    cut sections;
    double tolerance; /* metres */
    double range[2];  /* of u */
    double limit[2];  /* crossing at an end that is a point, else -1 */
    knot_list along[2];
    size_t kinks;
    double *kink;          /* u knots where the hull may break */
    unsigned char *broken; /* [columns][kinks] */
    double *sites;         /* Greville points w */
    double *net;           /* the result: [u][w][3] */
} build;

/* T(u, w[n]) for tensor_map. */
static nurbs_status section_points(void *context, double u, size_t n, const double *w, double *out)
{
    build *work = context;
    double crossing;
    cut_kind kind = cut_section(&work->sections, u, &crossing);
    for (int e = 0; e < 2; e++)
        if (u == work->range[e] && work->limit[e] >= 0) {
            crossing = work->limit[e];
            kind = CUT_CROSSES;
        }
    if (kind != CUT_CROSSES)
        return cut_refuse(&work->sections, u, kind);
    cut_points(&work->sections, crossing, n, w, out);
    return NURBS_OK;
}

/* The hull's u knots inside the range, clamped at its ends; notes the knots of full multiplicity.
 */
static nurbs_status start_u(build *work)
{
    const cut *sections = &work->sections;
    const double *t = sections->knots_u;
    size_t p = (size_t)sections->degree[0];
    double least = 1e-9 * (work->range[1] - work->range[0]);
    nurbs_status status = knot_list_start(&work->along[0], sections->degree[0], work->range);
    work->kink = malloc(sections->size[0] * sizeof(double));
    if (!work->kink)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", sections->size[0]);
    for (size_t k = p + 1; k < sections->size[0] && status == NURBS_OK; k++) {
        if (t[k] < work->range[0] + least || t[k] > work->range[1] - least)
            continue;
        status = knot_list_append(&work->along[0], t[k]);
        if (p > 1 && t[k] == t[k + p - 1] && t[k] != t[k - 1])
            work->kink[work->kinks++] = t[k];
    }
    return status;
}

/* The hull's v knots carried over at the mean crossing, but none that would make the first span
 * shorter than half the next. */
static nurbs_status start_w(build *work)
{
    cut *sections = &work->sections;
    const double *t = sections->knots_v;
    enum { SAMPLES = 33 };
    double mean = 0, crossing;
    for (int k = 0; k < SAMPLES; k++) {
        double at = (k + 0.5) / SAMPLES;
        cut_section(sections, work->range[0] + at * (work->range[1] - work->range[0]), &crossing);
        mean += crossing / SAMPLES;
    }
    nurbs_status status =
        knot_list_start(&work->along[1], sections->degree[1], (const double[]){0, 1});
    for (size_t k = (size_t)sections->degree[1] + 1; k < sections->size[1] && status == NURBS_OK;
         k++) {
        size_t next = k + 1;
        while (t[next] == t[k])
            next++;
        if (t[k] > mean && t[k] - mean >= 0.5 * (t[next] - t[k]))
            status = knot_list_append(&work->along[1], (t[k] - mean) / (1 - mean));
    }
    return status;
}

/* Which lines w = constant have a kink at which of the hull's breaks. */
static nurbs_status find_broken(build *work)
{
    size_t n = work->along[1].size;
    free(work->sites);
    free(work->broken);
    work->sites = malloc(n * sizeof(double));
    work->broken = calloc(n * work->kinks + 1, 1);
    double *before = malloc(6 * n * sizeof *before);
    nurbs_status status = NURBS_OK;
    if (!work->sites || !work->broken || !before)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu lines", n);
    else
        nurbs_greville(work->along[1].degree, n, work->along[1].knots, work->sites);
    for (size_t k = 0; k < work->kinks && status == NURBS_OK; k++) {
        double crossing, *after = before + 3 * n, u = work->kink[k];
        cut_kind kind = cut_section(&work->sections, u, &crossing);
        if (kind != CUT_CROSSES) {
            status = cut_refuse(&work->sections, u, kind);
            break;
        }
        cut_derivative(&work->sections, u, CUT_LEFT, crossing, n, work->sites, before);
        cut_derivative(&work->sections, u, CUT_RIGHT, crossing, n, work->sites, after);
        for (size_t j = 0; j < n; j++) {
            double jump = 0, length = 0;
            for (size_t c = 3 * j; c < 3 * j + 3; c++) {
                jump = fmax(jump, fabs(after[c] - before[c]));
                length = fmax(length, fabs(after[c]) + fabs(before[c]));
            }
            work->broken[j * work->kinks + k] = jump > 1e-6 * length;
        }
    }
    free(before);
    return status;
}

/* The u knots with those breaks reduced to simple knots that `broken` does not mark. */
static size_t reduced_knots(const build *work, const unsigned char *broken, double *knots)
{
    const knot_list *list = &work->along[0];
    size_t count = 0, kink = 0, p = (size_t)list->degree;
    for (size_t k = 0; k < list->size + p + 1; k++) {
        while (kink < work->kinks && work->kink[kink] < list->knots[k])
            kink++;
        int smooth = kink < work->kinks && work->kink[kink] == list->knots[k] && !broken[kink];
        if (!smooth || list->knots[k] != list->knots[k - 1])
            knots[count++] = list->knots[k];
    }
    return count - p - 1;
}

/* Interpolates lines first ... last - 1, which break alike, into the net. */
static nurbs_status fit_lines(build *work, size_t first, size_t last)
{
    const knot_list *list = &work->along[0];
    size_t p = (size_t)list->degree, m = 3 * (last - first), columns = work->along[1].size;
    double *knots = malloc((2 * list->size + p + 2 + list->size * m) * sizeof *knots);
    if (!knots)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu lines", last - first);
    double *sites = knots + list->size + p + 1, *rows = sites + list->size + 1;
    size_t n = reduced_knots(work, work->broken + first * work->kinks, knots);
    nurbs_greville(list->degree, n, knots, sites);
    const tensor_map map = {section_points, work};
    nurbs_status status = tensor_sample(&map, 0, (const size_t[]){n, last - first},
                                        (const double *const[]){sites, work->sites + first}, rows);
    if (status == NURBS_OK)
        status = tensor_solve(list->degree, n, knots, sites, m, rows);
    for (size_t k = 0; k < list->size + p + 1 && status == NURBS_OK; k++)
        if (k >= n + p + 1 || knots[k] != list->knots[k])
            spline_insert_rows(list->degree, &n, knots, m, rows, list->knots[k]);
    for (size_t i = 0; i < list->size && status == NURBS_OK; i++)
        memcpy(work->net + 3 * (i * columns + first), rows + i * m, m * sizeof *rows);
    free(knots);
    return status;
}

/* Rounding aside, these already hold: the waterline at the level, edges in y = 0 there. */
static void settle_edges(build *work)
{
    size_t rows = work->along[0].size, columns = work->along[1].size;
    double *net = work->net, reach = 0;
    for (size_t i = 0; i < rows; i++)
        net[3 * i * columns + 2] = work->sections.level;
    for (size_t k = 0; k < rows * columns; k++)
        reach = fmax(reach, fabs(net[3 * k + 1]));
    const struct {
        size_t first, step, count;
    } edges[3] = {
        {0, 1, columns}, {(rows - 1) * columns, 1, columns}, {columns - 1, columns, rows}};
    for (int e = 0; e < 3; e++) {
        double most = 0;
        for (size_t k = 0; k < edges[e].count; k++)
            most = fmax(most, fabs(net[3 * (edges[e].first + k * edges[e].step) + 1]));
        for (size_t k = 0; k < edges[e].count && most <= 1e-13 * reach; k++)
            net[3 * (edges[e].first + k * edges[e].step) + 1] = 0;
    }
}

static int is_half_hull(const nurbs_surface *hull)
{
    const double *points = nurbs_surface_points(hull);
    size_t nu = nurbs_surface_size(hull, 0), nv = nurbs_surface_size(hull, 1);
    double low = 0, high = 0;
    for (size_t k = 0; k < nu * nv; k++) {
        low = fmin(low, points[3 * k + 1]);
        high = fmax(high, points[3 * k + 1]);
    }
    return -low <= 0.05 * high;
}

/* Fills the net of all lines. */
static nurbs_status fit_net(build *work)
{
    const size_t size[2] = {work->along[0].size, work->along[1].size};
    free(work->net);
    work->net = malloc(3 * size[0] * size[1] * sizeof(double));
    if (!work->net)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu points", size[0], size[1]);
    nurbs_status status = find_broken(work);
    for (size_t first = 0, last; first < size[1] && status == NURBS_OK; first = last) {
        for (last = first + 1; last < size[1]; last++)
            if (memcmp(work->broken + first * work->kinks, work->broken + last * work->kinks,
                       work->kinks) != 0)
                break;
        status = fit_lines(work, first, last);
    }
    if (status == NURBS_OK)
        status = tensor_solve_across(&work->along[1], size[0], work->sites, work->net);
    if (status == NURBS_OK)
        settle_edges(work);
    return status;
}

/* How far setting control points with y < 0 to y = 0 moves the surface where the basis function of
 * point (i,j) is about largest. */
static double clip_change(const build *work, size_t i, size_t j)
{
    double basis[2][NURBS_MAX_DEGREE + 1], change = 0;
    size_t first[2];
    for (int d = 0; d < 2; d++) {
        const knot_list *list = &work->along[d];
        double greville = 0;
        for (int k = 1; k <= list->degree; k++)
            greville += list->knots[(d ? j : i) + (size_t)k] / list->degree;
        size_t span = nurbs_basis_span(list->degree, list->size, list->knots, greville, NULL);
        nurbs_basis(list->degree, list->knots, span, greville, basis[d]);
        first[d] = span - (size_t)list->degree;
    }
    for (int a = 0; a <= work->along[0].degree; a++)
        for (int b = 0; b <= work->along[1].degree; b++)
            change += basis[0][a] * basis[1][b] *
                      fmax(0, -work->net[3 * ((first[0] + (size_t)a) * work->along[1].size +
                                              first[1] + (size_t)b) +
                                         1]);
    return change;
}

/* Marks the knot intervals about control points that cannot be clipped within `allowed`, in both
 * directions; returns their number. */
static size_t mark_clips(const build *work, double allowed, unsigned char *const parts[2])
{
    size_t marked = 0, columns = work->along[1].size;
    for (size_t i = 0; i < work->along[0].size; i++)
        for (size_t j = 0; j < columns; j++) {
            if (!(work->net[3 * (i * columns + j) + 1] < 0) || !(clip_change(work, i, j) > allowed))
                continue;
            marked++;
            for (int d = 0; d < 2; d++)
                for (size_t k = (d ? j : i) + 1; k < (d ? j : i) + (size_t)work->along[d].degree;
                     k++)
                    parts[d][k] = work->along[d].knots[k + 1] > work->along[d].knots[k] ? 2 : 1;
        }
    return marked;
}

/* Divides the spans about control points that mark_clips() finds; *marked: their number. */
static nurbs_status divide_about_clips(build *work, size_t *marked)
{
    nurbs_status status = NURBS_OK;
    unsigned char *parts[2];
    for (int d = 0; d < 2; d++)
        parts[d] = calloc(work->along[d].size + (size_t)work->along[d].degree + 1, 1);
    *marked = 0;
    if (parts[0] && parts[1])
        *marked = mark_clips(work, 0.3 * work->tolerance, parts);
    else
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for knots");
    for (int d = 0; d < 2 && *marked && status == NURBS_OK; d++)
        status = knot_list_divide(&work->along[d], parts[d]);
    free(parts[0]);
    free(parts[1]);
    return status;
}

/* Gives a half hull a control net with y >= 0, which every later step can keep. First the surface
 * is brought to y >= 0, then what is left of the net is clipped: the net follows the surface closer
 * with every division of its spans, so a few of them make clipping harmless. */
static nurbs_status settle_side(build *work)
{
    enum { DIVISIONS = 3 };
    for (int round = 0;; round++) {
        size_t marked = 0;
        double moved;
        nurbs_status status = raise_to_side(
            work->sections.degree, (const size_t[]){work->along[0].size, work->along[1].size},
            work->along[0].knots, work->along[1].knots, work->net, &moved);
        if (status == NURBS_OK && round < DIVISIONS)
            status = divide_about_clips(work, &marked);
        if (status != NURBS_OK)
            return status;
        if (marked == 0)
            break;
        status = fit_net(work);
        if (status != NURBS_OK)
            return status;
    }
    for (size_t k = 0; k < work->along[0].size * work->along[1].size; k++)
        work->net[3 * k + 1] = fmax(work->net[3 * k + 1], 0);
    return NURBS_OK;
}

static nurbs_status assemble(build *work, nurbs_surface **wetted)
{
    nurbs_status status = fit_net(work);
    if (status == NURBS_OK && is_half_hull(work->sections.hull))
        status = settle_side(work);
    if (status == NURBS_OK)
        status = nurbs_surface_create(
            work->sections.degree, (const size_t[]){work->along[0].size, work->along[1].size},
            work->along[0].knots, work->along[1].knots, work->net, NULL, wetted);
    return status;
}

/* Fits, looks how far the result is from the sections after the last step, and divides the spans in
 * which that is too far, until the tolerance is kept. */
static nurbs_status fit_within(build *work, nurbs_surface **wetted, double *deviation)
{
    enum { ROUNDS = 6 };
    const tensor_map map = {section_points, work};
    for (int round = 0;; round++) {
        unsigned char *parts[2] = {NULL, NULL};
        nurbs_status status = assemble(work, wetted);
        if (status == NURBS_OK)
            status = tensor_measure(&map, *wetted, work->tolerance, parts, deviation);
        bool kept = status == NURBS_OK && *deviation <= work->tolerance;
        if (status == NURBS_OK && !kept && round == ROUNDS)
            status = nurbs_fail(NURBS_ERROR_NUMERIC,
                                "the cut surface cannot be brought nearer to the hull than %.3g m, "
                                "expected %.3g m",
                                *deviation, work->tolerance);
        for (int d = 0; d < 2 && !kept && status == NURBS_OK; d++)
            status = knot_list_divide(&work->along[d], parts[d]);
        free(parts[0]);
        free(parts[1]);
        if (kept || status != NURBS_OK)
            return status;
        nurbs_surface_free(*wetted);
        *wetted = NULL;
    }
}

static nurbs_status cut_surface(const nurbs_surface *hull, double level, double tolerance,
                                nurbs_surface **wetted, double *deviation)
{
    build work = {.tolerance = tolerance};
    nurbs_status status = cut_create(hull, level, &work.sections);
    if (status != NURBS_OK)
        return status;
    status = cut_range(&work.sections, work.range, work.limit);
    if (status == NURBS_OK)
        status = start_u(&work);
    if (status == NURBS_OK)
        status = start_w(&work);
    if (status == NURBS_OK)
        status =
            tensor_refine(&(const tensor_map){section_points, &work}, 0.4 * tolerance, work.along);
    if (status == NURBS_OK)
        status = fit_within(&work, wetted, deviation);
    if (status == NURBS_OK)
        status = nurbs_surface_check_fold(*wetted, NULL);
    if (status != NURBS_OK) {
        nurbs_surface_free(*wetted);
        *wetted = NULL;
    }
    cut_free(&work.sections);
    knot_list_free(&work.along[0]);
    knot_list_free(&work.along[1]);
    free(work.kink);
    free(work.broken);
    free(work.sites);
    free(work.net);
    return status;
}

/* What lies across the centre plane is the hull's own fault and no error of the cut: it is lifted
 * first, so that the tolerance can be kept. */
nurbs_status surface_wetted(const nurbs_surface *hull, double level, double tolerance,
                            nurbs_surface **wetted, double *deviation)
{
    nurbs_surface *lifted = NULL;
    double moved = 0;
    *wetted = NULL;
    *deviation = 0;
    if (!isfinite(level))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "level %g is not finite", level);
    if (!(isfinite(tolerance) && tolerance > 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "tolerance %g, expected a length > 0", tolerance);
    nurbs_status status = NURBS_OK;
    if (!nurbs_surface_weights(hull) && is_half_hull(hull))
        status = nurbs_surface_raise_side(hull, &lifted, &moved);
    if (status == NURBS_OK)
        status = cut_surface(moved > 0 ? lifted : hull, level, tolerance, wetted, deviation);
    nurbs_surface_free(lifted);
    return status;
}

nurbs_status nurbs_surface_wetted(const nurbs_surface *hull, double level, double tolerance,
                                  nurbs_surface **wetted)
{
    NURBS_NEED(hull && wetted);
    double deviation;
    return surface_wetted(hull, level, tolerance, wetted, &deviation);
}
