#include "core/band.h"
#include "core/error.h"

#include <nurbs/basis.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

nurbs_status modify_check(const nurbs_surface *surface, int direction, nurbs_surface **result)
{
    if (!result)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "result is NULL, expected a place for it");
    *result = NULL;
    if (!surface)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "surface is NULL");
    if (direction != 0 && direction != 1)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "direction is %d, expected 0 (u) or 1 (v)",
                          direction);
    return NURBS_OK;
}

/* Clamped knots of the part [from, to]: creates them. */
static nurbs_status part_knots(const struct axis *axis, double from, double to, double **knots,
                               size_t *size)
{
    const size_t p = (size_t)axis->degree;
    const double *t = axis->knots;
    *knots = NULL;
    if (!(from >= t[0] && to <= t[axis->size] && from < to))
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "part from %.17g to %.17g, expected an increasing pair in %.17g to %.17g",
                          from, to, t[0], t[axis->size]);
    double *part = malloc((axis->size + p + 1) * sizeof *part);
    if (!part)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", axis->size + p + 1);
    size_t n = 0;
    for (size_t i = 0; i <= p; i++)
        part[n++] = from;
    for (size_t i = p + 1; i < axis->size; i++)
        if (t[i] > from && t[i] < to)
            part[n++] = t[i];
    *size = n;
    for (size_t i = 0; i <= p; i++)
        part[n++] = to;
    *knots = part;
    return NURBS_OK;
}

nurbs_status nurbs_curve_part(const nurbs_curve *curve, double from, double to,
                              nurbs_curve **result)
{
    if (!curve || !result)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", curve ? "result" : "curve");
    *result = NULL;
    double *knots;
    size_t size;
    struct band band = {0};
    nurbs_status status = part_knots(&curve->axis, from, to, &knots, &size);
    if (status == NURBS_OK)
        status = band_insertion(&curve->axis, size, knots, &band);
    if (status == NURBS_OK)
        status = curve_map(curve, &band, curve->axis.degree, knots, result);
    band_free(&band);
    free(knots);
    return status;
}

nurbs_status nurbs_surface_part(const nurbs_surface *surface, int direction, double from, double to,
                                nurbs_surface **result)
{
    nurbs_status status = modify_check(surface, direction, result);
    if (status != NURBS_OK)
        return status;
    const struct axis *axis = &surface->axis[direction];
    double *knots;
    size_t size;
    struct band band = {0};
    status = part_knots(axis, from, to, &knots, &size);
    if (status == NURBS_OK)
        status = band_insertion(axis, size, knots, &band);
    if (status == NURBS_OK)
        status = surface_map(surface, direction, &band, axis->degree, knots, result);
    band_free(&band);
    free(knots);
    return status;
}

nurbs_status nurbs_curve_split(const nurbs_curve *curve, double u, nurbs_curve **left,
                               nurbs_curve **right)
{
    if (!curve || !left || !right)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL",
                          !curve  ? "curve"
                          : !left ? "left"
                                  : "right");
    *right = NULL;
    nurbs_status status = nurbs_curve_part(curve, curve->axis.knots[0], u, left);
    if (status == NURBS_OK)
        status = nurbs_curve_part(curve, u, curve->axis.knots[curve->axis.size], right);
    if (status != NURBS_OK) {
        nurbs_curve_free(*left);
        *left = NULL;
    }
    return status;
}

nurbs_status nurbs_surface_split(const nurbs_surface *surface, int direction, double value,
                                 nurbs_surface **low, nurbs_surface **high)
{
    nurbs_status status = modify_check(surface, direction, low);
    if (status == NURBS_OK)
        status = modify_check(surface, direction, high);
    if (status != NURBS_OK)
        return status;
    const struct axis *axis = &surface->axis[direction];
    status = nurbs_surface_part(surface, direction, axis->knots[0], value, low);
    if (status == NURBS_OK)
        status = nurbs_surface_part(surface, direction, value, axis->knots[axis->size], high);
    if (status != NURBS_OK) {
        nurbs_surface_free(*low);
        *low = NULL;
    }
    return status;
}

/* Knots mirrored in the middle of the domain: creates them; the ends stay exactly. */
static nurbs_status mirrored_knots(const struct axis *axis, double **mirrored)
{
    const size_t n = axis->size, count = n + (size_t)axis->degree + 1;
    const double begin = axis->knots[0], end = axis->knots[n];
    *mirrored = malloc(count * sizeof **mirrored);
    if (!*mirrored)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", count);
    for (size_t i = 0; i < count; i++) {
        const double t = axis->knots[count - 1 - i];
        (*mirrored)[i] = t == end ? begin : t == begin ? end : begin + (end - t);
    }
    return NURBS_OK;
}

nurbs_status nurbs_curve_reverse(const nurbs_curve *curve, nurbs_curve **result)
{
    if (!curve || !result)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", curve ? "result" : "curve");
    *result = NULL;
    const size_t n = curve->axis.size;
    double *knots, *points = malloc(4 * n * sizeof *points);
    nurbs_status status = mirrored_knots(&curve->axis, &knots);
    if (status == NURBS_OK && !points)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu control points", n);
    if (status == NURBS_OK) {
        double *weights = curve->weights ? points + 3 * n : NULL;
        for (size_t i = 0; i < n; i++) {
            memcpy(points + 3 * i, curve->points + 3 * (n - 1 - i), 3 * sizeof *points);
            if (weights)
                weights[i] = curve->weights[n - 1 - i];
        }
        status = nurbs_curve_create(curve->axis.degree, n, knots, points, weights, result);
    }
    free(knots);
    free(points);
    return status;
}

/* A surface whose control point (i,j) is the one of s with index source(s, i, j). */
static nurbs_status permuted(const nurbs_surface *s, const int degree[2], const size_t size[2],
                             const double *const knots[2],
                             size_t (*source)(const nurbs_surface *, size_t, size_t),
                             nurbs_surface **result)
{
    const size_t n = size[0] * size[1];
    double *points = malloc(4 * n * sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu control points", n);
    double *weights = s->weights ? points + 3 * n : NULL;
    for (size_t i = 0; i < size[0]; i++)
        for (size_t j = 0; j < size[1]; j++) {
            const size_t to = i * size[1] + j, from = source(s, i, j);
            memcpy(points + 3 * to, s->points + 3 * from, 3 * sizeof *points);
            if (weights)
                weights[to] = s->weights[from];
        }
    nurbs_status status =
        nurbs_surface_create(degree, size, knots[0], knots[1], points, weights, result);
    free(points);
    return status;
}

static size_t from_reversed_u(const nurbs_surface *s, size_t i, size_t j)
{
    return (s->axis[0].size - 1 - i) * s->axis[1].size + j;
}

static size_t from_reversed_v(const nurbs_surface *s, size_t i, size_t j)
{
    return i * s->axis[1].size + s->axis[1].size - 1 - j;
}

static size_t from_swapped(const nurbs_surface *s, size_t i, size_t j)
{
    return j * s->axis[1].size + i;
}

nurbs_status nurbs_surface_reverse(const nurbs_surface *surface, int direction,
                                   nurbs_surface **result)
{
    nurbs_status status = modify_check(surface, direction, result);
    if (status != NURBS_OK)
        return status;
    const int degree[2] = {surface->axis[0].degree, surface->axis[1].degree};
    const size_t size[2] = {surface->axis[0].size, surface->axis[1].size};
    const double *knots[2] = {surface->axis[0].knots, surface->axis[1].knots};
    double *mirrored;
    status = mirrored_knots(&surface->axis[direction], &mirrored);
    knots[direction] = mirrored;
    if (status == NURBS_OK)
        status = permuted(surface, degree, size, knots,
                          direction == 0 ? from_reversed_u : from_reversed_v, result);
    free(mirrored);
    return status;
}

nurbs_status nurbs_surface_swap(const nurbs_surface *surface, nurbs_surface **result)
{
    nurbs_status status = modify_check(surface, 0, result);
    if (status != NURBS_OK)
        return status;
    const int degree[2] = {surface->axis[1].degree, surface->axis[0].degree};
    const size_t size[2] = {surface->axis[1].size, surface->axis[0].size};
    const double *const knots[2] = {surface->axis[1].knots, surface->axis[0].knots};
    return permuted(surface, degree, size, knots, from_swapped, result);
}

nurbs_status nurbs_surface_transform(const nurbs_surface *surface, const double *matrix,
                                     const double shift[3], nurbs_surface **result)
{
    nurbs_status status = modify_check(surface, 0, result);
    if (status != NURBS_OK)
        return status;
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, nowhere[3] = {0, 0, 0};
    const double *m = matrix ? matrix : identity, *b = shift ? shift : nowhere;
    for (int k = 0; k < 12; k++)
        if (!isfinite(k < 9 ? m[k] : b[k - 9]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s entry %d is not finite",
                              k < 9 ? "matrix" : "shift", k < 9 ? k : k - 9);
    const size_t n = surface->axis[0].size * surface->axis[1].size;
    double *points = malloc(3 * n * sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu control points", n);
    for (size_t i = 0; i < n; i++) {
        const double *p = surface->points + 3 * i;
        for (size_t c = 0; c < 3; c++)
            points[3 * i + c] = m[3 * c] * p[0] + m[3 * c + 1] * p[1] + m[3 * c + 2] * p[2] + b[c];
    }
    const int degree[2] = {surface->axis[0].degree, surface->axis[1].degree};
    const size_t size[2] = {surface->axis[0].size, surface->axis[1].size};
    status = nurbs_surface_create(degree, size, surface->axis[0].knots, surface->axis[1].knots,
                                  points, surface->weights, result);
    free(points);
    return status;
}

nurbs_status nurbs_surface_iso_curve(const nurbs_surface *surface, int direction, double value,
                                     nurbs_curve **curve)
{
    if (!curve)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "curve is NULL, expected a place for the result");
    *curve = NULL;
    nurbs_surface *unused;
    nurbs_status status = modify_check(surface, direction, &unused);
    if (status != NURBS_OK)
        return status;
    const struct axis *fixed = &surface->axis[direction], *along = &surface->axis[1 - direction];
    if (!(value >= fixed->knots[0] && value <= fixed->knots[fixed->size]))
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "%c = %.17g is outside the domain from %.17g to %.17g", "uv"[direction],
                          value, fixed -> knots[0], fixed -> knots[fixed->size]);
    const size_t p = (size_t)fixed->degree, n = along->size;
    const size_t step = direction == 0 ? surface->axis[1].size : 1;   /* between summed points */
    const size_t stride = direction == 0 ? 1 : surface->axis[1].size; /* along the curve */
    const size_t span = axis_span(fixed, value);
    double basis[NURBS_MAX_DEGREE + 1], *points = calloc(4 * n, sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu control points", n);
    nurbs_basis(fixed->degree, fixed->knots, span, value, basis);
    double *weights = surface->weights ? points + 3 * n : NULL;
    for (size_t j = 0; j < n; j++) {
        double sum[4] = {0.0, 0.0, 0.0, 0.0};
        for (size_t a = 0; a <= p; a++) {
            const double *q = surface->net + 4 * ((span - p + a) * step + j * stride);
            for (size_t c = 0; c < 4; c++)
                sum[c] += basis[a] * q[c];
        }
        for (size_t c = 0; c < 3; c++)
            points[3 * j + c] = weights ? sum[c] / sum[3] : sum[c];
        if (weights)
            weights[j] = sum[3];
    }
    status = nurbs_curve_create(along->degree, n, along->knots, points, weights, curve);
    free(points);
    return status;
}
