/* Posterior, its gradients, leave-one-out, and the way between modelled and caller's outputs. */
#include "core/error.h"
#include "core/matrix.h"
#include "gp/gp_internal.h"
#include "gp/kernel.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 64 };

static bayesopt_status need(const bayesopt_gp *gp, const char *what)
{
    return gp->conditioned ? BAYESOPT_OK
                           : bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                           "gp: %s before the model is conditioned", what);
}

/* Variance due to the estimated mean: r' (H'K^-1 H)^-1 r with r = h - H'K^-1 k, Rasmussen and
 * Williams eq. 2.42; overwrites r by (H'K^-1 H)^-1 r. */
static double mean_variance(const bayesopt_gp *gp, double *r)
{
    matrix_forward(gp->p, gp->gram, gp->p, r);
    double variance = matrix_dot(gp->p, r, r);
    matrix_backward(gp->p, gp->gram, gp->p, r);
    return variance;
}

static double prior_mean(const bayesopt_gp *gp, const double *x)
{
    double mean = gp->p ? gp->beta[0] : gp->fixed_mean;
    for (size_t c = 1; c < gp->p; c++)
        mean += gp->beta[c] * x[c - 1];
    return mean;
}

/* One block of m <= BLOCK points: k is n x BLOCK, columns d x BLOCK and rest p x BLOCK scratch. */
static void predict_block(const bayesopt_gp *gp, size_t m, const double *x, double *mean,
                          double *var, double *k, double *columns, double *rest)
{
    size_t n = gp->n, d = gp->d, p = gp->p;
    double point[BAYESOPT_MOST_VARIABLES], r[BAYESOPT_MOST_VARIABLES + 1];
    for (size_t c = 0; c < m; c++) {
        mean[c] = prior_mean(gp, x + c * d);
        for (size_t j = 0; j < d; j++)
            columns[j * BLOCK + c] = gp_scaled(gp, j, x[c * d + j]);
    }
    for (size_t i = 0; i < n; i++) {
        double *row = k + i * BLOCK;
        for (size_t j = 0; j < d; j++)
            point[j] = gp->scaled[j * gp->capacity + i];
        kernel_distances(m, d, columns, BLOCK, point, gp->jump, row);
        kernel_values(gp->options.kernel, m, row, row, NULL);
        matrix_scale(m, gp->signal, row);
        matrix_axpy(m, gp->alpha[i], row, mean);
    }
    if (!var)
        return;
    matrix_solve_lower(n, gp->factor, gp->capacity, m, k, BLOCK);
    memset(rest, 0, p * BLOCK * sizeof *rest);
    for (size_t c = 0; c < m; c++)
        var[c] = gp->signal;
    for (size_t i = 0; i < n; i++) {
        const double *row = k + i * BLOCK;
        for (size_t c = 0; c < m; c++)
            var[c] -= row[c] * row[c];
        for (size_t b = 0; b < p; b++)
            matrix_axpy(m, -gp->solved[b * gp->capacity + i], row, rest + b * BLOCK);
    }
    for (size_t c = 0; c < m; c++) {
        gp_basis_row(gp, x + c * d, r);
        for (size_t b = 0; b < p; b++)
            r[b] += rest[b * BLOCK + c];
        var[c] = fmax(var[c], 0) + mean_variance(gp, r);
    }
}

bayesopt_status bayesopt_gp_predict(const bayesopt_gp *gp, size_t m, const double *x, double *mean,
                                    double *var)
{
    NEED(gp);
    NEED(x);
    NEED(mean);
    NEED_MOST(m, BAYESOPT_MOST_POINTS);
    bayesopt_status status = need(gp, "prediction");
    if (status)
        return status;
    THREADS((int)gp->options.threads);
    double *k = malloc((gp->n + gp->d + gp->p) * BLOCK * sizeof *k);
    if (!k)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    double *columns = k + gp->n * BLOCK, *rest = columns + gp->d * BLOCK;
    for (size_t c = 0; c < m; c += BLOCK)
        predict_block(gp, m - c < BLOCK ? m - c : BLOCK, x + c * gp->d, mean + c,
                      var ? var + c : NULL, k, columns, rest);
    free(k);
    return BAYESOPT_OK;
}

bayesopt_status bayesopt_gp_predict_gradient(const bayesopt_gp *gp, const double *x, double *mean,
                                             double *var, double *dmean, double *dvar, double *work)
{
    NEED(gp);
    NEED(x);
    NEED(mean);
    NEED(var);
    NEED(dmean);
    NEED(dvar);
    NEED(work);
    bayesopt_status status = need(gp, "prediction");
    if (status)
        return status;
    THREADS((int)gp->options.threads);
    size_t n = gp->n, d = gp->d, p = gp->p, ld = gp->capacity;
    double *k = work, *w = work + n, point[BAYESOPT_MOST_VARIABLES], r[BAYESOPT_MOST_VARIABLES + 1];
    for (size_t j = 0; j < d; j++)
        point[j] = gp_scaled(gp, j, x[j]);
    kernel_distances(n, d, gp->scaled, ld, point, gp->jump, k);
    kernel_values(gp->options.kernel, n, k, k, w);
    matrix_scale(n, gp->signal, k);
    matrix_scale(n, gp->signal, w);
    *mean = prior_mean(gp, x) + matrix_dot(n, k, gp->alpha);
    gp_basis_row(gp, x, r);
    matrix_forward(n, gp->factor, ld, k);
    *var = fmax(gp->signal - matrix_dot(n, k, k), 0);
    for (size_t b = 0; b < p; b++)
        r[b] -= matrix_dot(n, gp->solved + b * ld, k);
    *var += mean_variance(gp, r);
    matrix_backward(n, gp->factor, ld, k);
    /* d var = -2 k'K^-1 dk - 2 (K^-1 H g)' dk + 2 g' dh with g = (H'K^-1 H)^-1 r */
    for (size_t b = 0; b < p; b++)
        matrix_axpy(n, r[b], gp->basis + b * ld, k);
    for (size_t j = 0; j < d; j++) {
        const double *column = gp->scaled + j * ld;
        double slope = 0, spread = 0;
        if (gp->categorical && gp->categorical[j]) { /* a step has no slope */
            dmean[j] = dvar[j] = 0;
            continue;
        }
#pragma omp simd reduction(+ : slope, spread)
        for (size_t i = 0; i < n; i++) {
            double dk = w[i] * (column[i] - point[j]);
            slope += gp->alpha[i] * dk;
            spread += k[i] * dk;
        }
        dmean[j] = slope / gp->lengthscale[j] + (p > 1 ? gp->beta[j + 1] : 0);
        dvar[j] = -2 * spread / gp->lengthscale[j] + (p > 1 ? 2 * r[j + 1] : 0);
    }
    return BAYESOPT_OK;
}

double bayesopt_gp_to_model(const bayesopt_gp *gp, double y)
{
    return gp ? transform_apply(&gp->transform, y) : (double)NAN;
}

double bayesopt_gp_from_model(const bayesopt_gp *gp, double value)
{
    return gp ? transform_invert(&gp->transform, value) : (double)NAN;
}

bayesopt_status bayesopt_gp_log_likelihood(const bayesopt_gp *gp, double *value, double *gradient)
{
    NEED(gp);
    NEED(value);
    bayesopt_status status = need(gp, "likelihood");
    if (status)
        return status;
    THREADS((int)gp->options.threads);
    *value = gp->log_likelihood;
    if (!gradient)
        return BAYESOPT_OK;
    struct gp_scratch scratch;
    if (!gp_scratch_create(&scratch, gp->capacity))
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    struct gp_theta theta = {gp->lengthscale, gp->signal, gp->noise};
    if (!gp_likelihood_gradient(gp, &theta, &scratch, true, gradient))
        status = bayesopt_fail(BAYESOPT_ERROR_NUMERIC, "gp: the covariance has no inverse");
    gp_scratch_free(&scratch);
    return status;
}

bayesopt_status bayesopt_gp_outputs(const bayesopt_gp *gp, double *t)
{
    NEED(gp);
    NEED(t);
    bayesopt_status status = need(gp, "outputs");
    if (!status)
        memcpy(t, gp->t, gp->n * sizeof *t);
    return status;
}

bayesopt_status bayesopt_gp_loo(const bayesopt_gp *gp, double *mean, double *var)
{
    NEED(gp);
    NEED(mean);
    NEED(var);
    bayesopt_status status = need(gp, "leave-one-out");
    if (status)
        return status;
    THREADS((int)gp->options.threads);
    size_t ld = gp->capacity;
    double *inverse = malloc(ld * ld * sizeof *inverse);
    if (!inverse)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    if (!matrix_inverse(gp->n, gp->factor, ld, inverse))
        status = bayesopt_fail(BAYESOPT_ERROR_NUMERIC, "gp: the covariance has no inverse");
    for (size_t i = 0; i < gp->n && !status; i++) {
        var[i] = 1 / inverse[i * ld + i];
        mean[i] = gp->t[i] - gp->alpha[i] * var[i];
    }
    free(inverse);
    return status;
}
