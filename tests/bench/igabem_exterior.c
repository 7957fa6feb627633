/* The potential on hull and free surface beside exact values, the Kelvin solver and itself.
 * Usage: igabem_bench_exterior spheroid | wigley | HULL.json... (no argument: the first two) */
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SPEEDS = 8 };

static igabem_options exterior(double cells)
{
    igabem_options options;
    igabem_options_init(&options);
    options.formulation = IGABEM_FORMULATION_EXTERIOR;
    options.surface_cells = cells;
    return options;
}

/* Forces at the speeds, which share their integrals. */
static void sweep(const igabem_hull *hull, const igabem_options *setting, size_t n,
                  const double *froude, igabem_forces *forces)
{
    igabem_options options[MOST_SPEEDS] = {{0}};
    igabem_solution *solutions[MOST_SPEEDS] = {NULL};
    for (size_t k = 0; k < n; k++) {
        options[k] = *setting;
        options[k].froude = froude[k];
        forces[k].cw = forces[k].cw_l2 = forces[k].cw_pressure = forces[k].cw_transom = NAN;
    }
    if (igabem_solve_many(hull, n, options, solutions)) {
        fprintf(stderr, "%s\n", igabem_last_error());
        return;
    }
    for (size_t k = 0; k < n; k++) {
        if (igabem_forces_compute(solutions[k], &forces[k]))
            fprintf(stderr, "%s\n", igabem_last_error());
        igabem_solution_free(solutions[k]);
    }
}

static igabem_hull *body(nurbs_status made, nurbs_surface *surface)
{
    igabem_hull *hull = NULL;
    if (made ||
        igabem_hull_create((const nurbs_surface *const *)&surface, 1, IGABEM_SYMMETRIC, &hull)) {
        fprintf(stderr, "%s %s\n", nurbs_last_error(), igabem_last_error());
        exit(1);
    }
    nurbs_surface_free(surface);
    return hull;
}

/* Against the exact resistances of tests/igabem/test_spheroid.c. */
static void spheroids(void)
{
    static const double froude[] = {0.35, 0.40, 0.50, 0.60, 0.80};
    static const double exact[2][5] = {
        {0.001375343973, 0.004696085283, 0.005940084442, 0.004182248287, 0.00173690497},
        {0.001484648601, 0.006159245503, 0.008803458256, 0.006402455475, 0.002648598643}};
    static const double ratio[2] = {6.0, 5.0}, depth[2] = {0.125, 0.16}, cells[] = {12, 16, 24};
    printf("Spheroids, C_w on L^2: error in per cent\n\n| L/D | cells |");
    for (int k = 0; k < 5; k++)
        printf(" Fr %.2f |", froude[k]);
    printf("\n");
    for (int b = 0; b < 2; b++) {
        nurbs_surface *surface = NULL;
        nurbs_status made =
            nurbs_make_ellipsoid(1.0, 1.0 / ratio[b], 1.0 / ratio[b], depth[b], &surface);
        igabem_hull *hull = body(made, surface);
        for (size_t c = 0; c < sizeof cells / sizeof *cells; c++) {
            igabem_options options = exterior(cells[c]);
            igabem_forces forces[MOST_SPEEDS];
            sweep(hull, &options, 5, froude, forces);
            printf("| %g | %g |", ratio[b], cells[c]);
            for (int k = 0; k < 5; k++)
                printf(" %+.2f |", 100.0 * (forces[k].cw_l2 / exact[b][k] - 1.0));
            printf("\n");
        }
        igabem_hull_free(hull);
    }
}

/* Over Michell's C_w, beside the Kelvin solver. */
static void wigleys(void)
{
    static const double froude[] = {0.25, 0.30, 0.35, 0.40}, beam[] = {0.1, 0.02, 0.01};
    static const struct {
        igabem_formulation formulation;
        double cells;
    } row[] = {{IGABEM_FORMULATION_NEUMANN_KELVIN, 0.0},
               {IGABEM_FORMULATION_EXTERIOR, 32.0},
               {IGABEM_FORMULATION_EXTERIOR, 48.0},
               {IGABEM_FORMULATION_EXTERIOR, 64.0}};
    printf("\nWigley hull, T/L 0.0625, hull 32 x 8: C_w over Michell's, by Kochin function and by "
           "pressure\n\n| B/L | formulation | cells |");
    for (int k = 0; k < 4; k++)
        printf(" Fr %.2f |", froude[k]);
    printf("\n");
    for (size_t b = 0; b < sizeof beam / sizeof *beam; b++) {
        nurbs_surface *surface = NULL;
        nurbs_status made = nurbs_make_wigley(1.0, beam[b], 0.0625, &surface);
        igabem_hull *hull = body(made, surface);
        igabem_forces thin[MOST_SPEEDS], forces[MOST_SPEEDS];
        igabem_options options = exterior(0.0);
        options.formulation = IGABEM_FORMULATION_MICHELL;
        options.elements_u = 32;
        options.elements_v = 8;
        sweep(hull, &options, 4, froude, thin);
        for (size_t r = 0; r < sizeof row / sizeof *row; r++) {
            options.formulation = row[r].formulation;
            options.surface_cells = row[r].cells;
            options.surface_upstream = 0.4;
            options.surface_downstream = 0.3;
            options.surface_side = 0.5;
            sweep(hull, &options, 4, froude, forces);
            printf("| %g | %s | %g |", beam[b], igabem_formulation_name(row[r].formulation),
                   row[r].cells);
            for (int k = 0; k < 4; k++)
                printf(" %.4f, %.4f |", forces[k].cw / thin[k].cw,
                       forces[k].cw_pressure / thin[k].cw);
            printf("\n");
            fflush(stdout);
        }
        igabem_hull_free(hull);
    }
}

/* What the settings of the free surface change. */
static void settings(const char *path)
{
    static const double froude[] = {0.28, 0.35, 0.41};
    static const struct {
        const char *name;
        double cells, first, damping, columns, downstream, side;
    } row[] = {{"32 cells", 32, 1, 1, 6, 0.7, 0.6},
               {"40 cells", 40, 1, 1, 6, 0.7, 0.6},
               {"56 cells", 56, 1, 1, 6, 0.7, 0.6},
               {"40, first row times 0.7", 40, 0.7, 1, 6, 0.7, 0.6},
               {"40, first row times 1.4", 40, 1.4, 1, 6, 0.7, 0.6},
               {"40, half the damping", 40, 1, 0.5, 6, 0.7, 0.6},
               {"40, twice the damping", 40, 1, 2, 6, 0.7, 0.6},
               {"40, 9 columns", 40, 1, 1, 9, 0.7, 0.6},
               {"40, 1.1 L aft", 40, 1, 1, 6, 1.1, 0.6},
               {"40, 0.8 L aside", 40, 1, 1, 6, 0.7, 0.8}};
    nurbs_hull *source = NULL;
    igabem_hull *hull = NULL;
    if (nurbs_hull_read(path, NULL, &source) || igabem_hull_from(source, &hull)) {
        fprintf(stderr, "%s: %s %s\n", path, nurbs_last_error(), igabem_last_error());
        nurbs_hull_free(source);
        return;
    }
    printf(
        "\n%s: C_w x 1000 by Kochin function; by pressure with the transom's term\n\n| setting |",
        path);
    for (int k = 0; k < 3; k++)
        printf(" Fr %.2f |", froude[k]);
    printf(" seconds a speed |\n");
    for (size_t r = 0; r < sizeof row / sizeof *row; r++) {
        igabem_options options = exterior(row[r].cells);
        igabem_forces forces[MOST_SPEEDS];
        options.surface_first = row[r].first;
        options.surface_damping = row[r].damping;
        options.surface_columns = row[r].columns;
        options.surface_downstream = row[r].downstream;
        options.surface_side = row[r].side;
        sweep(hull, &options, 3, froude, forces);
        printf("| %s |", row[r].name);
        for (int k = 0; k < 3; k++) {
            double transom = isfinite(forces[k].cw_transom) ? forces[k].cw_transom : 0.0;
            printf(" %.3f; %.3f |", 1e3 * forces[k].cw, 1e3 * (forces[k].cw_pressure + transom));
        }
        printf(" %.2f |\n", forces[0].seconds);
        fflush(stdout);
    }
    igabem_hull_free(hull);
    nurbs_hull_free(source);
}

int main(int argc, char **argv)
{
    for (int k = 1; k < argc; k++) {
        if (strcmp(argv[k], "spheroid") == 0)
            spheroids();
        else if (strcmp(argv[k], "wigley") == 0)
            wigleys();
        else
            settings(argv[k]);
    }
    if (argc < 2) {
        spheroids();
        wigleys();
    }
    return 0;
}
