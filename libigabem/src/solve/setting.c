#include "solve/setting.h"

#include "solve/assemble.h"
#include "solve/coarsened.h"
#include "solve/filters.h"
#include "solve/formulation.h"

#include <stdlib.h>
#include <string.h>

/* How a setting weighs the parts, row by row:
 *     velocity_i = rankine + image[i] image + wave[i] (local + wave). */
struct weights {
    double *image, *wave; /* [n] */
};

static void add_weighted(const struct influence *influence, const double *weight,
                         const double *from, double *to)
{
    size_t n = influence->density->n;
#pragma omp parallel for num_threads(influence->threads) schedule(static)
    for (size_t i = 0; i < n; i++)
        for (size_t k = 3 * n * i; k < 3 * n * (i + 1) && weight[i] != 0.0; k++)
            to[k] += weight[i] * from[k];
}

/* Of a setting's share, what is done after the integrals of each part; the solution is the rest. */
static const double RANKINE_DONE = 0.4, LOCAL_DONE = 0.65, LINE_DONE = 0.7, WAVE_DONE = 0.85;

/* Adds waterline and waves of one setting to rows; creates the operator of what the filters beyond
 * the first change in the matrix. */
static igabem_status wave_rows(const struct influence *influence, const igabem_solution *solution,
                               double from, double share, const double *weight, double *rows,
                               struct filter_change **change)
{
    const igabem_options *options = &solution->options;
    double cutoff[FILTERS_MOST];
    size_t filters = filters_of(options, cutoff);
    struct line *line = NULL;
    igabem_status status = IGABEM_OK;
    if (options->line_term)
        status = line_create(influence->density, influence->mesh, options->stem_limit, &line);
    progress_stage(influence->progress, from + LINE_DONE * share, influence->density->n);
    if (status == IGABEM_OK && line)
        status = influence_local_line(influence, line, solution->k0, weight, rows);
    progress_stage(influence->progress, from + WAVE_DONE * share, 1);
    if (status == IGABEM_OK)
        status =
            influence_wave(influence, line, solution->k0, filters, cutoff, weight, rows, change);
    line_free(line);
    return status;
}

/* Fills rows with the velocities of a setting. */
static igabem_status fill_rows(const struct influence *influence, const struct parts *parts,
                               double from, double share, const struct weights *weights,
                               const igabem_solution *solution, double *rows,
                               struct filter_change **change)
{
    size_t n = influence->density->n;
    const double *image = formulation_has_image(&solution->options) ? weights->image : NULL;
    igabem_status status = IGABEM_OK;
    progress_stage(influence->progress, from + RANKINE_DONE * share, n);
    if (parts->rankine) {
        memcpy(rows, parts->rankine, 3 * n * n * sizeof *rows);
        if (image)
            add_weighted(influence, image, parts->image, rows);
    } else {
        status = influence_rankine(influence, rows, NULL, image);
    }
    if (status != IGABEM_OK || !formulation_has_waves(&solution->options))
        return status;
    progress_stage(influence->progress, from + LOCAL_DONE * share, n);
    if (parts->local)
        add_weighted(influence, weights->wave, parts->local, rows);
    else
        status = influence_local(influence, solution->k0, weights->wave, rows);
    if (status == IGABEM_OK)
        status = wave_rows(influence, solution, from, share, weights->wave, rows, change);
    return status;
}

static igabem_status keep(const double *rows, igabem_solution *solution)
{
    size_t n = solution->density->n, size = 3 * n * n * sizeof *rows;
    solution->system = malloc(size);
    if (!solution->system)
        return solution_no_memory(n);
    memcpy(solution->system, rows, size);
    solution->memory += (double)size;
    return IGABEM_OK;
}

/* Density and velocities from the rows, which are used up. */
static igabem_status solve_rows(const struct influence *influence,
                                const struct filter_change *change, double *rows,
                                igabem_solution *solution)
{
    size_t n = influence->density->n;
    const struct matrix matrix = {n, 3 * n, rows, influence->threads, influence->progress};
    double cutoff[FILTERS_MOST];
    size_t filters = filters_of(&solution->options, cutoff);
    solution->velocity = malloc(3 * n * sizeof *solution->velocity);
    double *flow = malloc(n * sizeof *flow);
    igabem_status status = solution->velocity && flow ? IGABEM_OK : solution_no_memory(n);
    if (status == IGABEM_OK) {
        assemble_turn(influence, rows);
        if (solution->options.keep_system != 0.0)
            status = keep(rows, solution);
        if (status == IGABEM_OK && solution->waves)
            status = coarsened_density(&matrix, solution, &solution->sigma_change);
    }
    if (status == IGABEM_OK)
        status = filters_solve(&matrix, solution, filters, change);
    for (size_t i = 0; i < n && status == IGABEM_OK && solution->sigma_change; i++)
        solution->sigma_change[i] = solution->sigma[i] - solution->sigma_change[i];
    if (status == IGABEM_OK) {
        solution_normal_flow(solution, flow);
        assemble_velocity(influence, rows, flow, solution->sigma, solution->velocity);
        status = density_interpolate(solution->density, 3, solution->velocity);
    }
    free(flow);
    return status;
}

static void fill_weights(const igabem_solution *solution, const struct weights *weights)
{
    const struct density *density = solution->density;
    for (size_t i = 0; i < density->n; i++) {
        double share = solution_wave_share(solution, density->point[3 * i]);
        weights->wave[i] = share;
        weights->image[i] = 2.0 * share - 1.0;
    }
}

igabem_status setting_solve(const struct influence *influence, const struct parts *parts,
                            double share, igabem_solution *solution)
{
    size_t n = influence->density->n;
    if (!formulation_solves(&solution->options)) {
        solution_normal_flow(solution, solution->sigma);
        return density_interpolate(solution->density, 1, solution->sigma);
    }
    double from = influence->progress ? influence->progress->done : 0.0;
    size_t arrays = 3; /* n^2 doubles each */
    arrays += 3 * ((size_t) !!parts->rankine + (size_t) !!parts->image + (size_t) !!parts->local);
    solution->memory = (double)(arrays * n * n * sizeof(double));
    double *rows = calloc(3 * n * n, sizeof *rows);
    double *weight = malloc(2 * n * sizeof *weight);
    const struct weights weights = {weight, weight + n};
    struct filter_change *change = NULL;
    igabem_status status = rows && weight ? IGABEM_OK : solution_no_memory(n);
    if (status == IGABEM_OK) {
        fill_weights(solution, &weights);
        status = fill_rows(influence, parts, from, share, &weights, solution, rows, &change);
    }
    if (change)
        solution->memory += filter_change_memory(change);
    progress_stage(influence->progress, from + share, n);
    if (status == IGABEM_OK)
        status = solve_rows(influence, change, rows, solution);
    free(weight);
    free(rows);
    filter_change_free(change);
    return status;
}

igabem_status setting_system(const struct influence *influence, const igabem_solution *solution,
                             double *rows)
{
    static const struct parts none = {NULL, NULL, NULL, 0.0};
    size_t n = influence->density->n;
    double *weight = malloc(2 * n * sizeof *weight);
    const struct weights weights = {weight, weight + n};
    struct filter_change *change = NULL;
    if (!weight)
        return solution_no_memory(n);
    memset(rows, 0, 3 * n * n * sizeof *rows);
    fill_weights(solution, &weights);
    igabem_status status = fill_rows(influence, &none, 0.0, 1.0, &weights, solution, rows, &change);
    if (status == IGABEM_OK)
        assemble_turn(influence, rows);
    filter_change_free(change);
    free(weight);
    return status;
}
