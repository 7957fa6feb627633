#include "tangent/potential.h"

#include "exterior/base_flow.h"
#include "exterior/operator.h"
#include "solve/linear.h"
#include "solve/potential.h"
#include "tangent/base_change.h"
#include "tangent/contract.h"
#include "tangent/potential_wave.h"
#include "tangent/row.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* (b - A q)' of all rows but for what the operators on the surface add: fills
 * right[fields][unknowns]. */
static igabem_status right_sides(const igabem_tangent *tangent, const struct rows *rows, size_t n,
                                 int threads, double *right)
{
    const struct field *field = tangent->field;
    size_t width = rows_width(rows);
    igabem_status result = IGABEM_OK;
#pragma omp parallel num_threads(threads)
    {
        double *row = calloc(CONTRACT_ROWS * width, sizeof *row);
        double *sum = malloc(CONTRACT_ROWS * field->n * sizeof *sum);
        double *point = calloc(CONTRACT_ROWS * field->points, sizeof *point);
        struct row_work *work = row_work_create(rows);
        igabem_status status = row && sum && point && work ? IGABEM_OK : IGABEM_ERROR_MEMORY;
#pragma omp for schedule(dynamic, 1)
        for (size_t i = 0; i < n; i += CONTRACT_ROWS) {
            size_t count = n - i < CONTRACT_ROWS ? n - i : CONTRACT_ROWS;
            for (size_t r = 0; r < count && status == IGABEM_OK; r++) {
                status = rows_fill(rows, i + r, work, row + r * width);
                field_points_of(field, row + r * width, point + r * field->points);
            }
            if (status != IGABEM_OK)
                continue;
            memset(sum, 0, CONTRACT_ROWS * field->n * sizeof *sum);
            contract(field->points, point, field->points, field->point, field->width, field->n,
                     sum);
            contract(tangent->shape->size, row + field->controls, width, tangent->change,
                     field->width, field->n, sum);
            for (size_t f = 0; f < field->n; f++)
                for (size_t r = 0; r < count; r++)
                    right[f * n + i + r] = sum[r * field->n + f];
        }
        row_work_free(work);
        free(row);
        free(sum);
        free(point);
#pragma omp critical(igabem_potential_tangent)
        if (status != IGABEM_OK)
            result = status;
    }
    return result == IGABEM_OK ? result : tangent_no_memory(field->n);
}

/* [n][fields] with rows as wide as those of the field. */
static double *widen(size_t n, const struct field *field, const double *from)
{
    double *to = calloc(n * field->width + 1, sizeof *to);
    for (size_t k = 0; k < n && to; k++)
        memcpy(to + k * field->width, from + k * field->n, field->n * sizeof *to);
    return to;
}

static igabem_status moved_sides(igabem_tangent *tangent, const struct influence *influence,
                                 size_t n, const double *base, double *right)
{
    size_t fields = tangent->field->n, hull = tangent->solution->density->n;
    double *change = NULL, *outside = NULL;
    struct rows *rows = NULL;
    igabem_status status = shape_change(tangent, tangent->shape, base, &change, &outside);
    if (status == IGABEM_OK)
        status = rows_create(tangent, tangent->shape, influence, &rows);
    if (status == IGABEM_OK) {
        tangent->change = widen(tangent->shape->size, tangent->field, change);
        status = tangent->change ? right_sides(tangent, rows, n, influence->threads, right)
                                 : tangent_no_memory(fields);
    }
    for (size_t i = hull; i < n && status == IGABEM_OK; i++)
        for (size_t f = 0; f < fields; f++)
            right[f * n + i] += outside[(i - hull) * fields + f];
    rows_free(rows);
    free(change);
    free(outside);
    return status;
}

/* Of v . S_s = phi_s, v . S_t = phi_t and v . n = U n_x at the collocation points, v that of the
 * solution: v' . S_s = phi_s' - v_y V_s and so on. */
static void point_velocities(igabem_tangent *tangent, const double *v, double *move)
{
    const igabem_solution *solution = tangent->solution;
    const struct density *density = solution->density;
    size_t n = density->n, fields = tangent->field->n;
    for (size_t i = 0; i < n; i++) {
        size_t e = tangent->mesh->patch_base[density->owner[i]];
        double local[2];
        while (!element_contains(density, &tangent->mesh->element[e], i, local))
            e++;
        const struct element *element = &tangent->mesh->element[e];
        const double *normal = density->normal + 3 * i;
        struct jet jet;
        element_jet(element, local[0], local[1], &jet);
        field_at(tangent->field, element, local, move);
        double a = 0.0, b = 0.0, d = 0.0;
        for (size_t c = 0; c < 3; c++) {
            a += jet.ds[c] * jet.ds[c];
            b += jet.ds[c] * jet.dt[c];
            d += jet.dt[c] * jet.dt[c];
        }
        double det = a * d - b * b;
        for (size_t f = 0; f < fields; f++) {
            const double *turned = tangent->normal + 3 * (f * n + i);
            double slope[2], across = solution->speed * turned[0];
            element_slope(element, tangent->sigma + f * n, local, slope);
            slope[0] -= v[3 * i + 1] * move[fields + f];
            slope[1] -= v[3 * i + 1] * move[2 * fields + f];
            double p = (d * slope[0] - b * slope[1]) / det;
            double q = (a * slope[1] - b * slope[0]) / det;
            for (size_t c = 0; c < 3; c++)
                across -= turned[c] * v[3 * i + c];
            for (size_t c = 0; c < 3; c++)
                tangent->velocity[(3 * f + c) * n + i] =
                    p * jet.ds[c] + q * jet.dt[c] + across * normal[c];
        }
    }
}

static igabem_status velocities(igabem_tangent *tangent)
{
    const igabem_solution *solution = tangent->solution;
    const struct density *density = solution->density;
    size_t n = density->n, fields = tangent->field->n;
    double *v = malloc(3 * n * sizeof *v), *move = malloc(3 * fields * sizeof *move);
    igabem_status status = v && move ? IGABEM_OK : tangent_no_memory(fields);
    for (size_t p = 0; p < density->patches && status == IGABEM_OK; p++) {
        const struct density_patch *patch = &density->patch[p];
        status =
            density_evaluate(density, p, 3, solution->velocity, patch->size[0] * patch->size[1],
                             density->uv[patch->offset], v + 3 * patch->offset);
    }
    if (status == IGABEM_OK) {
        point_velocities(tangent, v, move);
        status = density_interpolate(density, 3 * fields, tangent->velocity);
    }
    free(v);
    free(move);
    return status;
}

/* What the cells of a double model radiate, given the changes of all unknowns, [fields][n]. */
static igabem_status radiation(igabem_tangent *tangent, size_t n, const double *unknowns,
                               const double *base)
{
    const igabem_solution *solution = tangent->solution;
    const struct free_surface *surface = solution->surface;
    size_t fields = tangent->field->n, hull = solution->density->n;
    size_t cells = surface->nx * surface->ny;
    struct sparse edge;
    igabem_status status = operator_edge(surface, solution->density, tangent->mesh, &edge);
    if (status != IGABEM_OK)
        return status;
    double *phi = calloc((cells + edge.rows) * fields + 1, sizeof *phi);
    for (size_t f = 0; f < fields && phi; f++) {
        const double *own = unknowns + f * n;
        for (size_t c = 0; c < cells; c++)
            phi[c * fields + f] = own[hull + c];
        for (size_t k = 0; k < edge.rows; k++)
            for (size_t l = edge.start[k]; l < edge.start[k + 1]; l++)
                phi[(cells + k) * fields + f] += edge.value[l] * own[edge.column[l]];
    }
    status = phi ? shape_cells(tangent, phi, base, &tangent->cells) : tangent_no_memory(fields);
    free(phi);
    sparse_free(&edge);
    return status;
}

static igabem_status solve(igabem_tangent *tangent, const struct influence *influence)
{
    const igabem_solution *solution = tangent->solution;
    size_t n = potential_unknowns(solution), hull = solution->density->n;
    size_t fields = tangent->field->n;
    double *factors = NULL, *base = NULL, *right = malloc(n * fields * sizeof *right);
    int *pivots = NULL;
    igabem_status status = right ? IGABEM_OK : tangent_no_memory(fields);
    if (status == IGABEM_OK && solution->base)
        status = base_change(tangent, tangent->shape, influence, &base);
    if (status == IGABEM_OK)
        status = moved_sides(tangent, influence, n, base, right);
    if (status == IGABEM_OK && !solution->system)
        status = potential_factors(influence, solution, &factors, &pivots);
    if (status == IGABEM_OK) {
        const struct matrix matrix = {n, n, factors ? factors : solution->system,
                                      influence->threads, NULL};
        status = linear_lu_solve(&matrix, pivots ? pivots : solution->pivots, false, fields, right);
    }
    for (size_t f = 0; f < fields && status == IGABEM_OK; f++)
        memcpy(tangent->sigma + f * hull, right + f * n, hull * sizeof *right);
    if (status == IGABEM_OK && solution->base)
        status = radiation(tangent, n, right, base);
    free(factors);
    free(pivots);
    free(base);
    free(right);
    return status;
}

igabem_status potential_tangent(igabem_tangent *tangent)
{
    const igabem_solution *solution = tangent->solution;
    size_t n = solution->density->n, fields = tangent->field->n;
    struct influence *influence = NULL;
    tangent->velocity = malloc(3 * n * fields * sizeof *tangent->velocity);
    tangent->shape = malloc(sizeof *tangent->shape);
    if (!tangent->velocity || !tangent->shape)
        return tangent_no_memory(fields);
    shape_place(solution, tangent->shape);
    igabem_status status =
        influence_create(solution->density, tangent->mesh, solution->options.tolerance,
                         threads_at_hand(), &influence);
    if (status == IGABEM_OK)
        status = solve(tangent, influence);
    if (status == IGABEM_OK)
        status = velocities(tangent);
    influence_free(influence);
    return status;
}

/* Changes of phi and phi_x on the hull, [2][n][width of the field]. */
static double *gather_changes(const igabem_tangent *tangent)
{
    const struct field *field = tangent->field;
    size_t hull = tangent->solution->density->n, width = field->width;
    double *change = calloc(2 * hull * width, sizeof *change);
    for (size_t f = 0; f < field->n && change; f++)
        for (size_t j = 0; j < hull; j++) {
            change[j * width + f] = tangent->sigma[f * hull + j];
            change[(hull + j) * width + f] = tangent->velocity[3 * f * hull + j];
        }
    return change;
}

/* What the cells of a double model radiate, F = (q - m.grad) E of each part on z = 0: adds to h[2],
 * fills row[2][SHAPE_CELL parts]. */
static void cells_row(const igabem_solution *solution, double t, double h[2], double *row)
{
    size_t parts = BASE_FLOW_SIDE * BASE_FLOW_SIDE * solution->surface->nx * solution->surface->ny;
    double k = solution->k0 * sqrt(1.0 + t * t), b = k * t;
    for (size_t p = 0; p < parts; p++) {
        const double *part = solution->cell_source[p];
        double e = 2.0 * cos(b * part[1]), o = 2.0 * sin(b * part[1]);
        const double wave[2] = {cos(k * part[0]), sin(k * part[0])};
        double q = part[3], mx = part[4], my = part[5];
        for (size_t r = 0; r < 2; r++) {
            double c = wave[r], s = r ? -wave[0] : wave[1];
            double *to = row + SHAPE_CELL * (r * parts + p);
            h[r] += (q * e + b * my * o) * c + k * mx * e * s;
            to[0] = (b * b * my * e - b * q * o) * c - k * b * mx * o * s;
            to[1] = e * c;
            to[2] = k * e * s;
            to[3] = b * o * c;
        }
    }
}

igabem_status potential_kochin(const igabem_tangent *tangent, double largest, size_t m,
                               const double *t, double (*h)[2], double (*dh)[2])
{
    const struct field *field = tangent->field;
    const igabem_solution *solution = tangent->solution;
    size_t cells = 0;
    struct waves *waves;
    igabem_status status = waves_create(tangent, largest, &waves);
    if (status != IGABEM_OK)
        return status;
    if (tangent->cells)
        cells = SHAPE_CELL * BASE_FLOW_SIDE * BASE_FLOW_SIDE * solution->surface->nx *
                solution->surface->ny;
    size_t numbers = waves_width(waves), own = 2 * solution->density->n;
    double *change = gather_changes(tangent);
    bool failed = !change;
#pragma omp parallel reduction(| : failed)
    {
        double *row = calloc(CONTRACT_ROWS * numbers, sizeof *row);
        double *sum = malloc(CONTRACT_ROWS * field->n * sizeof *sum);
        double *cell = calloc(CONTRACT_ROWS * cells + 1, sizeof *cell);
        double *point = malloc(CONTRACT_ROWS * field->points * sizeof *point);
        struct waves_work *work = waves_work_create(waves);
        failed |= !row || !sum || !cell || !point || !work;
#pragma omp for schedule(dynamic, 1)
        for (size_t i = 0; i < m; i += 2) {
            if (failed)
                continue;
            memset(sum, 0, CONTRACT_ROWS * field->n * sizeof *sum);
            for (size_t k = 0; k < 2 && i + k < m; k++) {
                waves_row(waves, t[i + k], work, h[i + k], row + 2 * k * numbers);
                if (cells)
                    cells_row(solution, t[i + k], h[i + k], cell + 2 * k * cells);
            }
            for (size_t r = 0; r < CONTRACT_ROWS; r++)
                field_points_of(field, row + r * numbers + own, point + r * field->points);
            contract(own, row, numbers, change, field->width, field->n, sum);
            contract(field->points, point, field->points, field->point, field->width, field->n,
                     sum);
            contract(tangent->shape->size, row + own + field->controls, numbers, tangent->change,
                     field->width, field->n, sum);
            if (cells)
                contract(cells, cell, cells, tangent->cells, field->width, field->n, sum);
            for (size_t f = 0; f < field->n; f++)
                for (size_t k = 0; k < 4 && i + k / 2 < m; k++)
                    dh[f * m + i + k / 2][k % 2] = sum[k * field->n + f];
        }
        waves_work_free(work);
        free(row);
        free(sum);
        free(cell);
        free(point);
    }
    free(change);
    waves_free(waves);
    return failed ? tangent_no_memory(field->n) : IGABEM_OK;
}
