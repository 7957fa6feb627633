/* Derivatives of the Kochin function: what the solution's point sources radiate while they and
 * their places change. */
#ifndef RADIATE_H
#define RADIATE_H

#include "tangent/tangent.h"

/* Point sources of one kind: surface by increasing depth, waterline. */
struct carriers {
    size_t n;
    double *x, *y, *z; /* z of the waterline: NULL */
    double *strength;  /* q */
    double *change;    /* [n][2][fields]: of the strength q; q times the move along y */
};

struct radiators {
    size_t fields;
    struct carriers surface, line;
};

/* Sources fine enough for wave angles up to t_max. */
igabem_status radiators_create(const igabem_tangent *tangent, double t_max,
                               struct radiators **radiators);
void radiators_free(struct radiators *radiators);

enum { ANGLES_AT_ONCE = 8 };

/* The Kochin function at m <= ANGLES_AT_ONCE wave angles t, and its derivatives: fills h[m][2] and
 * dh[m][fields][2]. */
void radiators_sum(const struct radiators *radiators, double k0, size_t m, const double *t,
                   double (*h)[2], double (*dh)[2]);

#endif
