#include "solve/solution.h"

#include "core/error.h"
#include "exterior/free_surface.h"
#include "exterior/transom.h"
#include "solve/formulation.h"

#include <math.h>
#include <stdlib.h>

igabem_status solution_no_memory(size_t n)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for influences of %zu unknowns", n);
}

igabem_status solution_create(const igabem_hull *hull, const igabem_options *options,
                              igabem_solution **result)
{
    igabem_solution *solution = calloc(1, sizeof *solution);
    if (!solution)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a solution");
    *result = solution;
    solution->options = *options;
    igabem_status status = igabem_options_freeze(hull, &solution->options);
    if (status != IGABEM_OK)
        return status;
    solution->formulation = igabem_formulation_info(solution->options.formulation);
    igabem_hull_get_info(hull, &solution->info);
    solution->x_aft = hull->hydrostatics.x_aft;
    solution->x_fore = hull->hydrostatics.x_fore;
    solution->waves = options->kernel == IGABEM_KERNEL_KELVIN;
    solution->potential = formulation_has_potential(&solution->options);
    solution->speed = 1.0;
    solution->condition = solution->residual = NAN;
    if (solution->waves) {
        solution->speed = options->froude * sqrt(options->gravity * hull->length);
        solution->k0 = options->gravity / (solution->speed * solution->speed);
    }
    const igabem_options *used = &solution->options;
    const struct density_rule rule = {
        .degree = used->degree,
        .refine = {used->refine, used->refine_v},
        .elements = {used->elements_u * used->refine, used->elements_v * used->refine_v},
        .waterline_span = used->waterline_span};
    status = density_create(hull, &rule, &solution->density);
    if (status != IGABEM_OK)
        return status;
    solution->sigma = malloc(solution->density->n * sizeof *solution->sigma);
    return solution->sigma ? IGABEM_OK : solution_no_memory(solution->density->n);
}

double solution_stem_limiter(const igabem_options *options, double nu_x)
{
    double ratio = fabs(nu_x) / options->stem_limit;
    return 1.0 / (1.0 + ratio * ratio * ratio * ratio);
}

const igabem_options *igabem_solution_options(const igabem_solution *solution)
{
    return solution ? &solution->options : NULL;
}

void igabem_solution_free(igabem_solution *solution)
{
    if (!solution)
        return;
    density_free(solution->density);
    free_surface_free(solution->surface);
    free(solution->surface_phi);
    free(solution->base);
    free(solution->base_velocity);
    free(solution->cell_source);
    transom_free(solution->transom);
    free(solution->strip_phi);
    free(solution->sigma);
    free(solution->system);
    free(solution->pivots);
    free(solution->velocity);
    free(solution->sigma_lower);
    free(solution->sigma_upper);
    free(solution->sigma_change);
    free(solution);
}

double solution_wave_share(const igabem_solution *solution, double x)
{
    const igabem_options *options = &solution->options;
    if (!formulation_has_waves(options))
        return 0.0;
    if (!solution->formulation->stern_rows)
        return 1.0;
    double length = solution->info.length;
    double from = solution->x_aft + options->stern_length * length;
    double width = fmax(options->stern_blend * length, 1e-12 * length);
    double s = fmin(1.0, fmax(0.0, (x - from) / width + 0.5));
    return s * s * (3.0 - 2.0 * s);
}

void solution_normal_flow(const igabem_solution *solution, double *values)
{
    for (size_t i = 0; i < solution->density->n; i++)
        values[i] = solution->speed * solution->density->normal[3 * i];
}
