/* Sheets and their elements: the only place that writes SVG of text, lines and marks. */
#include "cli.h"
#include "plot/plot.h"
#include "text.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

bool plot_open(struct plot *plot, double width, double height, const char *title)
{
    *plot = (struct plot){.width = ceil(width), .height = ceil(height), .scale = 2};
    snprintf(plot->title, sizeof plot->title, "%s", title);
    plot->out = cli_needed(text_open(&plot->body, &plot->size));
    return true;
}

void plot_free(struct plot *plot)
{
    if (plot->out)
        fclose(plot->out);
    free(plot->body);
    free(plot->boxes);
    *plot = (struct plot){0};
}

void plot_escape(FILE *out, const char *text)
{
    static const struct {
        char character;
        const char *entity;
    } entities[] = {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
    for (; *text; text++) {
        size_t k = 0;
        while (k < 4 && entities[k].character != *text)
            k++;
        if (k < 4)
            fputs(entities[k].entity, out);
        else if ((unsigned char)*text >= ' ')
            fputc(*text, out);
    }
}

double plot_text_width(const char *text, double size)
{
    /* Advance of DejaVu Sans, the widest of the usual faces, in parts of the size: of digits, and
     * the mean of others. */
    static const double digit = 0.64, other = 0.6;
    double width = 0;
    for (const char *c = text; *c; c++)
        if (((unsigned char)*c & 0xc0) != 0x80)
            width += *c >= '0' && *c <= '9' ? digit : other;
    return size * width;
}

static struct plot_box text_box(const char *text, double x, double y, double size,
                                enum plot_anchor anchor)
{
    double width = plot_text_width(text, size), left = x - width * 0.5 * (int)anchor;
    return (struct plot_box){left, y - 0.8 * size, left + width, y + 0.22 * size};
}

static bool is_free(const struct plot *plot, const struct plot_box *box)
{
    if (box->left < 0 || box->right > plot->width || box->top < 0 || box->bottom > plot->height)
        return false;
    for (size_t k = 0; k < plot->n_boxes; k++) {
        const struct plot_box *other = &plot->boxes[k];
        if (box->left < other->right && other->left < box->right && box->top < other->bottom &&
            other->top < box->bottom)
            return false;
    }
    return true;
}

static void keep_box(struct plot *plot, struct plot_box box)
{
    if (plot->n_boxes == plot->room) {
        size_t room = plot->room ? 2 * plot->room : 64;
        plot->boxes = cli_needed(realloc(plot->boxes, room * sizeof *plot->boxes));
        plot->room = room;
    }
    plot->boxes[plot->n_boxes++] = box;
}

/* "C_{w}" with its subscript; what follows it is raised again, to the end. */
static void write_marked(FILE *out, const char *text, double size)
{
    char part[256];
    const char *mark;
    int open = 0;
    while ((mark = strstr(text, "_{")) && strchr(mark, '}')) {
        const char *end = strchr(mark, '}');
        snprintf(part, sizeof part, "%.*s", (int)(mark - text), text);
        plot_escape(out, part);
        snprintf(part, sizeof part, "%.*s", (int)(end - mark - 2), mark + 2);
        fprintf(out, "<tspan font-size=\"%.1f\" dy=\"%.1f\">", fmax(10, 0.75 * size), 0.25 * size);
        plot_escape(out, part);
        fputs("</tspan>", out);
        text = end + 1;
        if (*text) {
            /* A blank at the start of an element would be dropped. */
            fprintf(out, "<tspan dx=\"%.1f\" dy=\"%.1f\">", *text == ' ' ? 0.32 * size : 0,
                    -0.25 * size);
            text += *text == ' ';
            open++;
        }
    }
    plot_escape(out, text);
    for (; open > 0; open--)
        fputs("</tspan>", out);
}

static bool put_text(struct plot *plot, double x, double y, double size, enum plot_anchor anchor,
                     const char *colour, bool only_if_free, const char *format, va_list args)
{
    static const char *const names[] = {"start", "middle", "end"};
    char text[256];
    vsnprintf(text, sizeof text, format, args);
    struct plot_box box = text_box(text, x, y, size, anchor);
    if (only_if_free && !is_free(plot, &box))
        return false;
    keep_box(plot, box);
    fprintf(plot->out,
            "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%g\" text-anchor=\"%s\" fill=\"%s\">", x, y,
            size, names[anchor], colour);
    write_marked(plot->out, text, size);
    fputs("</text>\n", plot->out);
    return true;
}

void plot_text(struct plot *plot, double x, double y, double size, enum plot_anchor anchor,
               const char *colour, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    put_text(plot, x, y, size, anchor, colour, false, format, args);
    va_end(args);
}

bool plot_label(struct plot *plot, double x, double y, double size, enum plot_anchor anchor,
                const char *colour, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    bool put = put_text(plot, x, y, size, anchor, colour, true, format, args);
    va_end(args);
    return put;
}

void plot_path(struct plot *plot, struct plot_pen pen, const char *fill)
{
    fprintf(plot->out, "<path fill=\"%s\"", fill ? fill : "none");
    if (pen.width > 0)
        fprintf(plot->out, " stroke=\"%s\" stroke-width=\"%g\" stroke-linejoin=\"round\"",
                pen.colour, pen.width);
    if (pen.dashes)
        fprintf(plot->out, " stroke-dasharray=\"%s\"", pen.dashes);
    fputs(" d=\"", plot->out);
}

void plot_path_end(struct plot *plot)
{
    fputs("\"/>\n", plot->out);
}

void plot_line(struct plot *plot, double x1, double y1, double x2, double y2, struct plot_pen pen)
{
    plot_path(plot, pen, NULL);
    fprintf(plot->out, "M%.2f %.2fL%.2f %.2f", x1, y1, x2, y2);
    plot_path_end(plot);
}

void plot_mark(struct plot *plot, double x, double y, enum plot_marker marker, double radius,
               const char *colour, const char *note)
{
    if (!isfinite(x) || !isfinite(y))
        return;
    if (marker == PLOT_CROSS)
        fprintf(plot->out,
                "<path d=\"M%.1f %.1fl%g %gm0 %gl%g %g\" stroke=\"%s\" stroke-width=\"1.5\" "
                "fill=\"none\">",
                x - radius, y - radius, 2 * radius, 2 * radius, -2 * radius, -2 * radius,
                2 * radius, colour);
    else
        fprintf(plot->out,
                "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%g\" fill=\"%s\" stroke=\"%s\" "
                "stroke-width=\"%g\">",
                x, y, radius, marker == PLOT_RING ? "white" : colour, colour,
                marker == PLOT_RING ? 1.2 : 0.0);
    if (note) {
        fputs("<title>", plot->out);
        plot_escape(plot->out, note);
        fputs("</title>", plot->out);
    }
    fputs(marker == PLOT_CROSS ? "</path>\n" : "</circle>\n", plot->out);
}

void plot_clip(struct plot *plot, const struct plot_frame *f)
{
    /* Several sheets may stand on one page: the title keeps their names apart. */
    unsigned long name = 5381;
    for (const char *c = plot->title; *c; c++)
        name = name * 33 + (unsigned char)*c;
    name = (name & 0xffffff) + 0x1000000 * ++plot->clips;
    fprintf(plot->out,
            "<clipPath id=\"clip%lx\"><rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>"
            "</clipPath><g clip-path=\"url(#clip%lx)\">\n",
            name, f->left, f->top, f->width, f->height, name);
}

void plot_unclip(struct plot *plot)
{
    fputs("</g>\n", plot->out);
}

void plot_legend(struct plot *plot, double x, double y, bool column, size_t n,
                 const struct plot_legend *entries)
{
    for (size_t i = 0; i < n; i++) {
        const struct plot_legend *e = &entries[i];
        if (e->marker == PLOT_LINE)
            plot_line(plot, x, y - 4, x + 22, y - 4, e->pen);
        else if (e->marker == PLOT_BAND)
            fprintf(plot->out,
                    "<rect x=\"%.1f\" y=\"%.1f\" width=\"22\" height=\"9\" fill=\"%s\" "
                    "fill-opacity=\"0.2\"/>\n",
                    x, y - 8.5, e->pen.colour);
        else
            plot_mark(plot, x + 13, y - 4, e->marker, 3.5, e->pen.colour, NULL);
        plot_text(plot, x + 27, y, 12, PLOT_START, PLOT_INK, "%s", e->text);
        if (column)
            y += 19;
        else
            x += 46 + plot_text_width(e->text, 12);
    }
}
