/* Free waves fitted to an area, against waves of a known amplitude, and the cut through a free
 * surface that was solved, against exact resistances and the Kochin function. */
#include "check.h"
#include "hulls.h"
#include "result/free_waves.h"

#include <string.h>

static const double k0 = 8.0, stern = -0.5, depth = 0.1;

/* A source under the bow and a sink under the stern. */
static double _Complex amplitude(double t)
{
    double k = k0 * sqrt(1.0 + t * t);
    return exp(-k0 * depth * (1.0 + t * t)) * (cexp(-I * k * (0.5 - stern)) - 0.7);
}

/* Their waves at one place, by the trapezoidal rule over t = sinh v. */
static double elevation(double x, double y)
{
    enum { N = 4000 };
    const double step = 4.5 / N;
    double sum = 0.0;
    for (int i = -N; i <= N; i++) {
        double t = sinh(step * i), k = k0 * sqrt(1.0 + t * t);
        sum += step * cosh(step * i) * creal(amplitude(t) * cexp(I * k * (x - stern + t * y)));
    }
    return sum;
}

/* The largest error of the amplitude up to t = 2, over the largest. */
static double misjudged(const struct free_waves *waves)
{
    double most = 0.0, error = 0.0;
    for (double t = 0.0; t <= 2.0; t += 0.05) {
        most = fmax(most, cabs(amplitude(t)));
        error = fmax(error, cabs(free_waves_amplitude(waves, t) - amplitude(t)));
    }
    return error / most;
}

enum { ALONG = 24, ACROSS = 14, POINTS = ALONG * ACROSS };

/* On a wave length and a half behind the stern, and the same with an error of 3 % that no wave
 * has. */
static void test_fit(void)
{
    double x[POINTS], y[POINTS], zeta[POINTS], square = 0.0;
    for (int i = 0; i < POINTS; i++) {
        double across = (i % ACROSS + 0.5) / ACROSS;
        x[i] = stern - 0.25 - 0.05 * (i / ACROSS);
        y[i] = 0.7 * across * across + 0.1 * across;
        zeta[i] = elevation(x[i], y[i]);
        square += zeta[i] * zeta[i] / POINTS;
    }
    struct free_waves waves;
    CU_ASSERT_EQUAL_FATAL(free_waves_fit(k0, stern, 1.0, POINTS, x, y, zeta, &waves), IGABEM_OK);
    CHECK_CLOSE(waves.misfit, 0.0, 3e-3);
    CHECK_CLOSE(misjudged(&waves), 0.0, 0.02);
    /* Continued to eight lengths. */
    const double far[2] = {-8.0, -8.3}, off[2] = {0.2, 0.9};
    double there[2];
    CU_ASSERT_EQUAL_FATAL(free_waves_elevation(&waves, 2, far, off, there), IGABEM_OK);
    for (int k = 0; k < 2; k++)
        CHECK_CLOSE(there[k], elevation(far[k], off[k]), 0.02 * sqrt(square));
    for (int i = 0; i < POINTS; i++)
        zeta[i] += 0.03 * sqrt(2.0 * square) * sin(1.7 * i * i);
    CU_ASSERT_EQUAL_FATAL(free_waves_fit(k0, stern, 1.0, POINTS, x, y, zeta, &waves), IGABEM_OK);
    CHECK_CLOSE(waves.misfit, 0.03, 0.005);
    CHECK_CLOSE(misjudged(&waves), 0.0, 0.06);
    CU_ASSERT_EQUAL(free_waves_fit(k0, stern, 1.0, 5, x, y, zeta, &waves), IGABEM_ERROR_ARGUMENT);
}

static igabem_solution *solve(const igabem_hull *hull, igabem_formulation formulation,
                              double froude, double cells, double downstream, double side)
{
    igabem_options options;
    igabem_options_init(&options);
    options.formulation = formulation;
    options.froude = froude;
    options.refine = 1;
    options.surface_cells = cells;
    options.surface_rows = round(0.6 * cells * side / 0.8);
    options.surface_upstream = side > 1.0 ? 1.0 : 0.6;
    options.surface_first = 0.5;
    options.surface_downstream = downstream;
    options.surface_side = side;
    igabem_solution *solution = NULL;
    igabem_status status = igabem_solve(hull, &options, &solution);
    if (status != IGABEM_OK)
        fprintf(stderr, "solve: %s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    return solution;
}

static double cut_over_kochin(const igabem_solution *solution)
{
    igabem_forces forces;
    double cw = NAN;
    CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    igabem_status status = igabem_wave_cut(solution, NAN, &cw);
    if (status != IGABEM_OK)
        fprintf(stderr, "cut: %s\n", igabem_last_error());
    CU_ASSERT_EQUAL(status, IGABEM_OK);
    return cw / forces.cw;
}

/* C_w on L^2 of the spheroid L/D 5 at depth 0.16 (test_spheroid.c), by the waves on the surface. */
static void test_spheroid(void)
{
    igabem_hull *hull = ellipsoid_hull(1.0, 0.2, 0.2, 0.16, 6, 2);
    igabem_solution *solution = solve(hull, IGABEM_FORMULATION_EXTERIOR, 0.4, 20.0, 1.8, 1.2);
    igabem_forces forces;
    CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    CHECK_CLOSE(cut_over_kochin(solution) * forces.cw_l2 / 0.006159245503, 1.0, 0.02);
    double cw, beside = 0.05;
    CU_ASSERT_EQUAL(igabem_wave_cut(solution, beside, &cw), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(igabem_last_error(), "wave cut at y = 0.05 m"));
    CU_ASSERT_EQUAL(igabem_wave_cut(solution, 3.0, &cw), IGABEM_ERROR_ARGUMENT);
    igabem_solution_free(solution);
    solution = solve(hull, IGABEM_FORMULATION_EXTERIOR, 0.4, 8.0, 0.5, 0.8);
    CU_ASSERT_EQUAL(igabem_wave_cut(solution, NAN, &cw), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(igabem_last_error(), "surface_downstream"));
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

/* A hull at the surface: the two meet as the cells get smaller. */
static void test_wigley(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 16, 4);
    for (int k = 0; k < 2; k++) {
        igabem_formulation formulation =
            k ? IGABEM_FORMULATION_DOUBLE_MODEL : IGABEM_FORMULATION_EXTERIOR;
        double apart[2];
        for (int c = 0; c < 2; c++) {
            igabem_solution *solution = solve(hull, formulation, 0.35, c ? 24.0 : 12.0, 1.2, 0.8);
            apart[c] = cut_over_kochin(solution) - 1.0;
            igabem_solution_free(solution);
        }
        CHECK_CLOSE(apart[1], 0.0, 0.13);
        CU_ASSERT_TRUE(fabs(apart[1]) < 0.6 * fabs(apart[0]));
    }
    igabem_hull_free(hull);
}

static const struct check_case cases[] = {
    {"fit", test_fit}, {"spheroid", test_spheroid}, {"Wigley hull", test_wigley}};

CHECK_MAIN("free waves", cases)
