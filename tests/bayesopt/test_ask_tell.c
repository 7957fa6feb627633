/* Asking and telling: order, failures, constraints, pending points, edge cases. */
#include "check.h"

#include <float.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include <bayesopt/bayesopt.h>

static double bowl(size_t d, const double *x)
{
    double sum = 0;
    for (size_t j = 0; j < d; j++)
        sum += (x[j] - 0.3) * (x[j] - 0.3) * (1 + (double)j);
    return sum;
}

static bayesopt *make(size_t d, const bayesopt_options *options)
{
    double lower[64], upper[64];
    bayesopt *bo = NULL;
    for (size_t j = 0; j < d; j++) {
        lower[j] = -1;
        upper[j] = 2;
    }
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(d, lower, upper, options, &bo), BAYESOPT_OK);
    return bo;
}

static void finds_a_minimum(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 12;
    options.max_evaluations = 40;
    bayesopt *bo = make(3, &options);
    double x[3], f;
    uint64_t id, expected = 1;
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK) {
        CU_ASSERT_EQUAL(id, expected++);
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(3, x), NULL), BAYESOPT_OK);
    }
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 1, x, &id), BAYESOPT_STOP_BUDGET);
    CU_ASSERT_EQUAL(bayesopt_count(bo), 40);
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, &id), BAYESOPT_OK);
    CU_ASSERT(f < 1e-5);
    CHECK_CLOSE(bowl(3, x), f, 0);
    for (size_t j = 0; j < 3; j++)
        CHECK_CLOSE(x[j], 0.3, 0.01);
    bayesopt_free(bo);
}

/* The same seed gives the same points; another seed gives others; looking at the model in between
 * changes nothing. */
static void is_reproducible(void)
{
    bayesopt_options options;
    double history[3][25][2];
    for (int run = 0; run < 3; run++) {
        bayesopt_options_init(&options);
        options.initial_n = 10;
        options.max_evaluations = 25;
        options.seed = run == 2 ? 8 : 7;
        bayesopt *bo = make(2, &options);
        double x[2];
        uint64_t id;
        for (size_t i = 0; bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK; i++) {
            memcpy(history[run][i], x, sizeof x);
            CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(2, x), NULL), BAYESOPT_OK);
            if (run == 1 && i > 2) {
                double mean, sd;
                CU_ASSERT_EQUAL(bayesopt_predict(bo, 1, x, &mean, &sd), BAYESOPT_OK);
                CHECK_CLOSE(mean, bowl(2, x), 0.05);
            }
        }
        bayesopt_free(bo);
    }
    CU_ASSERT_EQUAL(memcmp(history[0], history[1], sizeof history[0]), 0);
    CU_ASSERT_NOT_EQUAL(memcmp(history[0], history[2], sizeof history[0]), 0);
}

static void batches_are_distinct(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 8;
    options.max_evaluations = 31;
    bayesopt *bo = make(2, &options);
    double x[10];
    uint64_t ids[5];
    size_t told = 0;
    while (bayesopt_ask(bo, 5, x, ids) == BAYESOPT_OK) {
        for (size_t i = 0; i < 5 && ids[i]; i++)
            for (size_t k = 0; k < i; k++)
                CU_ASSERT(hypot(x[2 * i] - x[2 * k], x[2 * i + 1] - x[2 * k + 1]) > 1e-7);
        /* Told in another order than asked. */
        for (size_t i = 5; i-- > 0;)
            if (ids[i]) {
                CU_ASSERT_EQUAL(bayesopt_tell(bo, ids[i], bowl(2, x + 2 * i), NULL), BAYESOPT_OK);
                told++;
            }
    }
    CU_ASSERT_EQUAL(told, 31);
    CU_ASSERT_EQUAL(ids[1], 0);
    bayesopt_free(bo);
}

/* Evaluations fail in a corner of the box: the search goes on and learns to avoid it. */
static void failures_are_learnt(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 15;
    options.max_evaluations = 60;
    bayesopt *bo = make(2, &options);
    double x[2], f;
    uint64_t id;
    size_t late_failures = 0;
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK) {
        if (x[0] < 0.5 && x[1] < 0.5) {
            late_failures += id > 30 && fmax(x[0], x[1]) < 0.4;
            CU_ASSERT_EQUAL(bayesopt_tell_failed(bo, id, "folded"), BAYESOPT_OK);
        } else {
            CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(2, x), NULL), BAYESOPT_OK);
        }
    }
    /* The best place is on the edge of the failures: trials just beyond it go on, deep ones stop.
     */
    CU_ASSERT(late_failures < 5);
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    /* min((0.2)^2 + 0, 0 + 2 (0.2)^2) on the feasible side */
    CU_ASSERT(f < 0.045);
    bayesopt_point point;
    size_t failed = 0;
    for (size_t i = 0; i < bayesopt_count(bo); i++) {
        CU_ASSERT_EQUAL(bayesopt_get(bo, i, &point), BAYESOPT_OK);
        if (point.state == BAYESOPT_STATE_FAILED) {
            CU_ASSERT_STRING_EQUAL(point.note, "folded");
            CU_ASSERT(isnan(point.f));
            failed++;
        }
    }
    CU_ASSERT(failed > 0);
    CU_ASSERT_EQUAL(bayesopt_get(bo, bayesopt_count(bo), &point), BAYESOPT_ERROR_ARGUMENT);
    bayesopt_free(bo);
}

static void outcome_constraints(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    const double lower[2] = {-INFINITY, 0.95}, upper[2] = {0, 1.05};
    options.initial_n = 15;
    options.max_evaluations = 70;
    options.n_constraints = 2;
    options.constraint_lower = lower;
    options.constraint_upper = upper;
    bayesopt *bo = make(2, &options);
    double x[2], f;
    uint64_t id;
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK) {
        double c[2] = {0.6 - x[0], x[0] + x[1]};
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(2, x), c), BAYESOPT_OK);
    }
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    CU_ASSERT(x[0] >= 0.6);
    CU_ASSERT(x[0] + x[1] >= 0.95 && x[0] + x[1] <= 1.05);
    /* On x0 + x1 = s the bowl is least at x0 - 0.3 = 2 (s - 0.6)/3, and s = 0.95 is the nearest:
     * x0 = 0.5333 < 0.6, so x0 = 0.6, x1 = 0.35. */
    CHECK_CLOSE(f, 0.09 + 2 * 0.05 * 0.05, 3e-3);
    bayesopt_free(bo);
}

static void infeasible_everywhere(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 8;
    options.max_evaluations = 16;
    options.n_constraints = 1;
    bayesopt *bo = make(2, &options);
    double x[2], f, least = INFINITY;
    uint64_t id;
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK) {
        double c = 1 + bowl(2, x);
        least = fmin(least, c);
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, 0, &c), BAYESOPT_OK);
    }
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_NONE_FEASIBLE);
    CHECK_CLOSE(1 + bowl(2, x), least, 0);
    bayesopt_free(bo);
}

/* A slab three hundredths thick, as a displacement to be kept, and a linear row. */
static int slab(void *data, size_t d, const double *x, double *value)
{
    double sum = 0;
    for (size_t j = 0; j < d; j++)
        sum += x[j] + 0.1 * x[j] * x[j];
    ++*(size_t *)data;
    value[0] = sum - 2.03;
    value[1] = 2.00 - sum;
    return 0;
}

static void input_constraints(void)
{
    bayesopt_options options;
    const double a[4] = {1, -1, 0, 0}, b[1] = {0};
    size_t calls = 0;
    bayesopt_options_init(&options);
    options.initial_n = 20;
    options.max_evaluations = 50;
    options.n_input_constraints = 2;
    options.input_constraint = slab;
    options.input_data = &calls;
    options.n_linear = 1;
    options.linear_a = a;
    options.linear_b = b;
    bayesopt *bo = make(4, &options);
    double x[4], f, value[2];
    uint64_t id;
    bayesopt_status status;
    while ((status = bayesopt_ask(bo, 1, x, &id)) == BAYESOPT_OK) {
        size_t unused = 0;
        slab(&unused, 4, x, value);
        CU_ASSERT(value[0] <= 0 && value[1] <= 0);
        CU_ASSERT(x[0] <= x[1] + 1e-12);
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(4, x), NULL), BAYESOPT_OK);
    }
    CU_ASSERT_EQUAL(status, BAYESOPT_STOP_BUDGET);
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    /* Lagrange: 2 w_j (x_j - 0.3) = mu (1 + 0.2 x_j); solved below to four digits by bisection. */
    double low = 0, high = 10;
    for (int i = 0; i < 100; i++) {
        double mu = (low + high) / 2, sum = 0, first = 0, second = 0;
        for (size_t j = 0; j < 4; j++) {
            double w = 1 + (double)j, at = (0.6 * w + mu) / (2 * w - 0.2 * mu);
            if (j == 0)
                first = at;
            else if (j == 1)
                second = at;
            sum += at + 0.1 * at * at;
        }
        /* x0 <= x1 is active: both share the weight 3. */
        double shared = (0.6 * 3 + 2 * mu) / (6 - 0.4 * mu);
        sum += 2 * (shared + 0.1 * shared * shared) - first - 0.1 * first * first - second -
               0.1 * second * second;
        *(sum < 2 ? &low : &high) = mu;
    }
    double mu = low, best = 0, shared = (0.6 * 3 + 2 * mu) / (6 - 0.4 * mu);
    best = 3 * (shared - 0.3) * (shared - 0.3);
    for (size_t j = 2; j < 4; j++) {
        double w = 1 + (double)j, at = (0.6 * w + mu) / (2 * w - 0.2 * mu);
        best += w * (at - 0.3) * (at - 0.3);
    }
    CHECK_CLOSE(f, best, 0.01 * best);
    CU_ASSERT(f >= best - 1e-9);
    bayesopt_free(bo);
}

static int never(void *data, size_t d, const double *x, double *value)
{
    (void)data;
    (void)d;
    value[0] = 1 + x[0] * x[0];
    return 0;
}

static void impossible_input_constraints(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.n_input_constraints = 1;
    options.input_constraint = never;
    bayesopt *bo = make(2, &options);
    double x[2];
    uint64_t id;
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 1, x, &id), BAYESOPT_ERROR_INFEASIBLE);
    CU_ASSERT_EQUAL(bayesopt_count(bo), 0);
    bayesopt_free(bo);
}

static void values_that_are_not_numbers(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 6;
    options.max_evaluations = 20;
    bayesopt *bo = make(1, &options);
    double x[1], f;
    uint64_t id;
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_ERROR_ARGUMENT);
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK) {
        f = id % 3 == 0 ? NAN : id % 3 == 1 ? INFINITY : bowl(1, x);
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, f, NULL), BAYESOPT_OK);
    }
    bayesopt_point point;
    CU_ASSERT_EQUAL(bayesopt_get(bo, 0, &point), BAYESOPT_OK);
    CU_ASSERT_EQUAL(point.state, BAYESOPT_STATE_FAILED);
    CU_ASSERT_STRING_EQUAL(point.note, "the objective is inf");
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    CU_ASSERT(isfinite(f));
    bayesopt_free(bo);
}

/* All evaluations fail: points keep coming until the budget is spent. */
static void nothing_ever_works(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 4;
    options.max_evaluations = 10;
    bayesopt *bo = make(3, &options);
    double x[3];
    uint64_t id;
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK)
        CU_ASSERT_EQUAL(bayesopt_tell_failed(bo, id, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_count(bo), 10);
    bayesopt_free(bo);
}

static double scaled_run(double factor, double shift, size_t d, double *x)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 2 * d + 2;
    options.max_evaluations = 2 * d + 22;
    bayesopt *bo = make(d, &options);
    uint64_t id;
    double f = NAN;
    bayesopt_status status;
    while ((status = bayesopt_ask(bo, 1, x, &id)) == BAYESOPT_OK)
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, shift + factor * bowl(d, x), NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(status, BAYESOPT_STOP_BUDGET);
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    bayesopt_free(bo);
    return f;
}

static void ranges_of_values(void)
{
    double x[64];
    CU_ASSERT(scaled_run(1e-300, 0, 2, x) < 1e-302);
    CU_ASSERT(scaled_run(1e300, 0, 2, x) < 1e298);
    CU_ASSERT(scaled_run(1, 1e9, 2, x) < 1e9 + 0.1);
    CHECK_CLOSE(scaled_run(0, 3, 2, x), 3, 0);
    CU_ASSERT(scaled_run(1, 0, 1, x) < 1e-6);
    CU_ASSERT(isfinite(scaled_run(1, 0, 50, x)));
}

static void repeated_points(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 4;
    options.max_evaluations = 40;
    bayesopt *bo = make(2, &options);
    const double at[2] = {0.5, 0.5}, outside[2] = {0.5, 2.5};
    for (int i = 0; i < 10; i++)
        CU_ASSERT_EQUAL(bayesopt_tell_point(bo, at, 0.12 + 1e-3 * i, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_tell_point(bo, outside, 1, NULL), BAYESOPT_ERROR_ARGUMENT);
    double x[2], f;
    uint64_t id;
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK)
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(2, x), NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_count(bo), 40);
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    CU_ASSERT(f < 1e-3);
    bayesopt_free(bo);
}

static void misuse_is_refused(void)
{
    bayesopt *bo;
    bayesopt_options options;
    double lower[2] = {0, 0}, upper[2] = {1, 0}, x[2];
    uint64_t id;
    CU_ASSERT_EQUAL(bayesopt_create(2, lower, upper, NULL, &bo), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "variable 1"));
    upper[1] = 1;
    bayesopt_options_init(&options);
    options.n_constraints = 1;
    options.constraint_lower = upper;
    CU_ASSERT_EQUAL(bayesopt_create(2, lower, upper, &options, &bo), BAYESOPT_ERROR_ARGUMENT);
    bayesopt_options_init(&options);
    options.n_input_constraints = 1;
    CU_ASSERT_EQUAL(bayesopt_create(2, lower, upper, &options, &bo), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(2, lower, upper, NULL, &bo), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 0, x, &id), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_tell(bo, 1, 0, NULL), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 1, x, &id), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_tell(bo, id, 0, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_tell(bo, id, 0, NULL), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "already"));
    bayesopt_free(bo);
    bayesopt_free(NULL);
}

/* Fewer evaluations than the initial design has points. */
static void small_budget(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 20;
    options.max_evaluations = 5;
    bayesopt *bo = make(2, &options);
    double x[2];
    uint64_t id;
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK)
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(2, x), NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_count(bo), 5);
    CU_ASSERT_EQUAL(bayesopt_set_budget(bo, 7), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 1, x, &id), BAYESOPT_OK);
    bayesopt_free(bo);
}

static int callback(void *data, size_t d, const double *x, double *f, double *constraints)
{
    (void)data;
    (void)constraints;
    *f = bowl(d, x);
    return x[0] > 1.5;
}

static int stop_at_ten(void *data, const bayesopt *bo)
{
    (void)data;
    return bayesopt_count(bo) == 10;
}

static void loop_with_callback(void)
{
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 8;
    options.max_evaluations = 60;
    options.stop_no_improvement = 6;
    bayesopt *bo = make(1, &options);
    CU_ASSERT_EQUAL(bayesopt_minimise(bo, callback, NULL, stop_at_ten, NULL),
                    BAYESOPT_ERROR_CANCELLED);
    CU_ASSERT_EQUAL(bayesopt_count(bo), 10);
    CU_ASSERT_EQUAL(bayesopt_minimise(bo, callback, NULL, NULL, NULL),
                    BAYESOPT_STOP_NO_IMPROVEMENT);
    CU_ASSERT(bayesopt_count(bo) < 60);
    bayesopt_free(bo);
}

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

static const struct check_case cases[] = {
    {"models and acquisitions", models_and_acquisitions},
    {"models that are refused", models_that_are_refused},
    {"smooth functions are polished", smooth_functions_are_polished},
    {"forrester pair", forrester_pair},
    {"widest range", widest_range},
    {"gradients help", gradients_help},
    {"two levels", two_levels},
    {"small expected improvement", small_expected_improvement},
    {"noisy objective", noisy_objective},
    {"finds a minimum", finds_a_minimum},
    {"is reproducible", is_reproducible},
    {"batches are distinct", batches_are_distinct},
    {"failures are learnt", failures_are_learnt},
    {"outcome constraints", outcome_constraints},
    {"infeasible everywhere", infeasible_everywhere},
    {"input constraints", input_constraints},
    {"impossible input constraints", impossible_input_constraints},
    {"values that are not numbers", values_that_are_not_numbers},
    {"nothing ever works", nothing_ever_works},
    {"ranges of values", ranges_of_values},
    {"repeated points", repeated_points},
    {"misuse is refused", misuse_is_refused},
    {"small budget", small_budget},
    {"loop with callback", loop_with_callback},
};

CHECK_MAIN("bayesopt ask and tell", cases)
