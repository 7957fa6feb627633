/* Sine products, eqs. 15-17. */
#include "constants.h"
#include "error.h"
#include "shape.h"
#include "sine_kernel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Orders, phases and coordinates (in box lengths) up to this keep every argument resolved. */
#define LARGEST 1e6

typedef struct sine_shape {
    galv_shape head;
    galv_box box;
    galv_combination combination;
    bool moves[3];
    galv_sine_step steps[]; /* with all three axes live */
} sine_shape;

static galv_status check_function(size_t i, const galv_sine *function)
{
    if (function->direction < 0 || function->direction > 2)
        return galv_fail(GALV_ERROR_ARGUMENT, "function %zu: direction %d, expected 0, 1 or 2", i,
                         function->direction);
    for (int j = 0; j < 3; j++) {
        if (!(fabs(function->order[j]) <= LARGEST))
            return galv_fail(GALV_ERROR_ARGUMENT,
                             "function %zu: order %g along %c, expected at most 1e6", i,
                             function->order[j], "xyz"[j]);
        if (!(fabs(function->phase[j]) <= LARGEST))
            return galv_fail(GALV_ERROR_ARGUMENT,
                             "function %zu: phase %g along %c, expected at most 1e6 rad", i,
                             function->phase[j], "xyz"[j]);
    }
    return GALV_OK;
}

static galv_status check_box(const galv_box *box)
{
    for (int j = 0; j < 3; j++)
        if (!isfinite(box->origin[j]) || !isfinite(box->length[j]) || box->length[j] <= 0)
            return galv_fail(GALV_ERROR_ARGUMENT,
                             "box along %c: origin %g, length %g, expected a positive length",
                             "xyz"[j], box -> origin[j], box -> length[j]);
    return GALV_OK;
}

/* Normalised coordinates of `count` <= GALV_TILE points; the rest of the tile is 0. */
static galv_status load_tile(const galv_box *box, size_t first, size_t count, const double *xyz,
                             double *s)
{
    memset(s, 0, 3 * GALV_TILE * sizeof *s);
    for (size_t p = 0; p < count; p++)
        for (size_t j = 0; j < 3; j++) {
            double value = (xyz[3 * p + j] - box->origin[j]) / box->length[j];
            if (!(fabs(value) <= LARGEST))
                return galv_fail(GALV_ERROR_GEOMETRY,
                                 "point %zu: %c = %g is more than 1e6 box lengths away", first + p,
                                 "xyz"[j], xyz[3 * p + j]);
            s[j * GALV_TILE + p] = value;
        }
    return GALV_OK;
}

/* |psi| <= 1, so the parameters bound how far the recursion can go. */
static galv_status check_reach(const sine_shape *shape, const double *x)
{
    double reach = 0,
           least = fmin(shape->box.length[0], fmin(shape->box.length[1], shape->box.length[2]));
    for (size_t i = 0; i < shape->head.n; i++)
        reach += fabs(x[i]);
    if (shape->combination == GALV_COMBINATION_SCALED)
        least = 1;
    if (!(reach <= LARGEST * least))
        return galv_fail(GALV_ERROR_ARGUMENT, "parameters add up to %g, more than 1e6 box lengths",
                         reach);
    return GALV_OK;
}

/* Multiplies a tile of values with the coordinate along the function's direction. */
static void scale_tile(const sine_shape *shape, int direction, const double *s, double *v)
{
    if (shape->combination != GALV_COMBINATION_SCALED)
        return;
    for (size_t p = 0; p < GALV_TILE; p++)
        v[p] *= shape->box.length[direction] * s[(size_t)direction * GALV_TILE + p];
}

static void displace_tile(const sine_shape *shape, const double *x, const double *s, double *d)
{
    double v[GALV_TILE];
    memset(d, 0, 3 * GALV_TILE * sizeof *d);
    if (shape->combination == GALV_COMBINATION_RECURSIVE) {
        for (size_t p = 0; p < GALV_TILE; p++)
            v[p] = 1;
        for (size_t i = 0; i < shape->head.n; i++)
            galv_sine_tile(1, &shape->steps[i], &x[i], v, s, d);
        return;
    }
    for (size_t i = 0; i < shape->head.n; i++) {
        const galv_sine_step *step = &shape->steps[i];
        for (size_t p = 0; p < GALV_TILE; p++)
            v[p] = x[i];
        for (int j = 0; j < 3; j++)
            galv_sine_factor(step->order[j], step->phase[j], s + j * GALV_TILE, v);
        scale_tile(shape, step->direction, s, v);
        for (size_t p = 0; p < GALV_TILE; p++)
            d[(size_t)step->direction * GALV_TILE + p] += v[p];
    }
}

static galv_status sine_displace(const galv_shape *head, size_t npoints, const double *xyz,
                                 const double *x, double *out)
{
    const sine_shape *shape = (const sine_shape *)head;
    double s[3 * GALV_TILE], d[3 * GALV_TILE];
    galv_status status = check_reach(shape, x);
    for (size_t first = 0; first < npoints && !status; first += GALV_TILE) {
        size_t count = npoints - first < GALV_TILE ? npoints - first : GALV_TILE;
        status = load_tile(&shape->box, first, count, xyz + 3 * first, s);
        if (status)
            break;
        displace_tile(shape, x, s, d);
        for (size_t p = 0; p < count; p++)
            for (size_t j = 0; j < 3; j++)
                out[3 * (first + p) + j] = d[j * GALV_TILE + p];
    }
    return status;
}

typedef struct sine_plan {
    galv_plan head;
    const sine_shape *shape;
    size_t tiles;
    double *s;       /* per tile, three tiles of normalised coordinates */
    double *factors; /* per tile and step, one tile of static products */
    galv_sine_step steps[];
} sine_plan;

static galv_status sine_rows(const galv_plan *head, size_t count, const double *x, double *rows,
                             size_t ld, size_t *bad)
{
    const sine_plan *plan = (const sine_plan *)head;
    const sine_shape *shape = plan->shape;
    size_t n = shape->head.n, width = 0;
    for (int j = 0; j < 3; j++)
        width += shape->moves[j];
    for (size_t r = 0; r < count; r++)
        if (check_reach(shape, x + r * n)) {
            *bad = r;
            return GALV_ERROR_ARGUMENT;
        }
    for (size_t tile = 0; tile < plan->tiles; tile++) {
        size_t first = tile * GALV_TILE * width;
        size_t points = (head->stored - first) / width;
        points = points < GALV_TILE ? points : GALV_TILE;
        for (size_t r = 0; r < count; r++) {
            double d[3 * GALV_TILE] = {0}, *row = rows + r * ld + first;
            galv_sine_tile(n, plan->steps, x + r * n, plan->factors + tile * n * GALV_TILE,
                           plan->s + tile * 3 * GALV_TILE, d);
            for (size_t j = 0, c = 0; j < 3; j++) {
                if (!shape->moves[j])
                    continue;
                for (size_t p = 0; p < points; p++)
                    row[p * width + c] = d[j * GALV_TILE + p];
                c++;
            }
        }
    }
    return GALV_OK;
}

static void sine_plan_destroy(galv_plan *head)
{
    sine_plan *plan = (sine_plan *)head;
    free(plan->s);
    free(plan->factors);
    free(plan);
}

/* Splits every function into the sines along axes that earlier functions move, left for evaluation,
 * and those that can be multiplied out now. live[i][j] says which. */
static void plan_steps(const sine_shape *shape, sine_plan *plan)
{
    bool moved[3] = {false, false, false};
    bool recursive = shape->combination == GALV_COMBINATION_RECURSIVE;
    size_t n = shape->head.n;
    for (size_t i = 0; i < n; i++) {
        const galv_sine_step *whole = &shape->steps[i];
        galv_sine_step *step = &plan->steps[i];
        *step = (galv_sine_step){.direction = whole->direction};
        for (size_t tile = 0; tile < plan->tiles; tile++)
            for (size_t p = 0; p < GALV_TILE; p++)
                plan->factors[(tile * n + i) * GALV_TILE + p] = 1;
        for (int j = 0; j < 3; j++) {
            if (recursive && moved[j] && whole->order[j] != 0) {
                step->axis[step->live] = j;
                step->order[step->live] = whole->order[j];
                step->phase[step->live] = whole->phase[j];
                step->per_length[step->live++] = whole->per_length[j];
                continue;
            }
            for (size_t tile = 0; tile < plan->tiles; tile++)
                galv_sine_factor(whole->order[j], whole->phase[j],
                                 plan->s + (tile * 3 + (size_t)j) * GALV_TILE,
                                 plan->factors + (tile * n + i) * GALV_TILE);
        }
        for (size_t tile = 0; tile < plan->tiles; tile++)
            scale_tile(shape, step->direction, plan->s + tile * 3 * GALV_TILE,
                       plan->factors + (tile * n + i) * GALV_TILE);
        moved[step->direction] = true;
    }
}

/* The others have their functions' values, static products all, as basis. */
static galv_status linear_plan(sine_plan *plan, galv_plan **out)
{
    const sine_shape *shape = plan->shape;
    size_t n = shape->head.n, stored = plan->head.stored;
    double *basis = malloc(n * stored * sizeof *basis);
    size_t *index = plan->head.index;
    if (!basis) {
        galv_plan_free(&plan->head);
        return galv_fail(GALV_ERROR_MEMORY, "basis of %zu functions on %zu coordinates", n, stored);
    }
    for (size_t i = 0; i < n; i++)
        for (size_t s = 0; s < stored; s++) {
            size_t point = index[s] / 3, tile = point / GALV_TILE, p = point % GALV_TILE;
            bool own = index[s] % 3 == (size_t)plan->steps[i].direction;
            basis[i * stored + s] = own ? plan->factors[(tile * n + i) * GALV_TILE + p] : 0;
        }
    plan->head.index = NULL;
    galv_plan_free(&plan->head);
    return galv_plan_linear(n, stored, index, basis, out);
}

static galv_status sine_plan_create(const galv_shape *head, size_t npoints, const double *xyz,
                                    galv_plan **out)
{
    const sine_shape *shape = (const sine_shape *)head;
    size_t n = head->n, tiles = (npoints + GALV_TILE - 1) / GALV_TILE, stored = 0;
    sine_plan *plan = calloc(1, sizeof *plan + n * sizeof *plan->steps);
    if (!plan)
        return galv_fail(GALV_ERROR_MEMORY, "plan of %zu functions", n);
    plan->head.rows = sine_rows;
    plan->head.concurrent = true;
    plan->head.destroy = sine_plan_destroy;
    plan->shape = shape;
    plan->tiles = tiles;
    plan->head.index = malloc(3 * npoints * sizeof *plan->head.index);
    plan->s = malloc(tiles * 3 * GALV_TILE * sizeof *plan->s);
    plan->factors = malloc(tiles * n * GALV_TILE * sizeof *plan->factors);
    if (!plan->head.index || !plan->s || !plan->factors) {
        galv_plan_free(&plan->head);
        return galv_fail(GALV_ERROR_MEMORY, "plan of %zu functions on %zu points", n, npoints);
    }
    for (size_t i = 0; i < 3 * npoints; i++)
        if (shape->moves[i % 3])
            plan->head.index[stored++] = i;
    plan->head.stored = stored;
    for (size_t tile = 0; tile < tiles; tile++) {
        size_t first = tile * GALV_TILE, rest = npoints - first;
        galv_status status = load_tile(&shape->box, first, rest < GALV_TILE ? rest : GALV_TILE,
                                       xyz + 3 * first, plan->s + tile * 3 * GALV_TILE);
        if (status) {
            galv_plan_free(&plan->head);
            return status;
        }
    }
    plan_steps(shape, plan);
    if (shape->combination != GALV_COMBINATION_RECURSIVE)
        return linear_plan(plan, out);
    *out = &plan->head;
    return GALV_OK;
}

static void sine_destroy(galv_shape *shape)
{
    free(shape);
}

static const galv_shape_class linear_class = {.name = "sine",
                                              .linear = true,
                                              .concurrent = true,
                                              .displace = sine_displace,
                                              .plan = sine_plan_create,
                                              .destroy = sine_destroy};

static const galv_shape_class recursive_class = {.name = "recursive sine",
                                                 .concurrent = true,
                                                 .displace = sine_displace,
                                                 .plan = sine_plan_create,
                                                 .destroy = sine_destroy};

galv_status galv_shape_sine(size_t n, const galv_sine *functions, const galv_box *box,
                            const double *lower, const double *upper, galv_combination combination,
                            galv_shape **out)
{
    if (!functions || !box || !out)
        return galv_fail(GALV_ERROR_ARGUMENT, "functions and box must be given");
    if (combination != GALV_COMBINATION_LINEAR && combination != GALV_COMBINATION_RECURSIVE &&
        combination != GALV_COMBINATION_SCALED)
        return galv_fail(GALV_ERROR_ARGUMENT,
                         "combination %d is neither linear nor recursive nor scaled",
                         (int)combination);
    galv_status status = check_box(box);
    for (size_t i = 0; i < n && !status; i++)
        status = check_function(i, &functions[i]);
    if (status)
        return status;
    sine_shape *shape = calloc(1, sizeof *shape + n * sizeof *shape->steps);
    if (!shape)
        return galv_fail(GALV_ERROR_MEMORY, "shape of %zu functions", n);
    bool recursive = combination == GALV_COMBINATION_RECURSIVE;
    status = galv_shape_start(&shape->head, recursive ? &recursive_class : &linear_class, n, lower,
                              upper);
    if (status) {
        free(shape);
        return status;
    }
    shape->box = *box;
    shape->combination = combination;
    for (size_t i = 0; i < n; i++) {
        galv_sine_step *step = &shape->steps[i];
        *step = (galv_sine_step){.direction = functions[i].direction, .live = 3, .axis = {0, 1, 2}};
        for (int j = 0; j < 3; j++) {
            step->order[j] = functions[i].order[j];
            step->phase[j] = functions[i].phase[j] / PI;
            step->per_length[j] = 1 / box->length[j];
        }
        shape->moves[step->direction] = true;
    }
    *out = &shape->head;
    return GALV_OK;
}

/* Whether sin(pi (order s + phase)) vanishes at s = 0 and at s = 1, up to the rounding of phase/pi.
 */
static bool vanishes_at_ends(double order, double phase)
{
    double at_start = phase - rint(phase), at_end = order + phase - rint(order + phase);
    return fabs(at_start) < 1e-14 && fabs(at_end) < 1e-14;
}

galv_status galv_shape_fold_bound(const galv_shape *head, double *bound, bool *fixed)
{
    if (!head || !bound || !fixed)
        return galv_fail(GALV_ERROR_ARGUMENT, "shape, bound and fixed must be given");
    bool linear = head->class == &linear_class &&
                  ((const sine_shape *)head)->combination == GALV_COMBINATION_LINEAR;
    if (head->class != &recursive_class && !(linear && head->n == 1))
        return galv_fail(GALV_ERROR_ARGUMENT,
                         "a fold bound exists for recursive sine sets, not for a %s shape of %zu "
                         "functions",
                         head->class->name, head->n);
    const sine_shape *shape = (const sine_shape *)head;
    *fixed = true;
    for (size_t i = 0; i < head->n; i++) {
        const galv_sine_step *step = &shape->steps[i];
        int q = step->direction;
        double slope = fabs(step->order[q]) * PI;
        bound[i] = slope > 0 ? shape->box.length[q] / slope : INFINITY;
        *fixed = *fixed && vanishes_at_ends(step->order[q], step->phase[q]);
    }
    return GALV_OK;
}
