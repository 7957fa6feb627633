/* Axes with round ticks, and curves on them. */
#include "cli.h"
#include "plot/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double plot_tick_step(double span, int wanted, bool whole)
{
    double raw = span / wanted;
    if (!(raw > 0) || !isfinite(raw))
        return 1;
    double power = pow(10, floor(log10(raw))), part = raw / power;
    double step = power * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
    return whole ? fmax(1, round(step)) : step;
}

void plot_include(struct plot_axis *axis, size_t n, const double *values)
{
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(values[i]) || (axis->log && !(values[i] > 0)))
            continue;
        axis->low = fmin(axis->low, values[i]);
        axis->high = fmax(axis->high, values[i]);
    }
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double plot_percentile(size_t n, const double *values, bool sizes, double share)
{
    double *sorted = cli_needed(malloc((n + 1) * sizeof *sorted)), found = 0;
    size_t known = 0;
    for (size_t i = 0; i < n; i++)
        if (isfinite(values[i]))
            sorted[known++] = sizes ? fabs(values[i]) : values[i];
    if (known) {
        qsort(sorted, known, sizeof *sorted, compare);
        found = sorted[(size_t)(share * (double)(known - 1))];
    }
    free(sorted);
    return found;
}

void plot_settle(struct plot_axis *axis)
{
    static const double most = 1e300, resolution = 1e-9;
    double low = axis->low, high = axis->high;
    if (!(low <= high)) /* empty, or NAN */
        low = high = axis->log ? 1 : 0;
    low = fmin(fmax(low, axis->log ? 1 / most : -most), most);
    high = fmin(fmax(high, axis->log ? 1 / most : -most), most);
    if (axis->whole) {
        low = floor(low);
        high = fmax(ceil(high), low + 1);
    }
    double room = fmax(fabs(low), fabs(high));
    if (axis->log && !(high > low * (1 + resolution))) {
        low /= 3;
        high *= 3;
    } else if (!axis->log && !(high - low > resolution * room)) {
        room = room > 0 ? 0.1 * room : 1;
        low -= room;
        high += room;
    }
    axis->low = low;
    axis->high = high;
}

void plot_nice(struct plot_axis *axis, int wanted)
{
    plot_settle(axis);
    if (axis->log) {
        axis->low = pow(10, floor(log10(axis->low) + 1e-9));
        axis->high = pow(10, ceil(log10(axis->high) - 1e-9));
    } else {
        double step = plot_tick_step(axis->high - axis->low, wanted, axis->whole);
        axis->low = floor(axis->low / step + 1e-9) * step;
        axis->high = ceil(axis->high / step - 1e-9) * step;
    }
    plot_settle(axis);
}

/* As many digits as tell one tick from the next, a true minus sign. */
static void print_number(char text[24], double value, double step)
{
    char number[24];
    double magnitude = fmax(fabs(value), step);
    int digits = (int)(floor(log10(magnitude) + 1e-9) - floor(log10(step) + 1e-9)) + 1;
    if (fabs(value) < 1e-9 * step)
        snprintf(number, sizeof number, "0");
    else if (magnitude >= 1e6 || step < 1e-5)
        snprintf(number, sizeof number, "%.*g", digits < 12 ? digits : 12, value);
    else
        snprintf(number, sizeof number, "%.*f", (int)fmax(0, -floor(log10(step) + 1e-9)), value);
    snprintf(text, 24, "%s%.18s", *number == '-' ? "−" : "", number + (*number == '-'));
}

/* "10⁻³", "2·10⁻³" */
static void print_power(char text[24], int mantissa, int exponent)
{
    static const char *const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    int n = abs(exponent);
    snprintf(text, 24, "%s10%s%s%s%s",
             mantissa == 1   ? ""
             : mantissa == 2 ? "2·"
                             : "5·",
             exponent < 0 ? "⁻" : "", n > 99 ? digits[n / 100 % 10] : "",
             n > 9 ? digits[n / 10 % 10] : "", digits[n % 10]);
}

static size_t log_ticks(const struct plot_axis *axis, double unit, int wanted, double *value,
                        char (*text)[24])
{
    static const int mantissas[] = {1, 2, 5};
    double low = log10(axis->low * unit), high = log10(axis->high * unit);
    int every = 1 + (int)((high - low) / fmax(wanted, 1)), shown = high - low < 2 ? 3 : 1;
    size_t n = 0;
    for (int k = (int)floor(low); k <= (int)ceil(high) && n < PLOT_TICKS; k += every)
        for (int m = 0; m < shown && n < PLOT_TICKS; m++) {
            double place = k + log10(mantissas[m]);
            if (place < low - 1e-9 || place > high + 1e-9)
                continue;
            value[n] = pow(10, place) / unit;
            print_power(text[n++], mantissas[m], k);
        }
    return n;
}

size_t plot_ticks(const struct plot_axis *axis, int wanted, double value[PLOT_TICKS],
                  char text[PLOT_TICKS][24])
{
    double unit = axis->unit != 0 ? axis->unit : 1;
    if (axis->log)
        return log_ticks(axis, unit, wanted, value, text);
    double low = axis->low * unit, high = axis->high * unit;
    double step = plot_tick_step(high - low, wanted, axis->whole);
    size_t n = 0;
    for (double k = ceil(low / step - 1e-9); k * step <= high + 1e-9 * step && n < PLOT_TICKS;
         k++) {
        value[n] = k * step / unit;
        print_number(text[n++], k * step, step);
    }
    return n;
}

double plot_x(const struct plot_frame *f, double x)
{
    double share = f->x.log ? log(x / f->x.low) / log(f->x.high / f->x.low)
                            : (x - f->x.low) / (f->x.high - f->x.low);
    return f->left + f->width * share;
}

double plot_y(const struct plot_frame *f, double y)
{
    double share = f->y.log ? log(y / f->y.low) / log(f->y.high / f->y.low)
                            : (y - f->y.low) / (f->y.high - f->y.low);
    return f->top + f->height * (1 - share);
}

static const struct plot_pen grid_pen = {PLOT_GRID, 1, NULL};

static void x_axis(struct plot *plot, const struct plot_frame *f)
{
    double value[PLOT_TICKS], bottom = f->top + f->height;
    char text[PLOT_TICKS][24];
    size_t n = plot_ticks(&f->x, (int)fmax(2, f->width / 75), value, text);
    for (size_t k = 0; k < n; k++) {
        double x = plot_x(f, value[k]);
        plot_line(plot, x, f->top, x, bottom, grid_pen);
        plot_label(plot, x, bottom + 16, 11, PLOT_MIDDLE, PLOT_MUTED, "%s", text[k]);
    }
    if (f->x.label)
        plot_text(plot, f->left + f->width / 2, bottom + 34, 12, PLOT_MIDDLE, PLOT_INK, "%s",
                  f->x.label);
}

static void y_axis(struct plot *plot, const struct plot_frame *f)
{
    double value[PLOT_TICKS], widest = 0, middle = f->top + f->height / 2;
    char text[PLOT_TICKS][24];
    size_t n = plot_ticks(&f->y, (int)fmax(2, f->height / 45), value, text);
    for (size_t k = 0; k < n; k++) {
        double y = plot_y(f, value[k]);
        plot_line(plot, f->left, y, f->left + f->width, y, grid_pen);
        plot_label(plot, f->left - 7, y + 4, 11, PLOT_END, PLOT_MUTED, "%s", text[k]);
        widest = fmax(widest, plot_text_width(text[k], 11));
    }
    if (!f->y.label)
        return;
    double x = fmax(12, f->left - widest - 14);
    fprintf(plot->out, "<g transform=\"translate(%.1f %.1f) rotate(-90)\">", x, middle);
    size_t boxes = plot->n_boxes;
    plot_text(plot, 0, 0, 12, PLOT_MIDDLE, PLOT_INK, "%s", f->y.label);
    fputs("</g>\n", plot->out);
    double half = plot_text_width(f->y.label, 12) / 2;
    if (plot->n_boxes > boxes)
        plot->boxes[boxes] = (struct plot_box){x - 10, middle - half, x + 3, middle + half};
}

void plot_axes(struct plot *plot, struct plot_frame *f)
{
    plot_settle(&f->x);
    plot_settle(&f->y);
    x_axis(plot, f);
    y_axis(plot, f);
    fprintf(plot->out,
            "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" "
            "stroke=\"#c3ccd5\"/>\n",
            f->left, f->top, f->width, f->height);
}

void plot_curve(struct plot *plot, const struct plot_frame *f, size_t n, const double *x,
                const double *y, struct plot_pen pen)
{
    bool drawing = false;
    plot_path(plot, pen, NULL);
    for (size_t i = 0; i < n; i++) {
        double px = plot_x(f, x[i]), py = plot_y(f, y[i]);
        bool there = isfinite(px) && isfinite(py);
        if (there)
            fprintf(plot->out, "%c%.2f %.2f", drawing ? 'L' : 'M', px, py);
        drawing = there;
    }
    plot_path_end(plot);
}

void plot_band(struct plot *plot, const struct plot_frame *f, size_t n, const double *x,
               const double *low, const double *high, const char *colour)
{
    char command = 'M';
    fprintf(plot->out, "<path fill=\"%s\" fill-opacity=\"0.2\" d=\"", colour);
    for (size_t k = 0; k < 2 * n; k++) {
        size_t i = k < n ? k : 2 * n - 1 - k;
        double px = plot_x(f, x[i]), py = plot_y(f, k < n ? low[i] : high[i]);
        if (!isfinite(px) || !isfinite(py))
            continue;
        fprintf(plot->out, "%c%.2f %.2f", command, px, py);
        command = 'L';
    }
    plot_path_end(plot);
}
