#include "band.h"
#include "error.h"
#include "multiversion.h"

#include <nurbs/basis.h>

#include <stdlib.h>
#include <string.h>

nurbs_status band_create(size_t rows, size_t width, struct band *band)
{
    band->rows = rows;
    band->width = width;
    band->first = malloc(rows * sizeof *band->first);
    band->values = malloc(rows * width * sizeof *band->values);
    if (band->first && band->values)
        return NURBS_OK;
    band_free(band);
    return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu rows of %zu weights", rows, width);
}

void band_free(struct band *band)
{
    free(band->first);
    free(band->values);
    memset(band, 0, sizeof *band);
}

/* The same for the three or four columns of single control points. */
NURBS_INLINE void apply_narrow(const struct band *band, size_t columns, const double *in,
                               double *out)
{
    for (size_t j = 0; j < band->rows; j++, out += columns) {
        const double *weight = band->values + j * band->width;
        const double *row = in + band->first[j] * columns;
        double sum[4] = {0.0, 0.0, 0.0, 0.0};
        for (size_t k = 0; k < band->width; k++, row += columns)
            for (size_t c = 0; c < columns; c++)
                sum[c] += weight[k] * row[c];
        memcpy(out, sum, columns * sizeof *out);
    }
}

NURBS_MULTIVERSION
void band_apply(const struct band *band, size_t columns, const double *in, double *out)
{
    if (columns == 3 || columns == 4) {
        if (columns == 3)
            apply_narrow(band, 3, in, out);
        else
            apply_narrow(band, 4, in, out);
        return;
    }
    for (size_t j = 0; j < band->rows; j++, out += columns) {
        const double *weight = band->values + j * band->width;
        const double *row = in + band->first[j] * columns;
        memset(out, 0, columns * sizeof *out);
        for (size_t k = 0; k < band->width; k++, row += columns)
            if (weight[k] != 0.0)
                for (size_t c = 0; c < columns; c++)
                    out[c] += weight[k] * row[c];
    }
}

/* The Cox-de Boor recursion with one argument for each level (Ramshaw 1989; with knots as
 * arguments it is the Oslo algorithm of Cohen, Lyche and Riesenfeld 1980). */
void blossom(int degree, const double *knots, size_t span, const double *args, double *weights)
{
    const double *t = knots + span;
    weights[0] = 1.0;
    for (int q = 1; q <= degree; q++) {
        const double u = args[q - 1];
        double saved = 0.0;
        for (int r = 0; r < q; r++) {
            const double left = t[r - q + 1];
            const double a = (u - left) / (t[r + 1] - left);
            const double value = weights[r];
            weights[r] = saved + (1.0 - a) * value;
            saved = a * value;
        }
        weights[q] = saved;
    }
}

/* With the span that holds the knot before the arguments, every weight is a discrete B-spline and
 * not negative (Cohen, Lyche and Riesenfeld). */
nurbs_status band_insertion(const struct axis *axis, size_t target_size, const double *target,
                            struct band *band)
{
    const int p = axis->degree;
    nurbs_status status = band_create(target_size, (size_t)p + 1, band);
    if (status != NURBS_OK)
        return status;
    for (size_t j = 0; j < target_size; j++) {
        const size_t span = axis_span(axis, target[j]);
        band->first[j] = span - (size_t)p;
        blossom(p, axis->knots, span, target + j + 1, band->values + j * band->width);
    }
    return NURBS_OK;
}

static void cartesian(size_t n, const double *net, double *points, double *weights)
{
    for (size_t i = 0; i < n; i++) {
        weights[i] = net[4 * i + 3];
        for (size_t c = 0; c < 3; c++)
            points[3 * i + c] = net[4 * i + c] / weights[i];
    }
}

/* Applies the band along the middle index of in[outer][n][inner points]: polynomial control points
 * as they are, rational ones in homogeneous form. */
static nurbs_status map_points(const struct band *band, size_t outer, size_t n, size_t inner,
                               const double *points, const double *net, int rational, double **out)
{
    const size_t dim = rational ? 4 : 3, count = outer * band->rows * inner;
    const double *in = rational ? net : points;
    double *mapped = malloc(8 * count * sizeof *mapped);
    *out = mapped;
    if (!mapped)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu control points", count);
    double *target = rational ? mapped + 4 * count : mapped;
    for (size_t i = 0; i < outer; i++)
        band_apply(band, inner * dim, in + i * n * inner * dim,
                   target + i * band->rows * inner * dim);
    if (rational)
        cartesian(count, target, mapped, mapped + 3 * count);
    return NURBS_OK;
}

nurbs_status curve_map(const nurbs_curve *curve, const struct band *band, int degree,
                       const double *knots, nurbs_curve **result)
{
    double *points;
    const int rational = curve->weights != NULL;
    nurbs_status status =
        map_points(band, 1, curve->axis.size, 1, curve->points, curve->net, rational, &points);
    if (status == NURBS_OK)
        status = nurbs_curve_create(degree, band->rows, knots, points,
                                    rational ? points + 3 * band->rows : NULL, result);
    free(points);
    return status;
}

nurbs_status surface_map(const nurbs_surface *s, int direction, const struct band *band, int degree,
                         const double *knots, nurbs_surface **result)
{
    int degrees[2] = {s->axis[0].degree, s->axis[1].degree};
    size_t size[2] = {s->axis[0].size, s->axis[1].size};
    const double *both[2] = {s->axis[0].knots, s->axis[1].knots};
    const int rational = s->weights != NULL;
    double *points;
    nurbs_status status =
        direction == 0
            ? map_points(band, 1, size[0], size[1], s->points, s->net, rational, &points)
            : map_points(band, size[0], size[1], 1, s->points, s->net, rational, &points);
    degrees[direction] = degree;
    size[direction] = band->rows;
    both[direction] = knots;
    if (status == NURBS_OK)
        status = nurbs_surface_create(degrees, size, both[0], both[1], points,
                                      rational ? points + 3 * size[0] * size[1] : NULL, result);
    free(points);
    return status;
}
