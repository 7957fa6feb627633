/* The latent space in use: bounds, projection, reconstruction, back-mapping, confidence. */
#include "check.h"
#include "fixture.h"

#include <string.h>

static double grid[3 * POINTS];

static galv_model *build(const galv_shape *shape, size_t count, uint64_t seed,
                         const galv_options *options)
{
    galv_model *model = NULL;
    fixture_grid(grid);
    CU_ASSERT_EQUAL_FATAL(
        galv_build(shape, POINTS, grid, galv_uniform(count, seed), options, &model), GALV_OK);
    return model;
}

static void test_projection_inverts_reconstruction(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_model *model = build(shape, 300, 1, NULL);
    size_t m = galv_model_modes(model);
    double u[FUNCTIONS], back[FUNCTIONS], d[3 * POINTS];
    CU_ASSERT_TRUE_FATAL(m <= FUNCTIONS);
    for (size_t k = 0; k < m; k++)
        u[k] = sin((double)k + 1);
    CU_ASSERT_EQUAL(galv_reconstruct(model, u, d), GALV_OK);
    CU_ASSERT_EQUAL(galv_project(model, d, back), GALV_OK);
    for (size_t k = 0; k < m; k++)
        CHECK_CLOSE(back[k], u[k], 1e-13);
    for (size_t p = 0; p < POINTS; p++) /* dx = dz = 0, and the stem and the keel stay */
        CU_ASSERT_TRUE(d[3 * p] == 0 && d[3 * p + 2] == 0);
    CU_ASSERT_EQUAL(d[3 * (POINTS - 1) + 1], 0);
    galv_model_free(model);
    galv_shape_free(shape);
}

static void test_box_holds_samples(void)
{
    enum { COUNT = 200 };
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_model *model = build(shape, COUNT, 8, NULL);
    size_t m = galv_model_modes(model);
    const double *lower = galv_model_lower(model), *upper = galv_model_upper(model);
    double x[FUNCTIONS], d[3 * POINTS], u[FUNCTIONS];
    double least[FUNCTIONS], greatest[FUNCTIONS];
    for (size_t k = 0; k < m; k++) {
        least[k] = INFINITY;
        greatest[k] = -INFINITY;
    }
    for (size_t r = 0; r < COUNT; r++) {
        galv_uniform_sample(8, r, FUNCTIONS, galv_shape_lower(shape), galv_shape_upper(shape), x);
        galv_shape_displace(shape, POINTS, grid, x, d);
        galv_project(model, d, u);
        for (size_t k = 0; k < m; k++) {
            least[k] = fmin(least[k], u[k]);
            greatest[k] = fmax(greatest[k], u[k]);
        }
    }
    for (size_t k = 0; k < m; k++) {
        CHECK_CLOSE(lower[k], least[k], 1e-13);
        CHECK_CLOSE(upper[k], greatest[k], 1e-13);
    }
    galv_model_free(model);
    galv_shape_free(shape);
}

/* Modes are reported with their component of largest magnitude positive. */
static void test_sign_of_modes(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_model *model = build(shape, 100, 3, NULL);
    size_t length = galv_model_coordinates(model);
    for (size_t k = 0; k < galv_model_modes(model); k++) {
        double largest = 0;
        for (size_t i = 0; i < length; i++) {
            double value = galv_model_vectors(model)[k * length + i];
            largest = fabs(value) > fabs(largest) ? value : largest;
        }
        CU_ASSERT_TRUE(largest > 0);
    }
    galv_model_free(model);
    galv_shape_free(shape);
}

/* With all 27 modes of a linear shape the parameters come back. */
static void test_backmap_returns_parameters(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_LINEAR, 0.03);
    galv_options options;
    galv_options_init(&options);
    options.modes = FUNCTIONS;
    galv_model *model = build(shape, 300, 1, &options);
    double x[FUNCTIONS], back[FUNCTIONS], d[3 * POINTS], u[FUNCTIONS], residual;
    galv_uniform_sample(77, 0, FUNCTIONS, galv_shape_lower(shape), galv_shape_upper(shape), x);
    galv_shape_displace(shape, POINTS, grid, x, d);
    galv_project(model, d, u);
    CU_ASSERT_EQUAL(galv_backmap(model, shape, u, back, &residual), GALV_OK);
    CHECK_CLOSE(residual, 0, 1e-13);
    for (int i = 0; i < FUNCTIONS; i++)
        CHECK_CLOSE(back[i], x[i], 1e-9);
    galv_model_free(model);
    galv_shape_free(shape);
}

static double distance(const galv_shape *shape, const double *x, const double *target)
{
    double d[3 * POINTS], sum = 0;
    galv_shape_displace(shape, POINTS, grid, x, d);
    for (size_t i = 0; i < (size_t)3 * POINTS; i++)
        sum += (d[i] - target[i]) * (d[i] - target[i]);
    return sqrt(sum / POINTS);
}

/* Recursive: the answer is within bounds, its residual is what it says, and no neighbour within the
 * bounds is nearer. */
static void test_backmap_is_a_bounded_minimum(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_model *model = build(shape, 500, 2, NULL);
    size_t m = galv_model_modes(model);
    unsigned at_bound = 0;
    for (uint64_t trial = 0; trial < 6; trial++) {
        double u[FUNCTIONS], x[FUNCTIONS], target[3 * POINTS], residual;
        galv_uniform_sample(50, trial, m, galv_model_lower(model), galv_model_upper(model), u);
        CU_ASSERT_EQUAL_FATAL(galv_backmap(model, shape, u, x, &residual), GALV_OK);
        galv_reconstruct(model, u, target);
        CHECK_RELATIVE(residual, distance(shape, x, target), 1e-9);
        for (int i = 0; i < FUNCTIONS; i++) {
            double here = x[i];
            CU_ASSERT_TRUE(fabs(here) <= 0.03);
            at_bound += fabs(here) == 0.03;
            for (int side = -1; side <= 1; side += 2) {
                x[i] = fmin(fmax(here + side * 1e-5, -0.03), 0.03);
                CU_ASSERT_TRUE(distance(shape, x, target) >= residual * (1 - 1e-9));
            }
            x[i] = here;
        }
    }
    CU_ASSERT_TRUE(at_bound > 0);
    galv_model_free(model);
    galv_shape_free(shape);
}

/* Sine of the greatest principal angle between the modes of two models of one grid, by the norm of
 * what the second leaves of the first: power iteration on I - M^T M with M = W2^T W1. */
static double angle_between(const galv_model *a, const galv_model *b)
{
    enum { MOST = FUNCTIONS };
    size_t m = galv_model_modes(a), length = galv_model_coordinates(a);
    double cross[MOST][MOST], v[MOST], value = 0;
    CU_ASSERT_TRUE_FATAL(m <= MOST && galv_model_modes(b) == m);
    for (size_t k = 0; k < m; k++)
        for (size_t l = 0; l < m; l++) {
            cross[k][l] = 0;
            for (size_t i = 0; i < length; i++)
                cross[k][l] +=
                    galv_model_vectors(b)[k * length + i] * galv_model_vectors(a)[l * length + i];
        }
    for (size_t l = 0; l < m; l++)
        v[l] = 1 + 0.1 * (double)l;
    for (int iteration = 0; iteration < 200; iteration++) {
        double mv[MOST], norm = 0;
        for (size_t k = 0; k < m; k++) {
            mv[k] = 0;
            for (size_t l = 0; l < m; l++)
                mv[k] += cross[k][l] * v[l];
        }
        for (size_t l = 0; l < m; l++) {
            for (size_t k = 0; k < m; k++)
                v[l] -= cross[k][l] * mv[k];
            norm += v[l] * v[l];
        }
        value = sqrt(norm);
        for (size_t l = 0; l < m; l++)
            v[l] /= value;
    }
    return asin(fmin(sqrt(value), 1));
}

/* The number of modes after which the spectrum falls most, so that the subspace is well determined.
 */
static size_t widest_gap(const galv_model *model)
{
    const double *values = galv_model_eigenvalues(model);
    size_t best = 4;
    for (size_t m = 4; m < 20; m++)
        if (values[m - 1] / values[m] > values[best - 1] / values[best])
            best = m;
    return best;
}

/* The stated standard error of the retained share is the spread of independent builds; the stated
 * angle is that to the modes of very many samples. */
static void test_confidence_matches_repetition(void)
{
    enum { BUILDS = 12, COUNT = 1500, MANY = 15000 };
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_options options;
    galv_options_init(&options);
    galv_model *first = build(shape, COUNT, 1, NULL);
    options.modes = widest_gap(first);
    galv_model_free(first);
    galv_model *truth = build(shape, MANY, 99, &options);
    double share[BUILDS], mean = 0, stated = 0, spread = 0, angle = 0, error = 0;
    for (uint64_t b = 0; b < BUILDS; b++) {
        galv_model *model = build(shape, COUNT, 100 + b, &options);
        galv_confidence confidence = galv_model_confidence(model);
        share[b] = galv_model_retained(model);
        mean += share[b] / BUILDS;
        stated += confidence.retained_error / BUILDS;
        angle += confidence.angle / BUILDS;
        error += angle_between(model, truth) / BUILDS;
        galv_model_free(model);
    }
    for (int b = 0; b < BUILDS; b++)
        spread += (share[b] - mean) * (share[b] - mean) / (BUILDS - 1);
    spread = sqrt(spread);
    CU_ASSERT_TRUE(stated > spread / 2 && stated < 2 * spread);
    CU_ASSERT_TRUE(angle > error / 1.5 && angle < 1.5 * error);
    galv_model_free(truth);
    galv_shape_free(shape);
}

/* Share of the variance of fresh samples that the modes hold, by projecting them. */
static double fresh_share(const galv_shape *shape, const galv_model *model, size_t first)
{
    enum { FRESH = 2000 };
    double x[FUNCTIONS], d[3 * POINTS], u[FUNCTIONS], kept = 0, all = 0;
    for (size_t r = first; r < first + FRESH; r++) {
        galv_uniform_sample(77, r, FUNCTIONS, galv_shape_lower(shape), galv_shape_upper(shape), x);
        galv_shape_displace(shape, POINTS, grid, x, d);
        galv_project(model, d, u);
        for (size_t k = 0; k < galv_model_modes(model); k++)
            kept += u[k] * u[k];
        for (size_t i = 0; i < (size_t)3 * POINTS; i++)
            all += d[i] * d[i];
    }
    return kept / all;
}

/* The share stated for fresh samples is theirs within its error, from N = 20 on; that of the
 * samples themselves is not. */
static void test_fresh_samples(void)
{
    enum { BUILDS = 15, SIZES = 4 };
    static const size_t count[SIZES] = {20, 30, 60, 200};
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    for (size_t s = 0; s < SIZES; s++) {
        size_t within = 0, far = 0;
        double bias = 0, flattery = 0, error = 0;
        for (uint64_t b = 0; b < BUILDS; b++) {
            galv_model *model = build(shape, count[s], 1000 * count[s] + b, NULL);
            galv_confidence c = galv_model_confidence(model);
            double truth = fresh_share(shape, model, 2000 * b);
            within += fabs(c.retained_fresh - truth) <= 2 * c.retained_error;
            far += fabs(c.retained_fresh - truth) > 4 * c.retained_error;
            bias += (c.retained_fresh - truth) / BUILDS;
            flattery += (galv_model_retained(model) - truth) / BUILDS;
            error += c.retained_error / BUILDS;
            galv_model_free(model);
        }
        CU_ASSERT_TRUE(within >= 12);
        CU_ASSERT_EQUAL(far, 0);
        CU_ASSERT_TRUE(fabs(bias) < error);
        CU_ASSERT_TRUE(count[s] > 30 || flattery > 3 * error);
        if (within < 12 || far || fabs(bias) >= error)
            fprintf(stderr, "N = %zu: %zu within 2, %zu beyond 4, bias %.4f, error %.4f, %.4f\n",
                    count[s], within, far, bias, error, flattery);
    }
    galv_shape_free(shape);
}

/* More samples, smaller figures: quarter the error for sixteen times the samples, within sampling
 * noise. */
static void test_confidence_shrinks(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_options options;
    galv_options_init(&options);
    options.modes = 12;
    galv_model *few = build(shape, 300, 5, &options), *many = build(shape, 4800, 5, &options);
    galv_confidence a = galv_model_confidence(few), b = galv_model_confidence(many);
    CU_ASSERT_TRUE(b.retained_error < a.retained_error / 1.5);
    CU_ASSERT_TRUE(b.angle < a.angle / 1.5);
    galv_model_free(few);
    galv_model_free(many);
    galv_shape_free(shape);
}

static const struct check_case cases[] = {
    {"projection inverts reconstruction", test_projection_inverts_reconstruction},
    {"the latent box holds the samples", test_box_holds_samples},
    {"sign of modes", test_sign_of_modes},
    {"back-mapping returns the parameters", test_backmap_returns_parameters},
    {"back-mapping finds a bounded minimum", test_backmap_is_a_bounded_minimum},
    {"confidence agrees with repetition", test_confidence_matches_repetition},
    {"the share of fresh samples", test_fresh_samples},
    {"confidence grows with samples", test_confidence_shrinks},
};

CHECK_MAIN("galv latent", cases)
