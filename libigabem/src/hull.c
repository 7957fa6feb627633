#include "hull.h"

#include "error.h"

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

/* libnurbs integrates over the half hull and doubles; a body given whole has been counted twice. */
static void halve(nurbs_hydrostatics *h)
{
    h->wetted_area /= 2;
    h->volume /= 2;
    h->waterplane_area /= 2;
    h->waterplane_inertia_x /= 2;
    h->waterplane_inertia_y /= 2;
    h->transom_area /= 2;
    h->section_area_max /= 2;
}

/* The patch on the side y >= 0. Creates *side. */
static igabem_status to_port(const struct igabem_hull *hull, size_t p, nurbs_surface **side)
{
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const double mirror[9] = {1, 0, 0, 0, -1, 0, 0, 0, 1};
    const double none[3] = {0, 0, 0}, tolerance = 1e-6 * hull->extent;
    const double *box = hull->patches[p].side;
    if (box[0] < -tolerance && box[1] > tolerance)
        return igabem_fail(IGABEM_ERROR_GEOMETRY,
                           "patch %zu runs from y = %.6g to %.6g m: a body given whole must be "
                           "divided at its centre plane (or given as a half, y >= 0)",
                           p, box[0], box[1]);
    const double *matrix = box[0] < -tolerance ? mirror : identity;
    nurbs_status status = nurbs_surface_transform(hull->patches[p].surface, matrix, none, side);
    return status ? hull_nurbs_fail(status, "mirroring a patch") : IGABEM_OK;
}

static igabem_status find_hydrostatics(struct igabem_hull *hull)
{
    nurbs_surface **half = calloc(hull->n, sizeof *half);
    igabem_status status = IGABEM_OK;
    if (!half)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu patches", hull->n);
    for (size_t p = 0; !status && p < hull->n; p++)
        status = to_port(hull, p, &half[p]);
    if (!status) {
        nurbs_status computed = nurbs_hydrostatics_compute(
            hull->n, (const nurbs_surface *const *)half, 0.0, &hull->hydrostatics);
        if (computed)
            status = hull_nurbs_fail(computed, "hydrostatics");
    }
    for (size_t p = 0; p < hull->n; p++)
        nurbs_surface_free(half[p]);
    free(half);
    if (status)
        return status;
    if (!hull->symmetric)
        halve(&hull->hydrostatics);
    if (!(hull->hydrostatics.volume > 0))
        return igabem_fail(IGABEM_ERROR_GEOMETRY,
                           "the patches enclose the volume %g m^3, expected a positive one: are "
                           "patches missing or folded?",
                           hull->hydrostatics.volume);
    return IGABEM_OK;
}

static igabem_status analyse(struct igabem_hull *hull)
{
    igabem_status status = hull_orient(hull);
    if (!status)
        status = hull_check(hull);
    if (!status)
        status = hull_classify_edges(hull);
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
    if (!hull || !(length > 0) || !isfinite(length))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "reference length %g m, expected a positive number", length);
    hull->length = length;
    return IGABEM_OK;
}

void igabem_hull_get_info(const igabem_hull *hull, igabem_hull_info *info)
{
    if (!hull || !info)
        return;
    *info = (igabem_hull_info){.length = hull->length,
                               .hydrostatics = hull->hydrostatics,
                               .surface_piercing = hull->surface_piercing,
                               .transom = hull->transom,
                               .nu_s = hull->nu_s,
                               .patches = hull->n};
}
