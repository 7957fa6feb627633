/* The few SVG elements that the drawings of galv use. */
#ifndef GALV_TOOL_SVG_H
#define GALV_TOOL_SVG_H

#include <stddef.h>
#include <stdio.h>

void svg_begin(FILE *out, double width, double height);
void svg_end(FILE *out);

enum svg_anchor { SVG_START, SVG_MIDDLE, SVG_END };

__attribute__((format(printf, 6, 7))) void svg_text(FILE *out, double x, double y, double size,
                                                    enum svg_anchor anchor, const char *format,
                                                    ...);
void svg_line(FILE *out, double x1, double y1, double x2, double y2, const char *stroke);
void svg_polyline(FILE *out, size_t n, const double *xy, const char *stroke, double width);

/* A colour between dark blue (0) and yellow (1), as "#rrggbb". */
void svg_colour(double t, char text[8]);
/* All of these colours from left to right. */
void svg_colour_bar(FILE *out, double x, double y, double width, double height);

/* A frame with ticks and the points (k, y[k]), k = 1..n, joined and marked. logarithmic: y on a log
 * scale, points <= 0 left out. mark: 1-based index of the point to single out, 0 for none. */
struct svg_chart {
    double x, y, width, height;
    const char *title, *label;
    int logarithmic;
    size_t mark;
};
void svg_draw_chart(FILE *out, const struct svg_chart *chart, size_t n, const double *values);

#endif
