/* The fixed rules of igabem_wave_residuals() and igabem_pressure_samples(). */
#ifndef RESIDUAL_H
#define RESIDUAL_H

#include "solve/solution.h"

#include <igabem/residual.h>

enum { RESIDUAL_ANGLES = IGABEM_WAVE_RESIDUALS / 2 };

/* Wave angles and what the Kochin function there is multiplied by, sqrt(2 w c sqrt(1+t^2)). */
igabem_status residual_angles(const igabem_solution *solution, double t[RESIDUAL_ANGLES],
                              double scale[RESIDUAL_ANGLES]);

/* Refuses numbers of parts that igabem_pressure_samples() does not take. */
igabem_status samples_check(size_t n_u, size_t n_v);

/* Number of samples of a patch, of which the first n_u n_v are on the hull, and their parameters.
 */
size_t samples_of_patch(const struct density_patch *patch, size_t n_u, size_t n_v);
void samples_place(const struct density_patch *patch, size_t n_u, size_t n_v, double (*uv)[2]);

/* What a sample of each kind counts for: `area` times n_x dS of the sample's part of the
 * parameters, `rise` times nu_x dl of its part of an edge. */
struct sample_scale {
    double area, rise;
};
struct sample_scale samples_scale(const igabem_solution *solution);

/* The same from the jets S, Su, Sv [9] of the samples. */
void samples_measure(const struct density_patch *patch, size_t n_u, size_t n_v, const double *jet,
                     struct sample_scale scale, igabem_pressure_sample *sample);

/* Edge of sample `at` of a patch, and its share of the edge; -1: on the hull. */
int samples_edge(const struct density_patch *patch, size_t n_u, size_t n_v, size_t at,
                 double *share);

#endif
