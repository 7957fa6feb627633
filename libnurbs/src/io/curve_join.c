#include "io/curve_join.h"

#include "core/error.h"

#include <nurbs/modify.h>

#include <stdlib.h>
#include <string.h>

/* Knots and homogeneous points of all curves, one after the other; joints keep one point. */
static nurbs_status concatenate(size_t n, nurbs_curve *const *curves, int degree,
                                nurbs_curve **joined)
{
    size_t room = 1, p = (size_t)degree, count = 0, used;
    bool rational = false;
    for (size_t k = 0; k < n; k++) {
        room += nurbs_curve_size(curves[k]);
        rational |= nurbs_curve_weights(curves[k]) != NULL;
    }
    double *knots = malloc((room + p + 1 + 4 * room) * sizeof *knots), offset = 0, scale = 1;
    if (!knots)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", room);
    double *points = knots + room + p + 1, *weights = points + 3 * room;
    used = 0;
    for (size_t k = 0; k < n; k++) {
        const nurbs_curve *c = curves[k];
        size_t size = nurbs_curve_size(c), skip = k > 0;
        const double *t = nurbs_curve_knots(c), *w = nurbs_curve_weights(c);
        offset = k > 0 ? knots[used - 1] - t[0] : 0;
        /* Weights of one curve may be scaled as a whole, so that the joint has one. */
        scale = k > 0 ? weights[count - 1] / (w ? w[0] : 1) : 1;
        if (k > 0)
            used--; /* the joint's knot has multiplicity degree */
        for (size_t i = k > 0 ? p + 1 : 0; i < size + p + 1; i++)
            knots[used++] = t[i] + offset;
        memcpy(points + 3 * count, nurbs_curve_points(c) + 3 * skip,
               3 * (size - skip) * sizeof *points);
        for (size_t i = skip; i < size; i++)
            weights[count + i - skip] = scale * (w ? w[i] : 1);
        count += size - skip;
    }
    nurbs_status status =
        nurbs_curve_create(degree, count, knots, points, rational ? weights : NULL, joined);
    free(knots);
    return status;
}

nurbs_status curves_join(size_t n, const nurbs_curve *const *curves, nurbs_curve **joined)
{
    int degree = 1;
    nurbs_status status = NURBS_OK;
    *joined = NULL;
    if (n == 0)
        return nurbs_fail(NURBS_ERROR_FORMAT, "a composite curve without parts");
    nurbs_curve **raised = calloc(n, sizeof *raised);
    if (!raised)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu curves", n);
    for (size_t k = 0; k < n; k++)
        if (nurbs_curve_degree(curves[k]) > degree)
            degree = nurbs_curve_degree(curves[k]);
    for (size_t k = 0; k < n && status == NURBS_OK; k++)
        status = nurbs_curve_elevate(curves[k], degree - nurbs_curve_degree(curves[k]), &raised[k]);
    if (status == NURBS_OK)
        status = concatenate(n, raised, degree, joined);
    for (size_t k = 0; k < n; k++)
        nurbs_curve_free(raised[k]);
    free(raised);
    return status;
}
