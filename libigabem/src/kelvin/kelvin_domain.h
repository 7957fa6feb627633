/* The argument checks that every batch function of kelvin.h makes. */
#ifndef IGABEM_KELVIN_DOMAIN_H
#define IGABEM_KELVIN_DOMAIN_H

#include <igabem/status.h>

/* Finite X, Y, Z with Z <= 0 and not all zero, or IGABEM_ERROR_ARGUMENT naming the first other
 * point. */
igabem_status kelvin_check_domain(const char *what, size_t n, const double *X, const double *Y,
                                  const double *Z);

/* The same and |X|, |Y|, |Z| <= 1e9: beyond, the phase of W is lost to rounding. */
igabem_status kelvin_check_wave_domain(const char *what, size_t n, const double *X, const double *Y,
                                       const double *Z);

#endif
