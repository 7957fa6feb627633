#include "report/drawings.h"
#include "report/svg.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 520, HEIGHT = 300 };

static struct svg_frame make_frame(void)
{
    return (struct svg_frame){.left = 68, .top = 16, .width = WIDTH - 88, .height = HEIGHT - 70};
}

/* As many modes as are worth a look: those of a linear family, or twice those kept. */
static size_t shown(const struct latent *l)
{
    size_t n = l->parameters > 2 * l->modes ? l->parameters : 2 * l->modes;
    return n < l->spectrum ? n : l->spectrum;
}

static void mark_kept(FILE *out, const struct svg_frame *frame, size_t modes, double value,
                      double text_below, const char *text)
{
    double x = svg_x(frame, (double)modes), y = svg_y(frame, value);
    svg_line(out, x, frame->top, x, frame->top + frame->height, SVG_OPTIMUM, 1.2, "4 3");
    fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\" fill=\"%s\"/>\n", x, y, SVG_OPTIMUM);
    bool right = x < frame->left + 0.6 * frame->width;
    svg_text(out, right ? x + 9 : x - 9, y + text_below, 12, right ? "start" : "end", SVG_OPTIMUM,
             text);
}

static void dots(FILE *out, const struct svg_frame *frame, size_t n, const double *x,
                 const double *y)
{
    for (size_t i = 0; i < n; i++)
        if (isfinite(y[i]))
            fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.4\" fill=\"%s\"/>\n",
                    svg_x(frame, x[i]), svg_y(frame, y[i]), SVG_BLUE);
}

void draw_variance(FILE *out, const struct latent *latent, double wanted)
{
    size_t n = shown(latent);
    double *x = calloc(n + 1, sizeof *x), *y = calloc(n + 1, sizeof *y);
    struct svg_frame frame = make_frame();
    char text[80];
    svg_open(out, WIDTH, HEIGHT, "Geometric variance retained against the number of modes");
    for (size_t k = 1; x && y && k <= n; k++) {
        x[k] = (double)k;
        y[k] = y[k - 1] + 100 * latent->eigenvalues[k - 1] / latent->trace;
    }
    if (x && y) {
        frame.x0 = 0;
        frame.x1 = (double)n;
        frame.y0 = 0;
        frame.y1 = 100;
        svg_axes(out, &frame, "modes m", "retained variance, %");
        double line_x[] = {frame.x0, frame.x1}, line_y[] = {100 * wanted, 100 * wanted};
        svg_curve(out, &frame, 2, line_x, line_y, SVG_MUTED, 1, "2 3");
        svg_curve(out, &frame, n + 1, x, y, SVG_BLUE, 1.8, NULL);
        dots(out, &frame, n + 1, x, y);
        snprintf(text, sizeof text, "m = %zu: %.2f %%", latent->modes, 100 * latent->retained);
        mark_kept(out, &frame, latent->modes, 100 * latent->retained, 20, text);
    }
    svg_close(out);
    free(x);
    free(y);
}

void draw_error(FILE *out, const struct latent *latent)
{
    size_t n = shown(latent);
    double *x = calloc(n, sizeof *x), *y = calloc(n, sizeof *y);
    struct svg_frame frame = make_frame();
    char text[80];
    svg_open(out, WIDTH, HEIGHT, "Mean square error of the reconstruction");
    if (x && y) {
        double low = latent->trace, high = latent->trace;
        for (size_t k = 0; k < n; k++) {
            x[k] = (double)(k + 1);
            /* Rounding of the last eigenvalues is not an error of the method. */
            y[k] = latent->mse[k] > 1e-9 * latent->trace ? latent->mse[k] : NAN;
            low = isfinite(y[k]) ? fmin(low, y[k]) : low;
        }
        frame.x0 = 0;
        frame.x1 = (double)n;
        frame.log_y = true;
        frame.y0 = pow(10, floor(log10(low)));
        frame.y1 = pow(10, ceil(log10(high)));
        svg_axes(out, &frame, "modes m", "mean square error, m²");
        svg_curve(out, &frame, n, x, y, SVG_BLUE, 1.8, NULL);
        dots(out, &frame, n, x, y);
        double kept = latent->mse[latent->modes - 1];
        if (kept > frame.y0) {
            snprintf(text, sizeof text, "%.3g m²", kept);
            mark_kept(out, &frame, latent->modes, kept, -10, text);
        }
    }
    svg_close(out);
    free(x);
    free(y);
}
