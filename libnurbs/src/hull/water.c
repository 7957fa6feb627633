/* Where the still water is, and what lies below it. */
#include "core/error.h"
#include "hull/hull.h"
#include "section/wetted.h"

#include <nurbs/modify.h>
#include <nurbs/simplify.h>
#include <nurbs/topology.h>

#include <math.h>

static const double simplify_cut = 1e-4; /* of the extent, where nothing else is asked for */

/* The part below the level; sections are lines of constant u, or of constant v where those do not
 * cross the level. */
static nurbs_status cut_patch(const nurbs_surface *patch, double level, double tolerance,
                              nurbs_surface **below, double *deviation)
{
    nurbs_surface *swapped = NULL;
    nurbs_status status = surface_wetted(patch, level, tolerance, below, deviation);
    if (status != NURBS_ERROR_GEOMETRY)
        return status;
    status = nurbs_surface_swap(patch, &swapped);
    if (!status)
        status = surface_wetted(swapped, level, tolerance, below, deviation);
    nurbs_surface_free(swapped);
    /* The message that names the patch's own parameters. */
    return status ? surface_wetted(patch, level, tolerance, below, deviation) : status;
}

/* One patch below the level, moved so that the water lies at z = 0; *wetted NULL when nothing of it
 * is below. */
static nurbs_status wet_patch(nurbs_hull *hull, const nurbs_surface *patch, double level, bool *cut,
                              nurbs_surface **wetted)
{
    double clearance = HULL_CLEARANCE * hull->extent;
    hull_box box = hull_box_empty();
    *wetted = NULL;
    *cut = false;
    nurbs_status status = hull_box_widen(patch, &box);
    if (status || box.lower[2] >= level - clearance)
        return status;
    nurbs_surface *below = NULL;
    double deviation = 0;
    *cut = box.upper[2] > level + clearance;
    status = *cut ? cut_patch(patch, level, hull->options.cut, &below, &deviation)
                  : nurbs_surface_copy(patch, &below);
    hull->deviation = fmax(hull->deviation, deviation);
    if (!status && level == 0.0) {
        *wetted = below;
        return NURBS_OK;
    }
    const double shift[3] = {0.0, 0.0, -level};
    if (!status)
        status = nurbs_surface_transform(below, NULL, shift, wetted);
    nurbs_surface_free(below);
    return status;
}

static nurbs_status add_light(nurbs_hull *hull, const nurbs_surface *wetted, double tolerance)
{
    nurbs_surface *light = NULL;
    double bound = 0;
    nurbs_status status = nurbs_surface_simplify(
        wetted, tolerance,
        NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_KEEP_KINKS | NURBS_SIMPLIFY_THRIFTY, &light,
        &bound);
    if (!status)
        status = nurbs_patches_add(hull->light, light);
    nurbs_surface_free(light);
    hull->bound = fmax(hull->bound, bound);
    return status;
}

static size_t control_points(const nurbs_patches *patches)
{
    size_t n = 0;
    for (size_t p = 0; p < nurbs_patches_count(patches); p++) {
        const nurbs_surface *surface = nurbs_patches_get(patches, p);
        n += nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
    }
    return n;
}

static nurbs_status wet_and_lighten(nurbs_hull *hull, size_t p)
{
    nurbs_surface *wetted;
    bool cut;
    double tolerance = hull->options.simplify;
    nurbs_status status =
        wet_patch(hull, nurbs_patches_get(hull->full, p), hull->level, &cut, &wetted);
    if (status || !wetted)
        return status;
    hull->cut |= cut;
    if (isnan(tolerance))
        tolerance = cut ? simplify_cut : 0;
    status = nurbs_patches_add(hull->wetted, wetted);
    if (!status && tolerance > 0)
        status = add_light(hull, wetted, tolerance * hull->extent);
    else if (!status)
        status = nurbs_patches_add(hull->light, wetted);
    nurbs_surface_free(wetted);
    return status;
}

nurbs_status hull_wet(nurbs_hull *hull)
{
    nurbs_status status = nurbs_patches_create(&hull->wetted);
    if (!status)
        status = nurbs_patches_create(&hull->light);
    for (size_t p = 0; !status && p < nurbs_patches_count(hull->full); p++)
        status = wet_and_lighten(hull, p);
    if (status)
        return status;
    if (nurbs_patches_count(hull->wetted) == 0)
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "nothing lies below the still water, z = %g m",
                          hull->level);
    return hull_tell(hull, "%s at z = %g m, %zu of %zu control points%s",
                     hull->cut                 ? "cut"
                     : hull->options.unbounded ? "whole, water left out"
                                               : "used as it is",
                     hull->level, control_points(hull->light), control_points(hull->full),
                     hull->bound > 0 ? " after simplification" : "");
}

/* Keel draft of the hull at the file's own level 0. */
static nurbs_status file_draft(nurbs_hull *hull, double *draft)
{
    nurbs_patches *wetted = NULL;
    nurbs_hydrostatics h = {0};
    hull_box box;
    nurbs_status status = nurbs_patches_create(&wetted);
    for (size_t p = 0; !status && p < nurbs_patches_count(hull->full); p++) {
        nurbs_surface *below;
        bool cut;
        status = wet_patch(hull, nurbs_patches_get(hull->full, p), 0.0, &cut, &below);
        if (!status && below)
            status = nurbs_patches_add(wetted, below);
        nurbs_surface_free(below);
    }
    if (!status)
        status = hull_box_of(wetted, &box);
    if (!status)
        status = hull_hydrostatics(wetted, box.lower[1] > -HULL_CLEARANCE * hull->extent, &h);
    nurbs_patches_free(wetted);
    *draft = h.keel_draft;
    return status ? nurbs_fail_in(status, "keel draft at z = 0") : NURBS_OK;
}

nurbs_status hull_choose_level(nurbs_hull *hull, const hull_box *box)
{
    hull->level = hull->options.level;
    if (hull->options.unbounded)
        hull->level = fmax(hull->level, box->upper[2] + hull->extent);
    else if (!isnan(hull->options.draft)) {
        double draft;
        nurbs_status status = file_draft(hull, &draft);
        if (status)
            return status;
        hull->level = hull->options.draft - draft;
    }
    return NURBS_OK;
}

nurbs_status hull_place(nurbs_hull *hull)
{
    const nurbs_hull_options *o = &hull->options;
    if (o->sinkage == 0.0 && o->trim == 0.0)
        return NURBS_OK;
    double c = cos(o->trim), s = sin(o->trim), x = o->pivot, level = hull->level;
    const double turn[9] = {c, 0, -s, 0, 1, 0, s, 0, c};
    const double shift[3] = {x - c * x + s * level, 0.0, level - s * x - c * level - o->sinkage};
    nurbs_patches *placed = NULL;
    nurbs_status status = nurbs_patches_transform(hull->full, turn, shift, &placed);
    if (status)
        return status;
    nurbs_patches_free(hull->full);
    hull->full = placed;
    return hull_tell(hull, "sunk by %g m and turned bow up by %g radians about x = %g m",
                     o->sinkage, o->trim, o->pivot);
}
