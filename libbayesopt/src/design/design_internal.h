/* What the files that make designs share. */
#ifndef BAYESOPT_DESIGN_INTERNAL_H
#define BAYESOPT_DESIGN_INTERNAL_H

#include "core/random.h"
#include "design/region.h"

#include <bayesopt/design.h>

void design_uniform(size_t n, size_t d, struct random_stream *stream, double *x);
/* Latin hypercube on the strata that existing points leave free. */
bool design_lhs(size_t n, size_t d, const bayesopt_design_options *options,
                struct random_stream *stream, double *x);
bool design_anneal(size_t n, size_t d, const bayesopt_design_options *options,
                   struct random_stream *stream, double *x);
bool design_sobol(size_t n, size_t d, uint64_t seed, double *x);
bayesopt_status design_stlbo(size_t n, size_t d, const bayesopt_design_options *options,
                             struct region *region, double *x);
/* Moves every point into the region and spreads the points there. */
bayesopt_status design_constrain(size_t n, size_t d, const bayesopt_design_options *options,
                                 struct region *region, struct random_stream *stream, double *x);

/* Energy of a pair at squared distance d2. */
double design_pair_energy(double d2, double power);
double design_distance2(size_t d, const double *a, const double *b);

#endif
