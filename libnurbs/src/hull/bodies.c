/* Bodies of one file that reach into each other: their volumes would count twice. */
#include "core/error.h"
#include "hull/hull.h"
#include "lines/lines.h"

#include <math.h>
#include <stdlib.h>

enum { PROBES = 5 };

/* Of the extent: how fine the triangles are, and how deep inside a body a point must lie. */
static const double fineness = 1e-4, depth = 5e-4;

/* The triangles of the patches of one connected part. */
static nurbs_status mesh_part(const nurbs_patches *patches, const size_t *part, size_t which,
                              double tolerance, nurbs_mesh **mesh)
{
    nurbs_patches *own = NULL;
    nurbs_status status = nurbs_patches_create(&own);
    for (size_t k = 0; k < nurbs_patches_count(patches) && !status; k++)
        if (part[k] == which)
            status = nurbs_patches_add(own, nurbs_patches_get(patches, k));
    if (!status)
        status = nurbs_patches_mesh(own, tolerance, mesh);
    nurbs_patches_free(own);
    return status;
}

/* Whether the line from p along y meets the triangle, and at which distance. */
static bool meets(const double p[3], const double *a, const double *b, const double *c,
                  double *distance)
{
    double area = (b[0] - a[0]) * (c[2] - a[2]) - (c[0] - a[0]) * (b[2] - a[2]);
    if (area == 0)
        return false;
    double s = ((p[0] - a[0]) * (c[2] - a[2]) - (c[0] - a[0]) * (p[2] - a[2])) / area,
           t = ((b[0] - a[0]) * (p[2] - a[2]) - (p[0] - a[0]) * (b[2] - a[2])) / area;
    *distance = a[1] + s * (b[1] - a[1]) + t * (c[1] - a[1]) - p[1];
    return s >= 0 && t >= 0 && s + t < 1;
}

/* An odd number of crossings beside p, the triangles far enough from it: p lies inside. Beside a
 * half body lies its own side only. */
static bool is_inside(const nurbs_mesh *mesh, const mesh_distance *distance, const double p[3],
                      double margin)
{
    const double *points = nurbs_mesh_points(mesh);
    const size_t *corner = nurbs_mesh_corners(mesh);
    size_t crossings = 0;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t k = 0; k < 3 * nurbs_mesh_vertices(mesh); k++) {
        low[k % 3] = fmin(low[k % 3], points[k]);
        high[k % 3] = fmax(high[k % 3], points[k]);
    }
    /* At the rim of its shadow a line grazes the body. */
    for (int c = 0; c < 3; c++)
        if (p[c] > high[c] - margin || p[c] < low[c] + (c == 1 ? 0 : margin))
            return false;
    for (size_t k = 0; k < nurbs_mesh_triangles(mesh); k++) {
        double away;
        if (!meets(p, points + 3 * corner[3 * k], points + 3 * corner[3 * k + 1],
                   points + 3 * corner[3 * k + 2], &away))
            continue;
        crossings += away > 0;
    }
    return crossings % 2 && mesh_distance_of(distance, p) > margin;
}

static void probes_of(const nurbs_surface *surface, double uv[PROBES * PROBES][2])
{
    const double *knots[2];
    double last[2];
    for (int d = 0; d < 2; d++) {
        knots[d] = nurbs_surface_knots(surface, d);
        last[d] = knots[d][nurbs_surface_size(surface, d)];
    }
    for (int k = 0; k < PROBES * PROBES; k++) {
        double x = (k / PROBES + 0.5) / PROBES, y = (k % PROBES + 0.5) / PROBES;
        uv[k][0] = (1 - x) * knots[0][0] + x * last[0];
        uv[k][1] = (1 - y) * knots[1][0] + y * last[1];
    }
}

static nurbs_status check_part(const nurbs_patches *patches, const size_t *part, size_t which,
                               double extent)
{
    nurbs_mesh *mesh = NULL;
    mesh_distance *distance = NULL;
    nurbs_status status = mesh_part(patches, part, which, fineness * extent, &mesh);
    if (!status)
        status = mesh_distance_create(mesh, &distance);
    for (size_t k = 0; k < nurbs_patches_count(patches) && !status; k++) {
        double uv[PROBES * PROBES][2], points[PROBES * PROBES][3];
        if (part[k] == which)
            continue;
        probes_of(nurbs_patches_get(patches, k), uv);
        status =
            nurbs_surface_eval(nurbs_patches_get(patches, k), 0, PROBES * PROBES, uv[0], points[0]);
        for (int i = 0; i < PROBES * PROBES && !status; i++)
            if (is_inside(mesh, distance, points[i], depth * extent))
                status = nurbs_fail(NURBS_ERROR_GEOMETRY,
                                    "a body reaches into another one, or lies inside it, about "
                                    "(%.6g, %.6g, %.6g): expected one that is united, or 'nurbs "
                                    "clean --keep' or '--drop' chooses its patches",
                                    points[i][0], points[i][1], points[i][2]);
    }
    mesh_distance_free(distance);
    nurbs_mesh_free(mesh);
    return status;
}

/* Numbers the parts that hang together by any edges; returns how many there are. */
static size_t number_parts(const nurbs_topology *topology, size_t n, size_t *part)
{
    size_t parts = 0;
    for (size_t k = 0; k < n; k++)
        part[k] = k;
    for (bool more = true; more;) {
        more = false;
        for (size_t k = 0; k < topology->joints; k++) {
            size_t a = topology->joint[k].edge[0] / 4, b = topology->joint[k].edge[1] / 4,
                   least = part[a] < part[b] ? part[a] : part[b];
            more |= part[a] != part[b];
            part[a] = part[b] = least;
        }
    }
    for (size_t k = 0; k < n; k++)
        parts += part[k] == k;
    return parts;
}

nurbs_status hull_check_bodies(const nurbs_patches *patches, const nurbs_topology *topology,
                               double extent)
{
    size_t n = nurbs_patches_count(patches), *part = malloc((n + 1) * sizeof *part);
    if (!part)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    nurbs_status status = NURBS_OK;
    bool several = number_parts(topology, n, part) > 1;
    for (size_t k = 0; k < n && several && !status; k++)
        if (part[k] == k)
            status = check_part(patches, part, k, extent);
    free(part);
    return status;
}
