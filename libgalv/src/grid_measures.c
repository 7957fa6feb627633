#include "grid_measures.h"

#include "error.h"

#include <math.h>
#include <stdlib.h>
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

size_t galv_wet_polygon(const double *const corner[3], double polygon[4][3])
{
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
    return n;
}

static double wet_triangle(const double *const corner[3])
{
    double polygon[4][3], sum = 0;
    size_t n = galv_wet_polygon(corner, polygon);
    for (size_t k = 2; k < n; k++)
        sum += triangle(polygon[0], polygon[k - 1], polygon[k]);
    return sum;
}

void galv_add_cell(const double *a, const double *c, double *sum)
{
    const double *b = a + 3, *d = c + 3;
    if (a[2] > 0 && b[2] > 0 && c[2] > 0 && d[2] > 0)
        return;
    *sum += wet_triangle((const double *const[]){a, b, d});
    *sum += wet_triangle((const double *const[]){a, d, c});
}

galv_status galv_grid_check(size_t sections, size_t girth, const double *xyz)
{
    if (sections < 2 || girth < 2 || !xyz)
        return galv_fail(GALV_ERROR_ARGUMENT, "a grid of %zu x %zu points has no cells", sections,
                         girth);
    for (size_t k = 0; k < 3 * sections * girth; k++)
        if (!isfinite(xyz[k]))
            return galv_fail(GALV_ERROR_ARGUMENT, "grid point %zu,%zu: %c is %g", k / 3 / girth,
                             k / 3 % girth, "xyz"[k % 3], xyz[k]);
    return GALV_OK;
}

galv_status galv_grid_volume(size_t sections, size_t girth, const double *xyz, double *volume)
{
    if (!volume)
        return galv_fail(GALV_ERROR_ARGUMENT, "the result must be given");
    galv_status status = galv_grid_check(sections, girth, xyz);
    if (status)
        return status;
    double sum = 0;
    for (size_t i = 0; i + 1 < sections; i++)
        for (size_t j = 0; j + 1 < girth; j++) {
            const double *corner = xyz + 3 * (i * girth + j);
            galv_add_cell(corner, corner + 3 * girth, &sum);
        }
    *volume = 2 * sum;
    return GALV_OK;
}

galv_status galv_crossings_find(size_t sections, size_t girth, const double *xyz,
                                galv_crossings *crossings)
{
    *crossings = (galv_crossings){.above = malloc(2 * sections * sizeof(size_t)),
                                  .share = malloc(sections * sizeof(double))};
    if (!crossings->above || !crossings->share) {
        galv_crossings_free(crossings);
        return galv_fail(GALV_ERROR_MEMORY, "waterline of %zu sections", sections);
    }
    crossings->below = crossings->above + sections;
    for (size_t i = 0; i < sections; i++)
        for (size_t j = 0; j + 1 < girth; j++) {
            size_t p = i * girth + j, q = p + 1;
            double zp = xyz[3 * p + 2], zq = xyz[3 * q + 2];
            if ((zp >= 0) == (zq >= 0))
                continue;
            crossings->above[crossings->n] = p;
            crossings->below[crossings->n] = q;
            crossings->share[crossings->n++] = zp / (zp - zq);
            break;
        }
    return GALV_OK;
}

void galv_crossings_free(galv_crossings *crossings)
{
    free(crossings->above);
    free(crossings->share);
    *crossings = (galv_crossings){0};
}

void galv_crossing_at(double share, const double *above, const double *below, double xy[2])
{
    for (size_t c = 0; c < 2; c++)
        xy[c] = (1 - share) * above[c] + share * below[c];
}

double galv_piece_slope(const double a[2], const double b[2])
{
    double dx = b[0] - a[0], dy = b[1] - a[1], length = hypot(dx, dy);
    return length > 0 ? fabs(dy) / length : 0;
}

galv_status galv_grid_entrance(size_t sections, size_t girth, const double *xyz, double most,
                               double *entrance)
{
    galv_crossings c;
    if (!entrance || !(most >= 0))
        return galv_fail(GALV_ERROR_ARGUMENT, "%s",
                         entrance ? "the greatest slope must be given"
                                  : "the result must be given");
    galv_status status = galv_grid_check(sections, girth, xyz);
    if (!status)
        status = galv_crossings_find(sections, girth, xyz, &c);
    if (status)
        return status;
    size_t n = c.n;
    double at[2][2];
    *entrance = 0;
    for (size_t i = 0; i < n; i++) {
        galv_crossing_at(c.share[i], xyz + 3 * c.above[i], xyz + 3 * c.below[i], at[i % 2]);
        double slope = i ? galv_piece_slope(at[(i + 1) % 2], at[i % 2]) : 0;
        if (slope <= GALV_STEM_SLACK * most)
            *entrance = fmax(*entrance, slope);
    }
    galv_crossings_free(&c);
    if (n < 2)
        return galv_fail(GALV_ERROR_GEOMETRY, "%zu sections cross z = 0, a waterline needs 2", n);
    return GALV_OK;
}
