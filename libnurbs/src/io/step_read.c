/* nurbs_patches_read_step(): representations, their places in assemblies, and the faces in them. */
#include "core/error.h"
#include "core/textfile.h"
#include "core/vector.h"
#include "io/step_assembly.h"

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

static const step_place identity = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};

typedef struct scene {
    step_file *file;
    double tolerance;
    nurbs_patches *patches;
    step_place at; /* of what is being read */
    step_assembly assembly;
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

/* RECTANGULAR_TRIMMED_SURFACE: basis, u1, u2, v1, v2, senses. Fills the range in natural
 * parameters, which on planes, quadrics and splines are the file's, but for the scale. */
static nurbs_status trimmed_range(const step_file *file, size_t instance, const step_record *record,
                                  cad_form *f)
{
    double value[4];
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < 4 && status == NURBS_OK; k++)
        status = step_number(file, instance, step_parameter(file, record, 2 + k), &value[k]);
    if (status != NURBS_OK)
        return status;
    if (f->kind == FORM_EXTRUDED || f->flipped ||
        (f->kind == FORM_REVOLVED && f->profile == PROFILE_CURVE) ||
        !step_flag(step_parameter(file, record, 6), true) ||
        !step_flag(step_parameter(file, record, 7), true))
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "a rectangle of a swept surface, or against its "
                                                "parameters");
    bool angle[2] = {f->kind == FORM_REVOLVED,
                     f->kind == FORM_REVOLVED && f->profile == PROFILE_CIRCLE};
    for (int d = 0; d < 2; d++) {
        double scale = f->kind == FORM_SPLINE ? 1 : angle[d] ? file->radians : file->metres;
        if (d == 1 && f->kind == FORM_REVOLVED && f->profile == PROFILE_LINE)
            scale /= f->slope[1]; /* heights of a cone are lengths of its generator */
        f->low[d] = scale * value[2 * d];
        f->high[d] = scale * value[2 * d + 1];
    }
    return NURBS_OK;
}

/* The exact surface over the limits of its form; a spline is cut to them. */
static nurbs_status surface_within(const cad_form *form, nurbs_surface **surface)
{
    nurbs_status status = form_surface(form, form->low, form->high, surface);
    for (int d = 0; d < 2 && status == NURBS_OK && form->kind == FORM_SPLINE; d++) {
        nurbs_surface *part;
        status = nurbs_surface_part(*surface, d, form->low[d], form->high[d], &part);
        if (status == NURBS_OK) {
            nurbs_surface_free(*surface);
            *surface = part;
        }
    }
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
    const step_record *rectangle = step_record_of(file, instance, "RECTANGULAR_TRIMMED_SURFACE");
    nurbs_status status = step_form(file, instance, 0, &form);
    if (status == NURBS_OK && rectangle)
        status = trimmed_range(file, instance, rectangle, &form);
    if (status == NURBS_OK)
        status = surface_within(&form, &surface);
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
    step_place before = s->at, from, to, relative;
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
    from = status == NURBS_OK ? step_of_frame(origin, frame) : identity;
    if (status == NURBS_OK)
        status = step_placement(file, target, origin, frame);
    if (status != NURBS_OK)
        return status;
    to = step_of_frame(origin, frame);
    from = step_inverse(&from);
    relative = step_after(&to, &from);
    s->at = step_after(&before, &relative);
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

/* Placements, points, curves and annotations are nobody's hull; anything else that is not read is
 * told. */
static void tell_unread(scene *s, size_t instance)
{
    static const char *const shapes[] = {"SURFACE", "SOLID",       "BREP", "SHELL",
                                         "FACE",    "TESSELLATED", "PLANE"};
    char name[64];
    step_name(s->file, instance, name);
    bool shape = false;
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; k++)
        shape |= strstr(name, shapes[k]) != NULL;
    if (!shape)
        return;
    step_report(s->file, "%s #%zu is left out: it is not read; ", name,
                s->file->instance[instance].id);
    s->left_out++;
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
    tell_unread(s, instance);
    return NURBS_OK;
}

/* Everything in a representation and those that share its coordinates, and what stands inside. */
static nurbs_status read_representation(scene *s, size_t instance, int depth)
{
    step_file *file = s->file;
    size_t root = step_root(&s->assembly, instance);
    step_place before = s->at;
    nurbs_status status = NURBS_OK;
    if (depth > MOST_DEPTH || ++s->placed > MOST_PLACED)
        return step_refuse(file, instance, "representations inside each other without end");
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++) {
        const step_record *record =
            step_root(&s->assembly, k) == root ? step_representation(file, k) : NULL;
        if (!record)
            continue;
        status = step_use_units_of(file, k);
        if (status == NURBS_OK)
            status = read_items(s, k, step_parameter(file, record, 1), false, depth);
    }
    for (size_t k = 0; k < s->assembly.links && status == NURBS_OK; k++)
        if (step_root(&s->assembly, s->assembly.link[k].parent) == root) {
            s->at = step_after(&before, &s->assembly.link[k].at);
            status = read_representation(s, s->assembly.link[k].inside, depth + 1);
            s->at = before;
        }
    return status;
}

/* Faces that no representation lists. */
static nurbs_status read_loose_faces(scene *s)
{
    nurbs_status status = NURBS_OK;
    size_t before = s->faces;
    for (size_t k = 0; k < s->file->count && status == NURBS_OK && before == 0; k++)
        if (step_record_of(s->file, k, "GLOBAL_UNIT_ASSIGNED_CONTEXT"))
            status = step_set_units(s->file, k);
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
    nurbs_status status = step_assembly_find(s->file, &s->assembly);
    for (size_t k = 0; k < s->file->count && status == NURBS_OK; k++)
        if (step_root(&s->assembly, k) == k && !s->assembly.used[k]) {
            s->at = identity;
            if (step_representation(s->file, k))
                status = read_representation(s, k, 0);
        }
    if (status == NURBS_OK)
        status = read_loose_faces(s);
    return status;
}

static nurbs_status read_file(step_file *file, double tolerance, nurbs_patches *patches)
{
    scene s = {
        .file = file, .tolerance = tolerance, .patches = patches, .seen = calloc(file->count, 1)};
    nurbs_status status = NURBS_OK;
    if (!s.seen)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu instances", file->path,
                            file->count);
    if (file->schema[0])
        step_report(file, "%s; ", file->schema);
    if (status == NURBS_OK)
        status = read_roots(&s);
    if (status == NURBS_OK && s.assembly.links > 0)
        step_report(file, "%zu representations placed by an assembly; ", s.assembly.links);
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
    step_assembly_free(&s.assembly);
    free(s.seen);
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
