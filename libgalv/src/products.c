/* One register tile serves both products: it adds P Q to a few rows of the result, where P is a
 * small piece of the block of rows, read in place (by rows or by columns), and Q a strip of at most
 * three vector registers' width. */
#include "products.h"

#include "simd.h"
#include "threads.h"

#include <string.h>

/* Numbers per vector register; rows of a tile; numbers along which a tile sums before it moves on,
 * and coordinates handed to a thread, so that strip and tile stay in cache. */
enum { LANE = 8, TALL = 8, FLAT = 2, DEPTH = 512, SHALLOW = 32, SLICE = 256 };

/* Multiplications below which waking other threads costs more than they save. */
enum { ALONE = 1 << 20 };

typedef double lane __attribute__((vector_size(LANE * sizeof(double)), aligned(sizeof(double))));

/* P[i][p] is at p[i across + p along]; the strip's row p at q + p ld; row i of the result at out +
 * i ld. */
typedef struct tile {
    size_t depth, across, along, ld;
} tile;

GALV_SIMD_INLINE void add_tile(const tile *shape, const double *restrict p,
                               const double *restrict q, double *restrict out, int rows, int lanes)
{
    lane sum[TALL][3];
    size_t across = shape->across, along = shape->along, ld = shape->ld;
    for (int i = 0; i < rows; i++)
        for (int l = 0; l < lanes; l++)
            sum[i][l] = *(const lane *)(out + (size_t)i * ld + l * LANE);
    for (size_t k = 0; k < shape->depth; k++, p += along, q += ld)
#pragma GCC unroll 8
        for (int i = 0; i < rows; i++)
            for (int l = 0; l < lanes; l++)
                sum[i][l] += p[(size_t)i * across] * *(const lane *)(q + l * LANE);
    for (int i = 0; i < rows; i++)
        for (int l = 0; l < lanes; l++)
            *(lane *)(out + (size_t)i * ld + l * LANE) = sum[i][l];
}

/* `count` rows of the result in tiles of `rows`. */
GALV_SIMD_INLINE void add_tiles(const tile *shape, size_t count, const double *p, const double *q,
                                double *out, int rows, int lanes)
{
    size_t i = 0;
    for (; i + (size_t)rows <= count; i += (size_t)rows)
        add_tile(shape, p + i * shape->across, q, out + i * shape->ld, rows, lanes);
    for (; i < count; i++)
        add_tile(shape, p + i * shape->across, q, out + i * shape->ld, 1, lanes);
}

/* All strips: the padded width is divided as evenly as strips of 1 to 3 registers allow. */
GALV_SIMD_INLINE void add_strips(const tile *shape, size_t count, const double *p, const double *q,
                                 double *out, int rows)
{
    size_t left = shape->ld / LANE;
    for (size_t strips = (left + 2) / 3; strips > 0; strips--) {
        size_t lanes = (left + strips - 1) / strips;
        if (lanes == 3)
            add_tiles(shape, count, p, q, out, rows, 3);
        else if (lanes == 2)
            add_tiles(shape, count, p, q, out, rows, 2);
        else
            add_tiles(shape, count, p, q, out, rows, 1);
        q += lanes * LANE;
        out += lanes * LANE;
        left -= lanes;
    }
}

typedef void strips_function(const tile *, size_t, const double *, const double *, double *);

GALV_SIMD static void strips_narrow(const tile *shape, size_t count, const double *p,
                                    const double *q, double *out)
{
    add_strips(shape, count, p, q, out, FLAT);
}

GALV_SIMD_WIDE static void strips_wide(const tile *shape, size_t count, const double *p,
                                       const double *q, double *out)
{
    add_strips(shape, count, p, q, out, TALL);
}

static strips_function *choose_strips(void)
{
    return galv_simd_wide() ? strips_wide : strips_narrow;
}

size_t galv_padded(size_t b)
{
    return (b + LANE - 1) / LANE * LANE;
}

void galv_pad(size_t length, size_t b, const double *columns, double *padded)
{
    size_t ld = galv_padded(b);
    for (size_t i = 0; i < length; i++)
        for (size_t c = 0; c < ld; c++)
            padded[i * ld + c] = c < b ? columns[c * length + i] : 0;
}

void galv_unpad(size_t length, size_t b, const double *padded, double *columns)
{
    size_t ld = galv_padded(b);
    for (size_t c = 0; c < b; c++)
        for (size_t i = 0; i < length; i++)
            columns[c * length + i] = padded[i * ld + c];
}

void galv_rows_times(size_t count, size_t n, double alpha, const double *rows, size_t b,
                     const double *v, double *t)
{
    size_t ld = galv_padded(b);
    strips_function *add = choose_strips();
#pragma omp parallel for num_threads(threads_at_hand()) schedule(static) if (count * n * ld > ALONE)
    for (size_t first = 0; first < count; first += SHALLOW) {
        size_t some = count - first < SHALLOW ? count - first : SHALLOW;
        double *out = t + first * ld;
        memset(out, 0, some * ld * sizeof *out);
        for (size_t a = 0; a < n; a += DEPTH) {
            tile shape = {
                .depth = n - a < DEPTH ? n - a : DEPTH, .across = n, .along = 1, .ld = ld};
            add(&shape, some, rows + first * n + a, v + a * ld, out);
        }
        for (size_t i = 0; i < some * ld; i++)
            out[i] *= alpha;
    }
}

void galv_rows_add_transposed(size_t count, size_t n, const double *rows, size_t b, const double *t,
                              double *y)
{
    size_t ld = galv_padded(b);
    strips_function *add = choose_strips();
#pragma omp parallel for num_threads(threads_at_hand()) schedule(static) if (count * n * ld > ALONE)
    for (size_t a = 0; a < n; a += SLICE)
        for (size_t first = 0; first < count; first += SHALLOW) {
            size_t some = count - first < SHALLOW ? count - first : SHALLOW;
            tile shape = {.depth = some, .across = 1, .along = n, .ld = ld};
            add(&shape, n - a < SLICE ? n - a : SLICE, rows + first * n + a, t + first * ld,
                y + a * ld);
        }
}
