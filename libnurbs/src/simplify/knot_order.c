/* Knots go in batches. A coarse control polygon c without one knot is nearest to c with it in the
 * largest distance |g c| / |g|_1, g the left null vector of the insertion of that knot (duality:
 * the condition g c' = 0 leaves one degree of freedom); this is the weight of Lyche and Morken
 * (1987). A batch takes knots by increasing weight plus present error near them, no two
 * neighbours, then least squares on the original control points tells what it costs. A batch that
 * costs too much is taken back, and those of its knots with an error above the limit near them
 * stay from then on. */
#include "simplify/knot_order.h"

#include "core/combine.h"
#include "core/error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A batch takes keys up to this part of the limit, or up to `growth` times the error reached or the
 * smallest key, whichever is the largest: small errors first, in few batches. */
static const double first_part = 0.1, growth = 1.5;
/* A key is a sum of bounds and an error rarely reaches it: tried up to this many times the limit.
 */
static const double hope = 1.5;
/* Batches in a row that cost too much before the end. */
enum { FAILURES = 4 };

struct candidate {
    double key;
    size_t index; /* among the coarse knots */
};

/* The knots that are left, and the control points over them. */
struct state {
    size_t count;   /* of knots */
    size_t *origin; /* original index of each */
    double *knots;
    double *coarse; /* control points */
    double *error;  /* of each original control point, largest over the lines */
};

struct search {
    const struct knot_order_request *request;
    const struct strip *strip;
    size_t columns; /* planes * lines */
    struct reduction along;
    struct state now, next;
    double *row;
    unsigned char *taken;  /* by knot of `now`: in the batch */
    unsigned char *banned; /* by original knot: it stays */
    struct candidate *candidates;
    double *memory; /* of the states and the row */
    size_t *indices;
};

void respect_walls(const struct wall wall[3], size_t planes, size_t lines, double *row)
{
    for (size_t c = 0; c < 3; c++)
        for (size_t j = 0; wall[c].side && j < lines; j++) {
            double *x = row + c * lines + j;
            const double limit = wall[c].value * (planes == 4 ? row[3 * lines + j] : 1.0);
            if (wall[c].side * (*x - limit) < 0.0)
                *x = limit;
        }
}

static double *place_state(struct state *state, size_t size, size_t count, size_t columns,
                           double *memory, size_t *indices)
{
    state->origin = indices;
    state->knots = memory;
    state->coarse = state->knots + count;
    state->error = state->coarse + size * columns;
    return state->error + size;
}

static nurbs_status search_create(const struct knot_order_request *request, struct search *s)
{
    const struct strip *strip = request->strip;
    const size_t n = strip->size, count = n + (size_t)request->degree + 1;
    memset(s, 0, sizeof *s);
    s->request = request;
    s->strip = strip;
    s->columns = strip->planes * strip->lines;
    nurbs_status status =
        reduction_create(request->degree, n, request->knots, n, request->knots, &s->along);
    if (status != NURBS_OK)
        return status;
    s->memory = malloc((2 * (count + n * s->columns + n) + s->columns) * sizeof(double));
    s->indices = malloc(2 * count * sizeof *s->indices);
    s->candidates = malloc(n * sizeof *s->candidates);
    s->taken = calloc(2 * count, 1);
    if (!s->memory || !s->indices || !s->candidates || !s->taken)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to order %zu knots", count);
    s->banned = s->taken + count;
    double *rest = place_state(&s->now, n, count, s->columns, s->memory, s->indices);
    s->row = place_state(&s->next, n, count, s->columns, rest, s->indices + count);
    s->now.count = count;
    for (size_t k = 0; k < count; k++) {
        s->now.origin[k] = k;
        s->now.knots[k] = request->knots[k];
    }
    return NURBS_OK;
}

static void search_free(struct search *s)
{
    reduction_free(&s->along);
    free(s->memory);
    free(s->indices);
    free(s->candidates);
    free(s->taken);
}

/* Fits the lines on the knots of a state; returns the largest error. */
static double fit(struct search *s, struct state *state)
{
    const struct strip *strip = s->strip;
    double largest = 0.0;
    reduction_set(&s->along, state->count - (size_t)s->along.degree - 1, state->knots);
    reduction_project(&s->along, s->columns, strip->rows, state->coarse);
    for (size_t i = 0; i < s->along.size; i++)
        respect_walls(s->request->wall, strip->planes, strip->lines,
                      state->coarse + i * s->columns);
    for (size_t i = 0; i < strip->size; i++) {
        reduction_expand_row(&s->along, i, s->columns, state->coarse, s->row);
        const double square = largest_square(strip->planes, strip->lines,
                                             strip->target + i * s->columns, s->row, NULL);
        state->error[i] = sqrt(square);
        largest = state->error[i] > largest ? state->error[i] : largest;
    }
    return largest;
}

/* Fits without the knots of the batch: the next state. */
static double try_batch(struct search *s)
{
    s->next.count = 0;
    for (size_t k = 0; k < s->now.count; k++)
        if (!s->taken[k]) {
            s->next.origin[s->next.count] = s->now.origin[k];
            s->next.knots[s->next.count++] = s->now.knots[k];
        }
    return fit(s, &s->next);
}

static void accept_batch(struct search *s)
{
    const struct state old = s->now;
    s->now = s->next;
    s->next = old;
}

/* Largest error of a state between two knots of the present one. */
static double error_between(const struct search *s, const struct state *state, size_t low,
                            size_t high)
{
    /* Control point i belongs to knot i + (p + 1) / 2. */
    const size_t shift = ((size_t)s->along.degree + 1) / 2;
    const size_t last = s->now.origin[high] - shift;
    double largest = 0.0;
    for (size_t i = s->now.origin[low] > shift ? s->now.origin[low] - shift : 0;
         i <= last && i < s->strip->size; i++)
        largest = state->error[i] > largest ? state->error[i] : largest;
    return largest;
}

/* Least change of the coarse control points that lets the knot go, plus the error around it. */
static double key_of(struct search *s, size_t index)
{
    struct removal removal;
    removal_functional(s->along.degree, s->now.knots, index, &removal);
    double norm = 0.0;
    for (size_t k = 0; k < removal.count; k++)
        norm += fabs(removal.functional[k]);
    combine(removal.count, removal.functional, s->now.coarse + removal.first * s->columns,
            (ptrdiff_t)s->columns, s->columns, 0.0, s->row);
    const size_t lines = s->strip->lines;
    double largest = 0.0;
    for (size_t j = 0; j < lines; j++) {
        double square = 0.0;
        for (size_t c = 0; c < s->strip->planes; c++)
            square += s->row[c * lines + j] * s->row[c * lines + j];
        largest = square > largest ? square : largest;
    }
    return sqrt(largest) / norm + error_between(s, &s->now, index - 1, index + 1);
}

static int compare_candidates(const void *a, const void *b)
{
    const struct candidate *x = a, *y = b;
    if (x->key != y->key)
        return x->key < y->key ? -1 : 1;
    return x->index < y->index ? -1 : x->index > y->index;
}

/* Fills the candidates, sorted. */
static size_t rank(struct search *s, double limit)
{
    const double *t = s->now.knots;
    const size_t p = (size_t)s->along.degree;
    size_t found = 0;
    for (size_t k = p + 1; k + p + 1 < s->now.count; k++) {
        size_t copies = 1;
        while (t[k - copies] == t[k])
            copies++;
        if (t[k + 1] == t[k] || (s->request->keep_kinks && copies >= p) ||
            s->banned[s->now.origin[k]])
            continue;
        const double key = key_of(s, k);
        if (key <= limit)
            s->candidates[found++] = (struct candidate){key, k};
    }
    qsort(s->candidates, found, sizeof *s->candidates, compare_candidates);
    return found;
}

/* Marks up to `most` candidates with keys up to the ceiling, no two of them neighbours, and writes
 * their original indices to `knot`. */
static size_t choose(struct search *s, size_t found, size_t most, double ceiling, size_t *knot)
{
    size_t chosen = 0;
    memset(s->taken, 0, s->now.count);
    for (size_t k = 0; k < found && chosen < most && s->candidates[k].key <= ceiling; k++) {
        const size_t index = s->candidates[k].index;
        if (s->taken[index - 1] || s->taken[index + 1])
            continue;
        s->taken[index] = 1;
        knot[chosen++] = s->now.origin[index];
    }
    return chosen;
}

/* Knots of the batch with an error above the limit near them stay from now on; returns their
 * number. */
static size_t ban_culprits(struct search *s, double limit)
{
    size_t banned = 0;
    for (size_t k = 2; k + 2 < s->now.count; k++)
        if (s->taken[k] && error_between(s, &s->next, k - 2, k + 2) > limit) {
            s->banned[s->now.origin[k]] = 1;
            banned++;
        }
    return banned;
}

/* Takes out the knots that go first; returns the error without them. */
static double begin(struct search *s, struct knot_order *order)
{
    const struct knot_order_request *request = s->request;
    memset(s->taken, 0, s->now.count);
    for (size_t k = 0; k < request->begin_count; k++) {
        order->knot[k] = request->begin->knot[k];
        s->taken[order->knot[k]] = 1;
    }
    order->count = request->begin_count;
    const double error = try_batch(s);
    accept_batch(s);
    for (size_t k = 0; k <= order->count; k++)
        order->error[k] = error;
    return error;
}

static void order_knots(struct search *s, struct knot_order *order)
{
    const double limit = s->request->limit;
    double reached = begin(s, order);
    size_t most = s->strip->size;
    for (int failures = 0; most > 0 && failures < FAILURES;) {
        const size_t found = rank(s, hope * limit);
        if (found == 0)
            break;
        const double ceiling =
            fmax(first_part * limit, growth * fmax(reached, s->candidates[0].key));
        const size_t chosen = choose(s, found, most, ceiling, order->knot + order->count);
        const double error = try_batch(s);
        if (error > limit) {
            if (ban_culprits(s, limit) == 0)
                most = chosen / 2;
            failures++;
            continue;
        }
        accept_batch(s);
        failures = 0;
        const double begun = reached;
        reached = fmax(error, reached);
        for (size_t k = 1; k <= chosen; k++)
            order->error[order->count + k] = begun + (reached - begun) * (double)k / (double)chosen;
        order->count += chosen;
    }
}

nurbs_status knot_order_create(const struct knot_order_request *request, struct knot_order *order)
{
    struct search s;
    const size_t size = request->strip->size;
    memset(order, 0, sizeof *order);
    nurbs_status status = search_create(request, &s);
    order->knot = malloc(size * sizeof *order->knot);
    order->error = malloc((size + 1) * sizeof *order->error);
    if (status == NURBS_OK && (!order->knot || !order->error))
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory to order %zu knots", size);
    if (status == NURBS_OK)
        order_knots(&s, order);
    search_free(&s);
    if (status != NURBS_OK)
        knot_order_free(order);
    return status;
}

void knot_order_free(struct knot_order *order)
{
    free(order->knot);
    free(order->error);
    memset(order, 0, sizeof *order);
}
