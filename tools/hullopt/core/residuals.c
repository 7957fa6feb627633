#include "core/residuals.h"

#include "cli.h"
#include "core/constraints.h"
#include "core/descent.h"
#include "core/objective.h"

#include <igabem/residual.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The coarse mesh for differences: three quarters of the elements each way, ten times the tolerance
 * of the quadrature. */
static const double COARSE_SHARE = 0.75, COARSE_TOLERANCE = 10;
static const double TANGENT_SOLVES = 1.5; /* of 15 directions, docs/benchmarks.md */
static const double UNREACHED = 1e3;      /* finite: SLSQP computes with it */
enum {
    ALONG = 60, /* samples of the pressure */
    AROUND = 16,
    /* Those of the waves, and one for the friction where the total resistance is lowered. */
    RESIDUALS = IGABEM_WAVE_RESIDUALS + 1,
    POINT = sizeof(igabem_pressure_sample) / sizeof(double)
};

static bool take_points(const struct descent *d, const igabem_solution *solution,
                        bayesopt_descent_sample *s)
{
    igabem_pressure_sample *point;
    size_t n;
    if (!core_ok(igabem_pressure_samples(solution, ALONG, AROUND, &n, &point), "forces: %s",
                 igabem_last_error()))
        return false;
    bool same = n == d->points;
    if (same)
        memcpy(s->state, point, n * sizeof *point);
    free(point);
    return same ||
           core_fail("forces: %zu samples of the pressure, the parent has %zu", n, d->points);
}

/* Those of setting m, where it is differenced. */
static bool take_setting(const struct descent *d, size_t m, const igabem_solution *solution,
                         bayesopt_descent_sample *s)
{
    bool known = s->known && s->known->known[m];
    if (!known && !core_ok(igabem_wave_residuals(solution, s->residual + m * RESIDUALS),
                           "forces: %s", igabem_last_error()))
        return false;
    return m || !d->points || (s->known && s->known->state_known) || take_points(d, solution, s);
}

bool descent_look(void *user_data, igabem_solution **solutions)
{
    struct descent *d = user_data;
    for (size_t m = 0; m < d->problem.n_settings; m++)
        if (!take_setting(d, m, solutions[m], d->sample))
            return false;
    slopes_keep(&d->slopes, d->at, solutions);
    return true;
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

void descent_keep(const struct descent *d, const struct evaluation *e,
                  bayesopt_descent_sample *sample)
{
    sample->value[0] = e->cw;
    memcpy(sample->value + 1, e->cw_model, e->models * sizeof *e->cw_model);
    memcpy(sample->value + 1 + e->models, e->cw_speed, e->speeds * sizeof *e->cw_speed);
    sample->bounded = e->cw_pressure;
    take_surface(d, e->wetted_area, true, sample);
}

/* Which settings are differenced: fills their numbers, returns how many. */
static size_t differenced(const struct descent *d, const bayesopt_descent_slopes *known,
                          size_t number[SETTINGS_MOST])
{
    size_t n = 0;
    for (size_t m = 0; m < d->problem.n_settings; m++)
        if (!known->known[m] || (m == 0 && d->points && !known->state_known))
            number[n++] = m;
    return n;
}

static bool solve_coarsely(struct descent *d, const struct design *design,
                           bayesopt_descent_sample *sample)
{
    size_t number[SETTINGS_MOST], n = differenced(d, sample->known, number);
    igabem_options setting[SETTINGS_MOST] = {d->coarse[0]};
    igabem_solution *solution[SETTINGS_MOST];
    for (size_t i = 0; i < n; i++)
        setting[i] = d->coarse[number[i]];
    if (!core_ok(igabem_solve_many(design->body, n, setting, solution), "solve: %s",
                 igabem_last_error()))
        return false;
    bool ok = true;
    for (size_t i = 0; i < n; i++) {
        ok = ok && take_setting(d, number[i], solution[i], sample);
        igabem_solution_free(solution[i]);
    }
    if (ok)
        take_surface(d, nurbs_hull_hydrostatics(design->hull)->wetted_area, false, sample);
    return ok;
}

/* Whether the run goes on, which is shown. */
static bool goes_on(struct descent *d, const char *what)
{
    if (d->search) {
        search_show(d->search, what);
        d->ok = core_goes_on(d->search->watch);
    }
    return d->ok;
}

/* A search never changes for want of memory: it ends. */
static bayesopt_descent_answer answer(struct descent *d, bool valued)
{
    if (core_lacked_memory()) {
        d->ok = false;
        return BAYESOPT_DESCENT_STOP;
    }
    return valued ? BAYESOPT_DESCENT_VALUED : BAYESOPT_DESCENT_FAILED;
}

static bayesopt_descent_answer coarse(void *user_data, const double *u,
                                      bayesopt_descent_sample *sample)
{
    struct descent *d = user_data;
    struct design design;
    char what[80];
    snprintf(what, sizeof what, "derivatives, solve %zu", ++d->differentiated);
    if (!goes_on(d, what))
        return BAYESOPT_DESCENT_STOP;
    bool ok = problem_build(d->base, u, &design) && solve_coarsely(d, &design, sample);
    design_free(&design);
    return answer(d, ok);
}

/* Of the residuals of setting m as take_surface() leaves them: the wetted area changes too. */
static void weigh_slopes(const struct descent *d, size_t m, const double *dr, const double *darea,
                         const double *r, double *slope)
{
    const struct config *config = d->base->config;
    double area = nurbs_hull_hydrostatics(d->slopes.design.hull)->wetted_area;
    double share = area / nurbs_hull_hydrostatics(d->base->parent.hull)->wetted_area;
    double friction = objective_friction(config, problem_length(d->base));
    bool counts = m <= config->models && config->quantity != QUANTITY_CW;
    for (size_t k = 0; k < d->problem.d; k++, slope += RESIDUALS, dr += IGABEM_WAVE_RESIDUALS) {
        double growth = darea[k] / (2 * area);
        for (int i = 0; i < IGABEM_WAVE_RESIDUALS; i++)
            slope[i] = counts ? sqrt(share) * (dr[i] + growth * r[i]) : dr[i];
        slope[IGABEM_WAVE_RESIDUALS] = counts ? sqrt(friction * share) * growth : 0;
    }
}

/* Setting m by tangents; false: it is left to differences. */
static bool take_tangents(struct descent *d, size_t m, bayesopt_descent_slopes *out)
{
    static const size_t parts[2] = {ALONG, AROUND};
    size_t n = d->problem.d;
    bool points = m == 0 && d->points;
    const igabem_solution *solution;
    double r[IGABEM_WAVE_RESIDUALS];
    double *dr = malloc(n * (IGABEM_WAVE_RESIDUALS + 1) * sizeof *dr);
    double *darea = dr ? dr + n * IGABEM_WAVE_RESIDUALS : NULL;
    bool ok = (dr || core_no_memory()) &&
              slopes_setting(&d->slopes, m, parts, dr, darea,
                             points ? (igabem_pressure_sample *)out->state : NULL, &solution) &&
              core_ok(igabem_wave_residuals(solution, r), "forces: %s", igabem_last_error());
    if (ok)
        weigh_slopes(d, m, dr, darea, r, out->residual + m * n * RESIDUALS);
    free(dr);
    out->known[m] = ok;
    out->state_known = out->state_known || (ok && points);
    return ok;
}

/* Says once how derivatives are had, and again when that changes. why: of the last setting that
 * has tangents and gave none, NULL: there is no such. */
static void tell_ways(struct descent *d, const bool *known, const char *why)
{
    char line[400] = "derivatives by tangents";
    size_t by_tangents = 0, n = d->problem.n_settings;
    for (size_t m = 0; m < n; m++)
        by_tangents += known[m];
    d->tangents = by_tangents;
    if (!d->search || (d->told && d->told == by_tangents + 1))
        return;
    d->told = by_tangents + 1;
    if (by_tangents < n)
        snprintf(line, sizeof line, "derivatives by tangents for %zu of %zu settings", by_tangents,
                 n);
    for (size_t m = 0; m < n; m++) {
        size_t length = strlen(line);
        const igabem_options *o = &d->slopes.setting[m];
        if (!known[m])
            snprintf(line + length, sizeof line - length, "%s %s at Fr %g",
                     strchr(line, ';') ? "," : "; by differences for",
                     igabem_formulation_name(o->formulation), o->froude);
    }
    core_tell(d->search->watch, "%s%s%s%s", line, why ? " (" : "", why ? why : "", why ? ")" : "");
}

static bayesopt_descent_answer derivatives(void *user_data, const double *u,
                                           bayesopt_descent_slopes *out)
{
    struct descent *d = user_data;
    char why[SENTENCE_SIZE] = "";
    if (!goes_on(d, "derivatives by tangents"))
        return BAYESOPT_DESCENT_STOP;
    bool open = slopes_any(&d->slopes) && slopes_open(&d->slopes, u);
    bool ok = open || !slopes_any(&d->slopes);
    for (size_t m = 0; m < d->problem.n_settings && open; m++)
        ok = (!d->slopes.has[m] || take_tangents(d, m, out)) && ok;
    if (!ok)
        snprintf(why, sizeof why, "%s", core_sentence());
    slopes_close(&d->slopes);
    bayesopt_descent_answer end = answer(d, open);
    if (end != BAYESOPT_DESCENT_STOP)
        tell_ways(d, out->known, ok ? NULL : why);
    return end;
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
    if (!d->search)
        return;
    core_tell(d->search->watch, "design %zu: %s", d->valued, sentence);
    search_show(d->search, sentence);
}

static void coarsen(igabem_options *options)
{
    options->elements_u = (int)lround(COARSE_SHARE * options->elements_u);
    options->elements_v = (int)lround(COARSE_SHARE * options->elements_v);
    options->tolerance *= COARSE_TOLERANCE;
}

void descent_cost(const struct problem *problem, bool sideways, double *coarse_seconds,
                  double *solves)
{
    igabem_options setting[SETTINGS_MOST], differenced[SETTINGS_MOST];
    igabem_solution *solutions[SETTINGS_MOST];
    size_t n = evaluate_settings(problem, setting), left = 0;
    for (size_t m = 0; m < n; m++)
        if (!sideways || !slopes_has(problem, &setting[m])) {
            differenced[left] = setting[m];
            coarsen(&differenced[left++]);
        }
    *solves = left < n ? TANGENT_SOLVES : 0;
    *coarse_seconds = 0;
    double start = cli_seconds();
    if (left == 0)
        return;
    *coarse_seconds = NAN;
    if (igabem_solve_many(problem->parent.body, left, differenced, solutions) != IGABEM_OK)
        return;
    *coarse_seconds = cli_seconds() - start;
    for (size_t m = 0; m < left; m++)
        igabem_solution_free(solutions[m]);
}

/* Of the samples of the pressure that every design has. */
static bool count_points(struct descent *d)
{
    struct problem *problem = d->base;
    igabem_solution *solution;
    igabem_options options = d->coarse[0];
    if (isnan(problem->config->pressure))
        return true;
    if (d->slopes.has[0]) /* any source density on the hull has the same, and this one soonest */
        options.formulation = IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN;
    if (igabem_solve(problem->parent.body, &options, &solution) != IGABEM_OK)
        return core_fail("%s", igabem_last_error());
    bool ok = igabem_pressure_samples(solution, ALONG, AROUND, &d->points, NULL) == IGABEM_OK ||
              core_fail("%s", igabem_last_error());
    igabem_solution_free(solution);
    d->problem.n_state = POINT * d->points;
    d->problem.function = pressure;
    return ok;
}

void descent_weigh(const struct config *config, size_t n, bayesopt_descent_setting *setting)
{
    const double f = config->confirm, speeds = config->speeds;
    for (size_t m = 0; m < n; m++)
        if (m > config->models)
            setting[m] = (bayesopt_descent_setting){isnan(speeds) ? UNREACHED : speeds, 0};
        else if (m == 0 || isnan(f))
            setting[m] = (bayesopt_descent_setting){0, 1};
        else
            setting[m] = (bayesopt_descent_setting){1 - f, f};
}

bool descent_start(struct problem *base, struct search *search, struct descent *d)
{
    const struct config *config = base->config;
    *d = (struct descent){.base = base, .search = search, .ok = true};
    if (config->free_to_trim)
        return core_fail("%s: flow.free_to_trim: derivatives are those of a hull held at rest",
                         config->path);
    bayesopt_descent_problem *p = &d->problem;
    bayesopt_descent_problem_init(p);
    p->d = galv_model_modes(base->model);
    p->lower = galv_model_lower(base->model);
    p->upper = galv_model_upper(base->model);
    p->n_settings = evaluate_settings(base, d->coarse);
    p->setting = d->setting;
    p->n_residuals = RESIDUALS;
    p->bound = config->pressure;
    p->n_limits = limits_count(config);
    p->limit = limit;
    p->derivatives = derivatives;
    p->coarse = coarse;
    p->tell = show_line;
    p->user_data = d;
    descent_weigh(config, p->n_settings, d->setting);
    for (size_t m = 0; m < p->n_settings; m++)
        coarsen(&d->coarse[m]);
    slopes_start(base, &d->slopes);
    return count_points(d);
}

void descent_end(struct descent *d)
{
    slopes_end(&d->slopes);
}
