#include "template.h"

#include "cli.h"

#include <ctype.h>
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

/* Length of what stands between the braces at text[0], if they close on the same line. */
static bool in_braces(const char *text, size_t left, size_t *length)
{
    const char *close = memchr(text, '}', left), *line = memchr(text, '\n', left);
    *length = close ? (size_t)(close - text) - 1 : 0;
    return close && (!line || close < line);
}

static bool is_word(const char *text, size_t length)
{
    bool word = length > 0 && (isalpha((unsigned char)*text) || *text == '_');
    for (size_t i = 0; i < length && word; i++)
        word = isalnum((unsigned char)text[i]) || strchr("_.-", text[i]);
    return word;
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

void template_write(const char *text, size_t length, const struct template_values *values,
                    FILE *out)
{
    for (size_t i = 0; i < length; i++) {
        size_t inside, field = SIZE_MAX;
        if (text[i] == '{' && i + 1 < length && text[i + 1] == '{')
            i++;
        else if (text[i] == '{' && in_braces(text + i, length - i, &inside))
            field = find(values->names, text + i + 1, inside);
        if (field == SIZE_MAX) {
            fputc(text[i], out);
        } else {
            write_field(values, field, out);
            i += inside + 1;
        }
    }
}

const char *template_unknown(const char *text, size_t length, const struct names *names,
                             size_t *field)
{
    for (size_t i = 0; i < length; i++) {
        size_t inside;
        if (text[i] == '{' && i + 1 < length && text[i + 1] == '{') {
            i++;
        } else if (text[i] == '{' && (i == 0 || text[i - 1] != '$') &&
                   in_braces(text + i, length - i, &inside) && is_word(text + i + 1, inside) &&
                   find(names, text + i + 1, inside) == SIZE_MAX) {
            *field = inside + 2;
            return text + i;
        }
    }
    return NULL;
}

char *template_read(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    FILE *out = file ? open_memstream(&text, length) : NULL;
    char buffer[4096];
    size_t n;
    while (out && (n = fread(buffer, 1, sizeof buffer, file)) > 0)
        fwrite(buffer, 1, n, out);
    bool ok = out && !ferror(file);
    if (out && (ferror(out) | (fclose(out) != 0) || !text)) {
        errno = ENOMEM;
        ok = false;
    }
    if (file)
        fclose(file);
    if (ok)
        return text;
    free(text);
    return NULL;
}

bool template_copy(const char *path, const char *folder, const struct template_values *values)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    size_t length;
    char *text = template_read(path, &length);
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
