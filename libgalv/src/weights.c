#include "error.h"

#include <galv/model.h>

#include <math.h>

/* Area of the quadrilateral a b d c by its diagonals: exact when flat, the area of the mean plane's
 * projection otherwise. */
static double cell_area(const double *a, const double *b, const double *c, const double *d)
{
    double p[3], q[3], n[3];
    for (int j = 0; j < 3; j++) {
        p[j] = d[j] - a[j];
        q[j] = c[j] - b[j];
    }
    for (int j = 0; j < 3; j++)
        n[j] = p[(j + 1) % 3] * q[(j + 2) % 3] - p[(j + 2) % 3] * q[(j + 1) % 3];
    return sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
}

galv_status galv_grid_weights(size_t sections, size_t girth, const double *xyz, double *weights)
{
    if (sections < 2 || girth < 2 || !xyz || !weights)
        return galv_fail(GALV_ERROR_ARGUMENT, "a grid of %zu x %zu points has no cells", sections,
                         girth);
    size_t npoints = sections * girth;
    double total = 0;
    for (size_t p = 0; p < npoints; p++)
        weights[p] = 0;
    for (size_t i = 0; i + 1 < sections; i++)
        for (size_t j = 0; j + 1 < girth; j++) {
            size_t a = i * girth + j, corner[4] = {a, a + 1, a + girth, a + girth + 1};
            double area = cell_area(xyz + 3 * corner[0], xyz + 3 * corner[1], xyz + 3 * corner[2],
                                    xyz + 3 * corner[3]);
            total += area;
            for (int k = 0; k < 4; k++)
                weights[corner[k]] += area / 4;
        }
    if (!isfinite(total))
        return galv_fail(GALV_ERROR_GEOMETRY, "the area of the grid is %g", total);
    for (size_t p = 0; p < npoints; p++) {
        weights[p] *= (double)npoints / total;
        if (!(weights[p] > 0))
            return galv_fail(GALV_ERROR_GEOMETRY,
                             "grid point %zu,%zu: all cells around it have no area", p / girth,
                             p % girth);
    }
    return GALV_OK;
}
