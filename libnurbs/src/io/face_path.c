/* Loops in space as paths in the natural parameters of a surface. */
#include "core/error.h"
#include "core/vector.h"
#include "io/face.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Places a knot span at which a curve is followed. */
enum { SPAN_SAMPLES = 24, LEAST_SAMPLES = 33 };

void face_path_free(face_path *path)
{
    for (size_t k = 0; k < path->count; k++)
        free(path->trace[k].ab);
    free(path->trace);
    *path = (face_path){0};
}

/* Room for one more trace of `count` places; its arrays are the path's. */
static face_trace *append(face_path *path, size_t count)
{
    if (path->count == path->room) {
        size_t room = path->room ? 2 * path->room : 8;
        face_trace *larger = realloc(path->trace, room * sizeof *larger);
        if (!larger)
            return NULL;
        path->trace = larger;
        path->room = room;
    }
    double *ab = malloc(3 * count * sizeof *ab);
    if (!ab)
        return NULL;
    face_trace *trace = &path->trace[path->count++];
    *trace = (face_trace){.count = count, .ab = ab, .t = ab + 2 * count};
    return trace;
}

/* Values that a pole leaves open come from the nearest place that has one. */
static void fill_loose(face_trace *trace, const bool *loose, int d)
{
    size_t n = trace->count, known = n;
    for (size_t k = 0; k < n; k++) {
        if (!loose[2 * k + (size_t)d])
            known = k;
        else if (known < n)
            trace->ab[2 * k + (size_t)d] = trace->ab[2 * known + (size_t)d];
    }
    known = n;
    for (size_t k = n; k-- > 0;) {
        if (!loose[2 * k + (size_t)d])
            known = k;
        else if (known < n)
            trace->ab[2 * k + (size_t)d] = trace->ab[2 * known + (size_t)d];
    }
}

static void unwrap(const cad_face *f, face_trace *trace, int d)
{
    double period = f->form.period[d], *ab = trace->ab;
    for (size_t k = 1; k < trace->count && period > 0; k++) {
        double step = ab[2 * k + (size_t)d] - ab[2 * k - 2 + (size_t)d];
        ab[2 * k + (size_t)d] -= period * round(step / period);
    }
}

/* At the seam of a closed spline or profile its first and last parameter are one place. An end that
 * lies there takes the side from which its curve comes. */
static void choose_seam_side(const cad_face *f, face_trace *trace, int d)
{
    double period = f->form.period[d], slack = 1e-7 * period, *ab = trace->ab + d;
    size_t last = trace->count - 1;
    if (!(period > 0) || trace->count < 3)
        return;
    for (int e = 0; e < 2; e++) {
        double *end = ab + 2 * (e ? last : 0), inner = ab[2 * (e ? last - 1 : 1)];
        bool seam = fabs(*end - f->form.low[d]) < slack || fabs(*end - f->form.high[d]) < slack;
        if (seam)
            *end -= period * round((*end - inner) / period);
    }
}

/* A parameter that hardly changes, in metres, is made constant. */
static void straighten(const cad_face *f, face_trace *trace, int d, double slack, double *moved)
{
    double low = INFINITY, high = -INFINITY, stretch[2], widest = 0;
    for (size_t k = 0; k < trace->count; k++) {
        low = fmin(low, trace->ab[2 * k + (size_t)d]);
        high = fmax(high, trace->ab[2 * k + (size_t)d]);
        form_stretch(&f->form, trace->ab + 2 * k, stretch);
        widest = fmax(widest, stretch[d]);
    }
    double off = 0.5 * (high - low) * widest, value = 0.5 * (low + high);
    trace->level[d] = off <= slack;
    if (!trace->level[d])
        return;
    for (int e = 0; e < 2; e++) {
        /* To a limit of the surface rather than beside it. */
        double limit = e ? f->form.high[d] : f->form.low[d];
        if (isfinite(limit) && fabs(value - limit) * widest <= slack + 1e-9 * fabs(limit) * widest)
            value = limit;
    }
    *moved = fmax(*moved, off);
    for (size_t k = 0; k < trace->count; k++)
        trace->ab[2 * k + (size_t)d] = value;
}

/* Follows a curve from t = from to `to`, which may be smaller. */
static nurbs_status trace_part(const cad_face *f, const nurbs_curve *curve, double from, double to,
                               size_t count, double slack, face_path *path, double *moved)
{
    face_trace *trace = append(path, count);
    bool *loose = malloc(2 * count * sizeof *loose);
    nurbs_status status = NURBS_OK;
    if (!trace || !loose)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a curve of %zu places", count);
    for (size_t k = 0; k < count && status == NURBS_OK; k++) {
        double p[3];
        trace->t[k] = k + 1 == count ? to : from + (to - from) * (double)k / (double)(count - 1);
        status = nurbs_curve_eval(curve, 0, 1, &trace->t[k], p);
        if (status == NURBS_OK)
            status = form_invert(&f->form, p, trace->ab + 2 * k, loose + 2 * k);
    }
    if (status == NURBS_OK) {
        size_t all = 0;
        trace->curve = curve;
        trace->loose[0] = loose[0] || loose[1];
        trace->loose[1] = loose[2 * count - 2] || loose[2 * count - 1];
        for (int d = 0; d < 2; d++) {
            choose_seam_side(f, trace, d);
            fill_loose(trace, loose, d);
            unwrap(f, trace, d);
            straighten(f, trace, d, slack, moved);
        }
        for (size_t k = 0; k < count; k++)
            all += loose[2 * k] || loose[2 * k + 1];
        /* A curve that lies in a pole, or has no length, says nothing. */
        if (all == count || (trace->level[0] && trace->level[1])) {
            free(trace->ab);
            path->count--;
        }
    }
    free(loose);
    return status;
}

/* The smooth parts of a curve, between the knots at which it may turn. */
static nurbs_status trace_curve(const cad_face *f, const nurbs_curve *curve, double slack,
                                face_path *path, double *moved)
{
    size_t p = (size_t)nurbs_curve_degree(curve), size = nurbs_curve_size(curve), spans = 0;
    const double *t = nurbs_curve_knots(curve);
    double from = t[0];
    nurbs_status status = NURBS_OK;
    for (size_t k = p + 1; k <= size && status == NURBS_OK; k++) {
        spans += t[k] > t[k - 1];
        if (k < size && (t[k] != t[k + p - 1] || t[k] == from))
            continue;
        size_t count = SPAN_SAMPLES * spans + 1;
        status = trace_part(f, curve, from, t[k], count < LEAST_SAMPLES ? LEAST_SAMPLES : count,
                            slack, path, moved);
        spans = 0;
        from = t[k];
    }
    return status;
}

static void shift_trace(face_trace *trace, int d, double by)
{
    for (size_t k = 0; k < trace->count; k++)
        trace->ab[2 * k + (size_t)d] += by;
}

static const double *trace_end(const face_trace *trace, int end)
{
    return trace->ab + (end ? 2 * (trace->count - 1) : 0);
}

/* Starts the loop behind a pole, so that everything up to the next one hangs together. */
static void rotate_to_pole(face_path *path)
{
    size_t first = 0;
    while (first < path->count && !(path->trace[first].loose[0] &&
                                    path->trace[(first + path->count - 1) % path->count].loose[1]))
        first++;
    if (first == path->count)
        return;
    for (size_t turn = 0; turn < first; turn++) {
        face_trace head = path->trace[0];
        memmove(path->trace, path->trace + 1, (path->count - 1) * sizeof head);
        path->trace[path->count - 1] = head;
    }
}

/* Two poles leave two chains: the one that climbs bounds the face on the side of growing angle when
 * the loop runs counterclockwise. */
static void order_chains(const cad_face *f, face_path *path, size_t second)
{
    for (int d = 0; d < 2; d++) {
        double period = f->form.period[d];
        if (!(period > 0))
            continue;
        const double *a = trace_end(&path->trace[0], 0), *b = trace_end(&path->trace[second], 0),
                     *a_end = trace_end(&path->trace[second - 1], 1);
        bool climbs = (a_end[!d] > a[!d]) != (d == 1);
        bool wanted = climbs != f->reversed; /* the second chain below the first */
        double gap = wanted ? a[d] - b[d] : b[d] - a[d], by;
        gap -= period * floor(gap / period);
        if (gap < 1e-9 * period || gap > (1 - 1e-9) * period)
            gap = period;
        by = (wanted ? a[d] - gap : a[d] + gap) - b[d];
        for (size_t k = second; k < path->count; k++)
            shift_trace(&path->trace[k], d, by);
    }
}

/* Shifts every part by whole periods to where the one before ends. */
static void join_parts(const cad_face *f, face_path *path)
{
    size_t poles = 0, second = 0;
    rotate_to_pole(path);
    for (size_t k = 1; k < path->count; k++) {
        face_trace *trace = &path->trace[k], *before = trace - 1;
        if (trace->loose[0] && before->loose[1]) {
            poles++;
            second = k;
            continue;
        }
        for (int d = 0; d < 2; d++) {
            double period = f->form.period[d],
                   step = trace_end(trace, 0)[d] - trace_end(before, 1)[d];
            if (period > 0)
                shift_trace(trace, d, -period * round(step / period));
        }
    }
    if (path->count == 0)
        return;
    const face_trace *first = &path->trace[0], *last = &path->trace[path->count - 1];
    bool closes_in_pole = first->loose[0] && last->loose[1];
    if (poles == 1 && closes_in_pole)
        order_chains(f, path, second);
    for (int d = 0; d < 2 && !closes_in_pole; d++)
        if (f->form.period[d] > 0)
            path->winding[d] =
                f->form.period[d] *
                round((trace_end(last, 1)[d] - trace_end(first, 0)[d]) / f->form.period[d]);
}

nurbs_status face_path_create(const cad_face *f, const face_loop *loop, double slack,
                              face_path *path, double *moved)
{
    nurbs_status status = NURBS_OK;
    *path = (face_path){0};
    for (size_t k = 0; k < loop->count && status == NURBS_OK; k++)
        status = trace_curve(f, loop->curve[k], slack, path, moved);
    if (status == NURBS_OK)
        join_parts(f, path);
    else
        face_path_free(path);
    return status;
}

/* A straight line in the parameters. */
static nurbs_status add_line(face_path *path, const double from[2], const double to[2])
{
    face_trace *trace = append(path, 2);
    if (!trace)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a seam");
    for (int d = 0; d < 2; d++) {
        trace->ab[d] = from[d];
        trace->ab[2 + d] = to[d];
        trace->level[d] = from[d] == to[d];
    }
    return NURBS_OK;
}

/* The pole on the inside of a loop that winds about parameter d. */
static nurbs_status close_with_pole(const cad_face *f, face_path *path, int d)
{
    bool above = (path->winding[d] > 0) != f->reversed;
    double pole = above != (d == 1) ? f->form.high[!d] : f->form.low[!d], stretch[2], usual[2],
           corner[4][2];
    memcpy(corner[0], trace_end(&path->trace[path->count - 1], 1), sizeof corner[0]);
    memcpy(corner[3], trace_end(&path->trace[0], 0), sizeof corner[3]);
    memcpy(corner[1], corner[0], sizeof corner[1]);
    memcpy(corner[2], corner[3], sizeof corner[2]);
    corner[1][!d] = corner[2][!d] = pole;
    form_stretch(&f->form, corner[0], usual);
    if (isfinite(pole))
        form_stretch(&f->form, corner[1], stretch);
    if (!isfinite(pole) || stretch[d] > 1e-6 * usual[d])
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "one loop round a surface that has no pole there");
    nurbs_status status = NURBS_OK;
    for (int k = 0; k < 3 && status == NURBS_OK; k++)
        status = add_line(path, corner[k], corner[k + 1]);
    return status;
}

/* Appends `other`, shifted to begin where the seam from the end of `path` arrives, and a seam back.
 */
static nurbs_status join_round(const cad_face *f, face_path *path, face_path *other, int d)
{
    double start[2], end[2], from[2], to[2];
    memcpy(start, trace_end(&path->trace[0], 0), sizeof start);
    memcpy(end, trace_end(&path->trace[path->count - 1], 1), sizeof end);
    memcpy(from, trace_end(&other->trace[0], 0), sizeof from);
    double by = f->form.period[d] * round((end[d] - from[d]) / f->form.period[d]);
    for (size_t k = 0; k < other->count; k++)
        shift_trace(&other->trace[k], d, by);
    memcpy(from, trace_end(&other->trace[0], 0), sizeof from);
    memcpy(to, trace_end(&other->trace[other->count - 1], 1), sizeof to);
    nurbs_status status = add_line(path, end, from);
    for (size_t k = 0; k < other->count && status == NURBS_OK; k++) {
        face_trace *moved = append(path, 1), *source = &other->trace[k];
        if (!moved)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a seam");
        free(moved->ab);
        *moved = *source;
        source->ab = NULL;
    }
    if (status == NURBS_OK)
        status = add_line(path, to, start);
    path->winding[d] = 0;
    return status;
}

nurbs_status face_close_paths(const cad_face *f, size_t *count, face_path *paths)
{
    for (int d = 0; d < 2; d++) {
        size_t winding[3], found = 0;
        for (size_t k = 0; k < *count; k++)
            if (paths[k].winding[d] != 0 && found < 3)
                winding[found++] = k;
        nurbs_status status = NURBS_OK;
        if (found > 2)
            return nurbs_fail(NURBS_ERROR_GEOMETRY, "three loops round one surface");
        if (found == 1)
            status = close_with_pole(f, &paths[winding[0]], d);
        if (found == 2 && paths[winding[0]].winding[d] * paths[winding[1]].winding[d] > 0)
            return nurbs_fail(NURBS_ERROR_GEOMETRY, "two loops round it in the same direction");
        if (found == 2) {
            status = join_round(f, &paths[winding[0]], &paths[winding[1]], d);
            face_path_free(&paths[winding[1]]);
            memmove(paths + winding[1], paths + winding[1] + 1,
                    (*count - winding[1] - 1) * sizeof *paths);
            (*count)--;
        }
        if (status != NURBS_OK)
            return status;
    }
    return NURBS_OK;
}
