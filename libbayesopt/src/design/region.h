/* The part of [0,1]^d that satisfies the constraints known beforehand. */
#ifndef BAYESOPT_REGION_H
#define BAYESOPT_REGION_H

#include "core/random.h"

#include <bayesopt/design.h>

#include <stdbool.h>

struct region {
    size_t d, m;
    bayesopt_input_constraint constraint; /* on points of [0,1]^d; unused if m = 0 */
    void *data;
    double *values, *moved, *jacobian; /* [m], [m], [m x d] scratch */
    double *gram, *step;               /* [m x m], [d] scratch */
};

bool region_create(struct region *region, size_t d, size_t m, bayesopt_input_constraint constraint,
                   void *data);
void region_free(struct region *region);
/* Fills value [m] at x; false if x cannot be judged. */
bool region_values(struct region *region, const double *x, double *value);
bool region_contains(struct region *region, const double *x);
/* Sum of the positive values; INFINITY if x cannot be judged. */
double region_violation(struct region *region, const double *x);
/* Jacobian [m x d] by one-sided differences towards the inside of the box; values at x given. */
bool region_jacobian(struct region *region, const double *x, const double *value, double *jacobian);
/* Moves x into the region by Gauss-Newton steps of least length; false if that does not arrive. */
bool region_project(struct region *region, double *x);
/* The point of the segment from inside (in the region) to x nearest to x that bisection finds. */
void region_retreat(struct region *region, const double *inside, double *x);
/* A point of the region from uniform draws and their projections; false after many of both. */
bool region_find(struct region *region, struct random_stream *stream, double *x);

#endif
