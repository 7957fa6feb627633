/* igabem solve: Froude numbers x formulations x levels of refinement on one hull. */
#include "solve.h"

#include "cli.h"
#include "commands.h"
#include "equilibrium.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const struct solve_result *solve_run_result(const struct solve_run *run, size_t level, size_t c)
{
    return &run->results[level * run->cases + c];
}

double ittc57_friction(double reynolds)
{
    if (!(reynolds > 1000.0))
        return NAN;
    double d = log10(reynolds) - 2.0;
    return 0.075 / (d * d);
}

/* The exponent p of c_k = c + a h_k^p through three levels: with h = 1/refine,
 * (c1 - c2)/(c2 - c3) = (h1^p - h2^p)/(h2^p - h3^p), which grows with p; bisection. */
void solve_observed_order(const struct solve_ladder *ladder, size_t upto, double *order,
                          double *limit)
{
    *order = *limit = NAN;
    if (upto < 3 || upto > ladder->n)
        return;
    double c[3], h[3];
    for (size_t k = 0; k < 3; k++) {
        const struct solve_result *level = ladder->level[upto - 3 + k];
        c[k] = level->forces.cw;
        h[k] = 1.0 / level->refine;
    }
    double ratio = (c[0] - c[1]) / (c[1] - c[2]);
    double low = 0.01, high = 20.0;
    for (int i = 0; i < 200; i++) {
        double p = 0.5 * (low + high);
        double model = (pow(h[0], p) - pow(h[1], p)) / (pow(h[1], p) - pow(h[2], p));
        if (!(model > ratio))
            low = p;
        else
            high = p;
    }
    if (!isfinite(ratio) || low < 0.02 || high > 19.9)
        return;
    double p = 0.5 * (low + high);
    *order = p;
    *limit = c[2] + (c[2] - c[1]) / (pow(h[1] / h[2], p) - 1.0);
}

enum { MOST_FORMULATIONS = 16 };

/* Formulations of a run; of all of them the one for hulls like this is the first. Fills
 * list[MOST_FORMULATIONS], returns their number. */
static size_t formulations(const struct solve_request *request, const igabem_hull_info *info,
                           igabem_formulation *list)
{
    const igabem_formulation_row *row;
    size_t n = 0;
    if (!request->all) {
        list[n++] = request->options.formulation;
        return n;
    }
    for (int stern = info->transom != IGABEM_TRANSOM_NONE; stern >= 0; stern--)
        for (igabem_formulation f = IGABEM_FORMULATION_AUTO + 1;
             (row = igabem_formulation_info(f)) && n < MOST_FORMULATIONS; f++)
            if (row->stern_rows == (stern == 1))
                list[n++] = f;
    return n;
}

static int report_progress(void *data, double fraction)
{
    cli_progress_update(data, fraction, NULL);
    return 0;
}

/* Parts per span on a level: each level is half as fine again as the one before, at least by one.
 */
static int refine_on_level(int first, size_t level)
{
    int parts = first;
    for (size_t k = 1; k <= level; k++) {
        int next = (int)lround(first * pow(1.5, (double)k));
        parts = next > parts ? next : parts + 1;
    }
    return parts;
}

/* Settings of all cases of one level: Froude numbers slow, formulations fast. */
static void fill_options(const struct solve_run *run, size_t level, igabem_options *options)
{
    const struct solve_request *request = run->request;
    igabem_formulation list[MOST_FORMULATIONS];
    size_t n = formulations(request, &run->info, list);
    for (size_t c = 0; c < run->cases; c++) {
        options[c] = request->options;
        options[c].froude = request->fr[c / n];
        options[c].formulation = list[c % n];
        options[c].refine = refine_on_level(request->options.refine, level);
        if (request->options.refine_v > 0)
            options[c].refine_v = refine_on_level(request->options.refine_v, level);
        if (!isnan(request->x_s))
            options[c].stern_length =
                fmax(0.0, (request->x_s - run->info.hydrostatics.x_aft) / run->info.length);
    }
}

static int write_files(const struct solve_run *run, const igabem_solution *solution)
{
    const struct solve_request *request = run->request;
    int code = CLI_OK;
    if (request->vtu)
        code = solve_write_vtu(solution, run->input, request->vtu);
    if (code == CLI_OK && request->waves)
        code = solve_write_waves(solution, run, request->waves);
    if (code == CLI_OK && request->pressure_plot)
        code = solve_write_pressure(solution, run, request->pressure_plot);
    if (code == CLI_OK && request->spectrum)
        code = solve_write_spectrum(solution, request->spectrum);
    return code;
}

/* Where the waves come from and what a wave cut says; thirds of the extent of the hull. */
static igabem_status survey(const struct solve_run *run, const igabem_solution *solution,
                            struct solve_result *result)
{
    const nurbs_hydrostatics *h = &run->info.hydrostatics;
    const double third = (h->x_fore - h->x_aft) / 3.0;
    const double limit[2] = {h->x_fore - third, h->x_aft + third};
    igabem_status status = igabem_wave_shares(solution, 2, limit, result->share);
    if (status)
        return status;
    if (!igabem_formulation_info(result->options.formulation)->solves || !run->input->half)
        return IGABEM_OK;
    return igabem_wave_cut(solution, NAN, &result->cw_cut);
}

/* Coefficients on the wetted area at rest, and the attitude that the hull was solved in. */
static void refer_to_rest(const struct solve_run *run, struct solve_result *result)
{
    igabem_forces *forces = &result->forces;
    double *coefficients[] = {&forces->cw,
                              &forces->cw_pressure,
                              &forces->cw_pressure_linear,
                              &forces->cw_cutoff_lower,
                              &forces->cw_cutoff_upper,
                              &result->cw_cut};
    for (size_t k = 0; k < sizeof coefficients / sizeof *coefficients; k++)
        *coefficients[k] *= forces->wetted_area / run->area_at_rest;
    forces->wetted_area = run->area_at_rest;
    forces->sinkage = run->request->hull.sinkage;
    forces->trim = run->request->hull.trim;
}

static int solve_level(struct solve_run *run, size_t level, igabem_options *options,
                       igabem_solution **solutions, struct cli_progress *progress)
{
    fill_options(run, level, options);
    for (size_t c = 0; c < run->cases; c++) {
        options[c].progress = report_progress;
        options[c].progress_user_data = progress;
    }
    igabem_status status = igabem_solve_many(run->input->hull, run->cases, options, solutions);
    for (size_t c = 0; !status && c < run->cases; c++) {
        struct solve_result *result = &run->results[level * run->cases + c];
        status = igabem_forces_compute(solutions[c], &result->forces);
        result->options = *igabem_solution_options(solutions[c]);
        result->refine = result->options.refine;
        result->cw_cut = result->share[0] = result->share[1] = result->share[2] = NAN;
        if (!status && run->request->survey && level + 1 == run->levels &&
            result->options.kernel == IGABEM_KERNEL_KELVIN)
            status = survey(run, solutions[c], result);
        if (run->request->free_to_trim)
            refer_to_rest(run, result);
    }
    int code = CLI_OK;
    if (status)
        code = cli_fail("%s: %s", run->request->hull.path, igabem_last_error());
    else if (level + 1 == run->levels) {
        igabem_formulation list[MOST_FORMULATIONS];
        size_t n = formulations(run->request, &run->info, list);
        code = write_files(run, solutions[run->cases - n]);
    }
    for (size_t c = 0; c < run->cases; c++)
        igabem_solution_free(solutions[c]);
    return code;
}

static int solve_all(struct solve_run *run)
{
    igabem_options *options = calloc(run->cases, sizeof *options);
    igabem_solution **solutions = calloc(run->cases, sizeof *solutions);
    run->results = calloc(run->cases * run->levels, sizeof *run->results);
    int code = CLI_OK;
    if (!options || !solutions || !run->results)
        code = cli_fail("out of memory");
    struct cli_progress progress;
    cli_progress_start(&progress, "solving");
    for (size_t level = 0; code == CLI_OK && level < run->levels; level++) {
        memset(solutions, 0, run->cases * sizeof *solutions);
        code = solve_level(run, level, options, solutions, &progress);
    }
    cli_progress_end(&progress);
    free(options);
    free(solutions);
    return code;
}

/* Of use only to those that know a cut-off. */
static void warn(const struct solve_run *run)
{
    const igabem_options *options = &run->request->options;
    const char *text = hull_warning(&run->info);
    if (*text && options->kernel == IGABEM_KERNEL_KELVIN &&
        (run->request->all || igabem_formulation_info(options->formulation)->kelvin_rows))
        fprintf(stderr, "igabem: warning: %s: %s\n", run->request->hull.path, text);
}

/* On a submerged body C_w by Kochin function and by pressure are one number (Lagally): what they
 * differ by is discretisation error. */
static void warn_of_gap(const struct solve_run *run)
{
    for (size_t c = 0; !run->info.surface_piercing && c < run->cases; c++) {
        const struct solve_result *result = solve_run_result(run, run->levels - 1, c);
        const igabem_forces *f = &result->forces;
        double gap = fabs(f->cw_pressure / f->cw - 1.0);
        if (gap > 0.01)
            fprintf(stderr,
                    "igabem: warning: %s: at Fr %g C_w by Kochin function and by pressure differ "
                    "by %.2g %%, on a submerged body all of it discretisation error: refine\n",
                    run->request->hull.path, result->options.froude, 100.0 * gap);
    }
}

/* What a command line without a mesh gets, on the last level but one of a ladder, whose levels are
 * half as fine again each. */
static size_t wanted_unknowns(int levels)
{
    return (size_t)(400.0 / pow(1.5, levels > 1 ? 2.0 * (levels - 2) : 0.0));
}

int command_solve(int argc, char **argv)
{
    struct solve_request request;
    struct hull_input input = {0};
    bool done;
    int code = solve_parse(argc, argv, &request, &done);
    if (code != CLI_OK || done) {
        solve_request_free(&request);
        return code;
    }
    struct solve_run run = {.request = &request, .input = &input, .levels = (size_t)request.ladder};
    code = hull_input_read(&request.hull, &input);
    if (code == CLI_OK) {
        igabem_hull_get_info(input.hull, &run.info);
        run.area_at_rest = run.info.hydrostatics.wetted_area;
        if (!request.resolution_given)
            igabem_options_refine(input.hull, wanted_unknowns(request.ladder), &request.options);
        if (code == CLI_OK && request.free_to_trim)
            code = equilibrium_find(&request, &input);
    }
    if (code == CLI_OK) {
        igabem_formulation list[MOST_FORMULATIONS];
        igabem_hull_get_info(input.hull, &run.info);
        run.cases = request.n_fr * formulations(&request, &run.info, list);
        warn(&run);
        code = solve_all(&run);
    }
    if (code == CLI_OK)
        warn_of_gap(&run);
    if (code == CLI_OK && request.plot)
        code = solve_write_plot(&run, request.plot) ? CLI_OK : CLI_FAILED;
    if (code == CLI_OK)
        code = request.json ? solve_print_json(&run) : solve_print_table(&run);
    free(run.results);
    hull_input_free(&input);
    solve_request_free(&request);
    return code;
}
