/* Which kind of step comes next, and the step. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "internal.h"
#include "search.h"

/* The trust region of Eriksson et al., TuRBO, NeurIPS 2019: side of the box, grown after successes
 * in a row, halved after failures in a row, and begun anew when it has collapsed. */
struct trust {
    double length;
    size_t successes, failures, restarts;
};

static const double length_start = 0.8, length_least = 0x1p-7, length_most = 1.6;

static void trust_update(const struct bayesopt *bo, struct trust *t, bool success)
{
    size_t patience = bo->d > 4 ? bo->d : 4;
    t->successes = success ? t->successes + 1 : 0;
    t->failures = success ? 0 : t->failures + 1;
    if (t->successes >= 3) {
        t->length = fmin(2 * t->length, length_most);
        t->successes = 0;
    } else if (t->failures >= patience) {
        t->length /= 2;
        t->failures = 0;
    }
    if (t->length < length_least) {
        t->length = length_start;
        t->restarts++;
    }
}

/* The region's state is a function of the history. A step succeeds when it lowers the best value by
 * more than a thousandth of its size, or the violation when nothing is feasible yet. */
static struct trust trust_replay(const struct bayesopt *bo)
{
    struct trust t = {.length = length_start};
    double f = INFINITY, violation = INFINITY;
    for (size_t i = 0; i < bo->n_points; i++) {
        const struct point *p = &bo->points[i];
        if (p->state == BAYESOPT_STATE_PENDING || p->level + 1 < (int)bo->options.n_levels)
            continue;
        double v = p->state == BAYESOPT_STATE_DONE ? history_violation(bo, p) : INFINITY;
        bool better = v < violation || (v == violation && p->f < f);
        bool success = v < violation || (v == violation && p->f < f - 1e-3 * fabs(f));
        if (p->phase == BAYESOPT_PHASE_LOCAL || p->phase == BAYESOPT_PHASE_POLISH)
            trust_update(bo, &t, p->state == BAYESOPT_STATE_DONE && success);
        if (p->state == BAYESOPT_STATE_DONE && better) {
            violation = v;
            f = p->f;
        }
    }
    return t;
}

double strategy_trust_length(const struct bayesopt *bo)
{
    return trust_replay(bo).length;
}

/* Box around the best point, longer along variables of long length scale. */
static void trust_box(const struct bayesopt *bo, double length, const double *centre, double *lower,
                      double *upper)
{
    double scales[1000], logs = 0;
    bayesopt_gp_parameters parameters = {.lengthscale = scales};
    bayesopt_gp_get_parameters(bo->surrogates.gps[0], &parameters);
    for (size_t j = 0; j < bo->d; j++)
        logs += log(scales[j]) / (double)bo->d;
    for (size_t j = 0; j < bo->d; j++) {
        double half = 0.5 * length * scales[j] / exp(logs);
        lower[j] = fmax(centre[j] - half, 0);
        upper[j] = fmin(centre[j] + half, 1);
    }
}

/* Deterministic objectives gain nothing from a point evaluated before. */
static void keep_apart(struct bayesopt *bo, uint64_t id, double *u)
{
    struct random_stream stream;
    random_start(&stream, bo->options.seed, STREAM_STRATEGY, id);
    for (int attempt = 0; attempt < 100; attempt++) {
        double nearest = INFINITY, moved[1000];
        for (size_t i = 0; i < bo->n_points; i++) {
            double most = 0;
            for (size_t j = 0; j < bo->d; j++)
                most = fmax(most, fabs(bo->points[i].u[j] - u[j]));
            nearest = fmin(nearest, most);
        }
        if (nearest > 1e-7)
            return;
        for (size_t j = 0; j < bo->d; j++)
            moved[j] = fmin(fmax(u[j] + 1e-3 * random_normal(&stream), 0), 1);
        if (region_contains(&bo->region, moved))
            memcpy(u, moved, bo->d * sizeof *u);
    }
}

static bayesopt_status propose_anywhere(struct bayesopt *bo, uint64_t id, double *u)
{
    struct random_stream stream;
    random_start(&stream, bo->options.seed, STREAM_STRATEGY, id);
    return region_find(&bo->region, &stream, u)
               ? BAYESOPT_OK
               : bayesopt_fail(BAYESOPT_ERROR_INFEASIBLE,
                               "no point found that satisfies the %zu input constraints",
                               bo->region.m);
}

/* One global step in eight keeps other basins in view. The others stay near the best point, by
 * turns where improvement is expected (which also measures where little is known) and where the
 * model has its minimum (which on smooth objectives is a Newton-like step). */
static bayesopt_phase next_phase(const struct bayesopt *bo, uint64_t id, bool known)
{
    if (!known || bo->options.strategy == BAYESOPT_STRATEGY_GLOBAL)
        return BAYESOPT_PHASE_GLOBAL;
    if (bo->options.strategy == BAYESOPT_STRATEGY_AUTO && id % 8 == 0)
        return BAYESOPT_PHASE_GLOBAL;
    bool polish = bo->options.strategy == BAYESOPT_STRATEGY_AUTO && bo->options.polish;
    return polish && id % 2 == 0 ? BAYESOPT_PHASE_POLISH : BAYESOPT_PHASE_LOCAL;
}

/* The level that removes more of the variance at u for its cost, as long as the proposals at the
 * cheap level have not cost more than those at the dear one. */
static bayesopt_status choose_level(const struct bayesopt *bo, const double *u, int *level)
{
    double share, cheap = 0, dear = 1;
    bayesopt_status status = surrogates_cheap_share(bo, u, &share);
    for (size_t i = 0; i < bo->n_points; i++)
        if (bo->points[i].phase != BAYESOPT_PHASE_INITIAL)
            *(bo->points[i].level ? &dear : &cheap) += 1;
    double ratio = bo->options.level_cost_ratio;
    *level = share > ratio && cheap * ratio <= dear ? 0 : 1;
    return status;
}

/* Whether the largest expected improvement, given as a logarithm in modelled units, is less than
 * the caller asks for, in units of f at the best value. */
static bool little_expected(const struct bayesopt *bo, double log_improvement)
{
    bool feasible;
    size_t best = history_best(bo, &feasible);
    if (!(bo->options.stop_expected_improvement > 0) || !feasible)
        return false;
    const bayesopt_gp *gp = bo->surrogates.gps[0];
    double f = bo->points[best].f, modelled = bayesopt_gp_to_model(gp, f);
    double lower = bayesopt_gp_from_model(gp, modelled - exp(log_improvement));
    return f - lower < bo->options.stop_expected_improvement;
}

bayesopt_status strategy_propose(struct bayesopt *bo, uint64_t id, double *u, bayesopt_phase *phase,
                                 int *level)
{
    double lower[1000], upper[1000], value;
    bool feasible;
    size_t done = 0;
    for (size_t i = 0; i < bo->n_points; i++)
        done += point_counts(bo, &bo->points[i]);
    *phase = BAYESOPT_PHASE_GLOBAL;
    if (done < 2)
        return propose_anywhere(bo, id, u);
    bayesopt_status status = surrogates_fit(bo, true);
    if (!status)
        status = search_believe_pending(bo);
    if (status)
        return status;
    struct trust trust = trust_replay(bo);
    size_t best = history_best(bo, &feasible);
    *phase = next_phase(bo, id, best != SIZE_MAX);
    for (size_t j = 0; j < bo->d; j++) {
        lower[j] = 0;
        upper[j] = 1;
    }
    if (*phase != BAYESOPT_PHASE_GLOBAL)
        trust_box(bo, trust.length, bo->points[best].u, lower, upper);
    bool polish = *phase == BAYESOPT_PHASE_POLISH;
    struct search search = {.goal = polish ? SEARCH_MEAN : SEARCH_IMPROVEMENT,
                            .lower = lower,
                            .upper = upper,
                            .id = id,
                            .candidates = 1024,
                            .starts = 6};
    status = search_run(bo, &search, u, &value);
    bo->surrogates.fitted = false;
    if (!status && *phase == BAYESOPT_PHASE_GLOBAL && little_expected(bo, value))
        return BAYESOPT_STOP_EXPECTED_IMPROVEMENT;
    if (!status)
        keep_apart(bo, id, u);
    if (!status && bo->options.n_levels == 2)
        status = choose_level(bo, u, level);
    return status;
}
