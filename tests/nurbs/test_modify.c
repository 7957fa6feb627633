#include "check.h"
#include "reference.h"

#include <string.h>

/* Largest distance of two curves (surfaces) at 200 common random parameters, relative to size. */
static double curve_difference(const nurbs_curve *a, const nurbs_curve *b, double from, double to)
{
    uint64_t state = 31;
    double largest = 0.0;
    const double scale = scale_of(nurbs_curve_points(a), 3 * nurbs_curve_size(a));
    for (int k = 0; k < 200; k++) {
        const double u = k == 0 ? from : k == 1 ? to : from + (to - from) * random_unit(&state);
        double p[3], q[3];
        if (nurbs_curve_eval(a, 0, 1, &u, p) || nurbs_curve_eval(b, 0, 1, &u, q))
            return NAN;
        largest = fmax(largest, largest_difference(p, q, 3));
    }
    return largest / scale;
}

static double surface_difference(const nurbs_surface *a, const nurbs_surface *b)
{
    uint64_t state = 32;
    double largest = 0.0;
    const double scale =
        scale_of(nurbs_surface_points(a), 3 * nurbs_surface_size(a, 0) * nurbs_surface_size(a, 1));
    double from[2], to[2];
    for (int d = 0; d < 2; d++) {
        from[d] = nurbs_surface_knots(b, d)[0];
        to[d] = nurbs_surface_knots(b, d)[nurbs_surface_size(b, d)];
    }
    for (int k = 0; k < 200; k++) {
        double uv[2], p[3], q[3];
        for (int d = 0; d < 2; d++)
            uv[d] = k < 4 ? ((k >> d) & 1 ? to[d] : from[d])
                          : from[d] + (to[d] - from[d]) * random_unit(&state);
        if (nurbs_surface_eval(a, 0, 1, uv, p) || nurbs_surface_eval(b, 0, 1, uv, q))
            return NAN;
        largest = fmax(largest, largest_difference(p, q, 3));
    }
    return largest / scale;
}

static void same_curve(const nurbs_curve *actual, const nurbs_curve *expected, double tolerance)
{
    const size_t n = nurbs_curve_size(expected);
    const size_t knots = n + (size_t)nurbs_curve_degree(expected) + 1;
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_size(actual), n);
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_degree(actual), nurbs_curve_degree(expected));
    CU_ASSERT_EQUAL(
        largest_difference(nurbs_curve_knots(actual), nurbs_curve_knots(expected), knots), 0.0);
    CHECK_CLOSE(largest_difference(nurbs_curve_points(actual), nurbs_curve_points(expected), 3 * n),
                0.0, tolerance * scale_of(nurbs_curve_points(expected), 3 * n));
    CU_ASSERT_EQUAL(!nurbs_curve_weights(actual), !nurbs_curve_weights(expected));
    if (nurbs_curve_weights(expected))
        CHECK_CLOSE(
            largest_difference(nurbs_curve_weights(actual), nurbs_curve_weights(expected), n), 0.0,
            tolerance * scale_of(nurbs_curve_weights(expected), n));
}

static void same_surface(const nurbs_surface *actual, const nurbs_surface *expected,
                         double tolerance)
{
    for (int d = 0; d < 2; d++) {
        const size_t n = nurbs_surface_size(expected, d);
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_size(actual, d), n);
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_degree(actual, d), nurbs_surface_degree(expected, d));
        CU_ASSERT_EQUAL(largest_difference(nurbs_surface_knots(actual, d),
                                           nurbs_surface_knots(expected, d),
                                           n + (size_t)nurbs_surface_degree(expected, d) + 1),
                        0.0);
    }
    const size_t n = nurbs_surface_size(expected, 0) * nurbs_surface_size(expected, 1);
    CHECK_CLOSE(
        largest_difference(nurbs_surface_points(actual), nurbs_surface_points(expected), 3 * n),
        0.0, tolerance * scale_of(nurbs_surface_points(expected), 3 * n));
    CU_ASSERT_EQUAL(!nurbs_surface_weights(actual), !nurbs_surface_weights(expected));
    if (nurbs_surface_weights(expected))
        CHECK_CLOSE(
            largest_difference(nurbs_surface_weights(actual), nurbs_surface_weights(expected), n),
            0.0, tolerance * scale_of(nurbs_surface_weights(expected), n));
}

static void test_reference_curves(void)
{
    struct reference ref = reference_load();
    int inserted = 0, elevated = 0;
    for (size_t k = 0; k < json_array_size(ref.cases); k++) {
        json_t *c = json_array_get(ref.cases, k), *part;
        if (!reference_is(c, "curve"))
            continue;
        nurbs_curve *curve = reference_curve(c, c, 0), *result, *expected;
        if ((part = json_object_get(c, "insert"))) {
            size_t n;
            double *u = reference_numbers(json_object_get(part, "add"), &n);
            CU_ASSERT_EQUAL_FATAL(nurbs_curve_insert(curve, n, u, &result), NURBS_OK);
            expected = reference_curve(c, part, 0);
            same_curve(result, expected, 1e-12);
            nurbs_curve_free(result);
            nurbs_curve_free(expected);
            free(u);
            inserted++;
        }
        if ((part = json_object_get(c, "elevate"))) {
            const int by = (int)json_integer_value(json_array_get(json_object_get(part, "by"), 0));
            CU_ASSERT_EQUAL_FATAL(nurbs_curve_elevate(curve, by, &result), NURBS_OK);
            expected = reference_curve(c, part, by);
            same_curve(result, expected, 1e-12);
            nurbs_curve_free(result);
            nurbs_curve_free(expected);
            elevated++;
        }
        nurbs_curve_free(curve);
    }
    CU_ASSERT(inserted >= 20);
    CU_ASSERT(elevated >= 20);
    reference_free(&ref);
}

static nurbs_surface *insert_both(nurbs_surface *surface, json_t *add)
{
    for (int d = 0; d < 2; d++) {
        size_t n;
        double *u = reference_numbers(json_array_get(add, (size_t)d), &n);
        nurbs_surface *next;
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_insert(surface, d, n, u, &next), NURBS_OK);
        nurbs_surface_free(surface);
        surface = next;
        free(u);
    }
    return surface;
}

static void test_reference_surfaces(void)
{
    struct reference ref = reference_load();
    int inserted = 0, elevated = 0;
    for (size_t k = 0; k < json_array_size(ref.cases); k++) {
        json_t *c = json_array_get(ref.cases, k), *part;
        if (!reference_is(c, "surface"))
            continue;
        if ((part = json_object_get(c, "insert"))) {
            nurbs_surface *result =
                insert_both(reference_surface(c, c, 0), json_object_get(part, "add"));
            nurbs_surface *expected = reference_surface(c, part, 0);
            same_surface(result, expected, 1e-12);
            nurbs_surface_free(result);
            nurbs_surface_free(expected);
            inserted++;
        }
        if ((part = json_object_get(c, "elevate"))) {
            json_t *by = json_object_get(part, "by");
            const int by_u = (int)json_integer_value(json_array_get(by, 0));
            const int by_v = (int)json_integer_value(json_array_get(by, 1));
            CU_ASSERT_EQUAL_FATAL(by_u, by_v);
            nurbs_surface *surface = reference_surface(c, c, 0), *half, *result;
            nurbs_surface *expected = reference_surface(c, part, by_u);
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_elevate(surface, 0, by_u, &half), NURBS_OK);
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_elevate(half, 1, by_v, &result), NURBS_OK);
            same_surface(result, expected, 1e-12);
            nurbs_surface_free(surface);
            nurbs_surface_free(half);
            nurbs_surface_free(result);
            nurbs_surface_free(expected);
            elevated++;
        }
    }
    CU_ASSERT(inserted >= 15);
    CU_ASSERT(elevated >= 15);
    reference_free(&ref);
}

/* Degrees 1 to 9, double knots and spans of 1e-9: elevation by one and by three keeps the shape,
 * raises every multiplicity by exactly as much, and stays in the convex hull. */
static void test_elevation_keeps_the_shape(void)
{
    uint64_t state = 33;
    for (int p = 1; p <= 9; p++)
        for (int k = 0; k < 12; k++) {
            const size_t n = (size_t)(p + 1 + k);
            const int by = k % 2 ? 3 : 1;
            nurbs_curve *c = random_curve(&state, p, n, 1, k % 3 == 2), *e;
            CU_ASSERT_EQUAL_FATAL(nurbs_curve_elevate(c, by, &e), NURBS_OK);
            CHECK_CLOSE(curve_difference(c, e, 0.0, 1.0), 0.0, 1e-13);
            double b0[64], b1[64];
            int m0[64], m1[64];
            const size_t d0 = nurbs_knots_distinct(p, n, nurbs_curve_knots(c), b0, m0);
            const size_t d1 =
                nurbs_knots_distinct(p + by, nurbs_curve_size(e), nurbs_curve_knots(e), b1, m1);
            CU_ASSERT_EQUAL_FATAL(d0, d1);
            for (size_t i = 0; i < d0; i++) {
                CU_ASSERT_EQUAL(b0[i], b1[i]);
                CU_ASSERT_EQUAL(m1[i], m0[i] + by);
            }
            if (!nurbs_curve_weights(c))
                for (size_t i = 0; i < 3 * nurbs_curve_size(e); i++)
                    CU_ASSERT(fabs(nurbs_curve_points(e)[i]) <= 1.0 + 1e-14);
            nurbs_curve_free(c);
            nurbs_curve_free(e);
        }
}

/* A jump (knot of multiplicity degree + 1) survives insertion and elevation on both sides. */
static void test_discontinuity(void)
{
    const double knots[] = {0, 0, 0, 0.3, 0.5, 0.5, 0.5, 0.8, 1, 1, 1};
    double points[24];
    uint64_t state = 34;
    for (int i = 0; i < 24; i++)
        points[i] = random_unit(&state);
    nurbs_curve *c, *e, *r, *b;
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(2, 8, knots, points, NULL, &c), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_elevate(c, 2, &e), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_insert(c, 2, (const double[]){0.4, 0.6}, &r), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_to_bezier(c, &b), NURBS_OK);
    const nurbs_curve *const others[3] = {e, r, b};
    for (int k = 0; k < 3; k++) {
        CHECK_CLOSE(curve_difference(c, others[k], 0.0, 1.0), 0.0, 1e-14);
        const double u = 0.5;
        double left[2][3];
        nurbs_curve_eval_left(c, 0, 1, &u, left[0]);
        nurbs_curve_eval_left(others[k], 0, 1, &u, left[1]);
        CHECK_CLOSE(largest_difference(left[0], left[1], 3), 0.0, 1e-15);
    }
    nurbs_curve_free(c);
    nurbs_curve_free(e);
    nurbs_curve_free(r);
    nurbs_curve_free(b);
}

static void test_parts_splits_and_beziers(void)
{
    uint64_t state = 35;
    for (int k = 0; k < 24; k++) {
        const int p = 1 + k % 6;
        const size_t n = (size_t)p + 9;
        nurbs_curve *c = random_curve(&state, p, n, 1, k % 2), *part, *low, *high, *bezier;
        const double from = k % 3 ? 0.4 * random_unit(&state) : nurbs_curve_knots(c)[p + 2];
        const double to = k % 4 ? 0.6 + 0.4 * random_unit(&state) : nurbs_curve_knots(c)[p + 7];
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_part(c, from, to, &part), NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_curve_knots(part)[0], from);
        CU_ASSERT_EQUAL(nurbs_curve_knots(part)[nurbs_curve_size(part)], to);
        CHECK_CLOSE(curve_difference(c, part, from, to), 0.0, 1e-13);
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_split(c, from, &low, &high), NURBS_OK);
        CHECK_CLOSE(curve_difference(c, low, 0.0, from), 0.0, 1e-13);
        CHECK_CLOSE(curve_difference(c, high, from, 1.0), 0.0, 1e-13);
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_to_bezier(c, &bezier), NURBS_OK);
        CHECK_CLOSE(curve_difference(c, bezier, 0.0, 1.0), 0.0, 1e-13);
        double breaks[64];
        const size_t spans = nurbs_knots_distinct(p, n, nurbs_curve_knots(c), breaks, NULL) - 1;
        CU_ASSERT_EQUAL(nurbs_curve_size(bezier), spans * (size_t)p + 1);
        nurbs_curve_free(c);
        nurbs_curve_free(part);
        nurbs_curve_free(low);
        nurbs_curve_free(high);
        nurbs_curve_free(bezier);
    }
}

static void test_surface_parts(void)
{
    uint64_t state = 36;
    for (int rational = 0; rational < 2; rational++) {
        const int degree[2] = {3, 2};
        const size_t size[2] = {9, 8};
        nurbs_surface *s = random_surface(&state, degree, size, 1, rational), *half, *part, *r, *b;
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_part(s, 0, 0.2, 0.7, &half), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_part(half, 1, 0.1, 1.0, &part), NURBS_OK);
        CHECK_CLOSE(surface_difference(s, part), 0.0, 1e-13);
        nurbs_surface_free(half);
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_split(s, 1, 0.35, &half, &r), NURBS_OK);
        CHECK_CLOSE(surface_difference(s, half), 0.0, 1e-13);
        CHECK_CLOSE(surface_difference(s, r), 0.0, 1e-13);
        nurbs_surface_free(r);
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_to_bezier(part, &b), NURBS_OK);
        CHECK_CLOSE(surface_difference(part, b), 0.0, 1e-13);
        nurbs_surface_free(half);
        nurbs_surface_free(part);
        nurbs_surface_free(b);
        nurbs_surface_free(s);
    }
}

static void test_refine(void)
{
    uint64_t state = 37;
    const int degree[2] = {3, 2};
    const size_t size[2] = {7, 5};
    nurbs_surface *s = random_surface(&state, degree, size, 0, 1), *r;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_refine(s, 3, &r), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_size(r, 0), 7 + 4 * 2);
    CU_ASSERT_EQUAL(nurbs_surface_size(r, 1), 5 + 3 * 2);
    CHECK_CLOSE(surface_difference(s, r), 0.0, 1e-13);
    nurbs_surface_free(r);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_refine(s, 1, &r), NURBS_OK);
    same_surface(r, s, 1e-15);
    nurbs_surface_free(r);
    nurbs_surface_free(s);
}

static void test_reverse_and_swap(void)
{
    uint64_t state = 38;
    const int degree[2] = {3, 2};
    const size_t size[2] = {7, 5};
    nurbs_surface *s = random_surface(&state, degree, size, 0, 1), *r, *back;
    for (int d = 0; d < 3; d++) {
        CU_ASSERT_EQUAL_FATAL(d < 2 ? nurbs_surface_reverse(s, d, &r) : nurbs_surface_swap(s, &r),
                              NURBS_OK);
        for (int k = 0; k < 20; k++) {
            const double uv[2] = {random_unit(&state), random_unit(&state)};
            const double at[3][2] = {{1 - uv[0], uv[1]}, {uv[0], 1 - uv[1]}, {uv[1], uv[0]}};
            double p[3], q[3];
            nurbs_surface_eval(s, 0, 1, uv, p);
            nurbs_surface_eval(r, 0, 1, at[d], q);
            CHECK_CLOSE(largest_difference(p, q, 3), 0.0, 1e-14);
        }
        CU_ASSERT_EQUAL_FATAL(
            d < 2 ? nurbs_surface_reverse(r, d, &back) : nurbs_surface_swap(r, &back), NURBS_OK);
        CHECK_CLOSE(surface_difference(s, back), 0.0, 1e-14);
        nurbs_surface_free(r);
        nurbs_surface_free(back);
    }
    nurbs_surface_free(s);
    nurbs_curve *c = random_curve(&state, 4, 9, 1, 1), *cr, *cb;
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_reverse(c, &cr), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_reverse(cr, &cb), NURBS_OK);
    CHECK_CLOSE(curve_difference(c, cb, 0.0, 1.0), 0.0, 1e-6); /* 1e-9 spans move by rounding */
    const double u = 0.3, w = 0.7;
    double p[3], q[3];
    nurbs_curve_eval(c, 0, 1, &u, p);
    nurbs_curve_eval(cr, 0, 1, &w, q);
    CHECK_CLOSE(largest_difference(p, q, 3), 0.0, 1e-13);
    nurbs_curve_free(c);
    nurbs_curve_free(cr);
    nurbs_curve_free(cb);
}

/* Evaluation commutes with an affine map, also of rational surfaces. */
static void test_affine_invariance(void)
{
    uint64_t state = 39;
    const int degree[2] = {3, 3};
    const size_t size[2] = {6, 8};
    const double m[9] = {1, 2, 0, -1, 0.5, 3, 0, 0.25, 1}, b[3] = {5, -6, 7};
    for (int rational = 0; rational < 2; rational++) {
        nurbs_surface *s = random_surface(&state, degree, size, 1, rational), *t;
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(s, m, b, &t), NURBS_OK);
        for (int k = 0; k < 50; k++) {
            const double uv[2] = {random_unit(&state), random_unit(&state)};
            double p[3], q[3];
            nurbs_surface_eval(s, 0, 1, uv, p);
            nurbs_surface_eval(t, 0, 1, uv, q);
            for (int x = 0; x < 3; x++)
                CHECK_CLOSE(q[x],
                            m[3 * x] * p[0] + m[3 * x + 1] * p[1] + m[3 * x + 2] * p[2] + b[x],
                            1e-13);
        }
        nurbs_surface_free(s);
        nurbs_surface_free(t);
    }
}

static void test_iso_curves(void)
{
    uint64_t state = 40;
    const int degree[2] = {3, 4};
    const size_t size[2] = {7, 9};
    for (int k = 0; k < 4; k++) {
        nurbs_surface *s = random_surface(&state, degree, size, 1, k % 2);
        const int d = k / 2;
        for (int j = 0; j < 4; j++) {
            const double value = j == 0 ? 0.0 : j == 1 ? 1.0 : random_unit(&state);
            nurbs_curve *c;
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_iso_curve(s, d, value, &c), NURBS_OK);
            for (int i = 0; i < 20; i++) {
                const double t = random_unit(&state), uv[2] = {d ? t : value, d ? value : t};
                double p[3], q[3];
                nurbs_surface_eval(s, 0, 1, uv, p);
                nurbs_curve_eval(c, 0, 1, &t, q);
                CHECK_CLOSE(largest_difference(p, q, 3), 0.0, 1e-14);
            }
            nurbs_curve_free(c);
        }
        nurbs_surface_free(s);
    }
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
    uint64_t state = 41;
    const int degree[2] = {3, 3};
    const size_t size[2] = {6, 6};
    nurbs_surface *s = random_surface(&state, degree, size, 0, 0), *r, *low;
    nurbs_curve *c = random_curve(&state, 2, 5, 0, 0), *q;
    refused(nurbs_curve_insert(c, 1, (const double[]){0.0}, &q), "knot 0 to insert");
    refused(nurbs_curve_insert(c, 1, (const double[]){NAN}, &q), "nan");
    refused(nurbs_curve_insert(c, 2, (const double[]){0.5, 0.4}, &q), "decreases");
    refused(nurbs_curve_insert(c, 3, (const double[]){0.5, 0.5, 0.5}, &q), "multiplicity 3");
    CU_ASSERT_PTR_NULL(q);
    refused(nurbs_curve_elevate(c, 24, &q), "raised by 24");
    refused(nurbs_curve_elevate(c, -1, &q), "raised by -1");
    refused(nurbs_curve_part(c, 0.5, 0.5, &q), "increasing pair");
    refused(nurbs_curve_part(c, NAN, 0.5, &q), "increasing pair");
    refused(nurbs_surface_insert(s, 2, 0, NULL, &r), "direction is 2");
    refused(nurbs_surface_insert(s, 1, 1, (const double[]){1.5}, &r), "1.5");
    refused(nurbs_surface_insert(s, 1, 1, NULL, &r), "NULL");
    refused(nurbs_surface_refine(s, 0, &r), "0 parts");
    refused(nurbs_surface_part(s, 0, -1.0, 0.5, &r), "part from -1");
    refused(nurbs_surface_split(s, 0, 1.0, &low, &r), "part from 1");
    CU_ASSERT_PTR_NULL(low);
    refused(nurbs_surface_transform(s, NULL, (const double[]){0, NAN, 0}, &r), "shift entry 1");
    refused(nurbs_surface_iso_curve(s, 0, 2.0, &q), "u = 2");
    refused(nurbs_surface_swap(NULL, &r), "surface is NULL");
    nurbs_curve_free(c);
    nurbs_surface_free(s);
}

static const struct check_case cases[] = {
    {"reference insertion and elevation of curves", test_reference_curves},
    {"reference insertion and elevation of surfaces", test_reference_surfaces},
    {"elevation keeps the shape", test_elevation_keeps_the_shape},
    {"a jump survives", test_discontinuity},
    {"parts, splits and Bezier segments", test_parts_splits_and_beziers},
    {"parts of surfaces", test_surface_parts},
    {"refinement", test_refine},
    {"reverse and swap", test_reverse_and_swap},
    {"affine invariance", test_affine_invariance},
    {"iso-curves", test_iso_curves},
    {"bad input is named", test_bad_input_is_named},
};

CHECK_MAIN("modify", cases)
