/* Options of an optimisation: names, defaults, checks. */
#include "core/error.h"
#include "core/front.h"
#include "problem/internal.h"
#include "threads.h"

#include <math.h>

const char *bayesopt_phase_name(bayesopt_phase phase)
{
    static const char *const names[] = {"initial", "global",   "local",
                                        "polish",  "external", "descent"};
    return (unsigned)phase < sizeof names / sizeof *names ? names[phase] : "unknown";
}

const char *bayesopt_state_name(bayesopt_state state)
{
    static const char *const names[] = {"pending", "done", "failed", "lost"};
    return (unsigned)state < sizeof names / sizeof *names ? names[state] : "unknown";
}

const char *bayesopt_strategy_name(bayesopt_strategy strategy)
{
    static const char *const names[] = {"auto", "global", "local"};
    return (unsigned)strategy < sizeof names / sizeof *names ? names[strategy] : "unknown";
}

const char *bayesopt_kind_name(bayesopt_kind kind)
{
    static const char *const names[] = {"real", "log", "integer", "categorical"};
    return (unsigned)kind < sizeof names / sizeof *names ? names[kind] : "unknown";
}

void bayesopt_options_init(bayesopt_options *options)
{
    if (!options)
        return;
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
        .n_objectives = 1,
        .level_cost_ratio = 0.1,
    };
}

static bayesopt_status check_box(size_t d, const double *lower, const double *upper,
                                 const bayesopt_options *o)
{
    if (d < 1 || d > BAYESOPT_MOST_VARIABLES)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%zu variables, expected 1 to %d", d,
                             BAYESOPT_MOST_VARIABLES);
    if (!lower || !upper)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%s is NULL", lower ? "upper" : "lower");
    for (size_t j = 0; j < d; j++)
        if (!isfinite(lower[j]) || !isfinite(upper[j]) || !(lower[j] <= upper[j]) ||
            !isfinite(upper[j] - lower[j]))
            return bayesopt_fail(
                BAYESOPT_ERROR_ARGUMENT,
                "variable %zu: bounds %g and %g, expected finite and not decreasing", j, lower[j],
                upper[j]);
    for (size_t j = 0; j < d && o->kind; j++) {
        bool whole = o->kind[j] == BAYESOPT_KIND_INTEGER || o->kind[j] == BAYESOPT_KIND_CATEGORICAL;
        if ((unsigned)o->kind[j] > BAYESOPT_KIND_CATEGORICAL)
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "variable %zu: kind %d is not known", j,
                                 (int)o->kind[j]);
        if (whole && (lower[j] != floor(lower[j]) || upper[j] != floor(upper[j]) ||
                      upper[j] - lower[j] >= BAYESOPT_MOST_VALUES))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "variable %zu: bounds %g and %g of whole numbers, expected whole "
                                 "ones and at most %d values",
                                 j, lower[j], upper[j], BAYESOPT_MOST_VALUES);
        if (o->kind[j] == BAYESOPT_KIND_LOG && !(lower[j] > 0))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "variable %zu: lower bound %g on a scale of logarithms, expected "
                                 "positive",
                                 j, lower[j]);
    }
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

static bayesopt_status check_sizes(const bayesopt_options *o)
{
    const struct {
        const char *name;
        size_t n, most;
    } sizes[] = {
        {"initial_n", o->initial_n, BAYESOPT_MOST_POINTS},
        {"n_constraints", o->n_constraints, BAYESOPT_MOST_CONSTRAINTS},
        {"n_input_constraints", o->n_input_constraints, BAYESOPT_MOST_CONSTRAINTS},
        {"n_linear", o->n_linear, BAYESOPT_MOST_CONSTRAINTS},
        {"n_conditions", o->n_conditions, BAYESOPT_MOST_CONSTRAINTS},
        {"n_first", o->n_first, BAYESOPT_MOST_POINTS},
    };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        if (sizes[i].n > sizes[i].most)
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%s is %zu, expected at most %zu",
                                 sizes[i].name, sizes[i].n, sizes[i].most);
    return BAYESOPT_OK;
}

bayesopt_status options_check(size_t d, const double *lower, const double *upper,
                              const bayesopt_options *o)
{
    bayesopt_status status = check_box(d, lower, upper, o);
    if (!status)
        status = check_enumerations(o);
    if (!status)
        status = check_sizes(o);
    if (status)
        return status;
    if (o->n_objectives < 1 || o->n_objectives > FRONT_MOST_OBJECTIVES)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%zu objectives, expected 1 to %d",
                             o->n_objectives, FRONT_MOST_OBJECTIVES);
    if (o->n_objectives > 1 &&
        (o->n_levels > 1 || o->acquisition != BAYESOPT_ACQUISITION_EI || o->stop_no_improvement ||
         o->stop_expected_improvement > 0 || o->strategy == BAYESOPT_STRATEGY_LOCAL))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "%zu objectives are searched over the whole box, on one level, by "
                             "expected improvement and to the end of the budget",
                             o->n_objectives);
    if (o->initial_x && !o->initial_n)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "initial_x without initial_n");
    for (size_t i = 0; o->initial_x && i < o->initial_n * d; i++)
        if (!(o->initial_x[i] >= lower[i % d] && o->initial_x[i] <= upper[i % d]))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "initial_x: variable %zu of point %zu is %g, expected %g to %g",
                                 i % d, i / d, o->initial_x[i], lower[i % d], upper[i % d]);
    if (o->n_first && (!o->first_x || o->initial_x))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "n_first is %zu %s", o->n_first,
                             o->first_x ? "beside a whole design of one's own, initial_x"
                                        : "without first_x");
    if (o->told_count && (o->n_levels > 1 || o->initial_x))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "told_count: points told count for the design of one level, and not "
                             "beside one of one's own");
    for (size_t j = 0; j < d && o->kind && o->mean == BAYESOPT_MEAN_LINEAR; j++)
        if (o->kind[j] == BAYESOPT_KIND_CATEGORICAL)
            return bayesopt_fail(
                BAYESOPT_ERROR_ARGUMENT,
                "variable %zu is categorical, which has no slope for a linear mean", j);
    if (o->n_conditions && !o->conditions)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "n_conditions is %zu without conditions",
                             o->n_conditions);
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
    if (!threads_are(o->threads))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "threads is %g, expected a whole number from 0 to %d", o->threads,
                             MOST_THREADS);
    if (!(o->lcb_factor > 0 && isfinite(o->lcb_factor)))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "lcb_factor is %g, expected positive",
                             o->lcb_factor);
    if (!(o->stop_expected_improvement >= 0))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "stop_expected_improvement is %g, expected not negative",
                             o->stop_expected_improvement);
    return BAYESOPT_OK;
}
