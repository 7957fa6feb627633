#include "core/error.h"
#include "core/textfile.h"
#include "io/iges.h"

#include <nurbs/io.h>
#include <nurbs/trim.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *type_name(int type)
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
                 {124, "transformation"},
                 {126, "B-spline curve"},
                 {128, "B-spline surface"},
                 {141, "boundary"},
                 {142, "curve on surface"},
                 {143, "bounded surface"},
                 {144, "trimmed surface"},
                 {186, "solid"},
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

/* One line of counts in the order of the file: "128 B-spline surface x 3, ...". */
static void report_counts(iges_file *file)
{
    iges_report(file, "entities: ");
    for (size_t k = 0; k < file->count; k++) {
        int type = file->entity[k].type, seen = 0;
        size_t count = 0;
        for (size_t i = 0; i < file->count; i++) {
            seen |= i < k && file->entity[i].type == type;
            count += file->entity[i].type == type;
        }
        if (!seen)
            iges_report(file, "%s%d %s x %zu", k ? ", " : "", type, type_name(type), count);
    }
    iges_report(file, "; ");
}

/* What the faces of a file make of each surface. */
typedef struct face_work {
    double tolerance;       /* of untrimming, metres; 0: not wanted */
    unsigned char *trimmed; /* [entities] by some face */
    unsigned char *whole;   /* [entities] some face needs the whole surface */
    nurbs_patches *patches; /* untrimmed ones; their base surface's index and face in `base` */
    size_t *base;
} face_work;

/* The surface of a trimmed face as a patch of its own; a loop for which that cannot be done leaves
 * the surface whole. */
static nurbs_status untrim_face(iges_file *file, size_t entity, const iges_face *face,
                                face_work *work)
{
    nurbs_surface *surface, *patch = NULL;
    double deviation = 0;
    size_t used = file->report_used, number = iges_number(entity);
    nurbs_status status = iges_surface(file, face->surface, &surface);
    file->report_used = used;
    if (status != NURBS_OK)
        return status;
    if (face->loops > 1)
        status = nurbs_fail(NURBS_ERROR_GEOMETRY, "it has %zu loops", face->loops);
    else
        status = nurbs_surface_untrim(surface, face->count, (const nurbs_curve *const *)face->curve,
                                      work->tolerance, &patch, &deviation);
    nurbs_surface_free(surface);
    if (status == NURBS_ERROR_GEOMETRY || status == NURBS_ERROR_NUMERIC) {
        iges_report(file, "face D%zu trims surface D%zu: the whole surface is kept: %s; ", number,
                    iges_number(face->surface), nurbs_last_error());
        work->whole[face->surface] = 1;
        return NURBS_OK;
    }
    if (status == NURBS_OK) {
        iges_report(file,
                    "face D%zu trims surface D%zu: resampled as %zu x %zu control points, "
                    "deviation %.2g m; ",
                    number, iges_number(face->surface), nurbs_surface_size(patch, 0),
                    nurbs_surface_size(patch, 1), deviation);
        work->base[nurbs_patches_count(work->patches)] = face->surface;
        status = nurbs_patches_add(work->patches, patch);
    }
    nurbs_surface_free(patch);
    return status;
}

static nurbs_status inspect_face(iges_file *file, size_t entity, face_work *work)
{
    iges_face face;
    nurbs_status status = iges_face_read(file, entity, &face);
    if (status != NURBS_OK)
        return status;
    size_t number = iges_number(entity), surface = face.surface;
    if (file->entity[surface].type != 128)
        iges_report(file, "face D%zu lies on %d %s D%zu, which is not read; ", number,
                    file->entity[surface].type, type_name(file->entity[surface].type),
                    iges_number(surface));
    else if (face.trim == IGES_UNKNOWN)
        iges_report(file,
                    "face D%zu has no curves in parameter space: the whole surface D%zu is "
                    "kept; ",
                    number, iges_number(surface));
    if (file->entity[entity].transformation > 0)
        iges_report(file, "face D%zu has a transformation of its own, which is not applied; ",
                    number);
    work->trimmed[surface] |= face.trim == IGES_TRIMMED;
    work->whole[surface] |= face.trim != IGES_TRIMMED;
    if (face.trim == IGES_TRIMMED && work->tolerance > 0) {
        status = untrim_face(file, entity, &face, work);
    } else if (face.trim == IGES_TRIMMED) {
        work->whole[surface] = 1;
        iges_report(file, "face D%zu trims surface D%zu: the whole surface is kept; ", number,
                    iges_number(surface));
    }
    iges_face_free(&face);
    return status;
}

/* Untrimmed patches stand in for a surface only if every face on it gave one: else they would lie
 * on the whole surface. */
static nurbs_status keep_surface(iges_file *file, size_t entity, const face_work *work,
                                 nurbs_patches *patches)
{
    nurbs_surface *surface;
    nurbs_status status = NURBS_OK;
    if (!work->trimmed[entity] || work->whole[entity]) {
        status = iges_surface(file, entity, &surface);
        if (status == NURBS_OK)
            status = nurbs_patches_add(patches, surface);
        nurbs_surface_free(surface);
        return status;
    }
    for (size_t k = 0; k < nurbs_patches_count(work->patches) && status == NURBS_OK; k++)
        if (work->base[k] == entity)
            status = nurbs_patches_add(patches, nurbs_patches_get(work->patches, k));
    return status;
}

static nurbs_status read_surfaces(iges_file *file, face_work *work, nurbs_patches *patches)
{
    size_t read = 0, trimmed = 0, untrimmed = 0;
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++)
        if (iges_is_face(file->entity[k].type))
            status = inspect_face(file, k, work);
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++) {
        if (file->entity[k].type != 128)
            continue;
        status = keep_surface(file, k, work, patches);
        read++;
        trimmed += work->trimmed[k];
        untrimmed += work->trimmed[k] && !work->whole[k];
    }
    if (status == NURBS_OK && read == 0)
        status = nurbs_fail(NURBS_ERROR_FORMAT,
                            "%s: no B-spline surface (entity 128) among %zu "
                            "entities",
                            file->path, file->count);
    iges_report(file, "%zu surfaces kept, %zu of them trimmed in the file", read, trimmed);
    if (untrimmed > 0)
        iges_report(file, ", %zu of these resampled", untrimmed);
    return status;
}

static nurbs_status read_file(iges_file *file, double tolerance, nurbs_patches *patches)
{
    face_work work = {.tolerance = tolerance,
                      .trimmed = calloc(2 * file->count + 1, 1),
                      .base = calloc(file->count + 1, sizeof(size_t))};
    nurbs_status status = NURBS_OK;
    report_counts(file);
    if (!work.trimmed || !work.base)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu entities", file->path,
                            file->count);
    work.whole = work.trimmed + file->count;
    if (status == NURBS_OK)
        status = nurbs_patches_create(&work.patches);
    if (status == NURBS_OK)
        status = read_surfaces(file, &work, patches);
    nurbs_patches_free(work.patches);
    free(work.trimmed);
    free(work.base);
    return status;
}

nurbs_status nurbs_patches_read_iges_untrimmed(const char *path, double tolerance,
                                               nurbs_patches **patches, char *report,
                                               size_t report_size)
{
    iges_file file = {.report = report, .report_size = report_size};
    numeric_locale locale;
    *patches = NULL;
    if (report && report_size)
        report[0] = '\0';
    if (!(isfinite(tolerance) && tolerance >= 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s: tolerance %g, expected a length >= 0", path,
                          tolerance);
    numeric_locale_set(&locale);
    nurbs_status status = iges_open(path, &file);
    if (status == NURBS_OK)
        status = nurbs_patches_create(patches);
    if (status == NURBS_OK)
        status = read_file(&file, tolerance, *patches);
    iges_close(&file);
    numeric_locale_restore(&locale);
    if (status != NURBS_OK) {
        nurbs_patches_free(*patches);
        *patches = NULL;
    }
    return status;
}

nurbs_status nurbs_patches_read_iges(const char *path, nurbs_patches **patches, char *report,
                                     size_t report_size)
{
    return nurbs_patches_read_iges_untrimmed(path, 0, patches, report, report_size);
}
