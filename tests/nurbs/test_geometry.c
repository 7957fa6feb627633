#include "check.h"
#include "reference.h"

#include <nurbs/geometry.h>

#include <string.h>

/* The octant of the unit sphere, collapsed edge included: normals along the radius with one sign,
 * both principal curvatures of size 1. */
static void test_sphere(void)
{
    struct reference ref = reference_load();
    uint64_t state = 71;
    int found = 0;
    for (size_t k = 0; k < json_array_size(ref.cases); k++) {
        json_t *c = json_array_get(ref.cases, k);
        if (strcmp(reference_id(c), "sphere_octant") != 0)
            continue;
        found = 1;
        nurbs_surface *s = reference_surface(c, c, 0);
        double sign = 0.0;
        for (int i = 0; i < 120; i++) {
            const double uv[2] = {random_unit(&state), i < 20 ? 1.0 : 0.99 * random_unit(&state)};
            double p[3], normal[3], h[4];
            nurbs_surface_eval(s, 0, 1, uv, p);
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_normals(s, 1, uv, normal), NURBS_OK);
            const double along = p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2];
            if (sign == 0.0)
                sign = along > 0.0 ? 1.0 : -1.0;
            CHECK_CLOSE(along, sign, 1e-13);
            if (i < 20) {
                CU_ASSERT_EQUAL(nurbs_surface_curvatures(s, 1, uv, h), NURBS_ERROR_GEOMETRY);
                continue;
            }
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_curvatures(s, 1, uv, h), NURBS_OK);
            CHECK_CLOSE(h[0], -sign, 1e-9);
            CHECK_CLOSE(h[1], 1.0, 1e-9);
            CHECK_CLOSE(h[2], -sign, 1e-9);
            CHECK_CLOSE(h[3], -sign, 1e-9);
        }
        nurbs_surface_free(s);
    }
    CU_ASSERT(found);
    reference_free(&ref);
}

/* z = x^2/2 a + x y b + y^2/2 c as a biquadratic, at the origin and elsewhere against the formulas
 * of a graph. */
static void test_graph(void)
{
    const double a = 0.7, b = -0.4, c = 1.9;
    const int degree[2] = {2, 2};
    const size_t size[2] = {3, 3};
    const double knots[] = {0, 0, 0, 1, 1, 1}, node[3] = {-1, 0, 1}, square[3] = {1, -1, 1};
    double points[27];
    for (size_t i = 0; i < 3; i++)
        for (size_t j = 0; j < 3; j++) {
            points[3 * (3 * i + j)] = node[i];
            points[3 * (3 * i + j) + 1] = node[j];
            points[3 * (3 * i + j) + 2] =
                0.5 * a * square[i] + b * node[i] * node[j] + 0.5 * c * square[j];
        }
    nurbs_surface *s;
    uint64_t state = 72;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, knots, knots, points, NULL, &s),
                          NURBS_OK);
    for (int i = 0; i < 50; i++) {
        const double uv[2] = {i ? random_unit(&state) : 0.5, i ? random_unit(&state) : 0.5};
        const double x = 2.0 * uv[0] - 1.0, y = 2.0 * uv[1] - 1.0;
        const double zx = a * x + b * y, zy = b * x + c * y, w = 1.0 + zx * zx + zy * zy;
        const double gaussian = (a * c - b * b) / (w * w);
        const double mean =
            ((1.0 + zy * zy) * a - 2.0 * zx * zy * b + (1.0 + zx * zx) * c) / (2.0 * w * sqrt(w));
        double h[4], normal[3];
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_curvatures(s, 1, uv, h), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_normals(s, 1, uv, normal), NURBS_OK);
        CHECK_CLOSE(h[0], mean, 1e-13);
        CHECK_CLOSE(h[1], gaussian, 1e-13);
        CHECK_CLOSE(h[2] * h[3], gaussian, 1e-13);
        CHECK_CLOSE(h[2] + h[3], 2.0 * mean, 1e-13);
        CU_ASSERT(h[2] <= h[3]);
        CHECK_CLOSE(normal[0], -zx / sqrt(w), 1e-14);
        CHECK_CLOSE(normal[1], -zy / sqrt(w), 1e-14);
        CHECK_CLOSE(normal[2], 1.0 / sqrt(w), 1e-14);
    }
    double h[4];
    CU_ASSERT_EQUAL(nurbs_surface_curvatures(s, 1, (const double[]){2, 0}, h),
                    NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_surface_normals(NULL, 1, h, h), NURBS_ERROR_ARGUMENT);
    nurbs_surface_free(s);
}

/* The twisted cubic (t, t^2, t^3): curvature and torsion in closed form; a circle; a point. */
static void test_curves(void)
{
    const double knots[] = {0, 0, 0, 0, 1, 1, 1, 1};
    const double points[] = {0, 0, 0, 1. / 3, 0, 0, 2. / 3, 1. / 3, 0, 1, 1, 1};
    nurbs_curve *c;
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(3, 4, knots, points, NULL, &c), NURBS_OK);
    for (int i = 0; i <= 20; i++) {
        const double t = i / 20.0, t2 = t * t;
        const double q = 9.0 * t2 * t2 + 9.0 * t2 + 1.0, speed = 1.0 + 4.0 * t2 + 9.0 * t2 * t2;
        double out[2];
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_curvatures(c, 1, &t, out), NURBS_OK);
        CHECK_CLOSE(out[0], 2.0 * sqrt(q) / (speed * sqrt(speed)), 1e-13);
        CHECK_CLOSE(out[1], 3.0 / q, 1e-13);
    }
    nurbs_curve_free(c);
    const double w = sqrt(0.5), quarter[] = {2, 0, 0, 2, 2, 0, 0, 2, 0};
    const double arc_knots[] = {0, 0, 0, 1, 1, 1};
    CU_ASSERT_EQUAL_FATAL(
        nurbs_curve_create(2, 3, arc_knots, quarter, (const double[]){1, w, 1}, &c), NURBS_OK);
    for (int i = 0; i <= 20; i++) {
        const double t = i / 20.0;
        double out[2];
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_curvatures(c, 1, &t, out), NURBS_OK);
        CHECK_CLOSE(out[0], 0.5, 1e-13);
        CHECK_CLOSE(out[1], 0.0, 1e-12);
    }
    nurbs_curve_free(c);
    const double nowhere[9] = {0}, t = 0.5;
    double out[2];
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(2, 3, arc_knots, nowhere, NULL, &c), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_curve_curvatures(c, 1, &t, out), NURBS_ERROR_GEOMETRY);
    nurbs_curve_free(c);
}

static const struct check_case cases[] = {
    {"sphere with a collapsed edge", test_sphere},
    {"graph of a quadratic", test_graph},
    {"curves", test_curves},
};

CHECK_MAIN("geometry", cases)
