#include "snapshots.h"

#include "cli.h"
#include "h5.h"

#include <stdlib.h>
#include <string.h>

static bool read_h5(const char *path, const char *dataset, size_t *rows, size_t *columns,
                    double **values)
{
    hid_t h5 = h5_open(path);
    if (h5 < 0)
        return false;
    *values = h5_load_array(h5, dataset, 2, rows, columns);
    H5Fclose(h5);
    return *values || cli_refuse("%s: no dataset '%s' of two dimensions; --dataset names another",
                                 path, dataset);
}

static bool read_csv(const char *path, size_t *rows, size_t *columns, double **values)
{
    struct cli_table table;
    if (!cli_table_read(path, &table))
        return false;
    *rows = table.rows;
    *columns = table.columns;
    *values = table.values;
    table.values = NULL;
    cli_table_free(&table);
    return true;
}

static bool has_suffix(const char *path, const char *suffix)
{
    size_t length = strlen(path), tail = strlen(suffix);
    return length >= tail && strcmp(path + length - tail, suffix) == 0;
}

/* The mean of the variants; a grid if the caller says which. */
static bool take_mean(const struct arguments *a, size_t npoints, const struct snapshots *s,
                      struct hull *parent)
{
    if (a->n_grid && a->grid[0] * a->grid[1] != npoints)
        return cli_refuse("%s: %zu points, expected %zu x %zu", a->snapshots, npoints, a->grid[0],
                          a->grid[1]);
    *parent = (struct hull){.xyz = cli_needed(calloc(3 * npoints, sizeof(double))),
                            .npoints = npoints,
                            .sections = a->grid[0],
                            .girth = a->grid[1]};
    if (!parent->xyz)
        return cli_refuse("out of memory");
    for (size_t r = 0; r < s->count; r++)
        for (size_t i = 0; i < 3 * npoints; i++)
            parent->xyz[i] += s->values[r * 3 * npoints + i] / (double)s->count;
    return true;
}

static void subtract(struct snapshots *s, const struct hull *parent)
{
    for (size_t r = 0; r < s->count; r++)
        for (size_t i = 0; i < 3 * parent->npoints; i++)
            s->values[r * 3 * parent->npoints + i] -= parent->xyz[i];
}

bool snapshots_read(const struct arguments *a, struct hull *parent, struct snapshots *s)
{
    const char *path = a->snapshots;
    size_t columns = 0;
    bool h5 = has_suffix(path, ".h5") || has_suffix(path, ".hdf5");
    if (!(h5 ? read_h5(path, a->dataset, &s->count, &columns, &s->values)
             : read_csv(path, &s->count, &columns, &s->values)))
        return false;
    if (!s->count || !columns || columns % 3)
        return cli_refuse("%s: %zu rows of %zu numbers, expected x, y, z of each point in each row",
                          path, s->count, columns);
    bool ok = a->hull ? hull_read(a->hull, a->grid[0], a->grid[1], parent)
                      : take_mean(a, columns / 3, s, parent);
    if (!ok)
        return false;
    if (columns != 3 * parent->npoints)
        return cli_refuse("%s: %zu points in a row, %s has %zu", path, columns / 3, a->hull,
                          parent->npoints);
    if (!a->displacements)
        subtract(s, parent);
    return true;
}

void snapshots_free(struct snapshots *snapshots)
{
    free(snapshots->values);
    *snapshots = (struct snapshots){.values = NULL};
}
