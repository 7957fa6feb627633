/* A quadratic through the points nearest to a centre, as model-based derivative-free searches use:
 * of all that interpolate, the one whose second derivatives are least (Powell, Math. Program. 100
 * (2004) 183). */
#ifndef BAYESOPT_QUADRATIC_H
#define BAYESOPT_QUADRATIC_H

#include <bayesopt/status.h>

#include <stdbool.h>
#include <stddef.h>

/* value(x) = constant + g's + s'Hs/2, s = x - centre. */
struct quadratic {
    size_t d;
    double *centre, *gradient, *hessian; /* [d], [d], [d x d] */
    double constant;
};

/* From n points x [n x d] with values y, n > d. At most (d + 1)(d + 2)/2 points and at most 300 of
 * them are used, the nearest first by the largest coordinate difference. *ok false: the points do
 * not determine a gradient. Free with quadratic_free() in any case.
 * @return BAYESOPT_ERROR_MEMORY */
bayesopt_status quadratic_fit(struct quadratic *q, size_t d, size_t n, const double *x,
                              const double *y, const double *centre, bool *ok);
/* *ok: whether the quadratic through the nearest points, as many as it has coefficients, foretells
 * the next d + 1, to 1 % of how those differ; *reach: how far away they are, by the largest
 * coordinate difference. False also when there are too few.
 * @return BAYESOPT_ERROR_MEMORY */
bayesopt_status quadratic_foretells(size_t d, size_t n, const double *x, const double *y,
                                    const double *centre, double *reach, bool *ok);
void quadratic_free(struct quadratic *q);
/* Value at x; gradient [d] filled unless NULL. */
double quadratic_value(const struct quadratic *q, const double *x, double *gradient);

#endif
