#include "problem/condition.h"

#include "core/error.h"
#include "problem/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How far an equality may be missed, of what its two sides differ by over the box; points at which
 * that is measured. */
static const double equality_share = 1e-6;
enum { SAMPLES = 64 };

void conditions_free(struct conditions *c)
{
    for (size_t i = 0; i < c->n; i++) {
        bayesopt_expression_free(c->expressions[i]);
        free(c->texts[i]);
    }
    free(c->expressions);
    free(c->texts);
    free(c->tolerance);
    *c = (struct conditions){0};
}

/* Largest absolute value over points of the box. */
static double largest_value(const struct bayesopt *bo, const bayesopt_expression *e)
{
    struct random_stream stream;
    double u[BAYESOPT_MOST_VARIABLES], x[BAYESOPT_MOST_VARIABLES], most = 0;
    random_start(&stream, 1, STREAM_DESIGN, 0);
    for (size_t i = 0; i < SAMPLES; i++) {
        for (size_t j = 0; j < bo->d; j++)
            u[j] = random_uniform(&stream);
        problem_from_unit(bo, u, x);
        double value = fabs(bayesopt_expression_value(e, x));
        most = isfinite(value) ? fmax(most, value) : most;
    }
    return most;
}

static bayesopt_status add(struct bayesopt *bo, const char *text)
{
    struct conditions *c = &bo->conditions;
    bayesopt_expression *e;
    NEED(text);
    bayesopt_status status =
        bayesopt_expression_create(text, bo->d, (const char *const *)bo->names, &e);
    if (status == BAYESOPT_ERROR_ARGUMENT) {
        char reason[200];
        strncpy(reason, bayesopt_last_error(), sizeof reason - 1);
        reason[sizeof reason - 1] = '\0';
        return bayesopt_fail(status, "condition '%s': %s", text, reason);
    }
    if (status)
        return status;
    c->expressions[c->n] = e;
    c->texts[c->n] = malloc(strlen(text) + 1);
    if (c->texts[c->n])
        strcpy(c->texts[c->n], text);
    c->tolerance[c->n] = equality_share * largest_value(bo, e);
    if (!c->texts[c->n++])
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    bayesopt_relation relation = bayesopt_expression_relation(e);
    if (relation == BAYESOPT_RELATION_NONE)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "condition '%s': expected a comparison, <=, >= or ==", text);
    c->rows += relation == BAYESOPT_RELATION_EQUAL ? 2 : 1;
    for (size_t j = 0; j < bo->d; j++)
        if (bo->kind[j] == BAYESOPT_KIND_CATEGORICAL && bayesopt_expression_uses(e, j))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "condition '%s': '%s' is categorical, which is no number", text,
                                 bo->names[j]);
    return BAYESOPT_OK;
}

bayesopt_status conditions_create(struct bayesopt *bo, size_t n, const char *const *texts)
{
    struct conditions *c = &bo->conditions;
    bayesopt_status status = BAYESOPT_OK;
    c->expressions = calloc(n + 1, sizeof *c->expressions);
    c->texts = calloc(n + 1, sizeof *c->texts);
    c->tolerance = calloc(n + 1, sizeof *c->tolerance);
    if (!c->expressions || !c->texts || !c->tolerance)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    for (size_t i = 0; i < n && !status; i++)
        status = add(bo, texts[i]);
    return status;
}

void conditions_values(const struct conditions *c, const double *x, double *value)
{
    for (size_t i = 0; i < c->n; i++) {
        double v = bayesopt_expression_value(c->expressions[i], x);
        if (bayesopt_expression_relation(c->expressions[i]) == BAYESOPT_RELATION_EQUAL) {
            *value++ = v - c->tolerance[i];
            *value++ = -v - c->tolerance[i];
        } else {
            *value++ = v;
        }
    }
}
