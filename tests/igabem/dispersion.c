#include "dispersion.h"

#include <math.h>

enum { ALIASES = 24 };
static const double pi = 3.14159265358979323846;

/* (sin(x/2)/(x/2))^n, the transform of a spline of degree n - 1 */
static double spline(double x, int n)
{
    double s = fabs(x) < 1e-8 ? 1.0 : sin(0.5 * x) / (0.5 * x);
    return pow(s, n);
}

static double samples(double x, int n)
{
    double sum = 0.0;
    for (int m = -ALIASES; m <= ALIASES; m++)
        sum += spline(x + 2 * pi * m, n);
    return sum;
}

double dispersion_value(const struct dispersion_scheme *scheme, double alpha, double beta)
{
    return samples(alpha, scheme->degree + 1) * samples(beta, scheme->degree + 1);
}

double dispersion_kernel(int density, const struct dispersion_grid *grid, double alpha, double beta)
{
    double along[2 * ALIASES + 1], sum = 0.0;
    for (int m = -ALIASES; m <= ALIASES; m++)
        along[m + ALIASES] = spline(alpha + 2 * pi * m, density + 1);
    for (int n = -ALIASES; n <= ALIASES; n++) {
        double b = beta + 2 * pi * n, across = spline(b, density + 1);
        for (int m = -ALIASES; m <= ALIASES; m++) {
            double k = hypot(alpha + 2 * pi * m + grid->tau * b, b / grid->h);
            sum += k > 0 ? along[m + ALIASES] * across / k : 0.0;
        }
    }
    return sum / (samples(alpha, density + 1) * samples(beta, density + 1));
}

/* The spline's own second derivative, aliases and all. */
static double exact_wave(const struct dispersion_scheme *scheme, const struct dispersion_grid *grid,
                         double alpha, double beta)
{
    double along[2 * ALIASES + 1], sum = 0.0;
    for (int m = -ALIASES; m <= ALIASES; m++)
        along[m + ALIASES] = spline(alpha + 2 * pi * m, scheme->degree + 1);
    for (int n = -ALIASES; n <= ALIASES; n++) {
        double b = beta + 2 * pi * n, across = spline(b, scheme->degree + 1);
        for (int m = -ALIASES; m <= ALIASES; m++) {
            double a = alpha + 2 * pi * m + grid->tau * b, k = hypot(a, b / grid->h);
            sum += k > 0 ? along[m + ALIASES] * across * a * a / k : 0.0;
        }
    }
    return sum;
}

/* First derivative of a quadratic spline at the middle of a cell over i, from its coefficients. */
static double first(const struct dispersion_scheme *scheme, double x)
{
    if (scheme->derivative == DISPERSION_FOURTH)
        return 13.0 / 12 * sin(x) - 1.0 / 24 * sin(2 * x);
    return sin(x);
}

/* Second derivative with the sign changed. */
static double second(const struct dispersion_scheme *scheme, double x)
{
    if (scheme->derivative == DISPERSION_FOURTH)
        return 5.0 / 3 * (1 - cos(x)) + 1.0 / 12 * (1 - cos(2 * x));
    return 2 * (1 - cos(x));
}

double dispersion_slope(const struct dispersion_scheme *scheme, double alpha)
{
    return first(scheme, alpha) / samples(alpha, scheme->degree + 1);
}

double complex dispersion_wave(const struct dispersion_scheme *scheme,
                               const struct dispersion_grid *grid, double alpha, double beta)
{
    double sa = pow(sin(0.5 * alpha), 4), sb = pow(sin(0.5 * beta), 4);
    double filter = 1 - scheme->filter * (sa + sb);
    if (scheme->derivative == DISPERSION_EXACT)
        return filter * exact_wave(scheme, grid, alpha, beta);
    double va = samples(alpha, scheme->degree + 1), vb = samples(beta, scheme->degree + 1);
    double da = first(scheme, alpha), db = first(scheme, beta), tau = grid->tau;
    double bb = scheme->twice ? db * db : second(scheme, beta);
    double even = second(scheme, alpha) * vb + 2 * tau * da * db + tau * tau * bb * va;
    double mu = scheme->odd * pow(sin(0.5 * beta), 6), slope = da * vb + tau * db * va;
    return (filter * even + 2 * I * mu * slope) *
           dispersion_kernel(scheme->density, grid, alpha, beta);
}

int dispersion_winding(const struct dispersion_scheme *scheme, const struct dispersion_grid *grid,
                       double beta, double eps, int n, const double complex *wave)
{
    double turns = 0.0;
    double complex before = 0.0, begin = 0.0;
    for (int k = 0; k <= n; k++) {
        double alpha = 2 * pi * (k % n + 0.5) / n - pi;
        double trace = 1e-3 * (sin(alpha) + grid->tau * sin(beta));
        double complex r = dispersion_value(scheme, alpha, beta) - (wave[k % n] + I * trace) / eps;
        if (k == 0)
            begin = r;
        else
            turns += carg((k == n ? begin : r) / before);
        before = r;
    }
    return (int)lround(turns / (2 * pi));
}

double dispersion_root(const struct dispersion_scheme *scheme, const struct dispersion_grid *grid,
                       double beta, double eps, double near)
{
    double low = 0.5 * near, high = fmin(1.5 * near, pi), at[2];
    for (int k = 0; k < 2; k++) {
        double a = k ? high : low;
        at[k] =
            eps * dispersion_value(scheme, a, beta) - creal(dispersion_wave(scheme, grid, a, beta));
    }
    if (!(at[0] > 0) || !(at[1] < 0))
        return NAN;
    for (int k = 0; k < 60 && high - low > 1e-12; k++) {
        double a = 0.5 * (low + high);
        if (eps * dispersion_value(scheme, a, beta) > creal(dispersion_wave(scheme, grid, a, beta)))
            low = a;
        else
            high = a;
    }
    return 0.5 * (low + high);
}
