/* The initial design: told points, the caller's first ones, and a design that keeps away from both.
 */
#include "core/error.h"
#include "problem/internal.h"
#include "search/strategy.h"
#include "store/store.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double square_distance(size_t d, const double *a, const double *b)
{
    double sum = 0;
    for (size_t j = 0; j < d; j++)
        sum += (a[j] - b[j]) * (a[j] - b[j]);
    return sum;
}

/* Puts first those rows that cover the box by themselves: each next one is the farthest from all
 * before. With two levels the first of them are evaluated at the dear one too. */
static void cover_first(size_t n, size_t d, double *x)
{
    for (size_t k = 1; k < n; k++) {
        size_t farthest = k;
        double most = -1;
        for (size_t i = k; i < n; i++) {
            double nearest = INFINITY;
            for (size_t c = 0; c < k; c++)
                nearest = fmin(nearest, square_distance(d, x + i * d, x + c * d));
            if (nearest > most) {
                most = nearest;
                farthest = i;
            }
        }
        for (size_t j = 0; j < d && farthest != k; j++) {
            double kept = x[k * d + j];
            x[k * d + j] = x[farthest * d + j];
            x[farthest * d + j] = kept;
        }
    }
}

/* Point k of those that count, and how many there are. */
static size_t find_told(const struct bayesopt *bo, size_t k, const struct point **out)
{
    size_t count = 0;
    for (size_t i = 0; i < bo->n_points && bo->options.told_count; i++) {
        const struct point *p = &bo->points[i];
        if (p->phase != BAYESOPT_PHASE_EXTERNAL)
            break;
        if (p->state != BAYESOPT_STATE_DONE || p->outside)
            continue;
        if (count == bo->options.initial_n)
            break;
        if (count++ == k && out)
            *out = p;
    }
    return count;
}

size_t initial_told(const struct bayesopt *bo)
{
    return find_told(bo, 0, NULL);
}

/* Whole-number variables get values of their own, and where all are whole a row that is there
 * already becomes another point, if chance finds one. */
static void make_discrete(struct bayesopt *bo, size_t n, size_t fixed, double *x)
{
    struct random_stream stream;
    size_t d = bo->d;
    double moved[BAYESOPT_MOST_VARIABLES];
    random_start(&stream, bo->options.seed, STREAM_REPAIR, 1);
    for (size_t i = fixed; i < n && bo->n_discrete; i++) {
        if (bo->region.m) /* what was judged is the nearest point */
            problem_snap(bo, x + i * d);
        else
            problem_spread(bo, x + i * d);
        memcpy(moved, x + i * d, d * sizeof *moved);
        for (int attempt = 0; attempt < 200 && bo->n_discrete == d; attempt++) {
            double nearest = INFINITY;
            for (size_t k = 0; k < i; k++)
                nearest = fmin(nearest, square_distance(d, x + k * d, moved));
            if (nearest > 0 && region_contains(&bo->region, moved)) {
                memcpy(x + i * d, moved, d * sizeof *moved);
                break;
            }
            for (size_t j = 0; j < d; j++)
                moved[j] = random_uniform(&stream);
            problem_spread(bo, moved);
        }
    }
}

/* The whole design; told and first points are its first rows. */
static bayesopt_status fill_design(struct bayesopt *bo, double *design)
{
    size_t n = bo->options.initial_n, d = bo->d, told = initial_told(bo), fixed = told;
    const struct point *p = NULL;
    bayesopt_status status = BAYESOPT_OK;
    for (size_t i = 0; i < told; i++) {
        find_told(bo, i, &p);
        memcpy(design + i * d, p->u, d * sizeof *design);
    }
    for (size_t i = 0; i < bo->options.n_first && fixed < n; i++)
        problem_to_unit(bo, bo->first_x + i * d, design + fixed++ * d);
    if (!fixed && !bo->region.m && problem_size(bo) == n) {
        for (size_t i = 0; i < n; i++)
            problem_point(bo, i, design + i * d);
        return BAYESOPT_OK;
    }
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.seed = bo->options.seed;
    options.n_constraints = bo->region.m;
    options.constraint = bo->region.constraint;
    options.constraint_user_data = bo->region.data;
    options.n_existing = fixed;
    options.existing = design;
    if (fixed < n)
        status =
            bayesopt_design(bo->options.initial_kind, n - fixed, d, &options, design + fixed * d);
    if (!status)
        make_discrete(bo, n, fixed, design);
    if (!status && bo->options.n_levels > 1)
        cover_first(n, d, design);
    return status;
}

static bayesopt_status make_design(struct bayesopt *bo)
{
    size_t n = bo->options.initial_n, d = bo->d;
    bayesopt_status status = BAYESOPT_OK;
    if (bo->design)
        return BAYESOPT_OK;
    double *design = malloc(n * d * sizeof *design);
    if (!design)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    for (size_t i = 0; i < n && bo->initial_x; i++)
        problem_to_unit(bo, bo->initial_x + i * d, design + i * d);
    if (!bo->initial_x)
        status = fill_design(bo, design);
    if (status) {
        free(design);
        return status;
    }
    bo->design = design;
    return store_put_design(bo);
}

bayesopt_status initial_point(struct bayesopt *bo, size_t i, double *u, double *x)
{
    size_t d = bo->d, told = initial_told(bo);
    bayesopt_status status = make_design(bo);
    if (status)
        return status;
    memcpy(u, bo->design + i * d, d * sizeof *u);
    problem_from_unit(bo, u, x);
    /* The caller's own points as they were given, to the last bit. */
    if (bo->initial_x)
        memcpy(x, bo->initial_x + i * d, d * sizeof *x);
    else if (i >= told && i - told < bo->options.n_first)
        memcpy(x, bo->first_x + (i - told) * d, d * sizeof *x);
    return BAYESOPT_OK;
}
