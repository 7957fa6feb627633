/* The wave part of a field of sources, summed over wave angles and marched from bow to stern: at a
 * transverse line x only the sources ahead of it count, so one running sum per angle serves every
 * point. */
#ifndef ELEVATION_MARCH_H
#define ELEVATION_MARCH_H

#include "result/elevation_pieces.h"

struct elevation_march {
    size_t n;                  /* wave angles t > 0 */
    double *t, *weight;        /* weight of Int dt, filter and sqrt(1+t^2) included */
    double *even_re, *even_im; /* Sum q e^{k0 (1+t^2) zeta - i k0 sqrt(1+t^2) xi} cos(.. t eta) */
    double *odd_re, *odd_im;   /* the same with sin; NULL when symmetric */
    bool symmetric;
    double k0;
};

/* Angles up to t_max that resolve offsets up to length along and beam across. t_c: filter, 0 none.
 */
igabem_status elevation_march_create(double k0, bool symmetric, double length, double beam,
                                     double t_max, double t_c, struct elevation_march **march);
void elevation_march_free(struct elevation_march *march);

/* Adds the sources set[begin..end) to the running sums. */
void elevation_march_add(struct elevation_march *march, const struct point_set *set, size_t begin,
                         size_t end);

/* On the line x, with the sources of `extra` (ahead of x, NULL: none) besides the running sums: the
 * coefficients of Int f sqrt(1+t^2) ... dt = Sum even cos(b y) + odd sin(b y), b = k0 sqrt(1+t^2)
 * t. Fills even[n] and, unless symmetric, odd[n]. */
void elevation_march_line(const struct elevation_march *march, double x,
                          const struct point_set *extra, double *even, double *odd);

/* That sum at y. */
double elevation_march_value(const struct elevation_march *march, const double *even,
                             const double *odd, double y);

#endif
