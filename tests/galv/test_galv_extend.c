/* Models that grow, that are written out, and that come from plain data; where latent points lie.
 */
#include "check.h"
#include "fixture.h"

#include <string.h>

static double grid[3 * POINTS];

static galv_model *build(const galv_shape *shape, galv_sampling sampling,
                         const galv_options *options)
{
    galv_model *model = NULL;
    fixture_grid(grid);
    CU_ASSERT_EQUAL_FATAL(galv_build(shape, POINTS, grid, sampling, options, &model), GALV_OK);
    return model;
}

/* A model of N samples extended by M against one of N + M. */
static void compare_extension(bool centre, bool weighted, galv_combination combination)
{
    enum { OLD = 300, ADDED = 250 };
    double weights[POINTS];
    fixture_grid(grid);
    galv_grid_weights(SECTIONS, GIRTH, grid, weights);
    galv_shape *shape = fixture_shape(combination, 0.03);
    galv_options options;
    galv_options_init(&options);
    options.centre = centre;
    options.weights = weighted ? weights : NULL;
    galv_model *old = build(shape, galv_uniform(OLD, 7), &options);
    galv_model *whole = build(shape, galv_uniform(OLD + ADDED, 7), &options), *grown = NULL;
    galv_sampling more = galv_uniform(ADDED, 7);
    more.first = OLD;
    CU_ASSERT_EQUAL_FATAL(galv_extend(old, shape, more, &options, &grown), GALV_OK);
    CU_ASSERT_EQUAL(galv_model_samples(grown), OLD + ADDED);
    CU_ASSERT_EQUAL(galv_model_modes(grown), galv_model_modes(whole));
    CHECK_RELATIVE(galv_model_trace(grown), galv_model_trace(whole), 1e-12);
    double bound = galv_model_truncation(grown), scale = galv_model_eigenvalues(whole)[0];
    size_t m = galv_model_modes(grown);
    for (size_t k = 0; k < m; k++) {
        double lost = galv_model_eigenvalues(whole)[k] - galv_model_eigenvalues(grown)[k];
        CU_ASSERT_TRUE(lost >= -1e-13 * scale && lost <= bound + 1e-13 * scale);
    }
    if (combination == GALV_COMBINATION_LINEAR) /* nothing beyond the pairs kept: exact */
        CHECK_CLOSE(bound, 0, 1e-13 * scale);
    else
        CU_ASSERT_TRUE(bound < galv_model_eigenvalues(whole)[m - 1]);
    for (size_t i = 0; i < (size_t)3 * POINTS; i++)
        CHECK_CLOSE(galv_model_mean(grown)[i], galv_model_mean(whole)[i], 1e-15);
    /* New samples are projected as galv_project() does, old ones carried over to their modes'
     * accuracy. */
    for (size_t r = 0; r < OLD + ADDED; r += 50) {
        double x[FUNCTIONS], d[3 * POINTS], u[FUNCTIONS];
        galv_uniform_sample(7, r, FUNCTIONS, galv_shape_lower(shape), galv_shape_upper(shape), x);
        galv_shape_displace(shape, POINTS, grid, x, d);
        galv_project(grown, d, u);
        for (size_t k = 0; k < m; k++)
            CHECK_CLOSE(galv_model_latent(grown)[r * m + k], u[k],
                        r < OLD ? 0.3 * sqrt(scale) : 1e-12);
    }
    double residual, x[FUNCTIONS], u[FUNCTIONS] = {0};
    u[0] = 0.5 * galv_model_upper(grown)[0];
    CU_ASSERT_EQUAL(galv_backmap(grown, shape, u, x, &residual), GALV_OK);
    CU_ASSERT_TRUE(residual < 0.01);
    CU_ASSERT_TRUE(galv_model_confidence(grown).angle > 0);
    galv_model_free(old);
    galv_model_free(whole);
    galv_model_free(grown);
    galv_shape_free(shape);
}

static void test_extension_equals_rebuilding(void)
{
    compare_extension(false, false, GALV_COMBINATION_LINEAR);
    compare_extension(true, true, GALV_COMBINATION_LINEAR);
    compare_extension(false, false, GALV_COMBINATION_RECURSIVE);
    compare_extension(true, false, GALV_COMBINATION_RECURSIVE);
    compare_extension(false, true, GALV_COMBINATION_RECURSIVE);
}

static void test_extension_refuses(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_LINEAR, 0.03), *other = NULL;
    galv_model *model = build(shape, galv_uniform(50, 1), NULL), *grown = NULL;
    galv_sine function;
    double lower = 0, upper = 1;
    function = (galv_sine){.order = {1, 1, 1}, .direction = 1};
    galv_shape_sine(1, &function, &fixture_box, &lower, &upper, GALV_COMBINATION_LINEAR, &other);
    CU_ASSERT_EQUAL(galv_extend(model, other, galv_uniform(5, 1), NULL, &grown),
                    GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_extend(model, shape, galv_uniform(0, 1), NULL, &grown),
                    GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_extend(NULL, shape, galv_uniform(5, 1), NULL, &grown),
                    GALV_ERROR_ARGUMENT);
    galv_model_free(model);
    galv_shape_free(other);
    galv_shape_free(shape);
}

static void test_view_and_restore(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_options options;
    galv_options_init(&options);
    options.centre = true;
    galv_model *model = build(shape, galv_uniform(120, 1), &options), *copy = NULL;
    galv_model_data data = galv_model_view(model);
    CU_ASSERT_EQUAL_FATAL(galv_model_restore(&data, &copy), GALV_OK);
    galv_model_data again = galv_model_view(copy);
    CU_ASSERT_EQUAL(again.samples, data.samples);
    CU_ASSERT_EQUAL(again.trace, data.trace);
    CU_ASSERT_EQUAL(
        memcmp(again.vectors, data.vectors, data.kept * data.coordinates * sizeof(double)), 0);
    double u[FUNCTIONS], x[FUNCTIONS], y[FUNCTIONS];
    for (size_t k = 0; k < data.modes; k++)
        u[k] = 0.3 * data.upper[k];
    CU_ASSERT_EQUAL(galv_backmap(model, shape, u, x, NULL), GALV_OK);
    CU_ASSERT_EQUAL(galv_backmap(copy, shape, u, y, NULL), GALV_OK);
    CU_ASSERT_EQUAL(memcmp(x, y, sizeof x), 0);
    galv_model_free(copy);

    galv_model_data bad = data;
    bad.modes = data.kept + 1;
    CU_ASSERT_EQUAL(galv_model_restore(&bad, &copy), GALV_ERROR_ARGUMENT);
    bad = data;
    bad.vectors = NULL;
    CU_ASSERT_EQUAL(galv_model_restore(&bad, &copy), GALV_ERROR_ARGUMENT);
    bad = data;
    double *values = malloc(data.spectrum * sizeof *values);
    memcpy(values, data.eigenvalues, data.spectrum * sizeof *values);
    values[3] = NAN;
    bad.eigenvalues = values;
    CU_ASSERT_EQUAL(galv_model_restore(&bad, &copy), GALV_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "eigenvalues: entry 3"));
    values[3] = 2 * values[0];
    CU_ASSERT_EQUAL(galv_model_restore(&bad, &copy), GALV_ERROR_ARGUMENT);
    free(values);
    galv_model_free(model);
    galv_shape_free(shape);
}

struct matrix {
    const double *rows;
    size_t length, refuse;
};

static int matrix_rows(void *user_data, size_t first, size_t count, double *rows)
{
    const struct matrix *m = user_data;
    memcpy(rows, m->rows + first * m->length, count * m->length * sizeof *rows);
    return first + count > m->refuse ? 5 : 0;
}

static void test_plain_data(void)
{
    enum { COUNT = 90, LENGTH = 40 };
    static double rows[COUNT * LENGTH], weights[LENGTH];
    for (size_t r = 0; r < COUNT; r++)
        for (size_t i = 0; i < LENGTH; i++)
            rows[r * LENGTH + i] = sin((double)(r * (i + 1))) / (double)(1 + i * i);
    for (size_t i = 0; i < LENGTH; i++)
        weights[i] = 1 + (double)i;
    struct matrix matrix = {rows, LENGTH, COUNT};
    galv_data data = {.count = COUNT,
                      .coordinates = LENGTH,
                      .rows = matrix_rows,
                      .user_data = &matrix,
                      .weights = weights};
    double *values = fixture_spectrum(COUNT, LENGTH, rows, true, weights, 0, NULL);
    galv_options options;
    galv_options_init(&options);
    options.centre = true;
    galv_model *model = NULL;
    CU_ASSERT_EQUAL_FATAL(galv_build_data(&data, &options, &model), GALV_OK);
    for (size_t k = 0; k < LENGTH; k++)
        CHECK_CLOSE(galv_model_eigenvalues(model)[k], values[k], 1e-14 * values[0]);
    /* The array itself gives the same bits as its rows one by one. */
    galv_data array = {.count = COUNT, .coordinates = LENGTH, .weights = weights, .values = rows};
    galv_model *same = NULL;
    CU_ASSERT_EQUAL_FATAL(galv_build_data(&array, &options, &same), GALV_OK);
    CU_ASSERT_EQUAL(memcmp(galv_model_eigenvalues(model), galv_model_eigenvalues(same),
                           LENGTH * sizeof(double)),
                    0);
    galv_model_free(same);
    double x, u[LENGTH] = {0};
    galv_shape *shape = fixture_shape(GALV_COMBINATION_LINEAR, 1);
    CU_ASSERT_EQUAL(galv_backmap(model, shape, u, &x, NULL), GALV_ERROR_ARGUMENT);
    galv_shape_free(shape);
    galv_model_free(model);
    matrix.refuse = 10;
    CU_ASSERT_EQUAL(galv_build_data(&data, &options, &model), GALV_ERROR_NUMERIC);
    data.count = 0;
    CU_ASSERT_EQUAL(galv_build_data(&data, &options, &model), GALV_ERROR_ARGUMENT);
    free(values);
}

/* Shares of the samples, counted. */
static void test_bounds_cover_their_share(void)
{
    enum { COUNT = 1000 };
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_model *model = build(shape, galv_uniform(COUNT, 1), NULL);
    size_t m = galv_model_modes(model);
    const double *latent = galv_model_latent(model);
    double lower[FUNCTIONS], upper[FUNCTIONS], radius, nearest, r90;
    CU_ASSERT_EQUAL(galv_latent_bounds(model, 1, lower, upper), GALV_OK);
    for (size_t k = 0; k < m; k++) {
        CU_ASSERT_EQUAL(lower[k], galv_model_lower(model)[k]);
        CU_ASSERT_EQUAL(upper[k], galv_model_upper(model)[k]);
    }
    CU_ASSERT_EQUAL(galv_latent_bounds(model, 0.9, lower, upper), GALV_OK);
    CU_ASSERT_EQUAL(galv_latent_ellipsoid(model, 0.9, &r90), GALV_OK);
    size_t inside = 0;
    for (size_t k = 0; k < m; k++) {
        size_t within = 0;
        for (size_t r = 0; r < COUNT; r++)
            within += latent[r * m + k] >= lower[k] && latent[r * m + k] <= upper[k];
        CU_ASSERT_TRUE(within >= 898 && within <= 902);
    }
    for (size_t r = 0; r < COUNT; r++) {
        CU_ASSERT_EQUAL(galv_latent_distance(model, latent + r * m, &radius, NULL), GALV_OK);
        inside += radius <= r90;
    }
    CU_ASSERT_TRUE(inside >= 899 && inside <= 901);
    double u[FUNCTIONS] = {0};
    memcpy(u, latent + 17 * m, m * sizeof *u);
    CU_ASSERT_EQUAL(galv_latent_distance(model, u, NULL, &nearest), GALV_OK);
    CU_ASSERT_EQUAL(nearest, 0);
    u[0] += 100 * sqrt(galv_model_eigenvalues(model)[0]);
    CU_ASSERT_EQUAL(galv_latent_distance(model, u, &radius, &nearest), GALV_OK);
    CU_ASSERT_TRUE(nearest > 95 && nearest < 105 && radius > 95);
    CU_ASSERT_EQUAL(galv_latent_bounds(model, 0, lower, upper), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_latent_ellipsoid(model, 1.1, &radius), GALV_ERROR_ARGUMENT);
    galv_model_free(model);
    galv_shape_free(shape);
}

static const struct check_case cases[] = {
    {"extending equals rebuilding", test_extension_equals_rebuilding},
    {"extending refuses what does not fit", test_extension_refuses},
    {"a model as numbers and back", test_view_and_restore},
    {"plain data", test_plain_data},
    {"bounds cover their share", test_bounds_cover_their_share},
};

CHECK_MAIN("galv extend", cases)
