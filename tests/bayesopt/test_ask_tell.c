/* Asking and telling: order, failures, constraints, pending points, edge cases. */
#include "check.h"
#include "search_problem.h"

#include <bayesopt/bayesopt.h>

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

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
    options.input_user_data = &calls;
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
    double lower[2] = {0, 0}, upper[2] = {1, -1}, x[2];
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

static const struct check_case cases[] = {
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
