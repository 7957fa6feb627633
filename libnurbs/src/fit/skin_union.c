/* The union of the knots of many curves, and every curve on it. */
#include "core/error.h"
#include "core/multiversion.h"
#include "fit/skin_common.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the length of the domain, which is 1. */
static const double merge = 1e-9;

/* A knot of a curve; `place` says where it is among the curve's own. */
typedef struct tagged {
    double knot;
    size_t curve, place;
} tagged;

static int compare_tagged(const void *a, const void *b)
{
    const tagged *x = a, *y = b;
    if (x->knot != y->knot)
        return x->knot < y->knot ? -1 : 1;
    if (x->curve != y->curve)
        return x->curve < y->curve ? -1 : 1;
    return x->place < y->place ? -1 : x->place > y->place;
}

static int same_knots(size_t n, const nurbs_curve *const *curves)
{
    const struct axis *first = &curves[0]->axis;
    for (size_t k = 1; k < n; k++) {
        const struct axis *axis = &curves[k]->axis;
        if (axis->size != first->size ||
            memcmp(axis->knots, first->knots,
                   (axis->size + (size_t)axis->degree + 1) * sizeof(double)) != 0)
            return 0;
    }
    return 1;
}

/* Groups of knots within `merge` of their lowest become that one, in the union as often as in the
 * curve with most of them. Fills interior, and moves the knots in all[curve * stride + place].
 * Returns the number of interior knots. */
static size_t merge_groups(size_t count, const tagged *list, size_t stride, size_t *tally,
                           double *interior, double *all)
{
    size_t kept = 0;
    for (size_t k = 0, next; k < count; k = next) {
        const double knot = list[k].knot;
        size_t most = 0;
        for (next = k; next < count && list[next].knot - knot <= merge; next++) {
            const size_t here = ++tally[list[next].curve];
            most = here > most ? here : most;
            all[list[next].curve * stride + list[next].place] = knot;
        }
        for (size_t i = k; i < next; i++)
            tally[list[i].curve] = 0;
        for (size_t i = 0; i < most; i++)
            interior[kept++] = knot;
    }
    return kept;
}

/* Rows of control points over `target` of a spline over t: blossoms at successive target knots,
 * whose denominators change with the span only. */
NURBS_INLINE void insert_rows(size_t p, const double *t, size_t dimension, const double *points,
                              size_t target_size, const double *target, double *out)
{
    double inverse[NURBS_MAX_DEGREE + 1][NURBS_MAX_DEGREE + 1];
    size_t span = p, known = 0;
    for (size_t j = 0; j < target_size; j++, out += dimension) {
        while (t[span + 1] <= target[j] && t[span + 1] < 1.0)
            span++;
        if (span != known) {
            for (size_t q = 1; q <= p; q++)
                for (size_t r = 0; r < q; r++)
                    inverse[q][r] = 1.0 / (t[span + r + 1] - t[span + r + 1 - q]);
            known = span;
        }
        double weight[NURBS_MAX_DEGREE + 1] = {1.0};
        for (size_t q = 1; q <= p; q++) {
            const double u = target[j + q];
            double saved = 0.0;
            for (size_t r = 0; r < q; r++) {
                const double a = (u - t[span + r + 1 - q]) * inverse[q][r];
                const double value = weight[r];
                weight[r] = saved + (1.0 - a) * value;
                saved = a * value;
            }
            weight[q] = saved;
        }
        const double *from = points + (span - p) * dimension;
        double sum[4] = {0.0};
        for (size_t k = 0; k <= p; k++, from += dimension)
            for (size_t c = 0; c < dimension; c++)
                sum[c] += weight[k] * from[c];
        for (size_t c = 0; c < dimension; c++)
            out[c] = sum[c];
    }
}

NURBS_MULTIVERSION
static void insert_all(int degree, const double *t, size_t dimension, const double *points,
                       size_t target_size, const double *target, double *out)
{
    if (degree == 3 && dimension == 3)
        insert_rows(3, t, 3, points, target_size, target, out);
    else
        insert_rows((size_t)degree, t, dimension, points, target_size, target, out);
}

/* The control points of a curve, homogeneous when dimension is 4. */
static void take_points(const nurbs_curve *curve, size_t dimension, double *points)
{
    if (dimension == 4)
        memcpy(points, curve->net, 4 * curve->axis.size * sizeof *points);
    else
        memcpy(points, curve->points, 3 * curve->axis.size * sizeof *points);
}

static nurbs_status reserve(size_t n, common *sections)
{
    const size_t p = (size_t)sections->degree;
    sections->knots = malloc((sections->size + p + 1) * sizeof(double));
    sections->net = malloc(sections->size * n * sections->dimension * sizeof(double));
    if (sections->knots && sections->net)
        return NURBS_OK;
    return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu control points", n,
                      sections->size);
}

/* The knots of all curves, tagged and sorted, and copied to all[n][stride]. Returns their number
 * inside the domain. */
static size_t gather(size_t n, const nurbs_curve *const *curves, size_t stride, tagged *list,
                     double *all)
{
    size_t count = 0;
    for (size_t k = 0; k < n; k++) {
        const struct axis *axis = &curves[k]->axis;
        memcpy(all + k * stride, axis->knots,
               (axis->size + (size_t)axis->degree + 1) * sizeof *all);
        for (size_t i = (size_t)axis->degree + 1; i < axis->size; i++)
            list[count++] = (tagged){axis->knots[i], k, i};
    }
    qsort(list, count, sizeof *list, compare_tagged);
    return count;
}

static nurbs_status merged_union(size_t n, const nurbs_curve *const *curves, common *sections)
{
    const size_t p = (size_t)sections->degree;
    size_t total = 1, longest = 0;
    for (size_t k = 0; k < n; k++) {
        total += curves[k]->axis.size;
        longest = curves[k]->axis.size > longest ? curves[k]->axis.size : longest;
    }
    const size_t stride = longest + p + 1;
    tagged *list = malloc(total * sizeof *list);
    size_t *tally = calloc(n, sizeof *tally);
    double *all = malloc((n * stride + total + 4 * longest) * sizeof *all);
    nurbs_status status = NURBS_OK;
    if (list && tally && all) {
        double *interior = all + n * stride, *points = interior + total;
        size_t count = gather(n, curves, stride, list, all);
        count = merge_groups(count, list, stride, tally, interior, all);
        sections->size = count + p + 1;
        status = reserve(n, sections);
        for (size_t k = 0; k < sections->size + p + 1 && status == NURBS_OK; k++)
            sections->knots[k] = k <= p ? 0 : k >= sections->size ? 1 : interior[k - p - 1];
        for (size_t k = 0; k < n && status == NURBS_OK; k++) {
            take_points(curves[k], sections->dimension, points);
            insert_all(sections->degree, all + k * stride, sections->dimension, points,
                       sections->size, sections->knots,
                       sections->net + k * sections->size * sections->dimension);
        }
    } else {
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the knots of %zu sections", n);
    }
    free(list);
    free(tally);
    free(all);
    return status;
}

nurbs_status common_union(size_t n, const nurbs_curve *const *curves, common *sections)
{
    if (!same_knots(n, curves))
        return merged_union(n, curves, sections);
    const struct axis *axis = &curves[0]->axis;
    sections->size = axis->size;
    nurbs_status status = reserve(n, sections);
    if (status != NURBS_OK)
        return status;
    memcpy(sections->knots, axis->knots,
           (axis->size + (size_t)axis->degree + 1) * sizeof *sections->knots);
    for (size_t k = 0; k < n; k++)
        take_points(curves[k], sections->dimension,
                    sections->net + k * axis->size * sections->dimension);
    return NURBS_OK;
}
