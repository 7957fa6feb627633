/* History of a search, latent spaces. */
#include "cli.h"
#include "plot/ship.h"

#include <math.h>
#include <stdlib.h>

/* A few designs far above all others would flatten the rest: the axis ends half the spread above
 * the 95th percentile, or above the reference, and what lies above stands on its upper edge. */
static struct plot_axis value_axis(const struct plot_history *h)
{
    static const double usual = 0.95, room = 0.5;
    struct plot_axis axis = {
        .low = INFINITY, .high = -INFINITY, .unit = h->unit, .label = h->label};
    double *values = cli_needed(malloc((h->n + 1) * sizeof *values)), zero = 0;
    for (size_t i = 0; i < h->n; i++)
        values[i] = h->trials[i].failed ? NAN : h->trials[i].value;
    plot_include(&axis, h->n, values);
    if (axis.low <= axis.high) {
        double high = plot_percentile(h->n, values, false, usual);
        axis.high = fmin(axis.high, high + room * (high - axis.low));
    }
    free(values);
    plot_include(&axis, isfinite(h->reference) ? 1 : 0, &zero);
    plot_include(&axis, 1, &h->reference);
    plot_nice(&axis, 5);
    return axis;
}

static void draw_best(struct plot *plot, const struct plot_frame *f, const struct plot_history *h)
{
    double best = INFINITY;
    plot_path(plot, (struct plot_pen){PLOT_OPTIMUM, 2.4, NULL}, NULL);
    for (size_t i = 0; i < h->n; i++) {
        const struct plot_trial *t = &h->trials[i];
        if (t->failed || t->infeasible || !(t->value < best))
            continue;
        double x = plot_x(f, t->number), y = plot_y(f, fmin(t->value, f->y.high));
        fprintf(plot->out, isfinite(best) ? "H%.1fV%.1f" : "M%.1f %.1f", x, y);
        best = t->value;
    }
    if (isfinite(best))
        fprintf(plot->out, "H%.1f", f->left + f->width);
    plot_path_end(plot);
}

static void draw_trials(struct plot *plot, const struct plot_frame *f, const struct plot_history *h)
{
    for (size_t i = 0; i < h->n; i++) {
        const struct plot_trial *t = &h->trials[i];
        const char *colour = t->initial ? PLOT_PALE : PLOT_BLUE;
        double x = plot_x(f, t->number);
        if (t->failed)
            plot_mark(plot, x, f->top - 9, PLOT_CROSS, 3.2, PLOT_RED, t->note);
        else if (t->value > f->y.high)
            plot_mark(plot, x, f->top, t->infeasible ? PLOT_RING : PLOT_DOT, 2, colour, t->note);
        else
            plot_mark(plot, x, plot_y(f, t->value), t->infeasible ? PLOT_RING : PLOT_DOT, 3, colour,
                      t->note);
    }
}

void plot_history(struct plot *plot, double left, double top, double width, double height,
                  const struct plot_history *h)
{
    struct plot_legend legend[] = {{"initial design", {PLOT_PALE, 0, NULL}, PLOT_DOT},
                                   {"iterations", {PLOT_BLUE, 0, NULL}, PLOT_DOT},
                                   {"best so far", {PLOT_OPTIMUM, 2.4, NULL}, PLOT_LINE},
                                   {0},
                                   {0},
                                   {0}};
    size_t entries = 3, initial = 0, infeasible = 0, failed = 0;
    struct plot_frame f = {
        .left = left + 64, .top = top + 46, .width = width - 84, .height = height - 92};
    f.x = (struct plot_axis){
        .low = INFINITY, .high = -INFINITY, .whole = true, .label = "evaluation"};
    for (size_t i = 0; i < h->n; i++) {
        plot_include(&f.x, 1, &h->trials[i].number);
        initial = h->trials[i].initial ? i + 1 : initial;
        infeasible += h->trials[i].infeasible && !h->trials[i].failed;
        failed += h->trials[i].failed;
    }
    f.y = value_axis(h);
    plot_axes(plot, &f);
    if (initial > 0 && initial < h->n) {
        double split = plot_x(&f, h->trials[initial - 1].number + 0.5);
        plot_line(plot, split, f.top, split, f.top + f.height,
                  (struct plot_pen){PLOT_MUTED, 1, "2 3"});
    }
    if (isfinite(h->reference)) {
        legend[entries] = (struct plot_legend){"original", {PLOT_ORIGINAL, 1.6, "5 4"}, PLOT_LINE};
        plot_line(plot, f.left, plot_y(&f, h->reference), f.left + f.width,
                  plot_y(&f, h->reference), legend[entries++].pen);
    }
    draw_best(plot, &f, h);
    draw_trials(plot, &f, h);
    if (infeasible)
        legend[entries++] =
            (struct plot_legend){"outside the limits", {PLOT_MUTED, 0, NULL}, PLOT_RING};
    if (failed)
        legend[entries++] = (struct plot_legend){"failed", {PLOT_RED, 0, NULL}, PLOT_CROSS};
    plot_legend(plot, f.left, top + 18, false, entries, legend);
}

/* As many modes as are worth a look: those of a linear family, or twice those kept. */
static size_t shown(const struct plot_latent *l)
{
    size_t n = l->parameters > 2 * l->modes + 2 ? l->parameters : 2 * l->modes + 2;
    return n < l->spectrum ? n : l->spectrum;
}

/* y[k] belongs to `first` + k modes. */
static void draw_chart(struct plot *plot, struct plot_frame *f, const struct plot_latent *l,
                       size_t first, size_t n, const double *y, const char *unit)
{
    double *x = cli_needed(malloc((n + 1) * sizeof *x)), kept = y[l->modes - first];
    f->x = (struct plot_axis){.high = (double)(n - 1 + first), .whole = true, .label = "modes"};
    plot_axes(plot, f);
    if (l->wanted > 0 && first == 0)
        plot_line(plot, f->left, plot_y(f, 100 * l->wanted), f->left + f->width,
                  plot_y(f, 100 * l->wanted), (struct plot_pen){PLOT_MUTED, 1, "2 3"});
    double at = plot_x(f, (double)l->modes);
    plot_line(plot, at, f->top, at, f->top + f->height,
              (struct plot_pen){PLOT_OPTIMUM, 1.2, "4 3"});
    for (size_t k = 0; k < n; k++)
        x[k] = (double)(first + k);
    plot_curve(plot, f, n, x, y, (struct plot_pen){PLOT_BLUE, 1.8, NULL});
    for (size_t k = 0; k < n; k++)
        plot_mark(plot, plot_x(f, x[k]), plot_y(f, y[k]), PLOT_DOT,
                  k + first == l->modes ? 4.5 : 2.4,
                  k + first == l->modes ? PLOT_OPTIMUM : PLOT_BLUE, NULL);
    bool right = at < f->left + 0.55 * f->width;
    /* Where the curve is not: it rises from the corner below on the left, or falls to the right. */
    plot_label(plot, right ? at + 9 : at - 9, right && first ? f->top + 16 : f->top + f->height - 8,
               12, right ? PLOT_START : PLOT_END, PLOT_OPTIMUM, "%zu modes: %.4g%s", l->modes, kept,
               unit);
    free(x);
}

void plot_variance(struct plot *plot, double left, double top, double width, double height,
                   const struct plot_latent *l)
{
    size_t n = shown(l);
    double *share = cli_needed(calloc(n + 1, sizeof *share));
    struct plot_frame f = {
        .left = left + 64, .top = top, .width = width - 74, .height = height - 44};
    f.y = (struct plot_axis){.high = 100, .label = "retained variance, %"};
    for (size_t k = 1; k <= n; k++)
        share[k] = share[k - 1] + 100 * l->eigenvalues[k - 1] / l->trace;
    if (l->modes <= n)
        draw_chart(plot, &f, l, 0, n + 1, share, " %");
    free(share);
}

void plot_error(struct plot *plot, double left, double top, double width, double height,
                const struct plot_latent *l)
{
    /* Rounding of the last eigenvalues is not an error of the method. */
    static const double rounding = 1e-9;
    size_t n = shown(l);
    double *mse = cli_needed(malloc((n + 1) * sizeof *mse));
    struct plot_frame f = {
        .left = left + 64, .top = top, .width = width - 74, .height = height - 44};
    f.y = (struct plot_axis){
        .low = INFINITY, .high = -INFINITY, .log = true, .label = "mean square error, m²"};
    for (size_t k = 0; k < n; k++)
        mse[k] = l->mse[k] > rounding * l->trace ? l->mse[k] : NAN;
    plot_include(&f.y, n, mse);
    plot_include(&f.y, 1, &l->trace);
    plot_nice(&f.y, 5);
    if (l->modes >= 1 && l->modes <= n)
        draw_chart(plot, &f, l, 1, n, mse, " m²");
    free(mse);
}
