#include "core/evaluate.h"

#include "cli.h"
#include "core/attitude.h"
#include "core/constraints.h"
#include "core/external.h"
#include "core/objective.h"
#include "core/particulars.h"
#include "core/remote.h"

#include <math.h>
#include <stdio.h>

void evaluation_start(uint64_t id, const char *phase, const double *u, struct evaluation *e)
{
    *e = (struct evaluation){.id = id,
                             .phase = phase,
                             .u = u,
                             .objective = NAN,
                             .value = NAN,
                             .cw = NAN,
                             .cw_pressure = NAN,
                             .rw = NAN,
                             .share_beyond_cutoff = NAN,
                             .condition = NAN,
                             .volume = NAN,
                             .volume_ratio = NAN,
                             .wetted_area = NAN,
                             .bound = NAN,
                             .outside = NAN,
                             .breadth = NAN,
                             .nu_s = NAN,
                             .sinkage = NAN,
                             .trim = NAN};
    for (size_t i = 0; i < CONFIG_MODELS_MOST; i++)
        e->cw_model[i] = NAN;
    for (size_t i = 0; i < SPEEDS_MOST; i++)
        e->cw_speed[i] = NAN;
    for (size_t i = 0; i < PARTICULARS; i++)
        e->particular[i][0] = e->particular[i][1] = NAN;
    for (size_t i = 0; i + 1 < OBJECTIVES_MOST; i++)
        e->told[i] = NAN;
}

/* Least share of its half breadth that a wet point keeps. */
static double breadth_kept(const struct problem *problem, const double *points)
{
    const double centre = 1e-6; /* m: nearer ones belong to keel, stem and stern */
    const double *parent = nurbs_grid_points(problem->grid);
    size_t n = nurbs_grid_rows(problem->grid) * nurbs_grid_columns(problem->grid);
    double least = INFINITY;
    for (size_t k = 0; k < 3 * n; k += 3)
        if (parent[k + 2] <= 0 && parent[k + 1] > centre)
            least = fmin(least, points[k + 1] / parent[k + 1]);
    return least;
}

static bool measure(const struct problem *problem, const struct design *design,
                    const double *points, struct evaluation *e)
{
    const nurbs_hydrostatics *h = nurbs_hull_hydrostatics(design->hull);
    e->volume = h->volume;
    e->volume_ratio = h->volume / nurbs_hull_hydrostatics(problem->parent.hull)->volume;
    e->wetted_area = h->wetted_area;
    e->bound = nurbs_hull_bound(design->hull);
    e->nu_s = design_nu_s(design);
    e->breadth = breadth_kept(problem, points);
    return particulars_of(problem, points, true, e->particular);
}

static bool keep_limits(const struct problem *problem, const struct evaluation *e)
{
    struct evaluation parent;
    evaluation_start(0, NULL, NULL, &parent);
    return e->outside > OUTSIDE ||
           (measure(problem, &problem->parent, nurbs_grid_points(problem->grid), &parent) &&
            limits_kept(problem->config, e, &parent));
}

/* By the servers of the problem, where there are some: they have the same settings. */
static bool solve_remotely(struct problem *problem, struct evaluation *e)
{
    igabem_options settings[SETTINGS_MOST];
    e->models = problem->config->models;
    e->speeds = evaluate_settings(problem, settings) - 1 - e->models;
    return remote_solve(problem->remote, e);
}

static bool compute_forces(const igabem_solution *solution, igabem_forces *forces)
{
    return core_ok(igabem_forces_compute(solution, forces), "forces: %s", igabem_last_error()) &&
           ((forces->cw > 0 && isfinite(forces->cw)) ||
            core_fail("forces: C_w is %g at Fr %g, expected a positive number", forces->cw,
                      igabem_solution_options(solution)->froude));
}

/* area: of the wetted surface over that at rest, which C_w is told on. */
static bool keep_list(igabem_solution *const *solutions, size_t n, const double *area, double *cw)
{
    igabem_forces forces;
    for (size_t i = 0; i < n; i++) {
        if (!compute_forces(solutions[i], &forces))
            return false;
        cw[i] = forces.cw * area[i];
    }
    return true;
}

static bool keep(igabem_solution *const *solutions, const double *area, struct evaluation *e)
{
    size_t first = 1 + e->models;
    igabem_forces forces;
    if (!keep_list(solutions + 1, e->models, area + 1, e->cw_model) ||
        !keep_list(solutions + first, e->speeds, area + first, e->cw_speed) ||
        !compute_forces(solutions[0], &forces))
        return false;
    e->cw = forces.cw * area[0];
    e->cw_pressure = forces.cw_pressure * area[0];
    e->rw = forces.rw;
    e->share_beyond_cutoff = forces.share_beyond_cutoff;
    e->condition = forces.condition;
    e->dofs = forces.dofs;
    return true;
}

/* The setting by the solver's formulation and by the others. */
static size_t by_all_models(const struct config *config, const igabem_options *own,
                            igabem_options *settings)
{
    settings[0] = *own;
    for (size_t i = 0; i < config->models; i++) {
        settings[1 + i] = *own;
        settings[1 + i].formulation = config->model[i];
    }
    return 1 + config->models;
}

bool evaluate_asks_speeds(const struct config *config)
{
    return config->weights || !isnan(config->speeds) || objectives_ask_speeds(config);
}

size_t evaluate_settings(const struct problem *problem, igabem_options settings[SETTINGS_MOST])
{
    const struct config *config = problem->config;
    size_t n = by_all_models(config, &problem->solver, settings);
    for (size_t i = 0; i < problem->speeds && evaluate_asks_speeds(config); i++)
        n += by_all_models(config, &problem->speed[i], settings + n);
    return n;
}

/* A view of the solutions and whom to pass it on to. */
struct viewer {
    evaluate_look look;
    void *user_data;
};

/* n settings of one speed, or at rest of all, with the hull as it floats there. */
static bool solve_afloat(const struct problem *problem, const struct design *design, size_t n,
                         const igabem_options *settings, struct attitude *attitude,
                         igabem_solution **solutions, double *area)
{
    if (!attitude_find(problem, design, settings[0].froude, attitude))
        return false;
    for (size_t k = 0; k < n; k++)
        area[k] = attitude->area;
    return core_ok(igabem_solve_many(attitude->body, n, settings, solutions), "solve: %s",
                   igabem_last_error());
}

static bool solve(const struct problem *problem, const struct design *design, struct viewer viewer,
                  struct evaluation *e)
{
    igabem_solution *solutions[SETTINGS_MOST] = {NULL};
    igabem_options settings[SETTINGS_MOST];
    struct attitude attitude[SURFACES_MOST];
    double area[SETTINGS_MOST];
    size_t n = evaluate_settings(problem, settings), found = 0;
    e->models = problem->config->models;
    e->speeds = n - 1 - e->models;
    size_t each = problem->config->free_to_trim ? 1 + e->models : n;
    bool ok = true;
    for (size_t i = 0; i < n && ok; i += each)
        ok = solve_afloat(problem, design, each, settings + i, &attitude[found++], solutions + i,
                          area + i);
    ok = ok && keep(solutions, area, e) &&
         (!viewer.look || viewer.look(viewer.user_data, solutions));
    e->sinkage = attitude[0].sinkage;
    e->trim = attitude[0].trim;
    e->surfaces = problem->config->free_to_trim ? found : 0;
    for (size_t j = 0; j < e->surfaces; j++)
        e->surface[j] = attitude[j].area;
    for (size_t i = 0; i < n; i++)
        igabem_solution_free(solutions[i]);
    while (found)
        attitude_free(&attitude[--found]);
    return ok;
}

/* points: of the grid of the design. */
static void finish(struct problem *problem, const struct design *design, const double *points,
                   double start, struct viewer viewer, struct evaluation *e)
{
    bool here = !problem->remote || viewer.look || design == &problem->parent;
    bool ok = design && measure(problem, design, points, e) && keep_limits(problem, e);
    double built = cli_seconds();
    ok = ok && (here ? solve(problem, design, viewer, e) : solve_remotely(problem, e));
    if (ok && here && problem->config->judge.command)
        ok = external_judge(problem->config, e->u, design->hull, &e->value, e->told);
    e->geometry_seconds = built - start;
    e->solve_seconds = cli_seconds() - built;
    e->failed = !ok;
    e->no_memory = core_lacked_memory() && !ok;
    if (!ok)
        snprintf(e->reason, sizeof e->reason, "%s", core_sentence());
}

void evaluate(struct problem *problem, struct evaluation *e, evaluate_look look, void *user_data)
{
    struct design design;
    double start = cli_seconds();
    e->outside = limits_excess(problem, e->u);
    bool built = problem_build(problem, e->u, &design);
    snprintf(e->made, sizeof e->made, "%s", problem->made);
    finish(problem, built ? &design : NULL, nurbs_grid_points(problem->moved), start,
           (struct viewer){look, user_data}, e);
    design_free(&design);
}

void evaluate_points(struct problem *problem, const double *points, struct evaluation *e)
{
    struct design design;
    double start = cli_seconds();
    e->outside = INFINITY; /* nothing is known beforehand: the figures of the built design decide */
    bool built = problem_build_points(problem, points, &design);
    finish(problem, built ? &design : NULL, points, start, (struct viewer){NULL, NULL}, e);
    design_free(&design);
}

void evaluate_parent(struct problem *problem, struct evaluation *e, evaluate_look look,
                     void *user_data)
{
    finish(problem, &problem->parent, nurbs_grid_points(problem->grid), cli_seconds(),
           (struct viewer){look, user_data}, e);
}
