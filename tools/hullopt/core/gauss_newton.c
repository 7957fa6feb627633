#include "core/gauss_newton.h"

#include "core/gn_model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { R = IGABEM_WAVE_RESIDUALS, TRIES = 6 };
/* Radii in half widths of the box: models of the Kochin function hold to about 0.4. */
static const double FIRST_RADIUS = 0.4, LEAST_RADIUS = 0.02, MOST_RADIUS = 1, GROWTH = 1.5,
                    SETTLE_RADIUS = 0.1;
static const double DIFFERENCE = 0.03; /* step of the differences, half widths */
static const double LEAST_GAIN = 2e-3; /* of the ratio in a step */
static const double SLACK = 2e-3;      /* by which every limit is tightened */
/* An excess weighs as much in the progress of the search: an l1 penalty, exact as long as it is
 * above the multipliers of the step's problem, which are of order one. */
static const double PENALTY = 3;

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
        if (p->setting[m].share == 1 && p->setting[m].offset == 0)
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
    double most = -HUGE_VAL;
    for (size_t m = 0; m <= run->problem->settings; m++)
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
    return merit(run, s) + PENALTY * fmax(worst_excess(run, s), 0);
}

static void note_best(struct run *run, const double *x, const struct gn_sample *s)
{
    if (worst_excess(run, s) > 0 || merit(run, s) >= run->least)
        return;
    run->least = merit(run, s);
    memcpy(run->best, x, run->problem->n * sizeof *x);
}

/* What the rejected candidate breaks is tightened by as much. */
static void tighten(struct run *run)
{
    for (size_t m = 0; m <= run->problem->settings; m++)
        run->model.shift[m] += fmax(excess(run, &run->candidate, m), 0);
}

static enum gn_answer value_candidate(struct run *run, double radius, double promised)
{
    const struct gn_problem *p = run->problem;
    char line[160];
    for (size_t k = 0; k < p->n; k++)
        run->trial[k] = fmin(fmax(run->x[k] + run->step[k], p->lower[k]), p->upper[k]);
    enum gn_answer answer = p->fine(p->user_data, run->trial, &run->candidate);
    if (answer != GN_VALUED)
        return answer;
    double broken = worst_excess(run, &run->candidate);
    snprintf(line, sizeof line, "radius %.2f: promised %.4f, is %.4f%s", radius, promised,
             merit(run, &run->candidate), broken > 0 ? ", breaks a limit" : "");
    say(p, line);
    note_best(run, run->trial, &run->candidate);
    return answer;
}

/* Steps from the design at hand until one makes progress by its fine values. */
static enum gn_answer advance(struct run *run, double *radius, bool *better)
{
    double before = progress(run, &run->at);
    *better = false;
    for (int attempt = 0; attempt < TRIES && !*better && *radius >= LEAST_RADIUS; attempt++) {
        double promised = gn_model_minimise(&run->model, *radius, run->step);
        if (!(promised < before - LEAST_GAIN / 2))
            break;
        enum gn_answer answer = value_candidate(run, *radius, promised);
        if (answer == GN_STOP)
            return answer;
        *better = answer == GN_VALUED && progress(run, &run->candidate) < before;
        if (*better)
            break;
        if (answer == GN_VALUED)
            tighten(run);
        *radius /= 2;
    }
    return GN_VALUED;
}

/* Where a search ends outside of the limits by little, the derivatives at hand lead it back: each
 * try aims inside by what the last was outside. */
static void settle(struct run *run)
{
    for (int attempt = 0; attempt < TRIES && worst_excess(run, &run->at) > 0; attempt++) {
        run->model.x = run->x;
        run->model.base = run->at;
        double promised = gn_model_minimise(&run->model, SETTLE_RADIUS, run->step);
        if (isnan(promised))
            break;
        if (value_candidate(run, SETTLE_RADIUS, promised) != GN_VALUED)
            break;
        tighten(run);
        swap(&run->at, &run->candidate);
        memcpy(run->x, run->trial, run->problem->n * sizeof *run->x);
    }
}

/* The bounds of the step's problem start inside of the true ones. */
static void place_model(struct run *run)
{
    const struct gn_problem *p = run->problem;
    run->model.x = run->x;
    run->model.base = run->at;
    for (size_t m = 0; m <= p->settings; m++)
        run->model.shift[m] = m < p->settings && p->setting[m].share == 1 ? 0 : SLACK;
}

static bool search(struct run *run)
{
    const struct gn_problem *p = run->problem;
    double *parent = run->model.shift + p->settings + 1, radius = FIRST_RADIUS;
    if (p->fine(p->user_data, run->x, &run->at) != GN_VALUED)
        return false;
    memcpy(parent, run->at.value, p->settings * sizeof *parent);
    run->model.parent = parent;
    run->model.parent_pressure = run->at.pressure;
    run->least = 1;
    for (bool better = true; better;) {
        double before = progress(run, &run->at);
        enum gn_answer answer = differentiate(run);
        place_model(run);
        if (answer == GN_VALUED)
            answer = advance(run, &radius, &better);
        if (answer != GN_VALUED || !better)
            break;
        swap(&run->at, &run->candidate);
        memcpy(run->x, run->trial, p->n * sizeof *run->x);
        radius = fmin(GROWTH * radius, MOST_RADIUS);
        better = progress(run, &run->at) < before - LEAST_GAIN;
    }
    settle(run);
    return true;
}

bool gn_run(const struct gn_problem *problem, double *x)
{
    struct run run = {.problem = problem};
    size_t n = problem->n;
    double *vectors = calloc(4 * n, sizeof *vectors);
    bool ok = vectors && gn_model_create(problem, &run.model);
    ok = sample_create(problem, &run.at) && ok;
    ok = sample_create(problem, &run.candidate) && ok;
    ok = sample_create(problem, &run.coarse) && ok;
    ok = sample_create(problem, &run.moved) && ok;
    if (ok) {
        run.x = vectors;
        run.trial = vectors + n;
        run.step = vectors + 2 * n;
        run.best = vectors + 3 * n;
        ok = search(&run);
        memcpy(x, run.best, n * sizeof *x);
    }
    sample_free(&run.at);
    sample_free(&run.candidate);
    sample_free(&run.coarse);
    sample_free(&run.moved);
    gn_model_free(&run.model);
    free(vectors);
    return ok;
}

bool gn_at_parent(const struct gn_problem *p, struct gn_model *model)
{
    struct run run = {.problem = p};
    double *vectors = calloc(2 * p->n, sizeof *vectors);
    bool ok = vectors && gn_model_create(p, &run.model);
    ok = sample_create(p, &run.at) && ok;
    ok = sample_create(p, &run.coarse) && ok;
    ok = sample_create(p, &run.moved) && ok;
    if (ok) {
        run.x = vectors;
        run.trial = vectors + p->n;
        ok = p->fine(p->user_data, run.x, &run.at) == GN_VALUED && differentiate(&run) == GN_VALUED;
    }
    sample_free(&run.coarse);
    sample_free(&run.moved);
    if (!ok) {
        sample_free(&run.at);
        gn_model_free(&run.model);
        free(vectors);
        return false;
    }
    double *parent = run.model.shift + p->settings + 1;
    memcpy(parent, run.at.value, p->settings * sizeof *parent);
    run.model.parent = parent;
    run.model.parent_pressure = run.at.pressure;
    run.model.base = run.at;
    run.model.x = vectors;
    *model = run.model;
    return true;
}

void gn_leave(struct gn_model *model)
{
    struct gn_sample base = model->base;
    sample_free(&base);
    free((void *)model->x);
    gn_model_free(model);
}
