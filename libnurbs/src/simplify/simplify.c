/* Simplification of curves and surfaces by knot removal. */
#include "core/error.h"
#include "simplify/subject.h"
#include "simplify/tensor_thin.h"

#include <nurbs/simplify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Divisions of a span in the certificate of a thrifty search, and the size up to which that of a
 * curve is one: it is cheap there. */
enum { PARTS = 2, SHORT_CURVE = 256 };

/* One coordinate of one edge of the original net: is it constant, and is the net on one side? */
struct edge_plane {
    int constant;
    double value;
    int side; /* 1: the net lies at or above the value, -1: at or below, 0: neither */
};

/* Edge 0: first row, 1: last row, 2: first column, 3: last column. */
static size_t edge_index(int edge, size_t k, const size_t size[2])
{
    switch (edge) {
    case 0:
        return k;
    case 1:
        return (size[0] - 1) * size[1] + k;
    case 2:
        return k * size[1];
    default:
        return k * size[1] + size[1] - 1;
    }
}

static struct edge_plane edge_plane(const struct subject *s, int edge, size_t c)
{
    struct edge_plane plane = {1, s->points[3 * edge_index(edge, 0, s->size) + c], 0};
    const size_t length = edge < 2 ? s->size[1] : s->size[0];
    for (size_t k = 1; k < length && plane.constant; k++)
        plane.constant = s->points[3 * edge_index(edge, k, s->size) + c] == plane.value;
    if (!plane.constant)
        return plane;
    int above = 1, below = 1;
    for (size_t i = 0; i < s->size[0] * s->size[1]; i++) {
        above = above && s->points[3 * i + c] >= plane.value;
        below = below && s->points[3 * i + c] <= plane.value;
    }
    plane.side = above - below;
    return plane;
}

/* With edges kept, a net on one side of an edge's plane stays there. */
static void set_walls(const struct subject *s, struct wall wall[3])
{
    for (int edge = 0; edge < 4; edge++)
        for (size_t c = 0; c < 3; c++) {
            const struct edge_plane plane = edge_plane(s, edge, c);
            if (plane.constant && plane.side)
                wall[c] = (struct wall){plane.side, (plane.value - s->centre[c]) /
                                                        (s->weights ? s->radius : 1.0)};
        }
}

/* Removal on the original knots, where a step is cheap, then on the divided ones, where the
 * difference is known more closely. Creates `t`. */
static nurbs_status thin(const struct subject *s, double tolerance, unsigned flags,
                         struct thinning *t)
{
    struct thinning_request request = subject_request(s, 0, tolerance);
    request.keep_kinks = (flags & NURBS_SIMPLIFY_KEEP_KINKS) != 0;
    if (flags & NURBS_SIMPLIFY_KEEP_EDGES)
        set_walls(s, request.wall);
    struct thinning first;
    nurbs_status status = thinning_create(&request, &first);
    if (status != NURBS_OK)
        return status;
    thinning_run(&first);
    struct thinning_request second = subject_request(s, 1, tolerance);
    second.keep_kinks = request.keep_kinks;
    memcpy(second.wall, request.wall, sizeof second.wall);
    for (int d = 0; d < s->directions; d++) {
        second.coarse_size[d] = first.along[d].size;
        second.coarse[d] = first.along[d].knots;
    }
    status = thinning_create(&second, t);
    thinning_free(&first);
    if (status != NURBS_OK)
        return status;
    thinning_run(t);
    status = thinning_squeeze(t, 8);
    if (status != NURBS_OK)
        thinning_free(t);
    return status;
}

/* Exactly what has to stay: corners, and with keep_edges an edge in a coordinate plane, and a net
 * on one side of that plane. */
static void restore_exact(const struct subject *s, const size_t size[2], int keep_edges,
                          double *points, double *weights)
{
    for (int edge = 0; keep_edges && edge < 4; edge++)
        for (size_t c = 0; c < 3; c++) {
            const struct edge_plane plane = edge_plane(s, edge, c);
            if (!plane.constant)
                continue;
            for (size_t i = 0; i < size[0] * size[1]; i++) {
                double *x = &points[3 * i + c];
                if (plane.side * (*x - plane.value) < 0.0)
                    *x = plane.value;
            }
            const size_t length = edge < 2 ? size[1] : size[0];
            for (size_t k = 0; k < length; k++)
                points[3 * edge_index(edge, k, size) + c] = plane.value;
        }
    for (int corner = 0; corner < 4; corner++) {
        const size_t from =
            (corner & 1 ? (s->size[0] - 1) * s->size[1] : 0) + (corner & 2 ? s->size[1] - 1 : 0);
        const size_t to =
            (corner & 1 ? (size[0] - 1) * size[1] : 0) + (corner & 2 ? size[1] - 1 : 0);
        memcpy(points + 3 * to, s->points + 3 * from, 3 * sizeof *points);
        if (s->weights)
            weights[to] = s->weights[from];
    }
}

/* The least-squares fit of a curve on the knots that its own order leaves. Creates `t`. */
static nurbs_status thin_curve(const struct subject *s, double tolerance, struct thinning *t)
{
    const struct wall none[3] = {{0, 0.0}, {0, 0.0}, {0, 0.0}};
    const size_t n = s->size[0], count = n + (size_t)s->degree[0] + 1, planes = (size_t)s->planes;
    double *rows = malloc((n * planes + count) * sizeof *rows), *kept = rows + n * planes;
    unsigned char *gone = calloc(count, 1);
    struct knot_order order = {0};
    nurbs_status status =
        rows && gone ? NURBS_OK
                     : nurbs_fail(NURBS_ERROR_MEMORY, "no memory to simplify %zu points", n);
    if (status == NURBS_OK) {
        for (size_t i = 0; i < n; i++)
            for (size_t plane = 0; plane < planes; plane++)
                rows[i * planes + plane] = s->net[plane * n + i];
        const struct strip strip = {n, planes, 1, rows, rows};
        const struct knot_order_request request = {.degree = s->degree[0],
                                                   .knots = s->knots[0],
                                                   .strip = &strip,
                                                   .limit = tolerance,
                                                   .wall = none};
        status = knot_order_create(&request, &order);
    }
    if (status == NURBS_OK) {
        size_t left = 0;
        for (size_t k = 0; k < order.count; k++)
            gone[order.knot[k]] = 1;
        for (size_t k = 0; k < count; k++)
            if (!gone[k])
                kept[left++] = s->knots[0][k];
        struct thinning_request finish = subject_request(s, n <= SHORT_CURVE, tolerance);
        finish.coarse_size[0] = n - order.count;
        finish.coarse[0] = kept;
        status = thinning_create(&finish, t);
    }
    if (status == NURBS_OK && n <= SHORT_CURVE) {
        thinning_run(t);
        status = thinning_squeeze(t, 8);
        if (status != NURBS_OK)
            thinning_free(t);
    }
    knot_order_free(&order);
    free(rows);
    free(gone);
    return status;
}

/* One result within about the tolerance, and its bound. */
static nurbs_status attempt_thinning(const struct subject *s, double tolerance, unsigned flags,
                                     struct simple *r)
{
    struct thinning t;
    nurbs_status status =
        s->directions == 1 ? thin_curve(s, tolerance, &t) : thin(s, tolerance, flags, &t);
    if (status != NURBS_OK)
        return status;
    const struct coarse_net net = thinning_net(&t);
    status = simple_create(s, t.along, r);
    r->bound = HUGE_VAL;
    if (status == NURBS_OK && subject_read(s, &net, r->points, r->weights)) {
        restore_exact(s, net.size, (flags & NURBS_SIMPLIFY_KEEP_EDGES) != 0, r->points, r->weights);
        r->bound = subject_certify(s, &t, r->points, r->weights);
    }
    thinning_free(&t);
    return status;
}

static nurbs_status attempt_quick(const struct subject *s, double tolerance, unsigned flags,
                                  struct simple *r)
{
    struct tensor_thin t;
    struct wall wall[3] = {{0, 0.0}, {0, 0.0}, {0, 0.0}};
    if (flags & NURBS_SIMPLIFY_KEEP_EDGES)
        set_walls(s, wall);
    nurbs_status status =
        tensor_thin_create(s, tolerance, (flags & NURBS_SIMPLIFY_KEEP_KINKS) != 0, wall, &t);
    if (status != NURBS_OK)
        return status;
    status = tensor_thin_run(&t);
    const struct coarse_net net = tensor_thin_net(&t);
    if (status == NURBS_OK)
        status = simple_create(s, t.along, r);
    r->bound = HUGE_VAL;
    if (status == NURBS_OK && subject_read(s, &net, r->points, r->weights)) {
        restore_exact(s, net.size, (flags & NURBS_SIMPLIFY_KEEP_EDGES) != 0, r->points, r->weights);
        r->bound = tensor_thin_certify(&t, r->points, r->weights);
    }
    tensor_thin_free(&t);
    return status;
}

/* Thins within a tolerance that is tightened until the certificate, which counts what is kept
 * exactly, holds: snapping an edge to its plane can cost more than thinning left. */
static nurbs_status simplify(const struct subject *s, double tolerance, unsigned flags,
                             struct simple *r)
{
    const int quick = s->directions == 2 && !(flags & NURBS_SIMPLIFY_THRIFTY);
    memset(r, 0, sizeof *r);
    double target = tolerance - s->rounding;
    for (int attempt = 0; attempt < 8 && target > 0.0; attempt++) {
        nurbs_status status =
            quick ? attempt_quick(s, target, flags, r) : attempt_thinning(s, target, flags, r);
        if (status != NURBS_OK || r->bound <= tolerance)
            return status;
        target *= 0.97 * fmax(0.5, fmin(1.0, tolerance / r->bound));
        simple_free(r);
    }
    return NURBS_OK;
}

static nurbs_status request_check(const void *spline, double tolerance, const void *result)
{
    if (!spline || !result)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL",
                          spline ? "result" : "the spline to simplify");
    if (!(tolerance > 0.0) || !isfinite(tolerance))
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "tolerance is %g, expected a positive length in metres", tolerance);
    return NURBS_OK;
}

nurbs_status nurbs_curve_simplify(const nurbs_curve *curve, double tolerance, nurbs_curve **result,
                                  double *bound)
{
    nurbs_status status = request_check(curve, tolerance, result);
    if (status != NURBS_OK)
        return status;
    *result = NULL;
    const struct axis *const axes[2] = {&curve->axis, NULL};
    struct subject s;
    struct simple r;
    status = subject_create(1, curve->axis.size <= SHORT_CURVE ? PARTS : 1, axes, curve->points,
                            curve->weights, &s);
    if (status != NURBS_OK)
        return status;
    status = simplify(&s, tolerance, 0, &r);
    if (status == NURBS_OK)
        status = simple_curve(curve, &r, result, bound);
    simple_free(&r);
    subject_free(&s);
    return status;
}

nurbs_status nurbs_surface_simplify(const nurbs_surface *surface, double tolerance, unsigned flags,
                                    nurbs_surface **result, double *bound)
{
    nurbs_status status = request_check(surface, tolerance, result);
    if (status != NURBS_OK)
        return status;
    *result = NULL;
    if (flags &
        ~(unsigned)(NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_KEEP_KINKS | NURBS_SIMPLIFY_THRIFTY))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "flags are %#x, expected NURBS_KEEP_*", flags);
    const struct axis *const axes[2] = {&surface->axis[0], &surface->axis[1]};
    struct subject s;
    struct simple r;
    status = subject_create(2, flags & NURBS_SIMPLIFY_THRIFTY ? PARTS : 1, axes, surface->points,
                            surface->weights, &s);
    if (status != NURBS_OK)
        return status;
    status = simplify(&s, tolerance, flags, &r);
    if (status == NURBS_OK)
        status = simple_surface(surface, &r, result, bound);
    simple_free(&r);
    subject_free(&s);
    return status;
}
