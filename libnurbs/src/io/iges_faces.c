#include "core/error.h"
#include "io/iges.h"

#include <nurbs/io.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>

enum { SAMPLES = 9, MAX_DEPTH = 16, MAX_CURVES = 100000 };

int iges_is_face(int type)
{
    return type == 144 || type == 143 || type == 510;
}

static nurbs_status append_curve(iges_file *file, size_t curve, iges_face *face)
{
    if (face->count == face->room) {
        size_t room = face->room ? 2 * face->room : 16;
        nurbs_curve **larger = realloc(face->curve, room * sizeof *larger);
        if (!larger)
            return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu curves", file->path, room);
        face->curve = larger;
        face->room = room;
    }
    nurbs_status status = iges_curve(file, curve, 1, &face->curve[face->count]);
    face->count += status == NURBS_OK;
    return status;
}

/* A curve in parameter space: 126, 110, 100, or a chain 102 of them; others are passed over. */
static nurbs_status read_curve(iges_file *file, size_t curve, int depth, iges_face *face)
{
    int type = file->entity[curve].type;
    if (type == 126 || type == 110 || type == 100)
        return append_curve(file, curve, face);
    if (type != 102)
        return NURBS_OK;
    /* A composite inside itself would never end. */
    if (depth == MAX_DEPTH || face->count > MAX_CURVES)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: composite curve at D%zu: composites inside each other without end",
                          file->path, iges_number(curve));
    long parts = 0;
    nurbs_status status = iges_integer(file, curve, 0, 0, &parts);
    for (long k = 0; k < parts && status == NURBS_OK; k++) {
        size_t part;
        status = iges_pointer(file, curve, (size_t)k + 1, &part);
        if (status == NURBS_OK)
            status = read_curve(file, part, depth + 1, face);
    }
    return status;
}

/* Curve on surface 142: creation, surface, curve in parameter space, curve in space, preference. */
static nurbs_status read_142(iges_file *file, size_t entity, iges_face *face)
{
    long given;
    size_t curve;
    nurbs_status status = iges_integer(file, entity, 2, 0, &given);
    if (status != NURBS_OK || given == 0)
        return status;
    status = iges_pointer(file, entity, 2, &curve);
    return status == NURBS_OK ? read_curve(file, curve, 0, face) : status;
}

/* Boundary 141: type, preference, surface, N, then (curve, sense, K, K parameter curves). */
static nurbs_status read_141(iges_file *file, size_t entity, iges_face *face)
{
    long n;
    size_t at = 4;
    nurbs_status status = iges_integer(file, entity, 3, 0, &n);
    for (long e = 0; e < n && status == NURBS_OK; e++) {
        long count;
        status = iges_integer(file, entity, at + 2, 0, &count);
        at += 3;
        for (long k = 0; k < count && status == NURBS_OK; k++) {
            size_t curve;
            status = iges_pointer(file, entity, at++, &curve);
            if (status == NURBS_OK)
                status = read_curve(file, curve, 0, face);
        }
    }
    return status;
}

/* Loop 508: N, then (type, edge, index, orientation, K, K times (isoparametric, curve)). */
static nurbs_status read_508(iges_file *file, size_t entity, iges_face *face)
{
    long n;
    size_t at = 1;
    nurbs_status status = iges_integer(file, entity, 0, 0, &n);
    for (long e = 0; e < n && status == NURBS_OK; e++) {
        long count;
        status = iges_integer(file, entity, at + 4, 0, &count);
        at += 5;
        for (long k = 0; k < count && status == NURBS_OK; k++, at += 2) {
            size_t curve;
            status = iges_pointer(file, entity, at + 1, &curve);
            if (status == NURBS_OK)
                status = read_curve(file, curve, 0, face);
        }
    }
    return status;
}

static nurbs_status read_loop(iges_file *file, size_t entity, iges_face *face)
{
    switch (file->entity[entity].type) {
    case 142:
        return read_142(file, entity, face);
    case 141:
        return read_141(file, entity, face);
    case 508:
        return read_508(file, entity, face);
    default:
        return NURBS_OK;
    }
}

/* Where a face lists its loops: parameters first ... first + count - 1, and whether the boundary of
 * the surface itself is the outer loop (144 with N1 = 0). */
static nurbs_status face_loops(const iges_file *file, size_t entity, size_t *first, size_t *count)
{
    long inner = 0, outer = 0;
    nurbs_status status;
    switch (file->entity[entity].type) {
    case 144: /* surface, N1, N2, outer, inner ... */
        status = iges_integer(file, entity, 1, 0, &outer);
        if (status == NURBS_OK)
            status = iges_integer(file, entity, 2, 0, &inner);
        *first = outer ? 3 : 4;
        *count = (size_t)(inner < 0 ? 0 : inner) + (outer ? 1 : 0);
        return status;
    case 143: /* type, surface, N, boundaries ... */
        status = iges_integer(file, entity, 2, 0, &inner);
        *first = 3;
        break;
    default: /* 510: surface, N, outer flag, loops ... */
        status = iges_integer(file, entity, 1, 0, &inner);
        *first = 3;
    }
    *count = inner < 0 ? 0 : (size_t)inner;
    return status;
}

/* Whether some curve leaves the boundary of the surface's domain. */
static nurbs_status leaves_boundary(const iges_face *face, const nurbs_surface *base, int *inside)
{
    nurbs_status status = NURBS_OK;
    *inside = 0;
    for (size_t i = 0; i < face->count * SAMPLES && status == NURBS_OK; i++) {
        const nurbs_curve *curve = face->curve[i / SAMPLES];
        const double *knots = nurbs_curve_knots(curve);
        size_t k = i % SAMPLES;
        double first = knots[0], last = knots[nurbs_curve_size(curve)], p[3];
        double t = k == SAMPLES - 1 ? last : first + (last - first) * (double)k / (SAMPLES - 1);
        int on_edge = 0;
        status = nurbs_curve_eval(curve, 0, 1, &t, p);
        for (int d = 0; d < 2; d++) {
            const double *range = nurbs_surface_knots(base, d);
            double low = range[0], high = range[nurbs_surface_size(base, d)],
                   slack = 1e-5 * (high - low);
            on_edge |= fabs(p[d] - low) < slack || fabs(p[d] - high) < slack;
        }
        *inside |= !on_edge;
    }
    return status;
}

static nurbs_status read_face(iges_file *file, size_t entity, iges_face *face)
{
    size_t first = 0;
    nurbs_surface *base = NULL;
    nurbs_status status =
        iges_pointer(file, entity, file->entity[entity].type == 143 ? 1 : 0, &face->surface);
    if (status == NURBS_OK && file->entity[face->surface].type != 128)
        return NURBS_OK; /* iges_face_space() */
    if (status == NURBS_OK)
        status = face_loops(file, entity, &first, &face->loops);
    if (status == NURBS_OK && face->loops == 0)
        face->trim = IGES_WHOLE;
    if (status == NURBS_OK && face->loops > iges_parameters(file, entity))
        status =
            nurbs_fail(NURBS_ERROR_FORMAT, "%s: face D%zu: %zu loops, more than its parameters",
                       file->path, iges_number(entity), face->loops);
    if (status == NURBS_OK) {
        face->end = calloc(face->loops + 1, sizeof *face->end);
        if (!face->end)
            status = nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu loops", file->path,
                                face->loops);
    }
    for (size_t k = 0; k < face->loops && status == NURBS_OK; k++) {
        size_t loop;
        status = iges_pointer(file, entity, first + k, &loop);
        if (status == NURBS_OK)
            status = read_loop(file, loop, face);
        if (status == NURBS_OK)
            face->end[k] = face->count;
    }
    if (status != NURBS_OK || face->count == 0)
        return status;
    size_t used = file->report_used;
    status = iges_surface(file, face->surface, &base);
    file->report_used = used; /* what there is to say about the surface is said when it is kept */
    int inside = 0;
    if (status == NURBS_OK)
        status = leaves_boundary(face, base, &inside);
    face->trim = inside ? IGES_TRIMMED : IGES_WHOLE;
    nurbs_surface_free(base);
    return status;
}

nurbs_status iges_face_read(iges_file *file, size_t entity, iges_face *face)
{
    *face = (iges_face){.trim = IGES_UNKNOWN};
    nurbs_status status = read_face(file, entity, face);
    if (status != NURBS_OK)
        iges_face_free(face);
    return status;
}

void iges_face_free(iges_face *face)
{
    nurbs_curves_free(face->count, face->curve);
    free(face->end);
    *face = (iges_face){0};
}

/* Appends the parts of a curve in space to the face's last loop, in reverse on demand. */
static nurbs_status add_space(iges_file *file, size_t curve, bool reversed, cad_face *f)
{
    size_t count;
    nurbs_curve **parts;
    nurbs_status status = iges_curve_parts(file, curve, &count, &parts);
    for (size_t k = 0; k < count; k++) {
        size_t at = reversed ? count - 1 - k : k;
        nurbs_curve *turned = parts[at];
        if (reversed && status == NURBS_OK) {
            status = nurbs_curve_reverse(parts[at], &turned);
            nurbs_curve_free(parts[at]);
        }
        if (status == NURBS_OK)
            status = face_add_curve(f, turned);
        else if (!reversed)
            nurbs_curve_free(turned);
    }
    free(parts);
    return status;
}

/* The curve in space of a 142. */
static nurbs_status space_142(iges_file *file, size_t entity, cad_face *f)
{
    long given;
    size_t curve;
    nurbs_status status = iges_integer(file, entity, 3, 0, &given);
    if (status == NURBS_OK && given == 0)
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "its boundary D%zu has no curve in space",
                          iges_number(entity));
    if (status == NURBS_OK)
        status = iges_pointer(file, entity, 3, &curve);
    return status == NURBS_OK ? add_space(file, curve, false, f) : status;
}

static nurbs_status space_141(iges_file *file, size_t entity, cad_face *f)
{
    long n;
    size_t at = 4;
    nurbs_status status = iges_integer(file, entity, 3, 0, &n);
    for (long e = 0; e < n && status == NURBS_OK; e++) {
        long count, sense;
        size_t curve;
        status = iges_pointer(file, entity, at, &curve);
        if (status == NURBS_OK)
            status = iges_integer(file, entity, at + 1, 1, &sense);
        if (status == NURBS_OK)
            status = iges_integer(file, entity, at + 2, 0, &count);
        if (status == NURBS_OK && (count < 0 || (size_t)count > iges_parameters(file, entity)))
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s: boundary D%zu: %ld curves", file->path,
                              iges_number(entity), count);
        if (status == NURBS_OK)
            status = add_space(file, curve, sense == 2, f);
        at += 3 + (size_t)(status == NURBS_OK ? count : 0);
    }
    return status;
}

/* Edge `number` (from 1) of an edge list 504: curve, start list and index, end list and index. */
static nurbs_status edge_curve(const iges_file *file, size_t list, long number, size_t *curve)
{
    long n;
    nurbs_status status = iges_integer(file, list, 0, 0, &n);
    if (status == NURBS_OK && (file->entity[list].type != 504 || number < 1 || number > n))
        return nurbs_fail(NURBS_ERROR_FORMAT, "%s: D%zu has no edge %ld", file->path,
                          iges_number(list), number);
    return status == NURBS_OK ? iges_pointer(file, list, 1 + 5 * ((size_t)number - 1), curve)
                              : status;
}

static nurbs_status space_508(iges_file *file, size_t entity, cad_face *f)
{
    long n;
    size_t at = 1;
    nurbs_status status = iges_integer(file, entity, 0, 0, &n);
    for (long e = 0; e < n && status == NURBS_OK; e++) {
        long vertex, number, agrees, count;
        size_t list, curve;
        status = iges_integer(file, entity, at, 0, &vertex);
        if (status == NURBS_OK)
            status = iges_pointer(file, entity, at + 1, &list);
        if (status == NURBS_OK)
            status = iges_integer(file, entity, at + 2, 0, &number);
        if (status == NURBS_OK)
            status = iges_integer(file, entity, at + 3, 1, &agrees);
        if (status == NURBS_OK)
            status = iges_integer(file, entity, at + 4, 0, &count);
        if (status == NURBS_OK && (count < 0 || (size_t)count > iges_parameters(file, entity)))
            return nurbs_fail(NURBS_ERROR_FORMAT, "%s: loop D%zu: %ld curves", file->path,
                              iges_number(entity), count);
        if (status == NURBS_OK && vertex == 0) {
            status = edge_curve(file, list, number, &curve);
            if (status == NURBS_OK)
                status = add_space(file, curve, agrees == 0, f);
        }
        at += 5 + 2 * (size_t)(status == NURBS_OK ? count : 0);
    }
    return status;
}

static nurbs_status space_loop(iges_file *file, size_t entity, cad_face *f)
{
    nurbs_status status = face_add_loop(f);
    if (status != NURBS_OK)
        return status;
    switch (file->entity[entity].type) {
    case 142:
        return space_142(file, entity, f);
    case 141:
        return space_141(file, entity, f);
    case 508:
        return space_508(file, entity, f);
    default:
        return add_space(file, entity, false, f);
    }
}

nurbs_status iges_face_base(const iges_file *file, size_t entity, size_t *surface)
{
    return iges_pointer(file, entity, file->entity[entity].type == 143 ? 1 : 0, surface);
}

nurbs_status iges_face_space(iges_file *file, size_t entity, cad_face *f)
{
    size_t base = entity, first = 4, count = 1;
    nurbs_status status = NURBS_OK;
    *f = (cad_face){.reversed = false};
    if (iges_is_face(file->entity[entity].type)) {
        status = iges_face_base(file, entity, &base);
        if (status == NURBS_OK)
            status = face_loops(file, entity, &first, &count);
    }
    if (status == NURBS_OK && count > iges_parameters(file, entity))
        status =
            nurbs_fail(NURBS_ERROR_FORMAT, "%s: face D%zu: %zu loops, more than its parameters",
                       file->path, iges_number(entity), count);
    if (status == NURBS_OK)
        status = iges_form(file, base, &f->form);
    for (size_t k = 0; k < count && status == NURBS_OK; k++) {
        size_t loop;
        status = iges_pointer(file, entity, first + k, &loop);
        if (status == NURBS_OK)
            status = space_loop(file, loop, f);
    }
    return status;
}
