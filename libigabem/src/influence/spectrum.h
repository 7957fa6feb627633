/* Wave angles t = tan(theta) > 0 of the wave part
 *     k0 W = 4 k0 H(-X) Int f(t) e^{Z (1+t^2)} sin((X + Y t) sqrt(1+t^2)) dt,
 *     f(t) = exp(-((1+t^2)/(1+t_c^2))^2). */
#ifndef SPECTRUM_H
#define SPECTRUM_H

#include <igabem/status.h>

#include <stddef.h>

struct spectrum {
    size_t n;
    double *t, *weight; /* weight of Int dt, without filter */
    double *root;       /* sqrt(1+t^2) */
};

/* Largest angle that counts to a relative tolerance: the filter has fallen to it, or the decay over
 * the least depth |z + zeta| of any pair of points. cutoff INFINITY and depth 0 are both "none". */
double spectrum_limit(double k0, double cutoff, double depth, double tolerance);

/* 10-point Gauss panels, each at most 20 radians of k0 sqrt(1+t^2) (length + t beam) and 0.4 of
 * asinh t long. */
igabem_status spectrum_create(double k0, double t_max, double length, double beam,
                              struct spectrum **spectrum);
void spectrum_free(struct spectrum *spectrum);

/* f(t). */
double spectrum_filter(double t, double cutoff);

#endif
