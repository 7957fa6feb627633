#include "result/radiation.h"

#include "core/error.h"

#include <math.h>

/* Each side's sources U n_x dS where nothing is solved, and those of a thin ship moved to y = 0
 * together with their mirror image, where it has no waterline. */
static void place_sources(const igabem_formulation_row *formulation, double speed,
                          struct sources *sources)
{
    for (size_t j = 0; j < sources->n && !formulation->solves; j++)
        sources->strength[j] = speed * sources->normal[0][j] * sources->area[j];
    for (size_t j = 0; j < sources->n && formulation->centre_plane; j++)
        sources->y[j] = 0.0;
    if (!formulation->line_term && !formulation->potential)
        sources->n_line = 0;
}

igabem_status radiation_sources(const igabem_solution *solution, enum radiation_cutoff cutoff,
                                double t_max, size_t cuts, const double *cut,
                                struct sources **sources)
{
    const double *sigma = cutoff == RADIATION_LOWER   ? solution->sigma_lower
                          : cutoff == RADIATION_UPPER ? solution->sigma_upper
                                                      : solution->sigma;
    const struct source_rule rule = {solution->k0, t_max, cuts, cut};
    igabem_status status = sources_create(solution, &rule, sigma, sources);
    if (status)
        return status;
    place_sources(solution->formulation, solution->speed, *sources);
    return IGABEM_OK;
}

/* Upper bound of z: the control points' (the hull lies in their hull). */
static double top(const igabem_solution *solution)
{
    double highest = -INFINITY;
    for (size_t p = 0; p < solution->density->patches; p++) {
        const nurbs_surface *surface = solution->density->patch[p].surface;
        size_t n = nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
        const double *points = nurbs_surface_points(surface);
        for (size_t k = 0; k < n; k++)
            highest = fmax(highest, points[3 * k + 2]);
    }
    return highest;
}

double radiation_limit(const igabem_solution *solution)
{
    const double decay = 40.0; /* of |H|^2 */
    double limit = solution->options.spectrum_limit, depth = -top(solution);
    if (solution->info.surface_piercing || !(depth > 0))
        return limit;
    return sqrt(decay / (2.0 * solution->k0 * depth));
}

void radiation_extent(const igabem_solution *solution, double *length, double *beam)
{
    double lower = INFINITY, upper = -INFINITY, side = 0.0;
    for (size_t p = 0; p < solution->density->patches; p++) {
        const nurbs_surface *surface = solution->density->patch[p].surface;
        size_t n = nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
        const double *points = nurbs_surface_points(surface);
        for (size_t k = 0; k < n; k++) {
            lower = fmin(lower, points[3 * k]);
            upper = fmax(upper, points[3 * k]);
            side = fmax(side, fabs(points[3 * k + 1]));
        }
    }
    *length = upper - lower;
    *beam = 2.0 * side;
}

double radiation_cutoff_angle(const igabem_solution *solution)
{
    double angle = solution->options.cutoff_angle;
    if (solution->potential)
        return 0.0;
    return isfinite(angle) && angle > 0 ? angle : 0.0;
}
