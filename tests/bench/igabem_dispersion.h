#ifndef IGABEM_DISPERSION_H
#define IGABEM_DISPERSION_H

#include "../igabem/dispersion.h"

#include <stddef.h>

enum { SCHEMES = 7, SHARP = 5, USED = 6 };
extern const struct dispersion_scheme dispersion_schemes[SCHEMES];

/* First beta/pi at which waves do not go downstream alone, 2 if there is none; per eps. */
void dispersion_first_lost(const struct dispersion_scheme *scheme,
                           const struct dispersion_grid *grid, size_t n, const double *eps,
                           double *lost);

void dispersion_print_lines(void);
void dispersion_print_planes(void);
void dispersion_print_picture(void);

#endif
