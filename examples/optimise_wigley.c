/* The Wigley hull made better from nothing but the libraries: six sine modifications, their latent
 * space, 20 designs at Fr 0.316, displacement within 1 %. The gain is what one model claims. */
#include <bayesopt/bayesopt.h>
#include <galv/galv.h>
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SECTIONS = 31, GIRTH = 11, FUNCTIONS = 6, DESIGNS = 20 };
#define A 0.002 /* m: a fiftieth of the beam */

static int failed(const char *sentence)
{
    fprintf(stderr, "optimise_wigley: %s\n", sentence);
    return EXIT_FAILURE;
}

/* Sideways sine products; stem, stern and keel stay. */
static galv_status family(galv_shape **shape)
{
    const galv_box box = {{-0.5, 0, -0.0625}, {1, 0.1, 0.125}};
    const double lower[] = {-A, -A, -A, -A, -A, -A}, upper[] = {A, A, A, A, A, A};
    galv_sine functions[FUNCTIONS];
    for (int i = 0; i < FUNCTIONS; i++)
        functions[i] = (galv_sine){.order = {1 + i % 3, 1, 1 + i / 3}, .direction = 1};
    return galv_shape_sine(FUNCTIONS, functions, &box, lower, upper, GALV_COMBINATION_RECURSIVE,
                           shape);
}

static nurbs_status wigley(nurbs_hull **hull, nurbs_grid **grid)
{
    nurbs_surface *side = NULL;
    nurbs_status status = nurbs_make_wigley(1, 0.1, 0.0625, &side);
    if (!status)
        status = nurbs_hull_create_surfaces(1, (const nurbs_surface *[]){side}, NULL, hull);
    if (!status)
        status = nurbs_hull_design_grid(*hull, SECTIONS, GIRTH, grid);
    nurbs_surface_free(side);
    return status;
}

int main(void)
{
    nurbs_hull *parent = NULL, *hull;
    nurbs_grid *grid = NULL;
    galv_shape *shape = NULL;
    galv_model *model = NULL;
    bayesopt *bo = NULL;
    igabem_options solver;
    igabem_forces first, forces;
    double u[FUNCTIONS] = {0}, best;
    uint64_t id;
    if (wigley(&parent, &grid) != NURBS_OK)
        return failed(nurbs_last_error());
    if (family(&shape) != GALV_OK ||
        galv_build(shape, (size_t)SECTIONS * GIRTH, nurbs_grid_points(grid), galv_uniform(500, 1),
                   NULL, &model) != GALV_OK)
        return failed(galv_last_error());
    igabem_options_init(&solver);
    solver.froude = 0.316;
    solver.elements_u = 20; /* the same density on every design */
    solver.elements_v = 6;
    solver.cutoff_angle = 1.2 / 0.2; /* and the same filter: 1.2 over nu_s = 2 B/L */
    solver.stem_limit = 2 * 0.2;
    if (igabem_solve_hull(parent, &solver, &first) != IGABEM_OK)
        return failed(igabem_last_error());
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.max_evaluations = DESIGNS;
    options.initial_n = DESIGNS / 2;
    options.n_constraints = 1;
    if (bayesopt_create(galv_model_modes(model), galv_model_lower(model), galv_model_upper(model),
                        &options, &bo) != BAYESOPT_OK ||
        bayesopt_tell_point(bo, u, first.cw, &(double){-0.01}) != BAYESOPT_OK)
        return failed(bayesopt_last_error());
    while (bayesopt_ask(bo, 1, u, &id) == BAYESOPT_OK) {
        hull = NULL;
        if (galv_displace(model, u, nurbs_grid_edit(grid)) != GALV_OK ||
            nurbs_hull_rebuild(parent, grid, &hull) != NURBS_OK)
            bayesopt_tell_failed(bo, id, nurbs_last_error());
        else if (igabem_solve_hull(hull, &solver, &forces) != IGABEM_OK)
            bayesopt_tell_failed(bo, id, igabem_last_error());
        else
            bayesopt_tell(bo, id, forces.cw,
                          &(double){fabs(forces.volume / first.volume - 1) - 0.01});
        nurbs_hull_free(hull);
    }
    if (bayesopt_best(bo, u, &best, NULL) != BAYESOPT_OK)
        return failed(bayesopt_last_error());
    printf("C_w %.4e -> %.4e (%+.1f %%)\n", first.cw, best, 100 * (best / first.cw - 1));
    bayesopt_free(bo);
    galv_model_free(model);
    galv_shape_free(shape);
    nurbs_grid_free(grid);
    nurbs_hull_free(parent);
    return best < first.cw ? EXIT_SUCCESS : EXIT_FAILURE;
}
