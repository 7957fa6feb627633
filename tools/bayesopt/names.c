#include "names.h"

#include "json_result.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool failed(void)
{
    return cli_refuse("%s", bayesopt_last_error());
}

bool store_keep(bayesopt *bo, const char *what, const char *text)
{
    char *there;
    if (bayesopt_store_get_text(bo, what, &there))
        return failed();
    if (!there)
        return !bayesopt_store_put_text(bo, what, text) || failed();
    bool same = strcmp(there, text) == 0;
    if (!same)
        cli_fail("the store is of another study: %s is '%s' there, '%s' here", what, there, text);
    free(there);
    return same;
}

bool names_keep(bayesopt *bo, const struct names *names)
{
    char entry[40];
    bool ok = true;
    for (size_t i = 0; i < names->m && ok; i++) {
        snprintf(entry, sizeof entry, "constraint.%zu", i + 1);
        ok = store_keep(bo, entry, names->constraints[i]);
    }
    for (size_t j = 0; j < names->d && ok; j++)
        ok = labels_keep(bo, names, j);
    return ok;
}

/* The text of an entry, or the short name where the store has none. */
static bool read_constraint(const bayesopt *bo, size_t i, char **name)
{
    char entry[40];
    snprintf(entry, sizeof entry, "constraint.%zu", i + 1);
    if (bayesopt_store_get_text(bo, entry, name))
        return failed();
    if (*name)
        return true;
    snprintf(entry, sizeof entry, "c%zu", i + 1);
    *name = strdup(entry);
    return *name || cli_refuse("out of memory");
}

bool names_read(const bayesopt *bo, struct names *names)
{
    *names = (struct names){.d = bayesopt_dimension(bo, NULL, NULL),
                            .m = bayesopt_constraint_count(bo, NULL, NULL)};
    names->variables = calloc(names->d, sizeof *names->variables);
    names->constraints = calloc(names->m + 1, sizeof *names->constraints);
    names->labels = calloc(names->d, sizeof *names->labels);
    bool ok =
        (names->variables && names->constraints && names->labels) || cli_refuse("out of memory");
    for (size_t j = 0; j < names->d && ok; j++)
        ok = ((names->variables[j] = strdup(bayesopt_variable_name(bo, j))) ||
              cli_refuse("out of memory")) &&
             labels_read(bo, names, j);
    for (size_t i = 0; i < names->m && ok; i++)
        ok = read_constraint(bo, i, &names->constraints[i]);
    if (!ok)
        names_free(names);
    return ok;
}

void names_free(struct names *names)
{
    for (size_t i = 0; names->variables && i < names->d; i++)
        free(names->variables[i]);
    for (size_t i = 0; names->constraints && i < names->m; i++)
        free(names->constraints[i]);
    for (size_t j = 0; names->labels && j < names->d; j++) {
        for (size_t i = 0; i < names->labels[j].n; i++)
            free(names->labels[j].texts[i]);
        free(names->labels[j].texts);
    }
    free(names->labels);
    free(names->variables);
    free(names->constraints);
    *names = (struct names){0};
}

static bool open_with_names(bayesopt_status status, bayesopt **bo, struct names *names)
{
    if (status)
        return failed();
    if (names_read(*bo, names))
        return true;
    bayesopt_free(*bo);
    return false;
}

bool store_open(const char *path, bayesopt **bo, struct names *names)
{
    return open_with_names(bayesopt_open_read(path, bo), bo, names);
}

bool store_open_to_write(const char *path, bayesopt **bo, struct names *names)
{
    return open_with_names(bayesopt_open(path, NULL, NULL, bo), bo, names);
}

json_t *number_json(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *named_json(size_t n, char *const *names, const double *values)
{
    json_t *object = json_object();
    for (size_t i = 0; i < n && values; i++)
        json_result_set(object, names[i], number_json(values[i]));
    return object;
}

bool print_json(FILE *stream, json_t *root)
{
    return json_result_write(stream, root, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
}

bool output_open(struct output *output, const char *path)
{
    *output = (struct output){stdout, path, {0}};
    if (path && !cli_file_open(&output->file, path))
        return cli_refuse("%s: cannot be written: %s", path, strerror(errno));
    if (path)
        output->stream = output->file.stream;
    return true;
}

bool output_close(struct output *output)
{
    return !output->path || cli_file_commit(&output->file) ||
           cli_refuse("%s: cannot be written: %s", output->path, strerror(errno));
}
