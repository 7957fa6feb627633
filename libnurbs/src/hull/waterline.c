/* The waterline as points. */
#include "core/error.h"
#include "hull/hull.h"

#include <nurbs/particulars.h>
#include <nurbs/section.h>

#include <math.h>
#include <stdlib.h>

/* Just below the water, where the wetted surfaces end, in parts of the draft. */
static const double below = 1e-4;

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Appends the points of one surface that lie at y >= 0. */
static nurbs_status add_points(const nurbs_surface *surface, double z, size_t *n, double **xy)
{
    const double up[3] = {0, 0, 1};
    nurbs_contour contour;
    nurbs_status status = nurbs_surface_contour(surface, up, z, 0, &contour);
    if (status)
        return status;
    size_t more = contour.lines ? contour.first[contour.lines] : 0;
    double *larger = realloc(*xy, 2 * (*n + more + 1) * sizeof *larger);
    if (!larger)
        status =
            nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a waterline of %zu points", *n + more);
    else
        *xy = larger;
    for (size_t i = 0; !status && i < more; i++) {
        const double *p = contour.points + 3 * i;
        if (p[1] >= 0) {
            larger[2 * *n] = p[0];
            larger[2 * (*n)++ + 1] = p[1];
        }
    }
    nurbs_contour_free(&contour);
    return status;
}

nurbs_status nurbs_hull_waterline(const nurbs_hull *hull, size_t *n, double **xy)
{
    if (!hull || !n || !xy)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "hull or a place for its waterline is NULL");
    *n = 0;
    *xy = NULL;
    nurbs_status status = NURBS_OK;
    double z = -below * hull->hydrostatics.draft;
    for (size_t k = 0; hull->waterline && k < nurbs_patches_count(hull->wetted) && !status; k++)
        status = add_points(nurbs_patches_get(hull->wetted, k), z, n, xy);
    if (status) {
        free(*xy);
        *xy = NULL;
        *n = 0;
    } else if (*n)
        qsort(*xy, *n, 2 * sizeof **xy, compare);
    return status;
}
