/* Kernels of the wave part by instruction set. Each is a translation unit of its own: one for all
 * of them takes a compiler a minute and more than a gigabyte. */
#ifndef IGABEM_KELVIN_WAVE_KERNEL_H
#define IGABEM_KELVIN_WAVE_KERNEL_H

#include <stddef.h>

/* Which integrand: known at compile time wherever it is passed on. */
enum kelvin_kind { KELVIN_PLAIN, KELVIN_FILTERED, KELVIN_SECOND_DERIVATIVES };

struct kelvin_wave_call {
    enum kelvin_kind kind;
    size_t n;
    const double *X, *Y, *Z; /* [n], checked */
    double depth, e2;        /* of the filter, see kelvin_contour.h */
    double *to[6]; /* [n] or NULL: W, W_X, W_Y, W_Z, or W_XX, W_XY, W_XZ, W_YY, W_YZ, W_ZZ */
};

typedef void kelvin_wave_kernel(const struct kelvin_wave_call *call);

kelvin_wave_kernel kelvin_wave_base, kelvin_wave_avx2, kelvin_wave_avx512;

#endif
