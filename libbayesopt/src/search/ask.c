/* Asking: left-over points first, then new ones, all in one transaction. */
#include "core/error.h"
#include "problem/internal.h"
#include "search/strategy.h"
#include "store/store.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points of this phase already given out. */
static size_t count_phase(const struct bayesopt *bo, bayesopt_phase phase)
{
    size_t count = 0;
    for (size_t i = 0; i < bo->n_points; i++)
        count += bo->points[i].phase == phase;
    return count;
}

/* Proposals in a row, from the end of the history, that did not lower the best feasible value. */
static size_t proposals_without_improvement(const struct bayesopt *bo)
{
    size_t since = 0;
    double best = INFINITY;
    for (size_t i = 0; i < bo->n_points; i++) {
        const struct point *p = &bo->points[i];
        if (!point_judged(p))
            continue;
        since += p->phase != BAYESOPT_PHASE_INITIAL;
        if (point_feasible(bo, p) && p->f < best) {
            best = p->f;
            since = 0;
        }
    }
    return since;
}

static bayesopt_status check_stop(const struct bayesopt *bo)
{
    size_t spent = 0;
    for (size_t i = 0; i < bo->n_points; i++)
        spent += !bo->points[i].outside;
    if (spent >= problem_budget(bo))
        return BAYESOPT_STOP_BUDGET;
    if (bo->options.stop_no_improvement &&
        proposals_without_improvement(bo) >= bo->options.stop_no_improvement)
        return BAYESOPT_STOP_NO_IMPROVEMENT;
    return BAYESOPT_OK;
}

static bayesopt_status new_point(struct bayesopt *bo, struct point **out)
{
    size_t d = bo->d, given = initial_told(bo) + count_phase(bo, BAYESOPT_PHASE_INITIAL);
    uint64_t id = bo->n_points ? bo->points[bo->n_points - 1].id + 1 : 1;
    bayesopt_phase phase = BAYESOPT_PHASE_INITIAL;
    int level = (int)bo->options.n_levels - 1;
    bayesopt_status status = check_stop(bo);
    if (status)
        return status;
    if (bo->constraints_missing)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "this run has %zu input constraints of its program's own; only that "
                             "program can propose points",
                             bo->options.n_input_constraints);
    double *u = malloc(2 * d * sizeof *u);
    if (!u)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    double *x = u + d;
    bool designed = given < problem_initial(bo);
    if (designed)
        status = initial_point(bo, given % bo->options.initial_n, u, x);
    /* In a space of few points the design may have one twice. */
    if (!status && designed && bo->n_discrete == d && history_was_asked(bo, u))
        designed = false;
    if (designed && given < bo->options.initial_n)
        level = 0;
    if (!status && !designed) {
        status = strategy_propose(bo, id, u, &phase, &level);
        problem_from_unit(bo, u, x);
    }
    if (!status) {
        *out = history_append(bo, id, x, phase);
        if (*out)
            (*out)->level = level;
        else
            status = bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    }
    free(u);
    return status;
}

bayesopt_status bayesopt_set_ask_progress(bayesopt *bo, bayesopt_ask_progress progress,
                                          void *user_data)
{
    NEED(bo);
    bo->progress = (struct progress){.callback = progress, .user_data = user_data};
    return BAYESOPT_OK;
}

/* The first pending point that no living session answers for. */
static struct point *left_over(struct bayesopt *bo)
{
    for (size_t i = 0; i < bo->n_points; i++)
        if (bo->points[i].state == BAYESOPT_STATE_PENDING && bo->points[i].session == 0)
            return &bo->points[i];
    return NULL;
}

static bayesopt_status give(struct bayesopt *bo, size_t i, size_t n, double *x, uint64_t *ids,
                            int *levels)
{
    bayesopt_status status;
    struct point *p = left_over(bo);
    if (p) {
        p->session = bo->session;
        status = store_update(bo, p);
        if (!status)
            status = store_touch(bo, p);
    } else {
        status = new_point(bo, &p);
        if (!status)
            status = store_insert(bo, p);
    }
    if (status > 0 && i > 0) {
        /* Some points were found: the rest is marked as not there. */
        for (size_t k = i; k < n; k++)
            ids[k] = 0;
        return status;
    }
    if (status)
        return status;
    memcpy(x + i * bo->d, p->x, bo->d * sizeof *x);
    ids[i] = p->id;
    if (levels)
        levels[i] = p->level;
    return BAYESOPT_OK;
}

/* Left-over points given by an ask that then failed are left over again. */
static void give_back(struct bayesopt *bo, size_t n, const uint64_t *ids)
{
    for (size_t i = 0; i < n; i++) {
        struct point *p = history_find(bo, ids[i]);
        if (p)
            p->session = 0;
    }
}

bayesopt_status bayesopt_ask_levels(bayesopt *bo, size_t n, double *x, uint64_t *ids, int *levels)
{
    NEED(bo);
    NEED(x);
    NEED(ids);
    NEED_MOST(n, BAYESOPT_MOST_POINTS);
    if (!n)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "asked for no points");
    THREADS((int)bo->options.threads);
    bayesopt_status status = store_begin(bo);
    if (status)
        return status;
    size_t before = bo->n_points, given = 0;
    status = store_release_orphans(bo, false, 0);
    double *kept = malloc(surrogates_state_size(&bo->surrogates, bo->d) * sizeof *kept);
    if (!kept && !status)
        status = bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    if (kept)
        surrogates_save(&bo->surrogates, bo->d, kept);
    bo->progress.wanted = n;
    bo->progress.cancelled = false;
    while (!status && given < n) {
        bo->progress.found = given;
        status = ask_is_cancelled(bo) ? ask_cancelled(bo) : give(bo, given, n, x, ids, levels);
        given += !status;
    }
    bo->progress.wanted = 0;
    bayesopt_status stop = status > 0 ? status : BAYESOPT_OK;
    if (status > 0)
        status = BAYESOPT_OK;
    if (!status && given)
        status = store_put_state(bo);
    if (!status)
        status = store_commit(bo);
    if (status) {
        store_rollback(bo);
        history_truncate(bo, before);
        give_back(bo, given, ids);
    }
    /* Fits that led to no point leave no trace. */
    if ((status || !given) && kept)
        surrogates_restore(&bo->surrogates, bo->d, kept);
    free(kept);
    return status ? status : given ? BAYESOPT_OK : stop;
}

bayesopt_status bayesopt_ask(bayesopt *bo, size_t n, double *x, uint64_t *ids)
{
    return bayesopt_ask_levels(bo, n, x, ids, NULL);
}
