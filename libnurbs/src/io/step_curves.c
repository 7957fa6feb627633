/* Curves of STEP files, and edges between their vertices. */
#include "core/constants.h"
#include "core/error.h"
#include "core/vector.h"
#include "io/curve_join.h"
#include "io/step.h"

#include <nurbs/invert.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DEPTH = 16 };

static const double turn = 2 * PI;

/* A vertex this near to another, or to an end of a curve, is the same: a share of the curve's
 * extent, as CAD kernels write lengths with about that. */
static const double same_place = 1e-6;

static nurbs_status segment(const double a[3], const double b[3], nurbs_curve **curve)
{
    const double knots[4] = {0, 0, 1, 1}, points[6] = {a[0], a[1], a[2], b[0], b[1], b[2]};
    return nurbs_curve_create(1, 2, knots, points, NULL, curve);
}

static nurbs_status reverse(nurbs_curve **curve)
{
    nurbs_curve *reversed;
    nurbs_status status = nurbs_curve_reverse(*curve, &reversed);
    if (status == NURBS_OK) {
        nurbs_curve_free(*curve);
        *curve = reversed;
    }
    return status;
}

/* LINE: point and vector; the vector's length is the unit of its parameter. */
static nurbs_status read_line(const step_file *file, size_t instance, const step_record *record,
                              double origin[3], double along[3])
{
    size_t point, vector, direction;
    double length;
    nurbs_status status = step_reference(file, instance, step_parameter(file, record, 1), &point);
    if (status == NURBS_OK)
        status = step_point(file, point, origin);
    if (status == NURBS_OK)
        status = step_reference(file, instance, step_parameter(file, record, 2), &vector);
    if (status != NURBS_OK)
        return status;
    const step_record *v = step_record_of(file, vector, "VECTOR");
    if (!v)
        return step_refuse(file, vector, "expected a VECTOR");
    status = step_reference(file, vector, step_parameter(file, v, 1), &direction);
    if (status == NURBS_OK)
        status = step_direction(file, direction, along);
    if (status == NURBS_OK)
        status = step_number(file, vector, step_parameter(file, v, 2), &length);
    if (status == NURBS_OK && !(length > 0))
        status = step_refuse(file, vector, "has no length");
    for (int c = 0; c < 3 && status == NURBS_OK; c++)
        along[c] *= length * file->metres;
    return status;
}

typedef enum conic_kind { CIRCLE, ELLIPSE, PARABOLA, HYPERBOLA, NO_CONIC } conic_kind;

typedef struct conic {
    conic_kind kind;
    double origin[3], frame[3][3], a, b;
} conic;

static nurbs_status read_conic(const step_file *file, size_t instance, conic *c)
{
    static const char *const names[] = {"CIRCLE", "ELLIPSE", "PARABOLA", "HYPERBOLA"};
    const step_record *record = NULL;
    size_t placement;
    for (c->kind = CIRCLE; c->kind != NO_CONIC; c->kind++)
        if ((record = step_record_of(file, instance, names[c->kind])))
            break;
    if (!record)
        return NURBS_OK;
    nurbs_status status =
        step_reference(file, instance, step_parameter(file, record, 1), &placement);
    if (status == NURBS_OK)
        status = step_placement(file, placement, c->origin, c->frame);
    if (status == NURBS_OK)
        status = step_number(file, instance, step_parameter(file, record, 2), &c->a);
    c->b = c->a;
    if (status == NURBS_OK && (c->kind == ELLIPSE || c->kind == HYPERBOLA))
        status = step_number(file, instance, step_parameter(file, record, 3), &c->b);
    c->a *= file->metres;
    c->b *= file->metres;
    if (status == NURBS_OK && !(c->a > 0 && c->b > 0))
        status = step_refuse(file, instance, "a radius or focal distance is not > 0");
    return status;
}

/* The conic's own parameter of a point near it. */
static double conic_parameter(const conic *c, const double p[3])
{
    double q[3];
    minus3(p, c->origin, q);
    double x = dot3(q, c->frame[0]), y = dot3(q, c->frame[1]);
    switch (c->kind) {
    case PARABOLA: /* a (t^2 x + 2 t y) */
        return y / (2 * c->a);
    case HYPERBOLA: /* a cosh t x + b sinh t y */
        return asinh(y / c->b);
    default:
        return atan2(y / c->b, x / c->a);
    }
}

/* Parabolas and branches of hyperbolas are one quadratic piece. */
static nurbs_status open_conic(const conic *c, double from, double to, nurbs_curve **curve)
{
    static const double knots[6] = {0, 0, 0, 1, 1, 1};
    double half = 0.5 * (to - from), weights[3] = {1, 1, 1}, points[9], xy[3][2];
    for (int k = 0; k < 3; k++) {
        double t = from + k * half;
        if (c->kind == PARABOLA) {
            /* Blossom of t^2 and t. */
            xy[k][0] = c->a * (k == 1 ? from * to : t * t);
            xy[k][1] = 2 * c->a * t;
        } else {
            double scale = k == 1 ? cosh(half) : 1;
            xy[k][0] = c->a * cosh(t) / scale;
            xy[k][1] = c->b * sinh(t) / scale;
        }
        along3(c->origin, xy[k][0], c->frame[0], points + 3 * k);
        along3(points + 3 * k, xy[k][1], c->frame[1], points + 3 * k);
    }
    if (c->kind == HYPERBOLA)
        weights[1] = cosh(half);
    return nurbs_curve_create(2, 3, knots, points, c->kind == HYPERBOLA ? weights : NULL, curve);
}

static nurbs_status conic_part(const conic *c, double from, double to, nurbs_curve **curve)
{
    double x[3], y[3];
    if (c->kind == PARABOLA || c->kind == HYPERBOLA)
        return open_conic(c, from, to, curve);
    for (int k = 0; k < 3; k++) {
        x[k] = c->a * c->frame[0][k];
        y[k] = c->b * c->frame[1][k];
    }
    return arc_create(c->origin, x, y, from, to, curve);
}

static nurbs_status polyline(const step_file *file, size_t instance, const step_node *list,
                             bool closed, nurbs_curve **curve)
{
    nurbs_status status = step_list(file, instance, list);
    if (status != NURBS_OK)
        return status;
    size_t n = 0, count = list->count + closed;
    double *points = malloc((4 * count + 2) * sizeof *points), *knots = points + 3 * count;
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu points", file->path, count);
    const step_node *node = step_child(file, list, 0);
    for (size_t k = 0; k < count && status == NURBS_OK; k++) {
        size_t index = 0;
        if (!node)
            node = step_child(file, list, 0);
        status = step_reference(file, instance, node, &index);
        if (status == NURBS_OK)
            status = step_point(file, index, points + 3 * n);
        node = status == NURBS_OK ? step_next(file, node) : NULL;
        double length = n ? distance3(points + 3 * n - 3, points + 3 * n) : 0;
        if (n && !(length > 0))
            continue;
        knots[n + 1] = n ? knots[n] + length : 0;
        n++;
    }
    if (status == NURBS_OK && n < 2)
        status = step_refuse(file, instance, "has fewer than two points");
    if (status == NURBS_OK) {
        knots[0] = 0;
        knots[n + 1] = knots[n];
        status = nurbs_curve_create(1, n, knots, points, NULL, curve);
    }
    free(points);
    return status;
}

static void extent_of(const nurbs_curve *curve, double *extent)
{
    const double *p = nurbs_curve_points(curve);
    *extent = 0;
    for (size_t k = 1; k < nurbs_curve_size(curve); k++)
        *extent = fmax(*extent, distance3(p, p + 3 * k));
}

/* From t = a to b of a curve; over the seam of a closed one where b <= a. */
static nurbs_status part_over_seam(const nurbs_curve *whole, double a, double b,
                                   nurbs_curve **curve)
{
    const double *knots = nurbs_curve_knots(whole);
    double low = knots[0], high = knots[nurbs_curve_size(whole)], slack = 1e-9 * (high - low);
    nurbs_curve *part[2] = {NULL, NULL};
    if (a < low + slack)
        a = low;
    if (b > high - slack)
        b = high;
    if (b > a + slack)
        return a == low && b == high ? nurbs_curve_copy(whole, curve)
                                     : nurbs_curve_part(whole, a, b, curve);
    if (a >= high - slack)
        return nurbs_curve_part(whole, low, b, curve);
    if (b <= low + slack)
        return nurbs_curve_part(whole, a, high, curve);
    nurbs_status status = nurbs_curve_part(whole, a, high, &part[0]);
    if (status == NURBS_OK)
        status = nurbs_curve_part(whole, low, b, &part[1]);
    if (status == NURBS_OK)
        status = curves_join(2, (const nurbs_curve *const *)part, curve);
    nurbs_curve_free(part[0]);
    nurbs_curve_free(part[1]);
    return status;
}

/* The stretch of a curve between two points near it, in its own direction. */
static nurbs_status between(const step_file *file, size_t instance, const nurbs_curve *whole,
                            const double from[3], const double to[3], nurbs_curve **curve)
{
    const double *p = nurbs_curve_points(whole), *end = p + 3 * (nurbs_curve_size(whole) - 1),
                 *knots = nurbs_curve_knots(whole);
    double extent, t[2], ends[2][3], apart[2];
    extent_of(whole, &extent);
    double near = same_place * extent;
    bool closed = distance3(p, end) <= near;
    memcpy(ends[0], from, sizeof ends[0]);
    memcpy(ends[1], to, sizeof ends[1]);
    if (distance3(from, p) <= near && distance3(to, end) <= near)
        return nurbs_curve_copy(whole, curve);
    nurbs_status status = nurbs_curve_closest(whole, 2, ends[0], t, apart);
    if (status != NURBS_OK)
        return status;
    if (fmax(apart[0], apart[1]) > 1e-3 * extent)
        return step_refuse(file, instance, "a vertex lies %.3g m off its curve",
                           fmax(apart[0], apart[1]));
    if (closed && distance3(from, p) <= near)
        t[0] = knots[0];
    if (closed && distance3(to, end) <= near)
        t[1] = knots[nurbs_curve_size(whole)];
    if (!closed && t[1] <= t[0])
        return step_refuse(file, instance, "its vertices stand in the wrong order on its curve");
    return part_over_seam(whole, t[0], t[1], curve);
}

/* TRIMMED_CURVE: basis, two trims (each a point, a parameter, or both), sense. */
typedef struct trim {
    bool has_point, has_value;
    double point[3], value;
} trim;

static nurbs_status read_trim(const step_file *file, size_t instance, const step_node *list,
                              trim *t)
{
    *t = (trim){.has_point = false};
    nurbs_status status = step_list(file, instance, list);
    const step_node *node = status == NURBS_OK ? step_child(file, list, 0) : NULL;
    for (; node && status == NURBS_OK; node = step_next(file, node)) {
        size_t point;
        if (node->kind == STEP_REFERENCE) {
            status = step_reference(file, instance, node, &point);
            if (status == NURBS_OK)
                status = step_point(file, point, t->point);
            t->has_point = true;
        } else {
            status = step_number(file, instance, node, &t->value);
            t->has_value = true;
        }
    }
    return status;
}

static nurbs_status part_of(step_file *file, size_t instance, int depth, const trim *first,
                            const trim *last, bool forwards, nurbs_curve **curve);

static nurbs_status trimmed_curve(step_file *file, size_t instance, const step_record *record,
                                  int depth, nurbs_curve **curve)
{
    size_t basis;
    trim t[2];
    nurbs_status status = step_reference(file, instance, step_parameter(file, record, 1), &basis);
    for (size_t k = 0; k < 2 && status == NURBS_OK; k++)
        status = read_trim(file, instance, step_parameter(file, record, 2 + k), &t[k]);
    if (status != NURBS_OK)
        return status;
    bool forwards = step_flag(step_parameter(file, record, 4), true);
    return part_of(file, basis, depth + 1, &t[0], &t[1], forwards, curve);
}

/* COMPOSITE_CURVE: segments, each a curve in or against its direction. */
static nurbs_status composite_curve(step_file *file, size_t instance, const step_record *record,
                                    int depth, nurbs_curve **curve)
{
    const step_node *list = step_parameter(file, record, 1);
    nurbs_status status = step_list(file, instance, list);
    if (status != NURBS_OK)
        return status;
    nurbs_curve **part = calloc(list->count + 1, sizeof *part);
    size_t n = 0;
    if (!part)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu curves", file->path,
                          list->count);
    for (const step_node *node = step_child(file, list, 0); node && status == NURBS_OK;
         node = step_next(file, node), n++) {
        size_t index, parent;
        status = step_reference(file, instance, node, &index);
        const step_record *s =
            status == NURBS_OK ? step_record_of(file, index, "COMPOSITE_CURVE_SEGMENT") : NULL;
        if (status == NURBS_OK && !s)
            status = step_refuse(file, index, "expected a COMPOSITE_CURVE_SEGMENT");
        if (status == NURBS_OK)
            status = step_reference(file, index, step_parameter(file, s, 2), &parent);
        if (status == NURBS_OK)
            status = step_curve(file, parent, depth + 1, &part[n]);
        if (status == NURBS_OK && !step_flag(step_parameter(file, s, 1), true))
            status = reverse(&part[n]);
    }
    if (status == NURBS_OK)
        status = curves_join(n, (const nurbs_curve *const *)part, curve);
    for (size_t k = 0; k < list->count; k++)
        nurbs_curve_free(part[k]);
    free(part);
    return status;
}

/* The curve in space of a SURFACE_CURVE and its kinds. */
static const step_record *surface_curve(const step_file *file, size_t instance)
{
    static const char *const names[] = {"SURFACE_CURVE", "SEAM_CURVE", "INTERSECTION_CURVE"};
    for (size_t k = 0; k < 3; k++) {
        const step_record *record = step_record_of(file, instance, names[k]);
        if (record)
            return record;
    }
    return NULL;
}

nurbs_status step_curve(step_file *file, size_t instance, int depth, nurbs_curve **curve)
{
    conic c;
    const step_record *record;
    *curve = NULL;
    if (depth > MOST_DEPTH)
        return step_refuse(file, instance, "curves inside each other without end");
    if (step_is_spline(file, instance, false))
        return step_spline_curve(file, instance, curve);
    if ((record = step_record_of(file, instance, "LINE"))) {
        double origin[3], along[3], end[3];
        nurbs_status status = read_line(file, instance, record, origin, along);
        along3(origin, 1, along, end);
        return status == NURBS_OK ? segment(origin, end, curve) : status;
    }
    if ((record = surface_curve(file, instance))) {
        size_t space;
        nurbs_status status =
            step_reference(file, instance, step_parameter(file, record, 1), &space);
        return status == NURBS_OK ? step_curve(file, space, depth + 1, curve) : status;
    }
    if ((record = step_record_of(file, instance, "TRIMMED_CURVE")))
        return trimmed_curve(file, instance, record, depth, curve);
    if ((record = step_record_of(file, instance, "COMPOSITE_CURVE")))
        return composite_curve(file, instance, record, depth, curve);
    if ((record = step_record_of(file, instance, "POLYLINE")))
        return polyline(file, instance, step_parameter(file, record, 1), false, curve);
    nurbs_status status = read_conic(file, instance, &c);
    if (status != NURBS_OK)
        return status;
    if (c.kind == CIRCLE || c.kind == ELLIPSE)
        return conic_part(&c, 0, turn, curve);
    char name[64];
    return nurbs_fail(NURBS_ERROR_GEOMETRY, "#%zu %s is no curve that is read",
                      file->instance[instance].id, step_name(file, instance, name));
}

/* The trim's place on a conic: its parameter if it has one, else that of its point. */
static double trim_angle(const step_file *file, const conic *c, const trim *t)
{
    bool angle = c->kind == CIRCLE || c->kind == ELLIPSE;
    return t->has_point ? conic_parameter(c, t->point) : t->value * (angle ? file->radians : 1);
}

static nurbs_status conic_between(const step_file *file, const conic *c, const trim *first,
                                  const trim *last, bool forwards, nurbs_curve **curve)
{
    double a = trim_angle(file, c, forwards ? first : last),
           b = trim_angle(file, c, forwards ? last : first);
    if (c->kind == CIRCLE || c->kind == ELLIPSE) {
        b -= turn * floor((b - a) / turn);
        if (b <= a + 1e-9 || b - a > turn)
            b = a + turn;
    } else if (!(b > a)) {
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "an edge runs against its conic");
    }
    nurbs_status status = conic_part(c, a, b, curve);
    return status == NURBS_OK && !forwards ? reverse(curve) : status;
}

/* From the first trim to the last. forwards: in the direction of the curve. */
static nurbs_status part_of(step_file *file, size_t instance, int depth, const trim *first,
                            const trim *last, bool forwards, nurbs_curve **curve)
{
    conic c = {.kind = NO_CONIC};
    const step_record *record = surface_curve(file, instance);
    *curve = NULL;
    if (depth > MOST_DEPTH)
        return step_refuse(file, instance, "curves inside each other without end");
    if (record) {
        size_t space;
        nurbs_status status =
            step_reference(file, instance, step_parameter(file, record, 1), &space);
        return status == NURBS_OK ? part_of(file, space, depth + 1, first, last, forwards, curve)
                                  : status;
    }
    record = step_record_of(file, instance, "LINE");
    if (record) {
        double origin[3], along[3], ends[2][3];
        nurbs_status status = read_line(file, instance, record, origin, along);
        for (int k = 0; k < 2 && status == NURBS_OK; k++) {
            const trim *t = k ? last : first;
            if (t->has_point)
                memcpy(ends[k], t->point, sizeof ends[k]);
            else
                along3(origin, t->value, along, ends[k]);
        }
        return status == NURBS_OK ? segment(ends[0], ends[1], curve) : status;
    }
    nurbs_status status = read_conic(file, instance, &c);
    if (status != NURBS_OK)
        return status;
    if (c.kind != NO_CONIC)
        return conic_between(file, &c, first, last, forwards, curve);
    nurbs_curve *whole = NULL;
    status = step_curve(file, instance, depth + 1, &whole);
    const trim *a = forwards ? first : last, *b = forwards ? last : first;
    if (status == NURBS_OK && a->has_point && b->has_point)
        status = between(file, instance, whole, a->point, b->point, curve);
    else if (status == NURBS_OK)
        status = part_over_seam(whole, a->value, b->value, curve);
    nurbs_curve_free(whole);
    return status == NURBS_OK && !forwards ? reverse(curve) : status;
}

static nurbs_status vertex(const step_file *file, size_t instance, const step_node *node, trim *t)
{
    size_t index, point;
    nurbs_status status = step_reference(file, instance, node, &index);
    if (status != NURBS_OK)
        return status;
    const step_record *record = step_record_of(file, index, "VERTEX_POINT");
    if (!record)
        return step_refuse(file, index, "expected a VERTEX_POINT");
    status = step_reference(file, index, step_parameter(file, record, 1), &point);
    *t = (trim){.has_point = true};
    return status == NURBS_OK ? step_point(file, point, t->point) : status;
}

nurbs_status step_edge(step_file *file, size_t instance, nurbs_curve **curve)
{
    const step_record *record = step_record_of(file, instance, "EDGE_CURVE");
    size_t geometry;
    trim t[2];
    *curve = NULL;
    if (!record)
        return step_refuse(file, instance, "expected an EDGE_CURVE");
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < 2 && status == NURBS_OK; k++)
        status = vertex(file, instance, step_parameter(file, record, 1 + k), &t[k]);
    if (status == NURBS_OK)
        status = step_reference(file, instance, step_parameter(file, record, 3), &geometry);
    if (status != NURBS_OK)
        return status;
    return part_of(file, geometry, 0, &t[0], &t[1],
                   step_flag(step_parameter(file, record, 4), true), curve);
}
