/* Functions beyond those for which figures of other optimisers are known. Boxes are moved so that
 * no minimum lies at a centre, which methods that divide the box evaluate first. */
#include "bayesopt_functions.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* Xiong et al., Int. J. Numer. Meth. Engng 71 (2007) 733: fast ripples on the left only. */
static double xiong(size_t d, const double *u)
{
    (void)d;
    double x = u[0] - 0.9;
    return sin(30 * x * x * x * x) * cos(2 * x) + x / 2;
}

static double six_hump_camel(size_t d, const double *u)
{
    (void)d;
    double x = -3 + 6 * u[0], y = -2 + 4 * u[1], xx = x * x, yy = y * y;
    return (4 - 2.1 * xx + xx * xx / 3) * xx + x * y + (-4 + 4 * yy) * yy;
}

/* Values from 3 to 1e6. */
static double goldstein_price(size_t d, const double *u)
{
    (void)d;
    double x = -2 + 4 * u[0], y = -2 + 4 * u[1], s = x + y + 1, t = 2 * x - 3 * y;
    return (1 + s * s * (19 - 14 * x + 3 * x * x - 14 * y + 6 * x * y + 3 * y * y)) *
           (30 + t * t * (18 - 32 * x + 12 * x * x + 48 * y - 36 * x * y + 27 * y * y));
}

/* Ten narrow wells on a plain. */
static double shekel(size_t d, const double *u)
{
    static const double well[10][4] = {{4, 4, 4, 4}, {1, 1, 1, 1},    {8, 8, 8, 8}, {6, 6, 6, 6},
                                       {3, 7, 3, 7}, {2, 9, 2, 9},    {5, 5, 3, 3}, {8, 1, 8, 1},
                                       {6, 2, 6, 2}, {7, 3.6, 7, 3.6}};
    static const double width[10] = {0.1, 0.2, 0.2, 0.4, 0.4, 0.6, 0.3, 0.7, 0.5, 0.5};
    double sum = 0;
    for (size_t i = 0; i < 10; i++) {
        double square = width[i];
        for (size_t j = 0; j < d; j++)
            square += (10 * u[j] - well[i][j]) * (10 * u[j] - well[i][j]);
        sum -= 1 / square;
    }
    return sum;
}

static double rosenbrock(size_t d, const double *u)
{
    double sum = 0;
    for (size_t j = 0; j + 1 < d; j++) {
        double x = -3 + 6 * u[j], y = -3 + 6 * u[j + 1];
        sum += 100 * (y - x * x) * (y - x * x) + (1 - x) * (1 - x);
    }
    return sum;
}

static double rastrigin(size_t d, const double *u)
{
    double sum = 10 * (double)d;
    for (size_t j = 0; j < d; j++) {
        double x = -3.5 + 8 * u[j];
        sum += x * x - 10 * cos(2 * pi * x);
    }
    return sum;
}

static double levy5(size_t d, const double *u)
{
    return levy_from(-8, d, u);
}

/* Steep valleys that meet at a point. */
static double michalewicz(size_t d, const double *u)
{
    double sum = 0;
    for (size_t j = 0; j < d; j++) {
        double x = pi * u[j];
        sum -= sin(x) * pow(sin((double)(j + 1) * x * x / pi), 20);
    }
    return sum;
}

static double zakharov(size_t d, const double *u)
{
    double squares = 0, linear = 0;
    for (size_t j = 0; j < d; j++) {
        double x = -5 + 15 * u[j];
        squares += x * x;
        linear += 0.5 * (double)(j + 1) * x;
    }
    return squares + linear * linear + linear * linear * linear * linear;
}

/* A bowl under a fine ripple. */
static double griewank(size_t d, const double *u)
{
    double squares = 0, product = 1;
    for (size_t j = 0; j < d; j++) {
        double x = -40 + 100 * u[j];
        squares += x * x / 4000;
        product *= cos(x / sqrt((double)(j + 1)));
    }
    return squares - product + 1;
}

static double styblinski_tang(size_t d, const double *u)
{
    double sum = 0;
    for (size_t j = 0; j < d; j++) {
        double x = -5 + 10 * u[j];
        sum += 0.5 * (x * x * x * x - 16 * x * x + 5 * x);
    }
    return sum;
}

static double powell(size_t d, const double *u)
{
    double sum = 0;
    for (size_t j = 0; j + 3 < d; j += 4) {
        double x[4];
        for (size_t k = 0; k < 4; k++)
            x[k] = -4 + 9 * u[j + k];
        double a = x[0] + 10 * x[1], b = x[2] - x[3], c = x[1] - 2 * x[2], e = x[0] - x[3];
        sum += a * a + 5 * b * b + c * c * c * c + 10 * e * e * e * e;
    }
    return sum;
}

static double dixon_price(size_t d, const double *u)
{
    double last = -8 + 20 * u[0], sum = (last - 1) * (last - 1);
    for (size_t j = 1; j < d; j++) {
        double x = -8 + 20 * u[j], s = 2 * x * x - last;
        sum += (double)(j + 1) * s * s;
        last = x;
    }
    return sum;
}

const struct test_function held_out_functions[] = {
    {"xiong1", 1, 6, 20, -0.62499890071786002, xiong, -0.546042966971},
    {"camel2", 2, 20, 50, -1.0316284534898774, six_hump_camel, 2.439168},
    {"goldstein2", 2, 20, 50, 3, goldstein_price, 645.13398784},
    {"shekel4", 4, 40, 100, -10.536409816692048, shekel, -0.603752963374},
    {"rosenbrock4", 4, 40, 100, 0, rosenbrock, 2105.4},
    {"rastrigin4", 4, 40, 100, 0, rastrigin, 12.479320225},
    {"levy5", 5, 50, 100, 0, levy5, 25.3545960518},
    {"michalewicz5", 5, 50, 100, -4.6876581790881477, michalewicz, -0.743514749887},
    {"zakharov6", 6, 60, 120, 0, zakharov, 788.75390625},
    {"griewank6", 6, 60, 120, 0, griewank, 1.17054077611},
    {"styblinski8", 8, 80, 160, -313.3293256301713, styblinski_tang, -232},
    {"powell8", 8, 80, 160, 0, powell, 414.6922},
    {"rosenbrock10", 10, 100, 200, 0, rosenbrock, 6316.2},
    {"dixonprice10", 10, 100, 200, 0, dixon_price, 70009},
};
const size_t n_held_out_functions = sizeof held_out_functions / sizeof *held_out_functions;
