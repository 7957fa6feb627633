#include "config.h"

#include "cli.h"

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
static const struct setting_word BY_RULE[] = {{"by rule", 0}, {NULL, 0}};
static const struct setting_word NEVER[] = {{"never", 0}, {NULL, 0}};
static const struct setting_word NO_LOWER[] = {{"none", -INFINITY}, {NULL, 0}};
static const struct setting_word NO_UPPER[] = {{"none", INFINITY}, {NULL, 0}};

static const struct setting VARIABLE_ROWS[] = {
    ROW(config_variable, "name", TEXT, name, .required = true, .sentence = "of the variable"),
    ROW(config_variable, "lower", NUMBER, lower, .required = true, .sentence = "lower bound"),
    ROW(config_variable, "upper", NUMBER, upper, .required = true, .sentence = "upper bound"),
    ROW(config_variable, "group", COUNT, group, .given = offsetof(struct config_variable, grouped),
        .sentence = "of variables with one length scale, from 0 on"),
};

static void check_variable(struct settings_source *source, void *target)
{
    const struct config_variable *v = target;
    if (!(v->lower < v->upper))
        settings_complain(source, "upper", "is %g, expected more than the lower bound %g", v->upper,
                          v->lower);
    if (strcmp(v->name, "id") == 0 || strcmp(v->name, "level") == 0)
        settings_complain(
            source, "name",
            "is '%s', which stands for the evaluation's own %s in a command; expected "
            "another name",
            v->name, v->name);
}

static const struct settings VARIABLE = {COUNT(VARIABLE_ROWS), VARIABLE_ROWS,
                                         .check = check_variable};

static const struct setting CONSTRAINT_ROWS[] = {
    ROW(config_constraint, "name", TEXT, name, .required = true, .sentence = "in the output"),
    ROW(config_constraint, "lower", NUMBER, lower, .words = NO_LOWER, .otherwise = "none",
        .sentence = "least allowed"),
    ROW(config_constraint, "upper", NUMBER, upper, .words = NO_UPPER, .otherwise = "none",
        .sentence = "most allowed"),
};

static void check_constraint(struct settings_source *source, void *target)
{
    const struct config_constraint *c = target;
    if (isinf(c->lower) && isinf(c->upper))
        settings_complain(source, "name", "is '%s', which has neither lower nor upper", c->name);
    else if (!(c->lower < c->upper))
        settings_complain(source, "upper", "is %g, expected more than lower, %g", c->upper,
                          c->lower);
}

static const struct settings CONSTRAINT = {COUNT(CONSTRAINT_ROWS), CONSTRAINT_ROWS,
                                           .check = check_constraint};

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
        .size = sizeof(struct config_variable), .sentence = "list of {name, lower, upper, group}"),
    ROW(config, "objective.command", TEXT, command, .required = true,
        .sentence =
            "what to run, by /bin/sh in a folder of its own; {name} of a variable, {id} and "
            "{level} are replaced, {{ is a brace"),
    ROW(config, "objective.key", TEXT, key,
        .sentence = "the number after it in the output counts; without, the last that ends a line"),
    ROW(config, "objective.gradient", TEXT, gradient,
        .sentence = "the derivatives are the numbers after it"),
    ROW(config, "objective.folder", TEXT, folder, .otherwise = "evaluations",
        .sentence = "parent of the working folders"),
    ROW(config, "objective.timeout", NUMBER, timeout, .most = INFINITY, .open_least = true,
        .words = NO_UPPER, .otherwise = "none", .sentence = "seconds, after which it has failed"),
    ROW(config, "objective.retries", COUNT, retries, .otherwise = "0",
        .sentence = "attempts after a failed one"),
    ROW(config, "constraints", ROWS, constraints, .n_most = 1000,
        .count = offsetof(struct config, n_constraints), .table = &CONSTRAINT,
        .size = sizeof(struct config_constraint),
        .sentence = "list of {name, lower, upper} on numbers after a name in the output"),
    ROW(config, "levels.cheap", TEXT, cheap,
        .sentence = "command of a cheaper, coarser evaluation"),
    ROW(config, "levels.cost", NUMBER, options.level_cost_ratio, .most = 1, .open_least = true,
        .sentence = "of the cheap one over the other's"),
    ROW(config, "search.evaluations", COUNT, options.max_evaluations, .words = BY_RULE,
        .sentence = "in all"),
    ROW(config, "search.initial", COUNT, options.initial_n, .words = BY_RULE,
        .sentence = "of them in the initial design"),
    ROW(config, "search.design", CHOICE, options.initial_kind, .words = DESIGNS,
        .sentence = "kind of the initial design"),
    ROW(config, "search.seed", SEED, options.seed, .sentence = "of all random streams"),
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

static void check(struct settings_source *source, void *target)
{
    const struct config *c = target;
    size_t grouped = 0;
    for (size_t j = 0; j < c->n_variables; j++) {
        grouped += c->variables[j].grouped;
        for (size_t k = 0; k < j; k++)
            if (strcmp(c->variables[j].name, c->variables[k].name) == 0)
                settings_complain(source, "variables", "has two called '%s'", c->variables[j].name);
    }
    if (grouped && grouped < c->n_variables)
        settings_complain(source, "variables", "has a group for %zu of %zu, expected all", grouped,
                          c->n_variables);
    if (!grouped && c->n_variables && c->options.scales == BAYESOPT_SCALES_TIED)
        settings_complain(source, "search.scales", "is 'tied', but the variables have no group");
}

const struct settings CONFIG = {COUNT(ROWS), ROWS, .check = check};

void config_start(struct config *c)
{
    *c = (struct config){0};
    bayesopt_options_init(&c->options);
    settings_start(&CONFIG, c);
}

void config_free(struct config *c)
{
    settings_free(&CONFIG, c);
    free(c->names.variables);
    free(c->names.constraints);
    free(c->bounds);
    free(c->group);
}

/* The library's options from what was read. */
static bool complete(struct config *c)
{
    size_t d = c->n_variables, m = c->n_constraints;
    c->names = (struct names){d, m, calloc(d, sizeof(char *)), calloc(m + 1, sizeof(char *))};
    c->bounds = malloc(2 * (d + m) * sizeof *c->bounds);
    c->group = malloc(d * sizeof *c->group);
    if (!c->names.variables || !c->names.constraints || !c->bounds || !c->group)
        return cli_refuse("out of memory");
    for (size_t j = 0; j < d; j++) {
        c->names.variables[j] = c->variables[j].name;
        c->bounds[j] = c->variables[j].lower;
        c->bounds[d + j] = c->variables[j].upper;
        c->group[j] = c->variables[j].group;
    }
    for (size_t k = 0; k < m; k++) {
        c->names.constraints[k] = c->constraints[k].name;
        c->bounds[2 * d + k] = c->constraints[k].lower;
        c->bounds[2 * d + m + k] = c->constraints[k].upper;
    }
    if (c->variables[0].grouped)
        c->options.scales = BAYESOPT_SCALES_TIED;
    c->options.group = c->group;
    c->options.n_constraints = m;
    c->options.constraint_lower = c->bounds + 2 * d;
    c->options.constraint_upper = c->bounds + 2 * d + m;
    c->options.n_levels = c->cheap ? 2 : 1;
    return true;
}

bool config_read(const char *path, struct config *c)
{
    return settings_read(path, &CONFIG, c, NULL) && complete(c);
}

char *config_store(const struct config *c)
{
    if (c->store_given)
        return strdup(c->store_given);
    const char *slash = strrchr(c->path, '/'), *name = slash ? slash + 1 : c->path;
    const char *dot = strrchr(name, '.'), *store = c->store ? c->store : ".db";
    size_t kept = c->store ? (*store == '/' ? 0 : (size_t)(name - c->path))
                  : dot    ? (size_t)(dot - c->path)
                           : strlen(c->path);
    char *made = malloc(kept + strlen(store) + 1);
    if (made)
        strcpy((char *)memcpy(made, c->path, kept) + kept, store);
    return made;
}

/* What says what is evaluated, in addition to the names. */
static bool keep_objective(const struct config *c, bayesopt *bo)
{
    return names_keep(bo, &c->names) && store_keep(bo, "objective.command", c->command) &&
           store_keep(bo, "objective.key", c->key ? c->key : "") &&
           store_keep(bo, "levels.cheap", c->cheap ? c->cheap : "");
}

bool config_create(const struct config *c, const char *store, bayesopt **bo)
{
    *bo = NULL;
    size_t d = c->n_variables;
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
