/* Shape modifications against their definitions, and the bound under which they cannot fold. */
#include "check.h"
#include "fixture.h"

#include <string.h>

static const double pi = 3.14159265358979323846;

/* Eqs. 16-17 written down as they stand, with the C library's sine. */
static void displace_plainly(size_t n, const galv_sine *functions, const galv_box *box,
                             galv_combination combination, const double *point, const double *x,
                             double *d)
{
    bool recursive = combination == GALV_COMBINATION_RECURSIVE;
    d[0] = d[1] = d[2] = 0;
    for (size_t i = 0; i < n; i++) {
        double psi = 1;
        for (int j = 0; j < 3; j++) {
            double zeta = point[j] - box->origin[j] + (recursive ? d[j] : 0);
            psi *= sin(functions[i].order[j] * pi * zeta / box->length[j] + functions[i].phase[j]);
        }
        int q = functions[i].direction;
        double scale = combination == GALV_COMBINATION_SCALED ? point[q] - box->origin[q] : 1;
        d[q] += x[i] * psi * scale;
    }
}

static double worst_difference(size_t n, const galv_sine *functions, galv_combination combination,
                               const double *xyz)
{
    double lower[FUNCTIONS], upper[FUNCTIONS], x[FUNCTIONS], d[3 * POINTS], worst = 0;
    for (size_t i = 0; i < n; i++)
        upper[i] = -(lower[i] = -0.03);
    galv_shape *shape = NULL;
    CU_ASSERT_EQUAL_FATAL(
        galv_shape_sine(n, functions, &fixture_box, lower, upper, combination, &shape), GALV_OK);
    for (size_t r = 0; r < 5; r++) {
        galv_uniform_sample(11, r, n, lower, upper, x);
        CU_ASSERT_EQUAL(galv_shape_displace(shape, POINTS, xyz, x, d), GALV_OK);
        for (size_t p = 0; p < POINTS; p++) {
            double expected[3];
            displace_plainly(n, functions, &fixture_box, combination, xyz + 3 * p, x, expected);
            for (int j = 0; j < 3; j++)
                worst = fmax(worst, fabs(d[3 * p + (size_t)j] - expected[j]));
        }
    }
    galv_shape_free(shape);
    return worst;
}

static void test_sines_match_definition(void)
{
    double xyz[3 * POINTS];
    galv_sine functions[FUNCTIONS];
    fixture_grid(xyz);
    fixture_functions(functions);
    CHECK_CLOSE(worst_difference(FUNCTIONS, functions, GALV_COMBINATION_LINEAR, xyz), 0, 1e-15);
    CHECK_CLOSE(worst_difference(FUNCTIONS, functions, GALV_COMBINATION_RECURSIVE, xyz), 0, 1e-15);
    CHECK_CLOSE(worst_difference(FUNCTIONS, functions, GALV_COMBINATION_SCALED, xyz), 0, 1e-15);
}

/* All directions, fractional orders, phases: every axis can be live. */
static void test_any_direction_and_phase(void)
{
    double xyz[3 * POINTS];
    galv_sine functions[FUNCTIONS];
    fixture_grid(xyz);
    fixture_functions(functions);
    for (int i = 0; i < FUNCTIONS; i++) {
        functions[i].direction = i % 3;
        functions[i].order[i % 2] += 0.37;
        for (int j = 0; j < 3; j++)
            functions[i].phase[j] = 0.4 * i - j;
    }
    functions[4].order[1] = 0;
    CHECK_CLOSE(worst_difference(FUNCTIONS, functions, GALV_COMBINATION_LINEAR, xyz), 0, 2e-15);
    CHECK_CLOSE(worst_difference(FUNCTIONS, functions, GALV_COMBINATION_RECURSIVE, xyz), 0, 2e-15);
    CHECK_CLOSE(worst_difference(FUNCTIONS, functions, GALV_COMBINATION_SCALED, xyz), 0, 2e-15);
}

/* A model built from rows of the fast path must see what galv_shape_displace() gives. */
static void rows_match_single_displacements(galv_combination combination)
{
    double xyz[3 * POINTS];
    fixture_grid(xyz);
    galv_sine functions[FUNCTIONS]; /* the first six are used */
    fixture_functions(functions);
    double lower[6], upper[6];
    for (int i = 0; i < 6; i++) {
        functions[i].direction = i % 3;
        functions[i].phase[2] = 0.3 * i;
        upper[i] = -(lower[i] = -0.02);
    }
    galv_shape *shape = NULL;
    CU_ASSERT_EQUAL_FATAL(
        galv_shape_sine(6, functions, &fixture_box, lower, upper, combination, &shape), GALV_OK);
    double *x = fixture_samples(shape, 40, 3);
    double *rows = fixture_rows(shape, POINTS, xyz, 40, x), trace = 0;
    for (size_t i = 0; i < 40 * 3 * POINTS; i++)
        trace += rows[i] * rows[i] / 40;
    galv_model *model = NULL;
    CU_ASSERT_EQUAL_FATAL(galv_build(shape, POINTS, xyz, galv_samples(40, x), NULL, &model),
                          GALV_OK);
    CHECK_RELATIVE(galv_model_trace(model), trace, 1e-14);
    galv_model_free(model);
    galv_shape_free(shape);
    free(rows);
    free(x);
}

static void test_rows_match_single_displacements(void)
{
    rows_match_single_displacements(GALV_COMBINATION_RECURSIVE);
    rows_match_single_displacements(GALV_COMBINATION_SCALED);
}

/* A model made again of its fields moves the points by the same bits. */
static void check_restored(const galv_model *model)
{
    double u[6] = {0.01, -0.004, 0.003, -0.02, 0.015, 0.007}, moved[3 * POINTS], again[3 * POINTS];
    galv_field fields[40];
    galv_model *restored = NULL;
    size_t n = galv_model_field_count();
    CU_ASSERT_TRUE_FATAL(n <= 40);
    for (size_t i = 0; i < n; i++)
        fields[i] = galv_model_field(model, i);
    CU_ASSERT_EQUAL_FATAL(galv_model_restore(n, fields, &restored), GALV_OK);
    CU_ASSERT_EQUAL(galv_displace(model, u, moved), GALV_OK);
    CU_ASSERT_EQUAL(galv_displace(restored, u, again), GALV_OK);
    CU_ASSERT_EQUAL(memcmp(moved, again, sizeof moved), 0);
    galv_model_free(restored);
}

/* The parameters themselves as variables: displaced by them the points are where the shape has
 * them, of a recursive set to second order. */
static void parameters_as_variables(galv_combination combination, double tolerance)
{
    double xyz[3 * POINTS], lower[6], upper[6], x[6], d[3 * POINTS], moved[3 * POINTS], u[6];
    galv_sine functions[FUNCTIONS]; /* the first six are used */
    galv_shape *shape = NULL;
    galv_model *model = NULL;
    fixture_grid(xyz);
    fixture_functions(functions);
    for (int i = 0; i < 6; i++)
        upper[i] =
            -(lower[i] = i == 1 ? -0.005 : -0.02); /* in no order of their shares of the variance */
    CU_ASSERT_EQUAL_FATAL(
        galv_shape_sine(6, functions, &fixture_box, lower, upper, combination, &shape), GALV_OK);
    CU_ASSERT_EQUAL_FATAL(galv_build_parameters(shape, POINTS, xyz, &model), GALV_OK);
    CU_ASSERT_EQUAL(galv_model_modes(model), 6);
    double worst = 0;
    for (size_t r = 0; r < 5; r++) {
        galv_uniform_sample(5, r, 6, lower, upper, x);
        CU_ASSERT_EQUAL(galv_shape_displace(shape, POINTS, xyz, x, d), GALV_OK);
        CU_ASSERT_EQUAL(galv_displace(model, x, moved), GALV_OK);
        for (size_t k = 0; k < 3 * POINTS; k++)
            worst = fmax(worst, fabs(moved[k] - xyz[k] - d[k]));
    }
    CHECK_CLOSE(worst, 0, tolerance);
    for (int i = 0; i < 6; i++) {
        CU_ASSERT_EQUAL(galv_model_lower(model)[i], lower[i]);
        CU_ASSERT_EQUAL(galv_model_upper(model)[i], upper[i]);
    }
    check_restored(model);
    CU_ASSERT_EQUAL(galv_project(model, d, u), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_backmap(model, shape, x, u, NULL), GALV_ERROR_ARGUMENT);
    galv_model_free(model);
    galv_shape_free(shape);
}

static void test_parameters_as_variables(void)
{
    parameters_as_variables(GALV_COMBINATION_LINEAR, 1e-14);
    parameters_as_variables(GALV_COMBINATION_SCALED, 1e-14);
    /* Six moves of 0.02 in a box of width 0.38 at slopes up to 3 pi / 0.38. */
    parameters_as_variables(GALV_COMBINATION_RECURSIVE, 0.02);
}

/* Below the bound every section through the box stays in it and in order, whatever the other
 * parameters. */
static void test_fold_bound_keeps_order(void)
{
    enum { LINE = 201, TRIALS = 200 };
    galv_sine functions[FUNCTIONS];
    double bound[FUNCTIONS], x[FUNCTIONS], xyz[3 * LINE], d[3 * LINE];
    bool fixed = false;
    fixture_functions(functions);
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 1);
    CU_ASSERT_EQUAL_FATAL(galv_shape_fold_bound(shape, bound, &fixed), GALV_OK);
    CU_ASSERT_TRUE(fixed);
    for (int i = 0; i < FUNCTIONS; i++)
        CHECK_RELATIVE(bound[i], 0.4 / (pi * functions[i].order[1]), 1e-15);
    unsigned outside = 0, folded = 0;
    for (size_t trial = 0; trial < TRIALS; trial++) {
        double lower[FUNCTIONS], place[2], zero[2] = {0, 0}, one[2] = {6, 0.3};
        for (int i = 0; i < FUNCTIONS; i++)
            lower[i] = -bound[i];
        galv_uniform_sample(5, trial, FUNCTIONS, lower, bound, x);
        for (int i = 0; i < FUNCTIONS;
             i++) /* corners of the box of parameters: the hardest cases */
            x[i] = trial % 2 ? x[i] : copysign(0.999 * bound[i], x[i]);
        galv_uniform_sample(6, trial, 2, zero, one, place);
        for (size_t p = 0; p < LINE; p++) {
            xyz[3 * p] = place[0];
            xyz[3 * p + 1] = 0.4 * (double)p / (LINE - 1);
            xyz[3 * p + 2] = place[1] - 0.3;
        }
        CU_ASSERT_EQUAL_FATAL(galv_shape_displace(shape, LINE, xyz, x, d), GALV_OK);
        double last = -1;
        for (size_t p = 0; p < LINE; p++) {
            double y = xyz[3 * p + 1] + d[3 * p + 1];
            outside += y < -1e-15 || y > 0.4 + 1e-12;
            folded += y < last - 1e-15;
            last = y;
        }
        CU_ASSERT_EQUAL(d[1], 0);
    }
    CU_ASSERT_EQUAL(outside, 0);
    CU_ASSERT_EQUAL(folded, 0);
    galv_shape_free(shape);
}

/* The bound is sharp: slightly above it the first function folds the line at the centre plane. */
static void test_fold_bound_is_sharp(void)
{
    galv_sine function = {.order = {0, 1, 0}, .phase = {pi / 2, 0, pi / 2}, .direction = 1};
    double lower = -1, upper = 1, bound, xyz[6] = {3, 0, -0.1, 3, 1e-4, -0.1}, d[6];
    bool fixed;
    galv_shape *shape = NULL;
    CU_ASSERT_EQUAL_FATAL(galv_shape_sine(1, &function, &fixture_box, &lower, &upper,
                                          GALV_COMBINATION_RECURSIVE, &shape),
                          GALV_OK);
    CU_ASSERT_EQUAL(galv_shape_fold_bound(shape, &bound, &fixed), GALV_OK);
    double x = -1.001 * bound;
    galv_shape_displace(shape, 2, xyz, &x, d);
    CU_ASSERT_TRUE(xyz[4] + d[4] < 0);
    x = -0.999 * bound;
    galv_shape_displace(shape, 2, xyz, &x, d);
    CU_ASSERT_TRUE(xyz[4] + d[4] > 0);
    galv_shape_free(shape);
    function.phase[1] = 0.1;
    CU_ASSERT_EQUAL_FATAL(galv_shape_sine(1, &function, &fixture_box, &lower, &upper,
                                          GALV_COMBINATION_RECURSIVE, &shape),
                          GALV_OK);
    CU_ASSERT_EQUAL(galv_shape_fold_bound(shape, &bound, &fixed), GALV_OK);
    CU_ASSERT_FALSE(fixed);
    galv_shape_free(shape);
}

static void test_bad_shapes_are_named(void)
{
    galv_sine functions[2] = {{{1, 1, 1}, {0, 0, 0}, 1}, {{1, NAN, 1}, {0, 0, 0}, 1}};
    double lower[2] = {-1, -1}, upper[2] = {1, 1};
    galv_shape *shape = NULL;
    galv_box box = fixture_box;
    CU_ASSERT_EQUAL(
        galv_shape_sine(2, functions, &box, lower, upper, GALV_COMBINATION_LINEAR, &shape),
        GALV_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "function 1"));
    functions[1].order[1] = 1;
    functions[1].direction = 3;
    CU_ASSERT_EQUAL(
        galv_shape_sine(2, functions, &box, lower, upper, GALV_COMBINATION_LINEAR, &shape),
        GALV_ERROR_ARGUMENT);
    functions[1].direction = 0;
    box.length[2] = 0;
    CU_ASSERT_EQUAL(
        galv_shape_sine(2, functions, &box, lower, upper, GALV_COMBINATION_LINEAR, &shape),
        GALV_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "along z"));
    box.length[2] = 1;
    lower[1] = 2;
    CU_ASSERT_EQUAL(
        galv_shape_sine(2, functions, &box, lower, upper, GALV_COMBINATION_LINEAR, &shape),
        GALV_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "parameter 1"));
    lower[1] = -1;
    CU_ASSERT_EQUAL(
        galv_shape_sine(0, functions, &box, lower, upper, GALV_COMBINATION_LINEAR, &shape),
        GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(
        galv_shape_sine(2, functions, &box, lower, upper, GALV_COMBINATION_LINEAR, &shape),
        GALV_OK);
    double xyz[6] = {0, 0, 0, 0, INFINITY, 0}, d[6], x[2] = {0.1, 0.1}, bad[2] = {0.1, NAN};
    CU_ASSERT_EQUAL(galv_shape_displace(shape, 2, xyz, x, d), GALV_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "point 1"));
    CU_ASSERT_EQUAL(galv_shape_displace(shape, 1, xyz, bad, d), GALV_ERROR_ARGUMENT);
    xyz[0] = 1e9;
    CU_ASSERT_EQUAL(galv_shape_displace(shape, 1, xyz, x, d), GALV_ERROR_GEOMETRY);
    galv_shape_free(shape);
    galv_shape_free(NULL);
}

/* Far arguments are reduced exactly: order 1e5 at s = k/1e5 is an exact zero. */
static void test_high_orders(void)
{
    galv_sine function = {.order = {0, 4096, 0}, .phase = {pi / 2, 0, pi / 2}, .direction = 1};
    galv_box box = {{0, 0, 0}, {1, 1, 1}};
    double lower = 0, upper = 1, x = 1, d[3];
    galv_shape *shape = NULL;
    CU_ASSERT_EQUAL_FATAL(
        galv_shape_sine(1, &function, &box, &lower, &upper, GALV_COMBINATION_LINEAR, &shape),
        GALV_OK);
    for (int k = 0; k < 64; k++) {
        double on[3] = {0.5, k / 4096.0, 0.5}, between[3] = {0.5, (k + 0.5) / 4096, 0.5};
        galv_shape_displace(shape, 1, on, &x, d);
        CU_ASSERT_EQUAL(d[1], 0);
        galv_shape_displace(shape, 1, between, &x, d);
        CHECK_CLOSE(d[1], k % 2 ? -1 : 1, 1e-15);
    }
    galv_shape_free(shape);
}

static void test_box_around(void)
{
    const double points[] = {1, -2, 5, -3, 0.5, 4, 0, 0, 4.5};
    galv_box box;
    CU_ASSERT_EQUAL(galv_box_around(3, points, &box), GALV_OK);
    const double origin[] = {-3, -2, 4}, length[] = {4, 2.5, 1};
    for (int a = 0; a < 3; a++) {
        CU_ASSERT_EQUAL(box.origin[a], origin[a]);
        CU_ASSERT_EQUAL(box.length[a], length[a]);
    }
    const double flat[] = {0, 1, 0, 1, 1, 1}, broken[] = {0, 0, 0, 1, NAN, 1, 2, INFINITY, 2};
    CU_ASSERT_EQUAL(galv_box_around(2, flat, &box), GALV_ERROR_GEOMETRY);
    CU_ASSERT_EQUAL(galv_box_around(3, broken, &box), GALV_ERROR_GEOMETRY);
    CU_ASSERT_EQUAL(galv_box_around(0, points, &box), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_box_around(3, NULL, &box), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_box_around(3, points, NULL), GALV_ERROR_ARGUMENT);
}

static const struct check_case cases[] = {
    {"parameters as variables", test_parameters_as_variables},
    {"the box around points", test_box_around},
    {"sine products equal eqs. 16-17", test_sines_match_definition},
    {"any direction, order and phase", test_any_direction_and_phase},
    {"rows of a model equal single displacements", test_rows_match_single_displacements},
    {"parameters below the fold bound keep order", test_fold_bound_keeps_order},
    {"the fold bound is sharp", test_fold_bound_is_sharp},
    {"bad shapes are named", test_bad_shapes_are_named},
    {"high orders have exact zeros", test_high_orders},
};

CHECK_MAIN("galv shape", cases)
