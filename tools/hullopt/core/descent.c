#include "core/descent.h"

#include "cli.h"
#include "core/constraints.h"
#include "core/forecast.h"
#include "core/objective.h"

#include <bayesopt/descent.h>
#include <igabem/residual.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The coarse mesh for derivatives: three quarters of the elements each way, ten times the tolerance
 * of the quadrature. */
static const double COARSE_SHARE = 0.75, COARSE_TOLERANCE = 10;
/* Of initial designs: how far the model is asked to look, and how far inside of the limits; the
 * latter of a forecast too. */
static const double DESIGN_RADIUS = 0.5, DESIGN_MARGIN = 0.01, FORECAST_MARGIN = 2e-3;
enum { DRAWS = 2 };                          /* points tried for each */
static const double UNREACHED = 1e3;         /* finite: SLSQP computes with it */
static const double FORECAST_OUTSIDE = 1e-4; /* no step keeps the limits */
enum {
    ALONG = 60, /* samples of the pressure */
    AROUND = 16,
    /* Those of the waves, and one for the friction where the total resistance is lowered. */
    RESIDUALS = IGABEM_WAVE_RESIDUALS + 1,
    POINT = sizeof(igabem_pressure_sample) / sizeof(double)
};

struct descent {
    struct problem *base;
    struct search *search; /* NULL: a forecast, which keeps no record */
    bayesopt_descent_problem problem;
    size_t points;                   /* of the pressure; 0: not bounded */
    bayesopt_descent_sample *sample; /* to be filled by look() */
    igabem_options coarse[SETTINGS_MOST];
    size_t valued, differentiated;
    bool ok; /* the record took everything */
};

static bool look(void *user_data, igabem_solution *const *solutions)
{
    struct descent *d = user_data;
    bayesopt_descent_sample *s = d->sample;
    for (size_t m = 0; m < d->problem.n_settings; m++)
        if (igabem_wave_residuals(solutions[m], s->residual + m * RESIDUALS) != IGABEM_OK)
            return core_fail("forces: %s", igabem_last_error());
    if (!d->points)
        return true;
    igabem_pressure_sample *point;
    size_t n;
    if (igabem_pressure_samples(solutions[0], ALONG, AROUND, &n, &point) != IGABEM_OK)
        return core_fail("forces: %s", igabem_last_error());
    bool same = n == d->points;
    if (same)
        memcpy(s->state, point, n * sizeof *point);
    free(point);
    return same ||
           core_fail("forces: %zu samples of the pressure, the parent has %zu", n, d->points);
}

/* What is lowered in place of C_w by the settings at flow.froude: (C_w + (1 + k) C_f) S / S_0 of
 * the original's surface S_0. A resistance is a sum of squares too: each residual times sqrt(S /
 * S_0), and one more for the friction. */
static void take_surface(const struct descent *d, double area, bool valued,
                         bayesopt_descent_sample *s)
{
    const struct config *config = d->base->config;
    double share = area / nurbs_hull_hydrostatics(d->base->parent.hull)->wetted_area;
    double friction = objective_friction(config, problem_length(d->base));
    for (size_t m = 0; m < d->problem.n_settings; m++) {
        double *r = s->residual + m * RESIDUALS;
        bool counts = m <= config->models && config->quantity != QUANTITY_CW;
        for (int i = 0; i < IGABEM_WAVE_RESIDUALS && counts; i++)
            r[i] *= sqrt(share);
        r[IGABEM_WAVE_RESIDUALS] = counts ? sqrt(friction * share) : 0;
        if (valued && counts)
            s->value[m] = (s->value[m] + friction) * share;
    }
}

static bool is_parent(const struct descent *d, const double *u)
{
    for (size_t k = 0; k < d->problem.d; k++)
        if (u[k] != 0)
            return false;
    return true;
}

/* Whether the design is on record already: 1, 0, or -1 after a failure. */
static int is_recorded(const struct descent *d, const double *u)
{
    struct evaluation *list;
    size_t n;
    int found = 0;
    if (!record_evaluations(d->search->record, &list, &n))
        return -1;
    for (size_t i = 0; i < n && !found; i++)
        found = memcmp(list[i].u, u, d->problem.d * sizeof *u) == 0;
    free(list);
    return found;
}

static void keep_values(const struct evaluation *e, bayesopt_descent_sample *sample)
{
    sample->value[0] = e->cw;
    memcpy(sample->value + 1, e->cw_model, e->models * sizeof *e->cw_model);
    memcpy(sample->value + 1 + e->models, e->cw_speed, e->speeds * sizeof *e->cw_speed);
    sample->bounded = e->cw_pressure;
}

static bayesopt_descent_answer fine(void *user_data, const double *u,
                                    bayesopt_descent_sample *sample)
{
    struct descent *d = user_data;
    struct search *search = d->search;
    struct evaluation e;
    bool parent = is_parent(d, u);
    if (!parent && d->valued == search->problem->config->iterations)
        return BAYESOPT_DESCENT_STOP;
    d->sample = sample;
    evaluation_start(0, "descent", u, &e);
    int recorded = parent ? 1 : is_recorded(d, u);
    if (parent)
        evaluate_parent(search->problem, &e, look, d);
    else if (recorded == 1)
        evaluate(search->problem, &e, look, d);
    if (recorded < 0 || (recorded == 0 && !search_step(search, &e, look, d))) {
        d->ok = false;
        return BAYESOPT_DESCENT_STOP;
    }
    d->valued += !parent;
    if (e.failed)
        return BAYESOPT_DESCENT_FAILED;
    keep_values(&e, sample);
    take_surface(d, e.wetted_area, true, sample);
    return BAYESOPT_DESCENT_VALUED;
}

static bayesopt_descent_answer coarse(void *user_data, const double *u,
                                      bayesopt_descent_sample *sample)
{
    struct descent *d = user_data;
    struct design design;
    igabem_solution *solutions[SETTINGS_MOST];
    char what[80];
    snprintf(what, sizeof what, "derivatives, solve %zu", ++d->differentiated);
    if (d->search) {
        search_show(d->search, what);
        d->ok = core_goes_on(d->search->watch);
    }
    if (!d->ok)
        return BAYESOPT_DESCENT_STOP;
    if (!problem_build(d->base, u, &design))
        return BAYESOPT_DESCENT_FAILED;
    bool ok =
        igabem_solve_many(design.body, d->problem.n_settings, d->coarse, solutions) == IGABEM_OK;
    if (ok) {
        d->sample = sample;
        ok = look(d, solutions);
        if (ok)
            take_surface(d, nurbs_hull_hydrostatics(design.hull)->wetted_area, false, sample);
        for (size_t m = 0; m < d->problem.n_settings; m++)
            igabem_solution_free(solutions[m]);
    }
    design_free(&design);
    return ok ? BAYESOPT_DESCENT_VALUED : BAYESOPT_DESCENT_FAILED;
}

static int limit(void *user_data, size_t n, const double *u, double *value)
{
    struct descent *d = user_data;
    return limits_evaluate(d->base, n, u, value);
}

static double pressure(void *user_data, const double *state, double *gradient)
{
    const struct descent *d = user_data;
    return igabem_pressure_sum(d->points, (const igabem_pressure_sample *)state,
                               (igabem_pressure_sample *)gradient);
}

static void show_line(void *user_data, const char *sentence)
{
    const struct descent *d = user_data;
    core_tell(d->search->watch, "design %zu: %s", d->valued, sentence);
    search_show(d->search, sentence);
}

static void coarsen(igabem_options *options)
{
    options->elements_u = (int)lround(COARSE_SHARE * options->elements_u);
    options->elements_v = (int)lround(COARSE_SHARE * options->elements_v);
    options->tolerance *= COARSE_TOLERANCE;
}

double descent_coarse_seconds(const struct problem *problem)
{
    igabem_options settings[SETTINGS_MOST];
    igabem_solution *solutions[SETTINGS_MOST];
    size_t n = evaluate_settings(problem, settings);
    for (size_t m = 0; m < n; m++)
        coarsen(&settings[m]);
    double start = cli_seconds();
    if (igabem_solve_many(problem->parent.body, n, settings, solutions) != IGABEM_OK)
        return NAN;
    double seconds = cli_seconds() - start;
    for (size_t m = 0; m < n; m++)
        igabem_solution_free(solutions[m]);
    return seconds;
}

/* Of the samples of the pressure that every design has. */
static bool count_points(struct descent *d)
{
    struct problem *problem = d->base;
    igabem_solution *solution;
    if (isnan(problem->config->pressure))
        return true;
    if (igabem_solve(problem->parent.body, &d->coarse[0], &solution) != IGABEM_OK)
        return core_fail("%s", igabem_last_error());
    bool ok = igabem_pressure_samples(solution, ALONG, AROUND, &d->points, NULL) == IGABEM_OK ||
              core_fail("%s", igabem_last_error());
    igabem_solution_free(solution);
    d->problem.n_state = POINT * d->points;
    d->problem.function = pressure;
    return ok;
}

/* What a setting counts for: objective, confirmation, or another speed. */
static bayesopt_descent_setting weigh(const struct config *config, size_t m)
{
    if (m > config->models)
        return (bayesopt_descent_setting){isnan(config->speeds) ? UNREACHED : config->speeds, 0};
    if (m == 0 || isnan(config->confirm))
        return (bayesopt_descent_setting){0, 1};
    return (bayesopt_descent_setting){1 - config->confirm, config->confirm};
}

/* setting: room for SETTINGS_MOST, borrowed. */
static bool start(struct problem *base, bayesopt_descent_setting *setting, struct descent *d)
{
    const struct config *config = base->config;
    d->base = base;
    d->ok = true;
    bayesopt_descent_problem *p = &d->problem;
    bayesopt_descent_problem_init(p);
    p->d = galv_model_modes(base->model);
    p->lower = galv_model_lower(base->model);
    p->upper = galv_model_upper(base->model);
    p->n_settings = evaluate_settings(base, d->coarse);
    p->setting = setting;
    p->n_residuals = RESIDUALS;
    p->bound = config->pressure;
    p->n_limits = limits_count(config);
    p->limit = limit;
    p->coarse = coarse;
    p->fine = fine;
    p->tell = show_line;
    p->user_data = d;
    for (size_t m = 0; m < d->problem.n_settings; m++) {
        coarsen(&d->coarse[m]);
        setting[m] = weigh(config, m);
    }
    return count_points(d);
}

bool descent_run(struct search *search, double *u)
{
    bayesopt_descent_setting setting[SETTINGS_MOST];
    char *stop;
    if (!record_get_text(search->record, "stop", &stop))
        return false;
    bool stopped = stop != NULL;
    free(stop);
    if (stopped)
        return true;
    struct descent d = {.search = search};
    if (!start(search->problem, setting, &d))
        return false;
    memset(u, 0, d.problem.d * sizeof *u);
    if (bayesopt_descend(&d.problem, u, NULL) < 0)
        return d.ok && core_fail("%s: %s", search->problem->config->path, bayesopt_last_error());
    return d.ok &&
           record_put_text(search->record, "stop",
                           d.valued == search->problem->config->iterations ? "budget spent"
                                                                           : "no step gains more");
}

/* The parent alone is valued. */
static bayesopt_descent_answer value_parent(void *user_data, const double *u,
                                            bayesopt_descent_sample *sample)
{
    struct descent *d = user_data;
    struct evaluation e;
    (void)u;
    d->sample = sample;
    evaluation_start(0, "parent", NULL, &e);
    evaluate_parent(d->base, &e, look, d);
    if (e.failed)
        return BAYESOPT_DESCENT_FAILED;
    keep_values(&e, sample);
    take_surface(d, e.wetted_area, true, sample);
    return BAYESOPT_DESCENT_VALUED;
}

/* Without the constraint of row k: whether there was one. */
static bool drop(const struct config *config, size_t k, struct config *without)
{
    *without = *config;
    return constraints_drop(without, k);
}

static double least(struct descent *d, bayesopt_descent_model *model, const struct config *config,
                    double *step)
{
    const struct config *keep = d->base->config;
    d->base->config = config;
    bayesopt_descent_problem problem = d->problem;
    bayesopt_descent_setting setting[SETTINGS_MOST];
    problem.setting = setting;
    problem.bound = config->pressure;
    problem.n_limits = limits_count(config);
    for (size_t m = 0; m < d->problem.n_settings; m++)
        setting[m] = weigh(config, m);
    double broken, ratio;
    bayesopt_status status = bayesopt_descent_model_minimise(
        model, &problem, NULL, INFINITY, FORECAST_MARGIN, step, &ratio, &broken);
    d->base->config = keep;
    return !status && broken < FORECAST_OUTSIDE ? ratio : NAN;
}

static void fill(struct descent *d, bayesopt_descent_model *model, struct forecast *f, double *step)
{
    struct config other = *d->base->config;
    for (size_t i = 0; i < FORECAST_SHARES && other.models; i++) {
        double share = FORECAST_SHARE[i];
        other.confirm = share == 1 ? NAN : share;
        f->confirmed[i] = least(d, model, &other, step);
    }
    f->asked = least(d, model, d->base->config, step);
    for (size_t k = 0; k < constraints_count() && k < FORECAST_ROWS; k++)
        f->without[k] = drop(d->base->config, k, &other) ? least(d, model, &other, step) : NAN;
}

/* The model at the original; setting: room for SETTINGS_MOST, borrowed. */
static bool model_parent(struct problem *problem, bayesopt_descent_setting *setting,
                         struct descent *d, bayesopt_descent_model **model)
{
    if (!start(problem, setting, d))
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
    bayesopt_descent_setting setting[SETTINGS_MOST];
    bayesopt_descent_model *model;
    struct descent d = {.search = NULL};
    for (size_t k = 0; k < FORECAST_ROWS; k++)
        f->without[k] = NAN;
    for (size_t i = 0; i < FORECAST_SHARES; i++)
        f->confirmed[i] = NAN;
    double *step = calloc(galv_model_modes(problem->model), sizeof *step);
    bool ok = (step || core_no_memory()) && model_parent(problem, setting, &d, &model);
    if (ok) {
        fill(&d, model, f, step);
        f->solves = d.differentiated;
        bayesopt_descent_model_free(model);
    }
    free(step);
    return ok;
}

/* Where the model promises most about each point of a Latin hypercube: designs unlike each other,
 * all of which keep the limits by the model. The first is that of the whole box. */
static bool fill_design(const bayesopt_descent_problem *p, bayesopt_descent_model *model, size_t n,
                        double *cube, double *u)
{
    size_t made = 0;
    for (size_t i = 0; i < DRAWS * n && made < n; i++) {
        double *centre = cube + i * p->d, ratio;
        for (size_t k = 0; k < p->d; k++)
            centre[k] = p->lower[k] + centre[k] * (p->upper[k] - p->lower[k]);
        double radius = i ? DESIGN_RADIUS : INFINITY;
        if (bayesopt_descent_model_minimise(model, NULL, centre, radius, DESIGN_MARGIN,
                                            u + made * p->d, &ratio, NULL) == BAYESOPT_OK)
            made++;
    }
    return made == n || core_fail("only %zu of %zu initial designs keep the known limits", made, n);
}

bool descent_design(struct problem *problem, size_t n, double *u)
{
    bayesopt_descent_setting setting[SETTINGS_MOST];
    bayesopt_descent_model *model;
    struct descent d = {.search = NULL};
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.seed = problem->config->search_seed;
    size_t modes = galv_model_modes(problem->model);
    double *cube = malloc(DRAWS * n * modes * sizeof *cube);
    bool ok =
        (cube || core_no_memory()) &&
        (bayesopt_design(BAYESOPT_DESIGN_LHS, DRAWS * n, modes, &options, cube) == BAYESOPT_OK ||
         core_fail("%s", bayesopt_last_error())) &&
        model_parent(problem, setting, &d, &model);
    if (ok) {
        ok = fill_design(&d.problem, model, n, cube, u);
        bayesopt_descent_model_free(model);
    }
    free(cube);
    return ok;
}
