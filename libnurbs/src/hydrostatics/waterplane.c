#include "core/error.h"
#include "hydrostatics/hydro_parts.h"

#include <nurbs/basis.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>

int edge_at_level(const nurbs_surface *surface, int e, double level)
{
    size_t nu = nurbs_surface_size(surface, 0), nv = nurbs_surface_size(surface, 1);
    const double *points = nurbs_surface_points(surface);
    size_t first = e == 1   ? (nu - 1) * nv
                   : e == 3 ? nv - 1
                            : 0,
           step = e < 2 ? 1 : nv, count = e < 2 ? nv : nu;
    double reach = 0, length = 0, slack = 0;
    for (size_t k = 0; k < nu * nv; k++)
        reach = fmax(reach, fabs(points[3 * k + 2] - level));
    slack = 1e-9 * reach;
    for (size_t k = 0; k < count; k++) {
        const double *p = points + 3 * (first + k * step), *q = points + 3 * first;
        if (fabs(p[2] - level) > slack)
            return 0;
        length = fmax(length, fabs(p[0] - q[0]) + fabs(p[1] - q[1]));
    }
    return length > slack;
}

static void add_curve_point(const double *p, double weight, waterplane *edge)
{
    double x = p[0], y = p[1], dx = weight * p[3];
    edge->area += 2 * y * dx;
    edge->moment_x += 2 * x * y * dx;
    edge->inertia_xx += 2 * y * y * y / 3 * dx;
    edge->inertia_yy += 2 * x * x * y * dx;
}

/* Golden-section search between a and b for the largest y of the curve. */
static double largest_y(const nurbs_curve *curve, double a, double b)
{
    const double ratio = 0.61803398874989484820;
    double p[3], best = 0;
    for (int k = 0; k < 60; k++) {
        double c = b - ratio * (b - a), d = a + ratio * (b - a), yc, yd;
        nurbs_curve_eval(curve, 0, 1, &c, p);
        yc = p[1];
        nurbs_curve_eval(curve, 0, 1, &d, p);
        yd = p[1];
        best = fmax(best, fmax(yc, yd));
        if (yc > yd)
            b = d;
        else
            a = c;
    }
    return best;
}

static void add_extremes(const nurbs_curve *curve, waterplane *plane)
{
    enum { SAMPLES = 400 };
    const double *knots = nurbs_curve_knots(curve);
    double first = knots[0], step = (knots[nurbs_curve_size(curve)] - first) / SAMPLES, p[3],
           best = -1, at = first;
    for (int k = 0; k <= SAMPLES; k++) {
        double u = k == SAMPLES ? knots[nurbs_curve_size(curve)] : first + k * step;
        nurbs_curve_eval(curve, 0, 1, &u, p);
        plane->aft = fmin(plane->aft, p[0]);
        plane->fore = fmax(plane->fore, p[0]);
        if (p[1] > best) {
            best = p[1];
            at = u;
        }
    }
    double a = fmax(first, at - step), b = fmin(knots[nurbs_curve_size(curve)], at + step);
    plane->beam = fmax(plane->beam, 2 * fmax(best, largest_y(curve, a, b)));
}

/* Sixteen Gauss points a span: exact for cubics, and to rounding for rational arcs. */
static nurbs_status add_edge(const nurbs_curve *curve, int sign, waterplane *plane)
{
    enum { ORDER = 16 };
    double nodes[ORDER], weights[ORDER], p[6];
    nurbs_status status = nurbs_gauss_legendre(ORDER, nodes, weights);
    const double *knots = nurbs_curve_knots(curve);
    waterplane edge = {0};
    for (size_t k = (size_t)nurbs_curve_degree(curve);
         k < nurbs_curve_size(curve) && status == NURBS_OK; k++) {
        double length = knots[k + 1] - knots[k];
        for (int g = 0; g < ORDER && length > 0 && status == NURBS_OK; g++) {
            double u = knots[k] + length * nodes[g];
            status = nurbs_curve_eval(curve, 1, 1, &u, p);
            add_curve_point(p, length * weights[g], &edge);
        }
    }
    plane->area += sign * edge.area;
    plane->moment_x += sign * edge.moment_x;
    plane->inertia_xx += sign * edge.inertia_xx;
    plane->inertia_yy += sign * edge.inertia_yy;
    add_extremes(curve, plane);
    plane->edges++;
    return status;
}

nurbs_status waterplane_integrate(size_t n, const nurbs_surface *const *patches, const int *sign,
                                  double level, waterplane *plane)
{
    /* Direction of the edges' parameters along the boundary, the surface to the left. */
    static const int along[4] = {-1, 1, 1, -1};
    *plane = (waterplane){.aft = INFINITY, .fore = -INFINITY};
    for (size_t k = 0; k < n; k++)
        for (int e = 0; e < 4; e++) {
            if (!edge_at_level(patches[k], e, level))
                continue;
            int direction = e / 2;
            const double *knots = nurbs_surface_knots(patches[k], direction);
            double value = e % 2 ? knots[nurbs_surface_size(patches[k], direction)] : knots[0];
            nurbs_curve *curve = NULL;
            nurbs_status status = nurbs_surface_iso_curve(patches[k], direction, value, &curve);
            if (status == NURBS_OK)
                status = add_edge(curve, sign[k] * along[e], plane);
            nurbs_curve_free(curve);
            if (status != NURBS_OK)
                return status;
        }
    return NURBS_OK;
}
