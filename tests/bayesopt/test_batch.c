/* Batches: their points lie apart, and evaluating ten at a time costs little. */
#include "check.h"

#include <bayesopt/bayesopt.h>

#include <stdint.h>

enum { MOST = 6, BATCH = 20 };

static double bowl(size_t d, const double *x)
{
    double sum = 0;
    for (size_t j = 0; j < d; j++)
        sum += (x[j] - 0.3) * (x[j] - 0.3);
    return sum;
}

static double waves(size_t d, const double *x)
{
    double sum = bowl(d, x);
    for (size_t j = 0; j < d; j++)
        sum += 0.1 * sin(13 * x[j] + (double)j);
    return sum;
}

/* Least value 0.397887 on the unit square (Dixon and Szego 1978). */
static double branin(size_t d, const double *u)
{
    const double pi = 3.14159265358979323846;
    double x = 15 * u[0] - 5, y = 15 * u[1], a = y - 5.1 * x * x / (4 * pi * pi) + 5 * x / pi - 6;
    (void)d;
    return a * a + 10 * (1 - 1 / (8 * pi)) * cos(x) + 10;
}

typedef double function(size_t d, const double *x);

static bayesopt *start(size_t d, size_t n, bayesopt_noise noise, function *f)
{
    double lower[MOST] = {0}, upper[MOST] = {1, 1, 1, 1, 1, 1}, x[MOST];
    bayesopt_options options;
    bayesopt *bo = NULL;
    uint64_t id;
    bayesopt_options_init(&options);
    options.initial_n = n;
    options.max_evaluations = 300;
    options.noise = noise;
    CU_ASSERT_FATAL(bayesopt_create(d, lower, upper, &options, &bo) == BAYESOPT_OK);
    for (size_t i = 0; i < n && !bayesopt_ask(bo, 1, x, &id); i++)
        CU_ASSERT(bayesopt_tell(bo, id, f(d, x), NULL) == BAYESOPT_OK);
    return bo;
}

/* Least distance of two points of a batch of 20. */
static double least_distance(size_t d, size_t n, bayesopt_noise noise, function *f)
{
    double x[BATCH * MOST], least = INFINITY;
    uint64_t ids[BATCH];
    bayesopt *bo = start(d, n, noise, f);
    CU_ASSERT_FATAL(bayesopt_ask(bo, BATCH, x, ids) == BAYESOPT_OK);
    for (size_t i = 0; i < BATCH; i++)
        for (size_t k = 0; k < i; k++) {
            double square = 0;
            for (size_t j = 0; j < d; j++)
                square += (x[i * d + j] - x[k * d + j]) * (x[i * d + j] - x[k * d + j]);
            least = fmin(least, sqrt(square));
        }
    bayesopt_free(bo);
    return least;
}

static void points_lie_apart(void)
{
    static const size_t sizes[][2] = {{1, 4}, {2, 12}, {3, 6}, {3, 20}, {3, 40}, {6, 40}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        size_t d = sizes[i][0], n = sizes[i][1];
        double least = d == 1 ? 0.005 : 0.01;
        CU_ASSERT(least_distance(d, n, BAYESOPT_NOISE_DETERMINISTIC, bowl) > least);
        CU_ASSERT(least_distance(d, n, BAYESOPT_NOISE_DETERMINISTIC, waves) > least);
    }
    CU_ASSERT(least_distance(3, 20, BAYESOPT_NOISE_LEARNED, waves) > 0.01);
}

static void ten_at_a_time(void)
{
    double x[10 * MOST], f;
    uint64_t ids[10];
    bayesopt *bo = start(2, 20, BAYESOPT_NOISE_DETERMINISTIC, branin);
    for (int round = 0; round < 6; round++) {
        CU_ASSERT_FATAL(bayesopt_ask(bo, 10, x, ids) == BAYESOPT_OK);
        for (size_t i = 0; i < 10; i++)
            CU_ASSERT(bayesopt_tell(bo, ids[i], branin(2, x + 2 * i), NULL) == BAYESOPT_OK);
    }
    CU_ASSERT(bayesopt_best(bo, x, &f, NULL) == BAYESOPT_OK);
    CHECK_CLOSE(f, 0.397887357729738, 1e-5);
    bayesopt_free(bo);
}

static const struct check_case cases[] = {
    {"points of a batch lie apart", points_lie_apart},
    {"ten at a time", ten_at_a_time},
};

CHECK_MAIN("bayesopt batch", cases)
