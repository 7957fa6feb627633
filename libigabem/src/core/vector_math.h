/* Exponential, sine and cosine that vectorise: no branches, no integer conversion, no library call.
 * Compiled once per instruction set where the loader can choose (VECTOR_MULTIVERSION); not by clang
 * 14, which loses multiversioned functions that another file calls. */
#ifndef VECTOR_MATH_H
#define VECTOR_MATH_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#if defined(__x86_64__) && defined(__linux__) && !defined(__clang__) &&                            \
    !defined(ISOHULL_NO_MULTIVERSION)
#define VECTOR_MULTIVERSION                                                                        \
    __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define VECTOR_MULTIVERSION
#endif
#define VECTOR_INLINE static inline __attribute__((always_inline))

/* e^x for -700 <= x <= 700, relative error below 4e-16: 2^n times the Taylor polynomial of degree
 * 12 on |r| <= ln(2)/2. */
VECTOR_INLINE double vector_exp(double x)
{
    const double shifter = 6755399441055744.0; /* 1.5 * 2^52: leaves an integer in the low bits */
    x = x > -700.0 ? x : -700.0;
    double shifted = x * 1.4426950408889634 + shifter;
    double n = shifted - shifter;
    double r = x - n * 6.93147180369123816490e-01;
    r -= n * 1.90821492927058770002e-10;
    double p = 1.0 / 479001600.0;
    p = p * r + 1.0 / 39916800.0;
    p = p * r + 1.0 / 3628800.0;
    p = p * r + 1.0 / 362880.0;
    p = p * r + 1.0 / 40320.0;
    p = p * r + 1.0 / 5040.0;
    p = p * r + 1.0 / 720.0;
    p = p * r + 1.0 / 120.0;
    p = p * r + 1.0 / 24.0;
    p = p * r + 1.0 / 6.0;
    p = p * r + 0.5;
    p = p * r + 1.0;
    p = p * r + 1.0;
    uint64_t bits, power;
    memcpy(&bits, &shifted, sizeof bits);
    power = (bits + 1023) << 52; /* the shifter's own bits leave at the top */
    double scale;
    memcpy(&scale, &power, sizeof scale);
    return p * scale;
}

/* sin x and cos x for |x| < 1e6, absolute error below 1e-15 + 1e-16 |x|: Taylor polynomials on
 * |r| <= pi/4 after reduction by multiples of pi/2. */
VECTOR_INLINE void vector_sincos(double x, double *sine, double *cosine)
{
    double n = rint(x * 0.63661977236758134308);
    double r = x - n * 1.57079632673412561417e+00;
    r -= n * 6.07710050650619224932e-11;
    double r2 = r * r;
    double s = -1.0 / 1307674368000.0;
    s = s * r2 + 1.0 / 6227020800.0;
    s = s * r2 - 1.0 / 39916800.0;
    s = s * r2 + 1.0 / 362880.0;
    s = s * r2 - 1.0 / 5040.0;
    s = s * r2 + 1.0 / 120.0;
    s = s * r2 - 1.0 / 6.0;
    s = s * r2 * r + r;
    double c = 1.0 / 20922789888000.0;
    c = c * r2 - 1.0 / 87178291200.0;
    c = c * r2 + 1.0 / 479001600.0;
    c = c * r2 - 1.0 / 3628800.0;
    c = c * r2 + 1.0 / 40320.0;
    c = c * r2 - 1.0 / 720.0;
    c = c * r2 + 1.0 / 24.0;
    c = c * r2 - 0.5;
    c = c * r2 + 1.0;
    double half = floor(0.5 * n), odd = n - 2.0 * half;         /* n mod 2 */
    double sign = 1.0 - 2.0 * (half - 2.0 * floor(0.5 * half)); /* -1 in quadrants 2 and 3 */
    double ss = odd != 0.0 ? c : s, cc = odd != 0.0 ? -s : c;
    *sine = sign * ss;
    *cosine = sign * cc;
}

#endif
