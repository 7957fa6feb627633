#include "shape_yaml.h"

#include "cli.h"
#include "yaml_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct function_text {
    char **order, **phase, **bounds;
    unsigned order_count, phase_count, bounds_count;
    char *direction;
};

struct box_text {
    char **origin, **length;
    unsigned origin_count, length_count;
};

struct lattice_text {
    char **count, **degree, **first, **last, **directions;
    unsigned count_count, degree_count, first_count, last_count, directions_count;
};

struct shape_text {
    char *combination, *direction;
    char **phase, **bounds, **orders;
    unsigned phase_count, bounds_count, orders_count;
    struct box_text box;
    struct function_text *functions;
    unsigned functions_count;
    struct lattice_text *lattice;
};

static const cyaml_schema_value_t number = {
    CYAML_VALUE_STRING(CYAML_FLAG_POINTER, char *, 1, CYAML_UNLIMITED),
};

#define NUMBERS(name, part, count, flags)                                                          \
    CYAML_FIELD_SEQUENCE(#name, CYAML_FLAG_POINTER | (flags), struct part, name, &number, count,   \
                         count)
#define WORD(name, part)                                                                           \
    CYAML_FIELD_STRING_PTR(#name, CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, struct part, name, 1,  \
                           CYAML_UNLIMITED)

static const cyaml_schema_field_t function_fields[] = {
    NUMBERS(order, function_text, 3, CYAML_FLAG_DEFAULT),
    NUMBERS(phase, function_text, 3, CYAML_FLAG_OPTIONAL),
    NUMBERS(bounds, function_text, 2, CYAML_FLAG_OPTIONAL),
    WORD(direction, function_text),
    CYAML_FIELD_END,
};

static const cyaml_schema_value_t function_entry = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct function_text, function_fields),
};

static const cyaml_schema_field_t box_fields[] = {
    NUMBERS(origin, box_text, 3, CYAML_FLAG_OPTIONAL),
    NUMBERS(length, box_text, 3, CYAML_FLAG_OPTIONAL),
    CYAML_FIELD_END,
};

static const cyaml_schema_field_t lattice_fields[] = {
    NUMBERS(count, lattice_text, 3, CYAML_FLAG_DEFAULT),
    NUMBERS(degree, lattice_text, 3, CYAML_FLAG_OPTIONAL),
    NUMBERS(first, lattice_text, 3, CYAML_FLAG_DEFAULT),
    NUMBERS(last, lattice_text, 3, CYAML_FLAG_DEFAULT),
    CYAML_FIELD_SEQUENCE("directions", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL,
                         struct lattice_text, directions, &number, 1, 3),
    CYAML_FIELD_END,
};

static const cyaml_schema_field_t shape_fields[] = {
    WORD(combination, shape_text),
    WORD(direction, shape_text),
    NUMBERS(phase, shape_text, 3, CYAML_FLAG_OPTIONAL),
    NUMBERS(bounds, shape_text, 2, CYAML_FLAG_OPTIONAL),
    NUMBERS(orders, shape_text, 3, CYAML_FLAG_OPTIONAL),
    CYAML_FIELD_MAPPING("box", CYAML_FLAG_OPTIONAL, struct shape_text, box, box_fields),
    CYAML_FIELD_SEQUENCE("functions", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL, struct shape_text,
                         functions, &function_entry, 1, CYAML_UNLIMITED),
    CYAML_FIELD_MAPPING_PTR("lattice", CYAML_FLAG_POINTER_NULL | CYAML_FLAG_OPTIONAL,
                            struct shape_text, lattice, lattice_fields),
    CYAML_FIELD_END,
};

static const cyaml_schema_value_t schema = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, struct shape_text, shape_fields),
};

static bool read_numbers(const char *path, const char *field, char *const *text, unsigned count,
                         double *out)
{
    for (unsigned i = 0; i < count; i++)
        if (!cli_parse_double(text[i], &out[i])) {
            cli_yaml_fail(path, field, "holds '%s', expected a number", text[i]);
            return false;
        }
    return true;
}

static bool read_direction(const char *path, const char *field, const char *text, int *out)
{
    const char *axis = strlen(text) == 1 ? strchr("xyz", *text) : NULL;
    if (!axis) {
        cli_yaml_fail(path, field, "is '%s', expected x, y or z", text);
        return false;
    }
    *out = (int)(axis - "xyz");
    return true;
}

static bool read_combination(const char *path, const char *text, galv_combination *out)
{
    *out = GALV_COMBINATION_RECURSIVE;
    if (!text || strcmp(text, "recursive") == 0)
        return true;
    *out = GALV_COMBINATION_LINEAR;
    if (strcmp(text, "linear") == 0)
        return true;
    cli_yaml_fail(path, "combination", "is '%s', expected recursive or linear", text);
    return false;
}

/* "auto" is the least coordinate of the points for the origin, their extent for the length. */
static bool read_box(const char *path, const struct box_text *text, size_t npoints,
                     const double *xyz, galv_box *box)
{
    for (size_t j = 0; j < 3; j++) {
        double least = INFINITY, greatest = -INFINITY;
        for (size_t p = 0; p < npoints; p++) {
            least = fmin(least, xyz[3 * p + j]);
            greatest = fmax(greatest, xyz[3 * p + j]);
        }
        box->origin[j] = least;
        box->length[j] = greatest - least;
        if (text->origin && strcmp(text->origin[j], "auto") != 0 &&
            !read_numbers(path, "box.origin", &text->origin[j], 1, &box->origin[j]))
            return false;
        if (text->length && strcmp(text->length[j], "auto") != 0 &&
            !read_numbers(path, "box.length", &text->length[j], 1, &box->length[j]))
            return false;
    }
    return true;
}

/* The fields of one function override those given for all. */
static bool read_function(const char *path, size_t i, const struct function_text *text,
                          const struct shape_text *all, galv_sine *function, double bounds[2])
{
    char field[64];
    snprintf(field, sizeof field, "functions.%zu", i);
    *function = (galv_sine){.direction = 1};
    char *const *phase = text->phase ? text->phase : all->phase;
    char *const *limits = text->bounds ? text->bounds : all->bounds;
    const char *direction = text->direction ? text->direction : all->direction;
    if (!limits) {
        cli_yaml_fail(path, all->orders ? "orders" : field,
                      "has no bounds, and none are given for all functions");
        return false;
    }
    return (!text->order || read_numbers(path, field, text->order, 3, function->order)) &&
           (!phase ||
            read_numbers(path, text->phase ? field : "phase", phase, 3, function->phase)) &&
           read_numbers(path, text->bounds ? field : "bounds", limits, 2, bounds) &&
           (!direction || read_direction(path, text->direction ? field : "direction", direction,
                                         &function->direction));
}

static bool interpret_functions(const char *path, const struct shape_text *text,
                                struct shape_definition *definition)
{
    if (!shape_definition_allocate(SHAPE_SINES, text->functions_count, definition)) {
        cli_fail("out of memory");
        return false;
    }
    bool ok = read_combination(path, text->combination, &definition->combination);
    for (size_t i = 0; ok && i < definition->n; i++) {
        double bounds[2];
        ok = read_function(path, i, &text->functions[i], text, &definition->functions[i], bounds);
        if (ok) {
            definition->lower[i] = bounds[0];
            definition->upper[i] = bounds[1];
        }
    }
    return ok;
}

static bool read_indices(const char *path, const char *field, char *const *text, size_t out[3])
{
    for (int j = 0; j < 3; j++)
        if (!cli_parse_size(text[j], &out[j])) {
            cli_yaml_fail(path, field, "holds '%s', expected a whole number", text[j]);
            return false;
        }
    return true;
}

/* Every triple of half-waves from 1 to the number given for its axis, the last axis fastest. */
static bool interpret_orders(const char *path, const struct shape_text *text,
                             struct shape_definition *definition)
{
    static const struct function_text plain;
    size_t most[3], count, n = 0;
    if (!read_indices(path, "orders", text->orders, most))
        return false;
    for (int j = 0; j < 3; j++)
        if (most[j] < 1 || most[j] > 50) {
            cli_yaml_fail(path, "orders", "holds %zu, expected whole numbers from 1 to 50",
                          most[j]);
            return false;
        }
    count = most[0] * most[1] * most[2];
    if (!shape_definition_allocate(SHAPE_SINES, count, definition)) {
        cli_fail("out of memory");
        return false;
    }
    for (; n < count; n++) {
        double bounds[2];
        galv_sine *function = &definition->functions[n];
        if (!read_function(path, n, &plain, text, function, bounds))
            return false;
        function->order[0] = (double)(1 + n / (most[1] * most[2]));
        function->order[1] = (double)(1 + n / most[2] % most[1]);
        function->order[2] = (double)(1 + n % most[2]);
        definition->lower[n] = bounds[0];
        definition->upper[n] = bounds[1];
    }
    return read_combination(path, text->combination, &definition->combination);
}

/* The moved control points are those from `first` to `last`, both included, counted from 0. */
static bool read_lattice(const char *path, const struct lattice_text *text, size_t count[3],
                         size_t degree[3], size_t first[3], size_t last[3])
{
    if (!read_indices(path, "lattice.count", text->count, count) ||
        !read_indices(path, "lattice.first", text->first, first) ||
        !read_indices(path, "lattice.last", text->last, last) ||
        (text->degree && !read_indices(path, "lattice.degree", text->degree, degree)))
        return false;
    for (int j = 0; j < 3; j++) {
        if (!text->degree)
            degree[j] = count[j] ? count[j] - 1 : 0;
        if (first[j] > last[j] || last[j] >= count[j] || count[j] > 1000 || degree[j] > 1000) {
            cli_yaml_fail(path, "lattice.last",
                          "along %c: moved points %zu to %zu of %zu (0 is the first)", "xyz"[j],
                          first[j], last[j], count[j]);
            return false;
        }
    }
    return true;
}

static bool interpret_lattice(const char *path, const struct shape_text *text,
                              struct shape_definition *definition)
{
    const struct lattice_text *lattice = text->lattice;
    size_t count[3], degree[3] = {0, 0, 0}, first[3], last[3], n = 0;
    unsigned axes = lattice->directions ? lattice->directions_count : 1;
    int axis[3] = {1, 1, 1};
    double bounds[2];
    if (!text->bounds) {
        cli_yaml_fail(path, "lattice", "has no bounds beside it");
        return false;
    }
    if (!read_lattice(path, lattice, count, degree, first, last) ||
        !read_numbers(path, "bounds", text->bounds, 2, bounds))
        return false;
    for (unsigned a = 0; lattice->directions && a < axes; a++)
        if (!read_direction(path, "lattice.directions", lattice->directions[a], &axis[a]))
            return false;
    size_t points = (last[0] - first[0] + 1) * (last[1] - first[1] + 1) * (last[2] - first[2] + 1);
    if (!shape_definition_allocate(SHAPE_LATTICE, points * axes, definition)) {
        cli_fail("out of memory");
        return false;
    }
    for (size_t i = first[0]; i <= last[0]; i++)
        for (size_t j = first[1]; j <= last[1]; j++)
            for (size_t k = first[2]; k <= last[2]; k++)
                for (unsigned a = 0; a < axes; a++) {
                    definition->lower[n] = bounds[0];
                    definition->upper[n] = bounds[1];
                    definition->moves[n++] = (galv_lattice_move){{i, j, k}, axis[a]};
                }
    for (int j = 0; j < 3; j++) {
        definition->count[j] = count[j];
        definition->degree[j] = (int)degree[j];
    }
    return true;
}

static bool interpret(const char *path, const struct shape_text *text, size_t npoints,
                      const double *xyz, struct shape_definition *definition)
{
    *definition = (struct shape_definition){.n = 0};
    if ((text->functions != NULL) + (text->orders != NULL) + (text->lattice != NULL) != 1) {
        cli_fail("%s: expected one of functions, orders or a lattice", path);
        return false;
    }
    bool ok = text->functions ? interpret_functions(path, text, definition)
              : text->orders  ? interpret_orders(path, text, definition)
                              : interpret_lattice(path, text, definition);
    ok = ok && read_box(path, &text->box, npoints, xyz, &definition->box);
    if (!ok)
        shape_definition_free(definition);
    return ok;
}

bool shape_definition_allocate(enum shape_kind kind, size_t n, struct shape_definition *definition)
{
    *definition = (struct shape_definition){.kind = kind, .n = n};
    definition->functions = kind == SHAPE_SINES ? calloc(n, sizeof *definition->functions) : NULL;
    definition->moves = kind == SHAPE_LATTICE ? calloc(n, sizeof *definition->moves) : NULL;
    definition->lower = calloc(n, sizeof *definition->lower);
    definition->upper = calloc(n, sizeof *definition->upper);
    if ((definition->functions || definition->moves) && definition->lower && definition->upper)
        return true;
    shape_definition_free(definition);
    return false;
}

void shape_definition_free(struct shape_definition *definition)
{
    free(definition->functions);
    free(definition->moves);
    free(definition->lower);
    free(definition->upper);
    *definition = (struct shape_definition){.n = 0};
}

bool shape_definition_read(const char *path, size_t npoints, const double *xyz,
                           struct shape_definition *definition)
{
    void *data;
    if (!cli_yaml_load(path, &schema, &data))
        return false;
    bool ok = interpret(path, data, npoints, xyz, definition);
    cli_yaml_free(&schema, data);
    return ok;
}

galv_status shape_definition_create(const struct shape_definition *definition, galv_shape **shape)
{
    if (definition->kind == SHAPE_SINES)
        return galv_shape_sine(definition->n, definition->functions, &definition->box,
                               definition->lower, definition->upper, definition->combination,
                               shape);
    galv_lattice lattice = {.box = definition->box};
    for (int j = 0; j < 3; j++) {
        lattice.count[j] = definition->count[j];
        lattice.degree[j] = definition->degree[j];
    }
    return galv_shape_ffd(&lattice, definition->n, definition->moves, definition->lower,
                          definition->upper, shape);
}

galv_shape *shape_yaml_read(const char *path, size_t npoints, const double *xyz)
{
    struct shape_definition definition;
    galv_shape *shape = NULL;
    if (!shape_definition_read(path, npoints, xyz, &definition))
        return NULL;
    if (shape_definition_create(&definition, &shape))
        cli_fail("%s: %s", path, galv_last_error());
    shape_definition_free(&definition);
    return shape;
}
