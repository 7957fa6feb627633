/* Loops with any number of corners, and holes, divided into four-sided loops. */
#include "core/constants.h"
#include "core/error.h"
#include "core/vector.h"
#include "io/trim_loop.h"

#include <nurbs/trim.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 12, MOST_CORNERS = 10, MOST_DEPTH = 12, MOST_TRIES = 3, GRID = 12 };

/* Smallest cell of the Coons map over the mean one: below, the loop is divided instead. A right
 * angle that opens to a straight one leaves about 0.08 on this grid. */
static const double least_quality = 0.02;

/* A side may bend by no more at one place (radians): about a sharper corner inside a side the map
 * folds in a stretch that a grid easily misses. */
static const double most_bend = 1.05;

/* Hollow places are those at which a loop wants to be divided: a chord from one counts as shorter
 * by this factor. */
static const double reflex_favour = 0.5;

/* A chord leaves the loop's edges by at least this angle (radians). */
static const double least_angle = 0.2;

typedef struct division {
    const nurbs_surface *surface;
    double tolerance, deviation;
    nurbs_patches *patches;
} division;

static nurbs_status insert_part(trim_loop *loop, size_t at, loop_part part)
{
    if (loop->count == loop->room) {
        size_t room = loop->room ? 2 * loop->room : 16;
        loop_part *larger = realloc(loop->part, room * sizeof *larger);
        if (!larger)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a loop of %zu curves",
                              loop->count);
        loop->part = larger;
        loop->room = room;
    }
    memmove(loop->part + at + 1, loop->part + at, (loop->count - at) * sizeof part);
    loop->part[at] = part;
    loop->count++;
    return NURBS_OK;
}

/* Divides part k at x, so that a joint lies behind part k. */
static nurbs_status divide_part(trim_loop *loop, size_t k, double x)
{
    loop_part first = loop->part[k], second = first;
    first.to = second.from = first.from + x * (first.to - first.from);
    for (int d = 0; d < 2; d++)
        first.shift[1][d] = second.shift[0][d] =
            (1 - x) * loop->part[k].shift[0][d] + x * loop->part[k].shift[1][d];
    first.length *= x;
    second.length *= 1 - x;
    first.turn = 0;
    loop->part[k] = first;
    return insert_part(loop, k + 1, second);
}

static loop_part straight(const double from[2], const double to[2])
{
    return (loop_part){.shift = {{from[0], from[1]}, {to[0], to[1]}}};
}

static void joint(const trim_loop *loop, size_t k, double uv[2])
{
    trim_loop_point(&loop->part[k], 1, uv, NULL);
}

/* Puts a corner in the middle of the longest stretch between corners. */
static nurbs_status add_corner(trim_loop *loop, bool *corner, size_t room)
{
    double best = -1, total, half;
    size_t start = 0, n = loop->count, any = n;
    for (size_t k = 0; k < n; k++)
        if (corner[k])
            any = k;
    size_t origin = any == n ? n - 1 : any, from = origin;
    for (size_t i = 1; i <= n; i++) {
        size_t k = (origin + i) % n;
        if (!corner[k] && i < n)
            continue;
        total = 0;
        for (size_t j = (from + 1) % n;; j = (j + 1) % n) {
            total += loop->part[j].length;
            if (j == k)
                break;
        }
        if (total > best) {
            best = total;
            start = from;
        }
        from = k;
    }
    half = 0.5 * best;
    size_t k = (start + 1) % n;
    while (half > loop->part[k].length * (1 - 1e-6)) {
        half -= loop->part[k].length;
        if (half < 1e-6 * best) {
            corner[k] = true;
            return NURBS_OK;
        }
        k = (k + 1) % n;
    }
    if (n + 1 >= room)
        return nurbs_fail(NURBS_ERROR_NUMERIC, "a loop of %zu curves", n);
    nurbs_status status = divide_part(loop, k, half / loop->part[k].length);
    memmove(corner + k + 1, corner + k, (n - k) * sizeof *corner);
    corner[k] = true;
    if (any == n && status == NURBS_OK)
        corner[loop->count - 1] = true;
    return status;
}

static void coons(const trim_loop *loop, double s, double t, double uv[2])
{
    double side[4][2], corner[4][2];
    for (int k = 0; k < 4; k++) {
        double at = k == 0 ? s : k == 1 ? t : k == 2 ? 1 - s : 1 - t;
        trim_loop_side(loop, &loop->side[k], at, side[k]);
        memcpy(corner[k], loop->side[k].start, sizeof corner[k]);
    }
    for (int d = 0; d < 2; d++)
        uv[d] = (1 - t) * side[0][d] + t * side[2][d] + (1 - s) * side[3][d] + s * side[1][d] -
                (1 - s) * ((1 - t) * corner[0][d] + t * corner[3][d]) -
                s * ((1 - t) * corner[1][d] + t * corner[2][d]);
}

static double cell_turn(const double a[2], const double b[2], const double c[2])
{
    return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

/* Smallest signed triangle at a corner of a cell over the mean cell; negative where the map folds.
 * At the corners of the map itself the cell as a whole counts: there an angle may be straight. */
static double quality(const trim_loop *loop)
{
    double uv[GRID + 1][GRID + 1][2], least = INFINITY, sum = 0;
    for (int i = 0; i <= GRID; i++)
        for (int j = 0; j <= GRID; j++)
            coons(loop, (double)i / GRID, (double)j / GRID, uv[i][j]);
    for (int i = 0; i < GRID; i++)
        for (int j = 0; j < GRID; j++) {
            const double *a = uv[i][j], *b = uv[i + 1][j], *c = uv[i + 1][j + 1], *d = uv[i][j + 1];
            double area = cell_turn(a, b, c) + cell_turn(a, c, d);
            sum += area;
            if ((i == 0 || i == GRID - 1) && (j == 0 || j == GRID - 1)) {
                least = fmin(least, 0.5 * area);
                continue;
            }
            least = fmin(least, fmin(fmin(cell_turn(a, b, d), cell_turn(b, c, a)),
                                     fmin(cell_turn(c, d, b), cell_turn(d, a, c))));
        }
    return sum > 0 ? 2 * least * GRID * GRID / sum : -1;
}

typedef struct choice {
    size_t corner[4];
    double quality;
} choice;

/* Whether every sharp corner is one of the four. */
static bool takes_sharp_corners(const trim_loop *loop, const size_t corner[4])
{
    for (size_t k = 0; k < loop->count; k++)
        if (fabs(loop->part[k].turn) > most_bend && k != corner[0] && k != corner[1] &&
            k != corner[2] && k != corner[3])
            return false;
    return true;
}

static void keep_choice(trim_loop *loop, const size_t corner[4], choice best[MOST_TRIES])
{
    choice c = {.quality = -1};
    memcpy(c.corner, corner, sizeof c.corner);
    if (takes_sharp_corners(loop, corner) && trim_loop_sides(loop, corner) == NURBS_OK)
        c.quality = quality(loop);
    for (int k = 0; k < MOST_TRIES; k++)
        if (c.quality > best[k].quality) {
            choice worse = best[k];
            best[k] = c;
            c = worse;
        }
}

static void rank_corners(trim_loop *loop, size_t n, const size_t *corner, choice best[MOST_TRIES])
{
    for (size_t a = 0; a < n; a++)
        for (size_t b = a + 1; b < n; b++)
            for (size_t c = b + 1; c < n; c++)
                for (size_t d = c + 1; d < n; d++) {
                    const size_t four[4] = {corner[a], corner[b], corner[c], corner[d]};
                    keep_choice(loop, four, best);
                }
}

/* Takes the loop as one four-sided patch if some choice of corners allows; *done tells. */
static nurbs_status take_whole(division *work, trim_loop *loop, bool *done)
{
    enum { ROOM = 256 };
    bool corner[ROOM] = {false};
    size_t list[ROOM], n = 0;
    choice best[MOST_TRIES];
    nurbs_status status = NURBS_OK;
    *done = false;
    if (loop->count + 8 >= ROOM)
        return nurbs_fail(NURBS_ERROR_NUMERIC, "its loop has %zu parts", loop->count);
    for (int k = 0; k < MOST_TRIES; k++)
        best[k] = (choice){.quality = least_quality};
    for (size_t k = 0; k < loop->count; k++) {
        /* A map folds at a corner of more than a straight angle: those stay inside a side. */
        corner[k] = trim_loop_turns(&loop->part[k]) && loop->part[k].turn > 0;
        n += corner[k];
    }
    if (n > MOST_CORNERS)
        return NURBS_OK;
    for (; n < 4 && status == NURBS_OK; n++)
        status = add_corner(loop, corner, ROOM);
    if (status != NURBS_OK)
        return status;
    n = 0;
    for (size_t k = 0; k < loop->count; k++)
        if (corner[k])
            list[n++] = k;
    rank_corners(loop, n, list, best);
    for (int k = 0; k < MOST_TRIES && best[k].quality > least_quality && !*done; k++) {
        nurbs_surface *patch = NULL;
        double deviation = 0;
        status = trim_loop_sides(loop, best[k].corner);
        if (status == NURBS_OK)
            status = untrim_sides(loop, work->tolerance, &patch, &deviation);
        if (status == NURBS_OK) {
            status = nurbs_patches_add(work->patches, patch);
            work->deviation = fmax(work->deviation, deviation);
            *done = true;
        } else if (status == NURBS_ERROR_GEOMETRY || status == NURBS_ERROR_NUMERIC) {
            status = NURBS_OK;
        }
        nurbs_surface_free(patch);
    }
    return status;
}

/* The loop as a polygon in metres: SAMPLES places a part, the first of each its start. */
static double *polygon(const trim_loop *loop)
{
    double *xy = malloc(2 * (loop->count * SAMPLES + 1) * sizeof *xy);
    for (size_t i = 0; xy && i < loop->count * SAMPLES; i++) {
        trim_loop_point(&loop->part[i / SAMPLES], (double)(i % SAMPLES) / SAMPLES, xy + 2 * i,
                        NULL);
        for (int d = 0; d < 2; d++)
            xy[2 * i + (size_t)d] *= loop->stretch[d];
    }
    return xy;
}

static double side_of(const double a[2], const double b[2], const double p[2])
{
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/* Whether the chord between vertices i and j of the polygon meets one of its other edges. */
static bool crosses(size_t n, const double *xy, size_t i, size_t j)
{
    const double *a = xy + 2 * i, *b = xy + 2 * j;
    for (size_t k = 0; k < n; k++) {
        size_t next = (k + 1) % n;
        if (k == i || k == j || next == i || next == j)
            continue;
        const double *p = xy + 2 * k, *q = xy + 2 * next;
        if (side_of(a, b, p) * side_of(a, b, q) <= 0 && side_of(p, q, a) * side_of(p, q, b) <= 0)
            return true;
    }
    return false;
}

/* Angle from direction (a -> b) to (a -> c), counterclockwise, 0 to a turn. */
static double angle_between(const double a[2], const double b[2], const double c[2])
{
    const double turn = 2 * PI;
    double angle = atan2(c[1] - a[1], c[0] - a[0]) - atan2(b[1] - a[1], b[0] - a[0]);
    return angle < 0 ? angle + turn : angle;
}

/* Whether a chord from vertex i to j leaves into the inside of a counterclockwise polygon, well
 * away from both edges there. */
static bool leaves_inside(size_t n, const double *xy, size_t i, size_t j)
{
    const double *a = xy + 2 * i, *next = xy + 2 * ((i + 1) % n),
                 *before = xy + 2 * ((i + n - 1) % n);
    double inside = angle_between(a, next, before), chord = angle_between(a, next, xy + 2 * j),
           least = fmin(least_angle, 0.25 * inside);
    return chord > least && chord < inside - least;
}

/* Twice the area between the polygon from vertex i on to j and the chord back. */
static double area_cut(size_t n, const double *xy, size_t i, size_t j)
{
    double area = 0;
    for (size_t k = i; k != j; k = (k + 1) % n) {
        const double *a = xy + 2 * k, *b = xy + 2 * ((k + 1) % n);
        area += a[0] * b[1] - b[0] * a[1];
    }
    return area + xy[2 * j] * xy[2 * i + 1] - xy[2 * i] * xy[2 * j + 1];
}

/* Whether the polygon bends away from the inside about vertex i: a reflex corner, or the middle of
 * a hollow curve. */
static bool hollow(size_t n, const double *xy, size_t i)
{
    const double *a = xy + 2 * i, *next = xy + 2 * ((i + SAMPLES / 2) % n),
                 *before = xy + 2 * ((i + n - SAMPLES / 2) % n);
    return angle_between(a, next, before) > PI + least_angle;
}

/* The chord that divides best, joints behind parts i and j: short for the area it divides, so that
 * it cuts no corners off. */
static bool find_chord(const trim_loop *loop, const double *xy, size_t *i, size_t *j)
{
    size_t n = loop->count * SAMPLES;
    double best = INFINITY;
    for (size_t a = 0; a < loop->count; a++)
        for (size_t b = a + 1; b < loop->count; b++) {
            size_t p = (a + 1) % loop->count * SAMPLES, q = (b + 1) % loop->count * SAMPLES;
            double length = hypot(xy[2 * p] - xy[2 * q], xy[2 * p + 1] - xy[2 * q + 1]),
                   area = fmin(area_cut(n, xy, p, q), area_cut(n, xy, q, p));
            if (!(area > 0 && length > 0))
                continue;
            double score = length / sqrt(area) * (hollow(n, xy, p) ? reflex_favour : 1) *
                           (hollow(n, xy, q) ? reflex_favour : 1);
            if (score >= best || !leaves_inside(n, xy, p, q) || !leaves_inside(n, xy, q, p) ||
                crosses(n, xy, p, q))
                continue;
            best = score;
            *i = a;
            *j = b;
        }
    return isfinite(best);
}

/* The parts behind `first` up to `last`, closed by a straight line. */
static nurbs_status cut_off(const trim_loop *loop, size_t first, size_t last, trim_loop *piece)
{
    double from[2], to[2];
    nurbs_status status = NURBS_OK;
    *piece = *loop;
    piece->part = NULL;
    piece->count = piece->room = 0;
    memset(piece->side, 0, sizeof piece->side);
    for (size_t k = (first + 1) % loop->count; status == NURBS_OK; k = (k + 1) % loop->count) {
        status = insert_part(piece, piece->count, loop->part[k]);
        if (k == last)
            break;
    }
    joint(loop, last, from);
    joint(loop, first, to);
    if (status == NURBS_OK)
        status = insert_part(piece, piece->count, straight(from, to));
    if (status == NURBS_OK) {
        trim_loop_measure(piece);
        trim_loop_find_turns(piece);
    }
    return status;
}

static nurbs_status divide(division *work, trim_loop *loop, int depth)
{
    bool done;
    nurbs_status status = take_whole(work, loop, &done);
    if (status != NURBS_OK || done)
        return status;
    if (depth == MOST_DEPTH)
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "its loop could not be divided into four-sided "
                                                "pieces");
    /* Joints halfway along every part give chords something to end at. */
    for (size_t k = 0; k < loop->count && loop->count < 48 && status == NURBS_OK; k++)
        if (depth < 3 || loop->count < 8) {
            status = divide_part(loop, k, 0.5);
            k++;
        }
    size_t i = 0, j = 0;
    double *xy = status == NURBS_OK ? polygon(loop) : NULL;
    if (status == NURBS_OK && !xy)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a loop of %zu curves", loop->count);
    if (status == NURBS_OK && !find_chord(loop, xy, &i, &j))
        status = nurbs_fail(NURBS_ERROR_GEOMETRY, "its loop crosses itself, or has no inside");
    free(xy);
    trim_loop piece[2] = {{0}, {0}};
    if (status == NURBS_OK)
        status = cut_off(loop, i, j, &piece[0]);
    if (status == NURBS_OK)
        status = cut_off(loop, j, i, &piece[1]);
    for (int k = 0; k < 2 && status == NURBS_OK; k++)
        status = divide(work, &piece[k], depth + 1);
    trim_loop_free(&piece[0]);
    trim_loop_free(&piece[1]);
    return status;
}

/* Nearest joints of the loop and a hole. */
static void nearest_joints(const trim_loop *loop, const trim_loop *hole, size_t *i, size_t *j)
{
    double best = INFINITY;
    for (size_t a = 0; a < loop->count; a++)
        for (size_t b = 0; b < hole->count; b++) {
            double p[2], q[2];
            joint(loop, a, p);
            joint(hole, b, q);
            double apart =
                hypot(loop->stretch[0] * (p[0] - q[0]), loop->stretch[1] * (p[1] - q[1]));
            if (apart < best) {
                best = apart;
                *i = a;
                *j = b;
            }
        }
}

/* Makes the hole a part of the loop, by a line to it and back. */
static nurbs_status bridge(trim_loop *loop, const trim_loop *hole)
{
    size_t i = 0, j = 0;
    double p[2], q[2];
    nearest_joints(loop, hole, &i, &j);
    joint(loop, i, p);
    joint(hole, j, q);
    size_t at = i + 1;
    nurbs_status status = insert_part(loop, at++, straight(p, q));
    for (size_t k = 1; k <= hole->count && status == NURBS_OK; k++)
        status = insert_part(loop, at++, hole->part[(j + k) % hole->count]);
    if (status == NURBS_OK)
        status = insert_part(loop, at, straight(q, p));
    return status;
}

/* A loop of one or two smooth parts gets more joints. */
static nurbs_status enough_joints(trim_loop *loop)
{
    nurbs_status status = NURBS_OK;
    while (loop->count < 4 && status == NURBS_OK) {
        size_t longest = 0;
        for (size_t k = 1; k < loop->count; k++)
            if (loop->part[k].length > loop->part[longest].length)
                longest = k;
        status = divide_part(loop, longest, 0.5);
    }
    return status;
}

/* The loop with the largest area first, the others turned to run clockwise and joined to it. */
static nurbs_status join_holes(size_t loops, trim_loop *loop)
{
    size_t outer = 0;
    double most = -INFINITY;
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < loops && status == NURBS_OK; k++) {
        double area = trim_loop_measure(&loop[k]);
        status = enough_joints(&loop[k]);
        if (area > most) {
            most = area;
            outer = k;
        }
    }
    trim_loop swapped = loop[0];
    loop[0] = loop[outer];
    loop[outer] = swapped;
    for (size_t k = 1; k < loops && status == NURBS_OK; k++) {
        trim_loop_reverse(&loop[k]);
        status = bridge(&loop[0], &loop[k]);
    }
    if (loops > 1 && status == NURBS_OK) {
        trim_loop_measure(&loop[0]);
        trim_loop_find_turns(&loop[0]);
    }
    return status;
}

static nurbs_status check(const nurbs_surface *surface, size_t loops, const size_t *count,
                          const nurbs_curve *const *const *loop, double tolerance,
                          const nurbs_patches *patches)
{
    if (!surface || loops == 0 || !count || !loop || !patches)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no surface, no loops or no patches");
    if (!(isfinite(tolerance) && tolerance > 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "tolerance %g, expected a length > 0", tolerance);
    for (size_t k = 0; k < loops; k++) {
        if (count[k] == 0 || !loop[k])
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "loop %zu has no curves", k);
        for (size_t i = 0; i < count[k]; i++)
            if (!loop[k][i])
                return nurbs_fail(NURBS_ERROR_ARGUMENT, "curve %zu of loop %zu is NULL", i, k);
    }
    return NURBS_OK;
}

nurbs_status nurbs_surface_untrim_parts(const nurbs_surface *surface, size_t loops,
                                        const size_t *count, const nurbs_curve *const *const *loop,
                                        double tolerance, nurbs_patches *patches, double *deviation)
{
    NURBS_NEED(surface && count && loop && patches);
    nurbs_status status = check(surface, loops, count, loop, tolerance, patches);
    if (status != NURBS_OK)
        return status;
    division work = {.surface = surface, .tolerance = tolerance};
    trim_loop *opened = calloc(loops, sizeof *opened);
    status = opened ? nurbs_patches_create(&work.patches)
                    : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu loops", loops);
    for (size_t k = 0; k < loops && status == NURBS_OK; k++)
        status = trim_loop_open(surface, count[k], loop[k], 0.25 * tolerance, &opened[k]);
    if (status == NURBS_OK)
        status = join_holes(loops, opened);
    if (status == NURBS_OK)
        status = divide(&work, &opened[0], 0);
    for (size_t k = 0; status == NURBS_OK && k < nurbs_patches_count(work.patches); k++)
        status = nurbs_patches_add(patches, nurbs_patches_get(work.patches, k));
    if (status == NURBS_OK && deviation)
        *deviation = work.deviation;
    for (size_t k = 0; opened && k < loops; k++)
        trim_loop_free(&opened[k]);
    free(opened);
    nurbs_patches_free(work.patches);
    return status;
}
