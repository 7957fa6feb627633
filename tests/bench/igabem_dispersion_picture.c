/* Phase error over the cells a wave, and the slope of the lines at which waves cease to go
 * downstream alone. */
#include "igabem_dispersion.h"

#include <math.h>
#include <stdio.h>

static const double pi = 3.14159265358979323846;
static const double width = 330, height = 300, top = 40;
static const char *const colour[SCHEMES] = {"#7570b3", "#1b9e77", "#66a61e", "#e6ab02",
                                            "#d95f02", "#999999", "#d62728"};

struct axis {
    double low, high; /* log10 */
};

static double place(const struct axis *axis, double value, double length)
{
    return length * (log10(value) - axis->low) / (axis->high - axis->low);
}

static void print_frame(double x, const struct axis axis[2], const double *ticks[2],
                        const size_t n[2], const char *const names[3])
{
    printf("<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"none\" stroke=\"#444\"/>\n"
           "<text x=\"%g\" y=\"%g\" font-weight=\"bold\">%s</text>\n"
           "<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">%s</text>\n"
           "<text x=\"%g\" y=\"%g\" text-anchor=\"middle\" transform=\"rotate(-90 %g %g)\">%s"
           "</text>\n",
           x, top, width, height, x, top - 10, names[0], x + width / 2, top + height + 34, names[1],
           x - 44, top + height / 2, x - 44, top + height / 2, names[2]);
    for (size_t k = 0; k < n[0]; k++) {
        double at = x + place(&axis[0], ticks[0][k], width);
        printf("<path d=\"M%g %gv%g\" stroke=\"#ddd\"/><text x=\"%g\" y=\"%g\" "
               "text-anchor=\"middle\">%g</text>\n",
               at, top, height, at, top + height + 16, ticks[0][k]);
    }
    for (size_t k = 0; k < n[1]; k++) {
        double at = top + height - place(&axis[1], ticks[1][k], height);
        printf("<path d=\"M%g %gh%g\" stroke=\"#ddd\"/><text x=\"%g\" y=\"%g\" "
               "text-anchor=\"end\">%g</text>\n",
               x, at, width, x - 5, at + 4, ticks[1][k]);
    }
}

static void print_phases(double x)
{
    static const double across[] = {6, 8, 12, 16, 24, 48}, up[] = {0.001, 0.01, 0.1, 1};
    const struct axis axis[2] = {{log10(6), log10(48)}, {-3.3, 0.7}};
    print_frame(x, axis, (const double *[]){across, up}, (const size_t[]){6, 4},
                (const char *const[]){"Error of the wave number, transverse waves", "cells a wave",
                                      "per cent"});
    struct dispersion_grid grid = {.h = 1};
    int row = 0;
    for (size_t s = 0; s < SCHEMES; s++) {
        if (s == SHARP)
            continue;
        printf("<path fill=\"none\" stroke=\"%s\" stroke-width=\"2\" d=\"", colour[s]);
        bool begun = false;
        for (double n = 6; n <= 48.01; n *= pow(8, 1.0 / 24)) {
            double u = 2 * pi / n,
                   e = 100 * fabs(dispersion_root(&dispersion_schemes[s], &grid, 0, u, u) / u - 1);
            if (e >= pow(10, axis[1].low) && e <= pow(10, axis[1].high)) {
                printf("%c%.1f %.1f", begun ? 'L' : 'M', x + place(&axis[0], n, width),
                       top + height - place(&axis[1], e, height));
                begun = true;
            }
        }
        double y = top + height + 56 + 18 * row++;
        printf("\"/>\n<path d=\"M%g %gh24\" stroke=\"%s\" stroke-width=\"2\"/><text x=\"%g\" "
               "y=\"%g\">%s</text>\n",
               x, y, colour[s], x + 32, y + 4, dispersion_schemes[s].name);
    }
}

/* Least slope of the lines, by halving, at which the scheme is lost; 1 if it is not. */
static double lost_slope(const struct dispersion_scheme *scheme, double h, double eps)
{
    double low = 0, high = 1, lost;
    for (int k = 0; k < 7; k++) {
        double middle = 0.5 * (low + high);
        struct dispersion_grid grid = {.h = h, .tau = -middle / h};
        dispersion_first_lost(scheme, &grid, 1, &eps, &lost);
        if (lost > 1)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

static void print_slopes(double x)
{
    static const double across[] = {12, 24, 48, 96, 192}, up[] = {0.05, 0.1, 0.2, 0.5, 1},
                        aspect[] = {0.5, 1, 2};
    static const char *const dash[] = {"2 3", "7 3", "none"};
    const struct axis axis[2] = {{log10(12), log10(192)}, {log10(0.05), 0}};
    print_frame(x, axis, (const double *[]){across, up}, (const size_t[]){5, 5},
                (const char *const[]){"Slope of the lines at which stability is lost",
                                      "cells a wave", "slope dy/dx of a line"});
    int row = 0;
    for (size_t s = 3; s <= USED; s += USED - 3)
        for (int l = 0; l < 3; l++) {
            printf("<path fill=\"none\" stroke=\"%s\" stroke-width=\"2\" stroke-dasharray=\"%s\" "
                   "d=\"",
                   colour[s], dash[l]);
            for (int k = 0; k <= 8; k++) {
                double n = 12 * pow(2, 0.5 * k);
                double slope = lost_slope(&dispersion_schemes[s], aspect[l], 2 * pi / n);
                printf("%c%.1f %.1f", k ? 'L' : 'M', x + place(&axis[0], n, width),
                       top + height - place(&axis[1], slope, height));
            }
            double y = top + height + 56 + 18 * row++;
            printf("\"/>\n<path d=\"M%g %gh24\" stroke=\"%s\" stroke-width=\"2\" "
                   "stroke-dasharray=\"%s\"/><text x=\"%g\" y=\"%g\">%s, dy/dx %g</text>\n",
                   x, y, colour[s], dash[l], x + 32, y + 4,
                   s == USED ? "first derivative twice" : "own second derivative", aspect[l]);
        }
}

void dispersion_print_picture(void)
{
    printf("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"860\" height=\"500\" "
           "font-family=\"sans-serif\" font-size=\"12\" fill=\"#222\">\n"
           "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n");
    print_phases(70);
    print_slopes(500);
    printf("</svg>\n");
}
