#include "core/front.h"

#include "core/error.h"

#include <bayesopt/acquisition.h>

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

bool front_dominated(size_t m, size_t n, const double *points, size_t i)
{
    for (size_t k = 0; k < n; k++) {
        bool not_worse = k != i, better = k < i;
        for (size_t c = 0; c < m; c++) {
            double theirs = points[k * m + c], ours = points[i * m + c];
            not_worse = not_worse && theirs <= ours;
            better = better || theirs < ours;
        }
        if (not_worse && better)
            return true;
    }
    return false;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Rows that matter, moved to the beginning; their number. */
static size_t keep_front(size_t m, size_t n, double *points, const double *reference)
{
    size_t kept = 0;
    for (size_t i = 0; i < n; i++) {
        bool below = true;
        for (size_t c = 0; c < m; c++)
            below = below && points[i * m + c] < reference[c];
        if (below)
            memmove(points + kept++ * m, points + i * m, m * sizeof *points);
    }
    n = kept;
    bool *dominated = calloc(n + 1, sizeof *dominated);
    if (!dominated)
        return SIZE_MAX;
    for (size_t i = 0; i < n; i++)
        dominated[i] = front_dominated(m, n, points, i);
    kept = 0;
    for (size_t i = 0; i < n; i++)
        if (!dominated[i])
            memmove(points + kept++ * m, points + i * m, m * sizeof *points);
    free(dominated);
    return kept;
}

static size_t index_of(const struct front *f, size_t c, double value)
{
    size_t low = 0, high = f->n_values[c] - 1;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (f->values[c][middle] < value)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static bool list_values(struct front *f, size_t n, const double *points, const double *reference)
{
    size_t total = 0;
    for (size_t c = 0; c < f->m; c++) {
        double *values = f->values[c] = malloc((n + 2) * sizeof *values);
        size_t count = 1;
        if (!values)
            return false;
        for (size_t i = 0; i < n; i++)
            values[1 + i] = points[i * f->m + c];
        qsort(values + 1, n, sizeof *values, compare);
        values[0] = -INFINITY;
        for (size_t i = 1; i <= n; i++)
            if (values[i] > values[count - 1])
                values[count++] = values[i];
        values[count++] = reference[c];
        f->n_values[c] = count;
        total += count;
    }
    f->scratch = malloc((3 * total + 1) * sizeof *f->scratch);
    return f->scratch != NULL;
}

static bool add_box(struct front *f, size_t *room, const unsigned box[FRONT_MOST_OBJECTIVES][2])
{
    if (f->n_boxes == *room) {
        size_t more = *room ? 2 * *room : 64;
        void *boxes = realloc(f->boxes, more * sizeof *f->boxes);
        if (!boxes)
            return false;
        f->boxes = boxes;
        *room = more;
    }
    memcpy(f->boxes[f->n_boxes++], box, sizeof *f->boxes);
    return true;
}

/* The strips of the first two objectives that n points (a plane's front, by increasing first value)
 * leave free, within slab `from` to `to` of the third. */
static bool add_strips(struct front *f, size_t *room, size_t n, const double *points,
                       const size_t *order, unsigned from, unsigned to)
{
    unsigned last = (unsigned)f->n_values[0] - 1, left = 0, top = (unsigned)f->n_values[1] - 1;
    for (size_t i = 0; i <= n; i++) {
        const double *p = i < n ? points + order[i] * f->m : NULL;
        unsigned right = p ? (unsigned)index_of(f, 0, p[0]) : last;
        const unsigned box[FRONT_MOST_OBJECTIVES][2] = {{left, right}, {0, top}, {from, to}};
        if (right > left && !add_box(f, room, box))
            return false;
        left = right;
        if (p)
            top = (unsigned)index_of(f, 1, p[1]);
    }
    return true;
}

/* Rows with a third value of at most `level` that are a front in the first two, by increasing first
 * value. */
static size_t plane_front(const struct front *f, size_t n, const double *points, double level,
                          size_t *order)
{
    size_t count = 0, m = f->m;
    for (size_t i = 0; i < n; i++) {
        const double *p = points + i * m;
        bool beaten = m > 2 && p[2] > level;
        for (size_t k = 0; k < n && !beaten; k++) {
            const double *q = points + k * m;
            bool there = k != i && (m < 3 || q[2] <= level);
            beaten = there && q[0] <= p[0] && q[1] <= p[1] && (q[0] < p[0] || q[1] < p[1] || k < i);
        }
        if (!beaten)
            order[count++] = i;
    }
    for (size_t i = 1; i < count; i++)
        for (size_t k = i; k > 0 && points[order[k] * m] < points[order[k - 1] * m]; k--) {
            size_t kept = order[k];
            order[k] = order[k - 1];
            order[k - 1] = kept;
        }
    return count;
}

bool front_create(struct front *f, size_t m, size_t n, const double *points,
                  const double *reference)
{
    *f = (struct front){.m = m};
    double *kept = malloc((n * m + 1) * sizeof *kept);
    size_t *order = malloc((n + 1) * sizeof *order), room = 0;
    bool ok = kept && order;
    if (ok) {
        memcpy(kept, points, n * m * sizeof *kept);
        n = keep_front(m, n, kept, reference);
        ok = n != SIZE_MAX && list_values(f, n, kept, reference);
    }
    size_t slabs = ok && m > 2 ? f->n_values[2] - 1 : 1;
    for (size_t s = 0; s < slabs && ok; s++) {
        double level = m > 2 ? f->values[2][s] : 0;
        size_t count = plane_front(f, n, kept, level, order);
        ok = add_strips(f, &room, count, kept, order, (unsigned)s, (unsigned)s + 1);
    }
    free(kept);
    free(order);
    if (!ok)
        front_free(f);
    return ok;
}

void front_free(struct front *f)
{
    for (size_t c = 0; c < FRONT_MOST_OBJECTIVES; c++)
        free(f->values[c]);
    free(f->boxes);
    free(f->scratch);
    *f = (struct front){0};
}

/* One objective's share of a box: log of EI(upper) - EI(lower), EI(b) = E max(b - y, 0), and its
 * derivatives. log_ei, by_mean and by_sd hold log EI at every value of the objective. */
static double log_share(const double *log_ei, const double *by_mean, const double *by_sd,
                        const unsigned *ends, double *share_mean, double *share_sd)
{
    unsigned low = ends[0], high = ends[1];
    double ratio = low ? exp(log_ei[low] - log_ei[high]) : 0;
    if (!(ratio < 1) || !isfinite(log_ei[high])) {
        *share_mean = *share_sd = 0;
        return -INFINITY;
    }
    *share_mean = (by_mean[high] - (low ? ratio * by_mean[low] : 0)) / (1 - ratio);
    *share_sd = (by_sd[high] - (low ? ratio * by_sd[low] : 0)) / (1 - ratio);
    return log_ei[high] + log1p(-ratio);
}

double front_log_improvement(const struct front *f, const double *mean, const double *sd,
                             double *by_mean, double *by_sd)
{
    double *log_ei[FRONT_MOST_OBJECTIVES], *slope_mean[FRONT_MOST_OBJECTIVES],
        *slope_sd[FRONT_MOST_OBJECTIVES], *at = f->scratch;
    double total = 0, most = -INFINITY, sum_mean[FRONT_MOST_OBJECTIVES] = {0},
           sum_sd[FRONT_MOST_OBJECTIVES] = {0};
    for (size_t c = 0; c < f->m; c++) {
        size_t n = f->n_values[c];
        log_ei[c] = at;
        slope_mean[c] = at + n;
        slope_sd[c] = at + 2 * n;
        at += 3 * n;
        for (size_t i = 1; i < n; i++)
            log_ei[c][i] = bayesopt_log_ei(mean[c], sd[c], f->values[c][i], &slope_mean[c][i],
                                           &slope_sd[c][i]);
    }
    /* A running sum of exponentials relative to the largest so far. */
    for (size_t b = 0; b < f->n_boxes; b++) {
        double value = 0, d_mean[FRONT_MOST_OBJECTIVES], d_sd[FRONT_MOST_OBJECTIVES];
        for (size_t c = 0; c < f->m; c++)
            value += log_share(log_ei[c], slope_mean[c], slope_sd[c], f->boxes[b][c], &d_mean[c],
                               &d_sd[c]);
        if (!isfinite(value))
            continue;
        double shrink = value > most ? exp(most - value) : 1;
        most = fmax(most, value);
        double weight = exp(value - most);
        total = total * shrink + weight;
        for (size_t c = 0; c < f->m; c++) {
            sum_mean[c] = sum_mean[c] * shrink + weight * d_mean[c];
            sum_sd[c] = sum_sd[c] * shrink + weight * d_sd[c];
        }
    }
    for (size_t c = 0; c < f->m; c++) {
        if (by_mean)
            by_mean[c] = total > 0 ? sum_mean[c] / total : 0;
        if (by_sd)
            by_sd[c] = total > 0 ? sum_sd[c] / total : 0;
    }
    return total > 0 ? most + log(total) : -INFINITY;
}
