/* The Green function of pairs with a filtered wave part, for the matrices of panel.h. */
#ifndef IGABEM_KELVIN_GREEN_H
#define IGABEM_KELVIN_GREEN_H

#include <igabem/kelvin.h>

/* A sum of igabem_kelvin_part with one sign of the image, or IGABEM_ERROR_ARGUMENT. */
igabem_status kelvin_check_parts(unsigned parts);

/* igabem_kelvin_green() whose wave part is that of igabem_kelvin_wave_filtered(). */
igabem_status kelvin_green_filtered(double k0, size_t n, const double *x, const double *y,
                                    const double *z, const double *xi, const double *eta,
                                    const double *zeta, unsigned parts,
                                    const igabem_kelvin_filter *filter, double *g, double *gx,
                                    double *gy, double *gz);

#endif
