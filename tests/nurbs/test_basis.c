#include "check.h"
#include "reference.h"

#include <string.h>

/* Span, partition of unity, non-negativity and the end values, at every degree, with double knots
 * and spans of 1e-9. */
static void test_partition_of_unity(void)
{
    uint64_t state = 1;
    for (int p = 0; p <= NURBS_MAX_DEGREE; p++) {
        double knots[128], values[3 * (NURBS_MAX_DEGREE + 1)];
        const size_t n = (size_t)p + 12;
        random_knots(&state, p, n, p > 0, knots);
        CU_ASSERT_EQUAL_FATAL(nurbs_knots_check(p, n, knots), NURBS_OK);
        for (int k = 0; k < 400; k++) {
            const double u = k == 0   ? 0.0
                             : k == 1 ? 1.0
                             : k < 14 ? knots[p + k - 2]
                                      : random_unit(&state);
            const size_t s = nurbs_basis_span(p, n, knots, u, NULL);
            CU_ASSERT(s >= (size_t)p && s < n && knots[s] < knots[s + 1]);
            CU_ASSERT(knots[s] <= u && (u < knots[s + 1] || (u == 1.0 && s == n - 1)));
            nurbs_basis_derivatives(p, knots, s, u, 2, values);
            double sum = 0.0, slope = 0.0, size = 1.0;
            for (int r = 0; r <= p; r++) {
                CU_ASSERT(values[r] >= 0.0);
                sum += values[r];
                slope += values[p + 1 + r];
                size = fmax(size, fabs(values[p + 1 + r]));
            }
            CHECK_CLOSE(sum, 1.0, 1e-14);
            CHECK_CLOSE(slope, 0.0, 1e-13 * size);
            if (u == 1.0)
                CU_ASSERT_EQUAL(values[p], 1.0);
            if (u == 0.0)
                CU_ASSERT_EQUAL(values[0], 1.0);
        }
    }
}

/* Derivatives of every order against the recursion N' = p (N_i / .. - N_{i+1} / ..) applied to the
 * next lower order of the whole row of lower-degree functions. */
static void test_derivatives_of_any_order(void)
{
    uint64_t state = 2;
    for (int p = 1; p <= 9; p++) {
        double knots[64], high[11 * 10], low[10 * 10];
        const size_t n = (size_t)p + 7;
        random_knots(&state, p, n, 0, knots);
        for (int k = 0; k < 20; k++) {
            const double u = random_unit(&state);
            const size_t s = nurbs_basis_span(p, n, knots, u, NULL);
            nurbs_basis_derivatives(p, knots, s, u, p, high);
            nurbs_basis_derivatives(p - 1, knots, s, u, p - 1, low);
            for (int order = 1; order <= p; order++)
                for (int r = 0; r <= p; r++) {
                    const double *t = knots + s - (size_t)p + (size_t)r;
                    const double *row = low + (order - 1) * p;
                    const double before = r > 0 ? p * row[r - 1] / (t[p] - t[0]) : 0.0;
                    const double after = r < p ? p * row[r] / (t[p + 1] - t[1]) : 0.0;
                    CHECK_CLOSE(high[order * (p + 1) + r], before - after,
                                1e-13 * fmax(1.0, fabs(before) + fabs(after)));
                }
        }
        nurbs_basis_derivatives(p, knots, (size_t)p, 0.0, p + 1, high);
        for (int r = 0; p < 9 && r <= p; r++)
            CU_ASSERT_EQUAL(high[(p + 1) * (p + 1) + r], 0.0);
    }
}

static void test_span_hint(void)
{
    uint64_t state = 3;
    double knots[64];
    const size_t n = 30;
    random_knots(&state, 3, n, 1, knots);
    size_t hint = 999;
    double u = 0.0;
    for (int k = 0; k < 3000; k++) {
        u = k % 5 == 0 ? random_unit(&state)
                       : fmin(1.0, fmax(0.0, u + 0.1 * (random_unit(&state) - 0.5)));
        const size_t expected = nurbs_basis_span(3, n, knots, u, NULL);
        CU_ASSERT_EQUAL(nurbs_basis_span(3, n, knots, u, &hint), expected);
        CU_ASSERT_EQUAL(hint, expected);
    }
    CU_ASSERT_EQUAL(nurbs_basis_span(3, n, knots, -5.0, &hint), 3);
    CU_ASSERT_EQUAL(nurbs_basis_span(3, n, knots, 7.0, &hint), n - 1);
}

static void test_greville_of_reference(void)
{
    struct reference ref = reference_load();
    int compared = 0;
    for (size_t k = 0; k < json_array_size(ref.cases); k++) {
        json_t *c = json_array_get(ref.cases, k), *g = json_object_get(c, "greville");
        for (size_t d = 0; d < json_array_size(g); d++) {
            size_t n;
            double *expected = reference_numbers(json_array_get(g, d), &n), actual[64];
            double *knots = reference_numbers(json_array_get(json_object_get(c, "knots"), d), NULL);
            const int degree =
                (int)json_integer_value(json_array_get(json_object_get(c, "degree"), d));
            nurbs_greville(degree, n, knots, actual);
            CHECK_CLOSE(largest_difference(actual, expected, n), 0.0,
                        1e-15 * scale_of(expected, n));
            compared++;
            free(expected);
            free(knots);
        }
    }
    CU_ASSERT(compared >= 60);
    reference_free(&ref);
}

static void test_distinct_knots(void)
{
    const double knots[] = {0, 0, 0, 0, 0.5, 0.5, 0.7, 1, 1, 1, 1};
    double breaks[5];
    int multiplicities[5];
    CU_ASSERT_EQUAL_FATAL(nurbs_knots_distinct(3, 7, knots, breaks, multiplicities), 4);
    const double expected[] = {0, 0.5, 0.7, 1};
    const int expected_multiplicities[] = {4, 2, 1, 4};
    for (int i = 0; i < 4; i++) {
        CU_ASSERT_EQUAL(breaks[i], expected[i]);
        CU_ASSERT_EQUAL(multiplicities[i], expected_multiplicities[i]);
    }
    CU_ASSERT_EQUAL(nurbs_knots_distinct(3, 7, knots, breaks, NULL), 4);
}

static void test_merging_knots(void)
{
    const double third = 1.0 / 3.0;
    double knots[] = {0,   0,          0,          0,          1e-9, third, third + 5e-17,
                      0.5, 0.5 + 2e-9, 0.5 + 3e-9, 0.5 + 4e-9, 0.9,  1,     1,
                      1,   1};
    CU_ASSERT_EQUAL(nurbs_knots_merge(3, 12, knots, 0.0), 0);
    CU_ASSERT(nurbs_knots_merge(3, 12, knots, 1e-8) >= 3);
    CU_ASSERT_EQUAL(knots[4], 1e-9); /* beside an end: stays */
    CU_ASSERT_EQUAL(knots[5], knots[6]);
    CHECK_CLOSE(knots[5], third, 1e-16);
    CU_ASSERT_EQUAL(knots[7], knots[9]); /* at most degree copies */
    CHECK_CLOSE(knots[7], 0.5 + 5e-9 / 3.0, 1e-15);
    CU_ASSERT_EQUAL(knots[10], 0.5 + 4e-9);
    CU_ASSERT_EQUAL(knots[11], 0.9);
    CU_ASSERT_EQUAL(nurbs_knots_check(3, 12, knots), NURBS_OK);
}

static void expect_refused(int degree, size_t n, const double *knots, const char *word)
{
    CU_ASSERT_EQUAL(nurbs_knots_check(degree, n, knots), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), word));
}

static void test_bad_knots_are_named(void)
{
    const double good[] = {0, 0, 0, 0.5, 1, 1, 1};
    CU_ASSERT_EQUAL(nurbs_knots_check(2, 4, good), NURBS_OK);
    expect_refused(-1, 4, good, "degree is -1");
    expect_refused(NURBS_MAX_DEGREE + 1, 100, good, "degree is 26");
    expect_refused(2, 2, good, "2 control points");
    expect_refused(2, 0, good, "0 control points");
    expect_refused(2, 4, NULL, "NULL");
    expect_refused(2, 4, (const double[]){0, 0, 0, NAN, 1, 1, 1}, "knot 3 is nan");
    expect_refused(2, 4, (const double[]){0, 0, 0, 0.5, 1, 1, INFINITY}, "knot 6 is inf");
    expect_refused(2, 5, (const double[]){0, 0, 0, 0.5, 0.4, 1, 1, 1}, "knot 4 decreases");
    expect_refused(2, 4, (const double[]){0, 0, 0.1, 0.5, 1, 1, 1}, "first 3 knots differ");
    expect_refused(2, 4, (const double[]){0, 0, 0, 0.5, 0.9, 1, 1}, "last 3 knots differ");
    expect_refused(2, 4, (const double[]){0, 0, 0, 0, 1, 1, 1}, "multiplicity above 3");
    expect_refused(2, 4, (const double[]){0, 0, 0, 1, 1, 1, 1}, "multiplicity above 3");
    expect_refused(2, 3, (const double[]){0, 0, 0, 0, 0, 0}, "multiplicity above 3");
    expect_refused(1, 2, (const double[]){0, 0, 1e-320, 1e-320}, "too little to divide");
    expect_refused(1, 2, (const double[]){-1.7e308, -1.7e308, 1.7e308, 1.7e308},
                   "no usable length");
}

/* The n-point rule integrates x^k on [0,1] exactly up to k = 2n - 1. */
static void test_gauss_legendre(void)
{
    for (size_t n = 1; n <= 64; n++) {
        double nodes[64], weights[64];
        CU_ASSERT_EQUAL_FATAL(nurbs_gauss_legendre(n, nodes, weights), NURBS_OK);
        for (size_t k = 0; k < 2 * n; k++) {
            double sum = 0.0;
            for (size_t i = 0; i < n; i++)
                sum += weights[i] * pow(nodes[i], (double)k);
            CHECK_CLOSE(sum, 1.0 / (double)(k + 1), 2e-15);
        }
        for (size_t i = 0; i + 1 < n; i++)
            CU_ASSERT(nodes[i] < nodes[i + 1]);
    }
    double node, weight;
    CU_ASSERT_EQUAL(nurbs_gauss_legendre(0, &node, &weight), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_gauss_legendre(65, &node, &weight), NURBS_ERROR_ARGUMENT);
}

static const struct check_case cases[] = {
    {"partition of unity, non-negative, exact ends", test_partition_of_unity},
    {"derivatives of any order", test_derivatives_of_any_order},
    {"span with a hint", test_span_hint},
    {"Greville abscissae of the reference cases", test_greville_of_reference},
    {"distinct knots", test_distinct_knots},
    {"merging knots", test_merging_knots},
    {"bad knot vectors are named", test_bad_knots_are_named},
    {"Gauss-Legendre rules", test_gauss_legendre},
};

CHECK_MAIN("basis", cases)
