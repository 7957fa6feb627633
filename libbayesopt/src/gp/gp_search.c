#include "gp/gp_search.h"

#include "core/error.h"
#include "core/matrix.h"
#include "core/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const double gp_tight_variance = 0.1, gp_wide_variance = 1;

static const double log_2pi = 1.8378770664093454836;

/* Ranges of the search: length scales in units of the box, variances of standardised outputs. Long
 * scales with a large signal are wanted: there a Matern 5/2 process tends to a spline on top of a
 * quadratic polynomial, which is what smooth functions look like. */
static const double scale_range[2] = {0.01, 100};
static const double signal_range[2] = {0.02, 1e6};
static const double signal_deviation = 3; /* log sf2 ~ N(0, 3^2) */
/* log sn2 ~ N(centre, deviation^2). Deterministic data get a noise too, small enough to interpolate
 * and learnt, because simulations have a numerical one. */
static const struct gp_noise_prior learned_noise = {-4, 2, 1e-8, 0.5};
static const struct gp_noise_prior guard_noise = {-25, 2, 1e-12, 1e-6};

/* The first two starts of a fit, in units of the prior's centre, and the deviations of the
 * logarithms of the others; chosen on the first table of tests/bench/bayesopt_regret. */
static const double start_scale[2] = {0.75, 4}, start_signal[2] = {1, 300};
static const double start_spread = 0.7, start_signal_spread = 0.5;

/* Of the log posterior. */
static const double tolerance = 1e-3;

/* A direction in which the posterior is flatter than this counts with it: about that of the widest
 * prior, 1/signal_deviation^2. */
static const double least_curvature = 0.1;

static void unpack(const struct gp_search *fit, const double *theta, struct gp_theta *out)
{
    for (size_t j = 0; j < fit->gp->d; j++)
        fit->lengthscale[j] = exp(theta[fit->group[j]]);
    out->lengthscale = fit->lengthscale;
    out->signal = exp(theta[fit->groups]);
    out->noise = fit->parameters > fit->groups + 1 ? exp(theta[fit->groups + 1]) : 0;
}

/* log prior density of theta and its gradient (added). The precision of common + own deviations is
 * 1/v across the mean and 1/(v + G c) along it. */
static double log_prior(const struct gp_search *fit, const double *theta, double *gradient)
{
    const bayesopt_gp_options *o = &fit->gp->options;
    size_t groups = fit->groups;
    double count = (double)groups, v = fit->model.variance, along = v + count * o->prior_common;
    double centre = 0.5 * log((double)fit->gp->d) + o->prior_shift, mean = 0, square = 0;
    for (size_t g = 0; g < groups; g++)
        mean += (theta[g] - centre) / count;
    for (size_t g = 0; g < groups; g++) {
        double deviation = theta[g] - centre - mean;
        square += deviation * deviation / v;
        if (gradient)
            gradient[g] -= deviation / v + mean / along;
    }
    double value = -0.5 * (square + count * mean * mean / along + (count - 1) * log(v) +
                           log(along) + count * log_2pi);
    double u = theta[groups] / signal_deviation;
    value -= 0.5 * (u * u + log_2pi) + log(signal_deviation);
    if (gradient)
        gradient[groups] -= u / signal_deviation;
    if (fit->parameters > groups + 1) {
        u = (theta[groups + 1] - fit->noise->centre) / fit->noise->deviation;
        value -= 0.5 * (u * u + log_2pi) + log(fit->noise->deviation);
        if (gradient)
            gradient[groups + 1] -= u / fit->noise->deviation;
    }
    return value;
}

static bool log_posterior(struct gp_search *fit, const double *theta, double *value,
                          double *gradient)
{
    struct gp_theta unpacked;
    unpack(fit, theta, &unpacked);
    fit->evaluations++;
    if (!gp_likelihood(fit->gp, &unpacked, &fit->scratch, value, gradient ? fit->gradient : NULL))
        return false;
    if (gradient) {
        size_t d = fit->gp->d;
        memset(gradient, 0, fit->parameters * sizeof *gradient);
        for (size_t j = 0; j < d; j++)
            gradient[fit->group[j]] += fit->gradient[j];
        gradient[fit->groups] = fit->gradient[d];
        if (fit->parameters > fit->groups + 1)
            gradient[fit->groups + 1] = fit->gradient[d + 1];
    }
    *value += log_prior(fit, theta, gradient);
    return isfinite(*value);
}

static double objective(unsigned k, const double *theta, double *gradient, void *data)
{
    struct gp_search *fit = data;
    double value;
    fit->cancelled =
        fit->cancelled || (fit->gp->is_cancelled && fit->gp->is_cancelled(fit->gp->cancel_data));
    if (fit->cancelled) {
        nlopt_force_stop(fit->search);
        if (gradient)
            memset(gradient, 0, k * sizeof *gradient);
        return 1e30;
    }
    if (!log_posterior(fit, theta, &value, gradient)) {
        if (gradient)
            memset(gradient, 0, k * sizeof *gradient);
        return 1e30;
    }
    for (unsigned i = 0; gradient && i < k; i++)
        gradient[i] = -gradient[i];
    /* Close to singular covariances leave a rounding error of this size in the value, at which a
     * line search would go on to no end. */
    fit->flat += fabs(value - fit->best_value) < 1e-2;
    if (value > fit->best_value + tolerance)
        fit->flat = 0;
    if (fit->flat == 3)
        nlopt_force_stop(fit->search);
    if (value > fit->best_value) {
        fit->best_value = value;
        memcpy(fit->best, theta, k * sizeof *theta);
    }
    return -value;
}

bayesopt_status gp_search_climb(struct gp_search *fit, const double *start, size_t evaluations)
{
    unsigned k = (unsigned)fit->parameters;
    double low[GP_MOST_PARAMETERS], high[GP_MOST_PARAMETERS], theta[GP_MOST_PARAMETERS], value;
    for (size_t g = 0; g < fit->groups; g++) {
        low[g] = log(scale_range[0]);
        high[g] = log(scale_range[1]);
    }
    low[fit->groups] = log(signal_range[0]);
    high[fit->groups] = log(signal_range[1]);
    if (fit->parameters > fit->groups + 1) {
        low[fit->groups + 1] = log(fit->noise->least);
        high[fit->groups + 1] = log(fit->noise->most);
    }
    nlopt_opt search = nlopt_create(NLOPT_LD_LBFGS, k);
    if (!search)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    fit->search = search;
    fit->flat = 0;
    nlopt_set_min_objective(search, objective, fit);
    nlopt_set_lower_bounds(search, low);
    nlopt_set_upper_bounds(search, high);
    nlopt_set_ftol_abs(search, tolerance);
    nlopt_set_maxeval(search, (int)evaluations);
    for (unsigned i = 0; i < k; i++)
        theta[i] = fmin(fmax(start[i], low[i]), high[i]);
    /* A failed line search still leaves the best point seen in fit->best. */
    nlopt_result result = nlopt_optimize(search, theta, &value);
    nlopt_destroy(search);
    if (result == NLOPT_OUT_OF_MEMORY)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    return fit->cancelled ? bayesopt_fail(BAYESOPT_ERROR_CANCELLED, "gp: the fit was cancelled")
                          : BAYESOPT_OK;
}

bayesopt_status gp_search_create(struct gp_search *fit, bayesopt_gp *gp, struct gp_model model,
                                 const size_t *isotropic_groups)
{
    size_t groups = gp->d;
    *fit =
        (struct gp_search){.gp = gp, .model = model, .best_value = -INFINITY, .group = gp->group};
    if (model.isotropic) {
        groups = 1;
        fit->group = isotropic_groups;
    } else if (gp->options.scales == BAYESOPT_SCALES_TIED) {
        groups = 0;
        for (size_t j = 0; j < gp->d; j++)
            groups = gp->group[j] + 1 > groups ? gp->group[j] + 1 : groups;
    }
    fit->groups = groups;
    fit->noise = gp->options.noise == BAYESOPT_NOISE_LEARNED ? &learned_noise : &guard_noise;
    fit->parameters = groups + 1 + (gp->options.noise != BAYESOPT_NOISE_KNOWN);
    fit->lengthscale = malloc((4 * gp->d + 8) * sizeof(double));
    bool ok = gp_scratch_create(&fit->scratch, gp->capacity);
    if (!fit->lengthscale || !ok) {
        free(fit->lengthscale);
        if (ok)
            gp_scratch_free(&fit->scratch);
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    }
    fit->gradient = fit->lengthscale + gp->d;
    fit->best = fit->gradient + gp->d + 2;
    return BAYESOPT_OK;
}

void gp_search_free(struct gp_search *fit)
{
    gp_scratch_free(&fit->scratch);
    free(fit->lengthscale);
}

void gp_search_pack(const struct gp_search *fit, double *theta)
{
    const bayesopt_gp *gp = fit->gp;
    for (size_t g = 0; g < fit->groups; g++) {
        double sum = 0, count = 0;
        for (size_t j = 0; j < gp->d; j++)
            if (fit->group[j] == g) {
                sum += log(gp->lengthscale[j]);
                count += 1;
            }
        theta[g] = sum / count;
    }
    theta[fit->groups] = log(gp->signal);
    if (fit->parameters > fit->groups + 1)
        theta[fit->groups + 1] = log(fmax(gp->noise, fit->noise->least));
}

/* Start s in the coordinates of a fit. The likelihood has a mode of short scales (little is known
 * between the data) and one of long scales (a polynomial and little more), so the first two starts
 * are one in each; later ones are drawn around the first. */
void gp_search_start(const struct gp_search *fit, size_t s, double *theta)
{
    struct random_stream stream;
    random_start(&stream, fit->gp->options.seed, STREAM_FIT, s);
    double centre = 0.5 * log((double)fit->gp->d) + fit->gp->options.prior_shift;
    double common = s < 2 ? log(start_scale[s]) : start_spread * random_normal(&stream);
    for (size_t g = 0; g < fit->groups; g++) {
        double own = s > 1 ? sqrt(fit->model.variance) * random_normal(&stream) : 0;
        theta[g] = fmax(centre + common + own, log(0.1));
    }
    theta[fit->groups] =
        s < 2 ? log(start_signal[s]) : start_signal_spread * random_normal(&stream);
    if (fit->parameters > fit->groups + 1)
        theta[fit->groups + 1] = fit->noise->centre + (s > 1 ? random_normal(&stream) : 0);
}

void gp_search_adopt(struct gp_search *fit)
{
    bayesopt_gp *gp = fit->gp;
    struct gp_theta theta;
    unpack(fit, fit->best, &theta);
    memcpy(gp->lengthscale, theta.lengthscale, gp->d * sizeof *gp->lengthscale);
    gp->signal = theta.signal;
    gp->noise = theta.noise;
    gp->isotropic = fit->model.isotropic;
    gp->wide = fit->model.variance >= gp_wide_variance;
    gp->log_posterior = fit->best_value;
    gp->has_parameters = true;
}

/* Laplace's approximation of the log evidence: log posterior at the mode + k/2 log 2 pi - log det
 * H/2, H by forward differences of the gradient. It charges a model for its freedom, which the
 * density at the mode alone does not. */
bayesopt_status gp_search_evidence(struct gp_search *fit, double *evidence)
{
    size_t k = fit->parameters;
    double value, best = fit->best_value, logs = 0;
    double *h = malloc((k * k + 6 * k) * sizeof *h);
    if (!h)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "no memory to compare models");
    double *at = h + k * k, *moved = at + k, *theta = moved + k;
    const double step = 1e-3;
    memcpy(theta, fit->best, k * sizeof *theta);
    bool ok = log_posterior(fit, theta, &value, at);
    for (size_t i = 0; i < k && ok; i++) {
        double kept = theta[i];
        theta[i] += step;
        ok = log_posterior(fit, theta, &value, moved);
        theta[i] = kept;
        for (size_t j = 0; j < k && ok; j++)
            h[i * k + j] = (at[j] - moved[j]) / step;
    }
    for (size_t i = 0; i < k && ok; i++)
        for (size_t j = 0; j < i; j++)
            h[i * k + j] = h[j * k + i] = 0.5 * (h[i * k + j] + h[j * k + i]);
    ok = ok && matrix_eigenvalues(k, h, at, theta + k);
    for (size_t i = 0; i < k && ok; i++)
        logs += log(fmax(at[i], least_curvature));
    free(h);
    *evidence = ok ? best + 0.5 * ((double)k * log_2pi - logs) : best;
    return BAYESOPT_OK;
}
