/* Rows of numbers that commands take: from the command line or from a CSV file. */
#ifndef GALV_TOOL_LATENT_ROWS_H
#define GALV_TOOL_LATENT_ROWS_H

#include <stdbool.h>
#include <stddef.h>

struct rows {
    size_t count, width;
    double *values;
};

/* TEXT is "u1,u2,..." or the path of a CSV file with `width` columns (in order, or named PREFIX1,
 * PREFIX2, ...). Fewer numbers on the command line are completed by zeros. Prints why on failure.
 */
bool rows_read(const char *text, size_t width, const char *prefix, struct rows *rows);
void rows_free(struct rows *rows);

#endif
