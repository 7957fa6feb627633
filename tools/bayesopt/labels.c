/* Values that have names: how they are kept, printed and read. */
#include "json_result.h"
#include "names.h"
#include "text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One text: the labels of a variable, a line each. */
static bool join_labels(const struct labels *labels, char **joined)
{
    size_t size;
    FILE *out = text_open(joined, &size);
    for (size_t i = 0; out && i < labels->n; i++)
        fprintf(out, "%s%s", i ? "\n" : "", labels->texts[i]);
    return (out && text_close(out, joined)) || cli_refuse("out of memory");
}

static bool split_labels(char *joined, struct labels *labels)
{
    labels->texts = calloc(strlen(joined) + 1, sizeof *labels->texts);
    bool ok = labels->texts != NULL;
    for (char *line = joined; ok && line; labels->n++) {
        char *end = strchr(line, '\n');
        if (end)
            *end++ = '\0';
        ok = (labels->texts[labels->n] = strdup(line)) != NULL;
        line = end;
    }
    return ok || cli_refuse("out of memory");
}

bool labels_keep(bayesopt *bo, const struct names *names, size_t j)
{
    char entry[40], *joined = NULL;
    if (!names->labels || !names->labels[j].n)
        return true;
    snprintf(entry, sizeof entry, "variable.%zu.values", j + 1);
    bool ok = join_labels(&names->labels[j], &joined) && store_keep(bo, entry, joined);
    free(joined);
    return ok;
}

bool labels_read(const bayesopt *bo, struct names *names, size_t j)
{
    char entry[40], *joined;
    snprintf(entry, sizeof entry, "variable.%zu.values", j + 1);
    if (bayesopt_store_get_text(bo, entry, &joined))
        return cli_refuse("%s", bayesopt_last_error());
    bool ok = !joined || split_labels(joined, &names->labels[j]);
    free(joined);
    return ok;
}

const char *names_value(const struct names *names, size_t j, double value, char buffer[VALUE_SIZE])
{
    const struct labels *labels = names->labels ? &names->labels[j] : NULL;
    if (labels && value >= 0 && value < (double)labels->n)
        return labels->texts[(size_t)value];
    snprintf(buffer, VALUE_SIZE, "%.17g", value);
    return buffer;
}

bool names_parse(const struct names *names, size_t j, const char *text, double *value)
{
    const struct labels *labels = names->labels ? &names->labels[j] : NULL;
    for (size_t i = 0; labels && i < labels->n; i++)
        if (strcmp(labels->texts[i], text) == 0) {
            *value = (double)i;
            return true;
        }
    return (!labels || !labels->n) && cli_parse_double(text, value);
}

bool names_parse_point(const struct names *names, const char *option, const char *text, double *x)
{
    char *copy = strdup(text), *word = copy;
    size_t n = 0;
    bool ok = copy || cli_refuse("out of memory");
    for (const char *c = text; *c; c++)
        n += *c == ',';
    if (ok && n + 1 != names->d)
        ok = cli_refuse("%s: %zu values, expected %zu", option, n + 1, names->d);
    for (size_t j = 0; ok && j < names->d; j++) {
        char *end = strchr(word, ',');
        if (end)
            *end = '\0';
        ok = names_parse(names, j, word + strspn(word, " "), &x[j]) ||
             cli_refuse("%s: %s is '%s', expected %s", option, names->variables[j], word,
                        names->labels && names->labels[j].n ? "one of its values" : "a number");
        word = end ? end + 1 : word;
    }
    free(copy);
    return ok;
}

json_t *point_json(const struct names *names, const double *x)
{
    json_t *object = json_object();
    for (size_t j = 0; j < names->d; j++) {
        char buffer[VALUE_SIZE];
        double number;
        const char *text = names_value(names, j, x[j], buffer);
        bool label = text != buffer;
        json_result_set(object, names->variables[j],
                        !label                            ? number_json(x[j])
                        : cli_parse_double(text, &number) ? number_json(number)
                                                          : json_string(text));
    }
    return object;
}
