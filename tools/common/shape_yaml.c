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

struct shape_text {
    char *combination, *direction;
    char **phase, **bounds;
    unsigned phase_count, bounds_count;
    struct box_text box;
    struct function_text *functions;
    unsigned functions_count;
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

static const cyaml_schema_field_t shape_fields[] = {
    WORD(combination, shape_text),
    WORD(direction, shape_text),
    NUMBERS(phase, shape_text, 3, CYAML_FLAG_OPTIONAL),
    NUMBERS(bounds, shape_text, 2, CYAML_FLAG_OPTIONAL),
    CYAML_FIELD_MAPPING("box", CYAML_FLAG_OPTIONAL, struct shape_text, box, box_fields),
    CYAML_FIELD_SEQUENCE("functions", CYAML_FLAG_POINTER, struct shape_text, functions,
                         &function_entry, 1, CYAML_UNLIMITED),
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
    *out = GALV_RECURSIVE;
    if (!text || strcmp(text, "recursive") == 0)
        return true;
    *out = GALV_LINEAR;
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
        cli_yaml_fail(path, field, "has no bounds, and none are given for all functions");
        return false;
    }
    return read_numbers(path, field, text->order, 3, function->order) &&
           (!phase ||
            read_numbers(path, text->phase ? field : "phase", phase, 3, function->phase)) &&
           read_numbers(path, text->bounds ? field : "bounds", limits, 2, bounds) &&
           (!direction || read_direction(path, text->direction ? field : "direction", direction,
                                         &function->direction));
}

static bool interpret(const char *path, const struct shape_text *text, size_t npoints,
                      const double *xyz, struct shape_definition *definition)
{
    if (!shape_definition_allocate(text->functions_count, definition)) {
        cli_fail("out of memory");
        return false;
    }
    bool ok = read_combination(path, text->combination, &definition->combination) &&
              read_box(path, &text->box, npoints, xyz, &definition->box);
    for (size_t i = 0; ok && i < definition->n; i++) {
        double bounds[2];
        ok = read_function(path, i, &text->functions[i], text, &definition->functions[i], bounds);
        if (ok) {
            definition->lower[i] = bounds[0];
            definition->upper[i] = bounds[1];
        }
    }
    if (!ok)
        shape_definition_free(definition);
    return ok;
}

bool shape_definition_allocate(size_t n, struct shape_definition *definition)
{
    *definition = (struct shape_definition){.n = n};
    definition->functions = calloc(n, sizeof *definition->functions);
    definition->lower = calloc(n, sizeof *definition->lower);
    definition->upper = calloc(n, sizeof *definition->upper);
    if (definition->functions && definition->lower && definition->upper)
        return true;
    shape_definition_free(definition);
    return false;
}

void shape_definition_free(struct shape_definition *definition)
{
    free(definition->functions);
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
    return galv_shape_sine(definition->n, definition->functions, &definition->box,
                           definition->lower, definition->upper, definition->combination, shape);
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

/* Sections x girth when i,j run over a full rectangle, i slow; 0 otherwise. */
static void find_rectangle(const struct cli_table *table, int ci, int cj, size_t *sections,
                           size_t *girth)
{
    *sections = *girth = 0;
    if (ci < 0 || cj < 0 || table->rows == 0)
        return;
    const double *v = table->values;
    size_t columns = table->columns, n = 1;
    while (n < table->rows && v[n * columns + (size_t)ci] == v[(size_t)ci])
        n++;
    if (table->rows % n)
        return;
    for (size_t r = 0; r < table->rows; r++)
        if (v[r * columns + (size_t)ci] != v[(size_t)ci] + (double)(r / n) ||
            v[r * columns + (size_t)cj] != v[(size_t)cj] + (double)(r % n))
            return;
    *sections = table->rows / n;
    *girth = n;
}

bool hull_grid_read(const char *path, double **xyz, size_t *npoints, size_t *sections,
                    size_t *girth)
{
    struct cli_table table;
    if (!cli_table_read(path, &table))
        return false;
    int c[3] = {cli_table_column(&table, "x"), cli_table_column(&table, "y"),
                cli_table_column(&table, "z")};
    bool ok = c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && table.rows > 0;
    if (!ok)
        cli_fail("%s: expected rows with the columns x, y and z", path);
    *npoints = table.rows;
    *xyz = ok ? malloc(3 * table.rows * sizeof **xyz) : NULL;
    if (ok && !*xyz) {
        cli_fail("out of memory");
        ok = false;
    }
    for (size_t r = 0; ok && r < table.rows; r++)
        for (size_t j = 0; j < 3; j++)
            (*xyz)[3 * r + j] = table.values[r * table.columns + (size_t)c[j]];
    if (ok)
        find_rectangle(&table, cli_table_column(&table, "i"), cli_table_column(&table, "j"),
                       sections, girth);
    cli_table_free(&table);
    return ok;
}
