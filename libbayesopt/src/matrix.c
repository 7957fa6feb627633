#include "matrix.h"

#include <math.h>
#include <string.h>

#include <cblas.h>

#include "clones.h"

/* The largest cube OpenBLAS multiplies without its threads. */
enum { TILE = 64 };

static size_t tile_end(size_t start, size_t n)
{
    return n - start < TILE ? n : start + TILE;
}

/* C -= A B' and C -= A B for tiles: A m x k; C m x n. */
static void subtract_transposed(size_t m, size_t n, size_t k, const double *a, size_t lda,
                                const double *b, size_t ldb, double *c, size_t ldc)
{
    cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasTrans, (int)m, (int)n, (int)k, -1, a, (int)lda, b,
                (int)ldb, 1, c, (int)ldc);
}

static void subtract_product(size_t m, size_t n, size_t k, const double *a, size_t lda,
                             const double *b, size_t ldb, double *c, size_t ldc)
{
    cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, (int)m, (int)n, (int)k, -1, a, (int)lda,
                b, (int)ldb, 1, c, (int)ldc);
}

static bool tile_cholesky(size_t n, double *a, size_t ld)
{
    for (size_t i = 0; i < n; i++) {
        double *row = a + i * ld;
        for (size_t j = 0; j < i; j++)
            row[j] = (row[j] - cblas_ddot((int)j, row, 1, a + j * ld, 1)) / a[j * ld + j];
        double pivot = row[i] - cblas_ddot((int)i, row, 1, row, 1);
        if (!(pivot > 0) || !isfinite(pivot))
            return false;
        row[i] = sqrt(pivot);
    }
    return true;
}

/* B := L^-1 B, L n x n, B n x m: every step is a sweep over contiguous columns. */
BAYESOPT_CLONES
static void tile_solve(size_t n, const double *restrict l, size_t ld, size_t m, double *restrict b,
                       size_t ldb)
{
    for (size_t i = 0; i < n; i++) {
        double *restrict row = b + i * ldb;
        for (size_t k = 0; k < i; k++) {
            const double *restrict above = b + k * ldb;
            double factor = l[i * ld + k];
            for (size_t c = 0; c < m; c++)
                row[c] -= factor * above[c];
        }
        double reciprocal = 1 / l[i * ld + i];
        for (size_t c = 0; c < m; c++)
            row[c] *= reciprocal;
    }
}

/* A := A L^-T for a tile A m x n: the solve above on its transpose. */
static void tile_solve_right(size_t n, const double *l, size_t ld, size_t m, double *a, size_t lda)
{
    double transposed[TILE * TILE];
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < n; j++)
            transposed[j * TILE + i] = a[i * lda + j];
    tile_solve(n, l, ld, m, transposed, TILE);
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < n; j++)
            a[i * lda + j] = transposed[j * TILE + i];
}

bool matrix_cholesky(size_t n, double *a, size_t ld)
{
    for (size_t k = 0; k < n; k += TILE) {
        size_t width = tile_end(k, n) - k;
        for (size_t i = k; i < n; i += TILE) {
            size_t height = tile_end(i, n) - i;
            double *tile = a + i * ld + k;
            if (i == k) {
                /* A full product would overwrite the strict upper triangle. */
                double square[TILE * TILE];
                for (size_t r = 0; r < height; r++)
                    memcpy(square + r * TILE, tile + r * ld, (r + 1) * sizeof *square);
                for (size_t r = 0; r < height; r++)
                    for (size_t c = r + 1; c < width; c++)
                        square[r * TILE + c] = 0;
                for (size_t j = 0; j < k; j += TILE)
                    subtract_transposed(height, width, TILE, a + i * ld + j, ld, a + k * ld + j, ld,
                                        square, TILE);
                if (!tile_cholesky(width, square, TILE))
                    return false;
                for (size_t r = 0; r < height; r++)
                    memcpy(tile + r * ld, square + r * TILE, (r + 1) * sizeof *square);
            } else {
                for (size_t j = 0; j < k; j += TILE)
                    subtract_transposed(height, width, TILE, a + i * ld + j, ld, a + k * ld + j, ld,
                                        tile, ld);
                tile_solve_right(width, a + k * ld + k, ld, height, tile, ld);
            }
        }
    }
    return true;
}

void matrix_solve_lower(size_t n, const double *l, size_t ld, size_t m, double *b, size_t ldb)
{
    for (size_t i = 0; i < n; i += TILE) {
        size_t height = tile_end(i, n) - i;
        for (size_t c = 0; c < m; c += TILE) {
            size_t width = tile_end(c, m) - c;
            double *tile = b + i * ldb + c;
            for (size_t k = 0; k < i; k += TILE)
                subtract_product(height, width, TILE, l + i * ld + k, ld, b + k * ldb + c, ldb,
                                 tile, ldb);
            tile_solve(height, l + i * ld + i, ld, width, tile, ldb);
        }
    }
}

void matrix_forward(size_t n, const double *l, size_t ld, double *b)
{
    for (size_t i = 0; i < n; i++)
        b[i] = (b[i] - cblas_ddot((int)i, l + i * ld, 1, b, 1)) / l[i * ld + i];
}

void matrix_backward(size_t n, const double *l, size_t ld, double *b)
{
    for (size_t i = n; i-- > 0;) {
        b[i] /= l[i * ld + i];
        cblas_daxpy((int)i, -b[i], l + i * ld, 1, b, 1);
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
                subtract_product(height, width, TILE, l + i * ld + k, ld, work + k * ld + c, ld,
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
            for (size_t k = i; k < n; k += TILE)
                cblas_dgemm(CblasRowMajor, CblasTrans, CblasNoTrans, (int)height, (int)width,
                            (int)(tile_end(k, n) - k), 1, work + k * ld + i, (int)ld,
                            work + k * ld + j, (int)ld, k > i, tile, (int)ld);
        }
    }
}

void matrix_product(size_t n, size_t k, size_t m, const double *a, size_t lda, const double *b,
                    size_t ldb, double *c, size_t ldc)
{
    for (size_t i = 0; i < n; i += TILE)
        for (size_t j = 0; j < m; j += TILE)
            for (size_t t = 0; t < k; t += TILE)
                cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, (int)(tile_end(i, n) - i),
                            (int)(tile_end(j, m) - j), (int)(tile_end(t, k) - t), 1,
                            a + i * lda + t, (int)lda, b + t * ldb + j, (int)ldb, t > 0,
                            c + i * ldc + j, (int)ldc);
}
