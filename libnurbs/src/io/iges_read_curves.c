#include "core/error.h"
#include "core/textfile.h"
#include "io/iges.h"

#include <nurbs/io.h>

#include <stdlib.h>

enum { MAX_DEPTH = 16, MAX_CURVES = 100000 };

typedef struct curve_list {
    size_t count, room;
    nurbs_curve **curve;
} curve_list;

static nurbs_status append(iges_file *file, size_t entity, curve_list *list)
{
    if (list->count == list->room) {
        size_t room = list->room ? 2 * list->room : 16;
        nurbs_curve **larger = realloc(list->curve, room * sizeof *larger);
        if (!larger)
            return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu curves", file->path, room);
        list->curve = larger;
        list->room = room;
    }
    nurbs_status status = iges_curve(file, entity, file->metres, &list->curve[list->count]);
    list->count += status == NURBS_OK;
    return status;
}

/* A curve, or the parts of a composite one. */
static nurbs_status collect(iges_file *file, size_t entity, int depth, curve_list *list)
{
    int type = file->entity[entity].type;
    if (type == 100 || type == 104 || type == 106 || type == 110 || type == 112 || type == 126)
        return append(file, entity, list);
    if (type != 102)
        return NURBS_OK;
    long parts = 0;
    nurbs_status status = iges_integer(file, entity, 0, 0, &parts);
    /* A composite inside itself would never end. */
    if (status == NURBS_OK && (depth == MAX_DEPTH || list->count > MAX_CURVES))
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: composite curve at D%zu: composites inside each other without end",
                          file->path, iges_number(entity));
    for (long k = 0; k < parts && status == NURBS_OK; k++) {
        size_t part;
        status = iges_pointer(file, entity, (size_t)k + 1, &part);
        if (status == NURBS_OK)
            status = collect(file, part, depth + 1, list);
    }
    return status;
}

void nurbs_curves_free(size_t n, nurbs_curve **curves)
{
    for (size_t k = 0; curves && k < n; k++)
        nurbs_curve_free(curves[k]);
    free(curves);
}

nurbs_status nurbs_curves_read_iges(const char *path, size_t *n, nurbs_curve ***curves)
{
    NURBS_NEED(path && n && curves);
    iges_file file = {0};
    curve_list list = {0};
    numeric_locale locale;
    *n = 0;
    *curves = NULL;
    numeric_locale_set(&locale);
    nurbs_status status = iges_open(path, &file);
    for (size_t k = 0; k < file.count && status == NURBS_OK; k++) {
        /* 01 and 03: physically dependent on another entity. */
        if (file.entity[k].dependent % 2 == 0)
            status = collect(&file, k, 0, &list);
    }
    iges_close(&file);
    numeric_locale_restore(&locale);
    if (status != NURBS_OK) {
        nurbs_curves_free(list.count, list.curve);
        return status;
    }
    *n = list.count;
    *curves = list.curve;
    return NURBS_OK;
}
