/* The Green function of pairs, the short-wave filter, closed-form resistances and wave amplitudes.
 */
#include "check.h"

#include <igabem/kelvin.h>

#include <string.h>

static const double pi = 3.14159265358979323846;

static const double field[][3] = {
    {1.2, 0.3, -0.4}, {-3, 0.5, -0.2}, {-9, -2, -1}, {0.4, 0, -0.7}, {-2, 1, 0}};
static const double source[][3] = {
    {0, 0, -0.5}, {0.3, 0.1, -0.6}, {1, 0.4, -0.3}, {2, 0.2, -0.1}, {0, 0, -0.8}};
enum { PAIRS = 5, ALL = IGABEM_RANKINE | IGABEM_IMAGE | IGABEM_LOCAL | IGABEM_WAVE };

static void green(double k0, const double *P, const double *Q, unsigned parts, double *g)
{
    CU_ASSERT_EQUAL(
        igabem_kelvin_green(k0, 1, P, P + 1, P + 2, Q, Q + 1, Q + 2, parts, g, g + 1, g + 2, g + 3),
        IGABEM_OK);
}

/* 4 pi G = -1/r + 1/r' + k0 (N + W) from the dimensionless parts. */
static void parts_add_up(void)
{
    const double k0 = 1.7;
    for (int i = 0; i < PAIRS; i++) {
        const double *P = field[i], *Q = source[i];
        double d[3] = {P[0] - Q[0], P[1] - Q[1], P[2] - Q[2]}, above = P[2] + Q[2];
        double X = k0 * d[0], Y = k0 * d[1], Z = k0 * above, N[4], W[4], g[4], sum[4] = {0};
        igabem_kelvin_local(1, &X, &Y, &Z, N, N + 1, N + 2, N + 3);
        igabem_kelvin_wave(1, &X, &Y, &Z, W, W + 1, W + 2, W + 3);
        double r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        double image = sqrt(d[0] * d[0] + d[1] * d[1] + above * above);
        green(k0, P, Q, ALL, g);
        CHECK_RELATIVE(4 * pi * g[0], -1 / r + 1 / image + k0 * (N[0] + W[0]), 1e-13);
        double gx = d[0] / (r * r * r) - d[0] / (image * image * image) + k0 * k0 * (N[1] + W[1]);
        CHECK_CLOSE(4 * pi * g[1], gx, 1e-12 * (fabs(gx) + 1));
        for (unsigned part = 1; part <= 8; part *= 2) {
            double one[4];
            green(k0, P, Q, part, one);
            for (int k = 0; k < 4; k++)
                sum[k] += one[k];
        }
        for (int k = 0; k < 4; k++)
            CHECK_CLOSE(sum[k], g[k], 1e-14 * (fabs(g[k]) + 1));
    }
}

/* The gradient is that of the value, the second derivatives those of the gradient; G is harmonic;
 * and G_xx + k0 G_z = 0 on z = 0. */
static void derivatives(void)
{
    const double k0 = 1.3, h = 1e-4;
    for (int i = 0; i < PAIRS - 1; i++) {
        double g[4], H[6];
        const double *P = field[i], *Q = source[i];
        green(k0, P, Q, ALL, g);
        CU_ASSERT_EQUAL(igabem_kelvin_green_second(k0, 1, P, P + 1, P + 2, Q, Q + 1, Q + 2, ALL, H,
                                                   H + 1, H + 2, H + 3, H + 4, H + 5),
                        IGABEM_OK);
        CHECK_CLOSE(H[0] + H[3] + H[5], 0, 1e-8 * (fabs(H[0]) + 1));
        for (int axis = 0; axis < 3; axis++) {
            double a[4], b[4], plus[3], minus[3];
            memcpy(plus, P, sizeof plus);
            memcpy(minus, P, sizeof minus);
            plus[axis] += h;
            minus[axis] -= h;
            green(k0, plus, Q, ALL, a);
            green(k0, minus, Q, ALL, b);
            CHECK_CLOSE((a[0] - b[0]) / (2 * h), g[1 + axis], 1e-5 * (fabs(g[1 + axis]) + 1));
            for (int c = axis; c < 3; c++) {
                static const int at[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
                CHECK_CLOSE((a[1 + c] - b[1 + c]) / (2 * h), H[at[axis][c]],
                            1e-5 * (fabs(H[at[axis][c]]) + 1));
            }
        }
    }
    double P[3] = {-2, 1, 0}, Q[3] = {0, 0, -0.8}, g[4], H[6];
    green(k0, P, Q, ALL, g);
    igabem_kelvin_green_second(k0, 1, P, P + 1, P + 2, Q, Q + 1, Q + 2, ALL, H, H + 1, H + 2, H + 3,
                               H + 4, H + 5);
    CHECK_CLOSE(H[0] + k0 * g[3], 0, 1e-9);
}

/* A batch larger than the library's block equals single pairs. */
static void long_batch(void)
{
    enum { N = 150 };
    static double x[N], y[N], z[N], xi[N], eta[N], zeta[N], g[N], gz[N];
    for (int i = 0; i < N; i++) {
        x[i] = 3 * sin(i);
        y[i] = cos(2.0 * i);
        z[i] = -0.1 - 0.01 * i;
        xi[i] = 2 * cos(3.0 * i);
        eta[i] = 0.3 * sin(5.0 * i);
        zeta[i] = -0.05 - 0.02 * i;
    }
    CU_ASSERT_EQUAL(igabem_kelvin_green(2, N, x, y, z, xi, eta, zeta, ALL, g, NULL, NULL, gz),
                    IGABEM_OK);
    for (int i = 0; i < N; i++) {
        double P[3] = {x[i], y[i], z[i]}, Q[3] = {xi[i], eta[i], zeta[i]}, one[4];
        green(2, P, Q, ALL, one);
        CU_ASSERT_EQUAL(g[i], one[0]);
        CU_ASSERT_EQUAL(gz[i], one[3]);
    }
}

/* Where the stationary points are sharpest: numbers, no larger than waves that far away can be. */
static void distant_points(void)
{
    static const double place[][3] = {
        {-2.35264e7, 3.8516e6, -3.03839}, {-1e9, 2e8, -1},    {-1e9, 1e8, 0},
        {-1e9, 3.53553e8, -1e-3},         {-1e7, 2e3, -1e-4}, {-1e9, 1e9, -1e9}};
    for (size_t i = 0; i < sizeof place / sizeof place[0]; i++) {
        const double *P = place[i];
        double W[4];
        CU_ASSERT_EQUAL(igabem_kelvin_wave(1, P, P + 1, P + 2, W, W + 1, W + 2, W + 3), IGABEM_OK);
        for (int k = 0; k < 4; k++)
            CU_ASSERT(fabs(W[k]) < 0.1);
    }
}

/* Form (A) of docs/kelvin.md, differentiated under the integral and integrated in 30 digits: where
 * the slow oracle of the other tests loses the digits of the gradient of N. */
static void far_gradient(void)
{
    static const double P[2][3] = {{-3902.09586, 4.12811705, -0.876450975},
                                   {-1244.0, 1.48, -0.219}};
    static const double exact[2][4] = {{-0.00051241347955179408, -1.3128371687478964e-7,
                                        1.3874588766254572e-10, 3.7768686248199378e-11},
                                       {-0.001606423963964766, -1.290297582151267e-6,
                                        1.5301619093788392e-9, 1.8452444391692999e-9}};
    for (int i = 0; i < 2; i++) {
        double N[4], square = P[i][0] * P[i][0];
        CU_ASSERT_EQUAL(
            igabem_kelvin_local(1, &P[i][0], &P[i][1], &P[i][2], N, N + 1, N + 2, N + 3),
            IGABEM_OK);
        CHECK_RELATIVE(N[0], exact[i][0], 1e-12);
        for (int k = 1; k < 4; k++)
            CHECK_CLOSE(N[k], exact[i][k], 1e-10 / square);
    }
}

static void refusals(void)
{
    const double zero = 0, one = 1, minus = -1, bad = NAN, far = 2e9;
    double out;
    CU_ASSERT_EQUAL(igabem_kelvin_local(0, NULL, NULL, NULL, NULL, NULL, NULL, NULL), IGABEM_OK);
    CU_ASSERT_EQUAL(igabem_kelvin_local(1, NULL, &one, &minus, &out, NULL, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_kelvin_local(1, &zero, &zero, &zero, &out, NULL, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_kelvin_wave(1, &minus, &one, &one, &out, NULL, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT);
    CU_ASSERT(strstr(igabem_last_error(), "point 0") != NULL);
    CU_ASSERT_EQUAL(igabem_kelvin_wave(1, &bad, &one, &minus, &out, NULL, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_kelvin_wave(1, &far, &one, &minus, &out, NULL, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_kelvin_local(1, &far, &one, &minus, &out, NULL, NULL, NULL), IGABEM_OK);
    CU_ASSERT_EQUAL(
        igabem_kelvin_wave_second(1, &minus, &one, &one, &out, NULL, NULL, NULL, NULL, NULL),
        IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_kelvin_green(0, 1, &one, &one, &minus, &zero, &zero, &minus, ALL, &out,
                                        NULL, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_kelvin_green(1, 1, &one, &one, &minus, &zero, &zero, &minus, 32, &out,
                                        NULL, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_kelvin_green(1, 1, &one, &one, &minus, &one, &one, &minus, ALL, &out,
                                        NULL, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_kelvin_green(1, 1, &one, &one, &minus, &one, &one, &minus, IGABEM_LOCAL,
                                        &out, NULL, NULL, NULL),
                    IGABEM_OK);
    CU_ASSERT_EQUAL(igabem_kelvin_green(1, 1, &one, &one, &one, &zero, &zero, &minus, ALL, &out,
                                        NULL, NULL, NULL),
                    IGABEM_ERROR_ARGUMENT);
    igabem_kelvin_filter filter;
    igabem_kelvin_filter_init(&filter);
    filter.depth = -1;
    CU_ASSERT_EQUAL(
        igabem_kelvin_wave_filtered(1, &minus, &one, &minus, &filter, &out, NULL, NULL, NULL),
        IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_kelvin_source_resistance(1000, 1, 0, 1, &out), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_kelvin_sphere_resistance(1000, 9.81, 1, 1, 2, &out),
                    IGABEM_ERROR_ARGUMENT);
}

/* W and gradient by the trapezoid rule on the real t axis, v = asinh t, with the filter factor. */
static void filtered_directly(const double *P, double t_c, double *W)
{
    double C_c = 1 + t_c * t_c, step = 2e-5, limit = asinh(2.6 * sqrt(C_c) + 3);
    memset(W, 0, 4 * sizeof *W);
    for (int k = -(int)(limit / step); k * step <= limit; k++) {
        double t = sinh(k * step), C = cosh(k * step), phase = (P[0] + P[1] * t) * C;
        double size = 4 * step * exp(P[2] * C * C - C * C * C * C / (C_c * C_c)) * C;
        W[0] += size * sin(phase);
        W[1] += size * C * cos(phase);
        W[2] += size * C * t * cos(phase);
        W[3] += size * C * C * sin(phase);
    }
}

static void filter(void)
{
    static const double place[][4] = {
        {-2, 0.3, -0.1, 6}, {-2, 0.3, 0, 6},         {-7, 0, 0, 5},  {-0.1, 0.01, 0, 4},
        {-20, 3, -0.02, 8}, {-15, 0.1, -0.001, 10},  {-5, 6, 0, 3},  {-1, 0.02, 0, 12},
        {-30, 0.5, 0, 5},   {-1e-3, 1e-4, -1e-4, 6}, {-3, 1, -2, 6}, {-8, 2.8, -0.01, 1.5}};
    for (size_t i = 0; i < sizeof place / sizeof place[0]; i++) {
        const double *P = place[i];
        igabem_kelvin_filter f = {.cut_off = P[3]};
        double W[4], direct[4], scale = 1;
        filtered_directly(P, P[3], direct);
        CU_ASSERT_EQUAL(igabem_kelvin_wave_filtered(1, P, P + 1, P + 2, &f, W, W + 1, W + 2, W + 3),
                        IGABEM_OK);
        for (int k = 0; k < 4; k++)
            scale = fmax(scale, fabs(direct[k]));
        CHECK_CLOSE(W[0], direct[0], 1e-9 * fmax(1, fabs(direct[0])));
        for (int k = 1; k < 4; k++)
            CHECK_CLOSE(W[k], P[1] == 0 && k == 2 ? 0 : direct[k], 1e-9 * scale);
    }
    /* Depth: the plain W at the greater depth. A cut-off far beyond what the depth leaves does
     * nothing. */
    double P[3] = {-4, 0.7, -0.01}, deep[3] = {-4, 0.7, -0.3}, a, b;
    igabem_kelvin_filter f = {.depth = 0.3};
    igabem_kelvin_wave_filtered(1, P, P + 1, P + 2, &f, &a, NULL, NULL, NULL);
    igabem_kelvin_wave(1, deep, deep + 1, deep + 2, &b, NULL, NULL, NULL);
    CU_ASSERT_EQUAL(a, b);
    f = (igabem_kelvin_filter){.cut_off = 1e4};
    igabem_kelvin_wave_filtered(1, deep, deep + 1, deep + 2, &f, &a, NULL, NULL, NULL);
    CHECK_CLOSE(a, b, 1e-6);
}

/* R = (rho k0^2/2 pi) Int |H|^2 sqrt(1+t^2) dt of given sources, t = sinh v. */
static double resistance_of(double rho, double k0, size_t n, const double *x, const double *y,
                            const double *z, const double *strength)
{
    double sum = 0, step = 0.02;
    for (int k = -400; k <= 400; k++) {
        double t = sinh(k * step), C = cosh(k * step), hr, hi;
        CU_ASSERT_EQUAL(igabem_kochin_points(k0, 1, &t, n, x, y, z, strength, &hr, &hi), IGABEM_OK);
        sum += step * (hr * hr + hi * hi) * C * C;
    }
    return rho * k0 * k0 / (2 * pi) * sum;
}

static void resistances(void)
{
    const double rho = 1000, k0 = 0.8, depth = 0.9, zero = 0, z = -depth, strength = 2.5;
    double R, x[2] = {5e-4, -5e-4}, y[2] = {0, 0}, deep[2] = {z, z}, pair[2];
    CU_ASSERT_EQUAL(igabem_kelvin_source_resistance(rho, k0, depth, strength, &R), IGABEM_OK);
    CHECK_RELATIVE(resistance_of(rho, k0, 1, &zero, &zero, &z, &strength), R, 1e-10);
    /* Lagally: the same from the wave slope at the source, R = rho sigma^2 k0^2/(4 pi) W_X(0-)/2.
     */
    double X = -1e-12, Z = 2 * k0 * z, WX;
    igabem_kelvin_wave(1, &X, &zero, &Z, NULL, &WX, NULL, NULL);
    CHECK_RELATIVE(rho * strength * strength * k0 * k0 / (4 * pi) * WX / 2, R, 1e-9);
    /* A dipole as a close pair of opposite sources. */
    pair[0] = strength / 1e-3;
    pair[1] = -pair[0];
    CU_ASSERT_EQUAL(igabem_kelvin_dipole_resistance(rho, k0, depth, strength, &R), IGABEM_OK);
    CHECK_RELATIVE(resistance_of(rho, k0, 2, x, y, deep, pair), R, 1e-5);
    double sphere, g = 9.81, c = 0.4;
    CU_ASSERT_EQUAL(igabem_kelvin_sphere_resistance(rho, g, k0, depth, c, &sphere), IGABEM_OK);
    CU_ASSERT_EQUAL(
        igabem_kelvin_dipole_resistance(rho, k0, depth, 2 * pi * c * c * c * sqrt(g / k0), &R),
        IGABEM_OK);
    CHECK_RELATIVE(sphere, R, 1e-14);
    /* Far below, K0 + K1 ~ sqrt(2 pi/a) e^-a (1 + 1/(8 a)); close to the surface K1 ~ 1/a. */
    igabem_kelvin_source_resistance(1, 1, 300, 1, &R);
    CHECK_RELATIVE(R, exp(-600) * sqrt(2 * pi / 300) / (4 * pi) * (1 + 0.125 / 300), 1e-5);
    igabem_kelvin_source_resistance(1, 1, 1e-8, 1, &R);
    CHECK_RELATIVE(R, 1e8 / (4 * pi), 1e-6);
}

/* Segments and triangles against their own points, and across the change from close to distant
 * exponents. */
static void amplitudes(void)
{
    static const double corner[9] = {0.3, 0.1, -0.4, 1.1, -0.2, -0.7, 0.6, 0.5, -1.2};
    static const double ends_strength[2] = {0.7, 1.9}, one = 1.5;
    enum { N = 400 };
    static double x[N * N], y[N * N], z[N * N], s[N * N];
    double u[3], v[3], n[3], k0 = 1;
    for (int k = 0; k < 3; k++) {
        u[k] = corner[3 + k] - corner[k];
        v[k] = corner[6 + k] - corner[k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    double area = 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]),
           length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (double t = -3; t < 3.1; t += 0.75) {
        double ar, ai, br, bi, scale;
        for (int i = 0; i < N; i++) { /* midpoint rule */
            double l = (i + 0.5) / N;
            x[i] = corner[0] + l * u[0];
            y[i] = corner[1] + l * u[1];
            z[i] = corner[2] + l * u[2];
            s[i] = length / N * ((1 - l) * ends_strength[0] + l * ends_strength[1]);
        }
        igabem_kochin_points(k0, 1, &t, N, x, y, z, s, &ar, &ai);
        CU_ASSERT_EQUAL(igabem_kochin_segments(k0, 1, &t, 1, corner, ends_strength, &br, &bi),
                        IGABEM_OK);
        scale = hypot(br, bi);
        CHECK_CLOSE(hypot(ar - br, ai - bi), 0, 2e-4 * scale);
        int count = 0;
        for (int i = 0; i < N; i++) /* centroids of the N^2 similar parts */
            for (int j = 0; j < N - i; j++)
                for (int half = 0; half < (j < N - i - 1 ? 2 : 1); half++, count++) {
                    double p = (i + (1 + half) / 3.0) / N, q = (j + (1 + half) / 3.0) / N;
                    x[count] = corner[0] + p * u[0] + q * v[0];
                    y[count] = corner[1] + p * u[1] + q * v[1];
                    z[count] = corner[2] + p * u[2] + q * v[2];
                    s[count] = one * area / ((double)N * N);
                }
        CU_ASSERT_EQUAL(count, N * N);
        igabem_kochin_points(k0, 1, &t, N * N, x, y, z, s, &ar, &ai);
        CU_ASSERT_EQUAL(igabem_kochin_triangles(k0, 1, &t, 1, corner, &one, &br, &bi), IGABEM_OK);
        CHECK_CLOSE(hypot(ar - br, ai - bi), 0, 2e-4 * hypot(br, bi));
    }
    /* A triangle equals its two halves, and a segment its two parts, at any ratio of size to wave
     * length. */
    for (k0 = 1e-6; k0 < 200; k0 *= 3) {
        double t = 0.6, whole[2], part[2], half[18], segment[12],
               strength[4] = {0.7, 1.3, 1.3, 1.9}, both[2] = {one, one};
        for (int k = 0; k < 3; k++) {
            double middle = 0.5 * (corner[3 + k] + corner[6 + k]);
            half[k] = half[9 + k] = corner[k];
            half[3 + k] = corner[3 + k];
            half[6 + k] = half[12 + k] = middle;
            half[15 + k] = corner[6 + k];
            segment[k] = corner[k];
            segment[3 + k] = segment[6 + k] = 0.5 * (corner[k] + corner[3 + k]);
            segment[9 + k] = corner[3 + k];
        }
        igabem_kochin_triangles(k0, 1, &t, 1, corner, &one, &whole[0], &whole[1]);
        igabem_kochin_triangles(k0, 1, &t, 2, half, both, &part[0], &part[1]);
        CHECK_CLOSE(hypot(whole[0] - part[0], whole[1] - part[1]), 0,
                    1e-10 * hypot(whole[0], whole[1]));
        igabem_kochin_segments(k0, 1, &t, 1, corner, ends_strength, &whole[0], &whole[1]);
        igabem_kochin_segments(k0, 1, &t, 2, segment, strength, &part[0], &part[1]);
        CHECK_CLOSE(hypot(whole[0] - part[0], whole[1] - part[1]), 0,
                    1e-11 * hypot(whole[0], whole[1]));
    }
}

static const struct check_case cases[] = {
    {"parts add up", parts_add_up},
    {"derivatives", derivatives},
    {"long batch", long_batch},
    {"refusals", refusals},
    {"distant points", distant_points},
    {"filter", filter},
    {"gradient of N far away, in 30 digits", far_gradient},
    {"resistances", resistances},
    {"amplitudes", amplitudes},
};

CHECK_MAIN("kelvin green", cases)
