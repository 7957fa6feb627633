/* The wetted hull: the cut sections T(u,w) of cut.h interpolated by a tensor spline.
 *
 * Along w the knots of the hull are carried over at the mean crossing, along u the hull's own knots
 * are kept; spans of either direction are halved until the spline follows T within a part of the
 * tolerance inside every span. Where the hull may break (u knots of full multiplicity)
 * only those lines w = constant break that have a kink there. */
#include "cut.h"
#include "error.h"
#include "interpolate.h"
#include "knot_list.h"
#include "sides.h"
#include <nurbs/basis.h>
#include <nurbs/section.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 12 };

typedef struct build {
    cut sections;
    double target;   /* metres: allowed deviation along one direction */
    double range[2]; /* of u */
    double limit[2]; /* crossing at an end that is a point, else -1 */
    knot_list along[2];
    size_t kinks;
    double *kink;          /* u knots where the hull may break */
    unsigned char *broken; /* [columns][kinks] */
    double *sites;         /* Greville points w */
    double *net;           /* the result: [u][w][3] */
} build;

/* The section at u: T(u, w[n]) with points `stride` numbers apart. */
static nurbs_status sample_section(build *work, double u, size_t n, const double *w, double *out)
{
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

/* Fills out[n[0]][n[1]][3] with T(u, w), or out[n[1]][n[0]][3] when `lengthwise` is 1: rows along
 * the direction of refinement come first. */
static nurbs_status sample(build *work, int lengthwise, const size_t n[2],
                           const double *const parameters[2], double *out)
{
    if (!lengthwise) {
        for (size_t i = 0; i < n[0]; i++) {
            nurbs_status status =
                sample_section(work, parameters[0][i], n[1], parameters[1], out + 3 * n[1] * i);
            if (status != NURBS_OK)
                return status;
        }
        return NURBS_OK;
    }
    double *line = malloc(3 * n[1] * sizeof *line);
    nurbs_status status =
        line ? NURBS_OK : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section");
    for (size_t i = 0; i < n[0] && status == NURBS_OK; i++) {
        status = sample_section(work, parameters[0][i], n[1], parameters[1], line);
        for (size_t j = 0; j < n[1]; j++)
            memcpy(out + 3 * (j * n[0] + i), line + 3 * j, 3 * sizeof *out);
    }
    free(line);
    return status;
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

/* Interpolates rows[list->size][m] given at the sites, in place. */
static nurbs_status interpolate_rows(int degree, size_t n, const double *knots, const double *sites,
                                     size_t m, double *rows)
{
    banded factors;
    nurbs_status status = collocation_factor(degree, n, knots, sites, &factors);
    if (status == NURBS_OK) {
        banded_solve(&factors, m, rows);
        banded_free(&factors);
    }
    return status;
}

/* Largest distance between the splines rows[list->size][3n] at t and the points [n][3]. */
static double row_error(const knot_list *list, double t, size_t n, const double *rows,
                        const double *points)
{
    double basis[NURBS_MAX_DEGREE + 1], worst = 0;
    size_t p = (size_t)list->degree,
           span = nurbs_basis_span(list->degree, list->size, list->knots, t, NULL);
    nurbs_basis(list->degree, list->knots, span, t, basis);
    rows += (span - p) * 3 * n;
    for (size_t k = 0; k < 3 * n; k += 3) {
        double square = 0;
        for (size_t c = k; c < k + 3; c++) {
            double difference = -points[c];
            for (size_t a = 0; a <= p; a++)
                difference += basis[a] * rows[a * 3 * n + c];
            square += difference * difference;
        }
        worst = fmax(worst, square);
    }
    return sqrt(worst);
}

/* Where knot interval k is checked, far from the interpolation points: those of odd degrees lie
 * near the knots, those of even degrees near the middles of the spans. Returns the number of
 * places. */
static size_t check_places(const knot_list *list, size_t k, double *places)
{
    double length = list->knots[k + 1] - list->knots[k];
    size_t count = list->degree % 2 ? 1 : 2;
    if (!(length > 0))
        return 0;
    for (size_t c = 0; places && c < count; c++)
        places[c] = list->knots[k] + length * (count == 1 ? 0.5 : c ? 0.8 : 0.2);
    return count;
}

/* One direction: splines through T at its Greville points, on the n lines `across` of the other
 * direction; halves the spans that are off and counts them. */
static nurbs_status refine_once(build *work, int direction, size_t n, const double *across,
                                size_t *halved)
{
    knot_list *list = &work->along[direction];
    size_t intervals = list->size + (size_t)list->degree, m = 3 * n, count = list->size, checks = 0;
    double *sites = malloc((count + 2 * intervals) * (1 + m) * sizeof *sites);
    unsigned char *split = calloc(intervals, 1);
    *halved = 0;
    if (!sites || !split) {
        free(sites);
        free(split);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to fit %zu sections", count);
    }
    double *places = sites + count, *rows = places + 2 * intervals, *points = rows + count * m;
    nurbs_greville(list->degree, count, list->knots, sites);
    for (size_t k = 0; k < intervals; k++)
        checks += check_places(list, k, places + checks);
    const size_t at[2] = {direction ? n : count, direction ? count : n},
                 between[2] = {direction ? n : checks, direction ? checks : n};
    nurbs_status status = sample(
        work, direction, at,
        (const double *const[]){direction ? across : sites, direction ? sites : across}, rows);
    if (status == NURBS_OK)
        status = sample(
            work, direction, between,
            (const double *const[]){direction ? across : places, direction ? places : across},
            points);
    if (status == NURBS_OK)
        status = interpolate_rows(list->degree, count, list->knots, sites, m, rows);
    for (size_t k = 0, c = 0; k < intervals && status == NURBS_OK; k++) {
        for (size_t last = c + check_places(list, k, NULL); c < last; c++)
            split[k] |= row_error(list, places[c], n, rows, points + c * m) > work->target;
        *halved += split[k];
    }
    if (status == NURBS_OK && *halved)
        status = knot_list_halve(list, split, *halved);
    free(sites);
    free(split);
    return status;
}

static nurbs_status refine(build *work)
{
    nurbs_status status = NURBS_OK;
    for (int direction = 1; direction >= 0 && status == NURBS_OK; direction--) {
        const knot_list *other = &work->along[!direction];
        double *across = malloc(other->size * sizeof *across);
        if (!across)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu parameters", other->size);
        nurbs_greville(other->degree, other->size, other->knots, across);
        size_t halved = 1;
        for (int round = 0; round < ROUNDS && halved && status == NURBS_OK; round++)
            status = refine_once(work, direction, other->size, across, &halved);
        free(across);
    }
    return status;
}

/* Which lines w = constant have a kink at which of the hull's breaks. */
static nurbs_status find_broken(build *work)
{
    size_t n = work->along[1].size;
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
    nurbs_status status = sample(work, 0, (const size_t[]){n, last - first},
                                 (const double *const[]){sites, work->sites + first}, rows);
    if (status == NURBS_OK)
        status = interpolate_rows(list->degree, n, knots, sites, m, rows);
    for (size_t k = 0; k < list->size + p + 1 && status == NURBS_OK; k++)
        if (k >= n + p + 1 || knots[k] != list->knots[k])
            spline_insert_rows(list->degree, &n, knots, m, rows, list->knots[k]);
    for (size_t i = 0; i < list->size && status == NURBS_OK; i++)
        memcpy(work->net + 3 * (i * columns + first), rows + i * m, m * sizeof *rows);
    free(knots);
    return status;
}

/* Across the lines: replaces the points at the w sites by control points. */
static nurbs_status fit_sections(build *work)
{
    size_t rows = work->along[0].size, columns = work->along[1].size;
    double *turned = malloc(3 * rows * columns * sizeof *turned);
    if (!turned)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu points", rows, columns);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++)
            memcpy(turned + 3 * (j * rows + i), work->net + 3 * (i * columns + j),
                   3 * sizeof *turned);
    nurbs_status status = interpolate_rows(work->along[1].degree, columns, work->along[1].knots,
                                           work->sites, 3 * rows, turned);
    for (size_t i = 0; i < rows && status == NURBS_OK; i++)
        for (size_t j = 0; j < columns; j++)
            memcpy(work->net + 3 * (i * columns + j), turned + 3 * (j * rows + i),
                   3 * sizeof *turned);
    free(turned);
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

static nurbs_status assemble(build *work, nurbs_surface **wetted)
{
    const size_t size[2] = {work->along[0].size, work->along[1].size};
    double moved;
    work->net = malloc(3 * size[0] * size[1] * sizeof(double));
    if (!work->net)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu points", size[0], size[1]);
    nurbs_status status = NURBS_OK;
    for (size_t first = 0, last; first < size[1] && status == NURBS_OK; first = last) {
        for (last = first + 1; last < size[1]; last++)
            if (memcmp(work->broken + first * work->kinks, work->broken + last * work->kinks,
                       work->kinks) != 0)
                break;
        status = fit_lines(work, first, last);
    }
    if (status == NURBS_OK)
        status = fit_sections(work);
    if (status != NURBS_OK)
        return status;
    settle_edges(work);
    if (is_half_hull(work->sections.hull))
        status = raise_to_side(work->sections.degree, size, work->along[0].knots,
                               work->along[1].knots, work->net, &moved);
    if (status == NURBS_OK)
        status = nurbs_surface_create(work->sections.degree, size, work->along[0].knots,
                                      work->along[1].knots, work->net, NULL, wetted);
    return status;
}

nurbs_status nurbs_surface_wetted(const nurbs_surface *hull, double level, double tolerance,
                                  nurbs_surface **wetted)
{
    build work = {.target = tolerance / 2};
    *wetted = NULL;
    if (!isfinite(level))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "level %g is not finite", level);
    if (!(isfinite(tolerance) && tolerance > 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "tolerance %g, expected a length > 0", tolerance);
    nurbs_status status = cut_create(hull, level, &work.sections);
    if (status != NURBS_OK)
        return status;
    status = cut_range(&work.sections, work.range, work.limit);
    if (status == NURBS_OK)
        status = start_u(&work);
    if (status == NURBS_OK)
        status = start_w(&work);
    if (status == NURBS_OK)
        status = refine(&work);
    if (status == NURBS_OK)
        status = find_broken(&work);
    if (status == NURBS_OK)
        status = assemble(&work, wetted);
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
