#include "search/noisy.h"

#include "core/error.h"
#include "core/matrix.h"
#include "core/random.h"
#include "gp/gp_internal.h"
#include "gp/kernel.h"

#include <bayesopt/acquisition.h>
#include <bayesopt/design.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DRAWS = 16, MOST_SOBOL = 1000 };

struct noisy {
    bayesopt_gp *exact; /* the same covariance, conditioned on noise-free residuals */
    size_t n, d;
    double *slope; /* [d + 1] prior mean: constant and slopes */
    double *alpha; /* [DRAWS x n] */
    double *dmean; /* [2 d] scratch */
    double best[DRAWS];
};

/* Standard normal draws [DRAWS x n], a scrambled Sobol sequence as far as it reaches. */
static bayesopt_status draw_normals(size_t n, uint64_t seed, double *z)
{
    struct random_stream stream;
    random_start(&stream, seed, STREAM_SEARCH, 0);
    if (n > MOST_SOBOL) {
        for (size_t i = 0; i < DRAWS * n; i++)
            z[i] = random_normal(&stream);
        return BAYESOPT_OK;
    }
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.seed = seed;
    bayesopt_status status = bayesopt_design(BAYESOPT_DESIGN_SOBOL, DRAWS, n, &options, z);
    for (size_t i = 0; i < DRAWS * n && !status; i++)
        z[i] = transform_normal_score(fmin(fmax(z[i], 1e-6), 1 - 1e-6));
    return status;
}

/* With K = F + N, N the noise, the true values given t have mean t - N alpha and covariance
 * N - N K^-1 N; its Cholesky factor replaces the lower triangle of k. */
static bool posterior_factor(const bayesopt_gp *gp, const double *noise, double *k)
{
    size_t n = gp->n, ld = gp->capacity;
    double largest = 0;
    if (!matrix_inverse(n, gp->factor, ld, k))
        return false;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++)
            k[i * ld + j] = (i == j ? noise[i] : 0) - noise[i] * k[i * ld + j] * noise[j];
        largest = fmax(largest, noise[i]);
    }
    for (size_t i = 0; i < n; i++)
        k[i * ld + i] += 1e-9 * largest + 1e-300;
    return matrix_cholesky(n, k, ld);
}

/* The regression of the residuals without noise. */
static bayesopt_status make_exact(const bayesopt_gp *gp, struct noisy *noisy,
                                  const double *residual)
{
    bayesopt_gp_options options = gp->options;
    bayesopt_gp_parameters parameters = {gp->lengthscale, gp->signal, 1e-8 * gp->signal, 0};
    options.mean = BAYESOPT_MEAN_FIXED;
    options.noise = BAYESOPT_NOISE_DETERMINISTIC;
    options.transform = BAYESOPT_TRANSFORM_NONE;
    options.group = gp->group;
    options.categorical = gp->categorical;
    bayesopt_status status = bayesopt_gp_create(gp->d, &options, &noisy->exact);
    if (!status)
        status = bayesopt_gp_set_data(noisy->exact, gp->n, gp->x, residual, NULL);
    if (!status)
        status = bayesopt_gp_set_parameters(noisy->exact, &parameters);
    return status;
}

static double prior_mean(const struct noisy *noisy, const double *x)
{
    double mean = noisy->slope[0];
    for (size_t j = 0; j < noisy->d; j++)
        mean += noisy->slope[1 + j] * x[j];
    return mean;
}

/* scratch: [n] residuals, [n] noise, [DRAWS x n] normals, a capacity x capacity matrix. */
static bayesopt_status draw(const bayesopt_gp *gp, const bool *eligible, uint64_t seed,
                            struct noisy *noisy, double *scratch)
{
    size_t n = gp->n, ld = gp->capacity;
    double *residual = scratch, *noise = residual + n, *z = noise + n, *k = z + DRAWS * n;
    for (size_t i = 0; i < n; i++)
        noise[i] = gp_noise(gp, i, gp->noise) + gp->jitter;
    bayesopt_status status = draw_normals(n, seed, z);
    if (!status && !posterior_factor(gp, noise, k))
        status = bayesopt_fail(BAYESOPT_ERROR_NUMERIC, "noisy improvement: no posterior factor");
    for (size_t s = 0; s < DRAWS && !status; s++) {
        noisy->best[s] = INFINITY;
        for (size_t i = 0; i < n; i++) {
            double value =
                gp->t[i] - noise[i] * gp->alpha[i] + matrix_dot(i + 1, k + i * ld, z + s * n);
            residual[i] = value - prior_mean(noisy, gp->x + i * gp->d);
            if (eligible[i])
                noisy->best[s] = fmin(noisy->best[s], value);
        }
        if (s == 0)
            status = make_exact(gp, noisy, residual);
        if (status)
            return status;
        double *alpha = noisy->alpha + s * n;
        memcpy(alpha, residual, n * sizeof *alpha);
        matrix_forward(n, noisy->exact->factor, noisy->exact->capacity, alpha);
        matrix_backward(n, noisy->exact->factor, noisy->exact->capacity, alpha);
    }
    return status;
}

bayesopt_status noisy_create(const bayesopt_gp *gp, const bool *eligible, uint64_t seed,
                             struct noisy **out)
{
    size_t n = gp->n, d = gp->d;
    struct noisy *noisy = calloc(1, sizeof *noisy);
    double *scratch = malloc(((2 + DRAWS) * n + gp->capacity * gp->capacity) * sizeof *scratch);
    if (noisy) {
        *noisy = (struct noisy){.n = n, .d = d};
        noisy->slope = calloc(d + 1 + DRAWS * n + 2 * d, sizeof *noisy->slope);
    }
    if (!noisy || !scratch || !noisy->slope) {
        free(scratch);
        noisy_free(noisy);
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    }
    noisy->alpha = noisy->slope + d + 1;
    noisy->dmean = noisy->alpha + DRAWS * n;
    noisy->slope[0] = gp->p ? gp->beta[0] : gp->fixed_mean;
    for (size_t c = 1; c < gp->p; c++)
        noisy->slope[c] = gp->beta[c];
    bayesopt_status status = draw(gp, eligible, seed, noisy, scratch);
    free(scratch);
    if (status) {
        noisy_free(noisy);
        return status;
    }
    *out = noisy;
    return BAYESOPT_OK;
}

void noisy_free(struct noisy *noisy)
{
    if (!noisy)
        return;
    bayesopt_gp_free(noisy->exact);
    free(noisy->slope);
    free(noisy);
}

double noisy_log_ei(struct noisy *noisy, const double *x, double *gradient, double *work)
{
    bayesopt_gp *gp = noisy->exact;
    size_t n = noisy->n, d = noisy->d;
    double value[DRAWS], by_mean[DRAWS], by_sd[DRAWS], point[BAYESOPT_MOST_VARIABLES], mean, var;
    double constant = prior_mean(noisy, x), most = -INFINITY, total = 0;
    /* The variance is the same for all draws, the mean is linear in alpha. */
    if (bayesopt_gp_predict(gp, 1, x, &mean, &var))
        return -INFINITY;
    double sd = sqrt(fmax(var, 1e-12));
    for (size_t j = 0; j < d; j++)
        point[j] = gp_scaled(gp, j, x[j]);
    kernel_distances(n, d, gp->scaled, gp->capacity, point, gp->jump, work);
    kernel_values(gp->options.kernel, n, work, work, NULL);
    for (size_t s = 0; s < DRAWS; s++) {
        mean = constant + gp->signal * matrix_dot(n, work, noisy->alpha + s * n);
        value[s] = bayesopt_log_ei(mean, sd, noisy->best[s], &by_mean[s], &by_sd[s]);
        most = fmax(most, value[s]);
    }
    if (!isfinite(most))
        return most;
    for (size_t s = 0; s < DRAWS; s++)
        total += exp(value[s] - most);
    if (gradient) {
        /* One prediction with the weighted sum of the alphas gives the means' share. */
        double shares = 0, slope_sd = 0, *dvar = noisy->dmean + d;
        memset(gp->alpha, 0, n * sizeof *gp->alpha);
        for (size_t s = 0; s < DRAWS; s++) {
            double weight = exp(value[s] - most) / total;
            shares += weight * by_mean[s];
            slope_sd += weight * by_sd[s];
            matrix_axpy(n, weight * by_mean[s], noisy->alpha + s * n, gp->alpha);
        }
        if (bayesopt_gp_predict_gradient(gp, x, &mean, &var, noisy->dmean, dvar, work))
            return -INFINITY;
        for (size_t j = 0; j < d; j++)
            gradient[j] =
                noisy->dmean[j] + shares * noisy->slope[1 + j] + slope_sd * dvar[j] / (2 * sd);
    }
    return most + log(total / DRAWS);
}
