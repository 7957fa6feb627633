#include "core/forecast.h"

#include "core/constraints.h"
#include "core/residuals.h"

#include <math.h>
#include <stdlib.h>

/* Of initial designs: how far the model is asked to look, and how far inside of the limits; the
 * latter of a forecast too. */
static const double DESIGN_RADIUS = 0.5, DESIGN_MARGIN = 0.01, FORECAST_MARGIN = 2e-3;
enum { DRAWS = 2 };                          /* points tried for each */
static const double FORECAST_OUTSIDE = 1e-4; /* no step keeps the limits */

/* The parent alone is valued. */
static bayesopt_descent_answer value_parent(void *user_data, const double *u,
                                            bayesopt_descent_sample *sample)
{
    struct descent *d = user_data;
    struct evaluation e;
    d->sample = sample;
    d->at = u;
    evaluation_start(0, "parent", NULL, &e);
    evaluate_parent(d->base, &e, descent_look, d);
    if (e.failed)
        return BAYESOPT_DESCENT_FAILED;
    descent_keep(d, &e, sample);
    return BAYESOPT_DESCENT_VALUED;
}

/* Without the constraint of row k: whether there was one. */
static bool drop(const struct config *config, size_t k, struct config *without)
{
    *without = *config;
    return constraints_drop(without, k);
}

static bool least(struct descent *d, bayesopt_descent_model *model, const struct config *config,
                  double *step, double *ratio)
{
    const struct config *keep = d->base->config;
    d->base->config = config;
    bayesopt_descent_problem problem = d->problem;
    bayesopt_descent_setting setting[SETTINGS_MOST];
    problem.setting = setting;
    problem.bound = config->pressure;
    problem.n_limits = limits_count(config);
    descent_weigh(config, problem.n_settings, setting);
    double broken;
    bayesopt_status status = bayesopt_descent_model_minimise(model, &problem, NULL, INFINITY,
                                                             FORECAST_MARGIN, step, ratio, &broken);
    d->base->config = keep;
    if (status || !(broken < FORECAST_OUTSIDE))
        *ratio = INFINITY;
    return status != BAYESOPT_ERROR_MEMORY || core_no_memory();
}

static bool fill(struct descent *d, bayesopt_descent_model *model, struct forecast *f, double *step)
{
    struct config other = *d->base->config;
    bool ok = true;
    for (size_t i = 0; i < FORECAST_SHARES && other.models && ok; i++) {
        double share = FORECAST_SHARE[i];
        other.confirm = share == 1 ? NAN : share;
        ok = least(d, model, &other, step, &f->confirmed[i]);
    }
    ok = ok && least(d, model, d->base->config, step, &f->asked);
    for (size_t k = 0; k < constraints_count() && k < FORECAST_ROWS && ok; k++)
        if (drop(d->base->config, k, &other))
            ok = least(d, model, &other, step, &f->without[k]);
    return ok;
}

/* The model at the original; descent_end() is to be called whatever comes of it. */
static bool model_parent(struct problem *problem, struct descent *d, bayesopt_descent_model **model)
{
    if (!descent_start(problem, NULL, d))
        return false;
    d->problem.fine = value_parent;
    bayesopt_status status = bayesopt_descent_model_create(&d->problem, NULL, model);
    if (!status)
        return true;
    const char *why = status == BAYESOPT_ERROR_NUMERIC && *core_sentence() ? core_sentence()
                                                                           : bayesopt_last_error();
    return core_fail("%s: the derivatives at the original cannot be had (%s)",
                     problem->config->path, why);
}

bool forecast_run(struct problem *problem, struct forecast *f)
{
    bayesopt_descent_model *model;
    struct descent d = {0};
    for (size_t k = 0; k < FORECAST_ROWS; k++)
        f->without[k] = NAN;
    for (size_t i = 0; i < FORECAST_SHARES; i++)
        f->confirmed[i] = NAN;
    double *step = calloc(galv_model_modes(problem->model), sizeof *step);
    bool ok = (step || core_no_memory()) && model_parent(problem, &d, &model);
    if (ok) {
        ok = fill(&d, model, f, step);
        f->solves = d.differentiated;
        f->tangents = d.tangents;
        f->settings = d.problem.n_settings;
        bayesopt_descent_model_free(model);
    }
    descent_end(&d);
    free(step);
    return ok;
}

/* Where the model promises most about each point of a Latin hypercube: designs unlike each other,
 * all of which keep the limits by the model. The first is that of the whole box. */
static bool fill_design(const bayesopt_descent_problem *p, bayesopt_descent_model *model, size_t n,
                        double *cube, double *u)
{
    size_t made = 0;
    bayesopt_status status = BAYESOPT_OK;
    for (size_t i = 0; i < DRAWS * n && made < n && status != BAYESOPT_ERROR_MEMORY; i++) {
        double *centre = cube + i * p->d, ratio;
        for (size_t k = 0; k < p->d; k++)
            centre[k] = p->lower[k] + centre[k] * (p->upper[k] - p->lower[k]);
        double radius = i ? DESIGN_RADIUS : INFINITY;
        status = bayesopt_descent_model_minimise(model, NULL, centre, radius, DESIGN_MARGIN,
                                                 u + made * p->d, &ratio, NULL);
        made += status == BAYESOPT_OK;
    }
    if (status == BAYESOPT_ERROR_MEMORY)
        return core_no_memory();
    return made == n || core_fail("only %zu of %zu initial designs keep the known limits", made, n);
}

bool forecast_design(struct problem *problem, size_t n, double *u)
{
    bayesopt_descent_model *model;
    struct descent d = {0};
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.seed = problem->config->search_seed;
    size_t modes = galv_model_modes(problem->model);
    double *cube = malloc(DRAWS * n * modes * sizeof *cube);
    bool ok =
        (cube || core_no_memory()) &&
        (bayesopt_design(BAYESOPT_DESIGN_LHS, DRAWS * n, modes, &options, cube) == BAYESOPT_OK ||
         core_fail("%s", bayesopt_last_error())) &&
        model_parent(problem, &d, &model);
    if (ok) {
        ok = fill_design(&d.problem, model, n, cube, u);
        bayesopt_descent_model_free(model);
    }
    descent_end(&d);
    free(cube);
    return ok;
}
