#include "core/attitude.h"

#include "constants.h"

static igabem_options at_speed(const struct problem *problem, double froude)
{
    igabem_options options = problem->solver;
    for (size_t i = 0; i < problem->speeds && options.froude != froude; i++)
        options = problem->speed[i];
    return options;
}

static bool float_freely(const struct problem *problem, const struct design *design, double froude,
                         struct attitude *a)
{
    nurbs_hull_options placement;
    igabem_options options = at_speed(problem, froude);
    igabem_equilibrium found;
    nurbs_hull *hull = NULL;
    nurbs_hull_options_init(&placement);
    placement.simplify = problem->config->tolerance;
    placement.length = nurbs_hull_length(design->hull);
    igabem_status status =
        igabem_equilibrium_find(nurbs_hull_full(design->hull), &placement, &options, &found, &hull);
    if (status == IGABEM_OK)
        status = igabem_hull_from(hull, &a->placed);
    if (status == IGABEM_OK) {
        a->body = a->placed;
        a->area = nurbs_hull_hydrostatics(hull)->wetted_area /
                  nurbs_hull_hydrostatics(design->hull)->wetted_area;
        a->sinkage = found.sinkage;
        a->trim = found.trim * (180 / PI);
    }
    nurbs_hull_free(hull);
    return core_ok(status, "free to trim: %s", igabem_last_error());
}

bool attitude_find(const struct problem *problem, const struct design *design, double froude,
                   struct attitude *attitude)
{
    *attitude = (struct attitude){.body = design->body, .area = 1};
    return !problem->config->free_to_trim || float_freely(problem, design, froude, attitude);
}

void attitude_free(struct attitude *attitude)
{
    igabem_hull_free(attitude->placed);
    attitude->placed = NULL;
}
