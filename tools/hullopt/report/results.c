#include "report/results.h"

#include "core/constraints.h"
#include "core/front.h"
#include "core/objective.h"
#include "core/optimise.h"
#include "core/verify.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const nurbs_hull *results_hull(const struct results *r, int which)
{
    return (which ? problem_best(r->problem) : &r->problem->parent)->hull;
}

/* The design of an id instead of the best. */
static bool choose(size_t design, struct results *r)
{
    size_t i = 1;
    while (i < r->n && r->evaluations[i].id != design)
        i++;
    if (i == r->n)
        return core_fail("design %zu is not on record", design);
    if (r->evaluations[i].failed)
        return core_fail("design %zu has failed: %s", design, r->evaluations[i].reason);
    r->chosen = r->best != &r->evaluations[i];
    r->best = &r->evaluations[i];
    return true;
}

static bool read_evaluations(const struct record *record, size_t design, struct results *r)
{
    const struct config *config = r->problem->config;
    if (!record_evaluations(record, &r->evaluations, &r->n))
        return false;
    if (r->n == 0 || r->evaluations[0].id != 0)
        return core_fail("nothing has been evaluated yet");
    r->baseline = r->evaluations;
    r->front = malloc(r->n * sizeof *r->front);
    if (!r->front)
        return core_no_memory();
    if ((objectives_count(config) > 1 &&
         !front_of(record, r->n, r->evaluations, &r->n_front, r->front)) ||
        !front_best(record, config, problem_length(r->problem), r->n, r->evaluations, &r->best))
        return false;
    for (size_t i = 0; i < r->n; i++)
        r->failed += r->evaluations[i].failed;
    if (!r->best)
        return core_fail("the parent is recorded as a failure: %s", r->baseline->reason);
    return !design || choose(design, r);
}

static bool read_parameters(const struct record *record, struct results *r)
{
    size_t one, n;
    double *residual, *made = NULL;
    if (!record_get_array(record, "best.parameters", &one, &r->n_parameters, &r->parameters) ||
        !record_get_array(record, "best.residual", &one, &n, &residual))
        return false;
    if (residual && one * n == 1)
        r->residual = *residual;
    free(residual);
    if (!record_get_text(record, "best.made", &r->made) ||
        !record_get_array(record, "best.made.cw", &one, &n, &made))
        return false;
    r->made_cw = made ? *made : (double)NAN;
    free(made);
    return true;
}

/* The verification is about C_w, which was not lowered. */
static void tell_of_command(struct results *r)
{
    char *text = r->verdict.statement, of_cw[sizeof r->verdict.statement + 20];
    static const char objective[] = "The objective sees", solver[] = "The solver sees";
    bool sees = strncmp(text, objective, sizeof objective - 1) == 0;
    snprintf(of_cw, sizeof of_cw, "%s%s", sees ? solver : "",
             text + (sees ? sizeof objective - 1 : 0));
    snprintf(text, sizeof r->verdict.statement,
             "The number of the command changes by %+.1f %%. C_w, which was not lowered: %.800s",
             100 * (r->best->value / r->baseline->value - 1), of_cw);
}

/* What the run did with its best. */
static bool read_verification(const struct record *record, struct results *r)
{
    return record_verifications(record, &r->rows, &r->n_rows) &&
           waves_read(record, false, &r->waves[0]) && waves_read(record, true, &r->waves[1]) &&
           read_parameters(record, r);
}

const char *results_statement(const struct results *r)
{
    return r->n_rows   ? r->verdict.statement
           : r->chosen ? "A design chosen from the record: no other model has verified its gain."
                       : "The run is not finished: the optimum has not been verified yet.";
}

bool results_read(struct problem *problem, const struct record *record, size_t design,
                  struct results *r)
{
    *r = (struct results){.problem = problem, .residual = NAN};
    bool ok = read_evaluations(record, design, r) &&
              (r->best == r->baseline || problem->best.hull ||
               optimise_set_best(problem, record, r->best)) &&
              record_get_text(record, "stop", &r->stop) &&
              (r->chosen || read_verification(record, r)) &&
              record_seconds(record, &r->sessions, &r->seconds) &&
              model_read(record, problem->config, r->baseline->cw, &r->model);
    if (!ok) {
        results_free(r);
        return false;
    }
    verdict_reach(r->rows, r->n_rows, &r->verdict);
    if (problem->config->judge.command && r->n_rows)
        tell_of_command(r);
    r->complete = r->stop && r->n_rows > 0 && r->waves[0].elevation &&
                  (r->waves[1].elevation || r->best == r->baseline);
    return true;
}

size_t results_parameters(const struct results *r)
{
    const struct config *config = r->problem->config;
    return config->maker.command ? config->n_parameters : galv_model_parameters(r->problem->model);
}

double results_objective(const struct results *r, size_t k, const struct evaluation *e)
{
    const struct config *config = r->problem->config;
    struct objective o;
    objectives_describe(config, k, &o);
    return o.scale * objectives_value(config, k, problem_length(r->problem), e, r->baseline);
}

void results_free(struct results *r)
{
    for (int k = 0; k < 2; k++)
        free(r->waves[k].elevation);
    model_free(&r->model);
    free(r->evaluations);
    free(r->front);
    free(r->rows);
    free(r->parameters);
    free(r->made);
    free(r->stop);
    *r = (struct results){0};
}

void results_total_resistance(const struct results *r, double total[2])
{
    const struct evaluation *e[2] = {r->baseline, r->best};
    for (int k = 0; k < 2; k++)
        total[k] = objective_total_resistance(r->problem->config, problem_length(r->problem), e[k]);
}

struct results_times results_times(const struct results *r)
{
    struct results_times t = {0, 0, 0, 0};
    for (size_t i = 0; i < r->n; i++) {
        t.geometry += r->evaluations[i].geometry_seconds;
        t.solve += r->evaluations[i].solve_seconds;
        t.propose += r->evaluations[i].propose_seconds;
    }
    double n = r->n ? (double)r->n : 1;
    t.geometry /= n;
    t.solve /= n;
    t.propose /= n;
    t.evaluation = t.geometry + t.solve;
    return t;
}

bool results_ladder(const struct results *r, struct results_ladder *ladder)
{
    *ladder = (struct results_ladder){.cw = {NAN, NAN, NAN}};
    for (size_t i = 0; i < r->n_rows; i++) {
        const struct verification *v = &r->rows[i];
        if (v->group == GROUP_COARSER)
            ladder->cw[0] = v->cw_best;
        if (v->group == GROUP_OBJECTIVE)
            ladder->cw[1] = v->cw_best;
        if (v->group == GROUP_RESOLUTION) {
            ladder->cw[2] = v->cw_best;
            ladder->refine = r->problem->config->verify_refine;
        }
    }
    const double width[3] = {1 / VERIFY_COARSER, 1, 1 / ladder->refine};
    return isfinite(ladder->cw[0] + ladder->cw[1] + ladder->cw[2]) &&
           igabem_ladder_order(width, ladder->cw, &ladder->order, &ladder->limit) == IGABEM_OK;
}
