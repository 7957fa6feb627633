#include "banded.h"

#include "error.h"

#include <math.h>
#include <stdlib.h>

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

static void subtract(size_t m, double factor, const double *from, double *row)
{
    for (size_t c = 0; c < m; c++)
        row[c] -= factor * from[c];
}

void banded_solve(const banded *factors, size_t m, double *rhs)
{
    size_t n = factors->n;
    for (size_t i = 1; i < n; i++)
        for (size_t k = i > factors->lower ? i - factors->lower : 0; k < i; k++) {
            double factor = *banded_entry(factors, i, k);
            if (factor != 0)
                subtract(m, factor, rhs + k * m, rhs + i * m);
        }
    for (size_t i = n; i-- > 0;) {
        size_t last = i + factors->upper < n ? i + factors->upper : n - 1;
        for (size_t k = i + 1; k <= last; k++) {
            double factor = *banded_entry(factors, i, k);
            if (factor != 0)
                subtract(m, factor, rhs + k * m, rhs + i * m);
        }
        double inverse = 1 / *banded_entry(factors, i, i);
        for (size_t c = 0; c < m; c++)
            rhs[i * m + c] *= inverse;
    }
}
