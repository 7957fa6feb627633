/* Resistance, velocities and attitude of solved bodies against exact solutions. */
#include "check.h"
#include "hulls.h"

#include <string.h>

static igabem_solution *solve(const igabem_hull *hull, const igabem_options *options)
{
    igabem_solution *solution = NULL;
    igabem_status status = igabem_solve(hull, options, &solution);
    if (status)
        fprintf(stderr, "%s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    return solution;
}

static igabem_forces forces_of(const igabem_hull *hull, const igabem_options *options)
{
    igabem_forces forces = {.cw = NAN};
    igabem_solution *solution = solve(hull, options);
    igabem_status status = igabem_forces_compute(solution, &forces);
    if (status)
        fprintf(stderr, "%s\n", igabem_last_error());
    CU_ASSERT_EQUAL(status, IGABEM_OK);
    igabem_solution_free(solution);
    return forces;
}

/* Prolate spheroid, length 6 diameters, axis at an eighth of the length: full linear solution by
 * spheroidal harmonics, C_w on length squared, converged to 1e-6 in the harmonic order. */
static void submerged_spheroid(void)
{
    static const double exact[][2] = {
        {0.35, 0.001375343973}, {0.50, 0.005940084442}, {0.80, 0.00173690497}};
    igabem_hull *hull = ellipsoid_hull(1.0, 1.0 / 6, 1.0 / 6, 0.125, 8, 5);
    for (size_t i = 0; i < sizeof exact / sizeof exact[0]; i++) {
        igabem_options options;
        igabem_options_init(&options);
        options.refine = 1;
        options.froude = exact[i][0];
        igabem_forces forces = forces_of(hull, &options);
        CU_ASSERT(forces.dofs <= 600);
        CHECK_RELATIVE(forces.cw_l2, exact[i][1], 1e-3);
        CHECK_RELATIVE(forces.cw_pressure, forces.cw, 3e-3);
        CHECK_RELATIVE(forces.rw,
                       0.5 * 1000 * forces.speed * forces.speed * forces.wetted_area * forces.cw,
                       1e-12);
        CU_ASSERT(isnan(forces.sinkage) && isnan(forces.trim));
    }
    igabem_hull_free(hull);
}

/* Kochin and pressure meet under refinement (Lagally), to 1e-3 at 600 unknowns. */
static void kochin_against_pressure(void)
{
    double gap[2];
    for (int k = 0; k < 2; k++) {
        igabem_hull *hull = ellipsoid_hull(1.0, 1.0 / 6, 1.0 / 6, 0.125, k ? 12 : 8, k ? 8 : 5);
        igabem_options options;
        igabem_options_init(&options);
        options.refine = 1;
        options.froude = 0.5;
        igabem_forces forces = forces_of(hull, &options);
        gap[k] = fabs(forces.cw_pressure / forces.cw - 1);
        igabem_hull_free(hull);
    }
    CU_ASSERT(gap[1] < 1e-3);
    CU_ASSERT(gap[1] < gap[0]);
}

/* Sphere in unbounded flow: grad phi = (U/2) (e_x-stream solution): total speed 3/2 U sin, so on
 * the body moving towards +x the disturbance is (U/2) (3 n_x n - e_x). No force. */
static void sphere_unbounded(void)
{
    igabem_hull *hull = ellipsoid_hull(1.0, 1.0, 1.0, 2.0, 3, 3);
    igabem_options options;
    igabem_options_init(&options);
    options.refine = 1;
    options.kernel = IGABEM_KERNEL_RANKINE;
    igabem_solution *solution = solve(hull, &options);
    double uv[2 * 49], velocity[3 * 49], cp[49], worst = 0.0, worst_cp = 0.0;
    nurbs_surface *surface = ellipsoid_surface(1.0, 1.0, 1.0, 2.0, 3, 3);
    const double *ku = nurbs_surface_knots(surface, 0), *kv = nurbs_surface_knots(surface, 1);
    double end_u = ku[nurbs_surface_size(surface, 0) + (size_t)nurbs_surface_degree(surface, 0)];
    double end_v = kv[nurbs_surface_size(surface, 1) + (size_t)nurbs_surface_degree(surface, 1)];
    for (int i = 0; i < 49; i++) {
        uv[2 * i] = end_u * (0.05 + 0.15 * (i / 7));
        uv[2 * i + 1] = end_v * (0.05 + 0.15 * (i % 7));
    }
    CU_ASSERT_EQUAL(igabem_surface_velocity(solution, 0, 49, uv, velocity, cp), IGABEM_OK);
    for (int i = 0; i < 49; i++) {
        double at[3];
        CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 0, 1, uv + 2 * i, at), NURBS_OK);
        double n[3] = {2 * at[0], 2 * at[1], 2 * (at[2] + 2.0)};
        for (int k = 0; k < 3; k++)
            worst = fmax(worst, fabs(velocity[3 * i + k] - 0.5 * (3 * n[0] * n[k] - (k == 0))));
        double sine2 = 1 - n[0] * n[0];
        worst_cp = fmax(worst_cp, fabs(cp[i] - (1 - 2.25 * sine2)));
    }
    CU_ASSERT(worst < 5e-3);
    CU_ASSERT(worst_cp < 1.5e-2);
    igabem_forces forces;
    CU_ASSERT_EQUAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    CU_ASSERT(isnan(forces.cw) && isnan(forces.rw));
    CHECK_CLOSE(forces.cw_pressure, 0.0, 1e-4);
    CU_ASSERT_EQUAL(igabem_surface_velocity(solution, 1, 1, uv, velocity, cp),
                    IGABEM_ERROR_ARGUMENT);
    double h[1][2], zeta, t = 1.0;
    CU_ASSERT_EQUAL(igabem_kochin(solution, 1, &t, h, NULL), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_wave_elevation(solution, 1, &t, &t, &zeta), IGABEM_ERROR_ARGUMENT);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
}

/* The spectrum integrates to C_w. */
static void spectrum_adds_up(void)
{
    enum { N = 4001 };
    static double t[N], h[N][2], dcw[N];
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 8, 3);
    igabem_options options;
    igabem_options_init(&options);
    options.refine = 1;
    options.froude = 0.35;
    igabem_solution *solution = solve(hull, &options);
    igabem_forces forces;
    CU_ASSERT_EQUAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    for (int i = 0; i < N; i++)
        t[i] = 20.0 * i / (N - 1.0);
    CU_ASSERT_EQUAL(igabem_kochin(solution, N, t, h, dcw), IGABEM_OK);
    double sum = 0.0; /* Simpson over one sign of t */
    for (int i = 0; i < N; i++)
        sum += dcw[i] * (i == 0 || i == N - 1 ? 1 : i % 2 ? 4 : 2);
    CHECK_RELATIVE(2 * sum * 20.0 / (N - 1.0) / 3, forces.cw, 1e-5);
    CU_ASSERT(forces.share_beyond_cutoff > 0 && forces.share_beyond_cutoff < 0.05);
    const double minus[1] = {-1.3}, plus[1] = {1.3};
    double a[1][2], b[1][2];
    CU_ASSERT_EQUAL(igabem_kochin(solution, 1, minus, a, NULL), IGABEM_OK);
    CU_ASSERT_EQUAL(igabem_kochin(solution, 1, plus, b, NULL), IGABEM_OK);
    CHECK_CLOSE(a[0][0], b[0][0], 1e-12 * fabs(b[0][0]));
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

/* A hull that is the same fore and aft has no trim and, at rest waves (double body), sinks: the
 * flow is faster along it than the stream. */
static void attitude_of_double_body(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 10, 4);
    igabem_options options;
    igabem_options_init(&options);
    options.refine = 1;
    options.froude = 0.3;
    options.formulation = IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN;
    igabem_forces forces = forces_of(hull, &options);
    CU_ASSERT(forces.sinkage > 0);
    CHECK_CLOSE(forces.trim, 0.0, 1e-6);
    CU_ASSERT(isnan(forces.cw_pressure));
    CU_ASSERT(forces.cw > 0);
    igabem_hull_free(hull);
}

/* Geometric similarity: C_w does not know the size, forces grow with the cube. */
static void similarity(void)
{
    double cw[2], rw[2];
    for (int k = 0; k < 2; k++) {
        const double scale = k ? 7.0 : 1.0;
        const double matrix[9] = {scale, 0, 0, 0, scale, 0, 0, 0, scale}, shift[3] = {0, 0, 0};
        nurbs_surface *unit = wigley_surface(0.1, 0.0625, 8, 3), *large;
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(unit, matrix, shift, &large), NURBS_OK);
        const nurbs_surface *list[1] = {large};
        igabem_hull *hull;
        CU_ASSERT_EQUAL_FATAL(igabem_hull_create(list, 1, IGABEM_SYMMETRIC, &hull), IGABEM_OK);
        igabem_options options;
        igabem_options_init(&options);
        options.refine = 1;
        options.froude = 0.3;
        igabem_forces forces = forces_of(hull, &options);
        cw[k] = forces.cw;
        rw[k] = forces.rw;
        igabem_hull_free(hull);
        nurbs_surface_free(unit);
        nurbs_surface_free(large);
    }
    CHECK_RELATIVE(cw[1], cw[0], 1e-9);
    CHECK_RELATIVE(rw[1] / rw[0], 343.0, 1e-9);
}

/* The wedge's transom is a triangle of half breadth b and depth T: rho g b T^2/3 of hydrostatic
 * pressure is missing on it when it is dry; a closed hull has no such term. */
static void dry_transom(void)
{
    const double b = 0.05, draft = 0.04;
    nurbs_surface *surface = wedge_surface(b, draft);
    const nurbs_surface *list[1] = {surface};
    igabem_hull *hull = NULL;
    CU_ASSERT_EQUAL_FATAL(igabem_hull_create(list, 1, IGABEM_SYMMETRIC, &hull), IGABEM_OK);
    nurbs_surface_free(surface);
    igabem_options options;
    igabem_options_init(&options);
    options.refine = 1;
    options.froude = 0.5;
    options.elements_u = 4;
    options.elements_v = 3;
    igabem_forces forces = forces_of(hull, &options);
    igabem_hull_free(hull);
    double dynamic = 0.5 * forces.speed * forces.speed * forces.wetted_area;
    CHECK_RELATIVE(forces.cw_transom, options.gravity * b * draft * draft / 3 / dynamic, 1e-10);
    CU_ASSERT(isfinite(forces.cw_run_up) && forces.cw_run_up != 0.0);
    hull = wigley_hull(0.1, 0.0625, 4, 2);
    forces = forces_of(hull, &options);
    igabem_hull_free(hull);
    CU_ASSERT(isnan(forces.cw_transom));
    /* what the run-up adds is second order: far below the linear pressure on a thin hull */
    CU_ASSERT(fabs(forces.cw_run_up) < 0.5 * fabs(forces.cw_pressure_linear));
}

static const struct check_case cases[] = {
    {"submerged spheroid against its exact resistance", submerged_spheroid},
    {"Kochin against pressure", kochin_against_pressure},
    {"sphere in unbounded flow", sphere_unbounded},
    {"the spectrum adds up", spectrum_adds_up},
    {"sinkage and trim of a double body", attitude_of_double_body},
    {"geometric similarity", similarity},
    {"what a dry transom lacks", dry_transom},
};

CHECK_MAIN("forces", cases)
