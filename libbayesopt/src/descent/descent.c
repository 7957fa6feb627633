/* The search of bayesopt/descent.h. */
#include "core/error.h"
#include "descent/descent_model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Radii in half widths of the box: models of residuals such as a wave's amplitudes hold to about
 * 0.4. */
static const double FIRST_RADIUS = 0.4, LEAST_RADIUS = 0.02, MOST_RADIUS = 1, GROWTH = 1.5,
                    RESTART_RADIUS = 0.1;
static const double DIFFERENCE = 0.03; /* step of the differences, half widths */
static const double LEAST_GAIN = 1e-3, LEAST_OF_A_CYCLE = 5e-3; /* of the ratio */
enum { MORE_STEPS = 2 };                                        /* with the same derivatives */
/* Limits are tightened more where steps end outside by as little. */
static const double SMALL_EXCESS = 5e-3, MOST_MARGIN = 1e-2;
/* Shares of the promised progress: a shorter radius below, a longer one above. */
static const double POOR = 0.25, GOOD = 0.7;
/* The penalty is raised where a search would end outside. */
static const double MORE = 10, MOST_PENALTY = 1000;

struct run {
    const descent_problem *problem;
    descent_model model; /* at the point that the search has come to */
    descent_sample candidate;
    double *trial, *step;
    double *best, least;     /* the best that keeps all limits; HUGE_VAL: none yet */
    bayesopt_status failure; /* of a step */
};

static void swap(descent_sample *a, descent_sample *b)
{
    descent_sample keep = *a;
    *a = *b;
    *b = keep;
}

static double ratio(const struct run *run, const descent_sample *s, size_t m)
{
    return s->value[m] / run->model.start[m];
}

/* The objective: the largest ratio of its settings. */
static double merit(const struct run *run, const descent_sample *s)
{
    const descent_problem *p = run->problem;
    double most = 0;
    for (size_t m = 0; m < p->n_settings; m++)
        if (setting_is_objective(&p->setting[m]))
            most = fmax(most, ratio(run, s, m));
    return most;
}

/* By how much the fine values break the limits of setting m (b: m = n_settings). */
static double excess(const struct run *run, const descent_sample *s, size_t m)
{
    const descent_problem *p = run->problem;
    if (m == p->n_settings)
        return isnan(p->bound) ? -1 : s->bounded / run->model.start_bounded - p->bound;
    return ratio(run, s, m) - p->setting[m].offset - p->setting[m].share * merit(run, s);
}

static double worst_excess(const struct run *run, const descent_sample *s)
{
    const descent_problem *p = run->problem;
    double most = -HUGE_VAL;
    for (size_t m = 0; m <= p->n_settings; m++)
        if (m == p->n_settings || !setting_is_objective(&p->setting[m]))
            most = fmax(most, excess(run, s, m));
    return most;
}

/* What the differences of one derivative work with. */
struct difference {
    bayesopt_descent_slopes known;
    descent_sample at, moved;
    double *trial; /* [d] */
};

/* The other side where a point has no value or the box ends. */
static bayesopt_descent_answer move(const descent_model *model, size_t k, struct difference *work,
                                    double *step)
{
    const descent_problem *p = model->problem;
    bayesopt_descent_answer answer = BAYESOPT_DESCENT_FAILED;
    *step = DIFFERENCE * (p->upper[k] - p->lower[k]) / 2;
    for (int side = 0; side < 2 && answer == BAYESOPT_DESCENT_FAILED; side++, *step = -*step) {
        memcpy(work->trial, model->x, p->d * sizeof *work->trial);
        work->trial[k] += *step;
        if (work->trial[k] >= p->lower[k] && work->trial[k] <= p->upper[k])
            answer = descent_coarse(p, work->trial, &work->known, &work->moved);
        if (answer != BAYESOPT_DESCENT_FAILED)
            return answer;
    }
    return answer;
}

static bayesopt_status status_of(bayesopt_descent_answer answer, const char *what, size_t k)
{
    switch (answer) {
    case BAYESOPT_DESCENT_VALUED:
        return BAYESOPT_OK;
    case BAYESOPT_DESCENT_STOP:
        return BAYESOPT_STOP_BUDGET;
    case BAYESOPT_DESCENT_FAILED:
        break;
    }
    return bayesopt_fail(BAYESOPT_ERROR_NUMERIC, what, k);
}

static bayesopt_status difference_all(descent_model *model, struct difference *work)
{
    const descent_problem *p = model->problem;
    bayesopt_descent_answer answer = descent_slopes(p, model->x, &work->known);
    if (answer == BAYESOPT_DESCENT_VALUED && slopes_complete(p, &work->known))
        return BAYESOPT_OK;
    if (answer == BAYESOPT_DESCENT_VALUED)
        answer = descent_coarse(p, model->x, &work->known, &work->at);
    bayesopt_status status = status_of(
        answer, "there is no coarse value where derivatives by all %zu variables are taken", p->d);
    for (size_t k = 0; k < p->d && !status; k++) {
        double step;
        status = status_of(move(model, k, work, &step),
                           "there is no coarse value on either side of variable %zu", k);
        if (!status)
            descent_model_difference(model, &work->known, k, step, &work->at, &work->moved);
    }
    return status;
}

bayesopt_status descent_differentiate(descent_model *model)
{
    const descent_problem *p = model->problem;
    struct difference work = {.trial = malloc(p->d * sizeof *work.trial)};
    bool ok = sample_create(p, &work.at) && work.trial;
    ok = sample_create(p, &work.moved) && ok;
    ok = slopes_create(p, model, &work.known) && ok;
    bayesopt_status status =
        ok ? difference_all(model, &work) : bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    sample_free(&work.at);
    sample_free(&work.moved);
    free(work.known.known);
    free(work.trial);
    return status;
}

bayesopt_status descent_start(descent_model *model, const double *start)
{
    const descent_problem *p = model->problem;
    if (start)
        memcpy(model->x, start, p->d * sizeof *start);
    memcpy(model->anchor, model->x, p->d * sizeof *model->x);
    bayesopt_descent_answer answer = descent_fine(p, model->x, &model->base);
    if (answer != BAYESOPT_DESCENT_VALUED)
        return bayesopt_fail(answer == BAYESOPT_DESCENT_STOP ? BAYESOPT_ERROR_CANCELLED
                                                             : BAYESOPT_ERROR_NUMERIC,
                             "the start has no value");
    for (size_t m = 0; m < p->n_settings; m++)
        if (!(model->base.value[m] > 0))
            return bayesopt_fail(BAYESOPT_ERROR_NUMERIC,
                                 "setting %zu is %g at the start, expected a positive number", m,
                                 model->base.value[m]);
    if (!isnan(p->bound) && !(model->base.bounded > 0))
        return bayesopt_fail(BAYESOPT_ERROR_NUMERIC,
                             "what is bounded is %g at the start, expected a positive number",
                             model->base.bounded);
    memcpy(model->start, model->base.value, p->n_settings * sizeof *model->start);
    model->start_bounded = model->base.bounded;
    return BAYESOPT_OK;
}

/* The objective with a penalty for what is broken: progress is what lowers it. */
static double progress(const struct run *run, const descent_sample *s)
{
    return merit(run, s) + run->model.penalty * fmax(worst_excess(run, s), 0);
}

static void note_best(struct run *run, const double *x, const descent_sample *s)
{
    if (worst_excess(run, s) > 0 || merit(run, s) >= run->least)
        return;
    run->least = merit(run, s);
    memcpy(run->best, x, run->problem->d * sizeof *x);
}

/* Values the step from x. */
static bayesopt_descent_answer value_candidate(struct run *run, double radius, double promised)
{
    const descent_problem *p = run->problem;
    char line[160];
    for (size_t k = 0; k < p->d; k++) {
        run->trial[k] = fmin(fmax(run->model.x[k] + run->step[k], p->lower[k]), p->upper[k]);
        run->step[k] = run->trial[k] - run->model.x[k];
    }
    bayesopt_descent_answer answer = descent_fine(p, run->trial, &run->candidate);
    if (answer != BAYESOPT_DESCENT_VALUED)
        return answer;
    double broken = worst_excess(run, &run->candidate);
    int length = snprintf(line, sizeof line, "radius %.2f: promised %.4f, is %.4f", radius,
                          promised, merit(run, &run->candidate));
    if (broken > 0)
        snprintf(line + length, sizeof line - (size_t)length, ", %.2g outside", broken);
    if (p->tell)
        p->tell(p->user_data, line);
    note_best(run, run->trial, &run->candidate);
    return answer;
}

/* One step of the model at hand, if it promises at least so much. *share: of the promised progress
 * that was made, -1 where the point has no value; NAN: too little is promised. */
static bayesopt_descent_answer try_step(struct run *run, double radius, double least, double *share)
{
    descent_model *model = &run->model;
    double before = progress(run, &model->base), broken = 0, tau;
    run->failure = descent_model_step(model, radius, run->step, &broken, &tau);
    if (run->failure)
        return BAYESOPT_DESCENT_STOP;
    double promised = before - tau - model->penalty * fmax(broken - model->margin, 0);
    *share = NAN;
    if (!(promised > least))
        return BAYESOPT_DESCENT_VALUED;
    bayesopt_descent_answer answer = value_candidate(run, radius, tau);
    *share = -1;
    if (answer != BAYESOPT_DESCENT_VALUED)
        return answer;
    *share = (before - progress(run, &run->candidate)) / promised;
    descent_model_update(model, run->step, &run->candidate);
    double over = worst_excess(run, &run->candidate);
    if (over > 0 && over < SMALL_EXCESS)
        model->margin = fmin(model->margin + over, MOST_MARGIN);
    if (*share > 0) {
        swap(&model->base, &run->candidate);
        memcpy(model->x, run->trial, run->problem->d * sizeof *model->x);
    }
    return answer;
}

/* Steps of new derivatives, shorter until one makes progress. While they come as promised the next
 * looks farther, and what one broke of a limit the next mends by its fine values. false: an
 * evaluation said stop, or run->failure. */
static bool cycle(struct run *run, double *radius)
{
    double share = -1;
    while (share <= 0 && *radius >= LEAST_RADIUS) {
        if (try_step(run, *radius, LEAST_GAIN, &share) == BAYESOPT_DESCENT_STOP)
            return false;
        if (isnan(share))
            return true;
        if (share < POOR)
            *radius /= 2;
    }
    for (int k = 0; k < MORE_STEPS && share > POOR; k++) {
        if (share > GOOD)
            *radius = fmin(GROWTH * *radius, MOST_RADIUS);
        else if (worst_excess(run, &run->model.base) <= 0)
            break;
        if (try_step(run, *radius, LEAST_GAIN, &share) == BAYESOPT_DESCENT_STOP)
            return false;
        if (share < POOR)
            *radius /= GROWTH;
    }
    return true;
}

/* New derivatives, without which a search that has begun ends where it is. *goes_on: false then. */
static bayesopt_status renew(struct run *run, bool *goes_on)
{
    const descent_problem *p = run->problem;
    bayesopt_status status = descent_differentiate(&run->model);
    if (status != BAYESOPT_ERROR_NUMERIC)
        return status;
    if (p->tell)
        p->tell(p->user_data, bayesopt_last_error());
    *goes_on = false;
    return BAYESOPT_OK;
}

static bayesopt_status search(struct run *run)
{
    descent_model *model = &run->model;
    double radius = FIRST_RADIUS;
    bayesopt_status status = descent_differentiate(model);
    for (bool goes_on = true; goes_on && !status;) {
        double before = progress(run, &model->base);
        if (!cycle(run, &radius))
            return run->failure ? run->failure : BAYESOPT_STOP_BUDGET;
        goes_on = progress(run, &model->base) < before - LEAST_OF_A_CYCLE;
        radius = fmax(radius, RESTART_RADIUS);
        if (!goes_on && worst_excess(run, &model->base) > 0 && model->penalty < MOST_PENALTY) {
            model->penalty *= MORE;
            goes_on = true;
        }
        memcpy(model->anchor, model->x, run->problem->d * sizeof *model->x);
        if (goes_on)
            status = renew(run, &goes_on);
    }
    return status;
}

static bool run_create(const descent_problem *problem, struct run *run)
{
    size_t d = problem->d;
    *run = (struct run){.problem = problem, .least = HUGE_VAL};
    run->trial = calloc(3 * d, sizeof *run->trial);
    bool ok = descent_model_init(problem, &run->model) && run->trial;
    if (run->trial) {
        run->step = run->trial + d;
        run->best = run->trial + 2 * d;
    }
    return sample_create(problem, &run->candidate) && ok;
}

static void run_free(struct run *run)
{
    sample_free(&run->candidate);
    descent_model_clear(&run->model);
    free(run->trial);
}

bayesopt_status bayesopt_descend(const bayesopt_descent_problem *problem, double *x, double *least)
{
    NEED(problem);
    NEED(x);
    bayesopt_status status = descent_check(problem, x);
    if (status)
        return status;
    struct run run;
    bool ok = run_create(problem, &run);
    status =
        ok ? descent_start(&run.model, x) : bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    double outside = HUGE_VAL;
    if (!status)
        status = descent_model_trespass(&run.model, &outside);
    if (!status) {
        if (outside <= DESCENT_OUTSIDE)
            note_best(&run, run.model.x, &run.model.base);
        status = search(&run);
    }
    if (status >= 0) {
        bool found = run.least < HUGE_VAL;
        memcpy(x, found ? run.best : run.model.x, problem->d * sizeof *x);
        if (least)
            *least = found ? run.least : merit(&run, &run.model.base);
        if (!found && !status)
            status = BAYESOPT_NONE_FEASIBLE;
    }
    run_free(&run);
    return status;
}
