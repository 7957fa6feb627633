/* Basis functions of an object's axis, with its stored reciprocals. */
#ifndef NURBS_AXIS_BASIS_H
#define NURBS_AXIS_BASIS_H

#include "core/basis_kernel.h"
#include "core/object.h"

NURBS_INLINE void axis_basis(const struct axis *axis, int degree, size_t span, double u, int order,
                             double *values)
{
    basis_evaluate(degree, axis->knots + span, axis->inverse + span, axis_stride(axis), u, order,
                   values);
}

#endif
