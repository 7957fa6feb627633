#include "core/problem.h"

#include "cli.h"
#include "constants.h"
#include "core/external.h"
#include "core/particulars.h"
#include "core/snapshots.h"
#include "shape_yaml.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char LATENT_SPACE[] = "latent space";

void design_free(struct design *design)
{
    nurbs_hull_free(design->hull);
    igabem_hull_free(design->body);
    *design = (struct design){0};
}

double problem_length(const struct problem *problem)
{
    return nurbs_hull_length(problem->source);
}

double design_nu_s(const struct design *design)
{
    igabem_hull_info info;
    if (!design->body)
        return NAN;
    igabem_hull_get_info(design->body, &info);
    return info.nu_s;
}

const struct design *problem_best(const struct problem *problem)
{
    return problem->best.hull ? &problem->best : &problem->parent;
}

static bool build_hull(struct problem *problem, const double *points, nurbs_hull **hull)
{
    size_t n = nurbs_grid_rows(problem->grid) * nurbs_grid_columns(problem->grid);
    memcpy(nurbs_grid_edit(problem->moved), points, 3 * n * sizeof *points);
    return core_ok(nurbs_hull_rebuild(problem->source, problem->moved, hull), "%s",
                   nurbs_last_error());
}

static bool build(struct problem *problem, const double *points, struct design *design)
{
    *design = (struct design){0};
    if (!build_hull(problem, points, &design->hull))
        return false;
    if (core_ok(igabem_hull_from(design->hull, &design->body), "hull: %s", igabem_last_error()))
        return true;
    design_free(design);
    return false;
}

bool problem_build_points(struct problem *problem, const double *points, struct design *design)
{
    return build(problem, points, design);
}

static void hull_options(const struct problem *problem, nurbs_hull_options *options)
{
    nurbs_hull_options_init(options);
    options->simplify = problem->config->tolerance;
    options->single = true; /* a family moves the design grid of one surface */
}

/* Reads a hull as it is placed: z = 0 is the still water of its full surface too, from which the
 * design grid is taken. */
static bool read_hull(const struct problem *problem, const char *path, nurbs_hull **hull)
{
    const struct config *config = problem->config;
    nurbs_hull_options options;
    hull_options(problem, &options);
    options.draft = config->draft;
    *hull = NULL;
    nurbs_status status = nurbs_hull_read(path, &options, hull);
    if (!status && (config->trim != 0 || !isnan(config->draft))) {
        const nurbs_hydrostatics *h = nurbs_hull_hydrostatics(*hull);
        options.draft = NAN;
        options.sinkage = nurbs_hull_level(*hull);
        options.pivot = (h->x_fore + h->x_aft) / 2;
        options.trim = config->trim * (PI / 180);
        nurbs_hull_free(*hull);
        *hull = NULL;
        status = nurbs_hull_read(path, &options, hull);
    }
    return status == NURBS_OK || core_fail("%s", nurbs_last_error());
}

static size_t count_points(const struct problem *problem)
{
    return nurbs_grid_rows(problem->grid) * nurbs_grid_columns(problem->grid);
}

bool problem_read_points(struct problem *problem, const char *path, double *points)
{
    const struct config *config = problem->config;
    nurbs_hull *hull;
    nurbs_grid *grid = NULL;
    bool ok = read_hull(problem, path, &hull) &&
              (nurbs_hull_design_grid(hull, config->sections, config->girth, &grid) == NURBS_OK ||
               core_fail("%s", nurbs_last_error()));
    if (!ok)
        core_fail("hull: %s", core_sentence());
    else if (nurbs_grid_rows(grid) != nurbs_grid_rows(problem->grid) ||
             nurbs_grid_columns(grid) != nurbs_grid_columns(problem->grid))
        ok = core_fail("hull: its design grid is %zu x %zu, that of the original %zu x %zu: set "
                       "grid.sections and grid.girth",
                       nurbs_grid_rows(grid), nurbs_grid_columns(grid),
                       nurbs_grid_rows(problem->grid), nurbs_grid_columns(problem->grid));
    if (ok)
        memcpy(points, nurbs_grid_points(grid), 3 * count_points(problem) * sizeof *points);
    nurbs_grid_free(grid);
    nurbs_hull_free(hull);
    return ok;
}

/* The command's hull; of a run that is only looked at, the one on record. */
bool problem_make_points(struct problem *problem, const double *u, double *points)
{
    char path[CONFIG_PATH];
    if (problem->found)
        memcpy(points, problem->found, 3 * count_points(problem) * sizeof *points);
    else if (!external_make(problem->config, u, path))
        return false;
    else
        snprintf(problem->made, sizeof problem->made, "%s", path);
    return problem->found || problem_read_points(problem, path, points);
}

/* The grid of a latent point, in problem->moved. */
static bool displace(struct problem *problem, const double *u)
{
    double *points = nurbs_grid_edit(problem->moved);
    problem->made[0] = '\0';
    if (config_by_command(problem->config))
        return problem_make_points(problem, u, points);
    return core_ok(galv_displace(problem->model, u, points), "grid: %s", galv_last_error());
}

bool problem_build(struct problem *problem, const double *u, struct design *design)
{
    *design = (struct design){0};
    if (u)
        return displace(problem, u) && build(problem, nurbs_grid_points(problem->moved), design);
    problem->made[0] = '\0';
    return build(problem, nurbs_grid_points(problem->grid), design);
}

bool problem_build_hull(struct problem *problem, const double *u, nurbs_hull **hull)
{
    *hull = NULL;
    return displace(problem, u) && build_hull(problem, nurbs_grid_points(problem->moved), hull);
}

bool problem_set_best(struct problem *problem, const double *u)
{
    design_free(&problem->best);
    return problem_build(problem, u, &problem->best) ||
           core_fail("the best design cannot be built again: %s", core_sentence());
}

/* The file's own grid unless the configuration asks for another. */
static bool sample_grid(struct problem *problem)
{
    const struct config *config = problem->config;
    const nurbs_patches *full = nurbs_hull_full(problem->source);
    const size_t n[2] = {config->sections, config->girth};
    const double *kept;
    for (int axis = 0; axis < 2; axis++)
        if (n[axis] == 0 && nurbs_patches_count(full) == 1 &&
            nurbs_patches_parameters(full, 0, axis, &kept) == 0)
            return core_fail("%s: grid.%s is missing, and %s keeps no design grid of its own",
                             config->path, axis ? "girth" : "sections", config->hull);
    return core_ok(nurbs_hull_design_grid(problem->source, n[0], n[1], &problem->grid), "%s: %s",
                   config->hull, nurbs_last_error());
}

static bool build_parent(struct problem *problem)
{
    return problem_build(problem, NULL, &problem->parent) ||
           core_fail("%s: the parent cannot be built (%s)", problem->config->hull, core_sentence());
}

static bool prepare_parent(struct problem *problem)
{
    const nurbs_grid *grid = problem->grid;
    if (nurbs_grid_create(nurbs_grid_rows(grid), nurbs_grid_columns(grid), nurbs_grid_points(grid),
                          &problem->moved) != NURBS_OK)
        return core_fail("%s", nurbs_last_error());
    return build_parent(problem);
}

/* mesh: the spans of its density are taken; NULL: those that suit the parent. */
static bool freeze(struct problem *problem, const igabem_options *mesh)
{
    const struct config *config = problem->config;
    igabem_options solver = config->solver;
    if (mesh) {
        solver.elements_u = mesh->elements_u;
        solver.elements_v = mesh->elements_v;
    }
    problem->solver = solver;
    problem->speeds = config->verify_froudes;
    bool ok = igabem_options_freeze(problem->parent.body, &problem->solver) == IGABEM_OK;
    for (size_t i = 0; i < problem->speeds && ok; i++) {
        problem->speed[i] = solver;
        problem->speed[i].froude = config->verify_froude[i];
        ok = igabem_options_freeze(problem->parent.body, &problem->speed[i]) == IGABEM_OK;
    }
    if (!ok)
        return core_fail("%s: %s", config->path, igabem_last_error());
    igabem_hull_info info;
    igabem_hull_get_info(problem->parent.body, &info);
    return info.transom != IGABEM_TRANSOM_NONE ||
           !igabem_formulation_info(problem->solver.formulation)->stern_rows ||
           core_fail("%s: solver.formulation is %s, but %s has no immersed transom", config->path,
                     igabem_formulation_name(problem->solver.formulation), config->hull);
}

bool problem_freeze(struct problem *problem)
{
    const igabem_options mesh = problem->solver;
    return freeze(problem, &mesh);
}

bool problem_read(const struct config *config, struct problem *problem)
{
    char path[CONFIG_PATH];
    *problem = (struct problem){.config = config};
    bool ok = !config->maker.command || external_make(config, NULL, path) ||
              core_fail("%s: the original cannot be made (%s)", config->path, core_sentence());
    ok = ok && read_hull(problem, config->maker.command ? path : config->hull, &problem->source);
    ok = ok && sample_grid(problem) && prepare_parent(problem) && freeze(problem, NULL);
    problem->is_solved = ok;
    if (!ok)
        problem_free(problem);
    return ok;
}

/* A hull whose length and tolerance the designs take, from the points of the grid alone. */
static bool restore_source(struct problem *problem, double length)
{
    nurbs_surface *side = NULL;
    nurbs_hull_options options;
    nurbs_hull_options_init(&options);
    options.simplify = problem->config->tolerance;
    options.length = length;
    bool ok = nurbs_skin(problem->grid, NULL, &side) == NURBS_OK &&
              nurbs_hull_create_surfaces(1, (const nurbs_surface *const[]){side}, &options,
                                         &problem->source) == NURBS_OK;
    nurbs_surface_free(side);
    return ok || core_fail("%s", nurbs_last_error());
}

bool problem_restore(const struct config *config, galv_model *model, const size_t grid[2],
                     double length, double *ends, struct problem *problem)
{
    *problem = (struct problem){.config = config, .ends = ends};
    bool ok = grid[0] * grid[1] == galv_model_points(model) ||
              core_fail("the design grid is %zu x %zu, but the latent space moves %zu points",
                        grid[0], grid[1], galv_model_points(model));
    ok = ok && (nurbs_grid_create(grid[0], grid[1], galv_model_parent(model), &problem->grid) ==
                    NURBS_OK ||
                core_fail("%s", nurbs_last_error()));
    ok = ok && restore_source(problem, length) && prepare_parent(problem);
    if (!ok) {
        galv_model_free(model);
        problem_free(problem);
        return false;
    }
    ok = problem_recall(problem, model, NULL);
    if (!ok)
        problem_free(problem);
    return ok;
}

void problem_free(struct problem *problem)
{
    design_free(&problem->parent);
    design_free(&problem->best);
    galv_limits_free(problem->limits);
    galv_model_free(problem->model);
    free(problem->initial);
    free(problem->ends);
    free(problem->map);
    free(problem->back);
    free(problem->found);
    nurbs_grid_free(problem->grid);
    nurbs_grid_free(problem->moved);
    nurbs_hull_free(problem->source);
    *problem = (struct problem){0};
}

/* The designs at both ends of every latent direction. */
static bool make_extremes(struct problem *problem, size_t n, nurbs_grid **grids)
{
    const nurbs_grid *grid = problem->grid;
    size_t modes = galv_model_modes(problem->model);
    double *u = calloc(modes, sizeof *u);
    bool ok = u || core_no_memory();
    for (size_t k = 0; k < n && ok; k++) {
        const double *bound =
            k % 2 ? galv_model_upper(problem->model) : galv_model_lower(problem->model);
        const double *points =
            problem->ends ? problem->ends + k * 3 * count_points(problem) : nurbs_grid_points(grid);
        u[k / 2] = bound[k / 2];
        ok = nurbs_grid_create(nurbs_grid_rows(grid), nurbs_grid_columns(grid), points,
                               &grids[k]) == NURBS_OK ||
             core_fail("%s", nurbs_last_error());
        ok = ok && (problem->ends ||
                    galv_displace(problem->model, u, nurbs_grid_edit(grids[k])) == GALV_OK ||
                    core_fail("%s", galv_last_error()));
        u[k / 2] = 0;
    }
    free(u);
    return ok;
}

/* From here on every design, and the parent again, is built in one spline space, so that figures
 * are smooth over the latent space. The density keeps the spans that suit the lighter parent. */
static bool share_space(struct problem *problem)
{
    size_t n = 2 * galv_model_modes(problem->model);
    nurbs_grid **grids = calloc(n, sizeof *grids);
    bool ok = (grids || core_no_memory()) && make_extremes(problem, n, grids);
    ok = ok && (nurbs_hull_share_space(problem->source, problem->grid, n,
                                       (const nurbs_grid *const *)grids) == NURBS_OK ||
                core_fail("%s: %s", problem->config->hull, nurbs_last_error()));
    for (size_t k = 0; grids && k < n; k++)
        nurbs_grid_free(grids[k]);
    free(grids);
    if (!ok)
        return false;
    design_free(&problem->parent);
    return build_parent(problem) && (!problem->is_solved || problem_freeze(problem));
}

bool problem_recall(struct problem *problem, galv_model *model, const double *gradient)
{
    problem->model = model;
    if (!share_space(problem) || (problem->map && !snapshots_invert(problem)))
        return false;
    if (galv_limits_create(model, nurbs_grid_rows(problem->grid), nurbs_grid_columns(problem->grid),
                           design_nu_s(&problem->parent), &problem->limits) != GALV_OK ||
        (gradient && galv_limits_set_gradient(problem->limits, gradient) != GALV_OK))
        return core_fail("%s: %s", problem->config->hull, galv_last_error());
    return particulars_of(problem, nurbs_grid_points(problem->grid), true, problem->particular);
}

/* Runs the command at both ends of each parameter, the others as in the original. */
static bool make_ends(struct problem *problem)
{
    const struct config *config = problem->config;
    size_t d = config->n_parameters, length = 3 * count_points(problem);
    double *u = calloc(d, sizeof *u);
    problem->ends = malloc(2 * d * length * sizeof *problem->ends);
    bool ok = (u && problem->ends) || core_no_memory();
    for (size_t k = 0; k < 2 * d && ok; k++) {
        size_t i = k / 2;
        double end = k % 2 ? config->upper[i] : config->lower[i];
        u[i] = end - config->original[i];
        ok = problem_make_points(problem, u, problem->ends + k * length) ||
             core_fail("%s: the hull at %s = %g cannot be had (%s)", config->path,
                       config->parameter[i], end, core_sentence());
        u[i] = 0;
    }
    free(u);
    return ok;
}

/* For what takes a linear family: straight to the ends. The designs themselves are the command's.
 */
static int displace_to_ends(void *user_data, size_t npoints, const double *xyz, const double *x,
                            double *d)
{
    const struct problem *problem = user_data;
    const struct config *config = problem->config;
    memset(d, 0, 3 * npoints * sizeof *d);
    for (size_t k = 0; k < config->n_parameters; k++) {
        const double *end = problem->ends + (2 * k + (x[k] > 0)) * 3 * npoints;
        double share = x[k] > 0 ? x[k] / (config->upper[k] - config->original[k])
                                : x[k] / (config->lower[k] - config->original[k]);
        for (size_t i = 0; i < 3 * npoints; i++)
            d[i] += share * (end[i] - xyz[i]);
    }
    return 0;
}

static galv_shape *read_shape(const struct problem *problem)
{
    const nurbs_patches *full = nurbs_hull_full(problem->source);
    struct shape_points points = {.n = count_points(problem),
                                  .xyz = nurbs_grid_points(problem->grid),
                                  .surface = nurbs_patches_get(full, 0),
                                  .rows = nurbs_grid_rows(problem->grid),
                                  .columns = nurbs_grid_columns(problem->grid)};
    double *u = cli_needed(malloc((points.rows + points.columns) * sizeof *u));
    galv_shape *shape = NULL;
    points.u = u;
    points.v = u + points.rows;
    if (nurbs_patches_design_parameters(full, 0, 0, points.rows, u) != NURBS_OK ||
        nurbs_patches_design_parameters(full, 0, 1, points.columns, u + points.rows) != NURBS_OK)
        cli_fail("%s: %s", problem->config->hull, nurbs_last_error());
    else
        shape = shape_yaml_read(problem->config->shape, &points);
    free(u);
    return shape;
}

galv_shape *problem_shape(struct problem *problem)
{
    const struct config *config = problem->config;
    galv_shape *shape = NULL;
    if (!config->maker.command)
        return read_shape(problem);
    size_t d = config->n_parameters;
    double *bound = malloc(2 * d * sizeof *bound);
    for (size_t k = 0; bound && k < d; k++) {
        bound[k] = config->lower[k] - config->original[k];
        bound[d + k] = config->upper[k] - config->original[k];
    }
    if (!bound || galv_shape_callback(d, bound, bound + d, displace_to_ends, problem, true,
                                      &shape) != GALV_OK)
        core_no_memory();
    free(bound);
    return shape;
}

static int show_fraction(void *user_data, double fraction)
{
    core_show(user_data, LATENT_SPACE, fraction, NULL);
    return !core_goes_on(user_data);
}

static double built_volume(void *user_data, const double *points)
{
    nurbs_hull *hull;
    if (!build_hull(user_data, points, &hull))
        return NAN;
    double volume = nurbs_hull_hydrostatics(hull)->volume;
    nurbs_hull_free(hull);
    return volume;
}

static bool take_model(struct problem *problem, galv_model *model)
{
    return problem_recall(problem, model, NULL) &&
           (config_by_command(problem->config) ||
            galv_limits_linearise(problem->limits, built_volume, problem) == GALV_OK ||
            core_fail("%s: %s", problem->config->shape, galv_last_error()));
}

bool problem_reduce(struct problem *problem, const galv_shape *shape,
                    const struct core_watch *watch)
{
    const struct config *config = problem->config;
    struct core_watch show = *watch;
    galv_options options;
    galv_model *model;
    galv_options_init(&options);
    options.variance = config->variance;
    if (config->variance == 1)
        options.modes = galv_shape_parameters(shape);
    options.progress = show_fraction;
    options.progress_user_data = &show;
    size_t points = nurbs_grid_rows(problem->grid) * nurbs_grid_columns(problem->grid);
    const double *xyz = nurbs_grid_points(problem->grid);
    if (config_by_command(config) && !make_ends(problem))
        return false;
    if (config->snapshots)
        return snapshots_reduce(problem, &options, watch, &model) && take_model(problem, model);
    galv_status status =
        config->space || config_by_command(config)
            ? galv_build_parameters(shape, points, xyz, &model)
            : galv_build(shape, points, xyz, galv_uniform(config->samples, config->latent_seed),
                         &options, &model);
    if (status != GALV_OK)
        return core_fail("%s: %s", config->shape, galv_last_error());
    return take_model(problem, model);
}
