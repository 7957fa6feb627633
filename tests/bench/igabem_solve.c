/* Time and growth of a solve: the DTMB 5415 wetted and simplified, Fr 0.35, default formulation.
 * Usage: igabem_bench_solve [threads] */
#include <igabem/igabem.h>
#include <math.h>
#include <nurbs/nurbs.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const double length = 5.72;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static igabem_hull *read_hull(const char *path)
{
    nurbs_patches *file = NULL;
    nurbs_surface *wetted = NULL, *light = NULL;
    igabem_hull *hull = NULL;
    double bound;
    if (nurbs_patches_read(path, &file) == NURBS_OK &&
        nurbs_surface_wetted(nurbs_patches_get(file, 0), 0.0, 1e-5 * length, &wetted) == NURBS_OK &&
        nurbs_surface_simplify(wetted, 1e-4 * length,
                               NURBS_KEEP_EDGES | NURBS_KEEP_KINKS | NURBS_THRIFTY, &light,
                               &bound) == NURBS_OK &&
        igabem_hull_create((const nurbs_surface *const *)&light, 1, IGABEM_SYMMETRIC, &hull) ==
            IGABEM_OK)
        igabem_hull_set_length(hull, length);
    else
        fprintf(stderr, "%s: %s %s\n", path, nurbs_last_error(), igabem_last_error());
    nurbs_surface_free(light);
    nurbs_surface_free(wetted);
    nurbs_patches_free(file);
    return hull;
}

int main(int argc, char **argv)
{
    static const int meshes[][2] = {{16, 6}, {24, 8}, {32, 10}, {40, 12}, {56, 16}, {80, 22}};
    igabem_hull *hull = read_hull(EXAMPLES_DIR "/hulls/dtmb5415.json");
    if (!hull)
        return EXIT_FAILURE;
    printf("unknowns  seconds  with forces  exponent  C_w\n");
    double previous_time = 0.0, previous_dofs = 0.0;
    for (size_t k = 0; k < sizeof meshes / sizeof meshes[0]; k++) {
        igabem_options options;
        igabem_options_init(&options);
        options.froude = 0.35;
        options.threads = argc > 1 ? atoi(argv[1]) : 0;
        options.elements_u = meshes[k][0];
        options.elements_v = meshes[k][1];
        igabem_solution *solution = NULL;
        igabem_forces forces;
        double start = now();
        if (igabem_solve(hull, &options, &solution) != IGABEM_OK ||
            igabem_forces_compute(solution, &forces) != IGABEM_OK) {
            fprintf(stderr, "%s\n", igabem_last_error());
            return EXIT_FAILURE;
        }
        double total = now() - start, dofs = (double)forces.dofs;
        printf("%8zu  %7.3f  %11.3f  ", forces.dofs, forces.seconds, total);
        if (k)
            printf("%8.2f", log(total / previous_time) / log(dofs / previous_dofs));
        else
            printf("%8s", "");
        printf("  %.4e\n", forces.cw);
        fflush(stdout);
        previous_time = total;
        previous_dofs = dofs;
        igabem_solution_free(solution);
    }
    igabem_hull_free(hull);
    return EXIT_SUCCESS;
}
