#include "tangent/potential.h"

#include "core/vector_math.h"
#include "solve/linear.h"
#include "solve/potential.h"
#include "tangent/potential_wave.h"
#include "tangent/row.h"
#include "threads.h"

#include <stdlib.h>
#include <string.h>

enum { ROWS_AT_ONCE = 4 };

/* Sums of one block of fields for several rows of factors, `step` apart. */
VECTOR_MULTIVERSION
static void contract_block(size_t n, const double *factor, size_t step, const double *matrix,
                           size_t width, double sum[ROWS_AT_ONCE][FIELD_BLOCK])
{
    double s[ROWS_AT_ONCE][FIELD_BLOCK] = {{0}};
    for (size_t k = 0; k < n; k++, matrix += width)
        for (size_t r = 0; r < ROWS_AT_ONCE; r++)
            for (size_t l = 0; l < FIELD_BLOCK; l++)
                s[r][l] += factor[r * step + k] * matrix[l];
    memcpy(sum, s, sizeof s);
}

/* Adds to out[ROWS_AT_ONCE][fields] the sums of factor[n], rows of it `step` apart, over rows of
 * matrix[n][width]. */
static void contract(size_t n, const double *factor, size_t step, const double *matrix,
                     size_t width, size_t fields, double *out)
{
    for (size_t first = 0; first < fields; first += FIELD_BLOCK) {
        double sum[ROWS_AT_ONCE][FIELD_BLOCK];
        contract_block(n, factor, step, matrix + first, width, sum);
        for (size_t r = 0; r < ROWS_AT_ONCE; r++)
            for (size_t l = 0; l < FIELD_BLOCK && first + l < fields; l++)
                out[r * fields + first + l] += sum[r][l];
    }
}

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
        double *row = calloc(ROWS_AT_ONCE * width, sizeof *row);
        double *sum = malloc(ROWS_AT_ONCE * field->n * sizeof *sum);
        struct row_work *work = row_work_create(rows);
        igabem_status status = row && sum && work ? IGABEM_OK : IGABEM_ERROR_MEMORY;
#pragma omp for schedule(dynamic, 1)
        for (size_t i = 0; i < n; i += ROWS_AT_ONCE) {
            size_t count = n - i < ROWS_AT_ONCE ? n - i : ROWS_AT_ONCE;
            for (size_t r = 0; r < count && status == IGABEM_OK; r++)
                status = rows_fill(rows, i + r, work, row + r * width);
            if (status != IGABEM_OK)
                continue;
            memset(sum, 0, ROWS_AT_ONCE * field->n * sizeof *sum);
            contract(field->controls, row, width, field->net, field->width, field->n, sum);
            contract(tangent->shape->size, row + field->controls, width, tangent->change,
                     field->width, field->n, sum);
            for (size_t f = 0; f < field->n; f++)
                for (size_t r = 0; r < count; r++)
                    right[f * n + i + r] = sum[r * field->n + f];
        }
        row_work_free(work);
        free(row);
        free(sum);
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
                                 size_t n, double *right)
{
    size_t fields = tangent->field->n, hull = tangent->solution->density->n;
    double *change = NULL, *outside = NULL;
    struct rows *rows = NULL;
    igabem_status status = shape_change(tangent, tangent->shape, &change, &outside);
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

static igabem_status solve(igabem_tangent *tangent, const struct influence *influence)
{
    const igabem_solution *solution = tangent->solution;
    size_t n = potential_unknowns(solution), hull = solution->density->n;
    size_t fields = tangent->field->n;
    double *factors = NULL, *right = malloc(n * fields * sizeof *right);
    int *pivots = NULL;
    igabem_status status =
        right ? moved_sides(tangent, influence, n, right) : tangent_no_memory(fields);
    if (status == IGABEM_OK && !solution->system)
        status = potential_factors(influence, solution, &factors, &pivots);
    if (status == IGABEM_OK) {
        const struct matrix matrix = {n, n, factors ? factors : solution->system,
                                      influence->threads, NULL};
        status = linear_lu_solve(&matrix, pivots ? pivots : solution->pivots, false, fields, right);
    }
    for (size_t f = 0; f < fields && status == IGABEM_OK; f++)
        memcpy(tangent->sigma + f * hull, right + f * n, hull * sizeof *right);
    free(factors);
    free(pivots);
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

/* Changes of all numbers of a row of the Kochin function: [width of a row][width of the field]. */
static igabem_status gather_changes(const igabem_tangent *tangent, size_t numbers, double **result)
{
    const struct field *field = tangent->field;
    size_t hull = tangent->solution->density->n, width = field->width;
    double *change = *result = calloc(numbers * width, sizeof *change);
    if (!change)
        return tangent_no_memory(field->n);
    for (size_t f = 0; f < field->n; f++)
        for (size_t j = 0; j < hull; j++) {
            change[j * width + f] = tangent->sigma[f * hull + j];
            change[(hull + j) * width + f] = tangent->velocity[3 * f * hull + j];
        }
    change += 2 * hull * width;
    memcpy(change, field->net, field->controls * width * sizeof *change);
    memcpy(change + field->controls * width, tangent->change,
           tangent->shape->size * width * sizeof *change);
    return IGABEM_OK;
}

igabem_status potential_kochin(const igabem_tangent *tangent, double largest, size_t m,
                               const double *t, double (*h)[2], double (*dh)[2])
{
    const struct field *field = tangent->field;
    struct waves *waves;
    double *change = NULL;
    igabem_status status = waves_create(tangent, largest, &waves);
    if (status != IGABEM_OK)
        return status;
    size_t numbers = waves_width(waves);
    status = gather_changes(tangent, numbers, &change);
    bool failed = status != IGABEM_OK;
#pragma omp parallel reduction(| : failed)
    {
        double *row = malloc(ROWS_AT_ONCE * numbers * sizeof *row);
        double *sum = malloc(ROWS_AT_ONCE * field->n * sizeof *sum);
        struct waves_work *work = waves_work_create(waves);
        failed |= !row || !sum || !work;
#pragma omp for schedule(dynamic, 1)
        for (size_t i = 0; i < m; i += 2) {
            if (failed)
                continue;
            for (size_t k = 0; k < 2; k++) /* of an odd number the last one twice */
                waves_row(waves, t[i + k < m ? i + k : i], work, h[i + k < m ? i + k : i],
                          row + 2 * k * numbers);
            memset(sum, 0, ROWS_AT_ONCE * field->n * sizeof *sum);
            contract(numbers, row, numbers, change, field->width, field->n, sum);
            for (size_t f = 0; f < field->n; f++)
                for (size_t k = 0; k < 4 && i + k / 2 < m; k++)
                    dh[f * m + i + k / 2][k % 2] = sum[k * field->n + f];
        }
        waves_work_free(work);
        free(row);
        free(sum);
    }
    free(change);
    waves_free(waves);
    return failed ? tangent_no_memory(field->n) : IGABEM_OK;
}
