/* Parts of a body that are not joined must not reach into each other. */
#include "core/constants.h"
#include "core/error.h"
#include "hull/hull.h"

#include <math.h>
#include <stdlib.h>

enum {
    SIDE = 24,
    PROBES = 7
}; /* cells of a patch in either direction; probes in either direction */

/* Of the solid angle 4 pi: a closed surface is seen under all of it from inside, under none from
 * outside. */
static const double INSIDE = 0.75;

/* A patch as flat cells at the middle of equal parts of its parameters. */
struct cells {
    double at[SIDE * SIDE][3], area[SIDE * SIDE][3];
};

static igabem_status find_cells(const struct hull_patch *patch, struct cells *cells)
{
    for (int k = 0; k < SIDE * SIDE; k++) {
        const double share[2] = {(k / SIDE + 0.5) / SIDE, (k % SIDE + 0.5) / SIDE};
        double uv[2], triples[9], normal[3], size, range = 1.0;
        for (int d = 0; d < 2; d++) {
            double width = patch->domain[d][1] - patch->domain[d][0];
            uv[d] = patch->domain[d][0] + share[d] * width;
            range *= width / SIDE;
        }
        nurbs_status status = nurbs_surface_eval(patch->surface, 1, 1, uv, triples);
        if (status)
            return hull_nurbs_fail(status, "sampling a patch");
        hull_normal(patch, triples, normal, &size);
        for (int c = 0; c < 3; c++) {
            cells->at[k][c] = triples[c];
            cells->area[k][c] = range * size * normal[c];
        }
    }
    return IGABEM_OK;
}

/* Adds the share of the solid angle under which p sees the cells mirrored by the signs; *near:
 * a cell is too close to be a point. */
static double seen(const struct cells *cells, const double sign[3], const double p[3], int *near)
{
    double sum = 0.0;
    for (int k = 0; k < SIDE * SIDE; k++) {
        double square = 0.0, flux = 0.0, area = 0.0;
        for (int c = 0; c < 3; c++) {
            double r = sign[c] * cells->at[k][c] - p[c];
            square += r * r;
            flux += sign[c] * cells->area[k][c] * r;
            area += cells->area[k][c] * cells->area[k][c];
        }
        if (square <= 4.0 * sqrt(area)) {
            *near = 1;
            return 0.0;
        }
        sum += flux / (square * sqrt(square));
    }
    return sum / (4.0 * PI);
}

/* Whether p lies in what part `number` of the body encloses with its images in y = 0 and z = 0. */
static bool encloses(const struct igabem_hull *hull, const struct cells *cells, const size_t *part,
                     size_t number, const double p[3])
{
    double sum = 0.0;
    int near = 0;
    for (int image = 0; image < 4; image++) {
        const double sign[3] = {1.0, image % 2 ? -1.0 : 1.0, image / 2 ? -1.0 : 1.0};
        for (size_t k = 0; k < hull->n && !near; k++)
            if (part[k] == number)
                sum += seen(&cells[k], sign, p, &near);
    }
    return !near && sum > INSIDE;
}

static igabem_status check_patch(const struct igabem_hull *hull, const struct cells *cells,
                                 const size_t *part, size_t parts, size_t index)
{
    for (int i = 0; i < PROBES * PROBES; i++) {
        int step = SIDE / PROBES;
        const double *p = cells[index].at[(i / PROBES * step + 1) * SIDE + i % PROBES * step + 1];
        for (size_t other = 0; other < parts; other++) {
            size_t first = 0;
            while (part[first] != other)
                first++;
            if (other != part[index] &&
                hull_same_side(&hull->patches[first], &hull->patches[index]) &&
                encloses(hull, cells, part, other, p))
                return igabem_fail(IGABEM_ERROR_GEOMETRY,
                                   "patch %zu reaches into the body that patch %zu belongs to, at "
                                   "(%.6g, %.6g, %.6g), and is not joined to it",
                                   index, first, p[0], p[1], p[2]);
        }
    }
    return IGABEM_OK;
}

igabem_status hull_check_overlap(const struct igabem_hull *hull, const size_t *part, size_t parts)
{
    if (parts < 2)
        return IGABEM_OK;
    struct cells *cells = malloc(hull->n * sizeof *cells);
    igabem_status status =
        cells ? IGABEM_OK : igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu patches", hull->n);
    for (size_t p = 0; p < hull->n && !status; p++)
        status = find_cells(&hull->patches[p], &cells[p]);
    for (size_t p = 0; p < hull->n && !status; p++)
        status = check_patch(hull, cells, part, parts, p);
    free(cells);
    return status;
}
