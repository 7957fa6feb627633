/* Points of many sections: corners that go from section to section become columns of their own. */
#include "core/error.h"
#include "lines/lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of a section's length: how far a corner may move to the next section, at once and for every
 * extent between the two: facets of a tight bend have corners that jump from one to the next. */
static const double follows = 0.06, at_once = 0.005, by_place = 3;
/* Of the sections, and of the extent: how many must have a corner that becomes a column, and how
 * far it must go; sections crowd where the hull is difficult. */
static const double common = 0.08, goes = 0.03;

enum { MOST_TRACKS = 64, LEAST_BAND = 3 };

/* A corner from section `first` to `last`, at share[n]. */
typedef struct track {
    size_t first, last, count;
    double *share;
} track;

typedef struct tracks {
    size_t n;
    track track[MOST_TRACKS];
} tracks;

static void tracks_free(tracks *t)
{
    for (size_t k = 0; k < t->n; k++)
        free(t->track[k].share);
}

/* Takes the corner into a track that ends at one of the last two sections nearby, or begins one. */
static nurbs_status follow(tracks *t, size_t sections, const line *const *lines, size_t i,
                           double share)
{
    track *best = NULL;
    double extent = lines[sections - 1]->place - lines[0]->place;
    for (size_t k = 0; k < t->n; k++) {
        track *one = &t->track[k];
        double away = fabs(one->share[one->last] - share),
               gap = (lines[i]->place - lines[one->last]->place) / extent;
        if (one->last + 3 < i || one->last >= i || away > fmin(follows, at_once + by_place * gap) ||
            (best && away >= fabs(best->share[best->last] - share)))
            continue;
        best = one;
    }
    if (!best) {
        if (t->n == MOST_TRACKS)
            return NURBS_OK;
        double *room = malloc(sections * sizeof *room);
        if (!room)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the corners of %zu sections",
                              sections);
        best = &t->track[t->n++];
        *best = (track){.first = i, .last = i, .share = room};
    }
    for (size_t k = best->last + 1; k < i; k++)
        best->share[k] = best->share[best->last] + (share - best->share[best->last]) *
                                                       (double)(k - best->last) /
                                                       (double)(i - best->last);
    best->last = i;
    best->share[i] = share;
    best->count++;
    return NURBS_OK;
}

static int by_count(const void *a, const void *b)
{
    size_t x = ((const track *)a)->count, y = ((const track *)b)->count;
    return (x < y) - (x > y);
}

static double mean_share(const track *t, size_t n)
{
    double sum = 0;
    for (size_t k = 0; k < n; k++)
        sum += t->share[k];
    return sum / (double)n;
}

/* Shares of all sections: those of the ends go on. */
static void extend(track *t, size_t n)
{
    for (size_t k = 0; k < t->first; k++)
        t->share[k] = t->share[t->first];
    for (size_t k = t->last + 1; k < n; k++)
        t->share[k] = t->share[t->last];
}

/* Whether two tracks keep apart, in one order. */
static bool keeps_apart(const track *a, const track *b, size_t n)
{
    static const double apart = 0.02;
    bool above = a->share[0] < b->share[0];
    for (size_t k = 0; k < n; k++)
        if (above ? b->share[k] - a->share[k] < apart : a->share[k] - b->share[k] < apart)
            return false;
    return true;
}

/* Ends that are open above and closed below turn there: a column goes to it, from end to end. */
static nurbs_status follow_closing(tracks *t, size_t n, const line *const *lines)
{
    double aft = lines[0]->closing, fore = lines[n - 1]->closing;
    if (!(aft > 0 || fore > 0) || t->n == MOST_TRACKS)
        return NURBS_OK;
    double *share = malloc(n * sizeof *share);
    if (!share)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the corners of %zu sections", n);
    aft = aft > 0 ? aft : fore;
    fore = fore > 0 ? fore : aft;
    for (size_t k = 0; k < n; k++)
        share[k] = aft + (fore - aft) * (lines[k]->place - lines[0]->place) /
                             (lines[n - 1]->place - lines[0]->place);
    t->track[t->n++] = (track){.last = n - 1, .count = n, .share = share};
    return NURBS_OK;
}

/* The longest tracks that keep apart, from the deck down, to the front. */
static void choose(tracks *t, size_t n, const line *const *lines, size_t *chosen)
{
    *chosen = 0;
    qsort(t->track, t->n, sizeof *t->track, by_count);
    for (size_t k = 0; k < t->n && *chosen < NURBS_SECTIONS_CORNERS; k++) {
        double length = lines[t->track[k].last]->place - lines[t->track[k].first]->place,
               extent = lines[n - 1]->place - lines[0]->place;
        bool good =
            (double)t->track[k].count >= fmax(3, common * (double)n) && length >= goes * extent;
        extend(&t->track[k], n);
        for (size_t i = 0; i < *chosen && good; i++)
            good = keeps_apart(&t->track[k], &t->track[i], n);
        if (!good)
            continue;
        track swapped = t->track[*chosen];
        t->track[*chosen] = t->track[k];
        t->track[k] = swapped;
        ++*chosen;
    }
    for (size_t a = 1; a < *chosen; a++)
        for (size_t b = a; b > 0 && t->track[b].share[0] < t->track[b - 1].share[0]; b--) {
            track swapped = t->track[b];
            t->track[b] = t->track[b - 1];
            t->track[b - 1] = swapped;
        }
}

static void point_at(const line *l, double share, double out[3])
{
    double at = fmin(fmax(share, 0), 1) * l->along[l->n - 1];
    size_t low = 0, high = l->n - 1;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        *(l->along[middle] <= at ? &low : &high) = middle;
    }
    double length = l->along[high] - l->along[low],
           t = length > 0 ? (at - l->along[low]) / length : 0;
    for (int c = 0; c < 3; c++)
        out[c] = (1 - t) * l->points[3 * low + (size_t)c] + t * l->points[3 * high + (size_t)c];
}

/* Columns of the corners: bands as wide as they are long. */
static void place_columns(const tracks *t, size_t chosen, size_t n, size_t columns,
                          size_t column[NURBS_SECTIONS_CORNERS + 2])
{
    column[0] = 0;
    for (size_t k = 0; k < chosen; k++) {
        double wanted = round(mean_share(&t->track[k], n) * (double)(columns - 1));
        double least = (double)(column[k] + LEAST_BAND),
               most = (double)(columns - 1 - LEAST_BAND * (chosen - k));
        column[k + 1] = (size_t)fmax(fmin(wanted, most), least);
    }
    column[chosen + 1] = columns - 1;
}

static void sample(const line *l, const tracks *t, size_t chosen, size_t section,
                   const size_t column[NURBS_SECTIONS_CORNERS + 2], double *out)
{
    for (size_t band = 0; band <= chosen; band++) {
        double from = band ? t->track[band - 1].share[section] : 0,
               to = band < chosen ? t->track[band].share[section] : 1;
        for (size_t j = column[band]; j <= column[band + 1]; j++) {
            double part = (double)(j - column[band]) / (double)(column[band + 1] - column[band]);
            point_at(l, (1 - part) * from + part * to, out + 3 * j);
        }
    }
}

nurbs_status lines_grid(size_t n, const line *const *lines, size_t columns, nurbs_grid **grid,
                        size_t *corners, size_t corner[NURBS_SECTIONS_CORNERS])
{
    tracks t = {0};
    size_t chosen = 0, column[NURBS_SECTIONS_CORNERS + 2];
    nurbs_status status = NURBS_OK;
    *grid = NULL;
    for (size_t i = 0; i < n && !status; i++)
        for (size_t k = 0; k < lines[i]->corners && !status; k++)
            status = follow(&t, n, lines, i, lines[i]->corner[k]);
    if (!status)
        status = follow_closing(&t, n, lines);
    if (!status)
        choose(&t, n, lines, &chosen);
    double *points = malloc(3 * n * columns * sizeof *points);
    if (!status && !points)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu sections", n);
    if (!status) {
        place_columns(&t, chosen, n, columns, column);
        for (size_t i = 0; i < n; i++)
            sample(lines[i], &t, chosen, i, column, points + 3 * i * columns);
        status = nurbs_grid_create(n, columns, points, grid);
    }
    *corners = chosen;
    for (size_t k = 0; k < chosen && !status; k++)
        corner[k] = column[k + 1];
    free(points);
    tracks_free(&t);
    return status;
}
