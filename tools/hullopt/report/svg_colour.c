#include "report/svg.h"

#include <math.h>

static void interpolate(const unsigned char stops[][3], size_t n, double t, unsigned char rgb[3])
{
    if (!(t > 0))
        t = 0;
    if (t > 1)
        t = 1;
    double position = t * (double)(n - 1);
    size_t i = (size_t)position;
    if (i > n - 2)
        i = n - 2;
    double share = position - (double)i;
    for (int k = 0; k < 3; k++)
        rgb[k] = (unsigned char)lround((1 - share) * stops[i][k] + share * stops[i + 1][k]);
}

/* Luminance rises evenly, so the map survives grey printing. */
void svg_map_sequential(double t, unsigned char rgb[3])
{
    static const unsigned char stops[][3] = {{30, 52, 140},  {33, 98, 181},  {34, 142, 176},
                                             {72, 178, 138}, {160, 203, 84}, {250, 224, 60}};
    interpolate(stops, sizeof stops / sizeof *stops, t, rgb);
}

void svg_map_diverging(double t, unsigned char rgb[3])
{
    static const unsigned char stops[][3] = {{8, 48, 107},    {33, 113, 181},  {133, 183, 222},
                                             {247, 247, 247}, {244, 165, 130}, {203, 54, 44},
                                             {103, 0, 31}};
    interpolate(stops, sizeof stops / sizeof *stops, t, rgb);
}

void svg_colour_bar(FILE *out, double x, double y, double width, double height,
                    void (*map)(double, unsigned char[3]), const char *low, const char *high,
                    const char *title)
{
    enum { STEPS = 48 };
    bool vertical = height > width;
    fputs("<g shape-rendering=\"crispEdges\">", out);
    for (int k = 0; k < STEPS; k++) {
        unsigned char c[3];
        map((k + 0.5) / STEPS, c);
        double share = (double)k / STEPS;
        /* Each step overlaps its neighbour a little: no seams when scaled. */
        if (vertical)
            fprintf(out, "<rect x=\"%.1f\" y=\"%.2f\" width=\"%.1f\" height=\"%.2f\"", x,
                    y + height * (1 - share) - height / STEPS, width, height / STEPS + 0.3);
        else
            fprintf(out, "<rect x=\"%.2f\" y=\"%.1f\" width=\"%.2f\" height=\"%.1f\"",
                    x + width * share, y, width / STEPS + 0.3, height);
        fprintf(out, " fill=\"#%02x%02x%02x\"/>\n", c[0], c[1], c[2]);
    }
    fputs("</g>\n", out);
    if (vertical) {
        svg_text(out, x + width / 2, y + height + 14, 11, "middle", SVG_MUTED, low);
        svg_text(out, x + width / 2, y - 6, 11, "middle", SVG_MUTED, high);
    } else {
        svg_text(out, x - 6, y + height, 11, "end", SVG_MUTED, low);
        svg_text(out, x + width + 6, y + height, 11, "start", SVG_MUTED, high);
        svg_text(out, x + width / 2, y - 5, 11, "middle", SVG_MUTED, title);
    }
}
