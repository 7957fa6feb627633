/* Elementary functions of sixteen doubles, to a few units in the last place on the ranges stated:
 * what the contour integral of W needs. Plain arithmetic and integer shifts, so that every
 * instruction set does. */
#ifndef IGABEM_KELVIN_VECMATH_H
#define IGABEM_KELVIN_VECMATH_H

#include "kelvin/kelvin_simd.h"

/* Adding 1.5 2^52 leaves the nearest integer in the low bits of a double. */
#define KELVIN_ROUNDER 0x1.8p52

/* Lane by lane, on finite numbers: a mask of all ones where a < b, taken from the sign of a - b,
 * because compilers break wide comparisons up into single lanes. */
#define KELVIN_LESS(a, b) (0 - ((kelvin_bits)((a) - (b)) >> 63))
#define KELVIN_SELECT(mask, a, b)                                                                  \
    ((kelvin_vec)(((kelvin_bits)(a) & (mask)) | ((kelvin_bits)(b) & ~(mask))))
#define KELVIN_MAX(a, b) KELVIN_SELECT(KELVIN_LESS(b, a), a, b)
#define KELVIN_MIN(a, b) KELVIN_SELECT(KELVIN_LESS(a, b), a, b)

/* e^x for |x| < 708: 2^n e^r with |r| <= ln(2)/2, Taylor to r^12 (relative error 2e-16 truncated).
 */
KELVIN_INLINE void kelvin_vexp(const kelvin_vec *px, kelvin_vec *out)
{
    kelvin_vec x = *px, shifted = x * 0x1.71547652b82fep0 + KELVIN_ROUNDER,
               n = shifted - KELVIN_ROUNDER;
    kelvin_vec r = x - n * 0x1.62e42fee00000p-1 - n * 0x1.a39ef35793c76p-33, r2 = r * r,
               r4 = r2 * r2;
    kelvin_vec p0 = 1 + r, p2 = 0.5 + r * (1.0 / 6), p4 = 1.0 / 24 + r * (1.0 / 120),
               p6 = 1.0 / 720 + r * (1.0 / 5040), p8 = 1.0 / 40320 + r * (1.0 / 362880),
               p10 = 1.0 / 3628800 + r * (1.0 / 39916800) + r2 * (1.0 / 479001600);
    kelvin_vec sum = (p0 + r2 * p2) + r4 * ((p4 + r2 * p6) + r4 * (p8 + r2 * p10));
    *out = (kelvin_vec)((kelvin_bits)sum + ((kelvin_bits)shifted << 52));
}

/* sin x and cos x for |x| < 1e12, absolute error about 2^-53 |x| beyond 1e6: reduction by pi/2 in
 * three parts, Taylor to r^15 and r^16 on |r| <= pi/4. */
KELVIN_INLINE void kelvin_vsincos(const kelvin_vec *px, kelvin_vec *sine, kelvin_vec *cosine)
{
    kelvin_vec x = *px, shifted = x * 0x1.45f306dc9c883p-1 + KELVIN_ROUNDER,
               n = shifted - KELVIN_ROUNDER;
    kelvin_vec r =
        x - n * 0x1.921fb54400000p0 - n * 0x1.0b4611a600000p-34 - n * 0x1.3198a2e037073p-69;
    kelvin_vec q = r * r, q2 = q * q, q4 = q2 * q2;
    kelvin_vec s = ((1 - q * (1.0 / 6)) + q2 * (1.0 / 120 - q * (1.0 / 5040))) +
                   q4 * ((1.0 / 362880 - q * (1.0 / 39916800)) +
                         q2 * (1.0 / 6227020800 - q * (1.0 / 1307674368000)));
    kelvin_vec c =
        ((1 - q * 0.5) + q2 * (1.0 / 24 - q * (1.0 / 720))) +
        q4 * ((1.0 / 40320 - q * (1.0 / 3628800)) +
              q2 * (1.0 / 479001600 - q * (1.0 / 87178291200) + q2 * (1.0 / 20922789888000)));
    s *= r;
    /* Quadrant: odd swaps, bit 1 of n flips the sine, bit 1 of n+1 the cosine. */
    kelvin_bits k = (kelvin_bits)shifted, odd = -(k & 1), sbits = (kelvin_bits)s,
                cbits = (kelvin_bits)c;
    *sine = (kelvin_vec)(((sbits & ~odd) | (cbits & odd)) ^ ((k & 2) << 62));
    *cosine = (kelvin_vec)(((cbits & ~odd) | (sbits & odd)) ^ (((k + 1) & 2) << 62));
}

/* How good 1/sqrt is: exact to rounding, or to 1e-5 for what only places nodes. */
enum kelvin_precision { KELVIN_FULL, KELVIN_ROUGH };

/* 1/sqrt(x) for normal x > 0: a linear guess on the exponent and mantissa bits (relative error
 * 0.034), then the series of y (1-e)^{-1/2}, e = 1 - x y^2, to e^3 (error 7e-6) and again to e^2.
 */
KELVIN_INLINE void kelvin_vrsqrt_to(const kelvin_vec *px, enum kelvin_precision precision,
                                    kelvin_vec *out)
{
    kelvin_vec x = *px;
    kelvin_vec y = (kelvin_vec)(UINT64_C(0x5fe6eb50c7b537a9) - ((kelvin_bits)x >> 1));
    kelvin_vec e = 1 - x * y * y;
    y += y * e * (0.5 + e * (0.375 + e * 0.3125));
    if (precision == KELVIN_FULL) {
        e = 1 - x * y * y;
        y += y * e * (0.5 + e * 0.375);
    }
    *out = y;
}

KELVIN_INLINE void kelvin_vrsqrt(const kelvin_vec *px, kelvin_vec *out)
{
    kelvin_vrsqrt_to(px, KELVIN_FULL, out);
}

/* Natural logarithm of normal x > 0 to 1e-9: places nodes, where nothing better is needed. ln x = e
 * ln 2 + 2 artanh((m-1)/(m+1)), x = m 2^e, m in [sqrt(1/2), sqrt 2). */
KELVIN_INLINE void kelvin_vlog(const kelvin_vec *px, kelvin_vec *out)
{
    kelvin_bits bits = (kelvin_bits)*px - UINT64_C(0x3fe6a09e667f3bcd);
    kelvin_bits power = bits & UINT64_C(0xfff0000000000000);
    kelvin_vec m = (kelvin_vec)((kelvin_bits)*px - power);
    /* The exponent as a double: its biased value below the mantissa bits of 2^52. */
    kelvin_bits biased = (power + (UINT64_C(1023) << 52)) >> 52;
    kelvin_vec e = (kelvin_vec)(biased | UINT64_C(0x4330000000000000)) - (0x1p52 + 1023);
    kelvin_vec s = (m - 1) / (m + 1), q = s * s;
    *out = e * 0x1.62e42fefa39efp-1 +
           2 * s * (1 + q * (1.0 / 3 + q * (1.0 / 5 + q * (1.0 / 7 + q * (1.0 / 9)))));
}

/* Natural logarithm of normal x > 0 within 0.06 below: the exponent, and the mantissa for its
 * logarithm. */
KELVIN_INLINE void kelvin_vlog_rough(const kelvin_vec *px, kelvin_vec *out)
{
    kelvin_bits bits = (kelvin_bits)*px;
    kelvin_vec scaled = (kelvin_vec)((bits >> 12) | UINT64_C(0x4330000000000000)) - 0x1p52;
    *out = (scaled * 0x1p-40 - 1023) * 0x1.62e42fefa39efp-1;
}

/* The sum of eight lanes. */
KELVIN_INLINE double kelvin_add_octet(const kelvin_vec *v, int first)
{
    double a[KELVIN_LANES];
    memcpy(a, v, sizeof a);
    const double *o = a + first;
    return ((o[0] + o[4]) + (o[2] + o[6])) + ((o[1] + o[5]) + (o[3] + o[7]));
}

KELVIN_INLINE double kelvin_add_lanes(const kelvin_vec *v)
{
    return kelvin_add_octet(v, 0) + kelvin_add_octet(v, KELVIN_OCTET);
}

#endif
