/* What the commands of galv print: tables as CSV, figures as JSON, warnings. */
#ifndef GALV_TOOL_OUTPUT_H
#define GALV_TOOL_OUTPUT_H

#include <galv/galv.h>

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

/* What there is to say beside the results. */
struct warnings {
    size_t n;
    char *text[8];
};
/* Says it on stderr and keeps it for the JSON object. */
__attribute__((format(printf, 2, 3))) void warn(struct warnings *warnings, const char *format, ...);
void warnings_free(struct warnings *warnings);

/* JSON has no NaN: figures that are not known are null. */
json_t *json_number(double value);
json_t *json_whole(size_t value);
json_t *json_numbers(size_t n, const double *values);

/* The figures that every command about a model gives. */
json_t *json_model(const galv_model *model);

/* Prints the object with the warnings on stdout and releases it; NULL counts as out of memory.
 * Returns an exit code. */
int json_print(json_t *root, const struct warnings *warnings);
/* Flushes stdout. Returns an exit code. */
int output_end(void);

/* A table, as CSV or as {"rows": [{name: value, ...}, ...]}: columns PREFIX1..PREFIXwidth from
 * `values` (row by row), then `extras` columns with the given names from `more`. Returns an exit
 * code. */
struct table {
    size_t rows, width, extras;
    const char *prefix, *const *names;
    const double *values, *more;
};
int table_print(const struct table *table, bool json, const struct warnings *warnings);

#endif
