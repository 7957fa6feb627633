#include "result/elevation_surface.h"

#include "core/error.h"
#include "exterior/base_flow.h"
#include "exterior/transom.h"

#include <igabem/solve.h>

#include <math.h>

/* g zeta/U: phi_x, and about another flow w = -e_x + grad Phi the same of Bernoulli's equation
 * linearised there: - w grad phi + U |grad Phi|^2/2. */
static double slope(const igabem_solution *solution, const struct free_surface_place *place)
{
    double gradient[2], base[2];
    operator_gradient(solution->surface, place, solution->surface_phi, gradient);
    if (!solution->base)
        return gradient[0];
    base_flow_at(solution->surface, solution->base, place, base);
    return (1.0 - base[0]) * gradient[0] - base[1] * gradient[1] +
           0.5 * solution->speed * (base[0] * base[0] + base[1] * base[1]);
}

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
            zeta[i] = scale * slope(solution, &place);
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

/* Of a cell: nodes lie so far within what was solved, that rounding keeps them there. */
static const double within = 1e-9;

igabem_status igabem_free_surface_grid(const igabem_solution *solution, size_t size[2], double *x,
                                       double *y)
{
    if (!solution || !size)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_free_surface_grid");
    const struct free_surface *surface = solution->surface;
    if (!surface)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "formulation %s has no grid on the free surface",
                           igabem_formulation_name(solution->options.formulation));
    size_t strip = solution->transom ? solution->transom->n : 0;
    size[0] = surface->nx + 1;
    size[1] = strip + surface->ny + 1;
    for (size_t i = 0; i < size[0] && x && y; i++) {
        double xi = fmin((double)surface->nx - within, fmax(within, (double)i));
        /* The strip begins where the waterline ends. */
        if (strip && i == surface->stern)
            xi += within;
        for (size_t j = 0; j < size[1]; j++) {
            size_t k = i * size[1] + j, row = j < strip ? 0 : j - strip;
            double edge = free_surface_y(surface, xi, 2 * row);
            x[k] = surface->x0 - surface->dx * xi;
            y[k] = j < strip            ? edge * (double)j / (double)strip
                   : row == surface->ny ? edge - within * surface->first
                                        : edge + within * surface->first;
        }
    }
    return IGABEM_OK;
}
