/* What N and W satisfy exactly: equations, symmetries, limits. Differences of gradients are taken
 * at points where both sides are smooth over the step. */
#include "check.h"

#include <igabem/kelvin.h>

static void local_at(double X, double Y, double Z, double *v)
{
    CU_ASSERT_EQUAL(igabem_kelvin_local(1, &X, &Y, &Z, v, v + 1, v + 2, v + 3), IGABEM_OK);
}

static void wave_at(double X, double Y, double Z, double *v)
{
    CU_ASSERT_EQUAL(igabem_kelvin_wave(1, &X, &Y, &Z, v, v + 1, v + 2, v + 3), IGABEM_OK);
}

typedef void evaluate(double X, double Y, double Z, double *v);

/* Derivative of component `of` along axis (1, 2, 3) by Richardson's central differences. */
static double difference(evaluate *f, const double *P, int of, int axis, double h)
{
    double d[2];
    for (int k = 0; k < 2; k++, h *= 0.5) {
        double a[4], b[4], plus[3] = {P[0], P[1], P[2]}, minus[3] = {P[0], P[1], P[2]};
        plus[axis - 1] += h;
        minus[axis - 1] -= h;
        f(plus[0], plus[1], plus[2], a);
        f(minus[0], minus[1], minus[2], b);
        d[k] = (a[of] - b[of]) / (2 * h);
    }
    return (4 * d[1] - d[0]) / 3;
}

static const double points[][3] = {{-0.3, 0.2, -0.1}, {-2, 0.5, -0.3},     {-7, 2.4, -0.5},
                                   {-25, 3, -1},      {-0.05, 0.03, -0.2}, {4, 1, -0.5},
                                   {-60, 21, -0.8},   {0.7, -0.4, -2},     {-11, -1.5, -0.6},
                                   {30, 50, -20},     {-300, 80, -2.5},    {0.01, 0.02, -0.015}};

static void equations(void)
{
    for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) {
        const double *P = points[i];
        double R = sqrt(P[0] * P[0] + P[1] * P[1] + P[2] * P[2]),
               h = 1e-3 * fmin(R, 0.3 * fabs(P[2])), v[4];
        double XX = difference(local_at, P, 1, 1, h), YY = difference(local_at, P, 2, 2, h),
               ZZ = difference(local_at, P, 3, 3, h);
        double scale = fabs(XX) + fabs(YY) + fabs(ZZ);
        local_at(P[0], P[1], P[2], v);
        CHECK_CLOSE(XX + YY + ZZ, 0, 2e-6 * scale);
        CHECK_CLOSE(XX + v[3], 2 * P[2] / (R * R * R), 2e-6 * scale);
        CHECK_CLOSE(difference(local_at, P, 0, 1, h), v[1], 1e-8 * fabs(v[1]) + 1e-10 / R);
        if (P[0] > 0)
            continue;
        XX = difference(wave_at, P, 1, 1, h), YY = difference(wave_at, P, 2, 2, h),
        ZZ = difference(wave_at, P, 3, 3, h);
        scale = fmax(1, fabs(XX) + fabs(YY) + fabs(ZZ));
        wave_at(P[0], P[1], P[2], v);
        CHECK_CLOSE(XX + YY + ZZ, 0, 1e-6 * scale);
        CHECK_CLOSE(XX + v[3], 0, 1e-6 * scale);
        CHECK_CLOSE(difference(wave_at, P, 0, 1, h), v[1], 1e-7 * scale);
    }
}

static void second_derivatives(void)
{
    for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) {
        const double *P = points[i];
        double N[6], W[6], R = sqrt(P[0] * P[0] + P[1] * P[1] + P[2] * P[2]);
        double h = 1e-3 * fmin(R, 0.3 * fabs(P[2])), n_scale = 1 / (R * R), w_scale = 1;
        CU_ASSERT_EQUAL(
            igabem_kelvin_local_second(1, P, P + 1, P + 2, N, N + 1, N + 2, N + 3, N + 4, N + 5),
            IGABEM_OK);
        CU_ASSERT_EQUAL(
            igabem_kelvin_wave_second(1, P, P + 1, P + 2, W, W + 1, W + 2, W + 3, W + 4, W + 5),
            IGABEM_OK);
        for (int k = 0; k < 6; k++) {
            n_scale = fmax(n_scale, fabs(N[k]));
            w_scale = fmax(w_scale, fabs(W[k]));
        }
        for (int r = 1, k = 0; r <= 3; r++)
            for (int c = r; c <= 3; c++, k++) {
                CHECK_CLOSE(N[k], difference(local_at, P, r, c, h), 1e-6 * n_scale);
                CHECK_CLOSE(W[k], P[0] < 0 ? difference(wave_at, P, r, c, h) : 0, 1e-6 * w_scale);
            }
    }
}

static void symmetries(void)
{
    for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) {
        double X = points[i][0], Y = points[i][1], Z = points[i][2], a[4], b[4];
        local_at(X, Y, Z, a);
        local_at(-X, -Y, Z, b);
        CU_ASSERT_EQUAL(a[0], b[0]);
        CU_ASSERT_EQUAL(a[1], -b[1]);
        CU_ASSERT_EQUAL(a[2], -b[2]);
        CU_ASSERT_EQUAL(a[3], b[3]);
        wave_at(-fabs(X), Y, Z, a);
        wave_at(-fabs(X), -Y, Z, b);
        CU_ASSERT_EQUAL(a[0], b[0]);
        CU_ASSERT_EQUAL(a[2], -b[2]);
    }
    double v[4];
    wave_at(-3, 0, -0.1, v);
    CU_ASSERT_EQUAL(v[2], 0);
    local_at(-3, 0, -0.1, v);
    CU_ASSERT_EQUAL(v[2], 0);
}

/* Modified Bessel functions K0 and K1 from their integrals. */
static double bessel_K(int order, double a)
{
    double sum = 0.5 * exp(-a), h = 1.0 / 64;
    for (int k = 1; k < 1200; k++)
        sum += exp(-a * cosh(k * h)) * (order ? cosh(k * h) : 1);
    return h * sum;
}

/* N_X(0+) = W_X(0-)/2 = e^{Z/2} [K0(rho/2) + (|Z|/rho) K1(rho/2)], and W vanishes with X. */
static void jump_at_the_source(void)
{
    static const double place[][2] = {{0.01, -0.02}, {0.3, -0.1}, {0, -0.5}, {1, -1e-3},
                                      {2, -3},       {5, -0.4},   {0.02, -7}};
    for (size_t i = 0; i < sizeof place / sizeof place[0]; i++) {
        double Y = place[i][0], Z = place[i][1], rho = hypot(Y, Z), v[4];
        double slope = exp(Z / 2) * (bessel_K(0, rho / 2) - Z / rho * bessel_K(1, rho / 2));
        local_at(0, Y, Z, v);
        CHECK_CLOSE(v[1], slope, 1e-9 * fmax(slope, 1 / (rho * rho)));
        wave_at(0, Y, Z, v);
        CU_ASSERT_EQUAL(v[0], 0);
        double tiny = -1e-12 * rho;
        wave_at(tiny, Y, Z, v);
        CHECK_CLOSE(v[1], 2 * slope, 1e-9 * fmax(1, slope / rho));
        /* N + W and its gradient are continuous across X = 0. */
        double ahead[4], behind[4];
        local_at(-tiny, Y, Z, ahead);
        local_at(tiny, Y, Z, behind);
        for (int k = 0; k < 4; k++)
            CHECK_CLOSE(behind[k] + v[k], ahead[k], 1e-9 * fmax(1, 10 * slope / rho));
    }
}

/* N = -2/R - 2 d^2/dX^2 ln(R - Z) + O(R^-3). */
static void far_field(void)
{
    static const double direction[][3] = {
        {1, 0, 0}, {0.6, 0.8, 0}, {0, 0.6, -0.8}, {0.48, 0.64, -0.6}, {0, 1, 0}};
    for (double R = 300; R < 1e13; R *= 7)
        for (size_t i = 0; i < sizeof direction / sizeof direction[0]; i++) {
            double X = R * direction[i][0], Y = R * direction[i][1], Z = R * direction[i][2], v[4];
            double s = 1 / (R - Z),
                   second = s / R - X * X * s / (R * R * R) - X * X * s * s / (R * R);
            local_at(X, Y, Z, v);
            CHECK_CLOSE(v[0] * R, -2 - 2 * R * second, 1e-10 + 30 / (R * R));
            CHECK_CLOSE(v[3] * R * R, 2 * Z / R, 1e-9 + 8 / R);
        }
}

/* On the track W = 4 pi Y1(|X|) with Y1(1), Y1(10), Y1(0.1) from Abramowitz & Stegun, table 9.1. */
static void track(void)
{
    static const double known[][2] = {{0.1, -6.458951095}, {1, -0.781212821}, {10, 0.249015424}};
    const double four_pi = 12.566370614359172;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        double v[4], close[4];
        wave_at(-known[i][0], 0, 0, v);
        CHECK_CLOSE(v[0], four_pi * known[i][1], 1e-8);
        wave_at(-known[i][0], 0, -1e-9, close);
        for (int k = 0; k < 4; k++)
            CHECK_CLOSE(v[k], close[k], 1e-5 * fmax(1, fabs(v[k])));
    }
    /* Z = 0 off the track is a regular limit. */
    double surface[4], below[4];
    wave_at(-3, 0.8, 0, surface);
    wave_at(-3, 0.8, -1e-10, below);
    for (int k = 0; k < 4; k++)
        CHECK_CLOSE(surface[k], below[k], 1e-7);
}

/* N next to the origin: -2 (1 + |Z|/(R+|X|)) - |X| ln R + O(R). */
static void near_field(void)
{
    for (double R = 1e-2; R > 1e-200; R *= 1e-6) {
        double X = 0.48 * R, Y = 0.64 * R, Z = -0.6 * R, v[4];
        local_at(X, Y, Z, v);
        /* 5e-14 |ln R|: the tables' L is zero at R = 0 to rounding only. */
        CHECK_CLOSE(v[0], -2 * (1 + 0.6 / 1.48) - X * log(R), 3 * R - 5e-14 * log(R));
        CU_ASSERT(isfinite(v[1]) && isfinite(v[2]) && isfinite(v[3]));
    }
}

/* Continuity of N and its gradient across the boundaries of the tables' cells. */
static void cell_boundaries(void)
{
    for (double M = 0.06; M < 200; M *= 1.0905)
        for (int k = 0; k < 200; k++) {
            double a = k / 99.5, b = fmod(k * 0.6180339887498949, 1.0), v[4], w[4];
            double P[3] = {M, M * a, -M * b * 1.5},
                   R = sqrt(P[0] * P[0] + P[1] * P[1] + P[2] * P[2]);
            double s = 1 + 1e-13, scale = 0;
            local_at(P[0] * s, P[1] / s, P[2], v);
            local_at(P[0], P[1], P[2] * s, w);
            for (int c = 1; c < 4; c++)
                scale = fmax(scale, fabs(v[c]));
            CHECK_CLOSE(v[0], w[0], 1e-11 * fabs(v[0]));
            for (int c = 1; c < 4; c++)
                CHECK_CLOSE(v[c], w[c], 1e-9 * fmax(scale, 1 / (R * R)));
        }
}

static const struct check_case cases[] = {
    {"Laplace and free surface", equations},
    {"second derivatives", second_derivatives},
    {"symmetries", symmetries},
    {"jump at X = 0", jump_at_the_source},
    {"far field", far_field},
    {"track and free surface", track},
    {"near field", near_field},
    {"cell boundaries", cell_boundaries},
};

CHECK_MAIN("kelvin identities", cases)
