/* Tables that commands print: CSV, or JSON as {"rows": [{name: value, ...}, ...]}. */
#ifndef GALV_TOOL_RESULTS_H
#define GALV_TOOL_RESULTS_H

#include <stdbool.h>
#include <stddef.h>

/* Columns PREFIX1..PREFIXwidth from `values` (row by row), then `extras` columns with the given
 * names from `more`. Returns an exit code. */
int results_print(bool json, size_t rows, const char *prefix, size_t width, const double *values,
                  size_t extras, const char *const *names, const double *more);

#endif
