/* C_w against Froude number as a small SVG: one line per formulation, axes with round numbers; of
 * the first formulation also C_w by pressure, dashed, and the band between 0.85 and 1.15 t_c. */
#include "cli.h"
#include "solve.h"

#include <errno.h>
#include <math.h>
#include <string.h>

enum { WIDTH = 760, HEIGHT = 480, LEFT = 70, RIGHT = 190, TOP = 24, BOTTOM = 56 };

struct frame {
    double x0, x1, y0, y1;
};

static double to_x(const struct frame *f, double value)
{
    return LEFT + (value - f->x0) / (f->x1 - f->x0) * (WIDTH - LEFT - RIGHT);
}

static double to_y(const struct frame *f, double value)
{
    return HEIGHT - BOTTOM - (value - f->y0) / (f->y1 - f->y0) * (HEIGHT - TOP - BOTTOM);
}

/* The largest of 1, 2, 5 times a power of ten that gives at least `ticks` steps. */
static double tick_step(double range, int ticks)
{
    double power = pow(10.0, floor(log10(range / ticks)));
    double steps[4] = {1, 2, 5, 10}, step = power;
    for (int k = 0; k < 4; k++)
        if (steps[k] * power * ticks <= range)
            step = steps[k] * power;
    return step;
}

static void draw_axes(FILE *f, const struct frame *frame)
{
    fprintf(f, "<g stroke=\"#bbb\" stroke-width=\"1\" fill=\"#222\" font-size=\"13\">\n");
    double dx = tick_step(frame->x1 - frame->x0, 5), dy = tick_step(frame->y1 - frame->y0, 4);
    for (double x = ceil(frame->x0 / dx - 1e-9) * dx; x <= frame->x1 + 1e-9 * dx; x += dx)
        fprintf(f,
                "<line x1=\"%.1f\" y1=\"%d\" x2=\"%.1f\" y2=\"%d\"/><text x=\"%.1f\" y=\"%d\" "
                "text-anchor=\"middle\" stroke=\"none\">%.4g</text>\n",
                to_x(frame, x), TOP, to_x(frame, x), HEIGHT - BOTTOM, to_x(frame, x),
                HEIGHT - BOTTOM + 18, x);
    for (double y = ceil(frame->y0 / dy - 1e-9) * dy; y <= frame->y1 + 1e-9 * dy; y += dy)
        fprintf(f,
                "<line x1=\"%d\" y1=\"%.1f\" x2=\"%d\" y2=\"%.1f\"/><text x=\"%d\" y=\"%.1f\" "
                "text-anchor=\"end\" stroke=\"none\">%.4g</text>\n",
                LEFT, to_y(frame, y), WIDTH - RIGHT, to_y(frame, y), LEFT - 8, to_y(frame, y) + 4,
                fabs(y) < 1e-9 * dy ? 0.0 : y);
    fprintf(f,
            "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\" stroke=\"none\">Fr</text>\n"
            "<text x=\"18\" y=\"%d\" text-anchor=\"middle\" stroke=\"none\" "
            "transform=\"rotate(-90 18 %d)\">1000 C_w</text>\n</g>\n",
            LEFT + (WIDTH - LEFT - RIGHT) / 2, HEIGHT - 12, (HEIGHT - BOTTOM + TOP) / 2,
            (HEIGHT - BOTTOM + TOP) / 2);
}

static const char *const colours[6] = {"#1b6ca8", "#c0392b", "#27825c",
                                       "#8e44ad", "#b9770e", "#555555"};

/* Entry number `row` of the legend. */
static void draw_legend(FILE *f, size_t row, const char *colour, const char *dashes,
                        const char *text)
{
    int y = TOP + 14 + 20 * (int)row;
    fprintf(f,
            "<line x1=\"%d\" y1=\"%d\" x2=\"%d\" y2=\"%d\" stroke=\"%s\" stroke-width=\"2\"%s/>"
            "<text x=\"%d\" y=\"%d\" font-size=\"12\">%s</text>\n",
            WIDTH - RIGHT + 10, y, WIDTH - RIGHT + 34, y, colour, dashes, WIDTH - RIGHT + 40, y + 4,
            text);
}

/* What the first formulation is worth: its cut-off band and its pressure. */
static void draw_doubt(FILE *f, const struct frame *frame, const struct solve_run *run,
                       size_t per_fr)
{
    static const char dashes[] = " stroke-dasharray=\"5 4\"";
    const struct solve_result *r = solve_run_result(run, run->levels - 1, 0);
    size_t n = run->request->n_fr;
    if (isfinite(r->forces.cw_cutoff_lower) && isfinite(r->forces.cw_cutoff_upper)) {
        fprintf(f, "<polygon fill=\"%s\" fill-opacity=\"0.2\" stroke=\"none\" points=\"",
                colours[0]);
        for (size_t i = 0; i < n; i++)
            fprintf(f, "%.2f,%.2f ", to_x(frame, r[i * per_fr].options.froude),
                    to_y(frame, 1000.0 * r[i * per_fr].forces.cw_cutoff_lower));
        for (size_t i = n; i-- > 0;)
            fprintf(f, "%.2f,%.2f ", to_x(frame, r[i * per_fr].options.froude),
                    to_y(frame, 1000.0 * r[i * per_fr].forces.cw_cutoff_upper));
        fprintf(f, "\"/>\n");
    }
    if (!isfinite(r->forces.cw_pressure))
        return;
    fprintf(f, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\"%s points=\"", colours[0],
            dashes);
    for (size_t i = 0; i < n; i++)
        fprintf(f, "%.2f,%.2f ", to_x(frame, r[i * per_fr].options.froude),
                to_y(frame, 1000.0 * r[i * per_fr].forces.cw_pressure));
    fprintf(f, "\"/>\n");
    draw_legend(f, per_fr, colours[0], dashes, "the first, by pressure");
}

static void draw_series(FILE *f, const struct frame *frame, const struct solve_run *run,
                        size_t which, size_t per_fr)
{
    const struct solve_result *first = solve_run_result(run, run->levels - 1, which);
    fprintf(f, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"2\" points=\"",
            colours[which % 6]);
    for (size_t i = 0; i < run->request->n_fr; i++) {
        const struct solve_result *r = solve_run_result(run, run->levels - 1, i * per_fr + which);
        fprintf(f, "%.2f,%.2f ", to_x(frame, r->options.froude),
                to_y(frame, 1000.0 * r->forces.cw));
    }
    fprintf(f, "\"/>\n");
    draw_legend(f, which, colours[which % 6], "",
                igabem_formulation_name(first->options.formulation));
}

int solve_write_plot(const struct solve_run *run, const char *path)
{
    size_t n = run->request->n_fr, per_fr = run->cases / n;
    struct frame frame = {INFINITY, -INFINITY, 0.0, 0.0};
    for (size_t c = 0; c < run->cases; c++) {
        const struct solve_result *r = solve_run_result(run, run->levels - 1, c);
        frame.x0 = fmin(frame.x0, r->options.froude);
        frame.x1 = fmax(frame.x1, r->options.froude);
        frame.y1 = fmax(frame.y1, 1080.0 * r->forces.cw);
        if (c % per_fr == 0) /* fmax and fmin leave NAN out */
            frame.y1 = fmax(frame.y1, 1080.0 * r->forces.cw_pressure);
        if (c % per_fr == 0)
            frame.y0 = fmin(frame.y0, 1080.0 * r->forces.cw_pressure);
    }
    if (!(frame.x1 > frame.x0) || !(frame.y1 > 0))
        return cli_fail("--plot %s: expected at least two Froude numbers and a wave resistance",
                        path);
    struct cli_file file;
    if (!cli_file_open(&file, path))
        return cli_fail("%s: %s", path, strerror(errno));
    fprintf(file.stream,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
            "viewBox=\"0 0 %d %d\" font-family=\"sans-serif\">\n"
            "<!-- igabem %s -->\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
            WIDTH, HEIGHT, WIDTH, HEIGHT, TOOL_VERSION);
    draw_axes(file.stream, &frame);
    draw_doubt(file.stream, &frame, run, per_fr);
    for (size_t which = 0; which < per_fr; which++)
        draw_series(file.stream, &frame, run, which, per_fr);
    fprintf(file.stream, "</svg>\n");
    if (!cli_file_commit(&file))
        return cli_fail("%s: %s", path, strerror(errno));
    return CLI_OK;
}
