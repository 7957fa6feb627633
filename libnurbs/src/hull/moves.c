/* From one rebuilt hull to another: moves of control points. */
#include "core/error.h"
#include "hull/hull.h"

#include <nurbs/fit.h>
#include <nurbs/grid.h>

#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 4 }; /* of the fit in each span, as in a shared space */

static size_t points_of(const nurbs_surface *surface)
{
    return nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
}

/* Whether two polynomial surfaces differ by their control points alone. */
static bool alike(const nurbs_surface *a, const nurbs_surface *b)
{
    for (int d = 0; d < 2; d++) {
        size_t n = nurbs_surface_size(a, d);
        int degree = nurbs_surface_degree(a, d);
        if (n != nurbs_surface_size(b, d) || degree != nurbs_surface_degree(b, d) ||
            memcmp(nurbs_surface_knots(a, d), nurbs_surface_knots(b, d),
                   (n + (size_t)degree + 1) * sizeof(double)) != 0)
            return false;
    }
    return !nurbs_surface_weights(a) && !nurbs_surface_weights(b);
}

static void subtract(const nurbs_surface *from, const nurbs_surface *to, double *move)
{
    const double *a = nurbs_surface_points(from), *b = nurbs_surface_points(to);
    for (size_t i = 0; i < 3 * points_of(from); i++)
        move[i] = b[i] - a[i];
}

/* Parameters of the samples of one direction: SAMPLES a span and both ends. */
static size_t sites(const nurbs_surface *surface, int d, double *t)
{
    const double *knots = nurbs_surface_knots(surface, d);
    size_t last = nurbs_surface_size(surface, d), n = 0;
    for (size_t i = (size_t)nurbs_surface_degree(surface, d); i < last; i++)
        for (int k = 0; k < SAMPLES && knots[i + 1] > knots[i]; k++)
            t[n++] = knots[i] + (knots[i + 1] - knots[i]) * k / SAMPLES;
    t[n++] = knots[last];
    return n;
}

/* Differences of two surfaces at equal parameters, of which grid holds those of the first. */
static nurbs_status sample(const nurbs_surface *from, const nurbs_surface *to, size_t rows,
                           const double *u, size_t columns, const double *v, nurbs_grid **grid)
{
    nurbs_grid *other = NULL;
    nurbs_status status = nurbs_grid_sample(from, rows, u, columns, v, grid);
    if (!status)
        status = nurbs_grid_sample(to, rows, u, columns, v, &other);
    if (!status) {
        double *a = nurbs_grid_edit(*grid);
        const double *b = nurbs_grid_points(other);
        for (size_t i = 0; i < 3 * rows * columns; i++)
            a[i] = b[i] - a[i];
    }
    nurbs_grid_free(other);
    return status;
}

/* The same as a field on the knots of the light surface. */
static nurbs_status fit(const nurbs_surface *from, const nurbs_surface *to,
                        const nurbs_surface *light, double *move)
{
    const int degree[2] = {nurbs_surface_degree(light, 0), nurbs_surface_degree(light, 1)};
    const size_t size[2] = {nurbs_surface_size(light, 0), nurbs_surface_size(light, 1)};
    nurbs_grid *grid = NULL;
    nurbs_surface *fitted = NULL;
    double *u = malloc((SAMPLES * (size[0] + size[1]) + 2) * sizeof *u);
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu moves", size[0] * size[1]);
    size_t rows = sites(light, 0, u), columns = sites(light, 1, u + rows);
    nurbs_status status = sample(from, to, rows, u, columns, u + rows, &grid);
    if (!status)
        status = nurbs_surface_fit(degree, size, nurbs_surface_knots(light, 0),
                                   nurbs_surface_knots(light, 1), grid, u, u + rows, &fitted);
    if (!status)
        memcpy(move, nurbs_surface_points(fitted), 3 * size[0] * size[1] * sizeof *move);
    nurbs_surface_free(fitted);
    nurbs_grid_free(grid);
    free(u);
    return status;
}

static nurbs_status patch_moves(const nurbs_hull *hull, const nurbs_hull *moved, size_t p,
                                double *move)
{
    const nurbs_surface *light = nurbs_patches_get(hull->light, p),
                        *other = nurbs_patches_get(moved->light, p);
    /* Knots of their own may be the same by chance, but what a removal leaves out is not. */
    bool shared = hull->shares_space && moved->shares_space;
    if ((shared || hull->light == hull->wetted) && alike(light, other)) {
        subtract(light, other, move);
        return NURBS_OK;
    }
    if (nurbs_surface_weights(light))
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "patch %zu is rational, expected B-splines", p);
    return fit(nurbs_patches_get(hull->wetted, p), nurbs_patches_get(moved->wetted, p), light,
               move);
}

nurbs_status nurbs_hull_moves(const nurbs_hull *hull, const nurbs_hull *moved, double *move)
{
    if (!hull || !moved || !move)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "hull, moved or move is NULL");
    size_t n = nurbs_patches_count(hull->light);
    if (n != nurbs_patches_count(moved->light) || n != nurbs_patches_count(hull->wetted) ||
        n != nurbs_patches_count(moved->wetted))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "hulls of %zu and %zu patches", n,
                          nurbs_patches_count(moved->light));
    nurbs_status status = NURBS_OK;
    for (size_t p = 0; p < n && !status; p++) {
        status = patch_moves(hull, moved, p, move);
        move += 3 * points_of(nurbs_patches_get(hull->light, p));
    }
    return status;
}
