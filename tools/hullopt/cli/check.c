#include "cli.h"
#include "cli/commands.h"
#include "core/constraints.h"
#include "core/descent.h"
#include "core/objective.h"
#include "core/search.h"
#include "json_result.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What a run would work on. */
struct plan {
    struct config config;
    struct problem problem;
    galv_shape *shape;
    struct evaluation parent;
    double coarse;   /* s of a solve for differences; 0: the method takes none */
    double tangents; /* solves that derivatives by tangents are worth; 0: likewise */
    json_t *warnings;
};

/* Keeps why the value of the original may be wrong. */
static bool keep_warnings(void *user_data, igabem_solution **solutions)
{
    struct plan *p = user_data;
    const char *warning;
    for (size_t i = 0; (warning = igabem_solution_warning(solutions[0], NULL, i)) != NULL; i++)
        json_array_append_new(p->warnings, json_string(warning));
    return true;
}

/* Whether the ends of every parameter move points along y alone; of a command's hulls nobody knows.
 */
static bool moves_sideways(const struct plan *p)
{
    if (p->config.maker.command)
        return true;
    const nurbs_grid *grid = p->problem.grid;
    size_t points = nurbs_grid_rows(grid) * nurbs_grid_columns(grid);
    size_t n = galv_shape_parameters(p->shape);
    double *x = cli_needed(calloc(n, sizeof *x));
    double *d = cli_needed(malloc(3 * points * sizeof *d));
    bool sideways = true;
    for (size_t i = 0; i < 2 * n && sideways; i++) {
        x[i / 2] = (i % 2 ? galv_shape_lower : galv_shape_upper)(p->shape)[i / 2];
        sideways = galv_shape_displace(p->shape, points, nurbs_grid_points(grid), x, d) == GALV_OK;
        for (size_t k = 0; k < 3 * points && sideways; k++)
            sideways = k % 3 == 1 || d[k] == 0;
        x[i / 2] = 0;
    }
    free(d);
    free(x);
    return sideways;
}

static bool read_plan(const struct options *options, struct plan *p)
{
    if (!config_read(options->path, NULL, &p->config))
        return false;
    if (!problem_read(&p->config, &p->problem))
        return cli_refuse("%s", core_sentence());
    p->shape = problem_shape(&p->problem);
    if (!p->shape)
        return false;
    evaluation_start(0, "parent", NULL, &p->parent);
    evaluate_parent(&p->problem, &p->parent, keep_warnings, p);
    bool descent = method_row(p->config.method)->kind == METHOD_DESCENT;
    if (descent && !p->parent.failed)
        descent_cost(&p->problem, moves_sideways(p), &p->coarse, &p->tangents);
    if (isnan(p->coarse))
        return cli_refuse("%s: the original cannot be solved on the mesh of the derivatives",
                          p->config.hull);
    return !p->parent.failed || cli_refuse("%s: the original cannot be evaluated (%s)",
                                           p->config.hull, p->parent.reason);
}

/* For derivatives at every second design: with one variable for each parameter, which are the most.
 */
static double derivatives(const struct plan *p)
{
    return ceil((double)p->config.iterations / 2);
}

static double coarse_solves(const struct plan *p)
{
    return p->coarse > 0 ? derivatives(p) * (1 + (double)galv_shape_parameters(p->shape)) : 0;
}

static double seconds(const struct plan *p)
{
    double tangents = p->tangents > 0 ? derivatives(p) * p->tangents : 0;
    return coarse_solves(p) * (p->coarse + p->parent.geometry_seconds) +
           tangents * p->parent.solve_seconds +
           (p->parent.geometry_seconds + p->parent.solve_seconds) *
               (double)search_budget(&p->config);
}

static bool print_json(const struct plan *p)
{
    const nurbs_hydrostatics *h = nurbs_hull_hydrostatics(p->problem.parent.hull);
    json_t *o = json_pack(
        "{s:f, s:f, s:f, s:f, s:f, s:f, s:i, s:i, s:i, s:s, s:f, s:i, s:f, s:i, s:f, s:O}",
        "length", problem_length(&p->problem), "beam", h->beam, "draft", h->draft, "volume",
        h->volume, "wetted_area", h->wetted_area, "transom_area", h->transom_area, "sections",
        (int)nurbs_grid_rows(p->problem.grid), "girth", (int)nurbs_grid_columns(p->problem.grid),
        "parameters", (int)galv_shape_parameters(p->shape), "formulation",
        igabem_formulation_name(p->problem.solver.formulation), "fr", p->problem.solver.froude,
        "dofs", (int)p->parent.dofs, "cw", p->parent.cw, "evaluations",
        (int)search_budget(&p->config), "seconds", seconds(p), "warnings", p->warnings);
    json_result_set(o, "coarse_seconds", json_real(p->coarse));
    json_result_set(o, "coarse_solves", json_real(coarse_solves(p)));
    return json_result_print(o, JSON_INDENT(2) | JSON_REAL_PRECISION(15)) == CLI_OK;
}

static void print_hull(const struct plan *p)
{
    const struct problem *problem = &p->problem;
    const nurbs_hydrostatics *h = nurbs_hull_hydrostatics(problem->parent.hull);
    const nurbs_surface *patch = nurbs_patches_get(nurbs_hull_light(problem->parent.hull), 0);
    printf("%-16s%s\n%-16slength %.5g m, beam %.4g, draft %.4g, volume %.5g m³, wetted area "
           "%.5g m², %s\n",
           "hull", p->config.hull, "", problem_length(problem), h->beam, h->draft, h->volume,
           h->wetted_area, h->transom_area > 0 ? "immersed transom" : "no transom");
    printf("%-16s%zu sections of %zu points\n", "design grid", nurbs_grid_rows(problem->grid),
           nurbs_grid_columns(problem->grid));
    printf("%-16s%zu x %zu control points, within %.2g m of the hull\n", "patch",
           nurbs_surface_size(patch, 0), nurbs_surface_size(patch, 1),
           nurbs_hull_bound(problem->parent.hull));
    if (p->config.maker.command)
        printf("%-16s%s\n%-16s%zu", "command", p->config.maker.command, "parameters",
               p->config.n_parameters);
    if (config_by_command(&p->config))
        printf(", which are searched directly\n");
    else if (p->config.snapshots)
        printf("\n%-16s%zu snapshots, %.4g %% of the variance\n", "latent space",
               p->config.snapshots, 100 * p->config.variance);
    else
        printf("%-16s%s: %zu parameters\n%-16s%zu samples, %.4g %% of the variance\n", "shape",
               p->config.shape, galv_shape_parameters(p->shape), "latent space", p->config.samples,
               100 * p->config.variance);
}

static void print_solver(const struct plan *p)
{
    const igabem_options *o = &p->problem.solver;
    printf("%-16sFr %g, U %.4g m/s\n%-16s%s, filter at tan %.4g, stem limit %.4g\n", "speed",
           o->froude, o->froude * sqrt(o->gravity * problem_length(&p->problem)), "formulation",
           igabem_formulation_name(o->formulation), o->cutoff_angle, o->stem_limit);
    printf("%-16s%zu unknowns\n%-16sC_w %.4e, %.2f s\n", "mesh", p->parent.dofs, "original",
           p->parent.cw, p->parent.geometry_seconds + p->parent.solve_seconds);
    if (p->config.free_to_trim)
        printf("%-16ssunk by %.4g m, trimmed by %.3g degrees\n", "floating", p->parent.sinkage,
               p->parent.trim);
    if (p->config.judge.command)
        printf("%-16s%s: %.6g\n", "objective", p->config.judge.command, p->parent.value);
    for (size_t k = 0; k < objectives_count(&p->config) && objectives_count(&p->config) > 1; k++) {
        struct objective described;
        objectives_describe(&p->config, k, &described);
        printf("%-16s%s%s: %.5g\n", k ? "" : "objectives", described.label,
               described.maximise ? ", raised" : "",
               described.scale * objectives_value(&p->config, k, problem_length(&p->problem),
                                                  &p->parent, &p->parent));
    }
    for (size_t k = 0; k < constraints_count(); k++) {
        struct constraint_figures f;
        constraints_figures(&p->config, k, &p->parent, &p->parent, &f);
        if (!f.is_optional || !isnan(f.allowed))
            printf("%-16s%s: %s\n", k ? "" : "limits", f.name, f.limit);
    }
}

static void print_search(const struct plan *p)
{
    const struct config *c = &p->config;
    if (p->tangents > 0)
        printf("%-16sby tangents%s, about %.2g solves each time\n", "derivatives",
               p->coarse > 0 ? " where a formulation has them" : "", p->tangents);
    if (p->coarse > 0)
        printf("%-16s%.2f s a coarse solve, at most %zu each time, about %.0f in all\n",
               p->tangents > 0 ? "" : "derivatives", p->coarse, 1 + galv_shape_parameters(p->shape),
               coarse_solves(p));
    printf("%-16s%s, at most %zu designs: about %.0f min on %d threads\n", "search",
           method_row(c->method)->name, search_budget(c), ceil(seconds(p) / 60), cli_threads());
    printf("%-16sresolution x %d, %zu other speeds\n", "verification", c->verify_refine,
           c->verify_froudes);
}

int check_command(const struct options *options)
{
    struct plan plan = {.warnings = json_array()};
    bool ok = (plan.warnings || cli_refuse("out of memory")) && read_plan(options, &plan);
    for (size_t i = 0; i < json_array_size(plan.warnings); i++)
        fprintf(stderr, "%s: warning: %s\n", cli_name(),
                json_string_value(json_array_get(plan.warnings, i)));
    if (ok && options->json) {
        ok = print_json(&plan);
    } else if (ok) {
        print_hull(&plan);
        print_solver(&plan);
        print_search(&plan);
        ok = cli_printed() == CLI_OK;
    }
    json_decref(plan.warnings);
    galv_shape_free(plan.shape);
    problem_free(&plan.problem);
    config_free(&plan.config);
    return ok ? CLI_OK : CLI_FAILED;
}
