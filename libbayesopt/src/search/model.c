/* What the surrogate of the objective says: predictions and its own quality. */
#include "core/error.h"
#include "problem/internal.h"
#include "search/strategy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Values the objective's model can be fitted to. */
static size_t count_done(const bayesopt *bo)
{
    size_t done = 0;
    for (size_t i = 0; i < bo->n_points; i++)
        done += point_counts(bo, &bo->points[i]);
    return done;
}

static bayesopt_status ensure_model(bayesopt *bo)
{
    size_t done = count_done(bo);
    if (done < 2)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "a model needs two successful evaluations, there are %zu", done);
    return bo->surrogates.fitted ? BAYESOPT_OK : surrogates_fit(bo, false);
}

/* Violation of the outcome constraints at a point of [0,1]^d, by the means of their models. */
static bayesopt_status predict_violation(const bayesopt *bo, const double *u, double *violation)
{
    bayesopt_status status = BAYESOPT_OK;
    *violation = 0;
    for (size_t k = 0; k < bo->options.n_constraints && !status; k++) {
        const bayesopt_gp *gp = bo->surrogates.gps[k + 1];
        double mean;
        status = bayesopt_gp_predict(gp, 1, u, &mean, NULL);
        mean = status ? NAN : bayesopt_gp_from_model(gp, mean);
        *violation += fmax(fmax(mean - bo->constraint_upper[k], bo->constraint_lower[k] - mean), 0);
    }
    return status;
}

/* The evaluated point whose mean is least, within the constraints by their means too. */
static bayesopt_status best_by_model(bayesopt *bo, size_t *best, double *f, bool *feasible)
{
    struct merit most = merit_worst, merit;
    bayesopt_status status = ensure_model(bo);
    for (size_t i = 0; i < bo->n_points && !status; i++) {
        const struct point *p = &bo->points[i];
        if (!point_counts(bo, p))
            continue;
        status = surrogates_predict(bo, 1, p->u, &merit.f, NULL);
        if (!status)
            status = predict_violation(bo, p->u, &merit.violation);
        if (!status && merit_better(merit, most)) {
            most = merit;
            *best = i;
        }
    }
    if (!status)
        *f = bayesopt_gp_from_model(bo->surrogates.gps[0], most.f);
    *feasible = most.violation <= 0;
    return status;
}

bayesopt_status bayesopt_best(bayesopt *bo, double *x, double *f, uint64_t *id)
{
    NEED(bo);
    bool feasible;
    double mean;
    size_t best = history_best(bo, &feasible);
    if (best == SIZE_MAX || bo->options.noise == BAYESOPT_NOISE_DETERMINISTIC || count_done(bo) < 2)
        return bayesopt_best_told(bo, x, f, id);
    bayesopt_status status = best_by_model(bo, &best, &mean, &feasible);
    if (status)
        return status;
    const struct point *p = &bo->points[best];
    if (x)
        memcpy(x, p->x, bo->d * sizeof *x);
    if (f)
        *f = problem_sign(bo) * mean;
    if (id)
        *id = p->id;
    return feasible ? BAYESOPT_OK : BAYESOPT_NONE_FEASIBLE;
}

bayesopt_status bayesopt_predict(bayesopt *bo, size_t n, const double *x, double *mean, double *sd)
{
    return bayesopt_predict_outcome(bo, 0, n, x, mean, sd);
}

bayesopt_status bayesopt_predict_outcome(bayesopt *bo, size_t k, size_t n, const double *x,
                                         double *mean, double *sd)
{
    NEED(bo);
    NEED(x);
    NEED(mean);
    NEED_MOST(n, BAYESOPT_MOST_POINTS);
    bayesopt_status status = problem_check_points(bo, n, x);
    if (!status)
        status = ensure_model(bo);
    double *u = malloc((n ? n : 1) * (bo->d + 1) * sizeof *u);
    if (!status && !u)
        status = bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    if (!status && k > bo->options.n_constraints)
        status = bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "outcome %zu of %zu", k,
                               bo->options.n_constraints);
    const bayesopt_gp *gp = status ? NULL : bo->surrogates.gps[k];
    double *var = status ? NULL : u + n * bo->d, sign = k ? 1 : problem_sign(bo);
    for (size_t i = 0; i < n && !status; i++)
        problem_to_unit(bo, x + i * bo->d, u + i * bo->d);
    if (!status)
        status =
            k ? bayesopt_gp_predict(gp, n, u, mean, var) : surrogates_predict(bo, n, u, mean, var);
    for (size_t i = 0; i < n && !status; i++) {
        double half = sqrt(var[i]), centre = mean[i];
        mean[i] = sign * bayesopt_gp_from_model(gp, centre);
        if (sd)
            sd[i] = 0.5 * (bayesopt_gp_from_model(gp, centre + half) -
                           bayesopt_gp_from_model(gp, centre - half));
    }
    free(u);
    return status;
}

/* Root mean square of the leave-one-out errors; NAN: none. */
static bayesopt_status loo_error(const bayesopt_gp *gp, size_t n, double *rms)
{
    double *mean = malloc((3 * n + 1) * sizeof *mean), sum = 0;
    *rms = NAN;
    if (!mean)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "no memory for %zu points", n);
    bayesopt_status status = bayesopt_gp_loo(gp, mean, mean + n);
    if (status) {
        free(mean);
        return status == BAYESOPT_ERROR_MEMORY ? status : BAYESOPT_OK;
    }
    bayesopt_gp_outputs(gp, mean + 2 * n);
    for (size_t i = 0; i < n; i++)
        sum += (mean[2 * n + i] - mean[i]) * (mean[2 * n + i] - mean[i]);
    free(mean);
    *rms = sqrt(sum / (double)n);
    return BAYESOPT_OK;
}

bayesopt_status bayesopt_model(bayesopt *bo, bayesopt_model_info *info, double *lengthscale)
{
    NEED(bo);
    NEED(info);
    bayesopt_status status = ensure_model(bo);
    bayesopt_gp_info gp_info;
    double rms;
    bayesopt_gp_parameters parameters = {.lengthscale = lengthscale};
    if (!status)
        status = bayesopt_gp_get_info(bo->surrogates.gps[0], &gp_info);
    if (!status)
        status = bayesopt_gp_get_parameters(bo->surrogates.gps[0], &parameters);
    if (!status)
        status = loo_error(bo->surrogates.gps[0], gp_info.n, &rms);
    if (status)
        return status;
    for (size_t j = 0; j < bo->d && lengthscale; j++)
        lengthscale[j] *= bo->kind[j] == BAYESOPT_KIND_LOG ? log(bo->upper[j] / bo->lower[j])
                          : bo->kind[j] == BAYESOPT_KIND_CATEGORICAL ? 1
                                                                     : bo->upper[j] - bo->lower[j];
    *info = (bayesopt_model_info){
        .n = gp_info.n,
        .isotropic = gp_info.isotropic,
        .wide = gp_info.wide,
        .transform = gp_info.transform,
        .log_posterior = gp_info.log_posterior,
        .jitter = gp_info.jitter,
        .signal_variance = parameters.signal,
        .noise_variance = parameters.noise,
        .loo_rms = rms,
        .repeat_sd = surrogates_repeat_deviation(bo),
        .trust_length = strategy_trust_length(bo),
    };
    return BAYESOPT_OK;
}
