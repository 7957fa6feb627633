/* The inner loops of matrix.c for one instruction set; included once for each, with
 *   KERNEL(name)   the function's name for this set
 *   KERNEL_TARGET  its target attribute, or nothing
 *   LANES          doubles in a register
 *   ROWS           rows of a register block, whose columns are 2 LANES. */

typedef double KERNEL(vector) __attribute__((vector_size(8 * LANES)));
struct KERNEL(unaligned) {
    KERNEL(vector) v;
} __attribute__((packed, aligned(8)));

/* C += sign A B for ROWS x 2 LANES of C: sums stay in registers over all of k. */
KERNEL_TARGET
static inline void KERNEL(block)(size_t k, double sign, const double *a, size_t row_stride,
                                 size_t column_stride, const double *b, size_t ldb, double *c,
                                 size_t ldc)
{
    KERNEL(vector) sum[ROWS][2] = {{{0}}};
    for (size_t t = 0; t < k; t++) {
        const struct KERNEL(unaligned) *row = (const void *)(b + t * ldb);
        KERNEL(vector) left = row[0].v, right = row[1].v;
        for (size_t r = 0; r < ROWS; r++) {
            double factor = a[r * row_stride + t * column_stride];
            sum[r][0] += factor * left;
            sum[r][1] += factor * right;
        }
    }
    for (size_t r = 0; r < ROWS; r++) {
        struct KERNEL(unaligned) *at = (void *)(c + r * ldc);
        at[0].v += sign * sum[r][0];
        at[1].v += sign * sum[r][1];
    }
}

/* What the blocks leave over at the right and lower edges. */
KERNEL_TARGET
static void KERNEL(edge)(size_t m, size_t n, size_t k, double sign, const double *a,
                         size_t row_stride, size_t column_stride, const double *restrict b,
                         size_t ldb, double *restrict c, size_t ldc)
{
    for (size_t i = 0; i < m; i++)
        for (size_t t = 0; t < k; t++) {
            double factor = sign * a[i * row_stride + t * column_stride];
            for (size_t j = 0; j < n; j++)
                c[i * ldc + j] += factor * b[t * ldb + j];
        }
}

/* C += sign A B for tiles: A m x k by its strides (so that A' serves as well), B k x n, C m x n. */
KERNEL_TARGET
static void KERNEL(product)(size_t m, size_t n, size_t k, double sign, const double *a,
                            size_t row_stride, size_t column_stride, const double *b, size_t ldb,
                            double *c, size_t ldc)
{
    size_t rows = m - m % ROWS, columns = n - n % (2 * LANES);
    for (size_t j = 0; j < columns; j += 2 * LANES)
        for (size_t i = 0; i < rows; i += ROWS)
            KERNEL(block)
    (k, sign, a + i * row_stride, row_stride, column_stride, b + j, ldb, c + i * ldc + j, ldc);
    KERNEL(edge)
    (rows, n - columns, k, sign, a, row_stride, column_stride, b + columns, ldb, c + columns, ldc);
    KERNEL(edge)
    (m - rows, n, k, sign, a + rows * row_stride, row_stride, column_stride, b, ldb, c + rows * ldc,
     ldc);
}

/* B := L^-1 B, L n x n, B n x m: every step is a sweep over contiguous columns. */
KERNEL_TARGET
static void KERNEL(solve)(size_t n, const double *restrict l, size_t ld, size_t m, double *b,
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

KERNEL_TARGET
static double KERNEL(dot)(size_t n, const double *x, const double *y)
{
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (size_t i = 0; i < n; i++)
        sum += x[i] * y[i];
    return sum;
}

KERNEL_TARGET
static void KERNEL(axpy)(size_t n, double a, const double *restrict x, double *restrict y)
{
    for (size_t i = 0; i < n; i++)
        y[i] += a * x[i];
}
