/* The hull through a moved design grid, and the space that such hulls share. */
#include "core/error.h"
#include "hull/hull.h"
#include "hull/space.h"
#include "section/wetted.h"

#include <nurbs/simplify.h>

#include <math.h>
#include <stdlib.h>

/* The cut at the waterline is this much finer than the simplification, so that it never matters. */
static const double cut_share = 0.1;
/* A shared space has the knots of a removal at this part of the tolerance: what is left of it is
 * for the designs. */
static const double knot_share = 0.3;
static const double default_tolerance = 1e-4; /* of the length */

static nurbs_status add_to(nurbs_patches **patches, const nurbs_surface *surface)
{
    nurbs_status status = nurbs_patches_create(patches);
    return status ? status : nurbs_patches_add(*patches, surface);
}

/* The sentence begins with the stage. */
static nurbs_status stage(nurbs_status status, const char *name)
{
    return status ? nurbs_fail_in(status, name) : NURBS_OK;
}

static double tolerance(const nurbs_hull *hull)
{
    double share = isnan(hull->options.simplify) ? default_tolerance : hull->options.simplify;
    return share * hull->length;
}

/* A stem that a section through the grid's points leaves by less than the tolerance stays in the
 * centre plane, as in a hull that is read. */
static nurbs_status skin_and_cut(const nurbs_hull *hull, const hull_space *space,
                                 const nurbs_grid *grid, nurbs_surface **full,
                                 nurbs_surface **wetted, double *deviation)
{
    nurbs_surface *cut = NULL;
    nurbs_status status = stage(hull_space_skin(space, grid, full), "skin");
    if (!status)
        status = stage(surface_wetted(*full, 0, cut_share * tolerance(hull), &cut, deviation),
                       "waterline");
    if (!status)
        status = hull_settle_edges(hull, cut, 0, tolerance(hull), wetted);
    nurbs_surface_free(cut);
    return status;
}

static nurbs_status thin(const nurbs_surface *wetted, double within, nurbs_surface **light,
                         double *bound)
{
    return stage(nurbs_surface_simplify(wetted, within,
                                        NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_THRIFTY, light,
                                        bound),
                 "simplify");
}

/* On the shared space, or on knots of its own where that does not hold it. */
static nurbs_status lighten(nurbs_hull *hull, const hull_space *space, const nurbs_surface *wetted,
                            nurbs_surface **light)
{
    double within = tolerance(hull);
    if (space) {
        nurbs_status status =
            stage(hull_space_fit(space, wetted, light, &hull->bound, NULL), "fit");
        if (status)
            return status;
        hull->shares_space = hull->bound <= within;
        if (hull->shares_space)
            return NURBS_OK;
        nurbs_surface_free(*light);
        *light = NULL;
        status =
            hull_tell(hull, "the shared space is %.3g m off, more than %.3g m: knots of its own",
                      hull->bound, within);
        if (status)
            return status;
    }
    return thin(wetted, within, light, &hull->bound);
}

static nurbs_status build(nurbs_hull *hull, const hull_space *space, const nurbs_grid *grid)
{
    nurbs_surface *full = NULL, *wetted = NULL, *light = NULL;
    nurbs_status status = skin_and_cut(hull, space, grid, &full, &wetted, &hull->deviation);
    if (!status)
        status = add_to(&hull->full, full);
    if (!status)
        status = add_to(&hull->wetted, wetted);
    if (!status)
        status = lighten(hull, space, wetted, &light);
    if (!status)
        status = add_to(&hull->light, light);
    if (!status)
        status = stage(hull_hydrostatics(hull->wetted, true, &hull->hydrostatics), "hydrostatics");
    if (!status)
        status = hull_tell(hull, "cut at z = 0 m, %zu of %zu control points after simplification",
                           nurbs_surface_size(light, 0) * nurbs_surface_size(light, 1),
                           nurbs_surface_size(full, 0) * nurbs_surface_size(full, 1));
    nurbs_surface_free(full);
    nurbs_surface_free(wetted);
    nurbs_surface_free(light);
    return status;
}

nurbs_status nurbs_hull_rebuild(const nurbs_hull *parent, const nurbs_grid *grid, nurbs_hull **hull)
{
    if (!parent || !grid || !hull)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "parent, grid or hull is NULL");
    *hull = NULL;
    nurbs_hull *result = calloc(1, sizeof *result);
    if (!result)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a hull");
    *result = (nurbs_hull){.options = parent->options,
                           .extent = parent->extent,
                           .length = parent->length,
                           .lpp = parent->lpp,
                           .half = true,
                           .cut = true,
                           .waterline = true};
    nurbs_status status = build(result, parent->space, grid);
    if (status) {
        nurbs_hull_free(result);
        return status;
    }
    *hull = result;
    return NURBS_OK;
}

/* The knots of the parent. */
static nurbs_status start_space(const nurbs_hull *parent, const nurbs_grid *grid,
                                hull_space **space)
{
    nurbs_surface *full = NULL, *wetted = NULL, *light = NULL;
    double deviation;
    nurbs_status status = skin_and_cut(parent, NULL, grid, &full, &wetted, &deviation);
    if (!status)
        status = thin(wetted, knot_share * tolerance(parent), &light, NULL);
    if (!status)
        status = hull_space_create(grid, light, space);
    nurbs_surface_free(full);
    nurbs_surface_free(wetted);
    nurbs_surface_free(light);
    return status;
}

/* Those that this design needs in addition. */
static nurbs_status widen_space(const nurbs_hull *parent, const nurbs_grid *design,
                                hull_space *space)
{
    nurbs_surface *full = NULL, *wetted = NULL;
    double deviation;
    nurbs_status status = skin_and_cut(parent, space, design, &full, &wetted, &deviation);
    if (!status)
        status = hull_space_widen(space, wetted, tolerance(parent));
    nurbs_surface_free(full);
    nurbs_surface_free(wetted);
    return status;
}

nurbs_status nurbs_hull_share_space(nurbs_hull *parent, const nurbs_grid *grid, size_t n,
                                    const nurbs_grid *const *designs)
{
    hull_space *space;
    if (!parent || !grid || (n && !designs))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "parent, grid or designs is NULL");
    nurbs_status status = start_space(parent, grid, &space);
    if (status)
        return status;
    for (size_t k = 0; k < n && !status; k++) {
        status = widen_space(parent, designs[k], space);
        /* A design that cannot be built has no say. */
        if (status == NURBS_ERROR_GEOMETRY)
            status = NURBS_OK;
    }
    if (status) {
        hull_space_free(space);
        return status;
    }
    hull_space_free(parent->space);
    parent->space = space;
    return NURBS_OK;
}

bool nurbs_hull_shares_space(const nurbs_hull *hull)
{
    return hull && hull->shares_space;
}
