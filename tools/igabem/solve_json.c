#include "cli.h"
#include "solve.h"

#include <errno.h>
#include <math.h>
#include <string.h>

/* JSON has no NaN and no infinity. */
static json_t *real(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static const char *kernel_name(igabem_kernel kernel)
{
    return kernel == IGABEM_KERNEL_KELVIN        ? "kelvin"
           : kernel == IGABEM_KERNEL_DOUBLE_BODY ? "double-body"
                                                 : "rankine";
}

const char *solve_solver_name(igabem_solver solver)
{
    return solver == IGABEM_SOLVER_AUTO ? "auto" : solver == IGABEM_SOLVER_LU ? "lu" : "gmres";
}

static json_t *options_json(const struct solve_result *result)
{
    const igabem_options *o = &result->options;
    json_t *json = json_object();
    json_object_set_new(json, "kernel", json_string(kernel_name(o->kernel)));
    json_object_set_new(json, "formulation", json_string(igabem_formulation_name(o->formulation)));
    json_object_set_new(json, "refine", json_integer(o->refine));
    json_object_set_new(json, "refine_v", json_integer(o->refine_v));
    json_object_set_new(json, "elements_u", json_integer(o->elements_u));
    json_object_set_new(json, "elements_v", json_integer(o->elements_v));
    json_object_set_new(json, "waterline_span", real(o->waterline_span));
    json_object_set_new(json, "degree", json_integer(o->degree));
    json_object_set_new(json, "line_term", json_boolean(o->line_term));
    json_object_set_new(json, "cutoff_angle", real(o->cutoff_angle));
    json_object_set_new(json, "cutoff_factor", real(o->cutoff_factor));
    json_object_set_new(json, "stem_limit", real(o->stem_limit));
    json_object_set_new(json, "stern_length", real(o->stern_length));
    json_object_set_new(json, "stern_blend", real(o->stern_blend));
    json_object_set_new(json, "spectrum_limit", real(o->spectrum_limit));
    json_object_set_new(json, "tolerance", real(o->tolerance));
    json_object_set_new(json, "solver", json_string(solve_solver_name(o->solver)));
    json_object_set_new(json, "gravity", real(o->gravity));
    json_object_set_new(json, "density", real(o->density));
    return json;
}

static void add_total(const struct solve_run *run, const struct solve_result *result, json_t *json)
{
    igabem_total total;
    solve_run_total(run, result, &total);
    json_object_set_new(json, "reynolds", real(total.reynolds));
    json_object_set_new(json, "cf", real(total.cf));
    json_object_set_new(json, "ct", real(total.ct));
    json_object_set_new(json, "rt", real(total.rt));
}

static json_t *warnings_json(const struct solve_result *result)
{
    json_t *list = json_array();
    for (char *const *w = result->warning; *w; w++)
        json_array_append_new(list, json_string(*w));
    return list;
}

static json_t *cost_json(const igabem_cost *cost)
{
    json_t *json = json_object();
    json_object_set_new(json, "singular_pairs", json_integer((json_int_t)cost->singular_pairs));
    json_object_set_new(json, "near_pairs", json_integer((json_int_t)cost->near_pairs));
    json_object_set_new(json, "far_pairs", json_integer((json_int_t)cost->far_pairs));
    json_object_set_new(json, "rankine", json_integer((json_int_t)cost->rankine));
    json_object_set_new(json, "local", json_integer((json_int_t)cost->local));
    json_object_set_new(json, "wave", json_integer((json_int_t)cost->wave));
    return json;
}

static json_t *result_json(const struct solve_run *run, const struct solve_result *result)
{
    const igabem_forces *f = &result->forces;
    double weight = run->request->options.density * run->request->options.gravity * f->volume;
    json_t *json = json_object();
    json_object_set_new(json, "fr", real(result->options.froude));
    json_object_set_new(json, "formulation",
                        json_string(igabem_formulation_name(result->options.formulation)));
    json_object_set_new(json, "k0", real(f->k0));
    json_object_set_new(json, "speed", real(f->speed));
    json_object_set_new(json, "dofs", json_integer((json_int_t)f->dofs));
    json_object_set_new(json, "unknowns_per_wave", real(f->unknowns_per_wave));
    json_object_set_new(json, "wetted_area", real(f->wetted_area));
    json_object_set_new(json, "volume", real(f->volume));
    json_object_set_new(json, "cw", real(f->cw));
    json_object_set_new(json, "cw_pressure", real(f->cw_pressure));
    json_object_set_new(json, "cw_pressure_linear", real(f->cw_pressure_linear));
    json_object_set_new(json, "cw_run_up", real(f->cw_run_up));
    json_object_set_new(json, "cw_transom", real(f->cw_transom));
    json_object_set_new(json, "cw_l2", real(f->cw_l2));
    json_object_set_new(json, "rw", real(f->rw));
    json_object_set_new(json, "rw_over_weight", real(f->rw / weight));
    json_object_set_new(json, "cw_cutoff_lower", real(f->cw_cutoff_lower));
    json_object_set_new(json, "cw_cutoff_upper", real(f->cw_cutoff_upper));
    json_object_set_new(json, "share_beyond_cutoff", real(f->share_beyond_cutoff));
    json_object_set_new(json, "cw_cut", real(result->cw_cut));
    json_object_set_new(json, "shares",
                        json_pack("[o,o,o]", real(result->share[0]), real(result->share[1]),
                                  real(result->share[2])));
    json_object_set_new(json, "sinkage", real(f->sinkage));
    json_object_set_new(json, "trim", real(f->trim));
    json_object_set_new(json, "condition", real(f->condition));
    json_object_set_new(json, "iterations", json_integer((json_int_t)f->iterations));
    json_object_set_new(json, "residual", real(f->residual));
    json_object_set_new(json, "memory", real(f->memory));
    json_object_set_new(json, "cost", cost_json(&f->cost));
    json_object_set_new(json, "seconds", real(f->seconds));
    if (result->options.kernel == IGABEM_KERNEL_KELVIN)
        add_total(run, result, json);
    json_object_set_new(json, "warnings", warnings_json(result));
    json_object_set_new(json, "options", options_json(result));
    return json;
}

static json_t *hull_json(const struct solve_run *run)
{
    const nurbs_hydrostatics *h = &run->info.hydrostatics;
    json_t *json = json_object();
    json_object_set_new(json, "file", json_string(run->request->hull.path));
    json_object_set_new(json, "note", json_string(run->input->note));
    json_object_set_new(json, "length", real(run->info.length));
    json_object_set_new(json, "wetted_area", real(h->wetted_area));
    json_object_set_new(json, "volume", real(h->volume));
    json_object_set_new(json, "transom_area", real(h->transom_area));
    json_object_set_new(json, "nu_s", real(run->info.nu_s));
    json_object_set_new(json, "surface_piercing", json_boolean(run->info.surface_piercing));
    json_object_set_new(json, "stern", json_string(hull_stern(&run->info)));
    json_object_set_new(json, "transom", json_boolean(run->info.transom != IGABEM_TRANSOM_NONE));
    json_object_set_new(json, "patches", json_integer((json_int_t)run->info.patches));
    json_object_set_new(json, "simplify_bound", real(run->input->simplify_bound));
    return json;
}

static json_t *ladder_json(const struct solve_run *run, size_t c)
{
    json_t *list = json_array(), *json = json_object();
    double order = NAN, limit = NAN;
    const struct solve_result *first = solve_run_result(run, 0, c);
    for (size_t level = 0; level < run->levels; level++) {
        const struct solve_result *result = solve_run_result(run, level, c);
        const igabem_forces *f = &result->forces;
        double before = level ? solve_run_result(run, level - 1, c)->forces.cw : NAN;
        json_t *row = json_object();
        solve_run_order(run, level, c, &order, &limit);
        json_object_set_new(row, "refine", json_integer(result->refine));
        json_object_set_new(row, "dofs", json_integer((json_int_t)f->dofs));
        json_object_set_new(row, "cw", real(f->cw));
        json_object_set_new(row, "change", real(f->cw / before - 1.0));
        json_object_set_new(row, "order", real(order));
        json_object_set_new(row, "richardson", real(limit));
        json_object_set_new(row, "seconds", real(f->seconds));
        json_array_append_new(list, row);
    }
    json_object_set_new(json, "fr", real(first->options.froude));
    json_object_set_new(json, "formulation",
                        json_string(igabem_formulation_name(first->options.formulation)));
    json_object_set_new(json, "levels", list);
    return json;
}

int solve_print_json(const struct solve_run *run)
{
    json_t *json = json_object(), *results = json_array();
    json_object_set_new(json, "hull", hull_json(run));
    for (size_t c = 0; c < run->cases; c++)
        json_array_append_new(results, result_json(run, solve_run_result(run, run->levels - 1, c)));
    json_object_set_new(json, "results", results);
    if (run->levels > 1) {
        json_t *ladders = json_array();
        for (size_t c = 0; c < run->cases; c++)
            json_array_append_new(ladders, ladder_json(run, c));
        json_object_set_new(json, "ladder", ladders);
    }
    int failed = json_dumpf(json, stdout, JSON_INDENT(1) | JSON_REAL_PRECISION(12)) != 0 ||
                 putchar('\n') == EOF || fflush(stdout) == EOF;
    json_decref(json);
    return failed ? cli_fail("standard output: %s", strerror(errno)) : CLI_OK;
}
