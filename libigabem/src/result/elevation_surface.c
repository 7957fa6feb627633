#include "result/elevation_surface.h"

#include "core/error.h"
#include "exterior/operator.h"
#include "exterior/transom.h"

#include <math.h>

igabem_status elevation_surface(const igabem_solution *solution, size_t n, const double *x,
                                const double *y, double *zeta)
{
    const struct free_surface *surface = solution->surface;
    double scale = solution->speed / solution->options.gravity;
    double aft = surface->x0 - surface->dx * (double)surface->nx;
    double side = surface->offset[2 * surface->ny];
    for (size_t i = 0; i < n; i++) {
        struct free_surface_place place;
        zeta[i] = NAN;
        if (free_surface_locate(surface, x[i], y[i], &place))
            zeta[i] = scale * operator_slope(surface, &place, solution->surface_phi);
        else if (solution->transom && x[i] <= solution->transom->x && x[i] >= aft &&
                 fabs(y[i]) <= solution->transom->breadth)
            zeta[i] = scale * transom_slope(solution->transom, x[i], y[i], solution->strip_phi);
        else if (!(x[i] >= aft && x[i] <= surface->x0 && fabs(y[i]) <= side))
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "point %zu is (%g, %g), off the free surface that was solved: x %g "
                               "to %g, y to %g m",
                               i, x[i], y[i], aft, surface->x0, side);
    }
    return IGABEM_OK;
}
