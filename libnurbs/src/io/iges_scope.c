/* Faces and surfaces of one scope as patches. */
#include "io/iges_scope.h"

#include "core/error.h"
#include "core/vector.h"

#include <nurbs/modify.h>
#include <nurbs/trim.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Faces on surfaces other than B-splines are resampled within this share of the extent of their
 * edges where the caller asks for no tolerance: unlike a spline surface, a plane has no whole. */
static const double default_share = 1e-6;

enum { USED = 1, TRIMMED = 2, WHOLE = 4 };

typedef struct scope_work {
    iges_file *file;
    const unsigned char *scope;
    double tolerance; /* metres; 0: spline surfaces stay whole */
    iges_tally *tally;
    unsigned char *role;    /* [entities] of surfaces: USED, TRIMMED, WHOLE */
    nurbs_patches *patches; /* of trimmed spline faces; the base surface of each in `base` */
    size_t *base, base_room;
} scope_work;

const char *iges_type_name(int type)
{
    static const struct {
        int type;
        const char *name;
    } names[] = {{100, "circular arc"},
                 {102, "composite curve"},
                 {104, "conic arc"},
                 {106, "copious data"},
                 {108, "plane"},
                 {110, "line"},
                 {112, "parametric spline"},
                 {114, "parametric spline surface"},
                 {116, "point"},
                 {118, "ruled surface"},
                 {120, "surface of revolution"},
                 {122, "tabulated cylinder"},
                 {123, "direction"},
                 {124, "transformation"},
                 {126, "B-spline curve"},
                 {128, "B-spline surface"},
                 {130, "offset curve"},
                 {140, "offset surface"},
                 {141, "boundary"},
                 {142, "curve on surface"},
                 {143, "bounded surface"},
                 {144, "trimmed surface"},
                 {186, "solid"},
                 {190, "plane surface"},
                 {192, "cylindrical surface"},
                 {194, "conical surface"},
                 {196, "spherical surface"},
                 {198, "toroidal surface"},
                 {308, "subfigure"},
                 {314, "colour"},
                 {402, "group"},
                 {406, "property"},
                 {408, "subfigure instance"},
                 {502, "vertex list"},
                 {504, "edge list"},
                 {508, "loop"},
                 {510, "face"},
                 {514, "shell"}};
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++)
        if (names[k].type == type)
            return names[k].name;
    return "entity";
}

/* Failures that concern one face or surface, not the file. */
static bool concerns_one(nurbs_status status)
{
    return status == NURBS_ERROR_GEOMETRY || status == NURBS_ERROR_NUMERIC;
}

static void left_out(scope_work *work, size_t entity)
{
    int type = work->file->entity[entity].type;
    iges_report(work->file, "%d %s D%zu is left out: %s; ", type, iges_type_name(type),
                iges_number(entity), nurbs_last_error());
    work->tally->left_out++;
}

/* The loops of a face on a spline surface as patches of their own: four sides as one, else in
 * pieces. */
static nurbs_status untrim_loops(const nurbs_surface *surface, const iges_face *face,
                                 double tolerance, nurbs_patches *made, double *deviation)
{
    const nurbs_curve *const *curves = (const nurbs_curve *const *)face->curve;
    nurbs_surface *patch = NULL;
    nurbs_status status = NURBS_ERROR_GEOMETRY;
    if (face->loops == 1)
        status = nurbs_surface_untrim(surface, face->count, curves, tolerance, &patch, deviation);
    if (status == NURBS_OK)
        status = nurbs_patches_add(made, patch);
    nurbs_surface_free(patch);
    if (!concerns_one(status))
        return status;
    const nurbs_curve *const **loop = malloc(face->loops * sizeof *loop);
    size_t *count = malloc(face->loops * sizeof *count);
    status = loop && count ? NURBS_OK
                           : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu loops", face->loops);
    for (size_t k = 0, at = 0; k < face->loops && status == NURBS_OK; k++) {
        loop[k] = curves + at;
        count[k] = face->end[k] - at;
        at = face->end[k];
        if (count[k] == 0)
            status = nurbs_fail(NURBS_ERROR_GEOMETRY, "a loop without curves");
    }
    if (status == NURBS_OK)
        status = nurbs_surface_untrim_parts(surface, face->loops, count, loop, tolerance, made,
                                            deviation);
    free(loop);
    free(count);
    return status;
}

/* Keeps patches for the place of their base surface. */
static nurbs_status keep_for_base(scope_work *work, size_t surface, const nurbs_patches *made)
{
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; status == NURBS_OK && k < nurbs_patches_count(made); k++) {
        size_t at = nurbs_patches_count(work->patches);
        if (at == work->base_room) {
            size_t room = at ? 2 * at : 16, *larger = realloc(work->base, room * sizeof *larger);
            if (!larger)
                return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", room);
            work->base = larger;
            work->base_room = room;
        }
        work->base[at] = surface;
        status = nurbs_patches_add(work->patches, nurbs_patches_get(made, k));
    }
    return status;
}

static void tell_resampled(scope_work *work, size_t entity, size_t surface,
                           const nurbs_patches *made, double deviation)
{
    size_t n = nurbs_patches_count(made);
    iges_report(work->file, "face D%zu trims surface D%zu: resampled as ", iges_number(entity),
                iges_number(surface));
    if (n == 1)
        iges_report(work->file, "%zu x %zu control points",
                    nurbs_surface_size(nurbs_patches_get(made, 0), 0),
                    nurbs_surface_size(nurbs_patches_get(made, 0), 1));
    else
        iges_report(work->file, "%zu pieces", n);
    iges_report(work->file, ", deviation %.2g m; ", deviation);
}

/* The surface of a trimmed face as patches; a loop for which that cannot be done leaves the surface
 * whole. */
static nurbs_status untrim_face(scope_work *work, size_t entity, const iges_face *face)
{
    iges_file *file = work->file;
    nurbs_surface *surface = NULL;
    nurbs_patches *made = NULL;
    double deviation = 0;
    size_t used = file->report_used;
    nurbs_status status = iges_surface(file, face->surface, &surface);
    file->report_used = used;
    if (status == NURBS_OK)
        status = nurbs_patches_create(&made);
    if (status == NURBS_OK) {
        status = untrim_loops(surface, face, work->tolerance, made, &deviation);
        if (concerns_one(status)) {
            iges_report(file, "face D%zu trims surface D%zu: the whole surface is kept: %s; ",
                        iges_number(entity), iges_number(face->surface), nurbs_last_error());
            work->role[face->surface] |= WHOLE;
            status = NURBS_OK;
        } else if (status == NURBS_OK) {
            tell_resampled(work, entity, face->surface, made, deviation);
            status = keep_for_base(work, face->surface, made);
        }
    }
    nurbs_surface_free(surface);
    nurbs_patches_free(made);
    return status;
}

static nurbs_status space_patches(scope_work *work, size_t entity, nurbs_patches *patches,
                                  face_outcome *outcome);

/* A face on a spline surface without curves in parameter space: by its curves in space. */
static nurbs_status project_spline_face(scope_work *work, size_t entity, size_t surface)
{
    face_outcome outcome;
    nurbs_patches *made = NULL;
    nurbs_status status = nurbs_patches_create(&made);
    if (status == NURBS_OK)
        status = space_patches(work, entity, made, &outcome);
    if (status == NURBS_OK) {
        work->role[surface] |= TRIMMED;
        tell_resampled(work, entity, surface, made, outcome.deviation);
        status = keep_for_base(work, surface, made);
    } else if (concerns_one(status)) {
        iges_report(work->file, "face D%zu trims surface D%zu: the whole surface is kept: %s; ",
                    iges_number(entity), iges_number(surface), nurbs_last_error());
        work->role[surface] |= WHOLE;
        status = NURBS_OK;
    }
    nurbs_patches_free(made);
    return status;
}

/* A face on a spline surface, by its curves in parameter space. */
static nurbs_status inspect_spline_face(scope_work *work, size_t entity)
{
    iges_file *file = work->file;
    iges_face face;
    nurbs_status status = iges_face_read(file, entity, &face);
    if (status != NURBS_OK)
        return status;
    size_t number = iges_number(entity), surface = face.surface;
    if (face.trim == IGES_UNKNOWN && work->tolerance > 0) {
        iges_face_free(&face);
        return project_spline_face(work, entity, surface);
    }
    if (face.trim == IGES_UNKNOWN)
        iges_report(file,
                    "face D%zu has no curves in parameter space: the whole surface D%zu is kept; ",
                    number, iges_number(surface));
    if (file->entity[entity].transformation > 0)
        iges_report(file, "face D%zu has a transformation of its own, which is not applied; ",
                    number);
    work->role[surface] |= face.trim == IGES_TRIMMED ? TRIMMED : WHOLE;
    if (face.trim == IGES_TRIMMED && work->tolerance > 0) {
        status = untrim_face(work, entity, &face);
    } else if (face.trim == IGES_TRIMMED) {
        work->role[surface] |= WHOLE;
        iges_report(file, "face D%zu trims surface D%zu: the whole surface is kept; ", number,
                    iges_number(surface));
    }
    iges_face_free(&face);
    return status;
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
    return high[0] >= low[0] ? distance3(low, high) : 1;
}

/* The patches of a face by its curves in space, moved as the face itself asks. */
static nurbs_status space_patches(scope_work *work, size_t entity, nurbs_patches *patches,
                                  face_outcome *outcome)
{
    iges_file *file = work->file;
    cad_face f;
    double matrix[9], shift[3];
    nurbs_patches *made = NULL;
    *outcome = (face_outcome){0};
    nurbs_status status = iges_face_space(file, entity, &f);
    double tolerance = work->tolerance > 0 ? work->tolerance : default_share * edge_extent(&f);
    bool is_face = iges_is_face(file->entity[entity].type);
    if (status == NURBS_OK)
        status = nurbs_patches_create(&made);
    if (status == NURBS_OK)
        status = face_patches(&f, tolerance, made, outcome);
    if (status == NURBS_OK)
        status = iges_transformation(file, entity, matrix, shift);
    for (size_t k = 0; status == NURBS_OK && k < nurbs_patches_count(made); k++) {
        nurbs_surface *moved = NULL;
        /* The transformation of a plane 108 is in its form already. */
        if (is_face && file->entity[entity].transformation > 0)
            status = nurbs_surface_transform(nurbs_patches_get(made, k), matrix, shift, &moved);
        if (status == NURBS_OK)
            status = nurbs_patches_add(patches, moved ? moved : nurbs_patches_get(made, k));
        nurbs_surface_free(moved);
    }
    nurbs_patches_free(made);
    face_free(&f);
    return status;
}

/* A face on a surface that is given by its form. */
static nurbs_status space_face(scope_work *work, size_t entity, nurbs_patches *patches)
{
    iges_file *file = work->file;
    int type = file->entity[entity].type;
    face_outcome outcome;
    nurbs_status status = space_patches(work, entity, patches, &outcome);
    work->tally->faces++;
    if (concerns_one(status)) {
        left_out(work, entity);
        return NURBS_OK;
    }
    if (status != NURBS_OK)
        return status;
    work->tally->exact += outcome.exact;
    work->tally->pieces += outcome.exact ? 0 : outcome.patches;
    if (!outcome.exact)
        iges_report(file, "%d %s D%zu: resampled as %zu %s, deviation %.2g m; ", type,
                    iges_type_name(type), iges_number(entity), outcome.patches,
                    outcome.patches == 1 ? "patch" : "pieces", outcome.deviation);
    return NURBS_OK;
}

/* Marks what a face lies on; faces on spline surfaces are inspected. */
static nurbs_status inspect_face(scope_work *work, size_t entity)
{
    size_t surface;
    nurbs_status status = iges_face_base(work->file, entity, &surface);
    if (status != NURBS_OK)
        return status;
    work->role[surface] |= USED;
    if (work->file->entity[entity].blank)
        return NURBS_OK;
    int type = work->file->entity[surface].type;
    if (type == 128)
        return inspect_spline_face(work, entity);
    if (!iges_is_form(type))
        iges_report(work->file, "face D%zu lies on %d %s D%zu, which is not read; ",
                    iges_number(entity), type, iges_type_name(type), iges_number(surface));
    return NURBS_OK;
}

/* Untrimmed patches stand in for a surface only if every face on it gave one: else they would lie
 * on the whole surface. */
static nurbs_status keep_spline(scope_work *work, size_t entity, nurbs_patches *patches)
{
    nurbs_surface *surface;
    nurbs_status status = NURBS_OK;
    unsigned char role = work->role[entity];
    if (role == USED) /* by blank faces alone */
        return NURBS_OK;
    work->tally->surfaces++;
    work->tally->trimmed += (role & TRIMMED) != 0;
    if (!(role & TRIMMED) || role & WHOLE) {
        status = iges_surface(work->file, entity, &surface);
        if (status == NURBS_OK)
            status = nurbs_patches_add(patches, surface);
        nurbs_surface_free(surface);
        return status;
    }
    work->tally->resampled++;
    for (size_t k = 0; status == NURBS_OK && k < nurbs_patches_count(work->patches); k++)
        if (work->base[k] == entity)
            status = nurbs_patches_add(patches, nurbs_patches_get(work->patches, k));
    return status;
}

/* A surface given by its form that no face uses: whole, if it ends by itself. */
static nurbs_status keep_form(scope_work *work, size_t entity, nurbs_patches *patches)
{
    nurbs_surface *surface = NULL;
    if (work->file->entity[entity].type == 108) {
        long curve = 0;
        nurbs_status status = iges_integer(work->file, entity, 4, 0, &curve);
        if (status == NURBS_OK && curve != 0)
            return space_face(work, entity, patches);
    }
    nurbs_status status = iges_whole(work->file, entity, &surface);
    if (status == NURBS_OK) {
        status = nurbs_patches_add(patches, surface);
        work->tally->faces++;
        work->tally->exact++;
    }
    nurbs_surface_free(surface);
    if (concerns_one(status)) {
        left_out(work, entity);
        return NURBS_OK;
    }
    return status;
}

static nurbs_status keep(scope_work *work, size_t entity, nurbs_patches *patches)
{
    iges_file *file = work->file;
    int type = file->entity[entity].type;
    size_t base;
    if (iges_is_face(type)) {
        nurbs_status status = iges_face_base(file, entity, &base);
        return status == NURBS_OK && iges_is_form(file->entity[base].type)
                   ? space_face(work, entity, patches)
                   : status;
    }
    if (type == 128)
        return keep_spline(work, entity, patches);
    return iges_is_form(type) && !(work->role[entity] & USED) ? keep_form(work, entity, patches)
                                                              : NURBS_OK;
}

static nurbs_status read_scope(scope_work *work, nurbs_patches *patches)
{
    iges_file *file = work->file;
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++) {
        size_t base;
        if (file->entity[k].type == 140 && iges_pointer(file, k, 4, &base) == NURBS_OK)
            work->role[base] |= USED;
        if (work->scope[k] && iges_is_face(file->entity[k].type))
            status = inspect_face(work, k);
    }
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++) {
        int type = file->entity[k].type;
        if (!work->scope[k] || !(iges_is_face(type) || type == 128 || iges_is_form(type)))
            continue;
        /* A blank surface still carries the faces on it. */
        if (file->entity[k].blank && !(work->role[k] & (TRIMMED | WHOLE))) {
            work->tally->blank++;
            continue;
        }
        status = keep(work, k, patches);
    }
    return status;
}

nurbs_status iges_read_scope(iges_file *file, const unsigned char *scope, double tolerance,
                             nurbs_patches *patches, iges_tally *tally)
{
    scope_work work = {.file = file,
                       .scope = scope,
                       .tolerance = tolerance,
                       .tally = tally,
                       .role = calloc(file->count + 1, 1)};
    nurbs_status status = work.role
                              ? nurbs_patches_create(&work.patches)
                              : nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu entities",
                                           file->path, file->count);
    if (status == NURBS_OK)
        status = read_scope(&work, patches);
    nurbs_patches_free(work.patches);
    free(work.role);
    free(work.base);
    return status;
}
