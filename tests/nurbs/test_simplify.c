#include "check.h"
#include "reference.h"

#include <string.h>

/* Largest distance at equal parameters on a dense grid; per coordinate in largest[3]. */
static double sampled_surface(const nurbs_surface *a, const nurbs_surface *b)
{
    enum { N = 160 };
    double u[N + 1], v[N + 1], worst = 0.0;
    double *p = malloc(sizeof(double) * 3 * (N + 1) * (N + 1) * 2);
    CU_ASSERT_PTR_NOT_NULL_FATAL(p);
    double *q = p + 3 * (N + 1) * (N + 1);
    const double *ku = nurbs_surface_knots(a, 0), *kv = nurbs_surface_knots(a, 1);
    const double lu = ku[nurbs_surface_size(a, 0)] - ku[0];
    const double lv = kv[nurbs_surface_size(a, 1)] - kv[0];
    for (int i = 0; i <= N; i++) {
        u[i] = ku[0] + lu * i / N;
        v[i] = kv[0] + lv * i / N;
    }
    CU_ASSERT_EQUAL(nurbs_surface_eval_grid(a, 0, N + 1, u, N + 1, v, p), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_eval_grid(b, 0, N + 1, u, N + 1, v, q), NURBS_OK);
    for (size_t i = 0; i < (size_t)(N + 1) * (N + 1); i++)
        worst = fmax(worst, hypot(hypot(p[3 * i] - q[3 * i], p[3 * i + 1] - q[3 * i + 1]),
                                  p[3 * i + 2] - q[3 * i + 2]));
    free(p);
    return worst;
}

static double sampled_curve(const nurbs_curve *a, const nurbs_curve *b, double largest[3])
{
    const double *k = nurbs_curve_knots(a), length = k[nurbs_curve_size(a)] - k[0];
    double worst = 0.0;
    largest[0] = largest[1] = largest[2] = 0.0;
    for (int i = 0; i <= 4000; i++) {
        const double u = k[0] + length * (i / 4000.0);
        double p[3], q[3];
        CU_ASSERT_EQUAL(nurbs_curve_eval(a, 0, 1, &u, p), NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_curve_eval(b, 0, 1, &u, q), NURBS_OK);
        for (int c = 0; c < 3; c++)
            largest[c] = fmax(largest[c], fabs(p[c] - q[c]));
        worst = fmax(worst, hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]));
    }
    return worst;
}

/* One knot fewer: no claim below what linear programming shows to be unreachable, and a result
 * near the best that exists. */
static void test_one_knot(void)
{
    struct reference ref = reference_load();
    int compared = 0;
    for (size_t k = 0; k < json_array_size(ref.cases); k++) {
        json_t *c = json_array_get(ref.cases, k);
        if (!reference_is(c, "remove_curve"))
            continue;
        nurbs_curve *curve = reference_curve(c, c, 0), *result;
        const double knot = json_number_value(json_object_get(c, "remove"));
        double bound, per[3], lower[3] = {0}, achievable[3] = {0};
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_remove(curve, knot, 1, &result, &bound), NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_curve_size(result), nurbs_curve_size(curve) - 1);
        const double worst = sampled_curve(curve, result, per);
        CU_ASSERT(worst <= bound);
        json_t *expect = json_object_get(c, "expect");
        if (expect) {
            double *points = reference_numbers(json_object_get(expect, "P"), NULL);
            CHECK_CLOSE(largest_difference(nurbs_curve_points(result), points,
                                           3 * nurbs_curve_size(result)),
                        0.0, 1e-12);
            CU_ASSERT(bound < 1e-12);
            free(points);
        } else {
            double norm = 0.0;
            for (size_t x = 0; x < 3; x++) {
                lower[x] = json_number_value(json_array_get(json_object_get(c, "linf_lower"), x));
                achievable[x] =
                    json_number_value(json_array_get(json_object_get(c, "linf_achievable"), x));
                CU_ASSERT(bound >= lower[x] * (1.0 - 1e-6));
                norm = hypot(norm, achievable[x]);
            }
            /* Each coordinate's optimum alone cannot all be reached by one Euclidean optimum. */
            if (!(worst <= 1.35 * norm))
                fprintf(stderr, "%s: %g, achievable %g\n", reference_id(c), worst, norm);
            CU_ASSERT(worst <= 1.35 * norm);
        }
        compared++;
        nurbs_curve_free(curve);
        nurbs_curve_free(result);
    }
    CU_ASSERT_EQUAL(compared, 8);
    reference_free(&ref);
}

static size_t peer_count(const json_t *c)
{
    json_t *n = json_object_get(json_object_get(c, "peer"), "n");
    size_t count = 1;
    for (size_t d = 0; d < json_array_size(n); d++)
        count *= (size_t)json_integer_value(json_array_get(n, d));
    return count;
}

/* No more control points than the peer needs, although the tolerance is Euclidean here and per
 * coordinate there. */
static void test_reduction_against_a_peer(void)
{
    struct reference ref = reference_load();
    int compared = 0;
    for (size_t k = 0; k < json_array_size(ref.cases); k++) {
        json_t *c = json_array_get(ref.cases, k);
        const double tolerance = json_number_value(json_object_get(c, "tol_per_coordinate"));
        double bound, per[3];
        size_t count;
        if (reference_is(c, "reduce_curve")) {
            nurbs_curve *curve = reference_curve(c, c, 0), *result;
            CU_ASSERT_EQUAL_FATAL(nurbs_curve_simplify(curve, tolerance, &result, &bound),
                                  NURBS_OK);
            CU_ASSERT(sampled_curve(curve, result, per) <= bound);
            count = nurbs_curve_size(result);
            nurbs_curve_free(curve);
            nurbs_curve_free(result);
        } else if (reference_is(c, "reduce_surface")) {
            nurbs_surface *surface = reference_surface(c, c, 0), *result;
            size_t counts[2];
            for (unsigned thrifty = 0; thrifty < 2; thrifty++) {
                CU_ASSERT_EQUAL_FATAL(nurbs_surface_simplify(surface, tolerance,
                                                             thrifty ? NURBS_SIMPLIFY_THRIFTY : 0,
                                                             &result, &bound),
                                      NURBS_OK);
                CU_ASSERT(sampled_surface(surface, result) <= bound);
                CU_ASSERT(bound <= tolerance);
                counts[thrifty] = nurbs_surface_size(result, 0) * nurbs_surface_size(result, 1);
                nurbs_surface_free(result);
            }
            nurbs_surface_free(surface);
            CU_ASSERT(counts[1] <= counts[0]);
            count = counts[0];
        } else {
            continue;
        }
        CU_ASSERT(bound <= tolerance);
        CU_ASSERT(count <= peer_count(c));
        compared++;
    }
    CU_ASSERT_EQUAL(compared, 8);
    reference_free(&ref);
}

/* Knots that were inserted go again and the control points come back to 1e-12. */
static void test_insert_then_remove(void)
{
    uint64_t state = 51;
    for (int k = 0; k < 40; k++) {
        const int p = 1 + k % 5;
        const size_t n = (size_t)p + 6;
        nurbs_curve *c = random_curve(&state, p, n, 0, k % 2), *fine, *back;
        double u[5], bound;
        for (int i = 0; i < 5; i++)
            u[i] = (i + 0.5 + 0.8 * (random_unit(&state) - 0.5)) / 5.0;
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_insert(c, 5, u, &fine), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_simplify(fine, 1e-10, &back, &bound), NURBS_OK);
        CU_ASSERT(bound <= 1e-10);
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_size(back), n);
        CU_ASSERT_EQUAL(
            largest_difference(nurbs_curve_knots(back), nurbs_curve_knots(c), n + (size_t)p + 1),
            0.0);
        CHECK_CLOSE(largest_difference(nurbs_curve_points(back), nurbs_curve_points(c), 3 * n), 0.0,
                    1e-12);
        nurbs_curve_free(c);
        nurbs_curve_free(fine);
        nurbs_curve_free(back);
    }
}

static void test_refine_then_simplify(void)
{
    uint64_t state = 52;
    const int degrees[3][2] = {{3, 3}, {2, 4}, {1, 3}};
    for (int k = 0; k < 6; k++) {
        const size_t size[2] = {9, 7};
        nurbs_surface *s = random_surface(&state, degrees[k / 2], size, 0, k % 2), *fine, *back;
        double bound;
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_refine(s, 2, &fine), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_simplify(fine, 1e-10, 0, &back, &bound), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_size(back, 0), 9);
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_size(back, 1), 7);
        CHECK_CLOSE(
            largest_difference(nurbs_surface_points(back), nurbs_surface_points(s), 3 * 9 * 7), 0.0,
            1e-12);
        nurbs_surface_free(s);
        nurbs_surface_free(fine);
        nurbs_surface_free(back);
    }
}

/* The bound holds and stays within the tolerance on random smooth surfaces, polynomial and
 * rational, with double knots. */
static void test_bound_is_certified(void)
{
    uint64_t state = 53;
    for (int k = 0; k < 12; k++) {
        const int degree[2] = {2 + k % 3, 3};
        const size_t size[2] = {24, 17};
        const size_t n = size[0] * size[1];
        nurbs_surface *r = random_surface(&state, degree, size, k % 2, k % 4 >= 2), *s, *simple;
        double *points = malloc(3 * n * sizeof *points), *weights = malloc(n * sizeof *weights);
        double g0[24], g1[17], bound;
        CU_ASSERT_FATAL(points && weights);
        nurbs_greville(degree[0], size[0], nurbs_surface_knots(r, 0), g0);
        nurbs_greville(degree[1], size[1], nurbs_surface_knots(r, 1), g1);
        for (size_t i = 0; i < n; i++) {
            const double a = g0[i / 17], b = g1[i % 17];
            points[3 * i] = 5.0 * a;
            points[3 * i + 1] = sin(3.0 * a) * (1.0 - b * b) + 0.02 * random_unit(&state);
            points[3 * i + 2] = b + 0.2 * cos(4.0 * a * b);
            weights[i] = 1.0 + 0.3 * sin(2.0 * a + b);
        }
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, nurbs_surface_knots(r, 0),
                                                   nurbs_surface_knots(r, 1), points,
                                                   k % 4 >= 2 ? weights : NULL, &s),
                              NURBS_OK);
        for (int t = 0; t < 3; t++) {
            const double tolerance = (double[]){3e-3, 1e-2, 5e-2}[t];
            for (unsigned thrifty = 0; thrifty < 2; thrifty++) {
                CU_ASSERT_EQUAL_FATAL(nurbs_surface_simplify(s, tolerance,
                                                             thrifty ? NURBS_SIMPLIFY_THRIFTY : 0,
                                                             &simple, &bound),
                                      NURBS_OK);
                CU_ASSERT(bound <= tolerance);
                CU_ASSERT(sampled_surface(s, simple) <= bound);
                if (t == 2)
                    CU_ASSERT(nurbs_surface_size(simple, 0) * nurbs_surface_size(simple, 1) <
                              n / 3);
                nurbs_surface_free(simple);
            }
        }
        free(points);
        free(weights);
        nurbs_surface_free(r);
        nurbs_surface_free(s);
    }
}

/* A half hull: keel and stem in y = 0, water line in z = 0, y >= 0 everywhere and small near the
 * stem, where least squares would swing to the other side. */
static nurbs_surface *half_hull(int kink)
{
    enum { NU = 60, NV = 20 };
    const int degree[2] = {3, 3};
    const size_t size[2] = {NU, NV};
    uint64_t state = 54;
    double ku[NU + 4], kv[NV + 4], gu[NU], gv[NV], points[3 * NU * NV];
    nurbs_surface *hull;
    random_knots(&state, 3, NU, 0, ku);
    random_knots(&state, 3, NV, 0, kv);
    if (kink)
        ku[30] = ku[31] = ku[32];
    nurbs_greville(3, NU, ku, gu);
    nurbs_greville(3, NV, kv, gv);
    for (size_t i = 0; i < NU; i++)
        for (size_t j = 0; j < NV; j++) {
            double *p = points + 3 * (i * NV + j);
            const double a = gu[i], b = gv[j];
            const double bend = kink && a > ku[32] ? 0.5 * (a - ku[32]) : 0.0;
            p[0] = 5.0 * a;
            p[1] = j == NV - 1 || i == NU - 1
                       ? 0.0
                       : 0.4 * pow(1.0 - a, 0.4) * (1.0 - pow(b, 6.0)) * (1.0 - 0.5 * bend);
            p[2] = j == 0 ? 0.0 : -0.3 * b - bend * b;
        }
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, ku, kv, points, NULL, &hull),
                          NURBS_OK);
    return hull;
}

static void test_edges_stay(void)
{
    nurbs_surface *hull = half_hull(0), *simple;
    for (int k = 0; k < 8; k++) {
        const int t = k / 2;
        const unsigned flags = NURBS_SIMPLIFY_KEEP_EDGES | (k % 2 ? NURBS_SIMPLIFY_THRIFTY : 0);
        const double tolerance = (double[]){1e-5, 1e-4, 1e-3, 1e-2}[t];
        double bound;
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_simplify(hull, tolerance, flags, &simple, &bound),
                              NURBS_OK);
        CU_ASSERT(bound <= tolerance);
        CU_ASSERT(sampled_surface(hull, simple) <= bound);
        const size_t nu = nurbs_surface_size(simple, 0), nv = nurbs_surface_size(simple, 1);
        const double *p = nurbs_surface_points(simple), *q = nurbs_surface_points(hull);
        CU_ASSERT(nu * nv < 60 * 20 / (size_t)(t + 1));
        for (size_t i = 0; i < nu; i++) {
            CU_ASSERT_EQUAL(p[3 * (i * nv) + 2], 0.0);
            CU_ASSERT_EQUAL(p[3 * (i * nv + nv - 1) + 1], 0.0);
        }
        for (size_t j = 0; j < nv; j++)
            CU_ASSERT_EQUAL(p[3 * ((nu - 1) * nv + j) + 1], 0.0);
        for (size_t i = 0; i < nu * nv; i++) {
            CU_ASSERT(p[3 * i + 1] >= 0.0);
            CU_ASSERT(p[3 * i + 2] <= 0.0);
        }
        const size_t corner[4][2] = {
            {0, 0}, {nv - 1, 19}, {(nu - 1) * nv, 59 * 20}, {nu * nv - 1, 1199}};
        for (int c = 0; c < 4; c++)
            CU_ASSERT_EQUAL(largest_difference(p + 3 * corner[c][0], q + 3 * corner[c][1], 3), 0.0);
        nurbs_surface_free(simple);
    }
    nurbs_surface_free(hull);
}

static void test_kinks_stay(void)
{
    nurbs_surface *hull = half_hull(1), *simple;
    const double kink = nurbs_surface_knots(hull, 0)[31];
    double bound;
    for (unsigned thrifty = 0; thrifty < 2; thrifty++) {
        const unsigned flags = NURBS_SIMPLIFY_KEEP_KINKS | NURBS_SIMPLIFY_KEEP_EDGES |
                               (thrifty ? NURBS_SIMPLIFY_THRIFTY : 0);
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_simplify(hull, 5e-2, flags, &simple, &bound), NURBS_OK);
        int copies = 0;
        for (size_t k = 0; k < nurbs_surface_size(simple, 0) + 4; k++)
            copies += nurbs_surface_knots(simple, 0)[k] == kink;
        CU_ASSERT_EQUAL(copies, 3);
        CU_ASSERT(nurbs_surface_size(simple, 0) < 20);
        CU_ASSERT(bound <= 5e-2);
        nurbs_surface_free(simple);
    }
    nurbs_surface_free(hull);
}

static void test_surface_remove(void)
{
    uint64_t state = 55;
    const int degree[2] = {3, 2};
    const size_t size[2] = {9, 8};
    nurbs_surface *s = random_surface(&state, degree, size, 0, 1), *fine, *back, *less;
    double bound;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_insert(s, 0, 2, (const double[]){0.345, 0.345}, &fine),
                          NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_remove(fine, 0, 0.345, 2, &back, &bound), NURBS_OK);
    CU_ASSERT(bound < 1e-12);
    CHECK_CLOSE(largest_difference(nurbs_surface_points(back), nurbs_surface_points(s), 3 * 72),
                0.0, 1e-12);
    const double knot = nurbs_surface_knots(s, 1)[4];
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_remove(s, 1, knot, 1, &less, &bound), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_size(less, 1), 7);
    const double worst = sampled_surface(s, less);
    CU_ASSERT(worst <= bound);
    CU_ASSERT(bound <= 4.0 * worst);
    nurbs_surface_free(less);
    CU_ASSERT_EQUAL(nurbs_surface_remove(s, 1, knot, 2, &less, &bound), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(less);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "1 times"));
    CU_ASSERT_EQUAL(nurbs_surface_remove(s, 1, 0.0, 1, &less, &bound), NURBS_ERROR_ARGUMENT);
    nurbs_surface_free(s);
    nurbs_surface_free(fine);
    nurbs_surface_free(back);
}

/* A simple shape on a wobbling parametrisation: evened out it needs fewer control points, and each
 * surface lies within the bound of the other. */
static void test_geometric_mode(void)
{
    enum { NU = 24, NV = 8, POINTS = 150 };
    const int degree[2] = {3, 3};
    const size_t size[2] = {NU, NV};
    const double tolerance = 1e-2;
    uint64_t state = 57;
    double ku[NU + 4], kv[NV + 4], gv[NV], points[3 * NU * NV], bound, plain_bound;
    nurbs_surface *s, *even, *plain;
    random_knots(&state, 3, NU, 0, ku);
    random_knots(&state, 3, NV, 0, kv);
    nurbs_greville(3, NV, kv, gv);
    for (size_t i = 0; i < NU; i++)
        for (size_t j = 0; j < NV; j++) { /* even in x although the knots are not */
            double *p = points + 3 * (i * NV + j);
            p[0] = 2.0 * (double)i / (NU - 1);
            p[1] = 0.4 * p[0] * (2.0 - p[0]) * (1.0 - gv[j] * gv[j]);
            p[2] = -gv[j];
        }
    for (size_t i = 0; i < NU; i++)
        points[3 * (i * NV + NV - 1) + 1] = 0.0;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, ku, kv, points, NULL, &s), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(
        nurbs_surface_simplify(s, tolerance, NURBS_SIMPLIFY_KEEP_EDGES, &plain, &plain_bound),
        NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(
        nurbs_surface_simplify_geometric(s, tolerance, NURBS_SIMPLIFY_KEEP_EDGES, &even, &bound),
        NURBS_OK);
    CU_ASSERT(bound <= tolerance);
    CU_ASSERT(5 * nurbs_surface_size(even, 0) * nurbs_surface_size(even, 1) <
              3 * nurbs_surface_size(plain, 0) * nurbs_surface_size(plain, 1));
    const nurbs_surface *const both[2] = {s, even};
    for (int k = 0; k < 2; k++) {
        double at[3 * POINTS], uv[2 * POINTS], distance[POINTS];
        for (int i = 0; i < POINTS; i++) {
            const double where[2] = {random_unit(&state), random_unit(&state)};
            nurbs_surface_eval(both[k], 0, 1, where, at + 3 * i);
        }
        CU_ASSERT_EQUAL(nurbs_surface_closest(both[1 - k], POINTS, at, uv, distance), NURBS_OK);
        for (int i = 0; i < POINTS; i++)
            CU_ASSERT(distance[i] <= bound);
    }
    const size_t nv = nurbs_surface_size(even, 1);
    for (size_t i = 0; i < nurbs_surface_size(even, 0); i++)
        CU_ASSERT_EQUAL(nurbs_surface_points(even)[3 * (i * nv + nv - 1) + 1], 0.0);
    nurbs_surface_free(even);
    CU_ASSERT_EQUAL(
        nurbs_surface_simplify_geometric(s, 1.0, NURBS_SIMPLIFY_KEEP_KINKS, &even, NULL),
        NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(even);
    nurbs_surface_free(s);
    nurbs_surface_free(plain);
}

/* A parabola whose parameter wobbles: evened out it needs fewer control points. */
static void test_geometric_curve(void)
{
    enum { N = 60, POINTS = 100 };
    uint64_t state = 58;
    double knots[N + 4], points[3 * N], bound, plain_bound, u;
    nurbs_curve *c, *even, *plain;
    random_knots(&state, 3, N, 0, knots);
    for (size_t i = 0; i < N; i++) { /* even in x although the knots are not */
        const double x = (double)i / (N - 1);
        points[3 * i] = 2.0 * x;
        points[3 * i + 1] = x * (1.0 - x);
        points[3 * i + 2] = 0.3 * x * x;
    }
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(3, N, knots, points, NULL, &c), NURBS_OK);
    for (int t = 0; t < 2; t++) {
        const double tolerance = t ? 1e-2 : 1e-3;
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_simplify(c, tolerance, &plain, &plain_bound), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_simplify_geometric(c, tolerance, &even, &bound),
                              NURBS_OK);
        CU_ASSERT(bound <= tolerance);
        CU_ASSERT(nurbs_curve_size(even) < nurbs_curve_size(plain));
        const nurbs_curve *const both[2] = {c, even};
        for (int k = 0; k < 2; k++)
            for (int i = 0; i <= POINTS; i++) {
                double at = (double)i / POINTS, p[3], distance;
                CU_ASSERT_EQUAL(nurbs_curve_eval(both[k], 0, 1, &at, p), NURBS_OK);
                CU_ASSERT_EQUAL(nurbs_curve_closest(both[1 - k], 1, p, &u, &distance), NURBS_OK);
                CU_ASSERT(distance <= bound);
            }
        nurbs_curve_free(plain);
        nurbs_curve_free(even);
    }
    CU_ASSERT_EQUAL(nurbs_curve_simplify_geometric(c, -1.0, &even, NULL), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(even);
    nurbs_curve_free(c);
}

static void test_bad_input(void)
{
    uint64_t state = 56;
    nurbs_curve *c = random_curve(&state, 3, 8, 0, 0), *q;
    double bound = -1.0;
    CU_ASSERT_EQUAL(nurbs_curve_simplify(c, 0.0, &q, &bound), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_curve_simplify(c, NAN, &q, &bound), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_curve_simplify(NULL, 1.0, &q, &bound), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_curve_remove(c, NAN, 1, &q, &bound), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_simplify(c, 1e-30, &q, &bound), NURBS_OK);
    CU_ASSERT_EQUAL(bound, 0.0); /* below rounding nothing can be proven: a copy */
    CU_ASSERT_EQUAL(nurbs_curve_size(q), 8);
    nurbs_curve_free(q);
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_simplify(c, 1e30, &q, NULL), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_curve_size(q), 4);
    nurbs_curve_free(q);
    nurbs_curve_free(c);
    const int degree[2] = {1, 1};
    const size_t size[2] = {2, 2};
    nurbs_surface *s = random_surface(&state, degree, size, 0, 0), *r;
    CU_ASSERT_EQUAL(nurbs_surface_simplify(s, 1.0, 8, &r, &bound), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_simplify(s, 1.0, 0, &r, &bound), NURBS_OK);
    CU_ASSERT_EQUAL(bound, 0.0);
    nurbs_surface_free(r);
    nurbs_surface_free(s);
}

static const struct check_case cases[] = {
    {"one knot removed near the best possible", test_one_knot},
    {"no more control points than a peer", test_reduction_against_a_peer},
    {"insert, then remove", test_insert_then_remove},
    {"refine, then simplify", test_refine_then_simplify},
    {"the bound is certified", test_bound_is_certified},
    {"edges and sides stay", test_edges_stay},
    {"kinks stay", test_kinks_stay},
    {"removal from surfaces", test_surface_remove},
    {"geometric mode", test_geometric_mode},
    {"geometric mode of curves", test_geometric_curve},
    {"bad input and extreme tolerances", test_bad_input},
};

CHECK_MAIN("simplify", cases)
