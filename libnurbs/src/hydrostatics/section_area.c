/* Areas of sections x = constant: along every line of constant second parameter the crossing with
 * the plane is found, and y dz is integrated over that parameter. Lines that end before the plane
 * (a stem or transom that is not a section) do not contribute. */
#include "core/error.h"
#include "hydrostatics/hydro_parts.h"
#include "integrals/quadrature.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>

/* A patch with `along` its lengthwise direction, and Gauss points across. */
typedef struct lengthwise {
    const nurbs_surface *surface;
    int sign;     /* turns Su x Sv outwards */
    double slack; /* lines are taken to end this much further aft, so that of two patches that meet
                     in the plane of the section one counts, whatever the rounding */
    int along;
    double first, last; /* domain along */
    size_t n;
    double *t, *weight; /* across; the two ends of the domain follow with weight 0 */
    double *ends;       /* x at both ends of every line */
} lengthwise;

static double extent_x(const nurbs_surface *surface, int direction)
{
    size_t nu = nurbs_surface_size(surface, 0), nv = nurbs_surface_size(surface, 1);
    const double *p = nurbs_surface_points(surface);
    double sum = 0;
    for (size_t i = 0; i < (direction ? nu : nv); i++) {
        size_t a = direction ? i * nv : i, b = direction ? i * nv + nv - 1 : (nu - 1) * nv + i;
        sum += fabs(p[3 * b] - p[3 * a]);
    }
    return sum / (double)(direction ? nu : nv);
}

static nurbs_status evaluate(const lengthwise *patch, double s, double t, double out[9])
{
    const double uv[2] = {patch->along ? t : s, patch->along ? s : t};
    return nurbs_surface_eval(patch->surface, 1, 1, uv, out);
}

static nurbs_status lengthwise_create(const nurbs_surface *surface, int sign, double slack,
                                      lengthwise *patch)
{
    int along = extent_x(surface, 1) > extent_x(surface, 0), across = !along;
    const double *knots = nurbs_surface_knots(surface, across),
                 *range = nurbs_surface_knots(surface, along);
    size_t spans = patch_spans(surface, across), order = spans > 8 ? 4 : 16,
           size = nurbs_surface_size(surface, across), at = 0;
    double nodes[16], weights[16];
    nurbs_status status = nurbs_gauss_legendre(order, nodes, weights);
    *patch = (lengthwise){.surface = surface,
                          .sign = sign,
                          .slack = slack,
                          .along = along,
                          .first = range[0],
                          .last = range[nurbs_surface_size(surface, along)],
                          .n = order * spans + 2,
                          .t = malloc(4 * (order * spans + 2) * sizeof(double))};
    if (!patch->t)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu quadrature points", patch->n);
    patch->weight = patch->t + patch->n;
    patch->ends = patch->weight + patch->n;
    for (size_t k = (size_t)nurbs_surface_degree(surface, across); k < size; k++)
        for (size_t g = 0; g < order && knots[k + 1] > knots[k]; g++, at++) {
            patch->t[at] = knots[k] + (knots[k + 1] - knots[k]) * nodes[g];
            patch->weight[at] = (knots[k + 1] - knots[k]) * weights[g];
        }
    patch->t[at] = knots[0];
    patch->t[at + 1] = knots[size];
    patch->weight[at] = patch->weight[at + 1] = 0;
    double out[9];
    for (size_t k = 0; k < patch->n && status == NURBS_OK; k++)
        for (size_t e = 0; e < 2 && status == NURBS_OK; e++) {
            status = evaluate(patch, e ? patch->last : patch->first, patch->t[k], out);
            patch->ends[2 * k + e] = out[0];
        }
    return status;
}

/* Newton's method kept in a bracket, for x(s,t) = x on line k. `guess` is used when inside, and
 * updated. Returns 0 when the line does not cross, else fills the point and derivatives. */
static int find_crossing(const lengthwise *patch, size_t k, double x, double *guess, double out[9])
{
    double a = patch->first, b = patch->last, from = patch->ends[2 * k] - patch->slack,
           to = patch->ends[2 * k + 1] - patch->slack;
    if ((from <= x) == (to <= x))
        return 0;
    int rising = to > from;
    double s = *guess > a && *guess < b ? *guess : 0.5 * (a + b);
    for (int step = 0; step < 80; step++) {
        if (evaluate(patch, s, patch->t[k], out) != NURBS_OK)
            return 0;
        double f = out[0] - x, slope = out[patch->along ? 6 : 3];
        if ((f < 0) == rising)
            a = s;
        else
            b = s;
        double next = s - f / slope;
        if (!(next > a && next < b))
            next = 0.5 * (a + b);
        if (fabs(next - s) <= 1e-14 * (patch->last - patch->first))
            break;
        s = next;
    }
    *guess = s;
    return 1;
}

/* The integral of 2 y dz over one patch, downwards with the body on the inner side. */
static double patch_section(const lengthwise *patch, double x, double *low)
{
    double area = 0, guess = patch->first, out[9];
    for (size_t k = 0; k < patch->n; k++) {
        if (!find_crossing(patch, k, x, &guess, out))
            continue;
        const double *ds = out + (patch->along ? 6 : 3), *dt = out + (patch->along ? 3 : 6);
        double slip = ds[0] != 0 ? -dt[0] / ds[0] : 0;
        double down = (ds[0] > 0) == patch->along ? 1 : -1;
        area += down * patch->weight[k] * 2 * out[1] * (dt[2] + ds[2] * slip);
        *low = fmin(*low, out[2]);
    }
    return patch->sign * area;
}

static double length_of(size_t n, const nurbs_surface *const *patches)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < n; k++) {
        const double *p = nurbs_surface_points(patches[k]);
        size_t count = nurbs_surface_size(patches[k], 0) * nurbs_surface_size(patches[k], 1);
        for (size_t i = 0; i < count; i++) {
            low = fmin(low, p[3 * i]);
            high = fmax(high, p[3 * i]);
        }
    }
    return high - low;
}

static nurbs_status create_all(size_t n, const nurbs_surface *const *patches, const int *sign,
                               lengthwise **all)
{
    double slack = 1e-9 * length_of(n, patches);
    *all = calloc(n, sizeof **all);
    if (!*all)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < n && status == NURBS_OK; k++)
        status = lengthwise_create(patches[k], sign[k], slack, &(*all)[k]);
    return status;
}

static void free_all(size_t n, lengthwise *all)
{
    for (size_t k = 0; all && k < n; k++)
        free(all[k].t);
    free(all);
}

static double sum_sections(size_t n, const lengthwise *all, double x, double *low)
{
    double area = 0;
    *low = INFINITY;
    for (size_t k = 0; k < n; k++)
        area += patch_section(&all[k], x, low);
    return area;
}

nurbs_status section_area(size_t n, const nurbs_surface *const *patches, const int *sign, double x,
                          double *area, double *low)
{
    lengthwise *all;
    nurbs_status status = create_all(n, patches, sign, &all);
    if (status == NURBS_OK)
        *area = sum_sections(n, all, x, low);
    free_all(n, all);
    return status;
}

nurbs_status section_area_largest(size_t n, const nurbs_surface *const *patches, const int *sign,
                                  double aft, double fore, double *area, double *at)
{
    enum { SAMPLES = 16, STEPS = 24 };
    const double ratio = 0.61803398874989484820;
    lengthwise *all;
    nurbs_status status = create_all(n, patches, sign, &all);
    double low, step = (fore - aft) / SAMPLES;
    *area = 0;
    *at = aft;
    for (int k = 1; k < SAMPLES && status == NURBS_OK; k++) {
        double x = aft + k * step, here = sum_sections(n, all, x, &low);
        if (here > *area) {
            *area = here;
            *at = x;
        }
    }
    /* Golden section: c < d inside a < b, one new area a step. */
    double a = *at - step, b = *at + step, c = b - ratio * (b - a), d = a + ratio * (b - a), ac = 0,
           ad = 0;
    if (status == NURBS_OK) {
        ac = sum_sections(n, all, c, &low);
        ad = sum_sections(n, all, d, &low);
    }
    for (int k = 0; k < STEPS && status == NURBS_OK; k++) {
        if (fmax(ac, ad) > *area) {
            *area = fmax(ac, ad);
            *at = ac > ad ? c : d;
        }
        if (ac > ad) {
            b = d;
            d = c;
            ad = ac;
            c = b - ratio * (b - a);
            ac = sum_sections(n, all, c, &low);
        } else {
            a = c;
            c = d;
            ac = ad;
            d = a + ratio * (b - a);
            ad = sum_sections(n, all, d, &low);
        }
    }
    free_all(n, all);
    return status;
}
