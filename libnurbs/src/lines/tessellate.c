/* Triangles of patches. */
#include "core/error.h"
#include "core/vector.h"

#include <nurbs/sections.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { PROBES = 4, MOST_PARTS = 64 };

static const size_t most_triangles = 200000;

/* Parameters of a patch: every knot span of a direction in parts of its own. */
typedef struct nodes {
    size_t n[2];
    double *t[2];
} nodes;

typedef struct soup {
    size_t vertices, triangles;
    double *points;
    size_t *corner;
} soup;

static void nodes_free(nodes *s)
{
    free(s->t[0]);
    free(s->t[1]);
    *s = (nodes){0};
}

static size_t spans_of(const nurbs_surface *surface, int d)
{
    const double *t = nurbs_surface_knots(surface, d);
    size_t spans = 0;
    for (size_t k = (size_t)nurbs_surface_degree(surface, d); k < nurbs_surface_size(surface, d);
         k++)
        spans += t[k + 1] > t[k];
    return spans;
}

/* Every knot span in as many parts as parts[span] says; NULL: in PROBES. */
static nurbs_status divide(const nurbs_surface *surface, int d, const size_t *parts, nodes *out)
{
    const double *knots = nurbs_surface_knots(surface, d);
    size_t size = nurbs_surface_size(surface, d), span = 0, total = 1;
    for (size_t k = 0; k < spans_of(surface, d); k++)
        total += parts ? parts[k] : PROBES;
    double *t = malloc(total * sizeof *t);
    if (!t)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu parameters", total);
    out->t[d] = t;
    out->n[d] = 0;
    for (size_t k = (size_t)nurbs_surface_degree(surface, d); k < size; k++) {
        if (!(knots[k + 1] > knots[k]))
            continue;
        size_t n = parts ? parts[span] : PROBES;
        for (size_t s = 0; s < n; s++)
            t[out->n[d]++] = knots[k] + (knots[k + 1] - knots[k]) * ((double)s / (double)n);
        span++;
    }
    t[out->n[d]++] = knots[size];
    return NURBS_OK;
}

/* Raises bend[span] to the distances of nodes inside it from the middle of their neighbours: four
 * times the sag of a chord of their step. */
static void find_bends(const double *p, const nodes *s, int d, double *bend)
{
    size_t step = d ? 1 : s->n[1];
    for (size_t i = 0; i < s->n[0]; i++)
        for (size_t j = 0; j < s->n[1]; j++) {
            size_t at = d ? j : i;
            const double *q = p + 3 * (i * s->n[1] + j);
            double away[3];
            if (at % PROBES == 0)
                continue;
            for (int c = 0; c < 3; c++)
                away[c] = 0.5 * ((q - 3 * step)[c] + (q + 3 * step)[c]) - q[c];
            bend[at / PROBES] = fmax(bend[at / PROBES], norm3(away));
        }
}

/* How many parts the spans of both directions need: parts[0 ... spans u - 1], then those of v. */
static nurbs_status choose_parts(const nurbs_surface *surface, double tolerance, size_t *parts)
{
    nodes probes = {0};
    size_t spans[2] = {spans_of(surface, 0), spans_of(surface, 1)};
    double *bend = calloc(spans[0] + spans[1], sizeof *bend), *points = NULL;
    nurbs_status status = bend ? divide(surface, 0, NULL, &probes)
                               : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the bends");
    if (!status)
        status = divide(surface, 1, NULL, &probes);
    if (!status) {
        points = malloc(3 * probes.n[0] * probes.n[1] * sizeof *points);
        status = points ? nurbs_surface_eval_grid(surface, 0, probes.n[0], probes.t[0], probes.n[1],
                                                  probes.t[1], points)
                        : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the samples");
    }
    for (int d = 0; d < 2 && !status; d++) {
        double *own = bend + (d ? spans[0] : 0);
        find_bends(points, &probes, d, own);
        for (size_t k = 0; k < spans[d]; k++) {
            double wanted = ceil(PROBES * sqrt(0.25 * own[k] / tolerance)),
                   least = spans[d] < PROBES ? PROBES : 1;
            parts[(d ? spans[0] : 0) + k] = (size_t)fmin(fmax(wanted, least), MOST_PARTS);
        }
    }
    nodes_free(&probes);
    free(bend);
    free(points);
    return status;
}

static nurbs_status add_patch(const nurbs_surface *surface, const size_t *parts, soup *s)
{
    nodes t = {0};
    size_t first = s->vertices;
    nurbs_status status = divide(surface, 0, parts, &t);
    if (!status)
        status = divide(surface, 1, parts + spans_of(surface, 0), &t);
    if (!status)
        status = nurbs_surface_eval_grid(surface, 0, t.n[0], t.t[0], t.n[1], t.t[1],
                                         s->points + 3 * s->vertices);
    for (size_t i = 0; i + 1 < t.n[0] && !status; i++)
        for (size_t j = 0; j + 1 < t.n[1]; j++) {
            size_t a = first + i * t.n[1] + j, b = a + t.n[1], *to = s->corner + 3 * s->triangles;
            const size_t two[6] = {a, b, b + 1, a, b + 1, a + 1};
            for (int k = 0; k < 6; k++)
                to[k] = two[k];
            s->triangles += 2;
        }
    s->vertices += t.n[0] * t.n[1];
    nodes_free(&t);
    return status;
}

/* Adds what a patch takes. */
static void count_cells(const nurbs_surface *surface, const size_t *parts, size_t *vertices,
                        size_t *triangles)
{
    size_t n[2] = {0, 0}, at = 0;
    for (int d = 0; d < 2; d++)
        for (size_t k = 0; k < spans_of(surface, d); k++)
            n[d] += parts[at++];
    *vertices += (n[0] + 1) * (n[1] + 1);
    *triangles += 2 * n[0] * n[1];
}

/* Parts of all patches, one after the other, coarser until the triangles are few enough. */
static nurbs_status plan(const nurbs_patches *patches, double tolerance, size_t *parts, soup *s)
{
    size_t count = nurbs_patches_count(patches);
    for (;; tolerance *= 1.5) {
        size_t at = 0;
        s->vertices = s->triangles = 0;
        for (size_t k = 0; k < count; k++) {
            const nurbs_surface *surface = nurbs_patches_get(patches, k);
            nurbs_status status = choose_parts(surface, tolerance, parts + at);
            if (status)
                return status;
            count_cells(surface, parts + at, &s->vertices, &s->triangles);
            at += spans_of(surface, 0) + spans_of(surface, 1);
        }
        bool coarsest = true;
        for (size_t k = 0; k < at; k++)
            coarsest &= parts[k] <= PROBES;
        if (s->triangles <= most_triangles || coarsest)
            return NURBS_OK;
    }
}

nurbs_status nurbs_patches_mesh(const nurbs_patches *patches, double tolerance, nurbs_mesh **mesh)
{
    if (!patches || !mesh)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "patches or mesh is NULL");
    *mesh = NULL;
    size_t count = nurbs_patches_count(patches), spans = 0;
    if (count == 0 || !(tolerance > 0 && isfinite(tolerance)))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%zu patches, tolerance %g m: expected some, > 0",
                          count, tolerance);
    for (size_t k = 0; k < count; k++)
        spans +=
            spans_of(nurbs_patches_get(patches, k), 0) + spans_of(nurbs_patches_get(patches, k), 1);
    soup s = {0};
    size_t *parts = malloc(spans * sizeof *parts), at = 0;
    nurbs_status status = parts ? plan(patches, tolerance, parts, &s)
                                : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu spans", spans);
    if (!status) {
        s.points = malloc(3 * s.vertices * sizeof *s.points);
        s.corner = malloc(3 * s.triangles * sizeof *s.corner);
        if (!s.points || !s.corner)
            status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu triangles", s.triangles);
    }
    s.vertices = s.triangles = 0;
    for (size_t k = 0; k < count && !status; k++) {
        const nurbs_surface *surface = nurbs_patches_get(patches, k);
        status = add_patch(surface, parts + at, &s);
        at += spans_of(surface, 0) + spans_of(surface, 1);
    }
    if (!status)
        status = nurbs_mesh_create(s.vertices, s.points, s.triangles, s.corner, mesh);
    free(s.points);
    free(s.corner);
    free(parts);
    return status;
}
