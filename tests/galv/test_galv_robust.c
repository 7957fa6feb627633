/* Unusual and wrong input. */
#include "check.h"
#include "fixture.h"

#include <string.h>

static double grid[3 * POINTS];

static galv_status build(const galv_shape *shape, galv_sampling sampling,
                         const galv_options *options, galv_model **model)
{
    *model = NULL;
    fixture_grid(grid);
    return galv_build(shape, POINTS, grid, sampling, options, model);
}

static void test_one_sample(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_model *model;
    galv_options options;
    galv_options_init(&options);
    for (int method = GALV_METHOD_AUTO; method <= GALV_METHOD_RANDOMISED; method++) {
        options.method = (galv_method)method;
        CU_ASSERT_EQUAL_FATAL(build(shape, galv_uniform(1, 1), &options, &model), GALV_OK);
        CU_ASSERT_EQUAL(galv_model_modes(model), 1);
        CU_ASSERT_EQUAL(galv_model_spectrum(model), 1);
        CHECK_RELATIVE(galv_model_eigenvalues(model)[0], galv_model_trace(model), 1e-13);
        CU_ASSERT_TRUE(isnan(galv_model_confidence(model).retained_error));
        double x[FUNCTIONS], d[3 * POINTS], u[FUNCTIONS], back[3 * POINTS];
        galv_uniform_sample(1, 0, FUNCTIONS, galv_shape_lower(shape), galv_shape_upper(shape), x);
        galv_shape_displace(shape, POINTS, grid, x, d);
        galv_project(model, d, u);
        galv_reconstruct(model, u, back);
        for (size_t i = 0; i < (size_t)3 * POINTS; i++)
            CHECK_CLOSE(back[i], d[i], 1e-15);
        CU_ASSERT_EQUAL(galv_backmap(model, shape, u, x, NULL), GALV_OK);
        galv_model_free(model);
    }
    options.method = GALV_METHOD_AUTO;
    options.centre = true;
    CU_ASSERT_EQUAL(build(shape, galv_uniform(1, 1), &options, &model), GALV_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NULL(model);
    galv_shape_free(shape);
}

/* Fewer samples than coordinates, and data of any rank up to N: every method finds that rank, the
 * spectrum of a dense SVD and all of the variance. */
static void test_few_samples_of_any_rank(void)
{
    enum { COUNT = 40, LENGTH = 300 };
    static double rows[COUNT * LENGTH];
    const size_t ranks[] = {1, 7, COUNT - 1, COUNT};
    const double lower = -1, upper = 1;
    galv_options options;
    galv_options_init(&options);
    options.variance = 1;
    for (int i = 0; i < 4; i++) {
        memset(rows, 0, sizeof rows);
        for (size_t k = 0; k < ranks[i]; k++)
            for (size_t r = 0; r < COUNT; r++)
                for (size_t c = 0; c < LENGTH; c++) {
                    double left, right;
                    galv_uniform_sample(5, k * COUNT + r, 1, &lower, &upper, &left);
                    galv_uniform_sample(6, k * LENGTH + c, 1, &lower, &upper, &right);
                    rows[r * LENGTH + c] += left * right;
                }
        double *values = fixture_spectrum(COUNT, LENGTH, rows, false, NULL, 0, NULL);
        galv_data data = {.count = COUNT, .coordinates = LENGTH, .values = rows};
        for (int method = GALV_METHOD_AUTO; method <= GALV_METHOD_RANDOMISED; method++) {
            galv_model *model = NULL;
            options.method = (galv_method)method;
            CU_ASSERT_EQUAL_FATAL(galv_build_data(&data, &options, &model), GALV_OK);
            CU_ASSERT_EQUAL(galv_model_method(model), method ? options.method : GALV_METHOD_GRAM);
            CU_ASSERT_EQUAL_FATAL(galv_model_spectrum(model), ranks[i]);
            CU_ASSERT_EQUAL(galv_model_modes(model), ranks[i]);
            CHECK_CLOSE(galv_model_retained(model), 1, 1e-12);
            for (size_t k = 0; k < ranks[i]; k++)
                CHECK_CLOSE(galv_model_eigenvalues(model)[k], values[k], 1e-11 * values[0]);
            galv_model_free(model);
        }
        free(values);
    }
}

/* The same five samples over and over: rank 5, all of the variance in 5 modes. */
static void test_duplicates(void)
{
    enum { COUNT = 60, DIFFERENT = 5 };
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    double *x = fixture_samples(shape, COUNT, 3);
    for (size_t r = DIFFERENT; r < COUNT; r++)
        memcpy(x + r * FUNCTIONS, x + (r % DIFFERENT) * FUNCTIONS, FUNCTIONS * sizeof *x);
    galv_model *model;
    galv_options options;
    galv_options_init(&options);
    options.variance = 1;
    for (int method = GALV_METHOD_AUTO; method <= GALV_METHOD_RANDOMISED; method++) {
        options.method = (galv_method)method;
        CU_ASSERT_EQUAL_FATAL(build(shape, galv_samples(COUNT, x), &options, &model), GALV_OK);
        CU_ASSERT_EQUAL(galv_model_modes(model), DIFFERENT);
        CU_ASSERT_EQUAL(galv_model_spectrum(model), DIFFERENT);
        CHECK_CLOSE(galv_model_retained(model), 1, 1e-12);
        galv_model_free(model);
    }
    options.centre = true;
    options.method = GALV_METHOD_AUTO;
    CU_ASSERT_EQUAL_FATAL(build(shape, galv_samples(COUNT, x), &options, &model), GALV_OK);
    CU_ASSERT_EQUAL(galv_model_modes(model), DIFFERENT - 1);
    galv_model_free(model);
    for (size_t r = 1; r < COUNT; r++)
        memcpy(x + r * FUNCTIONS, x, FUNCTIONS * sizeof *x);
    CU_ASSERT_EQUAL(build(shape, galv_samples(COUNT, x), &options, &model), GALV_ERROR_GEOMETRY);
    free(x);
    galv_shape_free(shape);
}

/* d = (1, x p, 0): constant along x, varying along y, nothing along z. */
static int constant(void *user_data, size_t npoints, const double *xyz, const double *x, double *d)
{
    (void)user_data;
    (void)xyz;
    for (size_t p = 0; p < npoints; p++) {
        d[3 * p] = 1;
        d[3 * p + 1] = x[0] * (double)(p + 1);
        d[3 * p + 2] = 0;
    }
    return 0;
}

static void test_constant_coordinates(void)
{
    double lower = -1, upper = 1;
    galv_shape *shape = NULL;
    CU_ASSERT_EQUAL_FATAL(galv_shape_callback(1, &lower, &upper, constant, NULL, true, &shape),
                          GALV_OK);
    galv_options options;
    galv_options_init(&options);
    options.variance = 1;
    galv_model *model;
    CU_ASSERT_EQUAL_FATAL(build(shape, galv_uniform(500, 1), &options, &model), GALV_OK);
    CU_ASSERT_EQUAL(galv_model_modes(model), 2);
    CU_ASSERT_EQUAL(galv_model_active(model), 2 * POINTS);
    galv_model_free(model);
    options.centre = true;
    CU_ASSERT_EQUAL_FATAL(build(shape, galv_uniform(500, 1), &options, &model), GALV_OK);
    CU_ASSERT_EQUAL(galv_model_modes(model), 1);
    CHECK_CLOSE(galv_model_mean(model)[3], 1, 1e-15);
    double x, u = 0.9 * galv_model_upper(model)[0], residual;
    CU_ASSERT_EQUAL(galv_backmap(model, shape, &u, &x, &residual), GALV_OK);
    CHECK_CLOSE(residual, 0, 1e-9);
    galv_model_free(model);
    galv_shape_free(shape);
}

static int sometimes_nan(void *user_data, size_t npoints, const double *xyz, const double *x,
                         double *d)
{
    constant(NULL, npoints, xyz, x, d);
    if (x[0] == 1234)
        d[7] = *(const double *)user_data;
    return 0;
}

static void test_bad_sample_is_named(void)
{
    const double bad_values[] = {NAN, INFINITY, 1e200};
    double lower = -1, upper = 1, bad, x[1000];
    galv_shape *shape = NULL;
    CU_ASSERT_EQUAL_FATAL(galv_shape_callback(1, &lower, &upper, sometimes_nan, &bad, true, &shape),
                          GALV_OK);
    for (int r = 0; r < 1000; r++)
        x[r] = r == 777 || r == 801 ? 1234 : r;
    galv_options options;
    galv_options_init(&options);
    galv_model *model;
    for (int method = GALV_METHOD_COVARIANCE; method <= GALV_METHOD_RANDOMISED; method++)
        for (int b = 0; b < 3; b++) {
            bad = bad_values[b];
            options.method = (galv_method)method;
            CU_ASSERT_EQUAL(build(shape, galv_samples(1000, x), &options, &model),
                            GALV_ERROR_NUMERIC);
            CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "sample 777"));
        }
    double d[3 * POINTS];
    bad = NAN;
    CU_ASSERT_EQUAL(galv_shape_displace(shape, POINTS, grid, &x[777], d), GALV_ERROR_NUMERIC);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "point 2"));
    x[3] = NAN;
    CU_ASSERT_EQUAL(build(shape, galv_samples(1000, x), NULL, &model), GALV_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "sample 3"));
    galv_shape_free(shape);
}

static int refuse(void *user_data, size_t npoints, const double *xyz, const double *x, double *d)
{
    constant(user_data, npoints, xyz, x, d);
    return x[0] > 0.99 ? 17 : 0;
}

static void test_callback_refuses(void)
{
    double lower = -1, upper = 1;
    galv_shape *shape = NULL;
    galv_model *model;
    CU_ASSERT_EQUAL(galv_shape_callback(1, &lower, &upper, NULL, NULL, false, &shape),
                    GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(galv_shape_callback(1, &lower, &upper, refuse, NULL, true, &shape),
                          GALV_OK);
    CU_ASSERT_EQUAL(build(shape, galv_uniform(5000, 1), NULL, &model), GALV_ERROR_NUMERIC);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "sample "));
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "17"));
    galv_shape_free(shape);
}

static int cancel(void *user_data, double fraction)
{
    double *last = user_data;
    CU_ASSERT_TRUE(fraction >= *last && fraction <= 1);
    *last = fraction;
    return fraction > 0.6;
}

static void test_progress_cancels(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_options options;
    galv_options_init(&options);
    double last = 0;
    options.progress = cancel;
    options.progress_user_data = &last;
    galv_model *model;
    CU_ASSERT_EQUAL(build(shape, galv_uniform(3000, 1), &options, &model), GALV_ERROR_CANCELLED);
    CU_ASSERT_TRUE(last > 0.6);
    galv_shape_free(shape);
}

/* What a caller was told: how often, the last fraction, the largest step, and where to cancel. */
typedef struct told {
    int calls;
    double last, step, cancel;
} told;

static int listen(void *user_data, double fraction)
{
    told *t = user_data;
    CU_ASSERT_TRUE(fraction >= t->last && fraction <= 1);
    t->step = fmax(t->step, fraction - t->last);
    t->last = fraction;
    t->calls++;
    return fraction > t->cancel;
}

/* Samples without any structure: all pairs are kept, and the groups of the confidence are of an
 * order that takes long. */
static int noise(void *user_data, size_t first, size_t count, double *rows)
{
    size_t length = *(size_t *)user_data;
    for (size_t i = 0; i < count * length; i++) {
        uint64_t x = (first * length + i + 1) * UINT64_C(0x9e3779b97f4a7c15);
        x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
        x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
        rows[i] = (double)(x >> 11) * 0x1p-53 - 0.5;
    }
    return 0;
}

static galv_status build_noise(size_t count, size_t length, galv_method method, told *t)
{
    galv_data data = {.count = count, .coordinates = length, .rows = noise, .user_data = &length};
    galv_options options;
    galv_options_init(&options);
    options.variance = method == GALV_METHOD_RANDOMISED ? 0.2 : 0.9999;
    options.method = method;
    options.workspace = method == GALV_METHOD_RANDOMISED ? 1 << 19 : 9 << 19; /* for small blocks */
    options.progress = listen;
    options.progress_user_data = t;
    galv_model *model = NULL;
    galv_status status = galv_build_data(&data, &options, &model);
    galv_model_free(model);
    return status;
}

/* 2 % of the work at most between two calls, all the way. */
static void test_progress_steps(void)
{
    told all = {.cancel = 2}, late = {.cancel = 0.9}, passes = {.cancel = 2};
    CU_ASSERT_EQUAL(build_noise(3700, 520, GALV_METHOD_COVARIANCE, &all), GALV_OK);
    CU_ASSERT_TRUE(all.last == 1 && all.step <= 0.02);
    CU_ASSERT_EQUAL(build_noise(520, 1000, GALV_METHOD_GRAM, &late), GALV_ERROR_CANCELLED);
    CU_ASSERT_TRUE(late.last > 0.9 && late.last < 0.92 && late.step <= 0.02);
    CU_ASSERT_EQUAL(build_noise(8000, 100, GALV_METHOD_RANDOMISED, &passes), GALV_OK);
    CU_ASSERT_TRUE(passes.last == 1 && passes.step <= 0.02);
}

static void test_progress_extends(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_options options;
    galv_options_init(&options);
    galv_model *model, *more = NULL;
    CU_ASSERT_EQUAL_FATAL(build(shape, galv_uniform(300, 1), &options, &model), GALV_OK);
    galv_sampling sampling = galv_uniform(3000, 1);
    sampling.first = 300;
    told all = {.cancel = 2}, early = {.cancel = 0.3};
    options.workspace = (size_t)2 << 20;
    options.progress = listen;
    options.progress_user_data = &all;
    CU_ASSERT_EQUAL(galv_extend(model, shape, sampling, &options, &more), GALV_OK);
    CU_ASSERT_TRUE(all.last == 1 && all.step <= 0.02);
    galv_model_free(more);
    options.progress_user_data = &early;
    CU_ASSERT_EQUAL(galv_extend(model, shape, sampling, &options, &more), GALV_ERROR_CANCELLED);
    CU_ASSERT_TRUE(early.last > 0.3 && early.last < 0.32);
    galv_model_free(model);
    galv_shape_free(shape);
}

static void test_wrong_arguments(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03), *other = NULL;
    galv_model *model;
    galv_options options;
    galv_options_init(&options);
    options.variance = 1.5;
    CU_ASSERT_EQUAL(build(shape, galv_uniform(10, 1), &options, &model), GALV_ERROR_ARGUMENT);
    options.variance = NAN;
    CU_ASSERT_EQUAL(build(shape, galv_uniform(10, 1), &options, &model), GALV_ERROR_ARGUMENT);
    galv_options_init(&options);
    double weights[POINTS];
    for (int p = 0; p < POINTS; p++)
        weights[p] = p == 5 ? -1 : 1;
    options.weights = weights;
    CU_ASSERT_EQUAL(build(shape, galv_uniform(10, 1), &options, &model), GALV_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "point 5"));
    CU_ASSERT_EQUAL(build(shape, galv_uniform(0, 1), NULL, &model), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_build(NULL, POINTS, grid, galv_uniform(3, 1), NULL, &model),
                    GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_build(shape, 0, grid, galv_uniform(3, 1), NULL, &model),
                    GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(build(shape, galv_uniform(30, 1), NULL, &model), GALV_OK);
    double lower = 0, upper = 1, u[FUNCTIONS] = {0}, x[FUNCTIONS], d[3 * POINTS];
    CU_ASSERT_EQUAL_FATAL(galv_shape_callback(1, &lower, &upper, constant, NULL, true, &other),
                          GALV_OK);
    CU_ASSERT_EQUAL(galv_backmap(model, other, u, x, NULL), GALV_ERROR_ARGUMENT);
    u[0] = NAN;
    CU_ASSERT_EQUAL(galv_backmap(model, shape, u, x, NULL), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_reconstruct(model, u, d), GALV_ERROR_ARGUMENT);
    galv_model_free(model);
    galv_model_free(NULL);
    galv_shape_free(other);
    galv_shape_free(shape);
}

/* Parameters that do nothing: bounds that coincide at 0. */
static void test_nothing_moves(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0);
    galv_model *model;
    CU_ASSERT_EQUAL(build(shape, galv_uniform(50, 1), NULL, &model), GALV_ERROR_GEOMETRY);
    galv_shape_free(shape);
}

/* Sample r is a function of the seed and r alone, uniform within its bounds. */
static void test_uniform_stream(void)
{
    enum { COUNT = 20000, N = 3 };
    const double lower[N] = {0, -2, 5}, upper[N] = {1, 2, 5};
    double first[N], again[N], longer[N + 2], mean = 0, square = 0, product = 0;
    const double lower5[N + 2] = {0, -2, 5, 0, 0}, upper5[N + 2] = {1, 2, 5, 1, 1};
    galv_uniform_sample(9, 4, N, lower, upper, first);
    galv_uniform_sample(9, 4, N, lower, upper, again);
    galv_uniform_sample(9, 4, N + 2, lower5, upper5, longer);
    CU_ASSERT_EQUAL(memcmp(first, again, sizeof first), 0);
    CU_ASSERT_EQUAL(memcmp(first, longer, sizeof first), 0);
    galv_uniform_sample(8, 5, N, lower, upper, again);
    CU_ASSERT_NOT_EQUAL(first[0], again[0]);
    for (size_t r = 0; r < COUNT; r++) {
        galv_uniform_sample(123, r, N, lower, upper, first);
        CU_ASSERT_TRUE(first[0] >= 0 && first[0] < 1 && fabs(first[1]) <= 2 && first[2] == 5);
        mean += first[0] / COUNT;
        square += first[0] * first[0] / COUNT;
        product += (first[0] - 0.5) * first[1] / COUNT;
    }
    /* Five standard errors. */
    CHECK_CLOSE(mean, 0.5, 5 * sqrt(1 / 12.0 / COUNT));
    CHECK_CLOSE(square, 1 / 3.0, 5 * sqrt(4 / 45.0 / COUNT));
    CHECK_CLOSE(product, 0, 5 * sqrt(1 / 12.0 * 4 / 3 / COUNT));
}

static const struct check_case cases[] = {
    {"one sample", test_one_sample},
    {"fewer samples than coordinates, any rank", test_few_samples_of_any_rank},
    {"duplicate samples", test_duplicates},
    {"constant coordinates", test_constant_coordinates},
    {"the sample that is not finite is named", test_bad_sample_is_named},
    {"a callback that refuses", test_callback_refuses},
    {"progress and cancelling", test_progress_cancels},
    {"steps of the progress", test_progress_steps},
    {"progress of an extension", test_progress_extends},
    {"wrong arguments", test_wrong_arguments},
    {"nothing moves", test_nothing_moves},
    {"the uniform stream", test_uniform_stream},
};

CHECK_MAIN("galv robustness", cases)
