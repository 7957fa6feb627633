#include "core/conventional.h"

#include "core/constraints.h"
#include "methods.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Half widths of the box: the first step of local methods, and of the differences of sqp, which
 * pass over the noise of C_w (1e-5) and stay where it is nearly linear. */
static const double FIRST_STEP = 0.25, DIFFERENCE = 0.01;
static const double LIMIT_STEP = 1e-5;  /* of the differences of the known limits */
static const double X_TOLERANCE = 1e-3; /* half widths, where a local method ends */

struct conventional {
    struct ledger ledger;
    nlopt_opt opt;
    double *moved, *side; /* a design, and values beside it */
};

static double half_width(const struct conventional *c, size_t k)
{
    const galv_model *model = c->ledger.search->problem->model;
    return (galv_model_upper(model)[k] - galv_model_lower(model)[k]) / 2;
}

/* Objective and outcomes beside each other, from one look. */
static size_t collect(struct conventional *c, const double *u, double *values)
{
    struct seen seen;
    if (!ledger_look(&c->ledger, u, &seen))
        nlopt_force_stop(c->opt);
    values[0] = seen.objective;
    memcpy(values + 1, seen.outcome, c->ledger.outcomes * sizeof *values);
    return 1 + c->ledger.outcomes;
}

/* slope[values][n] by one-sided differences, each an evaluation on record. */
static void differentiate(struct conventional *c, const double *u, const double *at, double *slope)
{
    const struct ledger *l = &c->ledger;
    const double *upper = galv_model_upper(l->search->problem->model);
    memcpy(c->moved, u, l->n * sizeof *u);
    for (size_t k = 0; k < l->n; k++) {
        double step = DIFFERENCE * half_width(c, k);
        step = u[k] + step > upper[k] ? -step : step;
        c->moved[k] = u[k] + step;
        size_t values = collect(c, c->moved, c->side);
        for (size_t i = 0; i < values; i++)
            slope[i * l->n + k] = (c->side[i] - at[i]) / step;
        c->moved[k] = u[k];
    }
}

static double objective(unsigned n, const double *u, double *gradient, void *data)
{
    struct conventional *c = data;
    double value;
    if (!c->ledger.method->constraints) {
        if (!ledger_penalised(&c->ledger, u, &value))
            nlopt_force_stop(c->opt);
        return value;
    }
    double *at = c->side + 1 + c->ledger.outcomes, *slope = at + 1 + c->ledger.outcomes;
    collect(c, u, at);
    if (gradient) {
        differentiate(c, u, at, slope);
        memcpy(gradient, slope, n * sizeof *gradient);
    }
    return at[0];
}

static void outcomes(unsigned m, double *value, unsigned n, const double *u, double *gradient,
                     void *data)
{
    struct conventional *c = data;
    double *at = c->side + 1 + m, *slope = at + 1 + m;
    collect(c, u, at);
    memcpy(value, at + 1, m * sizeof *value);
    if (!gradient)
        return;
    differentiate(c, u, at, slope);
    memcpy(gradient, slope + n, (size_t)m * n * sizeof *gradient);
}

static void known(unsigned m, double *value, unsigned n, const double *u, double *gradient,
                  void *data)
{
    struct conventional *c = data;
    struct problem *problem = c->ledger.search->problem;
    bool ok = limits_evaluate(problem, n, u, value) == 0;
    for (unsigned i = 0; i < m && !ok; i++)
        value[i] = 1;
    if (!gradient)
        return;
    double *side = c->side + 2 * (1 + c->ledger.outcomes) * (1 + (size_t)n);
    memcpy(c->moved, u, n * sizeof *u);
    for (unsigned k = 0; k < n; k++) {
        double step = LIMIT_STEP * half_width(c, k);
        for (unsigned s = 0; s < 2; s++) {
            c->moved[k] = s ? u[k] + step : u[k] - step;
            ok = limits_evaluate(problem, n, c->moved, side + s * m) == 0 && ok;
        }
        for (unsigned i = 0; i < m; i++)
            gradient[i * n + k] = ok ? (side[m + i] - side[i]) / (2 * step) : 0;
        c->moved[k] = u[k];
    }
}

static bool add_constraints(struct conventional *c)
{
    const struct ledger *l = &c->ledger;
    size_t most = l->limits > l->outcomes ? l->limits : l->outcomes;
    double *tolerance = malloc((most + 1) * sizeof *tolerance);
    bool ok = tolerance != NULL;
    for (size_t i = 0; i < most && ok; i++)
        tolerance[i] = OUTSIDE / 2;
    ok = ok &&
         nlopt_add_inequality_mconstraint(c->opt, (unsigned)l->limits, known, c, tolerance) > 0;
    if (ok && l->outcomes)
        ok = nlopt_add_inequality_mconstraint(c->opt, (unsigned)l->outcomes, outcomes, c,
                                              tolerance) > 0;
    free(tolerance);
    return ok;
}

static bool prepare(struct conventional *c, double *steps)
{
    const struct ledger *l = &c->ledger;
    const galv_model *model = l->search->problem->model;
    for (size_t k = 0; k < l->n; k++)
        steps[k] = FIRST_STEP * half_width(c, k);
    bool ok = nlopt_set_min_objective(c->opt, objective, c) > 0 &&
              nlopt_set_lower_bounds(c->opt, galv_model_lower(model)) > 0 &&
              nlopt_set_upper_bounds(c->opt, galv_model_upper(model)) > 0 &&
              nlopt_set_initial_step(c->opt, steps) > 0;
    for (size_t k = 0; k < l->n; k++)
        steps[k] = X_TOLERANCE * half_width(c, k);
    return ok && nlopt_set_xtol_abs(c->opt, steps) > 0 &&
           (!l->method->constraints || add_constraints(c));
}

bool conventional_run(struct search *search, const struct method_row *method)
{
    struct conventional c = {.opt = NULL};
    bool ok = ledger_open(search, method, &c.ledger);
    const struct ledger *l = &c.ledger;
    size_t n = l->n, values = 1 + l->outcomes;
    double *u = calloc(3 * n, sizeof *u), least;
    c.side = malloc((2 * values * (1 + n) + 2 * l->limits) * sizeof *c.side);
    c.opt = nlopt_create(method->algorithm, (unsigned)n);
    if (ok && u && c.side && c.opt) {
        c.moved = u + n;
        nlopt_srand((unsigned long)search->problem->config->search_seed);
        ok = prepare(&c, u + 2 * n) || core_fail("search: %s cannot be set up", method->name);
        if (ok) {
            nlopt_result result = nlopt_optimize(c.opt, u, &least);
            ok = result == NLOPT_OUT_OF_MEMORY
                     ? core_no_memory()
                     : ledger_stop(&c.ledger, "the method ended by itself");
        }
    } else {
        ok = ok && core_no_memory();
    }
    nlopt_destroy(c.opt);
    ledger_close(&c.ledger);
    free(u);
    free(c.side);
    return ok;
}
