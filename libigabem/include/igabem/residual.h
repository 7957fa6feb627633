/**
 * @file residual.h
 * C_w in the form that Gauss-Newton methods want: as a sum of squares of the Kochin function, which
 * is nearly linear in the shape, and the resistance by pressure as a sum over points of the hull of
 * terms in the velocities, which are nearly linear in it too. The quadratic models made of these
 * hold over ten times the step of one made of C_w itself.
 */
#ifndef IGABEM_RESIDUAL_H
#define IGABEM_RESIDUAL_H

#include <igabem/solve.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Numbers of igabem_wave_residuals(): real and imaginary part at 160 wave angles. */
enum { IGABEM_WAVE_RESIDUALS = 320 };

/** Fills r[IGABEM_WAVE_RESIDUALS], |r|^2 = C_w: sqrt(2 w c) (Re H, Im H) at the angles of a fixed
 * Gauss rule with weights w, c |H|^2 = d C_w/d t. The sum meets C_w of igabem_forces_compute() to
 * some 1e-4 (4e-4 at low Froude numbers). Half hulls, whose two signs of t are alike. */
IGABEM_API igabem_status igabem_wave_residuals(const igabem_solution *solution, double *r);

/** One point of the hull or of its waterline: C_w by pressure is the sum over all of
 * (v_x - v.v/2) area + v_x^2 rise/2. */
typedef struct igabem_pressure_sample {
    double v[3]; /**< grad phi / U */
    double area; /**< 4 n_x dS / S on a half hull, 0 on the waterline */
    double rise; /**< 4 U^2 nu_x dl / (g S) on the waterline, 0 on the hull: the strip between still
                    water and wave */
} igabem_pressure_sample;

/** Samples at the middles of n_u x n_v equal parts of the parameters of every patch, and of 2 n_u
 * or 2 n_v parts of every edge in the waterline. Of solutions on hulls with the same patches,
 * however fine they are solved, the samples stand for the same parameters.
 * @param sample  created, to be given to free(); NULL: only count them
 * @param[out] n  their number
 * Errors: IGABEM_ERROR_ARGUMENT: the formulation has no velocity on the hull. */
IGABEM_API igabem_status igabem_pressure_samples(const igabem_solution *solution, size_t n_u,
                                                 size_t n_v, size_t *n,
                                                 igabem_pressure_sample **sample);

/** C_w by pressure, the sum above. gradient (NULL: not wanted) is filled with its derivatives. */
IGABEM_API double igabem_pressure_sum(size_t n, const igabem_pressure_sample *sample,
                                      igabem_pressure_sample *gradient);

#ifdef __cplusplus
}
#endif

#endif
