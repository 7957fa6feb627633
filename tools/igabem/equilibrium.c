/* The weight and its place are those of the hull at rest. In each step the hull is placed, cut at
 * the still water and solved; its buoyancy is exact for the placed hull, the dynamic lift and
 * moment are the solver's, and the attitude changes by the residual over the hydrostatic stiffness
 * rho g A and rho g I_L of the waterplane. The centre of gravity is taken in the still water
 * plane: its height would add (KB - KG)/BM_L, about a per cent, to the stiffness in trim. */
#include "equilibrium.h"

#include "cli.h"

#include <math.h>

enum { MOST_ITERATIONS = 20 };
static const double TOLERANCE = 1e-5; /* of the length: change of draft at the worse end */

struct rest {
    double volume, centre; /* m^3, x of the centre of buoyancy and so of gravity */
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

static int solve_forces(const struct solve_request *request, const struct hull_input *input,
                        igabem_forces *forces)
{
    igabem_solution *solution = NULL;
    igabem_options options = request->options;
    options.sensitivity = 0;
    igabem_status status = igabem_solve(input->hull, &options, &solution);
    if (!status)
        status = igabem_forces_compute(solution, forces);
    igabem_solution_free(solution);
    if (status)
        return cli_fail("%s: %s", request->hull.path, igabem_last_error());
    if (!isfinite(forces->sinkage) || !isfinite(forces->trim))
        return cli_fail("%s: --free-to-trim needs a surface-piercing hull and a formulation that "
                        "solves for the pressure, not %s",
                        request->hull.path, igabem_formulation_name(request->options.formulation));
    return CLI_OK;
}

int equilibrium_find(struct solve_request *request, struct hull_input *input)
{
    igabem_hull_info info;
    igabem_forces forces;
    igabem_hull_get_info(input->hull, &info);
    const struct rest rest = {info.hydrostatics.volume, info.hydrostatics.centroid[0]};
    double length = info.length, extent = info.hydrostatics.x_fore - info.hydrostatics.x_aft;
    request->options.froude = request->fr[0];
    if (igabem_options_freeze(input->hull, &request->options))
        return cli_fail("%s: %s", request->hull.path, igabem_last_error());
    request->hull.pivot = info.hydrostatics.waterplane_centre;
    request->hull.length = length;
    request->hull.quiet = true;
    double change = INFINITY;
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        double sinkage, trim;
        int code = solve_forces(request, input, &forces);
        if (code != CLI_OK)
            return code;
        igabem_hull_get_info(input->hull, &info);
        residual(&rest, &info.hydrostatics, &forces, &sinkage, &trim);
        change = fabs(sinkage) + 0.5 * extent * fabs(trim);
        if (change < TOLERANCE * length)
            return CLI_OK;
        request->hull.sinkage += sinkage;
        request->hull.trim += trim;
        hull_input_free(input);
        code = hull_input_read(&request->hull, input);
        if (code != CLI_OK)
            return code;
    }
    return cli_fail("%s: no equilibrium after %d iterations: the draft still changes by %.3g m",
                    request->hull.path, MOST_ITERATIONS, change);
}
