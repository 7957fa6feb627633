/* Sparse matrices by rows, made row after row. */
#ifndef SPARSE_H
#define SPARSE_H

#include <stdbool.h>
#include <stddef.h>

struct sparse {
    size_t rows;
    size_t *start; /* [rows + 1], to be created with room for all rows, the first 0 */
    size_t *column;
    double *value;
};

/* Appends what is not zero of a full row, and clears that; room: of column and value, 0 at first.
 * Returns false when out of memory. */
bool sparse_append(struct sparse *sparse, size_t columns, double *row, size_t *room);

void sparse_free(struct sparse *sparse);

#endif
