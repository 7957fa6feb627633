#include "check.h"
#include "reference.h"

#include <nurbs/invert.h>

#include <string.h>

/* A rough sheet: even control points moved by up to half their distance. */
static nurbs_surface *sheet(uint64_t *state, const int degree[2], const size_t size[2], int hard,
                            int rational)
{
    nurbs_surface *r = random_surface(state, degree, size, hard, rational), *s;
    const size_t n = size[0] * size[1];
    double *p = malloc(3 * n * sizeof *p);
    CU_ASSERT_PTR_NOT_NULL_FATAL(p);
    for (size_t i = 0; i < n; i++) {
        const double *q = nurbs_surface_points(r) + 3 * i;
        const double du = 0.5 / (double)size[0], dv = 0.5 / (double)size[1];
        p[3 * i] = (double)(i / size[1]) / (double)(size[0] - 1) + du * q[0];
        p[3 * i + 1] = (double)(i % size[1]) / (double)(size[1] - 1) + dv * q[1];
        p[3 * i + 2] = du * q[2];
    }
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, nurbs_surface_knots(r, 0),
                                               nurbs_surface_knots(r, 1), p,
                                               nurbs_surface_weights(r), &s),
                          NURBS_OK);
    nurbs_surface_free(r);
    free(p);
    return s;
}

/* Points of a surface are found again; points off it get a distance no sampling beats. */
static void test_surface_against_sampling(void)
{
    uint64_t state = 61;
    enum { N = 120, POINTS = 60 };
    for (int k = 0; k < 6; k++) {
        const int degree[2] = {2 + k % 3, 3};
        const size_t size[2] = {9, 8};
        nurbs_surface *s = sheet(&state, degree, size, k % 2, k >= 3);
        double grid[N + 1], *net = malloc(3 * (N + 1) * (N + 1) * sizeof *net);
        double points[3 * POINTS], uv[2 * POINTS], distance[POINTS];
        CU_ASSERT_PTR_NOT_NULL_FATAL(net);
        for (int i = 0; i <= N; i++)
            grid[i] = (double)i / N;
        CU_ASSERT_EQUAL(nurbs_surface_eval_grid(s, 0, N + 1, grid, N + 1, grid, net), NURBS_OK);
        for (int i = 0; i < POINTS; i++) {
            const double at[2] = {random_unit(&state), random_unit(&state)};
            nurbs_surface_eval(s, 0, 1, at, points + 3 * i);
            for (int c = 0; i >= POINTS / 2 && c < 3; c++)
                points[3 * i + c] += random_unit(&state) - 0.5;
        }
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_closest(s, POINTS, points, uv, distance), NURBS_OK);
        for (int i = 0; i < POINTS; i++) {
            double p[3], sampled = HUGE_VAL;
            CU_ASSERT_EQUAL(nurbs_surface_eval(s, 0, 1, uv + 2 * i, p), NURBS_OK);
            const double *q = points + 3 * i;
            CHECK_CLOSE(hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]), distance[i], 1e-15);
            for (size_t g = 0; g < (N + 1) * (N + 1); g++)
                sampled = fmin(sampled, hypot(hypot(net[3 * g] - q[0], net[3 * g + 1] - q[1]),
                                              net[3 * g + 2] - q[2]));
            CU_ASSERT(distance[i] <= sampled * (1.0 + 1e-14));
            if (i < POINTS / 2)
                CHECK_CLOSE(distance[i], 0.0, 1e-14);
        }
        free(net);
        nurbs_surface_free(s);
    }
}

/* A sphere: the closest point lies on the ray from the centre, the distance is known. */
static void test_sphere(void)
{
    struct reference ref = reference_load();
    uint64_t state = 62;
    for (size_t k = 0; k < json_array_size(ref.cases); k++) {
        json_t *c = json_array_get(ref.cases, k);
        if (strcmp(reference_id(c), "sphere_octant") != 0)
            continue;
        nurbs_surface *s = reference_surface(c, c, 0);
        nurbs_locator *locator;
        CU_ASSERT_EQUAL_FATAL(nurbs_locator_create(s, &locator), NURBS_OK);
        for (int i = 0; i < 200; i++) {
            double at[2] = {random_unit(&state), random_unit(&state)}, p[3], q[3], uv[2], distance;
            for (int d = 0; d < 2; d++) {
                const double *knots = nurbs_surface_knots(s, d);
                at[d] = knots[0] + at[d] * (knots[nurbs_surface_size(s, d)] - knots[0]);
            }
            nurbs_surface_eval(s, 0, 1, at, p);
            const double radius = 0.2 + 3.0 * random_unit(&state);
            for (int x = 0; x < 3; x++)
                q[x] = radius * p[x];
            CU_ASSERT_EQUAL(nurbs_locator_closest(locator, 1, q, uv, &distance), NURBS_OK);
            CHECK_CLOSE(distance, fabs(radius - 1.0), 1e-14);
            /* From a start nearby the local search arrives at the same point. */
            double near[2] = {at[0], at[1]}, same;
            CU_ASSERT_EQUAL(nurbs_surface_closest_near(s, 1, q, near, &same), NURBS_OK);
            CHECK_CLOSE(same, distance, 1e-14);
        }
        nurbs_locator_free(locator);
        nurbs_surface_free(s);
    }
    reference_free(&ref);
}

static void test_curve_against_sampling(void)
{
    uint64_t state = 63;
    for (int k = 0; k < 12; k++) {
        nurbs_curve *c = random_curve(&state, 1 + k % 5, 10, 1, k % 2);
        for (int i = 0; i < 40; i++) {
            double point[3], p[3], u, distance, sampled = HUGE_VAL;
            const double at = random_unit(&state);
            nurbs_curve_eval(c, 0, 1, &at, point);
            for (int x = 0; i >= 20 && x < 3; x++)
                point[x] += random_unit(&state) - 0.5;
            CU_ASSERT_EQUAL(nurbs_curve_closest(c, 1, point, &u, &distance), NURBS_OK);
            nurbs_curve_eval(c, 0, 1, &u, p);
            CHECK_CLOSE(hypot(hypot(p[0] - point[0], p[1] - point[1]), p[2] - point[2]), distance,
                        1e-15);
            for (int g = 0; g <= 2000; g++) {
                const double t = g / 2000.0;
                nurbs_curve_eval(c, 0, 1, &t, p);
                sampled =
                    fmin(sampled, hypot(hypot(p[0] - point[0], p[1] - point[1]), p[2] - point[2]));
            }
            CU_ASSERT(distance <= sampled * (1.0 + 1e-14));
            if (i < 20)
                CHECK_CLOSE(distance, 0.0, 1e-14);
        }
        nurbs_curve_free(c);
    }
}

/* The minimum on a kink, where derivatives jump, and at a corner of the domain. */
static void test_kink_and_corner(void)
{
    const int degree[2] = {1, 1};
    const size_t size[2] = {3, 2};
    const double ku[] = {0, 0, 0.5, 1, 1}, kv[] = {0, 0, 1, 1};
    const double roof[] = {0, 0, 0, 0, 1, 0, 1, 0, 1, 1, 1, 1, 2, 0, 0, 2, 1, 0};
    nurbs_surface *s;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, ku, kv, roof, NULL, &s), NURBS_OK);
    const double points[] = {1.1, 0.25, 5, -3, -4, 0};
    double uv[4], distance[2];
    CU_ASSERT_EQUAL(nurbs_surface_closest(s, 2, points, uv, distance), NURBS_OK);
    CHECK_CLOSE(uv[0], 0.5, 1e-15);
    CHECK_CLOSE(uv[1], 0.25, 1e-15);
    CU_ASSERT_EQUAL(uv[2], 0.0);
    CU_ASSERT_EQUAL(uv[3], 0.0);
    CHECK_CLOSE(distance[0], hypot(0.1, 4.0), 1e-15);
    CHECK_CLOSE(distance[1], 5.0, 1e-15);
    double bad[3] = {0, NAN, 0}, out[2] = {2.0, 0.5};
    CU_ASSERT_EQUAL(nurbs_surface_closest(s, 1, bad, uv, NULL), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "point 0 has y"));
    CU_ASSERT_EQUAL(nurbs_surface_closest_near(s, 1, points, out, NULL), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "u = 2"));
    CU_ASSERT_EQUAL(nurbs_surface_closest(s, 1, points, NULL, NULL), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_curve_closest(NULL, 1, points, uv, NULL), NURBS_ERROR_ARGUMENT);
    nurbs_surface_free(s);
    nurbs_locator_free(NULL);
}

/* One Bezier segment or patch of high degree turns several times, so that the distance has several
 * local minima in it: none of a dense sampling may be lower than the one found. */
static void test_many_minima(void)
{
    enum { DEGREE = 9, SAMPLES = 4000, SIDE = 160, PATCH = 5 };
    uint64_t state = 67;
    const double ends[2 * (DEGREE + 1)] = {[DEGREE + 1] = 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    for (int k = 0; k < 12; k++) {
        double p[3 * (DEGREE + 1)], weights[DEGREE + 1], *u = malloc(4 * SAMPLES * sizeof *u);
        CU_ASSERT_PTR_NOT_NULL_FATAL(u);
        for (size_t i = 0; i <= DEGREE; i++) {
            p[3 * i] = (double)i / DEGREE;
            p[3 * i + 1] = (i % 2 ? 4.0 : -4.0) * random_unit(&state);
            p[3 * i + 2] = random_unit(&state);
            weights[i] = 0.5 + random_unit(&state);
        }
        nurbs_curve *c;
        CU_ASSERT_EQUAL_FATAL(
            nurbs_curve_create(DEGREE, DEGREE + 1, ends, p, k % 2 ? weights : NULL, &c), NURBS_OK);
        for (size_t i = 0; i < SAMPLES; i++)
            u[i] = (double)i / (SAMPLES - 1);
        nurbs_curve_eval(c, 0, SAMPLES, u, u + SAMPLES);
        for (int i = 0; i < 25; i++) {
            const double q[3] = {random_unit(&state), random_unit(&state) - 0.5, 0.5};
            double at, distance, sampled = HUGE_VAL;
            CU_ASSERT_EQUAL(nurbs_curve_closest(c, 1, q, &at, &distance), NURBS_OK);
            for (size_t s = 0; s < SAMPLES; s++) {
                const double *x = u + SAMPLES + 3 * s;
                sampled = fmin(sampled, hypot(hypot(x[0] - q[0], x[1] - q[1]), x[2] - q[2]));
            }
            CU_ASSERT(distance <= sampled * (1.0 + 1e-12));
            CU_ASSERT(sampled <= distance + 2e-2); /* and it is a point of the curve */
        }
        free(u);
        nurbs_curve_free(c);
    }
    for (int k = 0; k < 6; k++) {
        const int degree[2] = {PATCH, PATCH};
        const size_t size[2] = {PATCH + 1, PATCH + 1};
        double knots[2 * (PATCH + 1)] = {0}, p[3 * (PATCH + 1) * (PATCH + 1)];
        double weights[(PATCH + 1) * (PATCH + 1)], grid[SIDE];
        double *net = malloc(3 * SIDE * SIDE * sizeof *net);
        CU_ASSERT_PTR_NOT_NULL_FATAL(net);
        for (size_t i = 0; i < (PATCH + 1) * (PATCH + 1); i++) {
            p[3 * i] = (double)(i / (PATCH + 1)) / PATCH;
            p[3 * i + 1] = (double)(i % (PATCH + 1)) / PATCH;
            p[3 * i + 2] = 6.0 * random_unit(&state) - 3.0;
            weights[i] = 0.5 + random_unit(&state);
        }
        for (int i = 0; i <= PATCH; i++)
            knots[PATCH + 1 + i] = 1.0;
        nurbs_surface *s;
        CU_ASSERT_EQUAL_FATAL(
            nurbs_surface_create(degree, size, knots, knots, p, k % 2 ? weights : NULL, &s),
            NURBS_OK);
        for (size_t i = 0; i < SIDE; i++)
            grid[i] = (double)i / (SIDE - 1);
        nurbs_surface_eval_grid(s, 0, SIDE, grid, SIDE, grid, net);
        for (int i = 0; i < 20; i++) {
            const double q[3] = {random_unit(&state), random_unit(&state),
                                 2.0 * random_unit(&state) - 1.0};
            double uv[2], distance, sampled = HUGE_VAL;
            CU_ASSERT_EQUAL(nurbs_surface_closest(s, 1, q, uv, &distance), NURBS_OK);
            for (size_t x = 0; x < SIDE * SIDE; x++)
                sampled = fmin(sampled, hypot(hypot(net[3 * x] - q[0], net[3 * x + 1] - q[1]),
                                              net[3 * x + 2] - q[2]));
            CU_ASSERT(distance <= sampled * (1.0 + 1e-12));
            CU_ASSERT(sampled <= distance + 5e-2);
        }
        free(net);
        nurbs_surface_free(s);
    }
}

static const struct check_case cases[] = {
    {"several minima in one patch", test_many_minima},
    {"surfaces against sampling", test_surface_against_sampling},
    {"sphere", test_sphere},
    {"curves against sampling", test_curve_against_sampling},
    {"kinks, corners and bad input", test_kink_and_corner},
};

CHECK_MAIN("invert", cases)
