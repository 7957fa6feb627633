#include "hull/hull.h"

#include "core/error.h"

#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static igabem_status copy_patches(struct igabem_hull *hull, const nurbs_surface *const *patches,
                                  size_t n)
{
    hull->patches = calloc(n, sizeof *hull->patches);
    if (!hull->patches)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu patches", n);
    for (; hull->n < n; hull->n++) {
        if (!patches[hull->n])
            return igabem_fail(IGABEM_ERROR_ARGUMENT, "patch %zu is NULL", hull->n);
        struct hull_patch *patch = &hull->patches[hull->n];
        nurbs_status status = nurbs_surface_copy(patches[hull->n], &patch->surface);
        if (status)
            return hull_nurbs_fail(status, "copying a patch");
        patch->sign = 1.0;
        for (int d = 0; d < 2; d++) {
            const double *knots = nurbs_surface_knots(patch->surface, d);
            patch->domain[d][0] = knots[0];
            patch->domain[d][1] = knots[nurbs_surface_size(patch->surface, d) +
                                        (size_t)nurbs_surface_degree(patch->surface, d)];
        }
    }
    return IGABEM_OK;
}

/* The patches as libnurbs takes them; to be freed, NULL without memory. */
static const nurbs_surface **surfaces_of(const struct igabem_hull *hull)
{
    const nurbs_surface **list = malloc(hull->n * sizeof(const nurbs_surface *));
    if (!list)
        igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu patches", hull->n);
    for (size_t p = 0; list && p < hull->n; p++)
        list[p] = hull->patches[p].surface;
    return list;
}

static igabem_status find_hydrostatics(struct igabem_hull *hull)
{
    const nurbs_surface **list = surfaces_of(hull);
    nurbs_hydrostatics *h = &hull->hydrostatics;
    if (!list)
        return IGABEM_ERROR_MEMORY;
    nurbs_status status = hull->symmetric ? nurbs_hydrostatics_compute(hull->n, list, 0.0, h)
                                          : nurbs_hydrostatics_whole(hull->n, list, 0.0, h);
    free(list);
    if (status)
        return hull_nurbs_fail(status, "hydrostatics");
    if (!(h->volume > 0))
        return igabem_fail(IGABEM_ERROR_GEOMETRY,
                           "the patches enclose the volume %g m^3, expected a positive one: are "
                           "patches missing or folded?",
                           h->volume);
    return IGABEM_OK;
}

/* Which patches close the stern. */
static igabem_status find_transom(struct igabem_hull *hull)
{
    const nurbs_surface **list = surfaces_of(hull);
    int *closes = malloc(hull->n * sizeof *closes);
    igabem_status status = IGABEM_OK;
    if (!list || !closes)
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu patches", hull->n);
    if (!status && nurbs_transom_patches(hull->n, list, 0.0, closes))
        status = hull_nurbs_fail(NURBS_ERROR_GEOMETRY, "the stern");
    for (size_t p = 0; p < hull->n && !status; p++) {
        hull->patches[p].transom = closes[p];
        if (closes[p])
            hull->transom = IGABEM_TRANSOM_CLOSED;
    }
    free(list);
    free(closes);
    return status;
}

static igabem_status analyse(struct igabem_hull *hull)
{
    nurbs_topology topology = {0};
    igabem_status status = hull_bounds(hull);
    if (!status)
        status = hull_topology(hull, &topology);
    if (!status)
        status = hull_orient(hull, &topology);
    if (!status)
        status = hull_check(hull);
    if (!status)
        status = hull_measure(hull);
    if (!status)
        status = find_transom(hull);
    if (!status)
        status = hull_classify_edges(hull);
    if (!status)
        status = hull_check_joints(hull, &topology);
    nurbs_topology_free(&topology);
    if (!status)
        status = hull_check_submergence(hull);
    if (!status)
        status = find_hydrostatics(hull);
    if (!status)
        status = hull_waterline_angle(hull, &hull->nu_s);
    if (status)
        return status;
    const nurbs_hydrostatics *h = &hull->hydrostatics;
    hull->length = hull->surface_piercing ? h->x_fore - h->x_aft : hull->extent;
    return IGABEM_OK;
}

igabem_status igabem_hull_create(const nurbs_surface *const *patches, size_t n, unsigned flags,
                                 igabem_hull **hull)
{
    if (!hull)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "hull is NULL, expected where to store it");
    *hull = NULL;
    if (!patches || n == 0)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "no patches, expected at least one");
    for (size_t k = 0; k < n; k++)
        if (!patches[k])
            return igabem_fail(IGABEM_ERROR_ARGUMENT, "patch %zu is NULL", k);
    if (flags & ~(unsigned)IGABEM_SYMMETRIC)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "flags %#x, expected 0 or IGABEM_SYMMETRIC",
                           flags);
    struct igabem_hull *result = calloc(1, sizeof *result);
    if (!result)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a hull");
    result->symmetric = (flags & IGABEM_SYMMETRIC) != 0;
    igabem_status status = copy_patches(result, patches, n);
    if (!status)
        status = analyse(result);
    if (status) {
        igabem_hull_free(result);
        return status;
    }
    *hull = result;
    return IGABEM_OK;
}

void igabem_hull_free(igabem_hull *hull)
{
    if (!hull)
        return;
    for (size_t p = 0; p < hull->n; p++)
        nurbs_surface_free(hull->patches[p].surface);
    free(hull->patches);
    free(hull);
}

igabem_status igabem_hull_set_length(igabem_hull *hull, double length)
{
    if (!hull)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_hull_set_length");
    if (!(length > 0) || !isfinite(length))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "reference length %g m, expected a positive number", length);
    hull->length = length;
    return IGABEM_OK;
}

void igabem_hull_get_info(const igabem_hull *hull, igabem_hull_info *info)
{
    if (!info)
        return;
    *info = (igabem_hull_info){0};
    if (!hull)
        return;
    *info = (igabem_hull_info){.length = hull->length,
                               .hydrostatics = hull->hydrostatics,
                               .surface_piercing = hull->surface_piercing,
                               .transom = hull->transom,
                               .nu_s = hull->nu_s,
                               .patches = hull->n};
}
