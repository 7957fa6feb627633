/* The density's tangents: A sigma' = U n_x' - n'.v - n.(A' sigma), and those of the velocities. */
#include "core/error.h"
#include "solve/assemble.h"
#include "solve/formulation.h"
#include "solve/linear.h"
#include "solve/setting.h"
#include "tangent/change.h"
#include "threads.h"

#include <stdlib.h>
#include <string.h>

/* Values of `count` fields at the collocation points: fills value[unknowns][count]. */
static igabem_status at_points(const struct density *density, size_t count,
                               const double *coefficients, double *value)
{
    igabem_status status = IGABEM_OK;
    for (size_t p = 0; p < density->patches && status == IGABEM_OK; p++) {
        const struct density_patch *patch = &density->patch[p];
        size_t n = patch->size[0] * patch->size[1];
        status = density_evaluate(density, p, count, coefficients, n, density->uv[patch->offset],
                                  value + count * patch->offset);
    }
    return status;
}

/* What the waves add to them. */
static igabem_status change_waves(const struct change *change, const double *weight,
                                  double *velocity)
{
    const igabem_solution *solution = change->tangent->solution;
    struct line *line = NULL;
    igabem_status status = IGABEM_OK;
    if (solution->options.line_term)
        status = line_create(solution->density, change->influence->mesh,
                             solution->options.stem_limit, &line);
    if (status == IGABEM_OK)
        status = change_local(change, line, weight, velocity);
    if (status == IGABEM_OK)
        status = change_wave(change, line, weight, velocity);
    line_free(line);
    return status;
}

/* What the moves do to the velocities of the solution's sources at the points, which move too:
 * fills velocity[unknowns][3][fields]. */
static igabem_status change_velocities(igabem_tangent *tangent, const struct influence *influence,
                                       double *velocity)
{
    const igabem_solution *solution = tangent->solution;
    size_t n = solution->density->n;
    double *bernstein = NULL, *image = malloc(2 * n * sizeof *image);
    struct rules *rules = NULL;
    igabem_status status =
        image ? moving_density(tangent, &bernstein) : tangent_no_memory(tangent->field->n);
    if (status == IGABEM_OK)
        status = rules_create(influence, &rules);
    for (size_t i = 0; i < n && status == IGABEM_OK; i++) {
        image[n + i] = solution_wave_share(solution, solution->density->point[3 * i]);
        image[i] = 2.0 * image[n + i] - 1.0;
    }
    const struct change change = {tangent, influence, bernstein, rules};
    if (status == IGABEM_OK)
        status = change_rankine(&change, image, velocity);
    if (status == IGABEM_OK && formulation_has_waves(&solution->options))
        status = change_waves(&change, image + n, velocity);
    rules_free(rules);
    free(bernstein);
    free(image);
    return status;
}

/* Right-hand sides [fields][unknowns]. */
static igabem_status right_sides(const igabem_tangent *tangent, const double *change, double *right)
{
    const igabem_solution *solution = tangent->solution;
    const struct density *density = solution->density;
    size_t n = density->n, fields = tangent->field->n;
    double *v = malloc(3 * n * sizeof *v);
    igabem_status status =
        v ? at_points(density, 3, solution->velocity, v) : tangent_no_memory(fields);
    for (size_t f = 0; f < fields && status == IGABEM_OK; f++)
        for (size_t i = 0; i < n; i++) {
            const double *turned = tangent->normal + 3 * (f * n + i);
            const double *normal = density->normal + 3 * i;
            double sum = solution->speed * turned[0];
            for (size_t c = 0; c < 3; c++)
                sum -= turned[c] * v[3 * i + c] + normal[c] * change[(3 * i + c) * fields + f];
            right[f * n + i] = sum;
        }
    free(v);
    return status;
}

/* On the fluid side v = A sigma + sigma/2 n, of which `right` is A sigma' + sigma'/2 along n. */
static igabem_status velocity_tangents(igabem_tangent *tangent, const struct influence *influence,
                                       const double *rows, const double *change,
                                       const double *right)
{
    const igabem_solution *solution = tangent->solution;
    const struct density *density = solution->density;
    size_t n = density->n, fields = tangent->field->n;
    double *sigma = malloc(n * sizeof *sigma);
    igabem_status status =
        sigma ? at_points(density, 1, solution->sigma, sigma) : tangent_no_memory(fields);
    for (size_t f = 0; f < fields && status == IGABEM_OK; f++) {
        double *v = tangent->velocity + 3 * n * f;
        assemble_velocity(influence, rows, right + f * n, tangent->sigma + f * n, v);
        for (size_t i = 0; i < n; i++)
            for (size_t c = 0; c < 3; c++)
                v[c * n + i] += change[(3 * i + c) * fields + f] +
                                0.5 * sigma[i] * tangent->normal[3 * (f * n + i) + c];
    }
    free(sigma);
    return status == IGABEM_OK ? density_interpolate(density, 3 * fields, tangent->velocity)
                               : status;
}

static igabem_status solve(igabem_tangent *tangent, const struct influence *influence,
                           double *matrix, double *rows, double *change, double *right)
{
    const igabem_solution *solution = tangent->solution;
    size_t n = solution->density->n, fields = tangent->field->n;
    igabem_status status = IGABEM_OK;
    if (solution->system)
        rows = solution->system;
    else
        status = setting_system(influence, solution, rows);
    if (status == IGABEM_OK)
        status = change_velocities(tangent, influence, change);
    if (status == IGABEM_OK)
        status = right_sides(tangent, change, right);
    if (status != IGABEM_OK)
        return status;
    const struct matrix system = {n, n, matrix, influence->threads, NULL};
    for (size_t i = 0; i < n; i++)
        memcpy(matrix + i * n, rows + 3 * n * i, n * sizeof *matrix);
    memcpy(tangent->sigma, right, fields * n * sizeof *right);
    status = linear_lu_many(&system, fields, tangent->sigma, NULL);
    if (status == IGABEM_OK)
        status = velocity_tangents(tangent, influence, rows, change, right);
    return status;
}

igabem_status tangent_solve(igabem_tangent *tangent)
{
    const igabem_solution *solution = tangent->solution;
    size_t n = solution->density->n, fields = tangent->field->n;
    struct influence *influence = NULL;
    double *matrix = malloc(n * n * sizeof *matrix);
    double *rows = solution->system ? NULL : malloc(3 * n * n * sizeof *rows);
    double *change = calloc(3 * n * fields, sizeof *change);
    double *right = malloc(n * fields * sizeof *right);
    tangent->velocity = malloc(3 * n * fields * sizeof *tangent->velocity);
    igabem_status status = tangent_no_memory(fields);
    if (matrix && (rows || solution->system) && change && right && tangent->velocity)
        status = influence_create(solution->density, tangent->mesh, solution->options.tolerance,
                                  threads_at_hand(), &influence);
    if (status == IGABEM_OK)
        status = solve(tangent, influence, matrix, rows, change, right);
    influence_free(influence);
    free(matrix);
    free(rows);
    free(change);
    free(right);
    return status;
}
