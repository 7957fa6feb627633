/* Wave resistance of single submerged singularities in closed form (Havelock). */
#include "core/constants.h"
#include "core/error.h"

#include <igabem/kelvin.h>

#include <math.h>

/* e^-a K0(a) and e^-a K1(a) from K_n(a) = Int_0^inf e^{-a cosh t} cosh(n t) dt by the trapezoid
 * rule. Its error is e^{-2 pi (pi/2)/h} by the strip of decay, 7e-18 at h = 1/4, and e^{-2
 * pi^2/(h^2 a)} of the value where the integrand is a Gaussian of width 1/sqrt(a). */
static void bessel(double a, double *K0, double *K1)
{
    const double h = fmin(0.25, 0.7 / sqrt(a));
    double sum0 = 0.5 * exp(-2 * a), sum1 = sum0;
    for (int k = 1;; k++) {
        double c = cosh(k * h), term = exp(-a * (1 + c));
        if (term * c <= 1e-17 * sum1 && a * (c - 1) > 1)
            break;
        sum0 += term;
        sum1 += term * c;
    }
    *K0 = h * sum0;
    *K1 = h * sum1;
}

static igabem_status check(double rho, double k0, double depth, double strength,
                           const double *resistance)
{
    const struct {
        const char *name;
        double value;
    } positive[] = {{"rho", rho}, {"k0", k0}, {"depth", depth}};
    for (int k = 0; k < 3; k++)
        if (!(positive[k].value > 0) || !isfinite(positive[k].value))
            return igabem_fail(IGABEM_ERROR_ARGUMENT, "wave resistance: %s is %g, expected > 0",
                               positive[k].name, positive[k].value);
    if (!isfinite(strength))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "wave resistance: strength is %g, expected finite", strength);
    if (!resistance)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "wave resistance: no place for the result");
    return IGABEM_OK;
}

igabem_status igabem_kelvin_source_resistance(double rho, double k0, double depth, double strength,
                                              double *resistance)
{
    igabem_status status = check(rho, k0, depth, strength, resistance);
    if (status != IGABEM_OK)
        return status;
    double K0, K1;
    bessel(k0 * depth, &K0, &K1);
    *resistance = rho * strength * strength * k0 * k0 / (4 * PI) * (K0 + K1);
    return IGABEM_OK;
}

igabem_status igabem_kelvin_dipole_resistance(double rho, double k0, double depth, double moment,
                                              double *resistance)
{
    igabem_status status = check(rho, k0, depth, moment, resistance);
    if (status != IGABEM_OK)
        return status;
    double K0, K1, a = k0 * depth, square = moment * k0 * k0;
    bessel(a, &K0, &K1);
    *resistance = rho * square * square / (4 * PI) * (K0 + (1 + 0.5 / a) * K1);
    return IGABEM_OK;
}

igabem_status igabem_kelvin_sphere_resistance(double rho, double gravity, double k0, double depth,
                                              double radius, double *resistance)
{
    if (!(gravity > 0) || !isfinite(gravity))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "wave resistance: gravity is %g, expected > 0",
                           gravity);
    if (!(radius > 0) || !(radius < depth))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "wave resistance: radius is %g, expected between 0 and the depth %g",
                           radius, depth);
    if (!(k0 > 0) || !isfinite(k0))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "wave resistance: k0 is %g, expected > 0", k0);
    double moment = 2 * PI * radius * radius * radius * sqrt(gravity / k0);
    return igabem_kelvin_dipole_resistance(rho, k0, depth, moment, resistance);
}
