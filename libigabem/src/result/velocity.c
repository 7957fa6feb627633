/* Velocity and pressure at any parameter of the hull, from the velocity field in the basis of the
 * density. */
#include "core/error.h"
#include "solve/solution.h"

#include <math.h>
#include <stdlib.h>

igabem_status igabem_surface_velocity(const igabem_solution *solution, size_t patch, size_t n,
                                      const double *uv, double *velocity, double *cp)
{
    if (!solution || (n && (!uv || !velocity)))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_surface_velocity");
    if (patch >= solution->density->patches)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "patch %zu, expected less than %zu", patch,
                           solution->density->patches);
    if (!solution->velocity)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "formulation %s has no velocity on the hull",
                           igabem_formulation_name(solution->options.formulation));
    igabem_status status =
        density_evaluate(solution->density, patch, 3, solution->velocity, n, uv, velocity);
    double speed = solution->speed;
    for (size_t i = 0; !status && cp && i < n; i++) {
        const double *v = velocity + 3 * i;
        double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        cp[i] = (2.0 * speed * v[0] - square) / (speed * speed);
    }
    return status;
}

igabem_status igabem_source_density(const igabem_solution *solution, size_t patch, size_t n,
                                    const double *uv, double *sigma)
{
    if (!solution || (n && (!uv || !sigma)))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_source_density");
    if (patch >= solution->density->patches)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "patch %zu, expected less than %zu", patch,
                           solution->density->patches);
    if (solution->potential)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "formulation %s has a potential and no source density",
                           igabem_formulation_name(solution->options.formulation));
    return density_evaluate(solution->density, patch, 1, solution->sigma, n, uv, sigma);
}
