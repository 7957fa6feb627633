#include "hull_grid.h"

#include "cli.h"

#include <stdlib.h>

/* Sections x girth when i,j run over a full rectangle, i slow; 0 otherwise. */
static void find_rectangle(const struct cli_table *table, int ci, int cj, size_t *sections,
                           size_t *girth)
{
    *sections = *girth = 0;
    if (ci < 0 || cj < 0 || table->rows == 0)
        return;
    const double *v = table->values;
    size_t columns = table->columns, n = 1;
    while (n < table->rows && v[n * columns + (size_t)ci] == v[(size_t)ci])
        n++;
    if (table->rows % n)
        return;
    for (size_t r = 0; r < table->rows; r++)
        if (v[r * columns + (size_t)ci] != v[(size_t)ci] + (double)(r / n) ||
            v[r * columns + (size_t)cj] != v[(size_t)cj] + (double)(r % n))
            return;
    *sections = table->rows / n;
    *girth = n;
}

bool hull_grid_read(const char *path, double **xyz, size_t *npoints, size_t *sections,
                    size_t *girth)
{
    struct cli_table table;
    if (!cli_table_read(path, &table))
        return false;
    int c[3] = {cli_table_column(&table, "x"), cli_table_column(&table, "y"),
                cli_table_column(&table, "z")};
    bool ok = c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && table.rows > 0;
    if (!ok)
        cli_fail("%s: expected rows with the columns x, y and z", path);
    *npoints = table.rows;
    *xyz = ok ? malloc(3 * table.rows * sizeof **xyz) : NULL;
    if (ok && !*xyz) {
        cli_fail("out of memory");
        ok = false;
    }
    for (size_t r = 0; ok && r < table.rows; r++)
        for (size_t j = 0; j < 3; j++)
            (*xyz)[3 * r + j] = table.values[r * table.columns + (size_t)c[j]];
    if (ok)
        find_rectangle(&table, cli_table_column(&table, "i"), cli_table_column(&table, "j"),
                       sections, girth);
    cli_table_free(&table);
    return ok;
}
