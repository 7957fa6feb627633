#include "core/search.h"

#include "cli.h"
#include "core/constraints.h"
#include "core/conventional.h"
#include "core/descent.h"
#include "core/jobs.h"
#include "core/objective.h"
#include "core/remote.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char SEARCH[] = "search";

size_t search_budget(const struct config *config)
{
    bool descent = method_row(config->method)->kind == METHOD_DESCENT;
    return 1 + (descent ? 0 : config->initial) + config->iterations;
}

bool search_open(struct problem *problem, const char *path, struct record *record)
{
    const struct config *config = problem->config;
    const galv_model *model = problem->model;
    double lower[OUTCOME_MOST], upper[OUTCOME_MOST];
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.seed = config->search_seed;
    const struct method_row *method = method_row(config->method);
    bool design = method->kind == METHOD_DESIGN;
    options.initial_kind = design             ? method->design
                           : problem->initial ? BAYESOPT_DESIGN_LHS
                                              : (bayesopt_design_kind)config->design;
    options.initial_x = problem->initial;
    options.initial_n = config->initial + (design ? config->iterations : 0);
    options.max_evaluations = search_budget(config);
    options.strategy = config->strategy;
    options.n_input_constraints = limits_count(config);
    options.input_constraint = options.n_input_constraints ? limits_evaluate : NULL;
    options.input_user_data = problem;
    options.n_constraints = outcome_bounds(config, lower, upper);
    options.constraint_lower = lower;
    options.constraint_upper = upper;
    options.n_objectives = objectives_count(config);
    bool maximise[OBJECTIVES_MOST - 1];
    for (size_t k = 0; k + 1 < OBJECTIVES_MOST; k++)
        maximise[k] = config->other[k].maximise;
    options.maximise_others = maximise;
    *record = (struct record){0};
    if (bayesopt_create(galv_model_modes(model), galv_model_lower(model), galv_model_upper(model),
                        &options, &record->bo) == BAYESOPT_OK &&
        bayesopt_open_store(record->bo, path) == BAYESOPT_OK)
        return true;
    core_fail("%s: %s", path, bayesopt_last_error());
    record_close(record);
    return false;
}

static bool tell(struct search *s, struct evaluation *e)
{
    const struct config *config = s->problem->config;
    double length = problem_length(s->problem), told[OUTCOME_MOST + OBJECTIVES_MOST];
    e->objective = objective_of(config, length, e, &s->parent);
    size_t n = outcome_ratios(config, e, &s->parent, told);
    for (size_t k = 1; k < objectives_count(config); k++)
        told[n++] = objectives_value(config, k, length, e, &s->parent);
    return record_tell(s->record, e, told);
}

/* What the original has no value of would make of every design a failed one. */
static bool check_others(const struct search *s)
{
    const struct config *config = s->problem->config;
    struct objective o;
    for (size_t k = 1; k < objectives_count(config); k++) {
        objectives_describe(config, k, &o);
        double value =
            objectives_value(config, k, problem_length(s->problem), &s->parent, &s->parent);
        if (!isfinite(value))
            return core_fail("objective_%zu: the original has no %s", k + 1, o.name);
    }
    return true;
}

/* The parent is u = 0: told to the search before anything is asked. */
static bool begin(struct search *s)
{
    const struct config *config = s->problem->config;
    struct evaluation *list;
    size_t n;
    if (!record_evaluations(s->record, &list, &n))
        return false;
    for (size_t i = 0; i < n; i++) {
        if (list[i].id == 0) {
            s->parent = list[i];
            s->parent.u = NULL;
            s->best = list[i].objective;
        }
        if (outcome_allowed(config, &list[i], &s->parent))
            s->best = fmin(s->best, list[i].objective);
        s->failed += list[i].failed;
    }
    s->done = n;
    free(list);
    if (n)
        return true;
    double *zero = calloc(galv_model_modes(s->problem->model), sizeof *zero);
    if (!zero)
        return core_no_memory();
    core_show(s->watch, SEARCH, 0, "the original");
    evaluation_start(0, "parent", zero, &s->parent);
    evaluate_parent(s->problem, &s->parent, NULL, NULL);
    bool ok = true;
    if (s->parent.failed)
        ok = core_fail("%s: the parent cannot be evaluated (%s)", config->hull, s->parent.reason);
    else if (config->judge.command && !(s->parent.value > 0))
        ok = core_fail("objective.command: the original is worth %g, expected a positive number",
                       s->parent.value);
    else if (isnan(objective_of(config, problem_length(s->problem), &s->parent, &s->parent)))
        ok = core_fail("%s: objective.quantity: no ITTC-57 friction at Re <= 1000", config->hull);
    ok = ok && check_others(s) && tell(s, &s->parent);
    s->best = s->parent.cw;
    s->done = 1;
    s->parent.u = NULL;
    free(zero);
    return ok;
}

void search_show(const struct search *s, const char *what)
{
    char detail[240], best[40], front[40] = "";
    size_t members, all = search_budget(s->problem->config);
    objective_print(s->problem->config, problem_length(s->problem), s->best, &s->parent, best,
                    sizeof best);
    if (objectives_count(s->problem->config) > 1 &&
        bayesopt_pareto(s->record->bo, &members, NULL) == BAYESOPT_OK)
        snprintf(front, sizeof front, ", %zu in the Pareto set", members);
    snprintf(detail, sizeof detail, "%zu of %zu, %zu failed, best %s (%+.1f %%)%s%s%s", s->done,
             all, s->failed, best, 100 * (s->best / s->parent.cw - 1), front, what ? ", " : "",
             what ? what : "");
    core_show(s->watch, SEARCH, (double)s->done / (double)all, detail);
}

/* Of a command's hull that may be asked for: the best so far, or any of several objectives'. */
static bool keep_points(struct search *s, const struct evaluation *e)
{
    size_t n = galv_model_points(s->problem->model);
    double *points = malloc(3 * n * sizeof *points);
    bool ok = (points || core_no_memory()) && problem_read_points(s->problem, e->made, points) &&
              record_put_points(s->record, e->id, n, points);
    free(points);
    return ok;
}

/* Figures and value are told at once: a session that dies leaves a point that is asked again. */
static bool settle(struct search *s, struct evaluation *e)
{
    if (e->no_memory)
        return core_fail("%s: the design at hand is not on record, and --resume goes on with it",
                         e->reason);
    if (e->failed)
        core_tell(s->watch, "design %zu failed: %s", s->done, e->reason);
    if (!tell(s, e) || !record_update_session(s->record))
        return false;
    s->done++;
    s->failed += e->failed;
    if (!outcome_allowed(s->problem->config, e, &s->parent))
        return true;
    bool wanted = e->objective < s->best || objectives_count(s->problem->config) > 1;
    s->best = fmin(s->best, e->objective);
    return !*e->made || !wanted || keep_points(s, e);
}

bool search_step(struct search *s, struct evaluation *e, evaluate_look look, void *user_data)
{
    if (!core_goes_on(s->watch))
        return false;
    if (s->problem->remote)
        remote_choose(s->problem->remote, 0);
    evaluate(s->problem, e, look, user_data);
    return (!s->problem->remote || remote_learn(s->problem->remote, e, s->watch)) && settle(s, e);
}

/* The next design of the library, started; *more false, with the reason on record, when there is
 * none. */
static bool ask(struct search *s, double *u, struct evaluation *e, bool *more)
{
    uint64_t id;
    if (!core_goes_on(s->watch))
        return false;
    double start = cli_seconds();
    bayesopt_status status = bayesopt_ask(s->record->bo, 1, u, &id);
    *more = status == BAYESOPT_OK;
    if (status > 0)
        return record_put_text(s->record, "stop", bayesopt_status_string(status));
    if (status < 0)
        return core_fail("%s: %s", s->problem->config->path, bayesopt_last_error());
    evaluation_start(id, NULL, u, e);
    e->propose_seconds = cli_seconds() - start;
    return true;
}

static bool loop(struct search *s, double *u)
{
    struct evaluation e;
    for (bool more;;) {
        search_show(s, NULL);
        if (!ask(s, u, &e, &more))
            return false;
        if (!more)
            return true;
        if (!search_step(s, &e, NULL, NULL))
            return false;
    }
}

/* What the servers made of a design; one that has not answered in time is lost, and the design is
 * given to another: *again. */
static bool learn(struct search *s, struct job *job, bool *again)
{
    struct remote *remote = s->problem->remote;
    *again = remote && job->late;
    if (!remote)
        return true;
    if (*again) {
        remote_choose(remote, job->slot);
        job->evaluation.lost = (uint64_t)1 << remote->first;
        snprintf(job->evaluation.lost_reason, REASON_SIZE, "no answer after %g s",
                 s->problem->job_seconds);
    }
    bool ok = remote_learn(remote, &job->evaluation, s->watch);
    struct evaluation *e = &job->evaluation;
    if (ok && *again)
        evaluation_start(e->id, e->phase, e->u, e);
    return ok && (!*again || jobs_start(s->problem, job));
}

/* Several at once. What is at work when the run is to stop is waited for. */
static bool loop_jobs(struct search *s)
{
    struct problem *p = s->problem;
    struct job *jobs = jobs_create(p->jobs, galv_model_modes(p->model)), *job = jobs;
    bool ok = jobs || core_no_memory(), more = true;
    while (job) {
        for (size_t i = 0; i < p->jobs && ok && more; i++)
            if (!jobs[i].process) {
                ok = ask(s, jobs[i].u, &jobs[i].evaluation, &more);
                ok = ok && (!more || jobs_start(p, &jobs[i]));
            }
        search_show(s, NULL);
        job = jobs_wait(jobs, p->jobs, p->job_seconds);
        bool again = false;
        if (job && (!learn(s, job, &again) || (!again && !settle(s, &job->evaluation))))
            break;
    }
    jobs_free(jobs, p->jobs);
    return ok && !job && !more;
}

static bool run_method(struct search *s, double *u)
{
    const struct method_row *method = method_row(s->problem->config->method);
    char *stop;
    switch (method->kind) {
    case METHOD_GAUSSIAN_PROCESS:
    case METHOD_DESIGN:
        return s->problem->jobs > 1 ? loop_jobs(s) : loop(s, u);
    case METHOD_DESCENT:
        return descent_run(s, u);
    case METHOD_NLOPT:
    case METHOD_SWARM:
        break;
    }
    if (!record_get_text(s->record, "stop", &stop))
        return false;
    bool stopped = stop != NULL;
    free(stop);
    if (stopped)
        return true;
    return method->kind == METHOD_NLOPT ? conventional_run(s, method) : swarm_run(s, method);
}

bool search_run(struct problem *problem, struct record *record, const struct core_watch *watch)
{
    struct search s = {.problem = problem, .record = record, .watch = watch};
    double *u = malloc(galv_model_modes(problem->model) * sizeof *u);
    size_t modes = galv_model_modes(problem->model);
    bool ok = (u || core_no_memory()) && begin(&s) &&
              (!problem->remote || remote_check(problem->remote, &s.parent, modes)) &&
              run_method(&s, u);
    free(u);
    return ok;
}
