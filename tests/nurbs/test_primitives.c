#include "check.h"
#include "hulls.h"

#include <string.h>

static void ellipsoid_satisfies_its_equation(void)
{
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(3, 0.8, 0.5, 0.7, &surface), NURBS_OK);
    for (int i = 0; i <= 40; i++)
        for (int j = 0; j <= 40; j++) {
            double uv[2] = {i / 40.0, j / 40.0}, p[9], n[3];
            CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 1, 1, uv, p), NURBS_OK);
            double x = p[0] / 1.5, y = p[1] / 0.4, z = (p[2] + 0.7) / 0.25;
            CHECK_CLOSE(x * x + y * y + z * z, 1, 4e-15);
            CU_ASSERT(p[1] >= 0);
            n[0] = p[4] * p[8] - p[5] * p[7];
            n[1] = p[5] * p[6] - p[3] * p[8];
            n[2] = p[3] * p[7] - p[4] * p[6];
            /* Outward: along the gradient of the equation. */
            CU_ASSERT(n[0] * x / 1.5 + n[1] * y / 0.4 + n[2] * z / 0.25 >= -1e-12);
        }
    nurbs_surface_free(surface);
}

static void ellipsoid_runs_aft_to_fore_and_top_to_bottom(void)
{
    nurbs_surface *surface;
    double p[9];
    const double uv[6] = {0, 0.3, 1, 0.3, 0.5, 0};
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(3, 0.8, 0.5, 0.7, &surface), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 0, 3, uv, p), NURBS_OK);
    CHECK_CLOSE(p[0], -1.5, 1e-15);
    CHECK_CLOSE(p[3], 1.5, 1e-15);
    CHECK_CLOSE(p[8], -0.45, 1e-15);
    nurbs_surface_free(surface);
}

/* The middle knot is a knot of the shape only for its users' sake: across it the third derivative,
 * by differences from either side, is the same. On a sphere the angle of a meridian runs at a speed
 * that is constant within 1.1 %. */
static void ellipsoid_is_smooth_in_its_parameters(void)
{
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(6, 1, 0.8, 1, &surface), NURBS_OK);
    for (int d = 0; d < 2; d++) {
        const double h = 1e-4;
        double second[3][18], uv[6] = {0.3, 0.3, 0.3, 0.3, 0.3, 0.3};
        for (int k = 0; k < 3; k++)
            uv[2 * k + d] = 0.5 + (k - 1) * h;
        CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 2, 3, uv, second[0]), NURBS_OK);
        for (int c = 0; c < 3; c++) {
            const double *at = second[0] + (d == 0 ? 9 : 15) + c;
            CHECK_CLOSE((at[36] - at[18]) / h, (at[18] - at[0]) / h, 1e3 * h);
        }
    }
    nurbs_surface_free(surface);
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(2, 2, 2, 3, &surface), NURBS_OK);
    for (int k = 0; k <= 20; k++) {
        const double uv[2] = {k / 20.0, 0.5};
        double p[9];
        CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 1, 1, uv, p), NURBS_OK);
        CHECK_RELATIVE(sqrt(p[3] * p[3] + p[4] * p[4] + p[5] * p[5]), 3.14159265358979323846,
                       0.012);
    }
    nurbs_surface_free(surface);
}

static void wigley_satisfies_its_equation(void)
{
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(2.5, 0.25, 0.16, &surface), NURBS_OK);
    CU_ASSERT_PTR_NULL(nurbs_surface_weights(surface));
    for (int i = 0; i <= 40; i++)
        for (int j = 0; j <= 40; j++) {
            double uv[2] = {i / 40.0, j / 40.0}, p[9];
            CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 1, 1, uv, p), NURBS_OK);
            double x = 2 * p[0] / 2.5, z = p[2] / 0.16;
            CHECK_CLOSE(p[1], 0.125 * (1 - x * x) * (1 - z * z), 1e-16);
            CHECK_CLOSE(p[0], 2.5 * (uv[0] - 0.5), 1e-15);
            CU_ASSERT(p[5] * p[6] - p[3] * p[8] > 0); /* n_y: to port */
        }
    nurbs_surface_free(surface);
}

static void refuses_lengths_that_are_none(void)
{
    nurbs_surface *surface;
    const double bad[4] = {0, -1, NAN, INFINITY};
    for (int k = 0; k < 4; k++) {
        CU_ASSERT_EQUAL(nurbs_make_ellipsoid(bad[k], 1, 1, 0, &surface), NURBS_ERROR_ARGUMENT);
        CU_ASSERT_EQUAL(nurbs_make_ellipsoid(1, 1, bad[k], 0, &surface), NURBS_ERROR_ARGUMENT);
        CU_ASSERT_EQUAL(nurbs_make_wigley(1, bad[k], 1, &surface), NURBS_ERROR_ARGUMENT);
        CU_ASSERT_PTR_NULL(surface);
    }
    CU_ASSERT_EQUAL(nurbs_make_ellipsoid(1, 1, 1, NAN, &surface), NURBS_ERROR_ARGUMENT);
}

static const struct check_case cases[] = {
    {"ellipsoid satisfies its equation", ellipsoid_satisfies_its_equation},
    {"ellipsoid is smooth in its parameters", ellipsoid_is_smooth_in_its_parameters},
    {"ellipsoid runs aft to fore, top to bottom", ellipsoid_runs_aft_to_fore_and_top_to_bottom},
    {"wigley satisfies its equation", wigley_satisfies_its_equation},
    {"refuses lengths that are none", refuses_lengths_that_are_none},
};

CHECK_MAIN("nurbs primitives", cases)
