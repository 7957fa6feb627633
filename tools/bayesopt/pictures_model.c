/* Pictures of how good the model is, which variables matter, and where the good points lie. */
#include "pictures.h"
#include "plot/ship.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SQUARE = 560, GRID = 41, MOST_PAIRS = 3, MOST_AXES = 12, INDEX_SAMPLES = 1024 };

static bool library_failed(void)
{
    return cli_refuse("%s", bayesopt_last_error());
}

bool picture_loo(struct plot *plot, bayesopt *bo, const struct names *names)
{
    size_t n, most = bayesopt_count(bo) + 1;
    double *told = malloc(3 * most * sizeof *told), *mean = told + most, *sd = mean + most;
    (void)names;
    bool good = told || cli_refuse("out of memory");
    good = good && (!bayesopt_leave_one_out(bo, &n, told, mean, sd) || library_failed());
    good = good && plot_leave_one_out(plot, SQUARE, n, told, mean, sd);
    free(told);
    return good;
}

/* Sobol' indices [d] each, and the variables that matter most first [d]. */
static bool find_indices(bayesopt *bo, size_t d, double *first, double *total, size_t *order)
{
    if (bayesopt_sensitivity(bo, 0, INDEX_SAMPLES, first, total))
        return library_failed();
    plot_order(d, total, order);
    return true;
}

bool picture_indices(struct plot *plot, bayesopt *bo, const struct names *names)
{
    size_t d = names->d, *order = malloc(d * sizeof *order);
    double *first = malloc(2 * d * sizeof *first), *total = first + d;
    bool good = (first && order) || cli_refuse("out of memory");
    good = good && find_indices(bo, d, first, total, order) &&
           plot_indices(plot, PICTURE_WIDTH, d, first, total, order, names->variables);
    free(first);
    free(order);
    return good;
}

/* The value at a share of the way from low to high, on the axis' scale. */
static double along_axis(const struct plot_axis *axis, double share)
{
    return axis->log ? axis->low * pow(axis->high / axis->low, share)
                     : axis->low + (axis->high - axis->low) * share;
}

/* Whether a variable has a line to be drawn along. */
static bool has_axis(const bayesopt *bo, size_t j, const double *lower, const double *upper)
{
    return lower[j] < upper[j] && bayesopt_variable_kind(bo, j) != BAYESOPT_KIND_CATEGORICAL;
}

/* The model over variables a and b, the others at the best point. */
static bool draw_contours(struct plot *plot, bayesopt *bo, const struct names *names, size_t a,
                          size_t b, const double *best, struct plot_frame *f)
{
    size_t d = names->d, n = GRID * GRID;
    double *x = malloc(n * (d + 3) * sizeof *x), *along = x + n * d, *up = along + n, *f0 = up + n;
    if (!x)
        return cli_refuse("out of memory");
    bool whole[2] = {bayesopt_variable_kind(bo, a) >= BAYESOPT_KIND_INTEGER,
                     bayesopt_variable_kind(bo, b) >= BAYESOPT_KIND_INTEGER};
    for (size_t i = 0; i < n; i++) {
        memcpy(x + i * d, best, d * sizeof *x);
        along[i] = along_axis(&f->x, (double)(i / GRID) / (GRID - 1));
        up[i] = along_axis(&f->y, (double)(i % GRID) / (GRID - 1));
        x[i * d + a] = whole[0] ? round(along[i]) : along[i];
        x[i * d + b] = whole[1] ? round(up[i]) : up[i];
    }
    bool good = !bayesopt_predict(bo, n, x, f0, NULL) || library_failed();
    if (good) {
        struct plot_scale scale = {.map = PLOT_SEQUENTIAL,
                                   .axis = {.low = INFINITY, .high = -INFINITY, .label = "f"}};
        const struct plot_field field = {GRID, GRID, along, up, f0};
        double ticks[PLOT_TICKS];
        char texts[PLOT_TICKS][24];
        plot_include(&scale.axis, n, f0);
        plot_settle(&scale.axis);
        f->x.label = names->variables[a];
        f->y.label = names->variables[b];
        plot_axes(plot, f);
        plot_cells(plot, f, &field, &scale);
        size_t levels = plot_ticks(&scale.axis, 8, ticks, texts);
        for (size_t t = 0; t < levels; t++)
            plot_isolines(plot, f, &field, ticks[t], (struct plot_pen){"#ffffff", 0.8, NULL});
        plot_mark(plot, plot_x(f, best[a]), plot_y(f, best[b]), PLOT_CROSS, 5, PLOT_OPTIMUM,
                  "best");
        plot_bar(plot, f->left + f->width + 8, f->top + 14, 9, f->height - 14, &scale);
    }
    free(x);
    return good;
}

bool picture_contours(struct plot *plot, bayesopt *bo, const struct names *names)
{
    static const size_t pairs[MOST_PAIRS][2] = {{0, 1}, {0, 2}, {1, 2}};
    size_t d = names->d, *order = malloc(d * sizeof *order), free_ones = 0;
    double *best = malloc(5 * d * sizeof *best), *lower = best + d, *upper = lower + d;
    double *first = upper + d, *total = first + d;
    bool good = (best && order) || cli_refuse("out of memory");
    if (good)
        bayesopt_dimension(bo, lower, upper);
    for (size_t j = 0; j < d && good; j++)
        free_ones += has_axis(bo, j, lower, upper);
    if (good && free_ones < 2)
        good = cli_refuse("contours need two variables that are not fixed or categorical");
    good = good && (bayesopt_best(bo, best, NULL, NULL) >= 0 || library_failed());
    good = good && find_indices(bo, d, first, total, order);
    size_t kept = 0;
    for (size_t j = 0; j < d && good; j++)
        if (has_axis(bo, order[j], lower, upper))
            order[kept++] = order[j];
    size_t panels = free_ones > 2 ? MOST_PAIRS : 1;
    double width = (double)PICTURE_WIDTH / MOST_PAIRS;
    good = good && plot_open(plot, width * (double)panels, 340, "Contours of the model");
    for (size_t k = 0; k < panels && good; k++) {
        size_t a = order[pairs[k][0]], b = order[pairs[k][1]];
        struct plot_frame f = {
            .left = width * (double)k + 58, .top = 20, .width = width - 130, .height = 260};
        f.x = (struct plot_axis){.low = lower[a],
                                 .high = upper[a],
                                 .log = bayesopt_variable_kind(bo, a) == BAYESOPT_KIND_LOG};
        f.y = (struct plot_axis){.low = lower[b],
                                 .high = upper[b],
                                 .log = bayesopt_variable_kind(bo, b) == BAYESOPT_KIND_LOG};
        good = draw_contours(plot, bo, names, a, b, best, &f);
        if (!good)
            plot_free(plot);
    }
    free(best);
    free(order);
    return good;
}

/* One line across the axes, its value at the last. */
static void draw_line_of(struct plot *plot, const bayesopt *bo, const struct plot_frame *f,
                         size_t axes, const double *lower, const double *upper,
                         const bayesopt_point *p, double share, struct plot_pen pen)
{
    plot_path(plot, pen, NULL);
    for (size_t j = 0; j <= axes; j++) {
        double span = j < axes ? upper[j] - lower[j] : 1;
        bool log_scale = j < axes && bayesopt_variable_kind(bo, j) == BAYESOPT_KIND_LOG;
        double at = j == axes     ? share
                    : !(span > 0) ? 0.5
                    : log_scale   ? log(p->x[j] / lower[j]) / log(upper[j] / lower[j])
                                  : (p->x[j] - lower[j]) / span;
        double x = f->left + f->width * (double)j / (double)axes;
        fprintf(plot->out, j ? "L%.1f %.1f" : "M%.1f %.1f", x, f->top + f->height * (1 - at));
    }
    plot_path_end(plot);
}

bool picture_parallel(struct plot *plot, bayesopt *bo, const struct names *names)
{
    size_t d = names->d, axes = d < MOST_AXES ? d : MOST_AXES, n = bayesopt_count(bo), done = 0;
    double *lower = malloc((2 * d + n + 1) * sizeof *lower), *upper = lower + d, *value = upper + d;
    struct plot_scale scale = {.axis = {.low = INFINITY, .high = -INFINITY, .label = "f"}};
    bayesopt_point p;
    if (!lower)
        return cli_refuse("out of memory");
    bayesopt_dimension(bo, lower, upper);
    for (size_t i = 0; i < n && !bayesopt_get(bo, i, &p); i++)
        if (p.state == BAYESOPT_STATE_DONE && !p.outside)
            value[done++] = p.f;
    plot_include(&scale.axis, done, value);
    plot_settle(&scale.axis);
    bool good = done > 0 || cli_refuse("no evaluation has succeeded yet");
    good = good && plot_open(plot, PICTURE_WIDTH, 420, "Parallel coordinates");
    if (good) {
        struct plot_frame f = {.left = 60, .top = 44, .width = PICTURE_WIDTH - 150, .height = 320};
        bool greatest = bayesopt_maximises(bo);
        /* The best lines last, so that nothing hides them. */
        for (int pass = 0; pass < 2; pass++)
            for (size_t i = 0; i < n && !bayesopt_get(bo, i, &p); i++) {
                char colour[8];
                double span = scale.axis.high - scale.axis.low;
                double share = (p.f - scale.axis.low) / span;
                bool good_one = greatest ? share > 0.9 : share < 0.1;
                if (p.state != BAYESOPT_STATE_DONE || p.outside || good_one != (pass == 1))
                    continue;
                plot_scale_colour(&scale, p.f, colour);
                draw_line_of(plot, bo, &f, axes, lower, upper, &p, share,
                             (struct plot_pen){good_one ? PLOT_OPTIMUM : colour,
                                               good_one ? 1.4 : 0.9, NULL});
            }
        for (size_t j = 0; j <= axes; j++) {
            double x = f.left + f.width * (double)j / (double)axes;
            double low = j < axes ? lower[j] : scale.axis.low;
            double high = j < axes ? upper[j] : scale.axis.high;
            char buffer[2][VALUE_SIZE];
            plot_line(plot, x, f.top, x, f.top + f.height, (struct plot_pen){PLOT_INK, 1, NULL});
            plot_text(plot, x, f.top - 20, 12, PLOT_MIDDLE, PLOT_INK, "%.14s",
                      j < axes ? names->variables[j] : "f");
            const char *text[2] = {"", ""};
            bool label = j < axes && names->labels && names->labels[j].n;
            for (int e = 0; e < 2; e++) {
                snprintf(buffer[e], VALUE_SIZE, "%.4g", e ? high : low);
                text[e] = label ? names_value(names, j, e ? high : low, buffer[e]) : buffer[e];
            }
            plot_text(plot, x, f.top - 5, 10, PLOT_MIDDLE, PLOT_MUTED, "%.14s", text[1]);
            plot_text(plot, x, f.top + f.height + 14, 10, PLOT_MIDDLE, PLOT_MUTED, "%.14s",
                      text[0]);
        }
        plot_text(plot, f.left, f.top + f.height + 38, 12, PLOT_START, PLOT_MUTED,
                  "in red: within a tenth of the range of f from the best");
    }
    free(lower);
    return good;
}
