#include "core/band.h"

#include "core/combine.h"
#include "core/error.h"
#include "core/multiversion.h"

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

/* The same for the columns of single control points; four are one vector. */
typedef double quad __attribute__((vector_size(32)));

NURBS_MULTIVERSION
static void apply_to_quads(const struct band *band, const double *in, double *out)
{
    for (size_t j = 0; j < band->rows; j++, out += 4) {
        const double *weight = band->values + j * band->width;
        const double *row = in + band->first[j] * 4;
        quad sum = {0.0}, point;
        for (size_t k = 0; k < band->width; k++, row += 4) {
            memcpy(&point, row, sizeof point);
            sum += weight[k] * point;
        }
        memcpy(out, &sum, sizeof sum);
    }
}

NURBS_MULTIVERSION
static void apply_to_triples(const struct band *band, const double *in, double *out)
{
    for (size_t j = 0; j < band->rows; j++, out += 3) {
        const double *weight = band->values + j * band->width;
        const double *row = in + band->first[j] * 3;
        double sum[3] = {0.0};
        for (size_t k = 0; k < band->width; k++, row += 3)
            for (size_t c = 0; c < 3; c++)
                sum[c] += weight[k] * row[c];
        for (size_t c = 0; c < 3; c++)
            out[c] = sum[c];
    }
}

void band_apply(const struct band *band, size_t columns, const double *in, double *out)
{
    if (columns == 3) {
        apply_to_triples(band, in, out);
        return;
    }
    if (columns == 4) {
        apply_to_quads(band, in, out);
        return;
    }
    for (size_t j = 0; j < band->rows; j++, out += columns)
        combine(band->width, band->values + j * band->width, in + band->first[j] * columns,
                (ptrdiff_t)columns, columns, 0.0, out);
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

/* Points of a polynomial net, whose weights become 1 exactly. */
static void drop_weights(size_t n, double *net, double *points)
{
    for (size_t i = 0; i < n; i++) {
        memcpy(points + 3 * i, net + 4 * i, 3 * sizeof *points);
        net[4 * i + 3] = 1.0;
    }
}

/* Applies the band along the middle index of in[outer][n][dim]. */
static void map_rows(const struct band *band, size_t outer, size_t n, size_t dim, const double *in,
                     double *out)
{
    for (size_t i = 0; i < outer; i++)
        band_apply(band, dim, in + i * n * dim, out + i * band->rows * dim);
}

nurbs_status curve_map(const nurbs_curve *curve, const struct band *band, int degree,
                       const double *knots, nurbs_curve **result)
{
    const int rational = curve->weights != NULL;
    const size_t dim = rational ? 4 : 3, n = band->rows;
    double *mapped = malloc(8 * n * sizeof *mapped);
    if (!mapped)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu control points", n);
    double *points = rational ? mapped + 4 * n : mapped;
    map_rows(band, 1, curve->axis.size, dim, rational ? curve->net : curve->points, mapped);
    if (rational)
        cartesian(n, mapped, points, points + 3 * n);
    nurbs_status status =
        nurbs_curve_create(degree, n, knots, points, rational ? points + 3 * n : NULL, result);
    free(mapped);
    return status;
}

nurbs_status surface_map(const nurbs_surface *s, int direction, const struct band *band, int degree,
                         const double *knots, nurbs_surface **result)
{
    int degrees[2] = {s->axis[0].degree, s->axis[1].degree};
    size_t size[2] = {s->axis[0].size, s->axis[1].size};
    const double *both[2] = {s->axis[0].knots, s->axis[1].knots};
    const size_t n = size[direction];
    degrees[direction] = degree;
    size[direction] = band->rows;
    both[direction] = knots;
    nurbs_surface *r;
    nurbs_status status = surface_reserve(degrees, size, both, s->weights != NULL, &r);
    if (status != NURBS_OK)
        return status;
    const size_t outer = direction == 0 ? 1 : size[0], inner = direction == 0 ? size[1] : 1;
    map_rows(band, outer, n, 4 * inner, s->net, r->net);
    const size_t count = size[0] * size[1];
    if (r->weights) {
        cartesian(count, r->net, r->points, r->weights);
        status = points_check(count, r->points, r->weights);
        homogenize(count, r->points, r->weights, r->net);
    } else {
        drop_weights(count, r->net, r->points); /* convex combinations stay finite */
    }
    if (status == NURBS_OK)
        *result = r;
    else
        nurbs_surface_free(r);
    return status;
}
