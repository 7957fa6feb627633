#include "core/error.h"
#include "io/iges.h"
#include "io/iges_spline.h"

#include <nurbs/modify.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_INDEX = 1000000, MAX_CHAIN = 32 };

static nurbs_status refuse(const iges_file *file, size_t entity, const char *what)
{
    return nurbs_fail(NURBS_ERROR_FORMAT, "%s: entity %d at D%zu: %s", file->path,
                      file->entity[entity].type, iges_number(entity), what);
}

/* The sentence of the library under the name of the entity. */
static nurbs_status explain(const iges_file *file, size_t entity, nurbs_status status)
{
    char reason[256];
    if (status == NURBS_OK || status == NURBS_ERROR_MEMORY)
        return status;
    snprintf(reason, sizeof reason, "%s", nurbs_last_error());
    return refuse(file, entity, reason);
}

static nurbs_status read_reals(const iges_file *file, size_t entity, size_t at, size_t n,
                               double *values)
{
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < n && status == NURBS_OK; k++) {
        if (at + k >= iges_parameters(file, entity))
            return refuse(file, entity, "fewer parameters than its sizes ask for");
        status = iges_real(file, entity, at + k, 0, &values[k]);
    }
    return status;
}

nurbs_status iges_transformation(const iges_file *file, size_t entity, double matrix[9],
                                 double shift[3])
{
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(matrix, identity, sizeof identity);
    shift[0] = shift[1] = shift[2] = 0;
    size_t next = file->entity[entity].transformation;
    for (int depth = 0; next > 0; depth++) {
        double r[12], product[9], moved[3];
        size_t at = next - 1;
        if (file->entity[at].type != 124 || depth == MAX_CHAIN)
            return refuse(file, entity, "its transformation is not a chain of entities 124");
        nurbs_status status = read_reals(file, at, 0, 12, r);
        if (status != NURBS_OK)
            return status;
        for (int i = 0; i < 3; i++) {
            const double *row = r + 4 * i;
            for (int j = 0; j < 3; j++)
                product[3 * i + j] =
                    row[0] * matrix[j] + row[1] * matrix[3 + j] + row[2] * matrix[6 + j];
            moved[i] =
                row[0] * shift[0] + row[1] * shift[1] + row[2] * shift[2] + row[3] * file->metres;
        }
        memcpy(matrix, product, sizeof product);
        memcpy(shift, moved, sizeof moved);
        next = file->entity[at].transformation;
    }
    return NURBS_OK;
}

/* The numbers of a 128 as they stand, and room to clamp them. */
typedef struct raw_surface {
    int degree[2];
    size_t size[2];
    double *knots[2], *net; /* net homogeneous, u slow */
    double range[4];        /* U0 U1 V0 V1; NAN where not given */
} raw_surface;

static void raw_free(raw_surface *raw)
{
    free(raw->knots[0]);
    free(raw->knots[1]);
    free(raw->net);
}

static nurbs_status raw_sizes(const iges_file *file, size_t entity, raw_surface *raw)
{
    long upper[2], degree[2];
    nurbs_status status = NURBS_OK;
    for (size_t d = 0; d < 2 && status == NURBS_OK; d++) {
        status = iges_integer(file, entity, d, 0, &upper[d]);
        if (status == NURBS_OK)
            status = iges_integer(file, entity, 2 + d, 0, &degree[d]);
    }
    if (status != NURBS_OK)
        return status;
    size_t needed = 9;
    for (int d = 0; d < 2; d++) {
        if (degree[d] < 1 || degree[d] > 25 || upper[d] < degree[d] || upper[d] > MAX_INDEX)
            return refuse(file, entity,
                          "upper index or degree out of range (degree 1 to 25, index >= degree)");
        raw->degree[d] = (int)degree[d];
        raw->size[d] = (size_t)upper[d] + 1;
        needed += raw->size[d] + (size_t)degree[d] + 1;
    }
    if (needed + 4 * raw->size[0] * raw->size[1] > iges_parameters(file, entity))
        return refuse(file, entity, "fewer parameters than its sizes ask for");
    return NURBS_OK;
}

static nurbs_status raw_net(const iges_file *file, size_t entity, size_t at, raw_surface *raw)
{
    size_t nu = raw->size[0], nv = raw->size[1], n = nu * nv;
    double *values = malloc(4 * n * sizeof *values);
    if (!values)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu points", file->path, n);
    nurbs_status status = read_reals(file, entity, at, 4 * n, values);
    for (size_t i = 0; i < nu && status == NURBS_OK; i++)
        for (size_t j = 0; j < nv; j++) {
            size_t from = j * nu + i; /* the first index is fastest in the file */
            double w = values[from], *h = raw->net + 4 * (i * nv + j);
            for (size_t c = 0; c < 3; c++)
                h[c] = w * file->metres * values[n + 3 * from + c];
            h[3] = w;
            if (!(w > 0)) {
                status = refuse(file, entity, "a weight is not > 0");
                break;
            }
        }
    free(values);
    return status;
}

static nurbs_status raw_read(const iges_file *file, size_t entity, raw_surface *raw)
{
    *raw = (raw_surface){0};
    nurbs_status status = raw_sizes(file, entity, raw);
    if (status != NURBS_OK)
        return status;
    size_t room[2], at = 9;
    for (int d = 0; d < 2; d++) {
        room[d] = raw->size[d] + 2 * (size_t)raw->degree[d];
        raw->knots[d] = malloc((room[d] + (size_t)raw->degree[d] + 1) * sizeof(double));
    }
    raw->net = malloc(4 * room[0] * room[1] * sizeof(double));
    if (!raw->knots[0] || !raw->knots[1] || !raw->net)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for a surface", file->path);
    for (int d = 0; d < 2 && status == NURBS_OK; d++) {
        size_t count = raw->size[d] + (size_t)raw->degree[d] + 1;
        status = read_reals(file, entity, at, count, raw->knots[d]);
        for (size_t k = 1; k < count && status == NURBS_OK; k++)
            if (raw->knots[d][k] < raw->knots[d][k - 1])
                status = refuse(file, entity, "its knots decrease");
        if (status == NURBS_OK && !(raw->knots[d][raw->size[d]] > raw->knots[d][raw->degree[d]]))
            status = refuse(file, entity, "its knots have no length");
        at += count;
    }
    if (status == NURBS_OK)
        status = raw_net(file, entity, at, raw);
    at += 4 * raw->size[0] * raw->size[1];
    for (size_t k = 0; k < 4 && status == NURBS_OK; k++)
        status = iges_real(file, entity, at + k, NAN, &raw->range[k]);
    return status;
}

/* Exchanges the directions of the net in place of `net`, through a copy. */
static nurbs_status turn_net(const iges_file *file, raw_surface *raw, int back)
{
    size_t nu = raw->size[back], nv = raw->size[!back];
    double *copy = malloc(4 * nu * nv * sizeof *copy);
    if (!copy)
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu points", file->path, nu * nv);
    memcpy(copy, raw->net, 4 * nu * nv * sizeof *copy);
    for (size_t i = 0; i < nu; i++)
        for (size_t j = 0; j < nv; j++)
            memcpy(raw->net + 4 * (j * nu + i), copy + 4 * (i * nv + j), 4 * sizeof *copy);
    free(copy);
    return NURBS_OK;
}

static nurbs_status raw_clamp(iges_file *file, size_t entity, raw_surface *raw)
{
    size_t before[2] = {raw->size[0], raw->size[1]};
    int changed =
        clamp_spline(raw->degree[0], &raw->size[0], raw->knots[0], 4 * raw->size[1], raw->net);
    nurbs_status status = turn_net(file, raw, 0);
    if (status != NURBS_OK)
        return status;
    changed +=
        clamp_spline(raw->degree[1], &raw->size[1], raw->knots[1], 4 * raw->size[0], raw->net);
    status = turn_net(file, raw, 1);
    if (changed)
        iges_report(file,
                    "surface D%zu: end knots were not %d and %d equal ones, clamped (%zu x %zu -> "
                    "%zu x %zu); ",
                    iges_number(entity), raw->degree[0] + 1, raw->degree[1] + 1, before[0],
                    before[1], raw->size[0], raw->size[1]);
    return status;
}

/* From homogeneous to Cartesian points; equal weights are no weights. */
static nurbs_status raw_create(const raw_surface *raw, nurbs_surface **surface)
{
    size_t n = raw->size[0] * raw->size[1], rational = 0;
    double *points = malloc(4 * n * sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", n);
    double *weights = points + 3 * n;
    for (size_t k = 0; k < n; k++) {
        weights[k] = raw->net[4 * k + 3];
        for (size_t c = 0; c < 3; c++)
            points[3 * k + c] = raw->net[4 * k + c] / weights[k];
        rational += fabs(weights[k] - weights[0]) > 1e-14 * weights[0];
    }
    nurbs_status status = nurbs_surface_create(raw->degree, raw->size, raw->knots[0], raw->knots[1],
                                               points, rational ? weights : NULL, surface);
    free(points);
    return status;
}

/* Cuts direction d of the surface to the stated range when that lies inside its domain. */
static nurbs_status apply_range(iges_file *file, size_t entity, int d, const double range[2],
                                nurbs_surface **surface)
{
    const double *knots = nurbs_surface_knots(*surface, d);
    double first = knots[0], last = knots[nurbs_surface_size(*surface, d)],
           slack = 1e-9 * (last - first);
    if (isnan(range[0]) || isnan(range[1]))
        return NURBS_OK;
    double from = range[0] > first + slack ? range[0] : first,
           to = range[1] < last - slack ? range[1] : last;
    if (range[0] < first - slack || range[1] > last + slack || !(from < to)) {
        iges_report(file, "surface D%zu: stated range %g to %g lies outside its knots, ignored; ",
                    iges_number(entity), range[0], range[1]);
        return NURBS_OK;
    }
    if (from == first && to == last)
        return NURBS_OK;
    nurbs_surface *part;
    nurbs_status status = nurbs_surface_part(*surface, d, from, to, &part);
    if (status == NURBS_OK) {
        iges_report(file, "surface D%zu: cut to its stated range %g to %g; ", iges_number(entity),
                    from, to);
        nurbs_surface_free(*surface);
        *surface = part;
    }
    return status;
}

static nurbs_status move_surface(const iges_file *file, size_t entity, nurbs_surface **surface)
{
    double matrix[9], shift[3];
    if (file->entity[entity].transformation == 0)
        return NURBS_OK;
    nurbs_status status = iges_transformation(file, entity, matrix, shift);
    nurbs_surface *moved = NULL;
    if (status == NURBS_OK)
        status = nurbs_surface_transform(*surface, matrix, shift, &moved);
    if (status == NURBS_OK) {
        nurbs_surface_free(*surface);
        *surface = moved;
    }
    return status;
}

nurbs_status iges_surface(iges_file *file, size_t entity, nurbs_surface **surface)
{
    raw_surface raw;
    *surface = NULL;
    nurbs_status status = raw_read(file, entity, &raw);
    if (status == NURBS_OK)
        status = raw_clamp(file, entity, &raw);
    if (status == NURBS_OK)
        status = explain(file, entity, raw_create(&raw, surface));
    for (int d = 0; d < 2 && status == NURBS_OK; d++)
        status = explain(file, entity, apply_range(file, entity, d, raw.range + 2 * d, surface));
    if (status == NURBS_OK)
        status = move_surface(file, entity, surface);
    raw_free(&raw);
    if (status != NURBS_OK) {
        nurbs_surface_free(*surface);
        *surface = NULL;
    }
    return status;
}
