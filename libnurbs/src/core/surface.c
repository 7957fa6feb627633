#include "core/error.h"
#include "core/object.h"

#include <nurbs/basis.h>

#include <stdlib.h>
#include <string.h>

static nurbs_status surface_check(const int degree[2], const size_t size[2],
                                  const double *const knots[2])
{
    if (!degree || !size)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL, expected two numbers",
                          degree ? "size" : "degree");
    for (int d = 0; d < 2; d++) {
        if (degree[d] < 1)
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "direction %c: degree is %d, expected 1 to %d",
                              "uv"[d], degree[d], NURBS_MAX_DEGREE);
        if (nurbs_knots_check(degree[d], size[d], knots[d]) != NURBS_OK) {
            char detail[400];
            strncpy(detail, nurbs_last_error(), sizeof detail - 1);
            detail[sizeof detail - 1] = '\0';
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "direction %c: %s", "uv"[d], detail);
        }
    }
    if (size[0] > NURBS_MAX_POINTS / size[1])
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%zu x %zu control points are too many", size[0],
                          size[1]);
    return NURBS_OK;
}

nurbs_status surface_reserve(const int degree[2], const size_t size[2],
                             const double *const knots[2], int rational, nurbs_surface **surface)
{
    *surface = NULL;
    nurbs_status status = surface_check(degree, size, knots);
    if (status != NURBS_OK)
        return status;
    const size_t n = size[0] * size[1], header = padded(sizeof(nurbs_surface));
    nurbs_surface *s = aligned_alloc(64, header + axis_bytes(degree[0], size[0]) +
                                             axis_bytes(degree[1], size[1]) + net_bytes(n));
    if (!s)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a surface of %zu x %zu control points",
                          size[0], size[1]);
    char *cursor = (char *)s + header;
    for (int d = 0; d < 2; d++)
        axis_place(&s->axis[d], degree[d], size[d], knots[d], &cursor);
    s->net = take(&cursor, 4 * n * sizeof(double));
    s->points = take(&cursor, 3 * n * sizeof(double));
    s->weights = rational ? take(&cursor, n * sizeof(double)) : NULL;
    *surface = s;
    return NURBS_OK;
}

nurbs_status nurbs_surface_create(const int degree[2], const size_t size[2], const double *knots_u,
                                  const double *knots_v, const double *points,
                                  const double *weights, nurbs_surface **surface)
{
    if (!surface)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "surface is NULL, expected a place for the result");
    *surface = NULL;
    const double *const knots[2] = {knots_u, knots_v};
    nurbs_status status = surface_check(degree, size, knots);
    if (status == NURBS_OK)
        status = points_check(size[0] * size[1], points, weights);
    nurbs_surface *s;
    if (status == NURBS_OK)
        status = surface_reserve(degree, size, knots, weights != NULL, &s);
    if (status != NURBS_OK)
        return status;
    const size_t n = size[0] * size[1];
    memcpy(s->points, points, 3 * n * sizeof(double));
    if (weights)
        memcpy(s->weights, weights, n * sizeof(double));
    homogenize(n, points, weights, s->net);
    *surface = s;
    return NURBS_OK;
}

nurbs_status nurbs_surface_copy(const nurbs_surface *surface, nurbs_surface **copy)
{
    NURBS_NEED(surface && copy);
    const int degree[2] = {surface->axis[0].degree, surface->axis[1].degree};
    const size_t size[2] = {surface->axis[0].size, surface->axis[1].size};
    return nurbs_surface_create(degree, size, surface->axis[0].knots, surface->axis[1].knots,
                                surface->points, surface->weights, copy);
}

void nurbs_surface_free(nurbs_surface *surface)
{
    free(surface);
}

int nurbs_surface_degree(const nurbs_surface *surface, int direction)
{
    return surface ? surface->axis[direction].degree : 0;
}

size_t nurbs_surface_size(const nurbs_surface *surface, int direction)
{
    return surface ? surface->axis[direction].size : 0;
}

const double *nurbs_surface_knots(const nurbs_surface *surface, int direction)
{
    return surface ? surface->axis[direction].knots : NULL;
}

const double *nurbs_surface_points(const nurbs_surface *surface)
{
    return surface ? surface->points : NULL;
}

const double *nurbs_surface_weights(const nurbs_surface *surface)
{
    return surface ? surface->weights : NULL;
}
