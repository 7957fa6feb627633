#include "exterior/edge.h"

#include "core/constants.h"
#include "core/error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { EDGE_POINTS = 1025 };
/* It may run back by this share of the hull's length: rounding at a stem. */
static const double BACKWARDS = 1e-6;

static int by_x(const void *a, const void *b)
{
    double xa = ((const struct edge_point *)a)->at[0], xb = ((const struct edge_point *)b)->at[0];
    return (xa > xb) - (xa < xb);
}

static int by_y(const void *a, const void *b)
{
    double ya = ((const struct edge_point *)a)->at[1], yb = ((const struct edge_point *)b)->at[1];
    return (ya > yb) - (ya < yb);
}

/* Points of one edge of a patch, closer together towards its ends, where stems are. */
static igabem_status trace(const struct density *density, size_t index, int which, double length,
                           struct edge *edge)
{
    const struct hull_patch *patch = &density->patch[index].hull;
    double direction = 0.0;
    for (int i = 0; i < EDGE_POINTS; i++) {
        struct edge_point *point = &edge->point[edge->n];
        hull_edge_parameters(patch, which, 0.5 - 0.5 * cos(PI * i / (EDGE_POINTS - 1.0)),
                             point->uv);
        nurbs_status status = nurbs_surface_eval(patch->surface, 0, 1, point->uv, point->at);
        if (status)
            return hull_nurbs_fail(status, "an edge of the hull");
        point->at[1] = fabs(point->at[1]);
        point->patch = index;
        double step = i ? point->at[edge->key] - point[-1].at[edge->key] : 0.0;
        if (step * direction < -BACKWARDS * length)
            return igabem_fail(IGABEM_ERROR_GEOMETRY,
                               "the %s turns back at (%.6g, %.6g, %.6g) m: the free surface at it "
                               "has no grid",
                               edge->key ? "rim of the transom" : "waterline", point->at[0],
                               point->at[1], point->at[2]);
        if (fabs(step) > BACKWARDS * length)
            direction = step > 0 ? 1.0 : -1.0;
        edge->n++;
    }
    return IGABEM_OK;
}

igabem_status edge_create(const struct density *density, enum hull_edge kind, int key,
                          double length, struct edge *edge)
{
    size_t edges = 0;
    *edge = (struct edge){.key = key};
    for (size_t p = 0; p < density->patches; p++)
        for (int e = 0; e < HULL_EDGES; e++)
            edges += density->patch[p].hull.edge[e] == kind;
    if (edges == 0)
        return IGABEM_OK;
    edge->point = malloc(edges * EDGE_POINTS * sizeof *edge->point);
    if (!edge->point)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the edges of the hull");
    for (size_t p = 0; p < density->patches; p++)
        for (int e = 0; e < HULL_EDGES; e++) {
            if (density->patch[p].hull.edge[e] != kind)
                continue;
            igabem_status status = trace(density, p, e, length, edge);
            if (status != IGABEM_OK) {
                edge_free(edge);
                return status;
            }
        }
    qsort(edge->point, edge->n, sizeof *edge->point, key ? by_y : by_x);
    edge->first = edge->point[0].at[key];
    edge->last = edge->point[edge->n - 1].at[key];
    return IGABEM_OK;
}

void edge_free(struct edge *edge)
{
    free(edge->point);
    *edge = (struct edge){.key = edge->key};
}

/* The last point at or before the coordinate, but not the very last. */
static const struct edge_point *before(const struct edge *edge, double coordinate)
{
    size_t low = 0, high = edge->n - 1;
    while (low + 1 < high) {
        size_t middle = low + (high - low) / 2;
        if (edge->point[middle].at[edge->key] <= coordinate)
            low = middle;
        else
            high = middle;
    }
    return &edge->point[low];
}

/* Where the coordinate lies between a point and the next. */
static double share_of(const struct edge_point *p, int key, double coordinate)
{
    double width = p[1].at[key] - p[0].at[key];
    double share = width > 0 ? (coordinate - p[0].at[key]) / width : 1.0;
    return fmin(1.0, fmax(0.0, share));
}

const struct edge_point *edge_before(const struct edge *edge, double coordinate, double *share)
{
    const struct edge_point *p = before(edge, coordinate);
    *share = share_of(p, edge->key, coordinate);
    return p;
}

void edge_at(const struct edge *edge, double coordinate, double at[3])
{
    if (!edge->n)
        return;
    double share;
    const struct edge_point *p = edge_before(edge, coordinate, &share);
    for (int c = 0; c < 3; c++)
        at[c] = p[0].at[c] + share * (p[1].at[c] - p[0].at[c]);
}

igabem_status edge_locate(const struct edge *edge, const struct density *density, double coordinate,
                          size_t *patch, double uv[2])
{
    double share;
    const struct edge_point *p = edge_before(edge, coordinate, &share);
    int key = edge->key;
    bool between = p[0].patch == p[1].patch && p[1].at[key] > p[0].at[key];
    if (!between)
        p += share > 0.5;
    *patch = p->patch;
    memcpy(uv, p->uv, sizeof p->uv);
    /* A linear step and one of the secant: the points are close. */
    for (int k = 0; k < 2 && between; k++) {
        double at[3];
        for (int d = 0; d < 2; d++)
            uv[d] = p[0].uv[d] + share * (p[1].uv[d] - p[0].uv[d]);
        if (k)
            break;
        nurbs_status status = nurbs_surface_eval(density->patch[*patch].hull.surface, 0, 1, uv, at);
        if (status)
            return hull_nurbs_fail(status, "an edge of the hull");
        double miss = coordinate - (key ? fabs(at[1]) : at[0]);
        share = fmin(1.0, fmax(0.0, share + miss / (p[1].at[key] - p[0].at[key])));
    }
    return IGABEM_OK;
}
