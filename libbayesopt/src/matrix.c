#include "matrix.h"

#include <math.h>
#include <string.h>

enum { TILE = 64 };

/* Generic registers of two doubles, and on x86-64 wider ones where the machine has them. */
#define KERNEL(name) name##_generic
#define KERNEL_TARGET
#define LANES 2
#define ROWS  4
#include "matrix_kernels.h"
#undef KERNEL
#undef KERNEL_TARGET
#undef LANES
#undef ROWS

#if defined(__x86_64__) && defined(__GNUC__) && !defined(ISOHULL_NO_MULTIVERSION)
#define KERNEL(name)  name##_avx2
#define KERNEL_TARGET __attribute__((target("avx2,fma")))
#define LANES         4
#define ROWS          4
#include "matrix_kernels.h"
#undef KERNEL
#undef KERNEL_TARGET
#undef LANES
#undef ROWS

#define KERNEL(name)  name##_avx512
#define KERNEL_TARGET __attribute__((target("avx512f,avx2,fma")))
#define LANES         8
#define ROWS          8
#include "matrix_kernels.h"

#define DISPATCH(call)                                                                             \
    do {                                                                                           \
        if (__builtin_cpu_supports("avx512f"))                                                     \
            call(avx512);                                                                          \
        else if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))                  \
            call(avx2);                                                                            \
        else                                                                                       \
            call(generic);                                                                         \
    } while (0)
#else
#define DISPATCH(call) call(generic)
#endif

static void tile_product(size_t m, size_t n, size_t k, double sign, const double *a,
                         size_t row_stride, size_t column_stride, const double *b, size_t ldb,
                         double *c, size_t ldc)
{
#define CALL(set) product_##set(m, n, k, sign, a, row_stride, column_stride, b, ldb, c, ldc)
    DISPATCH(CALL);
#undef CALL
}

static void tile_solve(size_t n, const double *l, size_t ld, size_t m, double *b, size_t ldb)
{
#define CALL(set) solve_##set(n, l, ld, m, b, ldb)
    DISPATCH(CALL);
#undef CALL
}

double matrix_dot(size_t n, const double *x, const double *y)
{
    double sum = 0;
#define CALL(set) sum = dot_##set(n, x, y)
    DISPATCH(CALL);
#undef CALL
    return sum;
}

void matrix_axpy(size_t n, double a, const double *x, double *y)
{
#define CALL(set) axpy_##set(n, a, x, y)
    DISPATCH(CALL);
#undef CALL
}

void matrix_scale(size_t n, double a, double *x)
{
    for (size_t i = 0; i < n; i++)
        x[i] *= a;
}

static size_t tile_end(size_t start, size_t n)
{
    return n - start < TILE ? n : start + TILE;
}

static void transpose(size_t m, size_t n, const double *a, size_t lda, double *t)
{
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < n; j++)
            t[j * TILE + i] = a[i * lda + j];
}

static bool tile_cholesky(size_t n, double *a, size_t ld)
{
    for (size_t i = 0; i < n; i++) {
        double *row = a + i * ld;
        for (size_t j = 0; j < i; j++)
            row[j] = (row[j] - matrix_dot(j, row, a + j * ld)) / a[j * ld + j];
        double pivot = row[i] - matrix_dot(i, row, row);
        if (!(pivot > 0) || !isfinite(pivot))
            return false;
        row[i] = sqrt(pivot);
    }
    return true;
}

/* The tile of the diagonal at k: factor it in a copy, the strict upper triangle stays untouched. */
static bool factor_diagonal(size_t k, size_t width, double *a, size_t ld)
{
    double square[TILE * TILE] = {0};
    for (size_t r = 0; r < width; r++)
        memcpy(square + r * TILE, a + (k + r) * ld + k, (r + 1) * sizeof *square);
    for (size_t j = 0; j < k; j += TILE) {
        double turned[TILE * TILE];
        const double *row = a + k * ld + j;
        transpose(width, TILE, row, ld, turned);
        tile_product(width, width, TILE, -1, row, ld, 1, turned, TILE, square, TILE);
    }
    if (!tile_cholesky(width, square, TILE))
        return false;
    for (size_t r = 0; r < width; r++)
        memcpy(a + (k + r) * ld + k, square + r * TILE, (r + 1) * sizeof *square);
    return true;
}

/* The tiles below it: A_ik := (A_ik - sum_j L_ij L_kj') L_kk^-T, the solve on its transpose. */
static void factor_column(size_t n, size_t k, size_t width, double *a, size_t ld)
{
    double turned[TILE * TILE];
    for (size_t j = 0; j < k; j += TILE) {
        transpose(width, TILE, a + k * ld + j, ld, turned);
        for (size_t i = k + width; i < n; i += TILE)
            tile_product(tile_end(i, n) - i, width, TILE, -1, a + i * ld + j, ld, 1, turned, TILE,
                         a + i * ld + k, ld);
    }
    for (size_t i = k + width; i < n; i += TILE) {
        size_t height = tile_end(i, n) - i;
        double *tile = a + i * ld + k;
        transpose(height, width, tile, ld, turned);
        tile_solve(width, a + k * ld + k, ld, height, turned, TILE);
        for (size_t r = 0; r < height; r++)
            for (size_t c = 0; c < width; c++)
                tile[r * ld + c] = turned[c * TILE + r];
    }
}

bool matrix_cholesky(size_t n, double *a, size_t ld)
{
    for (size_t k = 0; k < n; k += TILE) {
        size_t width = tile_end(k, n) - k;
        if (!factor_diagonal(k, width, a, ld))
            return false;
        factor_column(n, k, width, a, ld);
    }
    return true;
}

void matrix_solve_lower(size_t n, const double *l, size_t ld, size_t m, double *b, size_t ldb)
{
    for (size_t c = 0; c < m; c += TILE) {
        size_t width = tile_end(c, m) - c;
        for (size_t i = 0; i < n; i += TILE) {
            size_t height = tile_end(i, n) - i;
            double *tile = b + i * ldb + c;
            for (size_t k = 0; k < i; k += TILE)
                tile_product(height, width, TILE, -1, l + i * ld + k, ld, 1, b + k * ldb + c, ldb,
                             tile, ldb);
            tile_solve(height, l + i * ld + i, ld, width, tile, ldb);
        }
    }
}

void matrix_forward(size_t n, const double *l, size_t ld, double *b)
{
    for (size_t i = 0; i < n; i++)
        b[i] = (b[i] - matrix_dot(i, l + i * ld, b)) / l[i * ld + i];
}

void matrix_backward(size_t n, const double *l, size_t ld, double *b)
{
    for (size_t i = n; i-- > 0;) {
        b[i] /= l[i * ld + i];
        matrix_axpy(i, -b[i], l + i * ld, b);
    }
}

/* work := L^-1, tile column by tile column; only tiles on and below the diagonal are touched, and
 * those of the diagonal are whole with zeros above. */
static void invert_lower(size_t n, const double *l, size_t ld, double *work)
{
    for (size_t c = 0; c < n; c += TILE) {
        size_t width = tile_end(c, n) - c;
        for (size_t i = c; i < n; i += TILE) {
            size_t height = tile_end(i, n) - i;
            double *tile = work + i * ld + c;
            for (size_t r = 0; r < height; r++) {
                memset(tile + r * ld, 0, width * sizeof *tile);
                if (i == c)
                    tile[r * ld + r] = 1;
            }
            for (size_t k = c; k < i; k += TILE)
                tile_product(height, width, TILE, -1, l + i * ld + k, ld, 1, work + k * ld + c, ld,
                             tile, ld);
            tile_solve(height, l + i * ld + i, ld, width, tile, ld);
        }
    }
}

void matrix_inverse(size_t n, const double *l, size_t ld, double *inverse, double *work)
{
    invert_lower(n, l, ld, work);
    for (size_t i = 0; i < n; i += TILE) {
        size_t height = tile_end(i, n) - i;
        for (size_t j = 0; j <= i; j += TILE) {
            size_t width = tile_end(j, n) - j;
            double *tile = inverse + i * ld + j;
            for (size_t r = 0; r < height; r++)
                memset(tile + r * ld, 0, width * sizeof *tile);
            for (size_t k = i; k < n; k += TILE)
                tile_product(height, width, tile_end(k, n) - k, 1, work + k * ld + i, 1, ld,
                             work + k * ld + j, ld, tile, ld);
        }
    }
}
