/* igabem solve: Froude numbers x formulations x levels of refinement on one hull. */
#include "solve.h"

#include "cli.h"
#include "commands.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct solve_result *case_result(const struct solve_run *run, size_t level, size_t c)
{
    return &run->results[level * run->cases + c];
}

const struct solve_result *solve_run_result(const struct solve_run *run, size_t level, size_t c)
{
    return case_result(run, level, c);
}

void solve_run_order(const struct solve_run *run, size_t level, size_t c, double *order,
                     double *limit)
{
    double h[3], cw[3];
    *order = *limit = NAN;
    for (size_t k = 0; k < 3 && level >= 2; k++) {
        const struct solve_result *result = solve_run_result(run, level - 2 + k, c);
        h[k] = 1.0 / result->refine;
        cw[k] = result->forces.cw;
    }
    if (level >= 2 && igabem_ladder_order(h, cw, order, limit))
        *order = *limit = NAN;
}

void solve_run_total(const struct solve_run *run, const struct solve_result *result,
                     igabem_total *total)
{
    const struct solve_request *request = run->request;
    const igabem_water water = {request->options.density, request->viscosity, request->form_factor};
    if (igabem_total_resistance(&result->forces, run->info.length, &water, total))
        *total = (igabem_total){NAN, NAN, NAN, NAN, {0}};
}

enum { MOST_FORMULATIONS = 16 };

static bool is_potential(igabem_formulation formulation)
{
    return igabem_formulation_info(formulation)->potential;
}

/* Formulations of a run; of all of them the one for hulls like this is the first, and those with a
 * potential, which share nothing with the others, are the last. Fills list[MOST_FORMULATIONS],
 * returns their number. */
static size_t formulations(const struct solve_request *request, const igabem_hull_info *info,
                           igabem_formulation *list)
{
    const igabem_formulation_row *row;
    bool transom = info->transom != IGABEM_TRANSOM_NONE;
    size_t n = 0;
    if (!request->all) {
        list[n++] = request->options.formulation;
        return n;
    }
    for (int part = transom ? 0 : 1; part < 3; part++)
        for (igabem_formulation f = IGABEM_FORMULATION_AUTO + 1;
             (row = igabem_formulation_info(f)) && n < MOST_FORMULATIONS; f++)
            if (part == (row->stern_rows ? 0 : row->potential ? 2 : 1))
                list[n++] = f;
    return n;
}

/* Of one call among several: cases done before it, and its own. */
struct part_progress {
    struct cli_progress line;
    size_t before, cases, all;
};

static int report_progress(void *data, double fraction)
{
    struct part_progress *part = data;
    cli_progress_update(&part->line,
                        ((double)part->before + fraction * (double)part->cases) / (double)part->all,
                        NULL);
    return 0;
}

/* Level 0 of a ladder: like the hull's knots, so that the last level but one is a single solve. */
static void start_surface(const struct solve_run *run, igabem_options *options)
{
    igabem_options rule = *options;
    if (run->levels > 1 && options->surface_cells == 0 && is_potential(options->formulation) &&
        !igabem_options_freeze(run->input->hull, &rule))
        options->surface_cells =
            fmax(4, round(rule.surface_cells * sqrt((double)igabem_ladder_unknowns(run->levels) /
                                                    (double)igabem_ladder_unknowns(2))));
}

/* Where nothing else is asked, a wave cut gets the waves behind the ship that it is continued from:
 * the 1.2 wave lengths that igabem_wave_cut() needs and a share to see them by. */
static void lengthen_surface(const struct solve_run *run, igabem_options *options)
{
    static const double wave_lengths = 1.3, farthest = 3.0;
    if (run->request->survey && options->surface_downstream == 0 &&
        is_potential(options->formulation))
        options->surface_downstream =
            fmin(farthest,
                 fmax(1.0, wave_lengths * 2.0 * acos(-1.0) * options->froude * options->froude));
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
        start_surface(run, &options[c]);
        lengthen_surface(run, &options[c]);
        igabem_ladder_level(level, &options[c]);
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

static void add_warning(struct solve_result *result, const char *sentence)
{
    size_t k = 0;
    while (k + 1 < WARNINGS_MOST && result->warning[k])
        k++;
    if (k + 1 < WARNINGS_MOST)
        result->warning[k] = cli_needed(strdup(sentence));
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
    const igabem_formulation_row *row = igabem_formulation_info(result->options.formulation);
    if (!row->solves || !run->input->half)
        return IGABEM_OK;
    status = igabem_wave_cut(solution, NAN, &result->cw_cut);
    if (!row->potential || status != IGABEM_ERROR_ARGUMENT)
        return status;
    /* Its free surface is too small for one. */
    result->cw_cut = NAN;
    add_warning(result, igabem_last_error());
    return IGABEM_OK;
}

/* Coefficients on the wetted area at rest, and the attitude that the hull was solved in. */
static void refer_to_rest(const struct solve_run *run, struct solve_result *result)
{
    igabem_forces *forces = &result->forces;
    double *coefficients[] = {
        &forces->cw,          &forces->cw_pressure,     &forces->cw_pressure_linear,
        &forces->cw_momentum, &forces->cw_cutoff_lower, &forces->cw_cutoff_upper,
        &result->cw_cut};
    for (size_t k = 0; k < sizeof coefficients / sizeof *coefficients; k++)
        *coefficients[k] *= forces->wetted_area / run->area_at_rest;
    forces->wetted_area = run->area_at_rest;
    forces->sinkage = run->request->hull.sinkage;
    forces->trim = run->request->hull.trim;
}

static void keep_warnings(const igabem_solution *solution, struct solve_result *result)
{
    const char *sentence;
    for (size_t k = 0; (sentence = igabem_solution_warning(solution, &result->forces, k)); k++)
        add_warning(result, sentence);
}

static const igabem_forces no_forces = {.speed = NAN,
                                        .k0 = NAN,
                                        .wetted_area = NAN,
                                        .volume = NAN,
                                        .rw = NAN,
                                        .cw = NAN,
                                        .cw_l2 = NAN,
                                        .cw_pressure = NAN,
                                        .cw_pressure_linear = NAN,
                                        .cw_run_up = NAN,
                                        .cw_transom = NAN,
                                        .cw_momentum = NAN,
                                        .cw_cutoff_lower = NAN,
                                        .cw_cutoff_upper = NAN,
                                        .share_beyond_cutoff = NAN,
                                        .sinkage = NAN,
                                        .trim = NAN,
                                        .condition = NAN,
                                        .residual = NAN,
                                        .seconds = NAN,
                                        .memory = NAN,
                                        .unknowns_per_wave = NAN,
                                        .cw_error = NAN};

/* What one case says; without a solution it was refused. */
static igabem_status take_case(const struct solve_run *run, bool last_level,
                               const igabem_options *options, const igabem_solution *solution,
                               struct solve_result *result)
{
    result->options = solution ? *igabem_solution_options(solution) : *options;
    result->refine = result->options.refine;
    result->forces = no_forces;
    result->cw_cut = result->share[0] = result->share[1] = result->share[2] = NAN;
    if (!solution) {
        result->refused = true;
        result->warning[0] = cli_needed(strdup(igabem_last_error()));
        return IGABEM_OK;
    }
    igabem_status status = igabem_forces_compute(solution, &result->forces);
    if (!status && run->request->survey && last_level &&
        result->options.kernel == IGABEM_KERNEL_KELVIN)
        status = survey(run, solution, result);
    if (run->request->free_to_trim)
        refer_to_rest(run, result);
    if (!status)
        keep_warnings(solution, result);
    return status;
}

/* Of all formulations those with a potential may refuse what the others take. */
static bool may_refuse(const struct solve_run *run, igabem_formulation formulation,
                       igabem_status status)
{
    return run->request->all && is_potential(formulation) &&
           (status == IGABEM_ERROR_ARGUMENT || status == IGABEM_ERROR_GEOMETRY ||
            status == IGABEM_ERROR_NUMERIC);
}

/* Solves n cases together and takes what they say; what is refused together, one by one. */
static int solve_cases(struct solve_run *run, size_t level, size_t n, const size_t *cases,
                       const igabem_options *options, struct part_progress *progress)
{
    bool last = level + 1 == run->levels;
    igabem_options *own = cli_needed(malloc(n * sizeof *own));
    igabem_solution **solutions = cli_needed(calloc(n, sizeof *solutions));
    for (size_t k = 0; k < n; k++)
        own[k] = options[cases[k]];
    progress->cases = n;
    int code = CLI_OK;
    igabem_status status = igabem_solve_many(run->input->hull, n, own, solutions);
    if (may_refuse(run, own[0].formulation, status)) {
        status = IGABEM_OK;
        for (size_t k = 0; k < n && n > 1 && code == CLI_OK; k++)
            code = solve_cases(run, level, 1, &cases[k], options, progress);
        if (n == 1)
            status = take_case(run, last, own, NULL, case_result(run, level, *cases));
    } else
        for (size_t k = 0; k < n && !status && code == CLI_OK; k++) {
            status = take_case(run, last, &own[k], solutions[k], case_result(run, level, cases[k]));
            if (!status && last && cases[k] == run->shown)
                code = write_files(run, solutions[k]);
        }
    if (status)
        code = cli_fail("%s: %s", run->request->hull.path, igabem_last_error());
    for (size_t k = 0; k < n; k++)
        igabem_solution_free(solutions[k]);
    free(solutions);
    free(own);
    return code;
}

/* The sources of all formulations share one call, each potential has its own. */
static int solve_level(struct solve_run *run, size_t level, struct part_progress *progress)
{
    size_t *cases = cli_needed(malloc(run->cases * sizeof *cases));
    bool *taken = cli_needed(calloc(run->cases, sizeof *taken));
    igabem_options *options = cli_needed(calloc(run->cases, sizeof *options));
    int code = CLI_OK;
    fill_options(run, level, options);
    for (size_t c = 0; c < run->cases; c++) {
        options[c].progress = report_progress;
        options[c].progress_user_data = progress;
    }
    for (size_t first = 0; first < run->cases && code == CLI_OK; first++) {
        bool potential = is_potential(options[first].formulation);
        size_t n = 0;
        for (size_t c = first; c < run->cases; c++)
            if (!taken[c] && (potential ? options[c].formulation == options[first].formulation
                                        : !is_potential(options[c].formulation))) {
                taken[c] = true;
                cases[n++] = c;
            }
        if (n > 0)
            code = solve_cases(run, level, n, cases, options, progress);
        progress->before += n;
    }
    free(cases);
    free(taken);
    free(options);
    return code;
}

static int solve_all(struct solve_run *run)
{
    struct part_progress progress = {.all = run->cases * run->levels};
    run->results = cli_needed(calloc(progress.all, sizeof *run->results));
    int code = CLI_OK;
    cli_progress_start(&progress.line, "solving");
    for (size_t level = 0; code == CLI_OK && level < run->levels; level++)
        code = solve_level(run, level, &progress);
    cli_progress_end(&progress.line);
    return code;
}

static bool is_of_hull(const igabem_hull *hull, const char *sentence)
{
    const char *own;
    for (size_t k = 0; (own = igabem_hull_warning(hull, k)); k++)
        if (strcmp(own, sentence) == 0)
            return true;
    return false;
}

/* What has been said of an earlier case. */
static bool was_said(const struct solve_run *run, size_t cases, const char *sentence)
{
    for (size_t c = 0; c < cases; c++)
        for (char *const *w = solve_run_result(run, run->levels - 1, c)->warning; *w; w++)
            if (strcmp(*w, sentence) == 0)
                return true;
    return false;
}

static void print_warnings(const struct solve_run *run)
{
    const char *path = run->request->hull.path;
    for (size_t c = 0; c < run->cases; c++) {
        const struct solve_result *result = solve_run_result(run, run->levels - 1, c);
        for (char *const *w = result->warning; *w; w++)
            if (!is_of_hull(run->input->hull, *w))
                fprintf(stderr, "igabem: warning: %s: Fr %g, %s: %s\n", path,
                        result->options.froude,
                        igabem_formulation_name(result->options.formulation), *w);
            else if (!was_said(run, c, *w))
                fprintf(stderr, "igabem: warning: %s: %s\n", path, *w);
    }
}

/* The hull of *input in the attitude of equilibrium. */
static int float_freely(struct solve_request *request, struct hull_input *input)
{
    nurbs_hull_options placement;
    igabem_equilibrium equilibrium;
    nurbs_hull_options_init(&placement);
    placement.level = nurbs_hull_level(input->source);
    placement.simplify = request->hull.simplify;
    placement.length = request->hull.length;
    request->options.froude = request->fr[0];
    igabem_status status = igabem_equilibrium_find(nurbs_hull_full(input->source), &placement,
                                                   &request->options, &equilibrium, NULL);
    if (status)
        return cli_fail("%s: --free-to-trim: %s", request->hull.path, igabem_last_error());
    igabem_hull_info info;
    igabem_hull_get_info(input->hull, &info);
    request->hull.length = info.length;
    request->hull.sinkage = equilibrium.sinkage;
    request->hull.trim = equilibrium.trim;
    request->hull.pivot = equilibrium.pivot;
    request->hull.quiet = true;
    hull_input_free(input);
    return hull_input_read(&request->hull, input);
}

static void run_free(struct solve_run *run)
{
    for (size_t k = 0; run->results && k < run->cases * run->levels; k++)
        for (char **w = run->results[k].warning; *w; w++)
            free(*w);
    free(run->results);
}

int command_solve(int argc, char **argv)
{
    struct solve_request request;
    struct hull_input input = {0};
    int code = solve_parse(argc, argv, &request);
    if (code >= 0) {
        solve_request_free(&request);
        return code;
    }
    struct solve_run run = {.request = &request, .input = &input, .levels = (size_t)request.ladder};
    code = hull_input_read(&request.hull, &input);
    if (code == CLI_OK) {
        igabem_hull_get_info(input.hull, &run.info);
        run.area_at_rest = run.info.hydrostatics.wetted_area;
        if (!request.resolution_given)
            igabem_options_refine(input.hull, igabem_ladder_unknowns((size_t)request.ladder),
                                  &request.options);
        if (code == CLI_OK && request.free_to_trim)
            code = float_freely(&request, &input);
    }
    if (code == CLI_OK) {
        igabem_formulation list[MOST_FORMULATIONS];
        igabem_hull_get_info(input.hull, &run.info);
        size_t n = formulations(&request, &run.info, list);
        run.cases = request.n_fr * n;
        run.shown = run.cases - n;
        code = solve_all(&run);
    }
    if (code == CLI_OK)
        print_warnings(&run);
    if (code == CLI_OK && request.plot)
        code = solve_write_plot(&run, request.plot) ? CLI_OK : CLI_FAILED;
    if (code == CLI_OK)
        code = request.json ? solve_print_json(&run) : solve_print_table(&run);
    run_free(&run);
    hull_input_free(&input);
    solve_request_free(&request);
    return code;
}
