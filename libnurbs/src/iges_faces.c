#include "error.h"
#include "iges.h"

#include <math.h>
#include <stdlib.h>

enum { SAMPLES = 9, MAX_DEPTH = 16, MAX_CURVES = 100000 };

int iges_is_face(int type)
{
    return type == 144 || type == 143 || type == 510;
}

/* What the curves of a face in parameter space do; the domain is that of the base surface. */
typedef struct loop_check {
    double low[2], high[2];
    size_t curves;
    int inside; /* some curve leaves the boundary of the domain */
} loop_check;

static nurbs_status check_simple(iges_file *file, size_t curve, loop_check *loops)
{
    nurbs_curve *read;
    nurbs_status status = iges_curve(file, curve, 1, &read);
    if (status != NURBS_OK)
        return status;
    const double *knots = nurbs_curve_knots(read);
    double first = knots[0], last = knots[nurbs_curve_size(read)];
    for (int k = 0; k < SAMPLES && status == NURBS_OK; k++) {
        double t = k == SAMPLES - 1 ? last : first + (last - first) * k / (SAMPLES - 1), p[3];
        int on_edge = 0;
        status = nurbs_curve_eval(read, 0, 1, &t, p);
        for (int d = 0; d < 2; d++) {
            double slack = 1e-5 * (loops->high[d] - loops->low[d]);
            on_edge |= fabs(p[d] - loops->low[d]) < slack || fabs(p[d] - loops->high[d]) < slack;
        }
        loops->inside |= !on_edge;
    }
    loops->curves++;
    nurbs_curve_free(read);
    return status;
}

/* A curve in parameter space: 126, 110, 100, or a chain 102 of them; others are passed over. */
static nurbs_status check_curve(iges_file *file, size_t curve, int depth, loop_check *loops)
{
    int type = file->entity[curve].type;
    if (type == 126 || type == 110 || type == 100)
        return check_simple(file, curve, loops);
    if (type != 102)
        return NURBS_OK;
    /* A composite inside itself would never end. */
    if (depth == MAX_DEPTH || loops->curves > MAX_CURVES)
        return nurbs_fail(NURBS_ERROR_FORMAT,
                          "%s: composite curve at D%zu: composites inside each other without end",
                          file->path, iges_number(curve));
    long parts = 0;
    nurbs_status status = iges_integer(file, curve, 0, 0, &parts);
    for (long k = 0; k < parts && status == NURBS_OK; k++) {
        size_t part;
        status = iges_pointer(file, curve, (size_t)k + 1, &part);
        if (status == NURBS_OK)
            status = check_curve(file, part, depth + 1, loops);
    }
    return status;
}

/* Curve on surface 142: creation, surface, curve in parameter space, curve in space, preference. */
static nurbs_status check_142(iges_file *file, size_t entity, loop_check *loops)
{
    long given;
    size_t curve;
    nurbs_status status = iges_integer(file, entity, 2, 0, &given);
    if (status != NURBS_OK || given == 0)
        return status;
    status = iges_pointer(file, entity, 2, &curve);
    return status == NURBS_OK ? check_curve(file, curve, 0, loops) : status;
}

/* Boundary 141: type, preference, surface, N, then (curve, sense, K, K parameter curves). */
static nurbs_status check_141(iges_file *file, size_t entity, loop_check *loops)
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
                status = check_curve(file, curve, 0, loops);
        }
    }
    return status;
}

/* Loop 508: N, then (type, edge, index, orientation, K, K times (isoparametric, curve)). */
static nurbs_status check_508(iges_file *file, size_t entity, loop_check *loops)
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
                status = check_curve(file, curve, 0, loops);
        }
    }
    return status;
}

static nurbs_status check_loop(iges_file *file, size_t entity, loop_check *loops)
{
    switch (file->entity[entity].type) {
    case 142:
        return check_142(file, entity, loops);
    case 141:
        return check_141(file, entity, loops);
    case 508:
        return check_508(file, entity, loops);
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

nurbs_status iges_face(iges_file *file, size_t entity, size_t *surface, iges_trim *trim)
{
    size_t first = 0, count = 0;
    nurbs_surface *base = NULL;
    *trim = IGES_UNKNOWN;
    nurbs_status status =
        iges_pointer(file, entity, file->entity[entity].type == 143 ? 1 : 0, surface);
    if (status == NURBS_OK && file->entity[*surface].type != 128)
        return NURBS_OK;
    if (status == NURBS_OK)
        status = face_loops(file, entity, &first, &count);
    if (status == NURBS_OK && count == 0)
        *trim = IGES_WHOLE;
    if (status != NURBS_OK || count == 0)
        return status;
    size_t used = file->report_used;
    status = iges_surface(file, *surface, &base);
    file->report_used = used; /* what there is to say about the surface is said when it is kept */
    if (status != NURBS_OK)
        return status;
    loop_check loops = {0};
    for (int d = 0; d < 2; d++) {
        loops.low[d] = nurbs_surface_knots(base, d)[0];
        loops.high[d] = nurbs_surface_knots(base, d)[nurbs_surface_size(base, d)];
    }
    nurbs_surface_free(base);
    for (size_t k = 0; k < count && status == NURBS_OK; k++) {
        size_t loop;
        status = iges_pointer(file, entity, first + k, &loop);
        if (status == NURBS_OK)
            status = check_loop(file, loop, &loops);
    }
    if (status == NURBS_OK && loops.curves > 0)
        *trim = loops.inside ? IGES_TRIMMED : IGES_WHOLE;
    return status;
}
