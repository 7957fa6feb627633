/* y >= 0 of a half hull, proved by Bernstein coefficients: a cell of the surface whose coefficients
 * are not negative lies on the side; others are divided until a corner, which is a point of the
 * surface, is negative or the depth is reached. */
#include "section/sides.h"

#include "core/band.h"
#include "core/error.h"

#include <nurbs/basis.h>
#include <nurbs/section.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEPTH = 6, SWEEPS = 200, MAX_ORDER = NURBS_MAX_DEGREE + 1 };

/* Bezier extraction of the non-empty spans of a direction: coefficient k of a span is the sum of
 * weights[span][k][a] times control point first[span] + a. */
typedef struct extraction {
    size_t spans, order;
    size_t *first;
    double *low, *high; /* ends of the spans */
    double *weights;
} extraction;

static void extraction_free(extraction *spans)
{
    free(spans->first);
    free(spans->low);
}

static nurbs_status extract(int degree, size_t n, const double *knots, extraction *spans)
{
    size_t order = (size_t)degree + 1;
    *spans = (extraction){.order = order,
                          .first = malloc(n * sizeof(size_t)),
                          .low = malloc(n * (2 + order * order) * sizeof(double))};
    if (!spans->first || !spans->low)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu spans", n);
    spans->high = spans->low + n;
    spans->weights = spans->high + n;
    for (size_t k = order - 1; k < n; k++) {
        if (!(knots[k + 1] > knots[k]))
            continue;
        size_t s = spans->spans++;
        spans->first[s] = k + 1 - order;
        spans->low[s] = knots[k];
        spans->high[s] = knots[k + 1];
        for (size_t c = 0; c < order; c++) {
            double args[MAX_ORDER];
            for (size_t a = 0; a + 1 < order; a++)
                args[a] = a + c + 1 < order ? knots[k] : knots[k + 1];
            blossom(degree, knots, k, args, spans->weights + (s * order + c) * order);
        }
    }
    return NURBS_OK;
}

/* The lowest point found in a cell, and where in the unit square. */
typedef struct lowest {
    double value, at[2];
} lowest;

/* Divides a Bezier net of p x q coefficients in the middle of direction d: low gets the first half.
 */
static void divide(const size_t order[2], int d, double *net, double *low)
{
    size_t count = order[!d], length = order[d], step = d ? 1 : order[1], across = d ? order[1] : 1;
    for (size_t line = 0; line < count; line++) {
        double *b = net + line * across, *a = low + line * across;
        for (size_t k = 0; k < length; k++) {
            a[k * step] = b[0];
            for (size_t i = 0; i + k + 1 < length; i++)
                b[i * step] = 0.5 * (b[i * step] + b[(i + 1) * step]);
        }
    }
}

static int any_negative(const double *net, size_t n, double slack)
{
    for (size_t k = 0; k < n; k++)
        if (net[k] < -slack)
            return 1;
    return 0;
}

static void search(const size_t order[2], const double *net, const double corner[2], double size,
                   int depth, double slack, lowest *found)
{
    size_t n = order[0] * order[1];
    if (!any_negative(net, n, slack))
        return;
    for (int k = 0; k < 4; k++) {
        size_t i = k & 1 ? order[0] - 1 : 0, j = k & 2 ? order[1] - 1 : 0;
        if (net[i * order[1] + j] < found->value)
            *found = (lowest){net[i * order[1] + j],
                              {corner[0] + (k & 1 ? size : 0), corner[1] + (k & 2 ? size : 0)}};
    }
    if (depth == 0)
        return;
    double parts[4][MAX_ORDER * MAX_ORDER];
    memcpy(parts[2], net, n * sizeof *net);
    divide(order, 0, parts[2], parts[0]);
    memcpy(parts[1], parts[0], n * sizeof *net);
    divide(order, 1, parts[1], parts[0]);
    memcpy(parts[3], parts[2], n * sizeof *net);
    divide(order, 1, parts[3], parts[2]);
    for (int k = 0; k < 4; k++) {
        const double from[2] = {corner[0] + (k & 2 ? 0.5 * size : 0),
                                corner[1] + (k & 1 ? 0.5 * size : 0)};
        search(order, parts[k], from, 0.5 * size, depth - 1, slack, found);
    }
}

/* Coefficients of y over the cell of spans a and b; whether its control points allow y < 0. */
static int cell_net(const extraction along[2], size_t a, size_t b, size_t nv, const double *points,
                    double *net)
{
    size_t p = along[0].order, q = along[1].order;
    const double *y = points + 3 * (along[0].first[a] * nv + along[1].first[b]) + 1;
    const double *u = along[0].weights + a * p * p, *v = along[1].weights + b * q * q;
    double half[MAX_ORDER * MAX_ORDER];
    int negative = 0;
    for (size_t i = 0; i < p; i++)
        for (size_t j = 0; j < q; j++)
            negative |= y[3 * (i * nv + j)] < 0;
    for (size_t i = 0; i < p && negative; i++)
        for (size_t l = 0; l < q; l++) {
            half[i * q + l] = 0;
            for (size_t j = 0; j < q; j++)
                half[i * q + l] += v[l * q + j] * y[3 * (i * nv + j)];
        }
    for (size_t k = 0; k < p && negative; k++)
        for (size_t l = 0; l < q; l++) {
            net[k * q + l] = 0;
            for (size_t i = 0; i < p; i++)
                net[k * q + l] += u[k * p + i] * half[i * q + l];
        }
    return negative;
}

/* Control points that may move: not those of edges that lie in y = 0. */
static int is_free(const size_t size[2], const unsigned char fixed[4], size_t i, size_t j)
{
    return !((i == 0 && fixed[0]) || (i + 1 == size[0] && fixed[1]) || (j == 0 && fixed[2]) ||
             (j + 1 == size[1] && fixed[3]));
}

static void find_fixed(const size_t size[2], const double *points, unsigned char fixed[4])
{
    memset(fixed, 1, 4);
    for (size_t i = 0; i < size[0]; i++) {
        fixed[2] &= points[3 * i * size[1] + 1] == 0;
        fixed[3] &= points[3 * (i * size[1] + size[1] - 1) + 1] == 0;
    }
    for (size_t j = 0; j < size[1]; j++) {
        fixed[0] &= points[3 * j + 1] == 0;
        fixed[1] &= points[3 * ((size[0] - 1) * size[1] + j) + 1] == 0;
    }
}

/* The smallest change of free control points, in the sense of least squares, that lifts the place
 * (u,v) of cell a, b by `lift`. */
static void lift_place(const int degree[2], const size_t size[2], const double *const knots[2],
                       const extraction along[2], const size_t cell[2], const double at[2],
                       const unsigned char fixed[4], double lift, double *points)
{
    double basis[2][MAX_ORDER], sum = 0;
    size_t first[2];
    for (int d = 0; d < 2; d++) {
        double low = along[d].low[cell[d]], high = along[d].high[cell[d]];
        first[d] = along[d].first[cell[d]];
        nurbs_basis(degree[d], knots[d], first[d] + (size_t)degree[d], low + at[d] * (high - low),
                    basis[d]);
    }
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < along[0].order; i++)
            for (size_t j = 0; j < along[1].order; j++) {
                double weight = basis[0][i] * basis[1][j];
                if (!is_free(size, fixed, first[0] + i, first[1] + j))
                    continue;
                if (pass == 0)
                    sum += weight * weight;
                else if (sum > 0)
                    points[3 * ((first[0] + i) * size[1] + first[1] + j) + 1] +=
                        lift * weight / sum;
            }
}

/* One pass over all cells; returns the number of places lifted. */
static size_t sweep(const int degree[2], const size_t size[2], const double *const knots[2],
                    const extraction along[2], const unsigned char fixed[4], double slack,
                    double *points)
{
    const size_t order[2] = {along[0].order, along[1].order};
    double net[MAX_ORDER * MAX_ORDER];
    size_t lifted = 0;
    for (size_t a = 0; a < along[0].spans; a++)
        for (size_t b = 0; b < along[1].spans; b++) {
            lowest found = {-slack, {0, 0}};
            if (cell_net(along, a, b, size[1], points, net))
                search(order, net, (const double[]){0, 0}, 1, DEPTH, slack, &found);
            if (found.value >= -slack)
                continue;
            lift_place(degree, size, knots, along, (const size_t[]){a, b}, found.at, fixed,
                       slack - 1.05 * found.value, points);
            lifted++;
        }
    return lifted;
}

nurbs_status raise_to_side(const int degree[2], const size_t size[2], const double *knots_u,
                           const double *knots_v, double *points, double *moved)
{
    const double *const knots[2] = {knots_u, knots_v};
    size_t n = size[0] * size[1];
    extraction along[2] = {{0}, {0}};
    unsigned char fixed[4];
    double reach = 0, *before = malloc(n * sizeof *before);
    *moved = 0;
    nurbs_status status =
        before ? NURBS_OK : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", n);
    for (int d = 0; d < 2 && status == NURBS_OK; d++)
        status = extract(degree[d], size[d], knots[d], &along[d]);
    for (size_t k = 0; k < n && status == NURBS_OK; k++) {
        before[k] = points[3 * k + 1];
        reach = fmax(reach, fabs(before[k]));
    }
    find_fixed(size, points, fixed);
    size_t lifted = status == NURBS_OK;
    for (int k = 0; k < SWEEPS && lifted; k++)
        lifted = sweep(degree, size, knots, along, fixed, 1e-12 * reach, points);
    /* What resists lifting is brought to the side by the control points themselves. */
    for (size_t k = 0; k < n && lifted; k++)
        points[3 * k + 1] = fmax(points[3 * k + 1], 0);
    for (size_t k = 0; k < n && status == NURBS_OK; k++)
        *moved = fmax(*moved, fabs(points[3 * k + 1] - before[k]));
    extraction_free(&along[0]);
    extraction_free(&along[1]);
    free(before);
    return status;
}

nurbs_status nurbs_surface_raise_side(const nurbs_surface *surface, nurbs_surface **result,
                                      double *moved)
{
    NURBS_NEED(surface && result);
    *result = NULL;
    const int degree[2] = {nurbs_surface_degree(surface, 0), nurbs_surface_degree(surface, 1)};
    const size_t size[2] = {nurbs_surface_size(surface, 0), nurbs_surface_size(surface, 1)};
    if (nurbs_surface_weights(surface))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "a rational surface cannot be raised to y >= 0");
    double *points = malloc(3 * size[0] * size[1] * sizeof *points), most = 0;
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu points", size[0], size[1]);
    memcpy(points, nurbs_surface_points(surface), 3 * size[0] * size[1] * sizeof *points);
    const double *u = nurbs_surface_knots(surface, 0), *v = nurbs_surface_knots(surface, 1);
    nurbs_status status = raise_to_side(degree, size, u, v, points, &most);
    if (status == NURBS_OK)
        status = nurbs_surface_create(degree, size, u, v, points, NULL, result);
    if (moved)
        *moved = most;
    free(points);
    return status;
}
