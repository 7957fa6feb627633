/* The sums of residuals against exact resistances and against the adaptive integrals. */
#include "check.h"
#include "hulls.h"

#include <stdlib.h>

static igabem_solution *solve(const igabem_hull *hull, double froude)
{
    igabem_solution *solution = NULL;
    igabem_options options;
    igabem_options_init(&options);
    options.froude = froude;
    CU_ASSERT_EQUAL_FATAL(igabem_solve(hull, &options, &solution), IGABEM_OK);
    return solution;
}

static double square(const igabem_solution *solution)
{
    double r[IGABEM_WAVE_RESIDUALS], sum = 0;
    CU_ASSERT_EQUAL_FATAL(igabem_wave_residuals(solution, r), IGABEM_OK);
    for (int k = 0; k < IGABEM_WAVE_RESIDUALS; k++)
        sum += r[k] * r[k];
    return sum;
}

static double pressure(const igabem_solution *solution, size_t n_u, size_t n_v)
{
    size_t n;
    igabem_pressure_sample *sample;
    CU_ASSERT_EQUAL_FATAL(igabem_pressure_samples(solution, n_u, n_v, &n, &sample), IGABEM_OK);
    double sum = igabem_pressure_sum(n, sample, NULL);
    free(sample);
    return sum;
}

/* C_w on length squared by spheroidal harmonics, as in the test of the forces. */
static void spheroid_against_its_exact_resistance(void)
{
    static const double exact[][2] = {{0.35, 0.001375343973}, {0.50, 0.005940084442}};
    igabem_hull *hull = ellipsoid_hull(1.0, 1.0 / 6, 1.0 / 6, 0.125, 8, 5);
    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    for (size_t i = 0; i < sizeof exact / sizeof exact[0]; i++) {
        igabem_solution *solution = solve(hull, exact[i][0]);
        double scale = info.hydrostatics.wetted_area;
        CHECK_RELATIVE(scale * square(solution), exact[i][1], 1e-3);
        CHECK_RELATIVE(scale * pressure(solution, 160, 80), exact[i][1], 5e-3);
        igabem_solution_free(solution);
    }
    igabem_hull_free(hull);
}

/* On a hull with a waterline the run-up counts too; the midpoint rule is of second order. */
static void wigley_against_the_adaptive_integrals(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 12, 5);
    igabem_forces forces;
    igabem_solution *solution = solve(hull, 0.316);
    CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    CU_ASSERT(fabs(forces.cw_run_up) > 0.01 * forces.cw_pressure);
    CHECK_RELATIVE(square(solution), forces.cw, 5e-4);
    double error[3];
    for (int k = 0; k < 3; k++) {
        size_t n = (size_t)20 << k;
        error[k] = fabs(pressure(solution, n, n / 2) - forces.cw_pressure);
    }
    CU_ASSERT(error[2] < 2e-3 * forces.cw_pressure);
    CU_ASSERT(log2(error[0] / error[1]) > 1.8);
    CU_ASSERT(log2(error[1] / error[2]) > 1.8);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

static void gradient_against_differences(void)
{
    enum { N = 3 };
    igabem_pressure_sample at[N] = {
        {{0.1, -0.2, 0.3}, 0.7, 0}, {{-0.4, 0.1, 0.2}, -0.3, 0}, {{0.25, 0, 0.1}, 0, 0.9}};
    igabem_pressure_sample gradient[N];
    double whole = igabem_pressure_sum(N, at, gradient);
    CHECK_CLOSE(whole, 0.7 * (0.1 - 0.07) - 0.3 * (-0.4 - 0.105) + 0.45 * 0.0625, 1e-15);
    for (int k = 0; k < N; k++) {
        double *x = (double *)&at[k], *g = (double *)&gradient[k];
        for (int c = 0; c < 5; c++) {
            double keep = x[c], side[2];
            for (int s = 0; s < 2; s++) {
                x[c] = keep + (s ? 1e-5 : -1e-5);
                side[s] = igabem_pressure_sum(N, at, NULL);
            }
            x[c] = keep;
            CHECK_CLOSE(g[c], (side[1] - side[0]) / 2e-5, 1e-9);
        }
    }
}

static void refuses_what_it_cannot_sample(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 3, 2);
    igabem_solution *solution = NULL;
    igabem_options options;
    size_t n;
    igabem_pressure_sample *sample;
    igabem_options_init(&options);
    options.froude = 0.3;
    options.formulation = IGABEM_FORMULATION_MICHELL;
    CU_ASSERT_EQUAL_FATAL(igabem_solve(hull, &options, &solution), IGABEM_OK);
    CU_ASSERT_EQUAL(igabem_pressure_samples(solution, 8, 4, &n, &sample), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(sample);
    CU_ASSERT_EQUAL(igabem_pressure_samples(solution, 8, 4, &n, NULL), IGABEM_OK);
    CU_ASSERT_EQUAL(n, 8 * 4 + 16);
    CU_ASSERT_EQUAL(igabem_pressure_samples(solution, 0, 4, &n, NULL), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_pressure_samples(NULL, 8, 4, &n, NULL), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_wave_residuals(solution, NULL), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT(isnan(igabem_pressure_sum(1, NULL, NULL)));
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

static const struct check_case cases[] = {
    {"spheroid against its exact resistance", spheroid_against_its_exact_resistance},
    {"Wigley against the adaptive integrals", wigley_against_the_adaptive_integrals},
    {"gradient against differences", gradient_against_differences},
    {"refuses what it cannot sample", refuses_what_it_cannot_sample},
};

CHECK_MAIN("residual", cases)
