/* nurbs_patches_read_step(): representations, their places in assemblies, and the faces in them. */
#include "core/error.h"
#include "core/textfile.h"
#include "io/step.h"
#include "io/vector.h"

#include <nurbs/io.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DEPTH = 32, MOST_PLACED = 20000 };

/* Faces are resampled within this share of the extent of their edges where the caller asks for no
 * tolerance. */
static const double default_share = 1e-6;

/* p -> matrix p + shift */
typedef struct placement {
    double matrix[9], shift[3];
} placement;

static const placement identity = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};

static placement after(const placement *outer, const placement *inner)
{
    placement result;
    for (int i = 0; i < 3; i++) {
        const double *row = outer->matrix + 3 * i;
        for (int j = 0; j < 3; j++)
            result.matrix[3 * i + j] = row[0] * inner->matrix[j] + row[1] * inner->matrix[3 + j] +
                                       row[2] * inner->matrix[6 + j];
        result.shift[i] = dot3(row, inner->shift) + outer->shift[i];
    }
    return result;
}

/* From the coordinates of a frame to those in which it is given. */
static placement of_frame(const double origin[3], double frame[3][3])
{
    placement p;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            p.matrix[3 * i + j] = frame[j][i];
        p.shift[i] = origin[i];
    }
    return p;
}

/* Of a rigid motion. */
static placement inverse(const placement *p)
{
    placement result;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            result.matrix[3 * i + j] = p->matrix[3 * j + i];
    for (int i = 0; i < 3; i++)
        result.shift[i] = -dot3(result.matrix + 3 * i, p->shift);
    return result;
}

/* A representation stands inside another one at a place. */
typedef struct link {
    size_t inside, parent; /* instances */
    placement at;
} link;

typedef struct scene {
    step_file *file;
    double tolerance;
    nurbs_patches *patches;
    placement at; /* of what is being read */
    size_t links, room;
    link *link;
    size_t *same;        /* [instances] a representation that shares coordinates; itself at last */
    unsigned char *used; /* [instances] representations that stand inside others */
    unsigned char *seen; /* [instances] faces that were read */
    size_t faces, exact, pieces, left_out, placed;
} scene;

static bool concerns_one(nurbs_status status)
{
    return status == NURBS_ERROR_GEOMETRY || status == NURBS_ERROR_NUMERIC;
}

static double edge_extent(const cad_face *f)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t k = 0; k < f->count; k++)
        for (size_t i = 0; i < f->loop[k].count; i++) {
            const double *p = nurbs_curve_points(f->loop[k].curve[i]);
            for (size_t j = 0; j < 3 * nurbs_curve_size(f->loop[k].curve[i]); j++) {
                low[j % 3] = fmin(low[j % 3], p[j]);
                high[j % 3] = fmax(high[j % 3], p[j]);
            }
        }
    return high[0] > low[0] || high[1] > low[1] || high[2] > low[2] ? distance3(low, high) : 1;
}

/* Moves patches to where the representation stands; a closed shell turned inside out flips them. */
static nurbs_status place_patches(scene *s, const nurbs_patches *made, bool inside_out)
{
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; status == NURBS_OK && k < nurbs_patches_count(made); k++) {
        nurbs_surface *moved = NULL, *turned = NULL;
        status =
            nurbs_surface_transform(nurbs_patches_get(made, k), s->at.matrix, s->at.shift, &moved);
        if (status == NURBS_OK && inside_out)
            status = nurbs_surface_swap(moved, &turned);
        if (status == NURBS_OK)
            status = nurbs_patches_add(s->patches, turned ? turned : moved);
        nurbs_surface_free(moved);
        nurbs_surface_free(turned);
    }
    return status;
}

static nurbs_status read_face(scene *s, size_t instance, bool inside_out)
{
    step_file *file = s->file;
    cad_face f;
    face_outcome outcome = {0};
    nurbs_patches *made = NULL;
    char name[64];
    s->seen[instance] = 1;
    nurbs_status status = step_face(file, instance, &f);
    if (status == NURBS_OK)
        status = nurbs_patches_create(&made);
    if (status == NURBS_OK) {
        double tolerance = s->tolerance > 0 ? s->tolerance : default_share * edge_extent(&f);
        status = face_patches(&f, tolerance, made, &outcome);
    }
    if (status == NURBS_OK)
        status = place_patches(s, made, inside_out);
    s->faces++;
    s->exact += status == NURBS_OK && outcome.exact;
    s->pieces += outcome.exact ? 0 : outcome.patches;
    if (status == NURBS_OK && !outcome.exact)
        step_report(file, "%s #%zu: resampled as %zu %s, deviation %.2g m; ",
                    step_name(file, instance, name), file->instance[instance].id, outcome.patches,
                    outcome.patches == 1 ? "patch" : "pieces", outcome.deviation);
    if (concerns_one(status)) {
        step_report(file, "%s #%zu is left out: %s; ", step_name(file, instance, name),
                    file->instance[instance].id, nurbs_last_error());
        s->left_out++;
        status = NURBS_OK;
    }
    nurbs_patches_free(made);
    face_free(&f);
    return status;
}

/* A surface by itself: whole, if it ends. */
static nurbs_status read_surface(scene *s, size_t instance)
{
    step_file *file = s->file;
    cad_form form;
    char name[64];
    nurbs_surface *surface = NULL;
    nurbs_patches *made = NULL;
    nurbs_status status = step_form(file, instance, 0, &form);
    if (status == NURBS_OK)
        status = form_surface(&form, form.low, form.high, &surface);
    if (status == NURBS_OK)
        status = nurbs_patches_create(&made);
    if (status == NURBS_OK)
        status = nurbs_patches_add(made, surface);
    if (status == NURBS_OK)
        status = place_patches(s, made, false);
    s->faces++;
    s->exact += status == NURBS_OK;
    if (concerns_one(status)) {
        step_report(file, "%s #%zu is left out: %s; ", step_name(file, instance, name),
                    file->instance[instance].id, nurbs_last_error());
        s->left_out++;
        status = NURBS_OK;
    }
    nurbs_surface_free(surface);
    nurbs_patches_free(made);
    form_free(&form);
    return status;
}

static nurbs_status read_representation(scene *s, size_t instance, int depth);
static nurbs_status read_item(scene *s, size_t instance, bool inside_out, int depth);

static nurbs_status read_items(scene *s, size_t instance, const step_node *list, bool inside_out,
                               int depth)
{
    nurbs_status status = step_list(s->file, instance, list);
    for (const step_node *node = status == NURBS_OK ? step_child(s->file, list, 0) : NULL;
         node && status == NURBS_OK; node = step_next(s->file, node)) {
        size_t item;
        status = step_reference(s->file, instance, node, &item);
        if (status == NURBS_OK)
            status = read_item(s, item, inside_out, depth + 1);
    }
    return status;
}

/* MAPPED_ITEM: a map (origin and representation) and a target placement or operator. */
static nurbs_status read_mapped(scene *s, size_t instance, const step_record *record, int depth)
{
    step_file *file = s->file;
    size_t map, target, origin_item, representation;
    double origin[3], frame[3][3];
    placement before = s->at, from, to, relative;
    nurbs_status status = step_reference(file, instance, step_parameter(file, record, 1), &map);
    if (status == NURBS_OK)
        status = step_reference(file, instance, step_parameter(file, record, 2), &target);
    const step_record *m =
        status == NURBS_OK ? step_record_of(file, map, "REPRESENTATION_MAP") : NULL;
    if (status == NURBS_OK && !m)
        status = step_refuse(file, map, "expected a REPRESENTATION_MAP");
    if (status == NURBS_OK)
        status = step_reference(file, map, step_parameter(file, m, 0), &origin_item);
    if (status == NURBS_OK)
        status = step_reference(file, map, step_parameter(file, m, 1), &representation);
    if (status == NURBS_OK)
        status = step_placement(file, origin_item, origin, frame);
    from = status == NURBS_OK ? of_frame(origin, frame) : identity;
    if (status == NURBS_OK)
        status = step_placement(file, target, origin, frame);
    if (status != NURBS_OK)
        return status;
    to = of_frame(origin, frame);
    from = inverse(&from);
    relative = after(&to, &from);
    s->at = after(&before, &relative);
    double metres = file->metres, radians = file->radians;
    status = read_representation(s, representation, depth + 1);
    file->metres = metres;
    file->radians = radians;
    s->at = before;
    return status;
}

/* What an item lists: names and where the list stands. */
static const struct {
    const char *name;
    size_t at;
} shells[] = {{"CLOSED_SHELL", 1},
              {"OPEN_SHELL", 1},
              {"CONNECTED_FACE_SET", 1},
              {"SHELL_BASED_SURFACE_MODEL", 1},
              {"FACE_BASED_SURFACE_MODEL", 1},
              {"GEOMETRIC_SET", 1},
              {"GEOMETRIC_CURVE_SET", 1}};

static nurbs_status read_solid(scene *s, size_t instance, const step_record *record,
                               bool inside_out, int depth)
{
    size_t shell;
    nurbs_status status =
        step_reference(s->file, instance, step_parameter(s->file, record, 1), &shell);
    if (status == NURBS_OK)
        status = read_item(s, shell, inside_out, depth + 1);
    const step_record *voids = step_record_of(s->file, instance, "BREP_WITH_VOIDS");
    if (status == NURBS_OK && voids)
        status = read_items(s, instance, step_parameter(s->file, voids, 2), inside_out, depth);
    return status;
}

static nurbs_status read_item(scene *s, size_t instance, bool inside_out, int depth)
{
    step_file *file = s->file;
    const step_record *record;
    if (depth > MOST_DEPTH)
        return step_refuse(file, instance, "items inside each other without end");
    if (step_record_of(file, instance, "ADVANCED_FACE") ||
        step_record_of(file, instance, "FACE_SURFACE"))
        return read_face(s, instance, inside_out);
    if ((record = step_record_of(file, instance, "MANIFOLD_SOLID_BREP")) ||
        (record = step_record_of(file, instance, "BREP_WITH_VOIDS")) ||
        (record = step_record_of(file, instance, "FACETED_BREP")))
        return read_solid(s, instance, record, inside_out, depth);
    if ((record = step_record_of(file, instance, "ORIENTED_CLOSED_SHELL")) ||
        (record = step_record_of(file, instance, "ORIENTED_OPEN_SHELL"))) {
        size_t shell;
        nurbs_status status =
            step_reference(file, instance, step_parameter(file, record, 2), &shell);
        bool turned = !step_flag(step_parameter(file, record, 3), true);
        return status == NURBS_OK ? read_item(s, shell, inside_out != turned, depth + 1) : status;
    }
    for (size_t k = 0; k < sizeof shells / sizeof *shells; k++)
        if ((record = step_record_of(file, instance, shells[k].name)))
            return read_items(s, instance, step_parameter(file, record, shells[k].at), inside_out,
                              depth);
    if ((record = step_record_of(file, instance, "MAPPED_ITEM")))
        return read_mapped(s, instance, record, depth);
    if (step_is_spline(file, instance, true) ||
        step_record_of(file, instance, "RECTANGULAR_TRIMMED_SURFACE"))
        return read_surface(s, instance);
    return NURBS_OK; /* placements, points, curves, annotations */
}

/* SI_UNIT(prefix, name), or CONVERSION_BASED_UNIT(name, measure with unit). */
static nurbs_status unit_factor(const step_file *file, size_t unit, int depth, double *factor)
{
    static const struct {
        const char *name;
        double factor;
    } prefixes[] = {{"EXA", 1e18},  {"PETA", 1e15},  {"TERA", 1e12},   {"GIGA", 1e9},
                    {"MEGA", 1e6},  {"KILO", 1e3},   {"HECTO", 1e2},   {"DECA", 1e1},
                    {"DECI", 1e-1}, {"CENTI", 1e-2}, {"MILLI", 1e-3},  {"MICRO", 1e-6},
                    {"NANO", 1e-9}, {"PICO", 1e-12}, {"FEMTO", 1e-15}, {"ATTO", 1e-18}};
    const step_record *si = step_record_of(file, unit, "SI_UNIT"),
                      *based = step_record_of(file, unit, "CONVERSION_BASED_UNIT");
    *factor = 1;
    if (si) {
        /* A derived first attribute (dimensions, *) stands before the prefix in a simple instance.
         */
        const step_node *prefix = step_parameter(file, si, file->instance[unit].count > 1 ? 0 : 1);
        if (!prefix || prefix->kind != STEP_ENUM)
            return NURBS_OK;
        for (size_t k = 0; k < sizeof prefixes / sizeof *prefixes; k++)
            if (strlen(prefixes[k].name) == prefix->length &&
                memcmp(prefixes[k].name, prefix->text, prefix->length) == 0) {
                *factor = prefixes[k].factor;
                return NURBS_OK;
            }
        return step_refuse(file, unit, "unknown prefix .%.*s.", (int)prefix->length, prefix->text);
    }
    if (!based || depth > MOST_DEPTH)
        return step_refuse(file, unit, "is no unit that is known");
    size_t measure, base;
    double value, inner;
    nurbs_status status = step_reference(
        file, unit, step_parameter(file, based, file->instance[unit].count > 1 ? 1 : 2), &measure);
    if (status != NURBS_OK)
        return status;
    const step_record *m = step_record_of(file, measure, "MEASURE_WITH_UNIT");
    if (!m)
        m = &file->record[file->instance[measure].first];
    status = step_number(file, measure, step_parameter(file, m, 0), &value);
    if (status == NURBS_OK)
        status = step_reference(file, measure, step_parameter(file, m, 1), &base);
    if (status == NURBS_OK)
        status = unit_factor(file, base, depth + 1, &inner);
    if (status == NURBS_OK && !(value > 0))
        return step_refuse(file, measure, "%g of a unit, expected > 0", value);
    *factor = status == NURBS_OK ? value * inner : 1;
    return status;
}

/* The units of a representation's context; a context without units leaves those of before. */
static nurbs_status set_units(step_file *file, size_t context)
{
    const step_record *record = step_record_of(file, context, "GLOBAL_UNIT_ASSIGNED_CONTEXT");
    if (!record)
        return NURBS_OK;
    /* In a simple instance the attributes of the context itself stand before. */
    const step_node *list = step_parameter(file, record, file->instance[context].count > 1 ? 0 : 2);
    nurbs_status status = step_list(file, context, list);
    for (const step_node *node = status == NURBS_OK ? step_child(file, list, 0) : NULL;
         node && status == NURBS_OK; node = step_next(file, node)) {
        size_t unit;
        status = step_reference(file, context, node, &unit);
        if (status == NURBS_OK && step_record_of(file, unit, "LENGTH_UNIT"))
            status = unit_factor(file, unit, 0, &file->metres);
        else if (status == NURBS_OK && step_record_of(file, unit, "PLANE_ANGLE_UNIT"))
            status = unit_factor(file, unit, 0, &file->radians);
    }
    return status;
}

/* A representation has a name, a list of items and a context. */
static const step_record *representation(const step_file *file, size_t instance)
{
    const step_instance *i = &file->instance[instance];
    for (size_t k = 0; k < i->count; k++) {
        const step_record *record = &file->record[i->first + k];
        static const char end[] = "REPRESENTATION";
        size_t n = sizeof end - 1;
        if (record->length < n || memcmp(record->name + record->length - n, end, n) != 0)
            continue;
        const step_node *items = step_parameter(file, record, 1),
                        *context = step_parameter(file, record, 2);
        if (items && items->kind == STEP_LIST && context && context->kind == STEP_REFERENCE)
            return record;
    }
    return NULL;
}

static nurbs_status representation_units(step_file *file, size_t instance)
{
    const step_record *record = representation(file, instance);
    size_t context;
    if (!record)
        return NURBS_OK;
    nurbs_status status = step_reference(file, instance, step_parameter(file, record, 2), &context);
    return status == NURBS_OK ? set_units(file, context) : status;
}

static size_t root_of(const scene *s, size_t instance)
{
    while (s->same[instance] != instance)
        instance = s->same[instance];
    return instance;
}

/* Everything in a representation and those that share its coordinates, and what stands inside. */
static nurbs_status read_representation(scene *s, size_t instance, int depth)
{
    step_file *file = s->file;
    size_t root = root_of(s, instance);
    placement before = s->at;
    nurbs_status status = NURBS_OK;
    if (depth > MOST_DEPTH || ++s->placed > MOST_PLACED)
        return step_refuse(file, instance, "representations inside each other without end");
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++) {
        const step_record *record = root_of(s, k) == root ? representation(file, k) : NULL;
        if (!record)
            continue;
        status = representation_units(file, k);
        if (status == NURBS_OK)
            status = read_items(s, k, step_parameter(file, record, 1), false, depth);
    }
    for (size_t k = 0; k < s->links && status == NURBS_OK; k++)
        if (root_of(s, s->link[k].parent) == root) {
            s->at = after(&before, &s->link[k].at);
            status = read_representation(s, s->link[k].inside, depth + 1);
            s->at = before;
        }
    return status;
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
static bool first_is_parent(const scene *s, size_t relationship, size_t first, size_t second)
{
    const step_file *file = s->file;
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
        return shown < file->count && root_of(s, shown) == root_of(s, first) &&
               root_of(s, shown) != root_of(s, second);
    }
    return false;
}

/* ITEM_DEFINED_TRANSFORMATION: the placement of item 1 in representation 1 falls on that of item 2
 * in representation 2. Gives the place of 1 in 2. */
static nurbs_status item_transformation(step_file *file, size_t operation, size_t first,
                                        size_t second, placement *at)
{
    const step_record *record = step_record_of(file, operation, "ITEM_DEFINED_TRANSFORMATION");
    placement item[2];
    nurbs_status status = NURBS_OK;
    if (!record)
        return step_refuse(file, operation, "expected an ITEM_DEFINED_TRANSFORMATION");
    for (size_t k = 0; k < 2 && status == NURBS_OK; k++) {
        size_t index;
        double origin[3], frame[3][3];
        status = representation_units(file, k ? second : first);
        if (status == NURBS_OK)
            status = step_reference(file, operation, step_parameter(file, record, 2 + k), &index);
        if (status == NURBS_OK)
            status = step_placement(file, index, origin, frame);
        if (status == NURBS_OK)
            item[k] = of_frame(origin, frame);
    }
    if (status != NURBS_OK)
        return status;
    item[0] = inverse(&item[0]);
    *at = after(&item[1], &item[0]);
    return NURBS_OK;
}

static nurbs_status add_link(scene *s, const link *l)
{
    if (s->links == s->room) {
        size_t room = s->room ? 2 * s->room : 16;
        link *larger = realloc(s->link, room * sizeof *larger);
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
static nurbs_status find_links(scene *s)
{
    step_file *file = s->file;
    static const char transformed[] = "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION";
    size_t pair[2];
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < file->count; k++)
        if (relationship(file, k, pair) && !step_record_of(file, k, transformed))
            s->same[root_of(s, pair[0])] = root_of(s, pair[1]);
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++) {
        const step_record *record = step_record_of(file, k, transformed);
        size_t operation;
        link l;
        if (!record || !relationship(file, k, pair))
            continue;
        status = step_reference(file, k, step_parameter(file, record, 0), &operation);
        if (status == NURBS_OK)
            status = item_transformation(file, operation, pair[0], pair[1], &l.at);
        if (status != NURBS_OK)
            return status;
        bool turned = first_is_parent(s, k, pair[0], pair[1]);
        l.inside = pair[turned];
        l.parent = pair[!turned];
        if (turned)
            l.at = inverse(&l.at);
        status = add_link(s, &l);
    }
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++) {
        const step_record *map = step_record_of(file, k, "REPRESENTATION_MAP");
        size_t mapped;
        if (map && step_reference(file, k, step_parameter(file, map, 1), &mapped) == NURBS_OK)
            s->used[root_of(s, mapped)] = 1;
    }
    for (size_t k = 0; k < s->links; k++)
        s->used[root_of(s, s->link[k].inside)] = 1;
    return status;
}

/* Faces that no representation lists. */
static nurbs_status read_loose_faces(scene *s)
{
    nurbs_status status = NURBS_OK;
    size_t before = s->faces;
    for (size_t k = 0; k < s->file->count && status == NURBS_OK && before == 0; k++)
        if (step_record_of(s->file, k, "GLOBAL_UNIT_ASSIGNED_CONTEXT"))
            status = set_units(s->file, k);
    s->at = identity;
    for (size_t k = 0; k < s->file->count && status == NURBS_OK; k++)
        if (!s->seen[k] && step_record_of(s->file, k, "ADVANCED_FACE"))
            status = read_face(s, k, false);
    if (s->faces > before)
        step_report(s->file, "%zu faces stand in no representation, read where they are; ",
                    s->faces - before);
    return status;
}

static nurbs_status read_roots(scene *s)
{
    nurbs_status status = find_links(s);
    for (size_t k = 0; k < s->file->count && status == NURBS_OK; k++)
        if (root_of(s, k) == k && !s->used[k]) {
            s->at = identity;
            if (representation(s->file, k))
                status = read_representation(s, k, 0);
        }
    if (status == NURBS_OK)
        status = read_loose_faces(s);
    return status;
}

static nurbs_status read_file(step_file *file, double tolerance, nurbs_patches *patches)
{
    scene s = {.file = file,
               .tolerance = tolerance,
               .patches = patches,
               .same = malloc(file->count * sizeof(size_t)),
               .used = calloc(2 * file->count, 1)};
    nurbs_status status = NURBS_OK;
    if (!s.same || !s.used)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu instances", file->path,
                            file->count);
    s.seen = s.used + file->count;
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++)
        s.same[k] = k;
    if (file->schema[0])
        step_report(file, "%s; ", file->schema);
    if (status == NURBS_OK)
        status = read_roots(&s);
    if (status == NURBS_OK && s.links > 0)
        step_report(file, "%zu representations placed by an assembly; ", s.links);
    if (status == NURBS_OK) {
        step_report(file, "%zu faces and surfaces, %zu of them exact", s.faces, s.exact);
        if (s.pieces > 0)
            step_report(file, ", others resampled as %zu patches", s.pieces);
        if (s.left_out > 0)
            step_report(file, ", %zu left out", s.left_out);
    }
    if (status == NURBS_OK && nurbs_patches_count(patches) == 0)
        status = nurbs_fail(NURBS_ERROR_FORMAT,
                            "%s: no face that can be read among %zu instances; %zu are left out",
                            file->path, file->count, s.left_out);
    free(s.link);
    free(s.same);
    free(s.used);
    return status;
}

nurbs_status nurbs_patches_read_step(const char *path, double tolerance, nurbs_patches **patches,
                                     char *report, size_t report_size)
{
    step_file file = {.report = report, .report_size = report_size};
    numeric_locale locale;
    if (!patches)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "patches is NULL");
    *patches = NULL;
    if (report && report_size)
        report[0] = '\0';
    if (!path || !(isfinite(tolerance) && tolerance >= 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s: tolerance %g, expected a length >= 0",
                          path ? path : "no path", tolerance);
    numeric_locale_set(&locale);
    nurbs_status status = step_open(path, &file);
    if (status == NURBS_OK)
        status = nurbs_patches_create(patches);
    if (status == NURBS_OK)
        status = read_file(&file, tolerance, *patches);
    step_close(&file);
    numeric_locale_restore(&locale);
    if (status != NURBS_OK) {
        nurbs_patches_free(*patches);
        *patches = NULL;
    }
    return status;
}
