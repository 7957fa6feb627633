/* Edges of a half hull that lie nearly in the centre plane. */
#include "core/error.h"

#include <nurbs/hull.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* y of control point k of edge e: u first, u last, v first, v last. */
static double *edge_y(double *points, const size_t n[2], int e, size_t k)
{
    size_t fixed = e % 2 ? n[e / 2] - 1 : 0;
    return points + 3 * (e < 2 ? fixed * n[1] + k : k * n[1] + fixed) + 1;
}

/* Puts the edges whose control points all lie within the tolerance of y = 0 there. */
static void snap_edges(double *points, const size_t n[2], double tolerance, size_t *edges,
                       double *moved)
{
    for (int e = 0; e < 4; e++) {
        double away = 0;
        size_t count = n[!(e / 2)];
        for (size_t k = 0; k < count; k++)
            away = fmax(away, fabs(*edge_y(points, n, e, k)));
        if (!(away > 0 && away <= tolerance))
            continue;
        for (size_t k = 0; k < count; k++)
            *edge_y(points, n, e, k) = 0;
        ++*edges;
        *moved = fmax(*moved, away);
    }
}

static nurbs_status snap_surface(const nurbs_surface *surface, double tolerance,
                                 nurbs_surface **snapped, size_t *edges, double *moved)
{
    const size_t n[2] = {nurbs_surface_size(surface, 0), nurbs_surface_size(surface, 1)};
    const int degree[2] = {nurbs_surface_degree(surface, 0), nurbs_surface_degree(surface, 1)};
    double *points = malloc(3 * n[0] * n[1] * sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", n[0] * n[1]);
    memcpy(points, nurbs_surface_points(surface), 3 * n[0] * n[1] * sizeof *points);
    snap_edges(points, n, tolerance, edges, moved);
    nurbs_status status = nurbs_surface_create(degree, n, nurbs_surface_knots(surface, 0),
                                               nurbs_surface_knots(surface, 1), points,
                                               nurbs_surface_weights(surface), snapped);
    free(points);
    return status;
}

static nurbs_status add_snapped(const nurbs_patches *patches, size_t index, double tolerance,
                                nurbs_patches *result, size_t *edges, double *moved)
{
    nurbs_surface *snapped = NULL;
    const double *u, *v;
    size_t rows = nurbs_patches_parameters(patches, index, 0, &u),
           columns = nurbs_patches_parameters(patches, index, 1, &v);
    nurbs_status status =
        snap_surface(nurbs_patches_get(patches, index), tolerance, &snapped, edges, moved);
    if (!status)
        status = nurbs_patches_add(result, snapped);
    if (!status)
        status = nurbs_patches_set_parameters(result, index, rows, u, columns, v);
    nurbs_surface_free(snapped);
    return status;
}

nurbs_status nurbs_patches_snap(const nurbs_patches *patches, double tolerance,
                                nurbs_patches **result, size_t *edges, double *moved)
{
    size_t count = 0;
    double most = 0;
    if (!patches || !result)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "patches or result is NULL");
    *result = NULL;
    if (!(isfinite(tolerance) && tolerance > 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "tolerance %g, expected a length > 0", tolerance);
    nurbs_patches *made = NULL;
    nurbs_status status = nurbs_patches_create(&made);
    if (!status)
        status = nurbs_patches_set_length(made, nurbs_patches_length(patches));
    if (!status)
        status = nurbs_patches_set_note(made, nurbs_patches_note(patches));
    for (size_t k = 0; k < nurbs_patches_count(patches) && !status; k++)
        status = add_snapped(patches, k, tolerance, made, &count, &most);
    if (status) {
        nurbs_patches_free(made);
        return status;
    }
    *result = made;
    if (edges)
        *edges = count;
    if (moved)
        *moved = most;
    return NURBS_OK;
}
