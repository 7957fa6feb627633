/* The optimisation object: options, bounds, small accessors, asking, the loop with a callback. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "internal.h"
#include "store.h"

const char *bayesopt_phase_name(bayesopt_phase phase)
{
    static const char *const names[] = {"initial", "global",   "local",
                                        "polish",  "external", "descent"};
    return (unsigned)phase < sizeof names / sizeof *names ? names[phase] : "unknown";
}

const char *bayesopt_state_name(bayesopt_state state)
{
    static const char *const names[] = {"pending", "done", "failed"};
    return (unsigned)state < sizeof names / sizeof *names ? names[state] : "unknown";
}

const char *bayesopt_strategy_name(bayesopt_strategy strategy)
{
    static const char *const names[] = {"auto", "global", "local"};
    return (unsigned)strategy < sizeof names / sizeof *names ? names[strategy] : "unknown";
}

void bayesopt_options_init(bayesopt_options *options)
{
    *options = (bayesopt_options){
        .seed = 1,
        .initial_kind = BAYESOPT_DESIGN_ANNEALED_LHS,
        .noise = BAYESOPT_NOISE_DETERMINISTIC,
        .kernel = BAYESOPT_KERNEL_MATERN52,
        .scales = BAYESOPT_SCALES_AUTO,
        .transform = BAYESOPT_TRANSFORM_AUTO,
        .strategy = BAYESOPT_STRATEGY_AUTO,
        .mean = BAYESOPT_MEAN_CONSTANT,
        .choice = BAYESOPT_CHOICE_POSTERIOR,
        .polish = true,
        .acquisition = BAYESOPT_ACQUISITION_EI,
        .lcb_factor = 2,
        .n_levels = 1,
        .level_cost_ratio = 0.1,
    };
}

static bayesopt_status check_box(size_t d, const double *lower, const double *upper)
{
    if (d < 1 || d > 1000)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%zu variables, expected 1 to 1000", d);
    for (size_t j = 0; j < d; j++)
        if (!isfinite(lower[j]) || !isfinite(upper[j]) || !(lower[j] < upper[j]) ||
            !isfinite(upper[j] - lower[j]))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "variable %zu: bounds %g and %g, expected finite and increasing",
                                 j, lower[j], upper[j]);
    return BAYESOPT_OK;
}

static bayesopt_status check_enumerations(const bayesopt_options *o)
{
    if ((unsigned)o->initial_kind > BAYESOPT_DESIGN_STLBO ||
        (unsigned)o->noise > BAYESOPT_NOISE_LEARNED ||
        (unsigned)o->kernel > BAYESOPT_KERNEL_MATERN52 ||
        (unsigned)o->scales > BAYESOPT_SCALES_AUTO ||
        (o->mean != BAYESOPT_MEAN_CONSTANT && o->mean != BAYESOPT_MEAN_LINEAR) ||
        (unsigned)o->choice > BAYESOPT_CHOICE_LOO ||
        (unsigned)o->transform > BAYESOPT_TRANSFORM_AUTO ||
        (unsigned)o->strategy > BAYESOPT_STRATEGY_LOCAL ||
        (unsigned)o->acquisition > BAYESOPT_ACQUISITION_LCB)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "an option is outside its list: initial_kind %d, noise %d, kernel %d, "
                             "scales %d, mean %d, choice %d, transform %d, strategy %d, "
                             "acquisition %d",
                             (int)o->initial_kind, (int)o->noise, (int)o->kernel, (int)o->scales,
                             (int)o->mean, (int)o->choice, (int)o->transform, (int)o->strategy,
                             (int)o->acquisition);
    return BAYESOPT_OK;
}

static bayesopt_status check_options(size_t d, const double *lower, const double *upper,
                                     const bayesopt_options *o)
{
    bayesopt_status status = check_enumerations(o);
    if (status)
        return status;
    if (o->initial_x && !o->initial_n)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "initial_x without initial_n");
    for (size_t i = 0; o->initial_x && i < o->initial_n * d; i++)
        if (!(o->initial_x[i] >= lower[i % d] && o->initial_x[i] <= upper[i % d]))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "initial_x: variable %zu of point %zu is %g, expected %g to %g",
                                 i % d, i / d, o->initial_x[i], lower[i % d], upper[i % d]);
    for (size_t i = 0; i < o->n_constraints; i++) {
        double low = o->constraint_lower ? o->constraint_lower[i] : -INFINITY;
        double high = o->constraint_upper ? o->constraint_upper[i] : 0;
        if (!(low < high))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "outcome constraint %zu: bounds %g and %g, expected increasing", i,
                                 low, high);
    }
    if ((o->n_input_constraints > 0) != (o->input_constraint != NULL))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "n_input_constraints is %zu but input_constraint is %s",
                             o->n_input_constraints, o->input_constraint ? "given" : "NULL");
    if (o->n_linear && (!o->linear_a || !o->linear_b))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "n_linear is %zu without linear_a and linear_b", o->n_linear);
    if (o->n_levels < 1 || o->n_levels > 2 ||
        !(o->level_cost_ratio > 0 && o->level_cost_ratio <= 1))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "%zu levels of cost ratio %g, expected 1 or 2 and a ratio in (0, 1]",
                             o->n_levels, o->level_cost_ratio);
    if (!(o->lcb_factor > 0 && isfinite(o->lcb_factor)))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "lcb_factor is %g, expected positive",
                             o->lcb_factor);
    if (!(o->stop_expected_improvement >= 0))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "stop_expected_improvement is %g, expected not negative",
                             o->stop_expected_improvement);
    return BAYESOPT_OK;
}

/* Linear rows first, then the caller's values. */
static int region_callback(void *data, size_t d, const double *u, double *value)
{
    struct bayesopt *bo = data;
    problem_from_unit(bo, u, bo->constraint_x);
    for (size_t i = 0; i < bo->options.n_linear; i++) {
        value[i] = -bo->linear_b[i];
        for (size_t j = 0; j < d; j++)
            value[i] += bo->linear_a[i * d + j] * bo->constraint_x[j];
    }
    if (!bo->options.n_input_constraints)
        return 0;
    return bo->options.input_constraint(bo->options.input_data, d, bo->constraint_x,
                                        value + bo->options.n_linear);
}

/* The group of each variable, checked by the regression that will use it; *copy stays NULL unless
 * scales are tied. */
static bayesopt_status copy_groups(size_t d, const bayesopt_options *o, size_t **copy)
{
    bayesopt_gp_options gp_options;
    bayesopt_gp *gp;
    *copy = NULL;
    if (o->scales != BAYESOPT_SCALES_TIED)
        return BAYESOPT_OK;
    bayesopt_gp_options_init(&gp_options);
    gp_options.scales = o->scales;
    gp_options.group = o->group;
    bayesopt_status status = bayesopt_gp_create(d, &gp_options, &gp);
    if (status)
        return status;
    bayesopt_gp_free(gp);
    *copy = malloc(d * sizeof **copy);
    if (!*copy)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    memcpy(*copy, o->group, d * sizeof **copy);
    return BAYESOPT_OK;
}

static double *copy(const double *from, size_t n, double otherwise)
{
    double *to = malloc((n ? n : 1) * sizeof *to);
    for (size_t i = 0; to && i < n; i++)
        to[i] = from ? from[i] : otherwise;
    return to;
}

bayesopt_status bayesopt_create(size_t d, const double *lower, const double *upper,
                                const bayesopt_options *options, bayesopt **out)
{
    bayesopt_options defaults;
    if (!options) {
        bayesopt_options_init(&defaults);
        options = &defaults;
    }
    bayesopt_status status = check_box(d, lower, upper);
    if (!status)
        status = check_options(d, lower, upper, options);
    size_t *group = NULL;
    if (!status)
        status = copy_groups(d, options, &group);
    if (status)
        return status;
    struct bayesopt *bo = calloc(1, sizeof *bo);
    if (!bo) {
        free(group);
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    }
    const bayesopt_options *o = options;
    bo->d = d;
    bo->options = *o;
    bo->options.group = bo->group = group;
    if (!o->initial_n)
        bo->options.initial_n = 10 * d < 200 ? 10 * d : 200;
    bo->session = 1;
    bo->lower = copy(lower, d, 0);
    bo->upper = copy(upper, d, 0);
    bo->constraint_lower = copy(o->constraint_lower, o->n_constraints, -INFINITY);
    bo->constraint_upper = copy(o->constraint_upper, o->n_constraints, 0);
    bo->linear_a = copy(o->linear_a, o->n_linear * d, 0);
    bo->linear_b = copy(o->linear_b, o->n_linear, 0);
    bo->initial_x = o->initial_x ? copy(o->initial_x, o->initial_n * d, 0) : NULL;
    bo->constraint_x = malloc(d * sizeof *bo->constraint_x);
    bool ok = bo->lower && bo->upper && bo->constraint_lower && bo->constraint_upper &&
              bo->linear_a && bo->linear_b && bo->constraint_x && (!o->initial_x || bo->initial_x);
    ok = ok && surrogates_create(&bo->surrogates, d, o->n_constraints);
    ok = ok &&
         region_create(&bo->region, d, o->n_linear + o->n_input_constraints, region_callback, bo);
    if (!ok) {
        bayesopt_free(bo);
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    }
    bo->options.constraint_lower = bo->constraint_lower;
    bo->options.constraint_upper = bo->constraint_upper;
    bo->options.linear_a = bo->linear_a;
    bo->options.linear_b = bo->linear_b;
    bo->options.initial_x = bo->initial_x;
    *out = bo;
    return BAYESOPT_OK;
}

void bayesopt_free(bayesopt *bo)
{
    if (!bo)
        return;
    store_close(bo);
    history_truncate(bo, 0);
    free(bo->points);
    free(bo->group);
    surrogates_free(&bo->surrogates);
    region_free(&bo->region);
    double *arrays[] = {bo->lower,    bo->upper,    bo->constraint_lower, bo->constraint_upper,
                        bo->linear_a, bo->linear_b, bo->initial_x,        bo->constraint_x,
                        bo->design};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        free(arrays[i]);
    free(bo);
}

void problem_to_unit(const struct bayesopt *bo, const double *x, double *u)
{
    for (size_t j = 0; j < bo->d; j++)
        u[j] = fmin(fmax((x[j] - bo->lower[j]) / (bo->upper[j] - bo->lower[j]), 0), 1);
}

void problem_from_unit(const struct bayesopt *bo, const double *u, double *x)
{
    for (size_t j = 0; j < bo->d; j++)
        x[j] = u[j] >= 1 ? bo->upper[j]
                         : fmin(bo->lower[j] + u[j] * (bo->upper[j] - bo->lower[j]), bo->upper[j]);
}

size_t problem_budget(const struct bayesopt *bo)
{
    return bo->options.max_evaluations ? bo->options.max_evaluations : 2 * problem_initial(bo) + 10;
}

size_t problem_initial(const struct bayesopt *bo)
{
    size_t n = bo->options.initial_n;
    return bo->options.n_levels == 1 ? n : n + (n + 3) / 4;
}

size_t bayesopt_dimension(const bayesopt *bo, double *lower, double *upper)
{
    if (lower)
        memcpy(lower, bo->lower, bo->d * sizeof *lower);
    if (upper)
        memcpy(upper, bo->upper, bo->d * sizeof *upper);
    return bo->d;
}

size_t bayesopt_constraint_count(const bayesopt *bo, double *lower, double *upper)
{
    size_t m = bo->options.n_constraints;
    if (lower)
        memcpy(lower, bo->constraint_lower, m * sizeof *lower);
    if (upper)
        memcpy(upper, bo->constraint_upper, m * sizeof *upper);
    return m;
}

size_t bayesopt_budget(const bayesopt *bo)
{
    return problem_budget(bo);
}

size_t bayesopt_level_count(const bayesopt *bo)
{
    return bo->options.n_levels;
}

size_t bayesopt_initial_count(const bayesopt *bo)
{
    return problem_initial(bo);
}

uint64_t bayesopt_seed(const bayesopt *bo)
{
    return bo->options.seed;
}

bayesopt_status bayesopt_set_budget(bayesopt *bo, size_t max_evaluations)
{
    size_t before = bo->options.max_evaluations;
    bayesopt_status status = store_begin(bo);
    if (status)
        return status;
    bo->options.max_evaluations = max_evaluations;
    status = store_put_budget(bo);
    if (!status)
        status = store_commit(bo);
    if (status) {
        store_rollback(bo);
        bo->options.max_evaluations = before;
    }
    return status;
}

static bayesopt_status ensure_model(bayesopt *bo)
{
    size_t done = history_count_state(bo, BAYESOPT_STATE_DONE);
    if (done < 2)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "a model needs two successful evaluations, there are %zu", done);
    return bo->surrogates.fitted ? BAYESOPT_OK : surrogates_fit(bo, false);
}

bayesopt_status bayesopt_predict(bayesopt *bo, size_t n, const double *x, double *mean, double *sd)
{
    bayesopt_status status = ensure_model(bo);
    double *u = malloc((n ? n : 1) * (bo->d + 1) * sizeof *u);
    if (!status && !u)
        status = bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    const bayesopt_gp *gp = bo->surrogates.gps[0];
    double *var = status ? NULL : u + n * bo->d;
    for (size_t i = 0; i < n && !status; i++)
        problem_to_unit(bo, x + i * bo->d, u + i * bo->d);
    if (!status)
        status = surrogates_predict(bo, n, u, mean, var);
    for (size_t i = 0; i < n && !status; i++) {
        double half = sqrt(var[i]), centre = mean[i];
        mean[i] = bayesopt_gp_from_model(gp, centre);
        if (sd)
            sd[i] = 0.5 * (bayesopt_gp_from_model(gp, centre + half) -
                           bayesopt_gp_from_model(gp, centre - half));
    }
    free(u);
    return status;
}

static double loo_error(const bayesopt_gp *gp, size_t n)
{
    double *mean = malloc((3 * n + 1) * sizeof *mean), sum = 0;
    if (!mean || bayesopt_gp_loo(gp, mean, mean + n)) {
        free(mean);
        return NAN;
    }
    bayesopt_gp_outputs(gp, mean + 2 * n);
    for (size_t i = 0; i < n; i++)
        sum += (mean[2 * n + i] - mean[i]) * (mean[2 * n + i] - mean[i]);
    free(mean);
    return sqrt(sum / (double)n);
}

bayesopt_status bayesopt_model(bayesopt *bo, bayesopt_model_info *info, double *lengthscale)
{
    bayesopt_status status = ensure_model(bo);
    bayesopt_gp_info gp_info;
    bayesopt_gp_parameters parameters = {.lengthscale = lengthscale};
    if (!status)
        status = bayesopt_gp_get_info(bo->surrogates.gps[0], &gp_info);
    if (!status)
        status = bayesopt_gp_get_parameters(bo->surrogates.gps[0], &parameters);
    if (status)
        return status;
    for (size_t j = 0; j < bo->d && lengthscale; j++)
        lengthscale[j] *= bo->upper[j] - bo->lower[j];
    *info = (bayesopt_model_info){
        .n = gp_info.n,
        .isotropic = gp_info.isotropic,
        .wide = gp_info.wide,
        .transform = gp_info.transform,
        .log_posterior = gp_info.log_posterior,
        .jitter = gp_info.jitter,
        .signal_variance = parameters.signal,
        .noise_variance = parameters.noise,
        .loo_rms = loo_error(bo->surrogates.gps[0], gp_info.n),
        .trust_length = strategy_trust_length(bo),
    };
    return BAYESOPT_OK;
}

bayesopt_status bayesopt_minimise(bayesopt *bo, bayesopt_objective objective, void *data,
                                  bayesopt_progress progress, void *progress_data)
{
    size_t m = bo->options.n_constraints;
    double *x = malloc((bo->d + m + 1) * sizeof *x);
    if (!x)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    double *constraints = x + bo->d;
    bayesopt_status status;
    uint64_t id;
    while ((status = bayesopt_ask(bo, 1, x, &id)) == BAYESOPT_OK) {
        double f = NAN;
        int code = objective(data, bo->d, x, &f, constraints);
        if (code) {
            char reason[64];
            snprintf(reason, sizeof reason, "the objective returned %d", code);
            status = bayesopt_tell_failed(bo, id, reason);
        } else {
            status = bayesopt_tell(bo, id, f, m ? constraints : NULL);
        }
        if (!status && progress && progress(progress_data, bo))
            status = bayesopt_fail(BAYESOPT_ERROR_CANCELLED, "cancelled after %zu evaluations",
                                   bo->n_points);
        if (status)
            break;
    }
    free(x);
    return status;
}
