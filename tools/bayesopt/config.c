#include "config.h"

#include "cli.h"
#include "yaml_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REQUIRED(name, part)                                                                       \
    CYAML_FIELD_STRING_PTR(#name, CYAML_FLAG_POINTER, struct part, name, 1, CYAML_UNLIMITED)
#define OPTIONAL(name, part)                                                                       \
    CYAML_FIELD_STRING_PTR(#name, CYAML_FLAG_POINTER_NULL_STR | CYAML_FLAG_OPTIONAL, struct part,  \
                           name, 1, CYAML_UNLIMITED)

static const cyaml_schema_field_t variable_fields[] = {
    REQUIRED(name, config_variable),
    REQUIRED(lower, config_variable),
    REQUIRED(upper, config_variable),
    OPTIONAL(group, config_variable),
    CYAML_FIELD_END,
};
static const cyaml_schema_value_t variable = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct config_variable, variable_fields),
};
static const cyaml_schema_field_t objective_fields[] = {
    REQUIRED(command, config_objective),
    OPTIONAL(key, config_objective),
    OPTIONAL(gradient, config_objective),
    OPTIONAL(folder, config_objective),
    OPTIONAL(timeout, config_objective),
    OPTIONAL(retries, config_objective),
    CYAML_FIELD_END,
};
static const cyaml_schema_field_t levels_fields[] = {
    OPTIONAL(cheap, config_levels),
    OPTIONAL(cost, config_levels),
    CYAML_FIELD_END,
};
static const cyaml_schema_field_t constraint_fields[] = {
    REQUIRED(name, config_constraint),
    OPTIONAL(lower, config_constraint),
    OPTIONAL(upper, config_constraint),
    CYAML_FIELD_END,
};
static const cyaml_schema_value_t constraint = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct config_constraint, constraint_fields),
};
static const cyaml_schema_field_t search_fields[] = {
    OPTIONAL(evaluations, config_search),
    OPTIONAL(initial, config_search),
    OPTIONAL(design, config_search),
    OPTIONAL(seed, config_search),
    OPTIONAL(strategy, config_search),
    OPTIONAL(noise, config_search),
    OPTIONAL(workers, config_search),
    OPTIONAL(kernel, config_search),
    OPTIONAL(scales, config_search),
    OPTIONAL(mean, config_search),
    OPTIONAL(choice, config_search),
    OPTIONAL(transform, config_search),
    OPTIONAL(acquisition, config_search),
    OPTIONAL(lcb_factor, config_search),
    OPTIONAL(stop_no_improvement, config_search),
    OPTIONAL(stop_expected_improvement, config_search),
    CYAML_FIELD_END,
};
static const cyaml_schema_field_t fields[] = {
    OPTIONAL(store, config_file),
    CYAML_FIELD_SEQUENCE("variables", CYAML_FLAG_POINTER, struct config_file, variables, &variable,
                         1, 1000),
    CYAML_FIELD_MAPPING("objective", CYAML_FLAG_DEFAULT, struct config_file, objective,
                        objective_fields),
    CYAML_FIELD_MAPPING("levels", CYAML_FLAG_OPTIONAL, struct config_file, levels, levels_fields),
    CYAML_FIELD_SEQUENCE("constraints", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL,
                         struct config_file, constraints, &constraint, 0, 1000),
    CYAML_FIELD_MAPPING("search", CYAML_FLAG_OPTIONAL, struct config_file, search, search_fields),
    CYAML_FIELD_END,
};
static const cyaml_schema_value_t schema = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, struct config_file, fields),
};

static bool number(const char *path, const char *field, const char *text, double otherwise,
                   double *out)
{
    *out = otherwise;
    if (!text || cli_parse_double(text, out))
        return true;
    cli_yaml_fail(path, field, "is '%s', expected a finite number", text);
    return false;
}

static bool whole(const char *path, const char *field, const char *text, size_t otherwise,
                  size_t *out)
{
    *out = otherwise;
    if (!text || cli_parse_size(text, out))
        return true;
    cli_yaml_fail(path, field, "is '%s', expected a whole number", text);
    return false;
}

static bool check_variables(struct config *c)
{
    const struct config_file *f = c->file;
    for (unsigned j = 0; j < f->variables_count; j++) {
        const struct config_variable *v = &f->variables[j];
        if (!number(c->path, "variables.lower", v->lower, 0, &c->lower[j]) ||
            !number(c->path, "variables.upper", v->upper, 1, &c->upper[j]))
            return false;
        if (!(c->lower[j] < c->upper[j])) {
            cli_yaml_fail(c->path, "variables", "'%s' has bounds %g and %g, expected increasing",
                          v->name, c->lower[j], c->upper[j]);
            return false;
        }
        for (unsigned k = 0; k < j; k++)
            if (strcmp(f->variables[k].name, v->name) == 0) {
                cli_yaml_fail(c->path, "variables", "has two called '%s'", v->name);
                return false;
            }
        c->names.variables[j] = strdup(v->name);
    }
    return true;
}

static bool check_constraints(struct config *c)
{
    const struct config_file *f = c->file;
    for (unsigned k = 0; k < f->constraints_count; k++) {
        const struct config_constraint *v = &f->constraints[k];
        if (!number(c->path, "constraints.lower", v->lower, -INFINITY, &c->constraint_lower[k]) ||
            !number(c->path, "constraints.upper", v->upper, INFINITY, &c->constraint_upper[k]))
            return false;
        if (!v->lower && !v->upper) {
            cli_yaml_fail(c->path, "constraints", "'%s' has neither lower nor upper", v->name);
            return false;
        }
        c->names.constraints[k] = strdup(v->name);
    }
    return true;
}

/* One of a list of names that the library gives for 0, 1, ...; NULL text keeps the default. */
static bool choice(const char *path, const char *field, const char *text, const char *const *list,
                   int n, int *out)
{
    if (!text)
        return true;
    for (int i = 0; i < n; i++)
        if (strcmp(text, list[i]) == 0) {
            *out = i;
            return true;
        }
    char names[200] = "";
    for (int i = 0; i < n; i++)
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i ? ", " : "",
                 list[i]);
    cli_yaml_fail(path, field, "is '%s', expected one of %s", text, names);
    return false;
}

/* The model, the acquisition and when to stop. */
static bool check_model(struct config *c)
{
    static const char *const kernels[] = {"se", "matern32", "matern52"};
    static const char *const scales[] = {"isotropic", "tied", "ard", "auto"};
    static const char *const means[] = {"constant", "linear"};
    static const char *const choices[] = {"posterior", "loo"};
    static const char *const transforms[] = {"none", "log",        "yeo-johnson",
                                             "rank", "winsorised", "auto"};
    static const char *const acquisitions[] = {"ei", "lcb"};
    const struct config_search *s = &c->file->search;
    bayesopt_options *o = &c->options;
    int kernel = (int)o->kernel, scale = c->group ? BAYESOPT_SCALES_TIED : (int)o->scales;
    int mean = 0, model = (int)o->choice, transform = (int)o->transform, what = (int)o->acquisition;
    bool ok = choice(c->path, "search.kernel", s->kernel, kernels, 3, &kernel) &&
              choice(c->path, "search.scales", s->scales, scales, 4, &scale) &&
              choice(c->path, "search.mean", s->mean, means, 2, &mean) &&
              choice(c->path, "search.choice", s->choice, choices, 2, &model) &&
              choice(c->path, "search.transform", s->transform, transforms, 6, &transform) &&
              choice(c->path, "search.acquisition", s->acquisition, acquisitions, 2, &what) &&
              number(c->path, "search.lcb_factor", s->lcb_factor, o->lcb_factor, &o->lcb_factor) &&
              whole(c->path, "search.stop_no_improvement", s->stop_no_improvement, 0,
                    &o->stop_no_improvement) &&
              number(c->path, "search.stop_expected_improvement", s->stop_expected_improvement, 0,
                     &o->stop_expected_improvement);
    if (ok && scale == BAYESOPT_SCALES_TIED && !c->group) {
        cli_yaml_fail(c->path, "search.scales", "is 'tied', but the variables have no group");
        return false;
    }
    o->kernel = (bayesopt_kernel)kernel;
    o->scales = (bayesopt_scales)scale;
    o->mean = mean ? BAYESOPT_MEAN_LINEAR : BAYESOPT_MEAN_CONSTANT;
    o->choice = (bayesopt_choice)model;
    o->transform = (bayesopt_transform)transform;
    o->acquisition = (bayesopt_acquisition)what;
    o->group = c->group;
    return ok;
}

static bool check_levels(struct config *c)
{
    const struct config_levels *l = &c->file->levels;
    if (!l->cheap && !l->cost)
        return true;
    if (!l->cheap) {
        cli_yaml_fail(c->path, "levels", "has no command 'cheap'");
        return false;
    }
    c->options.n_levels = 2;
    double *ratio = &c->options.level_cost_ratio;
    if (!number(c->path, "levels.cost", l->cost, *ratio, ratio))
        return false;
    if (*ratio > 0 && *ratio <= 1)
        return true;
    cli_yaml_fail(c->path, "levels.cost", "is %g, expected a share in (0, 1]", *ratio);
    return false;
}

static bool check_groups(struct config *c)
{
    const struct config_file *f = c->file;
    size_t given = 0;
    for (unsigned j = 0; j < f->variables_count; j++)
        given += f->variables[j].group != NULL;
    if (!given)
        return true;
    c->group = malloc(f->variables_count * sizeof *c->group);
    if (!c->group || given != f->variables_count) {
        cli_yaml_fail(c->path, "variables", "has a group for %zu of %u variables, expected all",
                      given, f->variables_count);
        return false;
    }
    for (unsigned j = 0; j < f->variables_count; j++)
        if (!whole(c->path, "variables.group", f->variables[j].group, 0, &c->group[j]))
            return false;
    return true;
}

static bool check_search(struct config *c)
{
    static const char *const designs[] = {"uniform", "lhs", "annealed-lhs", "sobol", "stlbo"};
    static const char *const strategies[] = {"auto", "global", "local"};
    static const char *const noises[] = {"deterministic", "known", "learned"};
    const struct config_search *s = &c->file->search;
    const struct config_objective *o = &c->file->objective;
    bayesopt_options *options = &c->options;
    int design = (int)options->initial_kind, strategy = (int)options->strategy;
    int noise = (int)options->noise;
    size_t seed = 1;
    bool ok = whole(c->path, "search.evaluations", s->evaluations, 0, &options->max_evaluations) &&
              whole(c->path, "search.initial", s->initial, 0, &options->initial_n) &&
              whole(c->path, "search.seed", s->seed, 1, &seed) &&
              whole(c->path, "search.workers", s->workers, 1, &c->workers) &&
              choice(c->path, "search.design", s->design, designs, 5, &design) &&
              choice(c->path, "search.strategy", s->strategy, strategies, 3, &strategy) &&
              choice(c->path, "search.noise", s->noise, noises, 3, &noise) &&
              number(c->path, "objective.timeout", o->timeout, 0, &c->timeout) &&
              whole(c->path, "objective.retries", o->retries, 0, &c->retries);
    if (ok && noise == BAYESOPT_NOISE_KNOWN) {
        cli_yaml_fail(c->path, "search.noise", "is 'known', which a command cannot tell");
        ok = false;
    }
    if (ok && (c->workers < 1 || c->workers > 1000)) {
        cli_yaml_fail(c->path, "search.workers", "is %zu, expected 1 to 1000", c->workers);
        ok = false;
    }
    options->seed = seed;
    options->initial_kind = (bayesopt_design_kind)design;
    options->strategy = (bayesopt_strategy)strategy;
    options->noise = (bayesopt_noise)noise;
    return ok;
}

bool config_read(const char *path, struct config *c)
{
    *c = (struct config){.path = path};
    bayesopt_options_init(&c->options);
    if (!cli_yaml_load(path, &schema, (void **)&c->file))
        return false;
    size_t d = c->file->variables_count, m = c->file->constraints_count;
    c->names = (struct names){.d = d,
                              .m = m,
                              .variables = calloc(d, sizeof(char *)),
                              .constraints = calloc(m + 1, sizeof(char *))};
    c->lower = malloc(2 * (d + m) * sizeof *c->lower);
    bool ok = c->names.variables && c->names.constraints && c->lower;
    if (ok) {
        c->upper = c->lower + d;
        c->constraint_lower = c->upper + d;
        c->constraint_upper = c->constraint_lower + m;
        ok = check_variables(c) && check_groups(c) && check_constraints(c) && check_search(c) &&
             check_model(c) && check_levels(c);
    } else {
        cli_fail("out of memory");
    }
    c->options.n_constraints = m;
    c->options.constraint_lower = c->constraint_lower;
    c->options.constraint_upper = c->constraint_upper;
    if (!ok)
        config_free(c);
    return ok;
}

void config_free(struct config *c)
{
    names_free(&c->names);
    free(c->lower);
    free(c->group);
    c->group = NULL;
    cli_yaml_free(&schema, c->file);
    c->file = NULL;
    c->lower = NULL;
}

/* What says what is evaluated, in addition to the names. */
static bool keep_objective(const struct config *c, bayesopt *bo)
{
    const struct config_file *f = c->file;
    const char *key = f->objective.key, *cheap = f->levels.cheap;
    return names_keep(bo, &c->names) && store_keep(bo, "objective.command", f->objective.command) &&
           store_keep(bo, "objective.key", key ? key : "") &&
           store_keep(bo, "levels.cheap", cheap ? cheap : "");
}

bool config_create(const struct config *c, const char *store, bayesopt **bo)
{
    *bo = NULL;
    bool ok = (!bayesopt_create(c->names.d, c->lower, c->upper, &c->options, bo) &&
               !bayesopt_open_store(*bo, store)) ||
              cli_refuse("%s", bayesopt_last_error());
    ok = ok && keep_objective(c, *bo);
    if (!ok) {
        bayesopt_free(*bo);
        *bo = NULL;
    }
    return ok;
}
