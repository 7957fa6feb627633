/* Knot removal for curves and surfaces.
 *
 * The state is a coarse net, the least-squares projection of the target, and the control net of
 * the difference over the fine knots, whose largest norm bounds the distance at equal parameters
 * (convex hull property). For every knot the least-squares solution without it is a rank-one
 * change of both, so the largest difference after its removal costs little; the least harmful knot
 * goes next. This is the ranking of Lyche and Morken (1987) with exact instead of estimated
 * weights, and with both directions of a surface in one competition, because they share one
 * tolerance. Keys grow as the difference grows, so an old key only has to be renewed when it comes
 * up for removal.
 *
 * Least squares leaves the largest difference well above the smallest possible one. Projections by
 * turns onto the coarse splines and onto the nets within the tolerance of the target (von Neumann,
 * Bregman 1965) find a coarse spline within it if there is one; that gains the last knots. */
#include "simplify/thinning.h"

#include "core/error.h"
#include "core/multiversion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rows with a smaller share of the influence are left out when knots are compared, */
static const double negligible_in_ranking = 1e-3;
/* and when one is removed; the final difference is computed afresh. */
static const double negligible_in_update = 1e-12;

static size_t plane_size(const struct thinning *t)
{
    return t->size[0] * t->size[1];
}

static size_t coarse_size(const struct thinning *t, int direction)
{
    return direction < t->directions ? t->along[direction].size : 1;
}

static void set_candidates(struct thinning *t, int direction, int keep_kinks)
{
    const struct reduction *r = &t->along[direction];
    const size_t p = (size_t)r->degree;
    for (size_t k = 0; k < r->size + p + 1; k++)
        t->key[direction][k] = HUGE_VAL;
    for (size_t k = p + 1; k < r->size; k++) {
        size_t copies = 1;
        while (r->knots[k - copies] == r->knots[k])
            copies++;
        if (r->knots[k + 1] != r->knots[k] && !(keep_kinks && copies >= p))
            t->key[direction][k] = 0.0;
    }
}

static void transpose(size_t rows, size_t columns, const double *from, size_t from_stride,
                      double *to, size_t to_stride)
{
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++)
            to[j * to_stride + i] = from[i * from_stride + j];
}

/* Coarse plane from a fine one by least squares in both directions. */
static void project_plane(struct thinning *t, const double *fine, double *coarse)
{
    const size_t n1 = t->size[1], m0 = t->along[0].size;
    if (t->directions == 1) {
        reduction_project(&t->along[0], 1, fine, coarse);
        return;
    }
    reduction_project(&t->along[0], n1, fine, t->half);
    transpose(m0, n1, t->half, n1, t->turned, m0);
    reduction_project(&t->along[1], m0, t->turned, t->half);
    transpose(t->along[1].size, m0, t->half, m0, coarse, n1);
}

static void expand_plane(struct thinning *t, const double *coarse, double *fine)
{
    const size_t n1 = t->size[1], m0 = t->along[0].size, m1 = coarse_size(t, 1);
    if (t->directions == 1) {
        reduction_expand(&t->along[0], 1, coarse, fine);
        return;
    }
    transpose(m0, m1, coarse, n1, t->half, m0);
    reduction_expand(&t->along[1], m0, t->half, t->turned);
    transpose(n1, m0, t->turned, m0, t->half, n1);
    reduction_expand(&t->along[0], n1, t->half, fine);
}

void thinning_difference(struct thinning *t)
{
    const size_t area = plane_size(t);
    for (size_t plane = 0; plane < (size_t)t->planes; plane++) {
        const double *target = t->target + plane * area;
        double *error = t->error + plane * area;
        expand_plane(t, t->coarse + plane * area, error);
        for (size_t i = 0; i < area; i++)
            error[i] = target[i] - error[i];
    }
}

static void fit(struct thinning *t)
{
    const size_t area = plane_size(t);
    for (size_t plane = 0; plane < (size_t)t->planes; plane++)
        project_plane(t, t->target + plane * area, t->coarse + plane * area);
    thinning_difference(t);
}

nurbs_status thinning_create(const struct thinning_request *request, struct thinning *t)
{
    memset(t, 0, sizeof *t);
    t->planes = request->planes;
    t->directions = request->directions;
    t->target = request->target;
    t->tolerance = request->tolerance;
    memcpy(t->wall, request->wall, sizeof t->wall);
    t->version = 1;
    t->size[1] = 1;
    size_t longest = 1;
    nurbs_status status = NURBS_OK;
    int complete = 1;
    for (int d = 0; d < t->directions; d++) {
        t->size[d] = request->fine_size[d];
        longest = t->size[d] > longest ? t->size[d] : longest;
        if (status == NURBS_OK)
            status = reduction_create(request->degree[d], request->fine_size[d], request->fine[d],
                                      request->coarse_size[d], request->coarse[d], &t->along[d]);
        const size_t count = request->coarse_size[d] + (size_t)request->degree[d] + 1;
        t->key[d] = malloc(count * sizeof(double));
        t->stamp[d] = calloc(count, sizeof(unsigned));
        complete = complete && t->key[d] && t->stamp[d];
    }
    const size_t area = plane_size(t), planes = (size_t)t->planes;
    t->coarse =
        malloc((2 * planes * area + planes * longest + longest + 5 * area) * sizeof(double));
    t->removal.x = malloc(2 * longest * sizeof(double));
    if (status == NURBS_OK && (!complete || !t->coarse || !t->removal.x))
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory to simplify %zu x %zu control points",
                            t->size[0], t->size[1]);
    if (status != NURBS_OK) {
        thinning_free(t);
        return status;
    }
    t->removal.influence = t->removal.x + longest;
    t->error = t->coarse + planes * area;
    t->line = t->error + planes * area;
    t->jump = t->line + planes * longest;
    t->half = t->jump + longest;
    t->turned = t->half + area;
    t->change = t->turned + area;
    t->excess = t->change + area; /* two planes */
    for (int d = 0; d < t->directions; d++)
        set_candidates(t, d, request->keep_kinks);
    fit(t);
    return NURBS_OK;
}

void thinning_free(struct thinning *t)
{
    for (int d = 0; d < 2; d++) {
        reduction_free(&t->along[d]);
        free(t->key[d]);
        free(t->stamp[d]);
    }
    free(t->coarse);
    free(t->removal.x);
    memset(t, 0, sizeof *t);
}

/* square[i] = squared norm of the difference at fine control point i. */
NURBS_MULTIVERSION
static void squared_norms(const struct thinning *t, double *square)
{
    const size_t area = plane_size(t);
    memset(square, 0, area * sizeof *square);
    for (size_t plane = 0; plane < (size_t)t->planes; plane++) {
        const double *error = t->error + plane * area;
        for (size_t i = 0; i < area; i++)
            square[i] += error[i] * error[i];
    }
}

double thinning_largest(const struct thinning *t)
{
    double largest = 0.0;
    squared_norms(t, t->excess);
    for (size_t i = 0; i < plane_size(t); i++)
        largest = t->excess[i] > largest ? t->excess[i] : largest;
    return sqrt(largest);
}

/* Fills jump with (g c) / (g x) of one plane, along the other direction's coarse control points. */
static void condition(const struct thinning *t, int direction, size_t plane, double *jump)
{
    const struct removal *removal = &t->removal;
    const size_t step = direction == 0 ? t->size[1] : 1, stride = direction == 0 ? 1 : t->size[1];
    const double *net = t->coarse + plane * plane_size(t) + removal->first * step;
    for (size_t j = 0; j < coarse_size(t, 1 - direction); j++) {
        double sum = 0.0;
        for (size_t k = 0; k < removal->count; k++)
            sum += removal->functional[k] * net[k * step + j * stride];
        jump[j] = sum / removal->gain;
    }
}

/* Largest squared norm of the difference after the removal, over the rows that it changes. */
NURBS_MULTIVERSION
static double largest_after(const struct thinning *t, int direction)
{
    const size_t low = t->removal.low, high = t->removal.high, n1 = t->size[1];
    const size_t row0 = direction == 0 ? low : 0, row1 = direction == 0 ? high : t->size[0];
    const size_t column0 = direction == 0 ? 0 : low, column1 = direction == 0 ? n1 : high;
    const size_t area = plane_size(t), across = t->size[1 - direction];
    const double *influence = t->removal.influence;
    double *square = t->excess, largest = 0.0;
    for (size_t i = row0; i < row1; i++) {
        memset(square, 0, n1 * sizeof *square);
        for (size_t plane = 0; plane < (size_t)t->planes; plane++) {
            const double *error = t->error + plane * area + i * n1;
            const double *y = t->line + plane * across;
            if (direction == 0)
                for (size_t j = column0; j < column1; j++) {
                    const double e = error[j] + influence[i] * y[j];
                    square[j] += e * e;
                }
            else
                for (size_t j = column0; j < column1; j++) {
                    const double e = error[j] + influence[j] * y[i];
                    square[j] += e * e;
                }
        }
        for (size_t j = column0; j < column1; j++)
            largest = square[j] > largest ? square[j] : largest;
    }
    return largest;
}

/* How far control points near the removed knot would lie behind a wall. */
static double wall_violation(struct thinning *t, int direction)
{
    const struct removal *removal = &t->removal;
    const size_t area = plane_size(t), across = coarse_size(t, 1 - direction);
    const size_t step = direction == 0 ? t->size[1] : 1, stride = direction == 0 ? 1 : t->size[1];
    double worst = 0.0;
    for (size_t plane = 0; plane < 3; plane++) {
        const struct wall wall = t->wall[plane];
        if (!wall.side)
            continue;
        double weight[NURBS_MAX_DEGREE + 2], point[NURBS_MAX_DEGREE + 2];
        condition(t, direction, plane, t->jump);
        condition(t, direction, (size_t)t->planes - 1, t->turned);
        for (size_t j = 0; j < across; j++) {
            for (size_t k = 0; k < removal->count; k++) {
                const double *at = t->coarse + (removal->first + k) * step + j * stride;
                const double x = removal->x[removal->first + k];
                point[k] = at[plane * area] - x * t->jump[j];
                weight[k] = t->planes == 4 ? at[3 * area] - x * t->turned[j] : 1.0;
            }
            const size_t gap = reduction_contract(removal, 1, 1, point);
            if (t->planes == 4)
                reduction_contract(removal, 1, 1, weight);
            for (size_t k = 0; k < removal->count; k++)
                if (k != gap)
                    worst = fmax(worst, wall.side * (wall.value * weight[k] - point[k]));
        }
    }
    return worst;
}

/* Prepares the removal of a knot; returns the largest difference after it in the rows that it
 * changes by more than a negligible part, HUGE_VAL when it cannot be removed. */
static double assess(struct thinning *t, int direction, size_t index, double negligible)
{
    reduction_assess(&t->along[direction], index, negligible, &t->removal);
    if (t->removal.gain == 0.0)
        return HUGE_VAL;
    const size_t across = t->size[1 - direction];
    for (size_t plane = 0; plane < (size_t)t->planes; plane++) {
        condition(t, direction, plane, t->jump);
        if (t->directions == 2)
            reduction_expand(&t->along[1 - direction], 1, t->jump, t->line + plane * across);
        else
            t->line[plane] = t->jump[0];
    }
    return fmax(sqrt(largest_after(t, direction)), wall_violation(t, direction));
}

static void forget_key(struct thinning *t, int direction, size_t index)
{
    const struct reduction *r = &t->along[direction];
    const size_t after = r->size + (size_t)r->degree - index;
    double *key = t->key[direction] + index;
    unsigned *stamp = t->stamp[direction] + index;
    if (r->knots[index - 1] == r->knots[index]) { /* the next copy becomes the candidate */
        key[-1] = 0.0;
        stamp[-1] = 0;
    }
    memmove(key, key + 1, after * sizeof *key);
    memmove(stamp, stamp + 1, after * sizeof *stamp);
}

static void contract(const struct removal *removal, size_t size, size_t columns, size_t stride,
                     double *net)
{
    const size_t gap = removal->first +
                       reduction_contract(removal, columns, stride, net + removal->first * stride);
    memmove(net + gap * stride, net + (gap + 1) * stride, (size - gap - 1) * stride * sizeof *net);
}

/* Removes the knot that was assessed last. */
NURBS_MULTIVERSION
static void take_out(struct thinning *t, int direction)
{
    const struct removal *removal = &t->removal;
    struct reduction *r = &t->along[direction];
    const size_t area = plane_size(t), n1 = t->size[1], across = t->size[1 - direction];
    const size_t coarse_across = coarse_size(t, 1 - direction);
    const size_t rows = removal->high - removal->low;
    for (size_t plane = 0; plane < (size_t)t->planes; plane++) {
        double *error = t->error + plane * area, *net = t->coarse + plane * area;
        const double *y = t->line + plane * across, *a = removal->influence + removal->low;
        condition(t, direction, plane, t->jump);
        if (direction == 0) {
            for (size_t i = 0; i < rows; i++)
                for (size_t j = 0; j < n1; j++)
                    error[(removal->low + i) * n1 + j] += a[i] * y[j];
            for (size_t i = 0; i < r->size; i++)
                for (size_t j = 0; j < coarse_across; j++)
                    net[i * n1 + j] -= removal->x[i] * t->jump[j];
            contract(removal, r->size, coarse_across, n1, net);
        } else {
            for (size_t i = 0; i < across; i++)
                for (size_t j = 0; j < rows; j++)
                    error[i * n1 + removal->low + j] += a[j] * y[i];
            for (size_t i = 0; i < coarse_across; i++) {
                for (size_t j = 0; j < r->size; j++)
                    net[i * n1 + j] -= removal->x[j] * t->jump[i];
                contract(removal, r->size, 1, 1, net + i * n1);
            }
        }
    }
    forget_key(t, direction, removal->index);
    reduction_drop(r, removal->index);
    reduction_update(r);
    t->version++;
}

int thinning_remove(struct thinning *t, int direction, size_t index)
{
    if (assess(t, direction, index, 0.0) == HUGE_VAL)
        return 0;
    take_out(t, direction);
    return 1;
}

/* The candidate with the smallest key, below the limit; keys of a direction weigh by the root of
 * its number of control points: a knot across the longer direction is worth more of them. */
static int best_candidate(const struct thinning *t, double limit, size_t *index)
{
    int direction = -1;
    double smallest = HUGE_VAL;
    for (int d = 0; d < t->directions; d++) {
        const double weight = sqrt((double)t->along[d].size);
        for (size_t k = 0; k < t->along[d].size; k++)
            if (t->key[d][k] <= limit && t->key[d][k] * weight < smallest) {
                smallest = t->key[d][k] * weight;
                direction = d;
                *index = k;
            }
    }
    return direction;
}

void thinning_run(struct thinning *t)
{
    size_t k;
    for (int d; (d = best_candidate(t, t->tolerance, &k)) >= 0;) {
        if (t->stamp[d][k] != t->version) {
            t->key[d][k] = assess(t, d, k, negligible_in_ranking);
            t->stamp[d][k] = t->version;
            continue;
        }
        t->key[d][k] = assess(t, d, k, negligible_in_update);
        if (t->key[d][k] <= t->tolerance)
            take_out(t, d);
    }
}

/* Moves coarse control points behind a wall onto it. */
static void respect_walls(struct thinning *t)
{
    const size_t area = plane_size(t), n1 = t->size[1];
    for (size_t plane = 0; plane < 3; plane++) {
        const struct wall wall = t->wall[plane];
        for (size_t i = 0; wall.side && i < t->along[0].size; i++)
            for (size_t j = 0; j < coarse_size(t, 1); j++) {
                double *x = t->coarse + plane * area + i * n1 + j;
                const double limit =
                    wall.value * (t->planes == 4 ? t->coarse[3 * area + i * n1 + j] : 1.0);
                if (wall.side * (*x - limit) < 0.0)
                    *x = limit;
            }
    }
}

/* One projection, over-relaxed by 1.7 (any factor between 0 and 2 converges): the part of the
 * difference beyond the goal goes into the coarse net as far as its splines can take it. */
NURBS_MULTIVERSION
static void balance_step(struct thinning *t, double goal)
{
    const size_t area = plane_size(t), n1 = t->size[1];
    const size_t m0 = t->along[0].size, m1 = coarse_size(t, 1);
    double *share = t->excess, *part = t->excess + area;
    squared_norms(t, share);
    for (size_t i = 0; i < area; i++)
        share[i] = share[i] > goal * goal ? 1.7 * (1.0 - goal / sqrt(share[i])) : 0.0;
    for (size_t plane = 0; plane < (size_t)t->planes; plane++) {
        const double *error = t->error + plane * area;
        double *coarse = t->coarse + plane * area;
        for (size_t i = 0; i < area; i++)
            part[i] = share[i] * error[i];
        project_plane(t, part, t->change);
        for (size_t i = 0; i < m0; i++)
            for (size_t j = 0; j < m1; j++)
                coarse[i * n1 + j] += t->change[i * n1 + j];
    }
    respect_walls(t);
    thinning_difference(t);
}

double thinning_balance(struct thinning *t, double goal, int steps)
{
    respect_walls(t);
    thinning_difference(t);
    double largest = thinning_largest(t), previous = largest;
    for (int s = 0; s < steps && largest > goal; s++) {
        balance_step(t, 0.95 * goal); /* aiming inside ends after finitely many steps */
        previous = largest;
        largest = thinning_largest(t);
        /* The excess shrinks about geometrically: stop when it will not vanish in time. */
        const double rate = (largest - goal) / (previous - goal);
        if (s >= 2 && (largest - goal) * pow(rate, steps - s) > 0.02 * goal)
            break;
    }
    return largest;
}

/* What a trial removal changes. */
struct snapshot {
    double *nets; /* coarse and error */
    double *knots, *key[2];
    unsigned *stamp[2];
    unsigned version;
    int direction;
};

static nurbs_status snapshot_create(const struct thinning *t, struct snapshot *s)
{
    memset(s, 0, sizeof *s);
    size_t longest = 0, count[2] = {0, 0};
    for (int d = 0; d < t->directions; d++) {
        count[d] = t->along[d].size + (size_t)t->along[d].degree + 1;
        longest = count[d] > longest ? count[d] : longest;
    }
    const size_t nets = 2 * (size_t)t->planes * plane_size(t);
    s->nets = malloc((nets + longest + count[0] + count[1]) * sizeof(double));
    s->stamp[0] = malloc((count[0] + count[1]) * sizeof(unsigned));
    if (!s->nets || !s->stamp[0]) {
        free(s->nets);
        free(s->stamp[0]);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to try removals in %zu x %zu points",
                          t->size[0], t->size[1]);
    }
    s->knots = s->nets + nets;
    s->key[0] = s->knots + longest;
    s->key[1] = s->key[0] + count[0];
    s->stamp[1] = s->stamp[0] + count[0];
    return NURBS_OK;
}

static void snapshot_free(struct snapshot *s)
{
    free(s->nets);
    free(s->stamp[0]);
}

static void snapshot_take(const struct thinning *t, int direction, struct snapshot *s)
{
    const struct reduction *r = &t->along[direction];
    const size_t count = r->size + (size_t)r->degree + 1;
    memcpy(s->nets, t->coarse, 2 * (size_t)t->planes * plane_size(t) * sizeof(double));
    memcpy(s->knots, r->knots, count * sizeof(double));
    memcpy(s->key[direction], t->key[direction], count * sizeof(double));
    memcpy(s->stamp[direction], t->stamp[direction], count * sizeof(unsigned));
    s->version = t->version;
    s->direction = direction;
}

static void snapshot_restore(const struct snapshot *s, struct thinning *t)
{
    struct reduction *r = &t->along[s->direction];
    r->size++;
    const size_t count = r->size + (size_t)r->degree + 1;
    memcpy(t->coarse, s->nets, 2 * (size_t)t->planes * plane_size(t) * sizeof(double));
    memcpy(r->knots, s->knots, count * sizeof(double));
    memcpy(t->key[s->direction], s->key[s->direction], count * sizeof(double));
    memcpy(t->stamp[s->direction], s->stamp[s->direction], count * sizeof(unsigned));
    t->version = s->version;
    reduction_update(r);
}

/* Balancing lowers the largest difference by up to about a third in so many steps. */
enum { BALANCE_STEPS = 15 };
static const double squeeze_limit = 1.5;

nurbs_status thinning_squeeze(struct thinning *t, int failures)
{
    struct snapshot before;
    nurbs_status status = snapshot_create(t, &before);
    if (status != NURBS_OK)
        return status;
    if (thinning_balance(t, t->tolerance, 2 * BALANCE_STEPS) > t->tolerance)
        failures = 0;
    size_t k;
    int failed = 0;
    for (int d;
         failed < failures && (d = best_candidate(t, squeeze_limit * t->tolerance, &k)) >= 0;) {
        if (t->stamp[d][k] != t->version) {
            t->key[d][k] = assess(t, d, k, negligible_in_ranking);
            t->stamp[d][k] = t->version;
            continue;
        }
        t->key[d][k] = HUGE_VAL; /* not again, should the trial fail */
        snapshot_take(t, d, &before);
        assess(t, d, k, negligible_in_update);
        take_out(t, d);
        if (thinning_balance(t, t->tolerance, BALANCE_STEPS) <= t->tolerance) {
            failed = 0;
        } else {
            snapshot_restore(&before, t);
            failed++;
        }
    }
    snapshot_free(&before);
    return NURBS_OK;
}
