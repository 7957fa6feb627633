#include "core/band.h"
#include "core/error.h"

#include <nurbs/basis.h>
#include <nurbs/modify.h>

#include <stdlib.h>
#include <string.h>

/* One more of each distinct knot: creates them. */
static nurbs_status elevated_knots(const struct axis *axis, double **elevated, size_t *size)
{
    const size_t count = axis->size + (size_t)axis->degree + 1;
    *elevated = malloc(2 * count * sizeof **elevated);
    if (!*elevated)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", 2 * count);
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || axis->knots[i] != axis->knots[i - 1])
            (*elevated)[n++] = axis->knots[i];
        (*elevated)[n++] = axis->knots[i];
    }
    *size = n - (size_t)axis->degree - 2;
    return NURBS_OK;
}

/* Control point j of degree p + 1 is the blossom of degree p + 1 at its knots, the mean of the
 * degree p blossoms that leave one of them out (Ramshaw 1989, section 8). */
nurbs_status band_elevation(const struct axis *axis, size_t elevated_size, const double *elevated,
                            struct band *band)
{
    const size_t p = (size_t)axis->degree;
    nurbs_status status = band_create(elevated_size, p + 1, band);
    if (status != NURBS_OK)
        return status;
    double args[NURBS_MAX_DEGREE + 1], weights[NURBS_MAX_DEGREE + 1];
    for (size_t j = 0; j < elevated_size; j++) {
        const double *t = elevated + j + 1;
        const size_t span = axis_span(axis, elevated[j]);
        double *row = band->values + j * band->width;
        band->first[j] = span - p;
        memset(row, 0, band->width * sizeof *row);
        for (size_t out = 0, equal; out <= p; out += equal) {
            equal = 1; /* equal knots leave equal sets: count them once */
            while (out + equal <= p && t[out + equal] == t[out])
                equal++;
            memcpy(args, t, out * sizeof *args);
            memcpy(args + out, t + out + 1, (p - out) * sizeof *args);
            blossom(axis->degree, axis->knots, span, args, weights);
            for (size_t r = 0; r <= p; r++)
                row[r] += (double)equal * weights[r];
        }
        for (size_t r = 0; r <= p; r++)
            row[r] /= (double)(p + 1);
    }
    return NURBS_OK;
}

static nurbs_status degree_check(int degree, int by)
{
    if (by >= 0 && by <= NURBS_MAX_DEGREE - degree)
        return NURBS_OK;
    return nurbs_fail(NURBS_ERROR_ARGUMENT, "degree %d raised by %d, expected 0 to %d", degree, by,
                      NURBS_MAX_DEGREE - degree);
}

nurbs_status nurbs_curve_elevate(const nurbs_curve *curve, int by, nurbs_curve **result)
{
    if (!curve || !result)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", curve ? "result" : "curve");
    *result = NULL;
    nurbs_curve *current = NULL, *next = NULL;
    nurbs_status status = degree_check(curve->axis.degree, by);
    if (status == NURBS_OK)
        status = nurbs_curve_copy(curve, &current);
    for (int k = 0; k < by && status == NURBS_OK; k++) {
        double *knots;
        size_t size;
        struct band band = {0};
        status = elevated_knots(&current->axis, &knots, &size);
        if (status == NURBS_OK)
            status = band_elevation(&current->axis, size, knots, &band);
        if (status == NURBS_OK)
            status = curve_map(current, &band, current->axis.degree + 1, knots, &next);
        band_free(&band);
        free(knots);
        nurbs_curve_free(current);
        current = next;
        next = NULL;
    }
    *result = current;
    return status;
}

nurbs_status nurbs_surface_elevate(const nurbs_surface *surface, int direction, int by,
                                   nurbs_surface **result)
{
    nurbs_status status = modify_check(surface, direction, result);
    if (status != NURBS_OK)
        return status;
    nurbs_surface *current = NULL, *next = NULL;
    status = degree_check(surface->axis[direction].degree, by);
    if (status == NURBS_OK)
        status = nurbs_surface_copy(surface, &current);
    for (int k = 0; k < by && status == NURBS_OK; k++) {
        const struct axis *axis = &current->axis[direction];
        double *knots;
        size_t size;
        struct band band = {0};
        status = elevated_knots(axis, &knots, &size);
        if (status == NURBS_OK)
            status = band_elevation(axis, size, knots, &band);
        if (status == NURBS_OK)
            status = surface_map(current, direction, &band, axis->degree + 1, knots, &next);
        band_free(&band);
        free(knots);
        nurbs_surface_free(current);
        current = next;
        next = NULL;
    }
    *result = current;
    return status;
}
