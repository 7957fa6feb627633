/* Which kind of step comes next, and the step. */
#include "search/strategy.h"

#include "core/error.h"
#include "core/quadratic.h"
#include "problem/internal.h"
#include "search/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How the local search stands. All of it is a function of the history. */
struct trust {
    size_t centre; /* the best point: feasible with least value, else of least violation */
    struct merit best;
    /* The trust region of Eriksson et al., TuRBO, NeurIPS 2019: side of the box, grown after
     * successes in a row, halved after failures in a row, begun anew when it has collapsed. */
    double length;
    size_t successes, failures;
    /* Local steps that together gained nothing worth naming, and whether they have shown that the
     * basin's bottom is reached. */
    size_t idle, idle_polished;
    double gained;
    bool settled;
    /* Half the side of the box a quadratic is trusted in, and what either kind of polishing step
     * gained of late. */
    double radius, polish_credit, descent_credit;
    size_t polished;
};

/* Proposals by their number (chosen on both tables of tests/bench/bayesopt_regret): one in
 * global_period looks over the whole box, every other one polishes; in a basin whose bottom is
 * reached only one in settled_period still does, and in place of the others the box is looked over.
 */
static const uint64_t global_period = 8, polish_period = 2, settled_period = 6;

/* Eriksson et al.: of the best value. */
static const double success_share = 1e-3;

static const double length_start = 0.8, length_least = 0x1p-7, length_most = 1.6;
static const double radius_start = 0.2, radius_most = 0.5, radius_least = 1e-8;
/* A gain is worth naming from this share on of the distance between the best tenth of the initial
 * design and the best value. */
static const double least_share = 1e-6;
/* Polishing steps longer than this have not settled. */
static const double settled_step = 0.01;

/* A batch (chosen on tests/bench/bayesopt_batches): how far apart its points lie at least, in sides
 * of the box that is searched per square root of d; how many sizes of the trust region its steps
 * take by turns; how many of them polish. */
static const double batch_apart = 0.04;
enum { SUCCESSES = 3 }; /* in a row before the region grows; Eriksson et al. */
enum { BATCH_SIZES = 3, BATCH_POLISHING = 2 };

static size_t patience(const struct bayesopt *bo)
{
    return bo->d > 4 ? bo->d : 4;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The value at which the best tenth of the initial design ends. */
static double good_value(const struct bayesopt *bo)
{
    double *values = malloc((bo->n_points + 1) * sizeof *values), value = INFINITY;
    size_t n = 0;
    for (size_t i = 0; values && i < bo->n_points; i++)
        if (bo->points[i].phase == BAYESOPT_PHASE_INITIAL && point_feasible(bo, &bo->points[i]))
            values[n++] = bo->points[i].f;
    if (n) {
        qsort(values, n, sizeof *values, compare);
        value = values[n / 10];
    }
    free(values);
    return value;
}

static double largest_difference(const struct bayesopt *bo, const double *u, size_t centre)
{
    double most = 0;
    for (size_t j = 0; j < bo->d && centre != SIZE_MAX; j++)
        most = fmax(most, fabs(u[j] - bo->points[centre].u[j]));
    return most;
}

static void length_update(const struct bayesopt *bo, struct trust *t, bool success)
{
    t->successes = success ? t->successes + 1 : 0;
    t->failures = success ? 0 : t->failures + 1;
    if (t->successes >= SUCCESSES) {
        t->length = fmin(2 * t->length, length_most);
        t->successes = 0;
    } else if (t->failures >= patience(bo)) {
        t->length /= 2;
        t->failures = 0;
    }
}

/* Steps that gain nothing although the polishing ones are short have reached the bottom. */
static void settle(const struct bayesopt *bo, struct trust *t, bool polishing, double step,
                   double gain, double good)
{
    double least = isfinite(good - t->best.f) ? least_share * (good - t->best.f) : 0;
    bool noisy = bo->options.noise != BAYESOPT_NOISE_DETERMINISTIC;
    t->idle++;
    t->idle_polished += polishing;
    t->gained += gain;
    if (noisy || t->best.violation > 0 || t->gained > least || (polishing && step > settled_step)) {
        t->settled = false;
        t->idle = t->idle_polished = 0;
        t->gained = 0;
    }
    /* In a batch few steps are polishing ones, and the others prove nothing. */
    bool idle = t->idle >= patience(bo) && 5 * t->idle_polished >= t->idle;
    if (t->length < length_least || idle) {
        t->settled = true;
        t->length = length_start;
        t->successes = t->failures = t->idle = t->idle_polished = 0;
        t->gained = 0;
    }
}

static void trust_step(const struct bayesopt *bo, const struct point *p, double good,
                       struct trust *t)
{
    bool done = p->state == BAYESOPT_STATE_DONE;
    struct merit merit = done ? point_merit(bo, p) : merit_worst;
    bool better = merit_better(merit, t->best);
    /* A step succeeds when it lowers the best value by a share of its size, or the violation when
     * nothing is feasible yet. */
    struct merit worth = t->best;
    worth.f -= isfinite(worth.f) ? success_share * fabs(worth.f) : 0;
    bool success = merit_better(merit, worth);
    double gain = better && merit.violation <= 0 && isfinite(t->best.f) ? t->best.f - p->f : 0;
    double step = largest_difference(bo, p->u, t->centre);
    bool descent = p->phase == BAYESOPT_PHASE_DESCENT, polish = p->phase == BAYESOPT_PHASE_POLISH;
    if (polish || descent) {
        double *credit = descent ? &t->descent_credit : &t->polish_credit;
        *credit = 0.5 * *credit + 0.5 * gain;
        t->polished++;
    }
    if (descent)
        t->radius = better ? fmin(2 * t->radius, radius_most)
                           : fmax(0.5 * fmin(t->radius, step), radius_least);
    else if (better)
        t->radius = fmin(fmax(t->radius, step), radius_most);
    if (polish || descent || p->phase == BAYESOPT_PHASE_LOCAL) {
        length_update(bo, t, success);
        settle(bo, t, polish || descent, step, gain, good);
    }
    if (better) {
        t->best = merit;
        t->centre = (size_t)(p - bo->points);
    }
}

static struct trust trust_replay(const struct bayesopt *bo)
{
    struct trust t = {
        .length = length_start, .radius = radius_start, .centre = SIZE_MAX, .best = merit_worst};
    double good = good_value(bo);
    for (size_t i = 0; i < bo->n_points; i++)
        if (point_judged(&bo->points[i]) && bo->points[i].level + 1 == (int)bo->options.n_levels)
            trust_step(bo, &bo->points[i], good, &t);
    return t;
}

double strategy_trust_length(const struct bayesopt *bo)
{
    return trust_replay(bo).length;
}

/* Whether values of variable j lie nearer or farther from each other. */
static bool has_distance(const struct bayesopt *bo, size_t j)
{
    return bo->kind[j] != BAYESOPT_KIND_CATEGORICAL && bo->lower[j] < bo->upper[j];
}

/* Sides of a box of geometric mean 1, longer along variables of long length scale. */
static void relative_sides(const struct bayesopt *bo, double *sides)
{
    double logs = 0;
    bayesopt_gp_parameters parameters = {.lengthscale = sides};
    bayesopt_gp_get_parameters(bo->surrogates.gps[0], &parameters);
    size_t count = 0;
    for (size_t j = 0; j < bo->d; j++)
        if (has_distance(bo, j)) {
            logs += log(sides[j]);
            count++;
        }
    for (size_t j = 0; j < bo->d; j++)
        sides[j] = has_distance(bo, j) ? sides[j] / exp(logs / (double)count) : 1;
}

/* Box around the best point: whole numbers reach at least one step far, categories anywhere. */
static void trust_box(const struct bayesopt *bo, double length, const double *sides,
                      const double *centre, double *lower, double *upper)
{
    for (size_t j = 0; j < bo->d; j++) {
        double half = 0.5 * length * sides[j];
        if (bo->kind[j] == BAYESOPT_KIND_CATEGORICAL)
            half = 1;
        else if (problem_is_discrete(bo, j))
            half = problem_value_unit(bo, j, fmax(round(half * (problem_values(bo, j) - 1)), 1));
        lower[j] = fmax(centre[j] - half, 0);
        upper[j] = fmin(centre[j] + half, 1);
    }
}

/* Some point of a space of whole numbers that was not asked yet. */
static bayesopt_status find_new(struct bayesopt *bo, struct random_stream *stream, double *u)
{
    size_t size = problem_size(bo), from = random_below(stream, size);
    double at[BAYESOPT_MOST_VARIABLES];
    for (size_t i = 0; i < size; i++) {
        problem_point(bo, (from + i) % size, at);
        if (!history_was_asked(bo, at) && region_contains(&bo->region, at)) {
            memcpy(u, at, bo->d * sizeof *u);
            return BAYESOPT_OK;
        }
    }
    return BAYESOPT_STOP_EXHAUSTED;
}

/* Deterministic objectives gain nothing from a point evaluated before. */
static bayesopt_status keep_apart(struct bayesopt *bo, uint64_t id, double *u)
{
    struct random_stream stream;
    bool discrete = bo->n_discrete == bo->d;
    random_start(&stream, bo->options.seed, STREAM_STRATEGY, id);
    if (discrete && bo->options.noise != BAYESOPT_NOISE_DETERMINISTIC)
        return BAYESOPT_OK;
    for (int attempt = 0; attempt < 100 && history_was_asked(bo, u); attempt++) {
        double moved[BAYESOPT_MOST_VARIABLES];
        for (size_t j = 0; j < bo->d; j++)
            moved[j] = fmin(fmax(u[j] + 1e-3 * random_normal(&stream), 0), 1);
        problem_snap(bo, moved);
        if (region_contains(&bo->region, moved))
            memcpy(u, moved, bo->d * sizeof *u);
    }
    bool small = discrete && problem_size(bo) <= BAYESOPT_MOST_POINTS;
    return small && history_was_asked(bo, u) ? find_new(bo, &stream, u) : BAYESOPT_OK;
}

static bayesopt_status propose_anywhere(struct bayesopt *bo, uint64_t id, double *u)
{
    struct random_stream stream;
    random_start(&stream, bo->options.seed, STREAM_STRATEGY, id);
    bool found = region_find(&bo->region, &stream, u);
    problem_snap(bo, u);
    return found ? keep_apart(bo, id, u)
                 : bayesopt_fail(BAYESOPT_ERROR_INFEASIBLE,
                                 "no point found that satisfies the %zu input constraints",
                                 bo->region.m);
}

static bayesopt_status no_memory(const struct bayesopt *bo)
{
    return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "no memory for %zu points", bo->n_points);
}

/* Values that count, and their points. NULL: out of memory. */
static double *list_values(const struct bayesopt *bo, size_t *n, double **y)
{
    double *x = malloc((bo->n_points ? bo->n_points : 1) * (bo->d + 1) * sizeof *x);
    *n = 0;
    if (!x)
        return NULL;
    *y = x + bo->n_points * bo->d;
    for (size_t i = 0; i < bo->n_points; i++)
        if (point_counts(bo, &bo->points[i])) {
            memcpy(x + *n * bo->d, bo->points[i].u, bo->d * sizeof *x);
            (*y)[(*n)++] = bo->points[i].f;
        }
    return x;
}

/* A quadratic through the values around the centre; none if there are too few or they lie in a
 * plane. */
static bayesopt_status fit_quadratic(const struct bayesopt *bo, const double *centre,
                                     struct quadratic *q, bool *fitted)
{
    double *y;
    size_t n;
    double *x = list_values(bo, &n, &y);
    *q = (struct quadratic){0};
    bayesopt_status status = x ? quadratic_fit(q, bo->d, n, x, y, centre, fitted) : no_memory(bo);
    free(x);
    return status;
}

/* Whether the points near the centre are as many as a quadratic has coefficients. */
static bool surrounded(const struct bayesopt *bo, const struct trust *t)
{
    size_t count = 0;
    for (size_t i = 0; i < bo->n_points; i++)
        count += point_counts(bo, &bo->points[i]) &&
                 largest_difference(bo, bo->points[i].u, t->centre) <= 2 * t->radius;
    return count >= (bo->d + 1) * (bo->d + 2) / 2;
}

/* Of two kinds of polishing steps the one that gained more of late, every fourth time the other. A
 * quadratic takes part when there are enough points around, or when it foretells those farther
 * away. The regression knows more of the function; close to a minimum of a smooth one the quadratic
 * is the better conditioned of the two. */
static bayesopt_status polishing_phase(const struct bayesopt *bo, struct trust *t,
                                       bayesopt_phase *phase)
{
    double reach = 0;
    bool proven = false;
    *phase = BAYESOPT_PHASE_POLISH;
    if (bo->n_discrete || bo->options.noise != BAYESOPT_NOISE_DETERMINISTIC)
        return BAYESOPT_OK;
    double *y;
    size_t n;
    double *x = list_values(bo, &n, &y);
    bayesopt_status status =
        x ? quadratic_foretells(bo->d, n, x, y, bo->points[t->centre].u, &reach, &proven)
          : no_memory(bo);
    free(x);
    if (status)
        return status;
    if (proven)
        t->radius = fmax(t->radius, fmin(reach, radius_most));
    if (!proven && !surrounded(bo, t))
        return BAYESOPT_OK;
    bool descent = t->descent_credit > t->polish_credit;
    if (t->polished % 4 == 3)
        descent = !descent;
    if (descent)
        *phase = BAYESOPT_PHASE_DESCENT;
    return BAYESOPT_OK;
}

/* Pending points of a kind of step, or of two. */
static size_t count_pending(const struct bayesopt *bo, bayesopt_phase phase, bayesopt_phase other)
{
    size_t count = 0;
    for (size_t i = 0; i < bo->n_points; i++) {
        const struct point *p = &bo->points[i];
        count += p->state == BAYESOPT_STATE_PENDING && (p->phase == phase || p->phase == other);
    }
    return count;
}

/* One global step in eight keeps other basins in view. The others stay near the best point, by
 * turns where improvement is expected (which also measures where little is known) and where a model
 * has its minimum (which on smooth objectives is a Newton-like step). Once the bottom of a basin is
 * reached, steps that look elsewhere take the place of most of the polishing. */
static bayesopt_status next_phase(const struct bayesopt *bo, uint64_t id, struct trust *t,
                                  bayesopt_phase *phase)
{
    bayesopt_strategy strategy = bo->options.strategy;
    *phase = BAYESOPT_PHASE_GLOBAL;
    /* With several objectives there is no one best point to stay near. */
    if (t->centre == SIZE_MAX || strategy == BAYESOPT_STRATEGY_GLOBAL ||
        bo->options.n_objectives > 1)
        return BAYESOPT_OK;
    bool global =
        t->settled ? id % settled_period && id % polish_period == 0 : id % global_period == 0;
    if (global && strategy != BAYESOPT_STRATEGY_LOCAL)
        return BAYESOPT_OK;
    *phase = BAYESOPT_PHASE_LOCAL;
    bool polishing =
        strategy != BAYESOPT_STRATEGY_LOCAL && bo->options.polish && id % polish_period == 0 &&
        count_pending(bo, BAYESOPT_PHASE_POLISH, BAYESOPT_PHASE_DESCENT) < BATCH_POLISHING;
    return polishing ? polishing_phase(bo, t, phase) : BAYESOPT_OK;
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
    if (!(bo->options.stop_expected_improvement > 0) || !feasible ||
        bo->options.acquisition != BAYESOPT_ACQUISITION_EI)
        return false;
    const bayesopt_gp *gp = bo->surrogates.gps[0];
    double f = bo->points[best].f, modelled = bayesopt_gp_to_model(gp, f);
    double lower = bayesopt_gp_from_model(gp, modelled - exp(log_improvement));
    return f - lower < bo->options.stop_expected_improvement;
}

/* Steps of a batch know nothing of each other's outcome, so they take the sizes that the trust
 * region might have by then. */
static double batch_length(const struct bayesopt *bo, double length, bayesopt_phase phase)
{
    return ldexp(length, -(int)(count_pending(bo, phase, phase) % BATCH_SIZES));
}

/* Of whole numbers the least mean is often at a point that was asked, where nothing is to be
 * learnt. */
static bool repeats(const struct bayesopt *bo, const double *u)
{
    return bo->n_discrete && bo->options.noise == BAYESOPT_NOISE_DETERMINISTIC &&
           history_was_asked(bo, u);
}

/* One step of the given kind; without apart wherever it leads. */
static bayesopt_status take_step(struct bayesopt *bo, struct search *search, const struct trust *t,
                                 bayesopt_phase phase, double *u, double *value)
{
    double sides[BAYESOPT_MOST_VARIABLES], apart[BAYESOPT_MOST_VARIABLES];
    double lower[BAYESOPT_MOST_VARIABLES], upper[BAYESOPT_MOST_VARIABLES], length = 1;
    bool polishing = phase == BAYESOPT_PHASE_POLISH || phase == BAYESOPT_PHASE_DESCENT;
    bool pending = history_count_state(bo, BAYESOPT_STATE_PENDING) > 0;
    search->lower = lower;
    search->upper = upper;
    search->goal = phase == BAYESOPT_PHASE_POLISH    ? SEARCH_MEAN
                   : phase == BAYESOPT_PHASE_DESCENT ? SEARCH_QUADRATIC
                                                     : SEARCH_IMPROVEMENT;
    relative_sides(bo, sides);
    if (phase != BAYESOPT_PHASE_GLOBAL)
        length =
            batch_length(bo, phase == BAYESOPT_PHASE_DESCENT ? 2 * t->radius : t->length, phase);
    for (size_t j = 0; j < bo->d; j++) {
        lower[j] = 0;
        upper[j] = 1;
        apart[j] = batch_apart * sqrt((double)bo->d) * length * sides[j];
    }
    if (phase != BAYESOPT_PHASE_GLOBAL)
        trust_box(bo, length, sides, bo->points[t->centre].u, lower, upper);
    search->apart = pending && !polishing ? apart : NULL;
    bayesopt_status status = search_run(bo, search, u, value);
    /* The place of a polishing step may be in good hands already. */
    if (!status && polishing && (!search_is_apart(bo, apart, u) || repeats(bo, u)))
        *value = -INFINITY;
    return status;
}

bayesopt_status strategy_propose(struct bayesopt *bo, uint64_t id, double *u, bayesopt_phase *phase,
                                 int *level)
{
    double value;
    struct quadratic quadratic = {0};
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
    struct search search = {.id = id, .candidates = 1024, .starts = 6, .quadratic = &quadratic};
    status = next_phase(bo, id, &trust, phase);
    bool fitted = false;
    if (!status && *phase == BAYESOPT_PHASE_DESCENT) {
        status = fit_quadratic(bo, bo->points[trust.centre].u, &quadratic, &fitted);
        *phase = fitted ? *phase : BAYESOPT_PHASE_POLISH;
    }
    if (!status)
        status = take_step(bo, &search, &trust, *phase, u, &value);
    bool polishing = *phase == BAYESOPT_PHASE_POLISH || *phase == BAYESOPT_PHASE_DESCENT;
    if (!status && polishing && !isfinite(value)) {
        *phase = BAYESOPT_PHASE_LOCAL;
        status = take_step(bo, &search, &trust, *phase, u, &value);
    }
    quadratic_free(&quadratic);
    bo->surrogates.fitted = false;
    if (!status && *phase == BAYESOPT_PHASE_GLOBAL && little_expected(bo, value))
        return BAYESOPT_STOP_EXPECTED_IMPROVEMENT;
    if (!status)
        status = keep_apart(bo, id, u);
    if (!status && bo->options.n_levels == 2)
        status = choose_level(bo, u, level);
    return status;
}
