#include "serve/variant.h"

#include "core/constraints.h"
#include "core/remote.h"

#include <math.h>
#include <string.h>

enum { REFINE_MOST = 16 };

/* As flow.froude. */
static bool read_speed(const json_t *value, double *froude, struct served_error *error)
{
    if (!json_is_number(value))
        return served_fail(error, SERVED_INVALID_INPUT,
                           "config.froude is no number or list of numbers");
    *froude = json_number_value(value);
    return (*froude > 0 && *froude < 10) ||
           served_fail(error, SERVED_INVALID_INPUT,
                       "config.froude is %.15g, expected above 0 and below 10", *froude);
}

static bool read_froude(const json_t *value, struct variant *v, struct served_error *error)
{
    if (!json_is_array(value)) {
        v->n = 1;
        return read_speed(value, &v->froude[0], error);
    }
    v->n = json_array_size(value);
    if (v->n < 1 || v->n > 1 + CONFIG_FROUDE_MOST)
        return served_fail(error, SERVED_INVALID_INPUT,
                           "config.froude has %zu numbers, expected 1 to %d", v->n,
                           1 + CONFIG_FROUDE_MOST);
    for (size_t i = 0; i < v->n; i++)
        if (!read_speed(json_array_get(value, i), &v->froude[i], error))
            return false;
    return true;
}

static bool read_formulation(const json_t *value, struct variant *v, struct served_error *error)
{
    const char *name = json_string_value(value);
    return (name && igabem_formulation_parse(name, &v->formulation)) ||
           served_fail(error, SERVED_INVALID_INPUT,
                       "config.formulation is %s, expected a name such as michell",
                       name ? name : "no text");
}

static bool read_refine(const json_t *value, struct variant *v, struct served_error *error)
{
    json_int_t refine = json_integer_value(value);
    if (!json_is_integer(value) || refine < 1 || refine > REFINE_MOST)
        return served_fail(error, SERVED_INVALID_INPUT, "config.refine is no integer from 1 to %d",
                           REFINE_MOST);
    v->refine = (int)refine;
    return true;
}

static const struct {
    const char *key;
    bool (*read)(const json_t *value, struct variant *variant, struct served_error *error);
} KEYS[] = {{"froude", read_froude}, {"formulation", read_formulation}, {"refine", read_refine}};
enum { N_KEYS = sizeof KEYS / sizeof *KEYS };

bool variant_read(const struct config *run, const json_t *config, struct variant *v,
                  struct served_error *error)
{
    size_t known = 0;
    *v = (struct variant){.n = 1,
                          .froude = {run->solver.froude},
                          .formulation = run->solver.formulation,
                          .refine = run->solver.refine};
    for (size_t i = 0; i < run->verify_froudes && !isnan(run->speeds); i++)
        v->froude[v->n++] = run->verify_froude[i];
    for (size_t k = 0; k < N_KEYS; k++) {
        const json_t *value = json_object_get(config, KEYS[k].key);
        known += value != NULL;
        if (value && !KEYS[k].read(value, v, error))
            return false;
    }
    if (known != json_object_size(config))
        return served_fail(error, SERVED_INVALID_INPUT,
                           "config has a key other than froude, formulation and refine");
    return isnan(run->pressure) || igabem_formulation_info(v->formulation)->pressure ||
           served_fail(error, SERVED_INVALID_INPUT,
                       "config.formulation is %s, which has no resistance by pressure, but the run "
                       "constrains it",
                       igabem_formulation_name(v->formulation));
}

void variant_apply(const struct variant *v, const struct config *run, struct config *config)
{
    *config = *run;
    config->displacement = NAN;
    if (v->as_run)
        return;
    config->solver.froude = v->froude[0];
    config->solver.formulation = v->formulation;
    config->solver.refine = v->refine;
    config->models = 0;
    config->verify_froudes = v->n - 1;
    memcpy(config->verify_froude, v->froude + 1, (v->n - 1) * sizeof *v->froude);
    config->speeds = v->n > 1 ? INFINITY : NAN;
}

bool variant_equal(const struct variant *a, const struct variant *b)
{
    return a->as_run == b->as_run && a->n == b->n && a->formulation == b->formulation &&
           a->refine == b->refine && memcmp(a->froude, b->froude, a->n * sizeof *a->froude) == 0;
}

/* What is told of a design beside resistance and constraints. */
static const struct {
    const char *name;
    size_t offset;
} FIGURES[] = {{"volume, m^3", offsetof(struct evaluation, volume)},
               {"wetted area, m^2", offsetof(struct evaluation, wetted_area)},
               {"steepest waterline, |nu_x|", offsetof(struct evaluation, nu_s)},
               {"least share of a half breadth kept", offsetof(struct evaluation, breadth)},
               {"R_w at the first speed, N", offsetof(struct evaluation, rw)}};
enum { N_FIGURES = sizeof FIGURES / sizeof *FIGURES };

/* Calls use(user_data, figures) for every constraint that the run has. */
static size_t constraints(const struct config *run, const struct evaluation *parent,
                          const struct evaluation *design, double *value, json_t *names)
{
    size_t n = 0;
    for (size_t k = 0; k < constraints_count(); k++) {
        struct constraint_figures f;
        constraints_figures(run, k, parent, design, &f);
        if (isnan(f.allowed))
            continue;
        if (value)
            value[n] = f.excess;
        if (names)
            json_array_append_new(names, json_string(f.name));
        n++;
    }
    return n;
}

static size_t count_constraints(const struct config *run)
{
    struct evaluation none;
    evaluation_start(0, NULL, NULL, &none);
    return constraints(run, &none, &none, NULL, NULL);
}

void variant_sizes(const struct variant *v, const struct config *run, size_t sizes[SERVED_OUTPUTS])
{
    if (v->as_run) {
        remote_sizes(run, sizes);
        return;
    }
    sizes[0] = v->n;
    sizes[1] = count_constraints(run);
    sizes[2] = N_FIGURES;
}

void variant_output(const struct variant *v, const struct config *run,
                    const struct evaluation *parent, const struct evaluation *design,
                    double *output)
{
    if (v->as_run) {
        remote_write(run, design, output);
        return;
    }
    *output++ = design->cw;
    for (size_t i = 1; i < v->n; i++)
        *output++ = design->cw_speed[i - 1];
    output += constraints(run, parent, design, output, NULL);
    for (size_t k = 0; k < N_FIGURES; k++)
        *output++ = *(const double *)(const void *)((const char *)design + FIGURES[k].offset);
}

json_t *variant_labels(const struct config *run)
{
    json_t *speeds = json_pack("[s]", "C_w at each of config.froude"), *limits = json_array(),
           *figures = json_array();
    struct evaluation none;
    evaluation_start(0, NULL, NULL, &none);
    constraints(run, &none, &none, NULL, limits);
    for (size_t k = 0; k < N_FIGURES; k++)
        json_array_append_new(figures, json_string(FIGURES[k].name));
    return json_pack("[o, o, o]", speeds, limits, figures);
}
