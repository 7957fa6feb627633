/* A four-sided trimmed surface as one tensor spline: a Coons map of the unit square to the inside
 * of the loop, and the surface interpolated over it. */
#include "core/error.h"
#include "fit/tensor_refine.h"
#include "io/trim_loop.h"

#include <nurbs/basis.h>
#include <nurbs/simplify.h>
#include <nurbs/trim.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_DEGREE = 3, MOST_DEGREE = 5, MOST_SIZE = 600, ROUNDS = 4, CHECKS = 4 };

typedef struct work {
    trim_loop loop;
    double corner[2][2][2]; /* [s][t] in the parameter plane */
    knot_list along[2];
    size_t across; /* number of t whose points on the sides s = 0 and s = 1 are kept */
    double *kept;  /* t, then pairs of both sides */
} work;

/* The sides in the direction of growing s and t. */
static void side_point(const work *w, int side, double t, double uv[2])
{
    trim_loop_side(&w->loop, &w->loop.side[side], side < 2 ? t : 1 - t, uv);
}

/* Points of the sides s = 0 and s = 1 at t[n], kept for the next section: most sections ask for
 * the same t. */
static nurbs_status prepare_across(work *w, size_t n, const double *t)
{
    if (n == w->across && memcmp(t, w->kept, n * sizeof *t) == 0)
        return NURBS_OK;
    free(w->kept);
    w->across = 0;
    w->kept = malloc(5 * n * sizeof *w->kept);
    if (!w->kept)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section of %zu points", n);
    memcpy(w->kept, t, n * sizeof *t);
    for (size_t k = 0; k < n; k++) {
        side_point(w, 3, t[k], w->kept + n + 4 * k);
        side_point(w, 1, t[k], w->kept + n + 4 * k + 2);
    }
    w->across = n;
    return NURBS_OK;
}

/* Coons (1967): (s, t[n]) into the parameter plane. */
static nurbs_status plane_points(work *w, double s, size_t n, const double *t, double *uv)
{
    double bottom[2], top[2];
    nurbs_status status = prepare_across(w, n, t);
    if (status != NURBS_OK)
        return status;
    side_point(w, 0, s, bottom);
    side_point(w, 2, s, top);
    for (size_t k = 0; k < n; k++) {
        const double *left = w->kept + n + 4 * k, *right = left + 2, a = t[k];
        for (int d = 0; d < 2; d++) {
            double ends = (1 - s) * ((1 - a) * w->corner[0][0][d] + a * w->corner[0][1][d]) +
                          s * ((1 - a) * w->corner[1][0][d] + a * w->corner[1][1][d]);
            double value =
                (1 - a) * bottom[d] + a * top[d] + (1 - s) * left[d] + s * right[d] - ends;
            uv[2 * k + (size_t)d] = fmin(fmax(value, w->loop.low[d]), w->loop.high[d]);
        }
    }
    return NURBS_OK;
}

/* The trimmed surface at (s, t[n]), for tensor_map. */
static nurbs_status section_points(void *context, double s, size_t n, const double *t, double *out)
{
    work *w = context;
    double *uv = malloc(2 * n * sizeof *uv);
    if (!uv)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section of %zu points", n);
    nurbs_status status = plane_points(w, s, n, t, uv);
    if (status == NURBS_OK)
        status = nurbs_surface_eval(w->loop.surface, 0, n, uv, out);
    free(uv);
    return status;
}

/* Twice the area of a triangle in the parameter plane, positive when counterclockwise. */
static double triangle(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Whether a cell a, b, c, d keeps its orientation at all four corners. At a corner of the map it is
 * enough that the cell as a whole does: the angle there may be straight. */
static bool cell_keeps_side(const double *a, const double *b, const double *c, const double *d,
                            bool at_corner)
{
    if (at_corner)
        return triangle(a, b, c) + triangle(a, c, d) > 0;
    return triangle(a, b, d) > 0 && triangle(b, c, a) > 0 && triangle(c, d, b) > 0 &&
           triangle(d, a, c) > 0;
}

/* Every cell of a fine net keeps its orientation. */
static nurbs_status check_map(work *w)
{
    enum { N = 48 };
    double t[N + 1], uv[2][2 * (N + 1)];
    for (int k = 0; k <= N; k++)
        t[k] = (double)k / N;
    nurbs_status status = plane_points(w, 0, N + 1, t, uv[0]);
    for (int i = 1; i <= N && status == NURBS_OK; i++) {
        const double *a = uv[(i + 1) % 2], *b = uv[i % 2];
        status = plane_points(w, t[i], N + 1, t, uv[i % 2]);
        for (int k = 0; k < N && status == NURBS_OK; k++, a += 2, b += 2)
            if (!cell_keeps_side(a, b, b + 2, a + 2, (i == 1 || i == N) && (k == 0 || k == N - 1)))
                status = nurbs_fail(NURBS_ERROR_GEOMETRY,
                                    "the four sides of its loop give a map that folds at "
                                    "u = %.6g, v = %.6g",
                                    a[0], a[1]);
    }
    return status;
}

/* A knot of the patch and how often it stands there. */
typedef struct knot {
    double at;
    int times;
} knot;

static int by_place(const void *a, const void *b)
{
    double x = ((const knot *)a)->at, y = ((const knot *)b)->at;
    return (x > y) - (x < y);
}

/* Whether lines of constant coordinate d in the plane become parameter lines: both sides along it
 * share it, and it is constant on the other two. */
static int lines_carry_over(const work *w, int d)
{
    const loop_side *across[2] = {&w->loop.side[d ? 0 : 3], &w->loop.side[d ? 2 : 1]};
    double slack = 1e-9 * (w->loop.high[d] - w->loop.low[d]);
    for (int e = 0; e < 2; e++)
        for (int k = 1; k <= 8; k++) {
            double uv[2];
            trim_loop_side(&w->loop, across[e], k / 8.0, uv);
            if (fabs(uv[d] - across[e]->start[d]) > slack)
                return 0;
        }
    return w->loop.side[d].along == d;
}

/* Fills kinks of the two sides along d, and the knots of the surface where they stay parameter
 * lines. */
static size_t collect_knots(const work *w, int d, int degree, knot *found)
{
    const nurbs_surface *surface = w->loop.surface;
    const loop_side *sides[2] = {&w->loop.side[d], &w->loop.side[d + 2]};
    int raise = degree - nurbs_surface_degree(surface, d);
    size_t count = 0, last = nurbs_surface_size(surface, d);
    for (int e = 0; e < 2; e++)
        for (size_t k = 0; k + 1 < sides[e]->count; k++) {
            double s;
            if (trim_loop_kink(&w->loop, sides[e], k, &s))
                found[count++] = (knot){e ? 1 - s : s, degree};
        }
    if (!lines_carry_over(w, d))
        return count;
    const double *t = nurbs_surface_knots(surface, d), start = sides[0]->start[d],
                 length = sides[0]->end[d] - start;
    for (size_t k = (size_t)nurbs_surface_degree(surface, d) + 1; k < last; k++) {
        int times = 1;
        while (t[k + 1] == t[k]) {
            times++;
            k++;
        }
        times += raise;
        found[count++] = (knot){(t[k] - start) / length, times < 1        ? 1
                                                         : times > degree ? degree
                                                                          : times};
    }
    return count;
}

static nurbs_status start_knots(work *w, int d)
{
    int own = nurbs_surface_degree(w->loop.surface, d), degree = own < LEAST_DEGREE  ? LEAST_DEGREE
                                                                 : own > MOST_DEGREE ? MOST_DEGREE
                                                                                     : own;
    size_t room =
        w->loop.side[d].count + w->loop.side[d + 2].count + nurbs_surface_size(w->loop.surface, d);
    knot *found = malloc(room * sizeof *found);
    if (!found)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", room);
    nurbs_status status = knot_list_start(&w->along[d], degree, (const double[]){0, 1});
    w->along[d].most = MOST_SIZE;
    size_t count = collect_knots(w, d, degree, found);
    qsort(found, count, sizeof *found, by_place);
    double last = 0;
    for (size_t k = 0; k < count && status == NURBS_OK; k++) {
        if (!(found[k].at > last + 1e-9 && found[k].at < 1 - 1e-9))
            continue;
        last = found[k].at;
        for (int times = 0; times < found[k].times && status == NURBS_OK; times++)
            status = knot_list_append(&w->along[d], last);
    }
    free(found);
    return status;
}

/* Interpolates the map at the Greville points of both knot vectors. */
static nurbs_status fit(work *w, nurbs_surface **patch)
{
    const size_t size[2] = {w->along[0].size, w->along[1].size};
    const int degree[2] = {w->along[0].degree, w->along[1].degree};
    double *sites[2], *net = malloc((3 * size[0] * size[1] + size[0] + size[1]) * sizeof *net);
    if (!net)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu points", size[0], size[1]);
    sites[0] = net + 3 * size[0] * size[1];
    sites[1] = sites[0] + size[0];
    for (int d = 0; d < 2; d++)
        nurbs_greville(degree[d], size[d], w->along[d].knots, sites[d]);
    const tensor_map map = {section_points, w};
    nurbs_status status =
        tensor_sample(&map, 0, size, (const double *const[]){sites[0], sites[1]}, net);
    if (status == NURBS_OK)
        status = tensor_solve(degree[0], size[0], w->along[0].knots, sites[0], 3 * size[1], net);
    if (status == NURBS_OK)
        status = tensor_solve_across(&w->along[1], size[0], sites[1], net);
    if (status == NURBS_OK)
        status = nurbs_surface_create(degree, size, w->along[0].knots, w->along[1].knots, net, NULL,
                                      patch);
    free(net);
    return status;
}

/* CHECKS places inside every span and both of its ends. */
static size_t check_places(const knot_list *list, double *t)
{
    size_t count = 0;
    for (size_t k = (size_t)list->degree; k < list->size; k++)
        for (int i = 0; i < CHECKS && list->knots[k + 1] > list->knots[k]; i++)
            t[count++] =
                list->knots[k] + (list->knots[k + 1] - list->knots[k]) * (i + 0.37) / CHECKS;
    t[count++] = 1;
    return count;
}

/* Largest distance between the patch and the surface at equal parameters. */
static nurbs_status measure(work *w, const nurbs_surface *patch, double *worst)
{
    size_t room[2] = {CHECKS * w->along[0].size + 1, CHECKS * w->along[1].size + 1};
    double *s = malloc((room[0] + 7 * room[1]) * sizeof *s), square = 0;
    if (!s)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu samples", room[0]);
    double *t = s + room[0], *points = t + room[1], *fitted = points + 3 * room[1];
    size_t n[2] = {check_places(&w->along[0], s), check_places(&w->along[1], t)};
    nurbs_status status = NURBS_OK;
    for (size_t i = 0; i < n[0] && status == NURBS_OK; i++) {
        status = section_points(w, s[i], n[1], t, points);
        if (status == NURBS_OK)
            status = nurbs_surface_eval_grid(patch, 0, 1, s + i, n[1], t, fitted);
        for (size_t k = 0; k < 3 * n[1] && status == NURBS_OK; k += 3) {
            double d[3] = {fitted[k] - points[k], fitted[k + 1] - points[k + 1],
                           fitted[k + 2] - points[k + 2]};
            square = fmax(square, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        }
    }
    free(s);
    *worst = sqrt(square);
    return status;
}

/* Each direction gets its share of what the closed gaps leave of the tolerance; should the sum
 * still be too large, a smaller share. */
static nurbs_status fit_within(work *w, nurbs_surface **patch, double *deviation)
{
    const tensor_map map = {section_points, w};
    double allowed = w->loop.tolerance - w->loop.closed, share = 0.25;
    nurbs_status status = NURBS_OK;
    for (int round = 0; round < ROUNDS; round++, share *= 0.4) {
        double worst = 0;
        nurbs_surface_free(*patch);
        *patch = NULL;
        status = tensor_refine(&map, share * allowed, w->along);
        if (status == NURBS_OK)
            status = fit(w, patch);
        if (status == NURBS_OK)
            status = measure(w, *patch, &worst);
        *deviation = worst + w->loop.closed;
        if (status != NURBS_OK || worst <= allowed)
            return status;
    }
    return nurbs_fail(NURBS_ERROR_NUMERIC, "%zu x %zu control points still deviate by %.3g m",
                      w->along[0].size, w->along[1].size, *deviation);
}

/* Drops the control points for which what is left of the tolerance pays. */
static nurbs_status lighten(const work *w, nurbs_surface **patch, double *deviation)
{
    nurbs_surface *light;
    double bound;
    nurbs_status status =
        nurbs_surface_simplify(*patch, w->loop.tolerance - *deviation,
                               NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_THRIFTY, &light, &bound);
    if (status != NURBS_OK)
        return status;
    nurbs_surface_free(*patch);
    *patch = light;
    *deviation += bound;
    return NURBS_OK;
}

static nurbs_status untrim(work *w, nurbs_surface **patch, double *deviation)
{
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            side_point(w, j ? 2 : 0, i, w->corner[i][j]);
    nurbs_status status = check_map(w);
    for (int d = 0; d < 2 && status == NURBS_OK; d++)
        status = start_knots(w, d);
    if (status == NURBS_OK)
        status = fit_within(w, patch, deviation);
    return status == NURBS_OK && *deviation < w->loop.tolerance ? lighten(w, patch, deviation)
                                                                : status;
}

nurbs_status untrim_sides(trim_loop *loop, double tolerance, nurbs_surface **patch,
                          double *deviation)
{
    work w = {.loop = *loop};
    w.loop.tolerance = tolerance;
    *patch = NULL;
    nurbs_status status = untrim(&w, patch, deviation);
    if (status != NURBS_OK) {
        nurbs_surface_free(*patch);
        *patch = NULL;
    }
    free(w.kept);
    for (int d = 0; d < 2; d++)
        knot_list_free(&w.along[d]);
    return status;
}

nurbs_status nurbs_surface_untrim(const nurbs_surface *surface, size_t n,
                                  const nurbs_curve *const *loop, double tolerance,
                                  nurbs_surface **patch, double *deviation)
{
    NURBS_NEED(patch);
    trim_loop opened = {0};
    double reached = 0;
    *patch = NULL;
    if (!surface || n == 0 || !loop)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no surface, or no curves of a loop");
    for (size_t k = 0; k < n; k++)
        if (!loop[k])
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "curve %zu of the loop is NULL", k);
    if (!(isfinite(tolerance) && tolerance > 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "tolerance %g, expected a length > 0", tolerance);
    nurbs_status status = trim_loop_create(surface, n, loop, 0.25 * tolerance, &opened);
    if (status == NURBS_OK)
        status = untrim_sides(&opened, tolerance, patch, &reached);
    if (status == NURBS_OK && deviation)
        *deviation = reached;
    trim_loop_free(&opened);
    return status;
}
