/* What an assembly of a STEP file puts where. */
#include "io/step_assembly.h"

#include "core/error.h"
#include "core/vector.h"

#include <stdlib.h>
#include <string.h>

step_place step_after(const step_place *outer, const step_place *inner)
{
    step_place result;
    for (int i = 0; i < 3; i++) {
        const double *row = outer->matrix + 3 * i;
        for (int j = 0; j < 3; j++)
            result.matrix[3 * i + j] = row[0] * inner->matrix[j] + row[1] * inner->matrix[3 + j] +
                                       row[2] * inner->matrix[6 + j];
        result.shift[i] = dot3(row, inner->shift) + outer->shift[i];
    }
    return result;
}

step_place step_of_frame(const double origin[3], double frame[3][3])
{
    step_place p;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            p.matrix[3 * i + j] = frame[j][i];
        p.shift[i] = origin[i];
    }
    return p;
}

step_place step_inverse(const step_place *p)
{
    step_place result;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            result.matrix[3 * i + j] = p->matrix[3 * j + i];
    for (int i = 0; i < 3; i++)
        result.shift[i] = -dot3(result.matrix + 3 * i, p->shift);
    return result;
}

size_t step_root(const step_assembly *s, size_t instance)
{
    while (s->same[instance] != instance)
        instance = s->same[instance];
    return instance;
}

/* Representation of a product definition, by SHAPE_DEFINITION_REPRESENTATION; count: none. */
static size_t shape_of(const step_file *file, size_t product)
{
    for (size_t k = 0; k < file->count; k++) {
        const step_record *record = step_record_of(file, k, "SHAPE_DEFINITION_REPRESENTATION"), *s;
        size_t shape, shown, definition;
        if (record &&
            step_reference(file, k, step_parameter(file, record, 0), &shape) == NURBS_OK &&
            (s = step_record_of(file, shape, "PRODUCT_DEFINITION_SHAPE")) &&
            step_reference(file, shape, step_parameter(file, s, 2), &definition) == NURBS_OK &&
            definition == product &&
            step_reference(file, k, step_parameter(file, record, 1), &shown) == NURBS_OK)
            return shown;
    }
    return file->count;
}

/* Whether the first representation of a placed relationship is the assembly: as the usage says. */
static bool first_is_parent(const step_file *file, const step_assembly *s, size_t relationship,
                            size_t first, size_t second)
{
    for (size_t k = 0; k < file->count; k++) {
        const step_record *record =
                              step_record_of(file, k, "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION"),
                          *p, *u;
        size_t of, shape, usage, parent;
        if (!record || step_reference(file, k, step_parameter(file, record, 0), &of) != NURBS_OK ||
            of != relationship ||
            step_reference(file, k, step_parameter(file, record, 1), &shape) != NURBS_OK ||
            !(p = step_record_of(file, shape, "PRODUCT_DEFINITION_SHAPE")) ||
            step_reference(file, shape, step_parameter(file, p, 2), &usage) != NURBS_OK ||
            !(u = step_record_of(file, usage, "NEXT_ASSEMBLY_USAGE_OCCURRENCE")) ||
            step_reference(file, usage, step_parameter(file, u, 3), &parent) != NURBS_OK)
            continue;
        size_t shown = shape_of(file, parent);
        return shown < file->count && step_root(s, shown) == step_root(s, first) &&
               step_root(s, shown) != step_root(s, second);
    }
    return false;
}

/* ITEM_DEFINED_TRANSFORMATION: the placement of item 1 in representation 1 falls on that of item 2
 * in representation 2. Gives the place of 1 in 2. */
static nurbs_status item_transformation(step_file *file, size_t operation, size_t first,
                                        size_t second, step_place *at)
{
    const step_record *record = step_record_of(file, operation, "ITEM_DEFINED_TRANSFORMATION");
    step_place item[2];
    nurbs_status status = NURBS_OK;
    if (!record)
        return step_refuse(file, operation, "expected an ITEM_DEFINED_TRANSFORMATION");
    for (size_t k = 0; k < 2 && status == NURBS_OK; k++) {
        size_t index;
        double origin[3], frame[3][3];
        status = step_use_units_of(file, k ? second : first);
        if (status == NURBS_OK)
            status = step_reference(file, operation, step_parameter(file, record, 2 + k), &index);
        if (status == NURBS_OK)
            status = step_placement(file, index, origin, frame);
        if (status == NURBS_OK)
            item[k] = step_of_frame(origin, frame);
    }
    if (status != NURBS_OK)
        return status;
    item[0] = step_inverse(&item[0]);
    *at = step_after(&item[1], &item[0]);
    return NURBS_OK;
}

static nurbs_status add_link(step_assembly *s, const step_link *l)
{
    if (s->links == s->room) {
        size_t room = s->room ? 2 * s->room : 16;
        step_link *larger = realloc(s->link, room * sizeof *larger);
        if (!larger)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu placements", room);
        s->link = larger;
        s->room = room;
    }
    s->link[s->links++] = *l;
    return NURBS_OK;
}

/* Both representations of a relationship; false if the instance is none. */
static bool relationship(const step_file *file, size_t instance, size_t pair[2])
{
    static const char *const names[] = {"REPRESENTATION_RELATIONSHIP",
                                        "SHAPE_REPRESENTATION_RELATIONSHIP"};
    for (size_t k = 0; k < 2; k++) {
        const step_record *record = step_record_of(file, instance, names[k]);
        if (record && step_parameter(file, record, 3) &&
            step_reference(file, instance, step_parameter(file, record, 2), &pair[0]) == NURBS_OK &&
            step_reference(file, instance, step_parameter(file, record, 3), &pair[1]) == NURBS_OK)
            return true;
    }
    return false;
}

/* First what shares coordinates, then what is placed. */
static nurbs_status find_links(step_file *file, step_assembly *s)
{
    static const char transformed[] = "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION";
    size_t pair[2];
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < file->count; k++)
        if (relationship(file, k, pair) && !step_record_of(file, k, transformed))
            s->same[step_root(s, pair[0])] = step_root(s, pair[1]);
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++) {
        const step_record *record = step_record_of(file, k, transformed);
        size_t operation;
        step_link l;
        if (!record || !relationship(file, k, pair))
            continue;
        status = step_reference(file, k, step_parameter(file, record, 0), &operation);
        if (status == NURBS_OK)
            status = item_transformation(file, operation, pair[0], pair[1], &l.at);
        if (status != NURBS_OK)
            return status;
        bool turned = first_is_parent(file, s, k, pair[0], pair[1]);
        l.inside = pair[turned];
        l.parent = pair[!turned];
        if (turned)
            l.at = step_inverse(&l.at);
        status = add_link(s, &l);
    }
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++) {
        const step_record *map = step_record_of(file, k, "REPRESENTATION_MAP");
        size_t mapped;
        if (map && step_reference(file, k, step_parameter(file, map, 1), &mapped) == NURBS_OK)
            s->used[step_root(s, mapped)] = 1;
    }
    for (size_t k = 0; k < s->links; k++)
        s->used[step_root(s, s->link[k].inside)] = 1;
    return status;
}

nurbs_status step_assembly_find(step_file *file, step_assembly *assembly)
{
    *assembly = (step_assembly){.same = malloc(file->count * sizeof(size_t)),
                                .used = calloc(file->count, 1)};
    if (!assembly->same || !assembly->used)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu instances", file->path,
                          file->count);
    for (size_t k = 0; k < file->count; k++)
        assembly->same[k] = k;
    return find_links(file, assembly);
}

void step_assembly_free(step_assembly *assembly)
{
    free(assembly->link);
    free(assembly->same);
    free(assembly->used);
}
