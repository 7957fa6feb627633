#include "cli.h"
#include "constants.h"
#include "solve.h"

#include <math.h>
#include <string.h>

static void print_hull(const struct solve_run *run)
{
    const nurbs_hydrostatics *h = &run->info.hydrostatics;
    printf("hull        %s (%s)\n", run->request->hull.path, run->input->note);
    printf("            L %.5g m, S %.5g m^2, V %.5g m^3, %s, %s\n", run->info.length,
           h->wetted_area, h->volume, run->info.surface_piercing ? "surface-piercing" : "submerged",
           hull_stern(&run->info));
    if (run->input->simplify_bound > 0)
        printf("            simplified within %.3g m\n", run->input->simplify_bound);
}

/* The formulation with every length and angle that went into the number. */
static void print_settings(const struct solve_run *run, const struct solve_result *result)
{
    const igabem_options *o = &result->options;
    const igabem_forces *f = &result->forces;
    const igabem_formulation_row *formulation = igabem_formulation_info(o->formulation);
    bool line = o->line_term && run->info.surface_piercing && formulation->line_term;
    if (o->kernel != IGABEM_KERNEL_KELVIN) {
        printf("  %s: no waves\n", o->kernel == IGABEM_KERNEL_RANKINE
                                       ? "kernel rankine, unbounded water"
                                       : "kernel double-body, rigid still water");
        return;
    }
    if (formulation->potential)
        printf("  %s: free surface of %g x %g cells beside the hull, %.3g, %.3g and %.3g lengths "
               "ahead, "
               "aft and aside",
               formulation->name, o->surface_cells, o->surface_rows, o->surface_upstream,
               o->surface_downstream, o->surface_side);
    else
        printf("  %s: line term %s", formulation->name, line ? "on" : "off");
    if (line)
        printf(", stem limit %.4g", o->stem_limit);
    if (run->info.surface_piercing && formulation->kelvin_rows) {
        if (isfinite(o->cutoff_angle) && f->k0 > 0)
            printf(", filter t_c %.4g = %.3g/nu_s (shortest wave %.3g m)", o->cutoff_angle,
                   o->cutoff_angle * run->info.nu_s,
                   2 * PI / (f->k0 * (1.0 + o->cutoff_angle * o->cutoff_angle)));
        else
            printf(", no filter");
    }
    if (run->info.surface_piercing)
        printf(", nu_s %.4g", run->info.nu_s);
    if (formulation->stern_rows)
        printf(", x_s %.4g m", run->info.hydrostatics.x_aft + o->stern_length * run->info.length);
    if (f->iterations > 0)
        printf(", GMRES %zu iterations", f->iterations);
    printf("\n");
}

/* A number of a column, "-" where the formulation has none. */
static void print_column(const char *format, int width, double value)
{
    if (isfinite(value))
        printf(format, width, value);
    else
        printf(" %*s", width, "-");
}

static void print_result(const struct solve_run *run, const struct solve_result *result)
{
    const igabem_forces *f = &result->forces;
    printf("%-7.4g %-20s %6zu", result->options.froude,
           igabem_formulation_name(result->options.formulation), f->dofs);
    print_column(" %*.4e", 11, f->cw);
    print_column(" %*.4e", 11, f->cw_pressure);
    print_column(" %*.4e", 11, f->cw_l2);
    print_column(" %*.4g", 9, f->rw);
    print_column(" %*.1e", 9, f->condition);
    print_column(" %*.2f", 7, f->seconds);
    printf("\n");
    if (result->refused) {
        printf("  refused: %s\n", *result->warning);
        return;
    }
    print_settings(run, result);
    if (f->cost.rankine > 0)
        printf(
            "  quadrature: %zu singular, %zu near, %zu far pairs; %.3g evaluations of 1/r, %.3g of "
            "N, %.3g of waves\n",
            f->cost.singular_pairs, f->cost.near_pairs, f->cost.far_pairs, (double)f->cost.rankine,
            (double)f->cost.local, (double)f->cost.wave);
    if (isfinite(f->cw_cutoff_lower) || isfinite(f->cw_cutoff_upper))
        printf("  C_w at 0.85 t_c %.4e, at 1.15 t_c %.4e; %.2g %% of it from beyond t_c\n",
               f->cw_cutoff_lower, f->cw_cutoff_upper, 100.0 * f->share_beyond_cutoff);
    else if (f->share_beyond_cutoff > 0)
        printf("  %.2g %% of C_w from beyond t_c\n", 100.0 * f->share_beyond_cutoff);
    if (isfinite(f->cw_error))
        printf("  discretisation error of C_w about %.2g %%\n", 100.0 * f->cw_error / f->cw);
    if (isfinite(f->cw_pressure_linear)) {
        printf("  C_w by pressure without the quadratic and run-up terms %.4e",
               f->cw_pressure_linear);
        if (run->info.surface_piercing)
            printf("; run-up %.4e", f->cw_run_up);
        printf("\n");
    }
    if (isfinite(f->cw_transom))
        printf("  a dry transom adds %.4e to C_w by pressure\n", f->cw_transom);
    if (isfinite(f->cw_momentum))
        printf("  C_w by the momentum of the water %.4e\n", f->cw_momentum);
    if (isfinite(result->cw_cut))
        printf("  C_w by a longitudinal wave cut %.4e\n", result->cw_cut);
    if (isfinite(result->share[0]))
        printf("  shares of the fore, middle and aft third: %.3g, %.3g, %.3g %%\n",
               100.0 * result->share[0], 100.0 * result->share[1], 100.0 * result->share[2]);
    if (isfinite(f->sinkage))
        printf("  sinkage %.4g m, trim %.4g deg (bow up positive)\n", f->sinkage,
               f->trim * (180 / PI));
    if (result->options.kernel == IGABEM_KERNEL_KELVIN) {
        igabem_total total;
        solve_run_total(run, result, &total);
        printf("  ITTC-57 C_f %.4e, C_t %.4e, R_t %.5g N at U %.4g m/s\n", total.cf, total.ct,
               total.rt, f->speed);
    }
}

static void print_ladder(const struct solve_run *run, size_t c)
{
    const struct solve_result *first = solve_run_result(run, 0, c);
    printf("\nrefinement at Fr %g, %s\nrefine unknowns         C_w    change   order  Richardson "
           "seconds\n",
           first->options.froude, igabem_formulation_name(first->options.formulation));
    for (size_t level = 0; level < run->levels; level++) {
        const struct solve_result *result = solve_run_result(run, level, c);
        const igabem_forces *f = &result->forces;
        double order, limit;
        solve_run_order(run, level, c, &order, &limit);
        printf("%6d %8zu %11.5e ", result->refine, f->dofs, f->cw);
        if (level > 0)
            printf("%8.3f%% ",
                   100.0 * (f->cw / solve_run_result(run, level - 1, c)->forces.cw - 1.0));
        else
            printf("%9s ", "");
        if (isfinite(order))
            printf("%7.2f %11.5e", order, limit);
        else
            printf("%7s %11s", "", "");
        printf(" %7.2f\n", f->seconds);
    }
}

/* Spread of the formulations at each Froude number: the uncertainty that a user sees. The first of
 * them is the default. */
static void print_spread(const struct solve_run *run)
{
    size_t per_fr = run->cases / run->request->n_fr;
    printf("\nuncertainty of the theory: C_w over the formulations that answer\n"
           "Fr      default     lowest                          highest\n");
    for (size_t i = 0; i < run->request->n_fr; i++) {
        const struct solve_result *first = solve_run_result(run, run->levels - 1, i * per_fr);
        const struct solve_result *low = first, *high = first;
        for (size_t k = 1; k < per_fr; k++) {
            const struct solve_result *other = first + k;
            if (other->forces.cw < low->forces.cw)
                low = other;
            if (other->forces.cw > high->forces.cw)
                high = other;
        }
        double base = first->forces.cw;
        printf("%-7.4g %.4e  %.4e %+4.0f %% %-20s %.4e %+4.0f %% %s\n", run->request->fr[i], base,
               low->forces.cw, 100.0 * (low->forces.cw / base - 1.0),
               igabem_formulation_name(low->options.formulation), high->forces.cw,
               100.0 * (high->forces.cw / base - 1.0),
               igabem_formulation_name(high->options.formulation));
    }
}

int solve_print_table(const struct solve_run *run)
{
    print_hull(run);
    printf("\n%-7s %-20s %6s %11s %11s %11s %9s %9s %7s\n", "Fr", "formulation", "dofs", "C_w",
           "C_w press.", "C_w (L^2)", "R_w N", "condition", "seconds");
    for (size_t c = 0; c < run->cases; c++)
        print_result(run, solve_run_result(run, run->levels - 1, c));
    if (run->request->all)
        print_spread(run);
    for (size_t c = 0; run->levels > 1 && c < run->cases; c++)
        if (!solve_run_result(run, run->levels - 1, c)->refused)
            print_ladder(run, c);
    return cli_printed();
}
