/* Pictures of a run: C_w against Froude number, the wave pattern, the pressure on the hull. */
#include "cli.h"
#include "plot/ship.h"
#include "solve.h"

#include <igabem/igabem.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const colours[8] = {"#1b6ca8", "#c0392b", "#27825c", "#8e44ad",
                                       "#b9770e", "#555555", "#12a5a5", "#d35ea8"};

/* One figure of the results of a formulation at every Froude number. */
struct series {
    const struct solve_run *run;
    size_t which, per_fr, n;
    double *fr, *cw, *pressure, *lower, *upper; /* n each, one block */
};

static bool series_fill(const struct solve_run *run, size_t which, size_t per_fr, struct series *s)
{
    size_t n = run->request->n_fr;
    double *block = malloc(5 * n * sizeof *block);
    if (!block)
        return cli_refuse("out of memory");
    *s = (struct series){run,           which,         per_fr,       n, block, block + n,
                         block + 2 * n, block + 3 * n, block + 4 * n};
    for (size_t i = 0; i < n; i++) {
        const struct solve_result *r = solve_run_result(run, run->levels - 1, i * per_fr + which);
        s->fr[i] = r->options.froude;
        s->cw[i] = r->forces.cw;
        s->pressure[i] = r->forces.cw_pressure;
        s->lower[i] = r->forces.cw_cutoff_lower;
        s->upper[i] = r->forces.cw_cutoff_upper;
    }
    return true;
}

/* One line per formulation; of the first also C_w by pressure and the band of the cut-off. */
static void draw_series(struct plot *plot, const struct plot_frame *f, const struct series *s,
                        struct plot_legend *legend, size_t *entries)
{
    const struct solve_result *first = solve_run_result(s->run, s->run->levels - 1, s->which);
    const struct plot_pen pen = {colours[s->which % 8], 2, NULL}, dashed = {pen.colour, 1.5, "5 4"};
    plot_curve(plot, f, s->n, s->fr, s->cw, pen);
    for (size_t i = 0; i < s->n; i++)
        plot_mark(plot, plot_x(f, s->fr[i]), plot_y(f, s->cw[i]), PLOT_DOT, 2.5, pen.colour, NULL);
    legend[(*entries)++] =
        (struct plot_legend){igabem_formulation_name(first->options.formulation), pen, PLOT_LINE};
    if (s->which == 0 && isfinite(s->pressure[0])) {
        plot_curve(plot, f, s->n, s->fr, s->pressure, dashed);
        legend[(*entries)++] = (struct plot_legend){"its C_{w} by pressure", dashed, PLOT_LINE};
    }
    if (s->which == 0 && isfinite(s->lower[0]) && isfinite(s->upper[0])) {
        plot_band(plot, f, s->n, s->fr, s->lower, s->upper, pen.colour);
        legend[(*entries)++] = (struct plot_legend){"its cut-off × 0.85–1.15", pen, PLOT_BAND};
    }
}

bool solve_write_plot(const struct solve_run *run, const char *path)
{
    enum { WIDTH = 860, HEIGHT = 480, MOST = 16 };
    static const double zero = 0;
    struct plot_frame f = {.left = 70, .top = 20, .width = WIDTH - 290, .height = HEIGHT - 70};
    struct plot_legend legend[MOST + 2];
    struct series series[MOST] = {0};
    struct plot plot;
    size_t per_fr = run->cases / run->request->n_fr, entries = 0;
    bool good = per_fr <= MOST;
    f.x = (struct plot_axis){.low = INFINITY, .high = -INFINITY, .label = "Fr"};
    f.y =
        (struct plot_axis){.low = INFINITY, .high = -INFINITY, .unit = 1000, .label = "1000 C_{w}"};
    for (size_t k = 0; k < per_fr && good; k++) {
        good = series_fill(run, k, per_fr, &series[k]);
        if (!good)
            break;
        plot_include(&f.x, series[k].n, series[k].fr);
        plot_include(&f.y, series[k].n, series[k].cw);
        if (k == 0)
            plot_include(&f.y, series[k].n, series[k].pressure);
    }
    if (good && (!(f.x.high > f.x.low) || !(f.y.high > 0)))
        good = cli_refuse("--plot %s: expected at least two Froude numbers and a wave resistance",
                          path);
    if (good)
        good = plot_open(&plot, WIDTH, HEIGHT, "Wave resistance against Froude number");
    if (good) {
        plot_include(&f.y, 1, &zero);
        plot_nice(&f.y, 6);
        plot_axes(&plot, &f);
        plot_clip(&plot, &f);
        for (size_t k = 0; k < per_fr; k++)
            draw_series(&plot, &f, &series[k], legend, &entries);
        plot_unclip(&plot);
        plot_legend(&plot, f.left + f.width + 16, f.top + 14, true, entries, legend);
        good = plot_save(&plot, path);
    }
    for (size_t k = 0; k < per_fr && k < MOST; k++)
        free(series[k].fr);
    return good;
}

bool solve_draw_waves(const struct solve_run *run, const struct wave_grid *grid, const char *path)
{
    enum { WIDTH = 1100 };
    char name[80];
    double *edge = NULL;
    size_t n_edge = 0;
    const struct solve_result *last = solve_run_result(run, run->levels - 1, run->shown);
    snprintf(name, sizeof name, "Fr %.4g", last->options.froude);
    if (nurbs_hull_waterline(run->input->source, &n_edge, &edge) != NURBS_OK)
        return cli_refuse("%s", nurbs_last_error());
    const struct plot_waves waves = {name,       grid->nx,
                                     grid->ny,   n_edge,
                                     grid->x[0], grid->x[grid->ny] - grid->x[0],
                                     grid->y[0], grid->y[1] - grid->y[0],
                                     grid->zeta, edge};
    struct plot plot;
    bool good = plot_wave_pattern(&plot, WIDTH, 1, &waves) && plot_save(&plot, path);
    free(edge);
    return good;
}

enum { LEVELS = 12 }; /* about so many lines of equal pressure */

/* What the 90th percentile of |Cp| asks for: points are dense at the ends of a hull, and the
 * stagnation points would leave the rest pale. */
static struct plot_scale pressure_scale(const struct patch_sample *samples, size_t patches)
{
    struct plot_scale scale = {PLOT_DIVERGING, {.label = "C_{p}"}};
    double most = 0;
    for (size_t p = 0; p < patches; p++)
        most = fmax(most, plot_percentile(samples[p].nu * samples[p].nv, samples[p].cp, true, 0.9));
    scale.axis.high = most;
    scale.axis.low = -most;
    plot_nice(&scale.axis, LEVELS);
    return scale;
}

/* One view of all patches: coordinate `up` over x. */
static bool draw_pressure(struct plot *plot, const struct plot_frame *f, size_t up,
                          const struct patch_sample *samples, size_t patches,
                          const struct plot_scale *scale)
{
    double level[PLOT_TICKS];
    char text[PLOT_TICKS][24];
    size_t levels = plot_ticks(&scale->axis, LEVELS, level, text);
    for (size_t p = 0; p < patches; p++) {
        size_t n = samples[p].nu * samples[p].nv;
        double *xy = malloc(2 * n * sizeof *xy);
        if (!xy)
            return cli_refuse("out of memory");
        for (size_t i = 0; i < n; i++) {
            xy[i] = samples[p].xyz[3 * i];
            xy[n + i] = samples[p].xyz[3 * i + up];
        }
        const struct plot_field field = {samples[p].nu, samples[p].nv, xy, xy + n, samples[p].cp};
        plot_cells(plot, f, &field, scale);
        for (size_t k = 0; k < levels; k++)
            plot_isolines(plot, f, &field, level[k],
                          (struct plot_pen){PLOT_INK, fabs(level[k]) < 1e-12 ? 1.1 : 0.5, NULL});
        free(xy);
    }
    return true;
}

bool solve_draw_pressure(const struct solve_run *run, const struct patch_sample *samples,
                         size_t patches, const char *path)
{
    enum { WIDTH = 1100, WANTED = 140, TOP = 40, GAP = 74 };
    static const size_t across[2] = {2, 1};
    const struct solve_result *last = solve_run_result(run, run->levels - 1, run->shown);
    struct plot_axis axis[3];
    for (size_t k = 0; k < 3; k++)
        axis[k] = (struct plot_axis){.low = INFINITY, .high = -INFINITY};
    for (size_t p = 0; p < patches; p++)
        for (size_t i = 0; i < 3 * samples[p].nu * samples[p].nv; i++)
            plot_include(&axis[i % 3], 1, &samples[p].xyz[i]);
    for (size_t k = 0; k < 3; k++)
        plot_settle(&axis[k]);
    const struct plot_scale scale = pressure_scale(samples, patches);
    double s = (WIDTH - 170) / (axis[0].high - axis[0].low), top = TOP, height[2];
    char label[2][60];
    for (size_t v = 0; v < 2; v++) {
        double tall = s * (axis[across[v]].high - axis[across[v]].low);
        double larger = fmin(fmax(1, ceil(WANTED / tall)), 4);
        height[v] = larger * tall;
        snprintf(label[v], sizeof label[v], "%s, m%s", v ? "y" : "z",
                 larger > 1 ? " (enlarged)" : "");
        axis[across[v]].label = label[v];
    }
    struct plot plot;
    if (!plot_open(&plot, WIDTH, TOP + height[0] + GAP + height[1] + 60, "Pressure on the hull"))
        return false;
    char speed[80] = "without waves";
    if (isfinite(last->options.froude))
        snprintf(speed, sizeof speed, "at Fr %.4g, %s", last->options.froude,
                 igabem_formulation_name(last->options.formulation));
    plot_text(&plot, 70, 22, 13, PLOT_START, PLOT_INK,
              "C_{p} %s, from the side and from below; lines %.2g apart", speed,
              plot_tick_step(scale.axis.high - scale.axis.low, LEVELS, false));
    bool good = true;
    for (size_t v = 0; v < 2 && good; v++) {
        struct plot_frame f = {70, top, WIDTH - 170, height[v], axis[0], axis[across[v]]};
        f.x.label = v ? "x, m (forward to the right)" : NULL;
        plot_axes(&plot, &f);
        good = draw_pressure(&plot, &f, across[v], samples, patches, &scale);
        if (v == 0 && f.y.high >= 0)
            plot_line(&plot, f.left, plot_y(&f, 0), f.left + f.width, plot_y(&f, 0),
                      (struct plot_pen){PLOT_BLUE, 2, NULL});
        top += height[v] + GAP;
    }
    plot_bar(&plot, WIDTH - 76, TOP + 14, 16, plot.height - TOP - 80, &scale);
    if (good)
        return plot_save(&plot, path);
    plot_free(&plot);
    return false;
}
