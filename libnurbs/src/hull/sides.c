/* Hydrostatics of a hull whose surfaces cover one side, or both. */
#include "core/error.h"
#include "hull/hull.h"

#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>

static const double mirror[9] = {1, 0, 0, 0, -1, 0, 0, 0, 1};

/* Each side was taken for a half hull and doubled: it counts half. */
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

/* Whether a patch lies to starboard. */
static nurbs_status find_side(const nurbs_surface *surface, size_t p, double tolerance,
                              bool *starboard)
{
    hull_box box = hull_box_empty();
    nurbs_status status = hull_box_widen(surface, &box);
    if (status)
        return status;
    *starboard = box.lower[1] + box.upper[1] < 0;
    if (box.lower[1] < -tolerance && box.upper[1] > tolerance)
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "patch %zu runs from y = %.6g to %.6g m: a body given whole must be "
                          "divided at its centre plane (or given as a half, y >= 0)",
                          p, box.lower[1], box.upper[1]);
    return NURBS_OK;
}

/* The surfaces of one side at y >= 0. Fills side[n], of which *count are created. */
static nurbs_status one_side(size_t n, const nurbs_surface *const *wetted, bool starboard,
                             double tolerance, nurbs_surface **side, size_t *count)
{
    nurbs_status status = NURBS_OK;
    *count = 0;
    for (size_t p = 0; !status && p < n; p++) {
        bool here = false;
        status = find_side(wetted[p], p, tolerance, &here);
        if (!status && here == starboard)
            status = starboard ? nurbs_surface_transform(wetted[p], mirror, NULL, &side[(*count)++])
                               : nurbs_surface_copy(wetted[p], &side[(*count)++]);
    }
    return status;
}

nurbs_status nurbs_hydrostatics_whole(size_t n, const nurbs_surface *const *wetted, double level,
                                      nurbs_hydrostatics *result)
{
    if (n == 0 || !wetted || !result)
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "nurbs_hydrostatics_whole: surfaces and a result are expected");
    hull_box box = hull_box_empty();
    nurbs_status status = NURBS_OK;
    nurbs_surface **side = calloc(n, sizeof *side);
    if (!side)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    for (size_t p = 0; p < n && !status; p++)
        status = hull_box_widen(wetted[p], &box);
    *result = (nurbs_hydrostatics){.x_aft = INFINITY, .x_fore = -INFINITY};
    for (int s = 0; s < 2 && !status; s++) {
        nurbs_hydrostatics h;
        size_t count;
        status = one_side(n, wetted, s == 1, HULL_CLEARANCE * (box.upper[0] - box.lower[0]), side,
                          &count);
        if (!status && count)
            status =
                nurbs_hydrostatics_compute(count, (const nurbs_surface *const *)side, level, &h);
        if (!status && count)
            add_side(result, &h);
        for (size_t p = 0; p < n; p++) {
            nurbs_surface_free(side[p]);
            side[p] = NULL;
        }
    }
    free(side);
    return status;
}

nurbs_status hull_hydrostatics(const nurbs_patches *wetted, bool half, nurbs_hydrostatics *result)
{
    size_t n = nurbs_patches_count(wetted);
    const nurbs_surface **list = malloc((n + 1) * sizeof(const nurbs_surface *));
    if (!list)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    for (size_t p = 0; p < n; p++)
        list[p] = nurbs_patches_get(wetted, p);
    nurbs_status status = half ? nurbs_hydrostatics_compute(n, list, 0.0, result)
                               : nurbs_hydrostatics_whole(n, list, 0.0, result);
    free(list);
    return status;
}

nurbs_status hull_side(nurbs_hull *hull)
{
    hull_box box;
    nurbs_status status = hull_box_of(hull->wetted, &box);
    hull->half = box.lower[1] > -HULL_CLEARANCE * (box.upper[0] - box.lower[0]);
    return status;
}

nurbs_status hull_measure(nurbs_hull *hull)
{
    nurbs_status status = hull_hydrostatics(hull->wetted, hull->half, &hull->hydrostatics);
    hull->waterline = hull->hydrostatics.waterplane_area > 0;
    return status;
}
