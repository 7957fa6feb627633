/* Derivatives of the rows of a potential's system times its solution, b - A q with q fixed, by all
 * numbers that the shape enters them by: the control values V of the hull's elements
 * (tangent/field.h) and then those of struct shape. */
#ifndef ROW_H
#define ROW_H

#include "influence/influence.h"
#include "tangent/shape.h"

struct rows;

/* hull: of the tangent's mesh, borrowed. */
igabem_status rows_create(const igabem_tangent *tangent, const struct shape *shape,
                          const struct influence *hull, struct rows **rows);
void rows_free(struct rows *rows);

/* Numbers of a row. */
size_t rows_width(const struct rows *rows);

/* Scratch of one thread. */
struct row_work;
struct row_work *row_work_create(const struct rows *rows);
void row_work_free(struct row_work *work);

/* Fills row[width] of unknown i, but for what a change of the lines of the grid takes from it
 * outside of the integrals. */
igabem_status rows_fill(const struct rows *rows, size_t i, struct row_work *work, double *row);

#endif
