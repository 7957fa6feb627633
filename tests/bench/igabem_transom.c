/* Transom hulls under the default formulation: change from mesh to mesh, spread over the cut-off
 * and over x_s, with the narrow switch and with one of 0.2 L, beside plain Neumann-Kelvin and the
 * double body. Usage: igabem_bench_transom [HULL.json...] (default: the three of examples/hulls) */
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { LEVELS = 3, SPEEDS = 3, SETTINGS = 17 };

static const int meshes[LEVELS][2] = {{24, 8}, {32, 10}, {40, 12}};
static const double speeds[SPEEDS] = {0.28, 0.35, 0.41};

static const struct setting {
    igabem_formulation formulation;
    double cutoff_factor;
    double stern; /* times the rule, or, if negative, minus the share of the length */
    double blend; /* 0: the default */
} settings[SETTINGS] = {{IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1.2, 1.0, 0.0},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 0.75, 1.0, 0.0},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 0.9, 1.0, 0.0},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1.5, 1.0, 0.0},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1.2, 0.8, 0.0},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1.2, 1.2, 0.0},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1.2, -0.28, 0.0},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1.2, -0.35, 0.0},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1.2, -0.42, 0.0},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN, 1.2, 1.0, 0.0},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN, 0.75, 1.0, 0.0},
                        {IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN, 1.2, 1.0, 0.0},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1.2, 1.0, 0.2},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 0.75, 1.0, 0.2},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1.5, 1.0, 0.2},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1.2, 0.8, 0.2},
                        {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1.2, 1.2, 0.2}};

static igabem_hull *read_hull(const char *path)
{
    nurbs_patches *file = NULL;
    nurbs_surface *wetted = NULL, *light = NULL;
    igabem_hull *hull = NULL;
    double bound;
    nurbs_status status = nurbs_patches_read(path, &file);
    double length = status ? 1.0 : nurbs_patches_length(file);
    /* a file that ends at the water is used as it is */
    if (!status &&
        nurbs_surface_wetted(nurbs_patches_get(file, 0), 0.0, 1e-5 * length, &wetted) == NURBS_OK)
        status = nurbs_surface_simplify(wetted, 1e-4 * length,
                                        NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_KEEP_KINKS,
                                        &light, &bound);
    else if (!status)
        status = nurbs_surface_copy(nurbs_patches_get(file, 0), &light);
    if (status || igabem_hull_create((const nurbs_surface *const *)&light, 1, IGABEM_SYMMETRIC,
                                     &hull) != IGABEM_OK)
        fprintf(stderr, "%s: %s %s\n", path, nurbs_last_error(), igabem_last_error());
    else
        igabem_hull_set_length(hull, length);
    nurbs_surface_free(light);
    nurbs_surface_free(wetted);
    nurbs_patches_free(file);
    return hull;
}

static void fill(const igabem_hull *hull, int level, igabem_options options[SPEEDS * SETTINGS])
{
    for (int k = 0; k < SPEEDS * SETTINGS; k++) {
        const struct setting *setting = &settings[k % SETTINGS];
        igabem_options *o = &options[k];
        igabem_options_init(o);
        o->refine = 1;
        o->froude = speeds[k / SETTINGS];
        o->formulation = setting->formulation;
        o->cutoff_factor = setting->cutoff_factor;
        if (setting->blend > 0)
            o->stern_blend = setting->blend;
        o->elements_u = meshes[level][0];
        o->elements_v = meshes[level][1];
        igabem_options rule = *o;
        if (igabem_options_freeze(hull, &rule) == IGABEM_OK)
            o->stern_length =
                setting->stern < 0 ? -setting->stern : setting->stern * rule.stern_length;
    }
}

static int solve_level(const igabem_hull *hull, int level, igabem_forces forces[SPEEDS * SETTINGS])
{
    igabem_options options[SPEEDS * SETTINGS];
    igabem_solution *solutions[SPEEDS * SETTINGS];
    fill(hull, level, options);
    int ok = igabem_solve_many(hull, SPEEDS * SETTINGS, options, solutions) == IGABEM_OK;
    for (int k = 0; k < SPEEDS * SETTINGS; k++) {
        ok = ok && igabem_forces_compute(solutions[k], &forces[k]) == IGABEM_OK;
        igabem_solution_free(solutions[k]);
    }
    return ok;
}

/* Largest over smallest of the settings first to last and of the base setting, less 1, in %. */
static double spread(const igabem_forces *f, int base, int first, int last)
{
    double low = f[base].cw, high = low;
    for (int k = first; k <= last; k++) {
        low = fmin(low, f[k].cw);
        high = fmax(high, f[k].cw);
    }
    return 100.0 * (high / low - 1.0);
}

static int report(const char *path)
{
    igabem_forces forces[LEVELS][SPEEDS * SETTINGS];
    igabem_hull *hull = read_hull(path);
    int ok = hull != NULL;
    for (int level = 0; ok && level < LEVELS; level++)
        ok = solve_level(hull, level, forces[level]);
    igabem_hull_free(hull);
    if (!ok) {
        fprintf(stderr, "%s: %s\n", path, igabem_last_error());
        return 0;
    }
    printf("%s\n  Fr    C_w x 1000 at %zu, %zu, %zu unknowns  change | t_c: %%  x_s: %%  0.35 L: %%"
           " | pressure  condition | neumann-kelvin  t_c: %%  double body | switch 0.2 L  t_c: %%"
           "  x_s: %%\n",
           path, forces[0][0].dofs, forces[1][0].dofs, forces[2][0].dofs);
    for (int s = 0; s < SPEEDS; s++) {
        const igabem_forces *f = &forces[LEVELS - 1][s * SETTINGS];
        printf("  %.2f", speeds[s]);
        for (int level = 0; level < LEVELS; level++)
            printf("  %.4f", 1000 * forces[level][s * SETTINGS].cw);
        printf("  %+.1f %% | %.1f  %.1f  %.1f | %.4f  %.0e | %.4f  %.1f  %.4f | %.4f  %.1f  %.1f\n",
               100 * (f[0].cw / forces[LEVELS - 2][s * SETTINGS].cw - 1), spread(f, 0, 1, 3),
               spread(f, 0, 4, 5), spread(f, 7, 6, 8), 1000 * f[0].cw_pressure, f[0].condition,
               1000 * f[9].cw, spread(f, 9, 10, 10), 1000 * f[11].cw, 1000 * f[12].cw,
               spread(f, 12, 13, 14), spread(f, 12, 15, 16));
    }
    fflush(stdout);
    return 1;
}

int main(int argc, char **argv)
{
    static const char *const files[] = {EXAMPLES_DIR "/hulls/dtmb5415.json",
                                        EXAMPLES_DIR "/hulls/fast.json",
                                        EXAMPLES_DIR "/hulls/bulb.json"};
    int n = argc > 1 ? argc - 1 : 3, ok = 1;
    for (int k = 0; k < n; k++)
        ok &= report(argc > 1 ? argv[k + 1] : files[k]);
    return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
