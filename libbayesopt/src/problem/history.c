/* The points of an optimisation. */
#include "core/error.h"
#include "problem/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void point_clear(struct point *point)
{
    free(point->x);
    free(point->u);
    free(point->constraints);
    free(point->gradient);
    free(point->note);
    attributes_free(&point->attributes);
    *point = (struct point){0};
}

void history_truncate(struct bayesopt *bo, size_t n)
{
    while (bo->n_points > n)
        point_clear(&bo->points[--bo->n_points]);
    bo->surrogates.fitted = false;
}

struct point *history_append(struct bayesopt *bo, uint64_t id, const double *x,
                             bayesopt_phase phase)
{
    if (bo->n_points == bo->room) {
        size_t room = bo->room ? 2 * bo->room : 64;
        struct point *more = realloc(bo->points, room * sizeof *more);
        if (!more)
            return NULL;
        bo->points = more;
        bo->room = room;
    }
    struct point *p = &bo->points[bo->n_points];
    *p = (struct point){.id = id, .phase = phase, .f = NAN, .session = bo->session};
    p->x = malloc(bo->d * sizeof *p->x);
    p->u = malloc(bo->d * sizeof *p->u);
    if (!p->x || !p->u) {
        point_clear(p);
        return NULL;
    }
    memcpy(p->x, x, bo->d * sizeof *x);
    problem_to_unit(bo, x, p->u);
    p->outside = !problem_inside(bo, x);
    p->level = (int)bo->options.n_levels - 1;
    bo->n_points++;
    bo->surrogates.fitted = false;
    return p;
}

/* Ids increase along the history. */
struct point *history_find(struct bayesopt *bo, uint64_t id)
{
    size_t low = 0, high = bo->n_points;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (bo->points[middle].id < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < bo->n_points && bo->points[low].id == id ? &bo->points[low] : NULL;
}

bool history_was_asked(const struct bayesopt *bo, const double *u)
{
    for (size_t i = 0; i < bo->n_points; i++) {
        double most = bo->points[i].state == BAYESOPT_STATE_LOST ? INFINITY : 0;
        for (size_t j = 0; j < bo->d; j++)
            most = fmax(most, fabs(bo->points[i].u[j] - u[j]));
        if (most <= 1e-7)
            return true;
    }
    return false;
}

size_t history_count_state(const struct bayesopt *bo, bayesopt_state state)
{
    size_t count = 0;
    for (size_t i = 0; i < bo->n_points; i++)
        count += bo->points[i].state == state;
    return count;
}

double history_violation(const struct bayesopt *bo, const struct point *point)
{
    double sum = 0;
    for (size_t i = 0; i < bo->options.n_constraints; i++)
        sum += fmax(fmax(point->constraints[i] - bo->constraint_upper[i],
                         bo->constraint_lower[i] - point->constraints[i]),
                    0);
    return sum;
}

bool point_is_dear(const struct bayesopt *bo, const struct point *point)
{
    return point->level + 1 == (int)bo->options.n_levels;
}

bool point_counts(const struct bayesopt *bo, const struct point *point)
{
    return point->state == BAYESOPT_STATE_DONE && point_is_dear(bo, point) && !point->outside;
}

bool point_judged(const struct point *point)
{
    return point->state == BAYESOPT_STATE_DONE || point->state == BAYESOPT_STATE_FAILED;
}

bool point_feasible(const struct bayesopt *bo, const struct point *point)
{
    return point_counts(bo, point) && history_violation(bo, point) <= 0;
}

const struct merit merit_worst = {INFINITY, INFINITY};

struct merit point_merit(const struct bayesopt *bo, const struct point *point)
{
    return (struct merit){history_violation(bo, point), point->f};
}

bool merit_better(struct merit a, struct merit b)
{
    return a.violation < b.violation || (a.violation == b.violation && a.f < b.f);
}

size_t history_best(const struct bayesopt *bo, bool *feasible)
{
    size_t best = SIZE_MAX;
    struct merit most = merit_worst;
    for (size_t i = 0; i < bo->n_points; i++) {
        if (!point_counts(bo, &bo->points[i]))
            continue;
        struct merit merit = point_merit(bo, &bo->points[i]);
        if (merit_better(merit, most)) {
            most = merit;
            best = i;
        }
    }
    *feasible = best != SIZE_MAX && most.violation <= 0;
    return best;
}

bayesopt_status bayesopt_best_told(const bayesopt *bo, double *x, double *f, uint64_t *id)
{
    NEED(bo);
    bool feasible;
    size_t best = history_best(bo, &feasible);
    if (best == SIZE_MAX)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "no evaluation has succeeded yet");
    if (x)
        memcpy(x, bo->points[best].x, bo->d * sizeof *x);
    if (f)
        *f = problem_sign(bo) * bo->points[best].f;
    if (id)
        *id = bo->points[best].id;
    return feasible ? BAYESOPT_OK : BAYESOPT_NONE_FEASIBLE;
}

size_t bayesopt_count(const bayesopt *bo)
{
    return bo ? bo->n_points : 0;
}

bayesopt_status bayesopt_get(const bayesopt *bo, size_t i, bayesopt_point *point)
{
    NEED(bo);
    NEED(point);
    if (i >= bo->n_points)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "row %zu of a history of %zu", i,
                             bo->n_points);
    const struct point *p = &bo->points[i];
    *point = (bayesopt_point){
        .id = p->id,
        .phase = p->phase,
        .state = p->state,
        .level = p->level,
        .x = p->x,
        .f = problem_sign(bo) * p->f,
        .constraints = p->constraints,
        .gradient = p->gradient,
        .variance = p->variance,
        .note = p->note ? p->note : "",
        .feasible = point_feasible(bo, p),
        .outside = p->outside,
        .n_attributes = p->attributes.n,
        .attributes = p->attributes.items,
    };
    return BAYESOPT_OK;
}
