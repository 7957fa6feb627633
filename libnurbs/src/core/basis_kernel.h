/* B-spline basis functions and derivatives by the Cox-de Boor recursion, inlined so that a constant
 * degree unrolls.
 *
 * Degree q on span s follows from degree q - 1 by
 *     N_{s-q+r,q} = a_{r-1} N_{s-q+r,q-1} + (1 - a_r) N_{s-q+1+r,q-1},
 *     a_r = (u - t_{s-q+1+r}) / h_r,   h_r = t_{s+r+1} - t_{s-q+1+r},
 * and its derivative by q (N_{r-1} / h_{r-1} - N_r / h_r) (The NURBS Book, eqs. 2.5 and 2.7).
 *
 * The reciprocals do not depend on u: `inverse` holds that of h_r of degree q at (q - 1) * stride +
 * r, rounded so that its product with h_r is not below 1. With a_r cut at 1 all values are
 * non-negative, and exactly 0 or 1 at a knot of full multiplicity. */
#ifndef NURBS_BASIS_KERNEL_H
#define NURBS_BASIS_KERNEL_H

#include "core/multiversion.h"

#include <nurbs/basis.h>

#include <float.h>

/* 1 / h, or up to three units in the last place more. */
NURBS_INLINE double reciprocal(double h)
{
    const double inverse = 1.0 / h;
    return h * inverse < 1.0 ? inverse * (1.0 + DBL_EPSILON) : inverse;
}

/* Raises values of degree q - 1 (q of them) to degree q (q + 1) in place. */
NURBS_INLINE void basis_raise(int q, const double *t, const double *inverse, double u,
                              double *values)
{
    double saved = 0.0;
    NURBS_UNROLL
    for (int r = 0; r < q; r++) {
        const double ratio = (u - t[r - q + 1]) * inverse[r];
        const double rising = ratio < 1.0 ? ratio : 1.0;
        const double value = values[r];
        values[r] = saved + (1.0 - rising) * value;
        saved = rising * value;
    }
    values[q] = saved;
}

/* Derivatives of the degree q functions from the degree q - 1 ones, in place. */
NURBS_INLINE void basis_differentiate(int q, const double *inverse, double *values)
{
    double saved = 0.0;
    NURBS_UNROLL
    for (int r = 0; r < q; r++) {
        const double term = q * values[r] * inverse[r];
        values[r] = saved - term;
        saved = term;
    }
    values[q] = saved;
}

/* t = knots + span. */
/* Fills values[order + 1][degree + 1]; rows above the degree are zero. */
NURBS_INLINE void basis_evaluate(int degree, const double *t, const double *inverse, size_t stride,
                                 double u, int order, double *values)
{
    const int width = degree + 1;
    const int kept = order < degree ? order : degree;
    double current[NURBS_MAX_DEGREE + 1];
    current[0] = 1.0;
    NURBS_UNROLL
    for (int q = 0; q <= degree; q++) {
        if (q > 0)
            basis_raise(q, t, inverse + (size_t)(q - 1) * stride, u, current);
        if (degree - q <= kept) /* where that derivative starts from */
            for (int r = 0; r <= q; r++)
                values[(degree - q) * width + r] = current[r];
    }
    NURBS_UNROLL
    for (int k = 1; k <= kept; k++) {
        NURBS_UNROLL
        for (int q = degree - k + 1; q <= degree; q++)
            basis_differentiate(q, inverse + (size_t)(q - 1) * stride, values + k * width);
    }
    for (int k = degree + 1; k <= order; k++)
        for (int r = 0; r < width; r++)
            values[k * width + r] = 0.0;
}

#endif
