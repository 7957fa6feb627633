/* Newton's method for the closest point inside a box of parameters. */
#ifndef NURBS_CLOSEST_H
#define NURBS_CLOSEST_H

#include "core/object.h"

struct box2 {
    double low[2], high[2];
};

/* Moves uv inside the box to a local minimum of the distance to the point; returns its square. */
double closest_in_box(const nurbs_surface *surface, const struct box2 *box, const double point[3],
                      double uv[2]);

/* Squared distance of a point to an axis-parallel box (low and high corner). */
static inline double distance_to_bounds(const double point[3], const double bounds[6])
{
    double sum = 0.0;
    for (int c = 0; c < 3; c++) {
        const double below = bounds[c] - point[c], above = point[c] - bounds[3 + c];
        const double d = below > 0.0 ? below : above > 0.0 ? above : 0.0;
        sum += d * d;
    }
    return sum;
}

/* Parts into which a Bezier segment is cut for the search, from its largest first and second
 * differences: more where its direction varies more. */
int closest_parts(double first, double second);

/* Raises the largest first and second difference of the count control points at p, stride apart. */
void closest_differences(size_t count, size_t stride, const double *p, double *first,
                         double *second);

nurbs_status closest_check(const void *spline, size_t n, const double *points, const double *out);

#endif
