/* The functions of a density on half its knots: a part of its space, so that rows of a matrix for
 * the density are rows for this part too. */
#ifndef COARSE_H
#define COARSE_H

#include "space/density.h"

struct coarse;

/* Every second simple knot of each direction is left out; NULL in *coarse where there is none. */
igabem_status coarse_create(const struct density *density, struct coarse **coarse);
void coarse_free(struct coarse *coarse);

/* Number of its functions. */
size_t coarse_size(const struct coarse *coarse);

/* Numbers of `work` below. */
size_t coarse_work(const struct coarse *coarse);

/* A row of a matrix for the density (n numbers) becomes one for the part. */
void coarse_row(const struct coarse *coarse, const double *row, double *work, double *part);

/* Coefficients in the part become those of the density. */
void coarse_expand(const struct coarse *coarse, const double *part, double *work, double *density);

#endif
