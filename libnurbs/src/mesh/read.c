/* STL and OBJ files. */
#include "core/error.h"
#include "core/textfile.h"
#include "mesh/mesh.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct soup {
    const char *path; /* borrowed */
    size_t vertices, vertex_room, corners, corner_room;
    double *points;
    size_t *corner;
} soup;

static nurbs_status grow(const soup *s, size_t used, size_t *room, size_t size, void **array)
{
    if (used < *room)
        return NURBS_OK;
    size_t more = *room ? 2 * *room : 1024;
    void *larger = realloc(*array, more * size);
    if (!larger)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu values", s->path, more);
    *array = larger;
    *room = more;
    return NURBS_OK;
}

static nurbs_status add_vertex(soup *s, const double p[3])
{
    void *points = s->points;
    nurbs_status status = grow(s, s->vertices, &s->vertex_room, 3 * sizeof *s->points, &points);
    s->points = points;
    if (status == NURBS_OK)
        memcpy(s->points + 3 * s->vertices++, p, 3 * sizeof *p);
    return status;
}

static nurbs_status add_corner(soup *s, size_t index)
{
    void *corner = s->corner;
    nurbs_status status = grow(s, s->corners, &s->corner_room, sizeof *s->corner, &corner);
    s->corner = corner;
    if (status == NURBS_OK)
        s->corner[s->corners++] = index;
    return status;
}

/* Three numbers; *at moves behind them. */
static bool three_numbers(const char **at, double p[3])
{
    for (int c = 0; c < 3; c++) {
        char *end;
        while (**at == ' ' || **at == '\t')
            ++*at;
        p[c] = strtod(*at, &end);
        if (end == *at || !isfinite(p[c]))
            return false;
        *at = end;
    }
    return true;
}

/* The word at the beginning of a line, blanks skipped. */
static bool begins(const char **at, const char *word)
{
    size_t n = strlen(word);
    const char *from = *at;
    while (*from == ' ' || *from == '\t')
        from++;
    if (strncmp(from, word, n) != 0 || (from[n] && !isspace((unsigned char)from[n])))
        return false;
    *at = from + n;
    return true;
}

static const char *next_line(const char *at)
{
    at += strcspn(at, "\n");
    return *at ? at + 1 : at;
}

static nurbs_status read_ascii_stl(soup *s, const char *text)
{
    nurbs_status status = NURBS_OK;
    size_t number = 1, in_facet = 0;
    bool ended = false;
    for (const char *line = text; *line && status == NURBS_OK; line = next_line(line), number++) {
        const char *at = line;
        double p[3];
        if (begins(&at, "vertex")) {
            if (!three_numbers(&at, p))
                return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: expected 'vertex x y z'", s->path,
                                  number);
            status = add_corner(s, s->vertices);
            if (status == NURBS_OK)
                status = add_vertex(s, p);
            in_facet++;
        } else if (begins(&at, "endfacet")) {
            if (in_facet != 3)
                return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: a facet of %zu vertices, expected 3",
                                  s->path, number, in_facet);
            in_facet = 0;
        }
        at = line;
        ended |= begins(&at, "endsolid");
    }
    if (status == NURBS_OK && (in_facet || !ended))
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: no endsolid: the file is cut", s->path,
                          number);
    return status;
}

static double little_endian(const unsigned char *at)
{
    uint32_t bits = 0;
    float value;
    for (int k = 3; k >= 0; k--)
        bits = bits << 8 | at[k];
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

enum { STL_HEADER = 84, STL_FACET = 50 };

static size_t facets_stated(const char *bytes)
{
    const unsigned char *at = (const unsigned char *)bytes + 80;
    return (size_t)at[0] | (size_t)at[1] << 8 | (size_t)at[2] << 16 | (size_t)at[3] << 24;
}

static nurbs_status read_binary_stl(soup *s, const char *bytes, size_t length)
{
    size_t n = facets_stated(bytes);
    nurbs_status status = NURBS_OK;
    if (length < STL_HEADER + STL_FACET * n)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: %zu bytes, but its %zu triangles take %zu: the file is cut", s->path,
                          length, n, STL_HEADER + STL_FACET * n);
    for (size_t k = 0; k < 3 * n && status == NURBS_OK; k++) {
        size_t byte = STL_HEADER + STL_FACET * (k / 3) + 12 * (k % 3 + 1);
        double p[3];
        for (size_t c = 0; c < 3; c++) {
            p[c] = little_endian((const unsigned char *)bytes + byte + 4 * c);
            if (!isfinite(p[c]))
                return nurbs_fail(NURBS_ERROR_FORMAT, "%s: byte %zu: a coordinate is %g", s->path,
                                  byte + 4 * c, p[c]);
        }
        status = add_corner(s, s->vertices);
        if (status == NURBS_OK)
            status = add_vertex(s, p);
    }
    return status;
}

/* Binary files may begin with "solid" too: their length tells. */
static bool is_ascii_stl(const char *bytes, size_t length)
{
    const char *at = bytes;
    if (length >= STL_HEADER && length == STL_HEADER + STL_FACET * facets_stated(bytes))
        return false;
    return begins(&at, "solid") && strlen(bytes) == length;
}

/* "f 1 2/3 4//5 -1": the first number of each group, from 1, or from the end if negative. */
static nurbs_status read_face(soup *s, const char *at, size_t number)
{
    size_t first = 0, last = 0, count = 0;
    nurbs_status status = NURBS_OK;
    for (;;) {
        char *end;
        while (*at == ' ' || *at == '\t' || *at == '\r')
            at++;
        if (*at == '\n' || *at == '\0' || *at == '#' || status != NURBS_OK)
            break;
        long index = strtol(at, &end, 10);
        size_t vertex = index > 0 ? (size_t)index - 1 : s->vertices + (size_t)index;
        if (end == at || index == 0 || vertex >= s->vertices)
            return nurbs_fail(NURBS_ERROR_FORMAT,
                              "%s:%zu: '%.12s' is no vertex of the %zu before it", s->path, number,
                              at, s->vertices);
        at = end + strcspn(end, " \t\r\n");
        if (count == 0)
            first = vertex;
        if (count >= 2) {
            status = add_corner(s, first);
            if (status == NURBS_OK)
                status = add_corner(s, last);
            if (status == NURBS_OK)
                status = add_corner(s, vertex);
        }
        last = vertex;
        count++;
    }
    if (status == NURBS_OK && count < 3)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: a face of %zu vertices, expected 3 or more",
                          s->path, number, count);
    return status;
}

static nurbs_status read_obj(soup *s, const char *text)
{
    nurbs_status status = NURBS_OK;
    size_t number = 1;
    for (const char *line = text; *line && status == NURBS_OK; line = next_line(line), number++) {
        const char *at = line;
        double p[3];
        if (begins(&at, "v")) {
            if (!three_numbers(&at, p))
                return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: expected 'v x y z'", s->path,
                                  number);
            status = add_vertex(s, p);
        } else if (begins(&at, "f")) {
            status = read_face(s, at, number);
        }
    }
    return status;
}

static bool has_extension(const char *path, const char *extension)
{
    size_t length = strlen(path), n = strlen(extension);
    if (length <= n)
        return false;
    for (size_t k = 0; k < n; k++)
        if (tolower((unsigned char)path[length - n + k]) != extension[k])
            return false;
    return true;
}

static nurbs_status read_soup(soup *s, const char *bytes, size_t length)
{
    if (has_extension(s->path, ".obj")) {
        if (strlen(bytes) != length)
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s: byte %zu is zero: not an OBJ file", s->path,
                              strlen(bytes));
        return read_obj(s, bytes);
    }
    if (is_ascii_stl(bytes, length))
        return read_ascii_stl(s, bytes);
    if (length < STL_HEADER)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: %zu bytes, not an STL file", s->path, length);
    return read_binary_stl(s, bytes, length);
}

nurbs_status nurbs_mesh_read(const char *path, double unit, nurbs_mesh **mesh)
{
    numeric_locale locale;
    char *bytes = NULL;
    size_t length = 0;
    if (!path || !mesh)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no path or no mesh");
    *mesh = NULL;
    if (!(isfinite(unit) && unit > 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s: unit %g m, expected > 0", path, unit);
    if (!has_extension(path, ".stl") && !has_extension(path, ".obj"))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s: meshes are read from .stl and .obj", path);
    soup s = {.path = path};
    numeric_locale_set(&locale);
    nurbs_status status = textfile_read(path, &bytes, &length);
    if (status == NURBS_OK)
        status = read_soup(&s, bytes, length);
    numeric_locale_restore(&locale);
    for (size_t k = 0; k < 3 * s.vertices; k++)
        s.points[k] *= unit;
    if (status == NURBS_OK && s.corners == 0)
        status = nurbs_fail(NURBS_ERROR_FORMAT, "%s: no triangles", path);
    if (status == NURBS_OK) {
        status = nurbs_mesh_create(s.vertices, s.points, s.corners / 3, s.corner, mesh);
        if (status != NURBS_OK && status != NURBS_ERROR_MEMORY) {
            char reason[256];
            snprintf(reason, sizeof reason, "%s", nurbs_last_error());
            status = nurbs_fail(status, "%s: %s", path, reason);
        }
    }
    free(bytes);
    free(s.points);
    free(s.corner);
    return status;
}
