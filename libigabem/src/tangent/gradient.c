/* C_w by every control point of the hull: from the waves back to the solution, through the
 * transposed system back to its rows, from these to the numbers that the shape enters them by, and
 * from those to the control points. */
#include "core/error.h"
#include "result/amplitude.h"
#include "result/kochin.h"
#include "result/radiation.h"
#include "solve/linear.h"
#include "solve/potential.h"
#include "tangent/fold.h"
#include "tangent/potential_wave.h"
#include "tangent/row.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FIELDS_AT_ONCE = 48 }; /* control points whose moves are at hand together */

struct gradient {
    igabem_tangent tangent; /* along a field that stays still: mesh, elements, shape */
    struct influence *influence;
    double cw;
    size_t unknowns;
    double *hull;   /* [n] what phi on the hull counts for */
    double *flow;   /* [n] phi_x there */
    double *number; /* control values of the elements, then struct shape */
    double *row;    /* [unknowns] the rows of the system */
};

static igabem_status no_memory(void)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a gradient");
}

static void add(size_t n, double factor, const double *from, double *to)
{
    for (size_t k = 0; k < n; k++)
        to[k] += factor * from[k];
}

/* Sums of `count` threads, in their order. */
static void add_up(size_t count, size_t n, const double *parts, double *to)
{
    for (size_t p = 0; p < count; p++)
        add(n, 1.0, parts + p * n, to);
}

/* Sum over wave angles of factor 2 Re(conj(H) H'), row by row of H'; C_w. */
static igabem_status sum_waves(const struct waves *waves, size_t m, const double *t,
                               const double *factor, size_t threads, double *sum, double *cw)
{
    size_t width = waves_width(waves);
    double *parts = calloc(threads * (width + 1), sizeof *parts);
    bool failed = !parts;
#pragma omp parallel num_threads((int)threads) reduction(| : failed)
    {
        double *row = malloc(2 * width * sizeof *row), h[2];
        struct waves_work *work = waves_work_create(waves);
        failed |= !row || !work;
#pragma omp for schedule(static, 1)
        for (size_t p = 0; p < threads; p++)
            for (size_t i = p; i < m && !failed; i += threads) {
                double *to = parts + p * (width + 1);
                waves_row(waves, t[i], work, h, row);
                for (size_t k = 0; k < 2; k++)
                    add(width, 2.0 * factor[i] * h[k], row + k * width, to);
                to[width] += factor[i] * (h[0] * h[0] + h[1] * h[1]);
            }
        waves_work_free(work);
        free(row);
    }
    if (!failed)
        for (size_t p = 0; p < threads; p++) {
            add(width, 1.0, parts + p * (width + 1), sum);
            *cw += parts[p * (width + 1) + width];
        }
    free(parts);
    return failed ? no_memory() : IGABEM_OK;
}

static igabem_status from_waves(struct gradient *gradient)
{
    const igabem_tangent *tangent = &gradient->tangent;
    const igabem_solution *solution = tangent->solution;
    size_t m = 0, n = solution->density->n;
    double limit = radiation_limit(solution), *t = NULL, *weight = NULL, *sum = NULL, length, beam;
    struct waves *waves = NULL;
    radiation_extent(solution, &length, &beam);
    igabem_status status = amplitude_rule(solution->k0, length, beam, limit,
                                          radiation_cutoff_angle(solution), &m, &t, &weight);
    if (status == IGABEM_OK)
        status = waves_create(tangent, limit, &waves);
    for (size_t i = 0; i < m && status == IGABEM_OK; i++) /* both signs of t */
        weight[i] *= 2.0 * kochin_coefficient(solution) * sqrt(1.0 + t[i] * t[i]);
    if (status == IGABEM_OK) {
        sum = calloc(waves_width(waves), sizeof *sum);
        status = sum ? sum_waves(waves, m, t, weight, (size_t)gradient->influence->threads, sum,
                                 &gradient->cw)
                     : no_memory();
    }
    if (status == IGABEM_OK) {
        memcpy(gradient->hull, sum, n * sizeof *sum);
        memcpy(gradient->flow, sum + n, n * sizeof *sum);
        memcpy(gradient->number, sum + 2 * n, (waves_width(waves) - 2 * n) * sizeof *sum);
    }
    waves_free(waves);
    free(t);
    free(weight);
    free(sum);
    return status;
}

/* The transpose of density_interpolate(): what values at the collocation points count for, from
 * what coefficients do. */
static igabem_status to_points(const struct density *density, double *values)
{
    size_t n = density->n;
    double *unit = calloc(n * n, sizeof *unit);
    igabem_status status = unit ? IGABEM_OK : no_memory();
    for (size_t i = 0; i < n && unit; i++)
        unit[i * n + i] = 1.0;
    if (status == IGABEM_OK)
        status = density_interpolate(density, n, unit);
    double *sum = calloc(n, sizeof *sum);
    if (status == IGABEM_OK && !sum)
        status = no_memory();
    for (size_t i = 0; i < n && status == IGABEM_OK; i++)
        for (size_t k = 0; k < n; k++)
            sum[i] += unit[i * n + k] * values[k];
    if (status == IGABEM_OK)
        memcpy(values, sum, n * sizeof *sum);
    free(sum);
    free(unit);
    return status;
}

/* Adds what slopes of phi along the parameters count for to the coefficients of phi. */
static void scatter_slope(const struct element *element, const double local[2],
                          const double slope[2], double *row)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    double bu[ELEMENT_SIDE], du[ELEMENT_SIDE], bv[ELEMENT_SIDE], dv[ELEMENT_SIDE];
    double moment[ELEMENT_FUNCTIONS], w[3] = {0.0, 0.0, 0.0};
    bernstein(element->degree[0], local[0], bu, du);
    bernstein(element->degree[1], local[1], bv, dv);
    for (size_t k = 0; k < m * n; k++) {
        double weight = element->rational ? element->net[4 * k + 3] : 1.0;
        w[0] += bu[k / n] * bv[k % n] * weight;
        w[1] += du[k / n] * bv[k % n] * weight;
        w[2] += bu[k / n] * dv[k % n] * weight;
    }
    double still = -(slope[0] * w[1] + slope[1] * w[2]) / (w[0] * w[0]);
    for (size_t k = 0; k < m * n; k++)
        moment[k] = still * bu[k / n] * bv[k % n] +
                    (slope[0] * du[k / n] * bv[k % n] + slope[1] * bu[k / n] * dv[k % n]) / w[0];
    element_scatter(element, 1, moment, row, 0);
}

/* phi_x at a collocation point (potential.c, point_velocities()), whose value counts for `value`.
 */
static void from_velocity(struct gradient *gradient, size_t i, double value)
{
    const igabem_tangent *tangent = &gradient->tangent;
    const igabem_solution *solution = tangent->solution;
    const struct density *density = solution->density;
    const double *normal = density->normal + 3 * i;
    size_t e = tangent->mesh->patch_base[density->owner[i]];
    double local[2], phi[2], a = 0.0, b = 0.0, d = 0.0, v[3], along = 0.0;
    while (!element_contains(density, &tangent->mesh->element[e], i, local))
        e++;
    const struct element *element = &tangent->mesh->element[e];
    struct jet jet;
    struct area_change area;
    element_jet(element, local[0], local[1], &jet);
    area_change(jet.ds, jet.dt, element->sign, &area);
    element_slope(element, solution->sigma, local, phi);
    for (size_t c = 0; c < 3; c++) {
        a += jet.ds[c] * jet.ds[c];
        b += jet.ds[c] * jet.dt[c];
        d += jet.dt[c] * jet.dt[c];
    }
    double det = a * d - b * b, p = (d * phi[0] - b * phi[1]) / det;
    double q = (a * phi[1] - b * phi[0]) / det;
    for (size_t c = 0; c < 3; c++)
        v[c] = p * jet.ds[c] + q * jet.dt[c] + solution->speed * normal[0] * normal[c];
    const double slope[2] = {value * (d * jet.ds[0] - b * jet.dt[0]) / det,
                             value * (a * jet.dt[0] - b * jet.ds[0]) / det};
    scatter_slope(element, local, slope, gradient->hull);
    /* n_x (U n_x' - v . n'), n' = (a' - n (n . a'))/|a| */
    double turn[3] = {value * normal[0] * (solution->speed - v[0]), -value * normal[0] * v[1],
                      -value * normal[0] * v[2]};
    for (size_t c = 0; c < 3; c++)
        along += turn[c] * normal[c];
    double counts[2] = {-v[1] * slope[0], -v[1] * slope[1]}; /* V_s and V_t */
    for (size_t k = 0; k < 2; k++)
        for (size_t c = 0; c < 3; c++)
            counts[k] += (turn[c] - along * normal[c]) * area.vector[k][c] / area.size;
    fold_point(element, local, 0.0, counts, gradient->number + tangent->field->offset[e]);
}

/* The rows of the system from its unknowns: transposed. */
static igabem_status through_system(struct gradient *gradient)
{
    const igabem_solution *solution = gradient->tangent.solution;
    size_t n = gradient->unknowns;
    double *factors = NULL;
    int *pivots = NULL;
    igabem_status status = IGABEM_OK;
    memcpy(gradient->row, gradient->hull, solution->density->n * sizeof *gradient->row);
    if (!solution->system)
        status = potential_factors(gradient->influence, solution, &factors, &pivots);
    if (status == IGABEM_OK) {
        const struct matrix matrix = {n, n, factors ? factors : solution->system,
                                      gradient->influence->threads, NULL};
        status =
            linear_lu_solve(&matrix, pivots ? pivots : solution->pivots, true, 1, gradient->row);
    }
    free(factors);
    free(pivots);
    return status;
}

static igabem_status from_rows(struct gradient *gradient)
{
    struct rows *rows;
    igabem_status result =
        rows_create(&gradient->tangent, gradient->tangent.shape, gradient->influence, &rows);
    if (result != IGABEM_OK)
        return result;
    size_t width = rows_width(rows), threads = (size_t)gradient->influence->threads;
    size_t n = gradient->unknowns;
    double *parts = calloc(threads * width, sizeof *parts);
    result = parts ? IGABEM_OK : no_memory();
#pragma omp parallel num_threads((int)threads)
    {
        double *row = malloc(width * sizeof *row);
        struct row_work *work = row_work_create(rows);
        igabem_status status = row && work ? result : IGABEM_ERROR_MEMORY;
#pragma omp for schedule(static, 1)
        for (size_t p = 0; p < threads; p++)
            for (size_t i = p; i < n && status == IGABEM_OK; i += threads) {
                status = rows_fill(rows, i, work, row);
                add(width, gradient->row[i], row, parts + p * width);
            }
        row_work_free(work);
        free(row);
#pragma omp critical(igabem_gradient)
        if (status != IGABEM_OK)
            result = status;
    }
    if (result == IGABEM_OK)
        add_up(threads, width, parts, gradient->number);
    free(parts);
    rows_free(rows);
    return result == IGABEM_OK ? result : no_memory();
}

/* The control points of one batch: fills out[n]. */
static igabem_status from_points(const struct gradient *gradient, const igabem_hull *hull, size_t n,
                                 const double *move, double *out)
{
    const igabem_solution *solution = gradient->tangent.solution;
    igabem_tangent tangent = gradient->tangent;
    size_t hull_unknowns = solution->density->n, rest = gradient->unknowns - hull_unknowns;
    double *change = NULL, *outside = NULL, area = solution->info.hydrostatics.wetted_area;
    igabem_status status =
        field_make(hull, solution->density, tangent.mesh, n, move, &tangent.field);
    tangent.area = calloc(n, sizeof *tangent.area);
    if (status == IGABEM_OK)
        status = tangent.area ? tangent_area(&tangent) : no_memory();
    if (status == IGABEM_OK)
        status = shape_change(&tangent, tangent.shape, NULL, &change, &outside);
    for (size_t f = 0; f < n && status == IGABEM_OK; f++) {
        const struct field *field = tangent.field;
        double sum = -gradient->cw * tangent.area[f] / area;
        for (size_t k = 0; k < field->controls; k++)
            sum += gradient->number[k] * field->net[k * field->width + f];
        for (size_t k = 0; k < tangent.shape->size; k++)
            sum += gradient->number[field->controls + k] * change[k * n + f];
        for (size_t k = 0; k < rest; k++)
            sum += gradient->row[hull_unknowns + k] * outside[k * n + f];
        out[f] = sum;
    }
    free(change);
    free(outside);
    free(tangent.area);
    field_free(tangent.field);
    return status;
}

/* Those in the centre plane stay there. */
static igabem_status to_control_points(const struct gradient *gradient, const igabem_hull *hull,
                                       double *out)
{
    size_t points = field_points(hull);
    double *move = calloc(3 * FIELDS_AT_ONCE * points, sizeof *move);
    igabem_status status = move ? IGABEM_OK : no_memory();
    for (size_t first = 0; first < points && status == IGABEM_OK; first += FIELDS_AT_ONCE) {
        size_t n = points - first < FIELDS_AT_ONCE ? points - first : FIELDS_AT_ONCE;
        for (size_t f = 0; f < n; f++)
            move[3 * (f * points + first + f) + 1] = 1.0;
        status = from_points(gradient, hull, n, move, out + first);
        for (size_t f = 0; f < n; f++)
            move[3 * (f * points + first + f) + 1] = 0.0;
    }
    free(move);
    if (status == IGABEM_OK)
        field_hold(hull, out);
    return status;
}

static igabem_status fill(struct gradient *gradient, const igabem_hull *hull, double *out)
{
    igabem_tangent *tangent = &gradient->tangent;
    const igabem_solution *solution = tangent->solution;
    size_t n = solution->density->n;
    double *still = calloc(3 * field_points(hull), sizeof *still);
    igabem_status status = still ? mesh_create(solution->density, &tangent->mesh) : no_memory();
    if (status == IGABEM_OK)
        status = field_create(hull, solution->density, tangent->mesh, 1, still, &tangent->field);
    free(still);
    if (status == IGABEM_OK)
        status = influence_create(solution->density, tangent->mesh, solution->options.tolerance,
                                  threads_at_hand(), &gradient->influence);
    if (status != IGABEM_OK)
        return status;
    tangent->shape = malloc(sizeof *tangent->shape);
    if (!tangent->shape)
        return no_memory();
    shape_place(solution, tangent->shape);
    gradient->unknowns = potential_unknowns(solution);
    gradient->hull = calloc(n, sizeof(double));
    gradient->flow = calloc(n, sizeof(double));
    gradient->row = calloc(gradient->unknowns, sizeof(double));
    gradient->number = calloc(tangent->field->controls + tangent->shape->size, sizeof(double));
    if (!gradient->hull || !gradient->flow || !gradient->row || !gradient->number)
        return no_memory();
    status = from_waves(gradient);
    if (status == IGABEM_OK)
        status = to_points(solution->density, gradient->flow);
    for (size_t i = 0; i < n && status == IGABEM_OK; i++)
        from_velocity(gradient, i, gradient->flow[i]);
    if (status == IGABEM_OK)
        status = through_system(gradient);
    if (status == IGABEM_OK)
        status = from_rows(gradient);
    return status == IGABEM_OK ? to_control_points(gradient, hull, out) : status;
}

igabem_status igabem_cw_gradient(const igabem_hull *hull, const igabem_solution *solution,
                                 double *dcw)
{
    if (!hull || !solution || !dcw)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_cw_gradient");
    igabem_status status = tangent_check(solution);
    if (status == IGABEM_OK && (!solution->potential || solution->base))
        status = igabem_fail(IGABEM_ERROR_ARGUMENT,
                             "formulation %s has no gradient but tangents along fields, expected "
                             "exterior",
                             solution->formulation->name);
    if (status != IGABEM_OK)
        return status;
    THREADS(solution->options.threads);
    struct gradient gradient = {.tangent = {.solution = solution}};
    status = fill(&gradient, hull, dcw);
    influence_free(gradient.influence);
    field_free(gradient.tangent.field);
    mesh_free(gradient.tangent.mesh);
    free(gradient.tangent.shape);
    free(gradient.hull);
    free(gradient.flow);
    free(gradient.number);
    free(gradient.row);
    return status;
}
