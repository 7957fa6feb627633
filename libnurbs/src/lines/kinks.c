/* Corners of the keel, seen from the side. */
#include "core/error.h"
#include "lines/lines.h"
#include "mesh/mesh.h"

#include <math.h>
#include <stdlib.h>

/* Of the extent: how far from the centre plane the keel is looked at. */
static const double beside = 1e-5;

/* Kinks of one line of the buttock, between the tips. */
static nurbs_status add_kinks(const sheets *s, size_t n, const double *points, double kink_angle,
                              size_t most, double *place, size_t *found)
{
    line l = {
        .n = n, .points = malloc(3 * n * sizeof(double)), .along = malloc(n * sizeof(double))};
    nurbs_status status = l.points && l.along
                              ? NURBS_OK
                              : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", n);
    for (size_t k = 0; k < 3 * n && !status; k++)
        l.points[k] = points[k];
    if (!status)
        status = line_finish(&l, kink_angle);
    for (size_t c = 0; c < l.corners && !status && *found < most; c++) {
        double at = l.corner[c] * l.along[n - 1];
        size_t k = 0;
        while (k + 1 < n && l.along[k + 1] < at)
            k++;
        double x = l.points[3 * k], z = l.points[3 * k + 2];
        if (fabs(l.along[k + 1] - at) < fabs(l.along[k] - at)) {
            x = l.points[3 * k + 3];
            z = l.points[3 * k + 5];
        }
        double there = sheets_place(s, x, z), margin = 0.01 * s->extent;
        /* Corners of the outlines themselves belong to the last sections. */
        if (there < s->tip[0] + margin || there > s->tip[1] - margin)
            continue;
        place[(*found)++] = there;
    }
    line_free(&l);
    return status;
}

nurbs_status keel_kinks(const nurbs_mesh *mesh, const sheets *s, double kink_angle, size_t most,
                        double *place, size_t *n)
{
    nurbs_contour contour = {0};
    const double across[3] = {0, 1, 0};
    *n = 0;
    nurbs_status status = nurbs_mesh_section(mesh, across, beside * s->extent, &contour);
    for (size_t k = 0; k < contour.lines && !status; k++)
        status = add_kinks(s, contour.first[k + 1] - contour.first[k],
                           contour.points + 3 * contour.first[k], kink_angle, most, place, n);
    nurbs_contour_free(&contour);
    return status;
}
