/* B-spline basis functions and derivatives by the Cox-de Boor recursion, inlined so that a constant
 * degree unrolls.
 *
 * Degree q on span s follows from degree q - 1 by
 *     N_{s-q+r,q} = a_{r-1} N_{s-q+r,q-1} + (1 - a_r) N_{s-q+1+r,q-1},
 *     a_r = (u - t_{s-q+1+r}) / (t_{s+r+1} - t_{s-q+1+r}),
 * and its derivative by q (N_{r-1} / h_{r-1} - N_r / h_r), h_r the same denominator (The NURBS
 * Book, eqs. 2.5 and 2.7). With the ratio a and 1 - a, all values are non-negative and those at a
 * knot of full multiplicity are exactly 0 or 1. */
#ifndef NURBS_BASIS_KERNEL_H
#define NURBS_BASIS_KERNEL_H

#include "multiversion.h"

#include <nurbs/basis.h>

/* Raises values of degree q - 1 (q of them) to degree q (q + 1) in place. */
NURBS_INLINE void basis_raise(int q, const double *t, double u, double *values)
{
    double saved = 0.0;
    for (int r = 0; r < q; r++) {
        const double left = t[r - q + 1];
        const double a = (u - left) / (t[r + 1] - left);
        const double value = values[r];
        values[r] = saved + (1.0 - a) * value;
        saved = a * value;
    }
    values[q] = saved;
}

/* Derivatives of the degree q functions from the degree q - 1 ones, in place. */
NURBS_INLINE void basis_differentiate(int q, const double *t, double *values)
{
    double saved = 0.0;
    for (int r = 0; r < q; r++) {
        const double term = q * values[r] / (t[r + 1] - t[r - q + 1]);
        values[r] = saved - term;
        saved = term;
    }
    values[q] = saved;
}

/* Fills values[order + 1][degree + 1]; rows above the degree are zero. */
NURBS_INLINE void basis_evaluate(int degree, const double *knots, size_t span, double u, int order,
                                 double *values)
{
    const double *t = knots + span;
    const int width = degree + 1;
    double current[NURBS_MAX_DEGREE + 1];
    current[0] = 1.0;
    for (int q = 0;; q++) {
        const int derivative = degree - q; /* the one that starts from degree q */
        if (derivative <= order) {
            double *row = values + derivative * width;
            for (int r = 0; r <= q; r++)
                row[r] = current[r];
            for (int k = q + 1; k <= degree; k++)
                basis_differentiate(k, t, row);
        }
        if (q == degree)
            break;
        basis_raise(q + 1, t, u, current);
    }
    for (int k = degree + 1; k <= order; k++)
        for (int r = 0; r < width; r++)
            values[k * width + r] = 0.0;
}

#endif
