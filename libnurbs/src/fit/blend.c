/* Surfaces from their edges: ruled surfaces and Coons patches. */
#include "core/error.h"

#include <nurbs/basis.h>
#include <nurbs/fit.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

nurbs_status nurbs_ruled(const nurbs_curve *first, const nurbs_curve *last, nurbs_surface **surface)
{
    NURBS_NEED(first && last && surface);
    /* Skinning of degree 1 runs its lines along u; the curves shall be the u lines. */
    const nurbs_curve *const both[2] = {first, last};
    nurbs_surface *skin;
    *surface = NULL;
    nurbs_status status = nurbs_skin_curves(2, both, (const double[]){0, 1}, 1, 0, &skin);
    if (status == NURBS_OK) {
        status = nurbs_surface_swap(skin, surface);
        nurbs_surface_free(skin);
    }
    return status;
}

static void curve_end(const nurbs_curve *curve, int last, double point[3])
{
    size_t k = last ? nurbs_curve_size(curve) - 1 : 0;
    memcpy(point, nurbs_curve_points(curve) + 3 * k, 3 * sizeof *point);
}

static double distance(const double *a, const double *b)
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* The four corners, at (u,v) = (0,0), (1,0), (0,1), (1,1), taken from the u curves. */
static nurbs_status find_corners(const nurbs_curve *const u[2], const nurbs_curve *const v[2],
                                 double corner[4][3])
{
    double extent = 0;
    for (int k = 0; k < 4; k++)
        curve_end(u[k / 2], k % 2, corner[k]);
    for (int k = 1; k < 4; k++)
        extent = fmax(extent, distance(corner[0], corner[k]));
    for (int k = 0; k < 4; k++) {
        double other[3];
        curve_end(v[k % 2], k / 2, other);
        if (!(distance(corner[k], other) <= 1e-9 * extent))
            return nurbs_fail(NURBS_ERROR_GEOMETRY,
                              "the edges do not meet at the corner u = %d, v = %d: gap of %g m",
                              k % 2, k / 2, distance(corner[k], other));
    }
    return NURBS_OK;
}

/* Brings a surface to the degrees of `like` and to at least its knots. */
static nurbs_status match(nurbs_surface **surface, const nurbs_surface *like)
{
    nurbs_status status = NURBS_OK;
    for (int d = 0; d < 2 && status == NURBS_OK; d++) {
        nurbs_surface *next;
        status = nurbs_surface_elevate(
            *surface, d, nurbs_surface_degree(like, d) - nurbs_surface_degree(*surface, d), &next);
        if (status != NURBS_OK)
            break;
        nurbs_surface_free(*surface);
        *surface = next;
        /* `like` holds every interior knot of this surface: insert the ones it has in addition. */
        size_t p = (size_t)nurbs_surface_degree(like, d), n = nurbs_surface_size(like, d),
               m = nurbs_surface_size(*surface, d), missing = 0, at = p + 1;
        const double *t = nurbs_surface_knots(like, d), *s = nurbs_surface_knots(*surface, d);
        double *add = malloc(n * sizeof *add);
        if (!add)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", n);
        for (size_t k = p + 1; k < n; k++) {
            if (at < m && s[at] == t[k])
                at++;
            else
                add[missing++] = t[k];
        }
        status = nurbs_surface_insert(*surface, d, missing, add, &next);
        free(add);
        if (status == NURBS_OK) {
            nurbs_surface_free(*surface);
            *surface = next;
        }
    }
    return status;
}

static nurbs_status bilinear(double corner[4][3], nurbs_surface **surface)
{
    static const double knots[4] = {0, 0, 1, 1};
    double points[12];
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            memcpy(points + 3 * (2 * i + j), corner[i + 2 * j], 3 * sizeof *points);
    return nurbs_surface_create((const int[]){1, 1}, (const size_t[]){2, 2}, knots, knots, points,
                                NULL, surface);
}

/* An empty frame with the degrees and knots of both ruled surfaces: u from the first, v from the
 * second. */
static nurbs_status frame(const nurbs_surface *along_u, const nurbs_surface *along_v,
                          nurbs_surface **surface)
{
    const int degree[2] = {nurbs_surface_degree(along_u, 0), nurbs_surface_degree(along_v, 1)};
    const size_t size[2] = {nurbs_surface_size(along_u, 0), nurbs_surface_size(along_v, 1)};
    double *points = calloc(3 * size[0] * size[1], sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu points", size[0], size[1]);
    nurbs_status status =
        nurbs_surface_create(degree, size, nurbs_surface_knots(along_u, 0),
                             nurbs_surface_knots(along_v, 1), points, NULL, surface);
    free(points);
    return status;
}

/* Coons: ruled along v + ruled along u - bilinear, on common knots. */
static nurbs_status combine(const nurbs_surface *like, nurbs_surface *const part[3],
                            nurbs_surface **surface)
{
    const int degree[2] = {nurbs_surface_degree(like, 0), nurbs_surface_degree(like, 1)};
    const size_t size[2] = {nurbs_surface_size(like, 0), nurbs_surface_size(like, 1)};
    size_t n = 3 * size[0] * size[1];
    double *points = malloc(n * sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu points", size[0], size[1]);
    for (size_t k = 0; k < n; k++)
        points[k] = nurbs_surface_points(part[0])[k] + nurbs_surface_points(part[1])[k] -
                    nurbs_surface_points(part[2])[k];
    nurbs_status status = nurbs_surface_create(degree, size, nurbs_surface_knots(like, 0),
                                               nurbs_surface_knots(like, 1), points, NULL, surface);
    free(points);
    return status;
}

nurbs_status nurbs_coons(const nurbs_curve *u_first, const nurbs_curve *u_last,
                         const nurbs_curve *v_first, const nurbs_curve *v_last,
                         nurbs_surface **surface)
{
    NURBS_NEED(u_first && u_last && v_first && v_last && surface);
    const nurbs_curve *const u[2] = {u_first, u_last}, *const v[2] = {v_first, v_last};
    nurbs_surface *part[3] = {NULL, NULL, NULL}, *like = NULL;
    double corner[4][3];
    *surface = NULL;
    for (int k = 0; k < 2; k++)
        if (nurbs_curve_weights(u[k]) || nurbs_curve_weights(v[k]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "a Coons patch is blended from polynomial curves only");
    nurbs_status status = find_corners(u, v, corner);
    if (status == NURBS_OK)
        status = nurbs_ruled(u_first, u_last, &part[0]);
    if (status == NURBS_OK)
        status = nurbs_skin_curves(2, v, (const double[]){0, 1}, 1, 0, &part[1]);
    if (status == NURBS_OK)
        status = bilinear(corner, &part[2]);
    if (status == NURBS_OK)
        status = frame(part[0], part[1], &like);
    for (int k = 0; k < 3 && status == NURBS_OK; k++)
        status = match(&part[k], like);
    if (status == NURBS_OK)
        status = combine(like, part, surface);
    for (int k = 0; k < 3; k++)
        nurbs_surface_free(part[k]);
    nurbs_surface_free(like);
    return status;
}
