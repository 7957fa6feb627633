/* What a study found and how good its model is: Pareto sets, leave-one-out, Sobol' indices. */
#include "plot/ship.h"

#include <math.h>

static void draw_plane(struct plot *plot, const struct plot_front *front, struct plot_frame *f,
                       size_t a, size_t b)
{
    f->x = (struct plot_axis){.low = INFINITY, .high = -INFINITY, .label = front->labels[a]};
    f->y = (struct plot_axis){.low = INFINITY, .high = -INFINITY, .label = front->labels[b]};
    for (size_t i = 0; i < front->n; i++) {
        plot_include(&f->x, 1, &front->designs[i].value[a]);
        plot_include(&f->y, 1, &front->designs[i].value[b]);
    }
    plot_nice(&f->x, 5);
    plot_nice(&f->y, 5);
    plot_axes(plot, f);
    if (front->original)
        plot_mark(plot, plot_x(f, front->original[a]), plot_y(f, front->original[b]), PLOT_CROSS, 5,
                  PLOT_INK, "original");
    if (front->shown) /* its mark is filled */
        plot_mark(plot, plot_x(f, front->shown[a]), plot_y(f, front->shown[b]), PLOT_RING, 7,
                  PLOT_INK, "shown");
    for (int members = 0; members < 2; members++) /* which nothing hides */
        for (size_t i = 0; i < front->n; i++) {
            const struct plot_design *d = &front->designs[i];
            if (d->member == members && isfinite(d->value[a]) && isfinite(d->value[b]))
                plot_mark(plot, plot_x(f, d->value[a]), plot_y(f, d->value[b]),
                          d->infeasible ? PLOT_RING : PLOT_DOT, members ? 3.4 : 2.6,
                          members ? PLOT_OPTIMUM : PLOT_PALE, d->note);
        }
}

bool plot_front(struct plot *plot, double width, double height, const struct plot_front *front)
{
    struct plot_legend legend[5] = {{"Pareto set", {PLOT_OPTIMUM, 0, NULL}, PLOT_DOT},
                                    {"evaluated", {PLOT_PALE, 0, NULL}, PLOT_DOT}};
    size_t entries = 2, outside = 0, panels = front->objectives == 2 ? 1 : 3, panel = 0;
    for (size_t i = 0; i < front->n; i++)
        outside += front->designs[i].infeasible;
    if (outside)
        legend[entries++] =
            (struct plot_legend){"outside the limits", {PLOT_PALE, 0, NULL}, PLOT_RING};
    if (front->original)
        legend[entries++] = (struct plot_legend){"original", {PLOT_INK, 0, NULL}, PLOT_CROSS};
    if (front->shown)
        legend[entries++] = (struct plot_legend){"shown here", {PLOT_INK, 0, NULL}, PLOT_RING};
    if (!plot_open(plot, width, height, "Pareto set"))
        return false;
    plot_legend(plot, 60, 18, false, entries, legend);
    for (size_t a = 0; a < front->objectives; a++)
        for (size_t b = a + 1; b < front->objectives; b++, panel++) {
            double room = width / (double)panels;
            struct plot_frame f = {.left = room * (double)panel + 70,
                                   .top = 40,
                                   .width = room - 90,
                                   .height = height - 96};
            draw_plane(plot, front, &f, a, b);
        }
    return true;
}

bool plot_leave_one_out(struct plot *plot, double side, size_t n, const double *told,
                        const double *mean, const double *sd)
{
    static const struct plot_pen equal = {PLOT_MUTED, 1, "4 3"}, bar = {PLOT_PALE, 1, NULL};
    struct plot_frame f = {.left = 74, .top = 20, .width = side - 94, .height = side - 80};
    if (!plot_open(plot, side, side, "Leave-one-out predictions"))
        return false;
    f.x = (struct plot_axis){.low = INFINITY, .high = -INFINITY};
    plot_include(&f.x, n, told);
    plot_include(&f.x, n, mean);
    plot_nice(&f.x, 5);
    f.y = f.x;
    f.x.label = "told";
    f.y.label = "expected from the others";
    plot_axes(plot, &f);
    plot_clip(plot, &f);
    plot_line(plot, plot_x(&f, f.x.low), plot_y(&f, f.x.low), plot_x(&f, f.x.high),
              plot_y(&f, f.x.high), equal);
    for (size_t i = 0; i < n; i++) {
        double x = plot_x(&f, told[i]);
        plot_line(plot, x, plot_y(&f, mean[i] - 2 * sd[i]), x, plot_y(&f, mean[i] + 2 * sd[i]),
                  bar);
    }
    for (size_t i = 0; i < n; i++)
        plot_mark(plot, plot_x(&f, told[i]), plot_y(&f, mean[i]), PLOT_DOT, 3, PLOT_BLUE, NULL);
    plot_unclip(plot);
    return true;
}

void plot_order(size_t n, const double *value, size_t *order)
{
    for (size_t j = 0; j < n; j++) {
        size_t k = j;
        for (; k > 0 && value[j] > value[order[k - 1]]; k--)
            order[k] = order[k - 1];
        order[k] = j;
    }
}

bool plot_indices(struct plot *plot, double width, size_t n, const double *first,
                  const double *total, const size_t *order, char *const *names)
{
    enum { MOST_BARS = 30 };
    static const struct plot_legend legend[] = {{"alone", {PLOT_BLUE, 8, NULL}, PLOT_LINE},
                                                {"with others", {PLOT_PALE, 8, NULL}, PLOT_LINE}};
    static const double row = 24, names_width = 190;
    size_t shown = n < MOST_BARS ? n : MOST_BARS;
    struct plot_frame f = {
        .left = fmin(names_width, width / 4), .top = 34, .height = row * (double)shown};
    f.width = width - f.left - 30;
    f.x = (struct plot_axis){.low = 0, .high = 1};
    if (!plot_open(plot, width, 90 + row * (double)shown, "Sobol' indices"))
        return false;
    plot_legend(plot, f.left, 18, false, 2, legend);
    for (int tick = 0; tick <= 5; tick++) {
        double x = plot_x(&f, 0.2 * tick);
        plot_line(plot, x, f.top, x, f.top + f.height, (struct plot_pen){PLOT_GRID, 1, NULL});
        plot_text(plot, x, f.top + f.height + 16, 11, PLOT_MIDDLE, PLOT_MUTED, "%.1f", 0.2 * tick);
    }
    plot_text(plot, f.left + f.width / 2, f.top + f.height + 36, 12, PLOT_MIDDLE, PLOT_MUTED,
              "share of the model's variance");
    for (size_t i = 0; i < shown; i++) {
        double y = f.top + row * ((double)i + 0.5);
        double whole = fmin(fmax(total[order[i]], 0), 1);
        double alone = fmin(fmax(first[order[i]], 0), whole);
        plot_line(plot, f.left, y, plot_x(&f, whole), y, (struct plot_pen){PLOT_PALE, 12, NULL});
        plot_line(plot, f.left, y, plot_x(&f, alone), y, (struct plot_pen){PLOT_BLUE, 12, NULL});
        plot_text(plot, f.left - 8, y + 4, 12, PLOT_END, PLOT_INK, "%.24s", names[order[i]]);
    }
    return true;
}
