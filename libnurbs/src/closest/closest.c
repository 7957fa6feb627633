#include "closest/closest.h"

#include "closest/closest_proof.h"
#include "core/error.h"

#include <nurbs/invert.h>
#include <nurbs/modify.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum { MAX_STEPS = 60, MAX_HALVINGS = 40 };

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* f = |S - P|^2 / 2 with gradient and Hessian; derivatives from inside the box. */
struct distance_model {
    double f, gradient[2], hessian[3]; /* uu, uv, vv */
    double gauss[3];                   /* the part without second derivatives */
    double residual, speed[2];         /* |S - P|, |Su|, |Sv| */
};

static void model_at(const nurbs_surface *surface, const struct box2 *box, const double point[3],
                     const double uv[2], struct distance_model *m)
{
    double s[18], r[3];
    const unsigned left = (uv[0] >= box->high[0] ? 1U : 0U) | (uv[1] >= box->high[1] ? 2U : 0U);
    nurbs_surface_eval_sided(surface, 2, left, 1, uv, s);
    for (int c = 0; c < 3; c++)
        r[c] = s[c] - point[c];
    const double *su = s + 3, *sv = s + 6;
    m->f = 0.5 * dot(r, r);
    m->residual = sqrt(2.0 * m->f);
    m->gradient[0] = dot(r, su);
    m->gradient[1] = dot(r, sv);
    m->gauss[0] = dot(su, su);
    m->gauss[1] = dot(su, sv);
    m->gauss[2] = dot(sv, sv);
    for (int k = 0; k < 3; k++)
        m->hessian[k] = m->gauss[k] + dot(r, s + 9 + 3 * k);
    m->speed[0] = sqrt(m->gauss[0]);
    m->speed[1] = sqrt(m->gauss[2]);
}

/* Solves h x = -g for the free parameters if h is positive definite there. */
static int newton_step(const double h[3], const double g[2], const int is_free[2], double step[2])
{
    step[0] = step[1] = 0.0;
    if (is_free[0] && is_free[1]) {
        const double determinant = h[0] * h[2] - h[1] * h[1];
        if (!(h[0] > 0.0) || !(determinant > 1e-12 * h[0] * h[2]))
            return 0;
        step[0] = (h[1] * g[1] - h[2] * g[0]) / determinant;
        step[1] = (h[1] * g[0] - h[0] * g[1]) / determinant;
        return 1;
    }
    const int d = is_free[0] ? 0 : 1;
    const double curvature = h[2 * d];
    if (!(curvature > 0.0))
        return 0;
    step[d] = -g[d] / curvature;
    return 1;
}

/* Newton where the Hessian allows it, else Gauss-Newton, else steepest descent. */
static void choose_step(const struct distance_model *m, const int is_free[2], double step[2])
{
    if (newton_step(m->hessian, m->gradient, is_free, step) ||
        newton_step(m->gauss, m->gradient, is_free, step))
        return;
    for (int d = 0; d < 2; d++)
        step[d] = is_free[d] && m->gauss[2 * d] > 0.0 ? -m->gradient[d] / m->gauss[2 * d] : 0.0;
}

static double clamp(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

double closest_in_box(const nurbs_surface *surface, const struct box2 *box, const double point[3],
                      double uv[2])
{
    struct distance_model m;
    model_at(surface, box, point, uv, &m);
    for (int iteration = 0; iteration < MAX_STEPS; iteration++) {
        int is_free[2], done = 1;
        for (int d = 0; d < 2; d++) {
            const double g = m.gradient[d];
            is_free[d] =
                !(uv[d] <= box->low[d] && g >= 0.0) && !(uv[d] >= box->high[d] && g <= 0.0);
            /* The residual is normal to the surface up to rounding. */
            done = done && (!is_free[d] || fabs(g) <= 4.0 * DBL_EPSILON * m.residual * m.speed[d]);
        }
        if (done || m.f == 0.0)
            break;
        double step[2], next[2] = {uv[0], uv[1]};
        choose_step(&m, is_free, step);
        struct distance_model trial = m;
        double fraction = 1.0;
        int better = 0;
        for (int h = 0; h < MAX_HALVINGS && !better; h++, fraction *= 0.5) {
            for (int d = 0; d < 2; d++)
                next[d] = clamp(uv[d] + fraction * step[d], box->low[d], box->high[d]);
            if (next[0] == uv[0] && next[1] == uv[1])
                break;
            model_at(surface, box, point, next, &trial);
            better = trial.f < m.f;
        }
        if (!better)
            break;
        uv[0] = next[0];
        uv[1] = next[1];
        m = trial;
    }
    return 2.0 * m.f;
}

nurbs_status closest_check(const void *spline, size_t n, const double *points, const double *out)
{
    if (!spline)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "the curve, surface or locator is NULL");
    if (n && (!points || !out))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL",
                          points ? "the parameter array" : "points");
    for (size_t i = 0; i < 3 * n; i++)
        if (!isfinite(points[i]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "point %zu has %c = %g, expected a finite number", i / 3,
                              "xyz"[i % 3], points[i]);
    return NURBS_OK;
}

nurbs_status nurbs_surface_closest_near(const nurbs_surface *surface, size_t n,
                                        const double *points, double *uv, double *distance)
{
    nurbs_status status = closest_check(surface, n, points, uv);
    if (status != NURBS_OK)
        return status;
    struct box2 domain;
    for (int d = 0; d < 2; d++) {
        domain.low[d] = surface->axis[d].knots[0];
        domain.high[d] = surface->axis[d].knots[surface->axis[d].size];
    }
    for (size_t i = 0; i < n; i++) {
        for (int d = 0; d < 2; d++)
            if (!(uv[2 * i + (size_t)d] >= domain.low[d] &&
                  uv[2 * i + (size_t)d] <= domain.high[d]))
                return nurbs_fail(
                    NURBS_ERROR_ARGUMENT,
                    "start %zu has %c = %.17g, outside the domain from %.17g to %.17g", i, "uv"[d],
                    uv[2 * i + (size_t)d], domain.low[d], domain.high[d]);
        const double square = closest_in_box(surface, &domain, points + 3 * i, uv + 2 * i);
        if (distance)
            distance[i] = sqrt(square);
    }
    return NURBS_OK;
}

/* Newton in [low, high] of one curve, as above. */
static double closest_on_interval(const nurbs_curve *curve, double low, double high,
                                  const double point[3], double *u)
{
    double best = HUGE_VAL, at = *u, next = *u;
    for (int iteration = 0; iteration < MAX_STEPS; iteration++) {
        double c[9], r[3], step, fraction = 1.0, f = HUGE_VAL;
        if (at >= high)
            nurbs_curve_eval_left(curve, 2, 1, &at, c);
        else
            nurbs_curve_eval(curve, 2, 1, &at, c);
        for (int x = 0; x < 3; x++)
            r[x] = c[x] - point[x];
        const double square = dot(r, r), slope = dot(r, c + 3), gauss = dot(c + 3, c + 3);
        best = square;
        if ((at <= low && slope >= 0.0) || (at >= high && slope <= 0.0) ||
            fabs(slope) <= 4.0 * DBL_EPSILON * sqrt(square * gauss))
            break;
        const double curvature = gauss + dot(r, c + 6);
        step = curvature > 0.0 ? -slope / curvature : gauss > 0.0 ? -slope / gauss : 0.0;
        for (int h = 0; h < MAX_HALVINGS && !(f < square); h++, fraction *= 0.5) {
            double p[3];
            next = clamp(at + fraction * step, low, high);
            if (next == at)
                break;
            nurbs_curve_eval(curve, 0, 1, &next, p);
            f = 0.0;
            for (int x = 0; x < 3; x++)
                f += (p[x] - point[x]) * (p[x] - point[x]);
        }
        if (!(f < square))
            break;
        at = next;
        best = f;
    }
    *u = at;
    return best;
}

int closest_parts(double first, double second)
{
    const double turning = first > 0.0 ? second / first : 0.0; /* at most 2 */
    return 2 + (int)(4.0 * turning);
}

void closest_differences(size_t count, size_t stride, const double *p, double *first,
                         double *second)
{
    for (size_t k = 0; k + 1 < count; k++) {
        const double *a = p + k * stride, *b = a + stride, *c = b + stride;
        double one = 0.0, two = 0.0;
        for (int x = 0; x < 3; x++) {
            one += (b[x] - a[x]) * (b[x] - a[x]);
            if (k + 2 < count)
                two += (c[x] - 2.0 * b[x] + a[x]) * (c[x] - 2.0 * b[x] + a[x]);
        }
        *first = fmax(*first, sqrt(one));
        *second = fmax(*second, sqrt(two));
    }
}

/* The Bezier segments of a curve with their boxes. */
struct segments {
    nurbs_curve *bezier;
    size_t count, *start; /* first control point */
    double *bounds;       /* [count][6] */
};

static void segments_free(struct segments *s)
{
    nurbs_curve_free(s->bezier);
    free(s->start);
    free(s->bounds);
}

static nurbs_status segments_create(const nurbs_curve *curve, struct segments *s)
{
    *s = (struct segments){0};
    nurbs_status status = nurbs_curve_to_bezier(curve, &s->bezier);
    if (status != NURBS_OK)
        return status;
    const struct axis *axis = &s->bezier->axis;
    const size_t p = (size_t)axis->degree;
    s->start = malloc(axis->size * sizeof *s->start);
    s->bounds = malloc(6 * axis->size * sizeof *s->bounds);
    if (!s->start || !s->bounds) {
        segments_free(s);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to locate in %zu spans", axis->size);
    }
    for (size_t k = p; k < axis->size; k++) {
        if (axis->knots[k] == axis->knots[k + 1])
            continue;
        double *bounds = s->bounds + 6 * s->count;
        s->start[s->count++] = k - p;
        for (size_t c = 0; c < 3; c++) {
            bounds[c] = HUGE_VAL;
            bounds[3 + c] = -HUGE_VAL;
        }
        for (size_t i = 3 * (k - p); i < 3 * (k + 1); i++) {
            bounds[i % 3] = fmin(bounds[i % 3], s->bezier->points[i]);
            bounds[3 + i % 3] = fmax(bounds[3 + i % 3], s->bezier->points[i]);
        }
    }
    return NURBS_OK;
}

static double search_interval(const void *context, const struct box2 *box, const double point[3],
                              double uv[2])
{
    return closest_on_interval(context, box->low[0], box->high[0], point, uv);
}

static double prove_segment(const nurbs_curve *curve, const struct segments *s, size_t k,
                            const double point[3], double best, double uv[2], size_t *cells)
{
    const struct axis *axis = &s->bezier->axis;
    const size_t p = (size_t)axis->degree;
    const struct bezier_patch patch = {
        {p + 1, 1},
        s->bezier->net + 4 * s->start[k],
        4,
        {{axis->knots[s->start[k] + p], 0.0}, {axis->knots[s->start[k] + p + 1], 0.0}}};
    return closest_prove(&patch, point, search_interval, curve, best, uv, cells);
}

static double closest_on_curve(const nurbs_curve *curve, const struct segments *s,
                               const double point[3], double *u)
{
    size_t first = 0, cells = CLOSEST_CELLS;
    double nearest = HUGE_VAL, uv[2] = {0.0, 0.0};
    for (size_t k = 0; k < s->count; k++) {
        const double d = distance_to_bounds(point, s->bounds + 6 * k);
        if (d < nearest) {
            nearest = d;
            first = k;
        }
    }
    double best = prove_segment(curve, s, first, point, HUGE_VAL, uv, &cells);
    for (size_t k = 0; k < s->count; k++)
        if (k != first && distance_to_bounds(point, s->bounds + 6 * k) < best)
            best = prove_segment(curve, s, k, point, best, uv, &cells);
    /* A minimum next to the end of a segment may lie immaterially beyond it. */
    *u = uv[0];
    const double square = closest_on_interval(curve, curve->axis.knots[0],
                                              curve->axis.knots[curve->axis.size], point, u);
    if (square < best)
        return square;
    *u = uv[0];
    return best;
}

nurbs_status nurbs_curve_closest(const nurbs_curve *curve, size_t n, const double *points,
                                 double *u, double *distance)
{
    nurbs_status status = closest_check(curve, n, points, u);
    struct segments segments;
    if (status == NURBS_OK)
        status = segments_create(curve, &segments);
    if (status != NURBS_OK)
        return status;
    for (size_t i = 0; i < n; i++) {
        const double square = closest_on_curve(curve, &segments, points + 3 * i, u + i);
        if (distance)
            distance[i] = sqrt(square);
    }
    segments_free(&segments);
    return NURBS_OK;
}
