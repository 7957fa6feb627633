#include "plot/ship.h"

#include <math.h>
#include <stdlib.h>

/* The 99th percentile of |elevation|, rounded up to two digits. */
static double colour_limit(size_t fields, const struct plot_waves *waves)
{
    static const double share = 0.99, still = 1e-3;
    double most = 0;
    for (size_t k = 0; k < fields; k++)
        most =
            fmax(most, plot_percentile(waves[k].nx * waves[k].ny, waves[k].elevation, true, share));
    double unit = most > 0 ? pow(10, floor(log10(most)) - 1) : 1;
    return most > 0 ? ceil(most / unit) * unit : still;
}

double plot_wave_at(const struct plot_waves *w, double x, double y)
{
    double column = (x - w->x0) / w->dx, row = (y - w->y0) / w->dy, sum = 0, weight = 0;
    size_t i = (size_t)fmin(fmax(column, 0), (double)w->nx - 1.000001);
    size_t j = (size_t)fmin(fmax(row, 0), (double)w->ny - 1.000001);
    double a = fmin(fmax(column - (double)i, 0), 1), b = fmin(fmax(row - (double)j, 0), 1);
    for (int k = 0; k < 4; k++) {
        size_t p = i + (size_t)(k & 1), q = j + (size_t)(k >> 1);
        double share = ((k & 1) ? a : 1 - a) * ((k >> 1) ? b : 1 - b);
        while (y >= 0 && q + 1 < w->ny && !isfinite(w->elevation[p * w->ny + q]))
            q++;
        while (y < 0 && q > 0 && !isfinite(w->elevation[p * w->ny + q]))
            q--;
        double value = w->elevation[p * w->ny + q];
        if (isfinite(value)) {
            sum += share * value;
            weight += share;
        }
    }
    return weight > 0 ? sum / weight : 0;
}

struct pattern {
    size_t n;
    const struct plot_waves *waves;
};

static double elevation_at(const void *user_data, double x, double y)
{
    const struct pattern *p = user_data;
    return plot_wave_at(&p->waves[p->n == 2 && y < 0], x, p->n == 2 ? fabs(y) : y);
}

static void draw_waterplane(struct plot *plot, const struct plot_frame *f,
                            const struct plot_waves *w, double side)
{
    if (w->n_edge < 2)
        return;
    plot_path(plot, (struct plot_pen){"#4b5763", 0.8, NULL}, "#c9cfd6");
    for (size_t k = 0; k < w->n_edge; k++)
        fprintf(plot->out, "%c%.2f %.2f", k ? 'L' : 'M', plot_x(f, w->edge[2 * k]),
                plot_y(f, side * w->edge[2 * k + 1]));
    fprintf(plot->out, "L%.2f %.2fL%.2f %.2fZ", plot_x(f, w->edge[2 * w->n_edge - 2]), plot_y(f, 0),
            plot_x(f, w->edge[0]), plot_y(f, 0));
    plot_path_end(plot);
}

/* Hulls, and the cusp lines of Kelvin's wedge from their bow, 19.47 degrees. */
static void draw_hulls(struct plot *plot, const struct plot_frame *f, const struct pattern *p)
{
    static const struct plot_pen dashed = {PLOT_INK, 0.8, "5 5"};
    double slope = 1 / sqrt(8), x_end = f->x.low;
    plot_clip(plot, f);
    for (int side = -1; side <= 1; side += 2) {
        const struct plot_waves *w = &p->waves[p->n == 2 && side < 0];
        double bow = -INFINITY;
        for (size_t k = 0; k < w->n_edge; k++)
            bow = fmax(bow, w->edge[2 * k]);
        if (isfinite(bow))
            plot_line(plot, plot_x(f, bow), plot_y(f, 0), plot_x(f, x_end),
                      plot_y(f, side * (bow - x_end) * slope), dashed);
        draw_waterplane(plot, f, w, side);
    }
    plot_unclip(plot);
}

bool plot_wave_pattern(struct plot *plot, double width, size_t n, const struct plot_waves *waves)
{
    enum { FINER = 3, MOST_PIXELS = 2000 };
    const struct pattern p = {n, waves};
    struct plot_frame f = {.left = 66, .top = 34, .width = width - 66 - 96};
    double breadth = (double)(waves->ny - 1) * waves->dy;
    f.x = (struct plot_axis){.low = waves->x0,
                             .high = waves->x0 + (double)(waves->nx - 1) * waves->dx,
                             .label = "x, m (forward to the right)"};
    f.y = (struct plot_axis){
        .low = n == 2 ? -breadth : waves->y0, .high = waves->y0 + breadth, .label = "y, m"};
    f.height = f.width * (f.y.high - f.y.low) / (f.x.high - f.x.low);
    if (!plot_open(plot, width, f.height + 82, n == 2 ? "Wave patterns" : "Wave pattern"))
        return false;
    double limit = colour_limit(n, waves);
    const struct plot_scale scale = {
        PLOT_DIVERGING, {.low = -limit, .high = limit, .unit = 1000, .label = "elevation, mm"}};
    size_t nx = FINER * waves->nx, ny = FINER * n * waves->ny;
    plot_axes(plot, &f);
    plot_raster(plot, &f, nx < MOST_PIXELS ? nx : MOST_PIXELS, ny < MOST_PIXELS ? ny : MOST_PIXELS,
                &scale, elevation_at, &p);
    draw_hulls(plot, &f, &p);
    if (n == 2)
        plot_line(plot, f.left, plot_y(&f, 0), f.left + f.width, plot_y(&f, 0),
                  (struct plot_pen){"white", 1, NULL});
    plot_bar(plot, f.left + f.width + 26, f.top + 20, 16, fmax(f.height - 30, 60), &scale);
    for (size_t k = 0; k < n; k++)
        if (waves[k].name)
            plot_text(plot, f.left + 10, k ? f.top + f.height - 10 : f.top + 20, 13, PLOT_START,
                      PLOT_INK, "%s", waves[k].name);
    double x = f.left + f.width - 60;
    plot_line(plot, x, 20, x + 44, 20, (struct plot_pen){PLOT_INK, 1.6, NULL});
    fprintf(plot->out, "<path d=\"M%.1f 20l-9 -4.5v9z\" fill=\"%s\"/>\n", x + 54, PLOT_INK);
    plot_text(plot, x - 8, 24, 12, PLOT_END, PLOT_INK, "course");
    return true;
}
