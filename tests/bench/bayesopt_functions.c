#include "bayesopt_functions.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

static double branin(size_t d, const double *u)
{
    (void)d;
    double a = -5 + 15 * u[0], b = 15 * u[1];
    double q = b - 5.1 * a * a / (4 * pi * pi) + 5 * a / pi - 6;
    return q * q + 10 * (1 - 1 / (8 * pi)) * cos(a) + 10;
}

static double hartmann3(size_t d, const double *u)
{
    static const double a[4][3] = {{3, 10, 30}, {0.1, 10, 35}, {3, 10, 30}, {0.1, 10, 35}};
    static const double p[4][3] = {{0.3689, 0.1170, 0.2673},
                                   {0.4699, 0.4387, 0.7470},
                                   {0.1091, 0.8732, 0.5547},
                                   {0.0381, 0.5743, 0.8828}};
    static const double c[4] = {1, 1.2, 3, 3.2};
    double sum = 0;
    for (size_t i = 0; i < 4; i++) {
        double e = 0;
        for (size_t j = 0; j < d; j++)
            e += a[i][j] * (u[j] - p[i][j]) * (u[j] - p[i][j]);
        sum -= c[i] * exp(-e);
    }
    return sum;
}

static double hartmann6(size_t d, const double *u)
{
    static const double a[4][6] = {{10, 3, 17, 3.5, 1.7, 8},
                                   {0.05, 10, 17, 0.1, 8, 14},
                                   {3, 3.5, 1.7, 10, 17, 8},
                                   {17, 8, 0.05, 10, 0.1, 14}};
    static const double p[4][6] = {{0.1312, 0.1696, 0.5569, 0.0124, 0.8283, 0.5886},
                                   {0.2329, 0.4135, 0.8307, 0.3736, 0.1004, 0.9991},
                                   {0.2348, 0.1451, 0.3522, 0.2883, 0.3047, 0.6650},
                                   {0.4047, 0.8828, 0.8732, 0.5743, 0.1091, 0.0381}};
    static const double c[4] = {1, 1.2, 3, 3.2};
    double sum = 0;
    for (size_t i = 0; i < 4; i++) {
        double e = 0;
        for (size_t j = 0; j < d; j++)
            e += a[i][j] * (u[j] - p[i][j]) * (u[j] - p[i][j]);
        sum -= c[i] * exp(-e);
    }
    return sum;
}

static double ackley(size_t d, const double *u)
{
    double squares = 0, cosines = 0;
    for (size_t j = 0; j < d; j++) {
        double x = -5 + 15 * u[j];
        squares += x * x / (double)d;
        cosines += cos(2 * pi * x) / (double)d;
    }
    return -20 * exp(-0.2 * sqrt(squares)) - exp(cosines) + 20 + exp(1.0);
}

static double rosenbrock_log(size_t d, const double *u)
{
    double sum = 0;
    for (size_t j = 0; j + 1 < d; j++) {
        double x = -2 + 4 * u[j], y = -2 + 4 * u[j + 1];
        sum += 100 * (y - x * x) * (y - x * x) + (1 - x) * (1 - x);
    }
    return log(1 + sum);
}

double levy_from(double low, size_t d, const double *u)
{
    double sum = 0, w = 0;
    for (size_t j = 0; j < d; j++) {
        w = 1 + (low + 20 * u[j] - 1) / 4;
        if (j == 0)
            sum += sin(pi * w) * sin(pi * w);
        if (j + 1 < d) {
            double s = sin(pi * w + 1);
            sum += (w - 1) * (w - 1) * (1 + 10 * s * s);
        }
    }
    double s = sin(2 * pi * w);
    return sum + (w - 1) * (w - 1) * (1 + s * s);
}

static double levy(size_t d, const double *u)
{
    return levy_from(-10, d, u);
}

/* A quadratic of five directions under a ripple: the shape of smooth latent spaces. */
static double rotated_quadratic(size_t d, const double *u)
{
    static const double weight[5] = {10, 5, 2, 1, 0.5};
    double sum = 0, n = (double)d;
    for (size_t m = 1; m <= 5; m++) {
        double z = 0;
        for (size_t i = 1; i <= d; i++) {
            double c = 0.5 + 0.2 * sin(1.7 * (double)i);
            z += sqrt(2 / n) * cos(pi * (double)m * ((double)i - 0.5) / n) * (u[i - 1] - c);
        }
        sum += weight[m - 1] * z * z;
    }
    for (size_t i = 1; i <= d; i++) {
        double c = 0.5 + 0.2 * sin(1.7 * (double)i);
        sum += 0.02 / n * (1 - cos(4 * pi * (u[i - 1] - c)));
    }
    return sum;
}

const struct test_function test_functions[] = {
    {"branin", 2, 20, 50, 0.39788735772973816, branin, 23.846560461},
    {"hartmann3", 3, 30, 60, -3.86278214782076, hartmann3, -0.698322873776},
    {"hartmann6", 6, 60, 120, -3.322368011415512, hartmann6, -1.01881805567},
    {"ackley5", 5, 50, 100, 0, ackley, 4.25365402657},
    {"rosen5log", 5, 50, 100, 0, rosenbrock_log, 6.73744134131},
    {"ackley10", 10, 100, 200, 0, ackley, 4.25365402657},
    {"levy10", 10, 100, 200, 0, levy, 24.0650246763},
    {"rotquad15", 15, 150, 250, 0, rotated_quadratic, 0.0548137761343},
};
const size_t n_test_functions = sizeof test_functions / sizeof *test_functions;

static double splitmix_uniform(uint64_t *state)
{
    *state += UINT64_C(0x9E3779B97F4A7C15);
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    z ^= z >> 31;
    return ((double)(z >> 11) + 0.5) * 0x1p-53;
}

void peer_latin_hypercube(unsigned seed, size_t n, size_t d, double *u)
{
    uint64_t state = UINT64_C(1000003) * seed + UINT64_C(7919) * d + 12345;
    size_t *p = malloc(n * sizeof *p);
    for (size_t j = 0; p && j < d; j++) {
        for (size_t i = 0; i < n; i++)
            p[i] = i;
        for (size_t i = n - 1; i >= 1; i--) {
            size_t k = (size_t)(splitmix_uniform(&state) * (double)(i + 1)), kept = p[i];
            p[i] = p[k];
            p[k] = kept;
        }
        for (size_t i = 0; i < n; i++)
            u[i * d + j] = ((double)p[i] + splitmix_uniform(&state)) / (double)n;
    }
    free(p);
}
