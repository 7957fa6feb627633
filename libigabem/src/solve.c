#include "assemble.h"
#include "error.h"
#include "solution.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

static const double sensitivity_factors[3] = {1.0, 0.85, 1.15};

double solution_stem_limiter(const igabem_options *options, double nu_x)
{
    double ratio = fabs(nu_x) / options->stem_limit;
    return 1.0 / (1.0 + ratio * ratio * ratio * ratio);
}

const igabem_options *igabem_solution_options(const igabem_solution *solution)
{
    return &solution->options;
}

void igabem_solution_free(igabem_solution *solution)
{
    if (!solution)
        return;
    density_free(solution->density);
    free(solution->sigma);
    free(solution->velocity);
    free(solution->sigma_lower);
    free(solution->sigma_upper);
    free(solution);
}

static igabem_status no_memory(size_t n)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for influences of %zu unknowns", n);
}

/* Work that settings on one hull share. */
struct shared {
    const igabem_hull *hull;
    size_t n;
    igabem_solution **solutions;
    igabem_progress progress;
    void *progress_data;
    double done; /* fraction */
};

static igabem_status report(struct shared *shared, double fraction)
{
    shared->done = fmax(shared->done, fraction);
    if (shared->progress && shared->progress(shared->progress_data, shared->done))
        return igabem_fail(IGABEM_ERROR_CANCELLED, "cancelled by the caller");
    return IGABEM_OK;
}

/* What a setting needs of the Green function. */
static int solves(const igabem_options *options)
{
    return options->kernel != IGABEM_KERNEL_KELVIN ||
           (options->formulation != IGABEM_HOGNER && options->formulation != IGABEM_MICHELL);
}

static int needs_image(const igabem_options *options)
{
    return solves(options) && options->kernel != IGABEM_KERNEL_RANKINE;
}

static int needs_waves(const igabem_options *options)
{
    return options->kernel == IGABEM_KERNEL_KELVIN &&
           (options->formulation == IGABEM_NEUMANN_KELVIN ||
            options->formulation == IGABEM_NEUMANN_KELVIN_STERN);
}

/* Share of the Kelvin kernel in the rows at x: all of it, but ahead of x_s only with the stern
 * variant, with a smooth switch; double body elsewhere. */
static double wave_share(const igabem_solution *solution, double x)
{
    const igabem_options *options = &solution->options;
    if (!needs_waves(options))
        return 0.0;
    if (options->formulation != IGABEM_NEUMANN_KELVIN_STERN)
        return 1.0;
    double length = solution->info.length;
    double from = solution->x_aft + options->stern_length * length;
    double width = fmax(options->stern_blend * length, 1e-12 * length);
    double s = fmin(1.0, fmax(0.0, (x - from) / width + 0.5));
    return s * s * (3.0 - 2.0 * s);
}

static igabem_status start_solution(const igabem_hull *hull, const igabem_options *options,
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
    igabem_hull_get_info(hull, &solution->info);
    solution->x_aft = hull->hydrostatics.x_aft;
    solution->x_fore = hull->hydrostatics.x_fore;
    solution->waves = options->kernel == IGABEM_KERNEL_KELVIN;
    solution->speed = 1.0;
    solution->condition = NAN;
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
    return solution->sigma ? IGABEM_OK : no_memory(solution->density->n);
}

/* U n_x at the collocation points: the right-hand side, and Hogner's density. */
static void normal_flow(const igabem_solution *solution, double *values)
{
    for (size_t i = 0; i < solution->density->n; i++)
        values[i] = solution->speed * solution->density->normal[3 * i];
}

/* Adds waterline and waves of one setting to wave[0][n][3][n]; the filters beyond the first start
 * from the waterline alone. */
static igabem_status wave_influence(const struct influence *influence,
                                    const igabem_solution *solution, const char *row,
                                    size_t filters, double *wave)
{
    const igabem_options *options = &solution->options;
    size_t n = influence->density->n, size = 3 * n * n;
    double cutoff[3];
    for (size_t f = 0; f < filters; f++)
        cutoff[f] = sensitivity_factors[f] * options->cutoff_angle;
    struct line *line = NULL;
    igabem_status status = IGABEM_OK;
    if (options->line_term)
        status = line_create(influence->density, influence->mesh, options->stem_limit, &line);
    if (status == IGABEM_OK && line)
        status = influence_local_line(influence, line, solution->k0, row, wave);
    for (size_t f = 1; f < filters && status == IGABEM_OK; f++)
        memcpy(wave + f * size, wave, size * sizeof *wave);
    if (status == IGABEM_OK)
        status = influence_wave(influence, line, solution->k0, filters, cutoff, row, wave);
    line_free(line);
    return status;
}

static igabem_status solve_density(const struct system *system, const igabem_solution *solution,
                                   double *sigma, double *condition)
{
    size_t n = solution->density->n;
    double *matrix = malloc(n * n * sizeof *matrix);
    if (!matrix)
        return no_memory(n);
    igabem_status status = system_matrix(system, matrix);
    if (status == IGABEM_OK) {
        normal_flow(solution, sigma);
        status = system_solve(n, matrix, sigma, condition);
    }
    free(matrix);
    return status;
}

static igabem_status solve_filters(struct system *system, igabem_solution *solution, size_t filters,
                                   const double *wave)
{
    size_t n = solution->density->n;
    double **extra[2] = {&solution->sigma_lower, &solution->sigma_upper};
    igabem_status status = solve_density(system, solution, solution->sigma, &solution->condition);
    if (status != IGABEM_OK)
        return status;
    solution->velocity = malloc(3 * n * sizeof *solution->velocity);
    if (!solution->velocity)
        return no_memory(n);
    status = system_velocity(system, solution->sigma, solution->velocity);
    if (status == IGABEM_OK)
        status = density_interpolate(solution->density, 3, solution->velocity);
    for (size_t f = 1; f < filters && status == IGABEM_OK; f++) {
        system->wave = wave + f * 3 * n * n;
        *extra[f - 1] = malloc(n * sizeof(double));
        status =
            *extra[f - 1] ? solve_density(system, solution, *extra[f - 1], NULL) : no_memory(n);
    }
    return status;
}

/* keep_local: another setting reads local after this one; else waterline and waves are added to it
 * in place. */
static igabem_status finish_solution(const struct influence *influence, const double *rankine,
                                     const double *image, double *local, int keep_local,
                                     igabem_solution *solution)
{
    const struct density *density = influence->density;
    const igabem_options *options = &solution->options;
    size_t n = density->n;
    if (!solves(options)) {
        normal_flow(solution, solution->sigma);
        return density_interpolate(solution->density, 1, solution->sigma);
    }
    int waves = needs_waves(options);
    size_t filters = waves ? (options->sensitivity && isfinite(options->cutoff_angle) ? 3 : 1) : 0;
    double *weights = malloc(2 * n * sizeof *weights);
    char *row = malloc(n);
    int in_place = waves && filters == 1 && !keep_local;
    double *own = waves && !in_place ? calloc(filters * 3 * n * n, sizeof *own) : NULL;
    double *wave = in_place ? local : own;
    igabem_status status = IGABEM_OK;
    size_t arrays = 1u + (image != NULL) + (local != NULL) + (own ? filters : 0);
    solution->memory = (double)((3 * arrays + 1) * n * n * sizeof(double));
    if (!weights || !row || (waves && !wave)) {
        status = no_memory(n);
        goto done;
    }
    struct system system = {.influence = influence,
                            .rankine = rankine,
                            .image = image,
                            .local = in_place ? NULL : local,
                            .wave = wave,
                            .image_weight = weights,
                            .wave_weight = weights + n};
    for (size_t i = 0; i < n; i++) {
        double share = wave_share(solution, density->point[3 * i]);
        row[i] = share > 0;
        system.wave_weight[i] = share;
        system.image_weight[i] = options->kernel == IGABEM_KERNEL_RANKINE ? 0.0 : 2.0 * share - 1.0;
    }
    if (waves)
        status = wave_influence(influence, solution, row, filters, wave);
    if (status == IGABEM_OK)
        status = solve_filters(&system, solution, filters, wave);
done:
    free(weights);
    free(row);
    free(own);
    return status;
}

/* N of the rows that any of the settings from `first` on with this k0 uses. */
static igabem_status shared_local(const struct influence *influence, igabem_solution **solutions,
                                  const size_t *member, size_t count, size_t first, double *local)
{
    const struct density *density = influence->density;
    double k0 = solutions[member[first]]->k0;
    char *row = calloc(density->n, 1);
    if (!row)
        return no_memory(density->n);
    for (size_t m = first; m < count; m++) {
        const igabem_solution *solution = solutions[member[m]];
        if (!needs_waves(&solution->options) || solution->k0 != k0)
            continue;
        for (size_t i = 0; i < density->n; i++)
            row[i] = (char)(row[i] | (wave_share(solution, density->point[3 * i]) > 0));
    }
    memset(local, 0, 3 * density->n * density->n * sizeof *local);
    igabem_status status = influence_local(influence, k0, row, local);
    free(row);
    return status;
}

/* Whether a setting after number m has the same k0 and reads N. */
static int local_used_later(igabem_solution **solutions, const size_t *member, size_t count,
                            size_t m)
{
    for (size_t k = m + 1; k < count; k++)
        if (needs_waves(&solutions[member[k]]->options) &&
            solutions[member[k]]->k0 == solutions[member[m]]->k0)
            return 1;
    return 0;
}

/* Settings that share unknowns and quadrature: indices member[count]. */
static igabem_status solve_group(struct shared *shared, const size_t *member, size_t count)
{
    igabem_solution **solutions = shared->solutions;
    double start = omp_get_wtime(), per_setting = 1.0 / (double)shared->n;
    const igabem_solution *first = solutions[member[0]];
    size_t n = first->density->n;
    int any = 0, images = 0, waves = 0;
    for (size_t m = 0; m < count; m++) {
        any |= solves(&solutions[member[m]]->options);
        images |= needs_image(&solutions[member[m]]->options);
        waves |= needs_waves(&solutions[member[m]]->options);
    }
    struct mesh *mesh = NULL;
    struct influence *influence = NULL;
    double *rankine = NULL, *image = NULL, *local = NULL, local_k0 = 0.0;
    int threads = first->options.threads > 0 ? first->options.threads : omp_get_max_threads();
    igabem_status status = mesh_create(first->density, &mesh);
    if (status == IGABEM_OK)
        status =
            influence_create(first->density, mesh, first->options.tolerance, threads, &influence);
    if (status == IGABEM_OK && any) {
        size_t size = 3 * n * n * sizeof(double);
        rankine = malloc(size);
        image = images ? malloc(size) : NULL;
        local = waves ? malloc(size) : NULL;
        if (!rankine || (images && !image) || (waves && !local))
            status = no_memory(n);
        if (status == IGABEM_OK)
            status = influence_rankine(influence, rankine, image);
    }
    if (status == IGABEM_OK)
        status = report(shared, shared->done + 0.5 * per_setting * (double)count);
    double common = (omp_get_wtime() - start) / (double)count;
    for (size_t m = 0; m < count && status == IGABEM_OK; m++) {
        igabem_solution *solution = solutions[member[m]];
        start = omp_get_wtime();
        if (needs_waves(&solution->options) && solution->k0 != local_k0) {
            status = shared_local(influence, solutions, member, count, m, local);
            local_k0 = solution->k0;
        }
        int keep = local_used_later(solutions, member, count, m);
        if (status == IGABEM_OK)
            status = finish_solution(influence, rankine, image, local, keep, solution);
        if (!keep)
            local_k0 = 0.0;
        solution->seconds = common + omp_get_wtime() - start;
        if (status == IGABEM_OK)
            status = report(shared, shared->done + 0.5 * per_setting);
    }
    free(rankine);
    free(image);
    free(local);
    influence_free(influence);
    mesh_free(mesh);
    return status;
}

static int same_group(const igabem_options *a, const igabem_options *b)
{
    return a->refine == b->refine && a->refine_v == b->refine_v && a->elements_u == b->elements_u &&
           a->elements_v == b->elements_v && a->waterline_span == b->waterline_span &&
           a->degree == b->degree && a->tolerance == b->tolerance && a->threads == b->threads;
}

igabem_status igabem_solve_many(const igabem_hull *hull, size_t n, const igabem_options *options,
                                igabem_solution **solutions)
{
    for (size_t k = 0; k < n; k++)
        solutions[k] = NULL;
    size_t *member = malloc((n + 1) * sizeof *member);
    char *taken = calloc(n + 1, 1);
    igabem_status status =
        member && taken ? IGABEM_OK : igabem_fail(IGABEM_ERROR_MEMORY, "no memory to solve");
    for (size_t k = 0; k < n && status == IGABEM_OK; k++)
        status = start_solution(hull, &options[k], &solutions[k]);
    struct shared shared = {.hull = hull, .n = n, .solutions = solutions};
    if (n > 0) {
        shared.progress = options[0].progress;
        shared.progress_data = options[0].progress_data;
    }
    for (size_t k = 0; k < n && status == IGABEM_OK; k++) {
        if (taken[k])
            continue;
        size_t count = 0;
        for (size_t m = k; m < n; m++)
            if (!taken[m] && same_group(&solutions[k]->options, &solutions[m]->options)) {
                taken[m] = 1;
                member[count++] = m;
            }
        status = solve_group(&shared, member, count);
    }
    free(member);
    free(taken);
    for (size_t k = 0; k < n && status != IGABEM_OK; k++) {
        igabem_solution_free(solutions[k]);
        solutions[k] = NULL;
    }
    return status;
}

igabem_status igabem_solve(const igabem_hull *hull, const igabem_options *options,
                           igabem_solution **solution)
{
    return igabem_solve_many(hull, 1, options, solution);
}
