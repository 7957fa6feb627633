/* The drawing kit of all commands: sheets of SVG with axes, curves, legends, colour scales and
 * raster fields, written as .svg, .png or .pdf. Lengths are units of the sheet, which is shown at
 * about one pixel a unit, y downwards. A sheet remembers where text stands, so that a label that
 * would cover another can move or be left out. */
#ifndef TOOLS_PLOT_H
#define TOOLS_PLOT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#define PLOT_INK      "#1b2733"
#define PLOT_MUTED    "#5f6c7a"
#define PLOT_GRID     "#e3e8ed"
#define PLOT_ORIGINAL "#64748b"
#define PLOT_OPTIMUM  "#d9480f"
#define PLOT_BLUE     "#1c6dd0"
#define PLOT_PALE     "#9db8d2"
#define PLOT_RED      "#b42318"

struct plot_box {
    double left, top, right, bottom;
};

struct plot {
    FILE *out;  /* SVG elements, NULL when closed */
    char *body; /* what was written to it */
    size_t size;
    double width, height;
    double scale; /* pixels a unit of a PNG, 2 unless changed */
    char title[120];
    struct plot_box *boxes; /* of the text */
    size_t n_boxes, room, clips;
};

/* The title is for screen readers and for the data of a PDF. A sheet that lacks memory ends the
 * command. */
bool plot_open(struct plot *plot, double width, double height, const char *title);
void plot_free(struct plot *plot);
/* Whether a name ends in .svg, .png or .pdf; refuses another with the name of the option. */
bool plot_is_picture(const char *path);
bool plot_check_path(const char *option, const char *path);
/* Write the sheet and free it: by extension, false after a sentence; or as an element of a page. */
bool plot_save(struct plot *plot, const char *path);
void plot_embed(struct plot *plot, FILE *page);

/* &, <, > and quotes replaced, other control characters dropped. */
void plot_escape(FILE *out, const char *text);

enum plot_anchor { PLOT_START, PLOT_MIDDLE, PLOT_END };
/* "C_{w}" sets the w low. */
__attribute__((format(printf, 7, 8))) void plot_text(struct plot *plot, double x, double y,
                                                     double size, enum plot_anchor anchor,
                                                     const char *colour, const char *format, ...);
/* The same where nothing is written yet, within the sheet; else false. */
__attribute__((format(printf, 7, 8))) bool plot_label(struct plot *plot, double x, double y,
                                                      double size, enum plot_anchor anchor,
                                                      const char *colour, const char *format, ...);
/* About how wide a text of a size is. */
double plot_text_width(const char *text, double size);

struct plot_pen {
    const char *colour;
    double width;
    const char *dashes; /* NULL: none */
};
void plot_line(struct plot *plot, double x1, double y1, double x2, double y2, struct plot_pen pen);
/* Opens a path with everything but its data: end with plot_path_end(). fill NULL: none. */
void plot_path(struct plot *plot, struct plot_pen pen, const char *fill);
void plot_path_end(struct plot *plot);

enum plot_marker { PLOT_LINE, PLOT_DOT, PLOT_RING, PLOT_CROSS, PLOT_BAND };
/* note: shown when pointed at, NULL for none. */
void plot_mark(struct plot *plot, double x, double y, enum plot_marker marker, double radius,
               const char *colour, const char *note);

struct plot_axis {
    double low, high;
    bool log, whole; /* whole: counts, ticks at integers only */
    double unit;     /* numbers shown are the values times this; 0 means 1 */
    const char *label;
};
/* Widens the axis to hold finite values (positive ones if logarithmic); begin with low = INFINITY,
 * high = -INFINITY. */
void plot_include(struct plot_axis *axis, size_t n, const double *values);
/* The value that `share` of the finite values do not exceed, of |values| if sizes; 0 if there are
 * none. */
double plot_percentile(size_t n, const double *values, bool sizes, double share);
/* Makes any axis drawable: finite, ordered, of some length. nice: and moves its ends to ticks. */
void plot_settle(struct plot_axis *axis);
void plot_nice(struct plot_axis *axis, int wanted);
/* 1, 2 or 5 times a power of ten, about a `wanted`-th of the span; whole: at least 1. */
double plot_tick_step(double span, int wanted, bool whole);
enum { PLOT_TICKS = 40 };
/* Fills the values of the ticks and what to write at them. */
size_t plot_ticks(const struct plot_axis *axis, int wanted, double value[PLOT_TICKS],
                  char text[PLOT_TICKS][24]);

/* A rectangle of the sheet that shows a rectangle of numbers. */
struct plot_frame {
    double left, top, width, height;
    struct plot_axis x, y;
};
double plot_x(const struct plot_frame *frame, double x);
double plot_y(const struct plot_frame *frame, double y);
/* Settles both axes; grid lines, numbers, labels, edge. */
void plot_axes(struct plot *plot, struct plot_frame *frame);
/* What follows is cut off at the frame, until plot_unclip(). */
void plot_clip(struct plot *plot, const struct plot_frame *frame);
void plot_unclip(struct plot *plot);

/* Points that are not finite interrupt a curve. */
void plot_curve(struct plot *plot, const struct plot_frame *frame, size_t n, const double *x,
                const double *y, struct plot_pen pen);
void plot_band(struct plot *plot, const struct plot_frame *frame, size_t n, const double *x,
               const double *low, const double *high, const char *colour);

struct plot_legend {
    const char *text;
    struct plot_pen pen;
    enum plot_marker marker;
};
/* From left to right, or one below the other. */
void plot_legend(struct plot *plot, double x, double y, bool column, size_t n,
                 const struct plot_legend *entries);

/* Blue over green to yellow, its luminance rising evenly; blue over white to red. */
enum plot_map { PLOT_SEQUENTIAL, PLOT_DIVERGING };
struct plot_scale {
    enum plot_map map;
    struct plot_axis axis;
};
void plot_colour(enum plot_map map, double t, unsigned char rgb[3]);
/* The same for a value of the scale, as "#rrggbb". */
void plot_scale_colour(const struct plot_scale *scale, double value, char text[8]);
/* An upright bar with ticks on its right and the axis' label above. */
void plot_bar(struct plot *plot, double x, double y, double width, double height,
              const struct plot_scale *scale);

/* nx x ny pixels that fill the frame, coloured by value at (x, y). */
void plot_raster(struct plot *plot, const struct plot_frame *frame, size_t nx, size_t ny,
                 const struct plot_scale *scale,
                 double (*value)(const void *user_data, double x, double y), const void *user_data);
/* Fields on a grid of nu x nv points of the plane (v fast): coloured cells, lines of equal value.
 */
struct plot_field {
    size_t nu, nv;
    const double *x, *y, *value;
};
void plot_cells(struct plot *plot, const struct plot_frame *frame, const struct plot_field *field,
                const struct plot_scale *scale);
void plot_isolines(struct plot *plot, const struct plot_frame *frame,
                   const struct plot_field *field, double level, struct plot_pen pen);

#endif
