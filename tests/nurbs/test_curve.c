#include "check.h"
#include "reference.h"

#include <string.h>

static void compare(const json_t *c, const char *key, const double *out, size_t stride,
                    double tolerance)
{
    size_t n;
    const json_t *e = json_object_get(json_object_get(c, "eval"), key);
    double *expected = reference_points(e, (int)json_integer_value(json_object_get(c, "dim")), &n);
    double largest = 0.0;
    for (size_t i = 0; i < n; i++)
        largest = fmax(largest, largest_difference(out + i * stride, expected + 3 * i, 3));
    const double limit = tolerance * scale_of(expected, 3 * n);
    if (!(largest <= limit))
        fprintf(stderr, "%s %s:\n", reference_id(c), key);
    CHECK_CLOSE(largest, 0.0, limit);
    free(expected);
}

static void test_reference(void)
{
    struct reference ref = reference_load();
    int compared = 0;
    for (size_t k = 0; k < json_array_size(ref.cases); k++) {
        json_t *c = json_array_get(ref.cases, k);
        if (!reference_is(c, "curve"))
            continue;
        nurbs_curve *curve = reference_curve(c, c, 0);
        size_t n;
        double *t = reference_numbers(json_object_get(json_object_get(c, "eval"), "t"), &n);
        double *out = malloc(9 * n * sizeof *out);
        CU_ASSERT_PTR_NOT_NULL_FATAL(out);
        CU_ASSERT_EQUAL(nurbs_curve_eval(curve, 2, n, t, out), NURBS_OK);
        compare(c, "S", out, 9, 1e-13);
        compare(c, "D1", out + 3, 9, 1e-12);
        compare(c, "D2", out + 6, 9, 1e-11);
        compared++;
        free(out);
        free(t);
        nurbs_curve_free(curve);
    }
    CU_ASSERT_EQUAL(compared, 24);
    reference_free(&ref);
}

/* Third and fourth derivatives against divided differences of the next lower order. */
static void test_higher_derivatives(void)
{
    uint64_t state = 11;
    for (int rational = 0; rational < 2; rational++) {
        nurbs_curve *curve = random_curve(&state, 5, 9, 0, rational);
        const double h = 1e-5;
        for (int k = 0; k < 20; k++) {
            const double u =
                nurbs_curve_knots(curve)[5 + k % 4] + 0.02 + 0.03 * random_unit(&state);
            double at[3][18];
            const double t[3] = {u - h, u, u + h};
            CU_ASSERT_EQUAL(nurbs_curve_eval(curve, 5, 3, t, at[0]), NURBS_OK);
            for (int order = 3; order <= 5; order++)
                for (int x = 0; x < 3; x++) {
                    const double slope =
                        (at[2][3 * (order - 1) + x] - at[0][3 * (order - 1) + x]) / (2.0 * h);
                    CHECK_CLOSE(at[1][3 * order + x], slope, 1e-5 * scale_of(at[1], 18));
                }
        }
        nurbs_curve_free(curve);
    }
}

/* A kink: the two limits of the slope differ, the point does not. */
static void test_limits_at_a_kink(void)
{
    const double knots[] = {0, 0, 0.5, 1, 1}, points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0};
    nurbs_curve *curve;
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(1, 3, knots, points, NULL, &curve), NURBS_OK);
    const double u = 0.5;
    double right[6], left[6];
    nurbs_curve_eval(curve, 1, 1, &u, right);
    nurbs_curve_eval_left(curve, 1, 1, &u, left);
    CU_ASSERT_EQUAL(largest_difference(right, left, 3), 0.0);
    const double slopes[2][3] = {{0, 2, 0}, {2, 0, 0}};
    CU_ASSERT_EQUAL(largest_difference(right + 3, slopes[0], 3), 0.0);
    CU_ASSERT_EQUAL(largest_difference(left + 3, slopes[1], 3), 0.0);
    const double ends[2] = {0.0, 1.0};
    double both[2][12];
    nurbs_curve_eval(curve, 1, 2, ends, both[0]);
    nurbs_curve_eval_left(curve, 1, 2, ends, both[1]);
    CU_ASSERT_EQUAL(largest_difference(both[0], both[1], 12), 0.0);
    nurbs_curve_free(curve);
}

static void test_accessors_and_copy(void)
{
    uint64_t state = 12;
    nurbs_curve *curve = random_curve(&state, 4, 8, 1, 1), *copy;
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_copy(curve, &copy), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_curve_degree(copy), 4);
    CU_ASSERT_EQUAL(nurbs_curve_size(copy), 8);
    CU_ASSERT_EQUAL(largest_difference(nurbs_curve_knots(copy), nurbs_curve_knots(curve), 13), 0.0);
    CU_ASSERT_EQUAL(largest_difference(nurbs_curve_points(copy), nurbs_curve_points(curve), 24),
                    0.0);
    CU_ASSERT_EQUAL(largest_difference(nurbs_curve_weights(copy), nurbs_curve_weights(curve), 8),
                    0.0);
    nurbs_curve_free(curve);
    nurbs_curve_free(copy);
    nurbs_curve_free(NULL);
}

static void refused(nurbs_status status, const char *word)
{
    CU_ASSERT_EQUAL(status, NURBS_ERROR_ARGUMENT);
    if (!strstr(nurbs_last_error(), word))
        fprintf(stderr, "'%s' does not name '%s'\n", nurbs_last_error(), word);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), word));
}

static void test_bad_input_is_named(void)
{
    const double knots[] = {0, 0, 0.5, 1, 1}, points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0};
    const double bad[] = {0, 0, 0, 1, NAN, 0, 1, 1, 0}, huge[] = {1e308, 0, 0, 0, 0, 0, 0, 0, 0};
    nurbs_curve *curve;
    refused(nurbs_curve_create(1, 3, knots, bad, NULL, &curve), "control point 1 has y");
    CU_ASSERT_PTR_NULL(curve);
    refused(nurbs_curve_create(1, 3, knots, NULL, NULL, &curve), "points");
    refused(nurbs_curve_create(1, 3, NULL, points, NULL, &curve), "knots");
    refused(nurbs_curve_create(1, 0, knots, points, NULL, &curve), "0 control points");
    refused(nurbs_curve_create(1, 3, knots, points, (const double[]){1, 0, 1}, &curve),
            "weight 1 is 0");
    refused(nurbs_curve_create(1, 3, knots, points, (const double[]){1, 1, NAN}, &curve),
            "weight 2 is nan");
    refused(nurbs_curve_create(1, 3, knots, huge, (const double[]){10, 1, 1}, &curve),
            "control point 0 times its weight");
    refused(nurbs_curve_create(1, 3, knots, points, NULL, NULL), "curve is NULL");
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(1, 3, knots, points, NULL, &curve), NURBS_OK);
    double out[200], u[2] = {0.2, 1.5};
    refused(nurbs_curve_eval(curve, 0, 2, u, out), "parameter 1 is 1.5");
    u[1] = NAN;
    refused(nurbs_curve_eval(curve, 0, 2, u, out), "parameter 1 is nan");
    refused(nurbs_curve_eval(curve, -1, 1, u, out), "order is -1");
    refused(nurbs_curve_eval(curve, 51, 1, u, out), "order is 51");
    refused(nurbs_curve_eval(curve, 0, 1, NULL, out), "u is NULL");
    refused(nurbs_curve_eval(NULL, 0, 1, u, out), "curve is NULL");
    nurbs_curve_free(curve);
}

static const struct check_case cases[] = {
    {"reference points and derivatives", test_reference},
    {"derivatives above the second", test_higher_derivatives},
    {"limits at a kink", test_limits_at_a_kink},
    {"accessors and copy", test_accessors_and_copy},
    {"bad input is named", test_bad_input_is_named},
};

CHECK_MAIN("curve", cases)
