#include "influence/filter_change.h"

#include "core/error.h"
#include "core/vector_math.h"

#include <stdlib.h>
#include <string.h>

igabem_status filter_change_create(size_t n, size_t points, size_t width, size_t filters,
                                   int threads, struct filter_change **result)
{
    *result = NULL;
    struct filter_change *change = malloc(sizeof *change);
    if (!change)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a wave operator");
    *change = (struct filter_change){
        .n = n, .points = points, .width = width, .filters = filters, .threads = threads};
    size_t partial = (size_t)threads * points;
    change->storage = calloc((filters + n + points) * width + partial, sizeof *change->storage);
    change->order = calloc(2 * n, sizeof *change->order);
    change->row = calloc(points + 1, sizeof *change->row);
    if (!change->storage || !change->order || !change->row) {
        filter_change_free(change);
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a wave operator of %zu unknowns", n);
    }
    change->rank = change->order + n;
    change->filter = change->storage;
    change->moments = change->filter + filters * width;
    change->factor = change->moments + n * width;
    change->partial = change->factor + points * width;
    *result = change;
    return IGABEM_OK;
}

void filter_change_free(struct filter_change *change)
{
    if (!change)
        return;
    for (size_t i = 0; i < change->points && change->row; i++)
        free(change->row[i].entry);
    free(change->row);
    free(change->order);
    free(change->storage);
    free(change);
}

bool filter_change_collect(struct filter_change *change, size_t index, double *buffer)
{
    struct filter_change_row *row = &change->row[index];
    size_t n = change->n, count = 0;
    for (size_t k = 0; k < n * change->filters; k++)
        count += buffer[k] != 0.0;
    struct filter_change_entry *entry = malloc((count + 1) * sizeof *entry);
    if (!entry)
        return false;
    row->entry = entry;
    for (size_t k = 0; k < n; k++) {
        double second = change->filters > 1 ? buffer[n + k] : 0.0;
        if (change->rank[k] >= row->ahead && (buffer[k] != 0.0 || second != 0.0))
            entry[row->entries++] = (struct filter_change_entry){k, {buffer[k], second}};
    }
    memset(buffer, 0, n * change->filters * sizeof *buffer);
    return true;
}

VECTOR_MULTIVERSION
static void accumulate(size_t n, double factor, const double *from, double *to)
{
    for (size_t j = 0; j < n; j++)
        to[j] += factor * from[j];
}

VECTOR_MULTIVERSION
static double triple_product(size_t n, const double *a, const double *b, const double *c)
{
    double part[8] = {0}, sum = 0.0;
    size_t j = 0;
    for (; j + 8 <= n; j += 8)
        for (size_t l = 0; l < 8; l++)
            part[l] += a[j + l] * b[j + l] * c[j + l];
    for (; j < n; j++)
        sum += a[j] * b[j] * c[j];
    for (size_t l = 0; l < 8; l++)
        sum += part[l];
    return sum;
}

/* The march over a part of the wave angles: fills result[points]. */
static void march(const struct filter_change *change, size_t filter, size_t begin, size_t end,
                  const double *x, double *result)
{
    enum { CHUNK = 256 };
    size_t width = change->width;
    memset(result, 0, change->points * sizeof *result);
    for (size_t first = begin; first < end; first += CHUNK) {
        double state[CHUNK] = {0};
        size_t count = end - first < CHUNK ? end - first : CHUNK, next = 0;
        for (size_t i = 0; i < change->points; i++) {
            for (; next < change->row[i].ahead; next++) {
                size_t k = change->order[next];
                accumulate(count, x[k], change->moments + k * width + first, state);
            }
            result[i] += triple_product(count, change->factor + i * width + first,
                                        change->filter + filter * width + first, state);
        }
    }
}

void filter_change_add(const struct filter_change *change, size_t filter, const double *x,
                       double *y)
{
    size_t parts = (size_t)change->threads;
#pragma omp parallel for num_threads(change->threads) schedule(static)
    for (size_t p = 0; p < parts; p++)
        march(change, filter, change->width * p / parts, change->width * (p + 1) / parts, x,
              change->partial + p * change->points);
#pragma omp parallel for num_threads(change->threads) schedule(static)
    for (size_t i = 0; i < change->points; i++) {
        const struct filter_change_row *row = &change->row[i];
        double sum = 0.0;
        for (size_t p = 0; p < parts; p++)
            sum += change->partial[p * change->points + i];
        for (size_t e = 0; e < row->entries; e++)
            sum += row->entry[e].value[filter] * x[row->entry[e].unknown];
        y[row->point] += sum;
    }
}

void filter_change_expand(const struct filter_change *change, size_t filter, double *matrix)
{
    size_t n = change->n, width = change->width;
    memset(matrix, 0, n * n * sizeof *matrix);
#pragma omp parallel for num_threads(change->threads) schedule(dynamic, 8)
    for (size_t i = 0; i < change->points; i++) {
        const struct filter_change_row *row = &change->row[i];
        double *to = matrix + n * row->point;
        for (size_t k = 0; k < row->ahead; k++)
            to[change->order[k]] =
                triple_product(width, change->factor + i * width, change->filter + filter * width,
                               change->moments + change->order[k] * width);
        for (size_t e = 0; e < row->entries; e++)
            to[row->entry[e].unknown] = row->entry[e].value[filter];
    }
}

double filter_change_memory(const struct filter_change *change)
{
    size_t bytes = (change->n + change->points) * change->width * sizeof(double);
    for (size_t i = 0; i < change->points; i++)
        bytes += change->row[i].entries * sizeof(struct filter_change_entry);
    return (double)bytes;
}
