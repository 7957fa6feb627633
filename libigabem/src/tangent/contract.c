#include "tangent/contract.h"

#include "core/vector_math.h"
#include "tangent/field.h"

#include <string.h>

/* Sums of one block of fields for several rows of factors, `step` apart. */
VECTOR_MULTIVERSION
static void contract_block(size_t n, const double *factor, size_t step, const double *matrix,
                           size_t width, double sum[CONTRACT_ROWS][FIELD_BLOCK])
{
    double s[CONTRACT_ROWS][FIELD_BLOCK] = {{0}};
    for (size_t k = 0; k < n; k++, matrix += width)
        for (size_t r = 0; r < CONTRACT_ROWS; r++)
            for (size_t l = 0; l < FIELD_BLOCK; l++)
                s[r][l] += factor[r * step + k] * matrix[l];
    memcpy(sum, s, sizeof s);
}

void contract(size_t n, const double *factor, size_t step, const double *matrix, size_t width,
              size_t fields, double *out)
{
    for (size_t first = 0; first < fields; first += FIELD_BLOCK) {
        double sum[CONTRACT_ROWS][FIELD_BLOCK];
        contract_block(n, factor, step, matrix + first, width, sum);
        for (size_t r = 0; r < CONTRACT_ROWS; r++)
            for (size_t l = 0; l < FIELD_BLOCK && first + l < fields; l++)
                out[r * fields + first + l] += sum[r][l];
    }
}
