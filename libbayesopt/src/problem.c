/* What is known before the first evaluation: box, constraints, counts, budget. */
#include "error.h"
#include "internal.h"

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
    return BAYESOPT_OK;
}

void problem_to_unit(const struct bayesopt *bo, const double *x, double *u)
{
    for (size_t j = 0; j < bo->d; j++)
        u[j] = fmin(fmax((x[j] - bo->lower[j]) / (bo->upper[j] - bo->lower[j]), 0), 1);
}

void problem_from_unit(const struct bayesopt *bo, const double *u, double *x)
{
    for (size_t j = 0; j < bo->d; j++)
        x[j] = u[j] >= 1 ? bo->upper[j]
                         : fmin(bo->lower[j] + u[j] * (bo->upper[j] - bo->lower[j]), bo->upper[j]);
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
