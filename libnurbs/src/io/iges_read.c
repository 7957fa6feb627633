/* nurbs_patches_read_iges(): the entities of a file, and of its placed subfigures. */
#include "core/error.h"
#include "core/textfile.h"
#include "io/iges_scope.h"

#include <nurbs/io.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NESTED = 16, MAX_INSTANCES = 20000 };

/* One line of counts in the order of the file: "128 B-spline surface x 3, ...". */
static void report_counts(iges_file *file)
{
    iges_report(file, "entities: ");
    for (size_t k = 0; k < file->count; k++) {
        int type = file->entity[k].type, seen = 0;
        size_t count = 0;
        for (size_t i = 0; i < file->count && !seen; i++) {
            seen |= i < k && file->entity[i].type == type;
            count += file->entity[i].type == type;
        }
        if (!seen)
            iges_report(file, "%s%d %s x %zu", k ? ", " : "", type, iges_type_name(type), count);
    }
    iges_report(file, "; ");
}

/* p -> matrix p + shift */
typedef struct placement {
    double matrix[9], shift[3];
} placement;

static placement after(const placement *outer, const placement *inner)
{
    placement result;
    for (int i = 0; i < 3; i++) {
        const double *row = outer->matrix + 3 * i;
        for (int j = 0; j < 3; j++)
            result.matrix[3 * i + j] = row[0] * inner->matrix[j] + row[1] * inner->matrix[3 + j] +
                                       row[2] * inner->matrix[6 + j];
        result.shift[i] = row[0] * inner->shift[0] + row[1] * inner->shift[1] +
                          row[2] * inner->shift[2] + outer->shift[i];
    }
    return result;
}

/* Where an entity lists others: parameters first, first + step ... */
static nurbs_status list_of(const iges_file *file, size_t entity, size_t *first, size_t *step,
                            size_t *count)
{
    long n = 0;
    size_t at = 0;
    nurbs_status status = NURBS_OK;
    int type = file->entity[entity].type, form = file->entity[entity].form;
    *first = 1;
    *step = type == 514 ? 2 : 1;
    *count = 0;
    switch (type) {
    case 308:
        at = 2;
        *first = 3;
        break;
    case 402:
        if (form != 1 && form != 7 && form != 14 && form != 15)
            return NURBS_OK;
        break;
    case 514:
        break;
    case 186:
        *first = 0;
        *count = 1;
        return NURBS_OK;
    case 144:
    case 510:
        *first = 0;
        *count = 1;
        return NURBS_OK;
    case 143:
        *count = 1;
        return NURBS_OK;
    default:
        return NURBS_OK;
    }
    status = iges_integer(file, entity, at, 0, &n);
    *count = n > 0 ? (size_t)n : 0;
    if (*count > iges_parameters(file, entity))
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: entity %d at D%zu lists %zu entities in %zu "
                          "parameters",
                          file->path, type, iges_number(entity), *count,
                          iges_parameters(file, entity));
    return status;
}

/* Sets mark[k] for everything that the entity is made of. */
static nurbs_status mark_parts(const iges_file *file, size_t entity, int depth, unsigned char *mark)
{
    size_t first, step, count;
    nurbs_status status = list_of(file, entity, &first, &step, &count);
    if (depth == MAX_NESTED)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: entity %d at D%zu: lists inside each other "
                          "without end",
                          file->path, file->entity[entity].type, iges_number(entity));
    for (size_t k = 0; k < count && status == NURBS_OK; k++) {
        size_t part;
        status = iges_pointer(file, entity, first + k * step, &part);
        if (status != NURBS_OK || mark[part])
            continue;
        mark[part] = 1;
        status = mark_parts(file, part, depth + 1, mark);
    }
    return status;
}

/* A blank solid, shell or group hides what it is made of. */
static nurbs_status spread_blank(iges_file *file)
{
    unsigned char *mark = calloc(file->count + 1, 1);
    nurbs_status status = mark ? NURBS_OK : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for marks");
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++) {
        int type = file->entity[k].type;
        if (file->entity[k].blank && (type == 186 || type == 514 || type == 402))
            status = mark_parts(file, k, 0, mark);
    }
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++)
        if (iges_is_face(file->entity[k].type))
            file->entity[k].blank |= mark[k];
    free(mark);
    return status;
}

/* Moves all patches and adds them to `to`. */
static nurbs_status place_patches(const nurbs_patches *from, const placement *at, nurbs_patches *to)
{
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; status == NURBS_OK && k < nurbs_patches_count(from); k++) {
        nurbs_surface *moved;
        status = nurbs_surface_transform(nurbs_patches_get(from, k), at->matrix, at->shift, &moved);
        if (status == NURBS_OK)
            status = nurbs_patches_add(to, moved);
        nurbs_surface_free(moved);
    }
    return status;
}

typedef struct scene {
    iges_file *file;
    double tolerance;
    iges_tally tally;
    nurbs_patches *patches;
} scene;

static nurbs_status read_instances(scene *s, const unsigned char *scope, const placement *outer,
                                   int depth);

/* Instance 408: subfigure, place, scale; then its own transformation. */
static nurbs_status instance_placement(const iges_file *file, size_t entity, size_t *subfigure,
                                       placement *at)
{
    placement own = {{0}, {0}}, moved;
    double scale;
    nurbs_status status = iges_pointer(file, entity, 0, subfigure);
    if (status == NURBS_OK && file->entity[*subfigure].type != 308)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: entity 408 at D%zu is no instance of a 308",
                          file->path, iges_number(entity));
    for (size_t c = 0; c < 3 && status == NURBS_OK; c++) {
        status = iges_real(file, entity, 1 + c, 0, &own.shift[c]);
        own.shift[c] *= file->metres;
    }
    if (status == NURBS_OK)
        status = iges_real(file, entity, 4, 1, &scale);
    if (status == NURBS_OK && !(scale > 0))
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: entity 408 at D%zu: scale %g, expected > 0",
                          file->path, iges_number(entity), scale);
    if (status == NURBS_OK)
        status = iges_transformation(file, entity, moved.matrix, moved.shift);
    if (status != NURBS_OK)
        return status;
    own.matrix[0] = own.matrix[4] = own.matrix[8] = scale;
    *at = after(&moved, &own);
    return NURBS_OK;
}

static nurbs_status read_instance(scene *s, size_t entity, const placement *outer, int depth)
{
    iges_file *file = s->file;
    size_t subfigure, before = nurbs_patches_count(s->patches);
    placement own, at;
    nurbs_patches *made = NULL;
    nurbs_status status = instance_placement(file, entity, &subfigure, &own);
    if (status == NURBS_OK && (depth == MAX_NESTED || ++s->tally.instances > MAX_INSTANCES))
        status = nurbs_fail(NURBS_ERROR_FORMAT, "%s: subfigures inside each other without end",
                            file->path);
    if (status != NURBS_OK)
        return status;
    at = after(outer, &own);
    unsigned char *scope = calloc(file->count + 1, 1);
    status = scope ? mark_parts(file, subfigure, 0, scope)
                   : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a subfigure");
    if (status == NURBS_OK)
        status = nurbs_patches_create(&made);
    if (status == NURBS_OK)
        status = iges_read_scope(file, scope, s->tolerance, made, &s->tally);
    if (status == NURBS_OK)
        status = place_patches(made, &at, s->patches);
    if (status == NURBS_OK)
        status = read_instances(s, scope, &at, depth + 1);
    if (status == NURBS_OK)
        iges_report(file, "subfigure D%zu placed by D%zu: %zu patches; ", iges_number(subfigure),
                    iges_number(entity), nurbs_patches_count(s->patches) - before);
    nurbs_patches_free(made);
    free(scope);
    return status;
}

static nurbs_status read_instances(scene *s, const unsigned char *scope, const placement *outer,
                                   int depth)
{
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < s->file->count && status == NURBS_OK; k++) {
        const iges_entity *entity = &s->file->entity[k];
        if (entity->type != 408 || !scope[k])
            continue;
        if (entity->blank)
            s->tally.blank++;
        else
            status = read_instance(s, k, outer, depth);
    }
    return status;
}

/* Everything that is not part of a subfigure. */
static nurbs_status root_scope(const iges_file *file, unsigned char *scope)
{
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < file->count && status == NURBS_OK; k++)
        if (file->entity[k].type == 308)
            status = mark_parts(file, k, 0, scope);
    for (size_t k = 0; k < file->count; k++)
        scope[k] = !scope[k];
    return status;
}

static void report_summary(iges_file *file, const iges_tally *tally)
{
    if (tally->faces > 0) {
        iges_report(file, "%zu faces and surfaces of other kinds, %zu of them exact", tally->faces,
                    tally->exact);
        if (tally->pieces > 0)
            iges_report(file, ", others resampled as %zu patches", tally->pieces);
        if (tally->left_out > 0)
            iges_report(file, ", %zu left out", tally->left_out);
        iges_report(file, "; ");
    }
    if (tally->blank > 0)
        iges_report(file, "%zu blank entities are left out; ", tally->blank);
    iges_report(file, "%zu surfaces kept, %zu of them trimmed in the file", tally->surfaces,
                tally->trimmed);
    if (tally->resampled > 0)
        iges_report(file, ", %zu of these resampled", tally->resampled);
}

static nurbs_status read_file(iges_file *file, double tolerance, nurbs_patches *patches)
{
    static const placement identity = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
    scene s = {.file = file, .tolerance = tolerance, .patches = patches};
    unsigned char *scope = calloc(file->count + 1, 1);
    nurbs_status status = scope ? spread_blank(file)
                                : nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu entities",
                                             file->path, file->count);
    report_counts(file);
    if (status == NURBS_OK)
        status = root_scope(file, scope);
    if (status == NURBS_OK)
        status = iges_read_scope(file, scope, tolerance, patches, &s.tally);
    if (status == NURBS_OK)
        status = read_instances(&s, scope, &identity, 0);
    free(scope);
    if (status != NURBS_OK)
        return status;
    report_summary(file, &s.tally);
    if (nurbs_patches_count(patches) > 0)
        return NURBS_OK;
    return nurbs_fail(NURBS_ERROR_FORMAT,
                      "%s: no surface that can be read among %zu entities; %zu faces are left out, "
                      "%zu entities blank",
                      file->path, file->count, s.tally.left_out, s.tally.blank);
}

nurbs_status nurbs_patches_read_iges_untrimmed(const char *path, double tolerance,
                                               nurbs_patches **patches, char *report,
                                               size_t report_size)
{
    NURBS_NEED(path && patches);
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
    NURBS_NEED(path && patches);
    return nurbs_patches_read_iges_untrimmed(path, 0, patches, report, report_size);
}
