/* What the surrogate of the objective says: predictions and its own quality. */
#include "error.h"
#include "internal.h"

#include <math.h>
#include <stdlib.h>

static bayesopt_status ensure_model(bayesopt *bo)
{
    size_t done = history_count_state(bo, BAYESOPT_STATE_DONE);
    if (done < 2)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "a model needs two successful evaluations, there are %zu", done);
    return bo->surrogates.fitted ? BAYESOPT_OK : surrogates_fit(bo, false);
}

bayesopt_status bayesopt_predict(bayesopt *bo, size_t n, const double *x, double *mean, double *sd)
{
    bayesopt_status status = ensure_model(bo);
    double *u = malloc((n ? n : 1) * (bo->d + 1) * sizeof *u);
    if (!status && !u)
        status = bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    const bayesopt_gp *gp = bo->surrogates.gps[0];
    double *var = status ? NULL : u + n * bo->d;
    for (size_t i = 0; i < n && !status; i++)
        problem_to_unit(bo, x + i * bo->d, u + i * bo->d);
    if (!status)
        status = surrogates_predict(bo, n, u, mean, var);
    for (size_t i = 0; i < n && !status; i++) {
        double half = sqrt(var[i]), centre = mean[i];
        mean[i] = bayesopt_gp_from_model(gp, centre);
        if (sd)
            sd[i] = 0.5 * (bayesopt_gp_from_model(gp, centre + half) -
                           bayesopt_gp_from_model(gp, centre - half));
    }
    free(u);
    return status;
}

static double loo_error(const bayesopt_gp *gp, size_t n)
{
    double *mean = malloc((3 * n + 1) * sizeof *mean), sum = 0;
    if (!mean || bayesopt_gp_loo(gp, mean, mean + n)) {
        free(mean);
        return NAN;
    }
    bayesopt_gp_outputs(gp, mean + 2 * n);
    for (size_t i = 0; i < n; i++)
        sum += (mean[2 * n + i] - mean[i]) * (mean[2 * n + i] - mean[i]);
    free(mean);
    return sqrt(sum / (double)n);
}

bayesopt_status bayesopt_model(bayesopt *bo, bayesopt_model_info *info, double *lengthscale)
{
    bayesopt_status status = ensure_model(bo);
    bayesopt_gp_info gp_info;
    bayesopt_gp_parameters parameters = {.lengthscale = lengthscale};
    if (!status)
        status = bayesopt_gp_get_info(bo->surrogates.gps[0], &gp_info);
    if (!status)
        status = bayesopt_gp_get_parameters(bo->surrogates.gps[0], &parameters);
    if (status)
        return status;
    for (size_t j = 0; j < bo->d && lengthscale; j++)
        lengthscale[j] *= bo->upper[j] - bo->lower[j];
    *info = (bayesopt_model_info){
        .n = gp_info.n,
        .isotropic = gp_info.isotropic,
        .wide = gp_info.wide,
        .transform = gp_info.transform,
        .log_posterior = gp_info.log_posterior,
        .jitter = gp_info.jitter,
        .signal_variance = parameters.signal,
        .noise_variance = parameters.noise,
        .loo_rms = loo_error(bo->surrogates.gps[0], gp_info.n),
        .trust_length = strategy_trust_length(bo),
    };
    return BAYESOPT_OK;
}
