#include "quadrature_regular.h"

#include "constants.h"

#include <limits.h>
#include <math.h>

/* ln rho of the Bernstein ellipse through z > 1, or 0. */
static double convergence(double distance, double half)
{
    double z = distance / half;
    return z > 1.0 + 1e-3 ? log(z + sqrt(z * z - 1.0)) : 0.0;
}

static double basis_digits(const struct factor *factor, double rate)
{
    return fmax(0.0, factor->degree * (rate + log(factor->share)));
}

static int whole(double n)
{
    return n < 1 ? 1 : n < 1e6 ? (int)ceil(n) : INT_MAX;
}

/* In both rules the part of the error that changes slowly with n takes its n from the rest. */

int regular_points(double distance, double half, const struct factor *factor, double scale,
                   double tolerance)
{
    double rate = convergence(distance, half);
    if (!(rate > 0))
        return INT_MAX;
    if (scale <= tolerance)
        return 1;
    double digits = log(scale / tolerance) + basis_digits(factor, rate), n = 0.5 * digits / rate;
    return whole(0.5 * (digits + log(PI * (2.0 * n + 1.0))) / rate - 0.5);
}

int shape_points(double chord, double bend, const struct factor *factor, double scale,
                 double tolerance)
{
    if (scale <= tolerance || !(bend > 0))
        return 1;
    double rate = convergence(chord, 2.0 * bend);
    if (!(rate > 0))
        return INT_MAX;
    double digits = log(0.7 * scale / tolerance) + basis_digits(factor, rate);
    double n = 0.5 * digits / rate;
    return whole(n - 0.75 * log(fmax(n, 1.0)) / rate);
}
