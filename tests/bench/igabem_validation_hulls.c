/* Two more hulls with a transom, one of them with a bulb: what the DTMB 5415 section asks of the
 * default formulation, asked of them. */
#include "igabem_validation.h"

#include <math.h>
#include <stdio.h>

static const double TO_DEGREES = 57.29577951308232;

enum { LEVELS = 4, SPREAD_LEVEL = 1, SPEEDS = 3, VARIANTS = 6 };

static const int sweep_mesh[2] = {24, 8};
static const int meshes[LEVELS][2] = {{32, 10}, {40, 12}, {56, 16}, {80, 22}};
static const double speeds[SPEEDS] = {0.28, 0.35, 0.41};

/* What the defaults are varied by: t_c nu_s, and x_s - x_aft over what the rule gives. */
static const struct {
    double cutoff_factor, stern;
} variants[VARIANTS] = {{1.2, 1.0}, {0.75, 1.0}, {0.9, 1.0}, {1.5, 1.0}, {1.2, 0.8}, {1.2, 1.2}};

static igabem_options on_mesh(double froude, const int mesh[2])
{
    igabem_options options = at_froude(froude);
    options.elements_u = mesh[0];
    options.elements_v = mesh[1];
    return options;
}

/* Largest over smallest of the first (the default) and of first..last, less 1, per cent. */
static double spread(const igabem_forces *forces, int first, int last)
{
    double low = forces[0].cw, high = low;
    for (int k = first; k <= last; k++) {
        low = fmin(low, forces[k].cw);
        high = fmax(high, forces[k].cw);
    }
    return 100.0 * (high / low - 1.0);
}

void transom_hull_table(const igabem_hull *hull)
{
    igabem_forces forces[LEVELS][SPEEDS * VARIANTS];
    for (int l = 0; l < LEVELS; l++) {
        igabem_options options[SPEEDS * VARIANTS];
        size_t n = 0;
        for (int s = 0; s < SPEEDS; s++)
            for (int k = 0; k < VARIANTS; k++) {
                if (k > 0 && l != SPREAD_LEVEL)
                    continue;
                igabem_options rule = on_mesh(speeds[s], meshes[l]);
                rule.cutoff_factor = variants[k].cutoff_factor;
                options[n] = rule;
                if (variants[k].stern != 1.0 && igabem_options_freeze(hull, &rule) == IGABEM_OK)
                    options[n].stern_length = variants[k].stern * rule.stern_length;
                n++;
            }
        solve_all(hull, n, options, forces[l]);
    }
    printf("| Fr | %zu | %zu | %zu | %zu unknowns | change | t_c nu_s 0.75-1.5 | x_s +-20 %% | "
           "pressure | condition | sinkage/L x 1000 | trim, degrees |\n"
           "|---|---|---|---|---|---|---|---|---|---|---|---|\n",
           forces[0][0].dofs, forces[1][0].dofs, forces[2][0].dofs, forces[3][0].dofs);
    for (int s = 0; s < SPEEDS; s++) {
        const igabem_forces *f = &forces[LEVELS - 1][s];
        const igabem_forces *before = &forces[LEVELS - 2][s];
        const igabem_forces *varied = &forces[SPREAD_LEVEL][s * VARIANTS];
        printf("| %.2f | %.3f | %.3f | %.3f | %.3f | %+.1f %% | %.1f %% | %.1f %% | %.3f | %.0e | "
               "%.3f | %.3f |\n",
               speeds[s], 1000 * forces[0][s].cw, 1000 * varied->cw, 1000 * before->cw,
               1000 * f->cw, 100 * (f->cw / before->cw - 1), spread(varied, 1, 3),
               spread(varied, 4, 5), 1000 * f->cw_pressure, f->condition, 1000 * f->sinkage,
               TO_DEGREES * f->trim);
    }
    printf("\n");
}

/* Places of the humps of n values, those inside the range that exceed both neighbours. */
static void print_humps(size_t n, const double *froude, const double *cw)
{
    int any = 0;
    for (size_t i = 1; i + 1 < n; i++)
        if (cw[i] > cw[i - 1] && cw[i] > cw[i + 1]) {
            printf(any ? ", %.2f" : "%.2f", froude[i]);
            any = 1;
        }
    if (!any)
        printf("none");
}

static void froude_numbers(const igabem_hull *hull)
{
    enum { N = 26, KINDS = 4 };
    static const igabem_formulation kinds[KINDS] = {
        IGABEM_FORMULATION_AUTO, IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN, IGABEM_FORMULATION_HOGNER,
        IGABEM_FORMULATION_MICHELL};
    igabem_options options[N * KINDS];
    igabem_forces forces[N * KINDS];
    double froude[N], cw[3][N], worst = 0.0, worst_at = 0.0;
    for (int i = 0; i < N; i++)
        for (int k = 0; k < KINDS; k++) {
            igabem_options *o = &options[KINDS * i + k];
            froude[i] = 0.20 + 0.01 * i;
            *o = on_mesh(froude[i], sweep_mesh);
            o->formulation = kinds[k];
            o->sensitivity = k == 0;
        }
    solve_all(hull, (size_t)N * KINDS, options, forces);
    printf("C_w x 1000, %zu unknowns:\n\n| Fr | default | 0.85 t_c | 1.15 t_c | pressure | "
           "double-body-kochin | hogner | michell |\n"
           "|---|---|---|---|---|---|---|---|\n",
           forces[0].dofs);
    for (int i = 0; i < N; i++) {
        const igabem_forces *f = forces + KINDS * i;
        cw[0][i] = f[0].cw;
        cw[1][i] = f[0].cw_cutoff_lower;
        cw[2][i] = f[0].cw_cutoff_upper;
        printf("| %.2f | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f |\n", froude[i],
               1000 * cw[0][i], 1000 * cw[1][i], 1000 * cw[2][i], 1000 * f[0].cw_pressure,
               1000 * f[1].cw, 1000 * f[2].cw, 1000 * f[3].cw);
        for (int k = 1; k < 3; k++) {
            double change = 100.0 * (cw[k][i] / cw[0][i] - 1.0);
            if (fabs(change) > fabs(worst)) {
                worst = change;
                worst_at = froude[i];
            }
        }
    }
    printf("\nHumps of the default, at 0.85 and at 1.15 t_c: Fr ");
    for (int k = 0; k < 3; k++) {
        print_humps(N, froude, cw[k]);
        printf(k < 2 ? "; " : ". ");
    }
    printf("Largest change by the cut-off: %+.1f %% at Fr %.2f.\n\n", worst, worst_at);
}

static void hull_report(const char *name, const char *text)
{
    char path[512];
    snprintf(path, sizeof path, EXAMPLES_DIR "/hulls/%s.json", name);
    igabem_hull *hull = hull_file(path, 1e-4);
    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    const nurbs_hydrostatics *h = &info.hydrostatics;
    printf("### %s.json: %s\n\nL %.4g, waterline %.4g, beam %.4g, draft %.4g, volume %.5g, wetted "
           "area %.5g, transom %.2f of the largest section, nu_s %.3f.\n\n",
           name, text, info.length, h->x_fore - h->x_aft, h->beam, h->keel_draft, h->volume,
           h->wetted_area, h->transom_area / h->section_area_max, info.nu_s);
    transom_hull_table(hull);
    froude_numbers(hull);
    igabem_hull_free(hull);
}

void hulls_section(void)
{
    printf(
        "## Other transom hulls\n\nOf this project's own making (examples/hulls), default "
        "formulation. C_w x 1000 by Kochin function; the change is that between "
        "the last two\nlevels, the spreads are those of the second, pressure and the rest those of "
        "the finest.\n\n");
    hull_report("fast", "wide immersed transom, no bulb");
    hull_report("bulb", "bulb and narrow transom");
}
