/* The free waves behind a ship as they are seen over an area of the still water (docs/theory.md,
 * section 8), seen from x_s:
 *     zeta = Re Int A(t) e^{i k0 sqrt(1+t^2) (x - x_s + t y)} dt   over both signs, A even,
 *     A = Sum over stern, middle and bow, e^{-i k0 sqrt(1+t^2) (x_origin - x_s)} Sum c e^{-a t^2}.
 * Waves begin at bow and stern, so that about these A is smooth. */
#ifndef FREE_WAVES_H
#define FREE_WAVES_H

#include <igabem/status.h>

#include <complex.h>
#include <stddef.h>

enum { FREE_WAVES_TERMS = 21 };

struct free_waves {
    double k0, stern, length; /* 1/m, m: x_s and the extent of the ship */
    double _Complex c[FREE_WAVES_TERMS];
    double misfit; /* rms of what is left over that of the elevations */
};

/* Fits c to n elevations. */
igabem_status free_waves_fit(double k0, double stern, double length, size_t n, const double *x,
                             const double *y, const double *zeta, struct free_waves *waves);
double _Complex free_waves_amplitude(const struct free_waves *waves, double t);
/* Fills zeta[n]. */
igabem_status free_waves_elevation(const struct free_waves *waves, size_t n, const double *x,
                                   const double *y, double *zeta);

#endif
