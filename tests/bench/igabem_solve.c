/* Time, memory and growth of a solve: the DTMB 5415 wetted and simplified, Fr 0.35, default
 * formulation. Beside the wall clock the processor time, and that of the calling thread: it runs
 * the serial parts and its share of the others, so that their ratio is the speed-up of idle cores
 * even when other work holds the machine up (with OMP_WAIT_POLICY=passive). Usage:
 * igabem_bench_solve [threads [largest number of unknowns [auto|lu|gmres [sensitivity]]]] */
#define _POSIX_C_SOURCE 200809L
#include <igabem/igabem.h>
#include <math.h>
#include <nurbs/nurbs.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double length = 5.72;

static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Exponent b of y = a x^b by least squares in the logarithms. */
static double exponent(size_t n, const double *x, const double *y)
{
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, m = (double)n;
    for (size_t k = 0; k < n; k++) {
        double u = log(x[k]), v = log(y[k]);
        sx += u;
        sy += v;
        sxx += u * u;
        sxy += u * v;
    }
    return (m * sxy - sx * sy) / (m * sxx - sx * sx);
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

enum { WALL, PROCESS, CALLER, CLOCKS };

static int run(const igabem_hull *hull, const igabem_options *options, igabem_forces *forces,
               double spent[CLOCKS])
{
    static const clockid_t clock[CLOCKS] = {CLOCK_MONOTONIC, CLOCK_PROCESS_CPUTIME_ID,
                                            CLOCK_THREAD_CPUTIME_ID};
    igabem_solution *solution = NULL;
    for (int c = 0; c < CLOCKS; c++)
        spent[c] = -seconds(clock[c]);
    int failed = igabem_solve(hull, options, &solution) != IGABEM_OK ||
                 igabem_forces_compute(solution, forces) != IGABEM_OK;
    for (int c = 0; c < CLOCKS; c++)
        spent[c] += seconds(clock[c]);
    igabem_solution_free(solution);
    if (failed)
        fprintf(stderr, "%s\n", igabem_last_error());
    return !failed;
}

int main(int argc, char **argv)
{
    static const int meshes[][2] = {{16, 6},  {24, 8},  {32, 10}, {40, 12},
                                    {56, 16}, {80, 22}, {96, 27}, {112, 32}};
    enum { LEVELS = sizeof meshes / sizeof meshes[0], FITTED = 4 };
    double dofs[LEVELS], time[LEVELS];
    size_t n = 0, most = argc > 2 ? (size_t)atol(argv[2]) : 1000000;
    igabem_hull *hull = read_hull(EXAMPLES_DIR "/hulls/dtmb5415.json");
    if (!hull)
        return EXIT_FAILURE;
    printf("unknowns     wall  processor  caller  exponent       MB         C_w  condition  "
           "iterations\n");
    for (size_t k = 0; k < LEVELS; k++) {
        igabem_options options;
        igabem_forces forces;
        double spent[CLOCKS];
        igabem_options_init(&options);
        options.froude = 0.35;
        options.threads = argc > 1 ? atoi(argv[1]) : 0;
        options.elements_u = meshes[k][0];
        options.elements_v = meshes[k][1];
        if (argc > 3 && strcmp(argv[3], "auto") != 0)
            options.solver = strcmp(argv[3], "lu") == 0 ? IGABEM_SOLVER_LU : IGABEM_SOLVER_GMRES;
        options.sensitivity = argc > 4;
        if ((size_t)(meshes[k][0] + 3) * (size_t)(meshes[k][1] + 3) > most)
            break;
        if (!run(hull, &options, &forces, spent))
            return EXIT_FAILURE;
        dofs[n] = (double)forces.dofs;
        time[n++] = spent[PROCESS];
        printf("%8zu %8.3f   %8.3f%8.3f  ", forces.dofs, spent[WALL], spent[PROCESS],
               spent[CALLER]);
        if (n > 1)
            printf("%8.2f", exponent(2, dofs + n - 2, time + n - 2));
        else
            printf("%8s", "");
        printf(" %8.1f  %.4e  %9.0f  %10zu\n", 1e-6 * forces.memory, forces.cw, forces.condition,
               forces.iterations);
        fflush(stdout);
    }
    if (n >= FITTED)
        printf("processor time grows with the power %.2f of the unknowns over the last %d rows\n",
               exponent(FITTED, dofs + n - FITTED, time + n - FITTED), (int)FITTED);
    igabem_hull_free(hull);
    return EXIT_SUCCESS;
}
