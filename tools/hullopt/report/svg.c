#include "report/svg.h"

#include <math.h>
#include <stdlib.h>

void svg_open(FILE *out, double width, double height, const char *title)
{
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" role=\"img\" "
            "font-family=\"system-ui,'Helvetica Neue',Arial,sans-serif\">\n<title>",
            width, height);
    svg_escape(out, title);
    fputs("</title>\n", out);
}

void svg_close(FILE *out)
{
    fputs("</svg>\n", out);
}

void svg_escape(FILE *out, const char *text)
{
    for (; *text; text++) {
        switch (*text) {
        case '&':
            fputs("&amp;", out);
            break;
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        default:
            if ((unsigned char)*text >= ' ')
                fputc(*text, out);
        }
    }
}

void svg_text(FILE *out, double x, double y, double size, const char *anchor, const char *colour,
              const char *text)
{
    fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%g\" text-anchor=\"%s\" fill=\"%s\">", x,
            y, size, anchor, colour);
    svg_escape(out, text);
    fputs("</text>\n", out);
}

void svg_line(FILE *out, double x1, double y1, double x2, double y2, const char *colour,
              double width, const char *dashes)
{
    fprintf(out,
            "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" "
            "stroke-width=\"%g\"",
            x1, y1, x2, y2, colour, width);
    if (dashes)
        fprintf(out, " stroke-dasharray=\"%s\"", dashes);
    fputs("/>\n", out);
}

double svg_x(const struct svg_frame *f, double x)
{
    return f->left + f->width * (x - f->x0) / (f->x1 - f->x0);
}

double svg_y(const struct svg_frame *f, double y)
{
    double share = f->log_y ? log(y / f->y0) / log(f->y1 / f->y0) : (y - f->y0) / (f->y1 - f->y0);
    return f->top + f->height * (1 - share);
}

/* 1, 2 or 5 times a power of ten that gives about `wanted` steps. */
static double tick_step(double span, int wanted)
{
    double raw = span / wanted, power = pow(10, floor(log10(raw))), m = raw / power;
    return power * (m < 1.5 ? 1 : m < 3.5 ? 2 : m < 7.5 ? 5 : 10);
}

void svg_nice(double *low, double *high)
{
    if (!(*high > *low)) {
        double margin = fmax(fabs(*low) * 0.1, 1e-12);
        *low -= margin;
        *high += margin;
    }
    double step = tick_step(*high - *low, 5);
    *low = floor(*low / step + 1e-9) * step;
    *high = ceil(*high / step - 1e-9) * step;
}

static void print_number(char *text, size_t size, double value, double step)
{
    double magnitude = fmax(fabs(value), step);
    if (fabs(value) < 1e-9 * step)
        snprintf(text, size, "0");
    else if (magnitude < 1e-3 || magnitude >= 1e5)
        snprintf(text, size, "%.3g", value);
    else
        snprintf(text, size, "%.*f", (int)fmax(0, -floor(log10(step) + 1e-9)), value);
}

/* "10⁻³" */
static void print_power(char *text, size_t size, int exponent)
{
    static const char *const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    int magnitude = abs(exponent);
    snprintf(text, size, "10%s%s%s", exponent < 0 ? "⁻" : "",
             magnitude > 9 ? digits[magnitude / 10 % 10] : "", digits[magnitude % 10]);
}

static void x_ticks(FILE *out, const struct svg_frame *f)
{
    double step = tick_step(f->x1 - f->x0, 7);
    char text[40];
    for (double k = ceil(f->x0 / step - 1e-9); k * step <= f->x1 + 1e-9 * step; k++) {
        double x = svg_x(f, k * step);
        svg_line(out, x, f->top, x, f->top + f->height, SVG_GRID, 1, NULL);
        print_number(text, sizeof text, k * step, step);
        svg_text(out, x, f->top + f->height + 16, 11, "middle", SVG_MUTED, text);
    }
}

static void y_tick(FILE *out, const struct svg_frame *f, double value, double step)
{
    char text[40];
    double y = svg_y(f, value);
    svg_line(out, f->left, y, f->left + f->width, y, SVG_GRID, 1, NULL);
    if (f->log_y)
        print_power(text, sizeof text, (int)lround(log10(value)));
    else
        print_number(text, sizeof text, value, step);
    svg_text(out, f->left - 7, y + 4, 11, "end", SVG_MUTED, text);
}

static void y_ticks(FILE *out, const struct svg_frame *f)
{
    if (f->log_y) {
        int first = (int)ceil(log10(f->y0) - 1e-9), last = (int)floor(log10(f->y1) + 1e-9);
        int every = 1 + (last - first) / 8;
        for (int k = first; k <= last; k += every)
            y_tick(out, f, pow(10, k), 1);
        return;
    }
    double step = tick_step(f->y1 - f->y0, 5);
    for (double k = ceil(f->y0 / step - 1e-9); k * step <= f->y1 + 1e-9 * step; k++)
        y_tick(out, f, k * step, step);
}

void svg_axes(FILE *out, const struct svg_frame *f, const char *x_label, const char *y_label)
{
    x_ticks(out, f);
    y_ticks(out, f);
    fprintf(out,
            "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" "
            "stroke=\"#c3ccd5\"/>\n",
            f->left, f->top, f->width, f->height);
    svg_text(out, f->left + f->width / 2, f->top + f->height + 34, 12, "middle", SVG_INK, x_label);
    fprintf(out, "<g transform=\"rotate(-90 %.1f %.1f)\">", f->left - 46, f->top + f->height / 2);
    svg_text(out, f->left - 46, f->top + f->height / 2, 12, "middle", SVG_INK, y_label);
    fputs("</g>\n", out);
}

void svg_curve(FILE *out, const struct svg_frame *f, size_t n, const double *x, const double *y,
               const char *colour, double width, const char *dashes)
{
    fprintf(out, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"%g\" stroke-linejoin=\"round\"",
            colour, width);
    if (dashes)
        fprintf(out, " stroke-dasharray=\"%s\"", dashes);
    fputs(" d=\"", out);
    bool drawing = false;
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(x[i]) || !isfinite(y[i])) {
            drawing = false;
            continue;
        }
        fprintf(out, "%c%.2f %.2f", drawing ? 'L' : 'M', svg_x(f, x[i]), svg_y(f, y[i]));
        drawing = true;
    }
    fputs("\"/>\n", out);
}

void svg_legend_row(FILE *out, double x, double y, const struct svg_legend *entries, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (entries[i].dot)
            fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"%s\"/>\n", x + 8, y - 4,
                    entries[i].colour);
        else
            svg_line(out, x, y - 4, x + 18, y - 4, entries[i].colour, 2.2, entries[i].dashes);
        svg_text(out, x + 24, y, 12, "start", SVG_INK, entries[i].text);
        size_t length = 0;
        while (entries[i].text[length])
            length++;
        x += 42 + 6.4 * (double)length;
    }
}
