#include "solve/potential.h"

#include "core/constants.h"
#include "core/error.h"
#include "exterior/system.h"
#include "solve/linear.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool same_surface(const igabem_options *a, const igabem_options *b)
{
    return a->formulation == b->formulation && a->surface_cells == b->surface_cells &&
           a->surface_rows == b->surface_rows && a->surface_first == b->surface_first &&
           a->surface_upstream == b->surface_upstream &&
           a->surface_downstream == b->surface_downstream && a->surface_side == b->surface_side &&
           a->surface_columns == b->surface_columns;
}

/* The free stream runs through the waterline. Beside ends as steep as this each finer mesh adds
 * waves that cannot leave the hull (docs/theory.md, section 14): C_w of a Wigley hull with nu_s
 * 0.45 grows by 28 % from 48 to 64 cells. */
static const double steepest_end = 0.35;

/* What the method has not been built for. */
static igabem_status check(const igabem_solution *solution)
{
    if (!solution->density->symmetric)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "exterior needs a half hull and its mirror "
                                                  "image, this one is given whole");
    if (solution->info.transom == IGABEM_TRANSOM_CLOSED)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "exterior takes a transom as dry: leave out the patch that closes it");
    if (solution->info.surface_piercing && !solution->formulation->double_model &&
        solution->info.nu_s > steepest_end)
        return igabem_fail(IGABEM_ERROR_GEOMETRY,
                           "exterior: an end of the waterline has nu_s %.3g, and beyond %g no "
                           "refinement settles; double-model takes steeper ones",
                           solution->info.nu_s, steepest_end);
    return IGABEM_OK;
}

/* The free surface, and the strip aft of a transom. */
static igabem_status make_surface(const struct influence *influence,
                                  const igabem_solution *solution, struct free_surface **surface,
                                  struct transom **transom)
{
    const igabem_options *options = &solution->options;
    const double ends[2] = {solution->x_aft, solution->x_fore};
    bool dry = solution->info.surface_piercing && solution->info.transom == IGABEM_TRANSOM_OPEN;
    const struct free_surface_rule rule = {.cells = options->surface_cells,
                                           .rows = options->surface_rows,
                                           .first = options->surface_first,
                                           .upstream = options->surface_upstream,
                                           .downstream = options->surface_downstream,
                                           .side = options->surface_side,
                                           .transom = dry};
    *transom = NULL;
    igabem_status status = free_surface_create(&rule, solution->density, ends, surface);
    if (status != IGABEM_OK || !dry)
        return status;
    const struct free_surface *s = *surface;
    return transom_create(solution->density, influence->mesh, ends[1] - ends[0],
                          s->x0 - s->dx * (double)s->stern, s->transom, s->dx, s->nx - s->stern,
                          s->transom / options->surface_columns, transom);
}

/* Creates the gradient on the hull of a potential of that speed, from its derivatives along the
 * surface and U n_x across at the collocation points. */
static igabem_status fill_velocity(const struct influence *influence, const struct density *density,
                                   const double *phi, double speed, double **velocity)
{
    const struct mesh *mesh = influence->mesh;
    size_t n = density->n;
    *velocity = malloc(3 * n * sizeof **velocity);
    if (!*velocity)
        return solution_no_memory(n);
    for (size_t i = 0; i < n; i++) {
        size_t patch = density->owner[i], e = mesh->patch_base[patch];
        double local[2], slope[2], normal[3], step[2][3];
        while (!element_contains(density, &mesh->element[e], i, local))
            e++;
        struct jet jet;
        element_jet(&mesh->element[e], local[0], local[1], &jet);
        element_slope(&mesh->element[e], phi, local, slope);
        memcpy(normal, density->normal + 3 * i, sizeof normal);
        memcpy(step[0], jet.ds, sizeof step[0]);
        memcpy(step[1], jet.dt, sizeof step[1]);
        double a = 0.0, b = 0.0, d = 0.0;
        for (size_t c = 0; c < 3; c++) {
            a += step[0][c] * step[0][c];
            b += step[0][c] * step[1][c];
            d += step[1][c] * step[1][c];
        }
        double det = a * d - b * b;
        double along = (d * slope[0] - b * slope[1]) / det;
        double across = (a * slope[1] - b * slope[0]) / det;
        for (size_t c = 0; c < 3; c++)
            (*velocity)[c * n + i] =
                along * step[0][c] + across * step[1][c] + speed * normal[0] * normal[c];
    }
    return density_interpolate(density, 3, *velocity);
}

/* Adds the hull's phi on an edge. */
static void edge_values(const struct sparse *edge, const double *hull, double *phi)
{
    for (size_t k = 0; k < edge->rows; k++) {
        phi[k] = 0.0;
        for (size_t l = edge->start[k]; l < edge->start[k + 1]; l++)
            phi[k] += edge->value[l] * hull[edge->column[l]];
    }
}

/* The free surface with its potential, which the hull's edges follow. */
static igabem_status keep_surface(const struct influence *influence, igabem_solution *solution,
                                  const double *phi)
{
    struct sparse edge = {0};
    igabem_status status =
        make_surface(influence, solution, &solution->surface, &solution->transom);
    if (status == IGABEM_OK)
        status = operator_edge(solution->surface, influence->density, influence->mesh, &edge);
    const struct transom *transom = solution->transom;
    size_t cells = 0, strip = transom ? transom->cells * transom->n : 0;
    if (status == IGABEM_OK) {
        cells = solution->surface->nx * solution->surface->ny;
        solution->surface_phi = malloc((cells + edge.rows + 1) * sizeof *phi);
        if (transom)
            solution->strip_phi = malloc((strip + 2 * transom->n) * sizeof *phi);
        if (!solution->surface_phi || (transom && !solution->strip_phi))
            status = solution_no_memory(cells);
    }
    if (status == IGABEM_OK) {
        memcpy(solution->surface_phi, phi, cells * sizeof *phi);
        edge_values(&edge, solution->sigma, solution->surface_phi + cells);
    }
    if (status == IGABEM_OK && transom) {
        memcpy(solution->strip_phi, phi + cells, strip * sizeof *phi);
        edge_values(&transom->rim, solution->sigma, solution->strip_phi + strip);
        for (size_t j = 0; j < transom->n; j++)
            solution->strip_phi[strip + transom->n + j] =
                solution->speed * solution->k0 * transom->depth[j];
    }
    sparse_free(&edge);
    return status;
}

/* The flow about which the surface was linearised, and what its cells radiate. */
static igabem_status keep_base(const struct influence *influence,
                               const struct exterior_system *system, igabem_solution *solution)
{
    size_t parts = BASE_FLOW_SIDE * BASE_FLOW_SIDE * system->cells;
    solution->base = malloc(system->cells * sizeof *solution->base);
    solution->cell_source = malloc(parts * sizeof *solution->cell_source);
    if (!solution->base || !solution->cell_source)
        return solution_no_memory(system->cells);
    memcpy(solution->base, system->base, system->cells * sizeof *solution->base);
    solution->surface_momentum =
        base_flow_radiate(solution->surface, solution->base, solution->surface_phi, solution->speed,
                          solution->k0, solution->cell_source);
    return fill_velocity(influence, solution->density, system->base_on_hull, 1.0,
                         &solution->base_velocity);
}

/* The matrix of a setting. */
static void fill_rows(const struct exterior_system *system, const igabem_solution *solution,
                      double *rows)
{
    double scale = 1.0 / solution->k0;
    double damping = solution->options.surface_damping / sqrt(solution->k0);
    for (size_t k = 0; k < system->n * system->n; k++)
        rows[k] = system->fixed[k] - scale * system->wave[k] - damping * system->odd[k];
}

size_t potential_unknowns(const igabem_solution *solution)
{
    const struct free_surface *surface = solution->surface;
    const struct transom *transom = solution->transom;
    return solution->density->n + surface->nx * surface->ny +
           (transom ? transom->cells * transom->n : 0);
}

igabem_status potential_factors(const struct influence *influence, const igabem_solution *solution,
                                double **factors, int **pivots)
{
    struct exterior_system system = {0};
    size_t n = potential_unknowns(solution);
    *factors = malloc(n * n * sizeof **factors);
    *pivots = malloc(n * sizeof **pivots);
    igabem_status status = *factors && *pivots ? IGABEM_OK : solution_no_memory(n);
    if (status == IGABEM_OK)
        status = exterior_system_create(influence, solution->surface, solution->transom,
                                        solution->formulation->double_model, &system);
    if (status == IGABEM_OK) {
        const struct matrix matrix = {n, n, *factors, influence->threads, influence->progress};
        fill_rows(&system, solution, *factors);
        status = linear_lu_factor(&matrix, *pivots, NULL);
    }
    exterior_system_free(&system);
    if (status != IGABEM_OK) {
        free(*factors);
        free(*pivots);
        *factors = NULL;
        *pivots = NULL;
    }
    return status;
}

/* The factors for igabem_tangent_create(). */
static igabem_status keep_factors(size_t n, const double *rows, const int *pivots,
                                  igabem_solution *solution)
{
    solution->system = malloc(n * n * sizeof *rows);
    solution->pivots = malloc(n * sizeof *pivots);
    if (!solution->system || !solution->pivots)
        return solution_no_memory(n);
    memcpy(solution->system, rows, n * n * sizeof *rows);
    memcpy(solution->pivots, pivots, n * sizeof *pivots);
    solution->memory += (double)(n * n * sizeof *rows);
    return IGABEM_OK;
}

/* Where cells are too few for the waves the differences of the free surface grow from row to row:
 * on a Wigley hull 9e4 at Fr 0.13, with C_w as by other methods, and 9e13 at 0.12, with C_w 0.03.
 */
static const double most_condition = 1e9;

static igabem_status check_condition(const igabem_solution *solution)
{
    if (solution->condition <= most_condition)
        return IGABEM_OK;
    return igabem_fail(IGABEM_ERROR_NUMERIC,
                       "%s at Fr %g: a condition number of %.2g, so too few cells of the free "
                       "surface along a transverse wave of %.3g m: state more surface_cells",
                       solution->formulation->name, solution->options.froude, solution->condition,
                       2.0 * PI / solution->k0);
}

static igabem_status solve_one(const struct influence *influence,
                               const struct exterior_system *system, double *rows,
                               igabem_solution *solution)
{
    size_t n = system->n;
    double *right = malloc(n * sizeof *right);
    int *pivots = malloc(n * sizeof *pivots);
    const struct matrix matrix = {n, n, rows, influence->threads, influence->progress};
    igabem_status status = right && pivots ? IGABEM_OK : solution_no_memory(n);
    if (status == IGABEM_OK) {
        fill_rows(system, solution, rows);
        for (size_t i = 0; i < n; i++)
            right[i] = solution->speed * (system->right[i] + solution->k0 * system->slope[i] -
                                          system->known[i] / solution->k0);
        status = linear_lu_factor(&matrix, pivots, &solution->condition);
    }
    if (status == IGABEM_OK)
        status = check_condition(solution);
    if (status == IGABEM_OK)
        status = linear_lu_solve(&matrix, pivots, false, 1, right);
    solution->options.solver = IGABEM_SOLVER_LU;
    solution->memory = 4.0 * (double)(n * n * sizeof *rows);
    if (status == IGABEM_OK && solution->options.keep_system != 0.0)
        status = keep_factors(n, rows, pivots, solution);
    if (status == IGABEM_OK) {
        memcpy(solution->sigma, right, system->hull * sizeof *right);
        status = keep_surface(influence, solution, right + system->hull);
    }
    if (status == IGABEM_OK && system->base)
        status = keep_base(influence, system, solution);
    if (status == IGABEM_OK)
        status = fill_velocity(influence, solution->density, solution->sigma, solution->speed,
                               &solution->velocity);
    free(right);
    free(pivots);
    return status;
}

/* Those of solutions[n] that have the free surface of the first; they are marked. */
static igabem_status solve_alike(const struct influence *influence, size_t n,
                                 igabem_solution *const *solutions, bool *done, double share,
                                 struct progress *progress)
{
    struct exterior_system system = {0};
    struct free_surface *surface = NULL;
    struct transom *transom = NULL;
    double start = wall_seconds(), fraction = progress->done;
    size_t alike = 0;
    for (size_t m = 0; m < n; m++)
        alike += !done[m] && same_surface(&solutions[0]->options, &solutions[m]->options);
    igabem_status status = make_surface(influence, solutions[0], &surface, &transom);
    /* The integrals of all are half of it. */
    progress_stage(progress, fraction + 0.5 * share * (double)alike, 1);
    fraction += 0.5 * share * (double)alike;
    if (status == IGABEM_OK)
        status = exterior_system_create(influence, surface, transom,
                                        solutions[0]->formulation->double_model, &system);
    double *rows = status == IGABEM_OK ? malloc(system.n * system.n * sizeof *rows) : NULL;
    if (status == IGABEM_OK && !rows)
        status = solution_no_memory(system.n);
    double common = (wall_seconds() - start) / (double)alike;
    for (size_t m = 0; m < n && status == IGABEM_OK; m++) {
        if (done[m] || !same_surface(&solutions[0]->options, &solutions[m]->options))
            continue;
        done[m] = true;
        start = wall_seconds();
        progress_stage(progress, fraction + 0.5 * share, 1);
        status = solve_one(influence, &system, rows, solutions[m]);
        solutions[m]->seconds = common + wall_seconds() - start;
        fraction += 0.5 * share;
        if (status == IGABEM_OK)
            status = progress_report(progress, fraction);
    }
    free(rows);
    free_surface_free(surface);
    transom_free(transom);
    exterior_system_free(&system);
    return status;
}

igabem_status potential_solve(struct influence *influence, size_t n,
                              igabem_solution *const *solutions, double share,
                              struct progress *progress)
{
    bool *done = calloc(n, sizeof *done);
    igabem_status status = done ? IGABEM_OK : solution_no_memory(n);
    for (size_t m = 0; m < n && status == IGABEM_OK; m++)
        status = check(solutions[m]);
    for (size_t m = 0; m < n && status == IGABEM_OK; m++)
        if (!done[m])
            status = solve_alike(influence, n - m, solutions + m, done + m, share, progress);
    free(done);
    return status;
}
