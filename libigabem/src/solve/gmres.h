/* Restarted GMRES with right preconditioning (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7, 1986;
 * Saad, Iterative Methods for Sparse Linear Systems, 2003, algorithms 6.9 and 9.5). */
#ifndef GMRES_H
#define GMRES_H

#include <igabem/status.h>

#include <stdbool.h>
#include <stddef.h>

typedef void (*gmres_product)(const void *data, const double *x, double *y);

struct gmres {
    size_t n;
    gmres_product matrix;                /* y = A x */
    gmres_product precondition;          /* y = M^-1 x; NULL: none */
    bool (*cancelled)(const void *data); /* asked after each iteration; NULL: never */
    const void *data;                    /* handed to all */
    size_t restart, most;                /* vectors kept; largest number of iterations */
    double tolerance;                    /* of ||b - A x|| / ||b|| */
};

struct gmres_result {
    size_t iterations; /* products with A and M^-1, without those for residuals */
    double residual;   /* ||b - A x|| / ||b||, from the last x itself */
    bool cancelled;
};

/* Solves A x = right from the x given. IGABEM_ERROR_NUMERIC when the limit is reached, when a whole
 * cycle hardly reduces the residual, when A is singular or anything is not finite; result then
 * tells how far it came. */
igabem_status gmres_solve(const struct gmres *gmres, const double *right, double *x,
                          struct gmres_result *result);

#endif
