#include "fit/parametrize.h"

#include "core/constants.h"
#include "core/error.h"

#include <math.h>
#include <stdlib.h>

static const double right_angle = PI / 2;

static double distance(const double *a, const double *b)
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

/* Turning angle at b, in [0, pi]; 0 where a neighbour coincides. */
static double turning(const double *a, const double *b, const double *c)
{
    double dot = 0, p[3], q[3];
    for (int k = 0; k < 3; k++) {
        p[k] = b[k] - a[k];
        q[k] = c[k] - b[k];
        dot += p[k] * q[k];
    }
    double x = p[1] * q[2] - p[2] * q[1], y = p[2] * q[0] - p[0] * q[2],
           z = p[0] * q[1] - p[1] * q[0];
    return atan2(sqrt(x * x + y * y + z * z), dot);
}

double nurbs_turning_angle(const double *a, const double *b, const double *c)
{
    return turning(a, b, c);
}

/* Foley and Nielsen (1989): chord lengths stretched where the polygon turns. */
static double foley_increment(size_t n, const double *points, size_t k)
{
    const double *p = points + 3 * k;
    double d = distance(p, p + 3), factor = 1;
    if (k > 0) {
        double before = distance(p - 3, p), angle = fmin(turning(p - 3, p, p + 3), right_angle);
        if (before + d > 0)
            factor += 1.5 * angle * before / (before + d);
    }
    if (k + 2 < n) {
        double after = distance(p + 3, p + 6), angle = fmin(turning(p, p + 3, p + 6), right_angle);
        if (after + d > 0)
            factor += 1.5 * angle * after / (after + d);
    }
    return d * factor;
}

nurbs_status nurbs_parametrize(nurbs_parametrization kind, size_t n, const double *points,
                               double *u)
{
    NURBS_NEED(n == 0 || (points && u));
    if (n < 2)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%zu points to parametrise, expected at least 2",
                          n);
    for (size_t k = 0; k < 3 * n; k++)
        if (!isfinite(points[k]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "point %zu: coordinate %zu is %g", k / 3, k % 3,
                              points[k]);
    u[0] = 0;
    for (size_t k = 0; k + 1 < n; k++) {
        double step = 1;
        switch (kind) {
        case NURBS_PARAMETRIZATION_UNIFORM:
            break;
        case NURBS_PARAMETRIZATION_CHORD:
            step = distance(points + 3 * k, points + 3 * k + 3);
            break;
        case NURBS_PARAMETRIZATION_CENTRIPETAL:
            step = sqrt(distance(points + 3 * k, points + 3 * k + 3));
            break;
        case NURBS_PARAMETRIZATION_FOLEY:
            step = foley_increment(n, points, k);
            break;
        default:
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "unknown parametrization %d", (int)kind);
        }
        u[k + 1] = u[k] + step;
    }
    double total = u[n - 1];
    for (size_t k = 0; k < n; k++)
        u[k] = total > 0 ? u[k] / total : (double)k / (double)(n - 1);
    u[n - 1] = 1;
    return NURBS_OK;
}

nurbs_status nurbs_parametrize_lines(nurbs_parametrization kind, size_t lines, size_t n,
                                     size_t line_stride, size_t point_stride, const double *points,
                                     double *u)
{
    double *line = malloc(4 * n * sizeof *line);
    if (!line)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu parameters", n);
    double *t = line + 3 * n;
    for (size_t k = 0; k < n; k++)
        u[k] = 0;
    size_t used = 0;
    nurbs_status status = NURBS_OK;
    for (size_t l = 0; l < lines && status == NURBS_OK; l++) {
        double length = 0;
        for (size_t k = 0; k < n; k++)
            for (size_t c = 0; c < 3; c++)
                line[3 * k + c] = points[3 * (l * line_stride + k * point_stride) + c];
        for (size_t k = 0; k + 1 < n; k++)
            length += distance(line + 3 * k, line + 3 * k + 3);
        if (length > 0) {
            status = nurbs_parametrize(kind, n, line, t);
            used++;
            for (size_t k = 0; k < n && status == NURBS_OK; k++)
                u[k] += t[k];
        }
    }
    free(line);
    if (status != NURBS_OK)
        return status;
    if (used == 0)
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "all %zu lines of the grid collapse to points",
                          lines);
    for (size_t k = 0; k < n; k++)
        u[k] /= (double)used;
    u[n - 1] = 1;
    for (size_t k = 0; k + 1 < n; k++)
        if (!(u[k + 1] > u[k]))
            return nurbs_fail(NURBS_ERROR_GEOMETRY,
                              "lines %zu and %zu of the grid coincide: their parameters are equal",
                              k + 1, k + 2);
    return NURBS_OK;
}
