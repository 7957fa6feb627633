/* The one table of what a model holds: it makes, frees, shows and restores a model. */
#include "error.h"
#include "model.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* Extents are members of the model, by their offset, and what is not one: */
enum { ONE = -1, THREE = -2, ONE_AND_MODES = -3 };

#define AT(member)                    ((int)offsetof(galv_model, member))
#define SIZE(member)                  #member, GALV_TYPE_SIZE, AT(member), 0, ONE, ONE, false
#define VECTOR(member, rows)          #member, GALV_TYPE_DOUBLE, AT(member), 1, rows, ONE, false
#define MATRIX(member, rows, columns) #member, GALV_TYPE_DOUBLE, AT(member), 2, rows, columns, false

static const struct row {
    const char *name;
    galv_type type;
    int offset, dimensions, rows, columns;
    bool unknown; /* may be NaN */
} table[] = {
    {SIZE(samples)},
    {SIZE(points)},
    {SIZE(coordinates)},
    {SIZE(active)},
    {SIZE(parameters)},
    {SIZE(modes)},
    {SIZE(spectrum)},
    {SIZE(kept)},
    {SIZE(passes)},
    {SIZE(method)},
    {"centred", GALV_TYPE_BOOL, AT(centred), 0, ONE, ONE, false},
    {"retained", GALV_TYPE_DOUBLE, AT(retained), 0, ONE, ONE, false},
    {"retained_geometry", GALV_TYPE_DOUBLE, AT(retained_geometry), 0, ONE, ONE, false},
    {"trace", GALV_TYPE_DOUBLE, AT(trace), 0, ONE, ONE, false},
    {"trace_geometry", GALV_TYPE_DOUBLE, AT(trace_geometry), 0, ONE, ONE, false},
    {"truncation", GALV_TYPE_DOUBLE, AT(truncation), 0, ONE, ONE, false},
    {"retained_fresh", GALV_TYPE_DOUBLE, AT(confidence.retained_fresh), 0, ONE, ONE, true},
    {"retained_error", GALV_TYPE_DOUBLE, AT(confidence.retained_error), 0, ONE, ONE, true},
    {"subspace_angle", GALV_TYPE_DOUBLE, AT(confidence.angle), 0, ONE, ONE, true},
    {VECTOR(eigenvalues, AT(spectrum))},
    {VECTOR(residuals, AT(spectrum))},
    {VECTOR(mse, AT(spectrum))},
    {MATRIX(vectors, AT(kept), AT(coordinates))},
    {VECTOR(mean, AT(coordinates))},
    {MATRIX(parent, AT(points), THREE)},
    {VECTOR(weights, AT(coordinates))},
    {MATRIX(latent, AT(samples), AT(modes))},
    {VECTOR(lower, AT(modes))},
    {VECTOR(upper, AT(modes))},
    {MATRIX(regression, AT(parameters), ONE_AND_MODES)},
};

enum { FIELDS = sizeof table / sizeof *table };

static size_t extent(const galv_model *model, int code)
{
    switch (code) {
    case ONE:
        return 1;
    case THREE:
        return 3;
    case ONE_AND_MODES:
        return 1 + model->modes;
    default:
        return *(const size_t *)((const char *)model + code);
    }
}

static void *member(galv_model *model, const struct row *row)
{
    return (char *)model + row->offset;
}

/* The pointer of an array in the model. */
static double **array(galv_model *model, const struct row *row)
{
    return member(model, row);
}

static size_t array_size(const galv_model *model, const struct row *row)
{
    return extent(model, row->rows) * extent(model, row->columns);
}

galv_model *galv_model_new(const galv_model *sizes, bool weighted)
{
    galv_model *model = malloc(sizeof *model);
    if (!model)
        return NULL;
    *model = *sizes;
    bool ok = true;
    for (const struct row *row = table; row < table + FIELDS; row++) {
        if (!row->dimensions)
            continue;
        size_t size = row->offset == AT(weights) && !weighted ? 0 : array_size(model, row);
        double *values = size ? calloc(size, sizeof *values) : NULL;
        *array(model, row) = values;
        ok = ok && (values || !size);
    }
    if (ok)
        return model;
    galv_model_free(model);
    return NULL;
}

void galv_model_free(galv_model *model)
{
    if (!model)
        return;
    for (const struct row *row = table; row < table + FIELDS; row++)
        if (row->dimensions)
            free(*array(model, row));
    free(model);
}

size_t galv_model_field_count(void)
{
    return FIELDS;
}

galv_field galv_model_field(const galv_model *model, size_t index)
{
    if (index >= FIELDS)
        return (galv_field){.name = ""};
    const struct row *row = table + index;
    galv_field field = {.name = row->name, .type = row->type, .dimensions = row->dimensions};
    if (!model)
        return field;
    field.rows = extent(model, row->rows);
    field.columns = extent(model, row->columns);
    const char *at = (const char *)model + row->offset;
    field.values = row->dimensions ? *(double *const *)at : (const void *)at;
    return field;
}

double galv_field_number(const galv_field *field)
{
    if (!field || !field->values)
        return NAN;
    switch (field->type) {
    case GALV_TYPE_SIZE:
        return (double)*(const size_t *)field->values;
    case GALV_TYPE_BOOL:
        return *(const bool *)field->values;
    default:
        return *(const double *)field->values;
    }
}

/* The field of that name, or an absent one. */
static galv_status find(size_t n, const galv_field *fields, const char *name, galv_field *found)
{
    *found = (galv_field){.name = name};
    for (size_t i = 0; i < n; i++) {
        if (!fields[i].name || strcmp(fields[i].name, name) != 0)
            continue;
        if (found->values)
            return galv_fail(GALV_ERROR_ARGUMENT, "'%s' is given twice", name);
        *found = fields[i];
    }
    return GALV_OK;
}

static galv_status check_names(size_t n, const galv_field *fields)
{
    for (size_t i = 0; i < n; i++) {
        bool known = false;
        for (size_t k = 0; k < FIELDS && fields[i].name; k++)
            known = known || strcmp(fields[i].name, table[k].name) == 0;
        if (!known)
            return galv_fail(GALV_ERROR_ARGUMENT, "a model has no '%s'",
                             fields[i].name ? fields[i].name : "(NULL)");
    }
    return GALV_OK;
}

/* Whole numbers that a double has exactly. */
static const double MOST_SIZE = 9007199254740992;

static galv_status read_number(const struct row *row, const galv_field *field, galv_model *model)
{
    if (!field->values && row->unknown) { /* files from before there was such a figure */
        *(double *)member(model, row) = NAN;
        return GALV_OK;
    }
    if (!field->values || (field->type != row->type && field->type != GALV_TYPE_DOUBLE))
        return galv_fail(GALV_ERROR_ARGUMENT, "'%s' is %s", row->name,
                         field->values ? "of another type" : "missing");
    double value = galv_field_number(field);
    bool whole = value >= 0 && value <= MOST_SIZE && value == floor(value);
    if (row->type == GALV_TYPE_DOUBLE ? !isfinite(value) && !(row->unknown && isnan(value))
                                      : !whole || (row->type == GALV_TYPE_BOOL && value > 1))
        return galv_fail(GALV_ERROR_ARGUMENT, "'%s' is %g", row->name, value);
    if (row->type == GALV_TYPE_DOUBLE)
        *(double *)member(model, row) = value;
    else if (row->type == GALV_TYPE_BOOL)
        *(bool *)member(model, row) = value > 0;
    else
        *(size_t *)member(model, row) = (size_t)value;
    return GALV_OK;
}

static galv_status check_sizes(const galv_model *m)
{
    if (m->samples == 0 || m->modes == 0 || m->kept < m->modes || m->spectrum < m->kept ||
        m->coordinates < m->active || m->active < m->spectrum || m->coordinates / 3 < m->points)
        return galv_fail(
            GALV_ERROR_ARGUMENT,
            "no model has %zu samples, %zu modes, %zu vectors, %zu eigenvalues, %zu of "
            "%zu coordinates moving, %zu points",
            m->samples, m->modes, m->kept, m->spectrum, m->active, m->coordinates, m->points);
    if (m->method == GALV_METHOD_AUTO || m->method > GALV_METHOD_PARAMETERS)
        return galv_fail(GALV_ERROR_ARGUMENT, "'method' is %zu", m->method);
    if (!(m->trace > 0))
        return galv_fail(GALV_ERROR_ARGUMENT, "'trace' is %g", m->trace);
    return GALV_OK;
}

/* Shape and numbers of an array against the sizes in the model. */
static galv_status check_array(const struct row *row, const galv_field *field,
                               const galv_model *model)
{
    size_t rows = extent(model, row->rows), columns = extent(model, row->columns);
    if (!field->values && rows > 0 && row->offset != AT(weights))
        return galv_fail(GALV_ERROR_ARGUMENT, "'%s' is missing", row->name);
    if (!field->values)
        return GALV_OK;
    if (field->type != row->type || field->rows != rows || field->columns != columns)
        return galv_fail(GALV_ERROR_ARGUMENT, "'%s' is %zu x %zu, expected %zu x %zu numbers",
                         row->name, field->rows, field->columns, rows, columns);
    if (columns && rows > SIZE_MAX / sizeof(double) / columns)
        return galv_fail(GALV_ERROR_ARGUMENT, "'%s' is %zu x %zu", row->name, rows, columns);
    const double *values = field->values;
    /* Of the parameters themselves they stand in the order of these; one may move nothing. */
    bool falling = row->offset == AT(eigenvalues) && model->method != GALV_METHOD_PARAMETERS;
    bool positive = falling || row->offset == AT(weights);
    static const double rounding = 1e-9; /* of the largest eigenvalue beside the trace */
    for (size_t i = 0; i < rows * columns; i++)
        if (!isfinite(values[i]) || (positive && !(values[i] > 0)) ||
            (falling && values[i] > (i > 0 ? values[i - 1] : model->trace * (1 + rounding))))
            return galv_fail(GALV_ERROR_ARGUMENT, "'%s': entry %zu is %g%s", row->name, i,
                             values[i],
                             falling    ? ", expected positive and falling numbers"
                             : positive ? ", expected more than 0"
                                        : "");
    return GALV_OK;
}

/* Every field in turn: numbers into the model, or arrays compared with them. */
static galv_status read_fields(size_t n, const galv_field *fields, bool arrays, galv_model *model)
{
    for (const struct row *row = table; row < table + FIELDS; row++) {
        galv_field field;
        if (arrays != (row->dimensions > 0))
            continue;
        galv_status status = find(n, fields, row->name, &field);
        if (!status)
            status = arrays ? check_array(row, &field, model) : read_number(row, &field, model);
        if (status)
            return status;
    }
    return GALV_OK;
}

galv_status galv_model_restore(size_t n, const galv_field *fields, galv_model **out)
{
    if (!fields || !out)
        return galv_fail(GALV_ERROR_ARGUMENT, "fields and result must be given");
    galv_model sizes = {.samples = 0};
    galv_field field;
    galv_status status = check_names(n, fields);
    if (!status)
        status = read_fields(n, fields, false, &sizes);
    if (!status)
        status = check_sizes(&sizes);
    if (!status)
        status = read_fields(n, fields, true, &sizes);
    if (!status)
        status = find(n, fields, "weights", &field);
    if (status)
        return status;
    galv_model *model = galv_model_new(&sizes, field.values != NULL);
    if (!model)
        return galv_fail(GALV_ERROR_MEMORY, "model of %zu modes, %zu coordinates", sizes.modes,
                         sizes.coordinates);
    for (const struct row *row = table; row < table + FIELDS; row++)
        if (row->dimensions && *array(model, row)) {
            find(n, fields, row->name, &field);
            memcpy(*array(model, row), field.values, array_size(model, row) * sizeof(double));
        }
    *out = model;
    return GALV_OK;
}
