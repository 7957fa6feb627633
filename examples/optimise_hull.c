/* An optimiser of one's own from the four libraries: a hull file, a family of shapes, their latent
 * space, a search for less wave resistance at the same displacement, a better hull as IGES.
 *   example_optimise_hull HULL FROUDE BETTER.igs [EVALUATIONS]
 * HULL has one patch for its side, up to a deck above the water (hulls/dtmb5415.json). */
#include <bayesopt/bayesopt.h>
#include <galv/galv.h>
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SECTIONS = 60, GIRTH = 20, POINTS = SECTIONS * GIRTH };
enum { ALONG = 7, ACROSS = 3, UP = 5, MOST = 64 };
static const double SIDEWAYS = 0.06; /* a control point moves by this share of the half breadth */
static const double BAND = 0.02;     /* the displacement stays within this share */

/* What every design is compared with. */
struct problem {
    nurbs_hull *parent;
    nurbs_grid *grid; /* of the design at hand */
    galv_model *model;
    igabem_options solver;
    double volume;
};

/* Sideways moves of the inner control points of a lattice around the hull: ends, centre plane and
 * keel stay. */
static galv_status family(const nurbs_grid *grid, galv_shape **shape)
{
    galv_lattice lattice = {.count = {ALONG, ACROSS, UP}, .degree = {3, 2, 3}};
    galv_status status = galv_box_around(POINTS, nurbs_grid_points(grid), &lattice.box);
    if (status != GALV_OK)
        return status;
    galv_lattice_move moves[MOST];
    double lower[MOST], upper[MOST];
    size_t n = 0;
    for (size_t i = 1; i + 1 < ALONG; i++)
        for (size_t j = 1; j < ACROSS; j++)
            for (size_t k = 1; k < UP; k++, n++) {
                moves[n] = (galv_lattice_move){.index = {i, j, k}, .direction = 1};
                upper[n] = SIDEWAYS * lattice.box.length[1];
                lower[n] = -upper[n];
            }
    return galv_shape_ffd(&lattice, n, moves, lower, upper, shape);
}

/* Filter, mesh and stern treatment stay the parent's. */
static igabem_status freeze(const nurbs_hull *parent, igabem_options *solver)
{
    igabem_hull *body = NULL;
    igabem_status status = igabem_hull_from(parent, &body);
    if (!status)
        status = igabem_options_freeze(body, solver);
    igabem_hull_free(body);
    return status;
}

/* The hull of a latent point. */
static nurbs_status build(struct problem *p, const double *u, nurbs_hull **hull)
{
    *hull = NULL;
    if (galv_displace(p->model, u, nurbs_grid_edit(p->grid)) != GALV_OK)
        return NURBS_ERROR_ARGUMENT;
    return nurbs_hull_rebuild(p->parent, p->grid, hull);
}

static bayesopt_status evaluate(struct problem *p, bayesopt *bo, uint64_t id, const double *u)
{
    nurbs_hull *hull;
    igabem_forces forces;
    bayesopt_status told;
    if (build(p, u, &hull) != NURBS_OK) {
        told = bayesopt_tell_failed(bo, id, nurbs_last_error());
    } else if (igabem_solve_hull(hull, &p->solver, &forces) != IGABEM_OK) {
        told = bayesopt_tell_failed(bo, id, igabem_last_error());
    } else {
        double change = nurbs_hull_hydrostatics(hull)->volume / p->volume - 1;
        told = bayesopt_tell(bo, id, forces.cw, &(double){fabs(change) - BAND});
    }
    nurbs_hull_free(hull);
    return told;
}

static int failed(const char *sentence)
{
    fprintf(stderr, "optimise_hull: %s\n", sentence);
    return EXIT_FAILURE;
}

int main(int argc, char **argv)
{
    struct problem p = {0};
    nurbs_hull *best = NULL, *first = NULL;
    galv_shape *shape = NULL;
    bayesopt *bo = NULL;
    igabem_forces forces;
    double u[MOST] = {0}, before, after;
    uint64_t id;
    if (argc < 4)
        return failed("expected HULL FROUDE BETTER.igs [EVALUATIONS]");
    if (nurbs_hull_read(argv[1], NULL, &p.parent) != NURBS_OK ||
        nurbs_hull_design_grid(p.parent, SECTIONS, GIRTH, &p.grid) != NURBS_OK)
        return failed(nurbs_last_error());
    if (family(p.grid, &shape) != GALV_OK ||
        galv_build(shape, POINTS, nurbs_grid_points(p.grid), galv_uniform(2000, 1), NULL,
                   &p.model) != GALV_OK)
        return failed(galv_last_error());
    igabem_options_init(&p.solver);
    p.solver.froude = strtod(argv[2], NULL);
    if (build(&p, u, &first) != NURBS_OK)
        return failed(nurbs_last_error());
    p.volume = nurbs_hull_hydrostatics(first)->volume;
    if (freeze(first, &p.solver) != IGABEM_OK ||
        igabem_solve_hull(first, &p.solver, &forces) != IGABEM_OK)
        return failed(igabem_last_error());
    before = forces.cw;
    printf("C_w %.4e; %zu latent variables of %zu parameters hold %.1f %% of their variance\n",
           before, galv_model_modes(p.model), galv_model_parameters(p.model),
           100 * galv_model_retained(p.model));

    bayesopt_options options;
    bayesopt_options_init(&options);
    options.n_constraints = 1;
    options.max_evaluations = argc > 4 ? strtoul(argv[4], NULL, 10) : 60;
    options.initial_n = options.max_evaluations / 2;
    if (bayesopt_create(galv_model_modes(p.model), galv_model_lower(p.model),
                        galv_model_upper(p.model), &options, &bo) != BAYESOPT_OK ||
        bayesopt_tell_point(bo, u, before, &(double){-BAND}) != BAYESOPT_OK)
        return failed(bayesopt_last_error());
    while (bayesopt_ask(bo, 1, u, &id) == BAYESOPT_OK && evaluate(&p, bo, id, u) == BAYESOPT_OK)
        ;
    if (bayesopt_best(bo, u, &after, NULL) != BAYESOPT_OK)
        return failed(bayesopt_last_error());
    if (build(&p, u, &best) != NURBS_OK || nurbs_hull_write(best, NULL, argv[3]) != NURBS_OK)
        return failed(nurbs_last_error());
    printf("C_w %.4e, %+.1f %%; displacement %+.2f %%; %s\n", after, 100 * (after / before - 1),
           100 * (nurbs_hull_hydrostatics(best)->volume / p.volume - 1), argv[3]);

    bayesopt_free(bo);
    galv_model_free(p.model);
    galv_shape_free(shape);
    nurbs_grid_free(p.grid);
    nurbs_hull_free(best);
    nurbs_hull_free(first);
    nurbs_hull_free(p.parent);
    return after < before ? EXIT_SUCCESS : EXIT_FAILURE;
}
