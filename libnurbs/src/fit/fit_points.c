/* Scattered points: sparse normal equations with a thin-plate term. */
#include "core/error.h"

#include <nurbs/basis.h>
#include <nurbs/fit.h>

#include <cs.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct normal_equations {
    const int *degree;
    const size_t *size;
    const double *knots[2];
    cs_di *triplets; /* lower triangle is enough, but both are summed */
    double *rhs;     /* [3][unknowns] */
} normal_equations;

/* Derivative orders (a,b) of the tensor basis at (u,v) for the functions of the spans. */
static void tensor_row(const normal_equations *system, double u, double v, int order_u, int order_v,
                       size_t span[2], double *row)
{
    const int p = system->degree[0], q = system->degree[1];
    double bu[3 * (NURBS_MAX_DEGREE + 1)], bv[3 * (NURBS_MAX_DEGREE + 1)];
    span[0] = nurbs_basis_span(p, system->size[0], system->knots[0], u, NULL);
    span[1] = nurbs_basis_span(q, system->size[1], system->knots[1], v, NULL);
    nurbs_basis_derivatives(p, system->knots[0], span[0], u, order_u, bu);
    nurbs_basis_derivatives(q, system->knots[1], span[1], v, order_v, bv);
    for (int a = 0; a <= p; a++)
        for (int b = 0; b <= q; b++)
            row[a * (q + 1) + b] = bu[order_u * (p + 1) + a] * bv[order_v * (q + 1) + b];
}

/* Adds weight * row row' to the matrix. */
static int add_product(normal_equations *system, const size_t span[2], const double *row,
                       double weight)
{
    const int p = system->degree[0], q = system->degree[1], n = (p + 1) * (q + 1);
    int columns[(NURBS_MAX_DEGREE + 1) * (NURBS_MAX_DEGREE + 1)], good = 1;
    for (int k = 0; k < n; k++)
        columns[k] = (int)((span[0] - (size_t)p + (size_t)(k / (q + 1))) * system->size[1] +
                           span[1] - (size_t)q + (size_t)(k % (q + 1)));
    for (int a = 0; a < n && good; a++)
        for (int b = 0; b < n && good; b++)
            good = cs_di_entry(system->triplets, columns[a], columns[b], weight * row[a] * row[b]);
    return good;
}

static nurbs_status add_points(normal_equations *system, size_t n, const double *points,
                               const double *uv)
{
    const int p = system->degree[0], q = system->degree[1];
    size_t unknowns = system->size[0] * system->size[1], span[2];
    double row[(NURBS_MAX_DEGREE + 1) * (NURBS_MAX_DEGREE + 1)], weight = 1 / (double)n;
    for (size_t k = 0; k < n; k++) {
        tensor_row(system, uv[2 * k], uv[2 * k + 1], 0, 0, span, row);
        if (!add_product(system, span, row, weight))
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu normal equations", unknowns);
        for (int a = 0; a < (p + 1) * (q + 1); a++) {
            size_t at = (span[0] - (size_t)p + (size_t)(a / (q + 1))) * system->size[1] + span[1] -
                        (size_t)q + (size_t)(a % (q + 1));
            for (size_t c = 0; c < 3; c++)
                system->rhs[c * unknowns + at] += weight * row[a] * points[3 * k + c];
        }
    }
    return NURBS_OK;
}

/* smoothing * (|Suu|^2 + 2 |Suv|^2 + |Svv|^2) at one quadrature point. */
static int add_bending(normal_equations *system, double u, double v, double weight)
{
    static const int orders[3][2] = {{2, 0}, {1, 1}, {0, 2}};
    double row[(NURBS_MAX_DEGREE + 1) * (NURBS_MAX_DEGREE + 1)];
    size_t span[2];
    int good = 1;
    for (int k = 0; k < 3 && good; k++) {
        tensor_row(system, u, v, orders[k][0], orders[k][1], span, row);
        good = add_product(system, span, row, k == 1 ? 2 * weight : weight);
    }
    return good;
}

static nurbs_status add_smoothing(normal_equations *system, double smoothing)
{
    const size_t rule =
        (size_t)(system->degree[0] > system->degree[1] ? system->degree[0] : system->degree[1]) + 1;
    const double *const *t = system->knots;
    double nodes[NURBS_MAX_DEGREE + 1], weights[NURBS_MAX_DEGREE + 1];
    nurbs_status status = nurbs_gauss_legendre(rule, nodes, weights);
    for (size_t i = (size_t)system->degree[0]; i < system->size[0]; i++)
        for (size_t j = (size_t)system->degree[1]; j < system->size[1]; j++) {
            double du = t[0][i + 1] - t[0][i], dv = t[1][j + 1] - t[1][j];
            for (size_t k = 0; k < rule * rule && du * dv > 0 && status == NURBS_OK; k++)
                if (!add_bending(system, t[0][i] + du * nodes[k / rule],
                                 t[1][j] + dv * nodes[k % rule],
                                 smoothing * du * dv * weights[k / rule] * weights[k % rule]))
                    status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for normal equations");
        }
    return status;
}

/* Cholesky factors once, three right-hand sides; pivots that vanish against the diagonal mean that
 * some control point is not determined. */
static nurbs_status solve(const normal_equations *system)
{
    int n = (int)(system->size[0] * system->size[1]), good = 0;
    cs_di *matrix = cs_di_compress(system->triplets);
    double *x = malloc((size_t)n * sizeof *x), largest = 0;
    if (matrix)
        cs_di_dupl(matrix);
    cs_dis *order = matrix ? cs_di_schol(1, matrix) : NULL;
    cs_din *factors = order ? cs_di_chol(matrix, order) : NULL;
    if (factors && x) {
        good = 1;
        for (int k = 0; k < n; k++)
            largest = fmax(largest, factors->L->x[factors->L->p[k]]);
        for (int k = 0; k < n; k++)
            good = good && factors->L->x[factors->L->p[k]] > 1e-7 * largest;
        for (size_t c = 0; c < 3 && good; c++) {
            double *b = system->rhs + c * (size_t)n;
            cs_di_ipvec(order->pinv, b, x, n);
            cs_di_lsolve(factors->L, x);
            cs_di_ltsolve(factors->L, x);
            cs_di_pvec(order->pinv, x, b, n);
        }
    }
    int memory = matrix && order && x;
    cs_di_nfree(factors);
    cs_di_sfree(order);
    cs_di_spfree(matrix);
    free(x);
    if (!memory)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %d normal equations", n);
    return good ? NURBS_OK
                : nurbs_fail(NURBS_ERROR_NUMERIC,
                             "the points do not determine the %d control points: add smoothing", n);
}

static nurbs_status check_points(const int degree[2], const size_t size[2],
                                 const double *const knots[2], size_t n, const double *points,
                                 const double *uv, double smoothing)
{
    nurbs_status status = nurbs_knots_check(degree[0], size[0], knots[0]);
    if (status == NURBS_OK)
        status = nurbs_knots_check(degree[1], size[1], knots[1]);
    if (status != NURBS_OK)
        return status;
    if (n == 0 || size[0] * size[1] > 10000000)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%zu points for %zu x %zu control points", n,
                          size[0], size[1]);
    if (!(smoothing >= 0 && isfinite(smoothing)))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "smoothing %g, expected >= 0", smoothing);
    for (size_t k = 0; k < n; k++) {
        for (size_t c = 0; c < 3; c++)
            if (!isfinite(points[3 * k + c]))
                return nurbs_fail(NURBS_ERROR_ARGUMENT, "point %zu: coordinate %zu is %g", k, c,
                                  points[3 * k + c]);
        for (size_t d = 0; d < 2; d++)
            if (!(uv[2 * k + d] >= knots[d][0] && uv[2 * k + d] <= knots[d][size[d]]))
                return nurbs_fail(NURBS_ERROR_ARGUMENT,
                                  "point %zu: parameter %c is %g, outside "
                                  "[%g, %g]",
                                  k, d ? 'v' : 'u', uv[2 * k + d], knots[d][0], knots[d][size[d]]);
    }
    return NURBS_OK;
}

nurbs_status nurbs_surface_fit_points(const int degree[2], const size_t size[2],
                                      const double *knots_u, const double *knots_v, size_t n,
                                      const double *points, const double *uv, double smoothing,
                                      nurbs_surface **surface)
{
    NURBS_NEED(degree && size && knots_u && knots_v && surface && (n == 0 || (points && uv)));
    normal_equations system = {degree, size, {knots_u, knots_v}, NULL, NULL};
    *surface = NULL;
    nurbs_status status = check_points(degree, size, system.knots, n, points, uv, smoothing);
    if (status != NURBS_OK)
        return status;
    size_t unknowns = size[0] * size[1];
    system.rhs = calloc(6 * unknowns, sizeof(double));
    system.triplets = cs_di_spalloc((int)unknowns, (int)unknowns, (int)(25 * unknowns), 1, 1);
    if (!system.rhs || !system.triplets)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu normal equations", unknowns);
    if (status == NURBS_OK)
        status = add_points(&system, n, points, uv);
    if (status == NURBS_OK && smoothing > 0)
        status = add_smoothing(&system, smoothing);
    /* A control point without any entry still needs its place on the diagonal. */
    for (size_t k = 0; k < unknowns && status == NURBS_OK; k++)
        if (!cs_di_entry(system.triplets, (int)k, (int)k, 0))
            status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for normal equations");
    if (status == NURBS_OK)
        status = solve(&system);
    if (status == NURBS_OK) {
        double *net = system.rhs + 3 * unknowns;
        for (size_t k = 0; k < unknowns; k++)
            for (size_t c = 0; c < 3; c++)
                net[3 * k + c] = system.rhs[c * unknowns + k];
        status = nurbs_surface_create(degree, size, knots_u, knots_v, net, NULL, surface);
    }
    cs_di_spfree(system.triplets);
    free(system.rhs);
    return status;
}
