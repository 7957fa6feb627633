#include "wigley_forms.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

/* Bernstein coefficients of the cubic c0 + c1 t + c2 t^2 + c3 t^3. */
static void cubic(const double c[4], double b[4])
{
    b[0] = c[0];
    b[1] = c[0] + c[1] / 3.0;
    b[2] = c[0] + 2.0 * c[1] / 3.0 + c[2] / 3.0;
    b[3] = c[0] + c[1] + c[2] + c[3];
}

/* Points x_i, y_i side_j, depth_j of a hull whose sections are similar. */
static void similar_sections(size_t n, const double *xy, const double side[4],
                             const double depth[4], double *points)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < 4; j++) {
            double *p = points + 3 * (4 * i + j);
            p[0] = xy[3 * i];
            p[1] = xy[3 * i + 1] * side[j];
            p[2] = depth[j];
        }
}

static const double knots_cubic[8] = {0, 0, 0, 0, 1, 1, 1, 1};

/* Parabolic waterline and sections y = side(v), z = depth(v), v in [0,1]. */
static nurbs_status parabolic(double beam, const double side[4], const double depth[4],
                              nurbs_surface **surface)
{
    const int degree[2] = {2, 3};
    const size_t size[2] = {3, 4};
    const double knots_u[6] = {0, 0, 0, 1, 1, 1};
    const double xy[9] = {-0.5, 0, 0, 0, beam, 0, 0.5, 0, 0}; /* (B/2) 4 u (1 - u) */
    double points[36];
    similar_sections(3, xy, side, depth, points);
    return nurbs_surface_create(degree, size, knots_u, knots_cubic, points, NULL, surface);
}

nurbs_status rounded_wigley(double beam, double draft, double radius, nurbs_surface **surface)
{
    enum { N = 81 };
    const double e = radius / (beam * beam);
    const double in_depth[4] = {0, -draft, 0, 0}, parabola[4] = {1, 0, -1, 0};
    double xy[3 * N], angle[N], side[4], depth[4], points[12 * N];
    *surface = NULL;
    for (int i = 0; i < N; i++) {
        angle[i] = PI * i / (N - 1);
        double sine = sin(angle[i]), f = sine * sine;
        xy[3 * i] = -0.5 * cos(angle[i]);
        xy[3 * i + 1] = i > 0 && i < N - 1 ? 0.5 * beam * sqrt(f * f + 2.0 * e * f) : 0.0;
        xy[3 * i + 2] = 0.0;
    }
    nurbs_curve *waterline;
    nurbs_status status = nurbs_curve_interpolate(3, N, xy, angle, &waterline);
    if (status)
        return status;
    cubic(parabola, side);
    cubic(in_depth, depth);
    similar_sections(N, nurbs_curve_points(waterline), side, depth, points);
    const int degree[2] = {3, 3};
    const size_t size[2] = {N, 4};
    status = nurbs_surface_create(degree, size, nurbs_curve_knots(waterline), knots_cubic, points,
                                  NULL, surface);
    nurbs_curve_free(waterline);
    return status;
}

nurbs_status flared_wigley(double beam, double draft, double c, nurbs_surface **surface)
{
    /* (1 - v^2)(1 - c v), zeta = -v */
    const double sections[4] = {1, -c, -1, c}, in_depth[4] = {0, -draft, 0, 0};
    double side[4], depth[4];
    cubic(sections, side);
    cubic(in_depth, depth);
    return parabolic(beam, side, depth, surface);
}

nurbs_status trimmed_wigley(double beam, double draft, double bow_up, double sinkage,
                            nurbs_surface **surface)
{
    /* zeta = a - (1 + a) v from a above the water to the keel; 1 - zeta^2 in powers of v. */
    const double a = 0.3, cosine = cos(bow_up), sine = sin(bow_up);
    const double sections[4] = {1 - a * a, 2 * a * (1 + a), -(1 + a) * (1 + a), 0};
    const double in_depth[4] = {a * draft, -(1 + a) * draft, 0, 0};
    const double turn[9] = {cosine, 0, -sine, 0, 1, 0, sine, 0, cosine},
                 shift[3] = {0, 0, -sinkage};
    double side[4], depth[4];
    nurbs_surface *whole, *turned;
    *surface = NULL;
    cubic(sections, side);
    cubic(in_depth, depth);
    nurbs_status status = parabolic(beam, side, depth, &whole);
    if (status)
        return status;
    status = nurbs_surface_transform(whole, turn, shift, &turned);
    nurbs_surface_free(whole);
    if (status)
        return status;
    status = nurbs_surface_wetted(turned, 0.0, 1e-7, surface);
    nurbs_surface_free(turned);
    return status;
}
