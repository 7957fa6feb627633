#include "hull/space.h"

#include "core/error.h"

#include <nurbs/basis.h>
#include <nurbs/fit.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Samples of the least squares in each span: the mean square over a span of a cubic against a
 * finer spline. */
enum { SAMPLES = 4 };
/* So many knots in smooth spans leave far less than this part of the bound; at a kink of the design
 * they only move the worst place. */
enum { PATIENCE = 8 };
static const double least_gain = 0.7;

void hull_space_free(hull_space *space)
{
    if (!space)
        return;
    for (int d = 0; d < 2; d++) {
        free(space->parameters[d]);
        free(space->knots[d]);
    }
    free(space);
}

static double *copy(size_t n, const double *values)
{
    double *result = malloc((n + 1) * sizeof *result);
    if (result)
        memcpy(result, values, n * sizeof *result);
    return result;
}

nurbs_status hull_space_create(const nurbs_grid *grid, const nurbs_surface *light,
                               hull_space **space)
{
    hull_space *s = calloc(1, sizeof *s);
    *space = NULL;
    if (!s)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the space of a hull");
    s->rows = nurbs_grid_rows(grid);
    s->columns = nurbs_grid_columns(grid);
    s->parameters[0] = malloc(s->rows * sizeof(double));
    s->parameters[1] = malloc(s->columns * sizeof(double));
    bool ok = s->parameters[0] && s->parameters[1];
    for (int d = 0; d < 2; d++) {
        s->degree[d] = nurbs_surface_degree(light, d);
        s->size[d] = nurbs_surface_size(light, d);
        s->knots[d] = copy(s->size[d] + (size_t)s->degree[d] + 1, nurbs_surface_knots(light, d));
        ok = ok && s->knots[d];
    }
    nurbs_status status = ok ? nurbs_skin_parameters(grid, NULL, s->parameters[0], s->parameters[1])
                             : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the space of a hull");
    if (status) {
        hull_space_free(s);
        return status;
    }
    *space = s;
    return NURBS_OK;
}

nurbs_status hull_space_skin(const hull_space *space, const nurbs_grid *grid, nurbs_surface **skin)
{
    nurbs_skin_options options;
    nurbs_skin_options_init(&options);
    *skin = NULL;
    if (space) {
        if (nurbs_grid_rows(grid) != space->rows || nurbs_grid_columns(grid) != space->columns)
            return nurbs_fail(
                NURBS_ERROR_ARGUMENT, "a grid of %zu x %zu points, expected the parent's %zu x %zu",
                nurbs_grid_rows(grid), nurbs_grid_columns(grid), space->rows, space->columns);
        options.u = space->parameters[0];
        options.v = space->parameters[1];
    }
    return nurbs_skin(grid, &options, skin);
}

/* Parameters of the samples of one direction: SAMPLES a span and both ends. */
static size_t sites(const hull_space *space, int d, double *t)
{
    const double *knots = space->knots[d];
    size_t n = 0;
    for (size_t i = (size_t)space->degree[d]; i < space->size[d]; i++)
        for (int k = 0; k < SAMPLES && knots[i + 1] > knots[i]; k++)
            t[n++] = knots[i] + (knots[i + 1] - knots[i]) * k / SAMPLES;
    t[n++] = knots[space->size[d]];
    return n;
}

/* The knots of b that a lacks, counted with multiplicity: fills missing. */
static size_t knots_missing(size_t na, const double *a, size_t nb, const double *b, double *missing)
{
    size_t n = 0;
    for (size_t i = 0, k = 0; k < nb; k++) {
        while (i < na && a[i] < b[k])
            i++;
        if (i < na && a[i] == b[k])
            i++;
        else
            missing[n++] = b[k];
    }
    return n;
}

/* The surface on its own knots and those of the other, in both directions. */
static nurbs_status on_union(const nurbs_surface *surface, const nurbs_surface *other,
                             nurbs_surface **result)
{
    nurbs_surface *made[2] = {NULL, NULL};
    const nurbs_surface *from = surface;
    nurbs_status status = NURBS_OK;
    for (int d = 0; d < 2 && !status; d++) {
        size_t p = (size_t)nurbs_surface_degree(surface, d) + 1;
        size_t na = nurbs_surface_size(surface, d) + p, nb = nurbs_surface_size(other, d) + p;
        double *missing = malloc(nb * sizeof *missing);
        if (!missing)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", nb);
        size_t n = knots_missing(na, nurbs_surface_knots(surface, d), nb,
                                 nurbs_surface_knots(other, d), missing);
        status = nurbs_surface_insert(from, d, n, missing, &made[d]);
        from = made[d];
        free(missing);
    }
    nurbs_surface_free(made[0]);
    *result = made[1];
    return status;
}

/* The largest distance of control points on common knots bounds that of the surfaces at equal
 * parameters (convex hull). */
static nurbs_status compare(const nurbs_surface *a, const nurbs_surface *b, double *bound,
                            double worst[2])
{
    nurbs_surface *fine = NULL, *other = NULL;
    size_t at = 0;
    *bound = 0;
    nurbs_status status = on_union(a, b, &fine);
    if (!status)
        status = on_union(b, a, &other);
    if (!status) {
        size_t columns = nurbs_surface_size(fine, 1), n = nurbs_surface_size(fine, 0) * columns;
        const double *p = nurbs_surface_points(fine), *q = nurbs_surface_points(other);
        for (size_t k = 0; k < n; k++) {
            double distance = hypot(hypot(p[3 * k] - q[3 * k], p[3 * k + 1] - q[3 * k + 1]),
                                    p[3 * k + 2] - q[3 * k + 2]);
            if (distance > *bound) {
                *bound = distance;
                at = k;
            }
        }
        const size_t index[2] = {at / columns, at % columns};
        for (int d = 0; d < 2 && worst; d++) {
            worst[d] = 0;
            for (int k = 1; k <= nurbs_surface_degree(fine, d); k++)
                worst[d] += nurbs_surface_knots(fine, d)[index[d] + (size_t)k] /
                            nurbs_surface_degree(fine, d);
        }
    }
    nurbs_surface_free(fine);
    nurbs_surface_free(other);
    return status;
}

nurbs_status hull_space_fit(const hull_space *space, const nurbs_surface *wetted,
                            nurbs_surface **light, double *bound, double worst[2])
{
    nurbs_grid *grid = NULL;
    *light = NULL;
    double *u = malloc((SAMPLES * (space->size[0] + space->size[1]) + 2) * sizeof *u);
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to fit %zu x %zu control points",
                          space->size[0], space->size[1]);
    size_t rows = sites(space, 0, u), columns = sites(space, 1, u + rows);
    nurbs_status status = nurbs_grid_sample(wetted, rows, u, columns, u + rows, &grid);
    if (!status)
        status = nurbs_surface_fit(space->degree, space->size, space->knots[0], space->knots[1],
                                   grid, u, u + rows, light);
    if (!status)
        status = compare(wetted, *light, bound, worst);
    if (status) {
        nurbs_surface_free(*light);
        *light = NULL;
    }
    nurbs_grid_free(grid);
    free(u);
    return status;
}

/* Divides the span that contains t; false: no memory. */
static bool divide(hull_space *space, int d, double t)
{
    size_t p = (size_t)space->degree[d], n = space->size[d], i = p;
    double *knots = malloc((n + p + 2) * sizeof *knots);
    if (!knots)
        return false;
    while (i + 1 < n && !(t < space->knots[d][i + 1]))
        i++;
    memcpy(knots, space->knots[d], (i + 1) * sizeof *knots);
    knots[i + 1] = 0.5 * (space->knots[d][i] + space->knots[d][i + 1]);
    memcpy(knots + i + 2, space->knots[d] + i + 1, (n + p - i) * sizeof *knots);
    free(space->knots[d]);
    space->knots[d] = knots;
    space->size[d]++;
    return true;
}

/* A copy of the knots, so that a trial leaves the space alone. */
static nurbs_status begin_trial(const hull_space *space, hull_space *trial)
{
    *trial = *space;
    for (int d = 0; d < 2; d++)
        trial->knots[d] = copy(space->size[d] + (size_t)space->degree[d] + 1, space->knots[d]);
    if (trial->knots[0] && trial->knots[1])
        return NURBS_OK;
    free(trial->knots[0]);
    free(trial->knots[1]);
    return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the space of a hull");
}

static void keep(hull_space *from, hull_space *space)
{
    for (int d = 0; d < 2; d++) {
        free(space->knots[d]);
        space->knots[d] = from->knots[d];
        space->size[d] = from->size[d];
    }
}

static void discard(hull_space *trial)
{
    free(trial->knots[0]);
    free(trial->knots[1]);
}

/* The bound that a further knot in direction d at t leaves. */
static nurbs_status try_knot(const hull_space *space, const nurbs_surface *wetted, int d, double t,
                             double *bound)
{
    hull_space trial;
    nurbs_surface *light = NULL;
    nurbs_status status = begin_trial(space, &trial);
    if (status)
        return status;
    if (!divide(&trial, d, t))
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the space of a hull");
    else
        status = hull_space_fit(&trial, wetted, &light, bound, NULL);
    nurbs_surface_free(light);
    discard(&trial);
    return status;
}

/* A knot where the fit is worst, in the direction in which it helps more. */
static nurbs_status add_knot(hull_space *space, const nurbs_surface *wetted, const double at[2])
{
    double left[2];
    nurbs_status status = NURBS_OK;
    for (int d = 0; d < 2 && !status; d++)
        status = try_knot(space, wetted, d, at[d], &left[d]);
    int d = left[0] <= left[1] ? 0 : 1;
    if (!status && !divide(space, d, at[d]))
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the space of a hull");
    return status;
}

nurbs_status hull_space_widen(hull_space *space, const nurbs_surface *wetted, double tolerance)
{
    hull_space wider;
    double at[2], bound, before = INFINITY;
    nurbs_status status = begin_trial(space, &wider);
    if (status)
        return status;
    for (int added = 0; !status; added++) {
        nurbs_surface *light;
        status = hull_space_fit(&wider, wetted, &light, &bound, at);
        nurbs_surface_free(light);
        if (!status && bound <= tolerance) {
            keep(&wider, space);
            return NURBS_OK;
        }
        if (status || (added % PATIENCE == 0 && bound > least_gain * before))
            break;
        before = added % PATIENCE == 0 ? bound : before;
        status = add_knot(&wider, wetted, at);
    }
    discard(&wider);
    return status;
}
