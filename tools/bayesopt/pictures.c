/* Pictures of the history and of slices of the model. */
#include "pictures.h"

#include "plot/ship.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = PICTURE_WIDTH, HEIGHT = 420, PANEL = 190, SAMPLES = 101, MOST_SLICES = 16 };

/* Fills trials[bayesopt_count()], returns how many are known. */
static size_t gather(const bayesopt *bo, struct plot_trial *trials)
{
    bayesopt_point p;
    double sign = bayesopt_maximises(bo) ? -1 : 1; /* the best is below */
    size_t n = 0;
    for (size_t i = 0; i < bayesopt_count(bo); i++) {
        if (bayesopt_get(bo, i, &p) || p.outside ||
            (p.state != BAYESOPT_STATE_DONE && p.state != BAYESOPT_STATE_FAILED))
            continue;
        struct plot_trial *t = &trials[n++];
        *t = (struct plot_trial){.number = (double)p.id,
                                 .value = sign * p.f,
                                 .initial = p.phase == BAYESOPT_PHASE_INITIAL ||
                                            p.phase == BAYESOPT_PHASE_EXTERNAL,
                                 .infeasible = !p.feasible,
                                 .failed = p.state == BAYESOPT_STATE_FAILED};
        if (t->failed || *p.note)
            snprintf(t->note, sizeof t->note, "%llu: %s", (unsigned long long)p.id, p.note);
        else
            snprintf(t->note, sizeof t->note, "%llu: %.6g", (unsigned long long)p.id, p.f);
    }
    return n;
}

bool picture_history(struct plot *plot, bayesopt *bo, const struct names *names)
{
    (void)names;
    struct plot_trial *trials = calloc(bayesopt_count(bo) + 1, sizeof *trials);
    if (!trials)
        return cli_refuse("out of memory");
    const struct plot_history history = {gather(bo, trials), trials, NAN,
                                         bayesopt_maximises(bo) ? -1 : 1, "objective"};
    bool good = plot_open(plot, WIDTH, HEIGHT, "History of the search");
    if (good)
        plot_history(plot, 0, 0, WIDTH, HEIGHT, &history);
    free(trials);
    return good;
}

/* The model along variable j through the best point: its mean, two standard deviations, the best.
 */
static bool draw_slice(struct plot *plot, bayesopt *bo, const struct names *names, size_t j,
                       const double *best, struct plot_frame *f)
{
    static const struct plot_pen mean_pen = {PLOT_BLUE, 2, NULL},
                                 best_pen = {PLOT_OPTIMUM, 1, "4 3"};
    size_t d = names->d;
    bool discrete = bayesopt_variable_kind(bo, j) >= BAYESOPT_KIND_INTEGER;
    double *x = malloc((5 + d) * SAMPLES * sizeof *x);
    if (!x)
        return cli_refuse("out of memory");
    double *mean = x + d * SAMPLES, *sd = mean + SAMPLES, *along = sd + SAMPLES;
    double *low = along + SAMPLES, *high = low + SAMPLES;
    for (size_t s = 0; s < SAMPLES; s++) {
        double share = (double)s / (SAMPLES - 1);
        along[s] = f->x.log ? f->x.low * pow(f->x.high / f->x.low, share)
                            : f->x.low + (f->x.high - f->x.low) * share;
        if (discrete)
            along[s] = round(along[s]);
        memcpy(x + s * d, best, d * sizeof *x);
        x[s * d + j] = along[s];
    }
    bool good =
        !bayesopt_predict(bo, SAMPLES, x, mean, sd) || cli_refuse("%s", bayesopt_last_error());
    if (good) {
        f->x.label = names->variables[j];
        plot_include(&f->y, SAMPLES, mean);
        plot_settle(&f->y);
        /* Some room on both sides of the curve: the band may be wider by orders. */
        double room = 0.3 * (f->y.high - f->y.low);
        f->y.low -= room;
        f->y.high += room;
        for (size_t s = 0; s < SAMPLES; s++) {
            low[s] = fmax(mean[s] - 2 * sd[s], f->y.low);
            high[s] = fmin(mean[s] + 2 * sd[s], f->y.high);
        }
        plot_axes(plot, f);
        plot_band(plot, f, SAMPLES, along, low, high, mean_pen.colour);
        plot_curve(plot, f, SAMPLES, along, mean, mean_pen);
        plot_line(plot, plot_x(f, best[j]), f->top, plot_x(f, best[j]), f->top + f->height,
                  best_pen);
    }
    free(x);
    return good;
}

bool picture_slices(struct plot *plot, bayesopt *bo, const struct names *names)
{
    static const struct plot_legend legend[] = {
        {"model", {PLOT_BLUE, 2, NULL}, PLOT_LINE},
        {"± 2 standard deviations", {PLOT_BLUE, 0, NULL}, PLOT_BAND},
        {"best", {PLOT_OPTIMUM, 1, "4 3"}, PLOT_LINE}};
    size_t d = names->d, shown = 0, chosen[MOST_SLICES];
    double *best = malloc(3 * d * sizeof *best), *lower = best + d, *upper = best + 2 * d;
    if (!best)
        return cli_refuse("out of memory");
    bayesopt_dimension(bo, lower, upper);
    for (size_t j = 0; j < d && shown < MOST_SLICES; j++)
        if (lower[j] < upper[j])
            chosen[shown++] = j;
    size_t columns = (size_t)ceil(sqrt((double)shown)), rows = (shown + columns - 1) / columns;
    double height = 30 + (rows < 3 ? 1.5 : 1) * PANEL * (double)rows;
    bool good = bayesopt_best(bo, best, NULL, NULL) >= 0 || cli_refuse("%s", bayesopt_last_error());
    good = good && plot_open(plot, WIDTH, height, "The model through the best point");
    if (good)
        plot_legend(plot, 60, 18, false, 3, legend);
    for (size_t k = 0; k < shown && good; k++) {
        size_t j = chosen[k];
        double width = (double)WIDTH / (double)columns, tall = (height - 30) / (double)rows;
        struct plot_frame f = {.left = width * (double)(k % columns) + 64,
                               .top = 36 + tall * (double)(k / columns),
                               .width = width - 78,
                               .height = tall - 56};
        f.x = (struct plot_axis){.low = lower[j],
                                 .high = upper[j],
                                 .log = bayesopt_variable_kind(bo, j) == BAYESOPT_KIND_LOG};
        f.y = (struct plot_axis){
            .low = INFINITY, .high = -INFINITY, .label = k % columns ? NULL : "objective"};
        good = draw_slice(plot, bo, names, j, best, &f);
        if (!good)
            plot_free(plot);
    }
    free(best);
    return good;
}

/* The objectives of a point: f, then the last of its outcomes. */
static struct plot_design design_of(const bayesopt *bo, const struct names *names, size_t row)
{
    bayesopt_point p;
    struct plot_design d = {.value = {NAN, NAN, NAN}};
    size_t objectives = bayesopt_objective_count(bo);
    if (bayesopt_get(bo, row, &p) || p.state != BAYESOPT_STATE_DONE || p.outside)
        return d;
    d.value[0] = p.f;
    for (size_t k = 1; k < objectives; k++)
        d.value[k] = p.constraints[names->m - objectives + k];
    d.infeasible = !p.feasible;
    snprintf(d.note, sizeof d.note, "%llu", (unsigned long long)p.id);
    return d;
}

bool picture_front(struct plot *plot, bayesopt *bo, const struct names *names)
{
    size_t all = bayesopt_count(bo), n = 0;
    struct plot_front front = {.n = all, .objectives = bayesopt_objective_count(bo)};
    if (front.objectives < 2)
        return cli_refuse("--front: there is one objective");
    size_t *rows = malloc((all + 1) * sizeof *rows);
    struct plot_design *designs = calloc(all + 1, sizeof *designs);
    bool good = (rows && designs) || cli_refuse("out of memory");
    good = good && (!bayesopt_pareto(bo, &n, rows) || cli_refuse("%s", bayesopt_last_error()));
    for (size_t i = 0; good && i < all; i++)
        designs[i] = design_of(bo, names, i);
    for (size_t i = 0; good && i < n; i++)
        designs[rows[i]].member = true;
    front.designs = designs;
    for (size_t k = 0; k < front.objectives; k++)
        front.labels[k] = k ? names->constraints[names->m - front.objectives + k] : "f";
    good = good && plot_front(plot, WIDTH, front.objectives == 2 ? 620 : HEIGHT, &front);
    free(rows);
    free(designs);
    return good;
}
