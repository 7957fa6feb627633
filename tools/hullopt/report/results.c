#include "report/results.h"

#include "core/constraints.h"
#include "core/objective.h"
#include "core/optimise.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const nurbs_hull *results_hull(const struct results *r, int which)
{
    return (which ? problem_best(r->problem) : &r->problem->parent)->hull;
}

static bool read_evaluations(const struct record *record, struct results *r)
{
    if (!record_evaluations(record, &r->evaluations, &r->n))
        return false;
    if (r->n == 0 || r->evaluations[0].id != 0)
        return core_fail("nothing has been evaluated yet");
    r->baseline = r->evaluations;
    r->best = outcome_best(r->problem->config, r->n, r->evaluations);
    for (size_t i = 0; i < r->n; i++)
        r->failed += r->evaluations[i].failed;
    return r->best || core_fail("the parent is recorded as a failure: %s", r->baseline->reason);
}

static bool read_parameters(const struct record *record, struct results *r)
{
    size_t one, n;
    double *residual;
    r->residual = NAN;
    if (!record_get_array(record, "best.parameters", &one, &r->n_parameters, &r->parameters) ||
        !record_get_array(record, "best.residual", &one, &n, &residual))
        return false;
    if (residual && one * n == 1)
        r->residual = *residual;
    free(residual);
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

bool results_read(struct problem *problem, const struct record *record, struct results *r)
{
    *r = (struct results){.problem = problem};
    bool ok = read_evaluations(record, r) &&
              (r->best == r->baseline || problem->best.hull ||
               optimise_set_best(problem, record, r->best)) &&
              record_get_text(record, "stop", &r->stop) &&
              record_verifications(record, &r->rows, &r->n_rows) &&
              waves_read(record, false, &r->waves[0]) && waves_read(record, true, &r->waves[1]) &&
              read_parameters(record, r) && record_seconds(record, &r->sessions, &r->seconds);
    if (!ok) {
        results_free(r);
        return false;
    }
    verdict_reach(r->rows, r->n_rows, &r->verdict);
    if (problem->config->judge.command)
        tell_of_command(r);
    r->complete = r->stop && r->n_rows > 0 && r->waves[0].elevation &&
                  (r->waves[1].elevation || r->best == r->baseline);
    return true;
}

void results_free(struct results *r)
{
    for (int k = 0; k < 2; k++)
        free(r->waves[k].elevation);
    free(r->evaluations);
    free(r->rows);
    free(r->parameters);
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
