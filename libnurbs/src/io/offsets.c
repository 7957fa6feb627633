/* Offset tables. */
#include "core/error.h"
#include "core/textfile.h"
#include "io/sections.h"

#include <nurbs/offsets.h>

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_COLUMNS = 400, LEAST_GRID = 40, WORD = 32 };

/* Columns that are no waterlines; a waterline is WATERLINE. */
typedef enum column_kind {
    WATERLINE,
    KEEL,
    DECK_Z,
    DECK_Y,
    KNUCKLE_Z,
    KNUCKLE_Y,
    COLUMN_KINDS
} column_kind;

static const char *const column_names[COLUMN_KINDS] = {"",       "keel",      "deck_z",
                                                       "deck_y", "knuckle_z", "knuckle_y"};

typedef struct row {
    size_t line;
    double station;
    double *entry; /* [columns]; NAN: empty */
} row;

typedef struct table {
    const char *path;
    double length, breadth, draft, x_origin, x_scale, y_scale, z_origin, z_scale;
    size_t columns;
    column_kind kind[MOST_COLUMNS];
    double waterline[MOST_COLUMNS], most[MOST_COLUMNS];
    size_t order[MOST_COLUMNS]; /* waterlines from high to low */
    size_t waterlines;
    bool has_header;
    size_t rows, room;
    row *row;
    row end[2]; /* stem and stern; entry NULL: none */
} table;

static void table_free(table *t)
{
    for (size_t k = 0; k < t->rows; k++)
        free(t->row[k].entry);
    free(t->row);
    free(t->end[0].entry);
    free(t->end[1].entry);
}

/* The next entry of a line, blanks round it removed; false behind the last one. */
static bool next_entry(const char **at, char text[WORD])
{
    if (!*at)
        return false;
    size_t n = strcspn(*at, ",\n#"), first = 0;
    const char *entry = *at;
    *at = entry[n] == ',' ? entry + n + 1 : NULL;
    while (n > 0 && isspace((unsigned char)entry[n - 1]))
        n--;
    while (first < n && isspace((unsigned char)entry[first]))
        first++;
    n -= first;
    if (n >= WORD)
        n = WORD - 1;
    memcpy(text, entry + first, n);
    text[n] = '\0';
    return true;
}

static nurbs_status number(const table *t, size_t line, const char *text, double *value)
{
    char *end;
    *value = strtod(text, &end);
    if (end == text || *end || !isfinite(*value))
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: '%s', expected a number", t->path, line,
                          text);
    return NURBS_OK;
}

static nurbs_status read_setting(table *t, size_t line, const char *name, const char *at)
{
    const struct {
        const char *name;
        double *value;
        bool positive;
    } settings[] = {{"length", &t->length, true},      {"breadth", &t->breadth, true},
                    {"draft", &t->draft, true},        {"x_origin", &t->x_origin, false},
                    {"x_scale", &t->x_scale, false},   {"y_scale", &t->y_scale, true},
                    {"z_origin", &t->z_origin, false}, {"z_scale", &t->z_scale, true}};
    char text[WORD];
    for (size_t k = 0; k < sizeof settings / sizeof *settings; k++) {
        if (strcasecmp(name, settings[k].name) != 0)
            continue;
        if (!next_entry(&at, text))
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: %s has no value", t->path, line, name);
        nurbs_status status = number(t, line, text, settings[k].value);
        if (status == NURBS_OK &&
            (settings[k].positive ? !(*settings[k].value > 0)
                                  : settings[k].value == &t->x_scale && *settings[k].value == 0))
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: %s is %g, expected %s", t->path, line,
                              name, *settings[k].value, settings[k].positive ? "> 0" : "not 0");
        return status;
    }
    return nurbs_fail(
        NURBS_ERROR_FORMAT,
        "%s:%zu: '%s', expected a setting (length, breadth, draft, x_origin, x_scale, "
        "y_scale, z_origin, z_scale) or the header 'station,...'",
        t->path, line, name);
}

static nurbs_status check_columns(table *t, size_t line)
{
    size_t times[COLUMN_KINDS] = {0};
    for (size_t k = 0; k < t->columns; k++) {
        times[t->kind[k]]++;
        if (t->kind[k] != WATERLINE)
            continue;
        size_t at = t->waterlines++;
        for (; at > 0 && t->waterline[t->order[at - 1]] < t->waterline[k]; at--)
            t->order[at] = t->order[at - 1];
        if (at > 0 && t->waterline[t->order[at - 1]] == t->waterline[k])
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: waterline %g is there twice", t->path,
                              line, t->waterline[k]);
        t->order[at] = k;
    }
    for (int k = 1; k < COLUMN_KINDS; k++)
        if (times[k] > 1)
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: column %s is there twice", t->path, line,
                              column_names[k]);
    if (times[DECK_Y] != times[DECK_Z] || times[KNUCKLE_Y] != times[KNUCKLE_Z])
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s:%zu: deck_z goes with deck_y, knuckle_z with knuckle_y", t->path,
                          line);
    if (t->waterlines < 2)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: %zu waterlines, expected two or more",
                          t->path, line, t->waterlines);
    return NURBS_OK;
}

static nurbs_status read_header(table *t, size_t line, const char *at)
{
    char text[WORD];
    t->has_header = true;
    while (next_entry(&at, text)) {
        size_t k = t->columns++;
        int kind = 1;
        if (k == MOST_COLUMNS)
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: more than %d columns", t->path, line,
                              MOST_COLUMNS);
        while (kind < COLUMN_KINDS && strcasecmp(text, column_names[kind]) != 0)
            kind++;
        t->kind[k] = kind < COLUMN_KINDS ? (column_kind)kind : WATERLINE;
        t->most[k] = 1;
        nurbs_status status = NURBS_OK;
        if (t->kind[k] == WATERLINE)
            status = number(t, line, text, &t->waterline[k]);
        if (status != NURBS_OK)
            return status;
    }
    return check_columns(t, line);
}

/* Entries behind the name of a line. */
static nurbs_status read_entries(const table *t, size_t line, const char *at, double *entry)
{
    char text[WORD];
    size_t k = 0;
    for (; next_entry(&at, text); k++) {
        if (k >= t->columns) {
            if (text[0] == '\0')
                continue;
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: more entries than the %zu columns",
                              t->path, line, t->columns);
        }
        entry[k] = NAN;
        nurbs_status status = text[0] ? number(t, line, text, &entry[k]) : NURBS_OK;
        if (status != NURBS_OK)
            return status;
    }
    for (; k < t->columns; k++)
        entry[k] = NAN;
    return NURBS_OK;
}

static nurbs_status read_row(table *t, size_t line, const char *name, const char *at)
{
    static const char *const ends[2] = {"stem", "stern"};
    double *entry = malloc(t->columns * sizeof *entry), station = 0;
    if (!entry)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for a station", t->path);
    nurbs_status status = read_entries(t, line, at, entry);
    bool most = strcasecmp(name, "max") == 0;
    int end = strcasecmp(name, ends[0]) == 0 ? 0 : strcasecmp(name, ends[1]) == 0 ? 1 : 2;
    if (status == NURBS_OK && !most && end == 2)
        status = number(t, line, name, &station);
    for (size_t k = 0; k < t->columns && status == NURBS_OK && end == 2; k++)
        if ((t->kind[k] == WATERLINE || t->kind[k] == DECK_Y || t->kind[k] == KNUCKLE_Y) &&
            entry[k] < 0)
            status = nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: half breadth %g, expected >= 0",
                                t->path, line, entry[k]);
    if (status == NURBS_OK && end < 2 && t->end[end].entry)
        status = nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: a second %s", t->path, line, ends[end]);
    if (status == NURBS_OK && !most && end == 2 && t->rows == t->room) {
        size_t room = t->room ? 2 * t->room : 32;
        row *larger = realloc(t->row, room * sizeof *larger);
        if (larger) {
            t->row = larger;
            t->room = room;
        } else {
            status =
                nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu stations", t->path, room);
        }
    }
    if (status != NURBS_OK || most) {
        for (size_t k = 0; k < t->columns && status == NURBS_OK; k++)
            t->most[k] = isnan(entry[k]) ? 1 : entry[k];
        free(entry);
        return status;
    }
    if (end < 2)
        t->end[end] = (row){line, 0, entry};
    else
        t->row[t->rows++] = (row){line, station, entry};
    return NURBS_OK;
}

static nurbs_status read_table(table *t, const char *text)
{
    size_t line = 1;
    nurbs_status status = NURBS_OK;
    for (const char *at = text; *at && status == NURBS_OK; line++) {
        const char *rest = at;
        char name[WORD];
        next_entry(&rest, name);
        if (name[0] == '\0' && rest) {
            status = nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: a line without a name or station",
                                t->path, line);
        } else if (name[0] && !t->has_header) {
            status = strcasecmp(name, "station") == 0 ? read_header(t, line, rest)
                                                      : read_setting(t, line, name, rest);
        } else if (name[0]) {
            status = read_row(t, line, name, rest);
        }
        at += strcspn(at, "\n");
        at += *at == '\n';
    }
    if (status == NURBS_OK && !t->has_header)
        status = nurbs_fail(NURBS_ERROR_FORMAT, "%s: no header 'station,<waterline>,...'", t->path);
    return status;
}

/* Column of a kind, its entry in a row; NAN: none. */
static double entry_of(const table *t, const row *r, column_kind kind)
{
    for (size_t k = 0; k < t->columns; k++)
        if (t->kind[k] == kind)
            return r->entry[k];
    return NAN;
}

static void put(section *s, double x, double y, double z)
{
    double *p = s->points + 3 * s->count++;
    p[0] = x;
    p[1] = y;
    p[2] = z;
}

/* Puts the knuckle where its height belongs. */
static void insert_knuckle(section *s, double x, double y, double z)
{
    size_t at = 0;
    while (at < s->count && s->points[3 * at + 2] > z)
        at++;
    if (at < s->count && s->points[3 * at + 2] == z) {
        s->points[3 * at + 1] = y;
    } else {
        memmove(s->points + 3 * at + 3, s->points + 3 * at, 3 * (s->count - at) * sizeof(double));
        s->count++;
        s->points[3 * at] = x;
        s->points[3 * at + 1] = y;
        s->points[3 * at + 2] = z;
    }
    s->knuckle = at + 1;
}

static double height(const table *t, double waterline)
{
    return t->z_origin + t->z_scale * waterline;
}

/* A station from deck to keel, ending on the centre line. */
static nurbs_status add_station(const table *t, const row *r, section_list *list)
{
    section *s = section_append(list, t->waterlines + 5);
    if (!s)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for a section", t->path);
    double keel = entry_of(t, r, KEEL), deck = entry_of(t, r, DECK_Z);
    s->x = t->x_origin + t->x_scale * r->station;
    s->line = r->line;
    if (!isnan(deck) && !isnan(entry_of(t, r, DECK_Y)))
        put(s, s->x, t->y_scale * entry_of(t, r, DECK_Y), height(t, deck));
    for (size_t i = 0; i < t->waterlines; i++) {
        size_t k = t->order[i];
        if (isnan(r->entry[k]) || t->waterline[k] >= deck || t->waterline[k] < keel)
            continue;
        put(s, s->x, t->y_scale * r->entry[k] * t->most[k], height(t, t->waterline[k]));
    }
    if (s->count == 0)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: station %g has no entries", t->path, r->line,
                          r->station);
    double z = entry_of(t, r, KNUCKLE_Z), y = entry_of(t, r, KNUCKLE_Y);
    if (!isnan(z) && !isnan(y))
        insert_knuckle(s, s->x, t->y_scale * y, height(t, z));
    const double *last = s->points + 3 * (s->count - 1), breadth = last[1], low = last[2],
                 bottom = isnan(keel) ? low : height(t, keel);
    /* One more point keeps a flat bottom flat. */
    if (breadth > 0 && bottom == low)
        put(s, s->x, 0.5 * breadth, bottom);
    if (breadth > 0 || bottom < low)
        put(s, s->x, 0, bottom);
    /* At an end of the section a knuckle breaks nothing. */
    if (s->knuckle == 1 || s->knuckle == s->count)
        s->knuckle = 0;
    return NURBS_OK;
}

/* The profile of an end: on the centre line where it has an entry, else as broad as the station
 * next to it, at the nearest place that it gives. */
static nurbs_status add_end(const table *t, const row *r, const row *next, section_list *list)
{
    section *s = section_append(list, t->waterlines);
    double x = NAN, sum = 0;
    if (!s)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for a section", t->path);
    s->line = r->line;
    for (size_t i = t->waterlines; i-- > 0;)
        if (!isnan(r->entry[t->order[i]]))
            x = r->entry[t->order[i]];
    if (isnan(x))
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: a profile without entries", t->path,
                          r->line);
    for (size_t i = 0; i < t->waterlines; i++) {
        size_t k = t->order[i];
        double y = next->entry[k] * t->most[k];
        if (!isnan(r->entry[k])) {
            x = r->entry[k];
            y = 0;
        } else if (isnan(y)) {
            continue;
        }
        put(s, t->x_origin + t->x_scale * x, t->y_scale * y, height(t, t->waterline[k]));
    }
    for (size_t k = 0; k < s->count; k++)
        sum += s->points[3 * k];
    s->x = sum / (double)s->count;
    return NURBS_OK;
}

/* The station nearest to an end. */
static const row *outermost(const table *t, const row *end)
{
    double place = NAN;
    const row *best = &t->row[0];
    for (size_t k = 0; k < t->columns; k++)
        if (t->kind[k] == WATERLINE && !isnan(end->entry[k]))
            place = end->entry[k];
    for (size_t k = 1; k < t->rows; k++)
        if (fabs(t->row[k].station - place) < fabs(best->station - place))
            best = &t->row[k];
    return best;
}

/* A profile that touches the outermost station, where that lies on the centre line, stands for it:
 * both would coincide there. */
static bool stands_for(const table *t, const row *end, const row *station)
{
    for (size_t k = 0; k < t->columns; k++)
        if (t->kind[k] == WATERLINE && end->entry[k] == station->station && station->entry[k] == 0)
            return true;
    return false;
}

static bool is_replaced(const table *t, const row *station)
{
    for (int e = 0; e < 2; e++)
        if (t->end[e].entry && outermost(t, &t->end[e]) == station &&
            stands_for(t, &t->end[e], station))
            return true;
    return false;
}

static nurbs_status make_grid(const table *t, size_t columns, nurbs_grid **grid,
                              nurbs_offsets_info *info)
{
    section_list list = {0};
    nurbs_status status =
        t->rows >= 2 ? NURBS_OK
                     : nurbs_fail(NURBS_ERROR_FORMAT, "%s: %zu stations, expected two or more",
                                  t->path, t->rows);
    for (size_t k = 0; k < t->rows && status == NURBS_OK; k++)
        status = is_replaced(t, &t->row[k]) ? NURBS_OK : add_station(t, &t->row[k], &list);
    for (int e = 0; e < 2 && status == NURBS_OK; e++)
        if (t->end[e].entry)
            status = add_end(t, &t->end[e], outermost(t, &t->end[e]), &list);
    size_t chine = 0, usual = 4 * t->waterlines;
    if (status == NURBS_OK)
        status = section_list_grid(&list, t->path, columns, usual < LEAST_GRID ? LEAST_GRID : usual,
                                   grid, &chine);
    if (status == NURBS_OK && info)
        *info = (nurbs_offsets_info){list.count, chine, t->length, t->breadth, t->draft, {0}};
    section_list_free(&list);
    return status;
}

nurbs_status nurbs_offsets_read(const char *path, size_t columns, nurbs_grid **grid,
                                nurbs_offsets_info *info)
{
    numeric_locale locale;
    char *text;
    size_t length;
    if (!path || !grid)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no path or no grid");
    *grid = NULL;
    table *t = calloc(1, sizeof *t);
    if (!t)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for a table", path);
    t->path = path;
    t->x_scale = t->y_scale = t->z_scale = 1;
    nurbs_status status = textfile_read(path, &text, &length);
    numeric_locale_set(&locale);
    if (status == NURBS_OK && strlen(text) != length)
        status = nurbs_fail(NURBS_ERROR_FORMAT, "%s: byte %zu is zero: not a text file", path,
                            strlen(text));
    if (status == NURBS_OK)
        status = read_table(t, text);
    numeric_locale_restore(&locale);
    if (status == NURBS_OK)
        status = make_grid(t, columns, grid, info);
    table_free(t);
    free(t);
    free(text);
    return status;
}
