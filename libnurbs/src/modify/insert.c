#include "core/band.h"
#include "core/error.h"

#include <nurbs/basis.h>
#include <nurbs/modify.h>

#include <stdlib.h>

/* Merges n sorted knots into those of the axis after checking them: creates knots. */
static nurbs_status merge_knots(const struct axis *axis, size_t n, const double *u, double **merged)
{
    const size_t p = (size_t)axis->degree, count = axis->size + p + 1;
    const double begin = axis->knots[0], end = axis->knots[axis->size];
    *merged = NULL;
    if (n && !u)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "the knots to insert are NULL, expected %zu", n);
    for (size_t i = 0; i < n; i++) {
        if (!(u[i] > begin && u[i] < end))
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "knot %zu to insert is %.17g, expected inside %.17g to %.17g", i,
                              u[i], begin, end);
        if (i > 0 && u[i] < u[i - 1])
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "knot %zu to insert decreases: %.17g after %.17g", i, u[i], u[i - 1]);
    }
    double *knots = malloc((count + n) * sizeof *knots);
    if (!knots)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", count + n);
    size_t used = 0;
    for (size_t k = 0, i = 0; k < count + n; k++)
        knots[k] = i < n && u[i] < axis->knots[used] ? u[i++] : axis->knots[used++];
    for (size_t i = 0, k = p + 1; i < n; i++) {
        while (knots[k] < u[i])
            k++;
        size_t multiplicity = 1;
        while (knots[k + multiplicity] == u[i])
            multiplicity++;
        if (multiplicity > p) {
            free(knots);
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "knot %zu to insert (%.17g) would have multiplicity %zu, expected at "
                              "most the degree %zu",
                              i, u[i], multiplicity, p);
        }
    }
    *merged = knots;
    return NURBS_OK;
}

nurbs_status nurbs_curve_insert(const nurbs_curve *curve, size_t n, const double *u,
                                nurbs_curve **result)
{
    if (!curve || !result)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", curve ? "result" : "curve");
    *result = NULL;
    double *knots;
    struct band band = {0};
    nurbs_status status = merge_knots(&curve->axis, n, u, &knots);
    if (status == NURBS_OK)
        status = band_insertion(&curve->axis, curve->axis.size + n, knots, &band);
    if (status == NURBS_OK)
        status = curve_map(curve, &band, curve->axis.degree, knots, result);
    band_free(&band);
    free(knots);
    return status;
}

nurbs_status nurbs_surface_insert(const nurbs_surface *surface, int direction, size_t n,
                                  const double *u, nurbs_surface **result)
{
    nurbs_status status = modify_check(surface, direction, result);
    if (status != NURBS_OK)
        return status;
    const struct axis *axis = &surface->axis[direction];
    double *knots;
    struct band band = {0};
    status = merge_knots(axis, n, u, &knots);
    if (status == NURBS_OK)
        status = band_insertion(axis, axis->size + n, knots, &band);
    if (status == NURBS_OK)
        status = surface_map(surface, direction, &band, axis->degree, knots, result);
    band_free(&band);
    free(knots);
    return status;
}

/* The knots that divide every non-empty span into equal parts: creates u. */
static nurbs_status dividing_knots(const struct axis *axis, int parts, double **u, size_t *n)
{
    const double *t = axis->knots;
    *n = 0;
    *u = malloc(axis->size * (size_t)parts * sizeof **u);
    if (!*u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu spans in %d parts", axis->size,
                          parts);
    for (size_t s = (size_t)axis->degree; s < axis->size; s++)
        for (int k = 1; t[s] < t[s + 1] && k < parts; k++) {
            const double knot = t[s] + (t[s + 1] - t[s]) * ((double)k / parts);
            if (!(knot > (*n ? (*u)[*n - 1] : t[0]) && knot > t[s] && knot < t[s + 1]))
                return nurbs_fail(NURBS_ERROR_ARGUMENT,
                                  "the span from %.17g to %.17g is too short for %d parts", t[s],
                                  t[s + 1], parts);
            (*u)[(*n)++] = knot;
        }
    return NURBS_OK;
}

nurbs_status nurbs_surface_refine(const nurbs_surface *surface, int parts, nurbs_surface **result)
{
    nurbs_status status = modify_check(surface, 0, result);
    if (status != NURBS_OK)
        return status;
    if (parts < 1 || parts > 1 << 20)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "spans in %d parts, expected 1 to 2^20", parts);
    nurbs_surface *half = NULL;
    double *u[2] = {NULL, NULL};
    size_t n[2];
    for (int d = 0; d < 2 && status == NURBS_OK; d++)
        status = dividing_knots(&surface->axis[d], parts, &u[d], &n[d]);
    if (status == NURBS_OK)
        status = nurbs_surface_insert(surface, 1, n[1], u[1], &half);
    if (status == NURBS_OK)
        status = nurbs_surface_insert(half, 0, n[0], u[0], result);
    nurbs_surface_free(half);
    free(u[0]);
    free(u[1]);
    return status;
}

/* Copies that bring every interior knot to a multiplicity of the degree: creates u. */
static nurbs_status bezier_knots(const struct axis *axis, double **u, size_t *n)
{
    const size_t p = (size_t)axis->degree;
    *n = 0;
    *u = malloc((axis->size * p + 1) * sizeof **u);
    if (!*u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu Bezier segments", axis->size);
    for (size_t i = p + 1; i < axis->size;) {
        size_t multiplicity = 1;
        while (axis->knots[i + multiplicity] == axis->knots[i])
            multiplicity++;
        for (size_t k = multiplicity; k < p; k++)
            (*u)[(*n)++] = axis->knots[i];
        i += multiplicity;
    }
    return NURBS_OK;
}

nurbs_status nurbs_curve_to_bezier(const nurbs_curve *curve, nurbs_curve **result)
{
    if (!curve || !result)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", curve ? "result" : "curve");
    *result = NULL;
    double *u;
    size_t n;
    nurbs_status status = bezier_knots(&curve->axis, &u, &n);
    if (status == NURBS_OK)
        status = nurbs_curve_insert(curve, n, u, result);
    free(u);
    return status;
}

nurbs_status nurbs_surface_to_bezier(const nurbs_surface *surface, nurbs_surface **result)
{
    nurbs_status status = modify_check(surface, 0, result);
    if (status != NURBS_OK)
        return status;
    nurbs_surface *half = NULL;
    double *u[2] = {NULL, NULL};
    size_t n[2];
    for (int d = 0; d < 2 && status == NURBS_OK; d++)
        status = bezier_knots(&surface->axis[d], &u[d], &n[d]);
    if (status == NURBS_OK)
        status = nurbs_surface_insert(surface, 1, n[1], u[1], &half);
    if (status == NURBS_OK)
        status = nurbs_surface_insert(half, 0, n[0], u[0], result);
    nurbs_surface_free(half);
    free(u[0]);
    free(u[1]);
    return status;
}
