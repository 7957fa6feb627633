/* The optimisation object, made and freed. */
#include "core/error.h"
#include "problem/internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Linear rows first, then conditions, then the caller's values. */
static int region_callback(void *data, size_t d, const double *u, double *value)
{
    struct bayesopt *bo = data;
    problem_from_unit(bo, u, bo->constraint_x);
    for (size_t i = 0; i < bo->options.n_linear; i++) {
        value[i] = -bo->linear_b[i];
        for (size_t j = 0; j < d; j++)
            value[i] += bo->linear_a[i * d + j] * bo->constraint_x[j];
    }
    value += bo->options.n_linear;
    conditions_values(&bo->conditions, bo->constraint_x, value);
    if (!bo->options.n_input_constraints)
        return 0;
    return bo->options.input_constraint(bo->options.input_user_data, d, bo->constraint_x,
                                        value + bo->conditions.rows);
}

/* The group of each variable, checked by the regression that will use it; *copy stays NULL unless
 * scales are tied. */
static bayesopt_status copy_groups(size_t d, const bayesopt_options *o, size_t **copy)
{
    bayesopt_gp_options gp_options;
    bayesopt_gp *gp;
    *copy = NULL;
    if (o->scales != BAYESOPT_SCALES_TIED)
        return BAYESOPT_OK;
    bayesopt_gp_options_init(&gp_options);
    gp_options.scales = o->scales;
    gp_options.group = o->group;
    bayesopt_status status = bayesopt_gp_create(d, &gp_options, &gp);
    if (status)
        return status;
    bayesopt_gp_free(gp);
    *copy = malloc(d * sizeof **copy);
    if (!*copy)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    memcpy(*copy, o->group, d * sizeof **copy);
    return BAYESOPT_OK;
}

static double *copy(const double *from, size_t n, double otherwise)
{
    double *to = malloc((n ? n : 1) * sizeof *to);
    for (size_t i = 0; to && i < n; i++)
        to[i] = from ? from[i] : otherwise;
    return to;
}

/* Bounds of constraints, then those of the other objectives, which have none. */
static double *extend(const double *from, size_t n, double otherwise, size_t total)
{
    double *to = malloc((total ? total : 1) * sizeof *to);
    double none = isinf(otherwise) ? otherwise : INFINITY;
    for (size_t i = 0; to && i < total; i++)
        to[i] = i >= n ? none : from ? from[i] : otherwise;
    return to;
}

/* Kinds and names, and what follows from them. */
static bool describe(struct bayesopt *bo, const bayesopt_options *o)
{
    size_t d = bo->d, categorical = 0;
    bo->named = o->names && o->names[0];
    bo->kind = calloc(d, sizeof *bo->kind);
    bo->names = calloc(d, sizeof *bo->names);
    bo->categorical = calloc(d, sizeof *bo->categorical);
    bool ok = bo->kind && bo->names && bo->categorical;
    for (size_t j = 0; j < d && ok; j++) {
        char number[24];
        snprintf(number, sizeof number, "x%zu", j + 1);
        const char *name = o->names && o->names[j] ? o->names[j] : number;
        bo->kind[j] = o->kind ? o->kind[j] : BAYESOPT_KIND_REAL;
        bo->categorical[j] = bo->kind[j] == BAYESOPT_KIND_CATEGORICAL;
        categorical += bo->categorical[j];
        bo->names[j] = malloc(strlen(name) + 1);
        ok = bo->names[j] != NULL;
        if (ok)
            strcpy(bo->names[j], name);
    }
    for (size_t j = 0; j < d && ok; j++)
        bo->n_discrete += problem_is_discrete(bo, j);
    if (!categorical) {
        free(bo->categorical);
        bo->categorical = NULL;
    }
    return ok;
}

/* The points of the initial design: what the caller says or 10 d, and no more than there are. */
static size_t initial_count(const struct bayesopt *bo, const bayesopt_options *o)
{
    size_t by_rule = 10 * bo->d < 200 ? 10 * bo->d : 200, n = o->initial_n ? o->initial_n : by_rule;
    if (o->n_first > n)
        n = o->n_first;
    return o->initial_x || n < problem_size(bo) ? n : problem_size(bo);
}

bayesopt_status bayesopt_create(size_t d, const double *lower, const double *upper,
                                const bayesopt_options *options, bayesopt **out)
{
    NEED(out);
    bayesopt_options filled;
    if (options)
        filled = *options;
    else
        bayesopt_options_init(&filled);
    if (!filled.n_objectives) /* of callers that know of one only */
        filled.n_objectives = 1;
    options = &filled;
    bayesopt_status status = options_check(d, lower, upper, options);
    size_t *group = NULL;
    if (!status)
        status = copy_groups(d, options, &group);
    if (status)
        return status;
    struct bayesopt *bo = calloc(1, sizeof *bo);
    if (!bo) {
        free(group);
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    }
    const bayesopt_options *o = options;
    bo->d = d;
    bo->options = *o;
    bo->options.group = bo->group = group;
    bo->session = 1;
    bo->lower = copy(lower, d, 0);
    bo->upper = copy(upper, d, 0);
    size_t outcomes = o->n_constraints + o->n_objectives - 1;
    bo->constraint_lower = extend(o->constraint_lower, o->n_constraints, -INFINITY, outcomes);
    bo->constraint_upper = extend(o->constraint_upper, o->n_constraints, 0, outcomes);
    bo->options.n_constraints = outcomes;
    for (size_t k = 1; k < o->n_objectives; k++)
        bo->maximise[k] = o->maximise_others && o->maximise_others[k - 1];
    bo->maximise[0] = o->maximise;
    bo->options.maximise_others = bo->maximise + 1;
    bo->linear_a = copy(o->linear_a, o->n_linear * d, 0);
    bo->linear_b = copy(o->linear_b, o->n_linear, 0);
    bo->initial_x = o->initial_x ? copy(o->initial_x, o->initial_n * d, 0) : NULL;
    bo->constraint_x = malloc(d * sizeof *bo->constraint_x);
    bool ok = bo->lower && bo->upper && bo->constraint_lower && bo->constraint_upper &&
              bo->linear_a && bo->linear_b && bo->constraint_x && (!o->initial_x || bo->initial_x);
    bo->first_x = o->n_first ? copy(o->first_x, o->n_first * d, 0) : NULL;
    ok = ok && (!o->n_first || bo->first_x) && describe(bo, o);
    ok = ok && surrogates_create(&bo->surrogates, d, outcomes);
    status = ok ? conditions_create(bo, o->n_conditions, o->conditions) : BAYESOPT_OK;
    size_t rows = o->n_linear + bo->conditions.rows + o->n_input_constraints;
    if (ok && !status)
        ok = region_create(&bo->region, d, rows, region_callback, bo);
    if (!ok)
        status = bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    if (!status && o->initial_x)
        status = problem_check_points(bo, o->initial_n, o->initial_x);
    if (!status && o->n_first)
        status = problem_check_points(bo, o->n_first, o->first_x);
    if (status) {
        problem_free(bo);
        return status;
    }
    bo->options.initial_n = initial_count(bo, o);
    bo->options.first_x = bo->first_x;
    bo->options.kind = bo->kind;
    bo->options.names = (const char *const *)bo->names;
    bo->options.conditions = (const char *const *)bo->conditions.texts;
    bo->options.constraint_lower = bo->constraint_lower;
    bo->options.constraint_upper = bo->constraint_upper;
    bo->options.linear_a = bo->linear_a;
    bo->options.linear_b = bo->linear_b;
    bo->options.initial_x = bo->initial_x;
    *out = bo;
    return BAYESOPT_OK;
}

void problem_free(struct bayesopt *bo)
{
    if (!bo)
        return;
    history_truncate(bo, 0);
    free(bo->points);
    free(bo->group);
    free(bo->kind);
    free(bo->categorical);
    for (size_t j = 0; bo->names && j < bo->d; j++)
        free(bo->names[j]);
    free(bo->names);
    conditions_free(&bo->conditions);
    surrogates_free(&bo->surrogates);
    region_free(&bo->region);
    double *arrays[] = {bo->lower,    bo->upper,    bo->constraint_lower, bo->constraint_upper,
                        bo->linear_a, bo->linear_b, bo->initial_x,        bo->constraint_x,
                        bo->design,   bo->first_x};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        free(arrays[i]);
    free(bo);
}
