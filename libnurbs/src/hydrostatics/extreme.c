#include "core/error.h"
#include "hydrostatics/hydro_parts.h"

#include <math.h>
#include <stdlib.h>

enum { PER_SPAN = 4 };

/* Where the surface reaches farthest among samples of every span. */
typedef struct extreme {
    const nurbs_surface *surface;
    int coordinate;
    double sign, best;
    double at[2], low[2], high[2]; /* parameters: the best sample and its neighbours */
} extreme;

static size_t sample_axis(const nurbs_surface *surface, int direction, double *t)
{
    const double *knots = nurbs_surface_knots(surface, direction);
    size_t size = nurbs_surface_size(surface, direction), count = 0;
    for (size_t k = (size_t)nurbs_surface_degree(surface, direction); k < size; k++)
        for (int s = 0; s < PER_SPAN && knots[k + 1] > knots[k]; s++)
            t[count++] = knots[k] + (knots[k + 1] - knots[k]) * s / PER_SPAN;
    t[count++] = knots[size];
    return count;
}

static nurbs_status scan(extreme *search)
{
    const nurbs_surface *surface = search->surface;
    size_t room[2];
    for (int d = 0; d < 2; d++)
        room[d] = PER_SPAN * nurbs_surface_size(surface, d) + 1;
    double *u = malloc((room[0] + 4 * room[1]) * sizeof *u);
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu samples", room[1]);
    double *v = u + room[0], *line = v + room[1];
    size_t n[2] = {sample_axis(surface, 0, u), sample_axis(surface, 1, v)};
    nurbs_status status = NURBS_OK;
    search->best = -INFINITY;
    for (size_t i = 0; i < n[0] && status == NURBS_OK; i++) {
        status = nurbs_surface_eval_grid(surface, 0, 1, u + i, n[1], v, line);
        for (size_t j = 0; j < n[1] && status == NURBS_OK; j++) {
            double value = search->sign * line[3 * j + (size_t)search->coordinate];
            if (value <= search->best)
                continue;
            search->best = value;
            search->at[0] = u[i];
            search->low[0] = u[i ? i - 1 : i];
            search->high[0] = u[i + 1 < n[0] ? i + 1 : i];
            search->at[1] = v[j];
            search->low[1] = v[j ? j - 1 : j];
            search->high[1] = v[j + 1 < n[1] ? j + 1 : j];
        }
    }
    free(u);
    return status;
}

static double value_at(const extreme *search, int direction, double t)
{
    double uv[2] = {search->at[0], search->at[1]}, p[3];
    uv[direction] = t;
    if (nurbs_surface_eval(search->surface, 0, 1, uv, p) != NURBS_OK)
        return -INFINITY;
    return search->sign * p[search->coordinate];
}

/* Golden-section search along one parameter. */
static void improve(extreme *search, int direction)
{
    const double ratio = 0.61803398874989484820;
    double a = search->low[direction], b = search->high[direction];
    for (int k = 0; k < 45; k++) {
        double c = b - ratio * (b - a), d = a + ratio * (b - a);
        double fc = value_at(search, direction, c), fd = value_at(search, direction, d);
        double t = fc > fd ? c : d, value = fmax(fc, fd);
        if (value > search->best) {
            search->best = value;
            search->at[direction] = t;
        }
        if (fc > fd)
            b = d;
        else
            a = c;
    }
}

nurbs_status extreme_point(size_t n, const nurbs_surface *const *patches, int coordinate,
                           double sign, double *value)
{
    double best = -INFINITY;
    for (size_t k = 0; k < n; k++) {
        extreme search = {.surface = patches[k], .coordinate = coordinate, .sign = sign};
        nurbs_status status = scan(&search);
        if (status != NURBS_OK)
            return status;
        for (int sweep = 0; sweep < 4; sweep++) {
            improve(&search, 0);
            improve(&search, 1);
        }
        best = fmax(best, search.best);
    }
    *value = sign * best;
    return NURBS_OK;
}
