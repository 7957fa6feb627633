#include "simplify/reduction.h"

#include "core/band.h"
#include "core/combine.h"
#include "core/error.h"
#include "core/multiversion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

nurbs_status reduction_create(int degree, size_t fine_size, const double *fine, size_t size,
                              const double *knots, struct reduction *r)
{
    const size_t width = (size_t)degree + 1;
    r->degree = degree;
    r->fine_size = fine_size;
    r->size = size;
    r->fine = fine;
    r->knots = malloc((size + width) * sizeof *r->knots);
    r->first = malloc(fine_size * sizeof *r->first);
    r->rows = malloc(fine_size * width * sizeof *r->rows);
    r->factor = malloc(size * width * sizeof *r->factor);
    r->column = malloc(size * sizeof *r->column);
    r->weights = malloc(fine_size * width * sizeof *r->weights);
    if (!r->knots || !r->first || !r->rows || !r->factor || !r->column || !r->weights) {
        reduction_free(r);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to simplify %zu control points", size);
    }
    memcpy(r->knots, knots, (size + width) * sizeof *r->knots);
    reduction_update(r);
    return NURBS_OK;
}

void reduction_free(struct reduction *r)
{
    free(r->knots);
    free(r->first);
    free(r->rows);
    free(r->factor);
    free(r->column);
    free(r->weights);
    memset(r, 0, sizeof *r);
}

/* Cholesky factorisation in place; column k of row i holds entry (i, i - k). */
static void factorize(size_t n, size_t width, double *a)
{
    for (size_t i = 0; i < n; i++) {
        double *row = a + i * width;
        for (size_t k = i < width - 1 ? i : width - 1; k > 0; k--) {
            const double *other = a + (i - k) * width;
            double sum = row[k];
            for (size_t l = k + 1; l < width && l <= i; l++)
                sum -= row[l] * other[l - k];
            row[k] = sum * other[0];
        }
        double sum = row[0];
        for (size_t l = 1; l < width && l <= i; l++)
            sum -= row[l] * row[l];
        row[0] = 1.0 / sqrt(sum); /* the reciprocal: solves multiply */
    }
}

/* Solves with the factor for `columns` right-hand sides of the same stride. */
static void solve(size_t n, size_t width, const double *a, size_t columns, double *b)
{
    const ptrdiff_t stride = (ptrdiff_t)columns;
    double weight[NURBS_MAX_DEGREE];
    for (size_t i = 0; i < n; i++) {
        const double *row = a + i * width;
        const size_t count = i < width - 1 ? i : width - 1;
        for (size_t k = 0; k < count; k++)
            weight[k] = -row[0] * row[k + 1];
        combine(count, weight, count ? b + (i - 1) * columns : b, -stride, columns, row[0],
                b + i * columns);
    }
    for (size_t i = n; i-- > 0;) {
        const double inverse = a[i * width];
        size_t count = 0;
        for (; count + 1 < width && i + count + 1 < n; count++)
            weight[count] = -inverse * a[(i + count + 1) * width + count + 1];
        combine(count, weight, count ? b + (i + 1) * columns : b, stride, columns, inverse,
                b + i * columns);
    }
}

/* The columns of A between the ends: rows low to high - 1 of column k, its weights at `start`. */
static void set_columns(struct reduction *r)
{
    const size_t p = (size_t)r->degree, width = p + 1;
    size_t low = 0, high = 0, start = 0;
    for (size_t k = 0; k < r->size; k++) {
        while (low < r->fine_size && r->first[low] + p < k)
            low++;
        while (high < r->fine_size && r->first[high] <= k)
            high++;
        size_t first = low, last = high;
        while (first < last && r->rows[first * width + k - r->first[first]] == 0.0)
            first++;
        while (last > first && r->rows[(last - 1) * width + k - r->first[last - 1]] == 0.0)
            last--;
        r->column[k] = (struct column){first, last - first, start};
        for (size_t i = first; i < last; i++)
            r->weights[start++] = r->rows[i * width + k - r->first[i]];
    }
}

void reduction_update(struct reduction *r)
{
    const size_t p = (size_t)r->degree, width = p + 1;
    size_t span = p;
    for (size_t i = 0; i < r->fine_size; i++) {
        while (span + 1 < r->size && r->fine[i] >= r->knots[span + 1])
            span++;
        r->first[i] = span - p;
        blossom(r->degree, r->knots, span, r->fine + i + 1, r->rows + i * width);
    }
    set_columns(r);
    if (r->size < 3)
        return;
    memset(r->factor, 0, r->size * width * sizeof *r->factor);
    memset(r->end, 0, sizeof r->end);
    for (size_t i = 0; i < r->fine_size; i++) {
        const double *row = r->rows + i * width;
        for (size_t a = 0; a < width; a++) {
            double *to = r->factor + (r->first[i] + a) * width;
            for (size_t b = 0; b <= a && row[a] != 0.0; b++)
                to[a - b] += row[a] * row[b];
        }
    }
    for (size_t k = 1; k < width && k < r->size; k++) {
        r->end[0][k] = r->factor[k * width + k];
        r->end[1][k] = r->factor[(r->size - 1) * width + k];
    }
    /* The first interior row has index 1; its neighbours to the left are fixed. */
    factorize(r->size - 2, width, r->factor + width);
}

void reduction_set(struct reduction *r, size_t size, const double *knots)
{
    const size_t bytes = (size + (size_t)r->degree + 1) * sizeof *knots;
    if (size == r->size && memcmp(r->knots, knots, bytes) == 0)
        return;
    r->size = size;
    memcpy(r->knots, knots, bytes);
    reduction_update(r);
}

/* Boehm's insertion of the removed knot, c_i = ratio_i c'_i + (1 - ratio_i) c'_{i-1}, has the left
 * null vector g. */
void removal_functional(int degree, const double *t, size_t index, struct removal *removal)
{
    const size_t p = (size_t)degree;
    const double knot = t[index];
    size_t others = 0; /* further copies */
    while (t[index - 1 - others] == knot)
        others++;
    removal->index = index;
    removal->first = index - 1 - p;
    removal->count = p - others + 2;
    double *g = removal->functional, *a = removal->ratio;
    a[0] = 1.0;
    g[0] = 1.0;
    double largest = 1.0;
    for (size_t k = 1; k < removal->count; k++) {
        const size_t i = removal->first + k;
        a[k] = k + 1 < removal->count ? (knot - t[i]) / (t[i + p + 1] - t[i]) : 0.0;
        g[k] = -g[k - 1] * a[k - 1] / (1.0 - a[k]);
        largest = fmax(largest, fabs(g[k]));
    }
    for (size_t k = 0; k < removal->count; k++)
        g[k] /= largest;
}

NURBS_MULTIVERSION
void reduction_assess(const struct reduction *r, size_t index, double negligible,
                      struct removal *removal)
{
    const size_t width = (size_t)r->degree + 1, m = r->size;
    removal_functional(r->degree, r->knots, index, removal);
    memset(removal->x, 0, m * sizeof *removal->x);
    for (size_t k = 0; k < removal->count; k++)
        removal->x[removal->first + k] = removal->functional[k];
    removal->x[0] = removal->x[m - 1] = 0.0;
    removal->gain = 0.0;
    removal->low = removal->high = 0;
    if (m < 3)
        return;
    solve(m - 2, width, r->factor + width, 1, removal->x + 1);
    for (size_t k = 0; k < removal->count; k++)
        removal->gain += removal->functional[k] * removal->x[removal->first + k];
    if (!(removal->gain > 0.0) || !isfinite(removal->gain)) {
        removal->gain = 0.0;
        return;
    }
    double largest = 0.0;
    for (size_t i = 0; i < r->fine_size; i++) {
        double sum = 0.0;
        for (size_t k = 0; k < width; k++)
            sum += r->rows[i * width + k] * removal->x[r->first[i] + k];
        removal->influence[i] = sum;
        largest = fmax(largest, fabs(sum));
    }
    size_t low = 0, high = r->fine_size;
    while (low < high && fabs(removal->influence[low]) <= negligible * largest)
        low++;
    while (high > low && fabs(removal->influence[high - 1]) <= negligible * largest)
        high--;
    removal->low = low;
    removal->high = high;
}

/* Solves the insertion equations from both sides, each as long as its ratio is the larger one. */
size_t reduction_contract(const struct removal *removal, size_t columns, size_t stride,
                          double *base)
{
    const double *a = removal->ratio;
    const size_t count = removal->count;
    size_t left = 0;
    while (left + 1 < count - 1 && a[left + 1] >= 0.5)
        left++;
    for (size_t k = 1; k <= left; k++)
        for (size_t c = 0; c < columns; c++)
            base[k * stride + c] =
                (base[k * stride + c] - (1.0 - a[k]) * base[(k - 1) * stride + c]) / a[k];
    /* New point k - 1 from old point k; new point count - 2 is old point count - 1. */
    for (size_t k = count - 2; k > left + 1; k--)
        for (size_t c = 0; c < columns; c++)
            base[k * stride + c] =
                (base[k * stride + c] - a[k] * base[(k + 1) * stride + c]) / (1.0 - a[k]);
    return left + 1;
}

void reduction_drop(struct reduction *r, size_t index)
{
    const size_t count = r->size + (size_t)r->degree + 1;
    memmove(r->knots + index, r->knots + index + 1, (count - index - 1) * sizeof *r->knots);
    r->size--;
}

void reduction_project(const struct reduction *r, size_t columns, const double *fine,
                       double *coarse)
{
    const size_t width = (size_t)r->degree + 1, m = r->size;
    const double *last = fine + (r->fine_size - 1) * columns;
    memcpy(coarse, fine, columns * sizeof *coarse);
    memcpy(coarse + (m - 1) * columns, last, columns * sizeof *coarse);
    for (size_t k = 1; k + 1 < m; k++) {
        const struct column column = r->column[k];
        double *to = coarse + k * columns;
        combine(column.count, r->weights + column.start, fine + column.first * columns,
                (ptrdiff_t)columns, columns, 0.0, to);
        /* Move the fixed end points to the right-hand side. */
        if (k < width) {
            const double weight = -r->end[0][k];
            combine(1, &weight, fine, 0, columns, 1.0, to);
        }
        if (m - 1 - k < width) {
            const double weight = -r->end[1][m - 1 - k];
            combine(1, &weight, last, 0, columns, 1.0, to);
        }
    }
    if (m > 2)
        solve(m - 2, width, r->factor + width, columns, coarse + columns);
}

void reduction_expand_row(const struct reduction *r, size_t i, size_t columns, const double *coarse,
                          double *row)
{
    const size_t width = (size_t)r->degree + 1;
    combine(width, r->rows + i * width, coarse + r->first[i] * columns, (ptrdiff_t)columns, columns,
            0.0, row);
}

void reduction_expand(const struct reduction *r, size_t columns, const double *coarse, double *fine)
{
    for (size_t i = 0; i < r->fine_size; i++)
        reduction_expand_row(r, i, columns, coarse, fine + i * columns);
}
