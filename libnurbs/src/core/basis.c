#include "core/basis_kernel.h"

enum { STRIDE = NURBS_MAX_DEGREE };

NURBS_INLINE void evaluate(int degree, const double *t, double u, int order, double *values)
{
    double inverse[NURBS_MAX_DEGREE * STRIDE];
    for (int q = 1; q <= degree; q++)
        for (int r = 0; r < q; r++)
            inverse[(q - 1) * STRIDE + r] = reciprocal(t[r + 1] - t[r - q + 1]);
    basis_evaluate(degree, t, inverse, STRIDE, u, order, values);
}

void nurbs_basis(int degree, const double *knots, size_t span, double u, double *values)
{
    nurbs_basis_derivatives(degree, knots, span, u, 0, values);
}

void nurbs_basis_derivatives(int degree, const double *knots, size_t span, double u, int order,
                             double *values)
{
    if (!knots || !values)
        return;
    if (degree == 3)
        evaluate(3, knots + span, u, order, values);
    else
        evaluate(degree, knots + span, u, order, values);
}
