#include "io/sections.h"

#include "core/error.h"
#include "core/vector.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_COLUMNS = 4, MOST_COLUMNS = 10000 };

section *section_append(section_list *list, size_t most)
{
    if (list->count == list->room) {
        size_t room = list->room ? 2 * list->room : 32;
        section *larger = realloc(list->section, room * sizeof *larger);
        if (!larger)
            return NULL;
        list->section = larger;
        list->room = room;
    }
    double *points = malloc(3 * (most + 1) * sizeof *points);
    if (!points)
        return NULL;
    section *s = &list->section[list->count++];
    *s = (section){.points = points};
    return s;
}

void section_list_free(section_list *list)
{
    for (size_t k = 0; k < list->count; k++)
        free(list->section[k].points);
    free(list->section);
    *list = (section_list){0};
}

static int by_place(const void *a, const void *b)
{
    double x = ((const section *)a)->x, y = ((const section *)b)->x;
    return (x > y) - (x < y);
}

/* Slope at the end of a shape-preserving cubic, from its first two chords. */
static double end_slope(double h, double next_h, double d, double next_d)
{
    double slope = ((2 * h + next_h) * d - h * next_d) / (h + next_h);
    if (slope * d <= 0)
        return 0;
    return d * next_d <= 0 && fabs(slope) > 3 * fabs(d) ? 3 * d : slope;
}

/* Fritsch and Carlson (SIAM J. Numer. Anal. 17, 1980), with the slopes of Fritsch and Butland (SIAM
 * J. Sci. Stat. Comput. 5, 1984), of coordinate c of n points at s. */
static double slope_at(size_t n, const double *s, const double *points, size_t c, size_t k)
{
#define CHORD(i) ((points[3 * ((i) + 1) + c] - points[3 * (i) + c]) / (s[(i) + 1] - s[i]))
    if (n == 2)
        return CHORD(0);
    if (k == 0)
        return end_slope(s[1] - s[0], s[2] - s[1], CHORD(0), CHORD(1));
    if (k == n - 1)
        return end_slope(s[n - 1] - s[n - 2], s[n - 2] - s[n - 3], CHORD(n - 2), CHORD(n - 3));
    double h0 = s[k] - s[k - 1], h1 = s[k + 1] - s[k], d0 = CHORD(k - 1), d1 = CHORD(k),
           w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
    return d0 * d1 <= 0 ? 0 : (w0 + w1) / (w0 / d0 + w1 / d1);
#undef CHORD
}

/* The point at chord length `at` of n points. */
static void interpolate(size_t n, const double *s, const double *points, double at, double out[3])
{
    size_t k = 0;
    while (k + 2 < n && at > s[k + 1])
        k++;
    double h = s[k + 1] - s[k], t = fmin(fmax((at - s[k]) / h, 0), 1);
    for (size_t c = 0; c < 3; c++) {
        double a = points[3 * k + c], b = points[3 * (k + 1) + c],
               ma = h * slope_at(n, s, points, c, k), mb = h * slope_at(n, s, points, c, k + 1);
        out[c] = t == 1
                     ? b
                     : a + t * (ma + t * (3 * (b - a) - 2 * ma - mb + t * (2 * (a - b) + ma + mb)));
    }
}

/* Points that coincide with the one before are dropped; the knuckle's index follows. */
static void drop_repeated(section *s)
{
    size_t kept = 1, knuckle = s->knuckle;
    for (size_t k = 1; k < s->count; k++) {
        if (distance3(s->points + 3 * k, s->points + 3 * (kept - 1)) > 0) {
            memmove(s->points + 3 * kept, s->points + 3 * k, 3 * sizeof *s->points);
            kept++;
        }
        if (k + 1 == knuckle)
            s->knuckle = kept;
    }
    s->count = kept;
}

/* `count` points at equal shares of the length of points first ... last; the last one only on
 * demand. */
static nurbs_status sample(const section *s, size_t first, size_t last, size_t count, bool end,
                           double *out)
{
    size_t n = last - first + 1;
    const double *points = s->points + 3 * first;
    double *along = malloc(n * sizeof *along);
    if (!along)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section of %zu points", n);
    along[0] = 0;
    for (size_t k = 1; k < n; k++)
        along[k] = along[k - 1] + distance3(points + 3 * k - 3, points + 3 * k);
    for (size_t k = 0; k < count; k++) {
        double share = (double)k / (double)(end ? count - 1 : count);
        interpolate(n, along, points, share * along[n - 1], out + 3 * k);
    }
    free(along);
    return NURBS_OK;
}

/* Mean share of the length above the knuckle: how many columns go there, and where the break of a
 * section without knuckle lies. */
static double knuckle_share(const section_list *list)
{
    double sum = 0;
    size_t found = 0;
    for (size_t k = 0; k < list->count; k++) {
        const section *s = &list->section[k];
        double above = 0, length = 0;
        for (size_t i = 1; i < s->count; i++) {
            double step = distance3(s->points + 3 * i - 3, s->points + 3 * i);
            length += step;
            above += i < s->knuckle ? step : 0;
        }
        if (s->knuckle) {
            sum += above / length;
            found++;
        }
    }
    return found ? sum / (double)found : 0;
}

static nurbs_status sample_section(const section *s, size_t columns, size_t chine, double *out)
{
    if (!chine || !s->knuckle)
        return sample(s, 0, s->count - 1, columns, true, out);
    nurbs_status status = sample(s, 0, s->knuckle - 1, chine, false, out);
    if (status != NURBS_OK)
        return status;
    return sample(s, s->knuckle - 1, s->count - 1, columns - chine, true, out + 3 * chine);
}

nurbs_status section_list_grid(section_list *list, const char *path, size_t columns, size_t usual,
                               nurbs_grid **grid, size_t *chine)
{
    columns = columns ? columns : usual;
    if (columns < LEAST_COLUMNS || columns > MOST_COLUMNS)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s: %zu columns, expected %d to %d", path, columns,
                          LEAST_COLUMNS, MOST_COLUMNS);
    if (list->count < 2)
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: %zu sections, expected two or more", path,
                          list->count);
    qsort(list->section, list->count, sizeof *list->section, by_place);
    for (size_t k = 0; k < list->count; k++) {
        section *s = &list->section[k];
        drop_repeated(s);
        if (s->count < 2)
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: a section of one point", path, s->line);
        if (k > 0 && s->x == s[-1].x)
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: the station at x = %g is there twice",
                              path, s->line, s->x);
    }
    double share = knuckle_share(list),
           *points = malloc(3 * list->count * columns * sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu sections", path, list->count);
    *chine = share > 0 ? (size_t)fmin(fmax(round(share * (double)(columns - 1)), 1),
                                      (double)(columns - 2))
                       : 0;
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < list->count && status == NURBS_OK; k++)
        status = sample_section(&list->section[k], columns, *chine, points + 3 * k * columns);
    if (status == NURBS_OK)
        status = nurbs_grid_create(list->count, columns, points, grid);
    free(points);
    return status;
}
