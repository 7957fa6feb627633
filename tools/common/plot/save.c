/* Sheets as files: SVG as it is, PNG and PDF drawn by librsvg on cairo. */
#include "cli.h"
#include "plot/plot.h"
#include "text.h"

#include <cairo-pdf.h>
#include <errno.h>
#include <librsvg/rsvg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char *extension(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot ? dot : "";
}

bool plot_is_picture(const char *path)
{
    const char *end = extension(path);
    return !strcasecmp(end, ".svg") || !strcasecmp(end, ".png") || !strcasecmp(end, ".pdf");
}

bool plot_check_path(const char *option, const char *path)
{
    return plot_is_picture(path) ||
           cli_refuse("%s %s: expected a name that ends in .svg, .png or .pdf", option, path);
}

static void write_svg(const struct plot *plot, FILE *out, bool file)
{
    if (file)
        fprintf(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    fprintf(out, "<svg xmlns=\"http://www.w3.org/2000/svg\"");
    if (file)
        fprintf(out, " width=\"%g\" height=\"%g\"", plot->width, plot->height);
    fprintf(out,
            " viewBox=\"0 0 %g %g\" role=\"img\" "
            "font-family=\"'DejaVu Sans',Verdana,Arial,sans-serif\">\n<title>",
            plot->width, plot->height);
    plot_escape(out, plot->title);
    fputs("</title>\n", out);
    if (file)
        fprintf(out,
                "<!-- isohull %s -->\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
                TOOL_VERSION);
    fwrite(plot->body, 1, plot->size, out);
    fputs("</svg>\n", out);
}

static void close_sheet(struct plot *plot)
{
    FILE *out = plot->out;
    plot->out = NULL;
    cli_needed(text_close(out, &plot->body));
}

void plot_embed(struct plot *plot, FILE *page)
{
    close_sheet(plot);
    write_svg(plot, page, false);
    plot_free(plot);
}

static cairo_status_t write_bytes(void *stream, const unsigned char *data, unsigned n)
{
    return fwrite(data, 1, n, stream) == n ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

static bool draw(const char *svg, size_t n, double width, double height, cairo_surface_t *surface)
{
    RsvgHandle *handle = rsvg_handle_new_from_data((const guint8 *)svg, n, NULL);
    cairo_t *cairo = cairo_create(surface);
    const RsvgRectangle sheet = {0, 0, width, height};
    bool good = handle && rsvg_handle_render_document(handle, cairo, &sheet, NULL) &&
                cairo_status(cairo) == CAIRO_STATUS_SUCCESS;
    cairo_destroy(cairo);
    if (handle)
        g_object_unref(handle);
    return good;
}

static bool write_drawn(const struct plot *plot, const char *svg, size_t n, bool png, FILE *stream)
{
    static const double points = 0.75; /* PostScript points a unit: 72 to 96 */
    double scale = png ? plot->scale : points;
    double width = scale * plot->width, height = scale * plot->height;
    cairo_surface_t *surface =
        png ? cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)lround(width),
                                         (int)lround(height))
            : cairo_pdf_surface_create_for_stream(write_bytes, stream, width, height);
    if (!png)
        cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, plot->title);
    bool good = draw(svg, n, width, height, surface);
    if (good && png)
        good = !cairo_surface_write_to_png_stream(surface, write_bytes, stream);
    cairo_surface_finish(surface);
    good = cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS && good;
    cairo_surface_destroy(surface);
    return good;
}

static bool write_picture(const struct plot *plot, const char *path, FILE *stream)
{
    if (!strcasecmp(extension(path), ".svg")) {
        write_svg(plot, stream, true);
        return true;
    }
    char *svg = NULL;
    size_t n = 0;
    FILE *memory = cli_needed(text_open(&svg, &n));
    write_svg(plot, memory, true);
    cli_needed(text_close(memory, &svg));
    bool good = write_drawn(plot, svg, n, !strcasecmp(extension(path), ".png"), stream);
    free(svg);
    return good;
}

bool plot_save(struct plot *plot, const char *path)
{
    struct cli_file file;
    bool good = true;
    close_sheet(plot);
    if (!cli_file_open(&file, path))
        good = cli_refuse("%s: cannot be written: %s", path, strerror(errno));
    else if (!write_picture(plot, path, file.stream) && !ferror(file.stream)) {
        cli_file_abandon(&file);
        good = cli_refuse("%s: the picture cannot be drawn", path);
    } else if (!cli_file_commit(&file))
        good = cli_refuse("%s: cannot be written: %s", path, strerror(errno));
    plot_free(plot);
    return good;
}
