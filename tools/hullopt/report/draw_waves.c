#include "report/drawings.h"
#include "report/png.h"
#include "report/svg.h"

#include <math.h>
#include <stdlib.h>

enum {
    WIDTH = 1060,
    MARGIN_LEFT = 70,
    MARGIN_RIGHT = 92,
    FINER = 3,
    OUTLINE = 161,
    CUT_HEIGHT = 280
};

/* What the picture shows of both halves. */
struct pattern {
    const struct results *results;
    const struct waves *half[2];
    double limit; /* elevation at the ends of the colour map, m */
};

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The 99th percentile of |elevation| of both hulls, rounded up to two digits. */
static double colour_limit(const struct waves *a, const struct waves *b)
{
    size_t na = a->nx * a->ny, nb = b->nx * b->ny, n = 0;
    double *all = malloc((na + nb) * sizeof *all), limit = 1;
    if (!all)
        return limit;
    for (size_t i = 0; i < na + nb; i++) {
        double value = fabs(i < na ? a->elevation[i] : b->elevation[i - na]);
        if (isfinite(value))
            all[n++] = value;
    }
    qsort(all, n, sizeof *all, compare);
    if (n && all[n * 99 / 100] > 0) {
        double unit = pow(10, floor(log10(all[n * 99 / 100])) - 1);
        limit = ceil(all[n * 99 / 100] / unit) * unit;
    }
    free(all);
    return limit;
}

/* Bilinear between the points of the field; inside the hull, where there is no water, the nearest
 * known value, so that the waterplane can be laid over without a rim. */
static double sample(const struct waves *w, double x, double y)
{
    double column = (x - w->x0) / w->dx, row = (y - w->y0) / w->dy;
    size_t i = (size_t)fmin(fmax(column, 0), (double)w->nx - 1.000001);
    size_t j = (size_t)fmin(fmax(row, 0), (double)w->ny - 1.000001);
    double a = fmin(fmax(column - (double)i, 0), 1), b = fmin(fmax(row - (double)j, 0), 1);
    double sum = 0, weight = 0;
    for (int k = 0; k < 4; k++) {
        size_t p = i + (k & 1), q = j + (size_t)(k >> 1);
        double share = ((k & 1) ? a : 1 - a) * ((k >> 1) ? b : 1 - b);
        while (q + 1 < w->ny && !isfinite(w->elevation[p * w->ny + q]))
            q++;
        double value = w->elevation[p * w->ny + q];
        if (isfinite(value)) {
            sum += share * value;
            weight += share;
        }
    }
    return weight > 0 ? sum / weight : 0;
}

static void raster(FILE *out, const struct svg_frame *f, const struct pattern *p)
{
    const struct waves *w = p->half[0];
    size_t nx = FINER * w->nx, ny = 2 * FINER * w->ny;
    unsigned char palette[256][3], *pixels = malloc(nx * ny);
    for (int k = 0; k < 256; k++)
        svg_map_diverging(k / 255.0, palette[k]);
    for (size_t j = 0; pixels && j < ny; j++) {
        double y = f->y1 - (f->y1 - f->y0) * ((double)j + 0.5) / (double)ny;
        for (size_t i = 0; i < nx; i++) {
            double x = f->x0 + (f->x1 - f->x0) * ((double)i + 0.5) / (double)nx;
            double t = 0.5 + 0.5 * sample(p->half[y < 0], x, fabs(y)) / p->limit;
            pixels[j * nx + i] = (unsigned char)lround(255 * fmin(fmax(t, 0), 1));
        }
    }
    fprintf(out,
            "<image x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" "
            "preserveAspectRatio=\"none\" href=\"",
            f->left, f->top, f->width, f->height);
    if (pixels)
        png_data_uri(out, nx, ny, pixels, (const unsigned char(*)[3])palette);
    fputs("\"/>\n", out);
    free(pixels);
}

/* Half of the waterplane, from the edge v = 0 of the wetted surface. */
static void waterplane(FILE *out, const struct svg_frame *f, const nurbs_surface *wetted,
                       double side)
{
    const double *ku = nurbs_surface_knots(wetted, 0), *kv = nurbs_surface_knots(wetted, 1);
    size_t pu = (size_t)nurbs_surface_degree(wetted, 0), nu = nurbs_surface_size(wetted, 0);
    double uv[OUTLINE][2], xyz[OUTLINE][3];
    for (size_t k = 0; k < OUTLINE; k++) {
        uv[k][0] =
            k + 1 == OUTLINE ? ku[nu] : ku[pu] + (ku[nu] - ku[pu]) * (double)k / (OUTLINE - 1);
        uv[k][1] = kv[0];
    }
    if (nurbs_surface_eval(wetted, 0, OUTLINE, uv[0], xyz[0]) != NURBS_OK)
        return;
    fputs("<path fill=\"#c9cfd6\" stroke=\"#4b5763\" stroke-width=\"0.8\" d=\"", out);
    for (size_t k = 0; k < OUTLINE; k++)
        fprintf(out, "%c%.2f %.2f", k ? 'L' : 'M', svg_x(f, xyz[k][0]), svg_y(f, side * xyz[k][1]));
    fprintf(out, "L%.2f %.2fL%.2f %.2fZ\"/>\n", svg_x(f, xyz[OUTLINE - 1][0]), svg_y(f, 0),
            svg_x(f, xyz[0][0]), svg_y(f, 0));
}

/* The cusp lines of Kelvin's wedge from the bow, 19.47 degrees. */
static void wedge(FILE *out, const struct svg_frame *f, double bow)
{
    double slope = 1 / sqrt(8), end = fmax(f->x0, bow - f->y1 / slope);
    for (int side = -1; side <= 1; side += 2)
        svg_line(out, svg_x(f, bow), svg_y(f, 0), svg_x(f, end),
                 svg_y(f, side * (bow - end) * slope), "#1b2733", 0.8, "5 5");
}

static void labels(FILE *out, const struct svg_frame *f, const struct pattern *p)
{
    char low[32], high[32];
    snprintf(low, sizeof low, "−%g mm", 1000 * p->limit);
    snprintf(high, sizeof high, "%g mm", 1000 * p->limit);
    svg_colour_bar(out, f->left + f->width + 34, f->top + 20, 16, f->height - 44, svg_map_diverging,
                   low, high, "");
    svg_text(out, f->left + 10, f->top + 20, 13, "start", SVG_INK, "original");
    svg_text(out, f->left + 10, f->top + f->height - 10, 13, "start", SVG_INK, "optimum");
    double x = f->left + f->width - 70, y = f->top + 22;
    svg_line(out, x, y, x + 44, y, SVG_INK, 1.6, NULL);
    fprintf(out, "<path d=\"M%.1f %.1fl-9 -4.5v9z\" fill=\"%s\"/>\n", x + 52, y, SVG_INK);
    svg_text(out, x - 8, y + 4, 12, "end", SVG_INK, "course");
}

void draw_waves(FILE *out, const struct results *r)
{
    struct pattern p = {r, {&r->waves[0], r->waves[1].elevation ? &r->waves[1] : &r->waves[0]}, 1};
    const struct waves *w = p.half[0];
    double length = (double)(w->nx - 1) * w->dx, breadth = (double)(w->ny - 1) * w->dy;
    double width = WIDTH - MARGIN_LEFT - MARGIN_RIGHT, height = width * 2 * breadth / length;
    struct svg_frame f = {.left = MARGIN_LEFT, .top = 10, .width = width, .height = height};
    f.x0 = w->x0;
    f.x1 = w->x0 + length;
    f.y0 = -breadth;
    f.y1 = breadth;
    p.limit = colour_limit(p.half[0], p.half[1]);
    svg_open(out, WIDTH, height + 56, "Wave patterns of the original and the optimum");
    svg_axes(out, &f, "x, m (forward to the right)", "y, m");
    raster(out, &f, &p);
    fprintf(out,
            "<clipPath id=\"water\"><rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>"
            "</clipPath><g clip-path=\"url(#water)\">\n",
            f.left, f.top, f.width, f.height);
    wedge(out, &f, r->designs[0].hydrostatics.x_fore);
    waterplane(out, &f, r->designs[0].wetted, 1);
    waterplane(out, &f, r->designs[1].wetted, -1);
    svg_line(out, f.left, svg_y(&f, 0), f.left + f.width, svg_y(&f, 0), "#ffffff", 1, NULL);
    fputs("</g>\n", out);
    labels(out, &f, &p);
    svg_close(out);
}

void draw_wave_cut(FILE *out, const struct results *r, double share)
{
    static const struct svg_legend legend[] = {{"original", SVG_ORIGINAL, "5 3", false},
                                               {"optimum", SVG_OPTIMUM, NULL, false}};
    static const char *const colours[] = {SVG_ORIGINAL, SVG_OPTIMUM}, *const dashes[] = {"5 3",
                                                                                         NULL};
    size_t n = r->waves[0].nx;
    double *x = malloc(3 * n * sizeof *x), most = 0;
    svg_open(out, WIDTH, CUT_HEIGHT, "Longitudinal wave cut");
    for (size_t i = 0; x && i < n; i++) {
        x[i] = r->waves[0].x0 + (double)i * r->waves[0].dx;
        for (size_t k = 0; k < 2; k++) {
            const struct waves *w = &r->waves[k];
            double *z = x + (k + 1) * n;
            z[i] = w->elevation ? 1000 * sample(w, x[i], share * r->parent.length) : NAN;
            most = fmax(most, isfinite(z[i]) ? fabs(z[i]) : 0);
        }
    }
    if (x && most > 0) {
        struct svg_frame f = {.left = MARGIN_LEFT,
                              .top = 36,
                              .width = WIDTH - MARGIN_LEFT - MARGIN_RIGHT,
                              .height = CUT_HEIGHT - 90};
        f.x0 = x[0];
        f.x1 = x[n - 1];
        f.y0 = -most;
        f.y1 = most;
        svg_nice(&f.y0, &f.y1);
        svg_axes(out, &f, "x, m (forward to the right)", "elevation, mm");
        for (size_t k = 0; k < 2; k++)
            svg_curve(out, &f, n, x, x + (k + 1) * n, colours[k], 1.8, dashes[k]);
        svg_legend_row(out, f.left, 20, legend, 2);
    }
    svg_close(out);
    free(x);
}
