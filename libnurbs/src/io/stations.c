/* Station files. */
#include "core/error.h"
#include "core/textfile.h"
#include "io/sections.h"

#include <nurbs/offsets.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRID_COLUMNS = 40 };

/* Up to three numbers of a line; more than it has gives the count that is there. 9: no number. */
static int numbers(const char *at, double value[3])
{
    int count = 0;
    for (;;) {
        while (*at == ' ' || *at == '\t' || *at == ',' || *at == ';' || *at == '\r')
            at++;
        if (*at == '\n' || *at == '\0' || *at == '#')
            return count;
        char *end;
        double v = strtod(at, &end);
        if (end == at || !isfinite(v) || count == 3)
            return 9;
        value[count++] = v;
        at = end;
    }
}

/* From keel to deck: turned. */
static void from_deck_down(section *s)
{
    const double *last = s->points + 3 * (s->count - 1);
    if (s->count < 2 || s->points[2] >= last[2])
        return;
    for (size_t a = 0, b = s->count - 1; a < b; a++, b--) {
        double swapped[3];
        memcpy(swapped, s->points + 3 * a, sizeof swapped);
        memcpy(s->points + 3 * a, s->points + 3 * b, sizeof swapped);
        memcpy(s->points + 3 * b, swapped, sizeof swapped);
    }
}

static nurbs_status read_stations(const char *path, const char *text, section_list *list)
{
    size_t line = 1;
    section *s = NULL;
    for (const char *at = text; *at; line++) {
        double v[3];
        int count = numbers(at, v);
        if (count > 2)
            return nurbs_fail(NURBS_ERROR_FORMAT,
                              "%s:%zu: expected 'x' of a station or 'y z' of a point", path, line);
        if (count == 2 && !s)
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: a point before the first station", path,
                              line);
        if (count == 1) {
            /* Room for the points up to the next station only. */
            const char *ahead = at;
            size_t most = 0;
            double w[3];
            do {
                ahead += strcspn(ahead, "\n");
                ahead += *ahead == '\n';
                most++;
            } while (*ahead && numbers(ahead, w) != 1);
            s = section_append(list, most);
            if (!s)
                return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu sections", path,
                                  list->count);
            s->x = v[0];
            s->line = line;
        } else if (count == 2) {
            double *p = s->points + 3 * s->count++;
            p[0] = s->x;
            p[1] = v[0];
            p[2] = v[1];
        }
        at += strcspn(at, "\n");
        at += *at == '\n';
    }
    for (size_t k = 0; k < list->count; k++) {
        if (list->section[k].count < 2)
            return nurbs_fail(NURBS_ERROR_FORMAT,
                              "%s:%zu: a station of %zu points, expected two "
                              "or more",
                              path, list->section[k].line, list->section[k].count);
        from_deck_down(&list->section[k]);
    }
    return NURBS_OK;
}

nurbs_status nurbs_stations_read(const char *path, size_t columns, nurbs_grid **grid)
{
    numeric_locale locale;
    section_list list = {0};
    char *text;
    size_t length, chine;
    if (!path || !grid)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no path or no grid");
    *grid = NULL;
    nurbs_status status = textfile_read(path, &text, &length);
    numeric_locale_set(&locale);
    if (status == NURBS_OK && strlen(text) != length)
        status = nurbs_fail(NURBS_ERROR_FORMAT, "%s: byte %zu is zero: not a text file", path,
                            strlen(text));
    if (status == NURBS_OK)
        status = read_stations(path, text, &list);
    numeric_locale_restore(&locale);
    if (status == NURBS_OK)
        status = section_list_grid(&list, path, columns, GRID_COLUMNS, grid, &chine);
    section_list_free(&list);
    free(text);
    return status;
}
