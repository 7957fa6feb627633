/* In each step the buoyancy is exact for the placed hull, lift and moment are the solver's, and the
 * attitude changes by the residual over the hydrostatic stiffness rho g A and rho g I_L of the
 * waterplane. */
#include "core/error.h"
#include "hull/hull.h"

#include <igabem/equilibrium.h>

#include <math.h>

enum { MOST_SOLVES = 20 };
static const double tolerance = 1e-5; /* of the length: change of draft at the worse end */

struct rest {
    double volume, centre; /* m^3, x of the centre of buoyancy and so of gravity */
    double extent;         /* m */
};

/* Sinkage and trim that are still to be added. */
static void residual(const struct rest *rest, const nurbs_hydrostatics *h,
                     const igabem_forces *forces, double *sinkage, double *trim)
{
    double axis = h->waterplane_centre;
    double buoyancy = h->volume * (h->centroid[0] - axis),
           weight = rest->volume * (rest->centre - axis);
    *sinkage = forces->sinkage - (h->volume - rest->volume) / h->waterplane_area;
    *trim = forces->trim + (buoyancy - weight) / h->waterplane_inertia_y;
}

static igabem_status forces_of(const igabem_hull *hull, const igabem_options *options,
                               igabem_forces *forces)
{
    igabem_solution *solution = NULL;
    igabem_options plain = *options;
    plain.sensitivity = 0;
    igabem_status status = igabem_solve(hull, &plain, &solution);
    if (!status)
        status = igabem_forces_compute(solution, forces);
    igabem_solution_free(solution);
    if (!status && (!isfinite(forces->sinkage) || !isfinite(forces->trim)))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "equilibrium needs a surface-piercing hull and a formulation that "
                           "solves for the pressure, not %s",
                           igabem_formulation_name(options->formulation));
    return status;
}

static igabem_status place(const nurbs_patches *patches, const nurbs_hull_options *placement,
                           igabem_hull **hull, nurbs_hull **placed)
{
    nurbs_status status = nurbs_hull_create(patches, placement, placed);
    if (status)
        return hull_nurbs_fail(status, "equilibrium");
    return igabem_hull_from(*placed, hull);
}

/* Fixes what is kept from the hull at rest. */
static igabem_status start(const igabem_hull *hull, struct rest *rest,
                           nurbs_hull_options *placement, igabem_options *options,
                           igabem_equilibrium *equilibrium)
{
    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    const nurbs_hydrostatics *h = &info.hydrostatics;
    *rest = (struct rest){h->volume, h->centroid[0], h->x_fore - h->x_aft};
    *equilibrium = (igabem_equilibrium){.pivot = h->waterplane_centre};
    placement->pivot = equilibrium->pivot;
    placement->length = info.length;
    return igabem_options_freeze(hull, options);
}

/* One solve, after which *equilibrium holds the attitude of the next. */
static igabem_status step(const igabem_hull *hull, const igabem_options *options,
                          const struct rest *rest, igabem_equilibrium *equilibrium, bool *found)
{
    igabem_forces forces;
    igabem_hull_info info;
    double sinkage, trim;
    igabem_status status = forces_of(hull, options, &forces);
    if (status)
        return status;
    igabem_hull_get_info(hull, &info);
    residual(rest, &info.hydrostatics, &forces, &sinkage, &trim);
    equilibrium->solves++;
    equilibrium->change = fabs(sinkage) + 0.5 * rest->extent * fabs(trim);
    *found = equilibrium->change < tolerance * info.length;
    if (!*found) {
        equilibrium->sinkage += sinkage;
        equilibrium->trim += trim;
    }
    return IGABEM_OK;
}

static igabem_status iterate(const nurbs_patches *patches, nurbs_hull_options *placement,
                             igabem_options *options, igabem_equilibrium *equilibrium,
                             nurbs_hull **placed)
{
    igabem_hull *hull = NULL;
    struct rest rest;
    bool found = false;
    igabem_status status = place(patches, placement, &hull, placed);
    if (!status && nurbs_hull_has_waterline(*placed) && !nurbs_hull_is_cut(*placed))
        status = igabem_fail(IGABEM_ERROR_ARGUMENT,
                             "equilibrium needs a hull that reaches above the still water, this "
                             "one ends there");
    if (!status)
        status = start(hull, &rest, placement, options, equilibrium);
    for (int i = 0; i < MOST_SOLVES && !status && !found; i++) {
        status = step(hull, options, &rest, equilibrium, &found);
        if (status || found)
            break;
        igabem_hull_free(hull);
        nurbs_hull_free(*placed);
        hull = NULL;
        *placed = NULL;
        placement->sinkage = equilibrium->sinkage;
        placement->trim = equilibrium->trim;
        status = place(patches, placement, &hull, placed);
    }
    igabem_hull_free(hull);
    if (!status && !found)
        status = igabem_fail(IGABEM_ERROR_NUMERIC,
                             "no equilibrium after %d solves: the draft still changes by %.3g m",
                             MOST_SOLVES, equilibrium->change);
    return status;
}

igabem_status igabem_equilibrium_find(const nurbs_patches *patches,
                                      const nurbs_hull_options *placement, igabem_options *options,
                                      igabem_equilibrium *equilibrium, nurbs_hull **hull)
{
    if (hull)
        *hull = NULL;
    if (!patches || !options || !equilibrium)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_equilibrium_find");
    if (options->kernel != IGABEM_KERNEL_KELVIN)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "equilibrium needs the Kelvin kernel");
    nurbs_hull_options at;
    if (placement)
        at = *placement;
    else
        nurbs_hull_options_init(&at);
    at.sinkage = at.trim = at.pivot = 0.0;
    nurbs_hull *placed = NULL;
    igabem_status status = iterate(patches, &at, options, equilibrium, &placed);
    if (status || !hull)
        nurbs_hull_free(placed);
    else
        *hull = placed;
    return status;
}
