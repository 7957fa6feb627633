/* Hydrostatics of a hull whose surfaces cover one side, or both. */
#include "core/error.h"
#include "hull/hull.h"

#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>

static const double mirror[9] = {1, 0, 0, 0, -1, 0, 0, 0, 1};

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

static nurbs_status port_patch(const nurbs_surface *surface, size_t p, double tolerance,
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

/* The patches of one side at y >= 0. Creates *side. */
static nurbs_status one_side(const nurbs_patches *patches, bool starboard, double tolerance,
                             nurbs_patches **side)
{
    nurbs_status status = nurbs_patches_create(side);
    for (size_t p = 0; !status && p < nurbs_patches_count(patches); p++) {
        const nurbs_surface *surface = nurbs_patches_get(patches, p);
        nurbs_surface *turned = NULL;
        bool here = false;
        status = port_patch(surface, p, tolerance, &here);
        if (status || here != starboard)
            continue;
        if (starboard)
            status = nurbs_surface_transform(surface, mirror, NULL, &turned);
        if (!status)
            status = nurbs_patches_add(*side, turned ? turned : surface);
        nurbs_surface_free(turned);
    }
    return status;
}

static nurbs_status half_hydrostatics(const nurbs_patches *half, nurbs_hydrostatics *result)
{
    size_t n = nurbs_patches_count(half);
    const nurbs_surface **list = malloc((n + 1) * sizeof(const nurbs_surface *));
    if (!list)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    for (size_t p = 0; p < n; p++)
        list[p] = nurbs_patches_get(half, p);
    nurbs_status status = nurbs_hydrostatics_compute(n, list, 0.0, result);
    free(list);
    return status;
}

nurbs_status hull_hydrostatics(const nurbs_patches *wetted, bool half, nurbs_hydrostatics *sum)
{
    if (half)
        return half_hydrostatics(wetted, sum);
    hull_box box;
    nurbs_status status = hull_box_of(wetted, &box);
    *sum = (nurbs_hydrostatics){.x_aft = INFINITY, .x_fore = -INFINITY};
    for (int s = 0; s < 2 && !status; s++) {
        nurbs_patches *side = NULL;
        nurbs_hydrostatics h;
        status = one_side(wetted, s == 1, HULL_CLEARANCE * (box.upper[0] - box.lower[0]), &side);
        if (!status && nurbs_patches_count(side) > 0) {
            status = half_hydrostatics(side, &h);
            if (!status)
                add_side(sum, &h);
        }
        nurbs_patches_free(side);
    }
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
