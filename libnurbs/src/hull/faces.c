/* Faces that bound a solid but are no hull: in the centre plane, in the water or level above it,
 * across the stern. */
#include "core/error.h"
#include "hull/hull.h"
#include "integrals/quadrature.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ORDER = 6, LIST_SIZE = 120 };

/* As nurbs_transom_patches(): |Int n dS| over the area, its x component, and the reach from the aft
 * end over the extent. */
static const double flat = 0.999, facing = 0.7, stern_reach = 0.05;
static const double plane_reach = 1e-5; /* of the extent: pieces of one plane */

/* Adds patch `index` of `from` with the parameters of its design grid. */
static nurbs_status add_patch(const nurbs_patches *from, size_t index, nurbs_patches *to)
{
    const double *u, *v;
    size_t rows = nurbs_patches_parameters(from, index, 0, &u),
           columns = nurbs_patches_parameters(from, index, 1, &v);
    nurbs_status status = nurbs_patches_add(to, nurbs_patches_get(from, index));
    return status
               ? status
               : nurbs_patches_set_parameters(to, nurbs_patches_count(to) - 1, rows, u, columns, v);
}

nurbs_status hull_start_patches(const nurbs_patches *from, nurbs_patches **to)
{
    nurbs_status status = nurbs_patches_create(to);
    if (!status)
        status = nurbs_patches_set_length(*to, nurbs_patches_length(from));
    return status ? status : nurbs_patches_set_note(*to, nurbs_patches_note(from));
}

/* "patches 2, 5" by the numbers of the file. */
static void name_patches(const nurbs_hull *hull, const bool *drop, char list[LIST_SIZE])
{
    size_t n = nurbs_patches_count(hull->full), count = 0, used = 0;
    for (size_t k = 0; k < n; k++)
        count += drop[k];
    used = (size_t)snprintf(list, LIST_SIZE, "%s", count == 1 ? "patch" : "patches");
    for (size_t k = 0, told = 0; k < n; k++) {
        if (!drop[k])
            continue;
        if (used + 40 > LIST_SIZE) {
            snprintf(list + used, LIST_SIZE - used, " and %zu more", count - told);
            return;
        }
        used += (size_t)snprintf(list + used, LIST_SIZE - used, "%s %zu", told++ ? "," : "",
                                 hull->number[k]);
    }
}

/* Leaves out the marked patches of full, if any, and says so. */
static nurbs_status leave_out(nurbs_hull *hull, const bool *drop, const char *why)
{
    char list[LIST_SIZE];
    size_t n = nurbs_patches_count(hull->full), kept = 0, dropped = 0;
    for (size_t k = 0; k < n; k++)
        dropped += drop[k];
    if (dropped == 0)
        return NURBS_OK;
    if (dropped == n)
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "all %zu patches %s: there is no hull", n, why);
    name_patches(hull, drop, list);
    nurbs_patches *rest = NULL;
    nurbs_status status = hull_start_patches(hull->full, &rest);
    for (size_t k = 0; k < n && !status; k++)
        if (!drop[k]) {
            status = add_patch(hull->full, k, rest);
            hull->number[kept++] = hull->number[k];
        }
    if (status) {
        nurbs_patches_free(rest);
        return status;
    }
    hull_replace_full(hull, rest);
    return hull_tell(hull, "%s: %s, no hull: left out", list, why);
}

/* Whether all control points of b lie in the plane of a flat patch a, and the boxes touch. */
static nurbs_status continues(const nurbs_hull *hull, const nurbs_surface *a,
                              const nurbs_surface *b, bool *yes)
{
    double clearance = plane_reach * hull->extent;
    hull_box box[2] = {hull_box_empty(), hull_box_empty()};
    patch_sums sums;
    nurbs_status status = hull_box_widen(a, &box[0]);
    if (!status)
        status = hull_box_widen(b, &box[1]);
    if (!status)
        status = patch_integrate(a, hull->level, ORDER, &sums);
    if (status)
        return status;
    const double *n = sums.normal, *from = nurbs_surface_points(a), *p = nurbs_surface_points(b);
    double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    *yes = size > 0;
    for (int c = 0; c < 3; c++)
        *yes &= box[1].lower[c] <= box[0].upper[c] + clearance &&
                box[1].upper[c] >= box[0].lower[c] - clearance;
    for (size_t k = 0; k < nurbs_surface_size(b, 0) * nurbs_surface_size(b, 1); k++, p += 3)
        *yes &= fabs((p[0] - from[0]) * n[0] + (p[1] - from[1]) * n[1] + (p[2] - from[2]) * n[2]) <=
                clearance * size;
    return NURBS_OK;
}

/* What lies beside a marked patch in its plane belongs to it: a transom in pieces. */
static nurbs_status mark_pieces(const nurbs_hull *hull, bool *drop)
{
    size_t n = nurbs_patches_count(hull->full);
    nurbs_status status = NURBS_OK;
    for (bool more = true; more && !status;) {
        more = false;
        for (size_t a = 0; a < n; a++)
            for (size_t b = 0; b < n && drop[a] && !status; b++) {
                bool yes = false;
                if (drop[b])
                    continue;
                status = continues(hull, nurbs_patches_get(hull->full, a),
                                   nurbs_patches_get(hull->full, b), &yes);
                drop[b] = yes;
                more |= yes;
            }
    }
    return status;
}

/* Marks patches by a rule: box is that of the patch, all that of every patch. */
typedef nurbs_status rule(const nurbs_hull *hull, const nurbs_surface *patch, const hull_box *box,
                          const hull_box *all, bool *drop);

static nurbs_status apply(nurbs_hull *hull, rule *applies, bool in_pieces, const char *why)
{
    hull_box all;
    size_t n = nurbs_patches_count(hull->full);
    bool *drop = calloc(n, sizeof *drop);
    nurbs_status status = drop ? hull_box_of(hull->full, &all)
                               : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    for (size_t k = 0; k < n && !status; k++) {
        const nurbs_surface *patch = nurbs_patches_get(hull->full, k);
        hull_box box = hull_box_empty();
        status = hull_box_widen(patch, &box);
        if (!status)
            status = applies(hull, patch, &box, &all, &drop[k]);
    }
    if (!status && in_pieces)
        status = mark_pieces(hull, drop);
    if (!status)
        status = leave_out(hull, drop, why);
    free(drop);
    return status;
}

static nurbs_status in_centre_plane(const nurbs_hull *hull, const nurbs_surface *patch,
                                    const hull_box *box, const hull_box *all, bool *drop)
{
    double clearance = HULL_CLEARANCE * hull->extent;
    (void)patch;
    (void)all;
    *drop = box->lower[1] >= -clearance && box->upper[1] <= clearance;
    return NURBS_OK;
}

static nurbs_status level_deck(const nurbs_hull *hull, const nurbs_surface *patch,
                               const hull_box *box, const hull_box *all, bool *drop)
{
    double clearance = HULL_CLEARANCE * hull->extent;
    (void)patch;
    (void)all;
    *drop = box->upper[2] - box->lower[2] <= clearance && box->lower[2] >= hull->level - clearance;
    return NURBS_OK;
}

static nurbs_status transom(const nurbs_hull *hull, const nurbs_surface *patch, const hull_box *box,
                            const hull_box *all, bool *drop)
{
    patch_sums sums;
    nurbs_status status = patch_integrate(patch, hull->level, ORDER, &sums);
    const double *s = sums.normal;
    *drop = false;
    if (status || nurbs_patches_count(hull->full) == 1)
        return status;
    double size = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    *drop = size > flat * sums.area && fabs(s[0]) > facing * size &&
            box->upper[0] < all->lower[0] + stern_reach * hull->extent &&
            box->upper[2] >= hull->level - HULL_CLEARANCE * hull->extent;
    return NURBS_OK;
}

nurbs_status hull_leave_out_centre(nurbs_hull *hull)
{
    return apply(hull, in_centre_plane, false, "in the centre plane");
}

nurbs_status hull_leave_out_covers(nurbs_hull *hull)
{
    nurbs_status status = apply(hull, level_deck, false, "level, in the still water or above it");
    return status ? status : apply(hull, transom, true, "a flat face across the stern, a transom");
}
