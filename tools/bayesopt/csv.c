#include "csv.h"

#include "cli.h"
#include "names.h"

#include <ctype.h>
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The field at *at, taken out of its quotes in place; *at goes behind its comma, or becomes NULL at
 * the end of the line. NULL: a quotation that does not end. */
static char *next_field(char **at)
{
    char *start = *at + strspn(*at, " \t"), *to = start, *from = start, *field = start;
    if (*from == '"') {
        for (from++; *from && (*from != '"' || from[1] == '"'); from++) {
            from += *from == '"';
            *to++ = *from;
        }
        if (!*from)
            return NULL;
        from++;
        from += strcspn(from, ",");
    } else {
        size_t length = strcspn(from, ",");
        to = from += length;
        while (to > field && isspace((unsigned char)to[-1]))
            to--;
    }
    *at = *from ? from + 1 : NULL;
    *to = '\0';
    return field;
}

/* Far beyond any history, far below what would fill a machine. */
static const size_t MOST_CELLS = (size_t)1 << 24;

static bool add_row(struct csv *csv, size_t line, char *text)
{
    bool header = csv->columns == 0;
    for (const char *c = text; *c && header; c++)
        csv->columns += *c == ',';
    csv->columns += header;
    size_t rows = header ? 0 : csv->rows + 1, k = 0;
    if ((rows + 1) * csv->columns > MOST_CELLS)
        return cli_refuse("%s:%zu: more than %zu fields, too many for a table", csv->path, line,
                          MOST_CELLS);
    char **more = realloc(csv->cells, (rows + 1) * csv->columns * sizeof *more);
    if (more)
        csv->cells = more;
    size_t *lines = realloc(csv->lines, (rows + 1) * sizeof *lines);
    if (lines)
        csv->lines = lines;
    if (!more || !lines)
        return cli_refuse("out of memory");
    char **cells = csv->cells + rows * csv->columns;
    memset(cells, 0, csv->columns * sizeof *cells);
    if (!header)
        csv->lines[csv->rows++] = line;
    for (char *at = text; at; k++) {
        char *field = next_field(&at);
        if (!field)
            return cli_refuse("%s:%zu: a quotation without an end", csv->path, line);
        if (k < csv->columns && !(cells[k] = strdup(field)))
            return cli_refuse("out of memory");
    }
    return k == csv->columns || cli_refuse("%s:%zu: %zu fields, expected %zu as in the header",
                                           csv->path, line, k, csv->columns);
}

bool csv_read(const char *path, struct csv *csv)
{
    bool standard = strcmp(path, "-") == 0, ok = true;
    *csv = (struct csv){.path = standard ? "standard input" : path};
    FILE *file = standard ? stdin : fopen(path, "r");
    struct cli_line line = {0};
    bool end = false;
    if (!file)
        return cli_refuse("%s: %s", path, strerror(errno));
    while ((ok = ok && cli_line_read(file, csv->path, &line, &end)) && !end) {
        size_t length = line.text ? strlen(line.text) : 0;
        while (length && isspace((unsigned char)line.text[length - 1]))
            line.text[--length] = '\0';
        if (length && line.text[strspn(line.text, " \t")] != '#')
            ok = add_row(csv, line.number, line.text);
    }
    if (ok && !csv->columns)
        ok = cli_refuse("%s: empty, expected a header line", csv->path);
    free(line.text);
    if (!standard)
        fclose(file);
    if (!ok)
        csv_free(csv);
    return ok;
}

void csv_free(struct csv *csv)
{
    for (size_t i = 0; csv->cells && i < (csv->rows + 1) * csv->columns; i++)
        free(csv->cells[i]);
    free(csv->cells);
    free(csv->lines);
    *csv = (struct csv){0};
}

size_t csv_column(const struct csv *csv, const char *name)
{
    for (size_t k = 0; k < csv->columns; k++)
        if (strcmp(csv->cells[k], name) == 0)
            return k;
    return SIZE_MAX;
}

bool csv_need(const struct csv *csv, const char *name, size_t *column)
{
    *column = csv_column(csv, name);
    return *column != SIZE_MAX || cli_refuse("%s: expected a column '%s'", csv->path, name);
}

const char *csv_cell(const struct csv *csv, size_t row, size_t column)
{
    return csv->cells[(row + 1) * csv->columns + column];
}

bool csv_number(const struct csv *csv, size_t row, size_t column, double *value)
{
    const char *text = csv_cell(csv, row, column);
    char *end;
    *value = strtod(text, &end);
    return (end != text && *end == '\0') ||
           cli_refuse("%s:%zu: %s is '%s', expected a number", csv->path, csv->lines[row],
                      csv->cells[column], text);
}

bool csv_value(const struct csv *csv, size_t row, size_t column, const struct names *names,
               size_t j, double *value)
{
    if (!names->labels || !names->labels[j].n)
        return csv_number(csv, row, column, value);
    const char *text = csv_cell(csv, row, column);
    return names_parse(names, j, text, value) ||
           cli_refuse("%s:%zu: %s is '%s', expected one of its values", csv->path, csv->lines[row],
                      names->variables[j], text);
}

bool csv_points(const struct csv *csv, const struct names *names, double *x)
{
    size_t column;
    bool ok = true;
    for (size_t j = 0; j < names->d && ok; j++) {
        ok = csv_need(csv, names->variables[j], &column);
        for (size_t i = 0; i < csv->rows && ok; i++)
            ok = csv_value(csv, i, column, names, j, &x[i * names->d + j]);
    }
    return ok;
}
