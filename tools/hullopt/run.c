#include "run.h"

#include "cli.h"
#include "folder.h"
#include "outcome.h"
#include "outputs.h"
#include "search.h"
#include "shape_yaml.h"
#include "verify.h"
#include "waves.h"

#include <galv/galv.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int show_fraction(void *user_data, double fraction)
{
    cli_progress_update(user_data, fraction, NULL);
    return 0;
}

static bool build_model(const struct config *config, const struct parent *parent,
                        const galv_shape *shape, galv_model **model)
{
    struct cli_progress progress;
    galv_options options;
    galv_options_init(&options);
    options.variance = config->variance;
    options.progress = show_fraction;
    options.progress_user_data = &progress;
    size_t points = nurbs_grid_rows(parent->grid) * nurbs_grid_columns(parent->grid);
    cli_progress_start(&progress, "latent space");
    galv_status status =
        galv_build(shape, points, nurbs_grid_points(parent->grid),
                   galv_uniform(config->samples, config->latent_seed), &options, model);
    cli_progress_end(&progress);
    return status == GALV_OK || cli_fail("%s: %s", config->shape, galv_last_error()) == CLI_OK;
}

static char *describe_solver(const igabem_options *o)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    if (!out)
        return NULL;
    fprintf(out,
            "formulation = %s\nfroude = %.15g\ngravity = %.15g\ndensity = %.15g\nrefine = %d\n"
            "elements_u = %d\nelements_v = %d\n"
            "degree = %d\nline_term = %s\ncutoff_angle = %.15g\nstem_limit = %.15g\n"
            "stern_length = %.15g\nstern_blend = %.15g\nspectrum_limit = %.15g\n"
            "tolerance = %.15g\n",
            igabem_formulation_name(o->formulation), o->froude, o->gravity, o->density, o->refine,
            o->elements_u, o->elements_v, o->degree, o->line_term ? "true" : "false",
            o->cutoff_angle, o->stem_limit, o->stern_length, o->stern_blend, o->spectrum_limit,
            o->tolerance);
    if (fclose(out) != 0) {
        free(text);
        return NULL;
    }
    return text;
}

static bool fill_store(struct store *store, const struct config *config,
                       const struct parent *parent, const struct evaluator *evaluator,
                       const struct latent *latent, const double *volume_gradient)
{
    char *solver = describe_solver(&evaluator->solver);
    bool ok =
        solver && store_put_text(store, "version", TOOL_VERSION) &&
        store_put_text(store, "solver", solver) &&
        store_put_array(store, "length", 1, 1, &parent->length) &&
        store_put_array(store, "grid", nurbs_grid_rows(parent->grid),
                        3 * nurbs_grid_columns(parent->grid), nurbs_grid_points(parent->grid)) &&
        store_put_latent(store, latent) &&
        (!volume_gradient ||
         store_put_array(store, "volume.gradient", 1, latent->modes, volume_gradient)) &&
        store_put_text(store, "configuration", config->text);
    free(solver);
    return ok;
}

/* The database is made under another name and renamed once complete, so that run.db always holds a
 * whole run. */
static bool make_store(const struct config *config, const struct parent *parent,
                       struct evaluator *evaluator, const galv_shape *shape, const char *path)
{
    char *fresh = malloc(strlen(path) + sizeof ".new");
    galv_model *model = NULL;
    struct latent latent = {0};
    struct search search = {0};
    struct store *store = NULL;
    double *gradient = NULL;
    bool ok = fresh != NULL;
    if (ok) {
        strcat(strcpy(fresh, path), ".new");
        store_remove(fresh);
        ok = build_model(config, parent, shape, &model);
    }
    if (ok && !latent_copy_model(model, &latent))
        ok = cli_fail("out of memory") == CLI_OK;
    if (ok && (gradient = malloc(latent.modes * sizeof *gradient)) != NULL &&
        !limits_gradient(&latent, parent, config->tolerance, gradient)) {
        free(gradient);
        gradient = NULL;
    }
    if (ok) {
        evaluator->latent = &latent;
        ok = search_create(config, evaluator, fresh, gradient, &search);
        search_free(&search);
        evaluator->latent = NULL;
    }
    ok = ok && (store = store_create(fresh)) != NULL &&
         fill_store(store, config, parent, evaluator, &latent, gradient);
    store_close(store);
    if (ok && rename(fresh, path) != 0)
        ok = cli_fail("%s: %s", path, strerror(errno)) == CLI_OK;
    if (!ok && fresh)
        store_remove(fresh);
    galv_model_free(model);
    latent_free(&latent);
    free(gradient);
    free(fresh);
    return ok;
}

/* Decides between a new run and an old one; refuses what would mix two. */
static bool prepare_store(const struct run_options *options, const struct config *config,
                          const struct parent *parent, struct evaluator *evaluator,
                          const galv_shape *shape, const char *path)
{
    char difference[400];
    switch (store_probe(path)) {
    case STORE_UNUSABLE:
        return false;
    case STORE_ABSENT:
        return make_store(config, parent, evaluator, shape, path);
    case STORE_RUN:
        break;
    }
    if (!options->resume)
        return cli_fail("%s holds a run already: continue it with --resume or choose another "
                        "folder",
                        options->out) == CLI_OK;
    struct store *store = store_open(path);
    if (!store)
        return false;
    char *then = store_get_text(store, "configuration");
    bool changed = !then || config_difference(config->text, then, difference, sizeof difference);
    if (changed)
        cli_fail("%s was started with another configuration (%s): resume with that one or choose "
                 "another folder",
                 options->out, then ? difference : "none recorded");
    free(then);
    store_close(store);
    return !changed;
}

/* The parameters of the original family nearest to the optimum. The model is built again: the
 * regression that starts the search for them is not kept with the run. */
static bool back_map(const struct config *config, const struct parent *parent,
                     const galv_shape *shape, const struct latent *latent, const double *u,
                     struct store *store)
{
    size_t n = galv_shape_parameters(shape), rows, columns;
    double residual, *known = store_get_array(store, "best.residual", &rows, &columns);
    bool have = known != NULL;
    free(known);
    if (have)
        return true;
    galv_model *model = NULL;
    double *x = malloc(n * sizeof *x);
    bool ok = x && build_model(config, parent, shape, &model);
    if (ok && galv_model_modes(model) == latent->modes) {
        if (galv_backmap(model, shape, u, x, &residual) == GALV_OK)
            ok = store_put_array(store, "best.parameters", 1, n, x) &&
                 store_put_array(store, "best.residual", 1, 1, &residual);
        else
            ok = cli_fail("back-mapping: %s", galv_last_error()) == CLI_OK;
    }
    galv_model_free(model);
    free(x);
    return ok;
}

static bool find_best(struct store *store, const struct outcome_limits *limits, size_t modes,
                      double **u)
{
    struct evaluation *list;
    size_t n, best = 0;
    if (!store_list_evaluations(store, modes, &list, &n))
        return false;
    for (size_t i = 0; i < n; i++)
        if (outcome_allowed(limits, &list[i], &list[0]) && list[i].cw < list[best].cw)
            best = i;
    *u = NULL;
    bool ok = true;
    if (n && list[best].id != 0) {
        *u = list[best].u;
        list[best].u = NULL;
    }
    for (size_t i = 0; i < n; i++)
        evaluation_free(&list[i]);
    free(list);
    return ok;
}

static bool run_stages(const struct run_options *options, const struct config *config,
                       const struct parent *parent, struct evaluator *evaluator,
                       const galv_shape *shape, struct store *store, const char *path)
{
    struct search search = {0};
    double *best = NULL;
    size_t modes = evaluator->latent->modes, rows, columns;
    double *gradient = store_get_array(store, "volume.gradient", &rows, &columns);
    bool ok = (!gradient || columns == modes) &&
              store_begin_session(store, options->threads, options->start) &&
              search_create(config, evaluator, path, gradient, &search);
    free(gradient);
    if (ok) {
        search.store = store;
        ok = search_run(&search);
    }
    search_free(&search);
    ok = ok && find_best(store, &evaluator->limits, modes, &best) &&
         verify_run(config, evaluator, best, store) && waves_run(config, evaluator, best, store) &&
         (!best || back_map(config, parent, shape, evaluator->latent, best, store)) &&
         store_update_session(store);
    free(best);
    return ok;
}

static bool use_store(const struct run_options *options, const struct config *config,
                      struct parent *parent, struct evaluator *evaluator, const galv_shape *shape,
                      const char *path)
{
    struct latent latent = {0};
    struct store *store = store_open(path);
    bool ok = store && store_get_latent(store, &latent);
    if (ok) {
        evaluator->latent = &latent;
        evaluator->scratch = malloc(latent.coordinates * sizeof *evaluator->scratch);
        ok = evaluator->scratch != NULL || cli_fail("out of memory") == CLI_OK;
    }
    ok = ok && run_stages(options, config, parent, evaluator, shape, store, path) &&
         outputs_write(store, options->out, options->json);
    evaluator->latent = NULL;
    latent_free(&latent);
    store_close(store);
    return ok;
}

static bool run_in_folder(const struct run_options *options, const struct config *config,
                          struct parent *parent, struct evaluator *evaluator,
                          const galv_shape *shape)
{
    struct folder folder;
    if (!folder_open(&folder, options->out))
        return false;
    char *path = folder_join(options->out, "run.db");
    bool ready = path && prepare_store(options, config, parent, evaluator, shape, path);
    bool ok = ready && use_store(options, config, parent, evaluator, shape, path);
    if (ready)
        folder_close(&folder);
    else
        folder_abandon(&folder);
    free(path);
    return ok;
}

int run_command(const struct run_options *options)
{
    struct config config;
    struct parent parent = {0};
    struct evaluator evaluator = {0};
    galv_shape *shape = NULL;
    if (!config_read(options->configuration, &options->overrides, &config))
        return CLI_FAILED;
    bool ok =
        parent_read(&config, &parent) && evaluator_create(&config, &parent, NULL, &evaluator) &&
        (shape = shape_yaml_read(config.shape,
                                 nurbs_grid_rows(parent.grid) * nurbs_grid_columns(parent.grid),
                                 nurbs_grid_points(parent.grid))) != NULL &&
        run_in_folder(options, &config, &parent, &evaluator, shape);
    galv_shape_free(shape);
    evaluator_free(&evaluator);
    parent_free(&parent);
    config_free(&config);
    return ok ? CLI_OK : CLI_FAILED;
}

int report_command(const char *folder, bool json)
{
    char *path = folder_join(folder, "run.db");
    bool ok = false;
    switch (path ? store_probe(path) : STORE_UNUSABLE) {
    case STORE_ABSENT:
        cli_fail("%s: no such file; is %s the folder of a run?", path, folder);
        break;
    case STORE_RUN: {
        struct store *store = store_open(path);
        ok = store && outputs_write(store, folder, json);
        store_close(store);
        break;
    }
    case STORE_UNUSABLE:
        break;
    }
    free(path);
    return ok ? CLI_OK : CLI_FAILED;
}
