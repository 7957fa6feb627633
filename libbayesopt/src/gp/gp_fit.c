/* The choice between transforms and models of a regression, each at its most likely
 * hyper-parameters. */
#include "core/error.h"
#include "gp/gp_search.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double log_2pi = 1.8378770664093454836;

static bayesopt_status no_memory(void)
{
    return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
}

/* Leave-one-out means [n] and variances [n], to be freed; *mean NULL where there are none. */
static bayesopt_status predict_left_out(bayesopt_gp *gp, double **mean)
{
    *mean = malloc(2 * gp->n * sizeof **mean);
    if (!*mean)
        return no_memory();
    bayesopt_status status =
        gp_condition(gp) ? bayesopt_gp_loo(gp, *mean, *mean + gp->n) : BAYESOPT_ERROR_NUMERIC;
    if (status) {
        free(*mean);
        *mean = NULL;
    }
    return status == BAYESOPT_ERROR_MEMORY ? status : BAYESOPT_OK;
}

/* Leave-one-out log predictive density, Rasmussen and Williams eq. 5.10; -INFINITY: none. */
static bayesopt_status loo_density(bayesopt_gp *gp, double *density)
{
    double *mean, sum = 0;
    bayesopt_status status = predict_left_out(gp, &mean);
    for (size_t i = 0; mean && i < gp->n; i++) {
        double var = mean[gp->n + i], error = gp->t[i] - mean[i];
        sum -= 0.5 * (log(var) + error * error / var + log_2pi);
    }
    *density = mean ? sum : -INFINITY;
    free(mean);
    return status;
}

/* Mean square of the leave-one-out errors in normal scores of the ranks, a scale that does not
 * depend on the transform in use; INFINITY: none. */
static bayesopt_status loo_score_error(bayesopt_gp *gp, double *error_square)
{
    struct transform ranks;
    double *mean, square = 0;
    *error_square = INFINITY;
    bayesopt_status status = predict_left_out(gp, &mean);
    if (!mean)
        return status;
    transform_reset(&ranks);
    if (!transform_estimate(&ranks, BAYESOPT_TRANSFORM_RANK, gp->n, gp->y)) {
        free(mean);
        return no_memory();
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
    if (!isnan(square))
        *error_square = square;
    return BAYESOPT_OK;
}

static size_t list_models(const bayesopt_gp *gp, struct gp_model *models)
{
    const bayesopt_gp_options *o = &gp->options;
    size_t count = 0;
    if (gp->d > 1 && (o->scales == BAYESOPT_SCALES_AUTO || o->scales == BAYESOPT_SCALES_ISOTROPIC))
        models[count++] = (struct gp_model){true, gp_tight_variance};
    if (gp->d > 1 && o->scales == BAYESOPT_SCALES_ISOTROPIC)
        return count;
    if (!isnan(o->prior_variance)) {
        models[count++] = (struct gp_model){false, o->prior_variance};
        return count;
    }
    models[count++] = (struct gp_model){false, gp_tight_variance};
    if (gp->d > 1)
        models[count++] = (struct gp_model){false, gp_wide_variance};
    return count;
}

static bayesopt_status set_transform(bayesopt_gp *gp, bayesopt_transform kind)
{
    if (!transform_estimate(&gp->transform, kind, gp->n, gp->y))
        return no_memory();
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
    struct gp_search fit;
    double theta[3];
    bayesopt_status status =
        gp_search_create(&fit, gp, (struct gp_model){true, gp_tight_variance}, isotropic_groups);
    if (status)
        return status;
    for (size_t s = 0; s < starts && !status; s++) {
        gp_search_start(&fit, s, theta);
        status = gp_search_climb(&fit, theta, gp->options.evaluations / 2 + 1);
    }
    *posterior = fit.best_value;
    if (!status && isfinite(fit.best_value))
        gp_search_adopt(&fit);
    gp->evaluations += fit.evaluations;
    gp_search_free(&fit);
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
    return loo_score_error(gp, square);
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
    struct gp_search fit;
    double theta[GP_MOST_PARAMETERS];
    double variance = !isnan(gp->options.prior_variance) ? gp->options.prior_variance
                      : gp->wide && !gp->isotropic       ? gp_wide_variance
                                                         : gp_tight_variance;
    struct gp_model model = {gp->isotropic && gp->d > 1, variance};
    bayesopt_status status = gp_search_create(&fit, gp, model, isotropic_groups);
    if (status)
        return status;
    gp_search_pack(&fit, theta);
    status = gp_search_climb(&fit, theta, gp->options.evaluations / 3 + 1);
    if (!status && isfinite(fit.best_value))
        gp_search_adopt(&fit);
    gp->evaluations = fit.evaluations;
    gp_search_free(&fit);
    return status;
}

/* One of the models compared, from the isotropic optimum the regression holds at present. */
static bayesopt_status fit_model(bayesopt_gp *gp, struct gp_model model,
                                 const size_t *isotropic_groups, bool compare, double *score)
{
    struct gp_search fit;
    double theta[GP_MOST_PARAMETERS];
    bayesopt_status status = gp_search_create(&fit, gp, model, isotropic_groups);
    if (status)
        return status;
    gp_search_pack(&fit, theta);
    status = gp_search_climb(&fit, theta, gp->options.evaluations);
    *score = -INFINITY;
    if (!status && isfinite(fit.best_value)) {
        *score = fit.best_value;
        if (compare && gp->options.choice == BAYESOPT_CHOICE_POSTERIOR)
            status = gp_search_evidence(&fit, score);
        gp_search_adopt(&fit);
        if (!status && compare && gp->options.choice == BAYESOPT_CHOICE_LOO)
            status = loo_density(gp, score);
    }
    gp->evaluations += fit.evaluations;
    gp_search_free(&fit);
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
    struct gp_model models[3];
    size_t count = list_models(gp, models), d = gp->d;
    double most = -INFINITY, score;
    struct bayesopt_gp start = *gp, best = *gp;
    double *scales = malloc(2 * d * sizeof *scales);
    if (!scales)
        return no_memory();
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
        return no_memory();
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
        return no_memory();
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
