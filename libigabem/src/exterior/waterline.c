#include "exterior/waterline.h"

#include "core/error.h"

#include <math.h>
#include <stdlib.h>

enum { EDGE_POINTS = 1025 };
/* An edge may run back by this share of the length: rounding of a stem. */
static const double BACKWARDS = 1e-6;

static int by_x(const void *a, const void *b)
{
    double xa = ((const struct waterline_point *)a)->x, xb = ((const struct waterline_point *)b)->x;
    return (xa > xb) - (xa < xb);
}

/* Points of one edge, closer together towards its ends, where stems are. */
static igabem_status trace(const struct density *density, size_t index, int edge, double length,
                           struct waterline_point *point, size_t *n)
{
    const struct hull_patch *patch = &density->patch[index].hull;
    const double pi = 3.14159265358979323846;
    double direction = 0.0;
    for (int i = 0; i < EDGE_POINTS; i++) {
        double uv[2], at[3];
        hull_edge_parameters(patch, edge, 0.5 - 0.5 * cos(pi * i / (EDGE_POINTS - 1.0)), uv);
        nurbs_status status = nurbs_surface_eval(patch->surface, 0, 1, uv, at);
        if (status)
            return hull_nurbs_fail(status, "the waterline");
        double step = i ? at[0] - point[*n - 1].x : 0.0;
        if (step * direction < -BACKWARDS * length)
            return igabem_fail(IGABEM_ERROR_GEOMETRY,
                               "the waterline turns back at x = %.6g m: the free surface beside it "
                               "has no grid",
                               at[0]);
        if (fabs(step) > BACKWARDS * length)
            direction = step > 0 ? 1.0 : -1.0;
        point[(*n)++] = (struct waterline_point){at[0], fabs(at[1]), index, {uv[0], uv[1]}};
    }
    return IGABEM_OK;
}

igabem_status waterline_create(const struct density *density, double aft, double fore,
                               struct waterline *waterline)
{
    *waterline = (struct waterline){.aft = aft, .fore = fore};
    size_t edges = 0, n = 0;
    for (size_t p = 0; p < density->patches; p++)
        for (int e = 0; e < HULL_EDGES; e++)
            edges += density->patch[p].hull.edge[e] == HULL_EDGE_WATERLINE;
    if (edges == 0)
        return IGABEM_OK;
    struct waterline_point *point = malloc(edges * EDGE_POINTS * sizeof *point);
    waterline->point = point;
    igabem_status status =
        point ? IGABEM_OK : igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the waterline");
    for (size_t p = 0; p < density->patches && status == IGABEM_OK; p++)
        for (int e = 0; e < HULL_EDGES && status == IGABEM_OK; e++)
            if (density->patch[p].hull.edge[e] == HULL_EDGE_WATERLINE)
                status = trace(density, p, e, fore - aft, point, &n);
    if (status != IGABEM_OK)
        return status;
    qsort(point, n, sizeof *point, by_x);
    waterline->n = n;
    waterline->aft = point[0].x;
    waterline->fore = point[n - 1].x;
    return IGABEM_OK;
}

void waterline_free(struct waterline *waterline)
{
    free(waterline->point);
    waterline->point = NULL;
}

/* The last point at or before x, which lies between the ends. */
static size_t before(const struct waterline *waterline, double x)
{
    size_t low = 0, high = waterline->n - 1;
    while (low + 1 < high) {
        size_t middle = low + (high - low) / 2;
        if (waterline->point[middle].x <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

double waterline_breadth(const struct waterline *waterline, double x)
{
    if (!waterline->n || x < waterline->aft || x > waterline->fore)
        return 0.0;
    const struct waterline_point *p = &waterline->point[before(waterline, x)];
    double width = p[1].x - p[0].x;
    return width > 0 ? p[0].y + (p[1].y - p[0].y) * (x - p[0].x) / width : p[1].y;
}

igabem_status waterline_locate(const struct waterline *waterline, const struct density *density,
                               double x, size_t *patch, double uv[2])
{
    const struct waterline_point *p = &waterline->point[before(waterline, x)];
    if (p[1].patch != p[0].patch)
        p += fabs(p[1].x - x) < fabs(p[0].x - x);
    double width = p[1].patch == p[0].patch ? p[1].x - p[0].x : 0.0;
    double share = width > 0 ? fmin(1.0, fmax(0.0, (x - p[0].x) / width)) : 0.0;
    *patch = p->patch;
    /* One step of the secant: the points are close. */
    for (int k = 0; k < 2; k++) {
        double at[3];
        for (int d = 0; d < 2; d++)
            uv[d] = p[0].uv[d] + (width > 0 ? share * (p[1].uv[d] - p[0].uv[d]) : 0.0);
        nurbs_status status = nurbs_surface_eval(density->patch[*patch].hull.surface, 0, 1, uv, at);
        if (status)
            return hull_nurbs_fail(status, "the waterline");
        if (k == 0 && width > 0)
            share = fmin(1.0, fmax(0.0, share + (x - at[0]) / width));
    }
    return IGABEM_OK;
}
