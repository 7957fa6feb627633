/* Colours of values: maps, bars, rasters, cells and lines of equal value. */
#include "cli.h"
#include "plot/plot.h"
#include "text.h"

#include <cairo.h>
#include <glib.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

void plot_colour(enum plot_map map, double t, unsigned char rgb[3])
{
    static const unsigned char sequential[][3] = {{30, 52, 140},  {33, 98, 181},  {34, 142, 176},
                                                  {72, 178, 138}, {160, 203, 84}, {250, 224, 60}};
    static const unsigned char diverging[][3] = {{8, 48, 107},    {33, 113, 181},  {133, 183, 222},
                                                 {247, 247, 247}, {244, 165, 130}, {203, 54, 44},
                                                 {103, 0, 31}};
    const unsigned char(*stops)[3] = map == PLOT_DIVERGING ? diverging : sequential;
    size_t last = map == PLOT_DIVERGING ? 6 : 5;
    double place = (t > 0 ? fmin(t, 1) : 0) * (double)last; /* NAN counts as 0 */
    size_t i = place < (double)last ? (size_t)place : last - 1;
    for (int k = 0; k < 3; k++)
        rgb[k] = (unsigned char)lround(stops[i][k] +
                                       (place - (double)i) * (stops[i + 1][k] - stops[i][k]));
}

static double share(const struct plot_scale *scale, double value)
{
    return (value - scale->axis.low) / (scale->axis.high - scale->axis.low);
}

void plot_scale_colour(const struct plot_scale *scale, double value, char text[8])
{
    unsigned char c[3];
    plot_colour(scale->map, share(scale, value), c);
    snprintf(text, 8, "#%02x%02x%02x", c[0], c[1], c[2]);
}

void plot_bar(struct plot *plot, double x, double y, double width, double height,
              const struct plot_scale *scale)
{
    enum { STEPS = 64 };
    const struct plot_frame f = {x, y, width, height, {.high = 1}, scale->axis};
    double value[PLOT_TICKS];
    char text[PLOT_TICKS][24], colour[8];
    fputs("<g shape-rendering=\"crispEdges\">", plot->out);
    for (int k = 0; k < STEPS; k++) {
        double part = (k + 0.5) / STEPS;
        plot_scale_colour(scale, scale->axis.low + part * (scale->axis.high - scale->axis.low),
                          colour);
        /* Each step overlaps its neighbour a little: no seams when scaled. */
        fprintf(plot->out,
                "<rect x=\"%.1f\" y=\"%.2f\" width=\"%.1f\" height=\"%.2f\" fill=\"%s\"/>\n", x,
                y + height * (1 - (k + 1.0) / STEPS), width, height / STEPS + 0.3, colour);
    }
    fputs("</g>\n", plot->out);
    size_t n = plot_ticks(&scale->axis, (int)fmin(fmax(3, height / 30), 12), value, text);
    for (size_t k = 0; k < n; k++) {
        double at = plot_y(&f, value[k]);
        plot_line(plot, x + width, at, x + width + 4, at, (struct plot_pen){PLOT_MUTED, 1, NULL});
        plot_label(plot, x + width + 7, at + 4, 11, PLOT_START, PLOT_MUTED, "%s", text[k]);
    }
    if (scale->axis.label)
        plot_text(plot, fmin(x, plot->width - plot_text_width(scale->axis.label, 11) - 2), y - 9,
                  11, PLOT_START, PLOT_INK, "%s", scale->axis.label);
}

static cairo_status_t write_bytes(void *stream, const unsigned char *data, unsigned n)
{
    return fwrite(data, 1, n, stream) == n ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

/* As a PNG in base 64. */
static void write_image(cairo_surface_t *image, FILE *out)
{
    char *png = NULL;
    size_t n = 0;
    FILE *memory = cli_needed(text_open(&png, &n));
    bool whole = !cairo_surface_write_to_png_stream(image, write_bytes, memory);
    cli_needed(text_close(memory, &png) && whole ? png : NULL);
    gchar *text = g_base64_encode((const guchar *)png, n);
    fputs(text, out);
    g_free(text);
    free(png);
}

void plot_raster(struct plot *plot, const struct plot_frame *f, size_t nx, size_t ny,
                 const struct plot_scale *scale,
                 double (*value)(const void *user_data, double x, double y), const void *user_data)
{
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)nx, (int)ny);
    unsigned char *pixels = cairo_image_surface_get_data(image);
    size_t stride = (size_t)cairo_image_surface_get_stride(image);
    for (size_t j = 0; pixels && j < ny; j++) {
        uint32_t *row = (uint32_t *)(void *)(pixels + j * stride);
        double y = f->y.high - (f->y.high - f->y.low) * ((double)j + 0.5) / (double)ny;
        for (size_t i = 0; i < nx; i++) {
            double x = f->x.low + (f->x.high - f->x.low) * ((double)i + 0.5) / (double)nx;
            unsigned char c[3];
            plot_colour(scale->map, share(scale, value(user_data, x, y)), c);
            row[i] = (uint32_t)c[0] << 16 | (uint32_t)c[1] << 8 | c[2];
        }
    }
    cairo_surface_mark_dirty(image);
    fprintf(plot->out,
            "<image x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" "
            "preserveAspectRatio=\"none\" href=\"data:image/png;base64,",
            f->left, f->top, f->width, f->height);
    write_image(image, plot->out);
    plot_path_end(plot);
    cairo_surface_destroy(image);
}

static void cell_corners(const struct plot_field *field, size_t i, size_t j, size_t corner[4])
{
    corner[0] = i * field->nv + j;
    corner[1] = corner[0] + field->nv;
    corner[2] = corner[1] + 1;
    corner[3] = corner[0] + 1;
}

void plot_cells(struct plot *plot, const struct plot_frame *f, const struct plot_field *field,
                const struct plot_scale *scale)
{
    fputs("<g stroke-width=\"0.6\" stroke-linejoin=\"round\">\n", plot->out);
    for (size_t i = 0; i + 1 < field->nu; i++)
        for (size_t j = 0; j + 1 < field->nv; j++) {
            size_t c[4];
            double mean = 0;
            char colour[8];
            cell_corners(field, i, j, c);
            for (int k = 0; k < 4; k++)
                mean += field->value[c[k]] / 4;
            if (!isfinite(mean))
                continue;
            plot_scale_colour(scale, mean, colour);
            for (int k = 0; k < 4; k++)
                fprintf(plot->out, "%s%.2f %.2f", k ? "L" : "<path d=\"M",
                        plot_x(f, field->x[c[k]]), plot_y(f, field->y[c[k]]));
            fprintf(plot->out, "Z\" fill=\"%s\" stroke=\"%s\"/>\n", colour, colour);
        }
    fputs("</g>\n", plot->out);
}

void plot_isolines(struct plot *plot, const struct plot_frame *f, const struct plot_field *field,
                   double level, struct plot_pen pen)
{
    plot_path(plot, pen, NULL);
    for (size_t i = 0; i + 1 < field->nu; i++)
        for (size_t j = 0; j + 1 < field->nv; j++) {
            size_t c[4], crossings = 0;
            double xy[4][2];
            cell_corners(field, i, j, c);
            for (int k = 0; k < 4; k++) {
                size_t a = c[k], b = c[(k + 1) % 4];
                double va = field->value[a] - level, vb = field->value[b] - level;
                if (!isfinite(va) || !isfinite(vb) || (va > 0) == (vb > 0))
                    continue;
                double t = va / (va - vb);
                xy[crossings][0] = plot_x(f, field->x[a] + t * (field->x[b] - field->x[a]));
                xy[crossings++][1] = plot_y(f, field->y[a] + t * (field->y[b] - field->y[a]));
            }
            for (size_t k = 0; k + 1 < crossings; k += 2)
                fprintf(plot->out, "M%.2f %.2fL%.2f %.2f", xy[k][0], xy[k][1], xy[k + 1][0],
                        xy[k + 1][1]);
        }
    plot_path_end(plot);
}
