/* One section: the pieces in which a sheet meets the mesh, put in order from keel to deck. */
#include "core/error.h"
#include "core/vector.h"
#include "lines/lines.h"
#include "mesh/mesh.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Of the extent: points this near are one; pieces join over the second, and along the centre plane
 * over the third; a keel lies within the fourth of it. */
static const double same = 1e-7, join = 2e-3, bridge = 0.06, centre = 2e-4;

enum { BRIDGE_PARTS = 32 };

/* A deck runs inboard, flatter than this slope, over this share of the half breadth. */
static const double deck_slope = 0.35, deck_share = 0.05;

/* Pieces: ranges of points. */
typedef struct pieces {
    size_t n, used, room;
    size_t (*range)[2];
    bool *taken;
    double *points;
} pieces;

static void pieces_free(pieces *p)
{
    free(p->range);
    free(p->taken);
    free(p->points);
}

void line_free(line *l)
{
    free(l->points);
    free(l->along);
    *l = (line){0};
}

static void add_point(pieces *p, const double point[3])
{
    memcpy(p->points + 3 * p->used++, point, 3 * sizeof *point);
}

static void close_piece(pieces *p, size_t first)
{
    if (p->used >= first + 2) {
        p->range[p->n][0] = first;
        p->range[p->n++][1] = p->used - 1;
    } else
        p->used = first;
}

/* What of a line lies at y >= 0. */
static void add_port_part(pieces *p, size_t n, const double *points)
{
    size_t first = p->used;
    for (size_t k = 0; k < n; k++) {
        const double *here = points + 3 * k, *before = here - 3;
        if (k > 0 && (here[1] < 0) != (before[1] < 0)) {
            double t = before[1] / (before[1] - here[1]), crossing[3];
            for (int c = 0; c < 3; c++)
                crossing[c] = before[c] + t * (here[c] - before[c]);
            crossing[1] = 0;
            add_point(p, crossing);
            if (here[1] < 0) {
                close_piece(p, first);
                first = p->used;
            }
        }
        if (here[1] >= 0)
            add_point(p, here);
    }
    close_piece(p, first);
}

static nurbs_status collect(const nurbs_contour *contour, pieces *p)
{
    size_t points = contour->first[contour->lines];
    /* A line gives at most one piece for every two crossings of y = 0. */
    *p = (pieces){.range = malloc((points + contour->lines + 1) * sizeof *p->range),
                  .taken = calloc(points + contour->lines + 1, sizeof *p->taken),
                  .points = malloc((6 * points + 3) * sizeof *p->points)};
    if (!p->range || !p->taken || !p->points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section of %zu points", points);
    for (size_t k = 0; k < contour->lines; k++)
        add_port_part(p, contour->first[k + 1] - contour->first[k],
                      contour->points + 3 * contour->first[k]);
    return NURBS_OK;
}

static double piece_length(const pieces *p, size_t k)
{
    double length = 0;
    for (size_t i = p->range[k][0]; i < p->range[k][1]; i++)
        length += distance3(p->points + 3 * i, p->points + 3 * i + 3);
    return length;
}

/* Faces in the centre plane are no hull. */
static void drop_centre_plane(pieces *p, double near)
{
    for (size_t k = 0; k < p->n; k++) {
        double widest = 0;
        for (size_t i = p->range[k][0]; i <= p->range[k][1]; i++)
            widest = fmax(widest, p->points[3 * i + 1]);
        p->taken[k] = widest <= near;
    }
}

/* The end of a free piece that `better` likes most; its point's index, or SIZE_MAX. */
static size_t find_keel(const pieces *p, double near)
{
    size_t best = SIZE_MAX;
    for (size_t k = 0; k < p->n; k++)
        for (int e = 0; e < 2 && !p->taken[k]; e++) {
            const double *q = p->points + 3 * p->range[k][e];
            if (q[1] <= near && (best == SIZE_MAX || q[2] < p->points[3 * best + 2]))
                best = p->range[k][e];
        }
    return best;
}

static size_t find_next(const pieces *p, const double end[3], double extent)
{
    size_t best = SIZE_MAX;
    double nearest = INFINITY;
    for (size_t k = 0; k < p->n; k++)
        for (int e = 0; e < 2 && !p->taken[k]; e++) {
            const double *q = p->points + 3 * p->range[k][e];
            double away = distance3(q, end);
            bool along_centre = q[1] <= centre * extent && end[1] <= centre * extent;
            if (away <= (along_centre ? bridge : join) * extent && away < nearest) {
                nearest = away;
                best = p->range[k][e];
            }
        }
    return best;
}

/* Appends the piece that holds the end point `at`, from there on. */
static void append(pieces *p, size_t at, double near, line *l)
{
    size_t k = 0;
    while (p->range[k][0] != at && p->range[k][1] != at)
        k++;
    p->taken[k] = true;
    bool forward = p->range[k][0] == at;
    size_t n = p->range[k][1] - p->range[k][0] + 1;
    for (size_t i = 0; i < n; i++) {
        const double *q = p->points + 3 * (forward ? at + i : at - i);
        if (l->n == 0 || distance3(q, l->points + 3 * (l->n - 1)) > near)
            memcpy(l->points + 3 * l->n++, q, 3 * sizeof *q);
    }
}

/* Along the centre plane the sheet goes on to the next piece, on an end its outline. */
static void follow_sheet(const sheets *s, double place, const double to[3], line *l)
{
    double from[3], away = distance3(l->points + 3 * (l->n - 1), to);
    memcpy(from, l->points + 3 * (l->n - 1), sizeof from);
    for (int k = 1; k < BRIDGE_PARTS && away > join * s->extent; k++) {
        double t = (double)k / BRIDGE_PARTS, z = from[2] + t * (to[2] - from[2]),
               *q = l->points + 3 * l->n++;
        q[0] = sheets_x(s, place, z);
        q[1] = from[1] + t * (to[1] - from[1]);
        q[2] = z;
    }
}

/* A line from keel to deck may end with a deck: from the side inboard, and flat. */
static void leave_out_deck(line *l, double kink_angle)
{
    double widest = 0;
    size_t last = l->n - 1;
    for (size_t k = 0; k < l->n; k++)
        widest = fmax(widest, l->points[3 * k + 1]);
    while (last > 1) {
        const double *a = l->points + 3 * (last - 1), *b = a + 3;
        if (!(b[1] < a[1] && fabs(b[2] - a[2]) <= deck_slope * (a[1] - b[1])))
            break;
        last--;
    }
    const double *edge = l->points + 3 * last, *end = l->points + 3 * (l->n - 1);
    if (last + 1 == l->n || edge[1] - end[1] < deck_share * widest)
        return;
    double before[3], after[3];
    minus3(edge, edge - 3, before);
    minus3(edge + 3, edge, after);
    unit3(before);
    unit3(after);
    if (acos(fmin(fmax(dot3(before, after), -1), 1)) > kink_angle)
        l->n = last + 1;
}

static void turn(line *l)
{
    for (size_t a = 0, b = l->n - 1; a < b; a++, b--) {
        double swapped[3];
        memcpy(swapped, l->points + 3 * a, sizeof swapped);
        memcpy(l->points + 3 * a, l->points + 3 * b, sizeof swapped);
        memcpy(l->points + 3 * b, swapped, sizeof swapped);
    }
}

static nurbs_status order(pieces *p, const sheets *s, double place, line *l, double *left_out)
{
    drop_centre_plane(p, same * s->extent);
    size_t at = find_keel(p, centre * s->extent);
    if (at == SIZE_MAX)
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "the section at x = %.6g m has no end at the keel in the centre plane: "
                          "expected a hull that reaches it",
                          place);
    size_t room = p->used + BRIDGE_PARTS * p->n;
    l->points = malloc((3 * room + 3) * sizeof *l->points);
    l->along = malloc((room + 1) * sizeof *l->along);
    if (!l->points || !l->along)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section of %zu points", p->used);
    while (at != SIZE_MAX) {
        append(p, at, same * s->extent, l);
        at = find_next(p, l->points + 3 * (l->n - 1), s->extent);
        if (at != SIZE_MAX)
            follow_sheet(s, place, p->points + 3 * at, l);
    }
    double length = 0, beside = 0;
    for (size_t k = 0; k < p->n; k++)
        *(p->taken[k] ? &length : &beside) += piece_length(p, k);
    if (beside > length)
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "the section at x = %.6g m is in pieces that do not join: %.3g m of it "
                          "hold together, %.3g m lie apart, from (%.6g, %.6g, %.6g) on",
                          place, length, beside, l->points[3 * l->n - 3], l->points[3 * l->n - 2],
                          l->points[3 * l->n - 1]);
    *left_out = fmax(*left_out, beside);
    return NURBS_OK;
}

nurbs_status line_trace(const nurbs_mesh *mesh, const sheets *s, double place, double kink_angle,
                        line *l, double *left_out)
{
    nurbs_contour contour = {0};
    pieces p = {0};
    *l = (line){.place = place};
    double *height = malloc((mesh->vertices + 1) * sizeof *height);
    if (!height)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu heights", mesh->vertices);
    for (size_t k = 0; k < mesh->vertices; k++)
        height[k] = mesh->points[3 * k] - sheets_x(s, place, mesh->points[3 * k + 2]);
    nurbs_status status = mesh_section_at(mesh, height, &contour);
    free(height);
    if (!status)
        status = collect(&contour, &p);
    if (!status)
        status = order(&p, s, place, l, left_out);
    nurbs_contour_free(&contour);
    pieces_free(&p);
    if (!status && l->n < 2)
        status = nurbs_fail(NURBS_ERROR_GEOMETRY, "the section at x = %.6g m is a point", place);
    if (status)
        return status;
    leave_out_deck(l, kink_angle);
    if (l->points[1] <= centre * s->extent)
        l->points[1] = 0;
    turn(l);
    return line_finish(l, kink_angle);
}

nurbs_status line_outline(const sheets *s, int end, double deck, double keel, const line *near,
                          line *l)
{
    size_t n = near->n;
    double z0 = near->points[2], z1 = near->points[3 * n - 1];
    *l = (line){.place = s->tip[end],
                .n = n,
                .points = malloc(3 * n * sizeof(double)),
                .along = malloc(n * sizeof(double))};
    if (!l->points || !l->along)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for an outline");
    for (size_t k = 0; k < n; k++) {
        double z = deck + (near->points[3 * k + 2] - z0) * (keel - deck) / (z1 - z0);
        l->points[3 * k] = sheets_outline(s, end, z);
        l->points[3 * k + 1] = 0;
        l->points[3 * k + 2] = z;
        l->along[k] = near->along[k];
    }
    l->corners = near->corners;
    memcpy(l->corner, near->corner, sizeof l->corner);
    return NURBS_OK;
}

/* The next point at least so far away, forward or back. */
static size_t neighbour(const line *l, size_t k, bool forward, double least)
{
    size_t i = k;
    while (forward ? i + 1 < l->n && l->along[i] - l->along[k] < least
                   : i > 0 && l->along[k] - l->along[i] < least)
        i += forward ? 1 : (size_t)-1;
    return i;
}

/* Direction over at least `least` of length from point k, forward or back. */
static bool direction(const line *l, size_t k, bool forward, double least, double d[3])
{
    size_t i = neighbour(l, k, forward, least);
    for (size_t c = 0; c < 3; c++)
        d[c] = forward ? l->points[3 * i + c] - l->points[3 * k + c]
                       : l->points[3 * k + c] - l->points[3 * i + c];
    return unit3(d) > 0;
}

/* By how much the line turns at point k; 0 at its ends. */
static double turn_at(const line *l, size_t k, double least)
{
    double before[3], after[3];
    if (k == 0 || k + 1 >= l->n || !direction(l, k, false, least, before) ||
        !direction(l, k, true, least, after))
        return 0;
    return acos(fmin(fmax(dot3(before, after), -1), 1));
}

nurbs_status line_finish(line *l, double kink_angle)
{
    /* Of the length: shorter pieces have no direction; corners are that far apart and from the ends
     */
    static const double least = 1e-3, apart = 0.02;
    /* A tight bend in a few facets turns at each of them, a corner at one point alone. */
    static const double alone = 2.5;
    double best[NURBS_SECTIONS_CORNERS] = {0}, total;
    l->along[0] = 0;
    for (size_t k = 1; k < l->n; k++)
        l->along[k] = l->along[k - 1] + distance3(l->points + 3 * k - 3, l->points + 3 * k);
    total = l->along[l->n - 1];
    l->corners = 0;
    for (size_t k = 1; k + 1 < l->n; k++) {
        double share = l->along[k] / total, step = least * total;
        double angle = share < apart || share > 1 - apart ? 0 : turn_at(l, k, step);
        if (!(angle > kink_angle) ||
            angle < alone * fmax(turn_at(l, neighbour(l, k, false, step), step),
                                 turn_at(l, neighbour(l, k, true, step), step)))
            continue;
        size_t last = l->corners ? l->corners - 1 : 0;
        if (l->corners && share - l->corner[last] < apart) {
            if (angle > best[last]) {
                l->corner[last] = share;
                best[last] = angle;
            }
        } else if (l->corners < NURBS_SECTIONS_CORNERS) {
            best[l->corners] = angle;
            l->corner[l->corners++] = share;
        }
    }
    return NURBS_OK;
}
