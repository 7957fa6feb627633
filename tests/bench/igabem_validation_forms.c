/* What the Wigley hull lacks, one thing at a time: rounded stems, flare, trim, full bows. */
#include "igabem_validation.h"
#include "wigley_forms.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double BEAM = 0.1, DRAFT = 0.0625, DEGREE = 3.14159265358979323846 / 180.0;

static igabem_hull *hull_of(nurbs_status status, nurbs_surface *surface)
{
    igabem_hull *hull;
    const nurbs_surface *list[1] = {surface};
    if (status || igabem_hull_create(list, 1, IGABEM_SYMMETRIC, &hull)) {
        fprintf(stderr, "igabem_validation: %s\n",
                status ? nurbs_last_error() : igabem_last_error());
        exit(EXIT_FAILURE);
    }
    nurbs_surface_free(surface);
    return hull;
}

static igabem_options on_mesh(double froude, int along, int around)
{
    igabem_options options = at_froude(froude);
    options.elements_u = along;
    options.elements_v = around;
    return options;
}

static void stem_table(void)
{
    static const double radius[4] = {0.0, 2e-5, 2e-4, 1e-3}, froude[2] = {0.30, 0.40};
    /* The prototype's, nu_c = 0.4, on 40 x 8 elements. */
    static const double note[4][2] = {
        {1.233, 1.605}, {1.232, 1.598}, {1.195, 1.547}, {1.182, 1.417}};
    enum { KINDS = 3 };
    printf("### Rounded stems\n\nWigley hull with stem arcs, y ~ sqrt(f^2 + 2 e f), C_w x 1000, "
           "B/L 0.1, 40 x 8 elements uniform in arccos(2x). Default: stem\nlimiter 2 nu_s, in "
           "brackets the prototype (nu_c = 0.4); then on 56 x 10 elements; then without the "
           "limiter.\n\n"
           "| radius/L | nu_s | Fr 0.30 | finer | unlimited | Fr 0.40 | finer | unlimited |\n"
           "|---|---|---|---|---|---|---|---|\n");
    for (int r = 0; r < 4; r++) {
        nurbs_surface *surface;
        nurbs_status status = rounded_wigley(BEAM, DRAFT, radius[r], &surface);
        igabem_hull *hull = hull_of(status, surface);
        igabem_options options[2 * KINDS];
        igabem_forces forces[2 * KINDS];
        igabem_hull_info info;
        igabem_hull_get_info(hull, &info);
        for (int i = 0; i < 2; i++) {
            for (int k = 0; k < KINDS; k++)
                options[KINDS * i + k] =
                    k == 1 ? on_mesh(froude[i], 56, 10) : on_mesh(froude[i], 40, 8);
            options[KINDS * i + 2].stem_limit = INFINITY;
        }
        solve_all(hull, 2 * KINDS, options, forces);
        printf("| %g | %.3f |", radius[r], info.nu_s);
        for (int i = 0; i < 2; i++)
            printf(" %.3f (%.3f) | %.3f | %.3f |", 1000 * forces[KINDS * i].cw, note[r][i],
                   1000 * forces[KINDS * i + 1].cw, 1000 * forces[KINDS * i + 2].cw);
        printf("\n");
        igabem_hull_free(hull);
    }
    printf("\n");
}

static void flare_table(void)
{
    static const double lean[5] = {-0.3, 0.0, 0.3, 0.6, 0.9}, froude[2] = {0.30, 0.40};
    printf("### Flare\n\nSections (1 - zeta^2)(1 + c zeta) of the same beam and draft, zeta = z/T: "
           "the side leans out by atan(0.8 c) at midships. C_w x 1000 on\n32 x 8 elements, in "
           "brackets its change to 48 x 12 and to 0.85 and 1.15 of the cut-off, per cent. C_w on "
           "each hull's own wetted area.\n\n"
           "| c | degrees | Fr | neumann-kelvin (finer, 0.85 t_c, 1.15 t_c) | pressure | "
           "double-body-kochin | hogner | michell |\n|---|---|---|---|---|---|---|---|\n");
    for (int l = 0; l < 5; l++) {
        nurbs_surface *surface;
        nurbs_status status = flared_wigley(BEAM, DRAFT, lean[l], &surface);
        igabem_hull *hull = hull_of(status, surface);
        for (int i = 0; i < 2; i++) {
            igabem_options options[5];
            igabem_forces f[5];
            for (int k = 0; k < 5; k++)
                options[k] = k == 4 ? on_mesh(froude[i], 48, 12) : on_mesh(froude[i], 32, 8);
            options[0].sensitivity = 1;
            options[1].formulation = IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN;
            options[2].formulation = IGABEM_FORMULATION_HOGNER;
            options[3].formulation = IGABEM_FORMULATION_MICHELL;
            solve_all(hull, 5, options, f);
            printf("| %.1f | %.0f | %.2f | %.3f (%+.1f, %+.1f, %+.1f) | %.3f | %.3f | %.3f | %.3f "
                   "|\n",
                   lean[l], atan(0.5 * BEAM * lean[l] / DRAFT) / DEGREE, froude[i], 1000 * f[0].cw,
                   100 * (f[4].cw / f[0].cw - 1), 100 * (f[0].cw_cutoff_lower / f[0].cw - 1),
                   100 * (f[0].cw_cutoff_upper / f[0].cw - 1), 1000 * f[0].cw_pressure,
                   1000 * f[1].cw, 1000 * f[2].cw, 1000 * f[3].cw);
        }
        igabem_hull_free(hull);
    }
    printf("\n");
}

static void trim_table(void)
{
    static const double trim[7] = {-0.5, -0.25, 0.0, 0.25, 0.5, 0.0, 0.0},
                        sinkage[7] = {0, 0, 0, 0, 0, 0.002, 0.004};
    static const double froude[2] = {0.30, 0.40};
    printf("### Trim and sinkage\n\nThe Wigley hull turned about midships (degrees, bow up) and "
           "sunk (over L), cut at the still water anew. C_w x 1000 on 32 x 8\nelements (change to "
           "0.85 and 1.15 of the cut-off, per cent), and over that of the hull upright. Michell's "
           "is the same for both signs of trim to first order.\n\n"
           "| trim | sinkage | Fr 0.30 | ratio | michell, ratio | Fr 0.40 | ratio | michell, ratio "
           "|\n|---|---|---|---|---|---|---|---|\n");
    double upright[2][2] = {{1, 1}, {1, 1}};
    static const int order[7] = {2, 0, 1, 3, 4, 5, 6};
    for (int c = 0; c < 7; c++) {
        int k = order[c];
        nurbs_surface *surface;
        nurbs_status status = trimmed_wigley(BEAM, DRAFT, trim[k] * DEGREE, sinkage[k], &surface);
        igabem_hull *hull = hull_of(status, surface);
        igabem_options options[4];
        igabem_forces f[4];
        if (igabem_hull_set_length(hull, 1.0))
            exit(EXIT_FAILURE);
        for (int i = 0; i < 2; i++) {
            options[2 * i] = options[2 * i + 1] = on_mesh(froude[i], 32, 8);
            options[2 * i].sensitivity = 1;
            options[2 * i + 1].formulation = IGABEM_FORMULATION_MICHELL;
        }
        solve_all(hull, 4, options, f);
        printf("| %.2f | %.3f |", trim[k], sinkage[k]);
        for (int i = 0; i < 2; i++) {
            if (c == 0) {
                upright[i][0] = f[2 * i].cw;
                upright[i][1] = f[2 * i + 1].cw;
            }
            printf(" %.3f (%+.1f, %+.1f) | %.3f | %.3f |", 1000 * f[2 * i].cw,
                   100 * (f[2 * i].cw_cutoff_lower / f[2 * i].cw - 1),
                   100 * (f[2 * i].cw_cutoff_upper / f[2 * i].cw - 1), f[2 * i].cw / upright[i][0],
                   f[2 * i + 1].cw / upright[i][1]);
        }
        printf("\n");
        igabem_hull_free(hull);
    }
    printf("\n");
}

static void full_bow_table(void)
{
    static const double factor[6] = {0.75, 0.9, 1.05, 1.2, 1.35, 1.5};
    static const double beam[4] = {0.15, 0.20, 0.25, 0.30};
    printf(
        "### Full bows\n\nWigley hulls of more and more beam, Fr 0.30, 32 x 8 elements: C_w over "
        "Michell's for t_c nu_s below. Beyond nu_s = 0.35 `igabem check`\nand `igabem solve` "
        "warn: there is no plateau to read a C_w from.\n\n| B/L | nu_s |");
    for (int k = 0; k < 6; k++)
        printf(" %.2f |", factor[k]);
    printf(" spread, per cent | condition at 1.2 | hogner | double-body-kochin "
           "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int b = 0; b < 4; b++) {
        nurbs_surface *surface;
        nurbs_status status = flared_wigley(beam[b], DRAFT, 0.0, &surface);
        igabem_hull *hull = hull_of(status, surface);
        igabem_options options[9];
        igabem_forces f[9];
        igabem_hull_info info;
        igabem_hull_get_info(hull, &info);
        for (int k = 0; k < 9; k++) {
            options[k] = on_mesh(0.30, 32, 8);
            if (k < 6)
                options[k].cutoff_factor = factor[k];
        }
        options[6].formulation = IGABEM_FORMULATION_MICHELL;
        options[7].formulation = IGABEM_FORMULATION_HOGNER;
        options[8].formulation = IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN;
        solve_all(hull, 9, options, f);
        double low = INFINITY, high = 0.0;
        printf("| %.2f | %.3f |", beam[b], info.nu_s);
        for (int k = 0; k < 6; k++) {
            low = fmin(low, f[k].cw);
            high = fmax(high, f[k].cw);
            printf(" %.3f |", f[k].cw / f[6].cw);
        }
        printf(" %.0f | %.0e | %.3f | %.3f |\n", 100 * (high / low - 1), f[3].condition,
               f[7].cw / f[6].cw, f[8].cw / f[6].cw);
        igabem_hull_free(hull);
    }
    printf("\n");
}

void forms_section(void)
{
    printf("## Relatives of the Wigley hull\n\n");
    stem_table();
    flare_table();
    trim_table();
    full_bow_table();
}
