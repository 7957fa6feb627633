/* The design grid of a hull. */
#include "core/error.h"
#include "hull/hull.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double greville(int degree, const double *knots, size_t i)
{
    double sum = 0;
    for (int k = 1; k <= degree; k++)
        sum += knots[i + (size_t)k];
    return sum / degree;
}

/* Moves the nearest inner parameter onto each interior knot of multiplicity >= degree. */
static void snap_to_kinks(int degree, size_t size, const double *knots, size_t n, double *out)
{
    size_t p = (size_t)degree;
    for (size_t i = p + 1; i + p <= size; i++) {
        if (knots[i] != knots[i + p - 1] || knots[i] == knots[i - 1] || knots[i] == knots[size])
            continue;
        size_t best = 1;
        for (size_t k = 1; k + 1 < n; k++)
            if (fabs(out[k] - knots[i]) < fabs(out[best] - knots[i]))
                best = k;
        out[best] = knots[i];
    }
}

/* n parameters of one direction, spaced like its Greville abscissae; false: two coincide. */
static bool spread_parameters(const nurbs_surface *surface, int axis, size_t n, double *out)
{
    int degree = nurbs_surface_degree(surface, axis);
    size_t size = nurbs_surface_size(surface, axis);
    const double *knots = nurbs_surface_knots(surface, axis);
    for (size_t k = 0; k < n; k++) {
        double position = (double)(size - 1) * (double)k / (double)(n - 1);
        size_t i = (size_t)position;
        if (i > size - 2)
            i = size - 2;
        double share = position - (double)i;
        out[k] = (1 - share) * greville(degree, knots, i) + share * greville(degree, knots, i + 1);
    }
    if (degree > 1)
        snap_to_kinks(degree, size, knots, n, out);
    for (size_t k = 1; k < n; k++)
        if (!(out[k] > out[k - 1]))
            return false;
    return true;
}

/* The parameters that the file keeps for its own design grid, or such as suit the knots. */
static nurbs_status choose_parameters(const nurbs_patches *patches, size_t index, int axis,
                                      size_t n, double *out)
{
    const double *kept;
    if (n == nurbs_patches_parameters(patches, index, axis, &kept)) {
        memcpy(out, kept, n * sizeof *out);
        return NURBS_OK;
    }
    if (!spread_parameters(nurbs_patches_get(patches, index), axis, n, out))
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "%zu grid lines cannot be laid over the knots in direction %d", n, axis);
    return NURBS_OK;
}

static const nurbs_surface *find_patch(const nurbs_patches *patches, size_t index,
                                       nurbs_status *status)
{
    const nurbs_surface *surface = nurbs_patches_get(patches, index);
    *status = surface
                  ? NURBS_OK
                  : nurbs_fail(NURBS_ERROR_ARGUMENT, "no patch %zu, there are %zu (counted from 0)",
                               index, nurbs_patches_count(patches));
    return surface;
}

nurbs_status nurbs_patches_design_parameters(const nurbs_patches *patches, size_t index, int axis,
                                             size_t n, double *parameters)
{
    nurbs_status status;
    if (!patches || !parameters)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "patches or parameters is NULL");
    if (!find_patch(patches, index, &status))
        return status;
    if (axis < 0 || axis > 1 || n < 2)
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "%zu grid lines in direction %d, expected at least 2 in direction 0 or 1",
                          n, axis);
    return choose_parameters(patches, index, axis, n, parameters);
}

nurbs_status nurbs_patches_design_grid(const nurbs_patches *patches, size_t index, size_t rows,
                                       size_t columns, nurbs_grid **grid)
{
    size_t n[2] = {rows, columns};
    const double *kept;
    if (!patches || !grid)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "patches or grid is NULL");
    *grid = NULL;
    nurbs_status status;
    const nurbs_surface *surface = find_patch(patches, index, &status);
    if (!surface)
        return status;
    for (int a = 0; a < 2; a++) {
        if (n[a] == 0)
            n[a] = nurbs_patches_parameters(patches, index, a, &kept);
        if (n[a] == 0)
            n[a] = nurbs_surface_size(surface, a);
        if (n[a] < 2)
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "a design grid of %zu %s, expected at least 2",
                              n[a], a ? "columns" : "rows");
    }
    double *u = malloc((n[0] + n[1]) * sizeof *u);
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu parameters", n[0] + n[1]);
    status = choose_parameters(patches, index, 0, n[0], u);
    if (!status)
        status = choose_parameters(patches, index, 1, n[1], u + n[0]);
    if (!status)
        status = nurbs_grid_sample(surface, n[0], u, n[1], u + n[0], grid);
    free(u);
    return status;
}

nurbs_status nurbs_hull_design_grid(const nurbs_hull *hull, size_t rows, size_t columns,
                                    nurbs_grid **grid)
{
    if (!hull || !grid)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "hull or grid is NULL");
    *grid = NULL;
    if (nurbs_patches_count(hull->full) != 1)
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "%zu patches, expected one that covers the side of the hull",
                          nurbs_patches_count(hull->full));
    return nurbs_patches_design_grid(hull->full, 0, rows, columns, grid);
}
