#include "core/error.h"
#include "problem/label.h"
#include "search/climber.h"

#include <math.h>
#include <nlopt.h>
#include <stdlib.h>
#include <string.h>

/* How long a step climbs; chosen on tests/bench/bayesopt_regret. */
enum { ASCENT_EVALUATIONS = 60, DESCENT_EVALUATIONS = 300 };
/* With discrete variables climbs along the others and sweeps over these take turns. */
enum { SWEEPS = 8, MOST_CATEGORIES = 64 };
/* Change of the acquisition, a logarithm, at which a climb ends. */
static const double ascent_tolerance = 1e-5;
/* Of a quadratic, in units of what it varies over the box, beside which the bottom of a narrow
 * valley is level. */
static const double descent_tolerance = 1e-14;

static bayesopt_status believe(bayesopt_gp *gp, const double *u)
{
    double mean, zero = 0;
    if (!gp)
        return BAYESOPT_OK;
    bayesopt_status status = bayesopt_gp_predict(gp, 1, u, &mean, NULL);
    if (status)
        return status;
    double y = bayesopt_gp_from_model(gp, mean);
    return bayesopt_gp_append(gp, 1, u, &y, &zero);
}

bayesopt_status search_believe_pending(struct bayesopt *bo)
{
    struct surrogates *s = &bo->surrogates;
    for (size_t i = 0; i < bo->n_points; i++) {
        const struct point *p = &bo->points[i];
        if (p->state != BAYESOPT_STATE_PENDING)
            continue;
        bool dear = point_is_dear(bo, p);
        bayesopt_status status = dear ? BAYESOPT_OK : believe(s->cheap, p->u);
        for (size_t g = 0; g + 1 < s->count && dear && !status; g++)
            status = believe(s->gps[g], p->u);
        if (status)
            return status;
    }
    return BAYESOPT_OK;
}

/* Square of the distance to a pending point in units of what is kept. */
static double square_apart(const struct bayesopt *bo, const double *apart, const struct point *p,
                           const double *u)
{
    double square = 0;
    for (size_t j = 0; j < bo->d; j++)
        square += pow((u[j] - p->u[j]) / apart[j], 2);
    return square;
}

bool search_is_apart(const struct bayesopt *bo, const double *apart, const double *u)
{
    for (size_t i = 0; i < bo->n_points && apart; i++) {
        const struct point *p = &bo->points[i];
        if (p->state == BAYESOPT_STATE_PENDING && square_apart(bo, apart, p, u) < 1)
            return false;
    }
    return true;
}

/* Local penalisation (Gonzalez et al., AISTATS 2016), with 1 - exp(-r^2/2) for the hammer: what
 * pending points will tell is not asked a second time. The logarithm; adds to the gradient. */
static double penalty(const struct climber *c, const double *u, double *gradient)
{
    const double *apart = c->search->apart;
    double sum = 0;
    for (size_t i = 0; i < c->bo->n_points && apart; i++) {
        const struct point *p = &c->bo->points[i];
        if (p->state != BAYESOPT_STATE_PENDING)
            continue;
        double square = fmax(square_apart(c->bo, apart, p, u), 1e-12);
        double miss = -expm1(-0.5 * square);
        sum += log(miss);
        for (size_t j = 0; j < c->bo->d && gradient; j++)
            gradient[j] += (1 - miss) / miss * (u[j] - p->u[j]) / (apart[j] * apart[j]);
    }
    return sum;
}

/* Several objectives: the logarithm of the expected hypervolume improvement. */
static double add_front(const struct climber *c, size_t stride, const double *mean,
                        const double *var, double *by_mean, double *by_var)
{
    const struct bayesopt *bo = c->bo;
    size_t m = bo->options.n_objectives;
    double mu[FRONT_MOST_OBJECTIVES], sd[FRONT_MOST_OBJECTIVES], d_mu[FRONT_MOST_OBJECTIVES],
        d_sd[FRONT_MOST_OBJECTIVES];
    for (size_t k = 0; k < m; k++) {
        size_t g = objective_model(bo, k);
        mu[k] = (g ? objective_sign(bo, k) : 1) * mean[g * stride];
        sd[k] = sqrt(fmax(var[g * stride], 1e-12));
    }
    double value = front_log_improvement(&c->front, mu, sd, d_mu, d_sd);
    for (size_t k = 0; k < m && by_mean; k++) {
        size_t g = objective_model(bo, k);
        by_mean[g] += (g ? objective_sign(bo, k) : 1) * d_mu[k];
        by_var[g] += d_sd[k] / (2 * sd[k]);
    }
    return value;
}

/* Acquisition from means and variances of all models; derivatives in them when wanted. */
static double combine(const struct climber *c, size_t stride, const double *mean, const double *var,
                      double *by_mean, double *by_var)
{
    const struct surrogates *s = &c->bo->surrogates;
    double value = 0;
    for (size_t g = 0; g < s->count; g++) {
        double dm = 0, ds = 0;
        if (!s->gps[g])
            continue;
        double sd = sqrt(fmax(var[g * stride], 1e-12));
        if (g + 1 == s->count) {
            value += label_log_trust(mean[g * stride], &dm);
        } else if (g > 0) {
            value += bayesopt_log_feasibility(mean[g * stride], sd, c->constraint_lower[g - 1],
                                              c->constraint_upper[g - 1], &dm, &ds);
        } else if (c->search->goal != SEARCH_IMPROVEMENT && c->improvement) {
            value -= mean[0];
            dm = -1;
        } else if (c->several) {
            ; /* add_front() */
        } else if (c->noisy) {
            value += mean[0]; /* put there by follow_noisy() */
            dm = 1;
        } else if (c->improvement && c->bo->options.acquisition == BAYESOPT_ACQUISITION_LCB) {
            value -= bayesopt_lcb(mean[0], sd, c->bo->options.lcb_factor);
            dm = -1;
            ds = c->bo->options.lcb_factor;
        } else if (c->improvement) {
            value += bayesopt_log_ei(mean[0], sd, c->best, &dm, &ds);
        }
        if (by_mean) {
            by_mean[g] = dm;
            by_var[g] = ds / (2 * sd);
        }
    }
    return c->several && c->improvement ? value + add_front(c, stride, mean, var, by_mean, by_var)
                                        : value;
}

/* The quadratic in modelled units, in place of the regression: mean, and a variance of 0. */
static double follow_quadratic(const struct climber *c, const double *u, double *mean,
                               double *dmean, double *dvar)
{
    const struct quadratic *q = c->search->quadratic;
    *mean = (quadratic_value(q, u, dmean) - q->constant) / c->unit;
    for (size_t j = 0; j < q->d && dmean; j++) {
        dmean[j] /= c->unit;
        dvar[j] = 0;
    }
    return 0;
}

/* Likewise the noisy expected improvement, which needs no more of the objective's model. */
static double follow_noisy(const struct climber *c, const double *u, double *mean, double *dmean,
                           double *dvar)
{
    *mean = noisy_log_ei(c->noisy, u, dmean, c->work);
    for (size_t j = 0; j < c->bo->d && dmean; j++)
        dvar[j] = 0;
    return 0;
}

static double climb_value(struct climber *c, const double *u, double *gradient)
{
    const struct surrogates *s = &c->bo->surrogates;
    size_t d = c->bo->d, count = s->count;
    double mean[count], var[count], by_mean[count], by_var[count];
    bayesopt_status status = BAYESOPT_OK;
    if (c->search->goal == SEARCH_QUADRATIC)
        var[0] = follow_quadratic(c, u, &mean[0], c->dmean, c->dvar);
    else if (c->noisy)
        var[0] = follow_noisy(c, u, &mean[0], c->dmean, c->dvar);
    else
        status =
            surrogates_predict_gradient(c->bo, u, &mean[0], &var[0], c->dmean, c->dvar, c->work);
    for (size_t g = 1; g < count && !status; g++)
        if (s->gps[g])
            status = bayesopt_gp_predict_gradient(s->gps[g], u, &mean[g], &var[g], c->dmean + g * d,
                                                  c->dvar + g * d, c->work);
    if (status)
        return -INFINITY;
    double value = combine(c, 1, mean, var, by_mean, by_var);
    for (size_t j = 0; j < d && gradient; j++) {
        gradient[j] = 0;
        for (size_t g = 0; g < count; g++)
            if (s->gps[g])
                gradient[j] += by_mean[g] * c->dmean[g * d + j] + by_var[g] * c->dvar[g * d + j];
    }
    if (c->search->apart)
        value += penalty(c, u, gradient);
    return value;
}

static double climb_objective(unsigned n, const double *u, double *gradient, void *data)
{
    struct climber *c = data;
    double value = climb_value(c, u, gradient);
    for (unsigned j = 0; gradient && j < n; j++)
        gradient[j] = isfinite(gradient[j]) ? -gradient[j] : 0;
    if (!isfinite(value))
        return 1e30;
    if (value > c->best_value && (!c->bo->region.m || region_contains(&c->bo->region, u)) &&
        search_is_apart(c->bo, c->search->apart, u)) {
        c->best_value = value;
        memcpy(c->best_u, u, n * sizeof *u);
    }
    return -value;
}

/* Constraint values with a Jacobian that is differenced once and then kept up to date by Broyden's
 * rank-one formula: constraints may be dear compared with the models. */
struct broyden {
    struct bayesopt *bo;
    bool started;
    double *u, *values, *jacobian;
};

static void input_constraints(unsigned m, double *result, unsigned n, const double *u,
                              double *gradient, void *data)
{
    struct broyden *b = data;
    double square = 0;
    if (!region_values(&b->bo->region, u, result))
        for (unsigned i = 0; i < m; i++)
            result[i] = 1;
    if (!gradient)
        return;
    for (unsigned j = 0; j < n && b->started; j++)
        square += (u[j] - b->u[j]) * (u[j] - b->u[j]);
    if (!b->started) {
        b->started = region_jacobian(&b->bo->region, u, result, b->jacobian);
        if (!b->started)
            memset(b->jacobian, 0, (size_t)m * n * sizeof *b->jacobian);
    } else if (square > 0) {
        for (unsigned i = 0; i < m; i++) {
            double *row = b->jacobian + (size_t)i * n, miss = result[i] - b->values[i];
            for (unsigned j = 0; j < n; j++)
                miss -= row[j] * (u[j] - b->u[j]);
            for (unsigned j = 0; j < n; j++)
                row[j] += miss * (u[j] - b->u[j]) / square;
        }
    }
    memcpy(b->u, u, n * sizeof *u);
    memcpy(b->values, result, m * sizeof *result);
    memcpy(gradient, b->jacobian, (size_t)m * n * sizeof *gradient);
}

/* One climb from u; leaves the best point seen (within the region) in c->best_u. */
static bayesopt_status climb(struct climber *c, const double *u)
{
    struct bayesopt *bo = c->bo;
    size_t d = bo->d, m = bo->region.m;
    double at[BAYESOPT_MOST_VARIABLES], value;
    double lower[BAYESOPT_MOST_VARIABLES], upper[BAYESOPT_MOST_VARIABLES];
    struct broyden broyden = {.bo = bo};
    double *tolerances = NULL;
    c->best_value = -INFINITY;
    if (bo->n_discrete == d) {
        climb_objective((unsigned)d, u, NULL, c);
        return BAYESOPT_OK;
    }
    for (size_t j = 0; j < d; j++) {
        bool discrete = problem_is_discrete(bo, j);
        lower[j] = discrete ? u[j] : c->search->lower[j];
        upper[j] = discrete ? u[j] : c->search->upper[j];
    }
    nlopt_opt opt = nlopt_create(m ? NLOPT_LD_SLSQP : NLOPT_LD_LBFGS, (unsigned)d);
    if (!opt)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    nlopt_set_min_objective(opt, climb_objective, c);
    nlopt_set_lower_bounds(opt, lower);
    nlopt_set_upper_bounds(opt, upper);
    bool quadratic = c->search->goal == SEARCH_QUADRATIC;
    nlopt_set_maxeval(opt, quadratic ? DESCENT_EVALUATIONS : ASCENT_EVALUATIONS);
    nlopt_set_ftol_abs(opt, quadratic ? descent_tolerance : ascent_tolerance);
    if (m) {
        broyden.u = malloc((d + 2 * m + m * d) * sizeof *broyden.u);
        if (!broyden.u) {
            nlopt_destroy(opt);
            return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
        }
        broyden.values = broyden.u + d;
        broyden.jacobian = broyden.values + m;
        tolerances = broyden.jacobian + m * d;
        memset(tolerances, 0, m * sizeof *tolerances);
        nlopt_add_inequality_mconstraint(opt, (unsigned)m, input_constraints, &broyden, tolerances);
    }
    memcpy(at, u, d * sizeof *at);
    nlopt_result result = nlopt_optimize(opt, at, &value); /* the best is in c in any other case */
    nlopt_destroy(opt);
    free(broyden.u);
    return result == NLOPT_OUT_OF_MEMORY ? bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory")
                                         : BAYESOPT_OK;
}

/* Value number t that a sweep tries for variable j at u; false: there are no more. Whole numbers
 * go one step either way, categories to any other. */
static bool sweep_value(const struct climber *c, size_t j, size_t t, double *value)
{
    const struct bayesopt *bo = c->bo;
    double unit = problem_value_unit(bo, j, 1), slack = 0.5 * unit;
    bool category = bo->kind[j] == BAYESOPT_KIND_CATEGORICAL;
    size_t count = category ? (size_t)problem_values(bo, j) : 2;
    if (t >= count || t >= MOST_CATEGORIES || !(unit > 0))
        return false;
    *value = category ? problem_value_unit(bo, j, (double)t) : *value + (t ? unit : -unit);
    return *value >= c->search->lower[j] - slack && *value <= c->search->upper[j] + slack;
}

/* The best of the points that differ from c->best_u in one discrete variable, if it is better. */
static bool sweep(struct climber *c)
{
    struct bayesopt *bo = c->bo;
    double from[BAYESOPT_MOST_VARIABLES], at[BAYESOPT_MOST_VARIABLES], before = c->best_value;
    memcpy(from, c->best_u, bo->d * sizeof *from);
    for (size_t j = 0; j < bo->d; j++)
        for (size_t t = 0; t < MOST_CATEGORIES && problem_is_discrete(bo, j); t++) {
            memcpy(at, from, bo->d * sizeof *at);
            if (!sweep_value(c, j, t, &at[j])) {
                if (t > 1)
                    break;
                continue;
            }
            problem_snap(bo, at);
            climb_objective((unsigned)bo->d, at, NULL, c);
        }
    return c->best_value > before + ascent_tolerance;
}

/* One ascent from u. */
static bayesopt_status ascend(struct climber *c, const double *u)
{
    struct bayesopt *bo = c->bo;
    double from[BAYESOPT_MOST_VARIABLES], most;
    if (ask_is_cancelled(bo))
        return ask_cancelled(bo);
    bayesopt_status status = climb(c, u);
    for (int turn = 0;
         turn < SWEEPS && bo->n_discrete && !status && isfinite(c->best_value) && sweep(c);
         turn++) {
        memcpy(from, c->best_u, bo->d * sizeof *from);
        most = c->best_value;
        status = climb(c, from);
        if (c->best_value < most) {
            c->best_value = most;
            memcpy(c->best_u, from, bo->d * sizeof *from);
        }
    }
    return status;
}

static bayesopt_status score(struct climber *c, size_t n, const double *x, double *values)
{
    const struct surrogates *s = &c->bo->surrogates;
    double *mean = malloc(2 * n * s->count * sizeof *mean);
    if (!mean)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    double *var = mean + n * s->count;
    bayesopt_status status = BAYESOPT_OK;
    bool quadratic = c->search->goal == SEARCH_QUADRATIC;
    if (!quadratic && !c->noisy)
        status = surrogates_predict(c->bo, n, x, mean, var);
    for (size_t i = 0; i < n && (quadratic || c->noisy); i++) {
        const double *at = x + i * c->bo->d;
        var[i] = quadratic ? follow_quadratic(c, at, &mean[i], NULL, NULL)
                           : follow_noisy(c, at, &mean[i], NULL, NULL);
    }
    for (size_t g = 1; g < s->count && !status; g++)
        if (s->gps[g])
            status = bayesopt_gp_predict(s->gps[g], n, x, mean + g * n, var + g * n);
    for (size_t i = 0; i < n && !status; i++)
        values[i] =
            search_is_apart(c->bo, c->search->apart, x + i * c->bo->d)
                ? combine(c, n, mean + i, var + i, NULL, NULL) + penalty(c, x + i * c->bo->d, NULL)
                : -INFINITY;
    free(mean);
    return status;
}

static size_t take_best(size_t from, size_t to, double *values)
{
    size_t best = SIZE_MAX;
    for (size_t i = from; i < to; i++)
        if (isfinite(values[i]) && (best == SIZE_MAX || values[i] > values[best]))
            best = i;
    return best;
}

/* Ascents from the best candidates of both families in turn; candidates outside the region are
 * moved into it first. */
static bayesopt_status ascend_all(struct climber *c, size_t n, double *x, double *values, double *u,
                                  double *value)
{
    struct bayesopt *bo = c->bo;
    size_t d = bo->d, uniform = c->search->candidates, tries = 0;
    *value = -INFINITY;
    for (size_t s = 0; s < c->search->starts && tries < 20 * c->search->starts;) {
        bool neighbours = s % 2 && n > uniform;
        size_t i = neighbours ? take_best(uniform, n, values) : take_best(0, uniform, values);
        if (i == SIZE_MAX)
            break;
        tries++;
        values[i] = NAN;
        double *start = x + i * d;
        if (bo->region.m && !region_contains(&bo->region, start)) {
            if (!region_project(&bo->region, start))
                continue;
            for (size_t j = 0; j < d; j++)
                start[j] = fmin(fmax(start[j], c->search->lower[j]), c->search->upper[j]);
        }
        bayesopt_status status = ascend(c, start);
        if (status)
            return status;
        if (c->best_value > *value) {
            *value = c->best_value;
            memcpy(u, c->best_u, d * sizeof *u);
        }
        s++;
    }
    return BAYESOPT_OK;
}

/* About how much the quadratic varies over the box. */
static double quadratic_range(const struct search *search)
{
    const struct quadratic *q = search->quadratic;
    double range = 0;
    if (search->goal != SEARCH_QUADRATIC)
        return 1;
    for (size_t j = 0; j < q->d; j++) {
        double side = search->upper[j] - search->lower[j];
        range += side * (fabs(q->gradient[j]) + side * fabs(q->hessian[j * q->d + j]));
    }
    return isfinite(range) && range > 0 ? range : 1;
}

static bool climber_create(struct climber *c, struct bayesopt *bo, const struct search *search)
{
    size_t d = bo->d, count = bo->surrogates.count, m = bo->options.n_constraints;
    *c = (struct climber){.bo = bo, .search = search, .several = bo->options.n_objectives > 1};
    size_t work = surrogates_work_size(bo);
    c->work = malloc((work + 2 * count * d + 2 * m + d) * sizeof *c->work);
    if (!c->work)
        return false;
    c->dmean = c->work + work;
    c->dvar = c->dmean + count * d;
    c->constraint_lower = c->dvar + count * d;
    c->constraint_upper = c->constraint_lower + m;
    c->best_u = c->constraint_upper + m;
    c->unit = quadratic_range(search);
    for (size_t i = 0; i < m; i++) {
        const bayesopt_gp *gp = bo->surrogates.gps[i + 1];
        double low = bo->constraint_lower[i], high = bo->constraint_upper[i];
        c->constraint_lower[i] = isinf(low) ? low : bayesopt_gp_to_model(gp, low);
        c->constraint_upper[i] = isinf(high) ? high : bayesopt_gp_to_model(gp, high);
    }
    return true;
}

bayesopt_status search_run(struct bayesopt *bo, const struct search *search, double *u,
                           double *value)
{
    struct climber c;
    size_t n = search->candidates + SEARCH_NEIGHBOURS;
    double *x = malloc(n * (bo->d + 1) * sizeof *x);
    if (!x || !climber_create(&c, bo, search)) {
        free(x);
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    }
    double *values = x + n * bo->d;
    bayesopt_status status = climber_find_incumbent(&c);
    if (!status)
        status = climber_prepare_noisy(&c);
    if (!status)
        status = climber_prepare_front(&c);
    if (!status)
        status = search_candidates(bo, search, x, &n);
    if (!status)
        status = score(&c, n, x, values);
    if (!status)
        status = ascend_all(&c, n, x, values, u, value);
    if (!status && isfinite(*value))
        *value -= penalty(&c, u, NULL);
    if (!status && !isfinite(*value)) {
        /* No start led anywhere: any point of the region in place of none. */
        struct random_stream stream;
        random_start(&stream, bo->options.seed, STREAM_SEARCH, random_hash(search->id));
        if (!region_find(&bo->region, &stream, u))
            status = bayesopt_fail(BAYESOPT_ERROR_INFEASIBLE,
                                   "no point found that satisfies the %zu input constraints",
                                   bo->region.m);
    }
    noisy_free(c.noisy);
    front_free(&c.front);
    free(c.work);
    free(x);
    return status;
}
