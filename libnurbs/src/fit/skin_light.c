/* A light surface near the one through the points of a grid. */
#include "core/error.h"

#include <nurbs/fit.h>
#include <nurbs/section.h>
#include <nurbs/simplify.h>

#include <math.h>
#include <stdbool.h>

enum { ROUNDS = 4 };

static bool is_half_hull(const nurbs_grid *grid)
{
    const double *points = nurbs_grid_points(grid);
    size_t n = nurbs_grid_rows(grid) * nurbs_grid_columns(grid);
    for (size_t k = 0; k < n; k++)
        if (points[3 * k + 1] < 0)
            return false;
    return true;
}

/* Knot removal within part of the tolerance, then y >= 0 where all points have it; *moved bounds
 * that last change. */
static nurbs_status lighten(const nurbs_surface *skin, bool half, double tolerance,
                            nurbs_surface **light, double *bound, double *moved)
{
    nurbs_surface *raised;
    *moved = 0;
    nurbs_status status = nurbs_surface_simplify(
        skin, tolerance,
        NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_KEEP_KINKS | NURBS_SIMPLIFY_THRIFTY, light,
        bound);
    if (status != NURBS_OK || !half)
        return status;
    status = nurbs_surface_raise_side(*light, &raised, moved);
    if (status == NURBS_OK) {
        nurbs_surface_free(*light);
        *light = raised;
    }
    return status;
}

nurbs_status nurbs_skin_light(const nurbs_grid *grid, const nurbs_skin_options *options,
                              double tolerance, nurbs_surface **surface, double *bound)
{
    nurbs_surface *skin = NULL, *light = NULL;
    double removed = 0, moved = 0, share = 1;
    if (!grid || !surface)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "grid or surface is NULL");
    *surface = NULL;
    if (!(isfinite(tolerance) && tolerance > 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "tolerance %g, expected a length > 0", tolerance);
    bool half = is_half_hull(grid), kept = false;
    nurbs_status status = nurbs_skin(grid, options, &skin);
    for (int round = 0; round < ROUNDS && !kept && status == NURBS_OK; round++, share *= 0.5) {
        nurbs_surface_free(light);
        light = NULL;
        status = lighten(skin, half, share * tolerance, &light, &removed, &moved);
        kept = removed + moved <= tolerance;
    }
    if (status == NURBS_OK && !kept)
        status = nurbs_fail(NURBS_ERROR_NUMERIC,
                            "the surface through the points overshoots the centre plane: bringing "
                            "it to y >= 0 moves it by %.3g m, expected at most %.3g m; closer "
                            "sections, a chine or another parametrization may help",
                            moved, tolerance);
    nurbs_surface_free(skin);
    if (status != NURBS_OK) {
        nurbs_surface_free(light);
        return status;
    }
    *surface = light;
    if (bound)
        *bound = removed + moved;
    return NURBS_OK;
}
