#include "error.h"
#include "iges.h"
#include "textfile.h"
#include <nurbs/io.h>

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

/* Faces: which surfaces they cut. cut[surface] is set for trimmed ones. */
static nurbs_status inspect_faces(iges_file *file, unsigned char *cut)
{
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++) {
        size_t surface = 0;
        iges_trim trim;
        if (!iges_is_face(file->entity[k].type))
            continue;
        status = iges_face(file, k, &surface, &trim);
        if (status != NURBS_OK)
            break;
        if (file->entity[surface].type != 128)
            iges_report(file, "face D%zu lies on %d %s D%zu, which is not read; ", iges_number(k),
                        file->entity[surface].type, type_name(file->entity[surface].type),
                        iges_number(surface));
        else if (trim == IGES_TRIMMED) {
            cut[surface] = 1;
            iges_report(file, "face D%zu trims surface D%zu: the whole surface is kept; ",
                        iges_number(k), iges_number(surface));
        } else if (trim == IGES_UNKNOWN) {
            iges_report(file,
                        "face D%zu has no curves in parameter space: the whole surface D%zu is "
                        "kept; ",
                        iges_number(k), iges_number(surface));
        }
    }
    return status;
}

static nurbs_status read_surfaces(iges_file *file, nurbs_patches *patches)
{
    size_t read = 0, trimmed = 0;
    unsigned char *cut = calloc(file->count + 1, 1);
    if (!cut)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu entities", file->path,
                          file->count);
    nurbs_status status = inspect_faces(file, cut);
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++) {
        nurbs_surface *surface;
        if (file->entity[k].type != 128)
            continue;
        status = iges_surface(file, k, &surface);
        if (status == NURBS_OK)
            status = nurbs_patches_add(patches, surface);
        nurbs_surface_free(surface);
        read++;
        trimmed += cut[k];
    }
    free(cut);
    if (status == NURBS_OK && read == 0)
        status = nurbs_fail(NURBS_ERROR_FORMAT,
                            "%s: no B-spline surface (entity 128) among %zu "
                            "entities",
                            file->path, file->count);
    iges_report(file, "%zu surfaces kept, %zu of them trimmed in the file", read, trimmed);
    return status;
}

nurbs_status nurbs_patches_read_iges(const char *path, nurbs_patches **patches, char *report,
                                     size_t report_size)
{
    iges_file file = {.report = report, .report_size = report_size};
    numeric_locale locale;
    *patches = NULL;
    if (report && report_size)
        report[0] = '\0';
    numeric_locale_set(&locale);
    nurbs_status status = iges_open(path, &file);
    if (status == NURBS_OK)
        status = nurbs_patches_create(patches);
    if (status == NURBS_OK) {
        report_counts(&file);
        status = read_surfaces(&file, *patches);
    }
    iges_close(&file);
    numeric_locale_restore(&locale);
    if (status != NURBS_OK) {
        nurbs_patches_free(*patches);
        *patches = NULL;
    }
    return status;
}
