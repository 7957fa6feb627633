/* Ten rugged or narrow functions, written down before any optimiser was run on them. Boxes are
 * moved so that no minimum lies at a centre. */
#include "bayesopt_functions.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* Waves of growing length, the minimum in a corner of the box. */
static double eggholder(size_t d, const double *u)
{
    (void)d;
    double x = -512 + 1024 * u[0], y = -512 + 1024 * u[1] + 47;
    return -y * sin(sqrt(fabs(y + x / 2))) - x * sin(sqrt(fabs(x - y)));
}

/* Rings about the minimum. */
static double drop_wave(size_t d, const double *u)
{
    (void)d;
    double x = -2 + 5 * u[0], y = -3.5 + 5 * u[1], square = x * x + y * y;
    return -(1 + cos(12 * sqrt(square))) / (0.5 * square + 2);
}

/* De Jong's fifth: 25 narrow holes in a plain. */
static double foxholes(size_t d, const double *u)
{
    (void)d;
    double sum = 0.002;
    for (int i = 0; i < 25; i++) {
        double x = -50 + 100 * u[0] - 16 * (i % 5 - 2), y = -50 + 100 * u[1] - 16 * (i / 5 - 2);
        sum += 1 / (i + 1 + pow(x, 6) + pow(y, 6));
    }
    return 1 / sum;
}

/* The best basins lie in corners, far from each other. */
static double schwefel(size_t d, const double *u)
{
    double sum = 0;
    for (size_t j = 0; j < d; j++) {
        double x = -500 + 1000 * u[j];
        sum -= x * sin(sqrt(fabs(x)));
    }
    return sum;
}

/* Spheres about the minimum, on a cone. */
static double salomon(size_t d, const double *u)
{
    double square = 0;
    for (size_t j = 0; j < d; j++) {
        double x = -4 + 10 * u[j];
        square += x * x;
    }
    return 1 - cos(2 * pi * sqrt(square)) + 0.1 * sqrt(square);
}

/* A sharp crease along a parabola. */
static double bukin(size_t d, const double *u)
{
    (void)d;
    double x = -15 + 10 * u[0] + 1, y = -3 + 6 * u[1];
    return 100 * sqrt(fabs(y - 0.01 * x * x)) + 0.01 * fabs(x + 10);
}

static double beale(size_t d, const double *u)
{
    (void)d;
    double x = -4.5 + 9 * u[0], y = -4.5 + 9 * u[1];
    double a = 1.5 - x + x * y, b = 2.25 - x + x * y * y, c = 2.625 - x + x * y * y * y;
    return a * a + b * b + c * c;
}

/* Fletcher and Powell: a valley along a helix. */
static double helical_valley(size_t d, const double *u)
{
    (void)d;
    double x = -4 + 9 * u[0], y = -6 + 10 * u[1], z = -5 + 8 * u[2];
    double angle = atan2(y, x) / (2 * pi), r = sqrt(x * x + y * y);
    double a = z - 10 * angle, b = r - 1;
    return 100 * (a * a + b * b) + z * z;
}

/* Colville's, or Wood's. */
static double colville(size_t d, const double *u)
{
    (void)d;
    double a = -3 + 6 * u[0], b = -3 + 6 * u[1], c = -3 + 6 * u[2], e = -3 + 6 * u[3];
    return 100 * (a * a - b) * (a * a - b) + (a - 1) * (a - 1) + (c - 1) * (c - 1) +
           90 * (c * c - e) * (c * c - e) + 10.1 * ((b - 1) * (b - 1) + (e - 1) * (e - 1)) +
           19.8 * (b - 1) * (e - 1);
}

/* Half axes from 1 to 1/100, turned by a cosine transform. */
static double ellipsoid(size_t d, const double *u)
{
    double sum = 0, n = (double)d;
    for (size_t m = 0; m < d; m++) {
        double z = 0;
        for (size_t j = 0; j < d; j++)
            z += sqrt((m ? 2 : 1) / n) * cos(pi * (double)m * ((double)j + 0.5) / n) *
                 (-3 + 8 * u[j]);
        sum += pow(1e4, (double)m / (n - 1)) * z * z;
    }
    return sum;
}

const struct test_function stated_functions[] = {
    {"eggholder2", 2, 20, 50, -959.64066272085097, eggholder, 46.201075291},
    {"dropwave2", 2, 20, 50, -1, drop_wave, -0.466264156997},
    {"foxholes2", 2, 20, 50, 0.99800383779444957, foxholes, 471.059357716},
    {"schwefel3", 3, 30, 60, -1256.9486618173012, schwefel, 599.992593673},
    {"salomon4", 4, 40, 100, 0, salomon, 0.2},
    {"bukin2", 2, 20, 50, 0, bukin, 155.251746963},
    {"beale2", 2, 20, 50, 0, beale, 268.63111476},
    {"helical3", 3, 30, 60, 0, helical_valley, 552.186427025},
    {"colville4", 4, 40, 100, 0, colville, 1527.504},
    {"ellipsoid6", 6, 60, 120, 0, ellipsoid, 2.16},
};
const size_t n_stated_functions = sizeof stated_functions / sizeof *stated_functions;
