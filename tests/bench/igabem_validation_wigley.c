/* The Wigley hull: convergence, cut-off, thin limit, Froude numbers. */
#include "igabem_validation.h"

#include <math.h>
#include <stdio.h>

static const double DRAFT = 0.0625;

enum { LEVELS = 5, SPEEDS = 6 };

static const int levels[LEVELS][2] = {{16, 4}, {24, 6}, {32, 8}, {48, 12}, {64, 16}};
static const double speeds[SPEEDS] = {0.20, 0.25, 0.30, 0.35, 0.40, 0.45};

/* Change of C_w of the defaults from the level before, and how far it is from the finest. */
static void changes(double cw[LEVELS][SPEEDS], const size_t dofs[LEVELS])
{
    printf(
        "\nDefaults: C_w x 1000, then its change from the level before and its distance from the "
        "finest level, per cent.\n\n| unknowns |");
    for (int i = 0; i < SPEEDS; i++)
        printf(" Fr %.2f |", speeds[i]);
    printf(" largest change | largest distance |\n|---|---|---|---|---|---|---|---|---|\n");
    for (int l = 0; l < LEVELS; l++) {
        double change = 0.0, distance = 0.0;
        printf("| %zu |", dofs[l]);
        for (int i = 0; i < SPEEDS; i++) {
            double from_finest = 100.0 * (cw[l][i] / cw[LEVELS - 1][i] - 1.0);
            double step = l > 0 ? 100.0 * (cw[l][i] / cw[l - 1][i] - 1.0) : NAN;
            if (l > 0)
                printf(" %.4f, %+.2f, %+.2f |", 1000 * cw[l][i], step, from_finest);
            else
                printf(" %.4f, -, %+.2f |", 1000 * cw[l][i], from_finest);
            change = fmax(change, fabs(step));
            distance = fmax(distance, fabs(from_finest));
        }
        if (l > 0)
            printf(" %.2f |", change);
        else
            printf(" - |");
        printf(" %.2f |\n", distance);
    }
    printf("\n");
}

static void convergence(void)
{
    /* Numerical experiments with a separate prototype of the same formulation, C_w x 1000, at the
     * speeds from the second to the last but one. */
    static const double note[LEVELS][4] = {{0.7479, 1.2293, 1.2085, 1.5983},
                                           {0.7292, 1.2151, 1.2156, 1.5945},
                                           {0.7237, 1.2116, 1.2157, 1.5939},
                                           {0.7239, 1.2060, 1.2160, 1.5944},
                                           {0.7220, 1.2051, 1.2162, 1.5946}};
    double cw[LEVELS][SPEEDS];
    size_t dofs[LEVELS];
    printf("### Convergence, B/L 0.1, T/L 0.0625\n\n"
           "C_w x 1000 with the line term not limited (sharp stem), t_c = 6.1; in brackets a "
           "separate prototype of the same\nformulation. The next table has the library's defaults "
           "(t_c = 1.2/nu_s = 6.12, stem limiter 2 nu_s), which lie\n1-2 %% higher; pressure and "
           "seconds are theirs.\n\n"
           "| elements | unknowns | Fr 0.25 | 0.30 | 0.35 | 0.40 | condition | pressure 0.30 | "
           "seconds |\n|---|---|---|---|---|---|---|---|---|\n");
    for (int l = 0; l < LEVELS; l++) {
        igabem_hull *hull = wigley(0.1, DRAFT, levels[l][0], levels[l][1]);
        igabem_options options[4 + SPEEDS];
        igabem_forces forces[4 + SPEEDS];
        for (int i = 0; i < SPEEDS; i++)
            options[4 + i] = at_froude(speeds[i]);
        for (int i = 0; i < 4; i++) {
            options[i] = at_froude(speeds[i + 1]);
            options[i].cutoff_angle = 6.1;
            options[i].stem_limit = INFINITY;
        }
        solve_all(hull, 4 + SPEEDS, options, forces);
        dofs[l] = forces[0].dofs;
        printf("| %d x %d | %zu |", levels[l][0], levels[l][1], dofs[l]);
        for (int i = 0; i < 4; i++)
            printf(" %.4f (%.4f) |", 1000 * forces[i].cw, note[l][i]);
        for (int i = 0; i < SPEEDS; i++)
            cw[l][i] = forces[4 + i].cw;
        double condition = forces[1].condition, pressure = forces[6].cw_pressure;
        solve_all(hull, 1, options + 6, forces);
        printf(" %.0e | %.4f | %.2f |\n", condition, 1000 * pressure, forces[0].seconds);
        igabem_hull_free(hull);
    }
    changes(cw, dofs);
}

static void cut_off(void)
{
    static const double factor[7] = {0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 2.0};
    static const double cases[6][3] = {{0.10, 0.0625, 0.25}, {0.10, 0.0625, 0.30},
                                       {0.10, 0.0625, 0.35}, {0.10, 0.0625, 0.40},
                                       {0.07, 0.0625, 0.30}, {0.15, 0.0625, 0.25}};
    printf("### Cut-off\n\nC_w over Michell's for t_c nu_s below, 40 x 8 elements, default stem "
           "limiter; the plateau around 1.2 is what makes\nthe filter harmless. Last two columns: "
           "no line term, which has no such plateau.\n\n| B/L | T/L | Fr |");
    for (int k = 0; k < 7; k++)
        printf(" %.1f |", factor[k]);
    printf(" off: 0.8 | off: 1.6 |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int c = 0; c < 6; c++) {
        igabem_hull *hull = wigley(cases[c][0], cases[c][1], 40, 8);
        igabem_options options[10];
        igabem_forces forces[10];
        for (int k = 0; k < 10; k++) {
            options[k] = at_froude(cases[c][2]);
            if (k < 7)
                options[k].cutoff_factor = factor[k];
        }
        options[7].line_term = options[8].line_term = 0;
        options[7].cutoff_factor = 0.8;
        options[8].cutoff_factor = 1.6;
        options[9].formulation = IGABEM_FORMULATION_MICHELL;
        solve_all(hull, 10, options, forces);
        printf("| %.2f | %.4f | %.2f |", cases[c][0], cases[c][1], cases[c][2]);
        for (int k = 0; k < 9; k++)
            printf(" %.3f |", forces[k].cw / forces[9].cw);
        printf("\n");
        igabem_hull_free(hull);
    }
    printf("\n");
}

/* The plateau as one figure for each Froude number. */
static void cut_off_spread(void)
{
    enum { FACTORS = 5 };
    static const double factor[FACTORS] = {0.75, 0.9, 1.05, 1.2, 1.5};
    igabem_options options[SPEEDS * FACTORS];
    igabem_forces forces[SPEEDS * FACTORS];
    igabem_hull *hull = wigley(0.1, DRAFT, 32, 8);
    for (int i = 0; i < SPEEDS * FACTORS; i++) {
        options[i] = at_froude(speeds[i / FACTORS]);
        options[i].cutoff_factor = factor[i % FACTORS];
    }
    solve_all(hull, SPEEDS * FACTORS, options, forces);
    igabem_hull_free(hull);
    printf("Largest over smallest C_w for t_c nu_s 0.75 to 1.5, B/L 0.10, 32 x 8 elements:");
    for (int i = 0; i < SPEEDS; i++) {
        double low = INFINITY, high = 0.0;
        for (int k = 0; k < FACTORS; k++) {
            low = fmin(low, forces[FACTORS * i + k].cw);
            high = fmax(high, forces[FACTORS * i + k].cw);
        }
        printf("%s Fr %.2f %.1f %%", i ? "," : "", speeds[i], 100.0 * (high / low - 1.0));
    }
    printf(".\n\n");
}

static void thin_limit(void)
{
    static const double beams[6] = {0.1, 0.05, 0.02, 0.01, 0.005, 0.0025};
    static const double froude[4] = {0.25, 0.30, 0.35, 0.40};
    double ratio[6][4], pressure[6][4];
    printf(
        "### Thin limit\n\nC_w over Michell's by Kochin function (by pressure), 32 x 8 elements, "
        "defaults. Extrapolated: linearly in the beam from the last\ntwo rows, exact value 1. The "
        "two C_w differ in proportion to the beam (theory.md, section 10).\n\n"
        "| B/L | Fr 0.25 | 0.30 | 0.35 | 0.40 |\n|---|---|---|---|---|\n");
    for (int b = 0; b < 6; b++) {
        igabem_hull *hull = wigley(beams[b], DRAFT, 32, 8);
        igabem_options options[8];
        igabem_forces forces[8];
        for (int i = 0; i < 4; i++) {
            options[i] = options[i + 4] = at_froude(froude[i]);
            options[i + 4].formulation = IGABEM_FORMULATION_MICHELL;
        }
        solve_all(hull, 8, options, forces);
        printf("| %.4f |", beams[b]);
        for (int i = 0; i < 4; i++) {
            ratio[b][i] = forces[i].cw / forces[i + 4].cw;
            pressure[b][i] = forces[i].cw_pressure / forces[i + 4].cw;
            printf(" %.4f (%.4f) |", ratio[b][i], pressure[b][i]);
        }
        printf("\n");
        igabem_hull_free(hull);
    }
    printf("| extrapolated |");
    for (int i = 0; i < 4; i++)
        printf(" %.4f (%.4f) |", 2 * ratio[5][i] - ratio[4][i],
               2 * pressure[5][i] - pressure[4][i]);
    printf("\n\n");
}

static void froude_sweep(void)
{
    enum { N = 26 };
    igabem_hull *hull = wigley(0.1, DRAFT, 32, 8);
    igabem_options options[4 * N];
    igabem_forces forces[4 * N];
    for (int i = 0; i < N; i++)
        for (int k = 0; k < 4; k++) {
            options[4 * i + k] = at_froude(0.20 + 0.01 * i);
            options[4 * i + k].formulation = k == 0   ? IGABEM_FORMULATION_NEUMANN_KELVIN
                                             : k == 1 ? IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN
                                             : k == 2 ? IGABEM_FORMULATION_HOGNER
                                                      : IGABEM_FORMULATION_MICHELL;
        }
    solve_all(hull, 4 * N, options, forces);
    printf("### Froude numbers\n\nC_w x 1000, 32 x 8 elements, B/L 0.1. Published for scale: thin "
           "ship at 0.35 1.2486 (Doctors and Beck 1987, second hand);\na low-order Neumann-Kelvin "
           "panel code, filtered, 1.11 at Fr 0.25 and 2.11 at 0.408.\n\n"
           "| Fr | neumann-kelvin | pressure | double-body-kochin | hogner | michell | sinkage/L x "
           "1000 | trim, degrees |\n|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < N; i++) {
        const igabem_forces *f = forces + 4 * i;
        printf("| %.2f | %.4f | %.4f | %.4f | %.4f | %.4f | %.3f | %.4f |\n", 0.20 + 0.01 * i,
               1000 * f[0].cw, 1000 * f[0].cw_pressure, 1000 * f[1].cw, 1000 * f[2].cw,
               1000 * f[3].cw, 1000 * f[0].sinkage, f[0].trim * 57.29577951308232);
    }
    printf("\n");
    igabem_hull_free(hull);
}

void wigley_section(void)
{
    printf("## Wigley hull\n\n");
    convergence();
    cut_off();
    cut_off_spread();
    thin_limit();
    froude_sweep();
}
