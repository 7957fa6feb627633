/* What the density becomes on half its knots: the change tells what twice as many would do. */
#ifndef COARSENED_H
#define COARSENED_H

#include "solve/linear.h"
#include "solve/solution.h"

/* Fills sigma[n], coefficients in the density's own space: of all densities on every second knot
 * that of least squared residual in the rows of the matrix, which stays as it is. Creates it in
 * *sigma; NULL where there is no such one. O(n^2 (sqrt(n) + n/16)). */
igabem_status coarsened_density(const struct matrix *matrix, const igabem_solution *solution,
                                double **sigma);

#endif
