#include "space/quadrature_regular.h"

#include "core/constants.h"

#include <limits.h>
#include <math.h>

/* Both rules try one number of points after the other: few are ever needed, and logarithms cost
 * more than products. */
enum { MOST_POINTS = 64 };

/* rho of the Bernstein ellipse through z, 0 when z is on the length or next to it. */
static double ellipse(double distance, double half)
{
    double z = distance / half;
    return z > 1.0 + 1e-3 ? z + sqrt(z * z - 1.0) : 0.0;
}

/* max(1, (share rho)^p) */
static double basis_growth(const struct factor *factor, double rho)
{
    double product = 1.0;
    for (int k = 0; k < factor->degree; k++)
        product *= factor->share * rho;
    return product > 1.0 ? product : 1.0;
}

int regular_points(double distance, double half, const struct factor *factor, double scale,
                   double tolerance)
{
    double rho = ellipse(distance, half);
    if (!(rho > 0))
        return INT_MAX;
    if (scale <= tolerance)
        return 1;
    double decay = 1.0 / (rho * rho), error = PI * scale * basis_growth(factor, rho) / rho;
    for (int n = 1; n <= MOST_POINTS; n++) {
        error *= decay;
        if (error * (2 * n + 1) <= tolerance)
            return n;
    }
    return INT_MAX;
}

int shape_points(double chord, double bend, const struct factor *factor, double scale,
                 double tolerance)
{
    if (scale <= tolerance || !(bend > 0))
        return 1;
    double rho = ellipse(chord, 2.0 * bend);
    if (!(rho > 0))
        return INT_MAX;
    double decay = 1.0 / (rho * rho), error = 0.7 * scale * basis_growth(factor, rho);
    for (int n = 1; n <= MOST_POINTS; n++) {
        error *= decay;
        if (error <= tolerance * n * sqrt(n))
            return n;
    }
    return INT_MAX;
}
