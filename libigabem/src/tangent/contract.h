/* Rows of factors times changes along fields, several at once. */
#ifndef CONTRACT_H
#define CONTRACT_H

#include <stddef.h>

enum { CONTRACT_ROWS = 4 };

/* Adds to out[CONTRACT_ROWS][fields] the sums of factor[n], rows of it `step` apart, over rows of
 * matrix[n][width]. */
void contract(size_t n, const double *factor, size_t step, const double *matrix, size_t width,
              size_t fields, double *out);

#endif
