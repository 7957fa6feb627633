/* What is known before the first evaluation: box, constraints, counts, budget. */
#include "core/error.h"
#include "problem/internal.h"

#include <math.h>
#include <string.h>

bayesopt_status problem_check_points(const struct bayesopt *bo, size_t n, const double *x)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < bo->d; j++)
            if (!(x[i * bo->d + j] >= bo->lower[j] && x[i * bo->d + j] <= bo->upper[j]))
                return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                     "variable %zu of point %zu is %g, expected %g to %g", j, i,
                                     x[i * bo->d + j], bo->lower[j], bo->upper[j]);
    return problem_check_values(bo, n, x);
}

bayesopt_status problem_check_values(const struct bayesopt *bo, size_t n, const double *x)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < bo->d; j++) {
            double value = x[i * bo->d + j];
            bool category = bo->kind[j] == BAYESOPT_KIND_CATEGORICAL;
            bool whole = category || bo->kind[j] == BAYESOPT_KIND_INTEGER;
            const char *expected =
                !isfinite(value)                                             ? "a finite number"
                : whole && value != floor(value)                             ? "a whole number"
                : bo->kind[j] == BAYESOPT_KIND_LOG && value <= 0             ? "a positive number"
                : category && (value < bo->lower[j] || value > bo->upper[j]) ? "a category"
                                                                             : NULL;
            if (expected)
                return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                     "variable %zu of point %zu is %g, expected %s", j, i, value,
                                     expected);
        }
    return BAYESOPT_OK;
}

/* Points of the box are in [0,1]^d whatever rounding does; those outside of it are not. */
void problem_to_unit(const struct bayesopt *bo, const double *x, double *u)
{
    for (size_t j = 0; j < bo->d; j++) {
        double low = bo->lower[j], high = bo->upper[j];
        bool inside = x[j] >= low && x[j] <= high;
        if (low == high)
            u[j] = inside ? 0 : x[j] - low;
        else if (bo->kind[j] == BAYESOPT_KIND_LOG)
            u[j] = log(x[j] / low) / log(high / low);
        else
            u[j] = (x[j] - low) / (high - low);
        if (inside)
            u[j] = fmin(fmax(u[j], 0), 1);
    }
}

void problem_from_unit(const struct bayesopt *bo, const double *u, double *x)
{
    for (size_t j = 0; j < bo->d; j++) {
        double low = bo->lower[j], high = bo->upper[j];
        if (bo->kind[j] == BAYESOPT_KIND_LOG)
            x[j] = low * exp(u[j] * log(high / low));
        else
            x[j] = low + u[j] * (high - low);
        if (problem_is_discrete(bo, j))
            x[j] = round(x[j]);
        x[j] = low == high ? low : u[j] >= 1 ? high : u[j] <= 0 ? low : fmin(fmax(x[j], low), high);
    }
}

void problem_unit_slope(const struct bayesopt *bo, const double *x, double *slope)
{
    for (size_t j = 0; j < bo->d; j++)
        slope[j] = problem_is_discrete(bo, j)         ? 0
                   : bo->kind[j] == BAYESOPT_KIND_LOG ? x[j] * log(bo->upper[j] / bo->lower[j])
                                                      : bo->upper[j] - bo->lower[j];
}

bool problem_is_discrete(const struct bayesopt *bo, size_t j)
{
    return bo->kind[j] == BAYESOPT_KIND_INTEGER || bo->kind[j] == BAYESOPT_KIND_CATEGORICAL ||
           bo->lower[j] == bo->upper[j];
}

double problem_values(const struct bayesopt *bo, size_t j)
{
    return bo->lower[j] == bo->upper[j] ? 1 : bo->upper[j] - bo->lower[j] + 1;
}

double problem_value_unit(const struct bayesopt *bo, size_t j, double k)
{
    double span = bo->upper[j] - bo->lower[j];
    return span > 0 ? k / span : 0;
}

void problem_snap(const struct bayesopt *bo, double *u)
{
    for (size_t j = 0; j < bo->d && bo->n_discrete; j++)
        if (problem_is_discrete(bo, j))
            u[j] = problem_value_unit(bo, j, round(u[j] * (problem_values(bo, j) - 1)));
}

void problem_spread(const struct bayesopt *bo, double *u)
{
    for (size_t j = 0; j < bo->d && bo->n_discrete; j++)
        if (problem_is_discrete(bo, j)) {
            double values = problem_values(bo, j), k = floor(u[j] * values);
            u[j] = problem_value_unit(bo, j, fmin(k, values - 1));
        }
}

size_t problem_size(const struct bayesopt *bo)
{
    double size = bo->n_discrete == bo->d ? 1 : INFINITY;
    for (size_t j = 0; j < bo->d && size <= BAYESOPT_MOST_POINTS; j++)
        size *= problem_values(bo, j);
    return size <= BAYESOPT_MOST_POINTS ? (size_t)size : (size_t)BAYESOPT_MOST_POINTS + 1;
}

void problem_point(const struct bayesopt *bo, size_t i, double *u)
{
    for (size_t j = 0; j < bo->d; j++) {
        size_t values = (size_t)problem_values(bo, j);
        u[j] = problem_value_unit(bo, j, (double)(i % values));
        i /= values;
    }
}

bool problem_inside(const struct bayesopt *bo, const double *x)
{
    for (size_t j = 0; j < bo->d; j++)
        if (!(x[j] >= bo->lower[j] && x[j] <= bo->upper[j]))
            return false;
    return true;
}

double problem_sign(const struct bayesopt *bo)
{
    return bo->options.maximise ? -1 : 1;
}

size_t problem_budget(const struct bayesopt *bo)
{
    return bo->options.max_evaluations ? bo->options.max_evaluations : 2 * problem_initial(bo) + 10;
}

size_t problem_initial(const struct bayesopt *bo)
{
    size_t n = bo->options.initial_n;
    return bo->options.n_levels == 1 ? n : n + (n + 3) / 4;
}

size_t bayesopt_dimension(const bayesopt *bo, double *lower, double *upper)
{
    if (!bo)
        return 0;
    if (lower)
        memcpy(lower, bo->lower, bo->d * sizeof *lower);
    if (upper)
        memcpy(upper, bo->upper, bo->d * sizeof *upper);
    return bo->d;
}

bayesopt_kind bayesopt_variable_kind(const bayesopt *bo, size_t j)
{
    return bo && j < bo->d ? bo->kind[j] : BAYESOPT_KIND_REAL;
}

const char *bayesopt_variable_name(const bayesopt *bo, size_t j)
{
    return bo && j < bo->d ? bo->names[j] : "";
}

bool bayesopt_maximises(const bayesopt *bo)
{
    return bo && bo->options.maximise;
}

size_t bayesopt_constraint_count(const bayesopt *bo, double *lower, double *upper)
{
    size_t m = bo ? bo->options.n_constraints : 0;
    if (!m)
        return 0;
    if (lower)
        memcpy(lower, bo->constraint_lower, m * sizeof *lower);
    if (upper)
        memcpy(upper, bo->constraint_upper, m * sizeof *upper);
    return m;
}

size_t bayesopt_objective_count(const bayesopt *bo)
{
    return bo ? bo->options.n_objectives : 0;
}

size_t bayesopt_budget(const bayesopt *bo)
{
    return bo ? problem_budget(bo) : 0;
}

size_t bayesopt_level_count(const bayesopt *bo)
{
    return bo ? bo->options.n_levels : 0;
}

size_t bayesopt_initial_count(const bayesopt *bo)
{
    return bo ? problem_initial(bo) : 0;
}

uint64_t bayesopt_seed(const bayesopt *bo)
{
    return bo ? bo->options.seed : 0;
}
