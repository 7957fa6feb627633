/* A study and its store: the store of another study is refused before anything is written. */
#include "cli.h"
#include "config.h"
#include "template.h"
#include "text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The texts of all templates, one behind the other. */
static char *join_templates(const struct config *c)
{
    char *joined = NULL;
    size_t size;
    FILE *out = text_open(&joined, &size);
    bool ok = out != NULL;
    for (size_t i = 0; i < c->n_templates && ok; i++) {
        size_t length;
        char *text = cli_read(c->templates[i], &length);
        ok = text != NULL || cli_refuse("%s: %s", c->templates[i], strerror(errno));
        if (ok)
            fputs(text, out);
        free(text);
    }
    if (out && text_close(out, &joined) && ok)
        return joined;
    free(joined);
    if (ok)
        cli_fail("out of memory");
    return NULL;
}

/* Whether the templates are those of the store; without, they become so. */
static bool keep_templates(const struct config *c, bayesopt *bo)
{
    char *there = NULL, *here = join_templates(c);
    bool ok = here != NULL;
    if (ok && bayesopt_store_get_text(bo, "objective.template", &there))
        ok = cli_refuse("%s", bayesopt_last_error());
    else if (ok && there && strcmp(there, here) != 0)
        ok = cli_refuse("the store is of another study: the text of objective.template differs");
    else if (ok && !there)
        ok = store_keep(bo, "objective.template", here);
    free(there);
    free(here);
    return ok;
}

/* The same model with the same settings is the same wherever it is served. */
static bool keep_model(const struct config *c, bayesopt *bo)
{
    char outputs[32 + 12 * 1000];
    int used = snprintf(outputs, sizeof outputs, "%zu", c->output);
    for (size_t k = 0; k < c->names.m && used < (int)sizeof outputs - 24; k++)
        used +=
            snprintf(outputs + used, sizeof outputs - (size_t)used, ",%zu", config_output(c, k));
    return !c->url || (store_keep(bo, "objective.model", c->model) &&
                       store_keep(bo, "objective.config", c->model_config ? c->model_config : "") &&
                       store_keep(bo, "objective.outputs", outputs));
}

/* What says what is evaluated, in addition to the names. */
static bool keep_objective(const struct config *c, bayesopt *bo)
{
    return names_keep(bo, &c->names) &&
           store_keep(bo, "objective.command", c->command ? c->command : "") && keep_model(c, bo) &&
           store_keep(bo, "objective.key", config_key(c) ? config_key(c) : "") &&
           store_keep(bo, "objective.file", c->file ? c->file : "") &&
           store_keep(bo, "levels.cheap", c->cheap ? c->cheap : "") && keep_templates(c, bo);
}

/* Variables or outcome constraints and their bounds, each by its name. */
static bool same_bounds(const char *store, const char *kind, size_t n, char *const *there_names,
                        const double *there, size_t m, char *const *here_names, const double *here)
{
    if (n != m)
        return cli_refuse("%s is of another study: it has %zu %ss, here are %zu", store, n, kind,
                          m);
    for (size_t j = 0; j < n; j++)
        if (strcmp(there_names[j], here_names[j]) != 0)
            return cli_refuse("%s is of another study: %s %zu is '%s' there, '%s' here", store,
                              kind, j + 1, there_names[j], here_names[j]);
    for (size_t j = 0; j < n; j++)
        if (there[j] != here[j] || there[n + j] != here[n + j])
            return cli_refuse("%s is of another study: %s '%s' goes from %g to %g there, from %g "
                              "to %g here",
                              store, kind, here_names[j], there[j], there[n + j], here[j],
                              here[n + j]);
    return true;
}

/* Compares an existing store with the file by names. One that cannot be opened is left to
 * bayesopt_open_store(), which says why. */
static bool is_same_study(const struct config *c, const char *store)
{
    size_t d = c->names.d, m = c->names.m;
    bayesopt *bo;
    struct names names;
    if (access(store, F_OK) != 0 || bayesopt_open_read(store, &bo))
        return true;
    bool ok = names_read(bo, &names);
    double *there = ok ? malloc(2 * (names.d + names.m) * sizeof *there) : NULL;
    if (ok && !there)
        ok = cli_refuse("out of memory");
    if (ok) {
        bayesopt_dimension(bo, there, there + names.d);
        bayesopt_constraint_count(bo, there + 2 * names.d, there + 2 * names.d + names.m);
        ok = same_bounds(store, "variable", names.d, names.variables, there, d, c->names.variables,
                         c->bounds) &&
             same_bounds(store, "constraint", names.m, names.constraints, there + 2 * names.d, m,
                         c->names.constraints, c->bounds + 2 * d);
        names_free(&names);
    }
    for (size_t j = 0; j < d && ok; j++)
        ok = bayesopt_variable_kind(bo, j) == c->kind[j] ||
             cli_refuse("%s is of another study: variable '%s' is %s there, %s here", store,
                        c->names.variables[j], bayesopt_kind_name(bayesopt_variable_kind(bo, j)),
                        bayesopt_kind_name(c->kind[j]));
    size_t objectives = c->n_objectives ? c->n_objectives : 1;
    if (ok && bayesopt_objective_count(bo) != objectives)
        ok = cli_refuse("%s is of another study: it has %zu objectives, here are %zu", store,
                        bayesopt_objective_count(bo), objectives);
    if (ok && bayesopt_maximises(bo) != c->options.maximise)
        ok = cli_refuse("%s is of another study: its objective is %s", store,
                        bayesopt_maximises(bo) ? "maximised" : "minimised");
    free(there);
    bayesopt_free(bo);
    return ok;
}

bool config_create(const struct config *c, const char *store, bayesopt **bo)
{
    *bo = NULL;
    size_t d = c->n_variables;
    if (!is_same_study(c, store))
        return false;
    bool ok = (!bayesopt_create(d, c->bounds, c->bounds + d, &c->options, bo) &&
               !bayesopt_open_store(*bo, store)) ||
              cli_refuse("%s", bayesopt_last_error());
    ok = ok && keep_objective(c, *bo);
    if (!ok) {
        bayesopt_free(*bo);
        *bo = NULL;
    }
    return ok;
}
