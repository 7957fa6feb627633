#include "core/error.h"
#include "core/textfile.h"
#include "io/iges.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 72, DATA_COLUMNS = 64, FIELD = 8 };

void iges_report(iges_file *file, const char *format, ...)
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

/* The lines of one section, one after the other, each padded with blanks to `columns`. */
typedef struct section {
    char letter;
    size_t columns, lines;
    char *text;
} section;

enum { START, GLOBAL, DIRECTORY, PARAMETER, TERMINATE, SECTIONS };

static nurbs_status split_sections(const iges_file *file, section parts[SECTIONS])
{
    static const char letters[SECTIONS] = {'S', 'G', 'D', 'P', 'T'};
    size_t total = 1, number = 0;
    for (const char *at = file->text; *at; at++)
        total += *at == '\n';
    for (int k = 0; k < SECTIONS; k++) {
        parts[k] = (section){letters[k], k == PARAMETER ? DATA_COLUMNS : COLUMNS, 0,
                             malloc(total * COLUMNS + 1)};
        if (!parts[k].text)
            return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu lines", file->path, total);
    }
    for (const char *at = file->text, *next; *at; at = next) {
        const char *end = at + strcspn(at, "\n");
        next = *end ? end + 1 : end;
        number++;
        while (end > at && (end[-1] == '\r' || end[-1] == ' '))
            end--;
        if (end == at)
            continue;
        int k = SECTIONS;
        if (end - at > COLUMNS)
            for (k = 0; k < SECTIONS && at[COLUMNS] != letters[k]; k++)
                ;
        if (k == SECTIONS)
            return nurbs_fail(NURBS_ERROR_FORMAT,
                              "%s:%zu: no section letter S, G, D, P or T in column 73", file->path,
                              number);
        memcpy(parts[k].text + parts[k].lines * parts[k].columns, at, parts[k].columns);
        parts[k].lines++;
    }
    for (int k = 0; k < SECTIONS; k++)
        parts[k].text[parts[k].lines * parts[k].columns] = '\0';
    return NURBS_OK;
}

/* Length of a Hollerith string "nH...", its count included, or 0. */
static size_t hollerith(const char *at, const char *end)
{
    size_t digits = 0, length = 0;
    while (at + digits < end && isdigit((unsigned char)at[digits]) && digits < 6)
        length = 10 * length + (size_t)(at[digits++] - '0');
    if (digits == 0 || at + digits >= end || at[digits] != 'H')
        return 0;
    length += digits + 1;
    return length <= (size_t)(end - at) ? length : (size_t)(end - at);
}

/* Splits text up to the record delimiter. *next gets the place behind it, or NULL if there is none.
 */
static nurbs_status split_record(const iges_file *file, const char *at, const char *end,
                                 iges_record *record, const char **next)
{
    size_t room = 0;
    *record = (iges_record){0};
    *next = NULL;
    for (;;) {
        while (at < end && *at == ' ')
            at++;
        const char *first = at;
        at += hollerith(at, end);
        while (at < end && *at != file->parameter_delimiter && *at != file->record_delimiter)
            at++;
        const char *last = at;
        while (last > first && last[-1] == ' ')
            last--;
        if (record->count == room) {
            room = room ? 2 * room : 16;
            const char **field = realloc(record->field, room * sizeof *field);
            if (field)
                record->field = field;
            size_t *length = realloc(record->length, room * sizeof *length);
            if (length)
                record->length = length;
            if (!field || !length)
                return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu parameters",
                                  file->path, room);
        }
        record->field[record->count] = first;
        record->length[record->count++] = (size_t)(last - first);
        if (at == end)
            return NURBS_OK;
        if (*at++ == file->record_delimiter) {
            *next = at;
            return NURBS_OK;
        }
    }
}

/* "1.5D+00" is a number in IGES; strtod knows E only. */
static int parse_real(const char *field, size_t length, double *value)
{
    char copy[64], *end;
    if (length == 0 || length >= sizeof copy)
        return 0;
    for (size_t k = 0; k < length; k++) {
        char c = field[k];
        if (!isdigit((unsigned char)c) && !strchr("+-.eEdD", c))
            return 0;
        copy[k] = c == 'D' || c == 'd' ? 'E' : c;
    }
    copy[length] = '\0';
    *value = strtod(copy, &end);
    return *end == '\0' && end != copy && isfinite(*value);
}

static nurbs_status wrong_parameter(const iges_file *file, size_t entity, size_t k,
                                    const char *expected)
{
    const iges_record *record = &file->entity[entity].record;
    return nurbs_fail(NURBS_ERROR_FORMAT,
                      "%s: entity %d at D%zu: parameter %zu is '%.*s', expected %s", file->path,
                      file->entity[entity].type, iges_number(entity), k + 1,
                      (int)(record->length[k + 1] < 40 ? record->length[k + 1] : 40),
                      record->field[k + 1], expected);
}

size_t iges_parameters(const iges_file *file, size_t entity)
{
    return file->entity[entity].record.count - 1;
}

nurbs_status iges_real(const iges_file *file, size_t entity, size_t k, double missing,
                       double *value)
{
    const iges_record *record = &file->entity[entity].record;
    *value = missing;
    if (k + 1 >= record->count || record->length[k + 1] == 0)
        return NURBS_OK;
    return parse_real(record->field[k + 1], record->length[k + 1], value)
               ? NURBS_OK
               : wrong_parameter(file, entity, k, "a number");
}

nurbs_status iges_integer(const iges_file *file, size_t entity, size_t k, long missing, long *value)
{
    double real;
    nurbs_status status = iges_real(file, entity, k, (double)missing, &real);
    if (status != NURBS_OK)
        return status;
    if (real != floor(real) || fabs(real) > 1e9)
        return wrong_parameter(file, entity, k, "an integer");
    *value = (long)real;
    return NURBS_OK;
}

nurbs_status iges_pointer(const iges_file *file, size_t entity, size_t k, size_t *index)
{
    long number = 0;
    nurbs_status status = iges_integer(file, entity, k, 0, &number);
    if (status != NURBS_OK)
        return status;
    if (number < 1 || number % 2 == 0 || (size_t)number / 2 >= file->count)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: entity %d at D%zu: parameter %zu points to D%ld, which is not there",
                          file->path, file->entity[entity].type, iges_number(entity), k + 1,
                          number);
    *index = (size_t)number / 2;
    return NURBS_OK;
}

static double global_real(const iges_file *file, size_t k, double missing)
{
    double value;
    if (k >= file->global.count ||
        !parse_real(file->global.field[k], file->global.length[k], &value))
        return missing;
    return value;
}

/* Fields 14 and 15: unit flag and name; 13: model space scale (a model at 0.125 is eight times as
 * large in the world). */
static nurbs_status find_unit(iges_file *file)
{
    static const struct {
        int flag;
        const char *name;
        double metres;
    } units[] = {{1, "IN", 0.0254},   {1, "INCH", 0.0254}, {2, "MM", 1e-3},     {4, "FT", 0.3048},
                 {5, "MI", 1609.344}, {6, "M", 1},         {7, "KM", 1e3},      {8, "MIL", 2.54e-5},
                 {9, "UM", 1e-6},     {10, "CM", 1e-2},    {11, "UIN", 2.54e-8}};
    int flag = (int)global_real(file, 13, 1);
    char name[16] = "";
    if (file->global.count > 14) {
        const char *field = file->global.field[14],
                   *mark = memchr(field, 'H', file->global.length[14]);
        size_t length = mark ? file->global.length[14] - (size_t)(mark + 1 - field) : 0;
        for (size_t k = 0; mark && k < length && k + 1 < sizeof name; k++) {
            name[k] = (char)toupper((unsigned char)mark[1 + k]);
            name[k + 1] = '\0';
        }
    }
    file->metres = 0;
    for (size_t k = 0; k < sizeof units / sizeof units[0] && file->metres == 0; k++)
        if (flag == 3 ? strcmp(name, units[k].name) == 0 : flag == units[k].flag)
            file->metres = units[k].metres;
    if (file->metres == 0)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: unknown unit: flag %d, name '%s'", file->path,
                          flag, name);
    double scale = global_real(file, 12, 1);
    if (!(scale > 0))
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: model space scale %g, expected > 0", file->path,
                          scale);
    if (scale != 1)
        iges_report(file, "model space scale %g applied; ", scale);
    file->metres /= scale;
    return NURBS_OK;
}

/* Fields 1 and 2 of the global section declare the delimiters: "1H,,1H;,", or are empty. */
static nurbs_status parse_global(iges_file *file, const char *text)
{
    const char *at = text, *next;
    file->parameter_delimiter = ',';
    file->record_delimiter = ';';
    while (*at == ' ')
        at++;
    if (strncmp(at, "1H", 2) == 0 && at[2]) {
        file->parameter_delimiter = at[2];
        at += 3;
    }
    if (*at != file->parameter_delimiter)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: the global section does not start with its delimiters", file->path);
    at++;
    while (*at == ' ')
        at++;
    if (strncmp(at, "1H", 2) == 0 && at[2])
        file->record_delimiter = at[2];
    nurbs_status status = split_record(file, text, text + strlen(text), &file->global, &next);
    if (status != NURBS_OK)
        return status;
    if (!next)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: the global section has no end", file->path);
    return NURBS_OK;
}

static nurbs_status directory_field(const iges_file *file, const char *line, size_t number,
                                    size_t field, long *value)
{
    char copy[FIELD + 1], *end;
    memcpy(copy, line + FIELD * field, FIELD);
    copy[FIELD] = '\0';
    *value = strtol(copy, &end, 10);
    while (*end == ' ')
        end++;
    if (*end != '\0')
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: directory line %zu, columns %zu-%zu: '%s'",
                          file->path, number, FIELD * field + 1, FIELD * field + FIELD, copy);
    return NURBS_OK;
}

static nurbs_status parse_entity(iges_file *file, const char *lines, size_t index)
{
    long type, first, transformation, form, status_number, lines_used;
    size_t number = iges_number(index);
    nurbs_status status = directory_field(file, lines, number, 0, &type);
    if (status == NURBS_OK)
        status = directory_field(file, lines, number, 1, &first);
    if (status == NURBS_OK)
        status = directory_field(file, lines, number, 6, &transformation);
    if (status == NURBS_OK)
        status = directory_field(file, lines, number, 8, &status_number);
    if (status == NURBS_OK)
        status = directory_field(file, lines + COLUMNS, number + 1, 3, &lines_used);
    if (status == NURBS_OK)
        status = directory_field(file, lines + COLUMNS, number + 1, 4, &form);
    if (status != NURBS_OK)
        return status;
    if (first < 1 || (size_t)first > file->parameter_lines)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: entity %ld at D%zu: its parameters begin at P%ld, but the file has "
                          "%zu parameter lines",
                          file->path, type, number, first, file->parameter_lines);
    if (transformation < 0 || (transformation > 0 && transformation % 2 == 0) ||
        (size_t)transformation / 2 >= file->count)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: entity %ld at D%zu: transformation D%ld is not there", file->path,
                          type, number, transformation);
    iges_entity *entity = &file->entity[index];
    entity->type = (int)type;
    entity->form = (int)form;
    entity->first_line = (size_t)first - 1;
    entity->transformation = transformation ? (size_t)transformation / 2 + 1 : 0;
    entity->dependent = (int)(status_number / 10000 % 100);
    entity->blank = status_number / 1000000 % 100 == 1;
    size_t last = lines_used > 0 ? entity->first_line + (size_t)lines_used : file->parameter_lines;
    if (last > file->parameter_lines)
        last = file->parameter_lines;
    const char *next;
    status = split_record(file, file->parameters + DATA_COLUMNS * entity->first_line,
                          file->parameters + DATA_COLUMNS * last, &entity->record, &next);
    if (status != NURBS_OK)
        return status;
    double stated;
    if (!next)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: entity %ld at D%zu: its parameters have no end: the file is cut",
                          file->path, type, number);
    if (!parse_real(entity->record.field[0], entity->record.length[0], &stated) ||
        stated != (double)type)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: entity %ld at D%zu: its parameters at P%ld begin with '%.*s'",
                          file->path, type, number, first,
                          (int)(entity->record.length[0] < 20 ? entity->record.length[0] : 20),
                          entity->record.field[0]);
    return NURBS_OK;
}

static nurbs_status parse_directory(iges_file *file, const section *directory)
{
    if (directory->lines % 2)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: odd number %zu of directory lines", file->path,
                          directory->lines);
    file->entity = calloc(directory->lines / 2 + 1, sizeof *file->entity);
    if (!file->entity)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu entities", file->path,
                          directory->lines / 2);
    file->count = directory->lines / 2;
    for (size_t k = 0; k < file->count; k++) {
        nurbs_status status = parse_entity(file, directory->text + 2 * COLUMNS * k, k);
        if (status != NURBS_OK)
            return status;
    }
    return NURBS_OK;
}

static void free_record(iges_record *record)
{
    free(record->field);
    free(record->length);
    *record = (iges_record){0};
}

nurbs_status iges_open(const char *path, iges_file *file)
{
    size_t length;
    section parts[SECTIONS] = {{0}};
    file->path = path;
    nurbs_status status = textfile_read(path, &file->text, &length);
    if (status != NURBS_OK)
        return status;
    if (strlen(file->text) != length)
        status = nurbs_fail(NURBS_ERROR_FORMAT, "%s: byte %zu is zero: not an ASCII IGES file",
                            path, strlen(file->text));
    if (status == NURBS_OK)
        status = split_sections(file, parts);
    if (status == NURBS_OK && parts[TERMINATE].lines == 0)
        status = nurbs_fail(NURBS_ERROR_FORMAT,
                            "%s: no terminate section: the file is cut or not an IGES file", path);
    if (status == NURBS_OK) {
        file->parameters = parts[PARAMETER].text;
        file->parameter_lines = parts[PARAMETER].lines;
        parts[PARAMETER].text = NULL;
        status = parse_global(file, parts[GLOBAL].text);
    }
    if (status == NURBS_OK)
        status = find_unit(file);
    free_record(&file->global);
    if (status == NURBS_OK)
        status = parse_directory(file, &parts[DIRECTORY]);
    for (int k = 0; k < SECTIONS; k++)
        free(parts[k].text);
    return status;
}

void iges_close(iges_file *file)
{
    for (size_t k = 0; k < file->count; k++)
        free_record(&file->entity[k].record);
    free(file->entity);
    free(file->parameters);
    free(file->text);
}
