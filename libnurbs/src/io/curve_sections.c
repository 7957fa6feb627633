/* Sections that a file of curves holds. */
#include "core/error.h"
#include "core/vector.h"
#include "io/sections.h"

#include <nurbs/io.h>
#include <nurbs/offsets.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { GRID_COLUMNS = 40, PER_SPAN = 24 };

/* Of the extent of all curves: how far a section may run in x; within how much ends meet, pieces
 * lie in one section and points lie in the centre plane. */
static const double runs = 0.05, meets = 1e-4;

/* A polyline, from deck to keel when it is finished. */
typedef struct piece {
    size_t n;
    double *points;
    double x, low, high; /* mean and range of x */
} piece;

static void pieces_free(size_t n, piece *p)
{
    for (size_t k = 0; p && k < n; k++)
        free(p[k].points);
    free(p);
}

/* The points of a polyline, samples of any other curve. */
static nurbs_status sample(const nurbs_curve *curve, piece *p)
{
    size_t size = nurbs_curve_size(curve), degree = (size_t)nurbs_curve_degree(curve), n = 0;
    const double *t = nurbs_curve_knots(curve);
    double *u = malloc((size * PER_SPAN + 1) * sizeof *u);
    p->points = malloc(3 * (size * PER_SPAN + 1) * sizeof *p->points);
    if (!u || !p->points) {
        free(u);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a curve of %zu points", size);
    }
    for (size_t k = degree; k < size; k++)
        for (size_t s = 0; s < (degree > 1 ? PER_SPAN : 1) && t[k + 1] > t[k]; s++)
            u[n++] = t[k] + (t[k + 1] - t[k]) * ((double)s / PER_SPAN);
    u[n++] = t[size];
    p->n = n;
    nurbs_status status = nurbs_curve_eval(curve, 0, n, u, p->points);
    free(u);
    return status;
}

static void measure(piece *p)
{
    p->low = INFINITY;
    p->high = -INFINITY;
    for (size_t k = 0; k < p->n; k++) {
        p->low = fmin(p->low, p->points[3 * k]);
        p->high = fmax(p->high, p->points[3 * k]);
    }
    p->x = 0.5 * (p->low + p->high);
}

static void reverse(piece *p)
{
    for (size_t a = 0, b = p->n - 1; p->n > 0 && a < b; a++, b--) {
        double swapped[3];
        memcpy(swapped, p->points + 3 * a, sizeof swapped);
        memcpy(p->points + 3 * a, p->points + 3 * b, sizeof swapped);
        memcpy(p->points + 3 * b, swapped, sizeof swapped);
    }
}

/* What lies at y >= 0, from its first to its last crossing. */
static nurbs_status take_port(piece *p, double near)
{
    double *port = malloc(3 * (p->n + 2) * sizeof *port);
    size_t n = 0;
    if (!port)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section of %zu points", p->n);
    for (size_t k = 0; k < p->n; k++) {
        const double *q = p->points + 3 * k, *last = q - 3;
        if (k > 0 && n < p->n + 1 && (q[1] < -near) != (last[1] < -near) && last[1] != q[1]) {
            double s = fmin(fmax(last[1] / (last[1] - q[1]), 0), 1);
            for (size_t c = 0; c < 3; c++)
                port[3 * n + c] = c == 1 ? 0 : last[c] + s * (q[c] - last[c]);
            n++;
        }
        if (q[1] >= -near) {
            memcpy(port + 3 * n, q, 3 * sizeof *port);
            port[3 * n + 1] = fabs(q[1]) <= near ? 0 : q[1];
            n++;
        }
    }
    free(p->points);
    p->points = port;
    p->n = n;
    return NURBS_OK;
}

/* Whether an end of b meets an end of a; both are turned so that b goes on where a ends. */
static bool follows(piece *a, piece *b, double near)
{
    for (int turn = 0; turn < 4; turn++) {
        if (distance3(a->points + 3 * (a->n - 1), b->points) <= near)
            return true;
        reverse(turn % 2 ? a : b);
    }
    return false;
}

static nurbs_status join(piece *a, piece *b)
{
    double *both = realloc(a->points, 3 * (a->n + b->n) * sizeof *both);
    if (!both)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section of %zu points", a->n + b->n);
    a->points = both;
    memcpy(both + 3 * a->n, b->points + 3, 3 * (b->n - 1) * sizeof *both);
    a->n += b->n - 1;
    b->n = 0;
    measure(a);
    return NURBS_OK;
}

/* Pieces of one section that meet become one. */
static nurbs_status join_all(size_t n, piece *p, double near)
{
    nurbs_status status = NURBS_OK;
    for (bool more = true; more && !status;) {
        more = false;
        for (size_t a = 0; a < n && !status; a++)
            for (size_t b = a + 1; b < n && p[a].n && !status; b++)
                if (p[b].n && fabs(p[a].x - p[b].x) <= near && follows(&p[a], &p[b], near)) {
                    status = join(&p[a], &p[b]);
                    more = true;
                }
    }
    return status;
}

/* Keeps the curves that are sections, their port halves. */
static nurbs_status clean(size_t n, piece *p, size_t *left_out, double *near)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t k = 0; k < n; k++) {
        measure(&p[k]);
        for (size_t i = 0; i < 3 * p[k].n; i++) {
            low[i % 3] = fmin(low[i % 3], p[k].points[i]);
            high[i % 3] = fmax(high[i % 3], p[k].points[i]);
        }
    }
    double extent = high[0] - low[0];
    *near = meets * extent;
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < n && !status; k++) {
        if (p[k].high - p[k].low > runs * extent) {
            p[k].n = 0;
            ++*left_out;
            continue;
        }
        if (high[1] <= *near)
            for (size_t i = 0; i < p[k].n; i++)
                p[k].points[3 * i + 1] *= -1;
        status = take_port(&p[k], *near);
        if (p[k].n < 2)
            p[k].n = 0;
    }
    return status;
}

static nurbs_status fill_list(const char *path, size_t n, piece *p, double near, section_list *list)
{
    for (size_t k = 0; k < n; k++) {
        if (p[k].n == 0)
            continue;
        for (size_t i = 0; i < k; i++)
            if (p[i].n && fabs(p[i].x - p[k].x) <= near)
                return nurbs_fail(NURBS_ERROR_GEOMETRY,
                                  "%s: two curves of the section at x = %.6g m do not meet: "
                                  "expected one, or pieces whose ends lie within %.3g m",
                                  path, p[k].x, near);
        if (p[k].points[2] < p[k].points[3 * p[k].n - 1])
            reverse(&p[k]);
        /* A narrow section from side to side comes up again in the centre plane. */
        for (const double *last = p[k].points + 3 * (p[k].n - 1);
             p[k].n > 2 && last[1] == 0 && last[-2] == 0 && last[2] > last[-1]; last -= 3)
            p[k].n--;
        section *s = section_append(list, p[k].n);
        if (!s)
            return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu sections", path,
                              list->count);
        s->x = p[k].x;
        s->count = p[k].n;
        memcpy(s->points, p[k].points, 3 * p[k].n * sizeof *p[k].points);
    }
    if (list->count < 2)
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "%s: %zu curves, %zu sections among them, expected two or more: curves "
                          "that keep within %g of the length in x",
                          path, n, list->count, runs);
    return NURBS_OK;
}

nurbs_status nurbs_sections_read_iges(const char *path, size_t columns, nurbs_grid **grid,
                                      size_t *left_out)
{
    size_t n = 0, chine, others = 0;
    nurbs_curve **curves = NULL;
    section_list list = {0};
    double near = 0;
    if (!path || !grid)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no path or no grid");
    *grid = NULL;
    nurbs_status status = nurbs_curves_read_iges(path, &n, &curves);
    piece *pieces = calloc(n + 1, sizeof *pieces);
    if (!status && !pieces)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu curves", path, n);
    for (size_t k = 0; k < n && !status; k++)
        status = sample(curves[k], &pieces[k]);
    if (!status)
        status = clean(n, pieces, &others, &near);
    if (!status)
        status = join_all(n, pieces, near);
    if (!status)
        status = fill_list(path, n, pieces, near, &list);
    if (!status)
        status = section_list_grid(&list, path, columns, GRID_COLUMNS, grid, &chine);
    if (left_out)
        *left_out = others;
    section_list_free(&list);
    pieces_free(n, pieces);
    nurbs_curves_free(n, curves);
    return status;
}
