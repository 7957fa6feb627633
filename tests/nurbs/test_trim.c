/* Trimmed surfaces resampled as patches: against the surface itself, areas in closed form, and what
 * must be refused. */
#include "check.h"

#include <nurbs/nurbs.h>

#include <string.h>

static nurbs_curve *curve(int degree, size_t n, const double *uv, const double *weights)
{
    double points[30], knots[20];
    for (size_t k = 0; k < n; k++) {
        points[3 * k] = uv[2 * k];
        points[3 * k + 1] = uv[2 * k + 1];
        points[3 * k + 2] = 0;
    }
    size_t p = (size_t)degree;
    for (size_t k = 0; k < n + p + 1; k++)
        knots[k] = k <= p ? 0 : k >= n ? (double)(n - p) : (double)(k - p);
    nurbs_curve *made;
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(degree, n, knots, points, weights, &made), NURBS_OK);
    return made;
}

static nurbs_curve *line(double u0, double v0, double u1, double v1)
{
    return curve(1, 2, (const double[]){u0, v0, u1, v1}, NULL);
}

static void free_loop(size_t n, nurbs_curve **loop)
{
    for (size_t k = 0; k < n; k++)
        nurbs_curve_free(loop[k]);
}

/* The plane z = 0 over [-2,2] x [-2,2], parameters = coordinates. */
static nurbs_surface *plane(void)
{
    const double knots[4] = {-2, -2, 2, 2}, points[12] = {-2, -2, 0, -2, 2, 0, 2, -2, 0, 2, 2, 0};
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){1, 1}, (const size_t[]){2, 2}, knots,
                                               knots, points, NULL, &surface),
                          NURBS_OK);
    return surface;
}

/* A wavy bicubic over [0,1] x [0,1]. */
static nurbs_surface *wavy(void)
{
    const double knots[11] = {0, 0, 0, 0, 0.3, 0.5, 0.8, 1, 1, 1, 1};
    double points[147];
    for (int k = 0; k < 49; k++) {
        int i = k / 7, j = k % 7;
        points[3 * k] = i;
        points[3 * k + 1] = j;
        points[3 * k + 2] = 0.5 * sin(0.7 * i) * cos(0.5 * j);
    }
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){3, 3}, (const size_t[]){7, 7}, knots,
                                               knots, points, NULL, &surface),
                          NURBS_OK);
    return surface;
}

static nurbs_surface *untrim(const nurbs_surface *surface, size_t n, nurbs_curve **loop,
                             double tolerance, double *deviation)
{
    nurbs_surface *patch = NULL;
    nurbs_status status = nurbs_surface_untrim(surface, n, (const nurbs_curve *const *)loop,
                                               tolerance, &patch, deviation);
    if (status != NURBS_OK)
        fprintf(stderr, "%s\n", nurbs_last_error());
    CU_ASSERT_EQUAL_FATAL(status, NURBS_OK);
    CU_ASSERT(*deviation <= tolerance);
    return patch;
}

/* Inside lines of constant parameter the patch is the surface itself, knots included; curves in any
 * direction and order of the loop. */
static void rectangle_is_exact(void)
{
    nurbs_surface *surface = wavy();
    nurbs_curve *loop[4] = {line(0.9, 0.2, 0.9, 0.7), line(0.1, 0.7, 0.9, 0.7),
                            line(0.1, 0.7, 0.1, 0.2), line(0.9, 0.2, 0.1, 0.2)};
    double deviation;
    nurbs_surface *patch = untrim(surface, 4, loop, 1e-9, &deviation);
    CU_ASSERT_EQUAL(nurbs_surface_size(patch, 0), 7);
    CU_ASSERT_EQUAL(nurbs_surface_size(patch, 1), 6);
    for (int k = 0; k <= 100; k++) {
        double st[2] = {(k % 11) / 10.0, (k * 7 % 11) / 10.0}, p[3], q[3];
        double uv[2] = {fmin(0.1 + 0.8 * st[0], 0.9), 0.2 + 0.5 * st[1]};
        CU_ASSERT_EQUAL(nurbs_surface_eval(patch, 0, 1, st, p), NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 0, 1, uv, q), NURBS_OK);
        for (int c = 0; c < 3; c++)
            CHECK_CLOSE(p[c], q[c], 1e-9);
    }
    nurbs_surface_free(patch);
    free_loop(4, loop);
    nurbs_surface_free(surface);
}

/* A quarter of a ring between radii 0.5 and 1.5: area pi / 2, edges on the circles. */
static void ring_keeps_area_and_edges(void)
{
    const double h = sqrt(0.5), weights[3] = {1, h, 1};
    nurbs_surface *surface = plane();
    nurbs_curve *loop[4] = {
        curve(2, 3, (const double[]){0.5, 0, 0.5, 0.5, 0, 0.5}, weights), line(0, 0.5, 0, 1.5),
        curve(2, 3, (const double[]){0, 1.5, 1.5, 1.5, 1.5, 0}, weights), line(1.5, 0, 0.5, 0)};
    double deviation, area, previous = 1;
    for (double tolerance = 1e-3; tolerance > 1e-8; tolerance *= 0.01) {
        nurbs_surface *patch = untrim(surface, 4, loop, tolerance, &deviation);
        CU_ASSERT_EQUAL(nurbs_surface_area(patch, &area, NULL), NURBS_OK);
        CHECK_CLOSE(area, 1.57079632679489662, 5 * tolerance); /* perimeter 5.14 x deviation */
        /* Two opposite edges lie on the circles, two on the axes. */
        double worst = 0;
        for (int k = 0; k <= 40; k++)
            for (int e = 0; e < 4; e++) {
                double t = k / 40.0, st[2] = {e < 2 ? t : e - 2, e < 2 ? e : t}, p[3];
                CU_ASSERT_EQUAL(nurbs_surface_eval(patch, 0, 1, st, p), NURBS_OK);
                double r = hypot(p[0], p[1]);
                worst = fmax(
                    worst, fmin(fmin(fabs(p[0]), fabs(p[1])), fmin(fabs(r - 0.5), fabs(r - 1.5))));
                CHECK_CLOSE(p[2], 0, 1e-15);
            }
        CU_ASSERT(worst <= tolerance);
        CU_ASSERT(worst < previous);
        previous = worst;
        nurbs_surface_free(patch);
    }
    free_loop(4, loop);
    nurbs_surface_free(surface);
}

/* Every point of the patch is on the surface within the stated deviation, the normal keeps its
 * side whichever way the loop runs. */
static void stays_on_a_curved_surface(void)
{
    nurbs_surface *surface = wavy();
    for (int turned = 0; turned < 2; turned++) {
        nurbs_curve *loop[4] = {
            curve(3, 4, (const double[]){0.1, 0.1, 0.4, 0.3, 0.6, 0, 0.9, 0.2}, NULL),
            line(0.9, 0.2, 0.8, 0.9),
            curve(2, 3, (const double[]){0.8, 0.9, 0.5, 0.7, 0.2, 0.95}, NULL),
            line(0.2, 0.95, 0.1, 0.1)};
        if (turned)
            for (int k = 0; k < 2; k++) {
                nurbs_curve *swapped = loop[k];
                loop[k] = loop[3 - k];
                loop[3 - k] = swapped;
            }
        double deviation, uv[200], distance[100], points[300], normals[6];
        nurbs_surface *patch = untrim(surface, 4, loop, 1e-5, &deviation);
        for (int k = 0; k < 100; k++) {
            uv[2 * k] = (k % 10 + 0.5) / 10;
            uv[2 * k + 1] = (k / 10 + 0.5) / 10;
        }
        CU_ASSERT_EQUAL(nurbs_surface_eval(patch, 0, 100, uv, points), NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_surface_closest(surface, 100, points, uv, distance), NURBS_OK);
        for (int k = 0; k < 100; k++)
            CU_ASSERT(distance[k] <= deviation);
        CU_ASSERT_EQUAL(nurbs_surface_normals(patch, 1, (const double[]){0.5, 0.5}, normals),
                        NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_surface_normals(surface, 1, (const double[]){0.5, 0.5}, normals + 3),
                        NURBS_OK);
        CU_ASSERT(normals[2] * normals[5] > 0.5);
        nurbs_surface_free(patch);
        free_loop(4, loop);
    }
    nurbs_surface_free(surface);
}

/* One polyline around, its vertices between the corners smooth or slightly bent; and two curves,
 * one of which turns twice. */
static void finds_corners_inside_curves(void)
{
    nurbs_surface *surface = plane(), *patch;
    double deviation, area;
    nurbs_curve *around =
        curve(1, 7, (const double[]){-1, -1, 0, -1, 1, -0.8, 1, 1, 0.2, 1, -1, 1, -1, -1}, NULL);
    patch = untrim(surface, 1, &around, 1e-6, &deviation);
    CU_ASSERT_EQUAL(nurbs_surface_area(patch, &area, NULL), NURBS_OK);
    CHECK_CLOSE(area, 4 - 0.1, 1e-5);
    nurbs_surface_free(patch);
    nurbs_curve_free(around);
    nurbs_curve *pair[2] = {curve(1, 4, (const double[]){0, 0, 1, 0, 1, 1, 0, 1}, NULL),
                            curve(2, 3, (const double[]){0, 1, -0.5, 0.5, 0, 0}, NULL)};
    patch = untrim(surface, 2, pair, 1e-6, &deviation);
    CU_ASSERT_EQUAL(nurbs_surface_area(patch, &area, NULL), NURBS_OK);
    CHECK_CLOSE(area, 1 + 0.25 * 2 / 3, 1e-5);
    nurbs_surface_free(patch);
    free_loop(2, pair);
    nurbs_surface_free(surface);
}

/* A hemisphere's octant between the pole and a slanted lower edge: the loop has no curve along the
 * collapsed edge. */
static void bridges_collapsed_edges(void)
{
    nurbs_surface *sphere, *patch;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(2, 2, 2, 0, &sphere), NURBS_OK);
    const double *knots[2] = {nurbs_surface_knots(sphere, 0), nurbs_surface_knots(sphere, 1)};
    double a = knots[0][0], b = knots[0][nurbs_surface_size(sphere, 0)], c = knots[1][0],
           d = knots[1][nurbs_surface_size(sphere, 1)], deviation, p[24];
    double corners[8] = {a, c, a, d, b, c, b, d};
    CU_ASSERT_EQUAL(nurbs_surface_eval(sphere, 0, 4, corners, p), NURBS_OK);
    /* The bodies collapse at both ends of u. */
    CHECK_CLOSE(p[0], p[3], 1e-15);
    double u = a + 0.4 * (b - a), w = a + 0.6 * (b - a);
    nurbs_curve *loop[3] = {line(a, c, u, c), line(u, c, w, d), line(w, d, a, d)};
    patch = untrim(sphere, 3, loop, 1e-5, &deviation);
    double uv[32], points[48], distance[16];
    for (int k = 0; k < 16; k++) {
        uv[2 * k] = (k % 4) / 3.0;
        uv[2 * k + 1] = (k / 4) / 3.0;
    }
    CU_ASSERT_EQUAL(nurbs_surface_eval(patch, 0, 16, uv, points), NURBS_OK);
    for (int k = 0; k < 16; k++)
        CHECK_CLOSE(hypot(hypot(points[3 * k], points[3 * k + 1]), points[3 * k + 2]), 1, 1e-5);
    CU_ASSERT_EQUAL(nurbs_surface_closest(sphere, 16, points, uv, distance), NURBS_OK);
    nurbs_surface_free(patch);
    free_loop(3, loop);
    nurbs_surface_free(sphere);
}

static void refuse(const nurbs_surface *surface, size_t n, nurbs_curve **loop, double tolerance,
                   const char *expected)
{
    nurbs_surface *patch = NULL;
    nurbs_status status =
        nurbs_surface_untrim(surface, n, (const nurbs_curve *const *)loop, tolerance, &patch, NULL);
    if (status >= 0 || !strstr(nurbs_last_error(), expected)) {
        fprintf(stderr, "expected '%s', got '%s'\n", expected,
                status < 0 ? nurbs_last_error() : "success");
        CU_FAIL("not refused as expected");
    }
    CU_ASSERT_PTR_NULL(patch);
    nurbs_surface_free(patch);
}

static void refuses_other_loops(void)
{
    nurbs_surface *surface = plane();
    const double h = sqrt(0.5), circle_weights[3] = {1, h, 1};
    nurbs_curve *loop[6] = {line(0, 0, 1, 0),   line(1, 0, 1, 1), line(1, 1, 0, 1),
                            line(0, 0.9, 0, 0), line(0, 1, 0, 3), line(0, 3, 0, 0)};
    refuse(surface, 4, loop, 1e-3, "open by 0.1 m");
    nurbs_curve *outside[5] = {loop[0], loop[1], loop[2], loop[4], loop[5]};
    refuse(surface, 5, outside, 1e-3, "leaves the surface");
    refuse(surface, 0, loop, 1e-3, "no curves");
    refuse(surface, 4, loop, 0, "tolerance 0");
    refuse(surface, 4, loop, NAN, "tolerance");
    nurbs_curve *triangle[3] = {loop[0], loop[1], line(1, 1, 0, 0)};
    refuse(surface, 3, triangle, 1e-3, "3 corners");
    nurbs_curve_free(triangle[2]);
    nurbs_curve *lens[2] = {curve(2, 3, (const double[]){1, 0, 1, 1, 0, 1}, circle_weights),
                            curve(2, 3, (const double[]){0, 1, 0, 0, 1, 0}, circle_weights)};
    refuse(surface, 2, lens, 1e-3, "2 corners");
    free_loop(2, lens);
    /* Four corners, one of them far inside: the Coons map leaves the loop. */
    nurbs_curve *arrow[4] = {line(-1, 0, 1, -1), line(1, -1, 0.9, 0.9), line(0.9, 0.9, 0.85, -0.85),
                             line(0.85, -0.85, -1, 0)};
    refuse(surface, 4, arrow, 1e-3, "folds");
    free_loop(4, arrow);
    free_loop(6, loop);
    nurbs_surface_free(surface);
}

/* A roof whose ridge runs across the patch cannot be followed by a C^2 spline to 1e-9; the refusal
 * comes in bounded time and memory. */
static void refuses_a_slanted_kink(void)
{
    const double u[5] = {0, 0, 0.5, 1, 1}, v[4] = {0, 0, 1, 1},
                 points[18] = {0, 0, 0, 0, 1, 0, 0.5, 0, 0.5, 0.5, 1, 0.5, 1, 0, 0, 1, 1, 0};
    nurbs_surface *roof;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){1, 1}, (const size_t[]){3, 2}, u, v,
                                               points, NULL, &roof),
                          NURBS_OK);
    nurbs_curve *loop[4] = {line(0.1, 0.1, 0.7, 0.1), line(0.7, 0.1, 0.9, 0.9),
                            line(0.9, 0.9, 0.3, 0.9), line(0.3, 0.9, 0.1, 0.1)};
    refuse(roof, 4, loop, 1e-9, "control points");
    free_loop(4, loop);
    nurbs_surface_free(roof);
}

static const struct check_case cases[] = {
    {"rectangle is exact", rectangle_is_exact},
    {"ring keeps area and edges", ring_keeps_area_and_edges},
    {"stays on a curved surface", stays_on_a_curved_surface},
    {"finds corners inside curves", finds_corners_inside_curves},
    {"bridges collapsed edges", bridges_collapsed_edges},
    {"refuses other loops", refuses_other_loops},
    {"refuses a slanted kink", refuses_a_slanted_kink},
};

CHECK_MAIN("nurbs trim", cases)
