/* A descent by the solver's derivatives: a hull file, shapes, their latent space, Gauss-Newton
 * steps at the same displacement, IGES: example_descend_hull HULL FROUDE BETTER.igs (as
 * optimise_hull) */
#include <bayesopt/bayesopt.h>
#include <galv/galv.h>
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SECTIONS = 60, GIRTH = 20, SINES = 5, MOST = 2 * SINES };
static const double PI = 3.14159265358979, SIDEWAYS = 0.1, BAND = 0.018, STEP = 0.1; /* shares */
struct problem {
    nurbs_hull *parent;
    nurbs_grid *grid; /* of the design at hand */
    galv_model *model;
    galv_limits *limits;
    igabem_options solver;
};
struct design {
    nurbs_hull *hull;
    igabem_hull *body;
    igabem_solution *flow;
};

static bool latent_space(size_t n, const double *xyz, galv_model **model)
{
    galv_box box;
    galv_sine sine[MOST];
    galv_shape *shape = NULL;
    double low[MOST], high[MOST];
    for (int k = 0; k < MOST; k++) { /* sines along the hull, alike at all depths, and cosines */
        sine[k] = (galv_sine){{k % SINES + 1, 0, k / SINES}, {0, PI / 2, PI / 2}, 1};
        low[k] = -(high[k] = SIDEWAYS); /* of the half breadth */
    }
    bool ok = !galv_box_around(n, xyz, &box) &&
              !galv_shape_sine(MOST, sine, &box, low, high, GALV_COMBINATION_SCALED, &shape) &&
              !galv_build(shape, n, xyz, galv_uniform(500, 1), NULL, model);
    galv_shape_free(shape);
    return ok;
}

static void clear(struct design *d)
{
    igabem_solution_free(d->flow);
    igabem_hull_free(d->body);
    nurbs_hull_free(d->hull);
    *d = (struct design){0};
}

static bool build(struct problem *p, const double *u, bool solve, struct design *d)
{
    clear(d);
    return galv_displace(p->model, u, nurbs_grid_edit(p->grid)) == GALV_OK &&
           nurbs_hull_rebuild(p->parent, p->grid, &d->hull) == NURBS_OK &&
           igabem_hull_from(d->hull, &d->body) == IGABEM_OK &&
           (!solve || igabem_solve(d->body, &p->solver, &d->flow) == IGABEM_OK);
}

static bayesopt_descent_answer value(void *problem, const double *u, bayesopt_descent_sample *s)
{
    struct design d = {0};
    igabem_forces forces;
    bool ok = build(problem, u, true, &d) && igabem_forces_compute(d.flow, &forces) == IGABEM_OK &&
              igabem_wave_residuals(d.flow, s->residual) == IGABEM_OK;
    s->value[0] = ok ? forces.cw : 0;
    clear(&d);
    return ok ? BAYESOPT_DESCENT_VALUED : BAYESOPT_DESCENT_FAILED;
}

/* Moves of the control points by a step in each variable, then all derivatives at once. */
static bayesopt_descent_answer slopes(void *problem, const double *u, bayesopt_descent_slopes *s)
{
    struct problem *p = problem;
    struct design d = {0}, beside = {0};
    igabem_tangent *tangent = NULL;
    size_t modes = galv_model_modes(p->model);
    bool ok = build(p, u, true, &d);
    const nurbs_surface *side = nurbs_patches_get(nurbs_hull_light(d.hull), 0);
    size_t n = 3 * nurbs_surface_size(side, 0) * nurbs_surface_size(side, 1);
    double *move = calloc(modes * n + 1, sizeof *move), at[MOST];
    for (size_t k = 0; k < modes && ok && move; k++) {
        memcpy(at, u, modes * sizeof *at);
        at[k] += STEP * (u[k] > 0 ? galv_model_lower(p->model) : galv_model_upper(p->model))[k];
        ok = build(p, at, false, &beside) &&
             nurbs_hull_moves(d.hull, beside.hull, move + k * n) == NURBS_OK;
        for (size_t i = 0; i < n; i++) /* the cut may shift points along the surface */
            move[k * n + i] *= i % 3 == 1 ? 1 / (at[k] - u[k]) : 0;
    }
    s->known[0] = ok && igabem_tangent_create(d.body, d.flow, modes, move, &tangent) == IGABEM_OK &&
                  igabem_tangent_residuals(tangent, s->residual) == IGABEM_OK;
    igabem_tangent_free(tangent);
    clear(&beside);
    clear(&d);
    free(move);
    return BAYESOPT_DESCENT_VALUED;
}

static int limit(void *p, size_t d, const double *u, double *excess)
{
    (void)d; /* less displacement has less waves: more is not limited */
    *excess = galv_limits_volume(((struct problem *)p)->limits, u, excess) ? 1 : 1 - BAND - *excess;
    return 0;
}

int main(int argc, char **argv)
{
    double u[MOST] = {0}, ratio = 1;
    struct problem p = {0};
    struct design d = {0};
    igabem_options_init(&p.solver);
    p.solver.froude = argc > 3 ? strtod(argv[2], NULL) : 0;
    p.solver.elements_u = 20; /* a light mesh, for looking around */
    p.solver.elements_v = 6;
    p.solver.keep_system = 1; /* for the tangents */
    bool ok = argc > 3 && !nurbs_hull_read(argv[1], NULL, &p.parent) &&
              !nurbs_hull_design_grid(p.parent, SECTIONS, GIRTH, &p.grid) &&
              !nurbs_hull_share_space(p.parent, p.grid, 0, NULL) &&
              latent_space(SECTIONS * GIRTH, nurbs_grid_points(p.grid), &p.model) &&
              !galv_limits_create(p.model, SECTIONS, GIRTH, 1, &p.limits) &&
              build(&p, u, false, &d) && !igabem_options_freeze(d.body, &p.solver);
    const bayesopt_descent_problem search = {.d = galv_model_modes(p.model),
                                             .lower = galv_model_lower(p.model),
                                             .upper = galv_model_upper(p.model),
                                             .n_settings = 1,
                                             .setting = &(bayesopt_descent_setting){0, 1},
                                             .n_residuals = IGABEM_WAVE_RESIDUALS,
                                             .bound = NAN,
                                             .n_limits = 1,
                                             .limit = limit,
                                             .fine = value,
                                             .derivatives = slopes,
                                             .user_data = &p};
    ok = ok && bayesopt_descend(&search, u, &ratio) >= 0 && build(&p, u, false, &d) &&
         !nurbs_hull_write(d.hull, NULL, argv[3]);
    if (ok)
        printf("C_w %+.1f %%, %zu variables: %s\n", 100 * (ratio - 1), search.d, argv[3]);
    else
        fprintf(stderr, "HULL FROUDE BETTER.igs: %s %s %s %s\n", nurbs_last_error(),
                galv_last_error(), igabem_last_error(), bayesopt_last_error());
    clear(&d);
    galv_limits_free(p.limits);
    galv_model_free(p.model);
    nurbs_grid_free(p.grid);
    nurbs_hull_free(p.parent);
    return ok && ratio < 1 ? EXIT_SUCCESS : EXIT_FAILURE;
}
