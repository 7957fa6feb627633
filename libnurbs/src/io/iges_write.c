/* IGES 5.3 with one entity 128 per patch, lengths in metres, 17 digits. The date in the header is
 * fixed: the same patches give the same file. */
#include "core/error.h"
#include "core/textfile.h"

#include <nurbs/io.h>

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* A section being filled: fields are packed into lines and never broken. */
typedef struct writer {
    FILE *stream; /* NULL: only count lines */
    char letter;
    size_t width;     /* columns for data: 72, or 64 before the directory pointer */
    size_t sequence;  /* lines written in this section */
    size_t directory; /* for parameter lines */
    char line[80];
    size_t used;
} writer;

static void flush_line(writer *out)
{
    if (out->used == 0)
        return;
    out->sequence++;
    if (out->stream) {
        fprintf(out->stream, "%-*s", (int)out->width, out->line);
        if (out->letter == 'P')
            fprintf(out->stream, "%8zu", out->directory);
        fprintf(out->stream, "%c%7zu\n", out->letter, out->sequence % 10000000);
    }
    out->used = 0;
    out->line[0] = '\0';
}

/* Adds text with its delimiter; a string too long for one line runs over. */
__attribute__((format(printf, 2, 3))) static void put(writer *out, const char *format, ...)
{
    char text[400];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    size_t length = strlen(text);
    if (out->used + length > out->width && length <= out->width)
        flush_line(out);
    for (size_t k = 0; k < length; k++) {
        if (out->used == out->width)
            flush_line(out);
        out->line[out->used++] = text[k];
        out->line[out->used] = '\0';
    }
}

/* The shortest text that restores the number, with the point that makes it a real. */
static void put_real(writer *out, double value, char delimiter)
{
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    if (!strchr(text, '.')) {
        char *mark = strchr(text, 'e');
        if (mark) {
            memmove(mark + 1, mark, strlen(mark) + 1);
            *mark = '.';
        } else {
            strcat(text, ".");
        }
    }
    for (char *c = text; *c; c++)
        if (*c == 'e')
            *c = 'E';
    put(out, "%s%c", text, delimiter);
}

static void put_string(writer *out, const char *text, char delimiter)
{
    put(out, "%zuH%s%c", strlen(text), text, delimiter);
}

/* The last part of the path, other readers' ASCII range only. */
static void file_name(const char *path, char name[64])
{
    const char *slash = strrchr(path, '/');
    snprintf(name, 64, "%s", slash ? slash + 1 : path);
    for (char *c = name; *c; c++)
        if (!isprint((unsigned char)*c) || (unsigned char)*c > 126)
            *c = '_';
}

static double largest_coordinate(const nurbs_patches *patches)
{
    double reach = 0;
    for (size_t k = 0; k < nurbs_patches_count(patches); k++) {
        const nurbs_surface *surface = nurbs_patches_get(patches, k);
        const double *p = nurbs_surface_points(surface);
        size_t n = 3 * nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
        for (size_t i = 0; i < n; i++)
            reach = fmax(reach, fabs(p[i]));
    }
    return reach;
}

static size_t write_global(FILE *stream, const char *path, double reach)
{
    writer out = {.stream = stream, .letter = 'G', .width = 72};
    char name[64];
    file_name(path, name);
    put(&out, "1H,,1H;,");
    put_string(&out, name, ',');
    put_string(&out, name, ',');
    put_string(&out, "libnurbs", ',');
    put_string(&out, nurbs_version(), ',');
    put(&out, "32,38,6,308,15,");
    put_string(&out, name, ',');
    put(&out, "1.,6,1HM,1,0.01,15H20000101.000000,");
    put_real(&out, reach > 0 ? 1e-12 * reach : 1e-12, ',');
    put_real(&out, reach, ',');
    put(&out, "0H,0H,11,0,15H20000101.000000;");
    flush_line(&out);
    return out.sequence;
}

/* Whether the first and the last line of control points in direction d agree. */
static int is_closed(const nurbs_surface *surface, int d, double slack)
{
    size_t nu = nurbs_surface_size(surface, 0), nv = nurbs_surface_size(surface, 1);
    const double *p = nurbs_surface_points(surface);
    for (size_t k = 0; k < (d ? nu : nv); k++) {
        size_t a = d ? k * nv : k, b = d ? k * nv + nv - 1 : (nu - 1) * nv + k;
        for (size_t c = 0; c < 3; c++)
            if (fabs(p[3 * a + c] - p[3 * b + c]) > slack)
                return 0;
    }
    return 1;
}

static void write_surface(writer *out, const nurbs_surface *surface, double reach)
{
    size_t nu = nurbs_surface_size(surface, 0), nv = nurbs_surface_size(surface, 1);
    const double *points = nurbs_surface_points(surface), *weights = nurbs_surface_weights(surface);
    put(out, "128,");
    put(out, "%zu,", nu - 1);
    put(out, "%zu,", nv - 1);
    for (int d = 0; d < 2; d++)
        put(out, "%d,", nurbs_surface_degree(surface, d));
    for (int d = 0; d < 2; d++)
        put(out, "%d,", is_closed(surface, d, 1e-12 * reach));
    put(out, "%d,", weights ? 0 : 1);
    put(out, "0,0,");
    for (int d = 0; d < 2; d++) {
        const double *knots = nurbs_surface_knots(surface, d);
        size_t count =
            nurbs_surface_size(surface, d) + (size_t)nurbs_surface_degree(surface, d) + 1;
        for (size_t k = 0; k < count; k++)
            put_real(out, knots[k], ',');
    }
    for (size_t j = 0; j < nv; j++)
        for (size_t i = 0; i < nu; i++)
            put_real(out, weights ? weights[i * nv + j] : 1, ',');
    for (size_t j = 0; j < nv; j++)
        for (size_t i = 0; i < nu; i++)
            for (size_t c = 0; c < 3; c++)
                put_real(out, points[3 * (i * nv + j) + c], ',');
    for (int d = 0; d < 2; d++) {
        const double *knots = nurbs_surface_knots(surface, d);
        put_real(out, knots[0], ',');
        put_real(out, knots[nurbs_surface_size(surface, d)], d ? ';' : ',');
    }
    flush_line(out);
}

/* The directory comes before the parameters but holds their line numbers: they are counted first.
 */
static void write_entities(FILE *stream, const nurbs_patches *patches, double reach,
                           size_t lines[2])
{
    size_t count = nurbs_patches_count(patches);
    writer counter = {.letter = 'P', .width = 64}, out = counter;
    for (size_t k = 0; k < count; k++) {
        size_t first = counter.sequence + 1;
        write_surface(&counter, nurbs_patches_get(patches, k), reach);
        fprintf(stream, "%8d%8zu%8d%8d%8d%8d%8d%8d%08dD%7zu\n", 128, first, 0, 0, 0, 0, 0, 0, 0,
                2 * k + 1);
        fprintf(stream, "%8d%8d%8d%8zu%8d%8s%8s%8s%8dD%7zu\n", 128, 0, 0,
                counter.sequence + 1 - first, 0, "", "", "HULL", 0, 2 * k + 2);
    }
    out.stream = stream;
    for (size_t k = 0; k < count; k++) {
        out.directory = 2 * k + 1;
        write_surface(&out, nurbs_patches_get(patches, k), reach);
    }
    lines[0] = 2 * count;
    lines[1] = out.sequence;
}

nurbs_status nurbs_patches_write_iges(const nurbs_patches *patches, const char *path)
{
    NURBS_NEED(patches && path);
    outfile file;
    size_t lines[2] = {0, 0};
    if (nurbs_patches_count(patches) == 0)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s: no patches to write", path);
    nurbs_status status = outfile_open(&file, path);
    if (status != NURBS_OK)
        return status;
    double reach = largest_coordinate(patches);
    fprintf(file.stream, "%-72sS%7d\n", "NURBS surfaces, lengths in metres", 1);
    size_t global = write_global(file.stream, path, reach);
    write_entities(file.stream, patches, reach, lines);
    fprintf(file.stream, "S%7dG%7zuD%7zuP%7zu%40sT%7d\n", 1, global, lines[0], lines[1], "", 1);
    return outfile_commit(&file);
}

nurbs_status nurbs_surface_write_iges(const nurbs_surface *surface, const char *path)
{
    NURBS_NEED(surface && path);
    nurbs_patches *patches;
    nurbs_status status = nurbs_patches_create(&patches);
    if (status == NURBS_OK)
        status = nurbs_patches_add(patches, surface);
    if (status == NURBS_OK)
        status = nurbs_patches_write_iges(patches, path);
    nurbs_patches_free(patches);
    return status;
}
