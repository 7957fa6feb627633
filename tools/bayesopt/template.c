#include "template.h"

#include "cli.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* Index of a name of the given length; d and d + 1 are the id and the level; SIZE_MAX: none. */
static size_t find(const struct names *names, const char *name, size_t length)
{
    for (size_t j = 0; j < names->d; j++)
        if (strlen(names->variables[j]) == length &&
            strncmp(names->variables[j], name, length) == 0)
            return j;
    if (length == 2 && strncmp(name, "id", 2) == 0)
        return names->d;
    return length == 5 && strncmp(name, "level", 5) == 0 ? names->d + 1 : SIZE_MAX;
}

static void write_field(const struct template_values *v, size_t field, FILE *out)
{
    char buffer[VALUE_SIZE];
    if (field < v->names->d)
        fputs(names_value(v->names, field, v->x[field], buffer), out);
    else if (field == v->names->d)
        fprintf(out, "%llu", (unsigned long long)v->id);
    else
        fprintf(out, "%d", v->level);
}

static bool value(void *user_data, const char *name, size_t length, FILE *out)
{
    const struct template_values *v = user_data;
    size_t field = find(v->names, name, length);
    if (field != SIZE_MAX && out)
        write_field(v, field, out);
    return field != SIZE_MAX;
}

void template_write(const char *text, size_t length, const struct template_values *values,
                    FILE *out)
{
    struct template_values v = *values;
    fields_write(text, length, value, &v, out);
}

const char *template_unknown(const char *text, size_t length, const struct names *names,
                             size_t *field)
{
    struct template_values v = {.names = names};
    return fields_unknown(text, length, value, &v, field);
}

bool template_copy(const char *path, const char *folder, const struct template_values *values)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    size_t length;
    char *text = cli_read(path, &length);
    char *to = malloc(strlen(folder) + strlen(name) + 2);
    FILE *out = NULL;
    if (text && to) {
        sprintf(to, "%s/%s", folder, name);
        out = fopen(to, "wbx");
    }
    bool ok = out != NULL;
    if (ok) {
        template_write(text, length, values, out);
        ok = fclose(out) == 0;
    }
    if (!ok)
        cli_fail("%s: %s", text && to ? to : path, strerror(errno));
    free(to);
    free(text);
    return ok;
}
