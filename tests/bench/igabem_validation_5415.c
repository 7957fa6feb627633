/* The DTMB 5415 at model scale. */
#include "igabem_validation.h"

#include <math.h>
#include <stdio.h>

static const double LENGTH = 5.72, GRAVITY = 9.803;

static igabem_options model_scale(double froude, igabem_formulation formulation,
                                  const int elements[2])
{
    igabem_options options = at_froude(froude);
    options.gravity = GRAVITY;
    options.formulation = formulation;
    options.elements_u = elements[0];
    options.elements_v = elements[1];
    return options;
}

static void particulars(const igabem_hull *hull)
{
    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    const nurbs_hydrostatics *h = &info.hydrostatics;
    printf("| | here | grid, bicubic refinement | paper, Table 1 |\n|---|---|---|---|\n"
           "| displacement, m^3 | %.5f | 0.55349 | 0.549 |\n"
           "| wetted area without transom, m^2 | %.4f | 4.850 | |\n"
           "| centre of buoyancy aft of FP, m | %.4f | 2.8896 | 2.884 |\n"
           "| beam at the waterline, m | %.4f | 0.7691 | 0.760 |\n"
           "| keel draft, m | %.4f | 0.2481 | 0.248 |\n"
           "| waterplane area, m^2 | %.4f | 3.4003 | |\n"
           "| nu_s | %.4f | 0.243 | |\n\n",
           h->volume, h->wetted_area, LENGTH - h->centroid[0], h->beam, h->keel_draft,
           h->waterplane_area, info.nu_s);
}

static void published(void)
{
    printf(
        "Published and other computations of this hull at Fr 0.35, C_w x 1000:\n\n"
        "| source | method | C_w x 1000 |\n|---|---|---|\n"
        "| Khan, Kaklis, Kostas, Serani, Diez | isogeometric Neumann-Kelvin | 0.915 |\n"
        "| L2-Sea panel code, finest grid run | double model, pressure (extrapolated 1.02-1.06) | "
        "1.08 |\n"
        "| L2-Sea panel code, finest grid run | double model, wave cut | 1.75 |\n"
        "| L2-Sea panel code | Neumann-Kelvin, wave cut | 1.49 |\n"
        "| L2-Sea panel code | Neumann-Kelvin, pressure (does not converge) | 3.46 |\n"
        "| prototype of neumann-kelvin-stern, x_s 1.5-2 m | C_w by Kochin function | 1.59-1.63 |\n"
        "| prototype of neumann-kelvin | no plateau in the cut-off | 1.8-3.0 |\n"
        "| Michell, offsets of the grid | | 1.747 |\n\n"
        "No figure of another program was used to set anything here. x_s and the stem limiter are "
        "the "
        "prototype's, which picked them on\nthis hull for their plateau in the cut-off, after "
        "seeing "
        "its results. The two resistances of the panel code differ by 62 %%.\n\n");
}

static double stern_length(const igabem_hull *hull, double x_s)
{
    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    return (x_s - info.hydrostatics.x_aft) / info.length;
}

enum { VARIANTS = 16 };

static size_t variants(const igabem_hull *hull, double froude, const int elements[2],
                       igabem_options *o, const char **names)
{
    static const struct {
        const char *name;
        igabem_formulation formulation;
        int line_term;
        double factor, x_s;
    } list[VARIANTS] = {
        {"neumann-kelvin-stern (default)", IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1, 1.2, 0},
        {"the same, t_c nu_s 0.75", IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1, 0.75, 0},
        {"the same, t_c nu_s 0.9", IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1, 0.9, 0},
        {"the same, t_c nu_s 1.5", IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1, 1.5, 0},
        {"the same, x_s 1.0 m", IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1, 1.2, 1.0},
        {"the same, x_s 1.5 m", IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1, 1.2, 1.5},
        {"the same, x_s 2.5 m", IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1, 1.2, 2.5},
        {"the same, no line term", IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 0, 1.2, 0},
        {"neumann-kelvin, t_c nu_s 1.2", IGABEM_FORMULATION_NEUMANN_KELVIN, 1, 1.2, 0},
        {"the same, t_c nu_s 0.75", IGABEM_FORMULATION_NEUMANN_KELVIN, 1, 0.75, 0},
        {"the same, no line term", IGABEM_FORMULATION_NEUMANN_KELVIN, 0, 1.2, 0},
        {"double-body-kochin", IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN, 1, 1.2, 0},
        {"the same, no line term", IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN, 0, 1.2, 0},
        {"hogner", IGABEM_FORMULATION_HOGNER, 1, 1.2, 0},
        {"the same, no line term", IGABEM_FORMULATION_HOGNER, 0, 1.2, 0},
        {"michell", IGABEM_FORMULATION_MICHELL, 1, 1.2, 0},
    };
    for (size_t k = 0; k < VARIANTS; k++) {
        o[k] = model_scale(froude, list[k].formulation, elements);
        o[k].line_term = list[k].line_term;
        o[k].cutoff_factor = list[k].factor;
        if (list[k].x_s > 0)
            o[k].stern_length = stern_length(hull, list[k].x_s);
        names[k] = list[k].name;
    }
    return VARIANTS;
}

/* What the finest levels say about the default: mesh, cut-off (rows 0 to 3), x_s (0, 4 to 6). */
static void print_spreads(const igabem_forces *coarse, const igabem_forces *fine)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {0, 0};
    for (int k = 0; k < 7; k++) {
        int first = k == 0 ? 0 : k > 3, last = k == 0 ? 1 : k > 3;
        for (int set = first; set <= last; set++) {
            low[set] = fmin(low[set], fine[k].cw);
            high[set] = fmax(high[set], fine[k].cw);
        }
    }
    printf(
        "Of the default, neumann-kelvin-stern, on the finest level: change from the level before "
        "%+.1f %%; spread over t_c nu_s\n0.75 to 1.5 %.1f %%, over x_s 1 to 2.5 m %.1f %%; "
        "pressure against Kochin %+.1f %%.\n\n",
        100 * (fine[0].cw / coarse[0].cw - 1), 100 * (high[0] / low[0] - 1),
        100 * (high[1] / low[1] - 1), 100 * (fine[0].cw_pressure / fine[0].cw - 1));
}

static void formulations(const char *file)
{
    enum { LEVELS = 4 };
    static const int elements[LEVELS][2] = {{24, 8}, {32, 10}, {40, 12}, {56, 16}};
    igabem_options options[VARIANTS];
    igabem_forces forces[LEVELS][VARIANTS];
    const char *names[VARIANTS];
    size_t n = 0;
    igabem_hull *hull = hull_file(file, 1e-4);
    for (int l = 0; l < LEVELS; l++) {
        n = variants(hull, 0.35, elements[l], options, names);
        solve_all(hull, n, options, forces[l]);
    }
    igabem_hull_free(hull);
    printf("### Formulations at Fr 0.35\n\nC_w x 1000 by Kochin function (by pressure) on four "
           "levels: uniform knots of the density's own, 24 x 8, 32 x 10,\n40 x 12 and 56 x 16 "
           "spans, on the hull simplified within 1e-4 of its length. Default: x_s = 2.03 m, "
           "t_c nu_s = 1.2,\nstem limiter 1.2 nu_s.\n\n| formulation |");
    for (int l = 0; l < LEVELS; l++)
        printf(" %zu unknowns |", forces[l][0].dofs);
    printf(" condition |\n|---|---|---|---|---|---|\n");
    for (size_t k = 0; k < n; k++) {
        printf("| %s |", names[k]);
        for (int l = 0; l < LEVELS; l++) {
            printf(" %.3f", 1000 * forces[l][k].cw);
            if (isfinite(forces[l][k].cw_pressure))
                printf(" (%.3f)", 1000 * forces[l][k].cw_pressure);
            printf(" |");
        }
        if (isfinite(forces[LEVELS - 1][k].condition))
            printf(" %.0e", forces[LEVELS - 1][k].condition);
        printf(" |\n");
    }
    printf("\n");
    print_spreads(forces[LEVELS - 2], forces[LEVELS - 1]);
}

static void speeds(const char *file)
{
    igabem_hull *hull = hull_file(file, 1e-4);
    printf(
        "### Three speeds\n\nDefault formulation on 32 x 10, 40 x 12, 56 x 16 and 80 x 22 spans. "
        "The change is "
        "that between the last two\nlevels, the spreads are those of the second, pressure and the "
        "rest those of the finest.\n\n");
    transom_hull_table(hull);
    igabem_hull_free(hull);
}

static void froude_numbers(const char *file)
{
    enum { N = 26, KINDS = 5 };
    static const igabem_formulation kinds[KINDS] = {
        IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, IGABEM_FORMULATION_NEUMANN_KELVIN,
        IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN, IGABEM_FORMULATION_HOGNER,
        IGABEM_FORMULATION_MICHELL};
    static igabem_options options[N * KINDS];
    static igabem_forces forces[N * KINDS];
    static const int elements[2] = {32, 10};
    igabem_hull *hull = hull_file(file, 1e-4);
    for (int i = 0; i < N; i++)
        for (int k = 0; k < KINDS; k++) {
            options[KINDS * i + k] = model_scale(0.20 + 0.01 * i, kinds[k], elements);
            options[KINDS * i + k].sensitivity = k == 0;
        }
    solve_all(hull, N * KINDS, options, forces);
    printf("### Froude numbers\n\nC_w x 1000, %zu unknowns. Panel code, wave cut: Fr 0.28 1.21 "
           "(Neumann-Kelvin), 1.46 (double model).\n\n"
           "| Fr | neumann-kelvin-stern | 0.85 t_c | 1.15 t_c | pressure | neumann-kelvin | "
           "double-body-kochin | hogner | michell |\n|---|---|---|---|---|---|---|---|---|\n",
           forces[0].dofs);
    for (int i = 0; i < N; i++) {
        const igabem_forces *f = forces + KINDS * i;
        printf("| %.2f | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f |\n",
               0.20 + 0.01 * i, 1000 * f[0].cw, 1000 * f[0].cw_cutoff_lower,
               1000 * f[0].cw_cutoff_upper, 1000 * f[0].cw_pressure, 1000 * f[1].cw, 1000 * f[2].cw,
               1000 * f[3].cw, 1000 * f[4].cw);
    }
    printf("\n");
    igabem_hull_free(hull);
}

static void growth(const char *file)
{
    static const int elements[5][2] = {{16, 6}, {24, 8}, {32, 10}, {40, 12}, {56, 16}};
    printf("### Time\n\nOne solve at Fr 0.35 with the default formulation, all included; %s.\n\n"
           "| unknowns | seconds |\n|---|---|\n",
           "wall clock of the machine that wrote this page");
    for (int l = 0; l < 5; l++) {
        igabem_hull *hull = hull_file(file, 1e-4);
        igabem_options options = model_scale(0.35, IGABEM_FORMULATION_AUTO, elements[l]);
        igabem_forces forces;
        solve_all(hull, 1, &options, &forces);
        printf("| %zu | %.2f |\n", forces.dofs, forces.seconds);
        igabem_hull_free(hull);
    }
    printf("\n");
}

void dtmb5415_section(const char *file)
{
    printf("## DTMB 5415, model scale\n\nLpp 5.72 m, g 9.803 m/s^2, C_w on the wetted area of both "
           "sides without the transom.\n\n");
    igabem_hull *hull = hull_file(file, 1e-4);
    particulars(hull);
    igabem_hull_free(hull);
    published();
    formulations(file);
    speeds(file);
    froude_numbers(file);
    growth(file);
}
