#include "error.h"
#include "simd.h"
#include "source.h"
#include "threads.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Numbers of a block below which waking other threads costs more than they save. */
enum { ALONE = 1 << 16 };

galv_status galv_stream_start(galv_stream *stream, galv_source *source, size_t block,
                              const double *weights, bool shifted)
{
    size_t stored = source->stored;
    *stream = (galv_stream){.source = source, .block = block, .stage = {.to = GALV_STAGE_READ}};
    stream->place = malloc(stored * sizeof *stream->place);
    stream->seen = calloc(stored, 1);
    stream->hidden = malloc(stored * sizeof *stream->hidden);
    stream->buffer = source->values ? NULL : malloc(block * stored * sizeof *stream->buffer);
    stream->packed = malloc(block * stored * sizeof *stream->packed);
    stream->energy = malloc(block * sizeof *stream->energy);
    stream->scale = weights ? malloc(stored * sizeof *stream->scale) : NULL;
    stream->shift = shifted ? calloc(stored, sizeof *stream->shift) : NULL;
    if (!stream->place || !stream->seen || !stream->hidden || !stream->packed || !stream->energy ||
        (!source->values && !stream->buffer) || (weights && !stream->scale) ||
        (shifted && !stream->shift)) {
        galv_stream_end(stream);
        return galv_fail(GALV_ERROR_MEMORY, "a block of %zu samples of %zu coordinates", block,
                         stored);
    }
    for (size_t s = 0; s < stored; s++)
        stream->hidden[s] = UINT64_MAX;
    for (size_t s = 0; weights && s < stored; s++)
        stream->scale[s] = sqrt(weights[source->index[s]]);
    return GALV_OK;
}

void galv_stream_end(galv_stream *stream)
{
    free(stream->place);
    free(stream->seen);
    free(stream->scale);
    free(stream->shift);
    free(stream->hidden);
    free(stream->buffer);
    free(stream->packed);
    free(stream->energy);
    *stream = (galv_stream){.source = NULL};
}

/* Gives places to the coordinates newly seen. */
static void adopt(galv_stream *stream)
{
    for (size_t s = 0; s < stream->source->stored; s++)
        if (stream->seen[s] && stream->hidden[s]) {
            stream->hidden[s] = 0;
            stream->place[stream->active++] = s;
        }
}

/* A coordinate that is zero in all rows so far contributes nothing to any inner product with them,
 * so it can join when it first moves. */
void galv_stream_expect(galv_stream *stream, size_t n, const double *rows)
{
    size_t stored = stream->source->stored;
    for (size_t i = 0; i < n; i++)
        for (size_t s = 0; s < stored; s++)
            stream->seen[s] |= rows[i * stored + s] != 0;
    adopt(stream);
}

/* Whether any number under the mask differs from zero of either sign. */
GALV_SIMD static bool any_under(size_t n, const double *row, const uint64_t *mask)
{
    uint64_t any = 0;
    for (size_t i = 0; i < n; i++) {
        uint64_t bits;
        memcpy(&bits, row + i, sizeof bits);
        any |= bits & mask[i];
    }
    return any << 1 != 0;
}

/* Most blocks have nothing new, which is quickly told. */
static void discover(galv_stream *stream, size_t count)
{
    size_t stored = stream->source->stored;
    bool news = false;
#pragma omp parallel for num_threads(threads_at_hand()) schedule(static)                           \
    reduction(||                                                                                   \
              : news) if (count * stored > ALONE)
    for (size_t r = 0; r < count; r++)
        news = news || any_under(stored, stream->raw + r * stored, stream->hidden);
    if (news)
        galv_stream_expect(stream, count, stream->raw);
}

static void pack_row(const galv_stream *stream, const double *raw, double *row)
{
    const size_t *place = stream->place;
    for (size_t a = 0; a < stream->active; a++)
        row[a] = raw[place[a]];
    if (stream->shift)
        for (size_t a = 0; a < stream->active; a++)
            row[a] -= stream->shift[place[a]];
    if (stream->scale)
        for (size_t a = 0; a < stream->active; a++)
            row[a] *= stream->scale[place[a]];
}

static galv_status row_not_finite(const galv_stream *stream, size_t sample, const double *raw)
{
    const galv_source *source = stream->source;
    for (size_t s = 0; s < source->stored; s++)
        if (!isfinite(raw[s]))
            return galv_fail(GALV_ERROR_NUMERIC, "sample %zu: coordinate %zu is %g", sample,
                             source->index[s], raw[s]);
    return galv_fail(GALV_ERROR_NUMERIC, "sample %zu: its squared norm overflows", sample);
}

/* Eight partial sums, so that the compiler may use vector registers without reordering anything. */
static double square_norm(size_t n, const double *row)
{
    double sum[8] = {0};
    size_t a = 0;
    for (; a + 8 <= n; a += 8)
        for (size_t k = 0; k < 8; k++)
            sum[k] += row[a + k] * row[a + k];
    for (; a < n; a++)
        sum[0] += row[a] * row[a];
    return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

/* Whether the active coordinates are the stored ones as they are. */
static bool is_plain(const galv_stream *stream)
{
    if (stream->scale || stream->shift || stream->active != stream->source->stored)
        return false;
    for (size_t a = 0; a < stream->active; a++)
        if (stream->place[a] != a)
            return false;
    return true;
}

galv_status galv_stream_read(galv_stream *stream, size_t first, size_t count)
{
    galv_source *source = stream->source;
    size_t stored = source->stored;
    galv_status status =
        source->values ? GALV_OK : source->rows(source, first, count, stream->buffer);
    if (status)
        return status;
    stream->raw = source->values ? source->values + first * stored : stream->buffer;
    if (stream->shift && first == 0)
        memcpy(stream->shift, stream->raw, stored * sizeof *stream->shift);
    if (stream->active < stored)
        discover(stream, count);
    size_t active = stream->active;
    bool plain = is_plain(stream);
    stream->rows = plain ? stream->raw : stream->packed;
#pragma omp parallel for num_threads(threads_at_hand()) schedule(static) if (count * stored > ALONE)
    for (size_t r = 0; r < count; r++) {
        if (!plain)
            pack_row(stream, stream->raw + r * stored, stream->packed + r * active);
        stream->energy[r] = square_norm(active, stream->rows + r * active);
    }
    for (size_t r = 0; r < count; r++)
        if (!isfinite(stream->energy[r]))
            return row_not_finite(stream, first + r, stream->raw + r * stored);
    return GALV_OK;
}

galv_status galv_stream_report(galv_stream *stream, size_t done)
{
    return galv_stage_report(&stream->stage, (double)done / (double)stream->source->samples);
}
