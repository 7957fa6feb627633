#include "core/error.h"
#include "hull/hull.h"

#include <nurbs/surface.h>

#include <math.h>
#include <stdlib.h>

hull_box hull_box_empty(void)
{
    return (hull_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

nurbs_status hull_box_widen(const nurbs_surface *surface, hull_box *box)
{
    enum { SIDE = 65 };
    double u[2][SIDE], *points = malloc(sizeof(double) * 3 * SIDE * SIDE);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %d samples", SIDE * SIDE);
    for (int d = 0; d < 2; d++) {
        const double *knots = nurbs_surface_knots(surface, d);
        double first = knots[0], last = knots[nurbs_surface_size(surface, d)];
        for (int i = 0; i < SIDE; i++)
            u[d][i] = i == SIDE - 1 ? last : first + (last - first) * i / (SIDE - 1.0);
    }
    nurbs_status status = nurbs_surface_eval_grid(surface, 0, SIDE, u[0], SIDE, u[1], points);
    for (size_t i = 0; !status && i < (size_t)SIDE * SIDE; i++)
        for (size_t k = 0; k < 3; k++) {
            box->lower[k] = fmin(box->lower[k], points[3 * i + k]);
            box->upper[k] = fmax(box->upper[k], points[3 * i + k]);
        }
    free(points);
    return status;
}

nurbs_status hull_box_of(const nurbs_patches *patches, hull_box *box)
{
    nurbs_status status = NURBS_OK;
    *box = hull_box_empty();
    for (size_t p = 0; p < nurbs_patches_count(patches) && !status; p++)
        status = hull_box_widen(nurbs_patches_get(patches, p), box);
    return status;
}
