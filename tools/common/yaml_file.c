#include "yaml_file.h"

#include "cli.h"

#include <ctype.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* libcyaml reports a failure as one message and a backtrace from the innermost field outwards. */
struct report {
    char message[160];
    char field[160]; /* "latent.variance", put together from the backtrace */
    unsigned line;
};

static void prepend_field(struct report *report, const char *name)
{
    char joined[sizeof report->field];
    int length =
        snprintf(joined, sizeof joined, "%s%s%s", name, *report->field ? "." : "", report->field);
    if (length > 0 && (size_t)length < sizeof joined)
        memcpy(report->field, joined, (size_t)length + 1);
}

static void collect(cyaml_log_t level, void *user_data, const char *format, va_list args)
{
    struct report *report = user_data;
    char text[256], name[128];
    unsigned line;
    if (level < CYAML_LOG_ERROR)
        return;
    vsnprintf(text, sizeof text, format, args);
    text[strcspn(text, "\n")] = '\0';
    const char *body = strncmp(text, "Load: ", 6) == 0 ? text + 6 : text;
    if (!*report->message) {
        snprintf(report->message, sizeof report->message, "%.150s", body);
    } else if (sscanf(body, " in mapping field '%127[^']' (line: %u", name, &line) == 2 ||
               sscanf(body, " in sequence entry '%127[^']' (line: %u", name, &line) == 2) {
        prepend_field(report, name);
        if (report->line == 0)
            report->line = line;
    }
}

static char *read_text(const char *path)
{
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return NULL;
    char *text = NULL;
    size_t length = 0, room = 0;
    do {
        if (length + 1 >= room) {
            char *more = realloc(text, room = room ? 2 * room : 8192);
            if (!more)
                break;
            text = more;
        }
        length += fread(text + length, 1, room - length - 1, stream);
    } while (!feof(stream) && !ferror(stream));
    if (text)
        text[length] = '\0';
    fclose(stream);
    return text;
}

/* The next `name:` at or after *position that starts a line or follows one of " {,-". */
static const char *find_key(const char *position, const char *name)
{
    size_t length = strlen(name);
    for (const char *c = position; *c; c++) {
        if (*c == '#') {
            c += strcspn(c, "\n");
            if (!*c)
                return NULL;
        }
        bool starts = c == position || strchr(" \n{,-", c[-1]);
        if (starts && strncmp(c, name, length) == 0 && c[length] == ':')
            return c;
    }
    return NULL;
}

static size_t line_of(const char *text, const char *field)
{
    char name[128];
    const char *position = text;
    while (*field) {
        size_t length = strcspn(field, ".");
        if (length >= sizeof name)
            return 0;
        memcpy(name, field, length);
        name[length] = '\0';
        field += length + (field[length] == '.');
        if (isdigit((unsigned char)*name)) /* entry of a list: the line of the list serves */
            continue;
        position = find_key(position, name);
        if (!position)
            return 0;
    }
    size_t line = 1;
    for (const char *c = text; c < position; c++)
        line += *c == '\n';
    return line;
}

size_t cli_yaml_line(const char *path, const char *field)
{
    char *text = read_text(path);
    size_t line = text ? line_of(text, field) : 0;
    free(text);
    return line;
}

int cli_yaml_fail(const char *path, const char *field, const char *format, ...)
{
    char text[512];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    size_t line = cli_yaml_line(path, field);
    if (line)
        return cli_fail("%s:%zu: %s %s", path, line, field, text);
    return cli_fail("%s: %s %s", path, field, text);
}

/* The place libcyaml gives for unknown and missing fields is that of the field before. */
static void explain(const char *path, cyaml_err_t error, const struct report *report)
{
    const char *colon = strstr(report->message, ": ");
    const char *key = colon ? colon + 2 : "";
    char parent[sizeof report->field];
    if (error == CYAML_ERR_INVALID_KEY) {
        size_t line = cli_yaml_line(path, key);
        cli_fail("%s:%zu: unknown field '%s'", path, line ? line : report->line, key);
    } else if (error == CYAML_ERR_MAPPING_FIELD_MISSING) {
        snprintf(parent, sizeof parent, "%s", report->field);
        cli_fail("%s: required field '%s' is missing%s%s%s", path, key, *parent ? " near '" : "",
                 parent, *parent ? "'" : "");
    } else if (*report->field) {
        cli_fail("%s:%u: field '%s': %s", path, report->line, report->field, report->message);
    } else {
        cli_fail("%s: %s", path, *report->message ? report->message : cyaml_strerror(error));
    }
}

bool cli_yaml_load(const char *path, const cyaml_schema_value_t *schema, void **data)
{
    struct report report = {"", "", 0};
    cyaml_config_t config = {.log_fn = collect,
                             .log_ctx = &report,
                             .mem_fn = cyaml_mem,
                             .log_level = CYAML_LOG_ERROR,
                             .flags = CYAML_CFG_NO_ALIAS};
    *data = NULL;
    FILE *probe = fopen(path, "r");
    if (!probe) {
        cli_fail("%s: %s", path, strerror(errno));
        return false;
    }
    fclose(probe);
    cyaml_err_t error = cyaml_load_file(path, &config, schema, data, NULL);
    if (error == CYAML_OK && *data)
        return true;
    if (error == CYAML_OK)
        cli_fail("%s: empty", path);
    else
        explain(path, error, &report);
    *data = NULL;
    return false;
}

void cli_yaml_free(const cyaml_schema_value_t *schema, void *data)
{
    cyaml_config_t config = {.mem_fn = cyaml_mem};
    if (data)
        cyaml_free(&config, schema, data, 0);
}
