/* What each edge of a patch is. */
#include "core/error.h"
#include "hull/hull.h"

#include <nurbs/curve.h>
#include <nurbs/invert.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    EDGE_SAMPLES = 65 /* points of the polyline that stands for an edge when edges are matched */
};

/* Relative to the extent of the body. */
static const double PLANE_TOLERANCE = 1e-6; /* an edge this close to a plane lies in it */
static const double BULGE = 1e-2; /* an edge lies this close to the polyline of its samples */
static const double TRANSOM_REACH = 0.05; /* an open edge this close to the aft end is a transom */

struct edge_points {
    double at[EDGE_SAMPLES][3];
};

static igabem_status sample_edges(const struct igabem_hull *hull, struct edge_points *edges)
{
    for (size_t p = 0; p < hull->n; p++)
        for (int e = 0; e < HULL_EDGES; e++) {
            double uv[EDGE_SAMPLES][2];
            for (int i = 0; i < EDGE_SAMPLES; i++)
                hull_edge_parameters(&hull->patches[p], e, i / (EDGE_SAMPLES - 1.0), uv[i]);
            nurbs_status status =
                nurbs_surface_eval(hull->patches[p].surface, 0, EDGE_SAMPLES, uv[0],
                                   edges[p * HULL_EDGES + (size_t)e].at[0]);
            if (status)
                return hull_nurbs_fail(status, "an edge of a patch");
        }
    return IGABEM_OK;
}

/* Largest |coordinate| along an edge. */
static double farthest(const struct edge_points *edge, int coordinate)
{
    double largest = 0.0;
    for (int i = 0; i < EDGE_SAMPLES; i++)
        largest = fmax(largest, fabs(edge->at[i][coordinate]));
    return largest;
}

static double edge_size(const struct edge_points *edge)
{
    double size = 0.0;
    for (int i = 1; i < EDGE_SAMPLES; i++)
        for (int k = 0; k < 3; k++)
            size = fmax(size, fabs(edge->at[i][k] - edge->at[0][k]));
    return size;
}

static double point_segment(const double p[3], const double a[3], const double b[3])
{
    double along = 0, length = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        along += (p[k] - a[k]) * (b[k] - a[k]);
        length += (b[k] - a[k]) * (b[k] - a[k]);
    }
    double t = length > 0 ? fmin(1.0, fmax(0.0, along / length)) : 0.0;
    for (int k = 0; k < 3; k++) {
        double d = p[k] - a[k] - t * (b[k] - a[k]);
        square += d * d;
    }
    return sqrt(square);
}

/* Distance of a point from an edge, exactly. */
static igabem_status edge_distance(const struct igabem_hull *hull, size_t which, const double p[3],
                                   double *distance)
{
    const struct hull_patch *patch = &hull->patches[which / HULL_EDGES];
    double uv[2], u;
    int fixed = which % HULL_EDGES == HULL_V0 || which % HULL_EDGES == HULL_V1;
    nurbs_curve *curve = NULL;
    hull_edge_parameters(patch, (int)(which % HULL_EDGES), 0.0, uv);
    nurbs_status status = nurbs_surface_iso_curve(patch->surface, fixed, uv[fixed], &curve);
    if (!status)
        status = nurbs_curve_closest(curve, 1, p, &u, distance);
    nurbs_curve_free(curve);
    return status ? hull_nurbs_fail(status, "distance from an edge") : IGABEM_OK;
}

/* Whether sample i of an edge lies on another one. Polylines leave out edges that are far; they do
 * not decide, as a curved edge bulges between its samples. */
static igabem_status is_shared(const struct igabem_hull *hull, const struct edge_points *edges,
                               size_t which, int i, int *shared)
{
    double tolerance = hull_join_tolerance(hull), nearby = BULGE * hull->extent;
    igabem_status status = IGABEM_OK;
    *shared = 0;
    for (size_t other = 0; !*shared && !status && other < hull->n * HULL_EDGES; other++) {
        const struct edge_points *o = &edges[other];
        if (other == which ||
            hull->patches[other / HULL_EDGES].edge[other % HULL_EDGES] == HULL_EDGE_COLLAPSED)
            continue;
        double distance = INFINITY;
        for (int j = 0; distance > tolerance && j + 1 < EDGE_SAMPLES; j++)
            distance = fmin(distance, point_segment(edges[which].at[i], o->at[j], o->at[j + 1]));
        if (distance > tolerance && distance <= nearby)
            status = edge_distance(hull, other, edges[which].at[i], &distance);
        *shared = distance <= tolerance;
    }
    return status;
}

/* Index of the first sample of an edge that lies neither in the centre plane of a half hull nor on
 * another edge, or -1. */
static igabem_status first_unshared(const struct igabem_hull *hull, const struct edge_points *edges,
                                    size_t which, int *first)
{
    double centre = hull->symmetric ? PLANE_TOLERANCE * hull->extent : -1.0;
    *first = -1;
    for (int i = 0; i < EDGE_SAMPLES && *first < 0; i++) {
        int shared = fabs(edges[which].at[i][1]) <= centre;
        igabem_status status = shared ? IGABEM_OK : is_shared(hull, edges, which, i, &shared);
        if (status)
            return status;
        if (!shared)
            *first = i;
    }
    return IGABEM_OK;
}

static igabem_status settle_free_edge(struct igabem_hull *hull, const struct edge_points *edges,
                                      size_t which)
{
    static const char *const names[HULL_EDGES] = {"u first", "u last", "v first", "v last"};
    const struct edge_points *edge = &edges[which];
    struct hull_patch *patch = &hull->patches[which / HULL_EDGES];
    /* Ends of an edge always touch the neighbouring edges: look at the middle as well. */
    int loose;
    igabem_status status = first_unshared(hull, edges, which, &loose);
    if (status)
        return status;
    if (loose < 0) {
        patch->edge[which % HULL_EDGES] = HULL_EDGE_JOINED;
        return IGABEM_OK;
    }
    double foremost = -INFINITY;
    for (int i = 0; i < EDGE_SAMPLES; i++)
        foremost = fmax(foremost, edge->at[i][0]);
    if (foremost > hull->lower[0] + TRANSOM_REACH * hull->extent)
        return igabem_fail(
            IGABEM_ERROR_GEOMETRY,
            "patch %zu, edge %s: open at (%.6g, %.6g, %.6g): off y = 0 by up to %.2g m, off z = 0 "
            "by up to %.2g m, shared with no other edge and not at the stern",
            which / HULL_EDGES, names[which % HULL_EDGES], edge->at[loose][0], edge->at[loose][1],
            edge->at[loose][2], farthest(edge, 1), farthest(edge, 2));
    patch->edge[which % HULL_EDGES] = HULL_EDGE_OPEN;
    hull->transom = IGABEM_TRANSOM_OPEN;
    return IGABEM_OK;
}

igabem_status hull_classify_edges(struct igabem_hull *hull)
{
    size_t n = hull->n * HULL_EDGES;
    struct edge_points *edges = malloc(n * sizeof *edges);
    if (!edges)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu edges", n);
    igabem_status status = sample_edges(hull, edges);
    double tolerance = PLANE_TOLERANCE * hull->extent;
    for (size_t e = 0; !status && e < n; e++) {
        enum hull_edge *kind = &hull->patches[e / HULL_EDGES].edge[e % HULL_EDGES];
        if (edge_size(&edges[e]) <= tolerance)
            *kind = HULL_EDGE_COLLAPSED;
        else if (farthest(&edges[e], 2) <= tolerance)
            *kind = HULL_EDGE_WATERLINE;
        else if (hull->symmetric && farthest(&edges[e], 1) <= tolerance)
            *kind = HULL_EDGE_CENTRE;
        else
            *kind = HULL_EDGE_OPEN;
        if (*kind == HULL_EDGE_WATERLINE)
            hull->surface_piercing = true;
    }
    for (size_t e = 0; !status && e < n; e++)
        if (hull->patches[e / HULL_EDGES].edge[e % HULL_EDGES] == HULL_EDGE_OPEN)
            status = settle_free_edge(hull, edges, e);
    free(edges);
    return status;
}
