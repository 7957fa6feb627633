/* The entrance angle that the short-wave filter is tied to. */
#include "core/error.h"
#include "hull/hull.h"

#include <math.h>
#include <stdlib.h>

enum { SAMPLES = 2048 };

/* A stem arc turns the waterline normal forward within a distance in which a sharp entrance hardly
 * changes it: a point belongs to an arc as long as |nu_x| there is more than ARC_RATIO times its
 * value ARC_REACH of the waterline further in, starting from the end. */
static const double ARC_REACH = 0.01;
static const double ARC_RATIO = 1.25;

struct station {
    double x, nu;
};

static int by_x(const void *a, const void *b)
{
    double xa = ((const struct station *)a)->x, xb = ((const struct station *)b)->x;
    return (xa > xb) - (xa < xb);
}

static bool is_waterline(const struct hull_patch *patch, int edge)
{
    return patch->edge[edge] == HULL_EDGE_WATERLINE && !patch->transom;
}

/* Stations along every waterline edge but that of a closed transom. Fills stations[SAMPLES] per
 * edge. */
static igabem_status sample(const struct igabem_hull *hull, struct station *stations, size_t *n)
{
    *n = 0;
    for (size_t p = 0; p < hull->n; p++)
        for (int e = 0; e < HULL_EDGES; e++) {
            const struct hull_patch *patch = &hull->patches[p];
            for (int i = 0; is_waterline(patch, e) && i < SAMPLES; i++) {
                double uv[2], triples[9], nu[2], dl;
                hull_edge_parameters(patch, e, i / (SAMPLES - 1.0), uv);
                nurbs_status status = nurbs_surface_eval(patch->surface, 1, 1, uv, triples);
                if (status)
                    return hull_nurbs_fail(status, "the waterline");
                hull_waterline_normal(patch, e, triples, nu, &dl);
                if (dl > 0)
                    stations[(*n)++] = (struct station){triples[0], fabs(nu[0])};
            }
        }
    return IGABEM_OK;
}

/* Largest |nu_x| of the stations within reach of x. */
static double near(const struct station *stations, size_t n, double x, double reach)
{
    double largest = 0.0;
    for (size_t i = 0; i < n; i++)
        if (fabs(stations[i].x - x) <= reach)
            largest = fmax(largest, stations[i].nu);
    return largest;
}

/* Number of stations from one end (step = +1 aft, -1 fore) that belong to a stem arc and to the
 * reach behind it, in which the waterline is still turning. */
static size_t arc(const struct station *stations, size_t n, int step, double length)
{
    double inward = step > 0 ? 1.0 : -1.0, reach = ARC_REACH * length, last = NAN;
    for (size_t count = 0; count < n; count++) {
        const struct station *s = &stations[step > 0 ? count : n - 1 - count];
        double further = near(stations, n, s->x + inward * reach, 0.1 * reach);
        if (!(further > 0 && s->nu <= ARC_RATIO * further))
            last = s->x;
        else if (!(inward * (s->x - last) < reach))
            return count;
    }
    return 0;
}

igabem_status hull_waterline_angle(const struct igabem_hull *hull, double *nu_s)
{
    *nu_s = 0.0;
    size_t edges = 0, n = 0;
    for (size_t p = 0; p < hull->n; p++)
        for (int e = 0; e < HULL_EDGES; e++)
            edges += (size_t)is_waterline(&hull->patches[p], e);
    if (edges == 0)
        return IGABEM_OK;
    struct station *stations = malloc(edges * SAMPLES * sizeof *stations);
    if (!stations)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the waterline");
    igabem_status status = sample(hull, stations, &n);
    if (!status && n > 0) {
        qsort(stations, n, sizeof *stations, by_x);
        double length = stations[n - 1].x - stations[0].x;
        size_t aft = arc(stations, n, 1, length), fore = arc(stations, n, -1, length);
        for (size_t i = aft; i + fore < n; i++)
            *nu_s = fmax(*nu_s, stations[i].nu);
    }
    free(stations);
    return status;
}
