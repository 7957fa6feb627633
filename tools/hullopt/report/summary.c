#include "cli.h"
#include "core/constraints.h"
#include "core/objective.h"
#include "json_result.h"
#include "report/agreement.h"
#include "report/outputs.h"
#include "report/particulars.h"

#include <math.h>
#include <string.h>

/* JSON has no NaN: a figure that is not there is null. */
static void put(json_t *object, const char *key, double value)
{
    json_result_set(object, key, isfinite(value) ? json_real(value) : json_null());
}

static void put_count(json_t *object, const char *key, size_t value)
{
    json_result_set(object, key, json_integer((json_int_t)value));
}

static void put_flag(json_t *object, const char *key, bool value)
{
    json_result_set(object, key, json_boolean(value));
}

static json_t *array(size_t n, const double *values)
{
    json_t *list = json_array();
    for (size_t i = 0; i < n; i++)
        json_result_append(list, isfinite(values[i]) ? json_real(values[i]) : json_null());
    return list;
}

static json_t *evaluation(const struct results *r, const struct evaluation *e)
{
    json_t *o = json_object();
    put_count(o, "id", (size_t)e->id);
    json_result_set(o, "phase", json_string(e->phase));
    if (r->problem->config->judge.command)
        put(o, "value", e->value);
    if (*e->made)
        json_result_set(o, "made", json_string(e->made));
    put(o, "cw", e->cw);
    put(o, "cw_pressure", e->cw_pressure);
    put(o, "rw", e->rw);
    if (e->speeds)
        json_result_set(o, "cw_speeds", array(e->speeds, e->cw_speed));
    put(o, "share_beyond_cutoff", e->share_beyond_cutoff);
    put(o, "condition", e->condition);
    put(o, "volume", e->volume);
    put(o, "wetted_area", e->wetted_area);
    if (r->problem->config->free_to_trim) {
        put(o, "sinkage", e->sinkage);
        put(o, "trim", e->trim);
    }
    put_count(o, "dofs", e->dofs);
    put(o, "simplification_bound", e->bound);
    json_result_set(o, "latent", array(galv_model_modes(r->problem->model), e->u));
    return o;
}

static json_t *values(const struct results *r, const struct evaluation *e)
{
    const struct config *config = r->problem->config;
    double list[OBJECTIVES_MOST];
    size_t n = objectives_count(config);
    for (size_t k = 0; k < n; k++)
        list[k] = objectives_value(config, k, problem_length(r->problem), e, r->baseline);
    return array(n, list);
}

/* Of several objectives: what they are, and the designs of the Pareto set. */
static void put_front(json_t *o, const struct results *r)
{
    struct objective described;
    json_t *names = json_array(), *list = json_array();
    for (size_t k = 0; k < objectives_count(r->problem->config); k++) {
        objectives_describe(r->problem->config, k, &described);
        json_result_append(
            names, json_pack("{s:s, s:b}", "name", described.name, "maximise", described.maximise));
    }
    for (size_t i = 0; i < r->n_front; i++) {
        const struct evaluation *e = &r->evaluations[r->front[i]];
        json_t *row = evaluation(r, e);
        json_result_set(row, "values", values(r, e));
        json_result_append(list, row);
    }
    json_result_set(o, "objectives", names);
    json_result_set(o, "front", list);
}

static json_t *constraints(const struct results *r)
{
    json_t *o = json_object();
    for (size_t k = 0; k < constraints_count(); k++) {
        struct constraint_figures f;
        json_t *row = json_object();
        constraints_figures(r->problem->config, k, r->baseline, r->best, &f);
        put(row, "allowed", f.allowed);
        put(row, "before", f.before);
        put(row, "after", f.after);
        put(row, "change", f.change);
        put(row, "largest_ratio", f.ratio);
        put_flag(row, "satisfied", f.kept);
        put_count(row, "violations",
                  constraints_violations(r->problem->config, k, r->n, r->evaluations));
        json_result_set(o, f.name, row);
    }
    return o;
}

static json_t *particulars(const struct results *r)
{
    struct particular list[PARTICULARS_MOST];
    json_t *o = json_object();
    size_t n = particulars_list(r, list);
    for (size_t i = 0; i < n; i++) {
        json_t *row = json_object();
        json_result_set(row, "unit", json_string(list[i].unit));
        put(row, "before", list[i].value[0]);
        put(row, "after", list[i].value[1]);
        json_result_set(o, list[i].key, row);
    }
    return o;
}

static json_t *verification(const struct results *r)
{
    json_t *list = json_array();
    for (size_t i = 0; i < r->n_rows; i++) {
        const struct verification *v = &r->rows[i];
        json_t *o = json_object();
        json_result_set(o, "group", json_string(verification_group_name(v->group)));
        json_result_set(o, "label", json_string(v->label));
        json_result_set(o, "formulation", json_string(v->formulation));
        put(o, "fr", v->froude);
        put_count(o, "refine", (size_t)v->refine);
        put(o, "stern_length", v->stern_length);
        put(o, "cw_before", v->cw_parent);
        put(o, "cw_after", v->cw_best);
        put(o, "reduction_percent", 100 * (1 - v->cw_best / v->cw_parent));
        put(o, "cw_pressure_before", v->cw_pressure_parent);
        put(o, "cw_pressure_after", v->cw_pressure_best);
        put_count(o, "dofs_before", v->dofs_parent);
        put_count(o, "dofs_after", v->dofs_best);
        put(o, "seconds", v->seconds);
        json_result_set(o, "note", json_string(v->note));
        json_result_append(list, o);
    }
    return list;
}

/* Of the optimum; null where the third mesh is missing. */
static json_t *ladder(const struct results *r)
{
    struct results_ladder l;
    if (!results_ladder(r, &l))
        return json_null();
    json_t *o = json_object();
    json_result_set(o, "cw", array(3, l.cw));
    put(o, "order", l.order);
    put(o, "limit", l.limit);
    return o;
}

static json_t *robust(const struct verdict *v)
{
    json_t *o = json_object();
    put_flag(o, "formulations", v->formulations);
    json_result_set(o, "resolution", v->has_resolution ? json_boolean(v->resolution) : json_null());
    json_result_set(o, "filter", v->has_filter ? json_boolean(v->filter) : json_null());
    json_result_set(o, "sterns", v->has_sterns ? json_boolean(v->sterns) : json_null());
    json_result_set(o, "speeds", v->has_speeds ? json_boolean(v->speeds) : json_null());
    put_flag(o, "only_objective", v->only_objective);
    put(o, "reduction_percent_pressure", 100 * v->pressure);
    put_count(o, "other_models", v->models);
    put_count(o, "confirm", v->confirm);
    put_count(o, "partly", v->partly);
    put_count(o, "deny", v->deny);
    json_result_set(o, "statement", json_string(v->statement));
    return o;
}

static json_t *agreement(const struct results *r)
{
    struct agreement a;
    json_t *list = json_array();
    for (size_t s = 0; s <= r->problem->speeds && agreement_of(r, s, &a); s++) {
        json_t *o = json_object(), *names = json_array(), *rank = json_array(),
               *ratio = json_array();
        for (size_t k = 0; k < a.models; k++) {
            json_result_append(names, json_string(a.name[k]));
            json_result_append(rank, array(a.models, a.rank[k]));
            json_result_append(ratio, array(a.n, a.ratio[k]));
        }
        put(o, "fr", a.froude);
        put_count(o, "designs", a.n);
        json_result_set(o, "formulations", names);
        json_result_set(o, "rank_correlation", rank);
        json_result_set(o, "cw_ratio", ratio);
        json_result_append(list, o);
        agreement_free(&a);
    }
    return list;
}

/* "key = value" lines as an object of texts and numbers. */
static json_t *settings(const char *text)
{
    json_t *o = json_object();
    char key[64], value[400];
    for (const char *line = text; *line;) {
        size_t length = strcspn(line, "\n"), name = strcspn(line, " \n");
        double number;
        if (name < sizeof key && strncmp(line + name, " = ", 3) == 0) {
            snprintf(key, sizeof key, "%.*s", (int)name, line);
            snprintf(value, sizeof value, "%.*s", (int)(length - name - 3), line + name + 3);
            json_result_set(
                o, key, cli_parse_double(value, &number) ? json_real(number) : json_string(value));
        } else if (name < sizeof key) {
            snprintf(key, sizeof key, "%.*s", (int)name, line);
            json_result_set(o, key, json_string(""));
        }
        line += length + (line[length] == '\n');
    }
    return o;
}

static json_t *solver(const igabem_options *options)
{
    bayesopt_attribute list[SOLVER_MOST];
    size_t n = record_solver(options, list);
    json_t *o = json_object();
    for (size_t i = 0; i < n; i++) {
        if (list[i].text)
            json_result_set(o, list[i].name, json_string(list[i].text));
        else
            put(o, list[i].name, list[i].number);
    }
    return o;
}

/* null where the search has none. */
static json_t *model(const struct search_model *m)
{
    if (!m->known)
        return json_null();
    json_t *o = json_object(), *indices = json_array();
    for (size_t k = 0; k < m->objectives; k++)
        json_result_append(indices,
                           json_pack("{s:o, s:o}", "alone", array(m->d, m->first + k * m->d),
                                     "with_others", array(m->d, m->total + k * m->d)));
    put_count(o, "designs", m->info.n);
    json_result_set(o, "transform", json_string(bayesopt_transform_name(m->info.transform)));
    put(o, "loo_rms", m->info.loo_rms);
    json_result_set(o, "lengthscale", array(m->d, m->scale));
    json_result_set(o, "sobol", indices);
    return o;
}

static json_t *failures(const struct results *r)
{
    json_t *list = json_array();
    for (size_t i = 0; i < r->n; i++) {
        const struct evaluation *e = &r->evaluations[i];
        if (!e->failed)
            continue;
        json_t *o = json_object();
        put_count(o, "id", (size_t)e->id);
        size_t stage = strcspn(e->reason, ":");
        json_result_set(o, "stage", json_stringn(e->reason, stage));
        json_result_set(o, "reason",
                        json_string(e->reason + stage + strspn(e->reason + stage, ": ")));
        json_result_append(list, o);
    }
    return list;
}

static void put_latent(json_t *o, const struct results *r)
{
    const galv_model *model = r->problem->model;
    put_count(o, "modes", galv_model_modes(model));
    put_count(o, "parameters", results_parameters(r));
    put_count(o, "latent_samples", galv_model_samples(model));
    put(o, "retained_variance", galv_model_retained(model));
    put(o, "retained_variance_fresh", galv_model_confidence(model).retained_fresh);
    put(o, "retained_variance_error", galv_model_confidence(model).retained_error);
    put(o, "trace", galv_model_trace(model));
    json_result_set(o, "eigenvalues",
                    array(galv_model_spectrum(model), galv_model_eigenvalues(model)));
}

json_t *summary_make(const struct results *r)
{
    struct results_times times = results_times(r);
    json_t *o = json_object();
    json_result_set(o, "format", json_string("hullopt-summary"));
    put_count(o, "version", 1);
    json_result_set(o, "tool", json_string("hullopt " TOOL_VERSION));
    put_flag(o, "complete", r->complete);
    json_result_set(o, "stop", r->stop ? json_string(r->stop) : json_null());
    json_t *best = evaluation(r, r->best);
    if (r->parameters) {
        json_result_set(best, "parameters", array(r->n_parameters, r->parameters));
        put(best, "parameters_residual", r->residual);
    }
    if (r->made) {
        json_result_set(best, "made", json_string(r->made));
        put(best, "made_cw", r->made_cw);
    }
    json_result_set(o, "baseline", evaluation(r, r->baseline));
    json_result_set(o, "best", best);
    if (objectives_count(r->problem->config) > 1)
        put_front(o, r);
    put(o, "reduction_percent", 100 * (1 - r->best->cw / r->baseline->cw));
    double total[2];
    results_total_resistance(r, total);
    put(o, "total_resistance_before", total[0]);
    put(o, "total_resistance_after", total[1]);
    put_count(o, "evaluations", r->n - 1); /* without the parent */
    put_count(o, "initial_samples", r->problem->config->initial);
    put_count(o, "failed_designs", r->failed);
    put_latent(o, r);
    put(o, "seconds", r->seconds);
    put(o, "seconds_per_evaluation", times.evaluation);
    put(o, "seconds_geometry", times.geometry);
    put(o, "seconds_solve", times.solve);
    put(o, "seconds_proposal", times.propose);
    put_count(o, "sessions", r->sessions);
    json_result_set(o, "constraints", constraints(r));
    json_result_set(o, "particulars", particulars(r));
    json_result_set(o, "verification", verification(r));
    json_result_set(o, "ladder", ladder(r));
    json_result_set(o, "robust", robust(&r->verdict));
    json_result_set(o, "agreement", agreement(r));
    json_result_set(o, "model", model(&r->model));
    json_result_set(o, "failures", failures(r));
    json_result_set(o, "settings", settings(r->problem->config->text));
    json_result_set(o, "solver", solver(&r->problem->solver));
    return o;
}
