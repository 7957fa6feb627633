#include "solve/filters.h"

#include "solve/formulation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double factors[FILTERS_MOST] = {1.0, 0.85, 1.15};
/* With fewer unknowns LU takes less than 3 % of a solve. */
static const size_t direct_unknowns = 1000;

size_t filters_of(const igabem_options *options, double cutoff[FILTERS_MOST])
{
    for (size_t f = 0; f < FILTERS_MOST; f++)
        cutoff[f] = factors[f] * options->cutoff_angle;
    bool several =
        formulation_has_waves(options) && options->sensitivity && isfinite(options->cutoff_angle);
    return several ? FILTERS_MOST : 1;
}

/* The densities of all filters by LU, which replaces the matrices by their factors. */
static igabem_status solve_directly(const struct matrix *matrix, igabem_solution *solution,
                                    size_t filters, const struct filter_change *change,
                                    double *const *sigma)
{
    size_t n = matrix->n;
    igabem_status status = IGABEM_OK;
    double *sum = filters > 1 ? malloc(n * n * sizeof *sum) : NULL;
    if (filters > 1 && !sum)
        return solution_no_memory(n);
    solution->memory += sum ? (double)(n * n * sizeof *sum) : 0.0;
    for (size_t f = filters; f-- > 0 && status == IGABEM_OK;) {
        const struct matrix changed = {n, n, sum, matrix->threads, matrix->progress};
        if (f > 0) {
            filter_change_expand(change, f - 1, sum);
            for (size_t i = 0; i < n; i++)
                for (size_t k = 0; k < n; k++)
                    sum[i * n + k] += matrix->rows[i * matrix->stride + k];
        }
        solution_normal_flow(solution, sigma[f]);
        status =
            linear_lu(f > 0 ? &changed : matrix, sigma[f], f == 0 ? &solution->condition : NULL);
    }
    free(sum);
    solution->options.solver = IGABEM_SOLVER_LU;
    return status;
}

struct one_change {
    const struct filter_change *change;
    size_t filter;
};

static void add_change(const void *data, const double *x, double *y)
{
    const struct one_change *change = data;
    filter_change_add(change->change, change->filter, x, y);
}

/* The same by GMRES, which leaves the matrices as they are; a filter starts from the density of the
 * first. */
static igabem_status solve_iteratively(const struct matrix *matrix, igabem_solution *solution,
                                       size_t filters, const struct filter_change *change,
                                       double *const *sigma)
{
    size_t n = matrix->n;
    struct iteration *iteration = NULL;
    double *right = malloc(n * sizeof *right);
    igabem_status status = right ? IGABEM_OK : solution_no_memory(n);
    if (status == IGABEM_OK)
        status = iteration_create(matrix, solution->density->point, &iteration);
    if (status == IGABEM_OK) {
        solution_normal_flow(solution, right);
        memset(sigma[0], 0, n * sizeof *right);
        solution->memory += iteration_memory(iteration);
    }
    for (size_t f = 0; f < filters && status == IGABEM_OK; f++) {
        const struct one_change filter = {change, f - 1};
        const struct addend addend = {add_change, &filter};
        struct gmres_result result;
        if (f > 0)
            memcpy(sigma[f], sigma[0], n * sizeof *right);
        status = iteration_solve(iteration, f > 0 ? &addend : NULL, right, sigma[f], &result);
        solution->iterations = f == 0 ? result.iterations : solution->iterations;
        solution->residual = f == 0 ? result.residual : fmax(solution->residual, result.residual);
    }
    if (status == IGABEM_OK)
        status = iteration_condition(iteration, &solution->condition);
    iteration_free(iteration);
    free(right);
    solution->options.solver = IGABEM_SOLVER_GMRES;
    return status;
}

igabem_status filters_solve(const struct matrix *matrix, igabem_solution *solution, size_t filters,
                            const struct filter_change *change)
{
    size_t n = matrix->n;
    igabem_solver wanted = solution->options.solver;
    double **extra[2] = {&solution->sigma_lower, &solution->sigma_upper};
    double *sigma[FILTERS_MOST] = {solution->sigma, NULL, NULL};
    for (size_t f = 1; f < filters; f++) {
        sigma[f] = *extra[f - 1] = malloc(n * sizeof(double));
        if (!sigma[f])
            return solution_no_memory(n);
    }
    igabem_status status = IGABEM_ERROR_NUMERIC;
    bool iterate =
        wanted == IGABEM_SOLVER_GMRES || (wanted == IGABEM_SOLVER_AUTO && n >= direct_unknowns);
    if (iterate)
        status = solve_iteratively(matrix, solution, filters, change, sigma);
    if (!iterate || (status == IGABEM_ERROR_NUMERIC && wanted == IGABEM_SOLVER_AUTO)) {
        solution->iterations = 0;
        solution->residual = NAN;
        status = solve_directly(matrix, solution, filters, change, sigma);
    }
    return status;
}
