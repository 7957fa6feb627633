/* Time, memory and growth of a solve: the DTMB 5415 wetted and simplified, Fr 0.35, default
 * formulation. Beside the wall clock the processor time, and that of the calling thread: it runs
 * the serial parts and its share of the others, so that their ratio is the speed-up of idle cores
 * even when other work holds the machine up (with OMP_WAIT_POLICY=passive). Usage:
 * igabem_bench_solve [threads [largest number of unknowns [auto|lu|gmres [sensitivity]]]]
 * igabem_bench_solve tolerance   cost and error of the quadrature against the tolerance asked
 * igabem_bench_solve froude      what the settings of a Froude sweep share */
#define _POSIX_C_SOURCE 200809L
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

#include <math.h>
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
                               NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_KEEP_KINKS |
                                   NURBS_SIMPLIFY_THRIFTY,
                               &light, &bound) == NURBS_OK &&
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

static int growth(const igabem_hull *hull, int argc, char **argv)
{
    static const int meshes[][2] = {{16, 6},  {24, 8},  {32, 10}, {40, 12},
                                    {56, 16}, {80, 22}, {96, 27}, {112, 32}};
    enum { LEVELS = sizeof meshes / sizeof meshes[0], FITTED = 4 };
    double dofs[LEVELS], time[LEVELS];
    size_t n = 0, most = argc > 2 ? (size_t)atol(argv[2]) : 1000000;
    printf("unknowns     wall  processor  caller  exponent       MB         C_w  condition  "
           "iterations\n");
    for (size_t k = 0; k < LEVELS; k++) {
        igabem_options options;
        igabem_forces forces;
        double spent[CLOCKS];
        igabem_options_init(&options);
        options.refine = 1;
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
            return 0;
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
    return 1;
}

/* Least processor time of a few repetitions. */
static int repeat(const igabem_hull *hull, const igabem_options *options, int times,
                  igabem_forces *forces, double *least)
{
    *least = INFINITY;
    for (int k = 0; k < times; k++) {
        double spent[CLOCKS];
        if (!run(hull, options, forces, spent))
            return 0;
        *least = fmin(*least, spent[PROCESS]);
    }
    return 1;
}

static int tolerances(const igabem_hull *hull, const char *name, igabem_options *options)
{
    enum { ROWS = 9, REPEAT = 3 };
    igabem_forces row[ROWS];
    double time[ROWS];
    for (int k = 0; k < ROWS; k++) {
        options->tolerance = pow(10.0, -2.0 - k);
        if (!repeat(hull, options, k < 6 ? REPEAT : 1, &row[k], &time[k]))
            return 0;
    }
    printf("%s, %zu unknowns, Fr %g, one thread\n"
           "tolerance singular     near      far        1/r          N      waves  seconds  "
           "error of C_w\n",
           name, row[0].dofs, options->froude);
    for (int k = 0; k < ROWS; k++) {
        const igabem_cost *c = &row[k].cost;
        printf("%9.0e %8zu %8zu %8zu %10.3g %10.3g %10.3g %8.3f  ", pow(10.0, -2.0 - k),
               c->singular_pairs, c->near_pairs, c->far_pairs, (double)c->rankine, (double)c->local,
               (double)c->wave, time[k]);
        if (k + 1 < ROWS)
            printf("%.1e\n", fabs(row[k].cw / row[ROWS - 1].cw - 1.0));
        else
            printf("(reference)\n");
    }
    return 1;
}

/* Length 1 m, 0.2 m thick, axis 0.16 m deep. */
static igabem_hull *make_spheroid(void)
{
    nurbs_surface *surface = NULL;
    igabem_hull *hull = NULL;
    if (nurbs_make_ellipsoid(1.0, 0.2, 0.2, 0.16, &surface) != NURBS_OK ||
        igabem_hull_create((const nurbs_surface *const *)&surface, 1, IGABEM_SYMMETRIC, &hull) !=
            IGABEM_OK)
        fprintf(stderr, "spheroid: %s %s\n", nurbs_last_error(), igabem_last_error());
    nurbs_surface_free(surface);
    return hull;
}

static int tolerance_tables(const igabem_hull *hull)
{
    igabem_options options;
    igabem_options_init(&options);
    options.refine = 1;
    options.threads = 1;
    options.froude = 0.35;
    options.elements_u = 32;
    options.elements_v = 10;
    if (!tolerances(hull, "DTMB 5415", &options))
        return 0;
    igabem_hull *spheroid = make_spheroid();
    igabem_options_init(&options);
    options.refine = 1;
    options.threads = 1;
    options.froude = 0.6;
    options.elements_u = 14;
    options.elements_v = 6;
    int done = spheroid && tolerances(spheroid, "submerged spheroid", &options);
    igabem_hull_free(spheroid);
    return done;
}

/* Processor time of n settings in one call. */
static int sweep(const igabem_hull *hull, size_t n, const igabem_options *options, double *spent)
{
    igabem_solution *solution[32];
    *spent = -seconds(CLOCK_PROCESS_CPUTIME_ID);
    int failed = igabem_solve_many(hull, n, options, solution) != IGABEM_OK;
    *spent += seconds(CLOCK_PROCESS_CPUTIME_ID);
    for (size_t k = 0; k < n; k++)
        igabem_solution_free(solution[k]);
    if (failed)
        fprintf(stderr, "%s\n", igabem_last_error());
    return !failed;
}

static int froude_table(const igabem_hull *hull)
{
    static const size_t counts[] = {1, 5, 26};
    enum { MOST = 26 };
    printf("Froude numbers 0.20 to 0.45   one call     each    one by one     each\n");
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
        igabem_options options[MOST];
        size_t n = counts[c];
        double together = INFINITY, apart = INFINITY;
        for (size_t k = 0; k < n; k++) {
            igabem_options_init(&options[k]);
            options[k].refine = 1;
            options[k].threads = 1;
            options[k].elements_u = 32;
            options[k].elements_v = 10;
            options[k].froude = n > 1 ? 0.2 + 0.25 * (double)k / (double)(n - 1) : 0.35;
        }
        for (int r = 0; r < (n < MOST ? 2 : 1); r++) {
            double spent, sum = 0.0;
            if (!sweep(hull, n, options, &spent))
                return 0;
            together = fmin(together, spent);
            for (size_t k = 0; k < n; k++) {
                if (!sweep(hull, 1, &options[k], &spent))
                    return 0;
                sum += spent;
            }
            apart = fmin(apart, sum);
        }
        printf("%22zu %16.3f %8.3f %13.3f %8.3f\n", n, together, together / (double)n, apart,
               apart / (double)n);
        fflush(stdout);
    }
    return 1;
}

int main(int argc, char **argv)
{
    igabem_hull *hull = read_hull(EXAMPLES_DIR "/hulls/dtmb5415.json");
    if (!hull)
        return EXIT_FAILURE;
    const char *mode = argc > 1 ? argv[1] : "";
    int done = strcmp(mode, "tolerance") == 0 ? tolerance_tables(hull)
               : strcmp(mode, "froude") == 0  ? froude_table(hull)
                                              : growth(hull, argc, argv);
    igabem_hull_free(hull);
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
