#include "hull_grid.h"

#include "cli.h"

#include <math.h>
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

/* Numbers of sections and of points along them are whole and no larger than any grid. */
static bool check_numbers(const char *path, const struct cli_table *table, int column,
                          const char *name)
{
    enum { MOST = 1000000 };
    for (size_t r = 0; column >= 0 && r < table->rows; r++) {
        double value = table->values[r * table->columns + (size_t)column];
        if (!(value >= 0 && value <= MOST && value == floor(value)))
            return cli_refuse("%s:%zu: %s is %.15g, expected a whole number from 0 to %d", path,
                              table->lines[r], name, value, MOST);
    }
    return true;
}

bool hull_grid_read(const char *path, double **xyz, size_t *npoints, size_t *sections,
                    size_t *girth)
{
    struct cli_table table;
    if (!cli_table_read(path, &table))
        return false;
    int ci = cli_table_column(&table, "i"), cj = cli_table_column(&table, "j");
    int c[3] = {cli_table_column(&table, "x"), cli_table_column(&table, "y"),
                cli_table_column(&table, "z")};
    bool ok = c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && table.rows > 0;
    if (!ok)
        cli_fail("%s: expected rows with the columns x, y and z", path);
    ok = ok && check_numbers(path, &table, ci, "i") && check_numbers(path, &table, cj, "j");
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
        find_rectangle(&table, ci, cj, sections, girth);
    cli_table_free(&table);
    return ok;
}
