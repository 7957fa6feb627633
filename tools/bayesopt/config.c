#include "config.h"

#include "cli.h"
#include "csv.h"

#include <errno.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ROW(part, name, kind, member, ...)                                                         \
    {                                                                                              \
        .key = (name), .type = SETTING_##kind, .offset = offsetof(struct part, member),            \
        __VA_ARGS__                                                                                \
    }
#define COUNT(array) (sizeof(array) / sizeof *(array))

static const struct setting_word DESIGNS[] = {{"uniform", BAYESOPT_DESIGN_UNIFORM},
                                              {"lhs", BAYESOPT_DESIGN_LHS},
                                              {"annealed-lhs", BAYESOPT_DESIGN_ANNEALED_LHS},
                                              {"sobol", BAYESOPT_DESIGN_SOBOL},
                                              {"stlbo", BAYESOPT_DESIGN_STLBO},
                                              {NULL, 0}};
static const struct setting_word STRATEGIES[] = {{"auto", BAYESOPT_STRATEGY_AUTO},
                                                 {"global", BAYESOPT_STRATEGY_GLOBAL},
                                                 {"local", BAYESOPT_STRATEGY_LOCAL},
                                                 {NULL, 0}};
/* A command cannot tell the variance of what it prints, so the known noise is missing. */
static const struct setting_word NOISES[] = {{"deterministic", BAYESOPT_NOISE_DETERMINISTIC},
                                             {"learned", BAYESOPT_NOISE_LEARNED},
                                             {NULL, 0}};
static const struct setting_word KERNELS[] = {{"se", BAYESOPT_KERNEL_SE},
                                              {"matern32", BAYESOPT_KERNEL_MATERN32},
                                              {"matern52", BAYESOPT_KERNEL_MATERN52},
                                              {NULL, 0}};
static const struct setting_word SCALES[] = {{"isotropic", BAYESOPT_SCALES_ISOTROPIC},
                                             {"tied", BAYESOPT_SCALES_TIED},
                                             {"ard", BAYESOPT_SCALES_ARD},
                                             {"auto", BAYESOPT_SCALES_AUTO},
                                             {NULL, 0}};
static const struct setting_word MEANS[] = {
    {"constant", BAYESOPT_MEAN_CONSTANT}, {"linear", BAYESOPT_MEAN_LINEAR}, {NULL, 0}};
static const struct setting_word CHOICES[] = {
    {"posterior", BAYESOPT_CHOICE_POSTERIOR}, {"loo", BAYESOPT_CHOICE_LOO}, {NULL, 0}};
static const struct setting_word TRANSFORMS[] = {{"none", BAYESOPT_TRANSFORM_NONE},
                                                 {"log", BAYESOPT_TRANSFORM_LOG},
                                                 {"yeo-johnson", BAYESOPT_TRANSFORM_YEO_JOHNSON},
                                                 {"rank", BAYESOPT_TRANSFORM_RANK},
                                                 {"winsorised", BAYESOPT_TRANSFORM_WINSORISED},
                                                 {"auto", BAYESOPT_TRANSFORM_AUTO},
                                                 {NULL, 0}};
static const struct setting_word ACQUISITIONS[] = {
    {"ei", BAYESOPT_ACQUISITION_EI}, {"lcb", BAYESOPT_ACQUISITION_LCB}, {NULL, 0}};
static const struct setting_word MATCHES[] = {
    {"equal", RESULT_EQUAL}, {"first", RESULT_FIRST}, {"last", RESULT_LAST}, {NULL, 0}};
static const struct setting_word BY_RULE[] = {{"by rule", 0}, {NULL, 0}};
static const struct setting_word NEVER[] = {{"never", 0}, {NULL, 0}};
static const struct setting_word NO_LOWER[] = {{"none", -INFINITY}, {NULL, 0}};
static const struct setting_word NO_UPPER[] = {{"none", INFINITY}, {NULL, 0}};

static const struct setting_word KINDS[] = {{"real", CONFIG_REAL},
                                            {"log", CONFIG_LOG},
                                            {"integer", CONFIG_INTEGER},
                                            {"ordinal", CONFIG_ORDINAL},
                                            {"categorical", CONFIG_CATEGORICAL},
                                            {"fixed", CONFIG_FIXED},
                                            {NULL, 0}};

static const struct setting VARIABLE_ROWS[] = {
    ROW(config_variable, "name", TEXT, name, .required = true, .sentence = "of the variable"),
    ROW(config_variable, "kind", CHOICE, kind, .words = KINDS, .otherwise = "real",
        .sentence = "what values it takes; log: real, searched on a scale of logarithms"),
    ROW(config_variable, "lower", NUMBER, lower,
        .given = offsetof(struct config_variable, bounded_below),
        .sentence = "lower bound of a real, log or integer one"),
    ROW(config_variable, "upper", NUMBER, upper,
        .given = offsetof(struct config_variable, bounded_above), .sentence = "upper bound"),
    ROW(config_variable, "values", TEXT, labels, .n_least = 1, .n_most = MOST_LABELS,
        .count = offsetof(struct config_variable, n_labels),
        .sentence = "of a categorical one, or of an ordinal one in their order"),
    ROW(config_variable, "value", NUMBER, value, .given = offsetof(struct config_variable, valued),
        .sentence = "of a fixed one"),
    ROW(config_variable, "group", COUNT, group, .given = offsetof(struct config_variable, grouped),
        .sentence = "of variables with one length scale, from 0 on"),
};

/* {id} and {level} stand for the evaluation's own in a command, the others are columns of the
 * history; what separates columns or fields is none of a name. */
static void check_name(struct settings_source *source, const char *name)
{
    static const char *const taken[] = {"id", "level", "phase", "state", "f", "feasible", "note"};
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++)
        if (strcmp(name, taken[i]) == 0)
            settings_complain(source, "name",
                              "is '%s', which stands for the evaluation's own; expected another "
                              "name",
                              name);
    if (!*name || strpbrk(name, ",{}\"\n\r"))
        settings_complain(source, "name",
                          "is '%s', expected a name without commas, braces and "
                          "quotes",
                          name);
}

/* What a kind needs of lower and upper, values and value, and takes of them. */
static void check_given(struct settings_source *source, const struct config_variable *v)
{
    bool labelled = v->kind == CONFIG_ORDINAL || v->kind == CONFIG_CATEGORICAL;
    bool fixed = v->kind == CONFIG_FIXED, bounded = !labelled && !fixed;
    const char *kind = KINDS[v->kind].name;
    const struct {
        const char *key;
        bool given, wanted;
    } keys[] = {{"lower", v->bounded_below, bounded},
                {"upper", v->bounded_above, bounded},
                {"values", v->n_labels > 0, labelled},
                {"value", v->valued, fixed}};
    for (size_t i = 0; i < COUNT(keys); i++)
        if (keys[i].wanted && !keys[i].given)
            settings_complain(source, keys[i].key,
                              "is missing, which a variable of kind '%s' needs", kind);
        else if (keys[i].given && !keys[i].wanted)
            settings_complain(source, keys[i].key,
                              "is given, which a variable of kind '%s' has not", kind);
}

static void check_variable(struct settings_source *source, void *target)
{
    const struct config_variable *v = target;
    bool whole = v->lower == floor(v->lower) && v->upper == floor(v->upper);
    check_given(source, v);
    check_name(source, v->name);
    if (v->bounded_below && v->bounded_above && !(v->lower < v->upper))
        settings_complain(source, "upper", "is %g, expected more than the lower bound %g", v->upper,
                          v->lower);
    if (v->kind == CONFIG_LOG && v->bounded_below && !(v->lower > 0))
        settings_complain(source, "lower", "is %g, expected a positive number for kind 'log'",
                          v->lower);
    if (v->kind == CONFIG_INTEGER && v->bounded_below && v->bounded_above && !whole)
        settings_complain(source, "lower", "and upper are %g and %g, expected whole numbers",
                          v->lower, v->upper);
    for (size_t i = 0; i < v->n_labels; i++) {
        if (!*v->labels[i] || strpbrk(v->labels[i], ",\"\n\r") || *v->labels[i] == ' ')
            settings_complain(source, "values",
                              "has '%s', expected texts without commas, quotes and blanks at the "
                              "beginning",
                              v->labels[i]);
        for (size_t k = 0; k < i; k++)
            if (strcmp(v->labels[i], v->labels[k]) == 0)
                settings_complain(source, "values", "has '%s' twice", v->labels[i]);
    }
}

static const struct settings VARIABLE = {COUNT(VARIABLE_ROWS), VARIABLE_ROWS,
                                         .check = check_variable};

static const struct setting_word NEXT[] = {{"next", 0}, {NULL, 0}};

static const struct setting CONSTRAINT_ROWS[] = {
    ROW(config_constraint, "name", TEXT, name, .required = true, .sentence = "in the output"),
    ROW(config_constraint, "lower", NUMBER, lower, .words = NO_LOWER, .otherwise = "none",
        .sentence = "least allowed"),
    ROW(config_constraint, "upper", NUMBER, upper, .words = NO_UPPER, .otherwise = "none",
        .sentence = "most allowed"),
    ROW(config_constraint, "output", COUNT, output, .words = NEXT, .otherwise = "next",
        .sentence = "which of the outputs of a model it is"),
};

static void check_constraint(struct settings_source *source, void *target)
{
    const struct config_constraint *c = target;
    check_name(source, c->name);
    if (isinf(c->lower) && isinf(c->upper))
        settings_complain(source, "name", "is '%s', which has neither lower nor upper", c->name);
    else if (!(c->lower < c->upper))
        settings_complain(source, "upper", "is %g, expected more than lower, %g", c->upper,
                          c->lower);
}

static const struct settings CONSTRAINT = {COUNT(CONSTRAINT_ROWS), CONSTRAINT_ROWS,
                                           .check = check_constraint};

static const struct setting OBJECTIVE_ROWS[] = {
    ROW(config_objective, "name", TEXT, name, .required = true, .sentence = "in the output"),
    ROW(config_objective, "maximise", SWITCH, maximise, .otherwise = "false",
        .sentence = "whether the greatest is sought, not the least"),
    ROW(config_objective, "output", COUNT, output, .words = NEXT, .otherwise = "next",
        .sentence = "which of the outputs of a model it is"),
};

static void check_one_objective(struct settings_source *source, void *target)
{
    check_name(source, ((const struct config_objective *)target)->name);
}

static const struct settings OBJECTIVE = {COUNT(OBJECTIVE_ROWS), OBJECTIVE_ROWS,
                                          .check = check_one_objective};

static const struct setting ROWS[] = {
    {.option = "CONFIG.yaml",
     .type = SETTING_TEXT,
     .offset = offsetof(struct config, path),
     .required = true,
     .sentence = "the file that describes the study"},
    {.option = "store",
     .type = SETTING_TEXT,
     .offset = offsetof(struct config, store_given),
     .sentence = "store to use instead of the file's"},
    {.option = "json",
     .type = SETTING_SWITCH,
     .offset = offsetof(struct config, json),
     .sentence = "one JSON object with the result"},
    ROW(config, "store", TEXT, store,
        .sentence = "SQLite file, relative to this one; by default "
                    "this one's name with .db"),
    ROW(config, "variables", ROWS, variables, .required = true, .n_least = 1, .n_most = 1000,
        .count = offsetof(struct config, n_variables), .table = &VARIABLE,
        .size = sizeof(struct config_variable),
        .sentence = "list of {name, kind, lower, upper, values, value, group}"),
    ROW(config, "conditions", TEXT, conditions, .n_least = 1, .n_most = MOST_CONDITIONS,
        .count = offsetof(struct config, n_conditions),
        .sentence =
            "that every point satisfies, in the variables' names: \"a + b <= 2\", \"a == 3 * b\""),
    ROW(config, "objective.command", TEXT, command,
        .sentence =
            "what to run, by /bin/sh in a folder of its own; {name} of a variable, {id} and "
            "{level} are replaced, {{ is a brace"),
    ROW(config, "objective.url", TEXT, url,
        .sentence = "in place of a command: a server of UM-Bridge models, http://host:4242, which "
                    "takes as many requests at once as there are workers"),
    ROW(config, "objective.model", TEXT, model, .sentence = "name of the model there"),
    ROW(config, "objective.config", TEXT, model_config,
        .sentence = "its settings, a JSON object: '{\"fidelity\": 3}'"),
    ROW(config, "objective.output", COUNT, output, .least = 1, .most = 1000000, .otherwise = "1",
        .sentence = "which of its outputs counts"),
    ROW(config, "objective.gradients", SWITCH, use_gradient, .otherwise = "true",
        .sentence = "whether derivatives are asked for where the model has them"),
    ROW(config, "objective.template", FILE, templates, .n_least = 1, .n_most = MOST_TEMPLATES,
        .count = offsetof(struct config, n_templates),
        .sentence = "input files copied into the folder with the same replaced"),
    ROW(config, "objective.file", TEXT, file,
        .sentence = "in the folder, which the command writes the numbers to; without, they are in "
                    "its standard output"),
    ROW(config, "objective.key", TEXT, key,
        .sentence = "the number after it counts: 'key = 3', 'key [unit]: 3', '| key | 3 |', 'key "
                    "3'; without a key the number that ends the last line"),
    ROW(config, "objective.match", CHOICE, match, .words = MATCHES, .otherwise = "equal",
        .sentence = "which counts of several numbers after a key; equal: a failure if they differ"),
    ROW(config, "objective.maximise", SWITCH, options.maximise, .otherwise = "false",
        .sentence = "whether the greatest number is sought, not the least"),
    ROW(config, "objective.gradient", TEXT, gradient,
        .sentence = "the derivatives are the numbers after it"),
    ROW(config, "objective.folder", TEXT, folder, .otherwise = "evaluations",
        .sentence = "parent of the working folders, relative to this file"),
    ROW(config, "objective.timeout", NUMBER, timeout, .most = INFINITY, .open_least = true,
        .words = NO_UPPER, .otherwise = "none", .sentence = "seconds, after which it has failed"),
    ROW(config, "objective.transient.status", NUMBERS, transient_status, .least = 1, .most = 255,
        .count = offsetof(struct config, n_transient_status),
        .sentence = "exit statuses of failures that say nothing of the point (a licence, a queue)"),
    ROW(config, "objective.transient.pattern", TEXT, transient_pattern,
        .sentence = "the same by a regular expression found in the output or the error output"),
    ROW(config, "objective.transient.timeout", SWITCH, transient_timeout, .otherwise = "false",
        .sentence = "whether a timeout is one of them"),
    ROW(config, "objective.retries", COUNT, retries, .otherwise = "0",
        .sentence = "attempts after a transient failure, or after any if none is called so"),
    ROW(config, "objective.stop_after", COUNT, stop_after, .words = NEVER, .otherwise = "5",
        .sentence = "stop after so many equal failures in a row, give them back and say why"),
    ROW(config, "constraints", ROWS, constraints, .n_most = 1000,
        .count = offsetof(struct config, n_constraints), .table = &CONSTRAINT,
        .size = sizeof(struct config_constraint),
        .sentence = "list of {name, lower, upper} on numbers after a name in the output"),
    ROW(config, "objectives", ROWS, objectives, .n_least = 2, .n_most = MOST_OBJECTIVES,
        .count = offsetof(struct config, n_objectives), .table = &OBJECTIVE,
        .size = sizeof(struct config_objective),
        .sentence = "several at once, in place of objective.key: list of {name, maximise}; their "
                    "Pareto set is sought"),
    ROW(config, "levels.cheap", TEXT, cheap,
        .sentence = "command of a cheaper, coarser evaluation"),
    ROW(config, "levels.cost", NUMBER, options.level_cost_ratio, .most = 1, .open_least = true,
        .sentence = "of the cheap one over the other's"),
    ROW(config, "search.evaluations", COUNT, options.max_evaluations, .words = BY_RULE,
        .sentence = "in all"),
    ROW(config, "search.initial", COUNT, options.initial_n, .words = BY_RULE,
        .sentence = "of them in the initial design"),
    ROW(config, "search.first", FILE, first,
        .sentence = "CSV file of points, a column per variable, which take its first places"),
    ROW(config, "search.told", SWITCH, options.told_count, .otherwise = "false",
        .sentence = "whether points told before the first ask take places of it too"),
    ROW(config, "search.design", CHOICE, options.initial_kind, .words = DESIGNS,
        .sentence = "kind of the initial design"),
    ROW(config, "search.seed", COUNT, options.seed, .sentence = "of all random streams"),
    ROW(config, "search.strategy", CHOICE, options.strategy, .words = STRATEGIES,
        .sentence = "which steps follow the initial design"),
    ROW(config, "search.noise", CHOICE, options.noise, .words = NOISES,
        .sentence = "whether the same point gives the same value"),
    ROW(config, "search.workers", COUNT, workers, .option = "workers", .least = 1, .most = 1000,
        .otherwise = "1", .sentence = "evaluations at a time"),
    ROW(config, "search.kernel", CHOICE, options.kernel, .words = KERNELS,
        .sentence = "of the regression"),
    ROW(config, "search.scales", CHOICE, options.scales, .words = SCALES,
        .sentence = "which length scales are free; tied when the variables have groups"),
    ROW(config, "search.mean", CHOICE, options.mean, .words = MEANS,
        .sentence = "of the regression"),
    ROW(config, "search.choice", CHOICE, options.choice, .words = CHOICES,
        .sentence = "between models"),
    ROW(config, "search.transform", CHOICE, options.transform, .words = TRANSFORMS,
        .sentence = "of the values"),
    ROW(config, "search.acquisition", CHOICE, options.acquisition, .words = ACQUISITIONS,
        .sentence = "what a proposal maximises"),
    ROW(config, "search.lcb_factor", NUMBER, options.lcb_factor, .most = INFINITY,
        .open_least = true, .sentence = "standard deviations below the mean, with lcb"),
    ROW(config, "search.stop_no_improvement", COUNT, options.stop_no_improvement, .words = NEVER,
        .sentence = "stop after so many proposals without one"),
    ROW(config, "search.stop_expected_improvement", NUMBER, options.stop_expected_improvement,
        .most = INFINITY, .words = NEVER, .sentence = "stop when less is expected, in units of f"),
};

const struct settings CONFIG = {COUNT(ROWS), ROWS, .check = config_check};

void config_start(struct config *c)
{
    *c = (struct config){0};
    bayesopt_options_init(&c->options);
    settings_start(&CONFIG, c);
}

void config_free(struct config *c)
{
    if (c->compiled)
        regfree(&c->pattern);
    settings_free(&CONFIG, c);
    free(c->names.variables);
    free(c->names.constraints);
    free(c->names.labels);
    free(c->bounds);
    free(c->group);
    free(c->kind);
    free(c->first_x);
}

static const bayesopt_kind KIND_OF[] = {
    [CONFIG_REAL] = BAYESOPT_KIND_REAL,
    [CONFIG_LOG] = BAYESOPT_KIND_LOG,
    [CONFIG_INTEGER] = BAYESOPT_KIND_INTEGER,
    [CONFIG_ORDINAL] = BAYESOPT_KIND_INTEGER,
    [CONFIG_CATEGORICAL] = BAYESOPT_KIND_CATEGORICAL,
    [CONFIG_FIXED] = BAYESOPT_KIND_REAL,
};

/* The points to be evaluated first. */
static bool read_first(struct config *c)
{
    struct csv csv;
    if (!csv_read(c->first, &csv))
        return false;
    c->first_x = malloc((csv.rows + 1) * c->n_variables * sizeof *c->first_x);
    bool ok = c->first_x ? csv_points(&csv, &c->names, c->first_x) : cli_refuse("out of memory");
    c->options.n_first = csv.rows;
    c->options.first_x = c->first_x;
    csv_free(&csv);
    return ok;
}

/* The library's options from what was read. */
static bool complete(struct config *c)
{
    size_t d = c->n_variables, others = c->n_objectives ? c->n_objectives - 1 : 0;
    size_t m = c->n_constraints + others;
    c->names = (struct names){d, m, calloc(d, sizeof(char *)), calloc(m + 1, sizeof(char *)),
                              calloc(d, sizeof(struct labels))};
    c->kind = calloc(d, sizeof *c->kind);
    c->bounds = malloc(2 * (d + m) * sizeof *c->bounds);
    c->group = malloc(d * sizeof *c->group);
    if (!c->names.variables || !c->names.constraints || !c->names.labels || !c->kind ||
        !c->bounds || !c->group)
        return cli_refuse("out of memory");
    for (size_t j = 0; j < d; j++) {
        struct config_variable *v = &c->variables[j];
        bool fixed = v->kind == CONFIG_FIXED;
        c->names.variables[j] = v->name;
        c->names.labels[j] = (struct labels){v->n_labels, v->labels};
        c->bounds[j] = fixed ? v->value : v->n_labels ? 0 : v->lower;
        c->bounds[d + j] = fixed ? v->value : v->n_labels ? (double)v->n_labels - 1 : v->upper;
        c->kind[j] = KIND_OF[v->kind];
        c->group[j] = v->group;
    }
    for (size_t k = 0; k < others; k++) { /* outcomes without bounds */
        c->names.constraints[c->n_constraints + k] = c->objectives[k + 1].name;
        c->bounds[2 * d + c->n_constraints + k] = -INFINITY;
        c->bounds[2 * d + m + c->n_constraints + k] = INFINITY;
        c->maximise_others[k] = c->objectives[k + 1].maximise;
    }
    for (size_t k = 0; k < c->n_constraints; k++) {
        c->names.constraints[k] = c->constraints[k].name;
        c->bounds[2 * d + k] = c->constraints[k].lower;
        c->bounds[2 * d + m + k] = c->constraints[k].upper;
    }
    if (c->variables[0].grouped)
        c->options.scales = BAYESOPT_SCALES_TIED;
    c->options.group = c->group;
    if (c->n_objectives) {
        c->options.n_objectives = c->n_objectives;
        c->options.maximise = c->objectives[0].maximise;
        c->options.maximise_others = c->maximise_others;
        if (c->objectives[0].output)
            c->output = c->objectives[0].output;
    }
    c->options.n_constraints = c->n_constraints;
    c->options.constraint_lower = c->bounds + 2 * d;
    c->options.constraint_upper = c->bounds + 2 * d + m;
    c->options.n_levels = c->cheap ? 2 : 1;
    c->options.kind = c->kind;
    c->options.names = (const char *const *)c->names.variables;
    c->options.n_conditions = c->n_conditions;
    c->options.conditions = (const char *const *)c->conditions;
    return !c->first || read_first(c);
}

bool config_read(const char *path, struct config *c)
{
    return settings_read(path, &CONFIG, c) && complete(c);
}

/* A path as the file means it: relative to its folder. */
static char *beside(const struct config *c, const char *name)
{
    const char *slash = strrchr(c->path, '/');
    size_t kept = slash && *name != '/' ? (size_t)(slash + 1 - c->path) : 0;
    char *made = malloc(kept + strlen(name) + 1);
    if (made)
        strcpy((char *)memcpy(made, c->path, kept) + kept, name);
    return made;
}

char *config_store(const struct config *c)
{
    if (c->store_given)
        return strdup(c->store_given);
    if (c->store)
        return beside(c, c->store);
    const char *slash = strrchr(c->path, '/'), *name = slash ? slash + 1 : c->path;
    const char *dot = strrchr(name, '.');
    size_t kept = dot ? (size_t)(dot - c->path) : strlen(c->path);
    char *made = malloc(kept + sizeof ".db");
    if (made)
        strcpy((char *)memcpy(made, c->path, kept) + kept, ".db");
    return made;
}

char *config_folder(const struct config *c)
{
    return beside(c, c->folder);
}

const char *config_key(const struct config *c)
{
    return c->n_objectives ? c->objectives[0].name : c->key;
}

size_t config_output(const struct config *c, size_t k)
{
    size_t output = c->output;
    for (size_t i = 0; i <= k; i++) {
        size_t given = i < c->n_constraints ? c->constraints[i].output
                                            : c->objectives[i - c->n_constraints + 1].output;
        output = given ? given : output + 1;
    }
    return output;
}

bool config_knows_transient(const struct config *c)
{
    return c->url || c->n_transient_status || c->transient_pattern || c->transient_timeout;
}
