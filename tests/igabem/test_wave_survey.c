/* Where the waves come from and what they carry away, beside independent ways to the same. */
#include "check.h"
#include "hulls.h"

#include <complex.h>

static igabem_solution *solve(const igabem_hull *hull, double froude,
                              igabem_formulation formulation)
{
    igabem_options options;
    igabem_solution *solution = NULL;
    igabem_options_init(&options);
    options.refine = 1;
    options.froude = froude;
    options.formulation = formulation;
    CU_ASSERT_EQUAL_FATAL(igabem_solve(hull, &options, &solution), IGABEM_OK);
    return solution;
}

/* Michell's amplitude of the Wigley hull y = (B/2)(1 - 4x^2)(1 - z^2/T^2) from x0 to x1: Simpson
 * along x, closed form in depth. */
static double _Complex michell(double draft, double k0, double t, double x0, double x1)
{
    enum { N = 400 };
    double a = k0 * (1.0 + t * t), k = k0 * sqrt(1.0 + t * t), decay = exp(-a * draft);
    double depth = (1.0 - decay) / a -
                   (2.0 / (a * a * a) -
                    decay * (draft * draft / a + 2.0 * draft / (a * a) + 2.0 / (a * a * a))) /
                       (draft * draft);
    double _Complex sum = 0.0;
    for (int i = 0; i <= N; i++) {
        double x = x0 + (x1 - x0) * i / N, weight = i == 0 || i == N ? 1.0 : i % 2 ? 4.0 : 2.0;
        sum += weight * 8.0 * x * cexp(I * k * x);
    }
    return sum * (x1 - x0) / (3.0 * N) * depth;
}

static void test_shares(void)
{
    const double draft = 0.0625, froude = 0.3, k0 = 1.0 / (froude * froude);
    const double limit[2] = {0.2, -0.1};
    igabem_hull *hull = wigley_hull(0.1, draft, 12, 3);
    igabem_solution *solution = solve(hull, froude, IGABEM_FORMULATION_MICHELL);
    double share[3], sum[3] = {0, 0, 0};
    CU_ASSERT_EQUAL(igabem_wave_shares(solution, 2, limit, share), IGABEM_OK);
    for (double v = 0.0, step = 0.002; v < 3.6; v += step) {
        double t = sinh(v + 0.5 * step);
        double _Complex h[3] = {michell(draft, k0, t, limit[0], 0.5),
                                michell(draft, k0, t, limit[1], limit[0]),
                                michell(draft, k0, t, -0.5, limit[1])};
        for (int k = 0; k < 3; k++)
            sum[k] += creal(h[k] * conj(h[0] + h[1] + h[2])) * (1.0 + t * t);
    }
    for (int k = 0; k < 3; k++)
        CHECK_CLOSE(share[k], sum[k] / (sum[0] + sum[1] + sum[2]), 2e-3);
    CHECK_CLOSE(share[0] + share[1] + share[2], 1.0, 1e-13);
    CU_ASSERT_EQUAL(igabem_wave_shares(solution, 0, NULL, share), IGABEM_OK);
    CHECK_CLOSE(share[0], 1.0, 1e-15);
    /* limits on the edges of elements, to rounding */
    for (int k = -2; k <= 2; k++) {
        double edge[2] = {1.0 / 6 + k * 3e-17, -1.0 / 6 + k * 3e-17};
        CU_ASSERT_EQUAL(igabem_wave_shares(solution, 2, edge, share), IGABEM_OK);
        CHECK_CLOSE(share[0] + share[1] + share[2], 1.0, 1e-13);
    }
    const double wrong[2] = {-0.1, 0.2};
    CU_ASSERT_EQUAL(igabem_wave_shares(solution, 2, wrong, share), IGABEM_ERROR_ARGUMENT);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

/* Limits where lines of the hull run in the plane of the limit but for rounding. */
static void test_limits_on_lines(void)
{
    nurbs_patches *file = NULL;
    igabem_hull *hull = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_read(EXAMPLES_DIR "/hulls/fast.json", &file), NURBS_OK);
    const nurbs_surface *list[1] = {nurbs_patches_get(file, 0)};
    CU_ASSERT_EQUAL_FATAL(igabem_hull_create(list, 1, IGABEM_SYMMETRIC, &hull), IGABEM_OK);
    igabem_solution *solution = solve(hull, 0.3, IGABEM_FORMULATION_HOGNER);
    const double limit[2] = {0.66666666666666674, 0.33333333333333331};
    double share[3] = {NAN, NAN, NAN};
    CU_ASSERT_EQUAL(igabem_wave_shares(solution, 2, limit, share), IGABEM_OK);
    CHECK_CLOSE(share[0] + share[1] + share[2], 1.0, 1e-12);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
    nurbs_patches_free(file);
}

/* Submerged: no filter, so far field and wave cut are the same integral. */
static void test_cut_of_spheroid(void)
{
    igabem_hull *hull = ellipsoid_hull(1.0, 0.2, 0.2, 0.16, 4, 4);
    igabem_solution *solution = solve(hull, 0.6, IGABEM_FORMULATION_NEUMANN_KELVIN);
    igabem_forces forces;
    double cw;
    CU_ASSERT_EQUAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    CU_ASSERT_EQUAL(igabem_wave_cut(solution, NAN, &cw), IGABEM_OK);
    CHECK_CLOSE(cw / forces.cw, 1.0, 3e-3);
    CU_ASSERT_EQUAL(igabem_wave_cut(solution, 0.05, &cw), IGABEM_ERROR_ARGUMENT);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

/* Surface-piercing: the waves on the cut are filtered, so is the Kochin function here. */
static void test_cut_of_wigley(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 16, 4);
    igabem_solution *solution = solve(hull, 0.35, IGABEM_FORMULATION_NEUMANN_KELVIN);
    enum { N = 370 };
    const double step = 0.01, t_c = igabem_solution_options(solution)->cutoff_angle;
    double t[N], h[N][2], dcw[N], cw, sum = 0.0;
    for (int i = 0; i < N; i++)
        t[i] = sinh((i + 0.5) * step);
    CU_ASSERT_EQUAL_FATAL(igabem_kochin(solution, N, t, h, dcw), IGABEM_OK);
    for (int i = 0; i < N; i++) {
        double ratio = (1.0 + t[i] * t[i]) / (1.0 + t_c * t_c);
        sum += 2.0 * dcw[i] * exp(-2.0 * ratio * ratio) * cosh((i + 0.5) * step) * step;
    }
    CU_ASSERT_EQUAL(igabem_wave_cut(solution, NAN, &cw), IGABEM_OK);
    CHECK_CLOSE(cw / sum, 1.0, 5e-3);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

static const struct check_case cases[] = {
    {"shares of zones along the hull", test_shares},
    {"limits on lines of the hull", test_limits_on_lines},
    {"cut beside a spheroid", test_cut_of_spheroid},
    {"cut beside a Wigley hull", test_cut_of_wigley},
};

CHECK_MAIN("wave survey", cases)
