/* Goto and van de Geijn, ACM TOMS 34 (2008): packed panels, a register tile, and loops that keep
 * one panel in L1 and a stack of panels in L2. */
#include "rank_update.h"

#include "error.h"
#include "simd.h"

#include <stdlib.h>
#include <string.h>

/* Register tile ROWS x COLUMNS, depth of a panel, rows of a stack of panels. */
enum { ROWS = 16, COLUMNS = 6, DEPTH = 256, STACK = 12 * ROWS, LANE = 8 };

typedef double lane __attribute__((vector_size(LANE * sizeof(double)), aligned(sizeof(double))));

/* tile (ROWS x COLUMNS, column-major) = rows panel times columns panel^T. `lanes` lanes of the tile
 * are kept in registers at a time: both with 32 registers of 512 bits, one with 16 of 256. */
GALV_SIMD_INLINE void multiply(size_t depth, const double *restrict rows,
                               const double *restrict columns, double *restrict tile, int lanes)
{
    for (int first = 0; first < ROWS / LANE; first += lanes) {
        lane sum[2][COLUMNS];
        memset(sum, 0, sizeof sum);
        const double *r = rows + first * LANE, *c = columns;
        for (size_t p = 0; p < depth; p++, r += ROWS, c += COLUMNS)
            for (int l = 0; l < lanes; l++) {
                lane v = *(const lane *)(r + l * LANE);
#pragma GCC unroll 6
                for (int j = 0; j < COLUMNS; j++)
                    sum[l][j] += v * c[j];
            }
        for (int l = 0; l < lanes; l++)
            for (int j = 0; j < COLUMNS; j++)
                *(lane *)(tile + j * ROWS + (first + l) * LANE) = sum[l][j];
    }
}

GALV_SIMD static void multiply_narrow(size_t depth, const double *rows, const double *columns,
                                      double *tile)
{
    multiply(depth, rows, columns, tile, 1);
}

GALV_SIMD_WIDE static void multiply_wide(size_t depth, const double *rows, const double *columns,
                                         double *tile)
{
    multiply(depth, rows, columns, tile, 2);
}

typedef void multiply_function(size_t, const double *, const double *, double *);

/* Panels of `width` rows of columns first..first+depth-1 of a: per column, width numbers, zeros
 * beyond n. */
static void pack(size_t n, size_t first, size_t depth, size_t width, const double *a,
                 double *panels)
{
    size_t count = (n + width - 1) / width;
#pragma omp parallel for schedule(static)
    for (size_t panel = 0; panel < count; panel++) {
        size_t row = panel * width, rest = n - row < width ? n - row : width;
        double *out = panels + panel * width * depth;
        for (size_t p = 0; p < depth; p++, out += width) {
            const double *in = a + (first + p) * n + row;
            for (size_t i = 0; i < width; i++)
                out[i] = i < rest ? in[i] : 0;
        }
    }
}

/* Adds the part of the tile at (i, j) that lies in the matrix and on or below its diagonal. */
static void add_tile(size_t n, size_t i, size_t j, double alpha, const double *tile, double *c)
{
    size_t rows = n - i < ROWS ? n - i : ROWS, columns = n - j < COLUMNS ? n - j : COLUMNS;
    for (size_t q = 0; q < columns; q++) {
        size_t top = j + q > i ? j + q - i : 0;
        double *column = c + (j + q) * n + i;
        for (size_t p = top; p < rows; p++)
            column[p] += alpha * tile[q * ROWS + p];
    }
}

/* The rows first..first+STACK-1 of the lower triangle. */
static void update_stack(size_t n, size_t first, size_t depth, double alpha, const double *rows,
                         const double *columns, double *c, multiply_function *product)
{
    size_t last = first + STACK < n ? first + STACK : n;
    for (size_t j = 0; j < last; j += COLUMNS)
        for (size_t i = first; i < last; i += ROWS) {
            double tile[ROWS * COLUMNS];
            if (i + ROWS <= j)
                continue;
            product(depth, rows + i * depth, columns + j * depth, tile);
            add_tile(n, i, j, alpha, tile, c);
        }
}

galv_status galv_rank_update(size_t n, size_t k, double alpha, const double *a, double *c)
{
    size_t row_panels = (n + ROWS - 1) / ROWS, column_panels = (n + COLUMNS - 1) / COLUMNS;
    size_t stacks = (n + STACK - 1) / STACK, deepest = k < DEPTH ? k : DEPTH;
    double *rows = malloc(row_panels * ROWS * deepest * sizeof *rows);
    double *columns = malloc(column_panels * COLUMNS * deepest * sizeof *columns);
    multiply_function *product = galv_simd_wide() ? multiply_wide : multiply_narrow;
    galv_status status = GALV_OK;
    if (!rows || !columns)
        status = galv_fail(GALV_ERROR_MEMORY, "update of a covariance of order %zu", n);
    for (size_t first = 0; first < k && !status; first += DEPTH) {
        size_t depth = k - first < DEPTH ? k - first : DEPTH;
        pack(n, first, depth, ROWS, a, rows);
        pack(n, first, depth, COLUMNS, a, columns);
        /* The lowest rows are the longest: hand them out first. */
#pragma omp parallel for schedule(dynamic)
        for (size_t s = 0; s < stacks; s++)
            update_stack(n, (stacks - 1 - s) * STACK, depth, alpha, rows, columns, c, product);
    }
    free(rows);
    free(columns);
    return status;
}
