/* First each direction gets an order by itself. Errors of the two mostly lie at different places
 * and then combine like independent ones; the pair of numbers with the smallest net on that
 * assumption is fitted and its true error measured. Next each direction in turn is ordered anew
 * with the other one reduced, so that its errors are those of the tensor fit on a sample of the
 * lines. Where a fit misses the tolerance, knots come back next to the places that miss it. */
#include "simplify/tensor_thin.h"

#include "core/combine.h"
#include "core/constants.h"
#include "core/error.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Lines that stand for all of them in the order, and trials of the tensor fit. */
enum { LINES = 12, TRIALS = 8, ROUNDS = 8 };
/* Up to this part of the tolerance a direction's own order serves for both. */
static const double small_error = 0.15;

/* The smallest net found within the tolerance. */
struct choice {
    size_t net;
    unsigned char *gone; /* of both directions */
};

static size_t planes(const struct tensor_thin *t)
{
    return (size_t)t->subject->planes;
}

/* to[j][plane][i] = from[i][plane][j]. */
static void turn(size_t count, size_t n, size_t m, const double *from, double *to)
{
    enum { TILE = 8 };
    for (size_t plane = 0; plane < count; plane++)
        for (size_t i0 = 0; i0 < n; i0 += TILE)
            for (size_t j0 = 0; j0 < m; j0 += TILE)
                for (size_t j = j0; j < j0 + TILE && j < m; j++)
                    for (size_t i = i0; i < i0 + TILE && i < n; i++)
                        to[(j * count + plane) * n + i] = from[(i * count + plane) * m + j];
}

/* Lines that stand for the others, denser towards the edges, where shapes are steepest; returns
 * their number. */
static size_t choose_lines(size_t across, size_t line[LINES])
{
    size_t count = 0;
    for (int k = 0; k < LINES; k++) {
        const double part = 0.5 - 0.5 * cos(PI * k / (LINES - 1));
        const size_t at = (size_t)(part * (double)(across - 1) + 0.5);
        if (count == 0 || at > line[count - 1])
            line[count++] = at;
    }
    return count;
}

/* Lines of the net along a direction: the target. What is fitted is the same or, with the
 * other direction reduced, the lines of the fit in that direction alone, so that the errors of a
 * strip are those of the tensor fit. */
static nurbs_status sample(struct tensor_thin *t, int direction, int reduced, struct strip *strip)
{
    const struct subject *s = t->subject;
    const size_t across = s->size[1 - direction], n = s->size[direction];
    const size_t columns = planes(t) * n;
    const double *net = direction == 0 ? t->turned_rows : t->rows;
    size_t lines[LINES];
    *strip = (struct strip){n, planes(t), choose_lines(across, lines), NULL, NULL};
    strip->rows = malloc((1 + (size_t)reduced) * columns * strip->lines * sizeof(double));
    if (!strip->rows)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu lines of a net", strip->lines);
    strip->target = strip->rows + (reduced ? columns * strip->lines : 0);
    if (reduced)
        reduction_project(&t->along[1 - direction], columns, net, t->half);
    for (size_t k = 0; k < strip->lines; k++) {
        const double *from = net + lines[k] * columns;
        for (size_t plane = 0; plane < planes(t); plane++)
            for (size_t i = 0; i < n; i++)
                strip->target[(i * planes(t) + plane) * strip->lines + k] = from[plane * n + i];
        if (!reduced)
            continue;
        reduction_expand_row(&t->along[1 - direction], lines[k], columns, t->half, t->row);
        for (size_t plane = 0; plane < planes(t); plane++)
            for (size_t i = 0; i < n; i++)
                strip->rows[(i * planes(t) + plane) * strip->lines + k] = t->row[plane * n + i];
    }
    return NURBS_OK;
}

static nurbs_status reserve(struct tensor_thin *t)
{
    const struct subject *s = t->subject;
    const size_t n = s->size[0], m = s->size[1], longest = n > m ? n : m;
    const size_t count[2] = {n + (size_t)s->degree[0] + 1, m + (size_t)s->degree[1] + 1};
    t->rows =
        malloc((planes(t) * (5 * n * m + longest) + count[0] + count[1] + n + m) * sizeof(double));
    t->gone[0] = calloc(count[0] + count[1], 1);
    if (!t->rows || !t->gone[0])
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to simplify %zu x %zu control points", n,
                          m);
    t->fit = t->rows + planes(t) * n * m;
    t->half = t->fit + planes(t) * n * m;
    t->turned = t->half + planes(t) * n * m;
    t->row = t->turned + planes(t) * n * m;
    t->turned_rows = t->row + planes(t) * longest;
    t->knots = t->turned_rows + planes(t) * n * m;
    t->worst[0] = t->knots + count[0] + count[1];
    t->worst[1] = t->worst[0] + n;
    t->gone[1] = t->gone[0] + count[0];
    for (size_t i = 0; i < n; i++)
        for (size_t plane = 0; plane < planes(t); plane++)
            memcpy(t->rows + (i * planes(t) + plane) * m, s->net + (plane * n + i) * m,
                   m * sizeof *t->rows);
    turn(planes(t), n, m, t->rows, t->turned_rows);
    return NURBS_OK;
}

/* The order of a direction: by itself, or (reduced) with the other direction as it is now, from the
 * point of the present order on where the error is small. */
static nurbs_status order_direction(struct tensor_thin *t, int d, int reduced,
                                    struct knot_order *order)
{
    const struct subject *s = t->subject;
    struct strip strip;
    nurbs_status status = sample(t, d, reduced, &strip);
    if (status != NURBS_OK)
        return status;
    struct knot_order_request request = {.degree = s->degree[d],
                                         .knots = s->knots[d],
                                         .strip = &strip,
                                         .limit = t->tolerance,
                                         .keep_kinks = t->keep_kinks,
                                         .wall = t->wall};
    while (reduced && request.begin_count < t->order[d].count &&
           t->order[d].error[request.begin_count + 1] <= small_error * t->tolerance)
        request.begin_count++;
    request.begin = &t->order[d];
    status = knot_order_create(&request, order);
    free(strip.rows);
    return status;
}

nurbs_status tensor_thin_create(const struct subject *s, double tolerance, int keep_kinks,
                                const struct wall wall[3], struct tensor_thin *t)
{
    memset(t, 0, sizeof *t);
    t->subject = s;
    t->tolerance = tolerance;
    t->keep_kinks = keep_kinks;
    memcpy(t->wall, wall, sizeof t->wall);
    nurbs_status status = reserve(t);
    for (int d = 0; d < 2 && status == NURBS_OK; d++) {
        status = reduction_create(s->degree[d], s->size[d], s->knots[d], s->size[d], s->knots[d],
                                  &t->along[d]);
        if (status == NURBS_OK)
            status = order_direction(t, d, 0, &t->order[d]);
    }
    if (status != NURBS_OK)
        tensor_thin_free(t);
    return status;
}

void tensor_thin_free(struct tensor_thin *t)
{
    for (int d = 0; d < 2; d++) {
        knot_order_free(&t->order[d]);
        reduction_free(&t->along[d]);
    }
    free(t->rows);
    free(t->gone[0]);
    memset(t, 0, sizeof *t);
}

static size_t knot_count(const struct tensor_thin *t, int d)
{
    return t->subject->size[d] + (size_t)t->subject->degree[d] + 1;
}

/* Marks the first knots of an order as gone, and no others. */
static void set_gone(struct tensor_thin *t, int d, const struct knot_order *order, size_t removed)
{
    memset(t->gone[d], 0, knot_count(t, d));
    for (size_t k = 0; k < removed; k++)
        t->gone[d][order->knot[k]] = 1;
}

static void set_knots(struct tensor_thin *t, int d)
{
    size_t left = 0;
    for (size_t k = 0; k < knot_count(t, d); k++)
        if (!t->gone[d][k])
            t->knots[left++] = t->subject->knots[d][k];
    reduction_set(&t->along[d], left - (size_t)t->subject->degree[d] - 1, t->knots);
}

/* Expands the fit in v, turned back into `half`[m0][planes][n1]. */
static void expand_half(struct tensor_thin *t)
{
    const size_t columns = planes(t) * t->along[0].size;
    reduction_expand(&t->along[1], columns, t->fit, t->turned);
    turn(planes(t), t->subject->size[1], t->along[0].size, t->turned, t->half);
}

/* Largest distance of the expanded fit from the net. */
static double largest_difference(struct tensor_thin *t)
{
    const size_t n = t->subject->size[0], m = t->subject->size[1], columns = planes(t) * m;
    double largest = 0.0;
    expand_half(t);
    memset(t->worst[1], 0, m * sizeof(double));
    for (size_t i = 0; i < n; i++) {
        reduction_expand_row(&t->along[0], i, columns, t->half, t->row);
        t->worst[0][i] = largest_square(planes(t), m, t->rows + i * columns, t->row, t->worst[1]);
        largest = fmax(largest, t->worst[0][i]);
    }
    return sqrt(largest);
}

/* Least squares in both directions without the knots that are gone; returns the largest error. */
static double fit(struct tensor_thin *t)
{
    const size_t columns = planes(t) * t->subject->size[1];
    set_knots(t, 0);
    set_knots(t, 1);
    const size_t m0 = t->along[0].size;
    reduction_project(&t->along[0], columns, t->rows, t->half);
    turn(planes(t), m0, t->subject->size[1], t->half, t->turned);
    reduction_project(&t->along[1], planes(t) * m0, t->turned, t->fit);
    for (size_t j = 0; j < t->along[1].size; j++)
        respect_walls(t->wall, planes(t), m0, t->fit + j * planes(t) * m0);
    return largest_difference(t);
}

/* The pair with the smallest net whose expected errors combine to at most the budget. */
static void smallest_net(const struct tensor_thin *t, double budget, size_t removed[2])
{
    const struct knot_order *u = &t->order[0], *v = &t->order[1];
    size_t best = SIZE_MAX, j = v->count;
    removed[0] = removed[1] = 0;
    for (size_t i = 0; i <= u->count && u->error[i] <= budget; i++) {
        while (j > 0 && hypot(u->error[i], v->error[j]) > budget)
            j--;
        const size_t net = (t->subject->size[0] - i) * (t->subject->size[1] - j);
        if (net < best) {
            best = net;
            removed[0] = i;
            removed[1] = j;
        }
    }
}

/* Brings back a knot next to each run of rows (direction 0) or columns with too large an error;
 * returns their number. */
static size_t mend(struct tensor_thin *t, int d)
{
    const size_t n = t->subject->size[d], count = knot_count(t, d);
    const size_t shift = ((size_t)t->subject->degree[d] + 1) / 2;
    const double limit = t->tolerance * t->tolerance;
    size_t back = 0;
    for (size_t i = 0; i < n; i++) {
        if (t->worst[d][i] <= limit)
            continue;
        size_t worst = i;
        for (; i + 1 < n && t->worst[d][i + 1] > limit; i++)
            worst = t->worst[d][i + 1] > t->worst[d][worst] ? i + 1 : worst;
        const size_t knot = worst + shift;
        for (size_t away = 0; away < count; away++) {
            const size_t left = knot >= away ? knot - away : 0;
            const size_t right = knot + away < count ? knot + away : count - 1;
            if (t->gone[d][left] || t->gone[d][right]) {
                t->gone[d][t->gone[d][left] ? left : right] = 0;
                back++;
                break;
            }
        }
    }
    return back;
}

/* What is left when the knots that are gone are gone. */
static size_t net_size(const struct tensor_thin *t)
{
    return t->along[0].size * t->along[1].size;
}

static void keep(const struct tensor_thin *t, struct choice *best)
{
    best->net = net_size(t);
    memcpy(best->gone, t->gone[0], knot_count(t, 0) + knot_count(t, 1));
}

/* Fits and mends along a direction until the tolerance holds or the net is no smaller than the
 * best. */
static void try_choice(struct tensor_thin *t, int d, struct choice *best)
{
    for (int round = 0; round < ROUNDS; round++) {
        const double error = fit(t);
        if (net_size(t) >= best->net)
            return;
        if (error <= t->tolerance) {
            keep(t, best);
            return;
        }
        if (mend(t, d) == 0)
            return;
    }
}

/* Lowers the budget until a pair holds the tolerance. */
static void share(struct tensor_thin *t, struct choice *best)
{
    double budget = t->tolerance;
    for (int trial = 0; trial < TRIALS; trial++) {
        size_t pair[2];
        smallest_net(t, budget, pair);
        for (int d = 0; d < 2; d++)
            set_gone(t, d, &t->order[d], pair[d]);
        const double error = fit(t);
        if (error <= t->tolerance) {
            keep(t, best);
            return;
        }
        if (error < 1.2 * t->tolerance) {
            try_choice(t, t->along[1].size > t->along[0].size, best);
            if (best->net < SIZE_MAX)
                return;
        }
        budget *= fmin(fmax(0.9 * t->tolerance / error, 0.3), 0.9);
    }
}

/* A direction anew with the other one as it is. */
static nurbs_status reorder(struct tensor_thin *t, int d, struct choice *best)
{
    struct knot_order order;
    memcpy(t->gone[0], best->gone, knot_count(t, 0) + knot_count(t, 1));
    set_knots(t, 0);
    set_knots(t, 1);
    nurbs_status status = order_direction(t, d, 1, &order);
    if (status != NURBS_OK)
        return status;
    set_gone(t, d, &order, order.count);
    try_choice(t, d, best);
    knot_order_free(&order);
    return NURBS_OK;
}

nurbs_status tensor_thin_run(struct tensor_thin *t)
{
    struct choice best = {SIZE_MAX, calloc(knot_count(t, 0) + knot_count(t, 1), 1)};
    if (!best.gone)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the flags of %zu knots",
                          knot_count(t, 0) + knot_count(t, 1));
    share(t, &best);
    const int longer = t->along[1].size > t->along[0].size;
    nurbs_status status = reorder(t, longer, &best);
    if (status == NURBS_OK)
        status = reorder(t, 1 - longer, &best);
    memcpy(t->gone[0], best.gone, knot_count(t, 0) + knot_count(t, 1));
    fit(t);
    free(best.gone);
    return status;
}

struct coarse_net tensor_thin_net(const struct tensor_thin *t)
{
    const size_t m0 = t->along[0].size, m1 = t->along[1].size;
    return (struct coarse_net){{m0, m1}, m0, {1, planes(t) * m0}, t->fit};
}

/* With weights the fourth plane counts by itself (subject.h). */
static double weighted_difference(struct tensor_thin *t, double ratio)
{
    const size_t n = t->subject->size[0], m = t->subject->size[1], columns = planes(t) * m;
    double largest = 0.0;
    expand_half(t);
    for (size_t i = 0; i < n; i++) {
        const double *target = t->rows + i * columns;
        reduction_expand_row(&t->along[0], i, columns, t->half, t->row);
        for (size_t j = 0; j < m; j++) {
            double square = 0.0;
            for (size_t c = 0; c < 3; c++) {
                const double d = target[c * m + j] - t->row[c * m + j];
                square += d * d;
            }
            const double w = fabs(target[3 * m + j] - t->row[3 * m + j]);
            largest = fmax(largest, sqrt(square) + ratio * w);
        }
    }
    return largest;
}

double tensor_thin_certify(struct tensor_thin *t, const double *points, const double *weights)
{
    const struct coarse_net net = tensor_thin_net(t);
    const double radius = subject_write(t->subject, points, weights, &net);
    return t->subject->rounding + (t->subject->weights
                                       ? weighted_difference(t, radius / t->subject->radius)
                                       : largest_difference(t));
}
