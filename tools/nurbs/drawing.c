#include "drawing.h"

#include <stdlib.h>
#include <string.h>

const drawing_pen drawing_pens[DRAWING_STYLES] = {{"grid", {208, 208, 208}, 0.6},
                                                  {"thin", {51, 51, 68}, 0.7},
                                                  {"edge", {0, 0, 0}, 1.3},
                                                  {"water", {0, 102, 204}, 1},
                                                  {"text", {0, 0, 0}, 1.1}};

static bool reserve(void **array, size_t count, size_t *room, size_t bytes)
{
    if (count < *room)
        return true;
    size_t more = *room ? 2 * *room : 64;
    void *larger = realloc(*array, more * bytes);
    if (larger) {
        *array = larger;
        *room = more;
    }
    return larger;
}

double *drawing_add_line(drawing *sheet, drawing_style style, size_t n)
{
    double *xy = malloc((2 * n + 1) * sizeof *xy);
    void *array = sheet->line;
    if (!xy || !reserve(&array, sheet->lines, &sheet->line_room, sizeof *sheet->line)) {
        free(xy);
        sheet->failed = true;
        return NULL;
    }
    sheet->line = array;
    sheet->line[sheet->lines++] = (drawing_line){style, n, xy};
    return xy;
}

void drawing_add_label(drawing *sheet, double x, double y, double height, const char *text)
{
    void *array = sheet->label;
    if (!reserve(&array, sheet->labels, &sheet->label_room, sizeof *sheet->label)) {
        sheet->failed = true;
        return;
    }
    sheet->label = array;
    drawing_label *label = &sheet->label[sheet->labels++];
    *label = (drawing_label){.x = x, .y = y, .height = height};
    snprintf(label->text, sizeof label->text, "%s", text);
}

void drawing_free(drawing *sheet)
{
    for (size_t k = 0; k < sheet->lines; k++)
        free(sheet->line[k].xy);
    free(sheet->line);
    free(sheet->label);
    *sheet = (drawing){0};
}

bool drawing_write_svg(const drawing *sheet, FILE *stream)
{
    fprintf(stream,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\">\n"
            "<style>path{fill:none;stroke-linejoin:round}text{font-family:sans-serif}",
            sheet->width, sheet->height);
    for (int k = 0; k < DRAWING_TEXT; k++)
        fprintf(stream, ".%s{stroke:#%02x%02x%02x;stroke-width:%g}", drawing_pens[k].name,
                drawing_pens[k].colour[0], drawing_pens[k].colour[1], drawing_pens[k].colour[2],
                drawing_pens[k].width);
    fprintf(stream, "</style>\n<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n");
    for (size_t k = 0; k < sheet->lines; k++) {
        const drawing_line *line = &sheet->line[k];
        fprintf(stream, "<path class=\"%s\" d=\"", drawing_pens[line->style].name);
        for (size_t i = 0; i < line->count; i++)
            fprintf(stream, "%c%.2f %.2f", i ? 'L' : 'M', line->xy[2 * i], line->xy[2 * i + 1]);
        fprintf(stream, "\"/>\n");
    }
    for (size_t k = 0; k < sheet->labels; k++) {
        const drawing_label *label = &sheet->label[k];
        /* A capital is about 0.72 of the font size high. */
        fprintf(stream, "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%.1f\">%s</text>\n", label->x,
                label->y, label->height / 0.72, label->text);
    }
    fprintf(stream, "</svg>\n");
    return !sheet->failed && !ferror(stream);
}

static const struct {
    char character;
    const char *strokes;
} font[] = {{'0', "03 07 18 38 47 43 32 12 03"},
            {'1', "17 28 22|12 32"},
            {'2', "07 18 38 47 46 02 42"},
            {'3', "07 18 38 47 46 35 25|35 44 43 32 12 03"},
            {'4', "32 38 04 44"},
            {'5', "48 08 05 35 44 43 32 12 03"},
            {'6', "38 18 07 03 12 32 43 44 35 05"},
            {'7', "08 48 12"},
            {'8', "15 06 07 18 38 47 46 35 15 04 03 12 32 43 44 35"},
            {'9', "45 15 06 07 18 38 47 43 32 12"},
            {'B', "02 08 38 47 46 35 05|35 44 43 32 02"},
            {'H', "02 08|48 42|05 45"},
            {'P', "02 08 38 47 46 35 05"},
            {'a', "46 42|45 36 16 05 03 12 32 43"},
            {'b', "08 02|05 16 36 45 43 32 12 03"},
            {'c', "45 36 16 05 03 12 32 43"},
            {'d', "48 42|45 36 16 05 03 12 32 43"},
            {'e', "04 44 45 36 16 05 03 12 32 43"},
            {'f', "12 17 28 38|06 36"},
            {'g', "46 41 30 10 01|45 36 16 05 03 12 32 43"},
            {'h', "08 02|05 16 36 45 42"},
            {'i', "26 22|28 27"},
            {'j', "26 21 10|28 27"},
            {'k', "08 02|46 04 42"},
            {'l', "28 22"},
            {'m', "06 02|05 16 25 22|25 36 45 42"},
            {'n', "06 02|05 16 36 45 42"},
            {'o', "05 16 36 45 43 32 12 03 05"},
            {'p', "06 00|05 16 36 45 43 32 12 03"},
            {'q', "46 40|45 36 16 05 03 12 32 43"},
            {'r', "06 02|05 16 36"},
            {'s', "45 36 16 05 14 34 43 32 12 03"},
            {'t', "18 13 22 32|06 36"},
            {'u', "06 03 12 32 43|46 42"},
            {'v', "06 22 46"},
            {'w', "06 12 25 32 46"},
            {'x', "06 42|02 46"},
            {'y', "06 22|46 10"},
            {'z', "06 46 02 42"},
            {'-', "04 34"},
            {'+', "04 44|26 22"},
            {'=', "03 43|05 45"},
            {'(', "38 26 24 32"},
            {')', "18 26 24 12"},
            {',', "22 11"},
            {'.', "22 23"},
            {' ', ""}};

const char *drawing_strokes(char character)
{
    for (size_t k = 0; k < sizeof font / sizeof font[0]; k++)
        if (font[k].character == character)
            return font[k].strokes;
    return "02 08 48 42 02"; /* a box for what the font lacks */
}
