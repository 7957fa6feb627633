#include "exterior/sparse.h"

#include <stdlib.h>

void sparse_free(struct sparse *sparse)
{
    free(sparse->start);
    free(sparse->column);
    free(sparse->value);
    *sparse = (struct sparse){0};
}

bool sparse_append(struct sparse *sparse, size_t columns, double *row, size_t *room)
{
    size_t n = sparse->start[sparse->rows];
    for (size_t k = 0; k < columns; k++) {
        if (row[k] == 0.0)
            continue;
        if (n == *room) {
            *room = 2 * *room + 1024;
            size_t *column = realloc(sparse->column, *room * sizeof *column);
            sparse->column = column ? column : sparse->column;
            double *value = realloc(sparse->value, *room * sizeof *value);
            sparse->value = value ? value : sparse->value;
            if (!column || !value)
                return false;
        }
        sparse->column[n] = k;
        sparse->value[n++] = row[k];
        row[k] = 0.0;
    }
    sparse->start[++sparse->rows] = n;
    return true;
}
