#include "sine_kernel.h"

#include "simd.h"

#include <stdint.h>
#include <string.h>

/* sin(pi v) within 1.1 ulp for |v| < 2^50, exactly 0 at integers. v = k + t with |t| <= 1/2 by
 * adding 1.5 2^52, which leaves k in the low bits; sin(pi v) = (-1)^k sin(pi t), and sin(pi t)/t is
 * a polynomial in t^2 interpolated at the Chebyshev points of [0, 1/4] (relative error 3e-17). */
GALV_SIMD_INLINE double sine_pi(double v)
{
    double shifted = v + 0x1.8p52, t = v - (shifted - 0x1.8p52), q = t * t;
    double p = 0x1.9d462020fcc78p-21;
    p = p * q - 0x1.6f7acdb8f658p-16;
    p = p * q + 0x1.e8f3675ee37ddp-12;
    p = p * q - 0x1.e3074dfaf87afp-8;
    p = p * q + 0x1.5078348551854p-4;
    p = p * q - 0x1.32d2cce627c86p-1;
    p = p * q + 0x1.466bc6775aa7dp+1;
    p = p * q - 0x1.4abbce625be52p+2;
    p = p * q + 0x1.921fb54442d18p+1;
    p *= t;
    uint64_t parity, bits;
    memcpy(&parity, &shifted, sizeof parity);
    memcpy(&bits, &p, sizeof bits);
    bits ^= parity << 63;
    memcpy(&p, &bits, sizeof p);
    return p;
}

/* The usual step: only the sine along the direction of motion is live. */
GALV_SIMD_INLINE void step_one(const galv_sine_step *step, double x, const double *restrict factor,
                               const double *restrict s, double *restrict d)
{
    double order = step->order[0], phase = step->phase[0], per_length = step->per_length[0];
    for (size_t p = 0; p < GALV_TILE; p++)
        d[p] += x * factor[p] * sine_pi(order * (s[p] + per_length * d[p]) + phase);
}

GALV_SIMD_INLINE void step_any(const galv_sine_step *step, double x, const double *restrict factor,
                               const double *restrict s, double *restrict d)
{
    double v[GALV_TILE];
    for (size_t p = 0; p < GALV_TILE; p++)
        v[p] = x * factor[p];
    for (int l = 0; l < step->live; l++) {
        const double *sl = s + step->axis[l] * GALV_TILE, *dl = d + step->axis[l] * GALV_TILE;
        double order = step->order[l], phase = step->phase[l], per_length = step->per_length[l];
        for (size_t p = 0; p < GALV_TILE; p++)
            v[p] *= sine_pi(order * (sl[p] + per_length * dl[p]) + phase);
    }
    double *dq = d + step->direction * GALV_TILE;
    for (size_t p = 0; p < GALV_TILE; p++)
        dq[p] += v[p];
}

GALV_SIMD void galv_sine_tile(size_t n, const galv_sine_step *steps, const double *x,
                              const double *factors, const double *s, double *d)
{
    for (size_t i = 0; i < n; i++, factors += GALV_TILE) {
        const galv_sine_step *step = &steps[i];
        size_t axis = (size_t)step->direction * GALV_TILE;
        if (step->live == 1 && step->axis[0] == step->direction)
            step_one(step, x[i], factors, s + axis, d + axis);
        else
            step_any(step, x[i], factors, s, d);
    }
}

GALV_SIMD void galv_sine_factor(double order, double phase, const double *restrict s,
                                double *restrict v)
{
    for (size_t p = 0; p < GALV_TILE; p++)
        v[p] *= sine_pi(order * s[p] + phase);
}
