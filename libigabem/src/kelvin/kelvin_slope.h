/* The local part as tangents want it. */
#ifndef IGABEM_KELVIN_SLOPE_H
#define IGABEM_KELVIN_SLOPE_H

#include <igabem/status.h>

#include <stddef.h>

/* Gradient of N and its derivative with respect to Y, components X, Y, Z: fills gradient[3][n] and
 * slope[3][n]. */
igabem_status kelvin_local_slope(size_t n, const double *X, const double *Y, const double *Z,
                                 double *gradient, double *slope);

#endif
