#include "report/drawings.h"
#include "report/svg.h"
#include "stations.h"

#include <math.h>
#include <stdlib.h>

enum { STATIONS = 20, AREAS = 121, BODY_WIDTH = 760, AREA_WIDTH = 760, AREA_HEIGHT = 300 };

/* Extent of both hulls over which the drawing is scaled. */
struct extent {
    double beam, low, high, aft, fore;
};

static struct extent measure(const struct results *r)
{
    struct extent e = {0, INFINITY, -INFINITY, INFINITY, -INFINITY};
    size_t n = nurbs_grid_rows(r->parent.grid) * nurbs_grid_columns(r->parent.grid);
    const double *p = nurbs_grid_points(r->parent.grid);
    for (size_t k = 0; k < n; k++) {
        e.beam = fmax(e.beam, p[3 * k + 1]);
        e.low = fmin(e.low, p[3 * k + 2]);
        e.high = fmax(e.high, p[3 * k + 2]);
        e.aft = fmin(e.aft, p[3 * k]);
        e.fore = fmax(e.fore, p[3 * k]);
    }
    return e;
}

/* Stations run from 0 at the aft perpendicular (x = 0, or the aft end of the waterline of a hull
 * whose origin is elsewhere) to 20, a length ahead. */
static double first_station(const struct results *r)
{
    double aft = r->designs[0].hydrostatics.x_aft;
    return fabs(aft) < 0.02 * r->parent.length ? 0 : aft;
}

/* A plan in the making: numbers that would stand on the one before are left out. */
struct plan {
    FILE *out;
    struct svg_frame frame;
    double last_x, last_y;
};

static void number_station(struct plan *plan, size_t n, const double *section_x,
                           const double *section_z, int station)
{
    char text[16];
    size_t top = n;
    for (size_t j = 0; j < n; j++)
        if (isfinite(section_x[j]) && (top == n || section_z[j] > section_z[top]))
            top = j;
    if (top == n)
        return;
    double x = svg_x(&plan->frame, section_x[top]), y = svg_y(&plan->frame, section_z[top]) - 5;
    if (hypot(x - plan->last_x, y - plan->last_y) < 13)
        return;
    plan->last_x = x;
    plan->last_y = y;
    snprintf(text, sizeof text, "%d", station);
    svg_text(plan->out, x, y, 10.5, "middle", SVG_MUTED, text);
}

/* Scraps of a section, where it just touches the stem or the edge of the transom, say nothing. */
static void drop_scraps(size_t n, double *x)
{
    enum { SCRAP = 8 };
    for (size_t start = 0; start < n;) {
        size_t end = start;
        while (end < n && isfinite(x[end]))
            end++;
        for (size_t j = start; j < end && end - start < SCRAP; j++)
            x[j] = NAN;
        start = end + 1;
    }
}

static void draw_sections(struct plan *plan, const struct results *r, const nurbs_surface *surface,
                          const char *colour, const char *dashes, bool numbers)
{
    struct stations s;
    if (!stations_create(surface, &s))
        return;
    double(*yz)[2] = malloc(s.nv * sizeof *yz);
    double *x = malloc(2 * s.nv * sizeof *x), *z = x + s.nv;
    double start = first_station(r), pitch = r->parent.length / STATIONS;
    for (int k = 0; yz && x && k <= STATIONS; k++) {
        double side = 2 * k < STATIONS ? -1 : 1;
        if (stations_section(&s, start + k * pitch, yz) < 2)
            continue;
        for (size_t j = 0; j < s.nv; j++) {
            x[j] = side * yz[j][0];
            z[j] = yz[j][1];
        }
        drop_scraps(s.nv, x);
        svg_curve(plan->out, &plan->frame, s.nv, x, z, colour, 1.5, dashes);
        if (numbers)
            number_station(plan, s.nv, x, z, k);
    }
    free(yz);
    free(x);
    stations_free(&s);
}

void draw_body_plan(FILE *out, const struct results *r)
{
    static const struct svg_legend legend[] = {{"original", SVG_ORIGINAL, "5 3", false},
                                               {"optimum", SVG_OPTIMUM, NULL, false}};
    struct extent e = measure(r);
    double margin = 0.12 * e.beam, scale = (BODY_WIDTH - 40) / (2 * (e.beam + margin));
    double height = scale * (e.high - e.low);
    struct svg_frame f = {.left = 20, .top = 70, .width = BODY_WIDTH - 40, .height = height};
    f.x0 = -e.beam - margin;
    f.x1 = e.beam + margin;
    f.y0 = e.low;
    f.y1 = e.high;
    svg_open(out, BODY_WIDTH, height + 110, "Body plans of the original and the optimum");
    double keel = -r->designs[0].hydrostatics.keel_draft;
    svg_line(out, svg_x(&f, f.x0), svg_y(&f, 0), svg_x(&f, f.x1), svg_y(&f, 0), SVG_BLUE, 1.2,
             NULL);
    svg_text(out, svg_x(&f, f.x1), svg_y(&f, 0) - 4, 11, "end", SVG_BLUE, "still water");
    svg_line(out, svg_x(&f, f.x0), svg_y(&f, keel), svg_x(&f, f.x1), svg_y(&f, keel), SVG_MUTED, 1,
             "2 3");
    svg_text(out, svg_x(&f, f.x1), svg_y(&f, keel) + 13, 11, "end", SVG_MUTED, "base line");
    svg_line(out, svg_x(&f, 0), f.top - 8, svg_x(&f, 0), f.top + height + 8, SVG_MUTED, 1,
             "8 3 2 3");
    struct plan plan = {out, f, -100, -100};
    draw_sections(&plan, r, r->designs[0].full, SVG_ORIGINAL, "5 3", true);
    draw_sections(&plan, r, r->designs[1].full, SVG_OPTIMUM, NULL, false);
    svg_legend_row(out, 20, 22, legend, 2);
    svg_text(out, svg_x(&f, -e.beam / 2), height + 100, 12, "middle", SVG_MUTED, "aft body");
    svg_text(out, svg_x(&f, e.beam / 2), height + 100, 12, "middle", SVG_MUTED, "fore body");
    svg_close(out);
}

static bool areas(const nurbs_surface *surface, double aft, double fore, double *x, double *area)
{
    struct stations s;
    if (!stations_create(surface, &s))
        return false;
    double(*yz)[2] = malloc(s.nv * sizeof *yz);
    for (size_t k = 0; yz && k < AREAS; k++) {
        x[k] = aft + (fore - aft) * (double)k / (AREAS - 1);
        area[k] =
            stations_section(&s, x[k], yz) < 2 ? 0 : stations_area(s.nv, (const double(*)[2])yz);
    }
    bool ok = yz != NULL;
    free(yz);
    stations_free(&s);
    return ok;
}

void draw_section_areas(FILE *out, const struct results *r)
{
    static const struct svg_legend legend[] = {{"original", SVG_ORIGINAL, "5 3", false},
                                               {"optimum", SVG_OPTIMUM, NULL, false}};
    static const char *const colours[] = {SVG_ORIGINAL, SVG_OPTIMUM}, *const dashes[] = {"5 3",
                                                                                         NULL};
    double x[AREAS], area[2][AREAS], most = 0;
    struct extent e = measure(r);
    svg_open(out, AREA_WIDTH, AREA_HEIGHT, "Sectional areas below the still water");
    bool ok = true;
    for (int k = 0; k < 2 && ok; k++)
        ok = areas(r->designs[k].wetted, e.aft, e.fore, x, area[k]);
    for (size_t i = 0; ok && i < AREAS; i++)
        most = fmax(most, fmax(area[0][i], area[1][i]));
    if (ok && most > 0) {
        struct svg_frame f = {
            .left = 76, .top = 36, .width = AREA_WIDTH - 96, .height = AREA_HEIGHT - 90};
        f.x0 = e.aft;
        f.x1 = e.fore;
        f.y1 = 1.05 * most;
        svg_axes(out, &f, "x, m (forward to the right)", "section area, m²");
        for (int k = 0; k < 2; k++)
            svg_curve(out, &f, AREAS, x, area[k], colours[k], 2, dashes[k]);
        svg_legend_row(out, f.left, 20, legend, 2);
    }
    svg_close(out);
}
