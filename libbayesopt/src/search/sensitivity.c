/* What a model says of itself: which variables matter, and how well it predicts what it was not
 * told. */
#include "core/error.h"
#include "problem/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_SAMPLES = 64, MOST_SAMPLES = 65536 };

/* Jansen's estimators (Saltelli et al., Computer Physics Communications 181 (2010) 259, table 2):
 * with f at two independent samples A and B, and at A with column j of B, the share of variance
 * that j explains alone is 1 - mean (fB - fABj)^2 / 2V and that it has a part in
 * mean (fA - fABj)^2 / 2V. */
static void estimate(size_t n, const double *fa, const double *fb, const double *fab,
                     double variance, double *first, double *total)
{
    double alone = 0, part = 0;
    for (size_t i = 0; i < n; i++) {
        alone += (fb[i] - fab[i]) * (fb[i] - fab[i]) / (2 * (double)n);
        part += (fa[i] - fab[i]) * (fa[i] - fab[i]) / (2 * (double)n);
    }
    *first = variance > 0 ? 1 - alone / variance : 0;
    *total = variance > 0 ? part / variance : 0;
}

static double variance_of(size_t n, const double *values)
{
    double mean = 0, square = 0;
    for (size_t i = 0; i < n; i++)
        mean += values[i] / (double)n;
    for (size_t i = 0; i < n; i++)
        square += (values[i] - mean) * (values[i] - mean) / (double)n;
    return square;
}

/* Two samples of n points from one sequence in 2 d dimensions: u [2 x n x d]. */
static bayesopt_status draw(const struct bayesopt *bo, size_t n, double *u)
{
    size_t d = bo->d;
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.seed = bo->options.seed;
    double *both = malloc(n * 2 * d * sizeof *both);
    if (!both)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    bayesopt_design_kind kind = 2 * d <= BAYESOPT_MOST_VARIABLES && 2 * d <= 50
                                    ? BAYESOPT_DESIGN_SOBOL
                                    : BAYESOPT_DESIGN_UNIFORM;
    bayesopt_status status = bayesopt_design(kind, n, 2 * d, &options, both);
    for (size_t i = 0; i < n && !status; i++)
        for (size_t s = 0; s < 2; s++) {
            double *at = u + (s * n + i) * d;
            memcpy(at, both + (2 * i + s) * d, d * sizeof *at);
            problem_spread(bo, at);
        }
    free(both);
    return status;
}

static bayesopt_status evaluate(bayesopt *bo, size_t k, size_t n, const double *u, double *x,
                                double *f)
{
    for (size_t i = 0; i < n; i++)
        problem_from_unit(bo, u + i * bo->d, x + i * bo->d);
    return bayesopt_predict_outcome(bo, k, n, x, f, NULL);
}

bayesopt_status bayesopt_sensitivity(bayesopt *bo, size_t k, size_t n, double *first, double *total)
{
    NEED(bo);
    NEED(first);
    NEED(total);
    if (n < LEAST_SAMPLES || n > MOST_SAMPLES || 2 * bo->d > BAYESOPT_MOST_VARIABLES)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "sensitivity from %zu samples of %zu variables: expected %d to %d, of "
                             "at most %d",
                             n, bo->d, LEAST_SAMPLES, MOST_SAMPLES, BAYESOPT_MOST_VARIABLES / 2);
    size_t d = bo->d;
    double *u = malloc(n * (3 * d + d + 4) * sizeof *u);
    if (!u)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    double *mixed = u + 2 * n * d, *x = mixed + n * d, *fa = x + n * d, *fb = fa + n, *fab = fb + n;
    bayesopt_status status = draw(bo, n, u);
    if (!status)
        status = evaluate(bo, k, n, u, x, fa);
    if (!status)
        status = evaluate(bo, k, n, u + n * d, x, fb);
    double variance = status ? 0 : variance_of(2 * n, fa);
    for (size_t j = 0; j < d && !status; j++) {
        memcpy(mixed, u, n * d * sizeof *u);
        for (size_t i = 0; i < n; i++)
            mixed[i * d + j] = u[(n + i) * d + j];
        status = evaluate(bo, k, n, mixed, x, fab);
        if (!status)
            estimate(n, fa, fb, fab, variance, &first[j], &total[j]);
    }
    free(u);
    return status;
}

bayesopt_status bayesopt_leave_one_out(bayesopt *bo, size_t *n, double *told, double *mean,
                                       double *sd)
{
    NEED(bo);
    NEED(n);
    NEED(told);
    NEED(mean);
    NEED(sd);
    *n = 0;
    if (bo->options.n_levels > 1)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "leave-one-out: two levels have no model of the values alone");
    bayesopt_model_info info;
    bayesopt_status status = bayesopt_model(bo, &info, NULL);
    if (status)
        return status;
    const bayesopt_gp *gp = bo->surrogates.gps[0];
    double *work = malloc(3 * info.n * sizeof *work), sign = problem_sign(bo);
    size_t done = history_count_state(bo, BAYESOPT_STATE_DONE);
    if (!work)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    status = bayesopt_gp_loo(gp, work, work + info.n);
    if (!status)
        status = bayesopt_gp_outputs(gp, work + 2 * info.n);
    /* What was derived from gradients follows the values. */
    *n = status ? 0 : info.n < done ? info.n : done;
    for (size_t i = 0; i < *n; i++) {
        double half = sqrt(work[info.n + i]);
        told[i] = sign * bayesopt_gp_from_model(gp, work[2 * info.n + i]);
        mean[i] = sign * bayesopt_gp_from_model(gp, work[i]);
        sd[i] = 0.5 * (bayesopt_gp_from_model(gp, work[i] + half) -
                       bayesopt_gp_from_model(gp, work[i] - half));
    }
    free(work);
    return status;
}
