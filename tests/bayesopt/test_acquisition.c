/* The scalar functions of the acquisition against integrals, differences and identities. */
#include "check.h"

#include <bayesopt/acquisition.h>

/* E max(best - Y, 0) by the trapezium rule, spectrally accurate here. */
static double improvement_by_integral(double mean, double sd, double best)
{
    double sum = 0, step = 1e-3;
    for (double z = -12; z <= 12; z += step) {
        double gain = best - (mean + sd * z);
        if (gain > 0)
            sum += gain * exp(-z * z / 2) / sqrt(2 * 3.14159265358979323846) * step;
    }
    return sum;
}

static void expected_improvement(void)
{
    CHECK_RELATIVE(bayesopt_ei(0.3, 0.7, 0.1), improvement_by_integral(0.3, 0.7, 0.1), 1e-6);
    CHECK_RELATIVE(bayesopt_ei(-2, 0.5, 0.1), improvement_by_integral(-2, 0.5, 0.1), 1e-6);
    CHECK_CLOSE(bayesopt_ei(1, 0, 3), 2, 0);
    CHECK_CLOSE(bayesopt_ei(3, 0, 1), 0, 0);
    CU_ASSERT(isinf(bayesopt_log_ei(3, 0, 1, NULL, NULL)));
    CU_ASSERT(isfinite(bayesopt_log_ei(1e10, 1, 0, NULL, NULL)));
    CHECK_CLOSE(bayesopt_lcb(1, 0.5, 2), 0, 0);
}

static void derivatives(void)
{
    static const double zs[] = {-300, -40, -6, -2.001, -1.999, -0.5, 0, 1, 4};
    for (size_t i = 0; i < sizeof zs / sizeof *zs; i++) {
        double z = zs[i], h = 1e-5 * fmax(1, fabs(z)), mean = 0.4, sd = 1.3, best = mean + sd * z;
        double dm, ds, lower = mean - 2 * sd + sd * z, upper = lower + 0.8;
        double scale = 1 + z * z;
        CHECK_CLOSE(bayesopt_log_h_derivative(z),
                    (bayesopt_log_h(z + h) - bayesopt_log_h(z - h)) / (2 * h), 1e-6 * scale);
        CHECK_CLOSE(bayesopt_log_cdf_derivative(z),
                    (bayesopt_log_cdf(z + h) - bayesopt_log_cdf(z - h)) / (2 * h), 1e-6 * scale);
        bayesopt_log_ei(mean, sd, best, &dm, &ds);
        CHECK_CLOSE(dm,
                    (bayesopt_log_ei(mean + h, sd, best, NULL, NULL) -
                     bayesopt_log_ei(mean - h, sd, best, NULL, NULL)) /
                        (2 * h),
                    1e-6 * scale);
        CHECK_CLOSE(ds,
                    (bayesopt_log_ei(mean, sd + 1e-6, best, NULL, NULL) -
                     bayesopt_log_ei(mean, sd - 1e-6, best, NULL, NULL)) /
                        2e-6,
                    1e-6 * scale);
        bayesopt_log_feasibility(mean, sd, lower, upper, &dm, &ds);
        CHECK_CLOSE(dm,
                    (bayesopt_log_feasibility(mean + h, sd, lower, upper, NULL, NULL) -
                     bayesopt_log_feasibility(mean - h, sd, lower, upper, NULL, NULL)) /
                        (2 * h),
                    1e-6 * scale);
        CHECK_CLOSE(ds,
                    (bayesopt_log_feasibility(mean, sd + 1e-6, lower, upper, NULL, NULL) -
                     bayesopt_log_feasibility(mean, sd - 1e-6, lower, upper, NULL, NULL)) /
                        2e-6,
                    2e-6 * scale);
    }
}

/* Both sides of the place where the formulas change, symmetry, and the interval as a sum of parts.
 */
static void identities(void)
{
    CHECK_CLOSE(bayesopt_log_h(-2 + 1e-12), bayesopt_log_h(-2 - 1e-12), 1e-11);
    CHECK_CLOSE(bayesopt_log_cdf(-2 + 1e-12), bayesopt_log_cdf(-2 - 1e-12), 1e-11);
    for (double z = -8; z < 8; z += 0.37)
        CHECK_CLOSE(exp(bayesopt_log_cdf(z)) + exp(bayesopt_log_cdf(-z)), 1, 1e-14);
    static const double ends[][2] = {{-3, -1}, {-1, 2}, {0.5, 3},
                                     {-9, -8}, {8, 9},  {-INFINITY, 0.3}};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        double a = ends[i][0], b = ends[i][1], middle = isinf(a) ? -1 : (a + b) / 2;
        double parts =
            exp(bayesopt_log_interval(a, middle)) + exp(bayesopt_log_interval(middle, b));
        CHECK_RELATIVE(parts, exp(bayesopt_log_interval(a, b)), 1e-12);
        CHECK_RELATIVE(bayesopt_log_interval(-b, -a), bayesopt_log_interval(a, b), 1e-13);
    }
    CHECK_CLOSE(bayesopt_log_interval(-INFINITY, INFINITY), 0, 0);
    CU_ASSERT(isinf(bayesopt_log_interval(2, 1)));
    CU_ASSERT(isnan(bayesopt_log_interval(NAN, 1)));
    CU_ASSERT(isfinite(bayesopt_log_interval(-1e9, -1e9 + 1)));
    CHECK_CLOSE(bayesopt_log_feasibility(1, 0, 0, 2, NULL, NULL), 0, 0);
    CU_ASSERT(isinf(bayesopt_log_feasibility(3, 0, 0, 2, NULL, NULL)));
}

static const struct check_case cases[] = {
    {"expected improvement", expected_improvement},
    {"derivatives", derivatives},
    {"identities", identities},
};

CHECK_MAIN("bayesopt acquisition", cases)
