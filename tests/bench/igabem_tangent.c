/* Processor time of tangents beside that of the solution: the DTMB 5415 wetted and simplified, Fr
 * 0.35, 15 fields. One line for each formulation that has them; the solution includes its residuals
 * and 40 x 20 samples of the pressure, the tangents the derivatives of these. Then the gradient by
 * all control points of those that have one. Usage: igabem_bench_tangent [fields] */
#define _POSIX_C_SOURCE 200809L
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const double length = 5.72;

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static nurbs_surface *read_surface(const char *path)
{
    nurbs_patches *file = NULL;
    nurbs_surface *wetted = NULL, *light = NULL;
    double bound;
    if (nurbs_patches_read(path, &file) != NURBS_OK ||
        nurbs_surface_wetted(nurbs_patches_get(file, 0), 0.0, 1e-5 * length, &wetted) != NURBS_OK ||
        nurbs_surface_simplify(wetted, 1e-4 * length,
                               NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_KEEP_KINKS |
                                   NURBS_SIMPLIFY_THRIFTY,
                               &light, &bound) != NURBS_OK)
        fprintf(stderr, "%s: %s\n", path, nurbs_last_error());
    nurbs_surface_free(wetted);
    nurbs_patches_free(file);
    return light;
}

/* y sin(i pi x/L) cos(j pi z/T), i from 1 to 5. */
static double *make_moves(const nurbs_surface *surface, size_t fields)
{
    const double pi = acos(-1.0), *point = nurbs_surface_points(surface);
    size_t points = nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
    double *move = calloc(3 * points * fields, sizeof *move);
    for (size_t f = 0; f < fields && move; f++)
        for (size_t k = 0; k < points; k++)
            move[3 * (f * points + k) + 1] = point[3 * k + 1] *
                                             sin((double)(1 + f % 5) * pi * point[3 * k] / length) *
                                             cos((double)(f / 5) * pi * point[3 * k + 2] / 0.248);
    return move;
}

enum { ALONG = 40, AROUND = 20 };

static bool has_velocity(const igabem_solution *solution)
{
    return igabem_formulation_info(igabem_solution_options(solution)->formulation)->solves;
}

/* What an optimiser reads of a solution. */
static igabem_status results(const igabem_solution *solution)
{
    size_t n = 0;
    igabem_pressure_sample *sample = NULL;
    double r[IGABEM_WAVE_RESIDUALS];
    igabem_status status = igabem_wave_residuals(solution, r);
    if (!status && has_velocity(solution))
        status = igabem_pressure_samples(solution, ALONG, AROUND, &n, &sample);
    free(sample);
    return status;
}

/* Their derivatives. */
static igabem_status derivatives(const igabem_solution *solution, const igabem_tangent *tangent,
                                 size_t fields)
{
    size_t n = 0;
    igabem_pressure_sample *dsample = NULL;
    double *dr = malloc(fields * IGABEM_WAVE_RESIDUALS * sizeof *dr);
    igabem_status status = igabem_tangent_residuals(tangent, dr);
    if (!status && has_velocity(solution))
        status = igabem_pressure_samples(solution, ALONG, AROUND, &n, NULL);
    if (!status && has_velocity(solution)) {
        dsample = malloc(fields * n * sizeof *dsample);
        status = igabem_tangent_samples(tangent, ALONG, AROUND, dsample);
    }
    free(dsample);
    free(dr);
    return status;
}

static igabem_status run(const igabem_hull *hull, igabem_formulation formulation, size_t fields,
                         const double *move)
{
    igabem_options options;
    igabem_options_init(&options);
    options.froude = 0.35;
    options.formulation = formulation;
    double spent[2][2] = {{0.0}};
    igabem_forces forces = {0};
    for (int kept = 0; kept < 2; kept++) {
        igabem_solution *solution = NULL;
        igabem_tangent *tangent = NULL;
        options.keep_system = kept;
        double start = seconds();
        igabem_status status = igabem_solve(hull, &options, &solution);
        if (!status)
            status = results(solution);
        spent[kept][0] = seconds() - start;
        if (!status)
            status = igabem_forces_compute(solution, &forces);
        start = seconds();
        if (!status)
            status = igabem_tangent_create(hull, solution, fields, move, &tangent);
        if (!status)
            status = derivatives(solution, tangent, fields);
        spent[kept][1] = seconds() - start;
        igabem_tangent_free(tangent);
        igabem_solution_free(solution);
        if (status)
            return status;
    }
    printf("| %s | %zu | %.2f | %.2f | %.2f | %.2f | %.2f |\n",
           igabem_formulation_name(formulation), forces.dofs, spent[0][0], spent[0][1], spent[1][1],
           spent[0][1] / spent[0][0], spent[1][1] / spent[1][0]);
    return IGABEM_OK;
}

/* C_w by all control points. */
static igabem_status run_gradient(const igabem_hull *hull, igabem_formulation formulation,
                                  size_t points)
{
    igabem_options options;
    igabem_options_init(&options);
    options.froude = 0.35;
    options.formulation = formulation;
    double spent[2][2] = {{0.0}}, *gradient = malloc(points * sizeof *gradient);
    igabem_status status = IGABEM_OK;
    for (int kept = 0; kept < 2 && !status; kept++) {
        igabem_solution *solution = NULL;
        options.keep_system = kept;
        double start = seconds();
        status = igabem_solve(hull, &options, &solution);
        if (!status)
            status = results(solution);
        spent[kept][0] = seconds() - start;
        start = seconds();
        if (!status)
            status = igabem_cw_gradient(hull, solution, gradient);
        spent[kept][1] = seconds() - start;
        igabem_solution_free(solution);
    }
    free(gradient);
    if (!status)
        printf("\n%s, gradient by %zu control points: %.2f, with a kept system %.2f; %.2f and %.2f "
               "solutions\n",
               igabem_formulation_name(formulation), points, spent[0][1], spent[1][1],
               spent[0][1] / spent[0][0], spent[1][1] / spent[1][0]);
    return status;
}

int main(int argc, char **argv)
{
    size_t fields = argc > 1 ? (size_t)atoi(argv[1]) : 15;
    nurbs_surface *surface = read_surface(EXAMPLES_DIR "/hulls/dtmb5415.json");
    igabem_hull *hull = NULL;
    double *move = surface && fields ? make_moves(surface, fields) : NULL;
    igabem_status status = IGABEM_ERROR_ARGUMENT;
    if (move)
        status =
            igabem_hull_create((const nurbs_surface *const *)&surface, 1, IGABEM_SYMMETRIC, &hull);
    if (!status)
        status = igabem_hull_set_length(hull, length);
    printf("%zu fields, processor seconds\n\n| formulation | unknowns | solution | tangents | with "
           "a kept system | in solutions | with a kept system |\n|---|---|---|---|---|---|---|\n",
           fields);
    for (int f = 0; !status && igabem_formulation_info((igabem_formulation)f); f++)
        if (igabem_formulation_info((igabem_formulation)f)->tangents)
            status = run(hull, (igabem_formulation)f, fields, move);
    if (!status)
        status = run_gradient(hull, IGABEM_FORMULATION_EXTERIOR,
                              nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1));
    if (status)
        fprintf(stderr, "%s\n", igabem_last_error());
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
    free(move);
    return status ? EXIT_FAILURE : EXIT_SUCCESS;
}
