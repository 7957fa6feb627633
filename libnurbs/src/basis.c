#include "basis_kernel.h"

void nurbs_basis(int degree, const double *knots, size_t span, double u, double *values)
{
    nurbs_basis_derivatives(degree, knots, span, u, 0, values);
}

void nurbs_basis_derivatives(int degree, const double *knots, size_t span, double u, int order,
                             double *values)
{
    if (degree == 3)
        basis_evaluate(3, knots, span, u, order, values);
    else
        basis_evaluate(degree, knots, span, u, order, values);
}
