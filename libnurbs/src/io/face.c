#include "io/face.h"

#include "core/error.h"
#include "core/vector.h"

#include <nurbs/fit.h>
#include <nurbs/modify.h>
#include <nurbs/trim.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Edges within this share of the tolerance of a parameter line are put on it. */
static const double straight_share = 0.1;

/* Where no edge bounds a range exactly, it is extended by this share. */
static const double margin = 0.05;

nurbs_status face_add_loop(cad_face *f)
{
    if (f->count == f->room) {
        size_t room = f->room ? 2 * f->room : 4;
        face_loop *larger = realloc(f->loop, room * sizeof *larger);
        if (!larger)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu loops", room);
        f->loop = larger;
        f->room = room;
    }
    f->loop[f->count++] = (face_loop){0};
    return NURBS_OK;
}

nurbs_status face_add_curve(cad_face *f, nurbs_curve *curve)
{
    face_loop *loop = &f->loop[f->count - 1];
    if (loop->count == loop->room) {
        size_t room = loop->room ? 2 * loop->room : 8;
        nurbs_curve **larger = realloc(loop->curve, room * sizeof *larger);
        if (!larger) {
            nurbs_curve_free(curve);
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu curves", room);
        }
        loop->curve = larger;
        loop->room = room;
    }
    loop->curve[loop->count++] = curve;
    return NURBS_OK;
}

nurbs_status face_reverse_loop(cad_face *f)
{
    face_loop *loop = &f->loop[f->count - 1];
    for (size_t k = 0; k < loop->count; k++) {
        nurbs_curve *reversed;
        nurbs_status status = nurbs_curve_reverse(loop->curve[k], &reversed);
        if (status != NURBS_OK)
            return status;
        nurbs_curve_free(loop->curve[k]);
        loop->curve[k] = reversed;
    }
    for (size_t a = 0, b = loop->count; a + 1 < b; a++) {
        nurbs_curve *swapped = loop->curve[a];
        loop->curve[a] = loop->curve[--b];
        loop->curve[b] = swapped;
    }
    return NURBS_OK;
}

void face_free(cad_face *f)
{
    for (size_t k = 0; k < f->count; k++) {
        for (size_t i = 0; i < f->loop[k].count; i++)
            nurbs_curve_free(f->loop[k].curve[i]);
        free(f->loop[k].curve);
    }
    free(f->loop);
    form_free(&f->form);
    *f = (cad_face){0};
}

/* What is at work: loops as paths, and the surface over their range. */
typedef struct cover {
    const cad_face *face;
    size_t count;
    face_path *path;
    double low[2], high[2];
    double slack, moved;
    nurbs_surface *surface;
} cover;

static void cover_free(cover *c)
{
    for (size_t k = 0; k < c->count; k++)
        face_path_free(&c->path[k]);
    free(c->path);
    nurbs_surface_free(c->surface);
}

static double path_area(const face_path *path)
{
    double area = 0;
    for (size_t k = 0; k < path->count; k++) {
        const face_trace *trace = &path->trace[k];
        for (size_t i = 1; i < trace->count; i++) {
            const double *a = trace->ab + 2 * i - 2, *b = a + 2;
            area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
        }
    }
    return fabs(area);
}

static void path_range(const face_path *path, double low[2], double high[2])
{
    for (int d = 0; d < 2; d++) {
        low[d] = INFINITY;
        high[d] = -INFINITY;
        for (size_t k = 0; k < path->count; k++)
            for (size_t i = 0; i < path->trace[k].count; i++) {
                double value = path->trace[k].ab[2 * i + (size_t)d];
                low[d] = fmin(low[d], value);
                high[d] = fmax(high[d], value);
            }
    }
}

static void shift_path(face_path *path, int d, double by)
{
    for (size_t k = 0; k < path->count; k++)
        for (size_t i = 0; i < path->trace[k].count; i++)
            path->trace[k].ab[2 * i + (size_t)d] += by;
}

/* Whole periods apart from the domain of a closed curve or surface, or from the outer loop. */
static void place_paths(cover *c)
{
    const cad_form *f = &c->face->form;
    for (int d = 0; d < 2; d++) {
        double period = f->period[d], low[2], high[2];
        if (!(period > 0))
            continue;
        for (size_t k = 0; k < c->count; k++) {
            path_range(&c->path[k], low, high);
            double home = k == 0 ? 0.5 * (f->low[d] + f->high[d]) : 0.5 * (c->low[d] + c->high[d]);
            shift_path(&c->path[k], d, -period * round((0.5 * (low[d] + high[d]) - home) / period));
            if (k == 0)
                path_range(&c->path[0], c->low, c->high);
        }
    }
}

/* Whether some edge that is a parameter line lies at this end of the range. */
static bool bounded(const face_path *path, int d, double value, double slack)
{
    for (size_t k = 0; k < path->count; k++)
        if (path->trace[k].level[d] && fabs(path->trace[k].ab[d] - value) <= slack)
            return true;
    return false;
}

/* The range of the surface to be built: exact where parameter lines end it. */
static void find_range(cover *c)
{
    const cad_form *f = &c->face->form;
    path_range(&c->path[0], c->low, c->high);
    for (int d = 0; d < 2; d++) {
        double length = c->high[d] - c->low[d], slack = 1e-9 * length;
        bool round = f->kind == FORM_REVOLVED && f->period[d] > 0;
        double room = round ? fmax(f->period[d] - length, 0) / 2 : INFINITY;
        double extra = fmin(margin * length, room);
        double low = round ? -INFINITY : f->low[d], high = round ? INFINITY : f->high[d];
        if (!bounded(&c->path[0], d, c->low[d], slack))
            c->low[d] = fmax(c->low[d] - extra, fmin(low, c->low[d]));
        if (!bounded(&c->path[0], d, c->high[d], slack))
            c->high[d] = fmin(c->high[d] + extra, fmax(high, c->high[d]));
        if (round && c->high[d] - c->low[d] > f->period[d])
            c->high[d] = c->low[d] + f->period[d];
    }
}

/* All edges lie on the boundary of the range. */
static bool is_rectangle(const cover *c)
{
    const face_path *path = &c->path[0];
    if (c->count != 1)
        return false;
    for (size_t k = 0; k < path->count; k++) {
        const face_trace *trace = &path->trace[k];
        bool on_edge = false;
        for (int d = 0; d < 2; d++) {
            double stretch[2], value = trace->ab[d];
            form_stretch(&c->face->form, trace->ab, stretch);
            double near = fmin(fabs(value - c->low[d]), fabs(value - c->high[d]));
            on_edge |= trace->level[d] && near * stretch[d] <= c->slack;
        }
        if (!on_edge)
            return false;
    }
    return true;
}

/* The corners of a plane face whose edges are straight; more than four are not wanted. */
static size_t straight_corners(const cover *c, double corner[4][2])
{
    const face_path *path = &c->path[0];
    size_t found = 0, n = path->count;
    if (c->face->form.kind != FORM_PLANE || c->count != 1)
        return 0;
    for (size_t k = 0; k < n; k++) {
        const face_trace *trace = &path->trace[k], *next = &path->trace[(k + 1) % n];
        if (!trace->curve || nurbs_curve_degree(trace->curve) != 1)
            return 0;
        const double *a = trace->ab, *b = next->ab, *end = next->ab + 2 * (next->count - 1);
        double cross = (b[0] - a[0]) * (end[1] - b[1]) - (b[1] - a[1]) * (end[0] - b[0]),
               size = hypot(b[0] - a[0], b[1] - a[1]) + hypot(end[0] - b[0], end[1] - b[1]);
        if (fabs(cross) <= c->slack * size)
            continue;
        if (found == 4)
            return 0;
        memcpy(corner[found++], b, sizeof corner[0]);
    }
    return found;
}

/* A plane triangle or convex quadrangle, exact as a bilinear patch. */
static nurbs_status bilinear(const cover *c, size_t n, double corner[4][2], nurbs_surface **patch)
{
    static const size_t order[4] = {0, 3, 1, 2};
    static const double knots[4] = {0, 0, 1, 1};
    const cad_form *f = &c->face->form;
    double points[12], area = 0;
    *patch = NULL;
    for (size_t k = 0; k < n; k++) {
        const double *a = corner[k], *b = corner[(k + 1) % n], *d = corner[(k + 2) % n];
        double turn = (b[0] - a[0]) * (d[1] - b[1]) - (b[1] - a[1]) * (d[0] - b[0]);
        if (turn * area < 0)
            return NURBS_OK;
        area = turn;
    }
    if (n == 3)
        memcpy(corner[3], corner[2], sizeof corner[3]);
    for (size_t k = 0; k < 4; k++) {
        /* Counterclockwise corners give the normal of the plane. */
        const double *at = corner[area > 0 ? order[k] : n == 3 ? 3 - order[k] : 3 - order[k]];
        double p[3];
        along3(f->origin, at[0], f->frame[0], p);
        along3(p, at[1], f->frame[1], points + 3 * k);
    }
    return nurbs_surface_create((const int[]){1, 1}, (const size_t[]){2, 2}, knots, knots, points,
                                NULL, patch);
}

/* A spline surface that a face uses between parameter lines. */
static nurbs_status cut_spline(cover *c)
{
    for (int d = 0; d < 2; d++) {
        const double *knots = nurbs_surface_knots(c->surface, d);
        double first = knots[0], last = knots[nurbs_surface_size(c->surface, d)],
               low = fmax(c->low[d], first), high = fmin(c->high[d], last),
               slack = 1e-9 * (last - first);
        nurbs_surface *part;
        if (low <= first + slack && high >= last - slack)
            continue;
        nurbs_status status = nurbs_surface_part(c->surface, d, low, high, &part);
        if (status != NURBS_OK)
            return status;
        nurbs_surface_free(c->surface);
        c->surface = part;
    }
    return NURBS_OK;
}

static nurbs_status segment(const double from[2], const double to[2], nurbs_curve **curve)
{
    const double knots[4] = {0, 0, 1, 1}, points[6] = {from[0], from[1], 0, to[0], to[1], 0};
    return nurbs_curve_create(1, 2, knots, points, NULL, curve);
}

/* The image of a curve in a plane is exact. */
static nurbs_status flat_image(const cad_form *f, const face_trace *trace, nurbs_curve **curve)
{
    double matrix[9] = {0}, shift[3] = {0}, from = trace->t[0], to = trace->t[trace->count - 1];
    nurbs_curve *part;
    for (int d = 0; d < 2; d++) {
        memcpy(matrix + 3 * d, f->frame[d], sizeof f->frame[d]);
        shift[d] = -dot3(f->origin, f->frame[d]);
    }
    nurbs_status status = nurbs_curve_part(trace->curve, fmin(from, to), fmax(from, to), &part);
    if (status == NURBS_OK)
        status = curve_transform(part, matrix, shift, curve);
    nurbs_curve_free(part);
    return status;
}

/* A cubic through all places of the trace. */
static nurbs_status interpolate(const cover *c, const face_trace *trace, nurbs_curve **curve)
{
    double *points = malloc(4 * trace->count * sizeof *points), *u = points + 3 * trace->count;
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", trace->count);
    for (size_t k = 0; k < trace->count; k++) {
        double uv[2];
        form_parameters(&c->face->form, c->low, c->high, trace->ab + 2 * k, uv);
        points[3 * k] = uv[0];
        points[3 * k + 1] = uv[1];
        points[3 * k + 2] = 0;
        u[k] = (double)k;
    }
    nurbs_status status = nurbs_curve_interpolate(3, trace->count, points, u, curve);
    free(points);
    return status;
}

/* Largest distance in space between the surface along the curve in its parameters, and the edge,
 * halfway between the places of the trace. */
static nurbs_status check_image(cover *c, const face_trace *trace, const nurbs_curve *curve)
{
    for (size_t k = 0; k + 1 < trace->count; k++) {
        double t = 0.5 * (trace->t[k] + trace->t[k + 1]), u = (double)k + 0.5, p[3], q[3], uv[3];
        nurbs_status status = nurbs_curve_eval(trace->curve, 0, 1, &t, p);
        if (status == NURBS_OK)
            status = nurbs_curve_eval(curve, 0, 1, &u, uv);
        for (int d = 0; d < 2 && status == NURBS_OK; d++) {
            const double *knots = nurbs_surface_knots(c->surface, d);
            uv[d] = fmin(fmax(uv[d], knots[0]), knots[nurbs_surface_size(c->surface, d)]);
        }
        if (status == NURBS_OK)
            status = nurbs_surface_eval(c->surface, 0, 1, uv, q);
        if (status != NURBS_OK)
            return status;
        c->moved = fmax(c->moved, distance3(p, q));
    }
    return NURBS_OK;
}

static nurbs_status image(cover *c, const face_trace *trace, nurbs_curve **curve)
{
    const cad_form *f = &c->face->form;
    double from[2], to[2];
    *curve = NULL;
    if (trace->curve && f->kind == FORM_PLANE && nurbs_curve_degree(trace->curve) > 1)
        return flat_image(f, trace, curve);
    if (!trace->curve || trace->level[0] || trace->level[1] || f->kind == FORM_PLANE) {
        form_parameters(f, c->low, c->high, trace->ab, from);
        form_parameters(f, c->low, c->high, trace->ab + 2 * (trace->count - 1), to);
        return segment(from, to, curve);
    }
    nurbs_status status = interpolate(c, trace, curve);
    return status == NURBS_OK ? check_image(c, trace, *curve) : status;
}

/* Images of all edges, one after the other. */
static nurbs_status images(cover *c, size_t *count, nurbs_curve **all)
{
    nurbs_status status = NURBS_OK;
    *count = 0;
    for (size_t k = 0; k < c->count; k++)
        for (size_t i = 0; i < c->path[k].count && status == NURBS_OK; i++) {
            status = image(c, &c->path[k].trace[i], &all[*count]);
            *count += all[*count] != NULL;
        }
    return status;
}

static nurbs_status resample(cover *c, double tolerance, nurbs_patches *patches,
                             face_outcome *outcome)
{
    size_t total = 0, made = 0, at = 0;
    for (size_t k = 0; k < c->count; k++)
        total += c->path[k].count;
    nurbs_curve **all = calloc(total + 1, sizeof *all);
    const nurbs_curve *const **loop = malloc(c->count * sizeof *loop);
    size_t *count = malloc(c->count * sizeof *count);
    nurbs_status status = all && loop && count
                              ? images(c, &made, all)
                              : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu curves", total);
    for (size_t k = 0; k < c->count && status == NURBS_OK; k++) {
        loop[k] = (const nurbs_curve *const *)(all + at);
        count[k] = c->path[k].count;
        at += count[k];
    }
    if (status == NURBS_OK && c->moved > 0.5 * tolerance)
        status = nurbs_fail(NURBS_ERROR_GEOMETRY, "its edges lie up to %.3g m off its surface",
                            c->moved);
    if (status == NURBS_OK)
        status = nurbs_surface_untrim_parts(c->surface, c->count, count, loop, tolerance - c->moved,
                                            patches, &outcome->deviation);
    outcome->deviation += c->moved;
    for (size_t k = 0; all && k < made; k++)
        nurbs_curve_free(all[k]);
    free(all);
    free(loop);
    free(count);
    return status;
}

/* Follows all loops; those that say nothing (a vertex, a collapsed edge) are passed over. */
static nurbs_status follow_loops(cover *c)
{
    const cad_face *f = c->face;
    c->path = calloc(f->count + 1, sizeof *c->path);
    if (!c->path)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu loops", f->count);
    for (size_t k = 0; k < f->count; k++) {
        nurbs_status status =
            face_path_create(f, &f->loop[k], c->slack, &c->path[c->count], &c->moved);
        if (status != NURBS_OK)
            return status;
        if (c->path[c->count].count > 0)
            c->count++;
        else
            face_path_free(&c->path[c->count]);
    }
    nurbs_status status = face_close_paths(f, &c->count, c->path);
    size_t outer = 0;
    for (size_t k = 1; k < c->count && status == NURBS_OK; k++)
        if (path_area(&c->path[k]) > path_area(&c->path[outer]))
            outer = k;
    if (c->count > 0) {
        face_path swapped = c->path[0];
        c->path[0] = c->path[outer];
        c->path[outer] = swapped;
    }
    return status;
}

static nurbs_status make_patches(cover *c, double tolerance, nurbs_patches *made,
                                 face_outcome *outcome)
{
    double corner[4][2];
    nurbs_surface *flat = NULL;
    nurbs_status status = follow_loops(c);
    if (status != NURBS_OK)
        return status;
    size_t corners = c->count ? straight_corners(c, corner) : 0;
    if (corners >= 3)
        status = bilinear(c, corners, corner, &flat);
    if (flat) {
        outcome->exact = true;
        status = nurbs_patches_add(made, flat);
        nurbs_surface_free(flat);
        return status;
    }
    if (c->count > 0) {
        place_paths(c);
        find_range(c);
    } else {
        memcpy(c->low, c->face->form.low, sizeof c->low);
        memcpy(c->high, c->face->form.high, sizeof c->high);
    }
    if (status == NURBS_OK)
        status = form_surface(&c->face->form, c->low, c->high, &c->surface);
    if (status != NURBS_OK)
        return status;
    if (c->count > 0 && !is_rectangle(c))
        return resample(c, tolerance, made, outcome);
    outcome->exact = true;
    outcome->deviation = c->moved;
    status = c->face->form.kind == FORM_SPLINE ? cut_spline(c) : NURBS_OK;
    return status == NURBS_OK ? nurbs_patches_add(made, c->surface) : status;
}

nurbs_status face_patches(const cad_face *f, double tolerance, nurbs_patches *patches,
                          face_outcome *outcome)
{
    cover c = {.face = f, .slack = straight_share * tolerance};
    nurbs_patches *made = NULL;
    *outcome = (face_outcome){0};
    nurbs_status status = nurbs_patches_create(&made);
    if (status == NURBS_OK)
        status = make_patches(&c, tolerance, made, outcome);
    for (size_t k = 0; status == NURBS_OK && k < nurbs_patches_count(made); k++) {
        nurbs_surface *turned = NULL;
        if (f->reversed)
            status = nurbs_surface_swap(nurbs_patches_get(made, k), &turned);
        if (status == NURBS_OK)
            status = nurbs_patches_add(patches, turned ? turned : nurbs_patches_get(made, k));
        nurbs_surface_free(turned);
        outcome->patches++;
    }
    nurbs_patches_free(made);
    cover_free(&c);
    return status;
}
