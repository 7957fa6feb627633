#include "core/combine.h"

#include "core/multiversion.h"

/* One pass over `to` for up to four rows; fresh: the old values are not read. */
NURBS_INLINE void pass(size_t rows, int fresh, const double *weight, const double *from,
                       ptrdiff_t stride, size_t columns, double own, double *restrict to)
{
    double w[4] = {0.0};
    const double *f[4] = {0};
    for (size_t r = 0; r < rows; r++) {
        w[r] = weight[r];
        f[r] = from + (ptrdiff_t)r * stride;
    }
    for (size_t c = 0; c < columns; c++) {
        double sum = fresh ? 0.0 : own * to[c];
        for (size_t r = 0; r < rows; r++)
            sum += w[r] * f[r][c];
        to[c] = sum;
    }
}

NURBS_INLINE void some_rows(size_t rows, int fresh, const double *weight, const double *from,
                            ptrdiff_t stride, size_t columns, double own, double *to)
{
    switch (rows) {
    case 0:
        pass(0, fresh, weight, from, stride, columns, own, to);
        break;
    case 1:
        pass(1, fresh, weight, from, stride, columns, own, to);
        break;
    case 2:
        pass(2, fresh, weight, from, stride, columns, own, to);
        break;
    case 3:
        pass(3, fresh, weight, from, stride, columns, own, to);
        break;
    default:
        pass(4, fresh, weight, from, stride, columns, own, to);
    }
}

NURBS_MULTIVERSION
void combine(size_t count, const double *weight, const double *from, ptrdiff_t stride,
             size_t columns, double own, double *to)
{
    size_t rows = count < 4 ? count : 4;
    if (own == 0.0)
        some_rows(rows, 1, weight, from, stride, columns, own, to);
    else
        some_rows(rows, 0, weight, from, stride, columns, own, to);
    for (size_t k = 4; k < count; k += 4) {
        rows = count - k < 4 ? count - k : 4;
        some_rows(rows, 0, weight + k, from + (ptrdiff_t)k * stride, stride, columns, 1.0, to);
    }
}

/* square[n] = squared norms of target - row, over planes `lines` apart. */
NURBS_INLINE void squares(size_t planes, size_t lines, size_t n, const double *target,
                          const double *row, double *restrict square)
{
    for (size_t j = 0; j < n; j++) {
        double sum = 0.0;
        for (size_t p = 0; p < planes; p++) {
            const double d = target[p * lines + j] - row[p * lines + j];
            sum += d * d;
        }
        square[j] = sum;
    }
}

NURBS_INLINE double larger(double a, double b)
{
    return a > b ? a : b;
}

enum { BLOCK = 128 };

NURBS_MULTIVERSION
double largest_square(size_t planes, size_t lines, const double *target, const double *row,
                      double *worst)
{
    double square[BLOCK + 3], largest[4] = {0.0};
    for (size_t j = 0; j < lines; j += BLOCK) {
        const size_t n = lines - j < BLOCK ? lines - j : BLOCK;
        if (planes == 3)
            squares(3, lines, n, target + j, row + j, square);
        else
            squares(planes, lines, n, target + j, row + j, square);
        for (size_t x = 0; worst && x < n; x++)
            worst[j + x] = larger(square[x], worst[j + x]);
        square[n] = square[n + 1] = square[n + 2] = 0.0;
        for (size_t x = 0; x < n; x += 4) /* comparisons in four chains */
            for (size_t y = 0; y < 4; y++)
                largest[y] = larger(square[x + y], largest[y]);
    }
    return larger(larger(largest[0], largest[1]), larger(largest[2], largest[3]));
}
