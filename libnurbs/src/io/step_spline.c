/* B-spline, Bezier and uniform curves and surfaces of STEP files. */
#include "core/error.h"
#include "io/iges_spline.h"
#include "io/step.h"

#include <nurbs/curve.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DEGREE = 25, MOST_POINTS = 1000000 };

/* Where the parts of a spline stand: in one record behind its name, or in the records of a complex
 * instance. */
typedef struct spline_source {
    const step_node *degree, *points, *multiplicities, *knots, *weights;
    bool bezier, quasi_uniform;
} spline_source;

static const step_record *any_record(const step_file *file, size_t instance,
                                     const char *const *names)
{
    const step_record *record = NULL;
    for (; *names && !record; names++)
        record = step_record_of(file, instance, *names);
    return record;
}

static const char *const curve_kinds[] = {"B_SPLINE_CURVE_WITH_KNOTS", "BEZIER_CURVE",
                                          "UNIFORM_CURVE", "QUASI_UNIFORM_CURVE", NULL};
static const char *const surface_kinds[] = {"B_SPLINE_SURFACE_WITH_KNOTS", "BEZIER_SURFACE",
                                            "UNIFORM_SURFACE", "QUASI_UNIFORM_SURFACE", NULL};

bool step_is_spline(const step_file *file, size_t instance, bool surface)
{
    return any_record(file, instance, surface ? surface_kinds : curve_kinds) != NULL;
}

static spline_source find_source(const step_file *file, size_t instance, bool surface)
{
    const char *base_name = surface ? "B_SPLINE_SURFACE" : "B_SPLINE_CURVE",
               *weights_name = surface ? "RATIONAL_B_SPLINE_SURFACE" : "RATIONAL_B_SPLINE_CURVE",
               *const *kinds = surface ? surface_kinds : curve_kinds;
    const step_record *own = any_record(file, instance, kinds),
                      *base = step_record_of(file, instance, base_name),
                      *rational = step_record_of(file, instance, weights_name);
    size_t directions = surface ? 2 : 1, behind = surface ? 8 : 6;
    spline_source s = {0};
    s.degree = step_parameter(file, base ? base : own, base ? 0 : 1);
    s.points = step_parameter(file, base ? base : own, (base ? 0 : 1) + directions);
    bool with_knots = own == step_record_of(file, instance, kinds[0]);
    if (with_knots) {
        s.multiplicities = step_parameter(file, own, base ? 0 : behind);
        s.knots = step_parameter(file, own, (base ? 0 : behind) + directions);
    }
    if (rational)
        s.weights = step_parameter(file, rational, 0);
    s.bezier = own == step_record_of(file, instance, kinds[1]);
    s.quasi_uniform = own == step_record_of(file, instance, kinds[3]);
    return s;
}

/* Knots without multiplicities given: Bezier and quasi-uniform ones are clamped. */
static void implied_knots(const spline_source *s, size_t p, size_t n, double *knots)
{
    for (size_t k = 0; k < n + p + 1; k++) {
        double value = (double)k - (double)p, last = (double)n - (double)p;
        if (s->bezier)
            value = (double)((k + p - 1) / p) - 1;
        knots[k] = s->bezier || s->quasi_uniform ? fmin(fmax(value, 0), last) : value;
    }
    for (size_t k = 0; s->bezier && k < n + p + 1; k++)
        knots[k] = k <= p ? 0 : k >= n ? (double)((n - 1) / p) : (double)((k - 1) / p);
}

/* n + p + 1 knots from pairs of values and multiplicities. */
static nurbs_status read_knots(const step_file *file, size_t instance, const spline_source *s,
                               size_t direction, size_t p, size_t n, double *knots)
{
    if (!s->knots) {
        if (s->bezier && (n - 1) % p != 0)
            return step_refuse(file, instance, "%zu points of Bezier segments of degree %zu", n, p);
        implied_knots(s, p, n, knots);
        return NURBS_OK;
    }
    const step_node *times = s->multiplicities, *values = s->knots;
    if (direction) {
        times = step_next(file, times);
        values = step_next(file, values);
    }
    nurbs_status status = step_list(file, instance, times);
    if (status == NURBS_OK)
        status = step_list(file, instance, values);
    if (status != NURBS_OK)
        return status;
    size_t used = 0;
    double before = -INFINITY;
    const step_node *time = step_child(file, times, 0), *value = step_child(file, values, 0);
    for (; time && value; time = step_next(file, time), value = step_next(file, value)) {
        size_t m;
        double t = 0;
        status = step_size(file, instance, time, n + p + 1, &m);
        if (status == NURBS_OK)
            status = step_number(file, instance, value, &t);
        if (status != NURBS_OK)
            return status;
        if (!(t >= before))
            return step_refuse(file, instance, "its knots decrease: %g after %g", t, before);
        before = t;
        for (; m > 0 && used < n + p + 1; m--)
            knots[used++] = t;
        if (m > 0)
            used = n + p + 2;
    }
    if (used != n + p + 1 || time || value)
        return step_refuse(file, instance,
                           "its knots and multiplicities do not give the %zu knots of %zu points "
                           "and degree %zu",
                           n + p + 1, n, p);
    return NURBS_OK;
}

/* One row of points, and its weights if there are any, as homogeneous ones. */
static nurbs_status read_row(const step_file *file, size_t instance, const step_node *points,
                             const step_node *weights, size_t n, double *net)
{
    nurbs_status status = step_list(file, instance, points);
    if (status == NURBS_OK && weights)
        status = step_list(file, instance, weights);
    if (status == NURBS_OK && (points->count != n || (weights && weights->count != n)))
        status = step_refuse(file, instance, "rows of points or weights differ in length");
    if (status != NURBS_OK)
        return status;
    const step_node *point = step_child(file, points, 0),
                    *weight = weights ? step_child(file, weights, 0) : NULL;
    for (size_t k = 0; k < n && status == NURBS_OK; k++, point = step_next(file, point)) {
        double *h = net + 4 * k;
        size_t index = 0;
        h[3] = 1;
        status = step_reference(file, instance, point, &index);
        if (status == NURBS_OK)
            status = step_point(file, index, h);
        if (status == NURBS_OK && weight) {
            status = step_number(file, instance, weight, &h[3]);
            weight = step_next(file, weight);
        }
        if (status == NURBS_OK && !(h[3] > 0))
            status = step_refuse(file, instance, "a weight is %g, expected > 0", h[3]);
        for (int c = 0; c < 3; c++)
            h[c] *= h[3];
    }
    return status;
}

/* Cartesian points and weights of a net; equal weights are none. */
static bool split_net(size_t n, const double *net, double *points, double *weights)
{
    bool rational = false;
    for (size_t k = 0; k < n; k++) {
        weights[k] = net[4 * k + 3];
        for (size_t c = 0; c < 3; c++)
            points[3 * k + c] = net[4 * k + c] / weights[k];
        rational |= fabs(weights[k] - net[3]) > 1e-14 * net[3];
    }
    return rational;
}

static nurbs_status sizes_make_sense(const step_file *file, size_t instance, size_t p, size_t n)
{
    if (p < 1 || p > MOST_DEGREE || n <= p || n > MOST_POINTS)
        return step_refuse(file, instance,
                           "degree %zu with %zu points, expected degree 1 to %d and more points", p,
                           n, MOST_DEGREE);
    return NURBS_OK;
}

nurbs_status step_spline_curve(step_file *file, size_t instance, nurbs_curve **curve)
{
    spline_source s = find_source(file, instance, false);
    size_t p = 0;
    *curve = NULL;
    nurbs_status status = step_size(file, instance, s.degree, MOST_DEGREE, &p);
    if (status == NURBS_OK)
        status = step_list(file, instance, s.points);
    if (status == NURBS_OK)
        status = sizes_make_sense(file, instance, p, s.points->count);
    if (status != NURBS_OK)
        return status;
    size_t n = s.points->count, room = n + 2 * p;
    double *knots = malloc((room + p + 1 + 8 * room) * sizeof *knots);
    if (!knots)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu points", file->path, n);
    double *net = knots + room + p + 1, *points = net + 4 * room, *weights = points + 3 * room;
    status = read_knots(file, instance, &s, 0, p, n, knots);
    if (status == NURBS_OK && !(knots[n] > knots[p]))
        status = step_refuse(file, instance, "its knots have no length");
    if (status == NURBS_OK)
        status = read_row(file, instance, s.points, s.weights, n, net);
    if (status == NURBS_OK) {
        clamp_spline((int)p, &n, knots, 4, net);
        bool rational = split_net(n, net, points, weights);
        status = nurbs_curve_create((int)p, n, knots, points, rational ? weights : NULL, curve);
        if (status != NURBS_OK && status != NURBS_ERROR_MEMORY)
            status = step_refuse(file, instance, "%s", nurbs_last_error());
    }
    free(knots);
    return status;
}

/* Exchanges rows and columns of points. */
static nurbs_status transpose(size_t rows, size_t columns, double *net)
{
    double *copy = malloc(4 * rows * columns * sizeof *copy);
    if (!copy)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", rows * columns);
    memcpy(copy, net, 4 * rows * columns * sizeof *copy);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++)
            memcpy(net + 4 * (j * rows + i), copy + 4 * (i * columns + j), 4 * sizeof *copy);
    free(copy);
    return NURBS_OK;
}

static nurbs_status clamp_and_create(const size_t p[2], size_t n[2], double *const knots[2],
                                     double *net, nurbs_surface **surface)
{
    clamp_spline((int)p[0], &n[0], knots[0], 4 * n[1], net);
    nurbs_status status = transpose(n[0], n[1], net);
    if (status != NURBS_OK)
        return status;
    clamp_spline((int)p[1], &n[1], knots[1], 4 * n[0], net);
    status = transpose(n[1], n[0], net);
    double *points = malloc(4 * n[0] * n[1] * sizeof *points), *weights = points + 3 * n[0] * n[1];
    if (status == NURBS_OK && !points)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", n[0] * n[1]);
    if (status == NURBS_OK) {
        bool rational = split_net(n[0] * n[1], net, points, weights);
        status = nurbs_surface_create((const int[]){(int)p[0], (int)p[1]}, n, knots[0], knots[1],
                                      points, rational ? weights : NULL, surface);
    }
    free(points);
    return status;
}

static nurbs_status surface_sizes(const step_file *file, size_t instance, const spline_source *s,
                                  size_t p[2], size_t n[2])
{
    nurbs_status status = step_size(file, instance, s->degree, MOST_DEGREE, &p[0]);
    if (status == NURBS_OK)
        status = step_size(file, instance, step_next(file, s->degree), MOST_DEGREE, &p[1]);
    if (status == NURBS_OK)
        status = step_list(file, instance, s->points);
    if (status != NURBS_OK)
        return status;
    const step_node *row = step_child(file, s->points, 0);
    n[0] = s->points->count;
    n[1] = row && row->kind == STEP_LIST ? row->count : 0;
    for (size_t d = 0; d < 2 && status == NURBS_OK; d++)
        status = sizes_make_sense(file, instance, p[d], n[d]);
    return status;
}

nurbs_status step_spline_surface(step_file *file, size_t instance, nurbs_surface **surface)
{
    spline_source s = find_source(file, instance, true);
    size_t p[2], n[2];
    *surface = NULL;
    nurbs_status status = surface_sizes(file, instance, &s, p, n);
    if (status != NURBS_OK)
        return status;
    size_t room[2] = {n[0] + 2 * p[0], n[1] + 2 * p[1]};
    double *knots[2] = {malloc((room[0] + p[0] + 1) * sizeof(double)),
                        malloc((room[1] + p[1] + 1) * sizeof(double))};
    double *net = malloc(4 * room[0] * room[1] * sizeof *net);
    if (!knots[0] || !knots[1] || !net)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu x %zu points", file->path,
                            n[0], n[1]);
    for (size_t d = 0; d < 2 && status == NURBS_OK; d++) {
        status = read_knots(file, instance, &s, d, p[d], n[d], knots[d]);
        if (status == NURBS_OK && !(knots[d][n[d]] > knots[d][p[d]]))
            status = step_refuse(file, instance, "its knots have no length");
    }
    const step_node *row = step_child(file, s.points, 0),
                    *weights = s.weights ? step_child(file, s.weights, 0) : NULL;
    if (status == NURBS_OK && s.weights && s.weights->count != n[0])
        status = step_refuse(file, instance, "points and weights differ in number");
    for (size_t i = 0; i < n[0] && status == NURBS_OK; i++, row = step_next(file, row)) {
        status = read_row(file, instance, row, weights, n[1], net + 4 * i * n[1]);
        weights = weights ? step_next(file, weights) : NULL;
    }
    if (status == NURBS_OK) {
        status = clamp_and_create(p, n, knots, net, surface);
        if (status != NURBS_OK && status != NURBS_ERROR_MEMORY)
            status = step_refuse(file, instance, "%s", nurbs_last_error());
    }
    free(knots[0]);
    free(knots[1]);
    free(net);
    return status;
}
