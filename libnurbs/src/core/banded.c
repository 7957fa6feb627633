#include "core/banded.h"

#include "core/combine.h"
#include "core/error.h"

#include <math.h>
#include <stdlib.h>

/* Entries of a row that are combined at once. */
enum { MOST = 16 };

nurbs_status banded_create(size_t n, size_t lower, size_t upper, banded *matrix)
{
    *matrix = (banded){n, lower, upper, calloc(n * (lower + 1 + upper), sizeof(double))};
    if (!matrix->a)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a band matrix of order %zu", n);
    return NURBS_OK;
}

void banded_free(banded *matrix)
{
    free(matrix->a);
    matrix->a = NULL;
}

nurbs_status banded_factor(banded *matrix)
{
    size_t n = matrix->n;
    for (size_t k = 0; k < n; k++) {
        double pivot = *banded_entry(matrix, k, k);
        if (!(fabs(pivot) > 1e-14))
            return nurbs_fail(NURBS_ERROR_NUMERIC,
                              "collocation matrix is singular at row %zu of %zu: the parameters do "
                              "not interlace with the knots",
                              k, n);
        size_t last_row = k + matrix->lower < n ? k + matrix->lower : n - 1;
        size_t last_column = k + matrix->upper < n ? k + matrix->upper : n - 1;
        for (size_t i = k + 1; i <= last_row; i++) {
            double factor = *banded_entry(matrix, i, k) / pivot;
            *banded_entry(matrix, i, k) = factor;
            if (factor != 0)
                for (size_t j = k + 1; j <= last_column; j++)
                    *banded_entry(matrix, i, j) -= factor * *banded_entry(matrix, k, j);
        }
    }
    return NURBS_OK;
}

/* Row i of the right-hand sides, less columns first to last - 1 of the factors, times `scale`. */
static void eliminate(const banded *factors, size_t i, size_t first, size_t last, double scale,
                      size_t m, double *rhs)
{
    double weight[MOST] = {0.0}, own = scale;
    while (first < last && *banded_entry(factors, i, first) == 0)
        first++;
    for (size_t part; first < last || own != 1.0; first += part, own = 1.0) {
        part = last - first < MOST ? last - first : MOST;
        for (size_t k = 0; k < part; k++)
            weight[k] = -scale * *banded_entry(factors, i, first + k);
        combine(part, weight, rhs + first * m, (ptrdiff_t)m, m, own, rhs + i * m);
    }
}

void banded_solve(const banded *factors, size_t m, double *rhs)
{
    size_t n = factors->n;
    for (size_t i = 1; i < n; i++)
        eliminate(factors, i, i > factors->lower ? i - factors->lower : 0, i, 1.0, m, rhs);
    for (size_t i = n; i-- > 0;) {
        size_t last = i + factors->upper < n ? i + factors->upper : n - 1;
        while (last > i && *banded_entry(factors, i, last) == 0)
            last--;
        eliminate(factors, i, i + 1, last + 1, 1 / *banded_entry(factors, i, i), m, rhs);
    }
}
