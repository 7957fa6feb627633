#include "core/error.h"
#include "solve/assemble.h"
#include "solve/formulation.h"
#include "solve/linear.h"
#include "solve/solution.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

static const double sensitivity_factors[3] = {1.0, 0.85, 1.15};
/* With fewer unknowns LU takes less than 3 % of a solve. */
static const size_t direct_unknowns = 1000;

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
    void *progress_user_data;
    double done; /* fraction */
};

static igabem_status report(struct shared *shared, double fraction)
{
    shared->done = fmax(shared->done, fraction);
    if (shared->progress && shared->progress(shared->progress_user_data, shared->done))
        return igabem_fail(IGABEM_ERROR_CANCELLED, "cancelled by the caller");
    return IGABEM_OK;
}

/* Share of the Kelvin kernel in the rows at x: all of it, but ahead of x_s only with the stern
 * variant, with a smooth switch; double body elsewhere. */
static double wave_share(const igabem_solution *solution, double x)
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
    solution->formulation = igabem_formulation_info(solution->options.formulation);
    igabem_hull_get_info(hull, &solution->info);
    solution->x_aft = hull->hydrostatics.x_aft;
    solution->x_fore = hull->hydrostatics.x_fore;
    solution->waves = options->kernel == IGABEM_KERNEL_KELVIN;
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
    return solution->sigma ? IGABEM_OK : no_memory(solution->density->n);
}

/* U n_x at the collocation points: the right-hand side, and Hogner's density. */
static void normal_flow(const igabem_solution *solution, double *values)
{
    for (size_t i = 0; i < solution->density->n; i++)
        values[i] = solution->speed * solution->density->normal[3 * i];
}

/* Parts of the Green function that several settings share, [n][3][n]; all NULL for one setting,
 * whose weights are applied as the parts are integrated. */
struct parts {
    double *rankine, *image, *local;
    double local_k0; /* that local is for; 0: none */
};

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

/* Adds waterline and waves of one setting to rows; creates the operator of what the filters beyond
 * the first change in the matrix. */
static igabem_status wave_influence(const struct influence *influence,
                                    const igabem_solution *solution, const double *weight,
                                    size_t filters, double *rows, struct wave_change **change)
{
    const igabem_options *options = &solution->options;
    double cutoff[3];
    for (size_t f = 0; f < filters; f++)
        cutoff[f] = sensitivity_factors[f] * options->cutoff_angle;
    struct line *line = NULL;
    igabem_status status = IGABEM_OK;
    if (options->line_term)
        status = line_create(influence->density, influence->mesh, options->stem_limit, &line);
    if (status == IGABEM_OK && line)
        status = influence_local_line(influence, line, solution->k0, weight, rows);
    if (status == IGABEM_OK)
        status =
            influence_wave(influence, line, solution->k0, filters, cutoff, weight, rows, change);
    line_free(line);
    return status;
}

/* Fills rows with the velocities of a setting; fraction is done after the Rankine part. */
static igabem_status weighted_rows(struct shared *shared, double fraction,
                                   const struct influence *influence,
                                   const igabem_solution *solution, const struct parts *parts,
                                   const struct weights *weights, size_t filters, double *rows,
                                   struct wave_change **change)
{
    size_t n = influence->density->n;
    const double *image = formulation_has_image(&solution->options) ? weights->image : NULL;
    igabem_status status = IGABEM_OK;
    if (parts->rankine) {
        memcpy(rows, parts->rankine, 3 * n * n * sizeof *rows);
        if (image)
            add_weighted(influence, image, parts->image, rows);
    } else {
        status = influence_rankine(influence, rows, NULL, image);
    }
    if (status == IGABEM_OK)
        status = report(shared, fraction);
    if (status != IGABEM_OK || !formulation_has_waves(&solution->options))
        return status;
    if (parts->local)
        add_weighted(influence, weights->wave, parts->local, rows);
    else
        status = influence_local(influence, solution->k0, weights->wave, rows);
    if (status == IGABEM_OK)
        status = wave_influence(influence, solution, weights->wave, filters, rows, change);
    return status;
}

/* The densities of all filters by LU, which replaces the matrices by their factors. */
static igabem_status solve_directly(const struct matrix *matrix, igabem_solution *solution,
                                    size_t filters, const struct wave_change *change,
                                    double *const *sigma)
{
    size_t n = matrix->n;
    igabem_status status = IGABEM_OK;
    double *sum = filters > 1 ? malloc(n * n * sizeof *sum) : NULL;
    if (filters > 1 && !sum)
        return no_memory(n);
    solution->memory += sum ? (double)(n * n * sizeof *sum) : 0.0;
    for (size_t f = filters; f-- > 0 && status == IGABEM_OK;) {
        const struct matrix changed = {n, n, sum, matrix->threads};
        if (f > 0) {
            wave_change_expand(change, f - 1, sum);
            for (size_t i = 0; i < n; i++)
                for (size_t k = 0; k < n; k++)
                    sum[i * n + k] += matrix->rows[i * matrix->stride + k];
        }
        normal_flow(solution, sigma[f]);
        status =
            linear_lu(f > 0 ? &changed : matrix, sigma[f], f == 0 ? &solution->condition : NULL);
    }
    free(sum);
    solution->options.solver = IGABEM_SOLVER_LU;
    return status;
}

struct filter_change {
    const struct wave_change *change;
    size_t filter;
};

static void add_change(const void *data, const double *x, double *y)
{
    const struct filter_change *change = data;
    wave_change_add(change->change, change->filter, x, y);
}

/* The same by GMRES, which leaves the matrices as they are; a filter starts from the density of the
 * first. */
static igabem_status solve_iteratively(const struct matrix *matrix, igabem_solution *solution,
                                       size_t filters, const struct wave_change *change,
                                       double *const *sigma)
{
    size_t n = matrix->n;
    struct iteration *iteration = NULL;
    double *right = malloc(n * sizeof *right);
    igabem_status status = right ? IGABEM_OK : no_memory(n);
    if (status == IGABEM_OK)
        status = iteration_create(matrix, solution->density->point, &iteration);
    if (status == IGABEM_OK) {
        normal_flow(solution, right);
        memset(sigma[0], 0, n * sizeof *right);
        solution->memory += iteration_memory(iteration);
    }
    for (size_t f = 0; f < filters && status == IGABEM_OK; f++) {
        const struct filter_change filter = {change, f - 1};
        const struct addend addend = {add_change, &filter};
        struct gmres_result result;
        if (f > 0)
            memcpy(sigma[f], sigma[0], n * sizeof *right);
        status = iteration_solve(iteration, f > 0 ? &addend : NULL, right, sigma[f], &result);
        solution->iterations = f == 0 ? result.iterations : solution->iterations;
        solution->residual = f == 0 ? result.residual : fmax(solution->residual, result.residual);
    }
    if (status == IGABEM_OK)
        status = iteration_condition(iteration, &solution->condition);
    iteration_free(iteration);
    free(right);
    solution->options.solver = IGABEM_SOLVER_GMRES;
    return status;
}

/* By the solver asked for; automatic choice turns to LU where GMRES fails. */
static igabem_status solve_filters(const struct matrix *matrix, igabem_solution *solution,
                                   size_t filters, const struct wave_change *change)
{
    size_t n = matrix->n;
    igabem_solver wanted = solution->options.solver;
    double **extra[2] = {&solution->sigma_lower, &solution->sigma_upper};
    double *sigma[3] = {solution->sigma, NULL, NULL};
    for (size_t f = 1; f < filters; f++) {
        sigma[f] = *extra[f - 1] = malloc(n * sizeof(double));
        if (!sigma[f])
            return no_memory(n);
    }
    igabem_status status = IGABEM_ERROR_NUMERIC;
    int iterate =
        wanted == IGABEM_SOLVER_GMRES || (wanted == IGABEM_SOLVER_AUTO && n >= direct_unknowns);
    if (iterate)
        status = solve_iteratively(matrix, solution, filters, change, sigma);
    if (!iterate || (status == IGABEM_ERROR_NUMERIC && wanted == IGABEM_SOLVER_AUTO)) {
        solution->iterations = 0;
        solution->residual = NAN;
        status = solve_directly(matrix, solution, filters, change, sigma);
    }
    return status;
}

static igabem_status solve_rows(const struct influence *influence, igabem_solution *solution,
                                size_t filters, double *rows, const struct wave_change *change)
{
    size_t n = influence->density->n;
    const struct matrix matrix = {n, 3 * n, rows, influence->threads};
    solution->velocity = malloc(3 * n * sizeof *solution->velocity);
    double *flow = malloc(n * sizeof *flow);
    igabem_status status = solution->velocity && flow ? IGABEM_OK : no_memory(n);
    if (status == IGABEM_OK) {
        assemble_turn(influence, rows);
        status = solve_filters(&matrix, solution, filters, change);
    }
    if (status == IGABEM_OK) {
        normal_flow(solution, flow);
        assemble_velocity(influence, rows, flow, solution->sigma, solution->velocity);
        status = density_interpolate(solution->density, 3, solution->velocity);
    }
    free(flow);
    return status;
}

static igabem_status finish_solution(struct shared *shared, double fraction,
                                     const struct influence *influence, const struct parts *parts,
                                     igabem_solution *solution)
{
    const struct density *density = influence->density;
    const igabem_options *options = &solution->options;
    size_t n = density->n;
    if (!formulation_solves(options)) {
        normal_flow(solution, solution->sigma);
        return density_interpolate(solution->density, 1, solution->sigma);
    }
    int several =
        formulation_has_waves(options) && options->sensitivity && isfinite(options->cutoff_angle);
    size_t filters = several ? 3 : 1;
    size_t arrays = 3; /* n^2 doubles each */
    arrays += 3 * ((size_t) !!parts->rankine + (size_t) !!parts->image + (size_t) !!parts->local);
    solution->memory = (double)(arrays * n * n * sizeof(double));
    double *rows = calloc(3 * n * n, sizeof *rows);
    struct wave_change *change = NULL;
    double *weight = malloc(2 * n * sizeof *weight);
    const struct weights weights = {weight, weight + n};
    igabem_status status = IGABEM_OK;
    if (!rows || !weight) {
        status = no_memory(n);
        goto done;
    }
    for (size_t i = 0; i < n; i++) {
        double share = wave_share(solution, density->point[3 * i]);
        weights.wave[i] = share;
        weights.image[i] = 2.0 * share - 1.0;
    }
    status = weighted_rows(shared, fraction, influence, solution, parts, &weights, filters, rows,
                           &change);
    if (change)
        solution->memory += wave_change_memory(change);
    if (status == IGABEM_OK)
        status = solve_rows(influence, solution, filters, rows, change);
done:
    free(weight);
    free(rows);
    wave_change_free(change);
    return status;
}

/* N of the rows that any of the settings from `first` on with this k0 uses. */
static igabem_status shared_local(const struct influence *influence, igabem_solution **solutions,
                                  const size_t *member, size_t count, size_t first, double *local)
{
    const struct density *density = influence->density;
    double k0 = solutions[member[first]]->k0;
    double *wanted = calloc(density->n, sizeof *wanted);
    if (!wanted)
        return no_memory(density->n);
    for (size_t m = first; m < count; m++) {
        const igabem_solution *solution = solutions[member[m]];
        if (!formulation_has_waves(&solution->options) || solution->k0 != k0)
            continue;
        for (size_t i = 0; i < density->n; i++)
            if (wave_share(solution, density->point[3 * i]) > 0)
                wanted[i] = 1.0;
    }
    memset(local, 0, 3 * density->n * density->n * sizeof *local);
    igabem_status status = influence_local(influence, k0, wanted, local);
    free(wanted);
    return status;
}

/* Whether two of the settings have the same k0 and read N. */
static int local_shared(igabem_solution **solutions, const size_t *member, size_t count)
{
    for (size_t m = 0; m < count; m++)
        for (size_t k = m + 1; k < count; k++)
            if (formulation_has_waves(&solutions[member[m]]->options) &&
                formulation_has_waves(&solutions[member[k]]->options) &&
                solutions[member[k]]->k0 == solutions[member[m]]->k0)
                return 1;
    return 0;
}

/* What more than one of the settings needs. */
static igabem_status share_parts(const struct influence *influence, igabem_solution **solutions,
                                 const size_t *member, size_t count, struct parts *parts)
{
    size_t n = influence->density->n, size = 3 * n * n * sizeof(double), solved = 0;
    int images = 0;
    for (size_t m = 0; m < count; m++) {
        solved += (size_t)formulation_solves(&solutions[member[m]]->options);
        images |= formulation_has_image(&solutions[member[m]]->options);
    }
    *parts = (struct parts){NULL, NULL, NULL, 0.0};
    if (solved < 2)
        return IGABEM_OK;
    int local = local_shared(solutions, member, count);
    parts->rankine = malloc(size);
    parts->image = images ? malloc(size) : NULL;
    parts->local = local ? malloc(size) : NULL;
    if (!parts->rankine || (images && !parts->image) || (local && !parts->local))
        return no_memory(n);
    return influence_rankine(influence, parts->rankine, parts->image, NULL);
}

/* Settings that share unknowns and quadrature: indices member[count]. */
static igabem_status solve_group(struct shared *shared, const size_t *member, size_t count)
{
    igabem_solution **solutions = shared->solutions;
    double start = omp_get_wtime(), per_setting = 1.0 / (double)shared->n;
    const igabem_solution *first = solutions[member[0]];
    struct mesh *mesh = NULL;
    struct influence *influence = NULL;
    struct parts parts = {NULL, NULL, NULL, 0.0};
    int threads = first->options.threads > 0 ? first->options.threads : omp_get_max_threads();
    igabem_status status = mesh_create(first->density, &mesh);
    if (status == IGABEM_OK)
        status =
            influence_create(first->density, mesh, first->options.tolerance, threads, &influence);
    struct igabem_cost shared_cost = {0};
    if (status == IGABEM_OK)
        influence->cost = &shared_cost;
    if (status == IGABEM_OK)
        status = share_parts(influence, solutions, member, count, &parts);
    double common = (omp_get_wtime() - start) / (double)count, done = shared->done;
    double share = parts.rankine ? 0.5 * per_setting : per_setting;
    if (parts.rankine)
        done += share * (double)count;
    if (status == IGABEM_OK)
        status = report(shared, done);
    for (size_t m = 0; m < count && status == IGABEM_OK; m++) {
        igabem_solution *solution = solutions[member[m]];
        start = omp_get_wtime();
        solution->cost = shared_cost;
        influence->cost = &solution->cost;
        if (parts.local && formulation_has_waves(&solution->options) &&
            solution->k0 != parts.local_k0) {
            status = shared_local(influence, solutions, member, count, m, parts.local);
            parts.local_k0 = solution->k0;
        }
        if (status == IGABEM_OK)
            status = finish_solution(shared, done + 0.5 * share, influence, &parts, solution);
        solution->seconds = common + omp_get_wtime() - start;
        done += share;
        if (status == IGABEM_OK)
            status = report(shared, done);
    }
    free(parts.rankine);
    free(parts.image);
    free(parts.local);
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
        shared.progress_user_data = options[0].progress_user_data;
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
