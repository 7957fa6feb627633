/* The regression object: options, data, conditioning. */
#include "core/error.h"
#include "core/matrix.h"
#include "gp/gp_internal.h"
#include "gp/kernel.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Starts of a fit, and likelihood evaluations of a start: more would never end. */
enum { MOST_SEARCH = 1000000 };

static const double log_2pi = 1.8378770664093454836;

const char *bayesopt_kernel_name(bayesopt_kernel kernel)
{
    static const char *const names[] = {"se", "matern32", "matern52"};
    return (unsigned)kernel < sizeof names / sizeof *names ? names[kernel] : "unknown";
}

const char *bayesopt_transform_name(bayesopt_transform transform)
{
    static const char *const names[] = {"none", "log", "yeo-johnson", "rank", "winsorised", "auto"};
    return (unsigned)transform < sizeof names / sizeof *names ? names[transform] : "unknown";
}

void bayesopt_gp_options_init(bayesopt_gp_options *options)
{
    if (!options)
        return;
    *options = (bayesopt_gp_options){
        .kernel = BAYESOPT_KERNEL_MATERN52,
        .scales = BAYESOPT_SCALES_ARD,
        .mean = BAYESOPT_MEAN_CONSTANT,
        .noise = BAYESOPT_NOISE_DETERMINISTIC,
        .transform = BAYESOPT_TRANSFORM_NONE,
        .choice = BAYESOPT_CHOICE_POSTERIOR,
        .prior_shift = 0,
        .prior_common = 1,
        .prior_variance = NAN,
        .starts = 3,
        .evaluations = 60,
        .seed = 1,
    };
}

static bayesopt_status check_options(size_t d, const bayesopt_gp_options *o)
{
    if (d < 1 || d > BAYESOPT_MOST_VARIABLES)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "gp: %zu variables, expected 1 to %d", d,
                             BAYESOPT_MOST_VARIABLES);
    if ((unsigned)o->kernel > BAYESOPT_KERNEL_MATERN52 ||
        (unsigned)o->scales > BAYESOPT_SCALES_AUTO || (unsigned)o->mean > BAYESOPT_MEAN_LINEAR ||
        (unsigned)o->noise > BAYESOPT_NOISE_LEARNED ||
        (unsigned)o->transform > BAYESOPT_TRANSFORM_AUTO ||
        (unsigned)o->choice > BAYESOPT_CHOICE_LOO)
        return bayesopt_fail(
            BAYESOPT_ERROR_ARGUMENT,
            "gp: an option is outside its list (kernel %d, scales %d, mean %d, noise "
            "%d, transform %d, choice %d)",
            (int)o->kernel, (int)o->scales, (int)o->mean, (int)o->noise, (int)o->transform,
            (int)o->choice);
    if (!isfinite(o->prior_shift) || !(o->prior_common > 0) || o->prior_variance <= 0)
        return bayesopt_fail(
            BAYESOPT_ERROR_ARGUMENT,
            "gp: prior shift %g, common variance %g, variance %g: expected finite, "
            "positive, positive or NAN",
            o->prior_shift, o->prior_common, o->prior_variance);
    if (!o->starts || !o->evaluations || o->starts > MOST_SEARCH || o->evaluations > MOST_SEARCH)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "gp: %zu starts of %zu evaluations, expected 1 to %d of each",
                             o->starts, o->evaluations, MOST_SEARCH);
    if (!threads_are(o->threads))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "gp: threads is %g, expected a whole number from 0 to %d", o->threads,
                             MOST_THREADS);
    for (size_t j = 0; j < d && o->categorical && o->mean == BAYESOPT_MEAN_LINEAR; j++)
        if (o->categorical[j])
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "gp: variable %zu is categorical, which has no slope for a linear "
                                 "mean",
                                 j);
    if (o->scales != BAYESOPT_SCALES_TIED)
        return BAYESOPT_OK;
    if (!o->group)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "gp: tied scales without groups");
    size_t groups = 0;
    for (size_t j = 0; j < d; j++) {
        if (o->group[j] > groups)
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "gp: group of variable %zu is %zu, expected at most %zu so that "
                                 "numbers have no gaps",
                                 j, o->group[j], groups);
        groups += o->group[j] == groups;
    }
    return BAYESOPT_OK;
}

bayesopt_status bayesopt_gp_create(size_t d, const bayesopt_gp_options *options, bayesopt_gp **out)
{
    NEED(out);
    bayesopt_gp_options defaults;
    if (!options) {
        bayesopt_gp_options_init(&defaults);
        options = &defaults;
    }
    bayesopt_status status = check_options(d, options);
    if (status)
        return status;
    bayesopt_gp *gp = calloc(1, sizeof *gp);
    if (!gp)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    gp->d = d;
    gp->options = *options;
    gp->options.group = NULL;
    gp->options.categorical = NULL;
    transform_reset(&gp->transform);
    gp->lengthscale = calloc(d, sizeof *gp->lengthscale);
    gp->gram = calloc((d + 1) * (d + 1), sizeof *gp->gram);
    gp->beta = calloc(d + 1, sizeof *gp->beta);
    gp->group = calloc(d, sizeof *gp->group);
    if (options->categorical) {
        gp->categorical = calloc(d, sizeof *gp->categorical);
        gp->jump = calloc(d, sizeof *gp->jump);
    }
    if (!gp->lengthscale || !gp->gram || !gp->beta || !gp->group ||
        (options->categorical && (!gp->categorical || !gp->jump))) {
        bayesopt_gp_free(gp);
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    }
    if (options->categorical)
        memcpy(gp->categorical, options->categorical, d * sizeof *gp->categorical);
    if (options->scales == BAYESOPT_SCALES_TIED)
        memcpy(gp->group, options->group, d * sizeof *gp->group);
    *out = gp;
    return BAYESOPT_OK;
}

void bayesopt_gp_free(bayesopt_gp *gp)
{
    if (!gp)
        return;
    transform_free(&gp->transform);
    double *arrays[] = {gp->lengthscale, gp->gram,   gp->beta, gp->x,     gp->y,
                        gp->variance,    gp->scaled, gp->t,    gp->alpha, gp->factor,
                        gp->solved,      gp->basis,  gp->jump};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        free(arrays[i]);
    free(gp->group);
    free(gp->categorical);
    free(gp);
}

static bool grow(double **array, size_t count)
{
    double *more = realloc(*array, count * sizeof **array);
    if (more)
        *array = more;
    return more != NULL;
}

bayesopt_status gp_reserve(struct bayesopt_gp *gp, size_t n)
{
    if (n <= gp->capacity)
        return BAYESOPT_OK;
    /* Rows keep their length while points are appended, so grow in steps; a multiple of 8 keeps
     * rows on cache lines. */
    size_t capacity = (n + n / 8 + 8) / 8 * 8, d = gp->d, old = gp->capacity;
    bool ok = grow(&gp->x, capacity * d) && grow(&gp->y, capacity) &&
              grow(&gp->variance, capacity) && grow(&gp->t, capacity) &&
              grow(&gp->alpha, capacity) && grow(&gp->solved, capacity * (d + 1)) &&
              grow(&gp->basis, capacity * (d + 1));
    double *factor = ok ? malloc(capacity * capacity * sizeof *factor) : NULL;
    double *scaled = ok ? malloc(capacity * d * sizeof *scaled) : NULL;
    if (!factor || !scaled) {
        free(factor);
        free(scaled);
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: no memory for %zu points", n);
    }
    if (gp->conditioned) {
        for (size_t i = 0; i < gp->n; i++)
            memcpy(factor + i * capacity, gp->factor + i * old, (i + 1) * sizeof *factor);
        for (size_t j = 0; j < d; j++)
            memcpy(scaled + j * capacity, gp->scaled + j * old, gp->n * sizeof *scaled);
    }
    free(gp->factor);
    free(gp->scaled);
    gp->factor = factor;
    gp->scaled = scaled;
    gp->capacity = capacity;
    return BAYESOPT_OK;
}

static bayesopt_status check_data(const bayesopt_gp *gp, size_t n, const double *x, const double *y,
                                  const double *variance)
{
    if (gp->options.noise == BAYESOPT_NOISE_KNOWN && !variance)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "gp: known noise without variances");
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(y[i]))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "gp: output %zu is %g, expected finite",
                                 i, y[i]);
        if (variance && !(variance[i] >= 0 && isfinite(variance[i])))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "gp: variance %zu is %g, expected finite and not negative", i,
                                 variance[i]);
        for (size_t j = 0; j < gp->d; j++)
            if (!isfinite(x[i * gp->d + j]))
                return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                     "gp: variable %zu of point %zu is %g, expected finite", j, i,
                                     x[i * gp->d + j]);
    }
    return BAYESOPT_OK;
}

static void copy_data(bayesopt_gp *gp, size_t at, size_t n, const double *x, const double *y,
                      const double *variance)
{
    memcpy(gp->x + at * gp->d, x, n * gp->d * sizeof *x);
    memcpy(gp->y + at, y, n * sizeof *y);
    for (size_t i = 0; i < n; i++)
        gp->variance[at + i] =
            variance && gp->options.noise == BAYESOPT_NOISE_KNOWN ? variance[i] : 0;
}

bayesopt_status bayesopt_gp_set_data(bayesopt_gp *gp, size_t n, const double *x, const double *y,
                                     const double *variance)
{
    NEED(gp);
    NEED(x);
    NEED(y);
    NEED_MOST(n, BAYESOPT_MOST_POINTS);
    bayesopt_status status = check_data(gp, n, x, y, variance);
    gp->conditioned = status ? gp->conditioned : false;
    if (!status)
        status = gp_reserve(gp, n);
    if (status)
        return status;
    copy_data(gp, 0, n, x, y, variance);
    gp->n = n;
    return BAYESOPT_OK;
}

double gp_noise(const struct bayesopt_gp *gp, size_t i, double noise)
{
    if (gp->options.noise != BAYESOPT_NOISE_KNOWN)
        return noise;
    double slope = transform_slope(&gp->transform, gp->y[i]);
    return noise + gp->variance[i] * slope * slope;
}

void gp_scale_inputs(struct bayesopt_gp *gp, const double *lengthscale)
{
    for (size_t j = 0; j < gp->d; j++) {
        bool categorical = gp->categorical && gp->categorical[j];
        double scale = categorical ? 1 : lengthscale[j];
        if (categorical)
            gp->jump[j] = 1 / (lengthscale[j] * lengthscale[j]);
        for (size_t i = 0; i < gp->n; i++)
            gp->scaled[j * gp->capacity + i] = gp->x[i * gp->d + j] / scale;
    }
}

double gp_scaled(const struct bayesopt_gp *gp, size_t j, double x)
{
    return gp->categorical && gp->categorical[j] ? x : x / gp->lengthscale[j];
}

void gp_covariance(const struct bayesopt_gp *gp, double signal, double *k, double *w)
{
    double point[BAYESOPT_MOST_VARIABLES];
    for (size_t i = 0; i < gp->n; i++) {
        for (size_t j = 0; j < gp->d; j++)
            point[j] = gp->scaled[j * gp->capacity + i];
        double *row = k + i * gp->capacity, *slope = w ? w + i * gp->capacity : NULL;
        kernel_distances(i + 1, gp->d, gp->scaled, gp->capacity, point, gp->jump, row);
        kernel_values(gp->options.kernel, i + 1, row, row, slope);
        matrix_scale(i + 1, signal, row);
        if (slope)
            matrix_scale(i + 1, signal, slope);
    }
}

void gp_basis_row(const struct bayesopt_gp *gp, const double *x, double *row)
{
    if (gp->p)
        row[0] = 1;
    for (size_t c = 1; c < gp->p; c++)
        row[c] = x[c - 1];
}

/* GLS coefficients of the mean, alpha and the log likelihood from the factor. */
static bool condition_mean(struct bayesopt_gp *gp)
{
    size_t n = gp->n, p = gp->p, ld = gp->capacity;
    double logs = 0;
    for (size_t i = 0; i < n; i++)
        logs += log(gp->factor[i * ld + i]);
    double *rows = gp->basis; /* [n x p] until K^-1 H takes its place */
    for (size_t i = 0; i < n; i++)
        gp_basis_row(gp, gp->x + i * gp->d, rows + i * p);
    matrix_solve_lower(n, gp->factor, ld, p, rows, p);
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < p; c++)
            gp->solved[c * ld + i] = rows[i * p + c];

    double *residual = gp->alpha;
    double constant = p ? 0 : gp->fixed_mean;
    for (size_t i = 0; i < n; i++)
        residual[i] = gp->t[i] - constant;
    matrix_forward(n, gp->factor, ld, residual);
    if (p) {
        for (size_t a = 0; a < p; a++) {
            gp->beta[a] = matrix_dot(n, gp->solved + a * ld, residual);
            for (size_t b = 0; b <= a; b++)
                gp->gram[a * p + b] = matrix_dot(n, gp->solved + a * ld, gp->solved + b * ld);
        }
        if (!matrix_cholesky(p, gp->gram, p))
            return false;
        matrix_forward(p, gp->gram, p, gp->beta);
        matrix_backward(p, gp->gram, p, gp->beta);
        for (size_t c = 0; c < p; c++)
            matrix_axpy(n, -gp->beta[c], gp->solved + c * ld, residual);
    }
    gp->log_likelihood =
        -0.5 * matrix_dot(n, residual, residual) - logs - 0.5 * (double)n * log_2pi;
    matrix_backward(n, gp->factor, ld, residual);
    return isfinite(gp->log_likelihood);
}

/* K^-1 H, needed by gradients of the posterior. */
static void condition_basis(struct bayesopt_gp *gp)
{
    memcpy(gp->basis, gp->solved, gp->p * gp->capacity * sizeof *gp->basis);
    for (size_t c = 0; c < gp->p; c++)
        matrix_backward(gp->n, gp->factor, gp->capacity, gp->basis + c * gp->capacity);
}

static void choose_basis(struct bayesopt_gp *gp)
{
    gp->p = gp->options.mean == BAYESOPT_MEAN_FIXED ? 0 : 1;
    /* A slope needs more points than coefficients. */
    if (gp->options.mean == BAYESOPT_MEAN_LINEAR && gp->n > gp->d + 1)
        gp->p = gp->d + 1;
}

/* One rung of the ladder after the other until K + jitter I has a factor. */
static bool factorise(struct bayesopt_gp *gp, double signal, double noise, double largest,
                      double *w)
{
    double diagonal = signal;
    for (size_t i = 0; i < gp->n; i++)
        diagonal += gp_noise(gp, i, noise) / (double)gp->n;
    for (double relative = 0; relative <= largest;
         relative = relative > 0 ? 10 * relative : 1e-10) {
        gp->jitter = relative * diagonal;
        gp_covariance(gp, signal, gp->factor, relative > 0 ? NULL : w);
        for (size_t i = 0; i < gp->n; i++)
            gp->factor[i * gp->capacity + i] += gp_noise(gp, i, noise) + gp->jitter;
        if (matrix_cholesky(gp->n, gp->factor, gp->capacity))
            return true;
    }
    return false;
}

bool gp_condition(struct bayesopt_gp *gp)
{
    gp->conditioned = false;
    for (size_t i = 0; i < gp->n; i++)
        gp->t[i] = transform_apply(&gp->transform, gp->y[i]);
    gp_scale_inputs(gp, gp->lengthscale);
    choose_basis(gp);
    if (!factorise(gp, gp->signal, gp->noise, 1.01e-4, NULL))
        return false;
    if (!condition_mean(gp)) {
        /* The basis is rank deficient on these points. */
        gp->p = gp->p > 1 ? 1 : gp->p;
        if (!condition_mean(gp))
            return false;
    }
    condition_basis(gp);
    gp->conditioned = true;
    return true;
}

bool gp_scratch_create(struct gp_scratch *scratch, size_t capacity)
{
    scratch->inverse = malloc(2 * capacity * capacity * sizeof(double));
    scratch->w = scratch->inverse + capacity * capacity;
    return scratch->inverse != NULL;
}

void gp_scratch_free(struct gp_scratch *scratch)
{
    free(scratch->inverse);
}

/* Rasmussen and Williams eq. 5.9: d/dtheta = tr((alpha alpha' - K^-1) dK/dtheta)/2. */
bool gp_likelihood_gradient(const struct bayesopt_gp *gp, const struct gp_theta *theta,
                            struct gp_scratch *scratch, bool need_w, double *gradient)
{
    size_t n = gp->n, d = gp->d, ld = gp->capacity;
    double point[BAYESOPT_MOST_VARIABLES], fit = 0, trace = 0, residual = 0;
    if (need_w)
        gp_covariance(gp, theta->signal, scratch->inverse, scratch->w);
    if (!matrix_inverse(n, gp->factor, ld, scratch->inverse))
        return false;
    memset(gradient, 0, (d + 2) * sizeof *gradient);
    for (size_t i = 0; i < n; i++) {
        double *p = scratch->inverse + i * ld, inverse = p[i];
        const double *w = scratch->w + i * ld;
        for (size_t k = 0; k < i; k++)
            p[k] = (gp->alpha[i] * gp->alpha[k] - p[k]) * w[k];
        for (size_t j = 0; j < d; j++)
            point[j] = gp->scaled[j * ld + i];
        kernel_weighted_squares(i, d, gp->scaled, ld, point, gp->jump, p, gradient);
        /* alpha' K alpha = alpha' (t - m) and tr K^-1 K = n leave only the diagonal part of K. */
        double noise = gp_noise(gp, i, theta->noise) + gp->jitter;
        double mean = gp->p ? 0 : gp->fixed_mean;
        for (size_t c = 0; c < gp->p; c++)
            mean += gp->beta[c] * (c ? gp->x[i * d + c - 1] : 1);
        residual += gp->alpha[i] * (gp->t[i] - mean);
        fit += noise * (gp->alpha[i] * gp->alpha[i] - inverse);
        trace += gp->alpha[i] * gp->alpha[i] - inverse;
    }
    gradient[d] = 0.5 * (residual - (double)n - fit);
    gradient[d + 1] = 0.5 * theta->noise * trace;
    return true;
}

bool gp_likelihood(struct bayesopt_gp *gp, const struct gp_theta *theta, struct gp_scratch *scratch,
                   double *value, double *gradient)
{
    gp->conditioned = false;
    gp_scale_inputs(gp, theta->lengthscale);
    choose_basis(gp);
    double *w = gradient ? scratch->w : NULL;
    if (!factorise(gp, theta->signal, theta->noise, 1.01e-6, w) || !condition_mean(gp))
        return false;
    *value = gp->log_likelihood;
    return !gradient || gp_likelihood_gradient(gp, theta, scratch, false, gradient);
}

bayesopt_status bayesopt_gp_set_parameters(bayesopt_gp *gp,
                                           const bayesopt_gp_parameters *parameters)
{
    NEED(gp);
    NEED(parameters);
    NEED(parameters->lengthscale);
    for (size_t j = 0; j < gp->d; j++)
        if (!(parameters->lengthscale[j] > 0 && isfinite(parameters->lengthscale[j])))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "gp: length scale %zu is %g, expected positive", j,
                                 parameters->lengthscale[j]);
    if (!(parameters->signal > 0 && isfinite(parameters->signal)) ||
        !(parameters->noise >= 0 && isfinite(parameters->noise)) || !isfinite(parameters->mean))
        return bayesopt_fail(
            BAYESOPT_ERROR_ARGUMENT,
            "gp: signal %g, noise %g, mean %g: expected positive, not negative, finite",
            parameters->signal, parameters->noise, parameters->mean);
    THREADS((int)gp->options.threads);
    memcpy(gp->lengthscale, parameters->lengthscale, gp->d * sizeof *gp->lengthscale);
    gp->signal = parameters->signal;
    gp->noise = parameters->noise;
    gp->fixed_mean = parameters->mean;
    gp->has_parameters = true;
    transform_free(&gp->transform);
    if (!gp_condition(gp))
        return bayesopt_fail(
            BAYESOPT_ERROR_NUMERIC,
            "gp: the covariance of %zu points is not positive definite with a jitter "
            "of 1e-4",
            gp->n);
    gp->log_posterior = gp->log_likelihood;
    return BAYESOPT_OK;
}

/* A new row of the factor: l = L^-1 k, l_nn^2 = k_nn - l'l. false: too small a pivot to trust. */
static bool append_row(bayesopt_gp *gp, size_t i)
{
    size_t ld = gp->capacity;
    double *row = gp->factor + i * ld, point[BAYESOPT_MOST_VARIABLES];
    for (size_t j = 0; j < gp->d; j++)
        point[j] = gp->scaled[j * ld + i] = gp_scaled(gp, j, gp->x[i * gp->d + j]);
    kernel_distances(i, gp->d, gp->scaled, ld, point, gp->jump, row);
    kernel_values(gp->options.kernel, i, row, row, NULL);
    matrix_scale(i, gp->signal, row);
    matrix_forward(i, gp->factor, ld, row);
    double diagonal = gp->signal + gp_noise(gp, i, gp->noise) + gp->jitter;
    double pivot = diagonal - matrix_dot(i, row, row);
    row[i] = sqrt(fmax(pivot, 0));
    return pivot > 1e-10 * diagonal;
}

bayesopt_status bayesopt_gp_append(bayesopt_gp *gp, size_t n, const double *x, const double *y,
                                   const double *variance)
{
    NEED(gp);
    NEED(x);
    NEED(y);
    NEED_MOST(n, BAYESOPT_MOST_POINTS);
    if (!gp->conditioned)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "gp: append before the model has data and hyper-parameters");
    bayesopt_status status = check_data(gp, n, x, y, variance);
    if (!status)
        status = gp_reserve(gp, gp->n + n);
    if (status)
        return status;
    THREADS((int)gp->options.threads);
    copy_data(gp, gp->n, n, x, y, variance);
    bool ok = true;
    for (size_t i = gp->n; i < gp->n + n && ok; i++) {
        gp->t[i] = transform_apply(&gp->transform, gp->y[i]);
        ok = append_row(gp, i);
    }
    gp->n += n;
    ok = ok && condition_mean(gp);
    if (ok)
        condition_basis(gp);
    else
        ok = gp_condition(gp);
    return ok ? BAYESOPT_OK
              : bayesopt_fail(BAYESOPT_ERROR_NUMERIC,
                              "gp: the covariance of %zu points is not positive definite with a "
                              "jitter of 1e-4",
                              gp->n);
}

void bayesopt_gp_forget(bayesopt_gp *gp)
{
    if (!gp)
        return;
    gp->has_parameters = false;
    gp->conditioned = false;
}

bayesopt_status bayesopt_gp_get_parameters(const bayesopt_gp *gp,
                                           bayesopt_gp_parameters *parameters)
{
    NEED(gp);
    NEED(parameters);
    if (!gp->has_parameters)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "gp: no hyper-parameters yet");
    if (parameters->lengthscale)
        memcpy(parameters->lengthscale, gp->lengthscale, gp->d * sizeof *gp->lengthscale);
    parameters->signal = gp->signal;
    parameters->noise = gp->noise;
    parameters->mean = gp->p ? gp->beta[0] : gp->fixed_mean;
    return BAYESOPT_OK;
}

static bayesopt_status need_conditioning(const bayesopt_gp *gp)
{
    return gp->conditioned ? BAYESOPT_OK
                           : bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                           "gp: not conditioned, call bayesopt_gp_fit() or "
                                           "bayesopt_gp_set_parameters() after setting data");
}

bayesopt_status bayesopt_gp_get_info(const bayesopt_gp *gp, bayesopt_gp_info *info)
{
    NEED(gp);
    NEED(info);
    bayesopt_status status = need_conditioning(gp);
    if (status)
        return status;
    double mean = gp->p ? gp->beta[0] : gp->fixed_mean, diagonal = gp->signal;
    for (size_t i = 0; i < gp->n; i++)
        diagonal += gp_noise(gp, i, gp->noise) / (double)gp->n;
    *info = (bayesopt_gp_info){
        .n = gp->n,
        .isotropic = gp->isotropic,
        .wide = gp->wide,
        .transform = gp->transform.kind,
        .offset = gp->transform.offset,
        .scale = gp->transform.scale,
        .jitter = gp->jitter / diagonal,
        .log_likelihood = gp->log_likelihood,
        .log_posterior = gp->log_posterior,
        .mean = mean,
        .evaluations = gp->evaluations,
    };
    return BAYESOPT_OK;
}
