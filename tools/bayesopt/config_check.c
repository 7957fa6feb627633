/* What the file of a study must satisfy beyond its rows. */
#include "cli.h"
#include "config.h"
#include "template.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of a regular expression: parts as written out, groups within groups. */
enum { LONGEST_PATTERN = 10000, NESTED = 100 };

/* Every {word} of a text must be a variable. */
static void check_fields(struct settings_source *source, const char *key, const char *text,
                         size_t length, const struct names *names)
{
    size_t field;
    const char *at = text ? template_unknown(text, length, names, &field) : NULL;
    if (at)
        settings_complain(source, key, "has '%.*s', which is no variable; '{{' stands for a brace",
                          (int)field, at);
}

static void check_templates(struct settings_source *source, const struct config *c,
                            const struct names *names)
{
    for (size_t i = 0; i < c->n_templates; i++) {
        const char *path = c->templates[i], *slash = strrchr(path, '/');
        const char *name = slash ? slash + 1 : path;
        size_t length;
        char *text = cli_read(path, &length);
        if (!text)
            settings_complain(source, "objective.template", "is '%s': %s", path, strerror(errno));
        check_fields(source, "objective.template", text, text ? length : 0, names);
        if (c->file && strcmp(c->file, name) == 0)
            settings_complain(source, "objective.file", "is '%s', which is a template's name",
                              name);
        if (strcmp(name, "stdout") == 0 || strcmp(name, "stderr") == 0)
            settings_complain(source, "objective.template",
                              "is called '%s', as the file of the output is", name);
        free(text);
    }
}

/* Several objectives: what goes with them, and names of their own. */
static void check_objectives(struct settings_source *source, const struct config *c)
{
    if (c->n_objectives && (c->key || c->options.maximise))
        settings_complain(source, "objectives", "are given beside objective.%s",
                          c->key ? "key" : "maximise");
    if (c->n_objectives && (c->gradient || c->cheap))
        settings_complain(source, "objectives", "are given beside %s",
                          c->gradient ? "objective.gradient" : "levels.cheap");
    for (size_t i = 0; i < c->n_objectives; i++) {
        for (size_t k = 0; k < i; k++)
            if (strcmp(c->objectives[i].name, c->objectives[k].name) == 0)
                settings_complain(source, "objectives", "has two called '%s'",
                                  c->objectives[i].name);
        for (size_t k = 0; k < c->n_constraints; k++)
            if (strcmp(c->objectives[i].name, c->constraints[k].name) == 0)
                settings_complain(source, "objectives", "has '%s', as a constraint is called",
                                  c->objectives[i].name);
        for (size_t k = 0; k < c->n_variables; k++)
            if (strcmp(c->objectives[i].name, c->variables[k].name) == 0)
                settings_complain(source, "objectives", "has '%s', as a variable is called",
                                  c->objectives[i].name);
    }
}

/* A model in place of a command: what goes with which. */
static void check_model(struct settings_source *source, const struct config *c)
{
    const struct {
        const char *key;
        bool given;
    } others[] = {{"objective.command", c->command},   {"objective.template", c->n_templates > 0},
                  {"objective.file", c->file},         {"objective.key", c->key},
                  {"objective.gradient", c->gradient}, {"levels.cheap", c->cheap},
                  {"objective.model", c->model},       {"objective.config", c->model_config}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (others[i].given && (i < 6) == (c->url != NULL))
            settings_complain(source, others[i].key,
                              c->url ? "is given beside objective.url"
                                     : "is given without objective.url");
    if (!c->url && !c->command && c->n_variables) /* the file is read */
        settings_complain(source, "objective.command", "is missing, and so is objective.url");
    if (c->url && !c->model)
        settings_complain(source, "objective.model", "is missing");
    json_t *json = c->model_config ? json_loads(c->model_config, 0, NULL) : NULL;
    if (c->model_config && !json_is_object(json))
        settings_complain(source, "objective.config", "is '%s', expected a JSON object",
                          c->model_config);
    json_decref(json);
    double number;
    for (size_t j = 0; j < c->n_variables && c->url; j++)
        for (size_t i = 0; i < c->variables[j].n_labels; i++)
            if (!cli_parse_double(c->variables[j].labels[i], &number))
                settings_complain(source, "variables",
                                  "has '%s' with the value '%s'; a model takes "
                                  "numbers",
                                  c->variables[j].name, c->variables[j].labels[i]);
}

/* Past a bracket expression that begins at '['. */
static const char *skip_bracket(const char *at)
{
    at += at[1] == '^' ? 2 : 1;
    at += *at == ']';
    while (*at && *at != ']') {
        const char *inner =
            *at == '[' && at[1] && strchr(".=:", at[1]) ? strchr(at + 2, ']') : NULL;
        at = (inner ? inner : at) + 1;
    }
    return *at ? at + 1 : at;
}

/* How often a part stands there once regcomp() has written out what follows it; 1: no repetition.
 * *at is past that. */
static double repetition(const char **at)
{
    char kind = *(*at)++, *end;
    if (kind != '{')
        return kind == '+' ? 2 : 1; /* a+ is aa* */
    double least = strtod(*at, &end), most = *end == ',' ? strtod(end + 1, &end) : least;
    *at = *end == '}' ? end + 1 : end;
    return fmax(1, fmax(least, most));
}

/* Parts of a pattern when its repetitions are written out as copies. */
static double written_out(const char *at)
{
    double sum[NESTED] = {0}, last = 0; /* of each group; of the part that a repetition is of */
    size_t depth = 0;
    while (*at)
        if (strchr("*+?{", *at)) {
            double times = repetition(&at);
            sum[depth] += (times - 1) * last;
            last *= times;
        } else if (*at == '(' && depth + 1 == NESTED) {
            return INFINITY;
        } else if (*at == '(') {
            sum[++depth] = last = 0;
            at++;
        } else {
            last = *at == ')' && depth > 0 ? 1 + sum[depth--] : 1;
            sum[depth] += last;
            at = *at == '[' ? skip_bracket(at) : at + (*at == '\\' && at[1] ? 2 : 1);
        }
    return sum[0];
}

/* What is run and how its results are read. */
static void check_objective(struct settings_source *source, struct config *c)
{
    struct names names = {.d = c->n_variables,
                          .variables = calloc(c->n_variables + 1, sizeof(char *))};
    for (size_t j = 0; names.variables && j < c->n_variables; j++)
        names.variables[j] = c->variables[j].name;
    if (names.variables) {
        check_fields(source, "objective.command", c->command, c->command ? strlen(c->command) : 0,
                     &names);
        check_fields(source, "levels.cheap", c->cheap, c->cheap ? strlen(c->cheap) : 0, &names);
        check_templates(source, c, &names);
    }
    free(names.variables);
    check_model(source, c);
    check_objectives(source, c);
    /* Whatever lies outside of the fresh folder may be of another evaluation. */
    if (c->file && (*c->file == '/' || strstr(c->file, "..")))
        settings_complain(source, "objective.file",
                          "is '%s', expected a name within the working folder", c->file);
    for (size_t i = 0; i < c->n_transient_status; i++)
        if (c->transient_status[i] != floor(c->transient_status[i]))
            settings_complain(source, "objective.transient.status", "is %g, expected whole numbers",
                              c->transient_status[i]);
    char message[200];
    if (c->compiled) /* by an earlier check: options replace what a file says */
        regfree(&c->pattern);
    double parts = c->transient_pattern ? written_out(c->transient_pattern) : 0;
    if (parts > LONGEST_PATTERN) {
        settings_complain(source, "objective.transient.pattern",
                          "is '%s', which makes %g parts when its repetitions are written out, "
                          "expected at most %d",
                          c->transient_pattern, parts, LONGEST_PATTERN);
        free(c->transient_pattern);
        c->transient_pattern = NULL;
    }
    int code = c->transient_pattern ? regcomp(&c->pattern, c->transient_pattern,
                                              REG_EXTENDED | REG_NOSUB | REG_NEWLINE)
                                    : 0;
    c->compiled = c->transient_pattern && !code;
    if (code) {
        regerror(code, &c->pattern, message, sizeof message);
        settings_complain(source, "objective.transient.pattern",
                          "is '%s', which is no regular expression: %s", c->transient_pattern,
                          message);
        free(c->transient_pattern);
        c->transient_pattern = NULL;
    }
}

void config_check(struct settings_source *source, void *target)
{
    struct config *c = target;
    size_t grouped = 0;
    check_objective(source, c);
    for (size_t j = 0; j < c->n_variables; j++) {
        grouped += c->variables[j].grouped;
        for (size_t k = 0; k < j; k++)
            if (strcmp(c->variables[j].name, c->variables[k].name) == 0)
                settings_complain(source, "variables", "has two called '%s'", c->variables[j].name);
        for (size_t k = 0; k < c->n_constraints; k++)
            if (strcmp(c->variables[j].name, c->constraints[k].name) == 0)
                settings_complain(source, "constraints", "has one called '%s', as a variable is",
                                  c->variables[j].name);
    }
    for (size_t j = 0; j < c->n_constraints; j++)
        for (size_t k = 0; k < j; k++)
            if (strcmp(c->constraints[j].name, c->constraints[k].name) == 0)
                settings_complain(source, "constraints", "has two called '%s'",
                                  c->constraints[j].name);
    if (grouped && grouped < c->n_variables)
        settings_complain(source, "variables", "has a group for %zu of %zu, expected all", grouped,
                          c->n_variables);
    if (!grouped && c->n_variables && c->options.scales == BAYESOPT_SCALES_TIED)
        settings_complain(source, "search.scales", "is 'tied', but the variables have no group");
}
