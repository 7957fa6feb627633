#include "core/descent.h"

#include "cli.h"
#include "core/constraints.h"
#include "core/forecast.h"
#include "core/gn_model.h"
#include "core/objective.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The coarse mesh for derivatives: three quarters of the elements each way, ten times the tolerance
 * of the quadrature. */
static const double COARSE_SHARE = 0.75, COARSE_TOLERANCE = 10;
static const double WHOLE_BOX = 2; /* a radius that the box ends before */
/* Of initial designs: how far the model is asked to look, and how far inside of the limits. */
static const double DESIGN_RADIUS = 0.5, DESIGN_MARGIN = 0.01;
enum { DRAWS = 2 }; /* points tried for each */
static const double UNREACHED = 1e3;
static const double FORECAST_OUTSIDE = 1e-4; /* no step keeps the limits */
enum { ALONG = 60, AROUND = 16 };            /* samples of the pressure */

struct descent {
    struct problem *base;
    struct search *search; /* NULL: a forecast, which keeps no record */
    struct gn_problem problem;
    struct gn_sample *sample; /* to be filled by look() */
    igabem_options coarse[SETTINGS_MOST];
    size_t valued, differentiated;
    bool ok; /* the record took everything */
};

static bool look(void *user_data, igabem_solution *const *solutions)
{
    struct descent *d = user_data;
    struct gn_sample *s = d->sample;
    for (size_t m = 0; m < d->problem.settings; m++)
        if (igabem_wave_residuals(solutions[m], s->residual + m * GN_RESIDUALS) != IGABEM_OK)
            return core_fail("forces: %s", igabem_last_error());
    if (!d->problem.points)
        return true;
    igabem_pressure_sample *point;
    size_t n;
    if (igabem_pressure_samples(solutions[0], ALONG, AROUND, &n, &point) != IGABEM_OK)
        return core_fail("forces: %s", igabem_last_error());
    bool same = n == s->points;
    if (same)
        memcpy(s->point, point, n * sizeof *point);
    free(point);
    return same ||
           core_fail("forces: %zu samples of the pressure, the parent has %zu", n, s->points);
}

/* What is lowered in place of C_w by the settings at flow.froude: (C_w + (1 + k) C_f) S / S_0 of
 * the original's surface S_0. A resistance is a sum of squares too: each residual times sqrt(S /
 * S_0), and one more for the friction. */
static void take_surface(const struct descent *d, double area, bool valued, struct gn_sample *s)
{
    const struct config *config = d->base->config;
    double share = area / nurbs_hull_hydrostatics(d->base->parent.hull)->wetted_area;
    double friction = objective_friction(config, problem_length(d->base));
    for (size_t m = 0; m < d->problem.settings; m++) {
        double *r = s->residual + m * GN_RESIDUALS;
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
    for (size_t k = 0; k < d->problem.n; k++)
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
        found = memcmp(list[i].u, u, d->problem.n * sizeof *u) == 0;
    free(list);
    return found;
}

static void keep_values(const struct evaluation *e, struct gn_sample *sample)
{
    sample->value[0] = e->cw;
    memcpy(sample->value + 1, e->cw_model, e->models * sizeof *e->cw_model);
    memcpy(sample->value + 1 + e->models, e->cw_speed, e->speeds * sizeof *e->cw_speed);
    sample->pressure = e->cw_pressure;
}

static enum gn_answer fine(void *user_data, const double *u, struct gn_sample *sample)
{
    struct descent *d = user_data;
    struct search *search = d->search;
    struct evaluation e;
    bool parent = is_parent(d, u);
    if (!parent && d->valued == search->problem->config->iterations)
        return GN_STOP;
    d->sample = sample;
    evaluation_start(0, "descent", u, &e);
    int recorded = parent ? 1 : is_recorded(d, u);
    if (parent)
        evaluate_parent(search->problem, &e, look, d);
    else if (recorded == 1)
        evaluate(search->problem, &e, look, d);
    if (recorded < 0 || (recorded == 0 && !search_step(search, &e, look, d))) {
        d->ok = false;
        return GN_STOP;
    }
    d->valued += !parent;
    if (e.failed)
        return GN_FAILED;
    keep_values(&e, sample);
    take_surface(d, e.wetted_area, true, sample);
    return GN_VALUED;
}

static enum gn_answer coarse(void *user_data, const double *u, struct gn_sample *sample)
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
        return GN_STOP;
    if (!problem_build(d->base, u, &design))
        return GN_FAILED;
    bool ok =
        igabem_solve_many(design.body, d->problem.settings, d->coarse, solutions) == IGABEM_OK;
    if (ok) {
        d->sample = sample;
        ok = look(d, solutions);
        if (ok)
            take_surface(d, nurbs_hull_hydrostatics(design.hull)->wetted_area, false, sample);
        for (size_t m = 0; m < d->problem.settings; m++)
            igabem_solution_free(solutions[m]);
    }
    design_free(&design);
    return ok ? GN_VALUED : GN_FAILED;
}

static bool limit(void *user_data, const double *u, double *value)
{
    struct descent *d = user_data;
    return limits_evaluate(d->base, d->problem.n, u, value) == 0;
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
    bool ok =
        igabem_pressure_samples(solution, ALONG, AROUND, &d->problem.points, NULL) == IGABEM_OK ||
        core_fail("%s", igabem_last_error());
    igabem_solution_free(solution);
    return ok;
}

/* What a setting counts for: objective, confirmation, or another speed. */
static struct gn_setting weigh(const struct config *config, size_t m)
{
    if (m > config->models)
        return (struct gn_setting){config->speeds, 0};
    if (m == 0 || isnan(config->confirm))
        return (struct gn_setting){0, 1};
    return (struct gn_setting){1 - config->confirm, config->confirm};
}

/* setting: room for SETTINGS_MOST, borrowed. */
static bool start(struct problem *base, struct gn_setting *setting, struct descent *d)
{
    const struct config *config = base->config;
    d->base = base;
    d->ok = true;
    d->problem = (struct gn_problem){.n = galv_model_modes(base->model),
                                     .lower = galv_model_lower(base->model),
                                     .upper = galv_model_upper(base->model),
                                     .settings = evaluate_settings(base, d->coarse),
                                     .setting = setting,
                                     .pressure = config->pressure,
                                     .limits = limits_count(config),
                                     .limit = limit,
                                     .coarse = coarse,
                                     .fine = fine,
                                     .tell = show_line,
                                     .user_data = d};
    for (size_t m = 0; m < d->problem.settings; m++) {
        coarsen(&d->coarse[m]);
        setting[m] = weigh(config, m);
    }
    return count_points(d);
}

bool descent_run(struct search *search, double *u)
{
    struct gn_setting setting[SETTINGS_MOST];
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
    if (!gn_run(&d.problem, u))
        return d.ok && core_no_memory();
    return d.ok &&
           record_put_text(search->record, "stop",
                           d.valued == search->problem->config->iterations ? "budget spent"
                                                                           : "no step gains more");
}

/* The parent alone is valued. */
static enum gn_answer value_parent(void *user_data, const double *u, struct gn_sample *sample)
{
    struct descent *d = user_data;
    struct evaluation e;
    (void)u;
    d->sample = sample;
    evaluation_start(0, "parent", NULL, &e);
    evaluate_parent(d->base, &e, look, d);
    if (e.failed)
        return GN_FAILED;
    keep_values(&e, sample);
    take_surface(d, e.wetted_area, true, sample);
    return GN_VALUED;
}

/* Without the constraint of row k: whether there was one. */
static bool drop(const struct config *config, size_t k, struct config *without)
{
    *without = *config;
    return constraints_drop(without, k);
}

static double least(struct descent *d, const struct gn_model *model, const struct config *config,
                    double *step)
{
    const struct config *keep = d->base->config;
    d->base->config = config;
    d->problem.pressure = config->pressure;
    d->problem.limits = limits_count(config);
    for (size_t m = 0; m < d->problem.settings; m++) {
        struct gn_setting *s = (struct gn_setting *)&d->problem.setting[m];
        *s = weigh(config, m);
        if (m > config->models && isnan(config->speeds))
            s->offset = UNREACHED; /* finite: SLSQP computes with it */
    }
    double broken = 0, ratio = gn_model_minimise(model, WHOLE_BOX, step, &broken);
    d->base->config = keep;
    return broken < FORECAST_OUTSIDE ? ratio : NAN;
}

static void fill(struct descent *d, const struct gn_model *model, struct forecast *f, double *step)
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
static bool model_parent(struct problem *problem, struct gn_setting *setting, struct descent *d,
                         struct gn_model *model)
{
    if (!start(problem, setting, d))
        return false;
    d->problem.fine = value_parent;
    return gn_at_parent(&d->problem, model) ||
           core_fail("%s: the derivatives at the original cannot be had (%s)",
                     problem->config->path, core_sentence());
}

bool forecast_run(struct problem *problem, struct forecast *f)
{
    struct gn_setting setting[SETTINGS_MOST];
    struct gn_model model;
    struct descent d = {.search = NULL};
    for (size_t k = 0; k < FORECAST_ROWS; k++)
        f->without[k] = NAN;
    for (size_t i = 0; i < FORECAST_SHARES; i++)
        f->confirmed[i] = NAN;
    double *step = calloc(galv_model_modes(problem->model), sizeof *step);
    bool ok = (step || core_no_memory()) && model_parent(problem, setting, &d, &model);
    if (ok) {
        fill(&d, &model, f, step);
        f->solves = d.differentiated;
        gn_leave(&model);
    }
    free(step);
    return ok;
}

/* Where the model promises most about each point of a Latin hypercube: designs unlike each other,
 * all of which keep the limits by the model. The first is that of the whole box. */
static bool fill_design(struct gn_model *model, size_t n, double *cube, double *u)
{
    const struct gn_problem *p = model->problem;
    size_t made = 0;
    for (size_t i = 0; i < DRAWS * n && made < n; i++) {
        double broken;
        for (size_t k = 0; k < p->n; k++)
            model->anchor[k] = p->lower[k] + cube[i * p->n + k] * (p->upper[k] - p->lower[k]);
        if (!isnan(
                gn_model_minimise(model, i ? DESIGN_RADIUS : WHOLE_BOX, u + made * p->n, &broken)))
            made++;
    }
    return made == n || core_fail("only %zu of %zu initial designs keep the known limits", made, n);
}

bool descent_design(struct problem *problem, size_t n, double *u)
{
    struct gn_setting setting[SETTINGS_MOST];
    struct gn_model model;
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
        model.margin = DESIGN_MARGIN;
        ok = fill_design(&model, n, cube, u);
        gn_leave(&model);
    }
    free(cube);
    return ok;
}
