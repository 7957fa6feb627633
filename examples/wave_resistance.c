/* Wave resistance of a hull from a NURBS file, and the wave along its side.
 *   example_wave_resistance HULL.json FROUDE     (a wetted half hull, for example
 * hulls/wigley.json) */
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

#include <stdio.h>
#include <stdlib.h>

static int failed(const char *message)
{
    fprintf(stderr, "%s\n", message);
    return EXIT_FAILURE;
}

int main(int argc, char **argv)
{
    if (argc != 3)
        return failed("usage: example_wave_resistance HULL.json FROUDE");

    nurbs_patches *file;
    if (nurbs_patches_read(argv[1], &file) != NURBS_OK)
        return failed(nurbs_last_error());

    const nurbs_surface *patch = nurbs_patches_get(file, 0);
    igabem_hull *hull;
    if (igabem_hull_create(&patch, 1, IGABEM_SYMMETRIC, &hull) != IGABEM_OK)
        return failed(igabem_last_error());

    igabem_options options;
    igabem_options_init(&options);
    options.froude = strtod(argv[2], NULL);
    options.elements_u = 24; /* source density: its own uniform knots */
    options.elements_v = 6;

    igabem_solution *flow;
    igabem_forces forces;
    if (igabem_solve(hull, &options, &flow) != IGABEM_OK ||
        igabem_forces_compute(flow, &forces) != IGABEM_OK)
        return failed(igabem_last_error());
    printf("C_w %.4e by the waves, %.4e by the pressure; R_w %.4g N; %zu unknowns\n", forces.cw,
           forces.cw_pressure, forces.rw, forces.dofs);

    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    double x[9], y[9], zeta[9];
    for (int i = 0; i < 9; i++) {
        x[i] = info.hydrostatics.x_fore - 0.25 * i * info.length;
        y[i] = 0.1 * info.length;
    }
    if (igabem_wave_elevation(flow, 9, x, y, zeta) != IGABEM_OK)
        return failed(igabem_last_error());
    for (int i = 0; i < 9; i++)
        printf("x %8.4f  zeta %9.6f m\n", x[i], zeta[i]);

    igabem_solution_free(flow);
    igabem_hull_free(hull);
    nurbs_patches_free(file);
    return EXIT_SUCCESS;
}
