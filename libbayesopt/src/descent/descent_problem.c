/* A problem of a descent: its defaults, its checks and its evaluations. */
#include "core/error.h"
#include "descent/descent_model.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* Of all arrays of a problem together: 2^40 numbers. */
static const double MOST_NUMBERS = 1099511627776.0;

void bayesopt_descent_problem_init(bayesopt_descent_problem *problem)
{
    if (problem)
        *problem = (bayesopt_descent_problem){.bound = NAN};
}

static bayesopt_status check_settings(const descent_problem *p)
{
    size_t objectives = 0;
    for (size_t m = 0; m < p->n_settings; m++) {
        const bayesopt_descent_setting *s = &p->setting[m];
        if (!isfinite(s->offset) || !isfinite(s->share) || s->share < 0)
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "setting %zu: offset %g, share %g, expected numbers and a share "
                                 "that is not negative",
                                 m, s->offset, s->share);
        objectives += setting_is_objective(s);
    }
    return objectives ? BAYESOPT_OK
                      : bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                      "none of %zu settings has offset 0 and share 1, expected at "
                                      "least one for the objective",
                                      p->n_settings);
}

static bayesopt_status check_box(const descent_problem *p, const double *start)
{
    for (size_t k = 0; k < p->d; k++) {
        double x = start ? start[k] : 0;
        if (!isfinite(p->lower[k]) || !isfinite(p->upper[k]) || !(p->lower[k] < p->upper[k]))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "variable %zu: bounds %g and %g, expected finite and increasing",
                                 k, p->lower[k], p->upper[k]);
        if (!(x >= p->lower[k] && x <= p->upper[k]))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "variable %zu: starts at %g, expected %g to %g", k, x, p->lower[k],
                                 p->upper[k]);
    }
    return BAYESOPT_OK;
}

bayesopt_status descent_check(const descent_problem *p, const double *start)
{
    if (p->d < 1 || p->d > BAYESOPT_MOST_VARIABLES)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%zu variables, expected 1 to %d", p->d,
                             BAYESOPT_MOST_VARIABLES);
    NEED(p->lower);
    NEED(p->upper);
    NEED(p->setting);
    NEED(p->fine);
    if (!p->coarse && !p->derivatives)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "coarse and derivatives are both NULL");
    NEED_MOST(p->n_limits, BAYESOPT_MOST_CONSTRAINTS);
    if (p->n_settings < 1 || p->n_settings > BAYESOPT_MOST_CONSTRAINTS)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%zu settings, expected 1 to %d",
                             p->n_settings, BAYESOPT_MOST_CONSTRAINTS);
    if (p->n_residuals < 1 ||
        ((double)p->n_residuals * (double)p->n_settings + (double)p->n_state) * (double)p->d >
            MOST_NUMBERS)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "%zu residuals and a state of %zu numbers, expected at least one "
                             "residual, and derivatives that fit into a memory",
                             p->n_residuals, p->n_state);
    if (p->n_limits && !p->limit)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "n_limits is %zu without limit", p->n_limits);
    if (!isnan(p->bound) && (!p->n_state || !p->function || isinf(p->bound)))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "bound is %g, expected NAN, or a number with a state and its function",
                             p->bound);
    bayesopt_status status = check_settings(p);
    return status ? status : check_box(p, start);
}

bool sample_create(const descent_problem *p, descent_sample *s)
{
    *s = (descent_sample){0};
    s->residual = calloc(p->n_settings * p->n_residuals, sizeof *s->residual);
    s->value = calloc(p->n_settings, sizeof *s->value);
    s->state = calloc(p->n_state + 1, sizeof *s->state);
    return s->residual && s->value && s->state;
}

void sample_free(descent_sample *s)
{
    free(s->residual);
    free(s->value);
    free(s->state);
}

bool slopes_create(const descent_problem *p, const descent_model *model,
                   bayesopt_descent_slopes *slopes)
{
    *slopes = (bayesopt_descent_slopes){.residual = model->jacobian, .state = model->slope};
    slopes->known = calloc(p->n_settings, sizeof *slopes->known);
    return slopes->known != NULL;
}

bool slopes_complete(const descent_problem *p, const bayesopt_descent_slopes *slopes)
{
    bool all = slopes->state_known || !p->n_state;
    for (size_t m = 0; m < p->n_settings; m++)
        all = all && slopes->known[m];
    return all;
}

static bool all_finite(size_t n, const double *value)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(value[i]))
            return false;
    return true;
}

bayesopt_descent_answer descent_slopes(const descent_problem *p, const double *x,
                                       bayesopt_descent_slopes *s)
{
    size_t each = p->d * p->n_residuals;
    if (!p->derivatives)
        return BAYESOPT_DESCENT_VALUED;
    bayesopt_descent_answer answer = p->derivatives(p->user_data, x, s);
    bool filled = answer == BAYESOPT_DESCENT_VALUED;
    for (size_t m = 0; m < p->n_settings; m++)
        s->known[m] = filled && s->known[m] && all_finite(each, s->residual + m * each);
    s->state_known = filled && s->state_known && all_finite(p->d * p->n_state, s->state);
    return answer == BAYESOPT_DESCENT_STOP ? answer : BAYESOPT_DESCENT_VALUED;
}

bayesopt_descent_answer descent_coarse(const descent_problem *p, const double *x,
                                       const bayesopt_descent_slopes *known, descent_sample *s)
{
    if (!p->coarse)
        return BAYESOPT_DESCENT_FAILED;
    s->known = known;
    bayesopt_descent_answer answer = p->coarse(p->user_data, x, s);
    if (answer != BAYESOPT_DESCENT_VALUED)
        return answer;
    bool finite = known->state_known || all_finite(p->n_state, s->state);
    for (size_t m = 0; m < p->n_settings; m++)
        finite = finite &&
                 (known->known[m] || all_finite(p->n_residuals, s->residual + m * p->n_residuals));
    return finite ? answer : BAYESOPT_DESCENT_FAILED;
}

bayesopt_descent_answer descent_fine(const descent_problem *p, const double *x, descent_sample *s)
{
    bayesopt_descent_answer answer = p->fine(p->user_data, x, s);
    if (answer != BAYESOPT_DESCENT_VALUED)
        return answer;
    bool finite = all_finite(p->n_settings * p->n_residuals, s->residual) &&
                  all_finite(p->n_settings, s->value) && all_finite(p->n_state, s->state) &&
                  (isnan(p->bound) || isfinite(s->bounded));
    return finite ? answer : BAYESOPT_DESCENT_FAILED;
}
