#include "search.h"

#include "cli.h"
#include "outcome.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Known volumes of hulls are linear to a few 1e-5, so the search stays this far inside the band,
 * and grids are allowed to touch the centre plane. */
static const double BAND_MARGIN = 1e-4, TOUCH = 1e-9;

/* Fills one value per limit that the configuration sets; <= 0 is allowed. */
static int known_limits(void *data, size_t d, const double *u, double *value)
{
    const struct search *search = data;
    const struct config *config = search->config;
    struct limits_breadth breadth = limits_breadth(&search->limits, u);
    (void)d;
    *value++ = -breadth.least_y / search->evaluator->parent->length - TOUCH;
    if (!isnan(config->breadth))
        *value++ = config->breadth - breadth.least_share;
    if (!isnan(config->entrance))
        *value++ = entrance_ratio(&search->entrance, search->limits.latent, u) - config->entrance;
    if (isnan(config->displacement))
        return 0;
    double change = limits_volume_ratio(&search->limits, u) - 1;
    double band = fmax(config->displacement - BAND_MARGIN, 0);
    *value++ = change - band;
    *value++ = -change - band;
    return isnan(change);
}

static size_t count_limits(const struct config *config)
{
    return 1u + (isnan(config->breadth) ? 0u : 1u) + (isnan(config->entrance) ? 0u : 1u) +
           (isnan(config->displacement) ? 0u : 2u);
}

bool search_create(const struct config *config, struct evaluator *evaluator, const char *path,
                   const double *volume_gradient, struct search *search)
{
    const struct latent *latent = evaluator->latent;
    *search = (struct search){.config = config, .evaluator = evaluator};
    if (!limits_create(latent, evaluator->parent->grid, volume_gradient, &search->limits) ||
        !entrance_create(evaluator->parent->grid, evaluator->parent_nu_s, &search->entrance)) {
        cli_fail("out of memory");
        search_free(search);
        return false;
    }
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.seed = config->search_seed;
    options.initial_kind = config->design;
    options.initial_n = config->initial;
    options.max_evaluations = 1 + config->initial + config->iterations; /* 1: the parent */
    options.strategy = config->strategy;
    options.n_input_constraints = count_limits(config);
    options.input_constraint = known_limits;
    options.input_user_data = search;
    double bound[OUTCOME_MOST];
    options.n_constraints = outcome_bounds(&evaluator->limits, evaluator->speeds, bound);
    options.constraint_upper = bound;
    if (bayesopt_create(latent->modes, latent->lower, latent->upper, &options, &search->bo) !=
            BAYESOPT_OK ||
        bayesopt_open_store(search->bo, path) != BAYESOPT_OK) {
        cli_fail("%s: %s", path, bayesopt_last_error());
        search_free(search);
        return false;
    }
    return true;
}

void search_free(struct search *search)
{
    bayesopt_free(search->bo);
    limits_free(&search->limits);
    entrance_free(&search->entrance);
    search->bo = NULL;
}

static bool told(const struct search *search, bayesopt_status status)
{
    if (status == BAYESOPT_OK)
        return true;
    cli_fail("%s: %s", search->config->path, bayesopt_last_error());
    return false;
}

/* The parent is u = 0: row 0 of the record, and a point that the search is told. */
static bool evaluate_parent(struct search *search)
{
    size_t modes = search->evaluator->latent->modes;
    struct evaluation e;
    int found = store_find_evaluation(search->store, 0, modes, &e);
    bool ok = found >= 0;
    if (found == 0) {
        ok = evaluation_create(modes, &e);
        if (ok) {
            snprintf(e.phase, sizeof e.phase, "parent");
            evaluate(search->evaluator, &e);
            if (e.failed)
                ok = cli_fail("%s: the parent cannot be evaluated (%s): %s", search->config->hull,
                              e.stage, e.reason) == CLI_OK;
            ok = ok && store_put_evaluation(search->store, modes, &e);
        }
    }
    search->parent = e;
    search->parent.u = NULL;
    double ratio[OUTCOME_MOST];
    if (ok && bayesopt_count(search->bo) == 0) {
        outcome_ratios(&search->evaluator->limits, &e, &e, ratio);
        ok = told(search, bayesopt_tell_point(search->bo, e.u, e.cw, ratio));
    }
    if (found >= 0)
        evaluation_free(&e);
    return ok;
}

static bool tell(struct search *search, const struct evaluation *e)
{
    double ratio[OUTCOME_MOST];
    outcome_ratios(&search->evaluator->limits, e, &search->parent, ratio);
    if (!e->failed)
        return told(search, bayesopt_tell(search->bo, e->id, e->cw, ratio));
    char reason[STAGE_SIZE + REASON_SIZE + 2];
    snprintf(reason, sizeof reason, "%s: %s", e->stage, e->reason);
    return told(search, bayesopt_tell_failed(search->bo, e->id, reason));
}

static void name_phase(const struct search *search, struct evaluation *e)
{
    bayesopt_point point;
    for (size_t i = bayesopt_count(search->bo); i-- > 0;) {
        if (bayesopt_get(search->bo, i, &point) == BAYESOPT_OK && point.id == e->id) {
            snprintf(e->phase, sizeof e->phase, "%s", bayesopt_phase_name(point.phase));
            return;
        }
    }
}

/* Record first, tell second: a session that dies between the two leaves a point that is asked
 * again, whose result is then found in the record and told without evaluating it twice. */
static bool handle(struct search *search, uint64_t id, const double *u, double propose_seconds,
                   struct evaluation *e)
{
    size_t modes = search->evaluator->latent->modes;
    int found = store_find_evaluation(search->store, id, modes, e);
    if (found < 0)
        return false;
    if (found == 0) {
        if (!evaluation_create(modes, e))
            return cli_fail("out of memory") == CLI_OK;
        memcpy(e->u, u, modes * sizeof *u);
        e->id = id;
        e->propose_seconds = propose_seconds;
        name_phase(search, e);
        evaluate(search->evaluator, e);
        if (!store_put_evaluation(search->store, modes, e) ||
            !store_update_session(search->store)) {
            evaluation_free(e);
            return false;
        }
    } else if (memcmp(e->u, u, modes * sizeof *u) != 0) {
        cli_fail("run.db: evaluation %llu is recorded at another point than the search asks for",
                 (unsigned long long)id);
        evaluation_free(e);
        return false;
    }
    if (tell(search, e))
        return true;
    evaluation_free(e);
    return false;
}

static void show(struct cli_progress *progress, const struct search *search, size_t done,
                 size_t failed, double best, double parent)
{
    char detail[120];
    size_t all = bayesopt_budget(search->bo);
    snprintf(detail, sizeof detail, "%zu of %zu, %zu failed, best C_w %.4e (%+.1f %%)", done, all,
             failed, best, 100 * (best / parent - 1));
    cli_progress_update(progress, (double)done / (double)all, detail);
}

static bool loop(struct search *search, double *u)
{
    struct cli_progress progress;
    double parent = search->parent.cw, best = parent;
    size_t done = 0, failed = 0;
    bayesopt_point point;
    for (size_t i = 0; i < bayesopt_count(search->bo); i++) {
        if (bayesopt_get(search->bo, i, &point) != BAYESOPT_OK)
            continue;
        done += point.state != BAYESOPT_STATE_PENDING;
        failed += point.state == BAYESOPT_STATE_FAILED;
        if (point.feasible)
            best = fmin(best, point.f);
    }
    cli_progress_start(&progress, "search");
    bool ok = true;
    while (ok) {
        uint64_t id;
        struct evaluation e;
        show(&progress, search, done, failed, best, parent);
        double start = cli_seconds();
        bayesopt_status status = bayesopt_ask(search->bo, 1, u, &id);
        if (status > 0) {
            ok = store_put_text(search->store, "stop", bayesopt_status_string(status));
            break;
        }
        ok = told(search, status) && handle(search, id, u, cli_seconds() - start, &e);
        if (ok) {
            done++;
            failed += e.failed;
            if (outcome_allowed(&search->evaluator->limits, &e, &search->parent))
                best = fmin(best, e.cw);
            evaluation_free(&e);
        }
    }
    cli_progress_end(&progress);
    return ok;
}

bool search_run(struct search *search)
{
    double *u = malloc(search->evaluator->latent->modes * sizeof *u);
    bool ok = u && evaluate_parent(search) && loop(search, u);
    free(u);
    return ok;
}
