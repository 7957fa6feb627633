/* One-dimensional least squares with both end control points at the first and last datum. */
#ifndef NURBS_LEAST_SQUARES_H
#define NURBS_LEAST_SQUARES_H

#include "core/banded.h"

typedef struct fit_matrix {
    int degree;
    size_t size, samples;
    size_t *first;  /* [samples] first control point that counts */
    double *values; /* [samples][degree + 1] basis functions */
    banded normal;  /* factors of the normal matrix of the inner control points */
} fit_matrix;

nurbs_status check_fit_request(int degree, size_t size, const double *knots, size_t n,
                               const double *u);
nurbs_status fit_matrix_create(int degree, size_t size, const double *knots, size_t n,
                               const double *u, fit_matrix *fit);
void fit_matrix_free(fit_matrix *fit);

/* data[samples][m] -> control[size][m]. */
void fit_matrix_solve(const fit_matrix *fit, size_t m, const double *data, double *control);

/* Largest distance of the points of datum k, m / 3 of them, from the splines. */
double fit_matrix_deviation(const fit_matrix *fit, size_t m, size_t k, const double *data,
                            const double *control);

#endif
