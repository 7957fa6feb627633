#include "fit/tensor_refine.h"

#include "core/error.h"
#include "fit/interpolate.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 12, MOST_PARTS = 4 };

nurbs_status tensor_sample(const tensor_map *map, int turned, const size_t n[2],
                           const double *const parameters[2], double *out)
{
    double *line = malloc(3 * n[1] * sizeof *line);
    if (!line)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section of %zu points", n[1]);
    nurbs_status status = NURBS_OK;
    for (size_t i = 0; i < n[0] && status == NURBS_OK; i++) {
        double *target = turned ? line : out + 3 * n[1] * i;
        status = map->section(map->context, parameters[0][i], n[1], parameters[1], target);
        for (size_t j = 0; j < n[1] && turned && status == NURBS_OK; j++)
            memcpy(out + 3 * (j * n[0] + i), line + 3 * j, 3 * sizeof *out);
    }
    free(line);
    return status;
}

nurbs_status tensor_solve(int degree, size_t n, const double *knots, const double *sites, size_t m,
                          double *rows)
{
    banded factors;
    nurbs_status status = collocation_factor(degree, n, knots, sites, &factors);
    if (status == NURBS_OK) {
        banded_solve(&factors, m, rows);
        banded_free(&factors);
    }
    return status;
}

nurbs_status tensor_solve_across(const knot_list *along, size_t rows, const double *sites,
                                 double *net)
{
    size_t columns = along->size;
    double *turned = malloc(3 * rows * columns * sizeof *turned);
    if (!turned)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu points", rows, columns);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++)
            memcpy(turned + 3 * (j * rows + i), net + 3 * (i * columns + j), 3 * sizeof *net);
    nurbs_status status =
        tensor_solve(along->degree, columns, along->knots, sites, 3 * rows, turned);
    for (size_t i = 0; i < rows && status == NURBS_OK; i++)
        for (size_t j = 0; j < columns; j++)
            memcpy(net + 3 * (i * columns + j), turned + 3 * (j * rows + i), 3 * sizeof *net);
    free(turned);
    return status;
}

/* Largest distance between the splines rows[list->size][3n] at t and the points [n][3]. */
static double row_error(const knot_list *list, double t, size_t n, const double *rows,
                        const double *points)
{
    double basis[NURBS_MAX_DEGREE + 1], worst = 0;
    size_t p = (size_t)list->degree,
           span = nurbs_basis_span(list->degree, list->size, list->knots, t, NULL);
    nurbs_basis(list->degree, list->knots, span, t, basis);
    rows += (span - p) * 3 * n;
    for (size_t k = 0; k < 3 * n; k += 3) {
        double square = 0;
        for (size_t c = k; c < k + 3; c++) {
            double difference = -points[c];
            for (size_t a = 0; a <= p; a++)
                difference += basis[a] * rows[a * 3 * n + c];
            square += difference * difference;
        }
        worst = fmax(worst, square);
    }
    return sqrt(worst);
}

/* Where knot interval k is checked, far from the interpolation points: those of odd degrees lie
 * near the knots, those of even degrees near the middles of the spans. Returns the number of
 * places. */
static size_t check_places(const knot_list *list, size_t k, double *places)
{
    double length = list->knots[k + 1] - list->knots[k];
    size_t count = list->degree % 2 ? 1 : 2;
    if (!(length > 0))
        return 0;
    for (size_t c = 0; places && c < count; c++)
        places[c] = list->knots[k] + length * (count == 1 ? 0.5 : c ? 0.8 : 0.2);
    return count;
}

/* Into how many parts a span must be divided when the error falls with the power degree + 1. */
static unsigned char parts_for(double error, double target, int degree)
{
    if (!(error > target))
        return 1;
    double parts = ceil(pow(error / target, 1.0 / (degree + 1)));
    return (unsigned char)fmin(fmax(parts, 2), MOST_PARTS);
}

/* The work of one round in one direction: `sites` and `places` to check along it, splines through
 * the map there on the n lines `across`. */
typedef struct round_work {
    double *sites, *places, *rows, *points;
    unsigned char *parts;
} round_work;

static nurbs_status round_reserve(const knot_list *list, size_t n, round_work *work)
{
    size_t intervals = list->size + (size_t)list->degree, count = list->size;
    work->sites = malloc((count + 2 * intervals) * (1 + 3 * n) * sizeof(double));
    work->parts = calloc(intervals, 1);
    if (!work->sites || !work->parts)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to fit %zu x %zu points", count, n);
    work->places = work->sites + count;
    work->rows = work->places + 2 * intervals;
    work->points = work->rows + 3 * n * count;
    return NURBS_OK;
}

/* Fills work->rows with splines and decides the parts of every span; *divided: some span needs it.
 */
static nurbs_status round_fit(const tensor_map *map, double target, const knot_list *list,
                              int direction, size_t n, const double *across, round_work *work,
                              int *divided)
{
    size_t intervals = list->size + (size_t)list->degree, count = list->size, checks = 0;
    nurbs_greville(list->degree, count, list->knots, work->sites);
    for (size_t k = 0; k < intervals; k++)
        checks += check_places(list, k, work->places + checks);
    const size_t at[2] = {direction ? n : count, direction ? count : n},
                 between[2] = {direction ? n : checks, direction ? checks : n};
    const double *const sites[2] = {direction ? across : work->sites,
                                    direction ? work->sites : across},
                        *const places[2] = {direction ? across : work->places,
                                            direction ? work->places : across};
    nurbs_status status = tensor_sample(map, direction, at, sites, work->rows);
    if (status == NURBS_OK)
        status = tensor_sample(map, direction, between, places, work->points);
    if (status == NURBS_OK)
        status = tensor_solve(list->degree, count, list->knots, work->sites, 3 * n, work->rows);
    for (size_t k = 0, c = 0; k < intervals && status == NURBS_OK; k++) {
        double error = 0;
        for (size_t last = c + check_places(list, k, NULL); c < last; c++)
            error = fmax(error,
                         row_error(list, work->places[c], n, work->rows, work->points + 3 * n * c));
        work->parts[k] = parts_for(error, target, list->degree);
        *divided |= work->parts[k] > 1;
    }
    return status;
}

static nurbs_status refine_once(const tensor_map *map, double target, knot_list *list,
                                int direction, size_t n, const double *across, int *divided)
{
    round_work work = {0};
    *divided = 0;
    nurbs_status status = round_reserve(list, n, &work);
    if (status == NURBS_OK)
        status = round_fit(map, target, list, direction, n, across, &work, divided);
    if (status == NURBS_OK && *divided)
        status = knot_list_divide(list, work.parts);
    free(work.sites);
    free(work.parts);
    return status;
}

nurbs_status tensor_refine(const tensor_map *map, double target, knot_list along[2])
{
    nurbs_status status = NURBS_OK;
    for (int direction = 1; direction >= 0 && status == NURBS_OK; direction--) {
        const knot_list *other = &along[!direction];
        double *across = malloc(other->size * sizeof *across);
        if (!across)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu parameters", other->size);
        nurbs_greville(other->degree, other->size, other->knots, across);
        int divided = 1;
        for (int round = 0; round < ROUNDS && divided && status == NURBS_OK; round++)
            status = refine_once(map, target, &along[direction], direction, other->size, across,
                                 &divided);
        free(across);
    }
    return status;
}
