/* What the search makes of what it is told: gradients, levels, noise, models, scales of values. */
#include "check.h"
#include "search_problem.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* A waved bowl in six variables, twelve points and twelve proposals: with gradients the minimum is
 * found far closer. */
static double best_with_gradients(bool told)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 12;
    options.max_evaluations = 24;
    bayesopt *bo = make(6, &options);
    double x[6], gradient[6], f;
    uint64_t id;
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK) {
        bayesopt_result result = {.f = bowl(6, x), .gradient = told ? gradient : NULL};
        for (size_t j = 0; j < 6; j++) {
            result.f += 0.2 * cos(2 * x[j]);
            gradient[j] = 2 * (x[j] - 0.3) * (1 + (double)j) - 0.4 * sin(2 * x[j]);
        }
        CU_ASSERT_EQUAL(bayesopt_tell_result(bo, id, &result), BAYESOPT_OK);
    }
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    bayesopt_free(bo);
    /* The minimum, variable by variable, by Newton's iteration. */
    for (size_t j = 0; j < 6; j++) {
        double at = 0.3, w = 1 + (double)j;
        for (int i = 0; i < 50; i++)
            at -= (2 * w * (at - 0.3) - 0.4 * sin(2 * at)) / (2 * w - 0.8 * cos(2 * at));
        f -= w * (at - 0.3) * (at - 0.3) + 0.2 * cos(2 * at);
    }
    return f;
}

static void gradients_help(void)
{
    double without = best_with_gradients(false), with = best_with_gradients(true);
    CU_ASSERT(with > -1e-9 && with < 1e-3);
    CU_ASSERT(with < 0.1 * without);
}

/* A cheap level that is biased and stretched: most evaluations are made there, the best point is
 * one of the dear level. */
static void two_levels(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.n_levels = 2;
    options.level_cost_ratio = 0.1;
    options.initial_n = 20;
    options.max_evaluations = 60;
    bayesopt *bo = make(3, &options);
    CU_ASSERT_EQUAL(bayesopt_initial_count(bo), 25);
    double x[3], f;
    uint64_t id;
    int level;
    size_t dear = 0, cheap = 0;
    while (bayesopt_ask_levels(bo, 1, x, &id, &level) == BAYESOPT_OK) {
        f = bowl(3, x);
        CU_ASSERT(level == (id <= 20 ? 0 : id <= 25 ? 1 : level));
        if (level == 0)
            f = -5 + 0.7 * f + 0.3 * sin(2 * x[0]);
        *(level ? &dear : &cheap) += 1;
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, f, NULL), BAYESOPT_OK);
    }
    CU_ASSERT(dear > 10 && cheap > 20);
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, &id), BAYESOPT_OK);
    CHECK_CLOSE(f, bowl(3, x), 0);
    CU_ASSERT(f < 1e-3);
    double mean, sd;
    CU_ASSERT_EQUAL(bayesopt_predict(bo, 1, x, &mean, &sd), BAYESOPT_OK);
    CHECK_CLOSE(mean, f, 1e-3);
    bayesopt_free(bo);
}

static void small_expected_improvement(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 15;
    options.max_evaluations = 200;
    options.stop_expected_improvement = 1e-3;
    bayesopt *bo = make(2, &options);
    double x[2], f;
    uint64_t id;
    bayesopt_status status;
    while ((status = bayesopt_ask(bo, 1, x, &id)) == BAYESOPT_OK)
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(2, x), NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(status, BAYESOPT_STOP_EXPECTED_IMPROVEMENT);
    CU_ASSERT(bayesopt_count(bo) < 100);
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    CU_ASSERT(f < 1e-3);
    bayesopt_free(bo);
}

/* Noise of a tenth of the spread: the model's minimum is near the true one. */
static void noisy_objective(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 20;
    options.max_evaluations = 60;
    options.noise = BAYESOPT_NOISE_LEARNED;
    bayesopt *bo = make(2, &options);
    double x[2], mean, sd;
    const double centre[2] = {0.3, 0.3};
    uint64_t id, state = 3;
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK) {
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        double noise = 0.4 * ((double)(state >> 11) * 0x1p-53 - 0.5);
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(2, x) + noise, NULL), BAYESOPT_OK);
    }
    CU_ASSERT_EQUAL(bayesopt_predict(bo, 1, centre, &mean, &sd), BAYESOPT_OK);
    CHECK_CLOSE(mean, 0, 0.15);
    bayesopt_model_info info;
    CU_ASSERT_EQUAL(bayesopt_model(bo, &info, NULL), BAYESOPT_OK);
    CU_ASSERT(info.noise_variance > 1e-5);
    bayesopt_free(bo);
}

/* Every model and acquisition that can be asked for finds the bowl's minimum. */
static void models_and_acquisitions(void)
{
    static const size_t groups[3] = {0, 1, 0};
    enum { TIED, LINEAR, LOO, BOUND, RANK, WINSORISED, WAYS };
    for (int way = 0; way < WAYS; way++) {
        bayesopt_options options;
        bayesopt_options_init(&options);
        options.initial_n = 12;
        options.max_evaluations = 32;
        options.scales = way == TIED ? BAYESOPT_SCALES_TIED : BAYESOPT_SCALES_AUTO;
        options.group = way == TIED ? groups : NULL;
        options.mean = way == LINEAR ? BAYESOPT_MEAN_LINEAR : BAYESOPT_MEAN_CONSTANT;
        options.choice = way == LOO ? BAYESOPT_CHOICE_LOO : BAYESOPT_CHOICE_POSTERIOR;
        if (way == BOUND) {
            options.acquisition = BAYESOPT_ACQUISITION_LCB;
            options.strategy = BAYESOPT_STRATEGY_GLOBAL;
        }
        options.transform = way == RANK         ? BAYESOPT_TRANSFORM_RANK
                            : way == WINSORISED ? BAYESOPT_TRANSFORM_WINSORISED
                                                : BAYESOPT_TRANSFORM_AUTO;
        bayesopt *bo = make(3, &options);
        double x[3], f, scale[3];
        uint64_t id;
        while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK)
            CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(3, x), NULL), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
        CU_ASSERT(f < (way == RANK ? 0.02 : way == BOUND ? 1e-2 : 1e-4));
        bayesopt_model_info info;
        CU_ASSERT_EQUAL(bayesopt_model(bo, &info, scale), BAYESOPT_OK);
        if (way == TIED)
            CHECK_CLOSE(scale[0], scale[2], 1e-12);
        bayesopt_free(bo);
    }
}

static void models_that_are_refused(void)
{
    static const size_t gap[2] = {0, 2};
    const double lower[2] = {0, 0}, upper[2] = {1, 1};
    bayesopt_options options;
    bayesopt *bo;
    bayesopt_options_init(&options);
    options.scales = BAYESOPT_SCALES_TIED;
    CU_ASSERT_EQUAL(bayesopt_create(2, lower, upper, &options, &bo), BAYESOPT_ERROR_ARGUMENT);
    options.group = gap;
    CU_ASSERT_EQUAL(bayesopt_create(2, lower, upper, &options, &bo), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "group"));
    bayesopt_options_init(&options);
    options.mean = BAYESOPT_MEAN_FIXED;
    CU_ASSERT_EQUAL(bayesopt_create(2, lower, upper, &options, &bo), BAYESOPT_ERROR_ARGUMENT);
    bayesopt_options_init(&options);
    options.lcb_factor = -1;
    CU_ASSERT_EQUAL(bayesopt_create(2, lower, upper, &options, &bo), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "lcb_factor"));
}

/* Branin's function, smooth with three equal minima: the quadratic steps come in and the value is
 * exact to six digits. */
static void smooth_functions_are_polished(void)
{
    const double pi = 3.14159265358979323846, least = 0.39788735772973816;
    for (unsigned seed = 1; seed <= 2; seed++) {
        const double lower[2] = {-5, 0}, upper[2] = {10, 15};
        bayesopt_options options;
        bayesopt_options_init(&options);
        options.initial_n = 16;
        options.max_evaluations = 50;
        options.seed = seed;
        bayesopt *bo;
        bayesopt_point point;
        double x[2], f;
        uint64_t id;
        size_t descents = 0;
        CU_ASSERT_EQUAL_FATAL(bayesopt_create(2, lower, upper, &options, &bo), BAYESOPT_OK);
        while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK) {
            double q = x[1] - 5.1 * x[0] * x[0] / (4 * pi * pi) + 5 * x[0] / pi - 6;
            f = q * q + 10 * (1 - 1 / (8 * pi)) * cos(x[0]) + 10;
            CU_ASSERT_EQUAL(bayesopt_tell(bo, id, f, NULL), BAYESOPT_OK);
            CU_ASSERT_EQUAL(bayesopt_get(bo, id - 1, &point), BAYESOPT_OK);
            descents += point.phase == BAYESOPT_PHASE_DESCENT;
        }
        CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
        CHECK_CLOSE(f, least, 1e-6);
        CU_ASSERT(descents > 0);
        CU_ASSERT_STRING_EQUAL(bayesopt_phase_name(BAYESOPT_PHASE_DESCENT), "descent");
        bayesopt_free(bo);
    }
}

/* Forrester, Sobester and Keane, Proc. R. Soc. A 463 (2007) 3251: the cheap level is the dear one
 * halved and tilted. Few dear evaluations suffice. */
static void forrester_pair(void)
{
    const double lower = 0, upper = 1;
    bayesopt_options options;
    bayesopt *bo;
    bayesopt_options_init(&options);
    options.n_levels = 2;
    options.level_cost_ratio = 0.05;
    options.initial_n = 11;
    options.max_evaluations = 24;
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(1, &lower, &upper, &options, &bo), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_level_count(bo), 2);
    double x, f;
    uint64_t id;
    int level;
    size_t dear = 0;
    while (bayesopt_ask_levels(bo, 1, &x, &id, &level) == BAYESOPT_OK) {
        f = (6 * x - 2) * (6 * x - 2) * sin(12 * x - 4);
        dear += level == 1;
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, level ? f : 0.5 * f + 10 * (x - 0.5) - 5, NULL),
                        BAYESOPT_OK);
    }
    CU_ASSERT(dear <= 13);
    CU_ASSERT_EQUAL(bayesopt_best(bo, &x, &f, NULL), BAYESOPT_OK);
    CHECK_CLOSE(f, -6.020740, 1e-3);
    bayesopt_free(bo);
}

/* Values from 1e-300 to 1e300 in one history. */
static void widest_range(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 10;
    options.max_evaluations = 30;
    bayesopt *bo = make(2, &options);
    double x[2], f;
    uint64_t id;
    bayesopt_status status;
    while ((status = bayesopt_ask(bo, 1, x, &id)) == BAYESOPT_OK) {
        CU_ASSERT(isfinite(x[0]) && isfinite(x[1]));
        f = pow(10, -300 + 600 * (bowl(2, x) / bowl(2, (double[2]){2, 2})));
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, f, NULL), BAYESOPT_OK);
    }
    CU_ASSERT_EQUAL(status, BAYESOPT_STOP_BUDGET);
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    CU_ASSERT(isfinite(f) && f < 1e-100);
    double mean, sd;
    CU_ASSERT_EQUAL(bayesopt_predict(bo, 1, x, &mean, &sd), BAYESOPT_OK);
    CU_ASSERT(!isnan(mean) && !isnan(sd));
    bayesopt_free(bo);
}

/* Half axes from 1 to 1/100, turned: a quadratic that foretells values it was not fitted to is
 * trusted, and its minimum found to rounding. */
static double long_valley(const double *x)
{
    double sum = 0;
    for (int m = 0; m < 5; m++) {
        double z = 0;
        for (int j = 0; j < 5; j++)
            z += cos(3.14159265358979 * m * (j + 0.5) / 5) * (x[j] - 0.35);
        sum += pow(10, m) * z * z;
    }
    return sum;
}

static void long_valleys_are_followed(void)
{
    for (uint64_t seed = 1; seed <= 3; seed++) {
        bayesopt_options options;
        bayesopt_options_init(&options);
        options.seed = seed;
        options.initial_n = 30;
        options.max_evaluations = 50;
        bayesopt *bo = make(5, &options);
        double x[5], f;
        uint64_t id;
        while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK)
            CU_ASSERT_EQUAL(bayesopt_tell(bo, id, long_valley(x), NULL), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_best(bo, NULL, &f, NULL), BAYESOPT_OK);
        CU_ASSERT(f >= 0 && f < 1e-7);
        bayesopt_free(bo);
    }
}

static const struct check_case cases[] = {
    {"models and acquisitions", models_and_acquisitions},
    {"models that are refused", models_that_are_refused},
    {"smooth functions are polished", smooth_functions_are_polished},
    {"forrester pair", forrester_pair},
    {"widest range", widest_range},
    {"long valleys are followed", long_valleys_are_followed},
    {"gradients help", gradients_help},
    {"two levels", two_levels},
    {"small expected improvement", small_expected_improvement},
    {"noisy objective", noisy_objective},
};

CHECK_MAIN("bayesopt search", cases)
