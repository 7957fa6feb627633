#include "outcome.h"
#include "report/drawings.h"
#include "report/svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1060, HEIGHT = 380 };

static bool is_initial(const struct evaluation *e)
{
    return strcmp(e->phase, "initial") == 0;
}

/* A few designs far above all others would flatten the rest: the axis ends at the 95th percentile
 * or twice the parent, whichever is higher, and what lies above stands on its upper edge. */
static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double upper_limit(const struct results *r)
{
    double *sorted = malloc((r->n + 1) * sizeof *sorted), limit = 0;
    size_t n = 0;
    if (!sorted)
        return 2 * r->baseline->cw;
    for (size_t i = 0; i < r->n; i++)
        if (!r->evaluations[i].failed)
            sorted[n++] = r->evaluations[i].cw;
    qsort(sorted, n, sizeof *sorted, compare);
    if (n)
        limit = fmin(sorted[n - 1], fmax(sorted[(n - 1) * 95 / 100], 2 * r->baseline->cw));
    free(sorted);
    return limit;
}

static void draw_points(FILE *out, const struct svg_frame *f, const struct results *r)
{
    for (size_t i = 0; i < r->n; i++) {
        const struct evaluation *e = &r->evaluations[i];
        double x = svg_x(f, (double)i);
        if (e->id == 0)
            continue;
        if (e->failed) {
            double y = f->top + 8;
            fprintf(out,
                    "<path d=\"M%.1f %.1fl7 7m0 -7l-7 7\" stroke=\"%s\" stroke-width=\"1.5\" "
                    "fill=\"none\"><title>%llu: ",
                    x - 3.5, y - 3.5, SVG_RED, (unsigned long long)e->id);
            svg_escape(out, e->reason);
            fputs("</title></path>\n", out);
            continue;
        }
        bool above = e->cw > f->y1;
        fprintf(out,
                "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"%s\"%s><title>%llu: C_w %.4e, "
                "displacement %+.2f %%</title></circle>\n",
                x, above ? f->top + 3 : svg_y(f, e->cw), above ? "2" : "3.2",
                is_initial(e) ? SVG_PALE : SVG_BLUE, above ? " opacity=\"0.6\"" : "",
                (unsigned long long)e->id, e->cw, 100 * (e->volume_ratio - 1));
    }
}

static void draw_incumbent(FILE *out, const struct svg_frame *f, const struct results *r)
{
    double best = INFINITY;
    fprintf(out, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"2.4\" d=\"", SVG_OPTIMUM);
    for (size_t i = 0; i < r->n; i++) {
        const struct evaluation *e = &r->evaluations[i];
        if (outcome_allowed(&r->limits, e, r->baseline) && e->cw < best) {
            if (isfinite(best))
                fprintf(out, "H%.1fV%.1f", svg_x(f, (double)i), svg_y(f, e->cw));
            else
                fprintf(out, "M%.1f %.1f", svg_x(f, (double)i), svg_y(f, e->cw));
            best = e->cw;
        }
    }
    fprintf(out, "H%.1f\"/>\n", f->left + f->width);
}

void draw_history(FILE *out, const struct results *r)
{
    static const struct svg_legend legend[] = {{"initial design", SVG_PALE, NULL, true},
                                               {"iterations", SVG_BLUE, NULL, true},
                                               {"best so far", SVG_OPTIMUM, NULL, false},
                                               {"original", SVG_ORIGINAL, "5 4", false}};
    struct svg_frame f = {.left = 84, .top = 40, .width = WIDTH - 104, .height = HEIGHT - 96};
    svg_open(out, WIDTH, HEIGHT, "History of the search");
    f.x1 = fmax(1, (double)r->n - 1);
    f.y0 = 0;
    f.y1 = upper_limit(r);
    svg_nice(&f.y0, &f.y1);
    f.y0 = 0;
    struct svg_frame scaled = f;
    scaled.y0 *= 1e3;
    scaled.y1 *= 1e3;
    svg_axes(out, &scaled, "evaluation", "10³ Cw");
    size_t initial = 0;
    for (size_t i = 0; i < r->n; i++)
        if (is_initial(&r->evaluations[i]))
            initial = i;
    double split = svg_x(&f, (double)initial + 0.5);
    if (initial > 0 && initial + 1 < r->n) {
        svg_line(out, split, f.top, split, f.top + f.height, SVG_MUTED, 1, "2 3");
        svg_text(out, split + 7, f.top + 26, 11, "start", SVG_MUTED, "iterations →");
    }
    double x[] = {f.x0, f.x1}, y[] = {r->baseline->cw, r->baseline->cw};
    svg_curve(out, &f, 2, x, y, SVG_ORIGINAL, 1.6, "5 4");
    draw_incumbent(out, &f, r);
    draw_points(out, &f, r);
    svg_legend_row(out, f.left, 22, legend, sizeof legend / sizeof *legend);
    if (r->failed) {
        fprintf(out, "<path d=\"M%.1f 14.5l7 7m0 -7l-7 7\" stroke=\"%s\" stroke-width=\"1.5\"/>\n",
                f.left + 452.0, SVG_RED);
        svg_text(out, f.left + 466, 22, 12, "start", SVG_INK, "failed");
    }
    svg_close(out);
}
