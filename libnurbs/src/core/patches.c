#include "core/error.h"

#include <nurbs/patches.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct patch {
    nurbs_surface *surface;
    size_t count[2]; /* design grid: rows, columns; 0: none */
    double *parameters[2];
};

struct nurbs_patches {
    size_t count, room;
    struct patch *patch;
    char *note;
    double length;
};

nurbs_status nurbs_patches_create(nurbs_patches **patches)
{
    NURBS_NEED(patches);
    *patches = calloc(1, sizeof **patches);
    if (!*patches)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a set of patches");
    return NURBS_OK;
}

void nurbs_patches_free(nurbs_patches *patches)
{
    if (!patches)
        return;
    for (size_t k = 0; k < patches->count; k++) {
        nurbs_surface_free(patches->patch[k].surface);
        free(patches->patch[k].parameters[0]);
        free(patches->patch[k].parameters[1]);
    }
    free(patches->patch);
    free(patches->note);
    free(patches);
}

nurbs_status nurbs_patches_add(nurbs_patches *patches, const nurbs_surface *surface)
{
    NURBS_NEED(patches && surface);
    if (patches->count == patches->room) {
        size_t room = patches->room ? 2 * patches->room : 8;
        struct patch *larger = realloc(patches->patch, room * sizeof *larger);
        if (!larger)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", room);
        patches->patch = larger;
        patches->room = room;
    }
    struct patch added = {0};
    nurbs_status status = nurbs_surface_copy(surface, &added.surface);
    if (status == NURBS_OK)
        patches->patch[patches->count++] = added;
    return status;
}

size_t nurbs_patches_count(const nurbs_patches *patches)
{
    return patches ? patches->count : 0;
}

const nurbs_surface *nurbs_patches_get(const nurbs_patches *patches, size_t index)
{
    return patches && index < patches->count ? patches->patch[index].surface : NULL;
}

nurbs_status nurbs_patches_set_note(nurbs_patches *patches, const char *text)
{
    NURBS_NEED(patches);
    size_t bytes = text ? strlen(text) + 1 : 1;
    char *copy = malloc(bytes);
    if (!copy)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a note of %zu bytes", bytes);
    memcpy(copy, text ? text : "", bytes);
    free(patches->note);
    patches->note = copy;
    return NURBS_OK;
}

const char *nurbs_patches_note(const nurbs_patches *patches)
{
    return patches && patches->note ? patches->note : "";
}

nurbs_status nurbs_patches_set_length(nurbs_patches *patches, double length)
{
    NURBS_NEED(patches);
    if (!(isfinite(length) && length >= 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "length %g, expected a finite length >= 0", length);
    patches->length = length;
    return NURBS_OK;
}

double nurbs_patches_length(const nurbs_patches *patches)
{
    return patches ? patches->length : 0;
}

static nurbs_status check_parameters(const nurbs_surface *surface, int direction, size_t n,
                                     const double *values)
{
    static const char name[2] = {'u', 'v'};
    const double *knots = nurbs_surface_knots(surface, direction);
    double first = knots[0], last = knots[nurbs_surface_size(surface, direction)];
    if (n < 2)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%zu parameters %c, expected at least 2", n,
                          name[direction]);
    for (size_t k = 0; k < n; k++)
        if (!(values[k] >= first && values[k] <= last) || (k > 0 && !(values[k] > values[k - 1])))
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "parameter %c[%zu] is %g: parameters increase inside [%g, %g]",
                              name[direction], k, values[k], first, last);
    return NURBS_OK;
}

nurbs_status nurbs_patches_set_parameters(nurbs_patches *patches, size_t index, size_t rows,
                                          const double *u, size_t columns, const double *v)
{
    NURBS_NEED(patches && (rows == 0 || u) && (columns == 0 || v));
    if (index >= patches->count)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "patch %zu of %zu", index, patches->count);
    struct patch *patch = &patches->patch[index];
    const size_t count[2] = {rows, columns};
    const double *const values[2] = {u, v};
    double *copy[2] = {NULL, NULL};
    nurbs_status status = NURBS_OK;
    for (int d = 0; d < 2 && (rows > 0 || columns > 0) && status == NURBS_OK; d++) {
        status = check_parameters(patch->surface, d, count[d], values[d]);
        if (status == NURBS_OK && !(copy[d] = malloc(count[d] * sizeof(double))))
            status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu parameters", count[d]);
        if (status == NURBS_OK)
            memcpy(copy[d], values[d], count[d] * sizeof(double));
    }
    if (status != NURBS_OK) {
        free(copy[0]);
        free(copy[1]);
        return status;
    }
    for (int d = 0; d < 2; d++) {
        free(patch->parameters[d]);
        patch->parameters[d] = copy[d];
        patch->count[d] = count[d];
    }
    return NURBS_OK;
}

size_t nurbs_patches_parameters(const nurbs_patches *patches, size_t index, int direction,
                                const double **values)
{
    if (!values)
        return 0;
    *values = NULL;
    if (!patches || index >= patches->count || direction < 0 || direction > 1)
        return 0;
    *values = patches->patch[index].parameters[direction];
    return patches->patch[index].count[direction];
}
