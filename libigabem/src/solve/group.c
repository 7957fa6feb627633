#include "solve/group.h"

#include "solve/formulation.h"
#include "solve/potential.h"
#include "solve/setting.h"
#include "threads.h"

#include <stdlib.h>
#include <string.h>

bool group_has_both(const igabem_options *a, const igabem_options *b)
{
    return a->refine == b->refine && a->refine_v == b->refine_v && a->elements_u == b->elements_u &&
           a->elements_v == b->elements_v && a->waterline_span == b->waterline_span &&
           a->degree == b->degree && a->tolerance == b->tolerance && a->threads == b->threads;
}

/* N of the rows that any of these settings with the k0 of the first uses. */
static igabem_status fill_local(const struct influence *influence, size_t n,
                                igabem_solution *const *solutions, double *local)
{
    const struct density *density = influence->density;
    double k0 = solutions[0]->k0;
    double *wanted = calloc(density->n, sizeof *wanted);
    if (!wanted)
        return solution_no_memory(density->n);
    for (size_t m = 0; m < n; m++) {
        if (!formulation_has_waves(&solutions[m]->options) || solutions[m]->k0 != k0)
            continue;
        for (size_t i = 0; i < density->n; i++)
            if (solution_wave_share(solutions[m], density->point[3 * i]) > 0)
                wanted[i] = 1.0;
    }
    memset(local, 0, 3 * density->n * density->n * sizeof *local);
    igabem_status status = influence_local(influence, k0, wanted, local);
    free(wanted);
    return status;
}

/* Whether two of the settings have the same k0 and read N. */
static bool share_local(size_t n, igabem_solution *const *solutions)
{
    for (size_t m = 0; m < n; m++)
        for (size_t k = m + 1; k < n; k++)
            if (formulation_has_waves(&solutions[m]->options) &&
                formulation_has_waves(&solutions[k]->options) &&
                solutions[k]->k0 == solutions[m]->k0)
                return true;
    return false;
}

/* What more than one of the settings needs. */
static igabem_status fill_parts(const struct influence *influence, size_t n,
                                igabem_solution *const *solutions, struct parts *parts)
{
    size_t unknowns = influence->density->n, size = 3 * unknowns * unknowns * sizeof(double);
    size_t solved = 0;
    bool images = false, local = share_local(n, solutions);
    for (size_t m = 0; m < n; m++) {
        solved += formulation_solves(&solutions[m]->options);
        images |= formulation_has_image(&solutions[m]->options);
    }
    if (solved < 2)
        return IGABEM_OK;
    parts->rankine = malloc(size);
    parts->image = images ? malloc(size) : NULL;
    parts->local = local ? malloc(size) : NULL;
    if (!parts->rankine || (images && !parts->image) || (local && !parts->local))
        return solution_no_memory(unknowns);
    return influence_rankine(influence, parts->rankine, parts->image, NULL);
}

static igabem_status solve_settings(struct influence *influence, struct parts *parts, size_t n,
                                    igabem_solution *const *solutions, double common, double share,
                                    struct progress *progress)
{
    const struct igabem_cost shared_cost = *influence->cost;
    double done = progress->done;
    igabem_status status = IGABEM_OK;
    for (size_t m = 0; m < n && status == IGABEM_OK; m++) {
        igabem_solution *solution = solutions[m];
        double start = wall_seconds();
        solution->cost = shared_cost;
        influence->cost = &solution->cost;
        if (parts->local && formulation_has_waves(&solution->options) &&
            solution->k0 != parts->local_k0) {
            progress_stage(progress, done + 0.5 * share, influence->density->n);
            status = fill_local(influence, n - m, solutions + m, parts->local);
            parts->local_k0 = solution->k0;
        }
        if (status == IGABEM_OK)
            status = setting_solve(influence, parts, share, solution);
        solution->seconds = common + wall_seconds() - start;
        done += share;
        if (status == IGABEM_OK)
            status = progress_report(progress, done);
    }
    return status;
}

/* Density by density: those that solve for a source density. */
static igabem_status solve_densities(struct influence *influence, size_t n,
                                     igabem_solution *const *solutions, double share,
                                     struct progress *progress)
{
    double start = wall_seconds(), done = progress->done;
    struct parts parts = {NULL, NULL, NULL, 0.0};
    struct igabem_cost shared_cost = {0};
    influence->cost = &shared_cost;
    progress_stage(progress, done + 0.5 * share * (double)n, influence->density->n);
    igabem_status status = fill_parts(influence, n, solutions, &parts);
    double common = (wall_seconds() - start) / (double)n;
    if (parts.rankine) {
        share *= 0.5;
        done += share * (double)n;
    }
    if (status == IGABEM_OK)
        status = progress_report(progress, done);
    if (status == IGABEM_OK)
        status = solve_settings(influence, &parts, n, solutions, common, share, progress);
    free(parts.rankine);
    free(parts.image);
    free(parts.local);
    return status;
}

igabem_status group_solve(size_t n, igabem_solution *const *solutions, double share,
                          struct progress *progress)
{
    double start = wall_seconds();
    const igabem_solution *first = solutions[0];
    struct mesh *mesh = NULL;
    struct influence *influence = NULL;
    THREADS(first->options.threads);
    int threads = threads_at_hand();
    size_t densities = 0, potentials = n;
    igabem_solution **sorted = malloc(n * sizeof *sorted);
    igabem_status status = sorted ? mesh_create(first->density, &mesh) : solution_no_memory(n);
    if (status == IGABEM_OK)
        status =
            influence_create(first->density, mesh, first->options.tolerance, threads, &influence);
    if (status == IGABEM_OK)
        influence->progress = progress;
    for (size_t m = 0; m < n && status == IGABEM_OK; m++)
        sorted[solutions[m]->potential ? --potentials : densities++] = solutions[m];
    double common = (wall_seconds() - start) / (double)n;
    if (status == IGABEM_OK && densities)
        status = solve_densities(influence, densities, sorted, share, progress);
    if (status == IGABEM_OK && densities < n)
        status = potential_solve(influence, n - densities, sorted + densities, share, progress);
    for (size_t m = 0; m < n; m++)
        solutions[m]->seconds += common;
    free(sorted);
    influence_free(influence);
    mesh_free(mesh);
    return status;
}
