/* A wetted hull has no other openings than its stern, and covers no place twice. */
#include "core/error.h"
#include "hull/hull.h"

#include <nurbs/invert.h>
#include <nurbs/topology.h>

#include <math.h>
#include <stdlib.h>

enum { SAMPLES = 65, PROBES = 5 };

/* Relative to the extent, as the solver has them. */
static const double join = 1e-4, stern_reach = 0.05, centre_reach = 1e-5;
static const double short_edge = 20; /* times the joining distance: shorter ones cannot be joined */
static const double minor = 0.05;    /* of the shorter edge, as nurbs_topology_orient() */
static const double slack = 2e-3;    /* of an edge's range, where a joint ends */

typedef struct search {
    const nurbs_patches *patches;
    const nurbs_topology *topology;
    bool half;
    double extent, aft, fore; /* m */
    double plane, centre;     /* m: what lies so near is in the water, in the centre plane */
    bool open_aft, open_fore;
} search;

static nurbs_status sample_edge(const search *s, size_t e, double t[SAMPLES],
                                double points[SAMPLES][3])
{
    const nurbs_surface *surface = nurbs_patches_get(s->patches, e / 4);
    const nurbs_edge *edge = &s->topology->edge[e];
    int fixed = edge->side / 2;
    const double *knots = nurbs_surface_knots(surface, fixed);
    double uv[SAMPLES][2],
        value = edge->side % 2 ? knots[nurbs_surface_size(surface, fixed)] : knots[0];
    for (int k = 0; k < SAMPLES; k++) {
        double x = k / (SAMPLES - 1.0);
        t[k] = (1 - x) * edge->range[0] + x * edge->range[1];
        uv[k][fixed] = value;
        uv[k][!fixed] = t[k];
    }
    return nurbs_surface_eval(surface, 0, SAMPLES, uv[0], points[0]);
}

/* Edges that part at a small angle, the sides of a narrow face, run together for a while. */
static bool is_minor(const nurbs_topology *topology, const nurbs_joint *joint)
{
    return joint->length < minor * fmin(topology->edge[joint->edge[0]].length,
                                        topology->edge[joint->edge[1]].length);
}

/* How many other edges run along edge e at t; *other is one of them. `reach` widens each stretch;
 * below zero, minor ones do not count. */
static size_t joined_at(const search *s, size_t e, double t, double reach, size_t other[2])
{
    size_t count = 0;
    for (size_t k = 0; k < s->topology->joints; k++) {
        const nurbs_joint *j = &s->topology->joint[k];
        if (reach < 0 && is_minor(s->topology, j))
            continue;
        for (int side = 0; side < 2; side++)
            if (j->edge[side] == e && t >= fmin(j->from[side], j->to[side]) - reach &&
                t <= fmax(j->from[side], j->to[side]) + reach) {
                if (count < 2)
                    other[count] = j->edge[!side];
                count++;
            }
    }
    return count;
}

static nurbs_status covered_twice(size_t e, const size_t other[2], const double p[3])
{
    return nurbs_fail(NURBS_ERROR_GEOMETRY,
                      "patches %zu, %zu and %zu share an edge at (%.6g, %.6g, %.6g), expected two: "
                      "do they overlap?",
                      e / 4, other[0] / 4, other[1] / 4, p[0], p[1], p[2]);
}

static nurbs_status check_edge(search *s, size_t e)
{
    static const char *const names[4] = {"first u", "last u", "first v", "last v"};
    const nurbs_edge *edge = &s->topology->edge[e];
    double t[SAMPLES], points[SAMPLES][3], foremost = -INFINITY, aftmost = INFINITY;
    double range = edge->range[1] - edge->range[0];
    int loose = -1;
    nurbs_status status = sample_edge(s, e, t, points);
    for (int k = 0; k < SAMPLES && !status; k++) {
        size_t other[2] = {0, 0};
        const double *p = points[k];
        foremost = fmax(foremost, p[0]);
        aftmost = fmin(aftmost, p[0]);
        bool water = fabs(p[2]) <= s->plane, centre = s->half && fabs(p[1]) <= s->centre,
             inner = k > 0 && k + 1 < SAMPLES;
        size_t joined = joined_at(s, e, t[k], -slack * range, other);
        if (inner && !centre && joined > 1 && other[0] != other[1])
            return covered_twice(e, other, p);
        if (inner && water && !centre && joined == 1)
            return nurbs_fail(NURBS_ERROR_GEOMETRY,
                              "patches %zu and %zu share an edge in the still water at (%.6g, "
                              "%.6g, %.6g): do they overlap?",
                              e / 4, other[0] / 4, p[0], p[1], p[2]);
        if (inner && loose < 0 && !water && !centre &&
            joined_at(s, e, t[k], slack * range, other) == 0)
            loose = k;
    }
    if (status || loose < 0)
        return status;
    if (foremost <= s->aft + stern_reach * s->extent) {
        s->open_aft = true;
        return NURBS_OK;
    }
    if (aftmost >= s->fore - stern_reach * s->extent)
        s->open_fore = true;
    const double *p = points[loose];
    return nurbs_fail(NURBS_ERROR_GEOMETRY,
                      "open at (%.6g, %.6g, %.6g), %s of a patch: %.3g m off the centre plane, "
                      "%.3g m below the still water, %.3g m forward of the aft end, and no other "
                      "patch joins it there: is one missing?",
                      p[0], p[1], p[2], names[edge->side], fabs(p[1]), -p[2], p[0] - s->aft);
}

/* Whether all probes of patch a lie on patch b, at the distance given. */
static nurbs_status lies_on(const search *s, size_t a, size_t b, double at[3], bool *lies)
{
    const nurbs_surface *surface = nurbs_patches_get(s->patches, a);
    double uv[PROBES * PROBES][2], points[PROBES * PROBES][3], away[PROBES * PROBES];
    const double *u = nurbs_surface_knots(surface, 0), *v = nurbs_surface_knots(surface, 1);
    double last[2] = {u[nurbs_surface_size(surface, 0)], v[nurbs_surface_size(surface, 1)]};
    for (int k = 0; k < PROBES * PROBES; k++) {
        double x = (k / PROBES + 0.5) / PROBES, y = (k % PROBES + 0.5) / PROBES;
        uv[k][0] = (1 - x) * u[0] + x * last[0];
        uv[k][1] = (1 - y) * v[0] + y * last[1];
    }
    nurbs_status status = nurbs_surface_eval(surface, 0, PROBES * PROBES, uv[0], points[0]);
    double closest[PROBES * PROBES][2];
    if (!status)
        status = nurbs_surface_closest(nurbs_patches_get(s->patches, b), PROBES * PROBES, points[0],
                                       closest[0], away);
    *lies = !status;
    for (int k = 0; k < PROBES * PROBES && !status; k++)
        *lies &= away[k] <= join * s->extent;
    for (int c = 0; c < 3; c++)
        at[c] = points[PROBES * PROBES / 2][c];
    return status;
}

static bool within(const hull_box *a, const hull_box *b, double margin)
{
    for (int c = 0; c < 3; c++)
        if (a->lower[c] < b->lower[c] - margin || a->upper[c] > b->upper[c] + margin)
            return false;
    return true;
}

/* A patch that lies on another one. */
static nurbs_status check_doubles(const search *s)
{
    size_t n = nurbs_patches_count(s->patches);
    hull_box *box = malloc((n + 1) * sizeof *box);
    if (!box)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < n && !status; k++) {
        box[k] = hull_box_empty();
        status = hull_box_widen(nurbs_patches_get(s->patches, k), &box[k]);
    }
    for (size_t a = 0; a < n && !status; a++)
        for (size_t b = 0; b < n && !status; b++) {
            bool lies = false;
            double at[3];
            if (a == b || !within(&box[a], &box[b], join * s->extent))
                continue;
            status = lies_on(s, a, b, at, &lies);
            if (lies)
                status = nurbs_fail(NURBS_ERROR_GEOMETRY,
                                    "a patch lies on another one, about (%.6g, %.6g, %.6g): is it "
                                    "given twice?",
                                    at[0], at[1], at[2]);
        }
    free(box);
    return status;
}

static nurbs_status check_all(search *s)
{
    nurbs_status status = check_doubles(s);
    for (size_t e = 0; e < s->topology->edges && !status; e++) {
        const nurbs_edge *edge = &s->topology->edge[e];
        if (!edge->collapsed && edge->length > short_edge * join * s->extent)
            status = check_edge(s, e);
    }
    return status;
}

nurbs_status hull_check_edges(const nurbs_hull *hull, bool *bow_aft)
{
    hull_box box;
    nurbs_topology topology = {0};
    *bow_aft = false;
    nurbs_status status = hull_box_of(hull->wetted, &box);
    if (status)
        return status;
    double extent = box.upper[0] - box.lower[0];
    status = nurbs_patches_topology(hull->wetted, join * extent, &topology);
    search s = {.patches = hull->wetted,
                .topology = &topology,
                .half = hull->half,
                .extent = extent,
                .aft = box.lower[0],
                .fore = box.upper[0],
                .plane = HULL_CLEARANCE * extent,
                .centre = centre_reach * extent};
    if (!status)
        status = check_all(&s);
    if (!status)
        status = hull_check_bodies(hull->wetted, &topology, extent);
    *bow_aft = status && s.open_fore && !s.open_aft;
    nurbs_topology_free(&topology);
    return status;
}
