#include "constants.h"
#include "error.h"

#include <galv/moments.h>

#include <math.h>
#include <stdlib.h>

enum { MOST_ORDER = 8, MOST_NODES = MOST_ORDER / 2 + 2 };

/* Gauss-Legendre rule of n nodes on [0, 1], by Newton's method on the Legendre polynomial. */
static void gauss(int n, double *node, double *weight)
{
    for (int i = 0; i < n; i++) {
        double x = cos(PI * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 10; step++) {
            double p = 1, before = 0;
            for (int k = 1; k <= n; k++) {
                double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
                before = p;
                p = next;
            }
            slope = n * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        node[i] = (1 + x) / 2;
        weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
}

size_t galv_moments_count(unsigned order)
{
    return (size_t)(order + 1) * (order + 2) * (order + 3) / 6;
}

static size_t section_count(unsigned order)
{
    return (size_t)(order + 1) * (order + 2) / 2;
}

/* 1, t, t^2, ... t^n */
static void powers(double t, unsigned n, double *p)
{
    p[0] = 1;
    for (unsigned k = 1; k <= n; k++)
        p[k] = p[k - 1] * t;
}

/* Adds weight * x^p y^(q+1) z^r / (q+1) to every moment. */
static void add_point(const double *point, double weight, unsigned order, double *moments)
{
    double x[MOST_ORDER + 2], y[MOST_ORDER + 2], z[MOST_ORDER + 2];
    powers(point[0], order, x);
    powers(point[1], order + 1, y);
    powers(point[2], order, z);
    size_t m = 0;
    for (unsigned s = 0; s <= order; s++)
        for (unsigned p = s + 1; p-- > 0;)
            for (unsigned q = s - p + 1; q-- > 0;)
                moments[m++] += weight * x[p] * y[q + 1] * z[s - p - q] / (q + 1);
}

/* By the divergence theorem with the field (0, x^p y^(q+1) z^r / (q+1), 0): only the hull surface
 * has flux. */
static void add_cell(const double *a, const double *b, const double *c, const double *d, int n,
                     const double *node, const double *weight, unsigned order, double *moments)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            double u = node[i], v = node[j], point[3], du[3], dv[3];
            for (int k = 0; k < 3; k++) {
                double low = a[k] + v * (b[k] - a[k]), high = c[k] + v * (d[k] - c[k]);
                point[k] = low + u * (high - low);
                du[k] = high - low;
                dv[k] = (1 - u) * (b[k] - a[k]) + u * (d[k] - c[k]);
            }
            double normal = du[2] * dv[0] - du[0] * dv[2];
            add_point(point, weight[i] * weight[j] * normal, order, moments);
        }
}

static void make_positive(size_t count, double *moments)
{
    double sign = moments[0] < 0 ? -1 : 1;
    for (size_t m = 0; m < count; m++)
        moments[m] *= sign;
}

galv_status galv_moments(size_t sections, size_t girth, const double *xyz, unsigned order,
                         double *moments)
{
    if (sections < 2 || girth < 2 || !xyz || !moments)
        return galv_fail(GALV_ERROR_ARGUMENT, "a grid of %zu x %zu points encloses nothing",
                         sections, girth);
    if (order > MOST_ORDER)
        return galv_fail(GALV_ERROR_ARGUMENT, "moments of order %u, expected at most %d", order,
                         MOST_ORDER);
    double node[MOST_NODES], weight[MOST_NODES];
    int n = (int)order / 2 + 2;
    gauss(n, node, weight);
    size_t count = galv_moments_count(order);
    for (size_t m = 0; m < count; m++)
        moments[m] = 0;
    for (size_t i = 0; i + 1 < sections; i++)
        for (size_t j = 0; j + 1 < girth; j++) {
            const double *a = xyz + 3 * (i * girth + j), *c = a + 3 * girth;
            add_cell(a, a + 3, c, c + 3, n, node, weight, order, moments);
        }
    make_positive(count, moments);
    return GALV_OK;
}

galv_status galv_section_moments(size_t n, const double *points, unsigned order, double *moments)
{
    if (n < 2 || !points || !moments)
        return galv_fail(GALV_ERROR_ARGUMENT, "a section of %zu points encloses nothing", n);
    if (order > MOST_ORDER)
        return galv_fail(GALV_ERROR_ARGUMENT, "moments of order %u, expected at most %d", order,
                         MOST_ORDER);
    double node[MOST_NODES], weight[MOST_NODES];
    int nodes = (int)order / 2 + 2;
    gauss(nodes, node, weight);
    size_t count = section_count(order);
    for (size_t m = 0; m < count; m++)
        moments[m] = 0;
    for (size_t k = 0; k + 1 < n; k++) {
        const double *a = points + 3 * k, *b = a + 3;
        for (int i = 0; i < nodes; i++) {
            double y[MOST_ORDER + 2], z[MOST_ORDER + 2] = {1}, dz = weight[i] * (b[2] - a[2]);
            powers(a[1] + node[i] * (b[1] - a[1]), order + 1, y);
            powers(a[2] + node[i] * (b[2] - a[2]), order, z);
            size_t m = 0;
            for (unsigned s = 0; s <= order; s++)
                for (unsigned q = s + 1; q-- > 0;)
                    moments[m++] += dz * y[q + 1] * z[s - q] / (q + 1);
        }
    }
    make_positive(count, moments);
    return GALV_OK;
}

static int evaluate(void *user_data, size_t npoints, const double *xyz, double *values)
{
    const galv_moment_set *set = user_data;
    if (npoints != set->sections * set->girth)
        return 1;
    if (galv_moments(set->sections, set->girth, xyz, set->order, values))
        return 2;
    values += galv_moments_count(set->order);
    for (size_t i = set->section_first; set->section_stride && i < set->sections;
         i += set->section_stride) {
        if (galv_section_moments(set->girth, xyz + 3 * i * set->girth, set->section_order, values))
            return 3;
        values += section_count(set->section_order);
    }
    return 0;
}

galv_status galv_moments_extra(galv_moment_set *set, galv_extra *extra)
{
    if (!set || !extra)
        return galv_fail(GALV_ERROR_ARGUMENT, "NULL argument of galv_moments_extra");
    size_t count = galv_moments_count(set->order);
    if (set->section_stride && set->section_first < set->sections)
        count += (1 + (set->sections - 1 - set->section_first) / set->section_stride) *
                 section_count(set->section_order);
    *extra =
        (galv_extra){.count = count, .evaluate = evaluate, .user_data = set, .concurrent = true};
    return GALV_OK;
}
