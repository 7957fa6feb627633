/* The contour integral of the wave part W behind the source, x = -X > 0, y = |Y|, z = -Z >= 0:
 *
 *     W = 4 Im Int e^{f(v)} cosh v dv,   f = -z C^2 + i C (-x + y S),   C = cosh v, S = sinh v.
 *
 * With w = sinh(v/2), C = 1 + 2 w^2, S = 2 w s and dv = 2 dw/s, s = sqrt(1 + w^2). In w the
 * transverse waves are -i x 2 w^2 next to w = 0 and the diverging ones have the same width next to
 * w = sqrt(x/4y). The trapezoid rule in p on the explicit contour
 *
 *     w = q + i kappa,   q = q(p) real,   kappa = (y (1/r + 8 q^2 r) - 2 x q)/D,   r = sqrt(1 +
 * q^2), D = 2.9 x + 7.6 z + 2.6 y + (13.3 y + 16.8 z) q^2 + 1.5/r^2.
 *
 * f is entire in v, so any such contour that ends in the valleys will do; the numbers of D are
 * those that needed the fewest nodes among points behind a hull. The numerator vanishes at the
 * stationary points of the phase at z = 0, where the contour crosses the real axis at about -+40
 * degrees, near the path of steepest descent; D > 0 keeps it smooth where they merge (the cusp x^2
 * = 8 y^2), leave the real axis (outside the wedge) or go to infinity (the track y = 0). With the
 * flat short-wave filter the exponent gains -e^2 C^4, e = 1/(1 + t_c^2), and z becomes z + 2 e^2 (1
 * + 8 q^2 + 8 q^4) in D, which brings the ends of the contour back to the real axis.
 *
 * q = p, or q = sinh p where the contour is long: near the source only e^{-(y+z) 4 q^4} ends it. */
#ifndef IGABEM_KELVIN_CONTOUR_H
#define IGABEM_KELVIN_CONTOUR_H

#include "kelvin/kelvin_vecmath.h"
#include "kelvin/kelvin_wave_kernel.h"

/* x, y, z as above, of one point, two or sixteen in the lanes; e2 = e^2 of the filter or 0. */
struct kelvin_wave_points {
    kelvin_vec x, y, z;
    double e2;
};

struct kelvin_complex {
    kelvin_vec re, im;
};

/* Sixteen nodes: w = q + i kappa, r, dw/dq = 1 + i slope, E = 1 + w^2 and 1/|E|, C, S, C^2, C S,
 * the exponent f, dv/dq. */
struct kelvin_nodes {
    kelvin_vec q, r, kappa, slope, inverse;
    struct kelvin_complex E, C, S, C2, CS, f, dv;
};

KELVIN_INLINE void kelvin_multiply(const struct kelvin_complex *a, const struct kelvin_complex *b,
                                   struct kelvin_complex *product)
{
    kelvin_vec re = a->re * b->re - a->im * b->im, im = a->re * b->im + a->im * b->re;
    product->re = re;
    product->im = im;
}

/* kappa and its derivative with respect to q. */
KELVIN_INLINE void kelvin_place_contour(const struct kelvin_wave_points *p, enum kelvin_kind kind,
                                        enum kelvin_precision precision, struct kelvin_nodes *n)
{
    kelvin_vec q = n->q, x = p->x, y = p->y, z = p->z, square = q * q, r2 = 1 + square, rho;
    kelvin_vrsqrt_to(&r2, precision, &rho);
    kelvin_vec r = r2 * rho, y8q = 8 * (y * q);
    kelvin_vec rho2 = rho * rho, a = y * rho + q * (y8q * r - 2 * x);
    kelvin_vec da = y8q * (2 * r + rho * (square - 0.125 * rho2)) - 2 * x;
    kelvin_vec outer = 13.3 * y + 16.8 * z, bump = 1.5 * rho2;
    kelvin_vec D = (2.9 * x + 7.6 * z + 2.6 * y) + outer * square + bump;
    kelvin_vec dD = 2 * q * (outer - bump * rho2);
    if (kind == KELVIN_FILTERED) {
        kelvin_vec extra = 2 * p->e2 * (1 + 8 * square * r2), weight = 7.6 + 16.8 * square;
        D += weight * extra;
        dD += q * (2 * 16.8 * extra + weight * (32 * p->e2) * (1 + 2 * square));
    }
    kelvin_vec inverse = 1 / D;
    n->r = r;
    n->kappa = a * inverse;
    n->slope = (da - n->kappa * dD) * inverse;
}

/* Everything else at the nodes n->q. */
KELVIN_INLINE void kelvin_place_nodes(const struct kelvin_wave_points *p, enum kelvin_kind kind,
                                      enum kelvin_precision precision, struct kelvin_nodes *n)
{
    kelvin_place_contour(p, kind, precision, n);
    kelvin_vec q = n->q, k = n->kappa, x = p->x, y = p->y, z = p->z, root;
    struct kelvin_complex E = {1 + (q * q - k * k), 2 * q * k}, s;
    kelvin_vec square = E.re * E.re + E.im * E.im;
    kelvin_vrsqrt_to(&square, precision, &n->inverse);
    kelvin_vec half = 0.5 * (square * n->inverse + E.re);
    kelvin_vrsqrt_to(&half, precision, &root);
    s.re = half * root;
    s.im = 0.5 * E.im * root;
    n->E = E;
    n->C.re = 2 * E.re - 1;
    n->C.im = 2 * E.im;
    n->S.re = 2 * (q * s.re - k * s.im);
    n->S.im = 2 * (q * s.im + k * s.re);
    kelvin_vec twice = 2 * n->inverse;
    n->dv.re = twice * (s.re + n->slope * s.im);
    n->dv.im = twice * (n->slope * s.re - s.im);
    n->C2.re = n->C.re * n->C.re - n->C.im * n->C.im;
    n->C2.im = 2 * n->C.re * n->C.im;
    kelvin_multiply(&n->C, &n->S, &n->CS);
    n->f.re = x * n->C.im - z * n->C2.re - y * n->CS.im;
    n->f.im = y * n->CS.re - x * n->C.re - z * n->C2.im;
    if (kind == KELVIN_FILTERED) {
        n->f.re -= p->e2 * (n->C2.re * n->C2.re - n->C2.im * n->C2.im);
        n->f.im -= 2 * p->e2 * n->C2.re * n->C2.im;
    }
}

/* As functions of q: the frequency |Im f_q| and the curvature |f_qq| of the exponent, f_q = f' v_q,
 * f_qq = v_q (f'' v_q - f' w w_q/(1 + w^2)), w_qq neglected, where f' = -2z C S + i (-x S + y (2
 * C^2 - 1)) - 4 e2 C^2 C S, f'' = -2z (2 C^2 - 1) + i (-x C + 4 y C S) - 4 e2 (4 C^4 - 3 C^2). */
KELVIN_INLINE void kelvin_bandwidth(const struct kelvin_wave_points *p,
                                    const struct kelvin_nodes *n, enum kelvin_kind kind,
                                    kelvin_vec *frequency, kelvin_vec *curvature)
{
    kelvin_vec x = p->x, y = p->y, z = p->z, root;
    struct kelvin_complex first, second, bend;
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
    /* -w w_q/(1 + w^2). */
    kelvin_vec scale = n->inverse * n->inverse, re = n->kappa * n->slope - n->q,
               im = -n->kappa - n->q * n->slope;
    bend.re = scale * (re * n->E.re + im * n->E.im);
    bend.im = scale * (im * n->E.re - re * n->E.im);
    *frequency = first.im * n->dv.re + first.re * n->dv.im;
    *frequency = KELVIN_MAX(*frequency, -*frequency);
    kelvin_multiply(&second, &n->dv, &second);
    kelvin_multiply(&first, &bend, &first);
    second.re += first.re;
    second.im += first.im;
    kelvin_vec square = (second.re * second.re + second.im * second.im) *
                            (n->dv.re * n->dv.re + n->dv.im * n->dv.im) +
                        1e-280;
    kelvin_vrsqrt_to(&square, KELVIN_ROUGH, &root);
    *curvature = square * root;
}

#endif
