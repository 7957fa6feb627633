/* The wave part of a field of sources, summed over wave angles and marched from bow to stern: at a
 * transverse line x only the sources ahead of it count, so one running sum per angle serves every
 * point. */
#ifndef WAVE_MARCH_H
#define WAVE_MARCH_H

#include "result/wave_pieces.h"

struct wave_march {
    size_t n;                  /* wave angles t > 0 */
    double *t, *weight;        /* weight of Int dt, filter and sqrt(1+t^2) included */
    double *even_re, *even_im; /* Sum q e^{k0 (1+t^2) zeta - i k0 sqrt(1+t^2) xi} cos(.. t eta) */
    double *odd_re, *odd_im;   /* the same with sin; NULL when symmetric */
    int symmetric;
    double k0;
};

/* Angles up to t_max that resolve offsets up to length along and beam across. t_c: filter, 0 none.
 */
igabem_status wave_march_create(double k0, int symmetric, double length, double beam, double t_max,
                                double t_c, struct wave_march **march);
void wave_march_free(struct wave_march *march);

/* Adds the sources set[begin..end) to the running sums. */
void wave_march_add(struct wave_march *march, const struct point_set *set, size_t begin,
                    size_t end);

/* On the line x, with the sources of `extra` (ahead of x, NULL: none) besides the running sums: the
 * coefficients of Int f sqrt(1+t^2) ... dt = Sum even cos(b y) + odd sin(b y), b = k0 sqrt(1+t^2)
 * t. Fills even[n] and, unless symmetric, odd[n]. */
void wave_march_line(const struct wave_march *march, double x, const struct point_set *extra,
                     double *even, double *odd);

/* That sum at y. */
double wave_march_value(const struct wave_march *march, const double *even, const double *odd,
                        double y);

#endif
