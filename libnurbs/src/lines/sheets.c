/* Outlines of the ends, and sheets that bend from a plane amidships into them. */
#include "core/error.h"
#include "lines/lines.h"

#include <math.h>

/* An outline that recedes faster than this with the height is keel or deck, no longer an end. */
static const double steepest = 1.5;

/* Of the extent: from a quarter on, neighbouring sheets would meet. */
static const double most_rake = 0.22;

static double level_of(const sheets *s, size_t k)
{
    return s->z[0] + (s->z[1] - s->z[0]) * (double)k / (OUTLINE_LEVELS - 1);
}

/* An edge widens the outlines at the levels that it crosses. */
static void add_edge(sheets *s, const double *p, const double *q)
{
    if (p[2] > q[2]) {
        const double *swapped = p;
        p = q;
        q = swapped;
    }
    double step = (s->z[1] - s->z[0]) / (OUTLINE_LEVELS - 1);
    double first = ceil((p[2] - s->z[0]) / step), last = floor((q[2] - s->z[0]) / step);
    for (double k = fmax(first, 0); k <= last && k < OUTLINE_LEVELS; k++) {
        double z = s->z[0] + k * step, t = q[2] > p[2] ? (z - p[2]) / (q[2] - p[2]) : 0,
               x = p[0] + fmin(fmax(t, 0), 1) * (q[0] - p[0]);
        s->end[0][(size_t)k] = fmin(s->end[0][(size_t)k], x);
        s->end[1][(size_t)k] = fmax(s->end[1][(size_t)k], x);
    }
}

/* From the bottom up to where the outline stands upright enough, and from the top down, it is kept
 * as it is there: what lies beyond is keel and deck. */
static void cut_off(sheets *s, int end)
{
    double *x = s->end[end], step = (s->z[1] - s->z[0]) / (OUTLINE_LEVELS - 1);
    size_t middle = 0;
    enum { REACH = 8 };
    /* The outermost point is part of every end. */
    for (size_t k = 0; k < OUTLINE_LEVELS; k++)
        if (end ? x[k] > x[middle] : x[k] < x[middle])
            middle = k;
    for (int up = 0; up < 2; up++) {
        size_t at = up ? OUTLINE_LEVELS - 1 : 0;
        while (at != middle) {
            size_t inner = up ? (at > middle + REACH ? at - REACH : middle)
                              : (at + REACH < middle ? at + REACH : middle);
            double rise = fabs((double)inner - (double)at) * step;
            if (fabs(x[inner] - x[at]) <= steepest * rise &&
                fabs(x[at] - x[middle]) <= most_rake * s->extent)
                break;
            at += up ? (size_t)-1 : 1;
        }
        for (size_t k = up ? OUTLINE_LEVELS - 1 : 0; k != at; k += up ? (size_t)-1 : 1)
            x[k] = x[at];
    }
}

nurbs_status sheets_create(const nurbs_mesh *mesh, sheets *s)
{
    const double *p = nurbs_mesh_points(mesh);
    const size_t *corner = nurbs_mesh_corners(mesh);
    for (int c = 0; c < 3; c++) {
        s->low[c] = INFINITY;
        s->high[c] = -INFINITY;
    }
    for (size_t k = 0; k < 3 * nurbs_mesh_vertices(mesh); k++) {
        s->low[k % 3] = fmin(s->low[k % 3], p[k]);
        s->high[k % 3] = fmax(s->high[k % 3], p[k]);
    }
    s->extent = s->high[0] - s->low[0];
    s->z[0] = s->low[2];
    s->z[1] = s->high[2];
    if (!(s->extent > 0 && s->z[1] > s->z[0]))
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "%g m long, %g m high: expected a hull", s->extent,
                          s->z[1] - s->z[0]);
    for (size_t k = 0; k < OUTLINE_LEVELS; k++) {
        s->end[0][k] = INFINITY;
        s->end[1][k] = -INFINITY;
    }
    for (size_t t = 0; t < nurbs_mesh_triangles(mesh); t++)
        for (size_t k = 0; k < 3; k++)
            add_edge(s, p + 3 * corner[3 * t + k], p + 3 * corner[3 * t + (k + 1) % 3]);
    /* The outermost levels may be missed by rounding. */
    for (int e = 0; e < 2; e++) {
        if (isinf(s->end[e][0]))
            s->end[e][0] = s->end[e][1];
        if (isinf(s->end[e][OUTLINE_LEVELS - 1]))
            s->end[e][OUTLINE_LEVELS - 1] = s->end[e][OUTLINE_LEVELS - 2];
    }
    for (size_t k = 0; k < OUTLINE_LEVELS; k++)
        if (!(s->end[1][k] >= s->end[0][k]))
            return nurbs_fail(NURBS_ERROR_GEOMETRY, "nothing of the hull lies at z = %g m",
                              level_of(s, k));
    for (int e = 0; e < 2; e++) {
        cut_off(s, e);
        s->tip[e] = e ? -INFINITY : INFINITY;
        for (size_t k = 0; k < OUTLINE_LEVELS; k++)
            s->tip[e] = e ? fmax(s->tip[e], s->end[e][k]) : fmin(s->tip[e], s->end[e][k]);
    }
    for (int e = 0; e < 2; e++)
        for (size_t k = 0; k < OUTLINE_LEVELS; k++)
            if (fabs(s->end[e][k] - s->tip[e]) > most_rake * s->extent)
                return nurbs_fail(NURBS_ERROR_GEOMETRY,
                                  "the outline of the %s recedes from x = %.6g to %.6g m at z = "
                                  "%.6g m, more than %g of the length",
                                  e ? "bow" : "stern", s->tip[e], s->end[e][k], level_of(s, k),
                                  most_rake);
    return NURBS_OK;
}

double sheets_outline(const sheets *s, int end, double z)
{
    double at = (z - s->z[0]) / (s->z[1] - s->z[0]) * (OUTLINE_LEVELS - 1);
    at = fmin(fmax(at, 0), OUTLINE_LEVELS - 1);
    size_t k = (size_t)at;
    if (k >= OUTLINE_LEVELS - 1)
        return s->end[end][OUTLINE_LEVELS - 1];
    double t = at - (double)k;
    return (1 - t) * s->end[end][k] + t * s->end[end][k + 1];
}

double sheets_x(const sheets *s, double x0, double z)
{
    double middle = 0.5 * (s->tip[0] + s->tip[1]), x = x0;
    int e = x0 > middle;
    double share = (x0 - middle) / (s->tip[e] - middle);
    return x + share * share * (sheets_outline(s, e, z) - s->tip[e]);
}

double sheets_place(const sheets *s, double x, double z)
{
    double low = s->tip[0], high = s->tip[1];
    for (int k = 0; k < 60; k++) {
        double middle = 0.5 * (low + high);
        *(sheets_x(s, middle, z) < x ? &low : &high) = middle;
    }
    return 0.5 * (low + high);
}
