/* Geometric moments, and latent spaces that account for appended quantities. */
#include "check.h"
#include "fixture.h"

#include <string.h>

static galv_extra moments_of(galv_moment_set *set)
{
    galv_extra extra = {.count = 0};
    CU_ASSERT_EQUAL_FATAL(galv_moments_extra(set, &extra), GALV_OK);
    return extra;
}

/* Half hull that is a wall: y = 0.5 + 0.1 x between x = 1..3, z = -1..0. */
static double wall[2 * 3 * 3];

static void make_wall(void)
{
    for (size_t i = 0; i < 2; i++)
        for (size_t j = 0; j < 3; j++) {
            double *p = wall + 3 * (i * 3 + j);
            p[0] = 1 + 2 * (double)i;
            p[1] = 0.5 + 0.1 * p[0];
            p[2] = -0.5 * (double)j;
        }
}

/* Integral of x^p (a + b x)^(q+1)/(q+1) z^r over the wall, by a fine midpoint rule in x. */
static double wall_moment(unsigned p, unsigned q, unsigned r)
{
    enum { STEPS = 20000 };
    double sum = 0;
    for (int k = 0; k < STEPS; k++) {
        double x = 1 + 2 * (k + 0.5) / STEPS;
        sum += pow(x, p) * pow(0.5 + 0.1 * x, q + 1) / (q + 1) * 2 / STEPS;
    }
    return sum * (r % 2 ? -1 : 1) / (r + 1);
}

static void test_moments_of_a_wall(void)
{
    double moments[35];
    make_wall();
    CU_ASSERT_EQUAL(galv_moments_count(4), 35);
    CU_ASSERT_EQUAL_FATAL(galv_moments(2, 3, wall, 4, moments), GALV_OK);
    size_t m = 0;
    for (unsigned s = 0; s <= 4; s++)
        for (unsigned p = s + 1; p-- > 0;)
            for (unsigned q = s - p + 1; q-- > 0;) {
                double expected = wall_moment(p, q, s - p - q);
                CHECK_RELATIVE(moments[m], expected, 1e-8);
                m++;
            }
    CU_ASSERT_EQUAL(m, 35);
}

/* Wigley hull: volume 4/9 L B T for both sides, centroid depth 3/8 T; converges with the square of
 * the cells. */
static double wigley_error(size_t n)
{
    double *xyz = malloc(3 * n * n * sizeof *xyz), moments[4];
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            double s = (double)i / (double)(n - 1), t = (double)j / (double)(n - 1);
            double *p = xyz + 3 * (i * n + j);
            p[0] = 6 * s;
            p[1] = 0.4 * 4 * s * (1 - s) * (1 - t * t);
            p[2] = -0.3 * t;
        }
    galv_moments(n, n, xyz, 1, moments);
    free(xyz);
    double volume = 4.0 / 9 * 6 * 0.4 * 0.3;
    CHECK_RELATIVE(moments[1] / moments[0], 3.0, 1e-12);
    CHECK_RELATIVE(moments[3] / moments[0], -3.0 / 8 * 0.3, 0.01);
    return fabs(moments[0] / volume - 1);
}

static void test_moments_converge(void)
{
    double coarse = wigley_error(11), fine = wigley_error(41);
    CU_ASSERT_TRUE(fine < 1e-3);
    CU_ASSERT_TRUE(coarse / fine > 15 && coarse / fine < 17);
}

static void test_section_moments(void)
{
    /* Triangle y from 0 at z = -1 to 2 at z = 0: area 1, first moments 2/3 and -1/3, second 2/3,
     * -1/4, 1/6. */
    const double points[] = {7, 0, -1, 7, 1, -0.5, 7, 2, 0};
    const double expected[] = {1, 2.0 / 3, -1.0 / 3, 2.0 / 3, -1.0 / 6, 1.0 / 6};
    double moments[6];
    CU_ASSERT_EQUAL_FATAL(galv_section_moments(3, points, 2, moments), GALV_OK);
    for (int m = 0; m < 6; m++)
        CHECK_CLOSE(moments[m], expected[m], 1e-15);
    CU_ASSERT_EQUAL(galv_section_moments(1, points, 2, moments), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_section_moments(3, points, 9, moments), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_moments(1, 3, points, 0, moments), GALV_ERROR_ARGUMENT);
}

/* Against the SVD of rows with the moments written behind them. */
static void test_appended_moments(void)
{
    enum { COUNT = 200, MOST = 80 };
    double xyz[3 * POINTS], weights[MOST], all[3 * POINTS + MOST];
    fixture_grid(xyz);
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_moment_set set = {
        .sections = SECTIONS, .girth = GIRTH, .order = 2, .section_order = 1, .section_stride = 7};
    galv_extra extra = moments_of(&set);
    size_t q = extra.count, length = 3 * POINTS + q;
    CU_ASSERT_EQUAL_FATAL(q, 10 + 3 * 3);
    /* The sections at stem and stern have no area: leave the first out by starting the balance with
     * it. */
    CU_ASSERT_EQUAL(
        galv_extra_balance(shape, POINTS, xyz, galv_uniform(50, 1), &extra, 0.5, weights),
        GALV_ERROR_GEOMETRY);
    set.section_stride = 0;
    extra = moments_of(&set);
    q = extra.count;
    length = 3 * POINTS + q;
    CU_ASSERT_EQUAL_FATAL(
        galv_extra_balance(shape, POINTS, xyz, galv_uniform(50, 1), &extra, 0.5, weights), GALV_OK);
    extra.weights = weights;
    double *x = fixture_samples(shape, COUNT, 6);
    double *rows = fixture_rows(shape, POINTS, xyz, COUNT, x);
    double *full = malloc(COUNT * length * sizeof *full), geometry = 0, moments = 0;
    for (size_t i = 0; i < length; i++)
        all[i] = i < 3 * POINTS ? 1 : weights[i - 3 * POINTS];
    for (size_t r = 0; r < COUNT; r++) {
        double *row = full + r * length;
        memcpy(row, rows + r * 3 * POINTS, 3 * POINTS * sizeof *row);
        CU_ASSERT_EQUAL(galv_extra_change(&extra, POINTS, xyz, row, row + 3 * POINTS), GALV_OK);
        for (size_t i = 0; i < length; i++)
            *(i < 3 * POINTS ? &geometry : &moments) += all[i] * row[i] * row[i] / COUNT;
    }
    CHECK_RELATIVE(moments, geometry / 2, 0.3);
    double *values = fixture_spectrum(COUNT, length, full, false, all, 0, NULL);
    galv_options options;
    galv_options_init(&options);
    options.extra = &extra;
    for (int method = GALV_METHOD_COVARIANCE; method <= GALV_METHOD_RANDOMISED; method++) {
        options.method = (galv_method)method;
        galv_model *model = NULL;
        CU_ASSERT_EQUAL_FATAL(
            galv_build(shape, POINTS, xyz, galv_samples(COUNT, x), &options, &model), GALV_OK);
        CU_ASSERT_EQUAL(galv_model_coordinates(model), length);
        CHECK_RELATIVE(galv_model_trace(model), geometry + moments, 1e-12);
        for (size_t k = 0; k < galv_model_modes(model); k++)
            CHECK_CLOSE(galv_model_eigenvalues(model)[k], values[k], 1e-11 * values[0]);
        /* What the modes leave of the displacements alone. */
        double left = 0, *u = malloc(galv_model_modes(model) * sizeof *u), back[3 * POINTS + MOST];
        for (size_t r = 0; r < COUNT; r++) {
            galv_project(model, full + r * length, u);
            galv_reconstruct(model, u, back);
            for (size_t i = 0; i < 3 * POINTS; i++)
                left += (back[i] - full[r * length + i]) * (back[i] - full[r * length + i]) / COUNT;
        }
        free(u);
        CHECK_CLOSE(galv_model_retained_geometry(model), 1 - left / geometry, 1e-10);
        galv_model_free(model);
    }
    options.method = GALV_METHOD_FACTORED;
    galv_model *none = NULL;
    CU_ASSERT_EQUAL(galv_build(shape, POINTS, xyz, galv_samples(COUNT, x), &options, &none),
                    GALV_ERROR_ARGUMENT);
    free(values);
    free(full);
    free(rows);
    free(x);
    galv_shape_free(shape);
}

/* Moments of the hull and of sections evaluated by the library, and those of the hull evaluated
 * with those of the sections handed in as numbers: the same rows, so the same spectrum. */
static void test_given_quantities(void)
{
    enum { COUNT = 60, HULL = 4, SECTION = 3, MOST = 20 };
    double xyz[3 * POINTS], weights[MOST], change[MOST];
    fixture_grid(xyz);
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_moment_set both = {.sections = SECTIONS,
                            .girth = GIRTH,
                            .order = 1,
                            .section_order = 1,
                            .section_first = 4,
                            .section_stride = SECTIONS / 2};
    galv_moment_set hull = {.sections = SECTIONS, .girth = GIRTH, .order = 1};
    galv_extra evaluated = moments_of(&both), given = moments_of(&hull);
    CU_ASSERT_EQUAL_FATAL(given.count, HULL);
    size_t rest = evaluated.count - HULL;
    CU_ASSERT_TRUE_FATAL(rest % SECTION == 0 && rest > 0 && evaluated.count <= MOST);
    galv_sampling sampling = galv_uniform(COUNT, 5);
    CU_ASSERT_EQUAL_FATAL(
        galv_extra_balance(shape, POINTS, xyz, sampling, &evaluated, 0.5, weights), GALV_OK);
    double *values = malloc(COUNT * rest * sizeof *values);
    for (size_t r = 0; r < COUNT; r++) {
        double x[FUNCTIONS], d[3 * POINTS];
        galv_uniform_sample(5, r, FUNCTIONS, galv_shape_lower(shape), galv_shape_upper(shape), x);
        galv_shape_displace(shape, POINTS, xyz, x, d);
        CU_ASSERT_EQUAL(galv_extra_change(&evaluated, POINTS, xyz, d, change), GALV_OK);
        memcpy(values + r * rest, change + HULL, rest * sizeof *values);
    }
    given.count += rest;
    given.given = rest;
    given.values = values;
    evaluated.weights = given.weights = weights;
    galv_options options;
    galv_options_init(&options);
    galv_model *model[2] = {NULL, NULL};
    for (int k = 0; k < 2; k++) {
        options.extra = k ? &given : &evaluated;
        CU_ASSERT_EQUAL_FATAL(galv_build(shape, POINTS, xyz, sampling, &options, &model[k]),
                              GALV_OK);
    }
    CU_ASSERT_EQUAL(galv_model_modes(model[0]), galv_model_modes(model[1]));
    for (size_t k = 0; k < galv_model_modes(model[0]); k++)
        CHECK_RELATIVE(galv_model_eigenvalues(model[1])[k], galv_model_eigenvalues(model[0])[k],
                       1e-12);
    CHECK_RELATIVE(galv_model_retained_geometry(model[1]), galv_model_retained_geometry(model[0]),
                   1e-12);
    CU_ASSERT_EQUAL(galv_extra_change(&given, POINTS, xyz, xyz, change), GALV_ERROR_ARGUMENT);
    values[37 * rest + 1] = NAN;
    galv_model *none = NULL;
    CU_ASSERT_EQUAL(galv_build(shape, POINTS, xyz, sampling, &options, &none), GALV_ERROR_NUMERIC);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "sample 37"));
    given.values = NULL;
    CU_ASSERT_EQUAL(galv_build(shape, POINTS, xyz, sampling, &options, &none), GALV_ERROR_ARGUMENT);
    galv_model_free(model[0]);
    galv_model_free(model[1]);
    free(values);
    galv_shape_free(shape);
}

/* Modes found with moments appended predict the volume better than as many without. */
static void test_moments_supervise(void)
{
    enum { COUNT = 400, MODES = 4 };
    double xyz[3 * POINTS], weight = 0, u[MODES], d[3 * POINTS + 1], error[2] = {0, 0};
    fixture_grid(xyz);
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_moment_set set = {.sections = SECTIONS, .girth = GIRTH, .order = 0};
    galv_extra extra = moments_of(&set);
    CU_ASSERT_EQUAL_FATAL(
        galv_extra_balance(shape, POINTS, xyz, galv_uniform(100, 1), &extra, 0.5, &weight),
        GALV_OK);
    extra.weights = &weight;
    galv_options options;
    galv_options_init(&options);
    options.modes = MODES;
    for (int with = 0; with < 2; with++) {
        options.extra = with ? &extra : NULL;
        galv_model *model = NULL;
        CU_ASSERT_EQUAL_FATAL(
            galv_build(shape, POINTS, xyz, galv_uniform(COUNT, 3), &options, &model), GALV_OK);
        for (size_t r = 0; r < COUNT; r++) {
            double x[FUNCTIONS], moved[3 * POINTS], change, volume[2];
            galv_uniform_sample(3, r, FUNCTIONS, galv_shape_lower(shape), galv_shape_upper(shape),
                                x);
            galv_shape_displace(shape, POINTS, xyz, x, d);
            galv_extra_change(&extra, POINTS, xyz, d, &d[3 * POINTS]);
            change = d[3 * POINTS];
            galv_project(model, d, u);
            galv_reconstruct(model, u, d);
            for (size_t i = 0; i < 3 * POINTS; i++)
                moved[i] = xyz[i] + d[i];
            galv_moments(SECTIONS, GIRTH, moved, 0, &volume[0]);
            galv_moments(SECTIONS, GIRTH, xyz, 0, &volume[1]);
            double miss = volume[0] - volume[1] - change;
            error[with] += miss * miss;
        }
        galv_model_free(model);
    }
    CU_ASSERT_TRUE(error[1] < error[0]);
    galv_shape_free(shape);
}

static const struct check_case cases[] = {
    {"moments of a wall", test_moments_of_a_wall},
    {"moments converge with the grid", test_moments_converge},
    {"moments of a section", test_section_moments},
    {"appended moments equal a dense SVD", test_appended_moments},
    {"quantities known to the caller", test_given_quantities},
    {"appended moments supervise the modes", test_moments_supervise},
};

CHECK_MAIN("galv moments", cases)
