/* Sobol' indices against their closed forms, leave-one-out against leaving one out. */
#include "check.h"

#include <bayesopt/bayesopt.h>

#include <stdint.h>

enum { D = 3, N = 60 };

/* On [0,1]^3: variances 1/12, 4/12 and, of the product with its mean taken out, 9/144. */
static double f(const double *x)
{
    return x[0] + 2 * x[1] + 3 * (x[0] - 0.5) * (x[2] - 0.5);
}

static bayesopt *told(size_t n, bool maximise)
{
    static const double lower[D] = {0}, upper[D] = {1, 1, 1};
    double x[N * D];
    bayesopt_options options;
    bayesopt *bo = NULL;
    bayesopt_options_init(&options);
    options.max_evaluations = N + 1;
    options.maximise = maximise;
    options.transform = BAYESOPT_TRANSFORM_NONE;
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(D, lower, upper, &options, &bo), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_design(BAYESOPT_DESIGN_LHS, N, D, NULL, x), BAYESOPT_OK);
    for (size_t i = 0; i < n; i++)
        CU_ASSERT_EQUAL(bayesopt_tell_point(bo, x + i * D, f(x + i * D), NULL), BAYESOPT_OK);
    return bo;
}

static void indices(void)
{
    const double v0 = 1.0 / 12, v1 = 4.0 / 12, v02 = 9.0 / 144, v = v0 + v1 + v02;
    double first[D], total[D];
    bayesopt *bo = told(N, false);
    CU_ASSERT_EQUAL(bayesopt_sensitivity(bo, 0, 2048, first, total), BAYESOPT_OK);
    CHECK_CLOSE(first[0], v0 / v, 0.02);
    CHECK_CLOSE(first[1], v1 / v, 0.02);
    CHECK_CLOSE(first[2], 0, 0.02);
    CHECK_CLOSE(total[0], (v0 + v02) / v, 0.02);
    CHECK_CLOSE(total[1], v1 / v, 0.02);
    CHECK_CLOSE(total[2], v02 / v, 0.02);
    bayesopt_free(bo);
}

/* By the regression alone: errors are small where the function is smooth, and told values come
 * back with their signs. test_gp.c compares with leaving one out. */
static void left_out(void)
{
    for (int turned = 0; turned < 2; turned++) {
        bayesopt *bo = told(40, turned);
        double value[N], mean[N], sd[N], most = 0;
        size_t n;
        CU_ASSERT_EQUAL(bayesopt_leave_one_out(bo, &n, value, mean, sd), BAYESOPT_OK);
        CU_ASSERT_EQUAL(n, 40);
        for (size_t i = 0; i < n; i++) {
            bayesopt_point p;
            CU_ASSERT(!bayesopt_get(bo, i, &p));
            CHECK_CLOSE(value[i], p.f, 1e-9);
            most = fmax(most, fabs(mean[i] - value[i]));
            CU_ASSERT(sd[i] > 0 && fabs(mean[i] - value[i]) < 12 * sd[i]);
        }
        CU_ASSERT(most > 0 && most < 0.1);
        bayesopt_free(bo);
    }
}

static const struct check_case cases[] = {{"indices", indices}, {"left out", left_out}};

CHECK_MAIN("bayesopt sensitivity", cases)
