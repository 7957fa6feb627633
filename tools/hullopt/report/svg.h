/* Drawing into a stream of SVG: frames with axes, lines, text, colour maps. Lengths are pixels of
 * the view box, y downwards. */
#ifndef HULLOPT_SVG_H
#define HULLOPT_SVG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* The colours of the report. */
#define SVG_INK      "#1b2733"
#define SVG_MUTED    "#5f6c7a"
#define SVG_GRID     "#e3e8ed"
#define SVG_ORIGINAL "#64748b"
#define SVG_OPTIMUM  "#d9480f"
#define SVG_BLUE     "#1c6dd0"
#define SVG_PALE     "#9db8d2"
#define SVG_RED      "#b42318"

/* Opens <svg> of width x height view units with a title for screen readers; close with "</svg>". */
void svg_open(FILE *out, double width, double height, const char *title);
void svg_close(FILE *out);

/* Text with &, <, > and quotes replaced. */
void svg_escape(FILE *out, const char *text);

/* anchor: "start", "middle", "end". Size in view units. */
void svg_text(FILE *out, double x, double y, double size, const char *anchor, const char *colour,
              const char *text);

void svg_line(FILE *out, double x1, double y1, double x2, double y2, const char *colour,
              double width, const char *dashes);

/* A rectangle of the picture that shows a rectangle of numbers. */
struct svg_frame {
    double left, top, width, height;
    double x0, x1, y0, y1; /* data at left, right, bottom, top */
    bool log_y;
};
double svg_x(const struct svg_frame *frame, double x);
double svg_y(const struct svg_frame *frame, double y);

/* Widens y0, y1 (or x0, x1) to ends at which ticks stand. */
void svg_nice(double *low, double *high);

/* Grid lines, ticks with numbers, labels. */
void svg_axes(FILE *out, const struct svg_frame *frame, const char *x_label, const char *y_label);

/* n points of data as one line; points that are not finite interrupt it. */
void svg_curve(FILE *out, const struct svg_frame *frame, size_t n, const double *x, const double *y,
               const char *colour, double width, const char *dashes);

/* Markers of a legend from left to right: a line or (dot) a circle, each followed by its text. */
struct svg_legend {
    const char *text, *colour, *dashes;
    bool dot;
};
void svg_legend_row(FILE *out, double x, double y, const struct svg_legend *entries, size_t n);

/* Colour maps on [0,1], into rgb[3] of 0..255: blue over green to yellow; blue over white to red.
 */
void svg_map_sequential(double t, unsigned char rgb[3]);
void svg_map_diverging(double t, unsigned char rgb[3]);

/* A vertical (or horizontal) bar of a map with the labels of its ends. */
void svg_colour_bar(FILE *out, double x, double y, double width, double height,
                    void (*map)(double, unsigned char[3]), const char *low, const char *high,
                    const char *title);

#endif
