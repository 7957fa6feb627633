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

/* libnurbs integrates over a half hull and doubles: of a body given whole each side counts half. */
static void add_side(nurbs_hydrostatics *sum, const nurbs_hydrostatics *side)
{
    double volume = side->volume / 2, plane = side->waterplane_area / 2;
    double all = sum->volume + volume, planes = sum->waterplane_area + plane;
    for (int k = 0; k < 3; k++)
        sum->centroid[k] = (sum->volume * sum->centroid[k] + volume * side->centroid[k]) / all;
    if (planes > 0) {
        double apart = side->waterplane_centre - sum->waterplane_centre;
        sum->waterplane_inertia_y +=
            side->waterplane_inertia_y / 2 + sum->waterplane_area * plane / planes * apart * apart;
        sum->waterplane_centre += plane / planes * apart;
    }
    sum->volume = all;
    sum->waterplane_area = planes;
    sum->waterplane_inertia_x += side->waterplane_inertia_x / 2;
    sum->wetted_area += side->wetted_area / 2;
    sum->transom_area += side->transom_area / 2;
    sum->section_area_max += side->section_area_max / 2;
    sum->section_area_max_x = side->section_area_max_x;
    sum->beam += side->beam / 2;
    sum->draft = fmax(sum->draft, side->draft);
    sum->keel_draft = fmax(sum->keel_draft, side->keel_draft);
    sum->x_aft = fmin(sum->x_aft, side->x_aft);
    sum->x_fore = fmax(sum->x_fore, side->x_fore);
    sum->error = fmax(sum->error, side->error);
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

/* Hydrostatics of the patches on the side of patch `first`, from there on, as a half hull doubled.
 */
static igabem_status side_hydrostatics(const struct igabem_hull *hull, size_t first,
                                       nurbs_hydrostatics *side)
{
    nurbs_surface **half = calloc(hull->n, sizeof *half);
    size_t n = 0;
    igabem_status status = IGABEM_OK;
    if (!half)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu patches", hull->n);
    for (size_t p = first; !status && p < hull->n; p++)
        if (hull_same_side(&hull->patches[first], &hull->patches[p]))
            status = to_port(hull, p, &half[n++]);
    if (!status) {
        nurbs_status computed =
            nurbs_hydrostatics_compute(n, (const nurbs_surface *const *)half, 0.0, side);
        if (computed)
            status = hull_nurbs_fail(computed, "hydrostatics");
    }
    for (size_t p = 0; p < n; p++)
        nurbs_surface_free(half[p]);
    free(half);
    return status;
}

static igabem_status find_hydrostatics(struct igabem_hull *hull)
{
    nurbs_hydrostatics *h = &hull->hydrostatics, side;
    igabem_status status = side_hydrostatics(hull, 0, h);
    if (!status && !hull->symmetric) {
        side = *h;
        *h = (nurbs_hydrostatics){.x_aft = INFINITY, .x_fore = -INFINITY};
        add_side(h, &side);
        size_t other = 1;
        while (other < hull->n && hull_same_side(&hull->patches[0], &hull->patches[other]))
            other++;
        if (other < hull->n)
            status = side_hydrostatics(hull, other, &side);
        if (other < hull->n && !status)
            add_side(h, &side);
    }
    if (status)
        return status;
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
    const nurbs_surface **list = malloc(hull->n * sizeof(const nurbs_surface *));
    int *closes = malloc(hull->n * sizeof *closes);
    igabem_status status = IGABEM_OK;
    if (!list || !closes)
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu patches", hull->n);
    for (size_t p = 0; p < hull->n && !status; p++)
        list[p] = hull->patches[p].surface;
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
