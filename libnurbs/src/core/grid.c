#include "core/error.h"
#include "core/textfile.h"

#include <nurbs/grid.h>

#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct nurbs_grid {
    size_t rows, columns;
    double *points;
};

nurbs_status nurbs_grid_create(size_t rows, size_t columns, const double *points, nurbs_grid **grid)
{
    NURBS_NEED(grid);
    *grid = NULL;
    if (rows < 2 || columns < 2)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "grid of %zu x %zu points, expected at least 2 x 2",
                          rows, columns);
    if (rows > SIZE_MAX / 24 / columns)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "grid of %zu x %zu points is too large", rows,
                          columns);
    size_t count = 3 * rows * columns;
    for (size_t k = 0; points && k < count; k++)
        if (!isfinite(points[k]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "grid point (%zu,%zu): coordinate %zu is %g",
                              k / 3 / columns + 1, k / 3 % columns + 1, k % 3, points[k]);
    nurbs_grid *made = malloc(sizeof *made);
    double *copy = calloc(count, sizeof *copy);
    if (!made || !copy) {
        free(made);
        free(copy);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a grid of %zu x %zu points", rows,
                          columns);
    }
    if (points)
        memcpy(copy, points, count * sizeof *copy);
    *made = (nurbs_grid){rows, columns, copy};
    *grid = made;
    return NURBS_OK;
}

void nurbs_grid_free(nurbs_grid *grid)
{
    if (grid)
        free(grid->points);
    free(grid);
}

size_t nurbs_grid_rows(const nurbs_grid *grid)
{
    return grid ? grid->rows : 0;
}

size_t nurbs_grid_columns(const nurbs_grid *grid)
{
    return grid ? grid->columns : 0;
}

const double *nurbs_grid_points(const nurbs_grid *grid)
{
    return grid ? grid->points : NULL;
}

double *nurbs_grid_edit(nurbs_grid *grid)
{
    return grid ? grid->points : NULL;
}

nurbs_status nurbs_grid_sample(const nurbs_surface *surface, size_t rows, const double *u,
                               size_t columns, const double *v, nurbs_grid **grid)
{
    NURBS_NEED(surface && u && v && grid);
    nurbs_status status = nurbs_grid_create(rows, columns, NULL, grid);
    if (status != NURBS_OK)
        return status;
    status = nurbs_surface_eval_grid(surface, 0, rows, u, columns, v, (*grid)->points);
    if (status != NURBS_OK) {
        nurbs_grid_free(*grid);
        *grid = NULL;
    }
    return status;
}

/* One line of the table. */
typedef struct entry {
    long i, j;
    double p[3];
    size_t line;
} entry;

static const char *skip_blank(const char *at)
{
    while (*at == ' ' || *at == '\t' || *at == '\r')
        at++;
    return at;
}

/* "i,j,x,y,z" of the header, whatever the case and blanks. */
static int is_header(const char *at)
{
    const char *expected = "i,j,x,y,z";
    for (; *at && *at != '\n'; at++) {
        if (*at == ' ' || *at == '\t' || *at == '\r')
            continue;
        if (tolower((unsigned char)*at) != *expected)
            return 0;
        expected++;
    }
    return *expected == '\0';
}

/* How much of a field is told. */
static int shown(const char *at)
{
    enum { MOST = 30 };
    size_t length = strcspn(at, ",\r\n");
    return length < MOST ? (int)length : MOST;
}

static nurbs_status parse_entry(const char *path, const char *at, size_t line, entry *out)
{
    static const char *const names[5] = {"i", "j", "x", "y", "z"};
    out->line = line;
    for (int k = 0; k < 5; k++) {
        char *end;
        at = skip_blank(at);
        if (*at == '\n' || *at == '\0')
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: column %s is missing", path, line,
                              names[k]);
        if (k < 2) {
            long index = strtol(at, &end, 10);
            if (end == at || index < 1 || index > 1000000)
                return nurbs_fail(NURBS_ERROR_FORMAT,
                                  "%s:%zu: column %s is '%.*s', expected an index from 1 to "
                                  "1000000",
                                  path, line, names[k], shown(at), at);
            *(k == 0 ? &out->i : &out->j) = index;
        } else {
            out->p[k - 2] = strtod(at, &end);
            if (end == at || !isfinite(out->p[k - 2]))
                return nurbs_fail(NURBS_ERROR_FORMAT,
                                  "%s:%zu: column %s is '%.*s', expected a finite number", path,
                                  line, names[k], shown(at), at);
        }
        at = skip_blank(end);
        if (k < 4 && *at != ',')
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: no comma after column %s", path, line,
                              names[k]);
        at += k < 4;
    }
    if (*at != '\n' && *at != '\0')
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: more than the five columns i,j,x,y,z", path,
                          line);
    return NURBS_OK;
}

static nurbs_status parse_table(const char *path, const char *text, entry **entries, size_t *count)
{
    size_t line = 0, room = 0;
    int header = 0;
    *entries = NULL;
    *count = 0;
    for (const char *at = text; *at; line++) {
        const char *first = skip_blank(at), *end = strchr(at, '\n');
        if (*first != '\n' && *first != '\0' && *first != '#') {
            if (!header) {
                if (!is_header(first))
                    return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: expected the header i,j,x,y,z",
                                      path, line + 1);
                header = 1;
            } else {
                if (*count == room) {
                    room = room ? 2 * room : 1024;
                    entry *larger = realloc(*entries, room * sizeof *larger);
                    if (!larger)
                        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu points", path,
                                          room);
                    *entries = larger;
                }
                nurbs_status status = parse_entry(path, first, line + 1, *entries + *count);
                if (status != NURBS_OK)
                    return status;
                ++*count;
            }
        }
        at = end ? end + 1 : at + strlen(at);
    }
    if (*count == 0)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: no points", path);
    return NURBS_OK;
}

static nurbs_status assemble(const char *path, const entry *entries, size_t count,
                             nurbs_grid **grid)
{
    size_t rows = 0, columns = 0;
    for (size_t k = 0; k < count; k++) {
        rows = (size_t)entries[k].i > rows ? (size_t)entries[k].i : rows;
        columns = (size_t)entries[k].j > columns ? (size_t)entries[k].j : columns;
    }
    if (rows * columns != count)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: %zu points, but i up to %zu and j up to %zu ask for %zu", path,
                          count, rows, columns, rows * columns);
    nurbs_status status = nurbs_grid_create(rows, columns, NULL, grid);
    unsigned char *seen = calloc(count, 1);
    if (status == NURBS_OK && !seen)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu points", path, count);
    for (size_t k = 0; k < count && status == NURBS_OK; k++) {
        size_t at = (size_t)(entries[k].i - 1) * columns + (size_t)(entries[k].j - 1);
        if (seen[at])
            status = nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: point (%ld,%ld) is given twice", path,
                                entries[k].line, entries[k].i, entries[k].j);
        seen[at] = 1;
        memcpy((*grid)->points + 3 * at, entries[k].p, sizeof entries[k].p);
    }
    free(seen);
    if (status != NURBS_OK) {
        nurbs_grid_free(*grid);
        *grid = NULL;
    }
    return status;
}

nurbs_status nurbs_grid_read(const char *path, nurbs_grid **grid)
{
    NURBS_NEED(path && grid);
    char *text;
    size_t length, count = 0;
    entry *entries = NULL;
    *grid = NULL;
    nurbs_status status = textfile_read(path, &text, &length);
    if (status != NURBS_OK)
        return status;
    if (strlen(text) != length) {
        status = nurbs_fail(NURBS_ERROR_FORMAT, "%s: byte %zu is zero: not a text file", path,
                            strlen(text));
    } else {
        numeric_locale locale;
        numeric_locale_set(&locale);
        status = parse_table(path, text, &entries, &count);
        numeric_locale_restore(&locale);
    }
    if (status == NURBS_OK)
        status = assemble(path, entries, count, grid);
    free(entries);
    free(text);
    return status;
}

nurbs_status nurbs_grid_write(const nurbs_grid *grid, const char *path)
{
    NURBS_NEED(grid && path);
    outfile file;
    nurbs_status status = outfile_open(&file, path);
    if (status != NURBS_OK)
        return status;
    fprintf(file.stream, "i,j,x,y,z\n");
    for (size_t k = 0; k < grid->rows * grid->columns; k++) {
        const double *p = grid->points + 3 * k;
        fprintf(file.stream, "%zu,%zu,%.17g,%.17g,%.17g\n", k / grid->columns + 1,
                k % grid->columns + 1, p[0], p[1], p[2]);
    }
    return outfile_commit(&file);
}
