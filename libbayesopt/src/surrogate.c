#include "surrogate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "gp_internal.h"
#include "internal.h"
#include "label.h"

/* Numbers of a state beside its length scales. */
enum { HEAD = 7 };

bool surrogates_create(struct surrogates *s, size_t d, size_t n_constraints)
{
    s->count = n_constraints + 2;
    s->states = calloc(s->count, sizeof *s->states);
    s->gps = calloc(s->count, sizeof *s->gps);
    double *scales = calloc(s->count * d, sizeof *scales);
    if (!s->states || !s->gps || !scales) {
        free(scales);
        return false;
    }
    for (size_t i = 0; i < s->count; i++)
        s->states[i].lengthscale = scales + i * d;
    return true;
}

void surrogates_free(struct surrogates *s)
{
    for (size_t i = 0; s->gps && i < s->count; i++)
        bayesopt_gp_free(s->gps[i]);
    if (s->states)
        free(s->states[0].lengthscale);
    free(s->states);
    free(s->gps);
}

size_t surrogates_state_size(const struct surrogates *s, size_t d)
{
    return s->count * (HEAD + d);
}

void surrogates_save(const struct surrogates *s, size_t d, double *values)
{
    for (size_t i = 0; i < s->count; i++, values += HEAD + d) {
        const struct model_state *state = &s->states[i];
        double head[HEAD] = {state->known,  state->isotropic, state->wide,     state->cold_n,
                             state->signal, state->noise,     state->transform};
        memcpy(values, head, sizeof head);
        memcpy(values + HEAD, state->lengthscale, d * sizeof *values);
    }
}

void surrogates_restore(struct surrogates *s, size_t d, const double *values)
{
    for (size_t i = 0; i < s->count; i++, values += HEAD + d) {
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
}

/* Data of one model, gathered from the history. */
struct sample {
    size_t n;
    double *x, *y, *variance;
};

static bool sample_create(struct sample *sample, size_t n, size_t d)
{
    sample->n = 0;
    sample->x = malloc((n ? n : 1) * (d + 2) * sizeof(double));
    sample->y = sample->x + n * d;
    sample->variance = sample->y + n;
    return sample->x != NULL;
}

/* Points closer than this in [0,1] units count as one; deterministic data keep their mean, which a
 * factorisation can bear. */
static const double coincident = 1e-9;

static void sample_add(struct sample *sample, size_t d, const double *u, double y, double variance)
{
    for (size_t i = 0; i < sample->n; i++) {
        double most = 0;
        for (size_t j = 0; j < d; j++)
            most = fmax(most, fabs(sample->x[i * d + j] - u[j]));
        if (most < coincident && variance == 0) {
            sample->y[i] = 0.5 * sample->y[i] + 0.5 * y;
            return;
        }
    }
    memcpy(sample->x + sample->n * d, u, d * sizeof *u);
    sample->y[sample->n] = y;
    sample->variance[sample->n++] = variance;
}

static void gather(const struct bayesopt *bo, size_t which, struct sample *sample)
{
    bool merge = bo->options.noise == BAYESOPT_NOISE_DETERMINISTIC;
    for (size_t i = 0; i < bo->n_points; i++) {
        const struct point *p = &bo->points[i];
        double variance = merge ? 0 : fmax(p->variance, 1e-300);
        if (which == bo->options.n_constraints + 1) {
            if (p->state != BAYESOPT_STATE_PENDING)
                sample_add(sample, bo->d, p->u, p->state == BAYESOPT_STATE_DONE ? 1 : -1, 0);
        } else if (p->state == BAYESOPT_STATE_DONE) {
            sample_add(sample, bo->d, p->u, which ? p->constraints[which - 1] : p->f, variance);
        }
    }
}

static void model_options(const struct bayesopt *bo, size_t which, bayesopt_gp_options *o)
{
    bayesopt_gp_options_init(o);
    o->seed = random_hash(bo->options.seed) + which;
    o->kernel = bo->options.kernel;
    o->scales = bo->options.scales;
    if (which == 0) {
        o->noise = bo->options.noise;
        o->transform = bo->options.transform;
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
    struct model_state *state = &bo->surrogates.states[which];
    bool cold = is_cold(state, sample->n);
    double lengthscale = state->lengthscale[0];
    bayesopt_status status = label_fit(sample->n, bo->d, sample->x, sample->y, cold, &lengthscale,
                                       &bo->surrogates.gps[which]);
    if (!status && keep && cold) {
        state->known = true;
        state->cold_n = (double)sample->n;
        state->lengthscale[0] = lengthscale;
    }
    return status;
}

/* A cold fit whenever the data have grown by a fifth; in between the last one is refined. */
static bayesopt_status fit_one(struct bayesopt *bo, size_t which, const struct sample *sample,
                               bool keep)
{
    struct model_state *state = &bo->surrogates.states[which];
    bayesopt_gp **gp = &bo->surrogates.gps[which];
    bayesopt_gp_options options;
    bayesopt_status status = BAYESOPT_OK;
    if (!*gp) {
        model_options(bo, which, &options);
        status = bayesopt_gp_create(bo->d, &options, gp);
        if (status)
            return status;
    }
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

bayesopt_status surrogates_fit(struct bayesopt *bo, bool keep)
{
    struct surrogates *s = &bo->surrogates;
    bayesopt_status status = BAYESOPT_OK;
    size_t failed = history_count_state(bo, BAYESOPT_STATE_FAILED);
    s->fitted = false;
    for (size_t which = 0; which < s->count && !status; which++) {
        struct sample sample;
        bayesopt_gp_free(s->gps[which]);
        s->gps[which] = NULL;
        if (which == s->count - 1 && !failed)
            break;
        if (!sample_create(&sample, bo->n_points, bo->d))
            return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
        gather(bo, which, &sample);
        if (sample.n && which == s->count - 1)
            status = fit_labels(bo, which, &sample, keep);
        else if (sample.n)
            status = fit_one(bo, which, &sample, keep);
        free(sample.x);
    }
    s->fitted = !status && s->gps[0] != NULL;
    return status;
}
