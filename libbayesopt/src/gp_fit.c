/* Maximum a posteriori hyper-parameters, and the choice between models. */
#include "error.h"
#include "gp_internal.h"
#include "matrix.h"
#include "random.h"
#include "threads.h"

#include <math.h>
#include <nlopt.h>
#include <stdlib.h>
#include <string.h>

static const double log_2pi = 1.8378770664093454836;

/* Ranges of the search: length scales in units of the box, variances of standardised outputs. Long
 * scales with a large signal are wanted: there a Matern 5/2 process tends to a spline on top of a
 * quadratic polynomial, which is what smooth functions look like. */
static const double scale_range[2] = {0.01, 100};
static const double signal_range[2] = {0.02, 1e6};
static const double signal_deviation = 3; /* log sf2 ~ N(0, 3^2) */
/* Variances of the own part of log l_j that are compared: scales within a factor of about 1.4 and
 * of 2.7 of each other; chosen on the first table of tests/bench/bayesopt_regret. */
static const double tight_variance = 0.1, wide_variance = 1;

/* log sn2 ~ N(centre, deviation^2). Deterministic data get a noise too, small enough to interpolate
 * and learnt, because simulations have a numerical one. */
struct noise_prior {
    double centre, deviation, least, most;
};
static const struct noise_prior learned_noise = {-4, 2, 1e-8, 0.5};
static const struct noise_prior guard_noise = {-25, 2, 1e-12, 1e-6};

/* The first two starts of a fit, in units of the prior's centre, and the deviations of the
 * logarithms of the others; chosen on the first table of tests/bench/bayesopt_regret. */
static const double start_scale[2] = {0.75, 4}, start_signal[2] = {1, 300};
static const double start_spread = 0.7, start_signal_spread = 0.5;

enum { MOST_PARAMETERS = BAYESOPT_MOST_VARIABLES + 2 };

/* Of the log posterior. */
static const double tolerance = 1e-3;

/* A direction in which the posterior is flatter than this counts with it: about that of the widest
 * prior, 1/signal_deviation^2. */
static const double least_curvature = 0.1;

/* One of the models compared: how the length scales are tied and how far they may differ. */
struct model {
    bool isotropic;
    double variance;
};

struct fit {
    bayesopt_gp *gp;
    struct model model;
    const struct noise_prior *noise;
    size_t groups, parameters; /* log l per group, log sf2, log sn2 if learned */
    const size_t *group;       /* [d] */
    struct gp_scratch scratch;
    double *lengthscale, *gradient; /* [d], [d + 2] */
    double *best;                   /* [parameters] */
    double best_value;
    bool cancelled;
    size_t evaluations, flat; /* flat: at the best value but for rounding */
    nlopt_opt search;
};

static void unpack(const struct fit *fit, const double *theta, struct gp_theta *out)
{
    for (size_t j = 0; j < fit->gp->d; j++)
        fit->lengthscale[j] = exp(theta[fit->group[j]]);
    out->lengthscale = fit->lengthscale;
    out->signal = exp(theta[fit->groups]);
    out->noise = fit->parameters > fit->groups + 1 ? exp(theta[fit->groups + 1]) : 0;
}

/* log prior density of theta and its gradient (added). The precision of common + own deviations is
 * 1/v across the mean and 1/(v + G c) along it. */
static double log_prior(const struct fit *fit, const double *theta, double *gradient)
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

static bool log_posterior(struct fit *fit, const double *theta, double *value, double *gradient)
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
    struct fit *fit = data;
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

static bayesopt_status climb(struct fit *fit, const double *start, size_t evaluations)
{
    unsigned k = (unsigned)fit->parameters;
    double low[MOST_PARAMETERS], high[MOST_PARAMETERS], theta[MOST_PARAMETERS], value;
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
    nlopt_optimize(search, theta, &value);
    nlopt_destroy(search);
    return fit->cancelled ? bayesopt_fail(BAYESOPT_ERROR_CANCELLED, "gp: the fit was cancelled")
                          : BAYESOPT_OK;
}

static bayesopt_status fit_create(struct fit *fit, bayesopt_gp *gp, struct model model,
                                  const size_t *isotropic_groups)
{
    size_t groups = gp->d;
    *fit = (struct fit){.gp = gp, .model = model, .best_value = -INFINITY, .group = gp->group};
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

static void fit_free(struct fit *fit)
{
    gp_scratch_free(&fit->scratch);
    free(fit->lengthscale);
}

/* Present hyper-parameters in the coordinates of a fit; groups get their members' mean. */
static void pack(const struct fit *fit, double *theta)
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
static void make_start(const struct fit *fit, size_t s, double *theta)
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

static void adopt(struct fit *fit)
{
    bayesopt_gp *gp = fit->gp;
    struct gp_theta theta;
    unpack(fit, fit->best, &theta);
    memcpy(gp->lengthscale, theta.lengthscale, gp->d * sizeof *gp->lengthscale);
    gp->signal = theta.signal;
    gp->noise = theta.noise;
    gp->isotropic = fit->model.isotropic;
    gp->wide = fit->model.variance >= wide_variance;
    gp->log_posterior = fit->best_value;
    gp->has_parameters = true;
}

/* Laplace's approximation of the log evidence: log posterior at the mode + k/2 log 2 pi - log det
 * H/2, H by forward differences of the gradient. It charges a model for its freedom, which the
 * density at the mode alone does not. */
static double log_evidence(struct fit *fit)
{
    size_t k = fit->parameters;
    double value, best = fit->best_value, logs = 0;
    double *h = malloc((k * k + 3 * k) * sizeof *h);
    if (!h)
        return best;
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
    ok = ok && matrix_eigenvalues(k, h, at);
    for (size_t i = 0; i < k && ok; i++)
        logs += log(fmax(at[i], least_curvature));
    free(h);
    return ok ? best + 0.5 * ((double)k * log_2pi - logs) : best;
}

/* Leave-one-out log predictive density, Rasmussen and Williams eq. 5.10. */
static double loo_density(bayesopt_gp *gp)
{
    double *mean = malloc(2 * gp->n * sizeof *mean), sum = 0;
    if (!mean || !gp_condition(gp) || bayesopt_gp_loo(gp, mean, mean + gp->n)) {
        free(mean);
        return -INFINITY;
    }
    for (size_t i = 0; i < gp->n; i++) {
        double var = mean[gp->n + i], error = gp->t[i] - mean[i];
        sum -= 0.5 * (log(var) + error * error / var + log_2pi);
    }
    free(mean);
    return sum;
}

/* Mean square of the leave-one-out errors in normal scores of the ranks, a scale that does not
 * depend on the transform in use. */
static double loo_score_error(bayesopt_gp *gp)
{
    struct transform ranks;
    double *mean = malloc(2 * gp->n * sizeof *mean), square = 0;
    transform_reset(&ranks);
    if (!mean || !gp_condition(gp) || bayesopt_gp_loo(gp, mean, mean + gp->n) ||
        !transform_estimate(&ranks, BAYESOPT_TRANSFORM_RANK, gp->n, gp->y)) {
        free(mean);
        return INFINITY;
    }
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < gp->n; i++) {
        double t = transform_apply(&ranks, gp->y[i]);
        low = fmin(low, t);
        high = fmax(high, t);
    }
    for (size_t i = 0; i < gp->n; i++) {
        double t = transform_apply(&ranks, transform_invert(&gp->transform, mean[i]));
        double error = fmin(fmax(t, low), high) - transform_apply(&ranks, gp->y[i]);
        square += error * error / (double)gp->n;
    }
    transform_free(&ranks);
    free(mean);
    return isnan(square) ? INFINITY : square;
}

static size_t list_models(const bayesopt_gp *gp, struct model *models)
{
    const bayesopt_gp_options *o = &gp->options;
    size_t count = 0;
    if (gp->d > 1 && (o->scales == BAYESOPT_SCALES_AUTO || o->scales == BAYESOPT_SCALES_ISOTROPIC))
        models[count++] = (struct model){true, tight_variance};
    if (gp->d > 1 && o->scales == BAYESOPT_SCALES_ISOTROPIC)
        return count;
    if (!isnan(o->prior_variance)) {
        models[count++] = (struct model){false, o->prior_variance};
        return count;
    }
    models[count++] = (struct model){false, tight_variance};
    if (gp->d > 1)
        models[count++] = (struct model){false, wide_variance};
    return count;
}

static bayesopt_status set_transform(bayesopt_gp *gp, bayesopt_transform kind)
{
    if (!transform_estimate(&gp->transform, kind, gp->n, gp->y))
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    for (size_t i = 0; i < gp->n; i++)
        gp->t[i] = transform_apply(&gp->transform, gp->y[i]);
    return BAYESOPT_OK;
}

/* log of the density of the caller's outputs over that of the modelled ones. */
static double log_jacobian(const bayesopt_gp *gp)
{
    double sum = 0;
    for (size_t i = 0; i < gp->n; i++)
        sum += log(transform_slope(&gp->transform, gp->y[i]));
    return sum;
}

/* One length scale, all starts; adopts the best. */
static bayesopt_status fit_isotropic(bayesopt_gp *gp, const size_t *isotropic_groups, size_t starts,
                                     double *posterior)
{
    struct fit fit;
    double theta[3];
    bayesopt_status status =
        fit_create(&fit, gp, (struct model){true, tight_variance}, isotropic_groups);
    if (status)
        return status;
    for (size_t s = 0; s < starts && !status; s++) {
        make_start(&fit, s, theta);
        status = climb(&fit, theta, gp->options.evaluations / 2 + 1);
    }
    *posterior = fit.best_value;
    if (!status && isfinite(fit.best_value))
        adopt(&fit);
    gp->evaluations += fit.evaluations;
    fit_free(&fit);
    return status;
}

/* Fits one length scale under a transform. value: log posterior of the caller's outputs; square:
 * loo_score_error(). */
static bayesopt_status try_transform(bayesopt_gp *gp, bayesopt_transform kind,
                                     const size_t *isotropic_groups, size_t starts, double *value,
                                     double *square)
{
    bayesopt_status status = set_transform(gp, kind);
    if (!status)
        status = fit_isotropic(gp, isotropic_groups, starts, value);
    if (status)
        return status;
    *value += log_jacobian(gp);
    *square = loo_score_error(gp);
    return BAYESOPT_OK;
}

/* The transform under which the data are most likely, if it gains more than 2 over leaving them
 * alone and predicts better too: a transform can make outputs look normal and yet hide the
 * structure (a quadratic, say) by which they are predicted. Judged with one length scale. Ranks and
 * winsorising have no density to compare; as they hide most they must halve the error. */
static bayesopt_status choose_transform(bayesopt_gp *gp, const size_t *isotropic_groups)
{
    static const struct {
        bayesopt_transform kind;
        bool density;
    } others[] = {{BAYESOPT_TRANSFORM_LOG, true},
                  {BAYESOPT_TRANSFORM_YEO_JOHNSON, true},
                  {BAYESOPT_TRANSFORM_WINSORISED, false},
                  {BAYESOPT_TRANSFORM_RANK, false}};
    bayesopt_transform best = BAYESOPT_TRANSFORM_NONE;
    double value, square, least;
    bayesopt_status status =
        try_transform(gp, best, isotropic_groups, gp->options.starts, &value, &least);
    if (status)
        return status;
    double most = value + 2, scale = gp->lengthscale[0];
    struct bayesopt_gp kept = *gp;
    for (size_t i = 0; i < sizeof others / sizeof *others && !status && gp->n > 4; i++) {
        bool density = others[i].density;
        status = try_transform(gp, others[i].kind, isotropic_groups, 2, &value, &square);
        if (status || (density ? value <= most || square >= least : square >= 0.5 * least))
            continue;
        most = density ? value : most;
        least = square;
        best = others[i].kind;
        kept = *gp;
        scale = gp->lengthscale[0];
    }
    if (!status)
        status = set_transform(gp, best);
    for (size_t j = 0; j < gp->d; j++)
        gp->lengthscale[j] = scale;
    gp->signal = kept.signal;
    gp->noise = kept.noise;
    gp->log_posterior = kept.log_posterior;
    return status;
}

static bayesopt_status fit_warm(bayesopt_gp *gp, const size_t *isotropic_groups)
{
    struct fit fit;
    double theta[MOST_PARAMETERS];
    double variance = !isnan(gp->options.prior_variance) ? gp->options.prior_variance
                      : gp->wide && !gp->isotropic       ? wide_variance
                                                         : tight_variance;
    struct model model = {gp->isotropic && gp->d > 1, variance};
    bayesopt_status status = fit_create(&fit, gp, model, isotropic_groups);
    if (status)
        return status;
    pack(&fit, theta);
    status = climb(&fit, theta, gp->options.evaluations / 3 + 1);
    if (!status && isfinite(fit.best_value))
        adopt(&fit);
    gp->evaluations = fit.evaluations;
    fit_free(&fit);
    return status;
}

/* One of the models compared, from the isotropic optimum the regression holds at present. */
static bayesopt_status fit_model(bayesopt_gp *gp, struct model model,
                                 const size_t *isotropic_groups, bool compare, double *score)
{
    struct fit fit;
    double theta[MOST_PARAMETERS];
    bayesopt_status status = fit_create(&fit, gp, model, isotropic_groups);
    if (status)
        return status;
    pack(&fit, theta);
    status = climb(&fit, theta, gp->options.evaluations);
    *score = -INFINITY;
    if (!status && isfinite(fit.best_value)) {
        *score = fit.best_value;
        if (compare && gp->options.choice == BAYESOPT_CHOICE_POSTERIOR)
            *score = log_evidence(&fit);
        adopt(&fit);
        if (compare && gp->options.choice == BAYESOPT_CHOICE_LOO)
            *score = loo_density(gp);
    }
    gp->evaluations += fit.evaluations;
    fit_free(&fit);
    return status;
}

/* Scalars and length scales of a regression, to return to. */
static void copy_parameters(const bayesopt_gp *from, const double *lengthscale, bayesopt_gp *to)
{
    memcpy(to->lengthscale, lengthscale, to->d * sizeof *lengthscale);
    to->signal = from->signal;
    to->noise = from->noise;
    to->isotropic = from->isotropic;
    to->wide = from->wide;
    to->log_posterior = from->log_posterior;
}

static bayesopt_status compare_models(bayesopt_gp *gp, const size_t *isotropic_groups)
{
    struct model models[3];
    size_t count = list_models(gp, models), d = gp->d;
    double most = -INFINITY, score;
    struct bayesopt_gp start = *gp, best = *gp;
    double *scales = malloc(2 * d * sizeof *scales);
    if (!scales)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    memcpy(scales, gp->lengthscale, d * sizeof *scales);
    memcpy(scales + d, gp->lengthscale, d * sizeof *scales);
    bayesopt_status status = BAYESOPT_OK;
    for (size_t m = 0; m < count && !status; m++) {
        copy_parameters(&start, scales, gp);
        status = fit_model(gp, models[m], isotropic_groups, count > 1, &score);
        if (!status && score > most) {
            most = score;
            best = *gp;
            memcpy(scales + d, gp->lengthscale, d * sizeof *scales);
        }
    }
    copy_parameters(&best, scales + d, gp);
    free(scales);
    return status;
}

static bayesopt_status fit_cold_here(bayesopt_gp *gp, const size_t *isotropic_groups)
{
    double posterior;
    bayesopt_status status;
    gp->evaluations = 0;
    if (gp->options.transform == BAYESOPT_TRANSFORM_AUTO)
        status = choose_transform(gp, isotropic_groups);
    else
        status = fit_isotropic(gp, isotropic_groups, gp->options.starts, &posterior);
    if (!status && gp->has_parameters)
        status = compare_models(gp, isotropic_groups);
    return status;
}

/* With many data the starts and the choice between models use an even selection of them: which mode
 * is the right one shows on a few hundred, and the full set then only refines it. */
static bayesopt_status fit_cold(bayesopt_gp *gp, const size_t *isotropic_groups)
{
    enum { MOST_COLD = 256 };
    if (gp->n <= MOST_COLD)
        return fit_cold_here(gp, isotropic_groups);
    bayesopt_gp_options options = gp->options;
    bayesopt_gp *part = NULL;
    size_t d = gp->d;
    double *x = malloc(MOST_COLD * (d + 2) * sizeof *x);
    if (!x)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    double *y = x + MOST_COLD * d, *variance = y + MOST_COLD;
    for (size_t k = 0; k < MOST_COLD; k++) {
        size_t i = k * gp->n / MOST_COLD;
        memcpy(x + k * d, gp->x + i * d, d * sizeof *x);
        y[k] = gp->y[i];
        variance[k] = gp->variance[i];
    }
    options.group = gp->group;
    options.categorical = gp->categorical;
    bayesopt_status status = bayesopt_gp_create(d, &options, &part);
    if (!status) {
        part->is_cancelled = gp->is_cancelled;
        part->cancel_data = gp->cancel_data;
    }
    if (!status)
        status = bayesopt_gp_set_data(part, MOST_COLD, x, y, variance);
    if (!status)
        status = bayesopt_gp_fit(part);
    if (!status)
        status = set_transform(gp, part->transform.kind);
    if (!status) {
        copy_parameters(part, part->lengthscale, gp);
        gp->has_parameters = true;
        status = fit_warm(gp, isotropic_groups);
    }
    bayesopt_gp_free(part);
    free(x);
    return status;
}

/* Parameters that always condition: scales of half the box diagonal and much noise. */
static void fall_back(bayesopt_gp *gp)
{
    for (size_t j = 0; j < gp->d; j++)
        gp->lengthscale[j] = 0.5 * sqrt((double)gp->d);
    gp->signal = 1;
    gp->noise = 1e-4;
    gp->has_parameters = true;
}

bayesopt_status bayesopt_gp_fit(bayesopt_gp *gp)
{
    NEED(gp);
    if (!gp->n)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "gp: fit without data");
    THREADS((int)gp->options.threads);
    size_t *isotropic_groups = calloc(gp->d, sizeof *isotropic_groups);
    if (!isotropic_groups)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    if (gp->options.scales != BAYESOPT_SCALES_TIED)
        for (size_t j = 0; j < gp->d; j++)
            gp->group[j] = j;
    bayesopt_transform kind = gp->options.transform;
    if (kind == BAYESOPT_TRANSFORM_AUTO) /* a warm fit keeps the kind, not its numbers */
        kind = gp->has_parameters ? gp->transform.kind : BAYESOPT_TRANSFORM_NONE;
    bayesopt_status status = set_transform(gp, kind);
    if (!status)
        status =
            gp->has_parameters ? fit_warm(gp, isotropic_groups) : fit_cold(gp, isotropic_groups);
    free(isotropic_groups);
    if (status)
        return status;
    if (!gp->has_parameters || !gp_condition(gp)) {
        fall_back(gp);
        if (!gp_condition(gp))
            return bayesopt_fail(BAYESOPT_ERROR_NUMERIC, "gp: %zu points cannot be conditioned on",
                                 gp->n);
    }
    return BAYESOPT_OK;
}
