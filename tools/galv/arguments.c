#include "arguments.h"

#include "cli.h"
#include "plot/plot.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int arguments_read(int argc, char **argv, const struct settings *table, struct arguments *a)
{
    *a = (struct arguments){.table = table};
    settings_start(table, a);
    int code = settings_options(argc, argv, table, a, NULL, NULL);
    if (code == -1 && a->model && !model_file_read(a->model, &a->file))
        code = CLI_FAILED;
    if (code != -1)
        arguments_free(a);
    return code;
}

void arguments_free(struct arguments *a)
{
    model_file_free(&a->file);
    warnings_free(&a->warnings);
    settings_free(a->table, a);
}

bool arguments_have_parameters(const struct arguments *a)
{
    return a->file.shape.n || cli_refuse("%s: made from snapshots, it has no parameters", a->model);
}

void arguments_either(struct settings_source *source, const char *one, bool has_one,
                      const char *other, bool has_other)
{
    if (has_one == has_other)
        settings_complain(source, one, "%s; give either --%s or --%s",
                          has_one ? "is one of two" : "is missing", one, other);
}

int picture_command(int argc, char **argv, const struct settings *table,
                    bool (*draw)(const struct arguments *))
{
    struct arguments a;
    int code = arguments_read(argc, argv, table, &a);
    if (code != -1)
        return code;
    size_t modes = galv_model_modes(a.file.model);
    if (!plot_check_path("-o", a.output))
        code = CLI_USAGE;
    else if (!draw(&a))
        code = CLI_FAILED;
    else
        code = !a.json ? CLI_OK
                       : json_print(json_pack("{s:s,s:o}", "file", a.output, "modes",
                                              json_whole(a.modes < modes ? a.modes : modes)),
                                    &a.warnings);
    arguments_free(&a);
    return code;
}

static bool from_list(const double *list, size_t n, size_t width, const char *text,
                      struct rows *rows)
{
    if (n > width)
        return cli_refuse("'%s': %zu numbers, expected at most %zu", text, n, width);
    *rows = (struct rows){.count = 1, .width = width, .values = calloc(width, sizeof(double))};
    if (!rows->values)
        return cli_refuse("out of memory");
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
    if ((!named && table->columns != width) || table->rows == 0)
        return cli_refuse("%s: %zu rows of %zu numbers, expected rows of %zu", path, table->rows,
                          table->columns, width);
    *rows = (struct rows){.count = table->rows,
                          .width = width,
                          .values = malloc(table->rows * width * sizeof(double))};
    if (!rows->values)
        return cli_refuse("out of memory");
    for (size_t k = 0; k < width; k++) {
        snprintf(name, sizeof name, "%s%zu", prefix, k + 1);
        int column = named ? cli_table_column(table, name) : (int)k;
        if (column < 0)
            return cli_refuse("%s: column '%s' is missing, expected %s1 to %s%zu", path, name,
                              prefix, prefix, width);
        for (size_t r = 0; r < table->rows; r++)
            rows->values[r * width + k] = table->values[r * table->columns + (size_t)column];
    }
    return true;
}

bool rows_read(const char *text, size_t width, const char *prefix, struct rows *rows)
{
    double *list = NULL;
    size_t n;
    bool ok;
    *rows = (struct rows){.values = NULL};
    if (cli_parse_list(text, &list, &n)) {
        ok = from_list(list, n, width, text, rows);
        free(list);
    } else {
        struct cli_table table;
        if (strcmp(text, "-") != 0 && access(text, F_OK) != 0)
            return cli_refuse("'%s' is neither finite numbers %s1,%s2,... nor a CSV file: %s", text,
                              prefix, prefix, strerror(errno));
        if (!cli_table_read(text, &table))
            return false;
        ok = from_table(&table, width, prefix, text, rows);
        cli_table_free(&table);
    }
    if (!ok)
        rows_free(rows);
    return ok;
}

void rows_free(struct rows *rows)
{
    free(rows->values);
    *rows = (struct rows){.values = NULL};
}

void rows_check_bounds(const struct rows *rows, const char *text,
                       const struct shape_definition *shape, struct warnings *warnings)
{
    size_t outside = 0, first = 0, at = 0;
    for (size_t r = 0; r < rows->count; r++)
        for (size_t k = 0; k < rows->width; k++) {
            double x = rows->values[r * rows->width + k];
            /* ends may be written with fewer digits than they have */
            double slack = 1e-12 * (shape->upper[k] - shape->lower[k]);
            if (x >= shape->lower[k] - slack && x <= shape->upper[k] + slack)
                continue;
            if (outside++ == 0) {
                first = r;
                at = k;
            }
        }
    if (outside)
        warn(warnings,
             "%s: %zu parameters lie outside of their bounds, the first in row %zu: x%zu is %g, "
             "expected from %g to %g",
             text, outside, first + 1, at + 1, rows->values[first * rows->width + at],
             shape->lower[at], shape->upper[at]);
}
