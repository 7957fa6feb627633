#include "view.h"

#include "svg.h"

#include <math.h>
#include <stdlib.h>

/* Turned about the vertical and seen from slightly below, in radians. */
static const double azimuth = 0.25, elevation = -0.25;

/* Right, up and towards the viewer. */
static void turn(const double *p, double out[3])
{
    double along = p[0] * cos(azimuth) - p[1] * sin(azimuth);
    double away = p[0] * sin(azimuth) + p[1] * cos(azimuth);
    out[0] = -along;
    out[1] = p[2] * cos(elevation) - away * sin(elevation);
    out[2] = p[2] * sin(elevation) + away * cos(elevation);
}

struct cell {
    double depth;
    size_t corner;
};

static int farther_first(const void *a, const void *b)
{
    double x = ((const struct cell *)a)->depth, y = ((const struct cell *)b)->depth;
    return (x > y) - (x < y);
}

struct fit {
    double scale, left, top, high;
};

static struct fit fit_points(const struct view *view, size_t n, const double *turned)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t p = 0; p < n; p++)
        for (int j = 0; j < 2; j++) {
            low[j] = fmin(low[j], turned[3 * p + (size_t)j]);
            high[j] = fmax(high[j], turned[3 * p + (size_t)j]);
        }
    double scale = fmin(view->width / fmax(high[0] - low[0], 1e-12),
                        view->height / fmax(high[1] - low[1], 1e-12));
    return (struct fit){scale,
                        view->x + (view->width - scale * (high[0] - low[0])) / 2 - scale * low[0],
                        view->y + (view->height - scale * (high[1] - low[1])) / 2, high[1]};
}

static void draw_cell(FILE *out, const struct view *view, const struct fit *fit,
                      const double *turned, const double *value, double largest, size_t corner)
{
    size_t girth = view->girth, c[4] = {corner, corner + 1, corner + girth + 1, corner + girth};
    double sum = 0;
    char colour[8];
    for (int k = 0; k < 4; k++)
        sum += value[c[k]] / 4;
    svg_colour(largest > 0 ? sum / largest : 0, colour);
    for (int k = 0; k < 4; k++)
        fprintf(out, "%s%.1f %.1f", k ? "L" : "<path d=\"M",
                fit->left + fit->scale * turned[3 * c[k]],
                fit->top + fit->scale * (fit->high - turned[3 * c[k] + 1]));
    fprintf(out, "Z\" fill=\"%s\" stroke=\"%s\"/>\n", colour, colour);
}

int view_surface(FILE *out, const struct view *view, const double *xyz, const double *value)
{
    size_t n = view->sections * view->girth, cells = 0;
    double *turned = malloc(3 * n * sizeof *turned), largest = 0;
    struct cell *order = malloc(n * sizeof *order);
    if (!turned || !order) {
        free(turned);
        free(order);
        return -1;
    }
    for (size_t p = 0; p < n; p++) {
        turn(xyz + 3 * p, turned + 3 * p);
        largest = fmax(largest, value[p]);
    }
    for (size_t i = 0; i + 1 < view->sections; i++)
        for (size_t j = 0; j + 1 < view->girth; j++) {
            size_t corner = i * view->girth + j;
            order[cells++] = (struct cell){
                turned[3 * corner + 2] + turned[3 * (corner + view->girth + 1) + 2], corner};
        }
    qsort(order, cells, sizeof *order, farther_first);
    struct fit fit = fit_points(view, n, turned);
    fputs("<g stroke-width=\"0.4\">\n", out);
    for (size_t c = 0; c < cells; c++)
        draw_cell(out, view, &fit, turned, value, largest, order[c].corner);
    fputs("</g>\n", out);
    free(turned);
    free(order);
    return 0;
}

struct body_plan view_body_plan(const struct view *view, const double *xyz)
{
    double low = INFINITY, high = -INFINITY, beam = 0, aft = INFINITY, fore = -INFINITY;
    for (size_t p = 0; p < view->sections * view->girth; p++) {
        aft = fmin(aft, xyz[3 * p]);
        fore = fmax(fore, xyz[3 * p]);
        beam = fmax(beam, fabs(xyz[3 * p + 1]));
        low = fmin(low, xyz[3 * p + 2]);
        high = fmax(high, xyz[3 * p + 2]);
    }
    /* A tenth is left for hulls wider than the parent. */
    struct body_plan plan = {.middle = (aft + fore) / 2};
    plan.scale =
        0.9 * fmin(view->width / (2 * fmax(beam, 1e-12)), view->height / fmax(high - low, 1e-12));
    plan.centre = view->x + view->width / 2;
    plan.bottom = view->y + view->height / 2 + plan.scale * (high + low) / 2;
    plan.stride = view->sections > 24 ? view->sections / 24 + 1 : 1;
    return plan;
}

void view_sections(FILE *out, const struct view *view, const struct body_plan *plan,
                   const double *xyz)
{
    for (size_t i = 0; i < view->sections; i += plan->stride) {
        const double *section = xyz + 3 * i * view->girth;
        double side = section[3 * (view->girth / 2)] < plan->middle ? -1 : 1;
        for (size_t j = 0; j < view->girth; j++)
            fprintf(out, "%c%.2f %.2f", j ? 'L' : 'M',
                    plan->centre + side * plan->scale * section[3 * j + 1],
                    plan->bottom - plan->scale * section[3 * j + 2]);
    }
}
