#include "shape_net.h"

#include "cli.h"

#include <stdlib.h>

enum { USUAL_DEGREE = 3 };

void shape_net_complete(struct shape_net *net, const nurbs_surface *surface)
{
    for (int a = 0; a < 2; a++) {
        if (!net->n_count) {
            net->count[a] = nurbs_surface_size(surface, a);
            net->degree[a] = (size_t)nurbs_surface_degree(surface, a);
        } else if (!net->n_degree) {
            net->degree[a] = net->count[a] > USUAL_DEGREE ? USUAL_DEGREE : net->count[a] - 1;
        }
    }
}

static size_t block(const struct shape_net_part *part)
{
    return (part->last[0] - part->first[0] + 1) * (part->last[1] - part->first[1] + 1);
}

size_t shape_net_parameters(const struct shape_net_part *part)
{
    return part->n_directions * (part->together ? 1 : block(part));
}

/* Clamped, with equal spans between the ends of the surface's parameters. */
static double *uniform_knots(const nurbs_surface *surface, int axis, size_t count, size_t degree)
{
    double *knots = cli_needed(malloc((count + degree + 1) * sizeof *knots));
    const double *own = nurbs_surface_knots(surface, axis);
    double start = own[nurbs_surface_degree(surface, axis)];
    double end = own[nurbs_surface_size(surface, axis)];
    size_t spans = count - degree;
    for (size_t i = 0; i <= count + degree; i++) {
        size_t k = i < degree ? 0 : i - degree < spans ? i - degree : spans;
        knots[i] = k == spans ? end : start + (end - start) * (double)k / (double)spans;
    }
    return knots;
}

/* A spline of that many control points, all of them in the origin. */
static bool make_spline(const struct shape_net *net, const nurbs_surface *surface,
                        nurbs_surface **spline)
{
    const int degree[2] = {(int)net->degree[0], (int)net->degree[1]};
    double *knots[2];
    for (int a = 0; a < 2; a++)
        knots[a] = uniform_knots(surface, a, net->count[a], net->degree[a]);
    double *points = cli_needed(calloc(net->count[0] * net->count[1], 3 * sizeof *points));
    bool ok = nurbs_surface_create(degree, net->count, knots[0], knots[1], points, NULL, spline) ==
                  NURBS_OK ||
              cli_refuse("control points: %s", nurbs_last_error());
    free(points);
    free(knots[0]);
    free(knots[1]);
    return ok;
}

/* The rows of the functions that do not vanish, into full ones. */
static bool fill_basis(const nurbs_surface *surface, const struct shape_points *points,
                       double *basis)
{
    size_t count = (size_t)(nurbs_surface_degree(surface, 0) + 1) *
                   (size_t)(nurbs_surface_degree(surface, 1) + 1);
    size_t all = nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
    size_t *columns = cli_needed(malloc(count * sizeof *columns));
    double *values = cli_needed(malloc(count * sizeof *values));
    bool ok = true;
    for (size_t p = 0; p < points->n && ok; p++) {
        const double uv[2] = {points->u[p / points->columns], points->v[p % points->columns]};
        ok = nurbs_surface_rows(surface, 0, 1, uv, columns, values) == NURBS_OK ||
             cli_refuse("control points: %s", nurbs_last_error());
        for (size_t c = 0; c < count && ok; c++)
            basis[p * all + columns[c]] = values[c];
    }
    free(columns);
    free(values);
    return ok;
}

bool shape_net_basis(const struct shape_net *net, const struct shape_points *points, double **basis)
{
    nurbs_surface *spline = NULL;
    *basis = NULL;
    if (net->n_count && !make_spline(net, points->surface, &spline))
        return false;
    double *values = cli_needed(calloc(points->n, net->count[0] * net->count[1] * sizeof *values));
    bool ok = fill_basis(spline ? spline : points->surface, points, values);
    nurbs_surface_free(spline);
    if (ok)
        *basis = values;
    else
        free(values);
    return ok;
}

int shape_net_field(const struct shape_net *net, const struct shape_net_part *part, size_t k,
                    size_t npoints, const double *basis, double *field)
{
    size_t columns = part->last[1] - part->first[1] + 1, all = net->count[0] * net->count[1];
    size_t from = part->together ? 0 : k / part->n_directions;
    size_t to = part->together ? block(part) : from + 1;
    int direction = part->directions[k % part->n_directions];
    for (size_t b = from; b < to; b++) {
        size_t i = part->first[0] + b / columns, j = part->first[1] + b % columns;
        for (size_t p = 0; p < npoints; p++)
            field[3 * p + (size_t)direction] += basis[p * all + i * net->count[1] + j];
    }
    return direction;
}
