/* Products of a block of rows with a few vectors: what a pass over the samples consists of. The
 * vectors are the columns of row-major matrices whose rows are padded with zeros to
 * galv_padded(b) numbers. */
#ifndef GALV_PRODUCTS_H
#define GALV_PRODUCTS_H

#include <stddef.h>

/* b rounded up to whole vector registers. */
size_t galv_padded(size_t b);

/* n vectors of `length` numbers, column-major, to the padded form and back. */
void galv_pad(size_t length, size_t b, const double *columns, double *padded);
void galv_unpad(size_t length, size_t b, const double *padded, double *columns);

/* t (count x b) = alpha rows v, with rows count x n row-major and v n x b; t and v padded. */
void galv_rows_times(size_t count, size_t n, double alpha, const double *rows, size_t b,
                     const double *v, double *t);

/* y (n x b) += rows^T t; y and t padded. */
void galv_rows_add_transposed(size_t count, size_t n, const double *rows, size_t b, const double *t,
                              double *y);

#endif
