/* The free surface linearised about the double-body flow: that flow against a dipole and its image,
 * the limit of a thin hull, where the free stream is as good, and a towing tank. */
#include "check.h"
#include "exterior/free_surface.h"
#include "exterior/operator.h"
#include "hulls.h"
#include "solve/solution.h"

static igabem_options double_model(double froude, double cells)
{
    igabem_options options;
    igabem_options_init(&options);
    options.froude = froude;
    options.formulation = IGABEM_FORMULATION_DOUBLE_MODEL;
    options.refine = 1;
    options.surface_cells = cells;
    options.surface_upstream = options.surface_downstream = 0.4;
    options.surface_side = 0.5;
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

static double cw_of(const igabem_hull *hull, const igabem_options *options)
{
    igabem_forces forces;
    igabem_solution *solution = solve(hull, options);
    CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    igabem_solution_free(solution);
    return forces.cw;
}

/* A sphere of radius a at the depth d = 4 and its image: dipoles of a^3/2 (1 + (a/2d)^3/2) each,
 * but for (a/2d)^4 = 1.5e-5. */
static void dipoles(double x, double y, struct base_point *exact)
{
    const double a = 0.5, depth = 4.0, m = a * a * a * (1.0 + 0.5 / 4096.0);
    double r2 = x * x + y * y + depth * depth, r3 = r2 * sqrt(r2), r5 = r3 * r2, r7 = r5 * r2;
    *exact = (struct base_point){{m * (3.0 * x * x / r5 - 1.0 / r3), m * 3.0 * x * y / r5},
                                 {m * (9.0 * x / r5 - 15.0 * x * x * x / r7),
                                  m * (3.0 * y / r5 - 15.0 * x * x * y / r7),
                                  m * (3.0 * x / r5 - 15.0 * x * y * y / r7)}};
}

/* Derivatives of the double-body flow at the middles of the cells against these, over their
 * largest. */
static void test_flow(void)
{
    igabem_hull *hull = ellipsoid_hull(1.0, 1.0, 1.0, 4.0, 4, 2);
    igabem_options options = double_model(0.8, 8.0);
    options.surface_rows = 8.0;
    options.surface_upstream = options.surface_downstream = 4.0;
    options.surface_side = 4.0;
    igabem_solution *solution = solve(hull, &options);
    const struct free_surface *surface = solution->surface;
    double most[2] = {0.0, 0.0}, error[2] = {0.0, 0.0};
    for (size_t c = 0; c < surface->nx * surface->ny; c++) {
        struct base_point exact, *point = &solution->base[c];
        dipoles(surface->point[c].at[0], surface->point[c].at[1], &exact);
        for (int k = 0; k < 2; k++) {
            most[0] = fmax(most[0], fabs(exact.gradient[k]));
            error[0] = fmax(error[0], fabs(point->gradient[k] - exact.gradient[k]));
        }
        for (int k = 0; k < 3; k++) {
            most[1] = fmax(most[1], fabs(exact.second[k]));
            error[1] = fmax(error[1], fabs(point->second[k] - exact.second[k]));
        }
    }
    CHECK_CLOSE(error[0] / most[0], 0.0, 1e-4);
    CHECK_CLOSE(error[1] / most[1], 0.0, 1e-4);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

/* What the choice of the flow does is of second order in the breadth: half of it in C_w over C_w at
 * half the breadth. And the elevations meet. */
static void test_thin(void)
{
    static const double breadth[2] = {0.04, 0.02};
    double gap[2];
    for (int k = 0; k < 2; k++) {
        igabem_hull *hull = wigley_hull(breadth[k], 0.0625, 16, 4);
        igabem_options options = double_model(0.35, 24.0), stream = options;
        stream.formulation = IGABEM_FORMULATION_EXTERIOR;
        gap[k] = cw_of(hull, &options) / cw_of(hull, &stream) - 1.0;
        igabem_hull_free(hull);
    }
    CHECK_CLOSE(gap[0], 0.0, 0.2);
    CHECK_RELATIVE(gap[1], 0.5 * gap[0], 0.2);
}

/* C_w of the angles t < 4, where a double model stops. */
static double cw_within(const igabem_hull *hull, const igabem_options *options)
{
    enum { N = 200 };
    double t[N], h[N][2], dcw[N], step = asinh(4.0) / N, sum = 0.0;
    for (int i = 0; i < N; i++)
        t[i] = sinh((i + 0.5) * step);
    igabem_solution *solution = solve(hull, options);
    CU_ASSERT_EQUAL_FATAL(igabem_kochin(solution, N, t, h, dcw), IGABEM_OK);
    for (int i = 0; i < N; i++)
        sum += 2.0 * dcw[i] * cosh((i + 0.5) * step) * step;
    igabem_solution_free(solution);
    return sum;
}

/* Michell's value is the limit of a thin ship: a parabola in the breadth through three hulls. */
static void test_michell(void)
{
    static const double breadth[3] = {0.02, 0.01, 0.005}, froude[2] = {0.28, 0.35};
    for (int f = 0; f < 2; f++) {
        double ratio[3];
        for (int k = 0; k < 3; k++) {
            igabem_hull *hull = wigley_hull(breadth[k], 0.0625, 20, 5);
            igabem_options options = double_model(froude[f], 20.0), thin = options;
            thin.formulation = IGABEM_FORMULATION_MICHELL;
            ratio[k] = cw_within(hull, &options) / cw_within(hull, &thin);
            igabem_hull_free(hull);
        }
        CHECK_CLOSE((8.0 * ratio[2] - 6.0 * ratio[1] + ratio[0]) / 3.0, 1.0, 2e-3);
        CU_ASSERT_TRUE(fabs(ratio[2] - 1.0) < 0.65 * fabs(ratio[1] - 1.0));
    }
}

/* One elevation on the grid and, by Bernoulli's equation, on the waterline of the hull. */
static void test_elevation(void)
{
    igabem_hull *hull = wigley_hull(0.05, 0.0625, 16, 4);
    igabem_options options = double_model(0.35, 32.0);
    igabem_solution *solution = solve(hull, &options);
    double most = 0.0, apart = 0.0;
    for (int k = 0; k < 9; k++) {
        double x = -0.3 + 0.07 * k, y = 0.025 * (1.0 - 4.0 * x * x) + 1e-9, zeta, v[3];
        const double uv[2] = {0.5 + x, 0.0};
        CU_ASSERT_EQUAL_FATAL(igabem_wave_elevation(solution, 1, &x, &y, &zeta), IGABEM_OK);
        CU_ASSERT_EQUAL_FATAL(igabem_surface_velocity(solution, 0, 1, uv, v, NULL), IGABEM_OK);
        double bernoulli = (solution->speed * v[0] - 0.5 * (v[0] * v[0] + v[1] * v[1])) / 9.80665;
        most = fmax(most, fabs(bernoulli));
        apart = fmax(apart, fabs(zeta - bernoulli));
    }
    CHECK_CLOSE(apart / most, 0.0, 0.05);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

/* Wigley hull B/L 0.1 at Fr 0.313: tanks lie between 1.40 and 1.90 (tests/data/wigley_tank.csv),
 * the free stream at 1.15. */
static void test_tank(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 24, 6);
    igabem_options options = double_model(0.313, 32.0);
    double cw = cw_of(hull, &options);
    CU_ASSERT_TRUE(cw > 1.40e-3 && cw < 1.90e-3);
    igabem_hull_free(hull);
}

/* Speeds and formulations at once, and each alone. */
static void test_sweep(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 8, 2);
    igabem_options options[3] = {double_model(0.3, 12.0), double_model(0.4, 12.0),
                                 double_model(0.4, 12.0)};
    igabem_solution *solutions[3];
    options[2].formulation = IGABEM_FORMULATION_EXTERIOR;
    CU_ASSERT_EQUAL_FATAL(igabem_solve_many(hull, 3, options, solutions), IGABEM_OK);
    for (int k = 0; k < 3; k++) {
        igabem_forces forces;
        igabem_options one = options[k];
        one.threads = 1;
        CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solutions[k], &forces), IGABEM_OK);
        CHECK_RELATIVE(cw_of(hull, &one), forces.cw, 1e-9);
        igabem_solution_free(solutions[k]);
    }
    igabem_hull_free(hull);
}

/* Hull and still water have given away what the waves carry, by the Kochin function: a hull at the
 * surface, and one below, where no mesh is short of anything. */
static void test_momentum(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 24, 6);
    double apart[2];
    for (int k = 0; k < 2; k++) {
        igabem_options options = double_model(0.35, k ? 32.0 : 20.0);
        igabem_solution *solution = solve(hull, &options);
        igabem_forces forces;
        CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
        apart[k] = forces.cw_momentum / forces.cw - 1.0;
        /* What the hull feels has the run-up in it. */
        CU_ASSERT_TRUE(forces.cw_run_up > 0.2 * forces.cw);
        CHECK_CLOSE(forces.cw_pressure / forces.cw, 1.4, 0.1);
        CU_ASSERT_PTR_NULL(igabem_solution_warning(solution, &forces, 0));
        igabem_solution_free(solution);
    }
    CHECK_CLOSE(apart[0], 0.0, 0.04);
    CHECK_CLOSE(apart[1], 0.0, 0.04);
    igabem_hull_free(hull);
    hull = ellipsoid_hull(1.0, 0.2, 0.2, 0.16, 6, 2);
    igabem_options options = double_model(0.4, 16.0);
    options.surface_rows = 10.0;
    options.surface_upstream = 1.0;
    options.surface_downstream = 1.5;
    options.surface_side = 0.8;
    igabem_solution *solution = solve(hull, &options);
    igabem_forces forces;
    CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    CHECK_RELATIVE(forces.cw_momentum, forces.cw, 0.01);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

static const struct check_case cases[] = {
    {"double-body flow", test_flow}, {"thin hull", test_thin},   {"Michell's limit", test_michell},
    {"elevation", test_elevation},   {"towing tank", test_tank}, {"sweep", test_sweep},
    {"momentum", test_momentum},
};

CHECK_MAIN("double model", cases)
