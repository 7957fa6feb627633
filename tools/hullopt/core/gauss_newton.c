#include "core/gauss_newton.h"

#include "core/gn_model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { R = GN_RESIDUALS };
/* Radii in half widths of the box: models of the Kochin function hold to about 0.4. */
static const double FIRST_RADIUS = 0.4, LEAST_RADIUS = 0.02, MOST_RADIUS = 1, GROWTH = 1.5,
                    RESTART_RADIUS = 0.1;
static const double DIFFERENCE = 0.03; /* step of the differences, half widths */
static const double LEAST_GAIN = 1e-3, LEAST_OF_A_CYCLE = 5e-3; /* of the ratio */
enum { MORE_STEPS = 2 };                                        /* with the same derivatives */
/* By which every limit is tightened: more where steps end outside by as little. */
static const double MARGIN = 2e-3, SMALL_EXCESS = 5e-3, MOST_MARGIN = 1e-2;
/* Shares of the promised progress: a shorter radius below, a longer one above. */
static const double POOR = 0.25, GOOD = 0.7;
/* Of an excess: exact as long as it is above the multipliers of the step's problem, which are of
 * order one, and raised where a search would end outside. */
static const double PENALTY = 3, MORE = 10, MOST_PENALTY = 1000;

struct run {
    const struct gn_problem *problem;
    struct gn_model model;
    struct gn_sample at, candidate, coarse, moved;
    double *x, *trial, *step;
    double *best, least; /* the best that keeps all limits */
};

static bool sample_create(const struct gn_problem *p, struct gn_sample *s)
{
    *s = (struct gn_sample){.points = p->points};
    s->residual = malloc(p->settings * R * sizeof(double));
    s->value = malloc(p->settings * sizeof(double));
    s->point = malloc((p->points + 1) * sizeof *s->point);
    return s->residual && s->value && s->point;
}

static void sample_free(struct gn_sample *s)
{
    free(s->residual);
    free(s->value);
    free(s->point);
}

static void swap(struct gn_sample *a, struct gn_sample *b)
{
    struct gn_sample keep = *a;
    *a = *b;
    *b = keep;
}

static void say(const struct gn_problem *p, const char *sentence)
{
    if (p->tell)
        p->tell(p->user_data, sentence);
}

static double ratio(const struct run *run, const struct gn_sample *s, size_t m)
{
    return s->value[m] / run->model.parent[m];
}

/* The objective: the largest ratio of its settings. */
static double merit(const struct run *run, const struct gn_sample *s)
{
    const struct gn_problem *p = run->problem;
    double most = 0;
    for (size_t m = 0; m < p->settings; m++)
        if (gn_is_objective(&p->setting[m]))
            most = fmax(most, ratio(run, s, m));
    return most;
}

/* By how much the fine values break the limits of setting m (the pressure: m = settings). */
static double excess(const struct run *run, const struct gn_sample *s, size_t m)
{
    const struct gn_problem *p = run->problem;
    if (m == p->settings)
        return isnan(p->pressure) ? -1 : s->pressure / run->model.parent_pressure - p->pressure;
    return ratio(run, s, m) - p->setting[m].offset - p->setting[m].share * merit(run, s);
}

static double worst_excess(const struct run *run, const struct gn_sample *s)
{
    const struct gn_problem *p = run->problem;
    double most = -HUGE_VAL;
    for (size_t m = 0; m <= p->settings; m++)
        if (m == p->settings || !gn_is_objective(&p->setting[m]))
            most = fmax(most, excess(run, s, m));
    return most;
}

/* The other side where a design cannot be built or the box ends. */
static enum gn_answer move(struct run *run, size_t k, double *step)
{
    const struct gn_problem *p = run->problem;
    enum gn_answer answer = GN_FAILED;
    *step = DIFFERENCE * (p->upper[k] - p->lower[k]) / 2;
    for (int side = 0; side < 2 && answer == GN_FAILED; side++, *step = -*step) {
        memcpy(run->trial, run->x, p->n * sizeof *run->trial);
        run->trial[k] += *step;
        if (run->trial[k] >= p->lower[k] && run->trial[k] <= p->upper[k])
            answer = p->coarse(p->user_data, run->trial, &run->moved);
        if (answer != GN_FAILED)
            return answer;
    }
    return answer;
}

static enum gn_answer differentiate(struct run *run)
{
    const struct gn_problem *p = run->problem;
    enum gn_answer answer = p->coarse(p->user_data, run->x, &run->coarse);
    for (size_t k = 0; k < p->n && answer == GN_VALUED; k++) {
        double step;
        answer = move(run, k, &step);
        if (answer == GN_VALUED)
            gn_model_differentiate(&run->model, k, step, &run->coarse, &run->moved);
    }
    return answer;
}

/* The objective with a penalty for what is broken: progress is what lowers it. */
static double progress(const struct run *run, const struct gn_sample *s)
{
    return merit(run, s) + run->model.penalty * fmax(worst_excess(run, s), 0);
}

/* The original and its fine values, at which every ratio is one. */
static bool start(struct run *run)
{
    const struct gn_problem *p = run->problem;
    if (p->fine(p->user_data, run->x, &run->at) != GN_VALUED)
        return false;
    memcpy(run->model.parent, run->at.value, p->settings * sizeof *run->model.parent);
    run->model.parent_pressure = run->at.pressure;
    run->model.margin = MARGIN;
    run->model.penalty = PENALTY;
    run->model.x = run->x;
    run->model.base = run->at;
    return true;
}

static void note_best(struct run *run, const double *x, const struct gn_sample *s)
{
    if (worst_excess(run, s) > 0 || merit(run, s) >= run->least)
        return;
    run->least = merit(run, s);
    memcpy(run->best, x, run->problem->n * sizeof *x);
}

/* Values the step d from x. */
static enum gn_answer value_candidate(struct run *run, double radius, double promised)
{
    const struct gn_problem *p = run->problem;
    char line[160];
    for (size_t k = 0; k < p->n; k++) {
        run->trial[k] = fmin(fmax(run->x[k] + run->step[k], p->lower[k]), p->upper[k]);
        run->step[k] = run->trial[k] - run->x[k];
    }
    enum gn_answer answer = p->fine(p->user_data, run->trial, &run->candidate);
    if (answer != GN_VALUED)
        return answer;
    double broken = worst_excess(run, &run->candidate);
    int length = snprintf(line, sizeof line, "radius %.2f: promised %.4f, is %.4f", radius,
                          promised, merit(run, &run->candidate));
    if (broken > 0)
        snprintf(line + length, sizeof line - (size_t)length, ", %.2g outside", broken);
    say(p, line);
    note_best(run, run->trial, &run->candidate);
    return answer;
}

/* One step of the model at hand, if it promises at least so much. *share: of the promised progress
 * that was made, -1 where the design could not be had; NAN: too little is promised. */
static enum gn_answer try_step(struct run *run, double radius, double least, double *share)
{
    double before = progress(run, &run->at), broken = 0;
    run->model.base = run->at;
    double tau = gn_model_minimise(&run->model, radius, run->step, &broken);
    double promised = before - tau - run->model.penalty * fmax(broken - run->model.margin, 0);
    *share = NAN;
    if (!(promised > least))
        return GN_VALUED;
    enum gn_answer answer = value_candidate(run, radius, tau);
    *share = -1;
    if (answer != GN_VALUED)
        return answer;
    *share = (before - progress(run, &run->candidate)) / promised;
    gn_model_update(&run->model, run->step, &run->candidate);
    double over = worst_excess(run, &run->candidate);
    if (over > 0 && over < SMALL_EXCESS)
        run->model.margin = fmin(run->model.margin + over, MOST_MARGIN);
    if (*share > 0) {
        swap(&run->at, &run->candidate);
        memcpy(run->x, run->trial, run->problem->n * sizeof *run->x);
    }
    return answer;
}

/* Steps of new derivatives, shorter until one makes progress. While they come as promised the next
 * looks farther, and what one broke of a limit the next mends by its fine values. */
static enum gn_answer cycle(struct run *run, double *radius)
{
    double share = -1;
    enum gn_answer answer = GN_VALUED;
    while (share <= 0 && *radius >= LEAST_RADIUS) {
        answer = try_step(run, *radius, LEAST_GAIN, &share);
        if (answer == GN_STOP || isnan(share))
            return answer;
        if (share < POOR)
            *radius /= 2;
    }
    for (int k = 0; k < MORE_STEPS && share > POOR; k++) {
        if (share > GOOD)
            *radius = fmin(GROWTH * *radius, MOST_RADIUS);
        else if (worst_excess(run, &run->at) <= 0)
            break;
        answer = try_step(run, *radius, LEAST_GAIN, &share);
        if (answer == GN_STOP)
            return answer;
        if (share < POOR)
            *radius /= GROWTH;
    }
    return GN_VALUED;
}

static bool search(struct run *run)
{
    double radius = FIRST_RADIUS;
    if (!start(run))
        return false;
    run->least = 1;
    for (bool goes_on = true; goes_on;) {
        double before = progress(run, &run->at);
        memcpy(run->model.anchor, run->x, run->problem->n * sizeof *run->x);
        enum gn_answer answer = differentiate(run);
        if (answer == GN_VALUED)
            answer = cycle(run, &radius);
        if (answer != GN_VALUED)
            break;
        goes_on = progress(run, &run->at) < before - LEAST_OF_A_CYCLE;
        radius = fmax(radius, RESTART_RADIUS);
        if (!goes_on && worst_excess(run, &run->at) > 0 && run->model.penalty < MOST_PENALTY) {
            run->model.penalty *= MORE;
            goes_on = true;
        }
    }
    return true;
}

static bool run_create(const struct gn_problem *problem, struct run *run)
{
    size_t n = problem->n;
    *run = (struct run){.problem = problem, .x = calloc(4 * n, sizeof(double))};
    bool ok = gn_model_create(problem, &run->model) && run->x;
    if (run->x) {
        run->trial = run->x + n;
        run->step = run->x + 2 * n;
        run->best = run->x + 3 * n;
    }
    struct gn_sample *samples[] = {&run->at, &run->candidate, &run->coarse, &run->moved};
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++)
        ok = sample_create(problem, samples[i]) && ok;
    return ok;
}

static void run_free(struct run *run)
{
    sample_free(&run->at);
    sample_free(&run->candidate);
    sample_free(&run->coarse);
    sample_free(&run->moved);
    gn_model_free(&run->model);
    free(run->x);
}

bool gn_run(const struct gn_problem *problem, double *x)
{
    struct run run;
    bool ok = run_create(problem, &run) && search(&run);
    if (ok)
        memcpy(x, run.best, problem->n * sizeof *x);
    run_free(&run);
    return ok;
}

bool gn_at_parent(const struct gn_problem *p, struct gn_model *model)
{
    struct run run;
    bool ok = run_create(p, &run) && start(&run) && differentiate(&run) == GN_VALUED;
    if (ok) { /* it takes what it borrowed */
        *model = run.model;
        run.model = (struct gn_model){0};
        run.at = (struct gn_sample){0};
        run.x = NULL;
    }
    run_free(&run);
    return ok;
}

void gn_leave(struct gn_model *model)
{
    struct gn_sample base = model->base;
    sample_free(&base);
    free((void *)model->x);
    gn_model_free(model);
}
