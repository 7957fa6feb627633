/* Errors over the domain as a picture: distance across, depth over distance behind the source
 * upwards, every cell the worst of some points with random Y/X. */
#include "igabem_kelvin.h"

#include <math.h>
#include <stdio.h>

enum { COLUMNS = 40, ROWS = 24, POINTS = 4, CELL = 9, GAP = 60 };
static const double first_r = -6, last_r = 4;         /* log10 R */
static const double first_slope = -4, last_slope = 2; /* log10 |Z|/|X| */
static const double least = -16, most = -8;           /* log10 of the error, ends of the colours */

static double uniform(unsigned long long *state)
{
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(*state >> 11) * 0x1p-53;
}

/* Worst errors of one cell. */
static void measure(int column, int row, unsigned long long *state, double error[4])
{
    for (int k = 0; k < 4; k++)
        error[k] = 0;
    for (int i = 0; i < POINTS; i++) {
        double R = pow(10, first_r + (last_r - first_r) * (column + uniform(state)) / COLUMNS);
        double z =
            pow(10, first_slope + (last_slope - first_slope) * (row + uniform(state)) / ROWS);
        double y = pow(10, -3 + 4 * uniform(state)), m = R / sqrt(1 + z * z + y * y), at[4];
        const double P[3] = {-m, y * m, -z * m};
        kelvin_errors(P, at);
        for (int k = 0; k < 4; k++)
            error[k] = fmax(error[k], at[k]);
    }
}

/* White at the least error, dark blue at the most. */
static void print_colour(double error)
{
    double s = (log10(fmax(error, 1e-300)) - least) / (most - least);
    s = fmin(fmax(s, 0), 1);
    printf("fill=\"rgb(%.0f,%.0f,%.0f)\"", 255 - 235 * s, 255 - 205 * s, 255 - 130 * s);
}

static void print_axes(double x, double y, const char *name)
{
    const double width = COLUMNS * CELL, height = ROWS * CELL;
    printf("<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"none\" stroke=\"#444\"/>"
           "<text x=\"%g\" y=\"%g\" font-weight=\"bold\">%s</text>\n",
           x, y, width, height, x, y - 8, name);
    for (int e = (int)first_r; e <= (int)last_r; e += 2)
        printf("<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">10<tspan dy=\"-5\" "
               "font-size=\"9\">%d</tspan></text>",
               x + width * (e - first_r) / (last_r - first_r), y + height + 16, e);
    for (int e = (int)first_slope; e <= (int)last_slope; e += 2)
        printf("<text x=\"%g\" y=\"%g\" text-anchor=\"end\">10<tspan dy=\"-5\" "
               "font-size=\"9\">%d</tspan></text>",
               x - 5, y + height - height * (e - first_slope) / (last_slope - first_slope) + 4, e);
    printf("<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">R</text>"
           "<text x=\"%g\" y=\"%g\" text-anchor=\"middle\" transform=\"rotate(-90 %g "
           "%g)\">|Z|/|X|</text>\n",
           x + width / 2, y + height + 30, x - 38, y + height / 2, x - 38, y + height / 2);
}

static void print_key(double x, double y)
{
    const int steps = (int)(most - least);
    for (int k = 0; k < steps; k++) {
        printf("<rect x=\"%g\" y=\"%g\" width=\"40\" height=\"14\" stroke=\"#888\" ", x + 40 * k,
               y);
        print_colour(pow(10, least + k + 0.5));
        printf("/>");
    }
    for (int k = 0; k <= steps; k++)
        printf("<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">10<tspan dy=\"-5\" "
               "font-size=\"9\">%d</tspan></text>",
               x + 40 * k, y + 30, (int)least + k);
    printf("\n");
}

void print_map(void)
{
    static const char *const name[4] = {"N", "gradient of N", "W", "gradient of W"};
    static double error[COLUMNS][ROWS][4];
    const double width = COLUMNS * CELL + GAP, height = ROWS * CELL + GAP + 20;
    unsigned long long state = 3;
    for (int i = 0; i < COLUMNS; i++)
        for (int j = 0; j < ROWS; j++)
            measure(i, j, &state, error[i][j]);
    printf("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" "
           "font-family=\"sans-serif\" font-size=\"12\" fill=\"#222\">\n"
           "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
           2 * width + 30, 2 * height + 70);
    for (int k = 0; k < 4; k++) {
        const double x = GAP + width * (k % 2), y = 30 + height * (k / 2);
        for (int i = 0; i < COLUMNS; i++)
            for (int j = 0; j < ROWS; j++) {
                printf("<rect x=\"%g\" y=\"%g\" width=\"%d\" height=\"%d\" ", x + CELL * i,
                       y + CELL * (ROWS - 1 - j), CELL, CELL);
                print_colour(error[i][j][k]);
                printf("/>\n");
            }
        print_axes(x, y, name[k]);
    }
    print_key(GAP, 2 * height + 30);
    printf("</svg>\n");
}
