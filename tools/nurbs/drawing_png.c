/* Anti-aliased lines: a pixel is covered as far as its centre lies inside the pen's stroke, half a
 * pixel inside counting full. The coverage of one line is gathered first, so that its own joints
 * are not darker; then it is blended onto the sheet. */
#include "drawing.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

typedef struct raster {
    size_t width, height;
    double scale;
    unsigned char *pixels;   /* [height][1 + 3 width]: PNG's filter byte, then red, green, blue */
    unsigned char *coverage; /* [height][width] of the line at hand */
    size_t low[2], high[2];  /* box of what is covered, high excluded */
} raster;

static size_t inside(double value, size_t limit)
{
    return value <= 0 ? 0 : value >= (double)limit ? limit : (size_t)value;
}

/* Distance of (x,y) from the segment a b. */
static double segment_distance(const double a[2], const double b[2], double x, double y)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy,
           t = square > 0 ? ((x - a[0]) * dx + (y - a[1]) * dy) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(x - a[0] - t * dx, y - a[1] - t * dy);
}

static void cover_segment(raster *image, const double a[2], const double b[2], double radius)
{
    double reach = radius + 1;
    size_t x0 = inside(fmin(a[0], b[0]) - reach, image->width),
           x1 = inside(fmax(a[0], b[0]) + reach + 1, image->width),
           y0 = inside(fmin(a[1], b[1]) - reach, image->height),
           y1 = inside(fmax(a[1], b[1]) + reach + 1, image->height);
    for (size_t y = y0; y < y1; y++)
        for (size_t x = x0; x < x1; x++) {
            double covered =
                radius + 0.5 - segment_distance(a, b, (double)x + 0.5, (double)y + 0.5);
            unsigned char value = (unsigned char)(255 * fmin(fmax(covered, 0), 1) + 0.5),
                          *at = image->coverage + y * image->width + x;
            *at = value > *at ? value : *at;
        }
    image->low[0] = x0 < image->low[0] ? x0 : image->low[0];
    image->low[1] = y0 < image->low[1] ? y0 : image->low[1];
    image->high[0] = x1 > image->high[0] ? x1 : image->high[0];
    image->high[1] = y1 > image->high[1] ? y1 : image->high[1];
}

static void blend(raster *image, const unsigned char colour[3])
{
    for (size_t y = image->low[1]; y < image->high[1]; y++)
        for (size_t x = image->low[0]; x < image->high[0]; x++) {
            unsigned char *covered = image->coverage + y * image->width + x,
                          *pixel = image->pixels + y * (3 * image->width + 1) + 1 + 3 * x;
            for (int c = 0; c < 3 && *covered; c++)
                pixel[c] =
                    (unsigned char)((pixel[c] * (255 - *covered) + colour[c] * *covered + 127) /
                                    255);
            *covered = 0;
        }
    image->low[0] = image->width;
    image->low[1] = image->height;
    image->high[0] = image->high[1] = 0;
}

/* Width of the pen in pixels: not below one, a thinner line would only be paler. */
static double radius_of(const raster *image, drawing_style style)
{
    return 0.5 * fmax(image->scale * drawing_pens[style].width, 1);
}

static void draw_line(raster *image, const drawing_line *line)
{
    double radius = radius_of(image, line->style), s = image->scale;
    for (size_t k = 1; k < line->count; k++) {
        const double *p = line->xy + 2 * k - 2, a[2] = {s * p[0], s * p[1]},
                     b[2] = {s * p[2], s * p[3]};
        cover_segment(image, a, b, radius);
    }
    blend(image, drawing_pens[line->style].colour);
}

/* Leftmost and rightmost point of a character; a blank is as wide as a narrow one. */
static void stroke_extent(const char *strokes, double extent[2])
{
    extent[0] = *strokes ? 4 : 0;
    extent[1] = *strokes ? 0 : 1.5;
    for (const char *p = strokes; *p; p += p[2] ? 3 : 2) {
        extent[0] = fmin(extent[0], p[0] - '0');
        extent[1] = fmax(extent[1], p[0] - '0');
    }
}

static void draw_label(raster *image, const drawing_label *label)
{
    const double unit = label->height / 6, s = image->scale;
    double radius = radius_of(image, DRAWING_TEXT), x = label->x;
    for (const char *c = label->text; *c; c++) {
        double last[2] = {0, 0}, at[2], extent[2];
        const char *strokes = drawing_strokes(*c);
        int drawn = 0;
        stroke_extent(strokes, extent);
        x -= unit * extent[0];
        for (const char *p = strokes; *p; p += p[2] ? 3 : 2) {
            at[0] = s * (x + unit * (p[0] - '0'));
            at[1] = s * (label->y - unit * (p[1] - '2'));
            if (drawn)
                cover_segment(image, last, at, radius);
            memcpy(last, at, sizeof last);
            drawn = p[2] == ' ';
        }
        x += unit * (extent[1] + 1.7);
    }
    blend(image, drawing_pens[DRAWING_TEXT].colour);
}

static void put_number(unsigned char out[4], uLong value)
{
    for (int k = 0; k < 4; k++)
        out[k] = (unsigned char)(value >> (24 - 8 * k) & 255);
}

/* Length, type, data, check sum: PNG (ISO/IEC 15948) clause 5.3. */
static void write_chunk(FILE *stream, const char type[4], const unsigned char *data, size_t n)
{
    unsigned char number[4];
    uLong sum = crc32(crc32(0, Z_NULL, 0), (const Bytef *)type, 4);
    put_number(number, n);
    fwrite(number, 1, 4, stream);
    fwrite(type, 1, 4, stream);
    if (n > 0) {
        fwrite(data, 1, n, stream);
        sum = crc32(sum, data, (uInt)n);
    }
    put_number(number, sum);
    fwrite(number, 1, 4, stream);
}

static bool write_png(const raster *image, FILE *stream)
{
    static const unsigned char signature[8] = {137, 'P', 'N', 'G', 13, 10, 26, 10};
    /* 8 bits a channel, red green blue, the only compression and filter method, not interlaced. */
    unsigned char header[13] = {0, 0, 0, 0, 0, 0, 0, 0, 8, 2, 0, 0, 0};
    uLong n = (uLong)(image->height * (3 * image->width + 1));
    uLongf packed = compressBound(n);
    unsigned char *data = malloc(packed);
    bool good = data && compress2(data, &packed, image->pixels, n, 9) == Z_OK;
    put_number(header, image->width);
    put_number(header + 4, image->height);
    if (good) {
        fwrite(signature, 1, sizeof signature, stream);
        write_chunk(stream, "IHDR", header, sizeof header);
        write_chunk(stream, "IDAT", data, packed);
        write_chunk(stream, "IEND", NULL, 0);
    }
    free(data);
    return good && !ferror(stream);
}

bool drawing_write_png(const drawing *sheet, double scale, FILE *stream)
{
    raster image = {.width = (size_t)ceil(scale * sheet->width),
                    .height = (size_t)ceil(scale * sheet->height),
                    .scale = scale};
    size_t bytes = image.height * (3 * image.width + 1);
    if (sheet->failed || image.width == 0 || image.height == 0 || bytes > 1000000000)
        return false;
    image.pixels = malloc(bytes);
    image.coverage = calloc(image.width * image.height, 1);
    bool good = image.pixels && image.coverage;
    if (good) {
        memset(image.pixels, 255, bytes);
        for (size_t y = 0; y < image.height; y++)
            image.pixels[y * (3 * image.width + 1)] = 0;
        image.low[0] = image.width;
        image.low[1] = image.height;
        for (size_t k = 0; k < sheet->lines; k++)
            draw_line(&image, &sheet->line[k]);
        for (size_t k = 0; k < sheet->labels; k++)
            draw_label(&image, &sheet->label[k]);
        good = write_png(&image, stream);
    }
    free(image.pixels);
    free(image.coverage);
    return good;
}
