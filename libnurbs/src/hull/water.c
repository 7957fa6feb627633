/* Where the still water is, and what lies below it. */
#include "core/error.h"
#include "hull/hull.h"
#include "section/wetted.h"

#include <nurbs/modify.h>
#include <nurbs/section.h>
#include <nurbs/simplify.h>
#include <nurbs/topology.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double most_lift = 1e-3;    /* of the extent: more is no overshoot of a fit */
static const double centre_reach = 1e-5; /* of the extent: an edge this near lies in y = 0 */
static const double simplify_cut = 1e-4; /* of the extent, where nothing else is asked for */

/* The part below the level, in one piece along u, or along v where the lines of constant u do not
 * cross the level, or in strips. The message names the patch's own parameters. */
nurbs_status hull_cut_patch(const nurbs_surface *patch, double level, double extent,
                            double tolerance, nurbs_patches *below, double *deviation)
{
    nurbs_surface *swapped = NULL, *wetted = NULL;
    nurbs_patches *parts = NULL;
    nurbs_status status = surface_wetted(patch, level, tolerance, &wetted, deviation);
    if (status == NURBS_ERROR_GEOMETRY) {
        status = nurbs_surface_swap(patch, &swapped);
        if (!status)
            status = surface_wetted(swapped, level, tolerance, &wetted, deviation);
    }
    for (int turned = 0; turned < 2 && status == NURBS_ERROR_GEOMETRY; turned++) {
        nurbs_patches_free(parts);
        status = nurbs_patches_create(&parts);
        if (!status)
            status = hull_cut_strips(turned ? swapped : patch, level, extent, tolerance, parts,
                                     deviation);
    }
    if (status == NURBS_ERROR_GEOMETRY)
        status = surface_wetted(patch, level, tolerance, &wetted, deviation);
    if (!status && wetted)
        status = nurbs_patches_add(below, wetted);
    for (size_t k = 0; !status && !wetted && k < nurbs_patches_count(parts); k++)
        status = nurbs_patches_add(below, nurbs_patches_get(parts, k));
    nurbs_surface_free(swapped);
    nurbs_surface_free(wetted);
    nurbs_patches_free(parts);
    return status;
}

/* How far an edge lies beyond the centre plane, if all of it does, as far in one place as in
 * another: a half that was put beside it, and no overshoot. */
static double beside(const nurbs_surface *patch)
{
    const size_t n[2] = {nurbs_surface_size(patch, 0), nurbs_surface_size(patch, 1)};
    double most = 0;
    for (int e = 0; e < 4; e++) {
        size_t fixed = e % 2 ? n[e / 2] - 1 : 0, count = n[!(e / 2)];
        double low = INFINITY, high = -INFINITY;
        for (size_t k = 0; k < count; k++) {
            const double *at =
                nurbs_surface_points(patch) + 3 * (e < 2 ? fixed * n[1] + k : k * n[1] + fixed);
            low = fmin(low, at[1]);
            high = fmax(high, at[1]);
        }
        if (high < 0 && low > 1.1 * high)
            most = fmax(most, -high);
    }
    return most;
}

/* A half hull off the wrong side of the centre plane; *lifted NULL where nothing is to be done. */
static nurbs_status lift(nurbs_hull *hull, const nurbs_surface *patch, const hull_box *box,
                         nurbs_surface **lifted, double *moved)
{
    *lifted = NULL;
    *moved = 0;
    if (box->lower[1] >= 0 || box->upper[1] <= -box->lower[1] || nurbs_surface_weights(patch))
        return NURBS_OK;
    double off = beside(patch);
    if (off > centre_reach * hull->extent)
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "an edge of a patch lies %.3g m beyond the centre plane, all along it: "
                          "expected %.3g m at most",
                          off, centre_reach * hull->extent);
    nurbs_status status = nurbs_surface_raise_side(patch, lifted, moved);
    if (!status && *moved > most_lift * hull->extent)
        status =
            nurbs_fail(NURBS_ERROR_GEOMETRY,
                       "a patch reaches across the centre plane, to y = %.3g m: it takes moves "
                       "of %.3g m to bring it to y >= 0, expected at most %.3g m",
                       box->lower[1], *moved, most_lift * hull->extent);
    hull->lifted = fmax(hull->lifted, *moved);
    return status;
}

/* Puts a coordinate of edge e there, if all its control points are within the clearance. */
static void settle_edge(double *points, const size_t n[2], int e, size_t coordinate, double there,
                        double clearance)
{
    size_t fixed = e % 2 ? n[e / 2] - 1 : 0, count = n[!(e / 2)];
    double away = 0;
    for (int pass = 0; pass < 2; pass++)
        for (size_t k = 0; k < count; k++) {
            double *at = points + 3 * (e < 2 ? fixed * n[1] + k : k * n[1] + fixed) + coordinate;
            away = fmax(away, fabs(*at - there));
            if (pass == 1 && away <= clearance)
                *at = there;
        }
}

/* Edges that lie within the clearance of the water and as close to the centre plane as the cut has
 * to be, or as the lift moved points off it, are put there: a counter's profile that an
 * interpolation makes swing about the plane is no rim of a transom. */
nurbs_status hull_settle_edges(const nurbs_hull *hull, const nurbs_surface *patch, double level,
                               double moved, nurbs_surface **settled)
{
    double centre = fmax(moved, fmin(hull->options.cut, centre_reach * hull->extent));
    const size_t n[2] = {nurbs_surface_size(patch, 0), nurbs_surface_size(patch, 1)};
    const int degree[2] = {nurbs_surface_degree(patch, 0), nurbs_surface_degree(patch, 1)};
    double *points = malloc(3 * n[0] * n[1] * sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", n[0] * n[1]);
    memcpy(points, nurbs_surface_points(patch), 3 * n[0] * n[1] * sizeof *points);
    for (int e = 0; e < 4; e++) {
        settle_edge(points, n, e, 2, level, HULL_CLEARANCE * hull->extent);
        settle_edge(points, n, e, 1, 0, centre);
    }
    nurbs_status status = nurbs_surface_create(degree, n, nurbs_surface_knots(patch, 0),
                                               nurbs_surface_knots(patch, 1), points,
                                               nurbs_surface_weights(patch), settled);
    free(points);
    return status;
}

/* What of one patch lies below the level, moved so that the water lies at z = 0. */
static nurbs_status wet_patch(nurbs_hull *hull, const nurbs_surface *patch, double level, bool *cut,
                              nurbs_patches *wetted)
{
    double clearance = HULL_CLEARANCE * hull->extent, lifted_by = 0;
    hull_box box = hull_box_empty();
    nurbs_surface *lifted = NULL;
    nurbs_patches *below = NULL;
    *cut = false;
    nurbs_status status = hull_box_widen(patch, &box);
    if (status || box.lower[2] >= level - clearance)
        return status;
    *cut = box.upper[2] > level + clearance;
    status = nurbs_patches_create(&below);
    if (!status)
        status = lift(hull, patch, &box, &lifted, &lifted_by);
    const nurbs_surface *sound = lifted ? lifted : patch;
    if (!status)
        status = *cut ? hull_cut_patch(sound, level, hull->extent, hull->options.cut, below,
                                       &hull->deviation)
                      : nurbs_patches_add(below, sound);
    const double shift[3] = {0.0, 0.0, -level};
    for (size_t k = 0; !status && k < nurbs_patches_count(below); k++) {
        nurbs_surface *settled = NULL, *moved = NULL;
        status = hull_settle_edges(hull, nurbs_patches_get(below, k), level, lifted_by, &settled);
        if (!status && level != 0.0)
            status = nurbs_surface_transform(settled, NULL, shift, &moved);
        if (!status)
            status = nurbs_patches_add(wetted, moved ? moved : settled);
        nurbs_surface_free(settled);
        nurbs_surface_free(moved);
    }
    nurbs_surface_free(lifted);
    nurbs_patches_free(below);
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
    bool cut;
    size_t first = nurbs_patches_count(hull->wetted);
    double tolerance = hull->options.simplify;
    nurbs_status status =
        wet_patch(hull, nurbs_patches_get(hull->full, p), hull->level, &cut, hull->wetted);
    if (status)
        return status;
    hull->cut |= cut;
    if (isnan(tolerance))
        tolerance = cut ? simplify_cut : 0;
    for (size_t k = first; !status && k < nurbs_patches_count(hull->wetted); k++) {
        const nurbs_surface *wetted = nurbs_patches_get(hull->wetted, k);
        status = tolerance > 0 ? add_light(hull, wetted, tolerance * hull->extent)
                               : nurbs_patches_add(hull->light, wetted);
    }
    return status;
}

nurbs_status hull_wet(nurbs_hull *hull)
{
    nurbs_status status = nurbs_patches_create(&hull->wetted);
    if (!status)
        status = nurbs_patches_create(&hull->light);
    for (size_t p = 0; !status && p < nurbs_patches_count(hull->full); p++) {
        char place[40];
        snprintf(place, sizeof place, "patch %zu", hull->number[p]);
        status = wet_and_lighten(hull, p);
        if (status)
            return nurbs_fail_in(status, place);
    }
    if (status)
        return status;
    if (hull->lifted > HULL_CLEARANCE * hull->extent)
        status = hull_tell(hull, "lifted onto y >= 0, by at most %.3g m", hull->lifted);
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
        bool cut;
        status = wet_patch(hull, nurbs_patches_get(hull->full, p), 0.0, &cut, wetted);
    }
    if (!status)
        status = hull_box_of(wetted, &box);
    if (!status)
        status = hull_hydrostatics(wetted, box.lower[1] > -HULL_CLEARANCE * hull->extent, &h);
    nurbs_patches_free(wetted);
    *draft = h.keel_draft;
    if (!status && isnan(*draft))
        status = nurbs_fail(NURBS_ERROR_GEOMETRY, "nothing lies halfway along the waterline");
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
    hull_replace_full(hull, placed);
    return hull_tell(hull, "sunk by %g m and turned bow up by %g radians about x = %g m",
                     o->sinkage, o->trim, o->pivot);
}
