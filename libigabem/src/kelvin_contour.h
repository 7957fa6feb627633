/* The contour integral of the wave part W behind the source, x = -X > 0, y = |Y|, z = -Z >= 0:
 *
 *     W = 4 Im Int e^{f(v)} cosh v dv,   f = -z C^2 + i C (-x + y S),   C = cosh v, S = sinh v,
 *
 * by the trapezoid rule in u on the explicit contour v = u + i tau(u),
 *
 *     tau = atan2(a, b)/2,  a = y cosh 2u - x sinh u,
 *     b = z cosh 2u + sqrt(x^2/cosh^2 u + y^2 cosh^2 2u + 1)/2.
 *
 * f is entire, so any such contour that ends in the valleys will do. a vanishes at the stationary
 * points of the phase x sinh - y sinh 2u/2 at z = 0, where the contour crosses the real axis at
 * -+45 degrees as the path of steepest descent does; b keeps it smooth where they merge (the cusp
 * x^2 = 8 y^2), leave the real axis (outside the wedge) or go to infinity (the track y = 0). With
 * the flat short-wave filter the exponent gains -e^2 C^4, e = 1/(1 + t_c^2), and b gains
 * 2 e^2 cosh^2 2u, which brings the ends of the contour back to the real axis. */
#ifndef IGABEM_KELVIN_CONTOUR_H
#define IGABEM_KELVIN_CONTOUR_H

#include "kelvin_vecmath.h"

/* x, y, z as above, of one point in all lanes or of eight points; e2 = e^2 of the filter or 0. */
struct kelvin_wave_points {
    kelvin_vec x, y, z;
    double e2;
};

/* Which integrand: known at compile time wherever it is passed on. */
enum kelvin_kind { KELVIN_PLAIN, KELVIN_FILTERED, KELVIN_SECOND_DERIVATIVES };

struct kelvin_complex {
    kelvin_vec re, im;
};

/* Eight nodes: C, S, C^2, C S, the exponent f, dtau/du. */
struct kelvin_nodes {
    struct kelvin_complex C, S, C2, CS, f;
    kelvin_vec slope;
};

/* e = e^u and g = e^-u at the nodes. */
KELVIN_INLINE void kelvin_place_nodes(const struct kelvin_wave_points *p, const kelvin_vec *e,
                                      const kelvin_vec *g, enum kelvin_kind kind,
                                      enum kelvin_precision precision, struct kelvin_nodes *nodes)
{
    kelvin_vec x = p->x, y = p->y, z = p->z;
    kelvin_vec ch = 0.5 * (*e + *g), sh = 0.5 * (*e - *g), ch_sq = ch * ch;
    kelvin_vec ch2 = 2 * ch_sq - 1, sh2 = 2 * sh * ch, ych2 = y * ch2;
    /* A = a cosh u, B = b cosh u and their derivatives; root = sqrt(x^2 + cosh^2 u (y^2 cosh^2 2u +
     * 1)). */
    kelvin_vec a = ych2 - x * sh, A = a * ch;
    kelvin_vec dA = (2 * y * sh2 - x * ch) * ch + a * sh;
    kelvin_vec inner = ych2 * ych2 + 1, square = x * x + ch_sq * inner, rroot;
    kelvin_vrsqrt_to(&square, precision, &rroot);
    kelvin_vec B = z * ch2 * ch + 0.5 * square * rroot;
    kelvin_vec dB = z * (2 * sh2 * ch + ch2 * sh) +
                    0.5 * ch * rroot * (sh * inner + 2 * ch * (y * y) * ch2 * sh2);
    if (kind == KELVIN_FILTERED) {
        B += 2 * p->e2 * ch2 * ch2 * ch;
        dB += 2 * p->e2 * ch2 * (4 * sh2 * ch + ch2 * sh);
    }
    kelvin_vec modulus = A * A + B * B, rmod, rcos;
    kelvin_vrsqrt_to(&modulus, precision, &rmod);
    nodes->slope = 0.5 * (dA * B - dB * A) * (rmod * rmod);
    kelvin_vec cos2 = B * rmod, sin2 = A * rmod, cos_sq = 0.5 + 0.5 * cos2;
    kelvin_vrsqrt_to(&cos_sq, precision, &rcos);
    kelvin_vec cosine = cos_sq * rcos, sine = 0.5 * sin2 * rcos;
    nodes->C.re = ch * cosine;
    nodes->C.im = sh * sine;
    nodes->S.re = sh * cosine;
    nodes->S.im = ch * sine;
    nodes->C2.re = 0.5 + 0.5 * ch2 * cos2;
    nodes->C2.im = 0.5 * sh2 * sin2;
    nodes->CS.re = 0.5 * sh2 * cos2;
    nodes->CS.im = 0.5 * ch2 * sin2;
    nodes->f.re = x * nodes->C.im - z * nodes->C2.re - y * nodes->CS.im;
    nodes->f.im = y * nodes->CS.re - x * nodes->C.re - z * nodes->C2.im;
    if (kind == KELVIN_FILTERED) {
        nodes->f.re -= p->e2 * (nodes->C2.re * nodes->C2.re - nodes->C2.im * nodes->C2.im);
        nodes->f.im -= 2 * p->e2 * nodes->C2.re * nodes->C2.im;
    }
}

/* As functions of u, with v' = 1 + i slope: the frequency |Im f' v'| and the curvature |f'' v'^2|
 * of the exponent, f'  = -2z C S + i (-x S + y (2 C^2 - 1)) - 4 e2 C^2 C S, f'' = -2z (2 C^2 - 1) +
 * i (-x C + 4 y C S) - 4 e2 (4 C^4 - 3 C^2). */
KELVIN_INLINE void kelvin_bandwidth(const struct kelvin_wave_points *p,
                                    const struct kelvin_nodes *n, enum kelvin_kind kind,
                                    kelvin_vec *frequency, kelvin_vec *curvature)
{
    kelvin_vec x = p->x, y = p->y, z = p->z, stretch = 1 + n->slope * n->slope, root;
    struct kelvin_complex first, second;
    first.re = x * n->S.im - 2 * (z * n->CS.re + y * n->C2.im);
    first.im = y * (2 * n->C2.re - 1) - x * n->S.re - 2 * z * n->CS.im;
    second.re = x * n->C.im - 4 * (y * n->CS.im + z * n->C2.re) + 2 * z;
    second.im = 4 * (y * n->CS.re - z * n->C2.im) - x * n->C.re;
    if (kind == KELVIN_FILTERED) {
        kelvin_vec r = n->C2.re, i = n->C2.im;
        first.re -= 4 * p->e2 * (r * n->CS.re - i * n->CS.im);
        first.im -= 4 * p->e2 * (r * n->CS.im + i * n->CS.re);
        second.re -= 4 * p->e2 * (4 * (r * r - i * i) - 3 * r);
        second.im -= 4 * p->e2 * (8 * r * i - 3 * i);
    }
    *frequency = first.im + n->slope * first.re;
    *frequency = KELVIN_MAX(*frequency, -*frequency);
    kelvin_vec square = second.re * second.re + second.im * second.im + 1e-280;
    kelvin_vrsqrt_to(&square, KELVIN_ROUGH, &root);
    *curvature = square * root * stretch;
}

#endif
