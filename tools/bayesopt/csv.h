/* CSV tables of texts: a header line, fields that may be quoted, '#' lines as comments. */
#ifndef BAYESOPT_TOOL_CSV_H
#define BAYESOPT_TOOL_CSV_H

#include <stdbool.h>
#include <stddef.h>

struct csv {
    const char *path;
    size_t rows, columns;
    char **cells;  /* [(rows + 1) x columns], the header first; blanks around them cut off */
    size_t *lines; /* [rows] where each stood in the file, from 1 */
};

/* PATH "-" reads standard input. Prints the sentence with the line at fault on failure. */
bool csv_read(const char *path, struct csv *csv);
void csv_free(struct csv *csv);

/* Index of a column; SIZE_MAX: there is none. */
size_t csv_column(const struct csv *csv, const char *name);
/* The same, or a sentence. */
bool csv_need(const struct csv *csv, const char *name, size_t *column);
const char *csv_cell(const struct csv *csv, size_t row, size_t column);
/* A cell as a number, nan and inf among them, or a sentence with line and column. */
bool csv_number(const struct csv *csv, size_t row, size_t column, double *value);
/* The same as a value of variable j, which may have labels. */
struct names;
bool csv_value(const struct csv *csv, size_t row, size_t column, const struct names *names,
               size_t j, double *value);
/* A column for every variable: x [rows x d]. */
bool csv_points(const struct csv *csv, const struct names *names, double *x);

#endif
