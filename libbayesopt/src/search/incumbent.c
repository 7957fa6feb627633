/* What a proposal is to improve on: the best value, draws of it, or a front. */
#include "core/error.h"
#include "search/climber.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Whether a pending point is believed to satisfy the outcome constraints. */
static bool believed_feasible(const struct climber *c, const double *u)
{
    const struct surrogates *s = &c->bo->surrogates;
    bool feasible = true;
    for (size_t k = 0; k + 2 < s->count && feasible; k++) {
        double mean;
        feasible =
            !s->gps[k + 1] || (!bayesopt_gp_predict(s->gps[k + 1], 1, u, &mean, NULL) &&
                               mean >= c->constraint_lower[k] && mean <= c->constraint_upper[k]);
    }
    return feasible;
}

/* Modelled value to improve on: the best observation, or with noise the best posterior mean at an
 * observed point; and what pending points are believed to bring, since the same improvement is not
 * there a second time. */
bayesopt_status climber_find_incumbent(struct climber *c)
{
    const struct bayesopt *bo = c->bo;
    const bayesopt_gp *gp = bo->surrogates.gps[0];
    bool noisy = bo->options.noise != BAYESOPT_NOISE_DETERMINISTIC;
    c->best = INFINITY;
    for (size_t i = 0; i < bo->n_points; i++) {
        const struct point *p = &bo->points[i];
        bool pending = p->state == BAYESOPT_STATE_PENDING && point_is_dear(bo, p);
        double value;
        if (pending ? !believed_feasible(c, p->u) : !point_feasible(bo, p))
            continue;
        if (noisy || pending) {
            bayesopt_status status = surrogates_predict(bo, 1, p->u, &value, NULL);
            if (status)
                return status;
        } else {
            value = bayesopt_gp_to_model(gp, p->f);
        }
        c->best = fmin(c->best, value);
    }
    c->improvement = isfinite(c->best);
    return BAYESOPT_OK;
}

/* Modelled objectives, to be minimised, of a point: told, or with noise and of pending ones the
 * models' means. */
static bayesopt_status modelled_objectives(const struct bayesopt *bo, const struct point *p,
                                           double *values)
{
    bool told =
        p->state == BAYESOPT_STATE_DONE && bo->options.noise == BAYESOPT_NOISE_DETERMINISTIC;
    bayesopt_status status = BAYESOPT_OK;
    for (size_t k = 0; k < bo->options.n_objectives && !status; k++) {
        size_t g = objective_model(bo, k);
        const bayesopt_gp *gp = bo->surrogates.gps[g];
        if (told)
            values[k] = bayesopt_gp_to_model(gp, g ? p->constraints[g - 1] : p->f);
        else
            status = bayesopt_gp_predict(gp, 1, p->u, &values[k], NULL);
        values[k] *= g ? objective_sign(bo, k) : 1;
    }
    return status;
}

/* Where the volume ends, as far beyond the front as a tenth of it is wide (Ishibuchi et al., Evol.
 * Computation 26 (2018) 411), and at least at the median of what was told, so that a front of few
 * points does not end the search in its own corner. */
static void find_reference(size_t m, size_t n, const double *values, double *column,
                           double *reference)
{
    static const double beyond = 0.1;
    for (size_t c = 0; c < m; c++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < n; i++) {
            column[i] = values[i * m + c];
            if (front_dominated(m, n, values, i))
                continue;
            low = fmin(low, column[i]);
            high = fmax(high, column[i]);
        }
        for (size_t i = 1; i < n; i++)
            for (size_t k = i; k > 0 && column[k] < column[k - 1]; k--) {
                double kept = column[k];
                column[k] = column[k - 1];
                column[k - 1] = kept;
            }
        reference[c] = fmax(high + beyond * fmax(high - low, beyond), column[n / 2]);
    }
}

bayesopt_status climber_prepare_front(struct climber *c)
{
    const struct bayesopt *bo = c->bo;
    size_t m = bo->options.n_objectives, n = 0;
    double reference[FRONT_MOST_OBJECTIVES];
    if (!c->several || !c->improvement)
        return BAYESOPT_OK;
    double *values = malloc((bo->n_points + 1) * (m + 1) * sizeof *values);
    if (!values)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    bayesopt_status status = BAYESOPT_OK;
    for (size_t i = 0; i < bo->n_points && !status; i++) {
        const struct point *p = &bo->points[i];
        bool pending = p->state == BAYESOPT_STATE_PENDING && believed_feasible(c, p->u);
        if (pending || point_feasible(bo, p))
            status = modelled_objectives(bo, p, values + n++ * m);
    }
    if (!status) {
        find_reference(m, n, values, values + n * m, reference);
        if (!front_create(&c->front, m, n, values, reference))
            status = bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    }
    free(values);
    return status;
}

/* With noise the expected improvement is one over what the values at the evaluated points may be.
 * Rows of the objective's data follow the history, then comes what was derived, and last what is
 * believed of pending points. */
bayesopt_status climber_prepare_noisy(struct climber *c)
{
    const struct bayesopt *bo = c->bo;
    const bayesopt_gp *gp = bo->surrogates.gps[0];
    if (!c->improvement || c->several || c->search->goal != SEARCH_IMPROVEMENT ||
        bo->options.acquisition != BAYESOPT_ACQUISITION_EI || bo->options.n_levels > 1 ||
        bo->options.noise == BAYESOPT_NOISE_DETERMINISTIC)
        return BAYESOPT_OK;
    bayesopt_gp_info info;
    bayesopt_status status = bayesopt_gp_get_info(gp, &info);
    bool *eligible = calloc(info.n ? info.n : 1, sizeof *eligible);
    size_t row = 0;
    if (!eligible)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    for (size_t i = 0; i < bo->n_points && row < info.n; i++)
        if (bo->points[i].state == BAYESOPT_STATE_DONE)
            eligible[row++] = point_feasible(bo, &bo->points[i]);
    row = info.n;
    for (size_t i = bo->n_points; i-- > 0 && row > 0;)
        if (bo->points[i].state == BAYESOPT_STATE_PENDING)
            eligible[--row] = believed_feasible(c, bo->points[i].u);
    uint64_t seed = random_hash(bo->options.seed ^ random_hash(c->search->id + 1));
    if (!status)
        status = noisy_create(gp, eligible, seed, &c->noisy);
    free(eligible);
    return status;
}
