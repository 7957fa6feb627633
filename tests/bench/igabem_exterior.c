/* The potential on hull and free surface beside exact values, the Kelvin solver and itself.
 * Usage: igabem_bench_exterior spheroid | wigley | thin | code | [double-model] HULL.json... |
 * [double-model] cut|pressure|first CELLS HULL.json... (no argument: spheroid wigley code) */
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SPEEDS = 8 };
static igabem_formulation settings_of = IGABEM_FORMULATION_EXTERIOR;

static igabem_options exterior(double cells)
{
    igabem_options options;
    igabem_options_init(&options);
    options.formulation = settings_of;
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
        forces[k].cw = forces[k].cw_l2 = forces[k].cw_momentum = NAN;
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

/* Against the exact resistances of tests/igabem/test_spheroid.c, the sphere (centre at 3 radii,
 * where the Kelvin solver is exact to 1e-5) against that; and what falls from one row of cells to
 * the next. */
static void spheroids(void)
{
    enum { SPEEDS = 5, BODIES = 3, CELLS = 4 };
    static const double froude[SPEEDS] = {0.35, 0.40, 0.50, 0.60, 0.80};
    static const double froude_sphere[SPEEDS] = {0.6, 0.7, 0.8, 1.0, 1.2};
    static const double exact[2][SPEEDS] = {
        {0.001375343973, 0.004696085283, 0.005940084442, 0.004182248287, 0.00173690497},
        {0.001484648601, 0.006159245503, 0.008803458256, 0.006402455475, 0.002648598643}};
    static const double ratio[BODIES] = {6.0, 5.0, 1.0}, depth[BODIES] = {0.125, 0.16, 1.5};
    static const double cells[CELLS] = {8, 12, 18, 27};
    for (int b = 0; b < BODIES; b++) {
        const double *at = b < 2 ? froude : froude_sphere;
        nurbs_surface *surface = NULL;
        nurbs_status made =
            nurbs_make_ellipsoid(1.0, 1.0 / ratio[b], 1.0 / ratio[b], depth[b], &surface);
        igabem_hull *hull = body(made, surface);
        igabem_forces reference[MOST_SPEEDS];
        igabem_options options = exterior(0.0);
        options.formulation = IGABEM_FORMULATION_NEUMANN_KELVIN;
        sweep(hull, &options, SPEEDS, at, reference);
        printf("\nL/D %g: C_w on L^2, error in per cent\n\n| cells |", ratio[b]);
        for (int k = 0; k < SPEEDS; k++)
            printf(" Fr %.2f |", at[k]);
        printf("\n|---|---|---|---|---|---|\n");
        for (size_t c = 0; c < CELLS; c++) {
            igabem_forces forces[MOST_SPEEDS];
            options = exterior(cells[c]);
            sweep(hull, &options, SPEEDS, at, forces);
            printf("| %g |", cells[c]);
            for (int k = 0; k < SPEEDS; k++)
                printf(" %+.2f |",
                       100.0 *
                           (forces[k].cw_l2 / (b < 2 ? exact[b][k] : reference[k].cw_l2) - 1.0));
            printf("\n");
            fflush(stdout);
        }
        igabem_hull_free(hull);
    }
}

/* Linear pressure beside another code's (jer-j/NeumannKelvin.jl, validation/noblesse_wigley, 80 x
 * 12 flat panels, filter and contour term on), Wigley hull B/L 0.1. */
static void another_code(void)
{
    enum { SPEEDS = 6 };
    static const double froude[SPEEDS] = {0.250, 0.267, 0.289, 0.316, 0.354, 0.408};
    static const double theirs[SPEEDS] = {1.114, 0.955, 1.634, 1.443, 1.602, 2.114};
    static const igabem_formulation rows[] = {IGABEM_FORMULATION_NEUMANN_KELVIN,
                                              IGABEM_FORMULATION_EXTERIOR};
    nurbs_surface *surface = NULL;
    nurbs_status made = nurbs_make_wigley(1.0, 0.1, 0.0625, &surface);
    igabem_hull *hull = body(made, surface);
    printf("\nWigley hull, linear pressure, C_w x 1000 (per cent of the other code's)\n\n"
           "| formulation |");
    for (int k = 0; k < SPEEDS; k++)
        printf(" %.3f |", froude[k]);
    printf("\n|---|---|---|---|---|---|---|\n| the other code |");
    for (int k = 0; k < SPEEDS; k++)
        printf(" %.3f |", theirs[k]);
    printf("\n");
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        igabem_options options = exterior(48.0);
        igabem_forces forces[MOST_SPEEDS];
        options.formulation = rows[r];
        options.elements_u = 40;
        options.elements_v = 8;
        sweep(hull, &options, SPEEDS, froude, forces);
        printf("| %s |", igabem_formulation_name(rows[r]));
        for (int k = 0; k < SPEEDS; k++)
            printf(" %.3f (%+.1f) |", 1e3 * forces[k].cw_pressure_linear,
                   100.0 * (1e3 * forces[k].cw_pressure_linear / theirs[k] - 1.0));
        printf("\n");
        fflush(stdout);
    }
    igabem_hull_free(hull);
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
           "momentum\n\n| B/L | formulation | cells |");
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
                       forces[k].cw_momentum / thin[k].cw);
            printf("\n");
            fflush(stdout);
        }
        igabem_hull_free(hull);
    }
}

/* Of the Kochin function, the angles that a cut holds. */
static double kochin_within(const igabem_solution *solution, double limit)
{
    enum { N = 400 };
    double t[N], h[N][2], dcw[N], step = asinh(limit) / N, sum = 0.0;
    for (int i = 0; i < N; i++)
        t[i] = sinh((i + 0.5) * step);
    if (igabem_kochin(solution, N, t, h, dcw))
        return NAN;
    for (int i = 0; i < N; i++)
        sum += 2.0 * dcw[i] * cosh((i + 0.5) * step) * step;
    return sum;
}

/* The double model on hulls that get thinner, over Michell's integral up to its own last angle. */
static void thin_limit(void)
{
    enum { SPEEDS = 4, BEAMS = 3, CELLS = 2 };
    static const double froude[SPEEDS] = {0.25, 0.30, 0.35, 0.40};
    static const double beam[BEAMS] = {0.02, 0.01, 0.005}, cells[CELLS] = {24, 36};
    double ratio[BEAMS][CELLS][SPEEDS], share[SPEEDS];
    for (int b = 0; b < BEAMS; b++) {
        nurbs_surface *surface = NULL;
        nurbs_status made = nurbs_make_wigley(1.0, beam[b], 0.0625, &surface);
        igabem_hull *hull = body(made, surface);
        igabem_options options = exterior(0.0);
        igabem_forces forces[MOST_SPEEDS], thin[MOST_SPEEDS];
        options.formulation = IGABEM_FORMULATION_MICHELL;
        options.elements_u = 32;
        options.elements_v = 8;
        sweep(hull, &options, SPEEDS, froude, thin);
        for (int k = 0; k < SPEEDS && b == 0; k++) {
            igabem_solution *solution = NULL;
            options.froude = froude[k];
            share[k] = igabem_solve(hull, &options, &solution)
                           ? NAN
                           : kochin_within(solution, 4.0) / thin[k].cw;
            igabem_solution_free(solution);
        }
        options.formulation = IGABEM_FORMULATION_DOUBLE_MODEL;
        options.surface_upstream = 0.4;
        options.surface_downstream = 0.3;
        options.surface_side = 0.5;
        for (int c = 0; c < CELLS; c++) {
            options.surface_cells = cells[c];
            sweep(hull, &options, SPEEDS, froude, forces);
            for (int k = 0; k < SPEEDS; k++)
                ratio[b][c][k] = forces[k].cw / (thin[k].cw * share[k]);
        }
        igabem_hull_free(hull);
    }
    printf("\nWigley hull, T/L 0.0625, double-model: C_w over Michell's, both of t < 4\n\n| B/L | "
           "cells |");
    for (int k = 0; k < SPEEDS; k++)
        printf(" Fr %.2f |", froude[k]);
    printf("\n|---|---|---|---|---|---|\n");
    for (int c = 0; c < CELLS; c++) {
        for (int b = 0; b < BEAMS; b++) {
            printf("| %g | %g |", beam[b], cells[c]);
            for (int k = 0; k < SPEEDS; k++)
                printf(" %.4f |", ratio[b][c][k]);
            printf("\n");
        }
        /* A parabola through the three. */
        printf("| extrapolated | %g |", cells[c]);
        for (int k = 0; k < SPEEDS; k++)
            printf(" %.4f |", (8.0 * ratio[2][c][k] - 6.0 * ratio[1][c][k] + ratio[0][c][k]) / 3.0);
        printf("\n");
    }
    printf("| Michell's share of t > 4 | |");
    for (int k = 0; k < SPEEDS; k++)
        printf(" %.2f %% |", 100.0 * (1.0 - share[k]));
    printf("\n");
}

/* What the settings of the free surface change. */
static void settings(const char *path)
{
    static const double froude[] = {0.28, 0.35, 0.41};
    static const struct {
        const char *name;
        double cells, first, damping, columns, downstream, side;
    } row[] = {{"32 cells", 32, 0.5, 1, 6, 0.7, 0.6},
               {"40 cells", 40, 0.5, 1, 6, 0.7, 0.6},
               {"56 cells", 56, 0.5, 1, 6, 0.7, 0.6},
               {"80 cells", 80, 0.5, 1, 6, 0.7, 0.6},
               {"40, first row times 0.7", 40, 0.35, 1, 6, 0.7, 0.6},
               {"40, first row times 1.4", 40, 0.7, 1, 6, 0.7, 0.6},
               {"40, half the damping", 40, 0.5, 0.5, 6, 0.7, 0.6},
               {"40, twice the damping", 40, 0.5, 2, 6, 0.7, 0.6},
               {"40, 9 columns", 40, 0.5, 1, 9, 0.7, 0.6},
               {"40, 1.1 L aft", 40, 0.5, 1, 6, 1.1, 0.6},
               {"40, 0.8 L aside", 40, 0.5, 1, 6, 0.7, 0.8}};
    nurbs_hull *source = NULL;
    igabem_hull *hull = NULL;
    if (nurbs_hull_read(path, NULL, &source) || igabem_hull_from(source, &hull)) {
        fprintf(stderr, "%s: %s %s\n", path, nurbs_last_error(), igabem_last_error());
        nurbs_hull_free(source);
        return;
    }
    printf("\n%s, %s: C_w x 1000 by Kochin function; by momentum\n\n| setting |", path,
           igabem_formulation_name(settings_of));
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
            printf(" %.3f; %.3f |", 1e3 * forces[k].cw, 1e3 * forces[k].cw_momentum);
        }
        printf(" %.2f |\n", forces[0].seconds);
        fflush(stdout);
    }
    igabem_hull_free(hull);
    nurbs_hull_free(source);
}

/* One solution: C_w, its part of t < 4, what cuts so far off the side say over that part, and what
 * its momentum says over C_w. */
static void cut_row(const char *name, const igabem_hull_info *info, const igabem_solution *solution)
{
    static const double off[] = {0.05, 0.10, 0.15, 0.20};
    const igabem_options *options = igabem_solution_options(solution);
    double within = kochin_within(solution, 4.0);
    igabem_forces forces;
    if (igabem_forces_compute(solution, &forces))
        fprintf(stderr, "%s\n", igabem_last_error());
    printf("| %s | %s | %g | %.2f | %.4f | %.4f |", name,
           igabem_formulation_name(options->formulation), options->surface_cells, options->froude,
           1e3 * forces.cw, 1e3 * within);
    for (size_t k = 0; k < sizeof off / sizeof *off; k++) {
        double cw = NAN, y = 0.5 * info->hydrostatics.beam + off[k] * info->length;
        if (igabem_wave_cut(solution, y, &cw))
            fprintf(stderr, "%s\n", igabem_last_error());
        printf(" %.3f |", cw / within);
    }
    printf(" %.3f |\n", forces.cw_momentum / forces.cw);
    fflush(stdout);
}

static igabem_hull *read_hull(const char *path, nurbs_hull **source)
{
    igabem_hull *hull = NULL;
    if (nurbs_hull_read(path, NULL, source) || igabem_hull_from(*source, &hull)) {
        fprintf(stderr, "%s: %s %s\n", path, nurbs_last_error(), igabem_last_error());
        nurbs_hull_free(*source);
        *source = NULL;
    }
    return hull;
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

enum { SHIP_SPEEDS = 3 };
static const double ship_froude[SHIP_SPEEDS] = {0.28, 0.35, 0.41};

/* Waves on the solved surface beside the Kochin function of the same solution. */
static void cuts(double cells, const char *path)
{
    nurbs_hull *source = NULL;
    igabem_hull *hull = read_hull(path, &source);
    igabem_options options[SHIP_SPEEDS];
    igabem_solution *solutions[SHIP_SPEEDS] = {NULL};
    igabem_hull_info info;
    if (!hull)
        return;
    igabem_hull_get_info(hull, &info);
    for (size_t k = 0; k < SHIP_SPEEDS; k++) {
        options[k] = exterior(cells);
        options[k].froude = ship_froude[k];
        options[k].elements_u = 48;
        options[k].elements_v = 10;
        options[k].surface_rows = round(0.55 * cells);
        options[k].surface_side = 0.8;
        options[k].surface_downstream = 1.8;
    }
    if (igabem_solve_many(hull, SHIP_SPEEDS, options, solutions))
        fprintf(stderr, "%s\n", igabem_last_error());
    for (size_t k = 0; k < SHIP_SPEEDS; k++) {
        if (solutions[k])
            cut_row(name_of(path), &info, solutions[k]);
        igabem_solution_free(solutions[k]);
    }
    igabem_hull_free(hull);
    nurbs_hull_free(source);
}

/* What the hull feels, and what the momentum says, beside the Kochin function. */
static void pressures(double cells, const char *path)
{
    nurbs_hull *source = NULL;
    igabem_hull *hull = read_hull(path, &source);
    igabem_options options = exterior(cells);
    igabem_forces forces[MOST_SPEEDS];
    if (!hull)
        return;
    options.elements_u = 48;
    options.elements_v = 10;
    sweep(hull, &options, SHIP_SPEEDS, ship_froude, forces);
    for (size_t k = 0; k < SHIP_SPEEDS; k++) {
        double transom = isfinite(forces[k].cw_transom) ? forces[k].cw_transom : 0.0;
        double felt = forces[k].cw_pressure + transom;
        printf("| %s | %.2f | %.4f | %.4f (%.2f) | %.4f (%.2f) | %.4f | %.4f |\n", name_of(path),
               ship_froude[k], 1e3 * forces[k].cw, 1e3 * forces[k].cw_momentum,
               forces[k].cw_momentum / forces[k].cw, 1e3 * felt, felt / forces[k].cw,
               1e3 * forces[k].cw_run_up, 1e3 * transom);
    }
    fflush(stdout);
    igabem_hull_free(hull);
    nurbs_hull_free(source);
}

/* What the width of the first row changes, in per cent of half a cell's. */
static void first_rows(double cells, const char *path)
{
    static const double first[] = {0.5, 0.35, 0.7};
    nurbs_hull *source = NULL;
    igabem_hull *hull = read_hull(path, &source);
    igabem_forces forces[3][MOST_SPEEDS];
    if (!hull)
        return;
    for (size_t r = 0; r < 3; r++) {
        igabem_options options = exterior(cells);
        options.elements_u = 40;
        options.elements_v = 10;
        options.surface_first = first[r];
        sweep(hull, &options, SHIP_SPEEDS, ship_froude, forces[r]);
    }
    for (size_t k = 0; k < SHIP_SPEEDS; k++)
        printf("| %s | %g | %.2f | %.4f | %+.1f | %+.1f |\n", name_of(path), cells, ship_froude[k],
               1e3 * forces[0][k].cw, 100.0 * (forces[1][k].cw / forces[0][k].cw - 1.0),
               100.0 * (forces[2][k].cw / forces[0][k].cw - 1.0));
    fflush(stdout);
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
        else if (strcmp(argv[k], "thin") == 0)
            thin_limit();
        else if (strcmp(argv[k], "code") == 0)
            another_code();
        else if (strcmp(argv[k], "cut") == 0 && k + 2 < argc) {
            printf(
                "| hull | formulation | cells | Fr | C_w x 1000 | t < 4 | cut at 0.05 L, over it "
                "| 0.10 | 0.15 | 0.20 | momentum |\n");
            for (double cells = atof(argv[++k]); k + 1 < argc;)
                cuts(cells, argv[++k]);
        } else if (strcmp(argv[k], "pressure") == 0 && k + 2 < argc) {
            printf("| hull | Fr | C_w x 1000 | momentum | pressure and transom | run-up | transom "
                   "|\n");
            for (double cells = atof(argv[++k]); k + 1 < argc;)
                pressures(cells, argv[++k]);
        } else if (strcmp(argv[k], "first") == 0 && k + 2 < argc) {
            printf("| hull | cells | Fr | C_w x 1000 | first row times 0.7, per cent | 1.4 |\n");
            for (double cells = atof(argv[++k]); k + 1 < argc;)
                first_rows(cells, argv[++k]);
        } else if (igabem_formulation_parse(argv[k], &settings_of))
            continue;
        else
            settings(argv[k]);
    }
    if (argc < 2) {
        spheroids();
        wigleys();
        another_code();
    }
    return 0;
}
