/* The model of the first step, for questions before a search. */
#include "core/error.h"
#include "descent/descent_model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bayesopt_status bayesopt_descent_model_create(const bayesopt_descent_problem *problem,
                                              const double *start, bayesopt_descent_model **result)
{
    if (result)
        *result = NULL;
    NEED(problem);
    NEED(result);
    bayesopt_status status = descent_check(problem, start);
    if (status)
        return status;
    descent_model *model = calloc(1, sizeof *model);
    bool ok = model && descent_model_init(problem, model);
    status =
        ok ? descent_start(model, start) : bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    if (!status)
        status = descent_differentiate(model);
    if (status == BAYESOPT_STOP_BUDGET)
        status = bayesopt_fail(BAYESOPT_ERROR_CANCELLED, "an evaluation said stop");
    if (status)
        bayesopt_descent_model_free(model);
    else
        *result = model;
    return status;
}

void bayesopt_descent_model_free(bayesopt_descent_model *model)
{
    if (!model)
        return;
    descent_model_clear(model);
    free(model);
}

/* Whether other bounds may be asked of a model. */
static bayesopt_status check_alike(const descent_problem *a, const descent_problem *b)
{
    if (a->d != b->d || a->n_settings != b->n_settings || a->n_residuals != b->n_residuals ||
        a->n_state != b->n_state)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "%zu variables, %zu settings of %zu residuals and a state of %zu "
                             "numbers, expected %zu, %zu, %zu and %zu",
                             b->d, b->n_settings, b->n_residuals, b->n_state, a->d, a->n_settings,
                             a->n_residuals, a->n_state);
    return !isnan(b->bound) && isnan(a->bound)
               ? bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                               "bound is %g of a model that was made without one", b->bound)
               : BAYESOPT_OK;
}

bayesopt_status bayesopt_descent_model_minimise(bayesopt_descent_model *model,
                                                const bayesopt_descent_problem *problem,
                                                const double *centre, double radius, double margin,
                                                double *x, double *least, double *broken)
{
    NEED(model);
    NEED(x);
    NEED(least);
    const descent_problem *own = model->problem;
    if (!problem)
        problem = own;
    bayesopt_status status = descent_check(problem, model->x);
    if (!status)
        status = check_alike(own, problem);
    if (status)
        return status;
    if (!(radius > 0) || !isfinite(margin))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "radius %g and margin %g, expected a positive one and a number",
                             radius, margin);
    for (size_t k = 0; k < own->d && centre; k++)
        if (!isfinite(centre[k]))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "variable %zu of centre is %g", k,
                                 centre[k]);
    double over = 0;
    memcpy(model->anchor, centre ? centre : model->x, own->d * sizeof *x);
    model->problem = problem;
    model->margin = margin;
    status = descent_model_step(model, radius, x, &over, least);
    model->problem = own;
    if (status)
        return status;
    for (size_t k = 0; k < own->d; k++)
        x[k] = fmin(fmax(model->x[k] + x[k], problem->lower[k]), problem->upper[k]);
    if (broken)
        *broken = over;
    return isnan(*least)
               ? bayesopt_fail(BAYESOPT_ERROR_INFEASIBLE,
                               "no point within %g half widths keeps the %zu known limits", radius,
                               problem->n_limits)
               : BAYESOPT_OK;
}
