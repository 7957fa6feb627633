#include "problem/surrogate.h"

#include "core/error.h"
#include "gp/gp_internal.h"
#include "problem/internal.h"
#include "problem/label.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Numbers of a state beside its length scales. */
enum { HEAD = 7 };

bool surrogates_create(struct surrogates *s, size_t d, size_t n_constraints)
{
    s->count = n_constraints + 2;
    s->states = calloc(s->count + 1, sizeof *s->states);
    s->gps = calloc(s->count, sizeof *s->gps);
    double *scales = calloc((s->count + 1) * d, sizeof *scales);
    if (!s->states || !s->gps || !scales) {
        free(scales);
        return false;
    }
    for (size_t i = 0; i <= s->count; i++)
        s->states[i].lengthscale = scales + i * d;
    return true;
}

void surrogates_free(struct surrogates *s)
{
    for (size_t i = 0; s->gps && i < s->count; i++)
        bayesopt_gp_free(s->gps[i]);
    bayesopt_gp_free(s->cheap);
    if (s->states)
        free(s->states[0].lengthscale);
    free(s->states);
    free(s->gps);
}

size_t surrogates_state_size(const struct surrogates *s, size_t d)
{
    return (s->count + 1) * (HEAD + d);
}

void surrogates_save(const struct surrogates *s, size_t d, double *values)
{
    for (size_t i = 0; i <= s->count; i++, values += HEAD + d) {
        const struct model_state *state = &s->states[i];
        double head[HEAD] = {state->known,  state->isotropic, state->wide,     state->cold_n,
                             state->signal, state->noise,     state->transform};
        memcpy(values, head, sizeof head);
        memcpy(values + HEAD, state->lengthscale, d * sizeof *values);
    }
}

bool surrogates_restore(struct surrogates *s, size_t d, const double *values)
{
    for (size_t i = 0; i <= s->count; i++)
        for (size_t j = 0; j < HEAD + d; j++) {
            double value = values[i * (HEAD + d) + j];
            if (!isfinite(value) ||
                (j == HEAD - 1 && !(value >= 0 && value <= BAYESOPT_TRANSFORM_AUTO)))
                return false;
        }
    for (size_t i = 0; i <= s->count; i++, values += HEAD + d) {
        struct model_state *state = &s->states[i];
        state->known = values[0] != 0;
        state->isotropic = values[1] != 0;
        state->wide = values[2] != 0;
        state->cold_n = values[3];
        state->signal = values[4];
        state->noise = values[5];
        state->transform = (bayesopt_transform)values[6];
        memcpy(state->lengthscale, values + HEAD, d * sizeof *values);
    }
    s->fitted = false;
    return true;
}

/* Data of one model, gathered from the history. */
struct sample {
    size_t n;
    double *x, *y, *variance;
    size_t *told; /* values whose mean y is */
};

static void sample_free(struct sample *sample)
{
    free(sample->x);
    free(sample->told);
}

static bool sample_create(struct sample *sample, size_t n, size_t d)
{
    sample->n = 0;
    sample->x = malloc((n ? n : 1) * (d + 2) * sizeof(double));
    sample->y = sample->x + n * d;
    sample->variance = sample->y + n;
    sample->told = malloc((n ? n : 1) * sizeof *sample->told);
    if (sample->x && sample->told)
        return true;
    sample_free(sample);
    return false;
}

/* Points closer than this in [0,1] units count as one; deterministic data keep their mean, which a
 * factorisation can bear. */
static const double coincident = 1e-9;

static double largest_difference(size_t d, const double *a, const double *b)
{
    double most = 0;
    for (size_t j = 0; j < d; j++)
        most = fmax(most, fabs(a[j] - b[j]));
    return most;
}

static void sample_add(struct sample *sample, size_t d, const double *u, double y, double variance)
{
    for (size_t i = 0; i < sample->n; i++) {
        if (variance == 0 && largest_difference(d, sample->x + i * d, u) < coincident) {
            sample->y[i] += (y - sample->y[i]) / (double)++sample->told[i];
            return;
        }
    }
    memcpy(sample->x + sample->n * d, u, d * sizeof *u);
    sample->y[sample->n] = y;
    sample->told[sample->n] = 1;
    sample->variance[sample->n++] = variance;
}

/* Values of the objective at one level, of a constraint (dear level), or labels. */
static void gather(const struct bayesopt *bo, size_t which, struct sample *sample)
{
    size_t labels = bo->surrogates.count - 1, cheap = bo->surrogates.count;
    bool merge = bo->options.noise == BAYESOPT_NOISE_DETERMINISTIC;
    int level = which == cheap ? 0 : (int)bo->options.n_levels - 1;
    for (size_t i = 0; i < bo->n_points; i++) {
        const struct point *p = &bo->points[i];
        double variance = merge ? 0 : fmax(p->variance, 1e-300);
        bool done = p->state == BAYESOPT_STATE_DONE;
        if (which == labels && point_judged(p))
            sample_add(sample, bo->d, p->u, done ? 1 : -1, 0);
        else if (which != labels && done && p->level == level)
            sample_add(sample, bo->d, p->u,
                       which == 0 || which == cheap ? p->f : p->constraints[which - 1], variance);
    }
}

/* Gradients enter as values a small step away along each variable (indirect gradient-enhanced
 * Kriging), for the best points first: f(x + h e_j) = f + h df/dx_j + O(h^2). */
enum { MOST_STEPS = 400 };
static const double gradient_step = 2e-3;

static void add_gradients(const struct bayesopt *bo, struct sample *sample)
{
    size_t d = bo->d, added = 0;
    double last = -INFINITY, slope[BAYESOPT_MOST_VARIABLES];
    while (added + d <= MOST_STEPS) {
        const struct point *next = NULL;
        for (size_t i = 0; i < bo->n_points; i++) {
            const struct point *p = &bo->points[i];
            if (point_counts(bo, p) && p->gradient && p->f > last && (!next || p->f < next->f))
                next = p;
        }
        if (!next)
            return;
        last = next->f;
        problem_unit_slope(bo, next->x, slope);
        for (size_t j = 0; j < d; j++, added++) {
            if (problem_is_discrete(bo, j))
                continue;
            double *at = sample->x + sample->n * d;
            double step = next->u[j] < 0.5 ? gradient_step : -gradient_step;
            memcpy(at, next->u, d * sizeof *at);
            at[j] += step;
            sample->y[sample->n] = next->f + problem_sign(bo) * step * slope[j] * next->gradient[j];
            sample->variance[sample->n++] = fmax(next->variance, 1e-300);
        }
    }
}

static void model_options(const struct bayesopt *bo, size_t which, bayesopt_gp_options *o)
{
    bayesopt_gp_options_init(o);
    o->seed = random_hash(bo->options.seed) + which;
    o->kernel = bo->options.kernel;
    o->scales = bo->options.scales;
    o->group = bo->group;
    o->choice = bo->options.choice;
    o->categorical = bo->categorical;
    o->threads = bo->options.threads;
    bool objective = which == 0;
    for (size_t k = 1; k < bo->options.n_objectives; k++)
        objective = objective || which == objective_model(bo, k);
    if (objective || which == bo->surrogates.count) {
        o->noise = bo->options.noise;
        o->mean = bo->options.mean;
        /* Two levels are added up, in units of the objective. */
        o->transform = bo->options.n_levels == 1 ? bo->options.transform : BAYESOPT_TRANSFORM_NONE;
    } else if (bo->options.noise != BAYESOPT_NOISE_DETERMINISTIC) {
        o->noise = BAYESOPT_NOISE_LEARNED;
    }
}

static bool is_cold(const struct model_state *state, size_t n)
{
    return !state->known || (double)n >= 1.2 * state->cold_n;
}

static bayesopt_status fit_labels(struct bayesopt *bo, size_t which, const struct sample *sample,
                                  bool keep)
{
    THREADS((int)bo->options.threads);
    struct model_state *state = &bo->surrogates.states[which];
    bool cold = is_cold(state, sample->n);
    double lengthscale = state->lengthscale[0];
    bayesopt_status status = label_fit(sample->n, bo->d, bo->categorical, sample->x, sample->y,
                                       cold, &lengthscale, &bo->surrogates.gps[which]);
    if (!status && keep && cold) {
        state->known = true;
        state->cold_n = (double)sample->n;
        state->lengthscale[0] = lengthscale;
    }
    return status;
}

static bool is_cancelled(void *user_data)
{
    return ask_is_cancelled(user_data);
}

/* A cold fit whenever the data have grown by a fifth; in between the last one is refined. */
static bayesopt_status fit_one(struct bayesopt *bo, size_t which, const struct sample *sample,
                               bool keep)
{
    struct model_state *state = &bo->surrogates.states[which];
    struct surrogates *s = &bo->surrogates;
    bayesopt_gp **gp = which == s->count ? &s->cheap : &s->gps[which];
    bayesopt_gp_options options;
    bayesopt_status status = BAYESOPT_OK;
    if (!*gp) {
        model_options(bo, which, &options);
        status = bayesopt_gp_create(bo->d, &options, gp);
        if (status)
            return status;
    }
    (*gp)->is_cancelled = is_cancelled;
    (*gp)->cancel_data = bo;
    bayesopt_gp_forget(*gp);
    bool cold = is_cold(state, sample->n);
    if (!cold) {
        memcpy((*gp)->lengthscale, state->lengthscale, bo->d * sizeof(double));
        (*gp)->signal = state->signal;
        (*gp)->noise = state->noise;
        (*gp)->isotropic = state->isotropic;
        (*gp)->wide = state->wide;
        (*gp)->transform.kind = state->transform;
        (*gp)->has_parameters = true;
    }
    status = bayesopt_gp_set_data(*gp, sample->n, sample->x, sample->y, sample->variance);
    if (!status)
        status = bayesopt_gp_fit(*gp);
    if (status || !keep)
        return status;
    if (cold)
        state->cold_n = (double)sample->n;
    memcpy(state->lengthscale, (*gp)->lengthscale, bo->d * sizeof(double));
    state->signal = (*gp)->signal;
    state->noise = (*gp)->noise;
    state->isotropic = (*gp)->isotropic;
    state->wide = (*gp)->wide;
    state->transform = (*gp)->transform.kind;
    state->known = true;
    return status;
}

/* Takes the part along a unit vector out of another. */
static void remove_along(size_t n, const double *unit, double *from)
{
    double along = 0;
    for (size_t i = 0; i < n; i++)
        along += unit[i] * from[i];
    for (size_t i = 0; i < n; i++)
        from[i] -= along * unit[i];
}

static void scale_to_unit(size_t n, double *vector)
{
    double square = 0;
    for (size_t i = 0; i < n; i++)
        square += vector[i] * vector[i];
    for (size_t i = 0; i < n && square > 0; i++)
        vector[i] /= sqrt(square);
}

/* Least-squares factor of the cheap values in the dear ones beside a constant and, with points to
 * spare, a slope in every variable: levels often differ by a tilt. work [n (d + 3)]. */
static double estimate_share(size_t n, size_t d, const double *x, const double *low,
                             const double *high, double *work)
{
    size_t columns = n > d + 3 ? d + 1 : 1;
    double *a = work, *b = a + n, *basis = b + n, before = 0, square = 0, cross = 0;
    if (n <= 2)
        return 1;
    memcpy(a, low, n * sizeof *a);
    memcpy(b, high, n * sizeof *b);
    for (size_t c = 0; c < columns; c++) {
        double *column = basis + c * n;
        for (size_t i = 0; i < n; i++)
            column[i] = c ? x[i * d + c - 1] : 1;
        for (size_t k = 0; k < c; k++)
            remove_along(n, basis + k * n, column);
        scale_to_unit(n, column);
        remove_along(n, column, a);
        remove_along(n, column, b);
        for (size_t i = 0; i < n && c == 0; i++)
            before += a[i] * a[i];
    }
    for (size_t i = 0; i < n; i++) {
        square += a[i] * a[i];
        cross += a[i] * b[i];
    }
    return square > 1e-6 * before ? cross / square : 1;
}

/* The cheap level first; then the share, and the dear values of the sample become differences. */
static bayesopt_status subtract_cheap(struct bayesopt *bo, struct sample *sample, bool keep)
{
    struct surrogates *s = &bo->surrogates;
    struct sample cheap;
    if (!sample_create(&cheap, bo->n_points, bo->d))
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    gather(bo, s->count, &cheap);
    bayesopt_status status = cheap.n ? fit_one(bo, s->count, &cheap, keep) : BAYESOPT_OK;
    sample_free(&cheap);
    if (status || !s->cheap || !sample->n)
        return status;
    double *low = malloc(sample->n * (bo->d + 4) * sizeof *low);
    if (!low)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    status = bayesopt_gp_predict(s->cheap, sample->n, sample->x, low, NULL);
    for (size_t i = 0; i < sample->n; i++)
        low[i] = bayesopt_gp_from_model(s->cheap, low[i]);
    s->share = estimate_share(sample->n, bo->d, sample->x, low, sample->y, low + sample->n);
    for (size_t i = 0; i < sample->n; i++)
        sample->y[i] -= s->share * low[i];
    free(low);
    return status;
}

static bayesopt_status fit_which(struct bayesopt *bo, size_t which, bool keep)
{
    struct sample sample;
    bayesopt_status status = BAYESOPT_OK;
    if (!sample_create(&sample, bo->n_points + MOST_STEPS, bo->d))
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    gather(bo, which, &sample);
    if (which == 0 && bo->options.n_levels == 1)
        add_gradients(bo, &sample);
    if (which == 0 && bo->options.n_levels == 2)
        status = subtract_cheap(bo, &sample, keep);
    if (!status && sample.n && which == bo->surrogates.count - 1)
        status = fit_labels(bo, which, &sample, keep);
    else if (!status && sample.n)
        status = fit_one(bo, which, &sample, keep);
    sample_free(&sample);
    return status;
}

bayesopt_status surrogates_fit(struct bayesopt *bo, bool keep)
{
    struct surrogates *s = &bo->surrogates;
    bayesopt_status status = BAYESOPT_OK;
    size_t failed = history_count_state(bo, BAYESOPT_STATE_FAILED);
    s->fitted = false;
    bayesopt_gp_free(s->cheap);
    s->cheap = NULL;
    for (size_t which = 0; which < s->count && !status; which++) {
        bayesopt_gp_free(s->gps[which]);
        s->gps[which] = NULL;
        if (which + 1 < s->count || failed)
            status = fit_which(bo, which, keep);
    }
    s->fitted = !status && s->gps[0] != NULL;
    return status;
}

/* What one modelled unit of the cheap level is in units of the difference's model. */
static double cheap_factor(const struct surrogates *s)
{
    return s->share * s->cheap->transform.scale / s->gps[0]->transform.scale;
}

static double cheap_offset(const struct surrogates *s)
{
    return s->share * s->cheap->transform.offset / s->gps[0]->transform.scale;
}

bayesopt_status surrogates_predict(const struct bayesopt *bo, size_t n, const double *x,
                                   double *mean, double *var)
{
    const struct surrogates *s = &bo->surrogates;
    bayesopt_status status = bayesopt_gp_predict(s->gps[0], n, x, mean, var);
    if (status || !s->cheap)
        return status;
    double *low = malloc(2 * (n ? n : 1) * sizeof *low), factor = cheap_factor(s);
    if (!low)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    status = bayesopt_gp_predict(s->cheap, n, x, low, var ? low + n : NULL);
    for (size_t i = 0; i < n && !status; i++) {
        mean[i] += cheap_offset(s) + factor * low[i];
        if (var)
            var[i] += factor * factor * low[n + i];
    }
    free(low);
    return status;
}

bayesopt_status surrogates_predict_gradient(const struct bayesopt *bo, const double *x,
                                            double *mean, double *var, double *dmean, double *dvar,
                                            double *work)
{
    const struct surrogates *s = &bo->surrogates;
    bayesopt_status status =
        bayesopt_gp_predict_gradient(s->gps[0], x, mean, var, dmean, dvar, work);
    if (status || !s->cheap)
        return status;
    double low, low_var, factor = cheap_factor(s), dlow[BAYESOPT_MOST_VARIABLES],
                         dlow_var[BAYESOPT_MOST_VARIABLES];
    status = bayesopt_gp_predict_gradient(s->cheap, x, &low, &low_var, dlow, dlow_var, work);
    *mean += cheap_offset(s) + factor * low;
    *var += factor * factor * low_var;
    for (size_t j = 0; j < bo->d; j++) {
        dmean[j] += factor * dlow[j];
        dvar[j] += factor * factor * dlow_var[j];
    }
    return status;
}

size_t surrogates_work_size(const struct bayesopt *bo)
{
    const struct surrogates *s = &bo->surrogates;
    size_t most = s->cheap ? s->cheap->n : 0;
    for (size_t g = 0; g < s->count; g++)
        most = s->gps[g] && s->gps[g]->n > most ? s->gps[g]->n : most;
    return 2 * most;
}

bayesopt_status surrogates_cheap_share(const struct bayesopt *bo, const double *x, double *share)
{
    const struct surrogates *s = &bo->surrogates;
    double mean, low, total;
    *share = 0;
    if (!s->cheap || !s->gps[0])
        return BAYESOPT_OK;
    bayesopt_status status = surrogates_predict(bo, 1, x, &mean, &total);
    if (!status)
        status = bayesopt_gp_predict(s->cheap, 1, x, &mean, &low);
    if (!status && total > 0)
        *share = cheap_factor(s) * cheap_factor(s) * low / total;
    return status;
}

/* Pooled over the points with several values: sum of squares about their means over n - points. */
double surrogates_repeat_deviation(const struct bayesopt *bo)
{
    double square = 0;
    size_t freedom = 0;
    for (size_t i = 0; i < bo->n_points; i++) {
        double mean = 0, sum = 0;
        size_t n = 0;
        for (size_t k = 0; k < bo->n_points; k++) {
            const struct point *p = &bo->points[k];
            if (!point_counts(bo, p) || !point_counts(bo, &bo->points[i]) ||
                largest_difference(bo->d, p->u, bo->points[i].u) >= coincident)
                continue;
            if (k < i) { /* counted with the first of them */
                n = 0;
                break;
            }
            double step = p->f - mean;
            mean += step / (double)++n;
            sum += step * (p->f - mean);
        }
        if (n > 1) {
            square += sum;
            freedom += n - 1;
        }
    }
    return freedom ? sqrt(square / (double)freedom) : NAN;
}
