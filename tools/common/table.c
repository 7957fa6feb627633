#include "cli.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* The byte order mark that some programs begin a file with. */
static const char MARK[] = "\xEF\xBB\xBF";

static char *trim(char *text)
{
    while (isspace((unsigned char)*text))
        text++;
    char *end = text + strlen(text);
    while (end > text && isspace((unsigned char)end[-1]))
        *--end = '\0';
    return text;
}

static size_t count_fields(const char *line)
{
    size_t n = 1;
    for (const char *c = line; *c; c++)
        n += *c == ',';
    return n;
}

/* Whether a first line is a row already: a file without a header must not lose it. */
static bool all_numbers(const char *line)
{
    double value;
    char *copy = strdup(line);
    bool ok = copy != NULL;
    for (char *start = copy; start && ok;) {
        char *comma = strchr(start, ',');
        if (comma)
            *comma = '\0';
        ok = cli_parse_double(trim(start), &value);
        start = comma ? comma + 1 : NULL;
    }
    free(copy);
    return ok;
}

/* Columns that have no names. */
static bool skip_header(size_t columns, struct cli_table *table)
{
    table->names = calloc(columns, sizeof *table->names);
    if (!table->names)
        return false;
    while (table->columns < columns)
        if (!(table->names[table->columns++] = strdup("")))
            return false;
    return true;
}

static bool read_header(char *line, struct cli_table *table)
{
    size_t most = count_fields(line);
    table->names = calloc(most, sizeof *table->names);
    if (!table->names)
        return false;
    for (char *start = line; start;) {
        char *comma = strchr(start, ',');
        if (comma)
            *comma = '\0';
        table->names[table->columns] = strdup(trim(start));
        if (!table->names[table->columns++])
            return false;
        start = comma ? comma + 1 : NULL;
    }
    return true;
}

static bool read_row(char *line, const char *path, size_t number, double *row, size_t columns)
{
    size_t k = 0;
    for (char *start = line; start; k++) {
        char *comma = strchr(start, ',');
        if (comma)
            *comma = '\0';
        char *text = trim(start);
        if (k < columns && !cli_parse_double(text, &row[k])) {
            cli_fail("%s:%zu: field %zu is '%s', expected a finite number", path, number, k + 1,
                     text);
            return false;
        }
        start = comma ? comma + 1 : NULL;
    }
    if (k != columns) {
        cli_fail("%s:%zu: %zu fields, expected %zu as in the first line", path, number, k, columns);
        return false;
    }
    return true;
}

static bool read_stream(FILE *stream, const char *path, struct cli_table *table)
{
    char *line = NULL;
    size_t capacity = 0, number = 0, room = 0;
    bool ok = true;
    while (ok && getline(&line, &capacity, stream) >= 0) {
        number++;
        char *text =
            trim(number == 1 && strncmp(line, MARK, sizeof MARK - 1) == 0 ? line + sizeof MARK - 1
                                                                          : line);
        if (*text == '\0' || *text == '#')
            continue;
        if (!table->names) {
            bool row = all_numbers(text);
            ok = (row ? skip_header(count_fields(text), table) : read_header(text, table)) ||
                 cli_refuse("out of memory");
            if (!row || !ok)
                continue;
        }
        if (table->rows == room) {
            room = room ? 2 * room : 256;
            double *more = realloc(table->values, room * table->columns * sizeof *more);
            if (more)
                table->values = more;
            size_t *lines = realloc(table->lines, room * sizeof *lines);
            if (lines)
                table->lines = lines;
            if (!more || !lines) {
                cli_fail("out of memory");
                ok = false;
                break;
            }
        }
        table->lines[table->rows] = number;
        ok = read_row(text, path, number, table->values + table->rows * table->columns,
                      table->columns);
        table->rows += ok;
    }
    if (ok && ferror(stream)) {
        cli_fail("%s: %s", path, strerror(errno));
        ok = false;
    }
    if (ok && !table->names) {
        cli_fail("%s: empty, expected a header line", path);
        ok = false;
    }
    free(line);
    return ok;
}

bool cli_table_read(const char *path, struct cli_table *table)
{
    *table = (struct cli_table){0};
    bool standard = strcmp(path, "-") == 0;
    FILE *stream = standard ? stdin : fopen(path, "r");
    if (!stream) {
        cli_fail("%s: %s", path, strerror(errno));
        return false;
    }
    bool ok = read_stream(stream, standard ? "standard input" : path, table);
    if (!standard)
        fclose(stream);
    if (!ok)
        cli_table_free(table);
    return ok;
}

void cli_table_free(struct cli_table *table)
{
    for (size_t i = 0; i < table->columns; i++)
        free(table->names[i]);
    free(table->names);
    free(table->values);
    free(table->lines);
    *table = (struct cli_table){0};
}

int cli_table_column(const struct cli_table *table, const char *name)
{
    for (size_t i = 0; i < table->columns; i++)
        if (strcmp(table->names[i], name) == 0)
            return (int)i;
    return -1;
}
