#include "kelvin/kelvin_domain.h"

#include "core/error.h"

#include <math.h>

static int is_good(double X, double Y, double Z)
{
    /* False for NaN as well; the largest finite double bounds |X|, |Y| and -Z. */
    return fabs(X) <= 1.7976931348623157e308 && fabs(Y) <= 1.7976931348623157e308 && Z <= 0 &&
           Z >= -1.7976931348623157e308 && (X != 0 || Y != 0 || Z != 0);
}

static igabem_status complain(const char *what, size_t i, double X, double Y, double Z)
{
    if (!isfinite(X) || !isfinite(Y) || !isfinite(Z))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "%s: point %zu is (%g, %g, %g), expected finite",
                           what, i, X, Y, Z);
    if (Z > 0)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "%s: point %zu has Z = %g, expected Z <= 0", what,
                           i, Z);
    return igabem_fail(IGABEM_ERROR_ARGUMENT, "%s: point %zu is at R = 0, where it is singular",
                       what, i);
}

igabem_status kelvin_check_domain(const char *what, size_t n, const double *X, const double *Y,
                                  const double *Z)
{
    if (n > 0 && (!X || !Y || !Z))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "%s: X, Y or Z is NULL", what);
    int good = 1;
    for (size_t i = 0; i < n; i++)
        good &= is_good(X[i], Y[i], Z[i]);
    for (size_t i = 0; !good && i < n; i++)
        if (!is_good(X[i], Y[i], Z[i]))
            return complain(what, i, X[i], Y[i], Z[i]);
    return IGABEM_OK;
}

igabem_status kelvin_check_wave_domain(const char *what, size_t n, const double *X, const double *Y,
                                       const double *Z)
{
    igabem_status status = kelvin_check_domain(what, n, X, Y, Z);
    for (size_t i = 0; status == IGABEM_OK && i < n; i++)
        if (fabs(X[i]) > 1e9 || fabs(Y[i]) > 1e9 || Z[i] < -1e9)
            status = igabem_fail(IGABEM_ERROR_ARGUMENT,
                                 "%s: point %zu is (%g, %g, %g), expected within 1e9", what, i,
                                 X[i], Y[i], Z[i]);
    return status;
}
