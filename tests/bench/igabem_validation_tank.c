/* The Wigley hull beside towing tanks: resistance, sinkage and trim against Froude number, as a
 * table and as docs/images/wigley_tank.svg (path relative to the working directory). */
#include "igabem_validation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CURVES = 5, SPEEDS = 31, MOST = 64 };
enum { WIDTH = 760, PANEL = 300, LEFT = 70, RIGHT = 210, TOP = 24, BOTTOM = 44 };

static const char image[] = "docs/images/wigley_tank.svg";

struct reading {
    char quantity[16];
    double fr, value, low, high;
};

/* C_w x 1000 by model; sinkage and trim x 1000 of the Neumann-Kelvin solution. */
struct sweep {
    double fr[SPEEDS];
    double cw[CURVES][SPEEDS], sinkage[SPEEDS], trim[SPEEDS];
};

static const char *const names[CURVES] = {"neumann-kelvin, waves", "neumann-kelvin, pressure",
                                          "double-body-kochin", "hogner", "michell"};
static const char *const colours[CURVES] = {"#1b6ca8", "#8e44ad", "#27825c", "#b9770e", "#555555"};

static _Noreturn void stop(const char *path, const char *why)
{
    fprintf(stderr, "igabem_validation: %s: %s\n", path, why);
    exit(EXIT_FAILURE);
}

static size_t read_tank(const char *path, struct reading readings[MOST])
{
    char line[256];
    size_t n = 0;
    FILE *file = fopen(path, "r");
    if (!file)
        stop(path, "cannot be opened");
    while (fgets(line, sizeof line, file)) {
        struct reading *r = &readings[n];
        if (line[0] == '#' || strncmp(line, "quantity", 8) == 0)
            continue;
        if (n == MOST || sscanf(line, "%15[^,],%lf,%lf,%lf,%lf", r->quantity, &r->fr, &r->value,
                                &r->low, &r->high) != 5)
            stop(path, "expected lines of quantity,fr,value,low,high");
        n++;
    }
    fclose(file);
    return n;
}

static void solve_sweep(struct sweep *sweep)
{
    static const igabem_formulation kinds[4] = {
        IGABEM_FORMULATION_NEUMANN_KELVIN, IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN,
        IGABEM_FORMULATION_HOGNER, IGABEM_FORMULATION_MICHELL};
    igabem_hull *hull = wigley(0.1, 0.0625, 32, 8);
    igabem_options options[4 * SPEEDS];
    igabem_forces forces[4 * SPEEDS];
    for (int i = 0; i < SPEEDS; i++) {
        sweep->fr[i] = 0.15 + 0.01 * i;
        for (int k = 0; k < 4; k++) {
            options[4 * i + k] = at_froude(sweep->fr[i]);
            options[4 * i + k].formulation = kinds[k];
        }
    }
    solve_all(hull, 4 * SPEEDS, options, forces);
    for (int i = 0; i < SPEEDS; i++) {
        const igabem_forces *f = &forces[4 * i];
        sweep->cw[0][i] = 1000 * f[0].cw;
        sweep->cw[1][i] = 1000 * f[0].cw_pressure;
        for (int k = 1; k < 4; k++)
            sweep->cw[k + 1][i] = 1000 * f[k].cw;
        sweep->sinkage[i] = 1000 * f[0].sinkage;
        sweep->trim[i] = 1000 * f[0].trim;
    }
    igabem_hull_free(hull);
}

/* Linear between the speeds of the sweep. */
static double at(const struct sweep *sweep, const double *curve, double fr)
{
    double s = (fr - sweep->fr[0]) / (sweep->fr[1] - sweep->fr[0]);
    int i = (int)fmin(fmax(floor(s), 0.0), SPEEDS - 2.0);
    return curve[i] + (s - i) * (curve[i + 1] - curve[i]);
}

static const double *curve_of(const struct sweep *sweep, const char *quantity)
{
    return strcmp(quantity, "cw") == 0        ? sweep->cw[0]
           : strcmp(quantity, "sinkage") == 0 ? sweep->sinkage
                                              : sweep->trim;
}

static void print_table(const struct sweep *sweep, size_t n, const struct reading *readings)
{
    printf(
        "## Wigley hull beside towing tanks\n\nMeasured: tests/data/wigley_tank.csv, figures read "
        "from published plots, second or third hand. Computed: 32 x 8 elements at\nrest, sinkage "
        "and "
        "trim linear. C_w, s/L and trim (bow up, over L) x 1000.\n\n"
        "| quantity | Fr | tank (range) | neumann-kelvin | pressure | double-body-kochin | hogner "
        "| "
        "michell |\n|---|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < n; i++) {
        const struct reading *r = &readings[i];
        printf("| %s | %.3f | %.2f (%.2f to %.2f) | %.2f |", r->quantity, r->fr, r->value, r->low,
               r->high, at(sweep, curve_of(sweep, r->quantity), r->fr));
        for (int k = 1; k < CURVES; k++) {
            if (strcmp(r->quantity, "cw") == 0)
                printf(" %.2f |", at(sweep, sweep->cw[k], r->fr));
            else
                printf(" |");
        }
        printf("\n");
    }
    printf("\n![Wigley hull beside towing tanks](images/wigley_tank.svg)\n\n");
}

struct frame {
    double top, y0, y1, step;
};

static double to_x(double fr)
{
    return LEFT + (fr - 0.15) / 0.30 * (WIDTH - LEFT - RIGHT);
}

static double to_y(const struct frame *frame, double value)
{
    return frame->top + (PANEL - BOTTOM) * (frame->y1 - value) / (frame->y1 - frame->y0);
}

static void draw_axes(FILE *f, const struct frame *frame, const char *title)
{
    double bottom = frame->top + PANEL - BOTTOM;
    fprintf(f, "<g stroke=\"#bbb\" fill=\"#222\" font-size=\"13\">\n");
    for (int k = 0; k <= 6; k++) {
        double x = to_x(0.15 + 0.05 * k);
        fprintf(
            f,
            "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/><text x=\"%.1f\" y=\"%.1f\" "
            "text-anchor=\"middle\" stroke=\"none\">%.2f</text>\n",
            x, frame->top, x, bottom, x, bottom + 18, 0.15 + 0.05 * k);
    }
    for (double v = frame->y0; v <= frame->y1 + 1e-9; v += frame->step)
        fprintf(f,
                "<line x1=\"%d\" y1=\"%.1f\" x2=\"%d\" y2=\"%.1f\"/><text x=\"%d\" y=\"%.1f\" "
                "text-anchor=\"end\" stroke=\"none\">%g</text>\n",
                LEFT, to_y(frame, v), WIDTH - RIGHT, to_y(frame, v), LEFT - 8, to_y(frame, v) + 4,
                v);
    fprintf(
        f,
        "<text x=\"18\" y=\"%.1f\" text-anchor=\"middle\" stroke=\"none\" transform=\"rotate(-90 "
        "18 %.1f)\">%s</text>\n</g>\n",
        0.5 * (frame->top + bottom), 0.5 * (frame->top + bottom), title);
}

static void draw_curve(FILE *f, const struct frame *frame, const struct sweep *sweep,
                       const double *curve, const char *colour)
{
    fprintf(f, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"2\" points=\"", colour);
    for (int i = 0; i < SPEEDS; i++)
        fprintf(f, "%.1f,%.1f ", to_x(sweep->fr[i]), to_y(frame, curve[i]));
    fprintf(f, "\"/>\n");
}

static void draw_tank(FILE *f, const struct frame *frame, const char *quantity, size_t n,
                      const struct reading *readings)
{
    for (size_t i = 0; i < n; i++) {
        const struct reading *r = &readings[i];
        if (strcmp(r->quantity, quantity) != 0)
            continue;
        double x = to_x(r->fr);
        fprintf(f,
                "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#c0392b\" "
                "stroke-width=\"2\"/><circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"#c0392b\"/>\n",
                x, to_y(frame, r->low), x, to_y(frame, r->high), x, to_y(frame, r->value));
    }
}

static void draw_legend(FILE *f)
{
    int x = WIDTH - RIGHT + 10;
    for (int k = 0; k <= CURVES; k++)
        fprintf(f,
                "<line x1=\"%d\" y1=\"%d\" x2=\"%d\" y2=\"%d\" stroke=\"%s\" "
                "stroke-width=\"2\"/><text x=\"%d\" y=\"%d\" font-size=\"12\">%s</text>\n",
                x, TOP + 14 + 20 * k, x + 20, TOP + 14 + 20 * k,
                k < CURVES ? colours[k] : "#c0392b", x + 26, TOP + 18 + 20 * k,
                k < CURVES ? names[k] : "towing tanks, range");
}

static void draw(const struct sweep *sweep, size_t n, const struct reading *readings)
{
    const struct frame resistance = {TOP, 0, 5, 1}, sinkage = {TOP + PANEL, 0, 6, 1},
                       trim = {TOP + 2 * PANEL, -5, 20, 5};
    FILE *f = fopen(image, "w");
    if (!f)
        stop(image, "cannot be written (run in the root of the sources)");
    fprintf(f,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d "
            "%d\" font-family=\"sans-serif\">\n<rect width=\"100%%\" height=\"100%%\" "
            "fill=\"white\"/>\n",
            WIDTH, TOP + 3 * PANEL + 10, WIDTH, TOP + 3 * PANEL + 10);
    draw_axes(f, &resistance, "1000 C_w");
    draw_axes(f, &sinkage, "1000 sinkage/L");
    draw_axes(f, &trim, "1000 trim, bow up");
    for (int k = CURVES - 1; k >= 0; k--)
        draw_curve(f, &resistance, sweep, sweep->cw[k], colours[k]);
    draw_curve(f, &sinkage, sweep, sweep->sinkage, colours[0]);
    draw_curve(f, &trim, sweep, sweep->trim, colours[0]);
    draw_tank(f, &resistance, "cw", n, readings);
    draw_tank(f, &sinkage, "sinkage", n, readings);
    draw_tank(f, &trim, "trim", n, readings);
    draw_legend(f);
    fprintf(f,
            "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\" font-size=\"13\">Fr</text>\n</svg>\n",
            0.5 * (LEFT + WIDTH - RIGHT), TOP + 3 * PANEL);
    if (ferror(f) | fclose(f))
        stop(image, "write error");
}

void tank_section(void)
{
    struct sweep sweep;
    struct reading readings[MOST];
    size_t n = read_tank(TEST_DATA_DIR "/wigley_tank.csv", readings);
    solve_sweep(&sweep);
    print_table(&sweep, n, readings);
    draw(&sweep, n, readings);
}
