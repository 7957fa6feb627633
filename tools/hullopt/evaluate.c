#include "evaluate.h"

#include "cli.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

bool evaluation_create(size_t modes, struct evaluation *e)
{
    *e = (struct evaluation){.cw = NAN,
                             .cw_pressure = NAN,
                             .rw = NAN,
                             .share_beyond_cutoff = NAN,
                             .condition = NAN,
                             .volume = NAN,
                             .volume_ratio = NAN,
                             .wetted_area = NAN,
                             .bound = NAN};
    for (size_t i = 0; i < CONFIG_FROUDE_MOST; i++)
        e->cw_speed[i] = NAN;
    e->u = calloc(modes, sizeof *e->u);
    return e->u != NULL;
}

void evaluation_free(struct evaluation *evaluation)
{
    free(evaluation->u);
    *evaluation = (struct evaluation){0};
}

static bool make_hull(const struct parent *parent, const struct design *design, igabem_hull **hull,
                      struct failure *failure)
{
    const nurbs_surface *patch = design->light;
    *hull = NULL;
    if (igabem_hull_create(&patch, 1, IGABEM_SYMMETRIC, hull) != IGABEM_OK ||
        (parent->length > 0 && igabem_hull_set_length(*hull, parent->length) != IGABEM_OK)) {
        igabem_hull_free(*hull);
        *hull = NULL;
        return failure_set(failure, "hull", "%s", igabem_last_error());
    }
    return true;
}

bool evaluate_build(struct evaluator *evaluator, const double *u, struct design *design,
                    igabem_hull **hull, struct failure *failure)
{
    double *d = NULL;
    if (u) {
        d = evaluator->scratch;
        latent_displace(evaluator->latent, u, d);
    }
    if (!design_build(evaluator->parent, d, evaluator->tolerance, design, failure))
        return false;
    if (hull && !make_hull(evaluator->parent, design, hull, failure)) {
        design_free(design);
        return false;
    }
    return true;
}

bool evaluator_create(const struct config *config, const struct parent *parent,
                      const struct latent *latent, struct evaluator *evaluator)
{
    struct failure failure;
    struct design design;
    igabem_hull *hull;
    *evaluator = (struct evaluator){.parent = parent,
                                    .latent = latent,
                                    .tolerance = config->tolerance,
                                    .displacement = config->displacement,
                                    .limits = {config->pressure, config->speeds},
                                    .solver = config->solver,
                                    .speeds = config->verify_froudes};
    if (!evaluate_build(evaluator, NULL, &design, &hull, &failure)) {
        cli_fail("%s: the parent cannot be built (%s): %s", config->hull, failure.stage,
                 failure.reason);
        return false;
    }
    evaluator->parent_volume = design.hydrostatics.volume;
    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    evaluator->parent_nu_s = info.nu_s;
    bool ok = igabem_options_freeze(hull, &evaluator->solver) == IGABEM_OK;
    for (size_t i = 0; i < evaluator->speeds && ok; i++) {
        evaluator->speed[i] = config->solver;
        evaluator->speed[i].froude = config->verify_froude[i];
        ok = igabem_options_freeze(hull, &evaluator->speed[i]) == IGABEM_OK;
    }
    if (!ok)
        cli_fail("%s: %s", config->path, igabem_last_error());
    else if (!isnan(config->pressure) &&
             !igabem_formulation_info(evaluator->solver.formulation)->pressure)
        ok = cli_fail("%s: constraints.pressure needs a resistance by pressure, which %s has not",
                      config->path,
                      igabem_formulation_name(evaluator->solver.formulation)) == CLI_OK;
    if (ok && latent) {
        evaluator->scratch = malloc(latent->coordinates * sizeof *evaluator->scratch);
        ok = evaluator->scratch != NULL;
        if (!ok)
            cli_fail("out of memory");
    }
    igabem_hull_free(hull);
    design_free(&design);
    return ok;
}

void evaluator_free(struct evaluator *evaluator)
{
    free(evaluator->scratch);
    *evaluator = (struct evaluator){0};
}

static bool check_displacement(const struct evaluator *evaluator, const struct evaluation *e,
                               struct failure *failure)
{
    double change = e->volume_ratio - 1;
    if (isnan(evaluator->displacement) || fabs(change) <= evaluator->displacement)
        return true;
    return failure_set(failure, "displacement",
                       "displacement differs by %+.2f %% from the parent's, allowed %.2f %%",
                       100 * change, 100 * evaluator->displacement);
}

static bool compute_forces(const igabem_solution *solution, igabem_forces *forces,
                           struct failure *failure)
{
    if (igabem_forces_compute(solution, forces) != IGABEM_OK)
        return failure_set(failure, "forces", "%s", igabem_last_error());
    if (!(forces->cw > 0 && isfinite(forces->cw)))
        return failure_set(failure, "forces", "C_w is %g at Fr %g, expected a positive number",
                           forces->cw, igabem_solution_options(solution)->froude);
    return true;
}

static bool record(igabem_solution *const *solutions, struct evaluation *e, struct failure *failure)
{
    igabem_forces forces;
    for (size_t i = 0; i < e->speeds; i++) {
        if (!compute_forces(solutions[1 + i], &forces, failure))
            return false;
        e->cw_speed[i] = forces.cw;
    }
    if (!compute_forces(solutions[0], &forces, failure))
        return false;
    e->cw = forces.cw;
    e->cw_pressure = forces.cw_pressure;
    e->rw = forces.rw;
    e->share_beyond_cutoff = forces.share_beyond_cutoff;
    e->condition = forces.condition;
    e->dofs = forces.dofs;
    return true;
}

/* The speed of the search, and the others when the configuration bounds C_w there. */
static bool solve(const struct evaluator *evaluator, const igabem_hull *hull, struct evaluation *e,
                  struct failure *failure)
{
    igabem_solution *solutions[1 + CONFIG_FROUDE_MOST];
    igabem_options options[1 + CONFIG_FROUDE_MOST];
    e->speeds = isnan(evaluator->limits.speeds) ? 0 : evaluator->speeds;
    options[0] = evaluator->solver;
    for (size_t i = 0; i < e->speeds; i++)
        options[1 + i] = evaluator->speed[i];
    if (igabem_solve_many(hull, 1 + e->speeds, options, solutions) != IGABEM_OK)
        return failure_set(failure, "solve", "%s", igabem_last_error());
    bool ok = record(solutions, e, failure);
    for (size_t i = 0; i <= e->speeds; i++)
        igabem_solution_free(solutions[i]);
    return ok;
}

void evaluate(struct evaluator *evaluator, struct evaluation *e)
{
    struct design design = {0};
    struct failure failure = {"", ""};
    igabem_hull *hull = NULL;
    double start = cli_seconds();
    bool ok = evaluate_build(evaluator, e->u, &design, &hull, &failure);
    if (ok) {
        e->volume = design.hydrostatics.volume;
        e->volume_ratio = e->volume / evaluator->parent_volume;
        e->wetted_area = design.hydrostatics.wetted_area;
        e->bound = design.bound;
        ok = check_displacement(evaluator, e, &failure);
    }
    double built = cli_seconds();
    ok = ok && solve(evaluator, hull, e, &failure);
    e->geometry_seconds = built - start;
    e->solve_seconds = cli_seconds() - built;
    e->failed = !ok;
    snprintf(e->stage, sizeof e->stage, "%s", failure.stage);
    snprintf(e->reason, sizeof e->reason, "%s", failure.reason);
    igabem_hull_free(hull);
    design_free(&design);
}
