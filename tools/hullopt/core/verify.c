#include "core/verify.h"

#include "cli.h"
#include "core/attitude.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Where neumann-kelvin-stern changes kernels is a choice; two shorter sterns beside the objective's
 * show how much the choice decides. Shares of the length. */
static const double OTHER_STERNS[] = {0.18, 0.26};

const double VERIFY_COARSER = 2.0 / 3;

const char *verification_group_name(enum verification_group group)
{
    static const char *const names[GROUPS] = {"objective", "formulation", "stern",  "resolution",
                                              "filter",    "speed",       "coarser"};
    return (unsigned)group < GROUPS ? names[group] : "";
}

static void add(struct verification *rows, igabem_options *options, size_t *n,
                enum verification_group group, const char *label, const igabem_options *setting)
{
    struct verification *row = &rows[*n];
    *row = (struct verification){.group = group,
                                 .froude = setting->froude,
                                 .refine = setting->refine,
                                 .stern_length = NAN,
                                 .cw_parent = NAN,
                                 .cw_best = NAN,
                                 .cw_pressure_parent = NAN,
                                 .cw_pressure_best = NAN};
    snprintf(row->label, sizeof row->label, "%s", label);
    snprintf(row->formulation, sizeof row->formulation, "%s",
             igabem_formulation_name(setting->formulation));
    if (igabem_formulation_info(setting->formulation)->stern_rows)
        row->stern_length = setting->stern_length;
    options[(*n)++] = *setting;
}

static void plan_models(const igabem_options *frozen, struct verification *rows,
                        igabem_options *options, size_t *n)
{
    const igabem_formulation_row *formulation;
    char label[80];
    for (igabem_formulation f = IGABEM_FORMULATION_AUTO + 1;
         (formulation = igabem_formulation_info(f)); f++) {
        if (f == frozen->formulation)
            continue;
        igabem_options other = *frozen;
        other.formulation = f;
        add(rows, options, n, GROUP_FORMULATION, formulation->name, &other);
    }
    for (size_t i = 0; i < sizeof OTHER_STERNS / sizeof *OTHER_STERNS; i++) {
        if (!igabem_formulation_info(frozen->formulation)->stern_rows)
            break;
        igabem_options other = *frozen;
        other.stern_length = OTHER_STERNS[i];
        snprintf(label, sizeof label, "stern length %.2f L", other.stern_length);
        add(rows, options, n, GROUP_STERN, label, &other);
    }
}

static void scale_surface(double factor, igabem_options *options)
{
    const double least = 4; /* of either, as igabem_options says */
    if (options->surface_cells > 0)
        options->surface_cells = fmax(least, round(factor * options->surface_cells));
    if (options->surface_rows > 0)
        options->surface_rows = fmax(least, round(factor * options->surface_rows));
}

/* With the mesh of the search three, where the density has spans of its own. */
static void plan_ladder(int refine, const igabem_options *frozen, struct verification *rows,
                        igabem_options *options, size_t *n)
{
    char label[80];
    igabem_options finer = *frozen, coarser = *frozen;
    finer.refine *= refine;
    if (finer.refine_v > 0)
        finer.refine_v *= refine;
    scale_surface(refine, &finer);
    snprintf(label, sizeof label, "%d times the resolution", refine);
    add(rows, options, n, GROUP_RESOLUTION, label, &finer);
    coarser.elements_u = (int)lround(VERIFY_COARSER * frozen->elements_u);
    coarser.elements_v = (int)lround(VERIFY_COARSER * frozen->elements_v);
    scale_surface(VERIFY_COARSER, &coarser);
    if (coarser.elements_u >= 2 && coarser.elements_v >= 2)
        add(rows, options, n, GROUP_COARSER, "two thirds of the resolution", &coarser);
}

size_t verify_plan(const struct problem *problem, struct verification rows[VERIFY_MOST],
                   igabem_options options[VERIFY_MOST])
{
    const struct config *config = problem->config;
    const igabem_options *frozen = &problem->solver;
    size_t n = 0;
    char label[80];
    add(rows, options, &n, GROUP_OBJECTIVE, "objective of the search", frozen);
    if (config->verify_refine == 0)
        return n;
    plan_models(frozen, rows, options, &n);
    if (config->verify_refine > 1)
        plan_ladder(config->verify_refine, frozen, rows, options, &n);
    if (isfinite(frozen->cutoff_angle)) {
        igabem_options own = *frozen;
        own.cutoff_angle = own.stem_limit = NAN;
        add(rows, options, &n, GROUP_FILTER, "each hull's own filter", &own);
    }
    for (size_t i = 0; i < problem->speeds; i++) {
        igabem_options outside = problem->speed[i];
        snprintf(label, sizeof label, "Fr %g", outside.froude);
        add(rows, options, &n, GROUP_SPEED, label, &outside);
        static const igabem_formulation outside_of_it[] = {IGABEM_FORMULATION_EXTERIOR,
                                                           IGABEM_FORMULATION_DOUBLE_MODEL};
        for (size_t k = 0; k < 2; k++) {
            outside.formulation = outside_of_it[k];
            if (frozen->formulation != outside_of_it[k])
                add(rows, options, &n, GROUP_SPEED, label, &outside);
        }
    }
    return n;
}

/* Parent and optimum as they float at one speed. */
struct pair {
    double froude;
    struct attitude parent, best;
};

static bool solve_one(const struct attitude *at, const igabem_options *options, const char *who,
                      double *cw, double *cw_pressure, size_t *dofs, struct verification *row)
{
    igabem_solution *solution;
    igabem_forces forces;
    igabem_status status = igabem_solve(at->body, options, &solution);
    if (status == IGABEM_OK) {
        status = igabem_forces_compute(solution, &forces);
        igabem_solution_free(solution);
    }
    if (!core_ok(status, "%s: %.200s", who, igabem_last_error())) {
        snprintf(row->note, sizeof row->note, "%s", core_sentence());
        return false;
    }
    *cw = forces.cw * at->area;
    *cw_pressure = forces.cw_pressure * at->area;
    *dofs = forces.dofs;
    return true;
}

static void solve_row(const struct pair *pair, bool has_best, const igabem_options *options,
                      struct verification *row)
{
    double start = cli_seconds();
    if (solve_one(&pair->parent, options, "parent", &row->cw_parent, &row->cw_pressure_parent,
                  &row->dofs_parent, row) &&
        has_best)
        solve_one(&pair->best, options, "optimum", &row->cw_best, &row->cw_pressure_best,
                  &row->dofs_best, row);
    if (!has_best) {
        row->cw_best = row->cw_parent;
        row->cw_pressure_best = row->cw_pressure_parent;
        row->dofs_best = row->dofs_parent;
    }
    row->seconds = cli_seconds() - start;
}

static void pair_free(struct pair *pair)
{
    attitude_free(&pair->parent);
    attitude_free(&pair->best);
}

/* Rows of one speed stand together as far as can be: the pair of the last one is kept. */
static bool pair_find(const struct problem *problem, double froude, struct pair *pair)
{
    if (pair->froude == froude)
        return true;
    pair_free(pair);
    *pair = (struct pair){.froude = froude};
    return attitude_find(problem, &problem->parent, froude, &pair->parent) &&
           attitude_find(problem, problem_best(problem), froude, &pair->best);
}

bool verify_run(const struct problem *problem, struct record *record,
                const struct core_watch *watch)
{
    struct verification rows[VERIFY_MOST], *known;
    igabem_options options[VERIFY_MOST];
    struct pair pair = {.froude = NAN};
    size_t done, n = verify_plan(problem, rows, options);
    bool ok = record_verifications(record, &known, &done);
    free(known);
    for (size_t i = done; i < n && ok; i++) {
        core_show(watch, "verification", (double)i / (double)n, rows[i].label);
        ok = core_goes_on(watch) && pair_find(problem, options[i].froude, &pair);
        if (!ok)
            break;
        solve_row(&pair, problem->best.hull, &options[i], &rows[i]);
        ok = !core_lacked_memory() && record_put_verification(record, i, &rows[i]) &&
             record_update_session(record);
    }
    pair_free(&pair);
    return ok;
}
