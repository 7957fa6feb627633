#include "check.h"
#include "reference.h"

#include <string.h>

static const char *const triples[6] = {"S", "Su", "Sv", "Suu", "Suv", "Svv"};
static const double tolerances[6] = {1e-13, 1e-12, 1e-12, 1e-11, 1e-11, 1e-11};

static void test_reference(void)
{
    struct reference ref = reference_load();
    int compared = 0;
    for (size_t k = 0; k < json_array_size(ref.cases); k++) {
        json_t *c = json_array_get(ref.cases, k), *eval = json_object_get(c, "eval");
        if (!reference_is(c, "surface"))
            continue;
        nurbs_surface *surface = reference_surface(c, c, 0);
        size_t n;
        double *uv = reference_numbers(json_object_get(eval, "uv"), &n);
        n /= 2;
        double *out = malloc(18 * n * sizeof *out);
        CU_ASSERT_PTR_NOT_NULL_FATAL(out);
        CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 2, n, uv, out), NURBS_OK);
        for (size_t t = 0; t < 6; t++) {
            double *expected = reference_numbers(json_object_get(eval, triples[t]), NULL);
            const double limit = tolerances[t] * scale_of(expected, 3 * n);
            for (size_t i = 0; i < n; i++)
                CHECK_CLOSE(largest_difference(out + 18 * i + 3 * t, expected + 3 * i, 3), 0.0,
                            limit);
            free(expected);
        }
        compared++;
        free(out);
        free(uv);
        nurbs_surface_free(surface);
    }
    CU_ASSERT_EQUAL(compared, 22);
    reference_free(&ref);
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Every order and the grid form give the same numbers as second order at scattered points, for
 * cubic and other degrees, polynomial and rational, knots among the parameters. */
static void test_grid_and_orders_agree(void)
{
    uint64_t state = 21;
    const int degrees[4][2] = {{3, 3}, {2, 5}, {1, 1}, {9, 3}};
    for (int k = 0; k < 8; k++) {
        const size_t size[2] = {14, 12};
        nurbs_surface *s = random_surface(&state, degrees[k / 2], size, 1, k % 2);
        enum { NU = 23, NV = 150 };
        double u[NU], v[NV], *uv = malloc(2 * NU * NV * sizeof *uv);
        double *full = malloc(18 * NU * NV * sizeof *full),
               *out = malloc(18 * NU * NV * sizeof *out);
        CU_ASSERT_FATAL(uv && full && out);
        for (size_t i = 0; i < NU; i++)
            u[i] = (double)i / (NU - 1);
        for (size_t j = 0; j < NV; j++)
            v[j] =
                j < NV / 2 ? 0.4 * (double)j / NV : 0.2 + 0.8 * (double)(j - NV / 2) / (NV / 2 - 1);
        v[40] = v[41] = nurbs_surface_knots(s, 1)[nurbs_surface_degree(s, 1) + 1];
        qsort(v, NV, sizeof *v, ascending);
        for (size_t i = 0; i < NU * NV; i++) {
            uv[2 * i] = u[i / NV];
            uv[2 * i + 1] = v[i % NV];
        }
        CU_ASSERT_EQUAL(nurbs_surface_eval(s, 2, NU * NV, uv, full), NURBS_OK);
        const double scale = scale_of(full, 18 * NU * NV);
        for (int order = 0; order <= 2; order++) {
            const size_t count = 3 * (size_t)NURBS_SURFACE_TRIPLES(order);
            CU_ASSERT_EQUAL(nurbs_surface_eval(s, order, NU * NV, uv, out), NURBS_OK);
            for (size_t i = 0; i < NU * NV; i++)
                CHECK_CLOSE(largest_difference(out + count * i, full + 18 * i, count), 0.0,
                            1e-13 * scale);
            CU_ASSERT_EQUAL(nurbs_surface_eval_grid(s, order, NU, u, NV, v, out), NURBS_OK);
            for (size_t i = 0; i < NU * NV; i++)
                CHECK_CLOSE(largest_difference(out + count * i, full + 18 * i, count), 0.0,
                            1e-13 * scale);
        }
        free(uv);
        free(full);
        free(out);
        nurbs_surface_free(s);
    }
}

/* The rows of nurbs_surface_basis times the control points are the point and its derivatives. */
static void test_basis_rows(void)
{
    uint64_t state = 22;
    for (int rational = 0; rational < 2; rational++) {
        const int degree[2] = {3, 4};
        const size_t size[2] = {7, 9};
        nurbs_surface *s = random_surface(&state, degree, size, 0, rational);
        for (int k = 0; k < 50; k++) {
            const double uv[2] = {random_unit(&state), random_unit(&state)};
            double values[6 * 20], out[18];
            size_t span[2];
            CU_ASSERT_EQUAL(nurbs_surface_basis(s, 2, uv[0], uv[1], span, values), NURBS_OK);
            nurbs_surface_eval(s, 2, 1, uv, out);
            for (size_t t = 0; t < 6; t++)
                for (size_t x = 0; x < 3; x++) {
                    double sum = 0.0;
                    for (size_t a = 0; a < 4; a++)
                        for (size_t b = 0; b < 5; b++)
                            sum += values[t * 20 + a * 5 + b] *
                                   nurbs_surface_points(
                                       s)[3 * ((span[0] - 3 + a) * 9 + span[1] - 4 + b) + x];
                    CHECK_CLOSE(sum, out[3 * t + x], 1e-13 * scale_of(out, 18));
                }
        }
        nurbs_surface_free(s);
    }
}

/* Moving one control point moves S, Su ... Svv by the row's entries; moving one weight moves S by
 * R (P - S) / w. */
static void test_rows_are_derivatives(void)
{
    uint64_t state = 24;
    const int degree[2] = {3, 2};
    const size_t size[2] = {7, 6};
    nurbs_surface *s = random_surface(&state, degree, size, 0, 1), *moved;
    double uv[6] = {0.21, 0.63, 0.5, 0.5, 1.0, 0.0}, values[3 * 6 * 12], p[18], q[18];
    size_t columns[3 * 12];
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_rows(s, 2, 3, uv, columns, values), NURBS_OK);
    for (size_t i = 0; i < 3; i++)
        for (size_t c = 0; c < 12; c++) {
            double points[3 * 42], weights[42];
            const size_t at = columns[12 * i + c];
            memcpy(points, nurbs_surface_points(s), sizeof points);
            memcpy(weights, nurbs_surface_weights(s), sizeof weights);
            points[3 * at + 1] += 1.0;
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, nurbs_surface_knots(s, 0),
                                                       nurbs_surface_knots(s, 1), points, weights,
                                                       &moved),
                                  NURBS_OK);
            nurbs_surface_eval(s, 2, 1, uv + 2 * i, p);
            nurbs_surface_eval(moved, 2, 1, uv + 2 * i, q);
            for (size_t t = 0; t < 6; t++) {
                CHECK_CLOSE(q[3 * t + 1] - p[3 * t + 1], values[(6 * i + t) * 12 + c],
                            1e-13 * scale_of(p, 18));
                CHECK_CLOSE(q[3 * t], p[3 * t], 1e-13 * scale_of(p, 18));
            }
            nurbs_surface_free(moved);
            const double step = 1e-6;
            points[3 * at + 1] -= 1.0;
            weights[at] += step;
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, nurbs_surface_knots(s, 0),
                                                       nurbs_surface_knots(s, 1), points, weights,
                                                       &moved),
                                  NURBS_OK);
            nurbs_surface_eval(moved, 0, 1, uv + 2 * i, q);
            for (size_t x = 0; x < 3; x++)
                CHECK_CLOSE((q[x] - p[x]) / step,
                            values[6 * i * 12 + c] * (points[3 * at + x] - p[x]) /
                                nurbs_surface_weights(s)[at],
                            1e-5);
            nurbs_surface_free(moved);
        }
    uv[3] = 2.0;
    CU_ASSERT_EQUAL(nurbs_surface_rows(s, 2, 3, uv, columns, values), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "parameter 1 has v = 2"));
    nurbs_surface_free(s);
}

/* Limits from both sides at a knot where the slope in u jumps. */
static void test_limits(void)
{
    const int degree[2] = {1, 1};
    const size_t size[2] = {3, 2};
    const double ku[] = {0, 0, 0.5, 1, 1}, kv[] = {0, 0, 1, 1};
    const double points[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1};
    nurbs_surface *s;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, ku, kv, points, NULL, &s), NURBS_OK);
    const double uv[2] = {0.5, 0.25};
    double right[9], left[9];
    nurbs_surface_eval(s, 1, 1, uv, right);
    nurbs_surface_eval_sided(s, 1, 1, 1, uv, left);
    const double expected[2][9] = {{1, 0.25, 0, 0, 0, 2, 0, 1, 0}, {1, 0.25, 0, 2, 0, 0, 0, 1, 0}};
    CU_ASSERT_EQUAL(largest_difference(right, expected[0], 9), 0.0);
    CU_ASSERT_EQUAL(largest_difference(left, expected[1], 9), 0.0);
    nurbs_surface_free(s);
}

/* A zero coordinate of a whole edge stays zero to the last bit. */
static void test_edge_plane_is_exact(void)
{
    uint64_t state = 23;
    const int degree[2] = {3, 3};
    const size_t size[2] = {11, 8};
    nurbs_surface *r = random_surface(&state, degree, size, 0, 0), *s;
    double points[3 * 11 * 8];
    memcpy(points, nurbs_surface_points(r), sizeof points);
    for (size_t i = 0; i < 11; i++) {
        points[3 * (8 * i) + 2] = 0.0;
        points[3 * (8 * i + 7) + 1] = 0.0;
    }
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, nurbs_surface_knots(r, 0),
                                               nurbs_surface_knots(r, 1), points, NULL, &s),
                          NURBS_OK);
    for (int k = 0; k < 100; k++) {
        const double uv[4] = {random_unit(&state), 0.0, random_unit(&state), 1.0};
        double out[6];
        nurbs_surface_eval(s, 0, 2, uv, out);
        CU_ASSERT_EQUAL(out[2], 0.0);
        CU_ASSERT_EQUAL(out[4], 0.0);
    }
    nurbs_surface_free(r);
    nurbs_surface_free(s);
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
    const int degree[2] = {1, 1}, point_degree[2] = {0, 1};
    const size_t size[2] = {2, 2}, empty[2] = {2, 0};
    const double k[] = {0, 0, 1, 1}, down[] = {1, 1, 0, 0};
    const double points[12] = {0}, bad[12] = {0, 0, 0, 0, 0, INFINITY};
    nurbs_surface *s;
    refused(nurbs_surface_create(degree, size, k, down, points, NULL, &s), "direction v: knot 2");
    CU_ASSERT_PTR_NULL(s);
    refused(nurbs_surface_create(point_degree, size, k, k, points, NULL, &s), "direction u");
    refused(nurbs_surface_create(degree, empty, k, k, points, NULL, &s), "0 control points");
    refused(nurbs_surface_create(degree, size, k, k, bad, NULL, &s), "control point 1 has z");
    refused(nurbs_surface_create(degree, size, k, k, points, (const double[]){1, 1, -1, 1}, &s),
            "weight 2 is -1");
    refused(nurbs_surface_create(degree, size, k, k, NULL, NULL, &s), "points is NULL");
    refused(nurbs_surface_create(NULL, size, k, k, points, NULL, &s), "degree is NULL");
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, k, k, points, NULL, &s), NURBS_OK);
    double out[36], uv[4] = {0.5, 0.5, 0.5, NAN};
    size_t span[2];
    refused(nurbs_surface_eval(s, 0, 2, uv, out), "parameter 1 has v = nan");
    refused(nurbs_surface_eval(s, 51, 1, uv, out), "order is 51");
    refused(nurbs_surface_eval(s, 0, 1, uv, NULL), "out is NULL");
    refused(nurbs_surface_eval_grid(s, 0, 2, (const double[]){0.5, 0.4}, 1, uv, out),
            "u decreases at 1");
    refused(nurbs_surface_eval_grid(s, 0, 1, uv, 2, (const double[]){0.5, 1.1}, out),
            "parameter 1 has v = 1.1");
    refused(nurbs_surface_basis(s, 0, -0.1, 0.5, span, out), "u = -0.1");
    CU_ASSERT_EQUAL(nurbs_surface_eval(s, 0, 0, NULL, NULL), NURBS_OK);
    nurbs_surface_free(s);
    nurbs_surface_free(NULL);
}

/* x = 1 / (1 + u + v) as a bilinear rational surface: every derivative in closed form. */
static void test_high_orders_of_a_quotient(void)
{
    enum { ORDER = 12 };
    const int degree[2] = {1, 1};
    const size_t size[2] = {2, 2};
    const double knots[4] = {0, 0, 1, 1}, weights[4] = {1, 2, 2, 3};
    double points[12] = {0}, out[3 * NURBS_SURFACE_TRIPLES(ORDER)];
    for (int i = 0; i < 4; i++)
        points[3 * i] = 1.0 / weights[i];
    nurbs_surface *s;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, knots, knots, points, weights, &s),
                          NURBS_OK);
    const double uv[2] = {0.3, 0.45}, base = 1.0 + uv[0] + uv[1];
    CU_ASSERT_EQUAL(nurbs_surface_eval(s, ORDER, 1, uv, out), NURBS_OK);
    double expected = 1.0 / base;
    for (int total = 0, k = 0; total <= ORDER; total++) {
        for (int l = 0; l <= total; l++, k++)
            CHECK_CLOSE(out[3 * k], expected, 1e-12 * fabs(expected));
        expected *= -(total + 1) / base;
    }
    nurbs_surface_free(s);
}

/* Orders above two against sums of basis functions, by Leibniz' rule for rational surfaces; on the
 * grid, and from the left of a knot as the end of the piece before it. */
static void test_high_orders(void)
{
    enum { ORDER = 6, TRIPLES = NURBS_SURFACE_TRIPLES(ORDER) };
    uint64_t state = 29;
    for (int rational = 0; rational < 2; rational++) {
        const int degree[2] = {4, 3};
        const size_t size[2] = {11, 9};
        nurbs_surface *s = random_surface(&state, degree, size, 0, rational);
        const double knot = nurbs_surface_knots(s, 0)[6];
        for (int trial = 0; trial < 12; trial++) {
            const int at_knot = trial == 11;
            const double uv[2] = {at_knot ? knot : random_unit(&state), random_unit(&state)};
            double out[3 * TRIPLES], grid[3 * TRIPLES], basis[2][(ORDER + 1) * 5], low[18];
            const unsigned left = at_knot ? 1 : 0;
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_eval_sided(s, ORDER, left, 1, uv, out), NURBS_OK);
            CU_ASSERT_EQUAL(nurbs_surface_eval_sided(s, 2, left, 1, uv, low), NURBS_OK);
            CHECK_CLOSE(largest_difference(out, low, 18), 0.0, 1e-11 * scale_of(low, 18));
            if (!at_knot) {
                CU_ASSERT_EQUAL(nurbs_surface_eval_grid(s, ORDER, 1, uv, 1, uv + 1, grid),
                                NURBS_OK);
                CU_ASSERT_EQUAL(largest_difference(out, grid, 3 * TRIPLES), 0.0);
            }
            size_t span[2];
            for (int d = 0; d < 2; d++) {
                span[d] =
                    nurbs_basis_span(degree[d], size[d], nurbs_surface_knots(s, d), uv[d], NULL);
                span[d] -= d == 0 && at_knot;
                nurbs_basis_derivatives(degree[d], nurbs_surface_knots(s, d), span[d], uv[d], ORDER,
                                        basis[d]);
            }
            double a[ORDER + 1][ORDER + 1][4] = {{{0}}}, largest = 0.0;
            for (int k = 0; k <= ORDER; k++)
                for (int l = 0; l <= ORDER; l++)
                    for (size_t i = 0; i < 5; i++)
                        for (size_t j = 0; j < 4; j++) {
                            const size_t p = (span[0] - 4 + i) * size[1] + span[1] - 3 + j;
                            const double w = rational ? nurbs_surface_weights(s)[p] : 1.0;
                            const double b =
                                w * basis[0][(size_t)k * 5 + i] * basis[1][(size_t)l * 4 + j];
                            for (size_t c = 0; c < 3; c++)
                                a[k][l][c] += b * nurbs_surface_points(s)[3 * p + c];
                            a[k][l][3] += b;
                        }
            for (size_t k = 0; k < 4 * (ORDER + 1) * (ORDER + 1); k++)
                largest = fmax(largest, fabs((&a[0][0][0])[k]));
            for (int k = 0; k <= ORDER; k++)
                for (int l = 0; k + l <= ORDER; l++)
                    for (int c = 0; c < 3; c++) { /* the derivative of w S is that of A */
                        double sum = 0.0, size_of_terms = 0.0, ci = 1.0;
                        for (int i = 0; i <= k; ci = ci * (k - i) / (i + 1), i++) {
                            double cj = 1.0;
                            for (int j = 0; j <= l; cj = cj * (l - j) / (j + 1), j++) {
                                const int total = k - i + l - j;
                                const double term = ci * cj * a[i][j][3] *
                                                    out[3 * (total * (total + 1) / 2 + l - j) + c];
                                sum += term;
                                size_of_terms += fabs(term);
                            }
                        }
                        CHECK_CLOSE(sum, a[k][l][c], 1e-12 * (size_of_terms + largest));
                    }
        }
        nurbs_surface_free(s);
    }
}

static const struct check_case cases[] = {
    {"any order of a quotient", test_high_orders_of_a_quotient},
    {"orders above two", test_high_orders},
    {"reference points and derivatives", test_reference},
    {"grid, scattered points and orders agree", test_grid_and_orders_agree},
    {"basis rows reproduce points", test_basis_rows},
    {"rows are derivatives", test_rows_are_derivatives},
    {"limits at a kink", test_limits},
    {"an edge in a coordinate plane evaluates exactly", test_edge_plane_is_exact},
    {"bad input is named", test_bad_input_is_named},
};

CHECK_MAIN("surface", cases)
