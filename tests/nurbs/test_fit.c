#include "check.h"
#include "hulls.h"

#include <string.h>

static const double corner[12] = {0, 0, 0, 3, 0, 0, 3, 4, 0, 3, 4, 12};

static void parametrizations(void)
{
    double u[4];
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_UNIFORM, 4, corner, u), NURBS_OK);
    CHECK_CLOSE(u[1], 1.0 / 3, 1e-16);
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_CHORD, 4, corner, u), NURBS_OK);
    CHECK_CLOSE(u[1], 3.0 / 19, 1e-16);
    CHECK_CLOSE(u[2], 7.0 / 19, 1e-16);
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_CENTRIPETAL, 4, corner, u), NURBS_OK);
    double total = sqrt(3) + 2 + sqrt(12);
    CHECK_CLOSE(u[1], sqrt(3) / total, 1e-15);
    CHECK_CLOSE(u[3], 1, 0);
    /* Foley: right angles stretch by 1 + 1.5 (pi/2) d_before / (d_before + d) and likewise after.
     */
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_FOLEY, 4, corner, u), NURBS_OK);
    double a = 1.5 * acos(0), first = 3 * (1 + a * 4 / 7),
           second = 4 * (1 + a * 3 / 7 + a * 12 / 16), third = 12 * (1 + a * 4 / 16);
    CHECK_CLOSE(u[1], first / (first + second + third), 1e-15);
    CHECK_CLOSE(u[2], (first + second) / (first + second + third), 1e-15);
}

static void coincident_points(void)
{
    double p[12] = {0, 0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0}, u[4];
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_CHORD, 4, p, u), NURBS_OK);
    CHECK_CLOSE(u[1], 0.5, 0);
    CHECK_CLOSE(u[2], 0.5, 0);
    double same[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_CENTRIPETAL, 3, same, u), NURBS_OK);
    CHECK_CLOSE(u[1], 0.5, 0);
    p[4] = INFINITY;
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_CHORD, 4, p, u), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_CHORD, 1, p, u), NURBS_ERROR_ARGUMENT);
}

/* Points of a polynomial of the curve's degree give that polynomial back. */
static void interpolation_reproduces_polynomials(void)
{
    for (int degree = 1; degree <= 5; degree++) {
        double u[12], p[36];
        for (size_t k = 0; k < 12; k++) {
            u[k] = 0.3 * (double)k + 0.05 * (double)(k * k);
            p[3 * k] = u[k];
            p[3 * k + 1] = pow(u[k], degree);
            p[3 * k + 2] = 1 - 2 * pow(u[k], degree - 1);
        }
        nurbs_curve *curve;
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_interpolate(degree, 12, p, u, &curve), NURBS_OK);
        double largest = pow(u[11], degree);
        for (int k = 0; k <= 100; k++) {
            double t = u[11] * k / 100, q[3];
            CU_ASSERT_EQUAL(nurbs_curve_eval(curve, 0, 1, &t, q), NURBS_OK);
            CHECK_CLOSE(q[0], t, 1e-13 * u[11]);
            CHECK_CLOSE(q[1], pow(t, degree), 1e-13 * largest);
        }
        nurbs_curve_free(curve);
    }
}

/* The NURBS Book, example 9.1: five points, degree 3, chord parameters 0, 5/17, 9/17, 14/17, 1. */
static void interpolation_of_the_book(void)
{
    const double p[15] = {0, 0, 0, 3, 4, 0, -1, 4, 0, -4, 0, 0, -4, -3, 0};
    double u[5];
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_CHORD, 5, p, u), NURBS_OK);
    CHECK_CLOSE(u[1], 5.0 / 17, 1e-15);
    CHECK_CLOSE(u[2], 9.0 / 17, 1e-15);
    CHECK_CLOSE(u[3], 14.0 / 17, 1e-15);
    nurbs_curve *curve;
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_interpolate(3, 5, p, u, &curve), NURBS_OK);
    CHECK_CLOSE(nurbs_curve_knots(curve)[4], 28.0 / 51, 1e-15);
    double q[15];
    CU_ASSERT_EQUAL(nurbs_curve_eval(curve, 0, 5, u, q), NURBS_OK);
    for (int k = 0; k < 15; k++)
        CHECK_CLOSE(q[k], p[k], 1e-14);
    nurbs_curve_free(curve);
}

static void interpolation_refuses(void)
{
    double u[4] = {0, 0.5, 0.5, 1};
    nurbs_curve *curve;
    CU_ASSERT_EQUAL(nurbs_curve_interpolate(3, 4, corner, u, &curve), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(curve);
    u[2] = 0.75;
    CU_ASSERT_EQUAL(nurbs_curve_interpolate(4, 4, corner, u, &curve), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_curve_interpolate(0, 4, corner, u, &curve), NURBS_ERROR_ARGUMENT);
    u[3] = NAN;
    CU_ASSERT_EQUAL(nurbs_curve_interpolate(3, 4, corner, u, &curve), NURBS_ERROR_ARGUMENT);
}

static void make_wave(size_t n, double *u, double *p)
{
    for (size_t k = 0; k < n; k++) {
        u[k] = (double)k / (double)(n - 1);
        p[3 * k] = 10 * u[k];
        p[3 * k + 1] = sin(6 * u[k]);
        p[3 * k + 2] = exp(-u[k]);
    }
}

static void uniform_knots(int degree, size_t size, double *knots)
{
    size_t p = (size_t)degree;
    for (size_t k = 0; k < size + p + 1; k++)
        knots[k] = k <= p ? 0 : k >= size ? 1 : (double)(k - p) / (double)(size - p);
}

/* Halving the spans of a cubic fit divides its error by about 2^4. */
static void least_squares_converges_with_order_four(void)
{
    enum { N = 801 };
    static double u[N], p[3 * N], q[3 * N];
    double knots[60], before = 0;
    make_wave(N, u, p);
    for (size_t spans = 8; spans <= 32; spans *= 2) {
        nurbs_curve *curve;
        uniform_knots(3, spans + 3, knots);
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_fit(3, spans + 3, knots, N, p, u, &curve), NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_curve_eval(curve, 0, N, u, q), NURBS_OK);
        double worst = 0;
        for (size_t k = 0; k < 3 * N; k++)
            worst = fmax(worst, fabs(q[k] - p[k]));
        if (before > 0)
            CU_ASSERT(log2(before / worst) > 3.5);
        before = worst;
        for (int c = 0; c < 3; c++) {
            CHECK_CLOSE(q[c], p[c], 0);
            CHECK_CLOSE(q[3 * N - 3 + c], p[3 * N - 3 + c], 0);
        }
        nurbs_curve_free(curve);
    }
}

/* The residual of a least-squares fit is orthogonal to every inner basis function. */
static void least_squares_residual_is_orthogonal(void)
{
    enum { N = 60, SIZE = 12 };
    double u[N], p[3 * N], q[3 * N], knots[SIZE + 4], sums[3 * SIZE] = {0}, basis[4];
    make_wave(N, u, p);
    for (size_t k = 0; k < N; k++)
        p[3 * k + 1] += 0.1 * ((double)((k * 7919) % 13) / 13 - 0.5);
    uniform_knots(3, SIZE, knots);
    nurbs_curve *curve;
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_fit(3, SIZE, knots, N, p, u, &curve), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_curve_eval(curve, 0, N, u, q), NURBS_OK);
    for (size_t k = 0; k < N; k++) {
        size_t span = nurbs_basis_span(3, SIZE, knots, u[k], NULL);
        nurbs_basis(3, knots, span, u[k], basis);
        for (size_t a = 0; a < 4; a++)
            for (size_t c = 0; c < 3; c++)
                sums[3 * (span - 3 + a) + c] += basis[a] * (q[3 * k + c] - p[3 * k + c]);
    }
    for (size_t k = 3; k < 3 * (SIZE - 1); k++)
        CHECK_CLOSE(sums[k], 0, 1e-13);
    nurbs_curve_free(curve);
}

static void least_squares_refuses(void)
{
    double u[8] = {0, 0.1, 0.2, 0.25, 0.3, 0.35, 0.4, 1}, p[24] = {0}, knots[11];
    nurbs_curve *curve;
    uniform_knots(3, 7, knots);
    CU_ASSERT_EQUAL(nurbs_curve_fit(3, 7, knots, 6, p, u, &curve), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_curve_fit(3, 7, knots, 8, p, u, &curve), NURBS_ERROR_NUMERIC);
    u[7] = 0.9;
    CU_ASSERT_EQUAL(nurbs_curve_fit(3, 7, knots, 8, p, u, &curve), NURBS_ERROR_ARGUMENT);
    u[7] = 1;
    p[5] = NAN;
    CU_ASSERT_EQUAL(nurbs_curve_fit(3, 7, knots, 8, p, u, &curve), NURBS_ERROR_ARGUMENT);
    knots[5] = 0.1;
    CU_ASSERT_EQUAL(nurbs_curve_fit(3, 7, knots, 8, p, u, &curve), NURBS_ERROR_ARGUMENT);
}

/* A fit on the surface's own knots gives the surface back. */
static void surface_fit_restores_a_spline(void)
{
    struct hull5415 hull;
    CU_ASSERT_FATAL(hull5415_load(&hull));
    const int degree[2] = {nurbs_surface_degree(hull.surface, 0),
                           nurbs_surface_degree(hull.surface, 1)};
    const size_t size[2] = {nurbs_surface_size(hull.surface, 0),
                            nurbs_surface_size(hull.surface, 1)};
    enum { NU = 400, NV = 120 };
    double u[NU], v[NV];
    for (size_t k = 0; k < NU; k++)
        u[k] = (double)k / (NU - 1);
    for (size_t k = 0; k < NV; k++)
        v[k] = (double)k / (NV - 1);
    nurbs_grid *grid;
    nurbs_surface *fitted;
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_sample(hull.surface, NU, u, NV, v, &grid), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_fit(degree, size, nurbs_surface_knots(hull.surface, 0),
                                            nurbs_surface_knots(hull.surface, 1), grid, u, v,
                                            &fitted),
                          NURBS_OK);
    CHECK_CLOSE(surface_distance(hull.surface, fitted, 101), 0, 1e-11);
    nurbs_surface_free(fitted);
    nurbs_grid_free(grid);
    hull5415_free(&hull);
}

static const struct check_case cases[] = {
    {"parametrizations", parametrizations},
    {"coincident points", coincident_points},
    {"interpolation reproduces polynomials", interpolation_reproduces_polynomials},
    {"interpolation of the book", interpolation_of_the_book},
    {"interpolation refuses", interpolation_refuses},
    {"least squares converges with order four", least_squares_converges_with_order_four},
    {"least-squares residual is orthogonal", least_squares_residual_is_orthogonal},
    {"least squares refuses", least_squares_refuses},
    {"surface fit restores a spline", surface_fit_restores_a_spline},
};

CHECK_MAIN("nurbs fit", cases)
