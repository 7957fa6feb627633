#include "sides.h"

#include "error.h"
#include <nurbs/basis.h>
#include <nurbs/section.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 5 };

/* Basis functions at SAMPLES places of every non-empty span, both ends of the span included. */
typedef struct side_axis {
    size_t spans, order;
    size_t *first;  /* first control point of a span */
    double *values; /* [spans][SAMPLES][order] */
} side_axis;

static nurbs_status axis_create(int degree, size_t n, const double *knots, side_axis *axis)
{
    size_t order = (size_t)degree + 1;
    *axis = (side_axis){0, order, malloc(n * sizeof(size_t)),
                        malloc(n * SAMPLES * order * sizeof(double))};
    if (!axis->first || !axis->values)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to sample %zu spans", n);
    for (size_t k = order - 1; k < n; k++) {
        if (!(knots[k + 1] > knots[k]))
            continue;
        axis->first[axis->spans] = k + 1 - order;
        for (size_t s = 0; s < SAMPLES; s++) {
            double t = knots[k] + (knots[k + 1] - knots[k]) * (double)s / (SAMPLES - 1);
            nurbs_basis(degree, knots, k, t, axis->values + (axis->spans * SAMPLES + s) * order);
        }
        axis->spans++;
    }
    return NURBS_OK;
}

/* Whether the surface has y < -slack in the cell of spans a and b. */
static int dips(const side_axis axis[2], size_t a, size_t b, size_t nv, const double *points,
                double slack)
{
    size_t p = axis[0].order, q = axis[1].order;
    const double *net = points + 3 * (axis[0].first[a] * nv + axis[1].first[b]) + 1;
    int negative = 0;
    for (size_t i = 0; i < p; i++)
        for (size_t j = 0; j < q; j++)
            negative |= net[3 * (i * nv + j)] < 0;
    for (size_t s = 0; s < SAMPLES && negative; s++)
        for (size_t t = 0; t < SAMPLES; t++) {
            const double *nu = axis[0].values + (a * SAMPLES + s) * p,
                         *mv = axis[1].values + (b * SAMPLES + t) * q;
            double y = 0;
            for (size_t i = 0; i < p; i++)
                for (size_t j = 0; j < q; j++)
                    y += nu[i] * mv[j] * net[3 * (i * nv + j)];
            if (y < -slack)
                return 1;
        }
    return 0;
}

static size_t raise_cell(const side_axis axis[2], size_t a, size_t b, size_t nv, double *points,
                         double *moved)
{
    double *net = points + 3 * (axis[0].first[a] * nv + axis[1].first[b]) + 1;
    size_t raised = 0;
    for (size_t i = 0; i < axis[0].order; i++)
        for (size_t j = 0; j < axis[1].order; j++) {
            double *y = net + 3 * (i * nv + j);
            if (*y < 0) {
                *moved = fmax(*moved, -*y);
                *y = 0;
                raised++;
            }
        }
    return raised;
}

nurbs_status raise_to_side(const int degree[2], const size_t size[2], const double *knots_u,
                           const double *knots_v, double *points, double *moved)
{
    const double *knots[2] = {knots_u, knots_v};
    side_axis axis[2] = {{0}, {0}};
    nurbs_status status = NURBS_OK;
    double reach = 0;
    *moved = 0;
    for (size_t k = 0; k < size[0] * size[1]; k++)
        reach = fmax(reach, fabs(points[3 * k + 1]));
    for (int d = 0; d < 2 && status == NURBS_OK; d++)
        status = axis_create(degree[d], size[d], knots[d], &axis[d]);
    for (size_t raised = status == NURBS_OK; raised > 0;) {
        raised = 0;
        for (size_t a = 0; a < axis[0].spans; a++)
            for (size_t b = 0; b < axis[1].spans; b++)
                if (dips(axis, a, b, size[1], points, 1e-15 * reach))
                    raised += raise_cell(axis, a, b, size[1], points, moved);
    }
    for (int d = 0; d < 2; d++) {
        free(axis[d].first);
        free(axis[d].values);
    }
    return status;
}

nurbs_status nurbs_surface_raise_side(const nurbs_surface *surface, nurbs_surface **result,
                                      double *moved)
{
    *result = NULL;
    const int degree[2] = {nurbs_surface_degree(surface, 0), nurbs_surface_degree(surface, 1)};
    const size_t size[2] = {nurbs_surface_size(surface, 0), nurbs_surface_size(surface, 1)};
    if (nurbs_surface_weights(surface))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "a rational surface cannot be raised to y >= 0");
    double *points = malloc(3 * size[0] * size[1] * sizeof *points), most = 0;
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu points", size[0], size[1]);
    memcpy(points, nurbs_surface_points(surface), 3 * size[0] * size[1] * sizeof *points);
    const double *u = nurbs_surface_knots(surface, 0), *v = nurbs_surface_knots(surface, 1);
    nurbs_status status = raise_to_side(degree, size, u, v, points, &most);
    if (status == NURBS_OK)
        status = nurbs_surface_create(degree, size, u, v, points, NULL, result);
    if (moved)
        *moved = most;
    free(points);
    return status;
}
