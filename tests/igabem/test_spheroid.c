/* Spheroids with exact answers: surface velocity in unbounded fluid and under a rigid still water,
 * and the wave resistance of submerged ones. The resistances are those of a solution of the full
 * linear problem (Farell, J. Ship Res. 17, 1973) in spheroidal harmonics, 15 multipoles, changing
 * by less than 1e-6 of themselves from 11 to 15. */
#include "check.h"
#include "hulls.h"

static igabem_solution *solve(const igabem_hull *hull, const igabem_options *options)
{
    igabem_solution *solution = NULL;
    igabem_status status = igabem_solve(hull, options, &solution);
    if (status != IGABEM_OK)
        fprintf(stderr, "solve: %s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    return solution;
}

/* The body alone, or its lower half under z = 0. */
static nurbs_surface *spheroid(double length, double diameter, int lower_half)
{
    nurbs_surface *whole = NULL, *half = NULL;
    CU_ASSERT_EQUAL_FATAL(
        nurbs_make_ellipsoid(length, diameter, diameter, lower_half ? 0.0 : 5.0 * length, &whole),
        NURBS_OK);
    if (!lower_half)
        return whole;
    double breaks[16];
    size_t n = nurbs_knots_distinct(nurbs_surface_degree(whole, 1), nurbs_surface_size(whole, 1),
                                    nurbs_surface_knots(whole, 1), breaks, NULL);
    CU_ASSERT_EQUAL_FATAL(n, 3); /* top, side, bottom */
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_part(whole, 1, breaks[1], breaks[2], &half), NURBS_OK);
    nurbs_surface_free(whole);
    return half;
}

static igabem_options plain(igabem_kernel kernel)
{
    igabem_options options;
    igabem_options_init(&options);
    options.refine = 1;
    options.kernel = kernel;
    options.tolerance = 1e-6;
    options.waterline_span = 0.0; /* orders want uniform knots */
    return options;
}

#ifndef SPHEROID_SLOW
/* The density of a sphere, 3/2 n_x, lies in the rational space of its own shape: what is left is
 * the error of the quadrature. */
static void test_sphere_in_its_own_basis(void)
{
    nurbs_surface *surface = spheroid(1.0, 1.0, 0);
    igabem_hull *hull = NULL;
    CU_ASSERT_EQUAL_FATAL(
        igabem_hull_create((const nurbs_surface *const *)&surface, 1, IGABEM_SYMMETRIC, &hull),
        IGABEM_OK);
    const double tolerance[2] = {1e-5, 1e-9}, error[2] = {2e-5, 1e-8};
    for (int k = 0; k < 2; k++) {
        igabem_options options = plain(IGABEM_KERNEL_RANKINE);
        options.refine = 2;
        options.tolerance = tolerance[k];
        igabem_solution *solution = solve(hull, &options);
        for (int i = 0; i < 50; i++) {
            const double *ku = nurbs_surface_knots(surface, 0),
                         *kv = nurbs_surface_knots(surface, 1);
            double u = fmod(0.3183 * (i + 1), 1.0), v = fmod(0.7177 * (i + 1), 1.0);
            const double uv[2] = {ku[0] + u * (ku[nurbs_surface_size(surface, 0)] - ku[0]),
                                  kv[0] + v * (kv[nurbs_surface_size(surface, 1)] - kv[0])};
            double point[3], sigma;
            CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 0, 1, uv, point), NURBS_OK);
            CU_ASSERT_EQUAL(igabem_source_density(solution, 0, 1, uv, &sigma), IGABEM_OK);
            CHECK_CLOSE(sigma, 1.5 * point[0] / 0.5, error[k]);
        }
        igabem_solution_free(solution);
    }
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
}

#else
/* Lamb, Hydrodynamics, art. 114: added mass coefficient of a spheroid along its axis. */
static double added_mass(double length, double diameter)
{
    double ratio = diameter / length;
    if (ratio == 1.0)
        return 0.5;
    double e = sqrt(1.0 - ratio * ratio);
    double alpha = 2.0 * (1.0 - e * e) / (e * e * e) * (0.5 * log((1.0 + e) / (1.0 - e)) - e);
    return alpha / (2.0 - alpha);
}

static void normal_of(const double t[9], double n[3], double *area)
{
    n[0] = t[4] * t[8] - t[5] * t[7];
    n[1] = t[5] * t[6] - t[3] * t[8];
    n[2] = t[3] * t[7] - t[4] * t[6];
    *area = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int c = 0; c < 3; c++)
        n[c] /= *area;
}

/* Root mean square over the surface of the velocity error; the exact velocity relative to the body
 * is (1 + k) times the tangential part of the stream. */
static double velocity_error(const nurbs_surface *surface, const igabem_solution *solution,
                             double coefficient)
{
    enum { NU = 40, NV = 20 };
    double sum = 0.0, total = 0.0, range[2][2];
    for (int d = 0; d < 2; d++) {
        range[d][0] = nurbs_surface_knots(surface, d)[0];
        range[d][1] = nurbs_surface_knots(surface, d)[nurbs_surface_size(surface, d)];
    }
    for (int k = 0; k < NU * NV; k++) {
        const double uv[2] = {range[0][0] + (range[0][1] - range[0][0]) * (k / NV + 0.5) / NU,
                              range[1][0] + (range[1][1] - range[1][0]) * (k % NV + 0.5) / NV};
        double t[9], n[3], v[3], area, square = 0.0;
        CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 1, 1, uv, t), NURBS_OK);
        CU_ASSERT_EQUAL(igabem_surface_velocity(solution, 0, 1, uv, v, NULL), IGABEM_OK);
        normal_of(t, n, &area);
        for (int c = 0; c < 3; c++) {
            double axis = c == 0;
            double exact = axis - (1.0 + coefficient) * (axis - n[0] * n[c]);
            square += (v[c] - exact) * (v[c] - exact);
        }
        sum += square * area;
        total += area;
    }
    return sqrt(sum / total);
}

static double error_at(const nurbs_surface *surface, igabem_options options, double coefficient)
{
    igabem_hull *hull = NULL;
    CU_ASSERT_EQUAL_FATAL(
        igabem_hull_create((const nurbs_surface *const *)&surface, 1, IGABEM_SYMMETRIC, &hull),
        IGABEM_OK);
    igabem_solution *solution = solve(hull, &options);
    double error = velocity_error(surface, solution, coefficient);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
    return error;
}

static void check_order(double length, double diameter, igabem_kernel kernel, const char *name,
                        double least_order, double last_error)
{
    nurbs_surface *surface = spheroid(length, diameter, kernel == IGABEM_KERNEL_DOUBLE_BODY);
    igabem_options options = plain(kernel);
    double previous = 0.0, order = 0.0;
    for (int level = 0; level < 3; level++) {
        options.elements_u = 6 << level;
        options.elements_v = 3 << level;
        double error = error_at(surface, options, added_mass(length, diameter));
        order = level ? log2(previous / error) : 0.0;
        printf("\n    %s L/D %g, %d x %d: velocity error %.2e, order %.1f", name, length / diameter,
               options.elements_u, options.elements_v, error, order);
        previous = error;
    }
    CU_ASSERT(order > least_order);
    CU_ASSERT(previous < last_error);
    nurbs_surface_free(surface);
}

/* Degree 4: order 5. */
static void test_velocity_order(void)
{
    check_order(1.0, 0.2, IGABEM_KERNEL_RANKINE, "unbounded", 4.5, 6e-5);
    check_order(1.0, 0.2, IGABEM_KERNEL_DOUBLE_BODY, "double body", 4.5, 6e-5);
    check_order(1.0, 1.0, IGABEM_KERNEL_DOUBLE_BODY, "double body", 4.3, 1e-6);
}

#endif

struct row {
    double froude, cw; /* R / (rho U^2 L^2 / 2) */
};

static void check_resistance(double diameter, double depth, const struct row *rows, size_t n,
                             int nu, int nv, double tol_kochin, double tol_pressure)
{
    igabem_hull *hull = ellipsoid_hull(1.0, diameter, diameter, depth, 1, 1);
    for (size_t k = 0; k < n; k++) {
        igabem_options options;
        igabem_options_init(&options);
        options.refine = 1;
        options.froude = rows[k].froude;
        options.elements_u = nu;
        options.elements_v = nv;
        igabem_solution *solution = solve(hull, &options);
        igabem_forces forces;
        CU_ASSERT_EQUAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
        CU_ASSERT(forces.dofs <= 600);
        printf("\n    L/D %.0f, Fr %.2f, %zu unknowns: error %.1e, Kochin - pressure %.1e",
               1.0 / diameter, rows[k].froude, forces.dofs, forces.cw_l2 / rows[k].cw - 1.0,
               forces.cw_pressure / forces.cw - 1.0);
        CHECK_RELATIVE(forces.cw_l2, rows[k].cw, tol_kochin);
        CHECK_RELATIVE(forces.cw_pressure, forces.cw, tol_pressure);
        igabem_solution_free(solution);
    }
    igabem_hull_free(hull);
}

static const struct row slender[] = {{0.35, 0.001375343973}, {0.40, 0.004696085283},
                                     {0.45, 0.006139721658}, {0.50, 0.005940084442},
                                     {0.60, 0.004182248287}, {0.70, 0.002686265361},
                                     {0.80, 0.00173690497},  {1.00, 0.0007952381805}};
#ifndef SPHEROID_SLOW
static void test_resistance(void)
{
    const struct row few[] = {slender[1], slender[3]};
    check_resistance(1.0 / 6.0, 0.125, few, 2, 16, 6, 1e-4, 2e-4);
    check_resistance(1.0 / 6.0, 0.125, few, 2, 24, 8, 2e-5, 3e-5);
}

#else
static const struct row fuller[] = {{0.35, 0.001484648601},
                                    {0.40, 0.006159245503},
                                    {0.50, 0.008803458256},
                                    {0.60, 0.006402455475},
                                    {0.80, 0.002648598643}};

static void test_resistance_of_all(void)
{
    check_resistance(1.0 / 6.0, 0.125, slender, 8, 32, 12, 1e-5, 1e-5);
    check_resistance(0.2, 0.16, fuller, 5, 32, 12, 1e-5, 1e-5);
}

#endif

static const struct check_case cases[] = {
#ifdef SPHEROID_SLOW
    {"order of the surface velocity", test_velocity_order},
    {"resistance of all exact rows", test_resistance_of_all},
#else
    {"sphere in its own basis", test_sphere_in_its_own_basis},
    {"resistance under refinement", test_resistance},
#endif
};

CHECK_MAIN("spheroid", cases)
