#include "core/constants.h"
#include "core/error.h"
#include "io/curve_join.h"
#include "io/form.h"
#include "io/iges.h"
#include "io/iges_spline.h"

#include <nurbs/io.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_INDEX = 1000000, MAX_DEPTH = 16, MAX_PARTS = 100000 };

static nurbs_status refuse(const iges_file *file, size_t entity, const char *what)
{
    return nurbs_fail(NURBS_ERROR_FORMAT, "%s: entity %d at D%zu: %s", file->path,
                      file->entity[entity].type, iges_number(entity), what);
}

/* Homogeneous control points into a curve; equal weights are no weights. */
static nurbs_status create_curve(int degree, size_t n, const double *knots, const double *net,
                                 const double matrix[9], const double shift[3], nurbs_curve **curve)
{
    double *points = malloc(4 * n * sizeof *points), *weights = points + 3 * n;
    size_t rational = 0;
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", n);
    for (size_t k = 0; k < n; k++) {
        const double *h = net + 4 * k;
        weights[k] = h[3];
        for (size_t c = 0; c < 3; c++)
            points[3 * k + c] =
                shift[c] +
                (matrix[3 * c] * h[0] + matrix[3 * c + 1] * h[1] + matrix[3 * c + 2] * h[2]) / h[3];
        rational += fabs(h[3] - net[3]) > 1e-14 * net[3];
    }
    nurbs_status status =
        nurbs_curve_create(degree, n, knots, points, rational ? weights : NULL, curve);
    free(points);
    return status;
}

static nurbs_status spline_sizes(const iges_file *file, size_t entity, int *degree, size_t *size)
{
    long upper, p;
    nurbs_status status = iges_integer(file, entity, 0, 0, &upper);
    if (status == NURBS_OK)
        status = iges_integer(file, entity, 1, 0, &p);
    if (status != NURBS_OK)
        return status;
    if (p < 1 || p > 25 || upper < p || upper > MAX_INDEX)
        return refuse(file, entity,
                      "upper index or degree out of range (degree 1 to 25, index >= degree)");
    *degree = (int)p;
    *size = (size_t)upper + 1;
    if (6 + *size + (size_t)p + 1 + 4 * *size > iges_parameters(file, entity))
        return refuse(file, entity, "fewer parameters than its sizes ask for");
    return NURBS_OK;
}

/* Cuts a curve to V0 ... V1 of the file. */
static nurbs_status curve_range(const iges_file *file, size_t entity, size_t at,
                                nurbs_curve **curve)
{
    double from, to;
    const double *knots = nurbs_curve_knots(*curve);
    double first = knots[0], last = knots[nurbs_curve_size(*curve)], slack = 1e-9 * (last - first);
    nurbs_status status = iges_real(file, entity, at, first, &from);
    if (status == NURBS_OK)
        status = iges_real(file, entity, at + 1, last, &to);
    if (status != NURBS_OK || from < first - slack || to > last + slack || !(to - from > slack) ||
        (from <= first + slack && to >= last - slack))
        return status;
    nurbs_curve *part;
    status = nurbs_curve_part(*curve, fmax(from, first), fmin(to, last), &part);
    if (status == NURBS_OK) {
        nurbs_curve_free(*curve);
        *curve = part;
    }
    return status;
}

static nurbs_status read_spline(const iges_file *file, size_t entity, double scale,
                                const double matrix[9], const double shift[3], nurbs_curve **curve)
{
    int degree = 0;
    size_t n = 0;
    nurbs_status status = spline_sizes(file, entity, &degree, &n);
    if (status != NURBS_OK)
        return status;
    size_t p = (size_t)degree, room = n + 2 * p, at = 6 + n + p + 1, stated = n;
    double *knots = malloc((room + p + 1 + 4 * room) * sizeof *knots);
    if (!knots)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu points", file->path, n);
    double *net = knots + room + p + 1;
    for (size_t k = 0; k < n + p + 1 && status == NURBS_OK; k++) {
        status = iges_real(file, entity, 6 + k, 0, &knots[k]);
        if (status == NURBS_OK && k > 0 && knots[k] < knots[k - 1])
            status = refuse(file, entity, "its knots decrease");
    }
    if (status == NURBS_OK && !(knots[n] > knots[p]))
        status = refuse(file, entity, "its knots have no length");
    for (size_t k = 0; k < n && status == NURBS_OK; k++) {
        double *h = net + 4 * k;
        status = iges_real(file, entity, at + k, 1, &h[3]);
        for (size_t c = 0; c < 3 && status == NURBS_OK; c++) {
            status = iges_real(file, entity, at + n + 3 * k + c, 0, &h[c]);
            h[c] *= scale * h[3];
        }
        if (status == NURBS_OK && !(h[3] > 0))
            status = refuse(file, entity, "a weight is not > 0");
    }
    if (status == NURBS_OK) {
        clamp_spline(degree, &n, knots, 4, net);
        status = create_curve(degree, n, knots, net, matrix, shift, curve);
    }
    if (status == NURBS_OK)
        status = curve_range(file, entity, at + 4 * stated, curve);
    free(knots);
    return status;
}

static nurbs_status read_line(const iges_file *file, size_t entity, double scale,
                              const double matrix[9], const double shift[3], nurbs_curve **curve)
{
    static const double knots[4] = {0, 0, 1, 1};
    double net[8] = {0, 0, 0, 1, 0, 0, 0, 1};
    for (size_t k = 0; k < 6; k++) {
        double *to = &net[k < 3 ? k : k + 1];
        nurbs_status status = iges_real(file, entity, k, 0, to);
        if (status != NURBS_OK)
            return status;
        *to *= scale;
    }
    return create_curve(1, 2, knots, net, matrix, shift, curve);
}

/* A circular arc in a plane z = ZT, counterclockwise from start to end: at most a quarter turn per
 * rational quadratic piece (The NURBS Book 7.5). */
static nurbs_status read_arc(const iges_file *file, size_t entity, double scale,
                             const double matrix[9], const double shift[3], nurbs_curve **curve)
{
    const double turn = 2 * PI;
    double v[7], knots[12], net[36];
    for (size_t k = 0; k < 7; k++) {
        nurbs_status status = iges_real(file, entity, k, 0, &v[k]);
        if (status != NURBS_OK)
            return status;
        v[k] *= scale;
    }
    double radius = hypot(v[3] - v[1], v[4] - v[2]), a = atan2(v[4] - v[2], v[3] - v[1]),
           b = atan2(v[6] - v[2], v[5] - v[1]);
    if (!(radius > 0))
        return refuse(file, entity, "its radius is zero");
    /* Equal ends mean a full circle. */
    if (b <= a + 1e-12)
        b += turn;
    size_t pieces = (size_t)ceil((b - a) / (turn / 4) - 1e-9), n = 2 * pieces + 1;
    double half = 0.5 * (b - a) / (double)pieces;
    for (size_t k = 0; k < n; k++) {
        double w = k % 2 ? cos(half) : 1, angle = a + (double)k * half;
        /* Middle control points lie at radius / cos(half), so weight cancels in w p. */
        double *h = net + 4 * k;
        h[0] = w * v[1] + radius * cos(angle);
        h[1] = w * v[2] + radius * sin(angle);
        h[2] = w * v[0];
        h[3] = w;
    }
    for (size_t k = 0; k < n + 3; k++)
        knots[k] = k < 3 ? 0 : k >= n ? 1 : (double)((k - 1) / 2) / (double)pieces;
    return create_curve(2, n, knots, net, matrix, shift, curve);
}

/* Conics, polylines and parametric splines are made in their own space and then moved. */
static nurbs_status read_other(const iges_file *file, size_t entity, double scale,
                               const double matrix[9], const double shift[3], nurbs_curve **curve)
{
    nurbs_curve *own = NULL;
    nurbs_status status;
    switch (file->entity[entity].type) {
    case 104:
        status = iges_conic(file, entity, scale, &own);
        break;
    case 106:
        status = iges_polyline(file, entity, scale, &own);
        break;
    default:
        status = iges_parametric(file, entity, scale, &own);
    }
    if (status == NURBS_OK)
        status = curve_transform(own, matrix, shift, curve);
    nurbs_curve_free(own);
    return status;
}

/* The parts of a composite 102, each again possibly composite. */
static nurbs_status read_parts(iges_file *file, size_t entity, double scale, int depth,
                               size_t *count, size_t *room, nurbs_curve ***parts)
{
    long n = 0;
    size_t part;
    if (file->entity[entity].type != 102) {
        if (*count == *room) {
            size_t more = *room ? 2 * *room : 8;
            nurbs_curve **larger = realloc(*parts, more * sizeof *larger);
            if (!larger)
                return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu curves", file->path,
                                  more);
            *parts = larger;
            *room = more;
        }
        nurbs_status status = iges_curve(file, entity, scale, &(*parts)[*count]);
        *count += status == NURBS_OK;
        return status;
    }
    nurbs_status status = iges_integer(file, entity, 0, 0, &n);
    if (status == NURBS_OK && (depth == MAX_DEPTH || *count > MAX_PARTS))
        return refuse(file, entity, "composites inside each other without end");
    for (long k = 0; k < n && status == NURBS_OK; k++) {
        status = iges_pointer(file, entity, (size_t)k + 1, &part);
        if (status == NURBS_OK)
            status = read_parts(file, part, scale, depth + 1, count, room, parts);
    }
    return status;
}

nurbs_status iges_curve_parts(iges_file *file, size_t entity, size_t *count, nurbs_curve ***parts)
{
    size_t room = 0;
    *count = 0;
    *parts = NULL;
    nurbs_status status = read_parts(file, entity, file->metres, 0, count, &room, parts);
    if (status != NURBS_OK) {
        nurbs_curves_free(*count, *parts);
        *count = 0;
        *parts = NULL;
    }
    return status;
}

nurbs_status iges_curve_joined(iges_file *file, size_t entity, nurbs_curve **curve)
{
    size_t count;
    nurbs_curve **parts;
    *curve = NULL;
    nurbs_status status = iges_curve_parts(file, entity, &count, &parts);
    if (status == NURBS_OK && count == 1)
        status = nurbs_curve_copy(parts[0], curve);
    else if (status == NURBS_OK)
        status = curves_join(count, (const nurbs_curve *const *)parts, curve);
    nurbs_curves_free(count, parts);
    return status;
}

nurbs_status iges_curve(iges_file *file, size_t entity, double scale, nurbs_curve **curve)
{
    double matrix[9], shift[3];
    *curve = NULL;
    nurbs_status status = iges_transformation(file, entity, matrix, shift);
    if (status != NURBS_OK)
        return status;
    switch (file->entity[entity].type) {
    case 100:
        status = read_arc(file, entity, scale, matrix, shift, curve);
        break;
    case 110:
        status = read_line(file, entity, scale, matrix, shift, curve);
        break;
    case 126:
        status = read_spline(file, entity, scale, matrix, shift, curve);
        break;
    case 104:
    case 106:
    case 112:
        status = read_other(file, entity, scale, matrix, shift, curve);
        break;
    default:
        status = refuse(file, entity, "is not a curve of type 100, 104, 106, 110, 112 or 126");
    }
    if (status != NURBS_OK) {
        nurbs_curve_free(*curve);
        *curve = NULL;
    }
    return status;
}
