#include "latent_rows.h"

#include "cli.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool from_list(const double *list, size_t n, size_t width, const char *text,
                      struct rows *rows)
{
    if (n > width) {
        cli_fail("'%s': %zu numbers, expected at most %zu", text, n, width);
        return false;
    }
    *rows = (struct rows){.count = 1, .width = width, .values = calloc(width, sizeof(double))};
    if (!rows->values) {
        cli_fail("out of memory");
        return false;
    }
    memcpy(rows->values, list, n * sizeof *list);
    return true;
}

/* Columns by name when the first name is there, else all of them in order. */
static bool from_table(const struct cli_table *table, size_t width, const char *prefix,
                       const char *path, struct rows *rows)
{
    char name[32];
    snprintf(name, sizeof name, "%s1", prefix);
    bool named = cli_table_column(table, name) >= 0;
    if ((!named && table->columns != width) || table->rows == 0) {
        cli_fail("%s: %zu rows of %zu numbers, expected rows of %zu", path, table->rows,
                 table->columns, width);
        return false;
    }
    *rows = (struct rows){.count = table->rows,
                          .width = width,
                          .values = malloc(table->rows * width * sizeof(double))};
    if (!rows->values) {
        cli_fail("out of memory");
        return false;
    }
    for (size_t k = 0; k < width; k++) {
        snprintf(name, sizeof name, "%s%zu", prefix, k + 1);
        int column = named ? cli_table_column(table, name) : (int)k;
        if (column < 0) {
            cli_fail("%s: column '%s' is missing", path, name);
            rows_free(rows);
            return false;
        }
        for (size_t r = 0; r < table->rows; r++)
            rows->values[r * width + k] = table->values[r * table->columns + (size_t)column];
    }
    return true;
}

bool rows_read(const char *text, size_t width, const char *prefix, struct rows *rows)
{
    double *list = NULL;
    size_t n;
    *rows = (struct rows){.values = NULL};
    if (cli_parse_list(text, &list, &n)) {
        bool ok = from_list(list, n, width, text, rows);
        free(list);
        return ok;
    }
    struct cli_table table;
    if (!cli_table_read(text, &table))
        return false;
    bool ok = from_table(&table, width, prefix, text, rows);
    cli_table_free(&table);
    return ok;
}

void rows_free(struct rows *rows)
{
    free(rows->values);
    rows->values = NULL;
}
