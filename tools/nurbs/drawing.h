/* A sheet of lines and labels, written as SVG or PNG. Sheet units are pixels of the SVG, y
 * downwards.
 */
#ifndef NURBS_DRAWING_H
#define NURBS_DRAWING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef enum drawing_style {
    DRAWING_GRID,  /* where sections are taken */
    DRAWING_THIN,  /* sections, waterlines, buttocks */
    DRAWING_EDGE,  /* edges of the patches */
    DRAWING_WATER, /* still water */
    DRAWING_TEXT,
    DRAWING_STYLES
} drawing_style;

/* Colour as red, green, blue from 0 to 255, and width of the pen. */
typedef struct drawing_pen {
    const char *name;
    unsigned char colour[3];
    double width;
} drawing_pen;
extern const drawing_pen drawing_pens[DRAWING_STYLES];

typedef struct drawing_line {
    drawing_style style;
    size_t count;
    double *xy; /* pairs */
} drawing_line;

typedef struct drawing_label {
    double x, y, height; /* left end of the base line, height of a capital */
    char text[60];
} drawing_label;

typedef struct drawing {
    double width, height;
    size_t lines, labels, line_room, label_room;
    drawing_line *line;
    drawing_label *label;
    bool failed; /* out of memory at some time */
} drawing;

/* A line of n points; fills *xy with room for them. NULL: out of memory (remembered). */
double *drawing_add_line(drawing *sheet, drawing_style style, size_t n);
void drawing_add_label(drawing *sheet, double x, double y, double height, const char *text);
void drawing_free(drawing *sheet);

/* false: the stream failed or memory ran out. The PNG has `scale` pixels a unit. */
bool drawing_write_svg(const drawing *sheet, FILE *stream);
bool drawing_write_png(const drawing *sheet, double scale, FILE *stream);

/* Strokes of a character of a simple pen font, for labels in pixels: points "xy" with x 0 to 4, y 2
 * at the base line and 8 on top of a capital, points separated by blanks, strokes by bars. */
const char *drawing_strokes(char character);

#endif
