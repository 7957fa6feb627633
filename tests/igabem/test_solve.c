/* The solver as its callers see it: settings, shared work, formulations, refusals. */
#include "check.h"
#include "hulls.h"

#include <stdint.h>
#include <string.h>

static igabem_solution *solve(const igabem_hull *hull, const igabem_options *options)
{
    igabem_solution *solution = NULL;
    igabem_status status = igabem_solve(hull, options, &solution);
    if (status != IGABEM_OK)
        fprintf(stderr, "solve: %s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    return solution;
}

static igabem_forces forces_of(const igabem_solution *solution)
{
    igabem_forces forces;
    CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    return forces;
}

static double cw_of(const igabem_hull *hull, const igabem_options *options)
{
    igabem_solution *solution = solve(hull, options);
    double cw = forces_of(solution).cw;
    igabem_solution_free(solution);
    return cw;
}

static igabem_options setting(int nu, int nv)
{
    igabem_options options;
    igabem_options_init(&options);
    options.refine = 1;
    options.froude = 0.3;
    options.elements_u = nu;
    options.elements_v = nv;
    return options;
}

static void test_names(void)
{
    igabem_formulation f;
    CU_ASSERT_TRUE(igabem_formulation_parse("hogner", &f));
    CU_ASSERT_EQUAL(f, IGABEM_FORMULATION_HOGNER);
    CU_ASSERT_STRING_EQUAL(igabem_formulation_name(IGABEM_FORMULATION_NEUMANN_KELVIN_STERN),
                           "neumann-kelvin-stern");
    CU_ASSERT_FALSE(igabem_formulation_parse("kelvin", &f));
    CU_ASSERT_PTR_NULL(igabem_formulation_name((igabem_formulation)99));
}

static void test_freeze(void)
{
    igabem_hull *wigley = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_hull *spheroid = ellipsoid_hull(1.0, 0.2, 0.2, 0.2, 1, 1);
    igabem_hull_info info;
    igabem_hull_get_info(wigley, &info);
    igabem_options options;
    igabem_options_init(&options);
    options.froude = 0.3;
    CU_ASSERT_EQUAL(igabem_options_freeze(wigley, &options), IGABEM_OK);
    CHECK_CLOSE(options.cutoff_angle, 1.2 / info.nu_s, 1e-12);
    CHECK_CLOSE(options.stem_limit, 2.0 * info.nu_s, 1e-12);
    CU_ASSERT_EQUAL(options.formulation, IGABEM_FORMULATION_NEUMANN_KELVIN);
    CU_ASSERT_TRUE(options.refine > 1 && options.refine_v > 1);
    CU_ASSERT_EQUAL(options.elements_u, 0);
    CU_ASSERT_EQUAL(options.line_term, 1);
    igabem_options_init(&options);
    options.refine = 1;
    options.froude = 0.3;
    CU_ASSERT_EQUAL(igabem_options_freeze(spheroid, &options), IGABEM_OK);
    CU_ASSERT(isinf(options.cutoff_angle));
    CU_ASSERT_EQUAL(options.line_term, 0);
    igabem_hull_free(wigley);
    igabem_hull_free(spheroid);
}

/* Hulls with knots here and there get uniform ones for their density, in the proportion of their
 * spans and enough for 400 unknowns, which `refine` divides. */
static void test_irregular_knots(void)
{
    nurbs_surface *surface = NULL, *crowded = NULL;
    const double knots[4] = {0.1, 0.12, 0.14, 0.8};
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(1.0, 0.1, 0.0625, &surface), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_insert(surface, 0, 4, knots, &crowded), NURBS_OK);
    igabem_hull *hull = NULL, *plain = wigley_hull(0.1, 0.0625, 1, 1);
    CU_ASSERT_EQUAL_FATAL(
        igabem_hull_create((const nurbs_surface *const *)&crowded, 1, IGABEM_SYMMETRIC, &hull),
        IGABEM_OK);
    igabem_options options;
    igabem_options_init(&options);
    options.froude = 0.3;
    CU_ASSERT_EQUAL(igabem_options_freeze(hull, &options), IGABEM_OK);
    CU_ASSERT_EQUAL(options.refine, 1);
    CU_ASSERT_EQUAL(options.refine_v, 1);
    int nu = options.elements_u, nv = options.elements_v, unknowns = (nu + 3) * (nv + 3);
    CHECK_CLOSE((double)nu / nv, 5.0, 0.5);
    CU_ASSERT_TRUE(unknowns >= 400 && unknowns < 480);
    /* Asked for as the command does, the same mesh. */
    igabem_options_init(&options);
    options.froude = 0.3;
    igabem_options_refine(hull, 400, &options);
    CU_ASSERT_EQUAL(igabem_options_freeze(hull, &options), IGABEM_OK);
    CU_ASSERT_TRUE(options.refine == 1 && options.refine_v == 1);
    CU_ASSERT_TRUE(options.elements_u == nu && options.elements_v == nv);
    igabem_options same = setting(nu, nv);
    CHECK_RELATIVE(cw_of(hull, &options), cw_of(plain, &same), 1e-5);
    options.elements_u = 5;
    options.elements_v = 1;
    options.refine = options.refine_v = 2;
    same = setting(10, 2);
    CHECK_RELATIVE(cw_of(hull, &options), cw_of(plain, &same), 1e-5);
    nurbs_surface_free(surface);
    nurbs_surface_free(crowded);
    igabem_hull_free(hull);
    igabem_hull_free(plain);
}

/* Several settings at once give what each gives alone. */
static void test_many(void)
{
    enum { N = 6 };
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_options options[N];
    for (int k = 0; k < N; k++)
        options[k] = setting(6, 2);
    options[1].froude = 0.4;
    options[2].formulation = IGABEM_FORMULATION_NEUMANN_KELVIN_STERN;
    options[3].formulation = IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN;
    options[4].formulation = IGABEM_FORMULATION_HOGNER;
    options[5].elements_u = 5;
    igabem_solution *solutions[N];
    CU_ASSERT_EQUAL_FATAL(igabem_solve_many(hull, N, options, solutions), IGABEM_OK);
    for (int k = 0; k < N; k++) {
        igabem_solution *alone = solve(hull, &options[k]);
        igabem_forces a = forces_of(solutions[k]), b = forces_of(alone);
        CU_ASSERT(a.cw > 0);
        CHECK_RELATIVE(a.cw, b.cw, 1e-12);
        CU_ASSERT_EQUAL(a.dofs, b.dofs);
        CU_ASSERT_EQUAL(isnan(a.condition), k == 4);
        igabem_solution_free(alone);
        igabem_solution_free(solutions[k]);
    }
    igabem_hull_free(hull);
}

/* C_w at 0.85 and 1.15 of the cut-off is that of separate solves. */
static void test_sensitivity(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_options options = setting(6, 2);
    CU_ASSERT_EQUAL_FATAL(igabem_options_freeze(hull, &options), IGABEM_OK);
    options.sensitivity = 1;
    igabem_solution *solution = solve(hull, &options);
    igabem_forces forces = forces_of(solution);
    igabem_solution_free(solution);
    options.sensitivity = 0;
    double angle = options.cutoff_angle;
    options.cutoff_angle = 0.85 * angle;
    CHECK_RELATIVE(forces.cw_cutoff_lower, cw_of(hull, &options), 1e-5);
    options.cutoff_angle = 1.15 * angle;
    CHECK_RELATIVE(forces.cw_cutoff_upper, cw_of(hull, &options), 1e-5);
    CU_ASSERT(fabs(forces.cw_cutoff_upper / forces.cw_cutoff_lower - 1.0) > 1e-4);
    igabem_hull_free(hull);
}

/* Largest difference of two source densities on a grid, over the largest value. */
static double density_gap(const igabem_solution *a, const igabem_solution *b)
{
    enum { SIDE = 9 };
    double uv[2 * SIDE * SIDE], va[SIDE * SIDE], vb[SIDE * SIDE], gap = 0.0, scale = 0.0;
    for (int k = 0; k < SIDE * SIDE; k++) {
        uv[2 * k] = (0.5 + k / SIDE) / SIDE;
        uv[2 * k + 1] = (0.5 + k % SIDE) / SIDE;
    }
    CU_ASSERT_EQUAL(igabem_source_density(a, 0, SIDE * SIDE, uv, va), IGABEM_OK);
    CU_ASSERT_EQUAL(igabem_source_density(b, 0, SIDE * SIDE, uv, vb), IGABEM_OK);
    for (int k = 0; k < SIDE * SIDE; k++) {
        gap = fmax(gap, fabs(va[k] - vb[k]));
        scale = fmax(scale, fabs(vb[k]));
    }
    return gap / scale;
}

/* GMRES gives what LU gives, with its condition estimate, on a Wigley hull with and without rows of
 * the double body at the stern and on a submerged spheroid. */
static void test_solvers(void)
{
    for (int k = 0; k < 3; k++) {
        igabem_hull *hull =
            k < 2 ? wigley_hull(0.1, 0.0625, 1, 1) : ellipsoid_hull(1.0, 0.2, 0.2, 0.16, 1, 1);
        igabem_options options = k < 2 ? setting(12, 4) : setting(6, 6);
        options.sensitivity = 1;
        if (k == 1)
            options.formulation = IGABEM_FORMULATION_NEUMANN_KELVIN_STERN;
        options.solver = IGABEM_SOLVER_LU;
        igabem_solution *lu = solve(hull, &options);
        options.solver = IGABEM_SOLVER_GMRES;
        igabem_solution *gmres = solve(hull, &options);
        igabem_forces a = forces_of(gmres), b = forces_of(lu);
        CU_ASSERT_EQUAL(igabem_solution_options(gmres)->solver, IGABEM_SOLVER_GMRES);
        CU_ASSERT(a.iterations > 0 && a.iterations < 60);
        CU_ASSERT(a.residual <= 1e-12);
        CU_ASSERT(b.iterations == 0 && isnan(b.residual));
        CU_ASSERT(density_gap(gmres, lu) < 1e-8);
        CHECK_RELATIVE(a.cw, b.cw, 1e-8);
        CHECK_RELATIVE(a.cw_pressure, b.cw_pressure, 1e-8);
        if (k < 2) {
            CHECK_RELATIVE(a.cw_cutoff_lower, b.cw_cutoff_lower, 1e-8);
            CHECK_RELATIVE(a.cw_cutoff_upper, b.cw_cutoff_upper, 1e-8);
        }
        CHECK_RELATIVE(a.condition, b.condition, 0.01);
        igabem_solution_free(lu);
        options.solver = IGABEM_SOLVER_AUTO;
        lu = solve(hull, &options);
        CU_ASSERT_EQUAL(igabem_solution_options(lu)->solver, IGABEM_SOLVER_LU);
        igabem_solution_free(lu);
        igabem_solution_free(gmres);
        igabem_hull_free(hull);
    }
}

/* With x_s at the stern the variant is plain Neumann-Kelvin, at the bow it is the double body. */
static void test_stern_limits(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_options options = setting(6, 2), stern = options;
    stern.formulation = IGABEM_FORMULATION_NEUMANN_KELVIN_STERN;
    stern.stern_length = 0.0;
    stern.stern_blend = 0.0;
    double plain = cw_of(hull, &options);
    CHECK_RELATIVE(cw_of(hull, &stern), plain, 1e-12);
    stern.stern_length = 1.0;
    options.formulation = IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN;
    double body = cw_of(hull, &options);
    CHECK_RELATIVE(cw_of(hull, &stern), body, 1e-12);
    CU_ASSERT(fabs(plain / body - 1.0) > 0.01);
    igabem_hull_free(hull);
}

/* x_s by rule: a share of the length, shorter with the waves below Fr 0.35; a given one is kept. */
static void test_stern_rule(void)
{
    static const double expected[][2] = {
        {0.20, 0.35 * 16.0 / 49.0}, {0.28, 0.224}, {0.35, 0.35}, {0.45, 0.35}};
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 1, 1);
    for (size_t k = 0; k < sizeof expected / sizeof expected[0]; k++) {
        igabem_options options;
        igabem_options_init(&options);
        options.refine = 1;
        options.froude = expected[k][0];
        CU_ASSERT_EQUAL(igabem_options_freeze(hull, &options), IGABEM_OK);
        CHECK_RELATIVE(options.stern_length, expected[k][1], 1e-14);
        options.froude = 0.35; /* frozen: stays */
        CU_ASSERT_EQUAL(igabem_options_freeze(hull, &options), IGABEM_OK);
        CHECK_RELATIVE(options.stern_length, expected[k][1], 1e-14);
        options.stern_length = 1.5;
        CU_ASSERT_EQUAL(igabem_options_freeze(hull, &options), IGABEM_ERROR_ARGUMENT);
    }
    igabem_options body;
    igabem_options_init(&body);
    body.refine = 1;
    body.kernel = IGABEM_KERNEL_DOUBLE_BODY;
    CU_ASSERT_EQUAL(igabem_options_freeze(hull, &body), IGABEM_OK);
    CU_ASSERT(isfinite(body.stern_length));
    igabem_hull_free(hull);
}

/* A body given whole, both sides as patches, makes the waves of the half with its image. */
static void test_both_sides(void)
{
    nurbs_surface *sides[2] = {NULL, NULL};
    const double mirror[9] = {1, 0, 0, 0, -1, 0, 0, 0, 1}, shift[3] = {0, 0, 0};
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(1.0, 0.1, 0.0625, &sides[0]), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(sides[0], mirror, shift, &sides[1]), NURBS_OK);
    igabem_hull *whole = NULL, *half = wigley_hull(0.1, 0.0625, 1, 1);
    CU_ASSERT_EQUAL_FATAL(igabem_hull_create((const nurbs_surface *const *)sides, 2, 0, &whole),
                          IGABEM_OK);
    igabem_options options = setting(6, 2);
    CU_ASSERT_EQUAL_FATAL(igabem_options_freeze(half, &options), IGABEM_OK);
    options.tolerance = 1e-7;
    igabem_solution *a = solve(half, &options), *b = solve(whole, &options);
    igabem_forces fa = forces_of(a), fb = forces_of(b);
    CU_ASSERT_EQUAL(fb.dofs, 2 * fa.dofs);
    CHECK_RELATIVE(fb.cw, fa.cw, 1e-6);
    const double uv[2] = {0.3, 0.4};
    double va[3], vb[3];
    CU_ASSERT_EQUAL(igabem_surface_velocity(a, 0, 1, uv, va, NULL), IGABEM_OK);
    CU_ASSERT_EQUAL(igabem_surface_velocity(b, 1, 1, uv, vb, NULL), IGABEM_OK);
    CHECK_CLOSE(vb[0], va[0], 1e-5);
    CHECK_CLOSE(vb[1], -va[1], 1e-5);
    CHECK_CLOSE(vb[2], va[2], 1e-5);
    igabem_solution_free(a);
    igabem_solution_free(b);
    igabem_hull_free(whole);
    igabem_hull_free(half);
    nurbs_surface_free(sides[0]);
    nurbs_surface_free(sides[1]);
}

/* C_w of a body divided at its middle parameters, nu x nv elements on all of it. */
static double divided(const nurbs_surface *whole, int along, int around, int nu, int nv,
                      double froude)
{
    nurbs_surface *part[4] = {NULL};
    size_t n = 0;
    for (int i = 0; i <= along; i++) {
        nurbs_surface *strip = NULL;
        const double u[2] = {along ? 0.5 * i : 0.0, along ? 0.5 * (i + 1) : 1.0};
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_part(whole, 0, u[0], u[1], &strip), NURBS_OK);
        for (int j = 0; j <= around; j++) {
            const double v[2] = {around ? 0.5 * j : 0.0, around ? 0.5 * (j + 1) : 1.0};
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_part(strip, 1, v[0], v[1], &part[n++]), NURBS_OK);
        }
        nurbs_surface_free(strip);
    }
    igabem_hull *hull = NULL;
    igabem_status status =
        igabem_hull_create((const nurbs_surface *const *)part, n, IGABEM_SYMMETRIC, &hull);
    if (status != IGABEM_OK)
        fprintf(stderr, "hull: %s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    igabem_options options = setting(nu, nv);
    options.froude = froude;
    double cw = cw_of(hull, &options);
    printf("\n    %zu patches: C_w %.6e", n, cw);
    igabem_hull_free(hull);
    while (n > 0)
        nurbs_surface_free(part[--n]);
    return cw;
}

/* The density may jump from patch to patch; what it radiates does not, within the mesh error. */
static void test_divided_hull(void)
{
    nurbs_surface *wigley = NULL, *spheroid = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(1.0, 0.1, 0.0625, &wigley), NURBS_OK);
    double one = divided(wigley, 0, 0, 20, 6, 0.35);
    double two = divided(wigley, 1, 0, 20, 6, 0.35), layers = divided(wigley, 0, 1, 20, 6, 0.35);
    CHECK_RELATIVE(two, one, 5e-4);
    CHECK_RELATIVE(layers, one, 1e-3);
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(1.0, 0.2, 0.2, 0.16, &spheroid), NURBS_OK);
    one = divided(spheroid, 0, 0, 12, 6, 0.5);
    two = divided(spheroid, 1, 0, 12, 6, 0.5);
    layers = divided(spheroid, 0, 1, 12, 6, 0.5);
    CHECK_RELATIVE(two, one, 5e-4);
    CHECK_RELATIVE(layers, one, 5e-4);
    nurbs_surface_free(wigley);
    nurbs_surface_free(spheroid);
}

static int equal_costs(const igabem_cost *a, const igabem_cost *b)
{
    return a->singular_pairs == b->singular_pairs && a->near_pairs == b->near_pairs &&
           a->far_pairs == b->far_pairs && a->rankine == b->rankine && a->local == b->local &&
           a->wave == b->wave;
}

/* Whatever the threads the work is the same, and a smaller tolerance takes more of it. */
static void test_cost(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_cost previous = {0};
    for (int level = 0; level < 3; level++) {
        igabem_options options = setting(6, 2);
        options.tolerance = pow(10.0, -3.0 - 2.0 * level);
        igabem_cost cost[2];
        for (int k = 0; k < 2; k++) {
            options.threads = k + 1;
            igabem_solution *solution = solve(hull, &options);
            igabem_forces forces = forces_of(solution);
            cost[k] = forces.cost;
            CU_ASSERT(cost[k].singular_pairs >= forces.dofs);
            igabem_solution_free(solution);
        }
        CU_ASSERT(equal_costs(&cost[0], &cost[1]));
        CU_ASSERT(cost[0].singular_pairs == previous.singular_pairs || level == 0);
        CU_ASSERT(cost[0].near_pairs >= previous.near_pairs && cost[0].far_pairs > 0);
        CU_ASSERT(cost[0].rankine > previous.rankine && cost[0].local > previous.local &&
                  cost[0].wave > previous.wave);
        previous = cost[0];
    }
    igabem_hull_free(hull);
}

static void test_threads(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_options options = setting(6, 2);
    options.threads = 1;
    double one = cw_of(hull, &options);
    CU_ASSERT_EQUAL(cw_of(hull, &options), one);
    options.threads = 2;
    CHECK_RELATIVE(cw_of(hull, &options), one, 1e-10);
    igabem_hull_free(hull);
}

static int cancel_half_way(void *data, double fraction)
{
    double *last = data;
    CU_ASSERT(fraction >= *last);
    *last = fraction;
    return fraction >= 0.5;
}

static void test_progress(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_options options = setting(3, 2);
    double last = 0.0;
    options.progress = cancel_half_way;
    options.progress_user_data = &last;
    igabem_solution *solution = NULL;
    CU_ASSERT_EQUAL(igabem_solve(hull, &options, &solution), IGABEM_ERROR_CANCELLED);
    CU_ASSERT_PTR_NULL(solution);
    CU_ASSERT(last >= 0.5);
    igabem_hull_free(hull);
}

static void refuse(const igabem_hull *hull, const igabem_options *options, const char *word)
{
    igabem_solution *solution = NULL;
    CU_ASSERT_EQUAL(igabem_solve(hull, options, &solution), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(solution);
    if (!strstr(igabem_last_error(), word))
        fprintf(stderr, "\"%s\" does not name %s\n", igabem_last_error(), word);
    CU_ASSERT_PTR_NOT_NULL(strstr(igabem_last_error(), word));
}

/* Waves too short to be summed in bounded time, and numbers that no setting can mean. */
static void test_bounds(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_options good = setting(3, 2), bad = good;
    bad.froude = 1e9;
    refuse(hull, &bad, "Froude");
    bad.froude = 0.01;
    refuse(hull, &bad, "spectrum_limit 20");
    bad.spectrum_limit = 1.0;
    refuse(hull, &bad, "cut-off");
    bad.froude = 1e-4;
    refuse(hull, &bad, "higher Froude number");
    bad = good;
    bad.spectrum_limit = 1e300;
    refuse(hull, &bad, "spectrum_limit");
    bad = good;
    bad.threads = 1000000;
    refuse(hull, &bad, "threads");
    bad.threads = -1;
    refuse(hull, &bad, "threads");
    igabem_solution *solution = solve(hull, &good);
    const double far[1] = {1e300};
    double h[1][2];
    CU_ASSERT_EQUAL(igabem_kochin(solution, 1, far, h, NULL), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(igabem_last_error(), "wave angle 1e+300"));
    const double places[3] = {-1e6, -1e300, 1.0};
    double zeta, cw;
    for (int k = 0; k < 2; k++) {
        CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 1, &places[k], &places[2], &zeta),
                        IGABEM_ERROR_ARGUMENT);
        CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 1, &places[2], &places[k], &zeta),
                        IGABEM_ERROR_ARGUMENT);
        CU_ASSERT_EQUAL(igabem_wave_cut(solution, -places[k], &cw), IGABEM_ERROR_ARGUMENT);
        const double ahead = -places[k];
        CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 1, &ahead, &places[2], &zeta),
                        IGABEM_ERROR_ARGUMENT);
    }
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

static void test_refusals(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_options good = setting(3, 2), bad = good;
    bad.froude = NAN;
    refuse(hull, &bad, "Froude");
    bad.froude = -0.3;
    refuse(hull, &bad, "Froude");
    bad = good;
    bad.refine = -1;
    refuse(hull, &bad, "refine");
    bad = good;
    bad.degree = 12;
    refuse(hull, &bad, "degree");
    bad = good;
    bad.tolerance = 0.0;
    refuse(hull, &bad, "tolerance");
    bad = good;
    bad.cutoff_angle = -1.0;
    refuse(hull, &bad, "cutoff_angle");
    bad = good;
    bad.formulation = (igabem_formulation)77;
    refuse(hull, &bad, "formulation");
    bad = good;
    bad.gravity = INFINITY;
    refuse(hull, &bad, "gravity");
    igabem_hull_free(hull);
}

/* A mesh for a hull of few spans: enough unknowns, not many more, the same for either orientation
 * of the parameters, and none for a hull that has enough. */
static void test_refine(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 2, 1);
    igabem_hull *fine = wigley_hull(0.1, 0.0625, 40, 12);
    igabem_options options = setting(0, 0);
    igabem_options_refine(hull, 400, &options);
    CU_ASSERT_TRUE(2 * options.refine > options.refine_v); /* spans along, around */
    options.formulation = IGABEM_FORMULATION_HOGNER;
    igabem_solution *solution = solve(hull, &options);
    size_t dofs = forces_of(solution).dofs;
    CU_ASSERT_TRUE(dofs >= 400 && dofs < 440);
    igabem_solution_free(solution);
    igabem_options_refine(fine, 400, &options);
    CU_ASSERT_EQUAL(options.refine, 1);
    CU_ASSERT_EQUAL(options.refine_v, 1);
    igabem_options_refine(hull, SIZE_MAX, &options);
    CU_ASSERT_TRUE(options.refine <= 64 && options.refine_v <= 64);
    igabem_hull_free(hull);
    igabem_hull_free(fine);
}

static const struct check_case cases[] = {
    {"names of formulations", test_names},
    {"frozen options", test_freeze},
    {"hull with irregular knots", test_irregular_knots},
    {"a mesh by rule", test_refine},
    {"bounds", test_bounds},
    {"several settings at once", test_many},
    {"cost of the quadrature", test_cost},
    {"sensitivity to the cut-off", test_sensitivity},
    {"LU and GMRES", test_solvers},
    {"limits of the stern variant", test_stern_limits},
    {"stern length by rule", test_stern_rule},
    {"both sides as patches", test_both_sides},
    {"one hull in several patches", test_divided_hull},
    {"threads", test_threads},
    {"progress and cancelling", test_progress},
    {"refusals", test_refusals},
};

CHECK_MAIN("solve", cases)
