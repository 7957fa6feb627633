/* Part 21 syntax. */
#include "core/error.h"
#include "core/textfile.h"
#include "io/step.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DEPTH = 64 };

void step_report(step_file *file, const char *format, ...)
{
    if (!file->report || file->report_used + 1 >= file->report_size)
        return;
    va_list args;
    va_start(args, format);
    int added = vsnprintf(file->report + file->report_used, file->report_size - file->report_used,
                          format, args);
    va_end(args);
    if (added > 0)
        file->report_used += (size_t)added;
    if (file->report_used >= file->report_size)
        file->report_used = file->report_size - 1;
}

static nurbs_status syntax(const step_file *file, const char *at, const char *what)
{
    char found[24];
    size_t n = 0;
    while (n + 1 < sizeof found && at[n] && at[n] != '\n' && at[n] != '\r') {
        found[n] = isprint((unsigned char)at[n]) ? at[n] : '?';
        n++;
    }
    found[n] = '\0';
    return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: '%s', expected %s", file->path, file->line,
                      n ? found : "the end of the file", what);
}

/* Blanks and comments. */
static const char *skip(step_file *file, const char *at)
{
    for (;;) {
        while (isspace((unsigned char)*at))
            file->line += *at++ == '\n';
        if (at[0] != '/' || at[1] != '*')
            return at;
        for (at += 2; *at && !(at[0] == '*' && at[1] == '/'); at++)
            file->line += *at == '\n';
        at += *at ? 2 : 0;
    }
}

static nurbs_status new_node(step_file *file, step_kind kind, size_t *index)
{
    if (file->nodes == file->node_room) {
        size_t room = file->node_room ? 2 * file->node_room : 1024;
        step_node *larger = realloc(file->node, room * sizeof *larger);
        if (!larger)
            return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu values", file->path, room);
        file->node = larger;
        file->node_room = room;
    }
    *index = file->nodes++;
    file->node[*index] = (step_node){.kind = kind};
    return NURBS_OK;
}

static bool is_name(char c)
{
    return isupper((unsigned char)c) || isdigit((unsigned char)c) || c == '_' || c == '!' ||
           islower((unsigned char)c);
}

/* '...' with '' for a quote. */
static nurbs_status parse_string(step_file *file, const char **at, step_node *node)
{
    const char *from = ++*at;
    while (**at && !(**at == '\'' && (*at)[1] != '\'')) {
        *at += **at == '\'';
        file->line += **at == '\n';
        ++*at;
    }
    if (!**at)
        return syntax(file, *at, "the end of a string");
    node->text = from;
    node->length = (size_t)(*at - from);
    ++*at;
    return NURBS_OK;
}

static nurbs_status parse_number(step_file *file, const char **at, double *value)
{
    char *end;
    *value = strtod(*at, &end);
    /* strtod takes more than a number of Part 21: inf, nan, hexadecimal. */
    for (const char *c = *at; c < end; c++)
        if (!isdigit((unsigned char)*c) && !strchr("+-.eE", *c))
            end = (char *)*at;
    if (end == *at || !isfinite(*value))
        return syntax(file, *at, "a value");
    *at = end;
    return NURBS_OK;
}

static nurbs_status parse_id(step_file *file, const char **at, size_t *id)
{
    const char *digits = ++*at;
    *id = 0;
    while (isdigit((unsigned char)**at) && *at - digits < 18)
        *id = 10 * *id + (size_t)(*(*at)++ - '0');
    return *at == digits || isdigit((unsigned char)**at) ? syntax(file, digits - 1, "#number")
                                                         : NURBS_OK;
}

static nurbs_status parse_list(step_file *file, const char **at, int depth, size_t list);

/* .NAME. or "binary" */
static nurbs_status parse_between(step_file *file, const char **at, char mark, step_node *node)
{
    const char *from = ++*at;
    while (**at && **at != mark && **at != '\n')
        ++*at;
    if (**at != mark)
        return syntax(file, from, "the end of an enumeration or binary value");
    node->text = from;
    node->length = (size_t)(*at - from);
    ++*at;
    return NURBS_OK;
}

static nurbs_status parse_typed(step_file *file, const char **at, int depth, size_t index)
{
    const char *from = *at;
    while (is_name(**at))
        ++*at;
    file->node[index].text = from;
    file->node[index].length = (size_t)(*at - from);
    *at = skip(file, *at);
    if (**at != '(')
        return syntax(file, from, "a value");
    return parse_list(file, at, depth + 1, index);
}

static nurbs_status parse_value(step_file *file, const char **at, int depth, size_t *index)
{
    char c = **at;
    step_kind kind = c == '$'                                        ? STEP_OMITTED
                     : c == '*'                                      ? STEP_DERIVED
                     : c == '\''                                     ? STEP_STRING
                     : c == '.' && !isdigit((unsigned char)(*at)[1]) ? STEP_ENUM
                     : c == '"'                                      ? STEP_BINARY
                     : c == '#'                                      ? STEP_REFERENCE
                     : c == '('                                      ? STEP_LIST
                     : isalpha((unsigned char)c) || c == '!'         ? STEP_TYPED
                                                                     : STEP_NUMBER;
    nurbs_status status = new_node(file, kind, index);
    if (status != NURBS_OK)
        return status;
    step_node *node = &file->node[*index];
    switch (kind) {
    case STEP_OMITTED:
    case STEP_DERIVED:
        ++*at;
        return NURBS_OK;
    case STEP_STRING:
        return parse_string(file, at, node);
    case STEP_ENUM:
        return parse_between(file, at, '.', node);
    case STEP_BINARY:
        return parse_between(file, at, '"', node);
    case STEP_REFERENCE:
        return parse_id(file, at, &node->id);
    case STEP_LIST:
        return parse_list(file, at, depth + 1, *index);
    case STEP_TYPED:
        return parse_typed(file, at, depth, *index);
    default:
        return parse_number(file, at, &node->number);
    }
}

/* "(" values ")" into the children of node `list`. */
static nurbs_status parse_list(step_file *file, const char **at, int depth, size_t list)
{
    size_t last = 0;
    if (depth > MOST_DEPTH)
        return syntax(file, *at, "fewer lists inside each other");
    *at = skip(file, *at + 1);
    while (**at != ')') {
        size_t child = 0;
        nurbs_status status = parse_value(file, at, depth, &child);
        if (status != NURBS_OK)
            return status;
        if (last)
            file->node[last].next = child;
        else
            file->node[list].first = child;
        file->node[list].count++;
        last = child;
        *at = skip(file, *at);
        if (**at == ',')
            *at = skip(file, *at + 1);
        else if (**at != ')')
            return syntax(file, *at, "',' or ')'");
    }
    ++*at;
    return NURBS_OK;
}

/* NAME(...) */
static nurbs_status parse_record(step_file *file, const char **at)
{
    const char *from = *at;
    size_t list = 0;
    while (is_name(**at))
        ++*at;
    size_t length = (size_t)(*at - from);
    *at = skip(file, *at);
    if (length == 0 || **at != '(')
        return syntax(file, from, "NAME(...)");
    nurbs_status status = new_node(file, STEP_LIST, &list);
    if (status == NURBS_OK)
        status = parse_list(file, at, 0, list);
    if (status == NURBS_OK && file->records == file->record_room) {
        size_t room = file->record_room ? 2 * file->record_room : 256;
        step_record *larger = realloc(file->record, room * sizeof *larger);
        if (!larger)
            return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu records", file->path,
                              room);
        file->record = larger;
        file->record_room = room;
    }
    if (status == NURBS_OK)
        file->record[file->records++] = (step_record){from, length, list};
    return status;
}

static nurbs_status new_instance(step_file *file, step_instance **instance)
{
    if (file->count == file->room) {
        size_t room = file->room ? 2 * file->room : 256;
        step_instance *larger = realloc(file->instance, room * sizeof *larger);
        if (!larger)
            return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu instances", file->path,
                              room);
        file->instance = larger;
        file->room = room;
    }
    *instance = &file->instance[file->count++];
    **instance = (step_instance){.line = file->line, .first = file->records};
    return NURBS_OK;
}

/* #id = NAME(...); or #id = (NAME(...) NAME(...)); */
static nurbs_status parse_instance(step_file *file, const char **at)
{
    step_instance *instance = NULL;
    nurbs_status status = new_instance(file, &instance);
    if (status == NURBS_OK)
        status = parse_id(file, at, &instance->id);
    if (status != NURBS_OK)
        return status;
    *at = skip(file, *at);
    if (**at != '=')
        return syntax(file, *at, "'='");
    *at = skip(file, *at + 1);
    if (**at == '(') {
        *at = skip(file, *at + 1);
        while (status == NURBS_OK && **at != ')') {
            status = parse_record(file, at);
            if (status == NURBS_OK)
                *at = skip(file, *at);
        }
        *at += status == NURBS_OK;
    } else {
        status = parse_record(file, at);
    }
    if (status != NURBS_OK)
        return status;
    instance->count = file->records - instance->first;
    *at = skip(file, *at);
    if (**at != ';')
        return syntax(file, *at, "';'");
    ++*at;
    return instance->count ? NURBS_OK : syntax(file, *at, "an entity before it");
}

/* Whether a keyword stands at `at`, not the beginning of a longer one. */
static bool keyword(const char *at, const char *word)
{
    size_t n = strlen(word);
    return strncmp(at, word, n) == 0 && !is_name(at[n]) && at[n] != '-';
}

/* Everything up to the next DATA; strings skipped whole. FILE_SCHEMA is kept for the report. */
static nurbs_status find_data(step_file *file, const char **at)
{
    while (**at && !keyword(*at, "DATA")) {
        if (keyword(*at, "FILE_SCHEMA")) {
            const char *quote = strchr(*at, '\'');
            size_t n = quote ? strcspn(quote + 1, "' {\n") : 0;
            if (n < sizeof file->schema && quote) {
                memcpy(file->schema, quote + 1, n);
                file->schema[n] = '\0';
            }
        }
        if (**at == '\'') {
            step_node string;
            nurbs_status status = parse_string(file, at, &string);
            if (status != NURBS_OK)
                return status;
            continue;
        }
        while (is_name(**at))
            ++*at;
        if (**at && !is_name(**at) && **at != '\'' && !isspace((unsigned char)**at) && **at != '/')
            ++*at;
        else if (**at == '/' && (*at)[1] != '*')
            ++*at;
        *at = skip(file, *at);
    }
    return NURBS_OK;
}

static nurbs_status parse_data(step_file *file, const char **at)
{
    size_t list = 0;
    *at = skip(file, *at + 4);
    nurbs_status status = NURBS_OK;
    if (**at == '(') { /* the parameters of a data section of the third edition */
        status = new_node(file, STEP_LIST, &list);
        if (status == NURBS_OK)
            status = parse_list(file, at, 0, list);
        if (status == NURBS_OK)
            *at = skip(file, *at);
    }
    if (status == NURBS_OK && **at != ';')
        return syntax(file, *at, "';'");
    for (*at = skip(file, *at + (status == NURBS_OK)); status == NURBS_OK && **at == '#';
         *at = skip(file, *at))
        status = parse_instance(file, at);
    if (status == NURBS_OK && !keyword(*at, "ENDSEC"))
        return syntax(file, *at, "#number or ENDSEC");
    return status;
}

static int by_id(const void *a, const void *b)
{
    size_t x = ((const step_instance *)a)->id, y = ((const step_instance *)b)->id;
    return (x > y) - (x < y);
}

static nurbs_status parse(step_file *file)
{
    size_t none;
    const char *at = file->text;
    file->line = 1;
    if (strncmp(at, "\xef\xbb\xbf", 3) == 0)
        at += 3;
    at = skip(file, at);
    if (strncmp(at, "ISO-10303-21", 12) != 0)
        return syntax(file, at, "ISO-10303-21: not a STEP file");
    nurbs_status status = new_node(file, STEP_OMITTED, &none);
    while (status == NURBS_OK) {
        status = find_data(file, &at);
        if (status != NURBS_OK || !*at)
            break;
        status = parse_data(file, &at);
    }
    if (status == NURBS_OK && !strstr(file->text, "END-ISO-10303-21"))
        status =
            nurbs_fail(NURBS_ERROR_FORMAT, "%s: no END-ISO-10303-21: the file is cut", file->path);
    if (status != NURBS_OK)
        return status;
    if (file->count == 0)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: no data", file->path);
    qsort(file->instance, file->count, sizeof *file->instance, by_id);
    for (size_t k = 1; k < file->count; k++)
        if (file->instance[k].id == file->instance[k - 1].id)
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: #%zu is there twice", file->path,
                              file->instance[k].line, file->instance[k].id);
    return NURBS_OK;
}

nurbs_status step_open(const char *path, step_file *file)
{
    size_t length;
    file->path = path;
    file->metres = file->radians = 1;
    nurbs_status status = textfile_read(path, &file->text, &length);
    if (status == NURBS_OK && strlen(file->text) != length)
        status = nurbs_fail(NURBS_ERROR_FORMAT, "%s: byte %zu is zero: not a STEP file", path,
                            strlen(file->text));
    return status == NURBS_OK ? parse(file) : status;
}

void step_close(step_file *file)
{
    free(file->instance);
    free(file->record);
    free(file->node);
    free(file->text);
}
