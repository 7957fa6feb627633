#ifndef NURBS_SURFACE_DERIVATIVES_H
#define NURBS_SURFACE_DERIVATIVES_H

#include "core/object.h"

#include <nurbs/basis.h>

/* Highest order of derivatives of surfaces. */
enum { SURFACE_MAX_ORDER = 2 * NURBS_MAX_DEGREE };

/* Derivatives up to any order at one place: fills out[triples][3]. */
void surface_derivatives(const nurbs_surface *s, int order, const size_t span[2],
                         const double uv[2], double *out);

#endif
