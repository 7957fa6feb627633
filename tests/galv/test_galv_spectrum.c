/* Spectra against a dense SVD and against the closed form of the linear case. */
#include "check.h"
#include "fixture.h"

#include <cblas.h>
#include <lapacke.h>
#include <string.h>

static double grid[3 * POINTS];

struct reference {
    double *x, *rows, *values;
    size_t count;
};

static struct reference make_reference(const galv_shape *shape, size_t count, bool centre,
                                       const double *weights)
{
    struct reference r = {.count = count};
    fixture_grid(grid);
    r.x = fixture_samples(shape, count, 42);
    r.rows = fixture_rows(shape, POINTS, grid, count, r.x);
    r.values = fixture_spectrum(count, (size_t)3 * POINTS, r.rows, centre, weights, 0, NULL);
    return r;
}

static void free_reference(struct reference *r)
{
    free(r->x);
    free(r->rows);
    free(r->values);
}

/* Eigenvalues against the SVD, relative to the largest; trace; modes orthonormal in the weighted
 * inner product and satisfying C w = lambda w; eq. 10 by going through all samples. */
static void check_model(const galv_model *model, const struct reference *r, double tolerance,
                        bool all)
{
    size_t length = galv_model_coordinates(model), m = galv_model_modes(model);
    size_t least = r->count < length ? r->count : length;
    const double *w = galv_model_vectors(model), *weight = galv_model_weights(model);
    double trace = 0;
    for (size_t k = 0; k < least; k++)
        trace += r->values[k];
    CHECK_RELATIVE(galv_model_trace(model), trace, 1e-13);
    size_t compared = all ? galv_model_spectrum(model) : m;
    for (size_t k = 0; k < compared; k++)
        CHECK_CLOSE(galv_model_eigenvalues(model)[k], r->values[k], tolerance * r->values[0]);
    for (size_t k = 0; k < m; k++)
        for (size_t l = 0; l <= k; l++) {
            double dot = 0;
            for (size_t i = 0; i < length; i++)
                dot += (weight ? weight[i] : 1) * w[k * length + i] * w[l * length + i];
            CHECK_CLOSE(dot, k == l, 1e-12);
        }
    double *u = malloc(m * sizeof *u), *d = malloc(length * sizeof *d), square = 0;
    for (size_t s = 0; s < r->count; s++) {
        const double *row = r->rows + s * length;
        CU_ASSERT_EQUAL(galv_project(model, row, u), GALV_OK);
        CU_ASSERT_EQUAL(galv_reconstruct(model, u, d), GALV_OK);
        for (size_t i = 0; i < length; i++)
            square += (weight ? weight[i] : 1) * (d[i] - row[i]) * (d[i] - row[i]);
        for (size_t k = 0; k < m; k++)
            CHECK_CLOSE(galv_model_latent(model)[s * m + k], u[k], 1e-12);
    }
    CHECK_CLOSE(galv_model_mse(model)[m - 1], square / (double)r->count, 1e-12 * trace);
    free(u);
    free(d);
}

static void compare(galv_combination combination, size_t count, galv_method method, bool centre,
                    bool weighted, double tolerance)
{
    galv_shape *shape = fixture_shape(combination, 0.03);
    double weights[POINTS], spread[3 * POINTS];
    fixture_grid(grid);
    CU_ASSERT_EQUAL(galv_grid_weights(SECTIONS, GIRTH, grid, weights), GALV_OK);
    for (size_t i = 0; i < (size_t)3 * POINTS; i++)
        spread[i] = weights[i / 3];
    struct reference r = make_reference(shape, count, centre, weighted ? spread : NULL);
    galv_options options;
    galv_options_init(&options);
    options.method = method;
    options.centre = centre;
    options.weights = weighted ? weights : NULL;
    galv_model *model = NULL;
    galv_status status =
        galv_build(shape, POINTS, grid, galv_samples(count, r.x), &options, &model);
    CU_ASSERT_EQUAL_FATAL(status, GALV_OK);
    if (method != GALV_METHOD_AUTO)
        CU_ASSERT_EQUAL(galv_model_method(model), method);
    CU_ASSERT_TRUE(galv_model_retained(model) >= 0.95);
    check_model(model, &r, tolerance, method != GALV_METHOD_RANDOMISED);
    galv_model_free(model);
    free_reference(&r);
    galv_shape_free(shape);
}

static void test_covariance_side(void)
{
    compare(GALV_COMBINATION_RECURSIVE, 400, GALV_METHOD_COVARIANCE, false, false, 1e-14);
    compare(GALV_COMBINATION_LINEAR, 400, GALV_METHOD_COVARIANCE, false, false, 1e-14);
    compare(GALV_COMBINATION_RECURSIVE, 60, GALV_METHOD_COVARIANCE, false, false, 1e-14);
}

static void test_gram_side(void)
{
    compare(GALV_COMBINATION_RECURSIVE, 100, GALV_METHOD_GRAM, false, false, 1e-14);
    compare(GALV_COMBINATION_LINEAR, 400, GALV_METHOD_GRAM, false, false, 1e-14);
    compare(GALV_COMBINATION_RECURSIVE, 700, GALV_METHOD_GRAM, false, false, 1e-14);
}

static void test_randomised(void)
{
    compare(GALV_COMBINATION_RECURSIVE, 400, GALV_METHOD_RANDOMISED, false, false, 1e-11);
    compare(GALV_COMBINATION_LINEAR, 400, GALV_METHOD_RANDOMISED, false, false, 1e-11);
}

static void test_factored(void)
{
    compare(GALV_COMBINATION_LINEAR, 400, GALV_METHOD_FACTORED, false, false, 1e-14);
    compare(GALV_COMBINATION_LINEAR, 400, GALV_METHOD_FACTORED, true, true, 1e-14);
    compare(GALV_COMBINATION_LINEAR, 15, GALV_METHOD_FACTORED, true, false, 1e-14);
    compare(GALV_COMBINATION_LINEAR, 400, GALV_METHOD_AUTO, true, false, 1e-14);
}

static void test_centred(void)
{
    compare(GALV_COMBINATION_RECURSIVE, 300, GALV_METHOD_COVARIANCE, true, false, 1e-14);
    compare(GALV_COMBINATION_RECURSIVE, 100, GALV_METHOD_GRAM, true, false, 1e-14);
    compare(GALV_COMBINATION_RECURSIVE, 300, GALV_METHOD_RANDOMISED, true, false, 1e-11);
}

static void test_weighted(void)
{
    compare(GALV_COMBINATION_RECURSIVE, 300, GALV_METHOD_COVARIANCE, false, true, 1e-14);
    compare(GALV_COMBINATION_RECURSIVE, 100, GALV_METHOD_GRAM, true, true, 1e-14);
    compare(GALV_COMBINATION_RECURSIVE, 300, GALV_METHOD_RANDOMISED, true, true, 1e-11);
}

/* Linear: C = Psi^T A Psi with A = X^T X / N, so its non-zero eigenvalues are those of the 27 x 27
 * matrix R A R^T with Psi^T = Q R. */
static void test_linear_equals_closed_form(void)
{
    enum { COUNT = 2000 };
    galv_shape *shape = fixture_shape(GALV_COMBINATION_LINEAR, 0.03);
    fixture_grid(grid);
    double *x = fixture_samples(shape, COUNT, 9);
    const lapack_int n = FUNCTIONS, length = 3 * POINTS;
    static double psi[3 * POINTS * FUNCTIONS];
    double tau[FUNCTIONS], r[FUNCTIONS * FUNCTIONS] = {0}, a[FUNCTIONS * FUNCTIONS],
                                         ra[FUNCTIONS * FUNCTIONS], values[FUNCTIONS];
    for (int i = 0; i < FUNCTIONS; i++) {
        double unit[FUNCTIONS] = {0};
        unit[i] = 1;
        galv_shape_displace(shape, POINTS, grid, unit, psi + i * length);
    }
    LAPACKE_dgeqrf(LAPACK_COL_MAJOR, length, n, psi, length, tau);
    for (int c = 0; c < FUNCTIONS; c++)
        for (int i = 0; i <= c; i++)
            r[c * FUNCTIONS + i] = psi[c * length + i];
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, n, n, COUNT, 1.0 / COUNT, x, n, x, n, 0, a,
                n);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n, n, n, 1, r, n, a, n, 0, ra, n);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, n, n, n, 1, ra, n, r, n, 0, a, n);
    LAPACKE_dsyev(LAPACK_COL_MAJOR, 'N', 'L', n, a, n, values);
    galv_options options;
    galv_options_init(&options);
    for (int method = GALV_METHOD_COVARIANCE; method <= GALV_METHOD_FACTORED; method++) {
        galv_model *model = NULL;
        options.method = (galv_method)method;
        CU_ASSERT_EQUAL_FATAL(
            galv_build(shape, POINTS, grid, galv_samples(COUNT, x), &options, &model), GALV_OK);
        CU_ASSERT_EQUAL(galv_model_spectrum(model), FUNCTIONS);
        for (size_t k = 0; k < galv_model_spectrum(model) && k < FUNCTIONS; k++)
            CHECK_CLOSE(galv_model_eigenvalues(model)[k], values[FUNCTIONS - 1 - k],
                        1e-12 * values[FUNCTIONS - 1]);
        galv_model_free(model);
    }
    free(x);
    galv_shape_free(shape);
}

/* Orders large enough for the iterative solver of the matrix methods, against all of LAPACK's
 * eigenvalues, which the variance target 1 makes the library use. */
static void test_iteration_equals_full_decomposition(void)
{
    enum { ALONG = 45, AROUND = 15, FINE = ALONG * AROUND, COUNT = 700 };
    static double xyz[3 * FINE];
    for (size_t i = 0; i < ALONG; i++)
        for (size_t j = 0; j < AROUND; j++) {
            double s = (double)i / (ALONG - 1), t = (double)j / (AROUND - 1);
            double *p = xyz + 3 * (i * AROUND + j);
            p[0] = 6 * s;
            p[1] = 0.4 * (0.1 + 3 * s * (1 - s)) * (1 - t * t);
            p[2] = -0.3 * t;
        }
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_model *part = NULL, *whole = NULL;
    galv_options options;
    galv_options_init(&options);
    CU_ASSERT_EQUAL_FATAL(galv_build(shape, FINE, xyz, galv_uniform(COUNT, 4), &options, &part),
                          GALV_OK);
    options.variance = 1;
    CU_ASSERT_EQUAL_FATAL(galv_build(shape, FINE, xyz, galv_uniform(COUNT, 4), &options, &whole),
                          GALV_OK);
    CU_ASSERT_EQUAL(galv_model_spectrum(part), 64);
    CU_ASSERT_TRUE(galv_model_spectrum(whole) > 400);
    CHECK_CLOSE(galv_model_retained(whole), 1, 1e-11);
    const double *p = galv_model_eigenvalues(part), *w = galv_model_eigenvalues(whole);
    for (size_t k = 0; k < 64; k++) {
        CHECK_RELATIVE(p[k], w[k], 1e-10);
        CU_ASSERT_TRUE(galv_model_residuals(part)[k] <= 1e-12 * p[0]);
    }
    size_t length = galv_model_coordinates(part);
    for (size_t k = 0; k < galv_model_modes(part); k++)
        for (size_t i = 0; i < length; i++)
            CHECK_CLOSE(galv_model_vectors(part)[k * length + i],
                        galv_model_vectors(whole)[k * length + i], 1e-9);
    galv_model_free(part);
    galv_model_free(whole);
    galv_shape_free(shape);
}

/* The a posteriori bounds hold against the exact eigenvalues, also when the iteration is cut short
 * by a loose goal. */
static void test_residuals_bound_errors(void)
{
    enum { COUNT = 500 };
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    struct reference r = make_reference(shape, COUNT, false, NULL);
    galv_options options;
    galv_options_init(&options);
    options.method = GALV_METHOD_RANDOMISED;
    options.variance = 0.3;
    options.spectrum = 12;
    galv_model *model = NULL;
    CU_ASSERT_EQUAL_FATAL(
        galv_build(shape, POINTS, grid, galv_samples(COUNT, r.x), &options, &model), GALV_OK);
    for (size_t k = 0; k < galv_model_spectrum(model); k++) {
        double value = galv_model_eigenvalues(model)[k], nearest = INFINITY;
        for (size_t j = 0; j < COUNT; j++)
            nearest = fmin(nearest, fabs(r.values[j] - value));
        CU_ASSERT_TRUE(nearest <= galv_model_residuals(model)[k] + 1e-15 * r.values[0]);
        CU_ASSERT_TRUE(value <= r.values[k] * (1 + 1e-13));
    }
    galv_model_free(model);
    free_reference(&r);
    galv_shape_free(shape);
}

/* Coordinates that start to move late join the covariance with zeros: a callback that moves point p
 * only from sample p on. */
static int late(void *user_data, size_t npoints, const double *xyz, const double *x, double *d)
{
    (void)user_data;
    (void)xyz;
    for (size_t i = 0; i < 3 * npoints; i++)
        d[i] = 3 * x[0] >= (double)i ? sin(x[0] * (double)(i + 1)) : 0;
    return 0;
}

static void test_late_coordinates(void)
{
    enum { COUNT = 600, LATE = 100 };
    double lower = 0, upper = COUNT, x[COUNT];
    static double xyz[3 * LATE];
    for (int r = 0; r < COUNT; r++)
        x[r] = r < 550 ? r / 50 : r;
    galv_shape *shape = NULL;
    CU_ASSERT_EQUAL_FATAL(galv_shape_callback(1, &lower, &upper, late, NULL, true, &shape),
                          GALV_OK);
    double *rows = fixture_rows(shape, LATE, xyz, COUNT, x);
    double *values = fixture_spectrum(COUNT, (size_t)3 * LATE, rows, false, NULL, 0, NULL);
    galv_options options;
    galv_options_init(&options);
    for (int method = GALV_METHOD_COVARIANCE; method <= GALV_METHOD_RANDOMISED; method++) {
        galv_model *model = NULL;
        options.method = (galv_method)method;
        CU_ASSERT_EQUAL_FATAL(
            galv_build(shape, LATE, xyz, galv_samples(COUNT, x), &options, &model), GALV_OK);
        for (size_t k = 0; k < galv_model_modes(model); k++)
            CHECK_CLOSE(galv_model_eigenvalues(model)[k], values[k], 1e-11 * values[0]);
        galv_model_free(model);
    }
    free(values);
    free(rows);
    galv_shape_free(shape);
}

static void test_area_weights(void)
{
    double xyz[] = {0, 0, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0, 3, 0, 0, 3, 1, 0}, weights[6];
    CU_ASSERT_EQUAL(galv_grid_weights(3, 2, xyz, weights), GALV_OK);
    const double expected[] = {1, 1, 1.5, 1.5, 0.5, 0.5};
    for (int i = 0; i < 6; i++)
        CHECK_CLOSE(weights[i], expected[i], 1e-15);
    memset(xyz, 0, sizeof xyz);
    CU_ASSERT_EQUAL(galv_grid_weights(3, 2, xyz, weights), GALV_ERROR_GEOMETRY);
    CU_ASSERT_EQUAL(galv_grid_weights(1, 6, xyz, weights), GALV_ERROR_ARGUMENT);
}

static const struct check_case cases[] = {
    {"covariance side equals a dense SVD", test_covariance_side},
    {"Gram side equals a dense SVD", test_gram_side},
    {"randomised iteration equals a dense SVD", test_randomised},
    {"functions of a linear shape equal a dense SVD", test_factored},
    {"centred samples", test_centred},
    {"weighted points", test_weighted},
    {"linear case equals the 27 x 27 closed form", test_linear_equals_closed_form},
    {"iterative solver equals the full decomposition", test_iteration_equals_full_decomposition},
    {"residuals bound the errors of eigenvalues", test_residuals_bound_errors},
    {"coordinates that move late", test_late_coordinates},
    {"area weights of a grid", test_area_weights},
};

CHECK_MAIN("galv spectrum", cases)
