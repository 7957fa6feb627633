#include "volume.h"

#include <string.h>

/* Integral of y over the projected triangle, by the mean of its corners. */
static double triangle(const double *a, const double *b, const double *c)
{
    double area = ((b[0] - a[0]) * (c[2] - a[2]) - (c[0] - a[0]) * (b[2] - a[2])) / 2;
    return area * (a[1] + b[1] + c[1]) / 3;
}

static void cross_water(const double *below, const double *above, double *point)
{
    double share = below[2] / (below[2] - above[2]);
    for (int k = 0; k < 3; k++)
        point[k] = below[k] + share * (above[k] - below[k]);
}

/* The wet part of a triangle has up to four corners. */
static double wet_triangle(const double *const corner[3])
{
    double polygon[4][3];
    size_t n = 0;
    for (int k = 0; k < 3; k++) {
        const double *here = corner[k], *next = corner[(k + 1) % 3];
        if (here[2] <= 0)
            memcpy(polygon[n++], here, sizeof polygon[0]);
        if (here[2] <= 0 && next[2] > 0)
            cross_water(here, next, polygon[n++]);
        else if (here[2] > 0 && next[2] <= 0)
            cross_water(next, here, polygon[n++]);
    }
    double sum = 0;
    for (size_t k = 2; k < n; k++)
        sum += triangle(polygon[0], polygon[k - 1], polygon[k]);
    return sum;
}

double volume_of_grid(size_t rows, size_t columns, const double *points)
{
    double sum = 0;
    for (size_t i = 0; i + 1 < rows; i++) {
        for (size_t j = 0; j + 1 < columns; j++) {
            const double *a = points + 3 * (i * columns + j), *b = a + 3;
            const double *c = a + 3 * columns, *d = c + 3;
            if (a[2] > 0 && b[2] > 0 && c[2] > 0 && d[2] > 0)
                continue;
            sum += wet_triangle((const double *const[]){a, b, d});
            sum += wet_triangle((const double *const[]){a, d, c});
        }
    }
    return 2 * sum;
}
