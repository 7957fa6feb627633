#include "core/quadratic.h"

#include "core/error.h"
#include "core/matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_POINTS = 300 };
/* Of how values differ: what a quadratic that foretells them may miss. */
static const double share_foretold = 0.01;

struct near {
    double distance;
    size_t row;
};

static int nearer(const void *a, const void *b)
{
    const struct near *x = a, *y = b;
    if (x->distance != y->distance)
        return x->distance < y->distance ? -1 : 1;
    return x->row < y->row ? -1 : x->row > y->row;
}

/* Smaller pivots over the largest entry are rounding errors of a singular matrix; points too close
 * to each other have at least the other number, so that a repeated point is no such matrix. */
static const double singular = 1e-14, apart = 1e-12;

/* With H = sum lambda_i s_i s_i' the conditions of least |H|^2 are (s_i's_j)^2/2 lambda + c + g's_i
 * = y_i, sum lambda = 0, sum lambda s = 0. Steps s are in units of the farthest point used. Fills
 * (lambda, c, g) [n], n = m + d + 1; a [n x n] is scratch. */
static bayesopt_status solve_conditions(size_t d, size_t m, const double *s, const double *y,
                                        double *a, double *solution, bool *ok)
{
    size_t n = m + d + 1;
    memset(a, 0, n * n * sizeof *a);
    memset(solution, 0, n * sizeof *solution);
    for (size_t i = 0; i < m; i++) {
        for (size_t k = 0; k <= i; k++) {
            double dot = 0;
            for (size_t j = 0; j < d; j++)
                dot += s[i * d + j] * s[k * d + j];
            a[i * n + k] = a[k * n + i] = 0.5 * dot * dot;
        }
        a[i * n + i] += apart;
        a[i * n + m] = a[m * n + i] = 1;
        for (size_t j = 0; j < d; j++)
            a[i * n + m + 1 + j] = a[(m + 1 + j) * n + i] = s[i * d + j];
        solution[i] = y[i];
    }
    return matrix_solve(n, a, solution, singular, ok);
}

/* Points by their distance. */
static void sort(size_t d, size_t n, const double *x, const double *centre, struct near *order)
{
    for (size_t i = 0; i < n; i++) {
        order[i] = (struct near){0, i};
        for (size_t j = 0; j < d; j++)
            order[i].distance = fmax(order[i].distance, fabs(x[i * d + j] - centre[j]));
    }
    qsort(order, n, sizeof *order, nearer);
}

static bayesopt_status no_memory(size_t n)
{
    return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "no memory for a quadratic of %zu points", n);
}

bayesopt_status quadratic_fit(struct quadratic *q, size_t d, size_t n, const double *x,
                              const double *y, const double *centre, bool *fitted)
{
    size_t m = (d + 1) * (d + 2) / 2;
    m = m < MOST_POINTS ? m : MOST_POINTS;
    m = m < n ? m : n;
    *q = (struct quadratic){.d = d};
    size_t unknowns = m + d + 1;
    q->centre = malloc((2 * d + d * d) * sizeof(double));
    struct near *order = malloc((n ? n : 1) * sizeof *order);
    double *s = malloc((m * (d + 1) + unknowns * (unknowns + 1)) * sizeof *s), unit = 0;
    bayesopt_status status = q->centre && order && s ? BAYESOPT_OK : no_memory(n);
    bool ok = !status && n > d;
    if (ok) {
        q->gradient = q->centre + d;
        q->hessian = q->gradient + d;
        sort(d, n, x, centre, order);
        unit = order[m - 1].distance;
        ok = unit > 0;
    }
    double *values = s + m * d, *solution = values + m;
    for (size_t i = 0; i < m && ok; i++) {
        for (size_t j = 0; j < d; j++)
            s[i * d + j] = (x[order[i].row * d + j] - centre[j]) / unit;
        values[i] = y[order[i].row];
    }
    if (ok)
        status = solve_conditions(d, m, s, values, solution + unknowns, solution, &ok);
    if (ok) {
        memcpy(q->centre, centre, d * sizeof *centre);
        memset(q->hessian, 0, d * d * sizeof *q->hessian);
        q->constant = solution[m];
        for (size_t j = 0; j < d; j++)
            q->gradient[j] = solution[m + 1 + j] / unit;
        for (size_t i = 0; i < m; i++) {
            double lambda = solution[i] / (unit * unit);
            for (size_t j = 0; j < d; j++)
                for (size_t k = 0; k < d; k++)
                    q->hessian[j * d + k] += lambda * s[i * d + j] * s[i * d + k];
        }
        ok = isfinite(q->constant);
        for (size_t j = 0; j < d + d * d; j++)
            ok = ok && isfinite(q->gradient[j]);
    }
    free(order);
    free(s);
    *fitted = ok;
    return status;
}

bayesopt_status quadratic_foretells(size_t d, size_t n, const double *x, const double *y,
                                    const double *centre, double *reach, bool *foretells)
{
    *foretells = false;
    size_t m = (d + 1) * (d + 2) / 2, others = d + 1;
    if (m > MOST_POINTS || n < m + others)
        return BAYESOPT_OK;
    struct quadratic q = {0};
    struct near *order = malloc(n * sizeof *order);
    double *near_x = malloc(m * (d + 1) * sizeof *near_x), mean = 0, spread = 0, square = 0;
    bayesopt_status status = order && near_x ? BAYESOPT_OK : no_memory(n);
    bool ok = !status;
    if (ok)
        sort(d, n, x, centre, order);
    for (size_t i = 0; i < m && ok; i++) {
        memcpy(near_x + i * d, x + order[i].row * d, d * sizeof *near_x);
        near_x[m * d + i] = y[order[i].row];
    }
    if (ok)
        status = quadratic_fit(&q, d, m, near_x, near_x + m * d, centre, &ok);
    for (size_t i = m; i < m + others && ok; i++)
        mean += y[order[i].row] / (double)others;
    for (size_t i = m; i < m + others && ok; i++) {
        double value = y[order[i].row],
               error = value - quadratic_value(&q, x + order[i].row * d, NULL);
        square += error * error;
        spread += (value - mean) * (value - mean);
    }
    if (ok)
        *reach = order[m + others - 1].distance;
    quadratic_free(&q);
    free(near_x);
    free(order);
    *foretells = ok && square < share_foretold * share_foretold * spread;
    return status;
}

void quadratic_free(struct quadratic *q)
{
    free(q->centre);
    *q = (struct quadratic){0};
}

double quadratic_value(const struct quadratic *q, const double *x, double *gradient)
{
    double value = q->constant;
    for (size_t j = 0; j < q->d; j++) {
        double curved = 0;
        for (size_t k = 0; k < q->d; k++)
            curved += q->hessian[j * q->d + k] * (x[k] - q->centre[k]);
        value += (q->gradient[j] + 0.5 * curved) * (x[j] - q->centre[j]);
        if (gradient)
            gradient[j] = q->gradient[j] + curved;
    }
    return value;
}
