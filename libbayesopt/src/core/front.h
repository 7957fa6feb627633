/* What a point promises when several objectives are minimised. */
#ifndef BAYESOPT_FRONT_H
#define BAYESOPT_FRONT_H

#include <stdbool.h>
#include <stddef.h>

enum { FRONT_MOST_OBJECTIVES = 3 };

/* The part of space that a set of points leaves undominated, below a reference point, as disjoint
 * boxes between values of the set. */
struct front {
    size_t m;                               /* objectives, 2 or 3 */
    size_t n_values[FRONT_MOST_OBJECTIVES]; /* of each objective, increasing */
    double *values[FRONT_MOST_OBJECTIVES];  /* the first is -INFINITY, the last the reference's */
    size_t n_boxes;
    unsigned (*boxes)[FRONT_MOST_OBJECTIVES][2]; /* indices of their lower and upper values */
    double *scratch;                             /* three numbers per value, one per box */
};

/* From n points [n x m], of which the dominated ones and those not below the reference [m] are left
 * aside. False: out of memory. */
bool front_create(struct front *front, size_t m, size_t n, const double *points,
                  const double *reference);
void front_free(struct front *front);

/* Logarithm of the expected growth of the dominated volume by a point of independent normal values
 * (Emmerich, Deutz and Klinkenberg, CEC 2011), and its derivatives in mean [m] and sd [m]; NULL
 * allowed for both. */
double front_log_improvement(const struct front *front, const double *mean, const double *sd,
                             double *by_mean, double *by_sd);

/* Whether row i of points [n x m] is dominated, or equals an earlier one. */
bool front_dominated(size_t m, size_t n, const double *points, size_t i);

#endif
