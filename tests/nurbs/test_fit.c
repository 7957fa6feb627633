#include "check.h"
#include "hulls.h"

#include <string.h>

static const double corner[12] = {0, 0, 0, 3, 0, 0, 3, 4, 0, 3, 4, 12};

static void parametrizations(void)
{
    double u[4];
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_PARAMETRIZATION_UNIFORM, 4, corner, u), NURBS_OK);
    CHECK_CLOSE(u[1], 1.0 / 3, 1e-16);
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_PARAMETRIZATION_CHORD, 4, corner, u), NURBS_OK);
    CHECK_CLOSE(u[1], 3.0 / 19, 1e-16);
    CHECK_CLOSE(u[2], 7.0 / 19, 1e-16);
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_PARAMETRIZATION_CENTRIPETAL, 4, corner, u), NURBS_OK);
    double total = sqrt(3) + 2 + sqrt(12);
    CHECK_CLOSE(u[1], sqrt(3) / total, 1e-15);
    CHECK_CLOSE(u[3], 1, 0);
    /* Foley: right angles stretch by 1 + 1.5 (pi/2) d_before / (d_before + d) and likewise after.
     */
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_PARAMETRIZATION_FOLEY, 4, corner, u), NURBS_OK);
    double a = 1.5 * acos(0), first = 3 * (1 + a * 4 / 7),
           second = 4 * (1 + a * 3 / 7 + a * 12 / 16), third = 12 * (1 + a * 4 / 16);
    CHECK_CLOSE(u[1], first / (first + second + third), 1e-15);
    CHECK_CLOSE(u[2], (first + second) / (first + second + third), 1e-15);
}

static void coincident_points(void)
{
    double p[12] = {0, 0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0}, u[4];
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_PARAMETRIZATION_CHORD, 4, p, u), NURBS_OK);
    CHECK_CLOSE(u[1], 0.5, 0);
    CHECK_CLOSE(u[2], 0.5, 0);
    double same[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_PARAMETRIZATION_CENTRIPETAL, 3, same, u), NURBS_OK);
    CHECK_CLOSE(u[1], 0.5, 0);
    p[4] = INFINITY;
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_PARAMETRIZATION_CHORD, 4, p, u), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_PARAMETRIZATION_CHORD, 1, p, u), NURBS_ERROR_ARGUMENT);
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
    CU_ASSERT_EQUAL(nurbs_parametrize(NURBS_PARAMETRIZATION_CHORD, 5, p, u), NURBS_OK);
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

/* Scattered points of a spline, more than it has control points, give it back. */
static void scattered_points_restore_a_spline(void)
{
    enum { N = 900, SIZE = 8 };
    static double uv[2 * N], p[3 * N];
    double knots[SIZE + 4], net[3 * SIZE * SIZE];
    const int degree[2] = {3, 3};
    const size_t size[2] = {SIZE, SIZE};
    nurbs_surface *spline, *fitted;
    uniform_knots(3, SIZE, knots);
    for (size_t k = 0; k < 3 * SIZE * SIZE; k++)
        net[k] = sin(1.7 * (double)k) + (double)(k % 3);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, knots, knots, net, NULL, &spline),
                          NURBS_OK);
    for (size_t k = 0; k < N; k++) { /* an additive sequence fills the square */
        uv[2 * k] = fmod(0.5 + 0.7548776662466927 * (double)k, 1);
        uv[2 * k + 1] = fmod(0.5 + 0.5698402909980532 * (double)k, 1);
    }
    CU_ASSERT_EQUAL(nurbs_surface_eval(spline, 0, N, uv, p), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(
        nurbs_surface_fit_points(degree, size, knots, knots, N, p, uv, 0, &fitted), NURBS_OK);
    CHECK_CLOSE(surface_distance(spline, fitted, 41), 0, 1e-9);
    nurbs_surface_free(fitted);
    /* Too few points: refused without smoothing, determined with it. */
    CU_ASSERT_EQUAL(nurbs_surface_fit_points(degree, size, knots, knots, 30, p, uv, 0, &fitted),
                    NURBS_ERROR_NUMERIC);
    CU_ASSERT_PTR_NULL(fitted);
    CU_ASSERT_EQUAL(nurbs_surface_fit_points(degree, size, knots, knots, 30, p, uv, 1e-6, &fitted),
                    NURBS_OK);
    nurbs_surface_free(fitted);
    uv[1] = 1.5;
    CU_ASSERT_EQUAL(nurbs_surface_fit_points(degree, size, knots, knots, N, p, uv, 0, &fitted),
                    NURBS_ERROR_ARGUMENT);
    nurbs_surface_free(spline);
}

/* Smoothing leaves planes alone and, when strong, turns anything into the best plane. */
static void smoothing_prefers_planes(void)
{
    enum { N = 400, SIZE = 7 };
    double uv[2 * N], p[3 * N], knots[SIZE + 4], q[3];
    const int degree[2] = {3, 2};
    const size_t size[2] = {SIZE, SIZE};
    double knots_v[SIZE + 3];
    nurbs_surface *fitted;
    uniform_knots(3, SIZE, knots);
    uniform_knots(2, SIZE, knots_v);
    for (size_t k = 0; k < N; k++) {
        double u = ((double)(k / 20) + 0.5) / 20, v = ((double)(k % 20) + 0.5) / 20;
        uv[2 * k] = u;
        uv[2 * k + 1] = v;
        p[3 * k] = 2 * u - v;
        p[3 * k + 1] = 1 + u + v;
        p[3 * k + 2] = (k % 2 ? 0.1 : -0.1) + 3 * v; /* rows of opposite noise */
    }
    CU_ASSERT_EQUAL_FATAL(
        nurbs_surface_fit_points(degree, size, knots, knots_v, N, p, uv, 10, &fitted), NURBS_OK);
    for (int k = 0; k <= 20; k++) {
        double at[2] = {k / 20.0, 1 - k / 20.0};
        CU_ASSERT_EQUAL(nurbs_surface_eval(fitted, 0, 1, at, q), NURBS_OK);
        CHECK_CLOSE(q[0], 2 * at[0] - at[1], 1e-8);
        CHECK_CLOSE(q[1], 2, 1e-8);
        CHECK_CLOSE(q[2], 3 * at[1], 0.03);
    }
    nurbs_surface_free(fitted);
}

static nurbs_curve *cubic(const double points[12])
{
    static const double knots[8] = {2, 2, 2, 2, 5, 5, 5, 5};
    nurbs_curve *curve;
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(3, 4, knots, points, NULL, &curve), NURBS_OK);
    return curve;
}

/* Edges of different degrees and knots come back exactly, and so does a bilinear surface. */
static void coons_keeps_its_edges(void)
{
    const double a[12] = {0, 0, 0, 1, 0, 1, 2, 0, -1, 3, 0, 0},
                 b[12] = {0, 2, 1, 1, 3, 1, 2, 2, 2, 3, 2, 0}, c[9] = {0, 0, 0, -1, 1, 2, 0, 2, 1},
                 d[12] = {3, 0, 0, 3, 0.5, 1, 4, 1, 1, 3, 2, 0}, quadratic[6] = {0, 0, 0, 1, 1, 1},
                 split[7] = {0, 0, 0, 0.3, 1, 1, 1};
    nurbs_curve *u[2] = {cubic(a), cubic(b)}, *v[2];
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(2, 3, quadratic, c, NULL, &v[0]), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(2, 4, split, d, NULL, &v[1]), NURBS_OK);
    nurbs_surface *patch;
    nurbs_status status = nurbs_coons(u[0], u[1], v[0], v[1], &patch);
    if (status != NURBS_OK)
        fprintf(stderr, "%s\n", nurbs_last_error());
    CU_ASSERT_EQUAL_FATAL(status, NURBS_OK);
    for (int e = 0; e < 4; e++)
        for (int k = 0; k <= 30; k++) {
            double t = k / 30.0, uv[2] = {e < 2 ? t : e - 2, e < 2 ? e : t},
                   s = e < 2 ? fmin(2 + 3 * t, 5) : t, p[3], q[3];
            CU_ASSERT_EQUAL(nurbs_surface_eval(patch, 0, 1, uv, p), NURBS_OK);
            CU_ASSERT_EQUAL(nurbs_curve_eval(e < 2 ? u[e] : v[e - 2], 0, 1, &s, q), NURBS_OK);
            for (int x = 0; x < 3; x++)
                CHECK_CLOSE(p[x], q[x], 1e-14);
        }
    nurbs_surface_free(patch);
    CU_ASSERT_EQUAL(nurbs_coons(u[1], u[0], v[0], v[1], &patch), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "corner"));
    CU_ASSERT_PTR_NULL(patch);
    CU_ASSERT_EQUAL_FATAL(nurbs_ruled(u[0], u[1], &patch), NURBS_OK);
    const double uv[2] = {0.4, 0.25}, s = 2 + 3 * 0.4;
    double p[3], q[3], r[3];
    CU_ASSERT_EQUAL(nurbs_surface_eval(patch, 0, 1, uv, p), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_curve_eval(u[0], 0, 1, &s, q), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_curve_eval(u[1], 0, 1, &s, r), NURBS_OK);
    for (int x = 0; x < 3; x++)
        CHECK_CLOSE(p[x], 0.75 * q[x] + 0.25 * r[x], 1e-14);
    nurbs_surface_free(patch);
    for (int k = 0; k < 2; k++) {
        nurbs_curve_free(u[k]);
        nurbs_curve_free(v[k]);
    }
}

/* A surface of the degrees themselves comes back; of others the points do. */
static void surface_interpolation(void)
{
    enum { ROWS = 9, COLUMNS = 7 };
    for (int k = 0; k < 4; k++) {
        const int degree[2] = {1 + k, 4 - k};
        double u[ROWS], v[COLUMNS];
        nurbs_grid *grid;
        nurbs_surface *s;
        CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(ROWS, COLUMNS, NULL, &grid), NURBS_OK);
        for (size_t i = 0; i < ROWS; i++)
            u[i] = 0.5 * (double)i + 0.03 * (double)(i * i);
        for (size_t j = 0; j < COLUMNS; j++)
            v[j] = -1.0 + 0.2 * (double)j + 0.02 * (double)(j * j);
        for (int exact = 0; exact < 2; exact++) {
            for (size_t i = 0; i < ROWS; i++)
                for (size_t j = 0; j < COLUMNS; j++) {
                    double *p = nurbs_grid_edit(grid) + 3 * (i * COLUMNS + j);
                    p[0] = u[i];
                    p[1] = exact ? pow(u[i], degree[0]) * pow(v[j], degree[1]) : sin(u[i] * v[j]);
                    p[2] = 2.0 * v[j];
                }
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_interpolate(degree, grid, u, v, &s), NURBS_OK);
            CU_ASSERT_EQUAL(nurbs_surface_size(s, 0), ROWS);
            CU_ASSERT_EQUAL(nurbs_surface_size(s, 1), COLUMNS);
            for (size_t i = 0; i < ROWS; i++)
                for (size_t j = 0; j < COLUMNS; j++) {
                    double at[2] = {u[i], v[j]}, q[3];
                    CU_ASSERT_EQUAL(nurbs_surface_eval(s, 0, 1, at, q), NURBS_OK);
                    for (size_t c = 0; c < 3; c++)
                        CHECK_CLOSE(q[c], nurbs_grid_points(grid)[3 * (i * COLUMNS + j) + c],
                                    1e-11);
                }
            const double at[2] = {0.37 * u[ROWS - 1], 0.21};
            double q[3];
            CU_ASSERT_EQUAL(nurbs_surface_eval(s, 0, 1, at, q), NURBS_OK);
            if (exact)
                CHECK_CLOSE(q[1], pow(at[0], degree[0]) * pow(at[1], degree[1]), 1e-11);
            nurbs_surface_free(s);
        }
        u[3] = u[2];
        CU_ASSERT_EQUAL(nurbs_surface_interpolate(degree, grid, u, v, &s), NURBS_ERROR_ARGUMENT);
        CU_ASSERT_PTR_NULL(s);
        CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "direction u"));
        nurbs_grid_free(grid);
    }
}

static const struct check_case cases[] = {
    {"interpolation of a grid at given parameters", surface_interpolation},
    {"parametrizations", parametrizations},
    {"coincident points", coincident_points},
    {"interpolation reproduces polynomials", interpolation_reproduces_polynomials},
    {"interpolation of the book", interpolation_of_the_book},
    {"interpolation refuses", interpolation_refuses},
    {"least squares converges with order four", least_squares_converges_with_order_four},
    {"least-squares residual is orthogonal", least_squares_residual_is_orthogonal},
    {"least squares refuses", least_squares_refuses},
    {"surface fit restores a spline", surface_fit_restores_a_spline},
    {"scattered points restore a spline", scattered_points_restore_a_spline},
    {"smoothing prefers planes", smoothing_prefers_planes},
    {"coons keeps its edges", coons_keeps_its_edges},
};

CHECK_MAIN("nurbs fit", cases)
