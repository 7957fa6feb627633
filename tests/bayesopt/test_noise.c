/* Values told more than once at a point, and the best point of noisy ones. */
#include "check.h"

#include <bayesopt/bayesopt.h>

#include <stdbool.h>
#include <stdint.h>

/* A deterministic study with 5 + x at eight points and the given values at x = 0.5. */
static double mean_of(size_t n, const double *values, bayesopt_model_info *info)
{
    double lower = 0, upper = 1, x, at = 0.5, mean = NAN;
    bayesopt_options options;
    bayesopt *bo;
    uint64_t id;
    bayesopt_options_init(&options);
    options.initial_n = 8;
    options.max_evaluations = 8 + n;
    options.transform = BAYESOPT_TRANSFORM_NONE;
    CU_ASSERT_FATAL(bayesopt_create(1, &lower, &upper, &options, &bo) == BAYESOPT_OK);
    for (size_t i = 0; i < n; i++) {
        CU_ASSERT(bayesopt_tell_point(bo, &at, values[i], NULL) == BAYESOPT_OK);
        if (i < 8 && bayesopt_ask(bo, 1, &x, &id) == BAYESOPT_OK)
            CU_ASSERT(bayesopt_tell(bo, id, 5 + x, NULL) == BAYESOPT_OK);
    }
    while (bayesopt_ask(bo, 1, &x, &id) == BAYESOPT_OK)
        CU_ASSERT(bayesopt_tell(bo, id, 5 + x, NULL) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_predict(bo, 1, &at, &mean, NULL) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_model(bo, info, NULL) == BAYESOPT_OK);
    bayesopt_free(bo);
    return mean;
}

static void repeated_values_give_their_mean(void)
{
    static const double values[][5] = {
        {1, 1.5, 2, 2.5, 3}, {3, 2.5, 2, 1.5, 1}, {2.5, 1, 3, 1.5, 2}, {2, 3, 1, 2.5, 1.5}};
    bayesopt_model_info info;
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        CHECK_CLOSE(mean_of(5, values[i], &info), 2, 1e-4);
        CHECK_CLOSE(info.repeat_sd, sqrt(2.5 / 4), 1e-12);
    }
    CHECK_CLOSE(mean_of(3, (const double[]){0, 0, 3}, &info), 1, 1e-4);
    CHECK_CLOSE(mean_of(3, (const double[]){3, 0, 0}, &info), 1, 1e-4);
    mean_of(1, values[0], &info);
    CU_ASSERT(isnan(info.repeat_sd));
}

static uint64_t state = 12345;

/* About normal: the sum of twelve uniform numbers. */
static double noise(void)
{
    double sum = -6;
    for (int i = 0; i < 12; i++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        sum += (double)(state >> 11) / 9007199254740992.0;
    }
    return sum;
}

static double valley(double x)
{
    return 10 * (x - 0.3) * (x - 0.3);
}

/* With a constraint c = x >= 0.2 that is noisy too. */
static void luck_is_not_the_best(void)
{
    double lower = 0, upper = 1, x, f, told, lucky = 0.9, c = 0.9, tilted = 0.05, below = 0.3;
    bayesopt_options options;
    bayesopt *bo;
    uint64_t id, best, luckiest;
    bayesopt_options_init(&options);
    options.initial_n = 40;
    options.max_evaluations = 42;
    options.noise = BAYESOPT_NOISE_LEARNED;
    options.n_constraints = 1;
    double least = 0.2, most = INFINITY;
    options.constraint_lower = &least;
    options.constraint_upper = &most;
    CU_ASSERT_FATAL(bayesopt_create(1, &lower, &upper, &options, &bo) == BAYESOPT_OK);
    for (size_t i = 0; i < 40 && bayesopt_ask(bo, 1, &x, &id) == BAYESOPT_OK; i++) {
        c = x + 0.05 * noise();
        CU_ASSERT(bayesopt_tell(bo, id, valley(x) + 0.3 * noise(), &c) == BAYESOPT_OK);
    }
    c = lucky;
    CU_ASSERT(bayesopt_tell_point(bo, &lucky, -1.5, &c) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_tell_point(bo, &tilted, -1.2, &below) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_best_told(bo, &x, &told, &luckiest) == BAYESOPT_OK);
    CU_ASSERT(x == lucky && told == -1.5);
    CU_ASSERT(bayesopt_best(bo, &x, &f, &best) == BAYESOPT_OK);
    CHECK_CLOSE(x, 0.3, 0.1);
    CHECK_CLOSE(f, valley(x), 0.2);
    CU_ASSERT(best != luckiest);
    double mean;
    CU_ASSERT(bayesopt_predict(bo, 1, &x, &mean, NULL) == BAYESOPT_OK);
    CHECK_CLOSE(f, mean, 1e-12);
    bayesopt_free(bo);
}

static void without_noise_it_is_the_least(void)
{
    double lower = 0, upper = 1, x, y, f, g;
    bayesopt_options options;
    bayesopt *bo;
    uint64_t id, other;
    bayesopt_options_init(&options);
    options.max_evaluations = 14;
    CU_ASSERT_FATAL(bayesopt_create(1, &lower, &upper, &options, &bo) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_best(bo, &x, &f, &id) == BAYESOPT_ERROR_ARGUMENT);
    while (bayesopt_ask(bo, 1, &x, &id) == BAYESOPT_OK)
        CU_ASSERT(bayesopt_tell(bo, id, valley(x), NULL) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_best(bo, &x, &f, &id) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_best_told(bo, &y, &g, &other) == BAYESOPT_OK);
    CU_ASSERT(x == y && f == g && id == other && f == valley(x));
    bayesopt_free(bo);
}

static const struct check_case cases[] = {
    {"repeated values give their mean", repeated_values_give_their_mean},
    {"luck is not the best", luck_is_not_the_best},
    {"without noise it is the least", without_noise_it_is_the_least},
};

CHECK_MAIN("bayesopt noise", cases)
