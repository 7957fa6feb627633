/* Gradient of the wave resistance along moves of a hull's control points, all for the price of two
 * solutions, and beside it differences that take two solutions each. Fails when they disagree. */
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { FIELDS = 6, NU = 7, NV = 6, POINTS = NU * NV };

/* The Wigley hull, 1 m long, with NU x NV control points to move. */
static nurbs_surface *make_hull(void)
{
    static const double u[] = {0.2, 0.4, 0.6, 0.8}, v[] = {0.25, 0.5, 0.75};
    nurbs_surface *plain = NULL, *along = NULL, *both = NULL;
    if (nurbs_make_wigley(1.0, 0.1, 0.0625, &plain) == NURBS_OK &&
        nurbs_surface_insert(plain, 0, 4, u, &along) == NURBS_OK)
        nurbs_surface_insert(along, 1, 3, v, &both);
    nurbs_surface_free(plain);
    nurbs_surface_free(along);
    return both;
}

/* Field f: stations fuller or finer, at the water or below, in proportion to the breadth, so that
 * stem and keel stay. */
static void make_move(int f, const double point[POINTS][3], double move[POINTS][3])
{
    for (int k = 0; k < POINTS; k++) {
        const double *p = point[k];
        move[k][0] = move[k][2] = 0.0;
        move[k][1] = p[1] * cos((f % 3) * 3.14159265 * p[0]) * (f < 3 ? 1.0 : cos(50.0 * p[2]));
    }
}

/* C_w of the hull moved by step, with the options of the hull itself; NAN when that fails. */
static double moved_cw(const nurbs_surface *own, const igabem_options *options,
                       const double move[POINTS][3], double step)
{
    const double *from = nurbs_surface_points(own);
    double point[3 * POINTS];
    nurbs_surface *moved = NULL;
    igabem_hull *hull = NULL;
    igabem_solution *flow = NULL;
    igabem_forces forces = {.cw = NAN};
    for (int k = 0; k < 3 * POINTS; k++)
        point[k] = from[k] + step * move[k / 3][k % 3];
    const int degree[2] = {nurbs_surface_degree(own, 0), nurbs_surface_degree(own, 1)};
    if (nurbs_surface_create(degree, (const size_t[]){NU, NV}, nurbs_surface_knots(own, 0),
                             nurbs_surface_knots(own, 1), point, NULL, &moved) == NURBS_OK &&
        igabem_hull_create((const nurbs_surface *const *)&moved, 1, IGABEM_SYMMETRIC, &hull) ==
            IGABEM_OK &&
        igabem_solve(hull, options, &flow) == IGABEM_OK)
        igabem_forces_compute(flow, &forces);
    igabem_solution_free(flow);
    igabem_hull_free(hull);
    nurbs_surface_free(moved);
    return forces.cw;
}

int main(void)
{
    static double move[FIELDS][POINTS][3];
    nurbs_surface *surface = make_hull();
    igabem_hull *hull = NULL;
    igabem_solution *flow = NULL;
    igabem_tangent *tangent = NULL;
    igabem_options options;
    double gradient[FIELDS], step = 0.01;
    igabem_options_init(&options);
    options.froude = 0.3;
    options.formulation = IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN;
    options.elements_u = 12;
    options.elements_v = 4;
    options.keep_system = 1; /* for the tangents */
    for (int f = 0; f < FIELDS && surface; f++)
        make_move(f, (const double(*)[3])nurbs_surface_points(surface), move[f]);
    if (!surface ||
        igabem_hull_create((const nurbs_surface *const *)&surface, 1, IGABEM_SYMMETRIC, &hull) ||
        igabem_options_freeze(hull, &options) || igabem_solve(hull, &options, &flow) ||
        igabem_tangent_create(hull, flow, FIELDS, move[0][0], &tangent) ||
        igabem_tangent_cw(tangent, gradient)) {
        fprintf(stderr, "shape_gradient: %s\n", surface ? igabem_last_error() : nurbs_last_error());
        return EXIT_FAILURE;
    }
    int failed = 0;
    for (int f = 0; f < FIELDS; f++) {
        const double(*field)[3] = (const double(*)[3])move[f];
        double ahead = moved_cw(surface, &options, field, step);
        double difference = (ahead - moved_cw(surface, &options, field, -step)) / (2.0 * step);
        printf("field %d: dC_w %+.4e, by differences %+.4e\n", f, gradient[f], difference);
        failed |= !(fabs(difference - gradient[f]) < 1e-3 * fabs(gradient[0]));
    }
    igabem_tangent_free(tangent);
    igabem_solution_free(flow);
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
