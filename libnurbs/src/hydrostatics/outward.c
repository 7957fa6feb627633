/* Which way the patches of a body face, and which of them close its stern. */
#include "core/error.h"
#include "hydrostatics/hydro_parts.h"
#include "integrals/quadrature.h"

#include <nurbs/topology.h>

#include <math.h>
#include <stdlib.h>

enum { ORDER = 6 };

/* Relative to the length of the body. */
static const double join_tolerance = 1e-4;
static const double stern_reach = 0.05;
/* |Int n dS| over the area: a face is flat; its x component: it faces aft. */
static const double flat = 0.999, facing = 0.7;

static double extent_x(size_t n, const patch_sums *sums)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < n; k++) {
        low = fmin(low, sums[k].low[0]);
        high = fmax(high, sums[k].high[0]);
    }
    return high - low;
}

static nurbs_status sum_each(size_t n, const nurbs_surface *const *patches, double level,
                             patch_sums **sums)
{
    *sums = malloc(n * sizeof **sums);
    if (!*sums)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    for (size_t k = 0; k < n; k++) {
        nurbs_status status = patch_integrate(patches[k], level, ORDER, &(*sums)[k]);
        if (status != NURBS_OK)
            return status;
    }
    return NURBS_OK;
}

static nurbs_status find_topology(size_t n, const nurbs_surface *const *patches, double tolerance,
                                  nurbs_topology *topology)
{
    nurbs_patches *list;
    *topology = (nurbs_topology){0};
    nurbs_status status = nurbs_patches_create(&list);
    for (size_t k = 0; k < n && status == NURBS_OK; k++)
        status = nurbs_patches_add(list, patches[k]);
    if (status == NURBS_OK)
        status = nurbs_patches_topology(list, tolerance, topology);
    nurbs_patches_free(list);
    return status;
}

/* The level, or the top of a body far below it: its closed parts have one volume whatever the plane
 * that depths count from, but errors of quadrature grow with the depth. */
static double nearest_level(size_t n, const patch_sums *sums, double level)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < n; k++) {
        low = fmin(low, sums[k].low[2]);
        high = fmax(high, sums[k].high[2]);
    }
    return level - high > high - low ? high : level;
}

nurbs_status outward_signs(size_t n, const nurbs_surface *const *patches, double level, int *sign)
{
    patch_sums *sums = NULL;
    nurbs_topology topology = {0};
    size_t *part = calloc(n, sizeof *part), parts = 1;
    double *volume = calloc(n, sizeof *volume);
    nurbs_status status = part && volume
                              ? sum_each(n, patches, level, &sums)
                              : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    sign[0] = 1;
    if (status == NURBS_OK && n > 1)
        status = find_topology(n, patches, join_tolerance * extent_x(n, sums), &topology);
    if (status == NURBS_OK && n > 1)
        status = nurbs_topology_orient(&topology, sign, part, &parts);
    /* The divergence theorem with (0, y, 0) and with (0, 0, z - level) gives the volume twice: on
     * y = 0 and on the level these vectors have no normal component. */
    double drop = status == NURBS_OK ? level - nearest_level(n, sums, level) : 0;
    for (size_t k = 0; k < n && status == NURBS_OK; k++)
        volume[part[k]] += sign[k] * (sums[k].y_ny - (sums[k].depth_nz - drop * sums[k].normal[2]));
    for (size_t k = 0; k < n && status == NURBS_OK; k++)
        sign[k] *= volume[part[k]] < 0 ? -1 : 1;
    nurbs_topology_free(&topology);
    free(sums);
    free(part);
    free(volume);
    return status;
}

static int reaches_level(const nurbs_surface *surface, double level)
{
    int edges = 0;
    for (int e = 0; e < 4; e++)
        edges += edge_at_level(surface, e, level);
    return edges > 0;
}

nurbs_status nurbs_transom_patches(size_t n, const nurbs_surface *const *wetted, double level,
                                   int *closes)
{
    NURBS_NEED(n == 0 || (wetted && closes));
    patch_sums *sums = NULL;
    if (n == 0)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no patches");
    closes[0] = 0;
    if (n == 1)
        return NURBS_OK;
    nurbs_status status = sum_each(n, wetted, level, &sums);
    double aft = INFINITY;
    for (size_t k = 0; k < n && status == NURBS_OK; k++)
        aft = fmin(aft, sums[k].low[0]);
    for (size_t k = 0; k < n && status == NURBS_OK; k++) {
        const double *s = sums[k].normal;
        double size = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        closes[k] = size > flat * sums[k].area && fabs(s[0]) > facing * size &&
                    sums[k].high[0] < aft + stern_reach * extent_x(n, sums) &&
                    reaches_level(wetted[k], level);
    }
    free(sums);
    return status;
}
