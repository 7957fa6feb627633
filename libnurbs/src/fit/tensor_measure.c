/* The distance of a spline from the map it was made to follow, after the last step. */
#include "core/error.h"
#include "fit/tensor_refine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SHARES = 7 };

/* Parameters between the knots of one direction, and the interval of each. */
typedef struct places {
    size_t n;
    double *at;
    size_t *interval;
} places;

static nurbs_status find_places(const nurbs_surface *spline, int direction, places *out)
{
    size_t size = nurbs_surface_size(spline, direction);
    const double *knots = nurbs_surface_knots(spline, direction);
    *out =
        (places){0, malloc(SHARES * size * sizeof(double)), malloc(SHARES * size * sizeof(size_t))};
    if (!out->at || !out->interval)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu samples", SHARES * size);
    for (size_t k = (size_t)nurbs_surface_degree(spline, direction); k < size; k++)
        for (int s = 0; s < SHARES && knots[k + 1] > knots[k]; s++, out->n++) {
            out->at[out->n] = knots[k] + (knots[k + 1] - knots[k]) * (s + 0.5) / SHARES;
            out->interval[out->n] = k;
        }
    return NURBS_OK;
}

static void free_places(places *list)
{
    free(list->at);
    free(list->interval);
}

static nurbs_status measure(const tensor_map *map, const nurbs_surface *spline, double tolerance,
                            const places list[2], unsigned char *const parts[2], double *deviation)
{
    size_t n = list[1].n;
    double *points = malloc(6 * n * sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu samples", n);
    nurbs_status status = NURBS_OK;
    for (size_t i = 0; i < list[0].n && status == NURBS_OK; i++) {
        double u = list[0].at[i], *wanted = points + 3 * n;
        status = map->section(map->context, u, n, list[1].at, wanted);
        if (status == NURBS_OK)
            status = nurbs_surface_eval_grid(spline, 0, 1, &u, n, list[1].at, points);
        for (size_t j = 0; j < n && status == NURBS_OK; j++) {
            const double *p = points + 3 * j, *q = wanted + 3 * j;
            double away = hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
            *deviation = fmax(*deviation, away);
            if (away > tolerance)
                parts[0][list[0].interval[i]] = parts[1][list[1].interval[j]] = 2;
        }
    }
    free(points);
    return status;
}

nurbs_status tensor_measure(const tensor_map *map, const nurbs_surface *spline, double tolerance,
                            unsigned char *parts[2], double *deviation)
{
    places list[2] = {{0}, {0}};
    nurbs_status status = NURBS_OK;
    *deviation = 0;
    for (int d = 0; d < 2 && status == NURBS_OK; d++) {
        size_t intervals = nurbs_surface_size(spline, d) + (size_t)nurbs_surface_degree(spline, d);
        status = find_places(spline, d, &list[d]);
        parts[d] = malloc(intervals);
        if (status == NURBS_OK && !parts[d])
            status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", intervals);
        if (status == NURBS_OK)
            memset(parts[d], 1, intervals);
    }
    if (status == NURBS_OK)
        status = measure(map, spline, tolerance, list, parts, deviation);
    free_places(&list[0]);
    free_places(&list[1]);
    return status;
}
