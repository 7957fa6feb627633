/* Prints the solver part of docs/validation.md: what the solver gives beside exact solutions, other
 * computations and published figures.   usage: igabem_validation HULL.json [SECTION...] >
 * validation.md */
#include "igabem_validation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static _Noreturn void stop(const char *what, const char *why)
{
    fprintf(stderr, "igabem_validation: %s: %s\n", what, why);
    exit(EXIT_FAILURE);
}

static nurbs_surface *take(nurbs_status status, nurbs_surface *result, nurbs_surface *from,
                           const char *what)
{
    nurbs_surface_free(from);
    if (status)
        stop(what, nurbs_last_error());
    return result;
}

/* Even division of every span, at least cubic before that: full smoothness. */
static nurbs_surface *refined(nurbs_surface *surface, int along, int around)
{
    const int parts[2] = {along, around};
    nurbs_surface *result = NULL;
    for (int d = 0; d < 2; d++) {
        int by = 3 - nurbs_surface_degree(surface, d);
        if (by <= 0)
            continue;
        nurbs_status status = nurbs_surface_elevate(surface, d, by, &result);
        surface = take(status, result, surface, "degree elevation");
    }
    for (int d = 0; d < 2; d++) {
        double breaks[16], knots[1024];
        size_t n = 0;
        size_t count =
            nurbs_knots_distinct(nurbs_surface_degree(surface, d), nurbs_surface_size(surface, d),
                                 nurbs_surface_knots(surface, d), breaks, NULL);
        for (size_t s = 0; s + 1 < count; s++)
            for (int k = 1; k < parts[d]; k++)
                knots[n++] = breaks[s] + (breaks[s + 1] - breaks[s]) * k / parts[d];
        if (n == 0)
            continue;
        nurbs_status status = nurbs_surface_insert(surface, d, n, knots, &result);
        surface = take(status, result, surface, "knot insertion");
    }
    return surface;
}

static igabem_hull *hull_of(nurbs_surface *surface)
{
    igabem_hull *hull;
    const nurbs_surface *list[1] = {surface};
    igabem_status status = igabem_hull_create(list, 1, IGABEM_SYMMETRIC, &hull);
    nurbs_surface_free(surface);
    if (status)
        stop("hull", igabem_last_error());
    return hull;
}

igabem_hull *wigley(double beam, double draft, int along, int around)
{
    nurbs_surface *surface = NULL;
    nurbs_status status = nurbs_make_wigley(1.0, beam, draft, &surface);
    return hull_of(refined(take(status, surface, NULL, "Wigley hull"), along, around));
}

nurbs_surface *ellipsoid_surface(double length, double beam, double height, double depth, int along,
                                 int around)
{
    nurbs_surface *surface = NULL;
    nurbs_status status = nurbs_make_ellipsoid(length, beam, height, depth, &surface);
    return refined(take(status, surface, NULL, "ellipsoid"), along, around);
}

igabem_hull *ellipsoid(double length, double beam, double height, double depth, int along,
                       int around)
{
    return hull_of(ellipsoid_surface(length, beam, height, depth, along, around));
}

/* Largest z of the control net. */
static double highest(const nurbs_surface *surface)
{
    size_t n = nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
    const double *points = nurbs_surface_points(surface);
    double z = -INFINITY;
    for (size_t k = 0; k < n; k++)
        z = fmax(z, points[3 * k + 2]);
    return z;
}

igabem_hull *hull_file(const char *file, double tolerance)
{
    nurbs_patches *patches;
    nurbs_surface *wetted = NULL, *light = NULL;
    if (nurbs_patches_read(file, &patches))
        stop(file, nurbs_last_error());
    const nurbs_surface *whole = nurbs_patches_get(patches, 0);
    double length = nurbs_patches_length(patches), bound;
    nurbs_status status;
    if (highest(whole) > 0.0) {
        status = nurbs_surface_wetted(whole, 0.0, 1e-5 * length, &wetted);
        wetted = take(status, wetted, NULL, file);
        status = nurbs_surface_simplify(wetted, tolerance * length,
                                        NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_KEEP_KINKS |
                                            NURBS_SIMPLIFY_THRIFTY,
                                        &light, &bound);
    } else {
        status = nurbs_surface_copy(whole, &light);
    }
    igabem_hull *hull = hull_of(take(status, light, wetted, file));
    nurbs_patches_free(patches);
    if (igabem_hull_set_length(hull, length))
        stop(file, igabem_last_error());
    return hull;
}

igabem_options at_froude(double froude)
{
    igabem_options options;
    igabem_options_init(&options);
    options.refine = 1;
    options.froude = froude;
    return options;
}

void solve_all(const igabem_hull *hull, size_t n, const igabem_options *options,
               igabem_forces *forces)
{
    igabem_solution **solutions = calloc(n, sizeof *solutions);
    if (!solutions)
        stop("solve", "out of memory");
    if (igabem_solve_many(hull, n, options, solutions))
        stop("solve", igabem_last_error());
    for (size_t i = 0; i < n; i++) {
        if (igabem_forces_compute(solutions[i], &forces[i]))
            stop("forces", igabem_last_error());
        igabem_solution_free(solutions[i]);
    }
    free(solutions);
    fflush(stdout);
}

static int wanted(int argc, char **argv, const char *section)
{
    for (int k = 2; k < argc; k++)
        if (strcmp(argv[k], section) == 0)
            return 1;
    return argc <= 2;
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(
            stderr,
            "usage: igabem_validation HULL.json [double-body|spheroids|wigley|forms|tank|patches|"
            "5415|hulls|error]\n");
        return 2;
    }
    printf(
        "# Validation of libigabem\n\n"
        "Written by `tests/validate` (tests/bench/igabem_validation.c); every figure below was "
        "computed by\nlibigabem %s unless its column names another source. C_w = R/(rho U^2 S/2) "
        "unless stated; errors are relative.\nKochin: from the far-field waves; pressure: from "
        "the pressure on the hull, quadratic and run-up terms included.\n\n",
        igabem_version());
    if (wanted(argc, argv, "double-body"))
        double_body_section();
    if (wanted(argc, argv, "spheroids"))
        spheroid_section();
    if (wanted(argc, argv, "wigley"))
        wigley_section();
    if (wanted(argc, argv, "forms"))
        forms_section();
    if (wanted(argc, argv, "tank"))
        tank_section();
    if (wanted(argc, argv, "patches"))
        patches_section();
    if (wanted(argc, argv, "5415"))
        dtmb5415_section(argv[1]);
    if (wanted(argc, argv, "hulls"))
        hulls_section();
    if (wanted(argc, argv, "error"))
        error_section(argv[1]);
    return ferror(stdout) || fflush(stdout) ? EXIT_FAILURE : EXIT_SUCCESS;
}
