/* Far-field wave amplitude of a set of point sources, and the resistance that it carries. */
#ifndef AMPLITUDE_H
#define AMPLITUDE_H

#include "result/sources.h"

/* H(t) = Sum q e^{k0 (1+t^2) z + i k0 sqrt(1+t^2) (x + t y)} over surface and line sources and
 * their mirror images: fills h[0] real, h[1] imaginary part. Sources below the reach of angle t
 * (decay e^-40) are not visited. Of a potential Green's identity (docs/theory.md, section 11). */
void amplitude(const struct sources *sources, double k0, double t, double h[2]);

/* The same for up to AMPLITUDE_SETS sources that differ in their strengths only: fills h[sets][2].
 * The waves at their common places are computed once. */
enum { AMPLITUDE_SETS = 4 };
void amplitude_sets(size_t sets, const struct sources *const *sources, double k0, double t,
                    double (*h)[2]);

/* A rule for Int f(t) dt, 0 <= t <= t_max, of products of two amplitudes: Gauss panels in v, t =
 * sinh v, short enough for the phase k0 sqrt(1+t^2) (length + t beam). t_break (0: none) is the end
 * of a panel. Creates *t and *weight. */
igabem_status amplitude_rule(double k0, double length, double beam, double t_max, double t_break,
                             size_t *n, double **t, double **weight);

/* What a spectrum adds up to, in units of the resistance integral
 * Int_{-inf}^{inf} |H|^2 sqrt(1+t^2) dt. */
struct amplitude_sum {
    double total;  /* the integral */
    double beyond; /* its part from |t| > t_break */
};

/* Integrates the spectra over 0 <= |t| <= t_max of up to AMPLITUDE_SETS sources that differ in
 * their strengths only: fills sum[sets]. */
igabem_status amplitude_integrate(size_t sets, const struct sources *const *sources, double k0,
                                  double length, double beam, double t_max, double t_break,
                                  struct amplitude_sum *sum);

#endif
