#include "cli.h"
#include "json_result.h"
#include "solve.h"

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
    json_result_set(json, "kernel", json_string(kernel_name(o->kernel)));
    json_result_set(json, "formulation", json_string(igabem_formulation_name(o->formulation)));
    json_result_set(json, "refine", json_integer(o->refine));
    json_result_set(json, "refine_v", json_integer(o->refine_v));
    json_result_set(json, "elements_u", json_integer(o->elements_u));
    json_result_set(json, "elements_v", json_integer(o->elements_v));
    json_result_set(json, "waterline_span", real(o->waterline_span));
    json_result_set(json, "degree", json_integer(o->degree));
    json_result_set(json, "line_term", json_boolean(o->line_term));
    json_result_set(json, "cutoff_angle", real(o->cutoff_angle));
    json_result_set(json, "cutoff_factor", real(o->cutoff_factor));
    json_result_set(json, "stem_limit", real(o->stem_limit));
    json_result_set(json, "stern_length", real(o->stern_length));
    json_result_set(json, "stern_blend", real(o->stern_blend));
    json_result_set(json, "spectrum_limit", real(o->spectrum_limit));
    json_result_set(json, "surface_cells", real(o->surface_cells));
    json_result_set(json, "surface_rows", real(o->surface_rows));
    json_result_set(json, "surface_first", real(o->surface_first));
    json_result_set(json, "surface_damping", real(o->surface_damping));
    json_result_set(json, "surface_upstream", real(o->surface_upstream));
    json_result_set(json, "surface_downstream", real(o->surface_downstream));
    json_result_set(json, "surface_side", real(o->surface_side));
    json_result_set(json, "tolerance", real(o->tolerance));
    json_result_set(json, "solver", json_string(solve_solver_name(o->solver)));
    json_result_set(json, "gravity", real(o->gravity));
    json_result_set(json, "density", real(o->density));
    return json;
}

static void add_total(const struct solve_run *run, const struct solve_result *result, json_t *json)
{
    igabem_total total;
    solve_run_total(run, result, &total);
    json_result_set(json, "reynolds", real(total.reynolds));
    json_result_set(json, "cf", real(total.cf));
    json_result_set(json, "ct", real(total.ct));
    json_result_set(json, "rt", real(total.rt));
}

static json_t *warnings_json(const struct solve_result *result)
{
    json_t *list = json_array();
    for (char *const *w = result->warning; *w; w++)
        json_result_append(list, json_string(*w));
    return list;
}

static json_t *cost_json(const igabem_cost *cost)
{
    json_t *json = json_object();
    json_result_set(json, "singular_pairs", json_integer((json_int_t)cost->singular_pairs));
    json_result_set(json, "near_pairs", json_integer((json_int_t)cost->near_pairs));
    json_result_set(json, "far_pairs", json_integer((json_int_t)cost->far_pairs));
    json_result_set(json, "rankine", json_integer((json_int_t)cost->rankine));
    json_result_set(json, "local", json_integer((json_int_t)cost->local));
    json_result_set(json, "wave", json_integer((json_int_t)cost->wave));
    return json;
}

static json_t *result_json(const struct solve_run *run, const struct solve_result *result)
{
    const igabem_forces *f = &result->forces;
    double weight = run->request->options.density * run->request->options.gravity * f->volume;
    json_t *json = json_object();
    json_result_set(json, "fr", real(result->options.froude));
    json_result_set(json, "formulation",
                    json_string(igabem_formulation_name(result->options.formulation)));
    json_result_set(json, "k0", real(f->k0));
    json_result_set(json, "speed", real(f->speed));
    json_result_set(json, "dofs", json_integer((json_int_t)f->dofs));
    json_result_set(json, "unknowns_per_wave", real(f->unknowns_per_wave));
    json_result_set(json, "wetted_area", real(f->wetted_area));
    json_result_set(json, "volume", real(f->volume));
    json_result_set(json, "cw", real(f->cw));
    json_result_set(json, "cw_error", real(f->cw_error));
    json_result_set(json, "cw_pressure", real(f->cw_pressure));
    json_result_set(json, "cw_pressure_linear", real(f->cw_pressure_linear));
    json_result_set(json, "cw_run_up", real(f->cw_run_up));
    json_result_set(json, "cw_transom", real(f->cw_transom));
    json_result_set(json, "cw_momentum", real(f->cw_momentum));
    json_result_set(json, "cw_l2", real(f->cw_l2));
    json_result_set(json, "rw", real(f->rw));
    json_result_set(json, "rw_over_weight", real(f->rw / weight));
    json_result_set(json, "cw_cutoff_lower", real(f->cw_cutoff_lower));
    json_result_set(json, "cw_cutoff_upper", real(f->cw_cutoff_upper));
    json_result_set(json, "share_beyond_cutoff", real(f->share_beyond_cutoff));
    json_result_set(json, "cw_cut", real(result->cw_cut));
    json_result_set(json, "shares",
                    json_pack("[o,o,o]", real(result->share[0]), real(result->share[1]),
                              real(result->share[2])));
    json_result_set(json, "sinkage", real(f->sinkage));
    json_result_set(json, "trim", real(f->trim));
    json_result_set(json, "condition", real(f->condition));
    json_result_set(json, "iterations", json_integer((json_int_t)f->iterations));
    json_result_set(json, "residual", real(f->residual));
    json_result_set(json, "memory", real(f->memory));
    json_result_set(json, "cost", cost_json(&f->cost));
    json_result_set(json, "seconds", real(f->seconds));
    if (result->options.kernel == IGABEM_KERNEL_KELVIN)
        add_total(run, result, json);
    json_result_set(json, "warnings", warnings_json(result));
    json_result_set(json, "options", options_json(result));
    return json;
}

static json_t *hull_json(const struct solve_run *run)
{
    const nurbs_hydrostatics *h = &run->info.hydrostatics;
    json_t *json = json_object();
    json_result_set(json, "file", json_string(run->request->hull.path));
    json_result_set(json, "note", json_string(run->input->note));
    json_result_set(json, "length", real(run->info.length));
    json_result_set(json, "wetted_area", real(h->wetted_area));
    json_result_set(json, "volume", real(h->volume));
    json_result_set(json, "transom_area", real(h->transom_area));
    json_result_set(json, "nu_s", real(run->info.nu_s));
    json_result_set(json, "surface_piercing", json_boolean(run->info.surface_piercing));
    json_result_set(json, "stern", json_string(hull_stern(&run->info)));
    json_result_set(json, "transom", json_boolean(run->info.transom != IGABEM_TRANSOM_NONE));
    json_result_set(json, "patches", json_integer((json_int_t)run->info.patches));
    json_result_set(json, "simplify_bound", real(run->input->simplify_bound));
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
        json_result_set(row, "refine", json_integer(result->refine));
        json_result_set(row, "dofs", json_integer((json_int_t)f->dofs));
        json_result_set(row, "cw", real(f->cw));
        json_result_set(row, "change", real(f->cw / before - 1.0));
        json_result_set(row, "order", real(order));
        json_result_set(row, "richardson", real(limit));
        json_result_set(row, "seconds", real(f->seconds));
        json_result_append(list, row);
    }
    json_result_set(json, "fr", real(first->options.froude));
    json_result_set(json, "formulation",
                    json_string(igabem_formulation_name(first->options.formulation)));
    json_result_set(json, "levels", list);
    return json;
}

int solve_print_json(const struct solve_run *run)
{
    json_t *json = json_object(), *results = json_array();
    json_result_set(json, "hull", hull_json(run));
    for (size_t c = 0; c < run->cases; c++)
        json_result_append(results, result_json(run, solve_run_result(run, run->levels - 1, c)));
    json_result_set(json, "results", results);
    if (run->levels > 1) {
        json_t *ladders = json_array();
        for (size_t c = 0; c < run->cases; c++)
            json_result_append(ladders, ladder_json(run, c));
        json_result_set(json, "ladder", ladders);
    }
    return json_result_print(json, JSON_INDENT(1) | JSON_REAL_PRECISION(12));
}
