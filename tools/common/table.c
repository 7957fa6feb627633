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

/* What a message shows of a field: its beginning, without what is not plain text. */
enum { SHOWN = 40 };
static const char *shown(const char *text, char out[SHOWN + 4])
{
    size_t n = 0;
    for (; n < SHOWN && text[n]; n++)
        out[n] = (char)(isprint((unsigned char)text[n]) ? text[n] : '?');
    strcpy(out + n, text[n] ? "..." : "");
    return out;
}

static bool read_row(char *line, const char *path, size_t number, double *row, size_t columns)
{
    size_t k = 0;
    for (char *start = line; start; k++) {
        char *comma = strchr(start, ','), part[SHOWN + 4];
        if (comma)
            *comma = '\0';
        char *text = trim(start);
        if (k < columns && !cli_parse_double(text, &row[k]))
            return cli_refuse("%s:%zu: field %zu is '%s', expected a finite number", path, number,
                              k + 1, shown(text, part));
        start = comma ? comma + 1 : NULL;
    }
    return k == columns || cli_refuse("%s:%zu: %zu fields, expected %zu as in the first line", path,
                                      number, k, columns);
}

/* Far beyond any table of designs or points, far below what would fill a machine. */
static const size_t MOST_LINE = (size_t)16 << 20, MOST_NUMBERS = (size_t)1 << 28;

bool cli_line_read(FILE *stream, const char *path, struct cli_line *line, bool *end)
{
    size_t n = 0;
    int byte;
    line->number++;
    while ((byte = getc_unlocked(stream)) != EOF && byte != '\n') {
        if (byte == '\0')
            return cli_refuse("%s:%zu: holds a zero byte, expected text", path, line->number);
        if (n == MOST_LINE)
            return cli_refuse("%s:%zu: a line of more than %zu bytes, expected a table", path,
                              line->number, MOST_LINE);
        if (n + 1 >= line->room) {
            size_t room = line->room ? 2 * line->room : 256;
            char *more = realloc(line->text, room);
            if (!more)
                return cli_refuse("%s: out of memory", path);
            line->text = more;
            line->room = room;
        }
        line->text[n++] = (char)byte;
    }
    if (byte == EOF && ferror(stream))
        return cli_refuse("%s: %s", path, strerror(errno));
    *end = byte == EOF && n == 0;
    if (n > 0)
        line->text[n] = '\0';
    else if (line->text)
        *line->text = '\0';
    return true;
}

/* Room for one more row. */
static bool add_row(const char *path, size_t *room, struct cli_table *table)
{
    if (table->rows < *room)
        return true;
    size_t rows = *room ? 2 * *room : 256;
    if (rows > MOST_NUMBERS / table->columns)
        return cli_refuse("%s: more than %zu numbers, too many for a table", path,
                          *room * table->columns);
    double *values = realloc(table->values, rows * table->columns * sizeof *values);
    if (values)
        table->values = values;
    size_t *lines = realloc(table->lines, rows * sizeof *lines);
    if (lines)
        table->lines = lines;
    if (!values || !lines)
        return cli_refuse("%s: out of memory", path);
    *room = rows;
    return true;
}

/* Names from the first line, which is left for a row if it is one: a file without a header must not
 * lose it. */
static bool read_first(char *text, const char *path, bool *row, struct cli_table *table)
{
    *row = all_numbers(text);
    return (*row ? skip_header(count_fields(text), table) : read_header(text, table)) ||
           cli_refuse("%s: out of memory", path);
}

static bool read_lines(FILE *stream, const char *path, struct cli_line *line,
                       struct cli_table *table)
{
    size_t room = 0;
    for (bool end = false, row = true;;) {
        if (!cli_line_read(stream, path, line, &end))
            return false;
        if (end)
            return table->names || cli_refuse("%s: empty, expected a header line", path);
        if (!line->text)
            continue;
        bool marked = line->number == 1 && strncmp(line->text, MARK, sizeof MARK - 1) == 0;
        char *text = trim(line->text + (marked ? sizeof MARK - 1 : 0));
        if (*text == '\0' || *text == '#')
            continue;
        if (!table->names && !read_first(text, path, &row, table))
            return false;
        if (!row) { /* was the header */
            row = true;
            continue;
        }
        if (!add_row(path, &room, table))
            return false;
        table->lines[table->rows] = line->number;
        if (!read_row(text, path, line->number, table->values + table->rows * table->columns,
                      table->columns))
            return false;
        table->rows++;
    }
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
    struct cli_line line = {0};
    bool ok = read_lines(stream, standard ? "standard input" : path, &line, table);
    free(line.text);
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
