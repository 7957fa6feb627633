#include "core/optimise.h"

#include "core/constraints.h"
#include "core/forecast.h"
#include "core/front.h"
#include "core/search.h"
#include "core/snapshots.h"
#include "core/verify.h"
#include "core/waves.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool write_record(struct problem *problem, const char *path)
{
    struct record record;
    bool ok = search_open(problem, path, &record) && record_put_origin(&record, problem);
    record_close(&record);
    return ok;
}

/* Initial designs by the derivatives at the original, where they are asked for. */
static bool make_initial(struct problem *problem, const struct core_watch *watch)
{
    const struct config *config = problem->config;
    if (config->design != CONFIG_DESIGN_FORECAST ||
        method_row(config->method)->kind != METHOD_GAUSSIAN_PROCESS)
        return true;
    core_show(watch, "initial designs", 0, NULL);
    problem->initial =
        malloc(config->initial * galv_model_modes(problem->model) * sizeof *problem->initial);
    return (problem->initial || core_no_memory()) &&
           forecast_design(problem, config->initial, problem->initial);
}

/* The record is made under another name and renamed once complete. */
bool optimise_begin(struct problem *problem, const galv_shape *shape, const char *path,
                    const struct core_watch *watch)
{
    char *fresh = malloc(strlen(path) + sizeof ".new");
    if (!fresh)
        return core_no_memory();
    strcat(strcpy(fresh, path), ".new");
    record_remove(fresh);
    bool ok = problem_reduce(problem, shape, watch) && make_initial(problem, watch) &&
              write_record(problem, fresh);
    if (ok && rename(fresh, path) != 0)
        ok = core_fail("%s: %s", path, strerror(errno));
    if (!ok)
        record_remove(fresh);
    free(fresh);
    return ok;
}

bool optimise_resume(struct problem *problem, const char *path)
{
    char difference[400];
    struct record record;
    struct origin origin;
    if (!record_read(path, &record, &origin))
        return false;
    record_close(&record);
    bool ok =
        !config_difference(problem->config->text, origin.configuration,
                           (const char *const[]){"now", "then"}, difference, sizeof difference) ||
        core_fail("%s was started with another configuration (%s): resume with that one or "
                  "choose another folder",
                  path, difference);
    if (ok && ((origin.initial && origin.n_initial != problem->config->initial) ||
               (origin.map && origin.n_parameters != problem->config->n_parameters)))
        ok = core_fail("%s: its initial designs or its parameters are damaged", path);
    if (ok) {
        problem->ends = origin.ends;
        origin.ends = NULL;
        problem->map = origin.map;
        origin.map = NULL;
        ok = problem_recall(problem, origin.model, origin.gradient);
        origin.model = NULL;
        problem->initial = origin.initial;
        origin.initial = NULL;
    }
    origin_free(&origin);
    return ok;
}

bool optimise_set_best(struct problem *problem, const struct record *record,
                       const struct evaluation *best)
{
    bool command = config_by_command(problem->config);
    if (command &&
        !record_get_points(record, best->id, galv_model_points(problem->model), &problem->found))
        return false;
    if (command && !problem->found && !problem->is_solved)
        return core_fail("the hull of design %llu is not on record; the command left it in %s",
                         (unsigned long long)best->id, best->made);
    return problem_set_best(problem, best->u);
}

static bool build_best(struct problem *problem, const struct record *record, double *u)
{
    struct evaluation *list;
    size_t n;
    bool ok = record_evaluations(record, &list, &n);
    const struct evaluation *best = NULL;
    ok = ok && front_best(record, problem->config, problem_length(problem), n, list, &best);
    if (best)
        memcpy(u, best->u, galv_model_modes(problem->model) * sizeof *u);
    if (best && best->id != 0)
        ok = optimise_set_best(problem, record, best);
    free(list);
    return ok;
}

/* Variables that are the parameters already, and how far the shape is from its linear part there.
 */
static bool keep_parameters(const struct problem *problem, const galv_shape *shape, const double *u,
                            double *x, double *residual)
{
    size_t points = galv_model_points(problem->model);
    double *d = malloc(6 * points * sizeof *d), sum = 0;
    if (!d)
        return core_no_memory();
    memcpy(x, u, galv_shape_parameters(shape) * sizeof *x);
    if (config_by_command(problem->config)) {
        for (size_t k = 0; k < galv_shape_parameters(shape); k++)
            x[k] += problem->config->original[k];
        *residual = 0;
        free(d);
        return true;
    }
    bool ok =
        (galv_shape_displace(shape, points, nurbs_grid_points(problem->grid), u, d) == GALV_OK &&
         galv_reconstruct(problem->model, u, d + 3 * points) == GALV_OK) ||
        core_fail("%s", galv_last_error());
    for (size_t k = 0; k < 3 * points && ok; k++)
        sum += (d[k] - d[3 * points + k]) * (d[k] - d[3 * points + k]);
    *residual = sqrt(sum / (double)points);
    free(d);
    return ok;
}

static bool map_parameters(const struct problem *problem, const galv_shape *shape, const double *u,
                           double *x, double *residual)
{
    return galv_model_method(problem->model) == GALV_METHOD_PARAMETERS
               ? keep_parameters(problem, shape, u, x, residual)
               : galv_backmap(problem->model, shape, u, x, residual) == GALV_OK ||
                     core_fail("back-mapping: %s", galv_last_error());
}

/* Of snapshots: the command's hull that is nearest, and what it is worth. One that the command
 * refuses is no failure of the run. */
static bool match_parameters(struct problem *problem, const double *u, struct record *record,
                             const struct core_watch *watch, double *x, double *residual)
{
    struct snapshots_match match = {.x = x};
    core_show(watch, "back to the command", 0, NULL);
    if (!snapshots_match(problem, u, &match)) {
        core_tell(watch, "the command makes no hull of the optimum: %s", core_sentence());
        *residual = NAN;
        for (size_t k = 0; k < problem->config->n_parameters; k++)
            x[k] = NAN;
        return true;
    }
    *residual = match.residual;
    return record_put_text(record, "best.made", match.made) &&
           record_put_array(record, "best.made.cw", 1, 1, &match.cw);
}

/* The parameters of the original family nearest to the best design. */
static bool back_map(struct problem *problem, const galv_shape *shape, const double *u,
                     struct record *record, const struct core_watch *watch)
{
    size_t n = galv_shape_parameters(shape), rows, columns;
    double residual, *known, *x = malloc(n * sizeof *x);
    bool ok = (x || core_no_memory()) &&
              record_get_array(record, "best.residual", &rows, &columns, &known);
    bool have = ok && known;
    if (ok)
        free(known);
    if (ok && !have)
        ok = (problem->map ? match_parameters(problem, u, record, watch, x, &residual)
                           : map_parameters(problem, shape, u, x, &residual)) &&
             record_put_array(record, "best.parameters", 1, n, x) &&
             record_put_array(record, "best.residual", 1, 1, &residual);
    free(x);
    return ok;
}

bool optimise_run(struct problem *problem, const galv_shape *shape, struct record *record,
                  const struct core_watch *watch)
{
    double *best = malloc(galv_model_modes(problem->model) * sizeof *best);
    bool ok = (best || core_no_memory()) && search_run(problem, record, watch) &&
              build_best(problem, record, best) && verify_run(problem, record, watch) &&
              waves_run(problem, record, watch) &&
              (!problem->best.hull || back_map(problem, shape, best, record, watch)) &&
              record_update_session(record);
    free(best);
    return ok;
}
