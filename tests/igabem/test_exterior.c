/* The potential on hull and free surface: against exact resistances of submerged spheroids (those
 * of test_spheroid.c), against the Kelvin solver, which shares no kernel with it, and against
 * itself. */
#include "check.h"
#include "hulls.h"

#include <string.h>

static igabem_options exterior(double froude, double cells)
{
    igabem_options options;
    igabem_options_init(&options);
    options.froude = froude;
    options.formulation = IGABEM_FORMULATION_EXTERIOR;
    options.refine = 1;
    options.surface_cells = cells;
    return options;
}

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

/* C_w on L^2 of the spheroid L/D 6 at depth L/8; the wave behind it beside the Kelvin solver's. */
static void test_spheroid(void)
{
    igabem_hull *hull = ellipsoid_hull(1.0, 1.0 / 6, 1.0 / 6, 0.125, 8, 2);
    igabem_options options = exterior(0.5, 16.0);
    igabem_solution *solution = solve(hull, &options);
    igabem_forces forces = forces_of(solution);
    CHECK_RELATIVE(forces.cw_l2, 0.005940084442, 0.01);
    /* Lagally: the same number by the pressure. */
    CHECK_RELATIVE(forces.cw_pressure, forces.cw, 0.02);
    options.formulation = IGABEM_FORMULATION_NEUMANN_KELVIN;
    igabem_solution *kelvin = solve(hull, &options);
    enum { POINTS = 40 };
    double x[POINTS], y[POINTS], zeta[2][POINTS], apart = 0.0, whole = 0.0;
    for (int i = 0; i < POINTS; i++) {
        x[i] = 0.4 - 0.03 * i;
        y[i] = 0.011 * i;
    }
    CU_ASSERT_EQUAL_FATAL(igabem_wave_elevation(solution, POINTS, x, y, zeta[0]), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(igabem_wave_elevation(kelvin, POINTS, x, y, zeta[1]), IGABEM_OK);
    for (int i = 0; i < POINTS; i++) {
        apart += (zeta[0][i] - zeta[1][i]) * (zeta[0][i] - zeta[1][i]);
        whole += zeta[1][i] * zeta[1][i];
    }
    CHECK_CLOSE(sqrt(apart / whole), 0.0, 0.03);
    igabem_solution_free(solution);
    igabem_solution_free(kelvin);
    igabem_hull_free(hull);
}

/* A thin Wigley hull, where both are one linear problem without doubt. */
static void test_thin_wigley(void)
{
    igabem_hull *hull = wigley_hull(0.02, 0.0625, 16, 4);
    igabem_options options = exterior(0.35, 32.0);
    options.surface_upstream = 0.3;
    options.surface_downstream = 0.3;
    options.surface_side = 0.5;
    igabem_solution *solution = solve(hull, &options);
    igabem_forces forces = forces_of(solution);
    options.formulation = IGABEM_FORMULATION_NEUMANN_KELVIN;
    igabem_solution *kelvin = solve(hull, &options);
    CHECK_RELATIVE(forces.cw, forces_of(kelvin).cw, 0.02);
    /* Their own momentum gives the same. */
    CHECK_RELATIVE(forces.cw_pressure - 2.0 * forces.cw_run_up, forces.cw, 0.06);
    CHECK_RELATIVE(forces_of(kelvin).cw_pressure - 2.0 * forces_of(kelvin).cw_run_up,
                   forces_of(kelvin).cw, 5e-3);
    /* The waterline is an edge of both spaces: one potential, one elevation. */
    double x = 0.113, y = 0.01 * (1.0 - 4.0 * x * x) + 1e-9, zeta, velocity[3];
    const double uv[2] = {0.5 + x, 0.0};
    CU_ASSERT_EQUAL_FATAL(igabem_wave_elevation(solution, 1, &x, &y, &zeta), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(igabem_surface_velocity(solution, 0, 1, uv, velocity, NULL), IGABEM_OK);
    CHECK_CLOSE(zeta, forces.speed / 9.80665 * velocity[0], 3e-4);
    igabem_solution_free(solution);
    igabem_solution_free(kelvin);
    igabem_hull_free(hull);
}

/* Speeds that share their integrals, beside another formulation, and single ones on one thread. */
static void test_sweep(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 8, 2);
    igabem_options options[3] = {exterior(0.3, 12.0), exterior(0.4, 12.0), exterior(0.4, 12.0)};
    options[1].formulation = IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN;
    igabem_solution *solutions[3];
    CU_ASSERT_EQUAL_FATAL(igabem_solve_many(hull, 3, options, solutions), IGABEM_OK);
    for (int k = 0; k < 3; k++) {
        igabem_options one = options[k];
        one.threads = 1;
        igabem_solution *single = solve(hull, &one);
        CHECK_RELATIVE(forces_of(single).cw, forces_of(solutions[k]).cw, 1e-9);
        igabem_solution_free(single);
        igabem_solution_free(solutions[k]);
    }
    igabem_hull_free(hull);
}

/* Shares of the whole are the whole: the sum over zones holds the dipoles and the waterline. */
static void test_shares(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 8, 2);
    igabem_options options = exterior(0.4, 12.0);
    igabem_solution *solution = solve(hull, &options);
    double x = 0.0, share[2], r[IGABEM_WAVE_RESIDUALS], sum = 0.0;
    CU_ASSERT_EQUAL_FATAL(igabem_wave_shares(solution, 1, &x, share), IGABEM_OK);
    CHECK_CLOSE(share[0] + share[1], 1.0, 1e-12);
    CU_ASSERT_EQUAL_FATAL(igabem_wave_residuals(solution, r), IGABEM_OK);
    for (int k = 0; k < IGABEM_WAVE_RESIDUALS; k++)
        sum += r[k] * r[k];
    CHECK_RELATIVE(sum, forces_of(solution).cw, 1e-3);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

static void refused(igabem_status status, igabem_status expected, const char *words)
{
    CU_ASSERT_EQUAL(status, expected);
    CU_ASSERT_PTR_NOT_NULL(strstr(igabem_last_error(), words));
}

static void test_refusals(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 8, 2);
    igabem_options options = exterior(0.4, 12.0);
    igabem_solution *solution = solve(hull, &options), *none;
    double x = -5.0, y = 0.2, value;
    const double uv[2] = {0.5, 0.5};
    refused(igabem_wave_elevation(solution, 1, &x, &y, &value), IGABEM_ERROR_ARGUMENT,
            "off the free surface");
    refused(igabem_source_density(solution, 0, 1, uv, &value), IGABEM_ERROR_ARGUMENT,
            "no source density");
    refused(igabem_wave_cut(solution, 5.0, &value), IGABEM_ERROR_ARGUMENT, "wave cut");
    x = y = 0.0;
    CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 1, &x, &y, &value), IGABEM_OK);
    CU_ASSERT_TRUE(isnan(value)); /* inside the water plane */
    igabem_solution_free(solution);
    options.surface_cells = 2.0;
    refused(igabem_solve(hull, &options, &none), IGABEM_ERROR_ARGUMENT, "surface_cells");
    /* Three cells a wave are no solution, six are one to be warned of. */
    options = exterior(0.15, 21.0);
    refused(igabem_solve(hull, &options, &none), IGABEM_ERROR_NUMERIC, "state more surface_cells");
    options = exterior(0.15, 42.0);
    solution = solve(hull, &options);
    const char *sentence = igabem_solution_warning(solution, NULL, 0);
    CU_ASSERT_PTR_NOT_NULL_FATAL(sentence);
    CU_ASSERT_PTR_NOT_NULL(strstr(sentence, "cells of the free surface"));
    igabem_solution_free(solution);
    igabem_hull_free(hull);
    hull = wigley_hull(0.25, 0.0625, 4, 2); /* nu_s 0.45 */
    options = exterior(0.4, 12.0);
    refused(igabem_solve(hull, &options, &none), IGABEM_ERROR_GEOMETRY, "nu_s 0.447");
    options.formulation = IGABEM_FORMULATION_DOUBLE_MODEL;
    solution = solve(hull, &options);
    sentence = igabem_solution_warning(solution, NULL, 0);
    CU_ASSERT_PTR_NOT_NULL_FATAL(sentence);
    CU_ASSERT_PTR_NOT_NULL(strstr(sentence, "nu_s"));
    igabem_solution_free(solution);
    options.surface_first = 0.5; /* slopes up to 0.5: 0.6 is needed */
    refused(igabem_solve(hull, &options, &none), IGABEM_ERROR_GEOMETRY, "surface_first 0.5");
    igabem_hull_free(hull);
}

/* A wedge with a dry transom: the water leaves the rim at its height, also where nothing is solved
 * at the rim itself, and what the strip holds depends on no number of columns. */
static void test_transom(void)
{
    nurbs_surface *surface = wedge_surface(0.05, 0.05);
    igabem_hull *hull = NULL;
    CU_ASSERT_EQUAL_FATAL(
        igabem_hull_create((const nurbs_surface *const *)&surface, 1, IGABEM_SYMMETRIC, &hull),
        IGABEM_OK);
    igabem_options options = exterior(0.5, 16.0);
    options.refine = 8;
    options.refine_v = 3;
    options.surface_side = 0.5;
    double cw[2];
    for (int k = 0; k < 2; k++) {
        options.surface_columns = k ? 8.0 : 4.0;
        igabem_solution *solution = solve(hull, &options);
        igabem_forces forces = forces_of(solution);
        cw[k] = forces.cw;
        double x = -1e-9, y = 0.02, zeta;
        CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 1, &x, &y, &zeta), IGABEM_OK);
        CHECK_CLOSE(zeta, -0.03, 1e-6);
        /* The grid that was solved, over the strip and beside it. */
        size_t size[2];
        CU_ASSERT_EQUAL(igabem_free_surface_grid(solution, size, NULL, NULL), IGABEM_OK);
        size_t n = size[0] * size[1], wet = 0;
        double *nodes = malloc(3 * n * sizeof *nodes);
        CU_ASSERT_PTR_NOT_NULL_FATAL(nodes);
        CU_ASSERT_EQUAL(igabem_free_surface_grid(solution, size, nodes, nodes + n), IGABEM_OK);
        CU_ASSERT_EQUAL(igabem_wave_elevation(solution, n, nodes, nodes + n, nodes + 2 * n),
                        IGABEM_OK);
        for (size_t m = 0; m < n; m++)
            wet += isfinite(nodes[2 * n + m]) != 0;
        /* 8 cells ahead, 16 beside, 16 aft: 15 lines through the water plane. */
        size_t columns = k ? 8 : 4;
        CU_ASSERT_EQUAL(size[0], 41);
        CU_ASSERT_EQUAL(wet, n - 15 * columns);
        free(nodes);
        /* The full-depth transom carries more than the waves do. */
        CU_ASSERT_TRUE(forces.cw > 0 && forces.cw_transom > 0);
        igabem_solution_free(solution);
    }
    CHECK_RELATIVE(cw[1], cw[0], 0.03);
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
}

static const struct check_case cases[] = {
    {"spheroid", test_spheroid}, {"thin Wigley hull", test_thin_wigley},
    {"sweep", test_sweep},       {"shares", test_shares},
    {"transom", test_transom},   {"refusals", test_refusals},
};

CHECK_MAIN("exterior", cases)
