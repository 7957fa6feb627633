/* Results of points: told, failed, told from outside. */
#include "core/error.h"
#include "problem/internal.h"
#include "store/store.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *copy_text(const char *text)
{
    char *copy = malloc(strlen(text) + 1);
    return copy ? strcpy(copy, text) : NULL;
}

static double *copy_numbers(const double *from, size_t n)
{
    double *copy = malloc(n * sizeof *copy);
    return copy ? memcpy(copy, from, n * sizeof *copy) : NULL;
}

static bool all_finite(const double *values, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(values[i]))
            return false;
    return true;
}

static bayesopt_status check_result(const struct bayesopt *bo, const bayesopt_result *r)
{
    if (isfinite(r->f) && bo->options.n_constraints && !r->constraints)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "a value was told without its %zu outcome constraints",
                             bo->options.n_constraints);
    if (!(r->variance >= 0 && isfinite(r->variance)))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "variance %g was told, expected finite and not negative", r->variance);
    return attributes_check(r->n_attributes, r->attributes);
}

/* Writes a result into a pending point. A value that is not finite is a failure with a reason. */
static bayesopt_status record(struct bayesopt *bo, struct point *p, const bayesopt_result *r)
{
    size_t m = bo->options.n_constraints;
    const char *note = r->note;
    char reason[96] = "";
    bool done = isfinite(r->f) && (!m || all_finite(r->constraints, m));
    if (!done && !note) {
        if (isfinite(r->f))
            snprintf(reason, sizeof reason, "an outcome constraint is not finite");
        else
            snprintf(reason, sizeof reason, "the objective is %g", r->f);
        note = reason;
    }
    bool ok = true;
    if (note)
        ok = (p->note = copy_text(note)) != NULL;
    if (ok && done && m)
        ok = (p->constraints = copy_numbers(r->constraints, m)) != NULL;
    if (ok && done && r->gradient && all_finite(r->gradient, bo->d))
        ok = (p->gradient = copy_numbers(r->gradient, bo->d)) != NULL;
    if (!ok || !attributes_copy(&p->attributes, r->n_attributes, r->attributes))
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    p->state = done           ? BAYESOPT_STATE_DONE
               : r->transient ? BAYESOPT_STATE_LOST
                              : BAYESOPT_STATE_FAILED;
    p->f = done ? problem_sign(bo) * r->f : NAN;
    p->variance = done ? r->variance : 0;
    bo->surrogates.fitted = false;
    return BAYESOPT_OK;
}

static void unrecord(struct point *p)
{
    free(p->note);
    free(p->constraints);
    free(p->gradient);
    attributes_free(&p->attributes);
    p->note = NULL;
    p->constraints = p->gradient = NULL;
    p->state = BAYESOPT_STATE_PENDING;
    p->f = NAN;
    p->variance = 0;
}

static bayesopt_status find_point(struct bayesopt *bo, uint64_t id, struct point **p)
{
    *p = history_find(bo, id);
    return *p ? BAYESOPT_OK
              : bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "no point has id %llu, the last is %llu",
                              (unsigned long long)id,
                              bo->n_points ? (unsigned long long)bo->points[bo->n_points - 1].id
                                           : 0);
}

bayesopt_status bayesopt_tell_result(bayesopt *bo, uint64_t id, const bayesopt_result *result)
{
    NEED(bo);
    NEED(result);
    bayesopt_status status = check_result(bo, result);
    if (!status)
        status = store_begin(bo);
    if (status)
        return status;
    struct point *p = NULL;
    status = find_point(bo, id, &p);
    if (!status && p->state != BAYESOPT_STATE_PENDING)
        status = bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "point %llu has already been told",
                               (unsigned long long)id);
    if (!status) {
        status = record(bo, p, result);
        if (!status)
            status = store_update(bo, p);
        if (!status)
            status = store_commit(bo);
        if (status)
            unrecord(p);
    }
    if (status)
        store_rollback(bo);
    return status;
}

bayesopt_status bayesopt_tell(bayesopt *bo, uint64_t id, double f, const double *constraints)
{
    NEED(bo);
    bayesopt_result result = {.f = f, .constraints = constraints};
    return bayesopt_tell_result(bo, id, &result);
}

bayesopt_status bayesopt_tell_failed(bayesopt *bo, uint64_t id, const char *reason)
{
    NEED(bo);
    bayesopt_result result = {.f = NAN, .note = reason ? reason : ""};
    return bayesopt_tell_result(bo, id, &result);
}

bayesopt_status bayesopt_release(bayesopt *bo, uint64_t id)
{
    NEED(bo);
    struct point *p;
    bayesopt_status status = store_begin(bo);
    if (status)
        return status;
    status = find_point(bo, id, &p);
    if (!status && p->state == BAYESOPT_STATE_DONE)
        status = bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                               "point %llu has the value %g; only what is pending or failed can be "
                               "asked again",
                               (unsigned long long)id, problem_sign(bo) * p->f);
    if (!status) {
        /* The file first: should it refuse, the history stays as it is. */
        struct point again = {.id = p->id, .phase = p->phase, .level = p->level, .x = p->x};
        again.state = BAYESOPT_STATE_PENDING;
        status = store_update(bo, &again);
        if (!status)
            status = store_commit(bo);
    }
    if (status) {
        store_rollback(bo);
        return status;
    }
    unrecord(p);
    p->session = 0;
    p->detached = false;
    bo->surrogates.fitted = false;
    return BAYESOPT_OK;
}

bayesopt_status bayesopt_tell_point_result(bayesopt *bo, const double *x,
                                           const bayesopt_result *result, uint64_t *id)
{
    NEED(bo);
    NEED(x);
    NEED(result);
    bayesopt_status status =
        result->outside ? problem_check_values(bo, 1, x) : problem_check_points(bo, 1, x);
    if (!status)
        status = check_result(bo, result);
    if (!status)
        status = store_begin(bo);
    if (status)
        return status;
    size_t before = bo->n_points;
    uint64_t next = before ? bo->points[before - 1].id + 1 : 1;
    struct point *p = history_append(bo, next, x, BAYESOPT_PHASE_EXTERNAL);
    status = p ? record(bo, p, result) : bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    if (!status)
        status = store_insert(bo, p);
    if (!status)
        status = store_commit(bo);
    if (status) {
        store_rollback(bo);
        history_truncate(bo, before);
    } else if (id) {
        *id = next;
    }
    return status;
}

bayesopt_status bayesopt_tell_point(bayesopt *bo, const double *x, double f,
                                    const double *constraints)
{
    NEED(bo);
    NEED(x);
    bayesopt_result result = {.f = f, .constraints = constraints};
    return bayesopt_tell_point_result(bo, x, &result, NULL);
}
