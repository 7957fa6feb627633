/* Least squares on given knots with both ends kept: band matrices in one direction, the two
 * directions of a grid one after the other (The NURBS Book 9.4). */
#include "core/banded.h"
#include "core/error.h"
#include "fit/least_squares.h"

#include <nurbs/basis.h>
#include <nurbs/fit.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

nurbs_status fit_matrix_create(int degree, size_t size, const double *knots, size_t n,
                               const double *u, fit_matrix *fit)
{
    size_t p = (size_t)degree, order = p + 1, inner = size - 2, hint = 0;
    *fit = (fit_matrix){.degree = degree, .size = size, .samples = n};
    fit->first = malloc(n * sizeof(size_t));
    fit->values = malloc(n * order * sizeof(double));
    nurbs_status status = NURBS_OK;
    if (!fit->first || !fit->values)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory to fit %zu points", n);
    for (size_t k = 0; k < n && status == NURBS_OK; k++) {
        size_t span = nurbs_basis_span(degree, size, knots, u[k], &hint);
        fit->first[k] = span - p;
        nurbs_basis(degree, knots, span, u[k], fit->values + k * order);
    }
    if (status == NURBS_OK && inner > 0)
        status = banded_create(inner, p, p, &fit->normal);
    for (size_t k = 0; k < n && inner > 0 && status == NURBS_OK; k++)
        for (size_t a = 0; a < order; a++)
            for (size_t b = 0; b < order; b++) {
                size_t i = fit->first[k] + a, j = fit->first[k] + b;
                if (i > 0 && i + 1 < size && j > 0 && j + 1 < size)
                    *banded_entry(&fit->normal, i - 1, j - 1) +=
                        fit->values[k * order + a] * fit->values[k * order + b];
            }
    if (status == NURBS_OK && inner > 0 && banded_factor(&fit->normal) != NURBS_OK)
        status = nurbs_fail(NURBS_ERROR_NUMERIC,
                            "%zu points do not determine %zu control points: some basis function "
                            "meets too few of them",
                            n, size);
    if (status != NURBS_OK)
        fit_matrix_free(fit);
    return status;
}

void fit_matrix_free(fit_matrix *fit)
{
    free(fit->first);
    free(fit->values);
    banded_free(&fit->normal);
    *fit = (fit_matrix){0};
}

void fit_matrix_solve(const fit_matrix *fit, size_t m, const double *data, double *control)
{
    size_t order = (size_t)fit->degree + 1, size = fit->size;
    const double *ends[2] = {data, data + (fit->samples - 1) * m};
    memset(control, 0, size * m * sizeof *control);
    for (size_t k = 0; k < fit->samples; k++) {
        const double *b = fit->values + k * order;
        size_t first = fit->first[k];
        double fixed[2] = {first == 0 ? b[0] : 0, first + order == size ? b[order - 1] : 0};
        for (size_t a = 0; a < order; a++) {
            size_t i = first + a;
            if (i == 0 || i + 1 == size || b[a] == 0)
                continue;
            for (size_t c = 0; c < m; c++)
                control[i * m + c] +=
                    b[a] * (data[k * m + c] - fixed[0] * ends[0][c] - fixed[1] * ends[1][c]);
        }
    }
    if (size > 2)
        banded_solve(&fit->normal, m, control + m);
    memcpy(control, ends[0], m * sizeof *control);
    memcpy(control + (size - 1) * m, ends[1], m * sizeof *control);
}

double fit_matrix_deviation(const fit_matrix *fit, size_t m, size_t k, const double *data,
                            const double *control)
{
    size_t order = (size_t)fit->degree + 1;
    double worst = 0;
    for (size_t c = 0; c < m; c += 3) {
        double square = 0;
        for (size_t d = c; d < c + 3; d++) {
            double difference = -data[k * m + d];
            for (size_t a = 0; a < order; a++)
                difference += fit->values[k * order + a] * control[(fit->first[k] + a) * m + d];
            square += difference * difference;
        }
        worst = fmax(worst, square);
    }
    return sqrt(worst);
}

nurbs_status check_fit_request(int degree, size_t size, const double *knots, size_t n,
                               const double *u)
{
    nurbs_status status = nurbs_knots_check(degree, size, knots);
    if (status != NURBS_OK)
        return status;
    if (n < size)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%zu points to fit %zu control points", n, size);
    for (size_t k = 0; k < n; k++)
        if (!(u[k] >= knots[0] && u[k] <= knots[size]) || (k > 0 && u[k] < u[k - 1]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "parameter %zu is %g: parameters do not decrease and lie in [%g, %g]",
                              k, u[k], knots[0], knots[size]);
    if (u[0] != knots[0] || u[n - 1] != knots[size])
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "parameters run from %g to %g, expected the whole domain [%g, %g]", u[0],
                          u[n - 1], knots[0], knots[size]);
    return NURBS_OK;
}

nurbs_status nurbs_curve_fit(int degree, size_t size, const double *knots, size_t n,
                             const double *points, const double *u, nurbs_curve **curve)
{
    NURBS_NEED(knots && curve && (n == 0 || (points && u)));
    fit_matrix fit;
    *curve = NULL;
    nurbs_status status = check_fit_request(degree, size, knots, n, u);
    for (size_t k = 0; k < 3 * n && status == NURBS_OK; k++)
        if (!isfinite(points[k]))
            status = nurbs_fail(NURBS_ERROR_ARGUMENT, "point %zu: coordinate %zu is %g", k / 3,
                                k % 3, points[k]);
    if (status == NURBS_OK)
        status = fit_matrix_create(degree, size, knots, n, u, &fit);
    if (status != NURBS_OK)
        return status;
    double *control = malloc(3 * size * sizeof *control);
    if (control) {
        fit_matrix_solve(&fit, 3, points, control);
        status = nurbs_curve_create(degree, size, knots, control, NULL, curve);
    } else {
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu control points", size);
    }
    free(control);
    fit_matrix_free(&fit);
    return status;
}

/* Turns [a][b][3] into [b][a][3]. */
static void turn(size_t a, size_t b, const double *from, double *to)
{
    for (size_t i = 0; i < a; i++)
        for (size_t j = 0; j < b; j++)
            memcpy(to + 3 * (j * a + i), from + 3 * (i * b + j), 3 * sizeof *to);
}

static nurbs_status fit_both(const fit_matrix fit[2], const double *points, double *net)
{
    size_t rows = fit[0].samples, columns = fit[1].samples, nv = fit[1].size, nu = fit[0].size;
    double *turned = malloc(3 * (rows * columns + 2 * nv * rows + nu * nv) * sizeof *turned);
    if (!turned)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu points", rows, columns);
    double *across = turned + 3 * rows * columns, *back = across + 3 * nv * rows;
    turn(rows, columns, points, turned);
    fit_matrix_solve(&fit[1], 3 * rows, turned, across);
    turn(nv, rows, across, back);
    fit_matrix_solve(&fit[0], 3 * nv, back, net);
    free(turned);
    return NURBS_OK;
}

nurbs_status nurbs_surface_fit(const int degree[2], const size_t size[2], const double *knots_u,
                               const double *knots_v, const nurbs_grid *grid, const double *u,
                               const double *v, nurbs_surface **surface)
{
    NURBS_NEED(degree && size && knots_u && knots_v && grid && u && v && surface);
    const double *const knots[2] = {knots_u, knots_v}, *const parameters[2] = {u, v};
    const size_t n[2] = {nurbs_grid_rows(grid), nurbs_grid_columns(grid)};
    fit_matrix fit[2] = {{0}, {0}};
    nurbs_status status = NURBS_OK;
    *surface = NULL;
    for (int d = 0; d < 2 && status == NURBS_OK; d++) {
        status = check_fit_request(degree[d], size[d], knots[d], n[d], parameters[d]);
        if (status == NURBS_OK)
            status = fit_matrix_create(degree[d], size[d], knots[d], n[d], parameters[d], &fit[d]);
    }
    double *net = status == NURBS_OK ? malloc(3 * size[0] * size[1] * sizeof *net) : NULL;
    if (status == NURBS_OK && !net)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu control points", size[0],
                            size[1]);
    if (status == NURBS_OK)
        status = fit_both(fit, nurbs_grid_points(grid), net);
    if (status == NURBS_OK)
        status = nurbs_surface_create(degree, size, knots_u, knots_v, net, NULL, surface);
    free(net);
    fit_matrix_free(&fit[0]);
    fit_matrix_free(&fit[1]);
    return status;
}
