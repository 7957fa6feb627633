/* Linear systems with a band matrix that is totally positive, as the collocation matrices of
 * B-splines are: elimination without pivoting is stable for them (de Boor and Pinkus 1977). */
#ifndef NURBS_BANDED_H
#define NURBS_BANDED_H

#include <nurbs/status.h>

typedef struct banded {
    size_t n, lower, upper;
    double *a; /* n rows of lower + 1 + upper entries, the diagonal at index `lower` */
} banded;

nurbs_status banded_create(size_t n, size_t lower, size_t upper, banded *matrix);
void banded_free(banded *matrix);

static inline double *banded_entry(const banded *matrix, size_t row, size_t column)
{
    return matrix->a + row * (matrix->lower + 1 + matrix->upper) + (column + matrix->lower - row);
}

/* Replaces the matrix by its factors L U. */
nurbs_status banded_factor(banded *matrix);

/* Solves in place for m right-hand sides: rhs[n][m]. */
void banded_solve(const banded *factors, size_t m, double *rhs);

#endif
