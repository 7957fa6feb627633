/* Designs of experiments: strata, balance, spread, constraints, augmentation. */
#include "check.h"

#include <bayesopt/design.h>

#include <stdbool.h>
#include <string.h>

enum { N = 60, D = 5 };

static bayesopt_design_quality quality(bayesopt_design_kind kind, bayesopt_design_options *options)
{
    double x[N * D];
    bayesopt_design_quality q = {0};
    CU_ASSERT_EQUAL(bayesopt_design(kind, N, D, options, x), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_design_measure(N, D, x, &q), BAYESOPT_OK);
    return q;
}

static void kinds(void)
{
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    bayesopt_design_quality uniform = quality(BAYESOPT_DESIGN_UNIFORM, NULL);
    bayesopt_design_quality lhs = quality(BAYESOPT_DESIGN_LHS, NULL);
    bayesopt_design_quality annealed = quality(BAYESOPT_DESIGN_ANNEALED_LHS, &options);
    bayesopt_design_quality sobol = quality(BAYESOPT_DESIGN_SOBOL, NULL);
    bayesopt_design_quality stlbo = quality(BAYESOPT_DESIGN_STLBO, NULL);
    CHECK_CLOSE(lhs.occupied, 1, 0);
    CHECK_CLOSE(annealed.occupied, 1, 0);
    CU_ASSERT(annealed.audze_eglais < lhs.audze_eglais);
    CU_ASSERT(annealed.min_distance > 1.3 * lhs.min_distance);
    CU_ASSERT(annealed.discrepancy < lhs.discrepancy);
    CU_ASSERT(lhs.discrepancy < uniform.discrepancy);
    CU_ASSERT(sobol.discrepancy < uniform.discrepancy);
    CU_ASSERT(stlbo.audze_eglais < uniform.audze_eglais);
    CU_ASSERT(stlbo.occupied > uniform.occupied);
    /* A high power comes nearer to maximin. */
    options.power = 50;
    CU_ASSERT(quality(BAYESOPT_DESIGN_ANNEALED_LHS, &options).phi_p < lhs.phi_p);
}

/* Every first 2^k points put one point into each of 2^k intervals of every coordinate, in all
 * dimensions that the generator makes up too. */
static void sobol_balance(void)
{
    enum { POINTS = 64, DIMENSIONS = 60 };
    static double x[POINTS * DIMENSIONS];
    CU_ASSERT_EQUAL(bayesopt_design(BAYESOPT_DESIGN_SOBOL, POINTS, DIMENSIONS, NULL, x),
                    BAYESOPT_OK);
    for (size_t n = 2; n <= POINTS; n *= 2)
        for (size_t j = 0; j < DIMENSIONS; j++) {
            bool seen[POINTS] = {false};
            size_t different = 0;
            for (size_t i = 0; i < n; i++) {
                size_t bin = (size_t)(x[i * DIMENSIONS + j] * (double)n);
                different += !seen[bin];
                seen[bin] = true;
            }
            CU_ASSERT_EQUAL(different, n);
        }
}

static void seeds(void)
{
    double a[N * D], b[N * D];
    bayesopt_design_options options;
    for (int kind = 0; kind <= BAYESOPT_DESIGN_STLBO; kind++) {
        bayesopt_design_options_init(&options);
        CU_ASSERT_EQUAL(bayesopt_design((bayesopt_design_kind)kind, N, D, &options, a),
                        BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_design((bayesopt_design_kind)kind, N, D, &options, b),
                        BAYESOPT_OK);
        CU_ASSERT_EQUAL(memcmp(a, b, sizeof a), 0);
        options.seed = 2;
        CU_ASSERT_EQUAL(bayesopt_design((bayesopt_design_kind)kind, N, D, &options, b),
                        BAYESOPT_OK);
        CU_ASSERT_NOT_EQUAL(memcmp(a, b, sizeof a), 0);
    }
}

/* A shell two hundredths thick between two spheres: a curved region that uniform points miss. */
static int shell(void *data, size_t d, const double *x, double *value)
{
    double square = 0;
    (void)data;
    for (size_t j = 0; j < d; j++)
        square += x[j] * x[j];
    value[0] = sqrt(square) - 1.02;
    value[1] = 1.00 - sqrt(square);
    return 0;
}

static void constrained(void)
{
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.n_constraints = 2;
    options.constraint = shell;
    for (int kind = 0; kind <= BAYESOPT_DESIGN_STLBO; kind++) {
        double x[N * D], value[2];
        bayesopt_design_quality q;
        CU_ASSERT_EQUAL(bayesopt_design((bayesopt_design_kind)kind, N, D, &options, x),
                        BAYESOPT_OK);
        for (size_t i = 0; i < N; i++) {
            shell(NULL, D, x + i * D, value);
            CU_ASSERT(value[0] <= 0 && value[1] <= 0);
        }
        CU_ASSERT_EQUAL(bayesopt_design_measure(N, D, x, &q), BAYESOPT_OK);
        CU_ASSERT(q.min_distance > 0.02);
    }
}

/* Cannot be judged anywhere, or violated everywhere. */
static int hopeless(void *data, size_t d, const double *x, double *value)
{
    (void)d;
    (void)x;
    value[0] = 1;
    return data != NULL;
}

static void infeasible(void)
{
    double x[4];
    int marker = 1;
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.n_constraints = 1;
    options.constraint = hopeless;
    for (int kind = 0; kind <= BAYESOPT_DESIGN_STLBO; kind++) {
        options.constraint_user_data = kind % 2 ? &marker : NULL;
        CU_ASSERT_EQUAL(bayesopt_design((bayesopt_design_kind)kind, 2, 2, &options, x),
                        BAYESOPT_ERROR_INFEASIBLE);
    }
}

/* New points take strata the old ones left free and stay away from them. */
static void augmentation(void)
{
    enum { OLD = 20, NEW = 20 };
    double all[(OLD + NEW) * 2];
    bayesopt_design_options options;
    bayesopt_design_quality q;
    CU_ASSERT_EQUAL(bayesopt_design(BAYESOPT_DESIGN_ANNEALED_LHS, OLD, 2, NULL, all), BAYESOPT_OK);
    bayesopt_design_options_init(&options);
    options.seed = 3;
    options.n_existing = OLD;
    options.existing = all;
    CU_ASSERT_EQUAL(bayesopt_design(BAYESOPT_DESIGN_ANNEALED_LHS, NEW, 2, &options, all + OLD * 2),
                    BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_design_measure(OLD + NEW, 2, all, &q), BAYESOPT_OK);
    CU_ASSERT(q.occupied > 0.97);
    CU_ASSERT(q.min_distance > 0.04);
}

/* Two points: all measures by hand. */
static void measures(void)
{
    const double x[4] = {0.25, 0.5, 0.75, 0.5};
    bayesopt_design_quality q;
    CU_ASSERT_EQUAL(bayesopt_design_measure(2, 2, x, &q), BAYESOPT_OK);
    CHECK_CLOSE(q.audze_eglais, 4, 1e-14);
    CHECK_CLOSE(q.min_distance, 0.5, 1e-15);
    CHECK_CLOSE(q.phi_p, 2, 1e-13);
    CHECK_CLOSE(q.occupied, 0.75, 1e-15);
    double single = 2 * (1 + 0.125 - 0.03125), pairs = 2 * (1 + 0.25) + 2 * (1 + 0.25 - 0.25);
    CHECK_CLOSE(q.discrepancy * q.discrepancy, 169.0 / 144 - single + pairs / 4, 1e-14);
    const double outside[2] = {0.5, 1.5};
    CU_ASSERT_EQUAL(bayesopt_design_measure(1, 2, outside, &q), BAYESOPT_ERROR_ARGUMENT);
}

static void misuse(void)
{
    double x[4];
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    CU_ASSERT_EQUAL(bayesopt_design(BAYESOPT_DESIGN_LHS, 0, 2, NULL, x), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_design((bayesopt_design_kind)17, 2, 2, NULL, x),
                    BAYESOPT_ERROR_ARGUMENT);
    options.power = -1;
    CU_ASSERT_EQUAL(bayesopt_design(BAYESOPT_DESIGN_LHS, 2, 2, &options, x),
                    BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_STRING_EQUAL(bayesopt_design_name(BAYESOPT_DESIGN_SOBOL), "sobol");
    CU_ASSERT_STRING_EQUAL(bayesopt_design_name((bayesopt_design_kind)17), "unknown");
    CU_ASSERT_EQUAL(bayesopt_design(BAYESOPT_DESIGN_ANNEALED_LHS, 1, 1, NULL, x), BAYESOPT_OK);
}

static const struct check_case cases[] = {
    {"kinds", kinds},           {"Sobol balance", sobol_balance},
    {"seeds", seeds},           {"constrained", constrained},
    {"infeasible", infeasible}, {"augmentation", augmentation},
    {"measures", measures},     {"misuse", misuse},
};

CHECK_MAIN("bayesopt design", cases)
