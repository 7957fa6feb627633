#include "core/error.h"
#include "core/textfile.h"

#include <nurbs/io.h>

#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Where in the file a value stands, for messages: "hull.json: patch 2: knots[0]". */
typedef struct place {
    const char *path;
    size_t patch;
} place;

static nurbs_status wrong(const place *at, const char *field, const char *expected)
{
    return nurbs_fail(NURBS_ERROR_FORMAT, "%s: patch %zu: %s: expected %s", at->path, at->patch,
                      field, expected);
}

static nurbs_status read_numbers(const place *at, const char *field, const json_t *list, size_t n,
                                 double *values)
{
    if (!json_is_array(list) || json_array_size(list) != n)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: patch %zu: %s: expected a list of %zu numbers, found %zu", at->path,
                          at->patch, field, n, json_array_size(list));
    for (size_t k = 0; k < n; k++) {
        const json_t *item = json_array_get(list, k);
        if (!json_is_number(item))
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s: patch %zu: %s[%zu] is not a number",
                              at->path, at->patch, field, k);
        values[k] = json_number_value(item);
    }
    return NURBS_OK;
}

static nurbs_status read_pair(const place *at, const char *field, const json_t *patch,
                              json_int_t least, json_int_t most, size_t pair[2])
{
    const json_t *list = json_object_get(patch, field);
    if (!json_is_array(list) || json_array_size(list) != 2)
        return wrong(at, field, "two integers");
    for (size_t d = 0; d < 2; d++) {
        const json_t *item = json_array_get(list, d);
        if (!json_is_integer(item) || json_integer_value(item) < least ||
            json_integer_value(item) > most)
            return nurbs_fail(NURBS_ERROR_FORMAT,
                              "%s: patch %zu: %s[%zu]: expected an integer from %lld to %lld",
                              at->path, at->patch, field, d, (long long)least, (long long)most);
        pair[d] = (size_t)json_integer_value(item);
    }
    return NURBS_OK;
}

static nurbs_status read_points(const place *at, const json_t *list, size_t n, double *points)
{
    if (!json_is_array(list) || json_array_size(list) != n)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: patch %zu: points: expected a list of %zu points, found %zu",
                          at->path, at->patch, n, json_array_size(list));
    for (size_t k = 0; k < n; k++) {
        char field[40];
        snprintf(field, sizeof field, "points[%zu]", k);
        nurbs_status status = read_numbers(at, field, json_array_get(list, k), 3, points + 3 * k);
        if (status != NURBS_OK)
            return status;
    }
    return NURBS_OK;
}

static nurbs_status read_arrays(const place *at, const json_t *patch, const int degree[2],
                                const size_t size[2], double *knots[2], double *points,
                                double *weights)
{
    const json_t *both = json_object_get(patch, "knots"),
                 *given = json_object_get(patch, "weights");
    if (!json_is_array(both) || json_array_size(both) != 2)
        return wrong(at, "knots", "two lists");
    nurbs_status status = NURBS_OK;
    for (size_t d = 0; d < 2 && status == NURBS_OK; d++)
        status = read_numbers(at, d ? "knots[1]" : "knots[0]", json_array_get(both, d),
                              size[d] + (size_t)degree[d] + 1, knots[d]);
    if (status == NURBS_OK)
        status = read_points(at, json_object_get(patch, "points"), size[0] * size[1], points);
    if (status == NURBS_OK && given)
        status = read_numbers(at, "weights", given, size[0] * size[1], weights);
    return status;
}

static nurbs_status read_surface(const place *at, const json_t *patch, nurbs_surface **surface)
{
    size_t pair[2], size[2];
    *surface = NULL;
    if (!json_is_object(patch))
        return wrong(at, "patch", "an object");
    nurbs_status status = read_pair(at, "degree", patch, 1, 25, pair);
    if (status == NURBS_OK)
        status = read_pair(at, "size", patch, 2, 1000000, size);
    if (status != NURBS_OK)
        return status;
    const json_t *points_given = json_object_get(patch, "points");
    if (json_array_size(points_given) != size[0] * size[1])
        return read_points(at, points_given, size[0] * size[1], NULL);
    int degree[2] = {(int)pair[0], (int)pair[1]};
    size_t nu = size[0] + pair[0] + 1, nv = size[1] + pair[1] + 1, n = size[0] * size[1];
    double *memory = malloc((nu + nv + 4 * n) * sizeof *memory);
    if (!memory)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: patch %zu: no memory for %zu points", at->path,
                          at->patch, n);
    double *knots[2] = {memory, memory + nu}, *points = memory + nu + nv,
           *weights = json_object_get(patch, "weights") ? points + 3 * n : NULL;
    status = read_arrays(at, patch, degree, size, knots, points, weights);
    if (status == NURBS_OK) {
        status = nurbs_surface_create(degree, size, knots[0], knots[1], points, weights, surface);
        if (status != NURBS_OK) {
            char reason[256];
            snprintf(reason, sizeof reason, "%s", nurbs_last_error());
            status =
                nurbs_fail(NURBS_ERROR_FORMAT, "%s: patch %zu: %s", at->path, at->patch, reason);
        }
    }
    free(memory);
    return status;
}

static nurbs_status read_parameters(const place *at, const json_t *patch, nurbs_patches *patches)
{
    const json_t *both = json_object_get(patch, "parameters");
    if (!both)
        return NURBS_OK;
    if (!json_is_array(both) || json_array_size(both) != 2)
        return wrong(at, "parameters", "two lists");
    size_t rows = json_array_size(json_array_get(both, 0)),
           columns = json_array_size(json_array_get(both, 1));
    double *values = malloc((rows + columns + 1) * sizeof *values);
    if (!values)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu parameters", at->path,
                          rows + columns);
    nurbs_status status = read_numbers(at, "parameters[0]", json_array_get(both, 0), rows, values);
    if (status == NURBS_OK)
        status = read_numbers(at, "parameters[1]", json_array_get(both, 1), columns, values + rows);
    if (status == NURBS_OK && nurbs_patches_set_parameters(patches, at->patch, rows, values,
                                                           columns, values + rows) != NURBS_OK)
        status = wrong(at, "parameters", "numbers that increase inside the domain");
    free(values);
    return status;
}

static nurbs_status read_heading(const char *path, const json_t *root, nurbs_patches *patches)
{
    const json_t *format = json_object_get(root, "format"),
                 *version = json_object_get(root, "version"), *unit = json_object_get(root, "unit"),
                 *lpp = json_object_get(root, "lpp"), *note = json_object_get(root, "note");
    if (!json_is_string(format) || strcmp(json_string_value(format), "nurbs") != 0)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: format: expected \"nurbs\"", path);
    if (json_is_integer(version) && json_integer_value(version) != 1)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: version is %lld, expected 1", path,
                          (long long)json_integer_value(version));
    if (!json_is_integer(version))
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: version: expected 1", path);
    if (unit && (!json_is_string(unit) || strcmp(json_string_value(unit), "m") != 0))
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: unit: expected \"m\"", path);
    if (lpp && (!json_is_number(lpp) ||
                nurbs_patches_set_length(patches, json_number_value(lpp)) != NURBS_OK))
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: lpp: expected a length in metres", path);
    if (note && !json_is_string(note))
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: note: expected a string", path);
    return note ? nurbs_patches_set_note(patches, json_string_value(note)) : NURBS_OK;
}

static nurbs_status read_root(const char *path, const json_t *root, nurbs_patches *patches)
{
    nurbs_status status = read_heading(path, root, patches);
    if (status != NURBS_OK)
        return status;
    const json_t *list = json_object_get(root, "patches");
    if (!json_is_array(list) || json_array_size(list) == 0)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: patches: expected a list of patches", path);
    for (size_t k = 0; k < json_array_size(list) && status == NURBS_OK; k++) {
        const place at = {path, k};
        nurbs_surface *surface;
        status = read_surface(&at, json_array_get(list, k), &surface);
        if (status == NURBS_OK)
            status = nurbs_patches_add(patches, surface);
        if (status == NURBS_OK)
            status = read_parameters(&at, json_array_get(list, k), patches);
        nurbs_surface_free(surface);
    }
    return status;
}

/* jansson tells some lacks of memory as invalid tokens. A text that it refuses a second time, while
 * there is memory for several of it, is at fault itself. */
static nurbs_status parse(const char *path, const char *text, size_t length, json_t **root)
{
    json_error_t error;
    *root = json_loadb(text, length, JSON_REJECT_DUPLICATES, &error);
    if (!*root)
        *root = json_loadb(text, length, JSON_REJECT_DUPLICATES, &error);
    if (*root)
        return NURBS_OK;
    void *room = malloc(8 * length + 65536);
    bool memory = room != NULL && json_error_code(&error) != json_error_out_of_memory;
    free(room);
    return memory ? nurbs_fail(NURBS_ERROR_FORMAT, "%s:%d: %s", path, error.line, error.text)
                  : nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu bytes", path, 8 * length);
}

nurbs_status nurbs_patches_read_json(const char *path, nurbs_patches **patches)
{
    NURBS_NEED(path && patches);
    char *text;
    size_t length;
    *patches = NULL;
    nurbs_status status = textfile_read(path, &text, &length);
    if (status != NURBS_OK)
        return status;
    json_t *root;
    status = parse(path, text, length, &root);
    free(text);
    if (status != NURBS_OK)
        return status;
    status = json_is_object(root)
                 ? nurbs_patches_create(patches)
                 : nurbs_fail(NURBS_ERROR_FORMAT, "%s: expected a JSON object", path);
    if (status == NURBS_OK)
        status = read_root(path, root, *patches);
    json_decref(root);
    if (status != NURBS_OK) {
        nurbs_patches_free(*patches);
        *patches = NULL;
    }
    return status;
}

/* As an integer, JSON's -0 would lose its sign. */
static void write_number(FILE *stream, double value)
{
    if (value == 0 && signbit(value))
        fprintf(stream, "-0.0");
    else
        fprintf(stream, "%.17g", value);
}

static void write_numbers(FILE *stream, size_t n, const double *values)
{
    for (size_t k = 0; k < n; k++) {
        fprintf(stream, "%s%s", k ? "," : "", k && k % 8 == 0 ? "\n" : "");
        write_number(stream, values[k]);
    }
}

static void write_two_lists(FILE *stream, const char *name, const size_t n[2],
                            const double *const values[2])
{
    fprintf(stream, ",\n\"%s\":[[", name);
    write_numbers(stream, n[0], values[0]);
    fprintf(stream, "],\n[");
    write_numbers(stream, n[1], values[1]);
    fprintf(stream, "]]");
}

static void write_patch(FILE *stream, const nurbs_patches *patches, size_t index)
{
    const nurbs_surface *surface = nurbs_patches_get(patches, index);
    const size_t size[2] = {nurbs_surface_size(surface, 0), nurbs_surface_size(surface, 1)};
    const int degree[2] = {nurbs_surface_degree(surface, 0), nurbs_surface_degree(surface, 1)};
    const double *points = nurbs_surface_points(surface), *weights = nurbs_surface_weights(surface);
    fprintf(stream, "{\"degree\":[%d,%d],\"size\":[%zu,%zu]", degree[0], degree[1], size[0],
            size[1]);
    const size_t knots[2] = {size[0] + (size_t)degree[0] + 1, size[1] + (size_t)degree[1] + 1};
    write_two_lists(
        stream, "knots", knots,
        (const double *const[]){nurbs_surface_knots(surface, 0), nurbs_surface_knots(surface, 1)});
    size_t n = size[0] * size[1], count[2];
    fprintf(stream, ",\n\"points\":[");
    for (size_t k = 0; k < n; k++) {
        fprintf(stream, "%s[", k ? ",\n" : "");
        write_numbers(stream, 3, points + 3 * k);
        fprintf(stream, "]");
    }
    fprintf(stream, "]");
    if (weights) {
        fprintf(stream, ",\n\"weights\":[");
        write_numbers(stream, n, weights);
        fprintf(stream, "]");
    }
    const double *values[2];
    for (int d = 0; d < 2; d++)
        count[d] = nurbs_patches_parameters(patches, index, d, &values[d]);
    if (count[0] > 0)
        write_two_lists(stream, "parameters", count, values);
    fprintf(stream, "}");
}

/* A JSON string with its quotes; the caller frees it. NULL: not UTF-8. */
static char *quoted(const char *text)
{
    json_t *value = json_string(text);
    char *result = value ? json_dumps(value, JSON_ENCODE_ANY) : NULL;
    json_decref(value);
    return result;
}

nurbs_status nurbs_patches_write_json(const nurbs_patches *patches, const char *path)
{
    NURBS_NEED(patches && path);
    size_t count = nurbs_patches_count(patches);
    if (count == 0)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s: no patches to write", path);
    char *note = quoted(nurbs_patches_note(patches));
    if (!note)
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "%s: the note is not UTF-8 text, or there is no memory for it", path);
    outfile file;
    nurbs_status status = outfile_open(&file, path);
    if (status == NURBS_OK) {
        fprintf(file.stream, "{\"format\":\"nurbs\",\"version\":1,\"unit\":\"m\"");
        if (nurbs_patches_length(patches) > 0)
            fprintf(file.stream, ",\"lpp\":%.17g", nurbs_patches_length(patches));
        if (strcmp(note, "\"\"") != 0)
            fprintf(file.stream, ",\n\"note\":%s", note);
        fprintf(file.stream, ",\n\"patches\":[\n");
        for (size_t k = 0; k < count; k++) {
            fprintf(file.stream, "%s", k ? ",\n" : "");
            write_patch(file.stream, patches, k);
        }
        fprintf(file.stream, "]}\n");
        status = outfile_commit(&file);
    }
    free(note);
    return status;
}
