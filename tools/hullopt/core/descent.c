#include "core/descent.h"

#include "core/constraints.h"
#include "core/gauss_newton.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The coarse mesh for derivatives: three quarters of the elements each way, ten times the tolerance
 * of the quadrature. */
static const double COARSE_SHARE = 0.75, COARSE_TOLERANCE = 10;
enum { ALONG = 60, AROUND = 16 }; /* samples of the pressure */

struct descent {
    struct search *search;
    struct gn_problem problem;
    struct gn_sample *sample; /* to be filled by look() */
    igabem_options coarse[SETTINGS_MOST];
    size_t valued, differentiated;
    bool ok; /* the record took everything */
    char line[160];
};

static bool look(void *user_data, igabem_solution *const *solutions)
{
    struct descent *d = user_data;
    struct gn_sample *s = d->sample;
    for (size_t m = 0; m < d->problem.settings; m++)
        if (igabem_wave_residuals(solutions[m], s->residual + m * IGABEM_WAVE_RESIDUALS) !=
            IGABEM_OK)
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
    search_show(search, d->line);
    if (e.failed)
        return GN_FAILED;
    sample->value[0] = e.cw;
    memcpy(sample->value + 1, e.cw_model, e.models * sizeof *e.cw_model);
    memcpy(sample->value + 1 + e.models, e.cw_speed, e.speeds * sizeof *e.cw_speed);
    sample->pressure = e.cw_pressure;
    return GN_VALUED;
}

static enum gn_answer coarse(void *user_data, const double *u, struct gn_sample *sample)
{
    struct descent *d = user_data;
    struct design design;
    igabem_solution *solutions[SETTINGS_MOST];
    char what[80];
    snprintf(what, sizeof what, "derivatives, solve %zu", ++d->differentiated);
    search_show(d->search, what);
    d->ok = core_goes_on(d->search->watch);
    if (!d->ok)
        return GN_STOP;
    if (!problem_build(d->search->problem, u, &design))
        return GN_FAILED;
    bool ok =
        igabem_solve_many(design.body, d->problem.settings, d->coarse, solutions) == IGABEM_OK;
    if (ok) {
        d->sample = sample;
        ok = look(d, solutions);
        for (size_t m = 0; m < d->problem.settings; m++)
            igabem_solution_free(solutions[m]);
    }
    design_free(&design);
    return ok ? GN_VALUED : GN_FAILED;
}

static bool limit(void *user_data, const double *u, double *value)
{
    struct descent *d = user_data;
    return limits_evaluate(d->search->problem, d->problem.n, u, value) == 0;
}

static void keep_line(void *user_data, const char *sentence)
{
    struct descent *d = user_data;
    snprintf(d->line, sizeof d->line, "%s", sentence);
}

static void coarsen(igabem_options *options)
{
    options->elements_u = (int)lround(COARSE_SHARE * options->elements_u);
    options->elements_v = (int)lround(COARSE_SHARE * options->elements_v);
    options->tolerance *= COARSE_TOLERANCE;
}

/* Of the samples of the pressure that every design has. */
static bool count_points(struct descent *d)
{
    struct problem *problem = d->search->problem;
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

bool descent_run(struct search *search, double *u)
{
    const struct config *config = search->problem->config;
    const galv_model *model = search->problem->model;
    struct gn_setting setting[SETTINGS_MOST];
    char *stop;
    if (!record_get_text(search->record, "stop", &stop))
        return false;
    bool stopped = stop != NULL;
    free(stop);
    if (stopped)
        return true;
    struct descent d = {.search = search, .ok = true};
    d.problem = (struct gn_problem){.n = galv_model_modes(model),
                                    .lower = galv_model_lower(model),
                                    .upper = galv_model_upper(model),
                                    .settings = evaluate_settings(search->problem, d.coarse),
                                    .setting = setting,
                                    .pressure = config->pressure,
                                    .limits = limits_count(config),
                                    .limit = limit,
                                    .coarse = coarse,
                                    .fine = fine,
                                    .tell = keep_line,
                                    .user_data = &d};
    for (size_t m = 0; m < d.problem.settings; m++) {
        coarsen(&d.coarse[m]);
        setting[m] = m <= config->models ? (struct gn_setting){0, 1}
                                         : (struct gn_setting){config->speeds, 0};
    }
    if (!count_points(&d))
        return false;
    if (!gn_run(&d.problem, u))
        return d.ok && core_no_memory();
    return d.ok &&
           record_put_text(search->record, "stop",
                           d.valued == config->iterations ? "budget spent" : "no step gains more");
}
