/* Free-surface elevation zeta = (U/g) phi_x at z = 0 (docs/theory.md, section 8). On z = 0 the
 * Rankine terms cancel and phi_x = (k0^2/4 pi) Sum q (N_X + W_X) over surface and line sources. */
#include "core/constants.h"
#include "core/error.h"
#include "result/elevation_march.h"
#include "result/elevation_surface.h"
#include "result/elevation_tree.h"
#include "result/radiation.h"
#include "solve/resolution.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { EDGE_POINTS = 513 /* of the polyline that stands for a waterline edge */ };

/* Filtered waves beyond 1.9 t_c carry less than e^-13. */
static const double FILTER_REACH = 1.9;

struct segment {
    double a[2], b[2];
};

struct waterplane {
    size_t n;
    struct segment *segment;
    bool symmetric;
};

struct field {
    const igabem_solution *solution;
    struct elevation_pieces *pieces;
    struct point_set set;
    size_t *first;  /* sources of piece i: first[i] .. first[i+1] */
    size_t *by_bow; /* pieces by decreasing aft end */
    struct elevation_tree *tree;
    struct elevation_march *march;
    struct waterplane waterplane;
};

static igabem_status trace_waterplane(const igabem_solution *solution, struct waterplane *plane)
{
    const struct density *density = solution->density;
    plane->symmetric = density->symmetric;
    plane->segment = malloc(density->patches * HULL_EDGES * EDGE_POINTS * sizeof *plane->segment);
    if (!plane->segment)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the waterplane");
    for (size_t p = 0; p < density->patches; p++)
        for (int e = 0; e < HULL_EDGES; e++) {
            const struct hull_patch *patch = &density->patch[p].hull;
            double last[3] = {0, 0, 0};
            for (int i = 0; patch->edge[e] == HULL_EDGE_WATERLINE && i < EDGE_POINTS; i++) {
                double uv[2], at[3];
                hull_edge_parameters(patch, e, i / (EDGE_POINTS - 1.0), uv);
                nurbs_status status = nurbs_surface_eval(patch->surface, 0, 1, uv, at);
                if (status)
                    return hull_nurbs_fail(status, "the waterline");
                if (i > 0)
                    plane->segment[plane->n++] =
                        (struct segment){{last[0], last[1]}, {at[0], at[1]}};
                memcpy(last, at, sizeof last);
            }
        }
    return IGABEM_OK;
}

/* Even-odd rule along +y from the point; the centre plane closes a half hull. */
static bool inside_waterplane(const struct waterplane *plane, double x, double y)
{
    int inside = 0;
    double side = plane->symmetric ? fabs(y) : y;
    for (size_t i = 0; i < plane->n; i++) {
        const struct segment *s = &plane->segment[i];
        if ((s->a[0] <= x) == (s->b[0] <= x))
            continue;
        double at = s->a[1] + (s->b[1] - s->a[1]) * (x - s->a[0]) / (s->b[0] - s->a[0]);
        inside ^= at > side;
    }
    return inside;
}

/* Largest wave angle of the field: what the filter, or else the depth, leaves. */
static double field_limit(const igabem_solution *solution)
{
    double t_c = radiation_cutoff_angle(solution), limit = radiation_limit(solution);
    if (t_c > 0)
        return fmin(limit, FILTER_REACH * t_c);
    /* The limit is that of |H|^2 with its double decay. */
    return solution->info.surface_piercing ? limit : sqrt(2.0) * limit;
}

static igabem_status place_sources(struct field *field)
{
    struct elevation_pieces *pieces = field->pieces;
    field->first = malloc((pieces->n + 1) * sizeof *field->first);
    field->by_bow = malloc(pieces->n * sizeof *field->by_bow);
    if (!field->first || !field->by_bow)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu elements", pieces->n);
    for (size_t i = 0; i < pieces->n; i++) {
        struct elevation_piece *piece = &pieces->piece[i];
        field->first[i] = field->set.n;
        field->by_bow[i] = i;
        if (!elevation_piece_sources(pieces, i, NAN, &field->set))
            return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the sources of the hull");
        const double *at[3] = {field->set.x, field->set.y, field->set.z};
        for (size_t j = field->first[i]; j < field->set.n; j++)
            for (int k = 0; k < 3; k++) {
                piece->lower[k] = fmin(piece->lower[k], at[k][j]);
                piece->upper[k] = fmax(piece->upper[k], at[k][j]);
            }
    }
    field->first[pieces->n] = field->set.n;
    for (size_t i = 1; i < pieces->n; i++) /* insertion sort: few hundred, nearly ordered */
        for (size_t j = i; j > 0 && pieces->piece[field->by_bow[j]].lower[0] >
                                        pieces->piece[field->by_bow[j - 1]].lower[0];
             j--) {
            size_t swap = field->by_bow[j];
            field->by_bow[j] = field->by_bow[j - 1];
            field->by_bow[j - 1] = swap;
        }
    return IGABEM_OK;
}

static void field_free(struct field *field)
{
    elevation_tree_free(field->tree);
    elevation_march_free(field->march);
    elevation_pieces_free(field->pieces);
    point_set_free(&field->set);
    free(field->first);
    free(field->by_bow);
    free(field->waterplane.segment);
}

/* reach: largest offsets from the sources along and across. */
static igabem_status field_create(const igabem_solution *solution, const double reach[2],
                                  struct field *field)
{
    *field = (struct field){.solution = solution};
    double t_max = field_limit(solution);
    igabem_status status = trace_waterplane(solution, &field->waterplane);
    if (!status)
        status = elevation_pieces_create(solution, t_max, &field->pieces);
    if (!status)
        status = place_sources(field);
    if (!status)
        status = elevation_tree_create(field->pieces, &field->set, field->first, &field->tree);
    if (!status)
        status =
            elevation_march_create(solution->k0, solution->density->symmetric, reach[0], reach[1],
                                   t_max, radiation_cutoff_angle(solution), &field->march);
    if (status)
        field_free(field);
    return status;
}

/* A line of equal x in the caller's points. */
struct line {
    double x;
    size_t index; /* of the point */
};

static int from_bow(const void *a, const void *b)
{
    const struct line *la = a, *lb = b;
    if (la->x != lb->x)
        return la->x < lb->x ? 1 : -1;
    return (la->index > lb->index) - (la->index < lb->index);
}

/* Sources ahead of x in the pieces that x cuts. */
static bool sources_ahead(const struct point_set *cut, double x, struct point_set *ahead)
{
    point_set_clear(ahead);
    for (size_t j = 0; j < cut->n; j++)
        if (cut->x[j] > x && !point_set_add(ahead, cut->x[j], cut->y[j], cut->z[j], cut->q[j]))
            return false;
    return true;
}

struct line_work {
    double *even, *odd;
    struct elevation_cut cut;
    struct point_set ahead;
};

/* Elevation at the points lines[0..n), all on one x. */
static igabem_status elevate_line(struct field *field, struct line_work *work, size_t n,
                                  const struct line *lines, const double *y, double *zeta)
{
    const igabem_solution *solution = field->solution;
    double x = lines[0].x, k0 = solution->k0;
    double scale = solution->speed / solution->options.gravity * k0 * k0 / (4.0 * PI);
    if (!elevation_cut_line(field->pieces, x, &work->cut) ||
        !sources_ahead(&work->cut.set, x, &work->ahead))
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the sources near x = %g", x);
    elevation_march_line(field->march, x, &work->ahead, work->even, work->odd);
    igabem_status status = IGABEM_OK;
#pragma omp parallel
    {
        struct point_set scratch = {0};
#pragma omp for schedule(dynamic, 1)
        for (size_t i = 0; i < n; i++) {
            size_t at = lines[i].index;
            double local;
            zeta[at] = NAN;
            if (inside_waterplane(&field->waterplane, x, y[at]))
                continue;
            igabem_status failed =
                elevation_tree_local(field->tree, &work->cut, k0, solution->density->symmetric, x,
                                     y[at], &scratch, &local);
            if (failed) {
#pragma omp critical(igabem_elevation)
                status = failed;
                continue;
            }
            double wave = elevation_march_value(field->march, work->even, work->odd, y[at]);
            zeta[at] = scale * (local + 4.0 * wave);
        }
        point_set_free(&scratch);
    }
    if (status)
        return igabem_fail(status, "the wave elevation on the line x = %g m failed: %s", x,
                           igabem_status_string(status));
    return IGABEM_OK;
}

/* Adds to the running sums the pieces that now lie ahead of x, from the next one on. */
static bool advance(struct field *field, double x, size_t *next, struct point_set *batch)
{
    point_set_clear(batch);
    for (; *next < field->pieces->n; ++*next) {
        size_t piece = field->by_bow[*next];
        if (field->pieces->piece[piece].lower[0] < x)
            break;
        for (size_t j = field->first[piece]; j < field->first[piece + 1]; j++)
            if (!point_set_add(batch, field->set.x[j], field->set.y[j], field->set.z[j],
                               field->set.q[j]))
                return false;
    }
    elevation_march_add(field->march, batch, 0, batch->n);
    return true;
}

static igabem_status march(struct field *field, size_t n, const struct line *lines, const double *y,
                           double *zeta)
{
    struct line_work work = {.even = malloc(field->march->n * sizeof(double)),
                             .odd = malloc(field->march->n * sizeof(double))};
    igabem_status status = elevation_cut_create(field->pieces->n, &work.cut);
    if (!status && (!work.even || !work.odd))
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu wave angles", field->march->n);
    size_t next = 0; /* pieces not yet in the running sums */
    for (size_t begin = 0, end; !status && begin < n; begin = end) {
        for (end = begin + 1; end < n && lines[end].x == lines[begin].x; end++)
            continue;
        if (!advance(field, lines[begin].x, &next, &work.ahead))
            status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the sources of the hull");
        else
            status = elevate_line(field, &work, end - begin, lines + begin, y, zeta);
    }
    free(work.even);
    free(work.odd);
    elevation_cut_free(&work.cut);
    point_set_free(&work.ahead);
    return status;
}

static igabem_status check_request(const igabem_solution *solution, size_t n, const double *x,
                                   const double *y, const double *zeta)
{
    if (!solution || (n && (!x || !y || !zeta)))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_wave_elevation");
    if (!solution->waves)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "this solution has no free surface, expected the Kelvin kernel");
    for (size_t i = 0; i < n; i++)
        if (!isfinite(x[i]) || !isfinite(y[i]))
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "point %zu is (%g, %g), expected finite coordinates", i, x[i], y[i]);
    return IGABEM_OK;
}

igabem_status igabem_wave_elevation(const igabem_solution *solution, size_t n, const double *x,
                                    const double *y, double *zeta)
{
    igabem_status status = check_request(solution, n, x, y, zeta);
    if (status || n == 0)
        return status;
    THREADS(solution->options.threads);
    if (solution->potential)
        return elevation_surface(solution, n, x, y, zeta);
    struct line *lines = malloc(n * sizeof *lines);
    if (!lines)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu points", n);
    double length, beam, aftmost = INFINITY, foremost = -INFINITY, side = 0.0;
    radiation_extent(solution, &length, &beam);
    for (size_t i = 0; i < n; i++) {
        lines[i] = (struct line){x[i], i};
        aftmost = fmin(aftmost, x[i]);
        foremost = fmax(foremost, x[i]);
        side = fmax(side, fabs(y[i]));
    }
    qsort(lines, n, sizeof *lines, from_bow);
    double reach[2] = {fmax(length, solution->x_fore - aftmost), side + 0.5 * beam};
    struct field field;
    double farthest = fmax(fmax(reach[0], reach[1]), foremost - solution->x_fore);
    status = resolution_check_distance(solution->k0, farthest);
    if (!status)
        status = field_create(solution, reach, &field);
    if (!status) {
        status = march(&field, n, lines, y, zeta);
        field_free(&field);
    }
    free(lines);
    return status;
}
