#include "svg.h"

#include <math.h>
#include <stdarg.h>

void svg_begin(FILE *out, double width, double height)
{
    fprintf(out,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
            "viewBox=\"0 0 %.0f %.0f\" font-family=\"sans-serif\">\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
            width, height, width, height);
}

void svg_end(FILE *out)
{
    fputs("</svg>\n", out);
}

void svg_text(FILE *out, double x, double y, double size, enum svg_anchor anchor,
              const char *format, ...)
{
    static const char *const names[] = {"start", "middle", "end"};
    char text[256];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%.0f\" text-anchor=\"%s\">", x, y, size,
            names[anchor]);
    for (const char *c = text; *c; c++) {
        if (*c == '<')
            fputs("&lt;", out);
        else if (*c == '&')
            fputs("&amp;", out);
        else
            fputc(*c, out);
    }
    fputs("</text>\n", out);
}

void svg_line(FILE *out, double x1, double y1, double x2, double y2, const char *stroke)
{
    fprintf(out, "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"%s\"/>\n", x1, y1, x2, y2, stroke);
}

void svg_polyline(FILE *out, size_t n, const double *xy, const char *stroke, double width)
{
    fputs("<path d=\"", out);
    for (size_t i = 0; i < n; i++)
        fprintf(out, "%c%.1f %.1f", i ? 'L' : 'M', xy[2 * i], xy[2 * i + 1]);
    fprintf(out, "\" fill=\"none\" stroke=\"%s\" stroke-width=\"%g\"/>\n", stroke, width);
}

void svg_colour(double t, char text[8])
{
    static const double stops[5][3] = {
        {45, 48, 140}, {25, 105, 200}, {20, 165, 175}, {140, 200, 85}, {250, 230, 30}};
    t = 4 * fmin(fmax(t, 0), 1);
    int k = t < 4 ? (int)t : 3;
    unsigned c[3];
    for (int j = 0; j < 3; j++)
        c[j] = (unsigned)lrint(stops[k][j] + (t - k) * (stops[k + 1][j] - stops[k][j])) & 255;
    snprintf(text, 8, "#%02x%02x%02x", c[0], c[1], c[2]);
}

void svg_colour_bar(FILE *out, double x, double y, double width, double height)
{
    enum { STEPS = 64 };
    char colour[8];
    fputs("<g shape-rendering=\"crispEdges\">\n", out);
    for (int k = 0; k < STEPS; k++) {
        svg_colour((k + 0.5) / STEPS, colour);
        fprintf(out, "<rect x=\"%.2f\" y=\"%.1f\" width=\"%.2f\" height=\"%.1f\" fill=\"%s\"/>\n",
                x + width * k / STEPS, y, width / STEPS, height, colour);
    }
    fputs("</g>\n", out);
}

/* 1, 2 or 5 times a power of ten, about a fifth of the range. */
static double tick_step(double range)
{
    double power = pow(10, floor(log10(range / 5))), part = range / 5 / power;
    return power * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
}

struct scale {
    double low, high;
    int logarithmic;
};

static double place(const struct svg_chart *chart, const struct scale *scale, double value)
{
    double v = scale->logarithmic ? log10(value) : value;
    return chart->y + chart->height * (1 - (v - scale->low) / (scale->high - scale->low));
}

static struct scale find_scale(const struct svg_chart *chart, size_t n, const double *values)
{
    struct scale scale = {INFINITY, -INFINITY, chart->logarithmic};
    for (size_t k = 0; k < n; k++) {
        if (chart->logarithmic && !(values[k] > 0))
            continue;
        double v = chart->logarithmic ? log10(values[k]) : values[k];
        scale.low = fmin(scale.low, v);
        scale.high = fmax(scale.high, v);
    }
    if (!(scale.high >= scale.low))
        scale.low = scale.high = 0;
    if (chart->logarithmic) {
        scale.low = floor(scale.low);
        scale.high = fmax(ceil(scale.high), scale.low + 1);
    } else {
        double step = tick_step(fmax(scale.high - scale.low, 1e-12));
        scale.low = floor(scale.low / step) * step;
        scale.high = fmax(ceil(scale.high / step) * step, scale.low + step);
    }
    return scale;
}

static void draw_ticks(FILE *out, const struct svg_chart *chart, const struct scale *scale,
                       size_t n)
{
    double right = chart->x + chart->width, bottom = chart->y + chart->height;
    double range = scale->high - scale->low;
    double step = scale->logarithmic ? fmax(1, ceil(range / 6)) : tick_step(range);
    for (int k = 0; scale->low + k * step <= scale->high + 1e-9 * step; k++) {
        double v = scale->low + k * step;
        double y = bottom - chart->height * (v - scale->low) / range;
        svg_line(out, chart->x, y, right, y, "#ddd");
        if (scale->logarithmic)
            svg_text(out, chart->x - 6, y + 4, 11, SVG_END, "1e%d", (int)v);
        else
            svg_text(out, chart->x - 6, y + 4, 11, SVG_END, "%.6g", v);
    }
    size_t every = n > 10 ? (size_t)tick_step((double)n) : 1;
    for (size_t k = every; k <= n; k += every) {
        double x = chart->x + chart->width * (double)k / (double)(n + 1);
        svg_line(out, x, bottom, x, bottom + 4, "#444");
        svg_text(out, x, bottom + 17, 11, SVG_MIDDLE, "%zu", k);
    }
}

void svg_draw_chart(FILE *out, const struct svg_chart *chart, size_t n, const double *values)
{
    struct scale scale = find_scale(chart, n, values);
    double bottom = chart->y + chart->height;
    draw_ticks(out, chart, &scale, n);
    fprintf(out,
            "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" "
            "stroke=\"#444\"/>\n",
            chart->x, chart->y, chart->width, chart->height);
    svg_text(out, chart->x, chart->y - 10, 14, SVG_START, "%s", chart->title);
    svg_text(out, chart->x + chart->width / 2, bottom + 36, 12, SVG_MIDDLE, "%s", chart->label);
    fputs("<path fill=\"none\" stroke=\"#1969c8\" stroke-width=\"1.5\" d=\"", out);
    char command = 'M';
    for (size_t k = 0; k < n; k++) {
        if (chart->logarithmic && !(values[k] > 0))
            continue;
        fprintf(out, "%c%.1f %.1f", command,
                chart->x + chart->width * (double)(k + 1) / (double)(n + 1),
                place(chart, &scale, values[k]));
        command = 'L';
    }
    fputs("\"/>\n", out);
    for (size_t k = 0; k < n; k++) {
        if (chart->logarithmic && !(values[k] > 0))
            continue;
        int marked = k + 1 == chart->mark;
        fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%d\" fill=\"%s\"/>\n",
                chart->x + chart->width * (double)(k + 1) / (double)(n + 1),
                place(chart, &scale, values[k]), marked ? 5 : 2, marked ? "#d62728" : "#1969c8");
    }
}
