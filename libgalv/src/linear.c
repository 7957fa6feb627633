/* Shapes that are linear in their parameters: free-form deformation and given fields. */
#include "error.h"
#include "shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DEGREE = 15 };

typedef struct ffd_shape {
    galv_shape head;
    galv_lattice lattice;
    galv_lattice_move moves[];
} ffd_shape;

/* Clamped uniform knots: knot i of `count` functions of this degree on [0, 1]. */
static double knot(size_t i, size_t count, int degree)
{
    size_t p = (size_t)degree, spans = count - p;
    return i <= p ? 0 : i - p >= spans ? 1 : (double)(i - p) / (double)spans;
}

/* The degree + 1 functions that do not vanish at t in [0, 1] (Cox-de Boor); returns the first one's
 * index. */
static size_t basis(double t, size_t count, int degree, double *values)
{
    size_t p = (size_t)degree, spans = count - p, span = (size_t)(t * (double)spans);
    span = (span < spans ? span : spans - 1) + p;
    values[0] = 1;
    for (size_t k = 1; k <= p; k++) {
        double carried = 0;
        for (size_t j = 0; j < k; j++) {
            double left = knot(span + 1 + j - k, count, degree),
                   right = knot(span + 1 + j, count, degree);
            double part = values[j] / (right - left);
            values[j] = carried + (right - t) * part;
            carried = (t - left) * part;
        }
        values[k] = carried;
    }
    return span - p;
}

/* Values of the lattice's functions at a point; false outside the box. */
static bool lattice_basis(const galv_lattice *lattice, const double *point, size_t first[3],
                          double values[3][MOST_DEGREE + 1])
{
    for (int j = 0; j < 3; j++) {
        double t = (point[j] - lattice->box.origin[j]) / lattice->box.length[j];
        if (!(t >= 0 && t <= 1))
            return false;
        first[j] = basis(t, lattice->count[j], lattice->degree[j], values[j]);
    }
    return true;
}

static double move_value(const ffd_shape *shape, const galv_lattice_move *move,
                         const size_t first[3], double values[3][MOST_DEGREE + 1])
{
    double product = 1;
    for (int j = 0; j < 3; j++) {
        if (move->index[j] < first[j] ||
            move->index[j] > first[j] + (size_t)shape->lattice.degree[j])
            return 0;
        product *= values[j][move->index[j] - first[j]];
    }
    return product;
}

static galv_status ffd_displace(const galv_shape *head, size_t npoints, const double *xyz,
                                const double *x, double *d)
{
    const ffd_shape *shape = (const ffd_shape *)head;
    memset(d, 0, 3 * npoints * sizeof *d);
    for (size_t p = 0; p < npoints; p++) {
        size_t first[3];
        double values[3][MOST_DEGREE + 1];
        if (!lattice_basis(&shape->lattice, xyz + 3 * p, first, values))
            continue;
        for (size_t i = 0; i < head->n; i++)
            d[3 * p + (size_t)shape->moves[i].direction] +=
                x[i] * move_value(shape, &shape->moves[i], first, values);
    }
    return GALV_OK;
}

/* The basis of a linear shape on all coordinates: the displacements of its unit vectors. */
static galv_status linear_shape_plan(const galv_shape *shape, size_t npoints, const double *xyz,
                                     galv_plan **plan)
{
    size_t n = shape->n, length = 3 * npoints;
    double *rows = malloc(n * length * sizeof *rows), *x = calloc(n, sizeof *x);
    size_t *index = malloc(length * sizeof *index);
    galv_status status = GALV_OK;
    if (!rows || !x || !index)
        status = galv_fail(GALV_ERROR_MEMORY, "%zu fields on %zu points", n, npoints);
    for (size_t i = 0; i < n && !status; i++) {
        x[i] = 1;
        status = shape->class->displace(shape, npoints, xyz, x, rows + i * length);
        x[i] = 0;
    }
    free(x);
    if (status) {
        free(rows);
        free(index);
        return status;
    }
    for (size_t i = 0; i < length; i++)
        index[i] = i;
    return galv_plan_linear(n, length, index, rows, plan);
}

static void ffd_destroy(galv_shape *shape)
{
    free(shape);
}

static const galv_shape_class ffd_class = {.name = "free-form",
                                           .linear = true,
                                           .concurrent = true,
                                           .displace = ffd_displace,
                                           .plan = linear_shape_plan,
                                           .destroy = ffd_destroy};

static galv_status check_lattice(const galv_lattice *lattice)
{
    for (int j = 0; j < 3; j++) {
        char axis = "xyz"[j];
        double length = lattice->box.length[j];
        if (!isfinite(lattice->box.origin[j]) || !isfinite(length) || length <= 0)
            return galv_fail(GALV_ERROR_ARGUMENT,
                             "lattice along %c: length %g, expected more than 0", axis, length);
        if (lattice->count[j] < 2)
            return galv_fail(GALV_ERROR_ARGUMENT,
                             "lattice along %c: %zu points, expected 2 or more", axis,
                             lattice->count[j]);
        if (lattice->degree[j] < 1 || lattice->degree[j] > MOST_DEGREE ||
            (size_t)lattice->degree[j] >= lattice->count[j])
            return galv_fail(
                GALV_ERROR_ARGUMENT,
                "lattice along %c: degree %d of %zu points, expected 1..%zu (at most %d)", axis,
                lattice->degree[j], lattice->count[j], lattice->count[j] - 1, MOST_DEGREE);
    }
    return GALV_OK;
}

static galv_status check_move(const galv_lattice *lattice, size_t i, const galv_lattice_move *move)
{
    if (move->direction < 0 || move->direction > 2)
        return galv_fail(GALV_ERROR_ARGUMENT, "move %zu: direction %d, expected 0, 1 or 2", i,
                         move->direction);
    for (int j = 0; j < 3; j++)
        if (move->index[j] >= lattice->count[j])
            return galv_fail(GALV_ERROR_ARGUMENT,
                             "move %zu: control point %zu along %c, expected less than %zu", i,
                             move->index[j], "xyz"[j], lattice -> count[j]);
    return GALV_OK;
}

galv_status galv_shape_ffd(const galv_lattice *lattice, size_t n, const galv_lattice_move *moves,
                           const double *lower, const double *upper, galv_shape **out)
{
    if (!lattice || !moves || !out)
        return galv_fail(GALV_ERROR_ARGUMENT, "lattice and moves must be given");
    galv_status status = check_lattice(lattice);
    for (size_t i = 0; i < n && !status; i++)
        status = check_move(lattice, i, &moves[i]);
    if (status)
        return status;
    ffd_shape *shape = malloc(sizeof *shape + n * sizeof *moves);
    if (!shape)
        return galv_fail(GALV_ERROR_MEMORY, "shape of %zu moves", n);
    status = galv_shape_start(&shape->head, &ffd_class, n, lower, upper);
    if (status) {
        free(shape);
        return status;
    }
    shape->lattice = *lattice;
    memcpy(shape->moves, moves, n * sizeof *moves);
    *out = &shape->head;
    return GALV_OK;
}

typedef struct field_shape {
    galv_shape head;
    size_t npoints;
    double fields[];
} field_shape;

static galv_status field_displace(const galv_shape *head, size_t npoints, const double *xyz,
                                  const double *x, double *d)
{
    (void)xyz;
    const field_shape *shape = (const field_shape *)head;
    if (npoints != shape->npoints)
        return galv_fail(GALV_ERROR_ARGUMENT, "the fields are given on %zu points, not on %zu",
                         shape->npoints, npoints);
    memset(d, 0, 3 * npoints * sizeof *d);
    for (size_t i = 0; i < head->n; i++)
        for (size_t k = 0; k < 3 * npoints; k++)
            d[k] += x[i] * shape->fields[i * 3 * npoints + k];
    return GALV_OK;
}

static void field_destroy(galv_shape *shape)
{
    free(shape);
}

static const galv_shape_class field_class = {.name = "field",
                                             .linear = true,
                                             .concurrent = true,
                                             .displace = field_displace,
                                             .plan = linear_shape_plan,
                                             .destroy = field_destroy};

galv_status galv_shape_fields(size_t n, size_t npoints, const double *fields, const double *lower,
                              const double *upper, galv_shape **out)
{
    if (!fields || !out || npoints == 0)
        return galv_fail(GALV_ERROR_ARGUMENT, "fields on at least one point must be given");
    size_t length = 3 * npoints;
    for (size_t i = 0; i < n * length; i++)
        if (!isfinite(fields[i]))
            return galv_fail(GALV_ERROR_ARGUMENT, "field %zu: coordinate %zu is %g", i / length,
                             i % length, fields[i]);
    field_shape *shape = malloc(sizeof *shape + n * length * sizeof *fields);
    if (!shape)
        return galv_fail(GALV_ERROR_MEMORY, "%zu fields on %zu points", n, npoints);
    galv_status status = galv_shape_start(&shape->head, &field_class, n, lower, upper);
    if (status) {
        free(shape);
        return status;
    }
    shape->npoints = npoints;
    memcpy(shape->fields, fields, n * length * sizeof *fields);
    *out = &shape->head;
    return GALV_OK;
}
