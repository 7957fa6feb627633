#include "fit/interpolate.h"

#include "core/error.h"

#include <nurbs/basis.h>
#include <nurbs/fit.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void clamp_ends(int degree, size_t n, double first, double last, double *knots)
{
    for (size_t k = 0; k <= (size_t)degree; k++) {
        knots[k] = first;
        knots[n + k] = last;
    }
}

void interpolation_knots(int degree, size_t n, const double *sites, double *knots)
{
    size_t p = (size_t)degree;
    clamp_ends(degree, n, sites[0], sites[n - 1], knots);
    for (size_t k = 0; k < n - p - 1; k++)
        knots[p + 1 + k] =
            degree % 2 ? sites[k + (p + 1) / 2] : 0.5 * (sites[k + p / 2] + sites[k + p / 2 + 1]);
}

void averaged_knots(int degree, size_t n, const double *sites, double *knots)
{
    size_t p = (size_t)degree;
    clamp_ends(degree, n, sites[0], sites[n - 1], knots);
    for (size_t k = 1; k + p < n; k++) {
        double sum = 0;
        for (size_t i = 0; i < p; i++)
            sum += sites[k + i];
        knots[p + k] = sum / (double)p;
    }
}

nurbs_status collocation_factor(int degree, size_t n, const double *knots, const double *sites,
                                banded *factors)
{
    size_t p = (size_t)degree, lower = 0, upper = 0, hint = 0;
    for (size_t i = 0; i < n; i++) {
        size_t first = nurbs_basis_span(degree, n, knots, sites[i], &hint) - p;
        if (i > first + lower)
            lower = i - first;
        if (first + p > i + upper)
            upper = first + p - i;
    }
    nurbs_status status = banded_create(n, lower, upper, factors);
    if (status != NURBS_OK)
        return status;
    for (size_t i = 0; i < n; i++) {
        double values[NURBS_MAX_DEGREE + 1];
        size_t span = nurbs_basis_span(degree, n, knots, sites[i], &hint);
        nurbs_basis(degree, knots, span, sites[i], values);
        for (size_t k = 0; k <= p; k++)
            *banded_entry(factors, i, span - p + k) = values[k];
    }
    status = banded_factor(factors);
    if (status != NURBS_OK)
        banded_free(factors);
    return status;
}

void spline_insert_rows(int degree, size_t *n, double *knots, size_t m, double *rows, double u)
{
    size_t p = (size_t)degree, span = p;
    while (span + 1 < *n && knots[span + 1] <= u)
        span++;
    memmove(rows + (span + 1) * m, rows + span * m, (*n - span) * m * sizeof *rows);
    for (size_t i = span; i + p > span; i--) {
        double alpha = (u - knots[i]) / (knots[i + p] - knots[i]);
        for (size_t c = 0; c < m; c++)
            rows[i * m + c] = (1 - alpha) * rows[(i - 1) * m + c] + alpha * rows[i * m + c];
        if (i == 1)
            break;
    }
    memmove(knots + span + 2, knots + span + 1, (*n + p - span) * sizeof *knots);
    knots[span + 1] = u;
    ++*n;
}

/* A piece of an axis between two active kinks (or ends), sites first ... last. */
typedef struct piece {
    size_t first, last;
} piece;

static size_t split_pieces(const kinked_axis *axis, const unsigned char *active, piece *pieces)
{
    size_t count = 0, first = 0;
    for (size_t k = 0; k < axis->kinks; k++)
        if (!active || active[k]) {
            pieces[count++] = (piece){first, axis->kink[k]};
            first = axis->kink[k];
        }
    pieces[count++] = (piece){first, axis->sites - 1};
    return count;
}

static size_t piece_size(const kinked_axis *axis, piece part)
{
    size_t points = part.last - part.first + 1, least = (size_t)axis->degree + 1;
    return points > least ? points : least;
}

/* Knots of the spline that is C^0 at the active kinks (all of them when active is NULL). */
static size_t piecewise_knots(const kinked_axis *axis, const piece *pieces, size_t count,
                              double *knots)
{
    size_t p = (size_t)axis->degree, size = 1;
    double *at = knots;
    *at++ = axis->u[0];
    for (size_t k = 0; k < count; k++) {
        const double *u = axis->u + pieces[k].first;
        size_t points = pieces[k].last - pieces[k].first + 1;
        for (size_t i = 0; i < p; i++)
            *at++ = u[0];
        for (size_t i = 0; i + p + 1 < points; i++)
            *at++ = p % 2 ? u[i + (p + 1) / 2] : 0.5 * (u[i + p / 2] + u[i + p / 2 + 1]);
        size += piece_size(axis, pieces[k]) - 1;
    }
    for (size_t i = 0; i <= p; i++)
        *at++ = axis->u[axis->sites - 1];
    return size;
}

/* Value at u of the polynomial through rows first ... last. */
static void lagrange(const kinked_axis *axis, piece part, double u, size_t m, const double *data,
                     double *value)
{
    memset(value, 0, m * sizeof *value);
    for (size_t i = part.first; i <= part.last; i++) {
        double weight = 1;
        for (size_t j = part.first; j <= part.last; j++)
            if (j != i)
                weight *= (u - axis->u[j]) / (axis->u[i] - axis->u[j]);
        for (size_t c = 0; c < m; c++)
            value[c] += weight * data[i * m + c];
    }
}

/* Sites and values of one piece but its first site; a piece with fewer points than degree + 1 gets
 * more of them, on the polynomial through its own. */
static size_t fill_piece(const kinked_axis *axis, piece part, size_t m, const double *data,
                         double *sites, double *values)
{
    size_t points = part.last - part.first + 1, size = piece_size(axis, part);
    if (points == size) {
        memcpy(sites, axis->u + part.first + 1, (size - 1) * sizeof *sites);
        memcpy(values, data + (part.first + 1) * m, (size - 1) * m * sizeof *values);
        return size - 1;
    }
    double a = axis->u[part.first], b = axis->u[part.last];
    for (size_t k = 1; k < size; k++) {
        sites[k - 1] = a + (b - a) * (double)k / (double)(size - 1);
        lagrange(axis, part, sites[k - 1], m, data, values + (k - 1) * m);
    }
    sites[size - 2] = b;
    memcpy(values + (size - 2) * m, data + part.last * m, m * sizeof *values);
    return size - 1;
}

nurbs_status kinked_axis_create(int degree, size_t n, const double *u, size_t kinks,
                                const size_t *kink, kinked_axis *axis)
{
    size_t p = (size_t)degree, room = n + (kinks + 1) * (2 * p + 2);
    *axis = (kinked_axis){degree, n, kinks, u, kink, 0, malloc(room * sizeof(double))};
    double *smooth = malloc((n + p + 1) * sizeof *smooth);
    double *broken = malloc(room * sizeof *broken);
    piece *pieces = malloc((kinks + 1) * sizeof *pieces);
    nurbs_status status = NURBS_OK;
    if (axis->knots && smooth && broken && pieces) {
        interpolation_knots(degree, n, u, smooth);
        size_t count = split_pieces(axis, NULL, pieces);
        size_t nb = piecewise_knots(axis, pieces, count, broken) + p + 1, ns = n + p + 1, i = 0,
               j = 0, size = 0;
        while (i < ns || j < nb) {
            double next = j == nb || (i < ns && smooth[i] <= broken[j]) ? smooth[i] : broken[j];
            i += i < ns && smooth[i] == next;
            j += j < nb && broken[j] == next;
            axis->knots[size++] = next;
        }
        axis->size = size - p - 1;
    } else {
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the knots of %zu sites", n);
        kinked_axis_free(axis);
    }
    free(smooth);
    free(broken);
    free(pieces);
    return status;
}

void kinked_axis_free(kinked_axis *axis)
{
    free(axis->knots);
    axis->knots = NULL;
}

/* Inserts what `knots` lacks against the axis' own vector; rows has room for axis->size rows. */
static void complete_knots(const kinked_axis *axis, size_t n, double *knots, size_t m, double *rows)
{
    size_t p = (size_t)axis->degree;
    for (size_t k = 0; k < axis->size + p + 1; k++)
        if (k >= n + p + 1 || knots[k] != axis->knots[k])
            spline_insert_rows(axis->degree, &n, knots, m, rows, axis->knots[k]);
}

nurbs_status kinked_axis_solve(const kinked_axis *axis, const unsigned char *active, size_t m,
                               const double *data, double *control)
{
    static const unsigned char none[1];
    size_t p = (size_t)axis->degree;
    piece *pieces = malloc((axis->kinks + 1) * sizeof *pieces);
    double *knots = malloc((2 * axis->size + p + 2) * sizeof *knots);
    if (!pieces || !knots) {
        free(pieces);
        free(knots);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to interpolate %zu sites", axis->sites);
    }
    double *sites = knots + axis->size + p + 1;
    size_t count = split_pieces(axis, axis->kinks ? active : none, pieces);
    size_t size = piecewise_knots(axis, pieces, count, knots), filled = 1;
    sites[0] = axis->u[0];
    memcpy(control, data, m * sizeof *control);
    for (size_t k = 0; k < count; k++)
        filled += fill_piece(axis, pieces[k], m, data, sites + filled, control + filled * m);
    banded factors;
    nurbs_status status = collocation_factor(axis->degree, size, knots, sites, &factors);
    if (status == NURBS_OK) {
        banded_solve(&factors, m, control);
        banded_free(&factors);
        complete_knots(axis, size, knots, m, control);
    }
    free(pieces);
    free(knots);
    return status;
}

/* [a][b][3] to [b][a][3]. */
static void turn(size_t a, size_t b, const double *from, double *to)
{
    for (size_t i = 0; i < a; i++)
        for (size_t j = 0; j < b; j++)
            memcpy(to + 3 * (j * a + i), from + 3 * (i * b + j), 3 * sizeof *to);
}

static nurbs_status check_sites(int degree, size_t n, const double *u, char direction)
{
    if (degree < 1 || degree > NURBS_MAX_DEGREE || n <= (size_t)degree)
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "direction %c: %zu points for degree %d, expected more points than the "
                          "degree and a degree from 1 to %d",
                          direction, n, degree, NURBS_MAX_DEGREE);
    for (size_t k = 0; k < n; k++)
        if (!isfinite(u[k]) || (k > 0 && !(u[k] > u[k - 1])))
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "direction %c: parameter %zu is %g: parameters must be finite and "
                              "increase",
                              direction, k, u[k]);
    return NURBS_OK;
}

/* Fills knots and solves rows[n][m] in place. */
static nurbs_status solve_direction(int degree, size_t n, const double *u, size_t m, double *knots,
                                    double *rows)
{
    banded factors;
    interpolation_knots(degree, n, u, knots);
    nurbs_status status = collocation_factor(degree, n, knots, u, &factors);
    if (status == NURBS_OK) {
        banded_solve(&factors, m, rows);
        banded_free(&factors);
    }
    return status;
}

nurbs_status nurbs_surface_interpolate(const int degree[2], const nurbs_grid *grid, const double *u,
                                       const double *v, nurbs_surface **surface)
{
    NURBS_NEED(degree && grid && u && v && surface);
    const size_t n[2] = {nurbs_grid_rows(grid), nurbs_grid_columns(grid)};
    const double *points = nurbs_grid_points(grid);
    *surface = NULL;
    nurbs_status status = check_sites(degree[0], n[0], u, 'u');
    if (status == NURBS_OK)
        status = check_sites(degree[1], n[1], v, 'v');
    if (status != NURBS_OK)
        return status;
    for (size_t k = 0; k < 3 * n[0] * n[1]; k++)
        if (!isfinite(points[k]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "grid point (%zu,%zu): coordinate %zu is %g",
                              k / 3 / n[1] + 1, k / 3 % n[1] + 1, k % 3, points[k]);
    const size_t count[2] = {n[0] + (size_t)degree[0] + 1, n[1] + (size_t)degree[1] + 1};
    double *net = malloc((6 * n[0] * n[1] + count[0] + count[1]) * sizeof *net);
    if (!net)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to interpolate %zu x %zu points", n[0],
                          n[1]);
    double *turned = net + 3 * n[0] * n[1], *knots_u = turned + 3 * n[0] * n[1],
           *knots_v = knots_u + count[0];
    turn(n[0], n[1], points, turned);
    status = solve_direction(degree[1], n[1], v, 3 * n[0], knots_v, turned);
    turn(n[1], n[0], turned, net);
    if (status == NURBS_OK)
        status = solve_direction(degree[0], n[0], u, 3 * n[1], knots_u, net);
    if (status == NURBS_OK)
        status = nurbs_surface_create(degree, n, knots_u, knots_v, net, NULL, surface);
    free(net);
    return status;
}

nurbs_status nurbs_curve_interpolate(int degree, size_t n, const double *points, const double *u,
                                     nurbs_curve **curve)
{
    NURBS_NEED(curve && (n == 0 || (points && u)));
    *curve = NULL;
    if (degree < 1 || degree > NURBS_MAX_DEGREE || n <= (size_t)degree)
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "%zu points for a curve of degree %d, expected more points than the "
                          "degree and a degree from 1 to %d",
                          n, degree, NURBS_MAX_DEGREE);
    for (size_t k = 0; k < n; k++)
        if (!isfinite(u[k]) || (k > 0 && !(u[k] > u[k - 1])))
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "parameter %zu is %g: parameters must be finite and increase", k,
                              u[k]);
    for (size_t k = 0; k < 3 * n; k++)
        if (!isfinite(points[k]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "point %zu: coordinate %zu is %g", k / 3, k % 3,
                              points[k]);
    double *knots = malloc((n + (size_t)degree + 1 + 3 * n) * sizeof *knots);
    if (!knots)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to interpolate %zu points", n);
    double *control = knots + n + (size_t)degree + 1;
    averaged_knots(degree, n, u, knots);
    memcpy(control, points, 3 * n * sizeof *control);
    banded factors;
    nurbs_status status = collocation_factor(degree, n, knots, u, &factors);
    if (status == NURBS_OK) {
        banded_solve(&factors, 3, control);
        banded_free(&factors);
        status = nurbs_curve_create(degree, n, knots, control, NULL, curve);
    }
    free(knots);
    return status;
}
