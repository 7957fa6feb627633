#include "cli.h"
#include "cli/commands.h"
#include "core/constraints.h"
#include "core/objective.h"
#include "json_result.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One design of a configuration, for an optimiser of one's own. */
struct asked {
    struct config config;
    struct problem problem;
    galv_shape *shape;
    struct evaluation parent, design;
    double *points; /* of the moved grid */
    double *u;      /* parameters of a command, less the original's; or NULL */
};

static bool read_problem(const struct options *options, struct asked *a)
{
    if (!config_read(options->path, NULL, &a->config))
        return false;
    if (!problem_read(&a->config, &a->problem))
        return cli_refuse("%s", core_sentence());
    const nurbs_grid *grid = a->problem.grid;
    size_t points = nurbs_grid_rows(grid) * nurbs_grid_columns(grid);
    a->shape = problem_shape(&a->problem);
    a->points = malloc(3 * points * sizeof *a->points);
    return a->shape && (a->points || cli_refuse("out of memory"));
}

static bool check_count(const char *option, size_t given, size_t expected)
{
    return given == expected ||
           cli_refuse("--%s has %zu numbers, expected %zu", option, given, expected);
}

/* Of a command: what is evaluated is its hull, moved from the original. */
static bool set_parameters(const struct options *options, struct asked *a)
{
    const struct config *c = &a->config;
    a->u = malloc(c->n_parameters * sizeof *a->u);
    for (size_t k = 0; a->u && k < c->n_parameters; k++) {
        a->u[k] = options->parameters[k] - c->original[k];
        if (!(options->parameters[k] >= c->lower[k] && options->parameters[k] <= c->upper[k]))
            return cli_refuse("--parameters: %s is %g, expected %g to %g", c->parameter[k],
                              options->parameters[k], c->lower[k], c->upper[k]);
    }
    return a->u || cli_refuse("out of memory");
}

/* The same where a latent space moves the grid. */
static bool make_points(const struct options *options, struct asked *a)
{
    bool ok = set_parameters(options, a) && (problem_make_points(&a->problem, a->u, a->points) ||
                                             cli_refuse("%s", core_sentence()));
    free(a->u);
    a->u = NULL;
    return ok;
}

/* In the space of the run, so that a design has the figures that a run would give it. */
static bool move_points(const struct options *options, struct asked *a)
{
    const struct core_watch nobody = {.show = NULL};
    struct problem *p = &a->problem;
    const nurbs_grid *grid = p->grid;
    size_t points = nurbs_grid_rows(grid) * nurbs_grid_columns(grid);
    if (options->n_parameters &&
        !check_count("parameters", options->n_parameters, galv_shape_parameters(a->shape)))
        return false;
    if (!problem_reduce(p, a->shape, &nobody))
        return cli_refuse("%s", core_sentence());
    if (config_by_command(p->config))
        return options->n_latent
                   ? cli_refuse("--latent: the hulls of parameters.command have parameters alone")
                   : set_parameters(options, a);
    if (options->n_latent)
        return check_count("latent", options->n_latent, galv_model_modes(p->model)) &&
               (galv_displace(p->model, options->latent, a->points) == GALV_OK ||
                cli_refuse("%s", galv_last_error()));
    if (p->config->maker.command)
        return make_points(options, a);
    if (galv_shape_displace(a->shape, points, nurbs_grid_points(grid), options->parameters,
                            a->points) != GALV_OK)
        return cli_refuse("%s", galv_last_error());
    for (size_t k = 0; k < 3 * points; k++)
        a->points[k] += nurbs_grid_points(grid)[k];
    return true;
}

static bool evaluate_both(struct asked *a)
{
    evaluation_start(0, "parent", NULL, &a->parent);
    evaluate_parent(&a->problem, &a->parent, NULL, NULL);
    if (a->parent.failed)
        return cli_refuse("%s: the original cannot be evaluated (%s)", a->config.hull,
                          a->parent.reason);
    evaluation_start(1, "asked", a->u, &a->design);
    if (a->u)
        evaluate(&a->problem, &a->design, NULL, NULL);
    else
        evaluate_points(&a->problem, a->points, &a->design);
    return true;
}

static void put(json_t *o, const char *name, double value)
{
    json_result_set(o, name, isfinite(value) ? json_real(value) : json_null());
}

/* Every constraint of the run by the built design. */
static json_t *constraints(const struct asked *a, bool *allowed)
{
    json_t *o = json_object();
    *allowed = !a->design.failed;
    for (size_t k = 0; k < constraints_count(); k++) {
        struct constraint_figures f;
        constraints_figures(&a->config, k, &a->parent, &a->design, &f);
        if (isnan(f.allowed))
            continue;
        json_t *row = json_object();
        put(row, "ratio", f.ratio);
        put(row, "excess", f.excess);
        json_result_set(row, "satisfied", json_boolean(f.kept));
        json_result_set(o, f.name, row);
        *allowed = *allowed && f.kept;
    }
    return o;
}

static json_t *list(size_t n, const double *values)
{
    json_t *array = json_array();
    for (size_t i = 0; i < n; i++)
        json_array_append_new(array, json_real(values[i]));
    return array;
}

static double objective_ratio(const struct asked *a)
{
    return objective_of(&a->config, problem_length(&a->problem), &a->design, &a->parent) /
           a->parent.cw;
}

/* Of several, by name and in SI units. */
static json_t *objectives(const struct asked *a)
{
    json_t *array = json_array();
    struct objective described;
    for (size_t k = 0; k < objectives_count(&a->config); k++) {
        json_t *row = json_object();
        objectives_describe(&a->config, k, &described);
        json_result_set(row, "name", json_string(described.name));
        put(row, "value",
            objectives_value(&a->config, k, problem_length(&a->problem), &a->design, &a->parent));
        json_result_append(array, row);
    }
    return array;
}

static json_t *result(const struct asked *a)
{
    const struct evaluation *e = &a->design;
    bool allowed;
    json_t *o = json_object(), *limits = constraints(a, &allowed);
    json_result_set(o, "failed", json_boolean(e->failed));
    json_result_set(o, "reason", json_string(e->reason));
    json_result_set(o, "allowed", json_boolean(allowed));
    put(o, "objective", objective_ratio(a));
    if (objectives_count(&a->config) > 1)
        json_result_set(o, "objectives", objectives(a));
    if (a->config.judge.command)
        put(o, "value", e->value);
    put(o, "cw", e->cw);
    put(o, "cw_parent", a->parent.cw);
    put(o, "cw_pressure", e->cw_pressure);
    put(o, "rw", e->rw);
    put(o, "rt", objective_total_resistance(&a->config, problem_length(&a->problem), e));
    put(o, "volume", e->volume);
    put(o, "wetted_area", e->wetted_area);
    if (a->config.free_to_trim) {
        put(o, "sinkage", e->sinkage);
        put(o, "trim", e->trim);
    }
    json_result_set(o, "cw_models", list(e->failed ? 0 : e->models, e->cw_model));
    json_result_set(o, "cw_speeds", list(e->failed ? 0 : e->speeds, e->cw_speed));
    json_result_set(o, "constraints", limits);
    return o;
}

static bool print_text(const struct asked *a)
{
    const struct evaluation *e = &a->design;
    printf("%-22s%.4e, %+.2f %%\n%-22s%.5f\n", "C_w", e->cw, 100 * (e->cw / a->parent.cw - 1),
           "objective, ratio", objective_ratio(a));
    for (size_t k = 0; k < constraints_count(); k++) {
        struct constraint_figures f;
        constraints_figures(&a->config, k, &a->parent, e, &f);
        if (!isnan(f.allowed))
            printf("%-22s%+.3f %%, limit %s%s\n", f.name, 100 * f.change, f.limit,
                   f.kept ? "" : ": violated");
    }
    return cli_printed() == CLI_OK;
}

int evaluate_command(const struct options *options)
{
    struct asked a = {.points = NULL};
    bool ok = ((options->n_latent > 0) != (options->n_parameters > 0)) ||
              cli_refuse("expected one of --latent and --parameters");
    if (!ok)
        return CLI_USAGE;
    ok = read_problem(options, &a) && move_points(options, &a) && evaluate_both(&a);
    if (ok && options->json)
        ok = json_result_print(result(&a), JSON_INDENT(2) | JSON_REAL_PRECISION(17)) == CLI_OK;
    if (ok && a.design.failed)
        ok = cli_refuse("the design cannot be evaluated (%s)", a.design.reason);
    else if (ok && !options->json)
        ok = print_text(&a);
    free(a.points);
    free(a.u);
    galv_shape_free(a.shape);
    problem_free(&a.problem);
    config_free(&a.config);
    return ok ? CLI_OK : CLI_FAILED;
}
