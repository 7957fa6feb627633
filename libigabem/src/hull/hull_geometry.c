#include "core/error.h"
#include "hull/hull.h"

#include <math.h>

igabem_status hull_nurbs_fail(nurbs_status status, const char *what)
{
    /* It need not be libnurbs itself that found no memory. */
    if (status == NURBS_ERROR_MEMORY)
        return igabem_fail(IGABEM_ERROR_MEMORY, "%s: no memory", what);
    return igabem_fail(IGABEM_ERROR_GEOMETRY, "%s: %s", what, nurbs_last_error());
}

bool hull_same_side(const struct hull_patch *a, const struct hull_patch *b)
{
    return (a->side[0] + a->side[1] < 0) == (b->side[0] + b->side[1] < 0);
}

void hull_edge_parameters(const struct hull_patch *patch, int edge, double s, double uv[2])
{
    int fixed = edge == HULL_U0 || edge == HULL_U1 ? 0 : 1;
    int end = edge == HULL_U1 || edge == HULL_V1 ? 1 : 0;
    const double *along = patch->domain[1 - fixed];
    uv[fixed] = patch->domain[fixed][end];
    uv[1 - fixed] = s >= 1.0 ? along[1] : along[0] + s * (along[1] - along[0]);
}

bool hull_normal(const struct hull_patch *patch, const double triples[9], double normal[3],
                 double *area)
{
    const double *su = triples + 3, *sv = triples + 6;
    double c[3] = {su[1] * sv[2] - su[2] * sv[1], su[2] * sv[0] - su[0] * sv[2],
                   su[0] * sv[1] - su[1] * sv[0]};
    *area = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    double scale = *area > 0 ? patch->sign / *area : 0.0;
    for (int k = 0; k < 3; k++)
        normal[k] = c[k] * scale;
    return *area > 0;
}

void hull_waterline_normal(const struct hull_patch *patch, int edge, const double triples[9],
                           double nu[2], double *dl)
{
    int along = edge == HULL_U0 || edge == HULL_U1 ? 1 : 0;
    const double *tangent = triples + 3 + 3 * along;
    double length = hypot(tangent[0], tangent[1]);
    *dl = length * (patch->domain[along][1] - patch->domain[along][0]);
    nu[0] = nu[1] = 0.0;
    if (!(length > 0))
        return;
    double normal[3], area;
    hull_normal(patch, triples, normal, &area);
    double outward = tangent[1] * normal[0] - tangent[0] * normal[1] < 0 ? -1.0 : 1.0;
    nu[0] = outward * tangent[1] / length;
    nu[1] = -outward * tangent[0] / length;
}
