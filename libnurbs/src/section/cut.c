#include "section/cut.h"

#include "core/error.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SCANS_PER_SPAN = 4 };

/* The hull's net in homogeneous form and its v knots scaled to [0,1]; reversed when the sections
 * run upwards. */
static void load_net(cut *sections, int upwards)
{
    size_t nu = sections->size[0], nv = sections->size[1], nk = nv + (size_t)sections->degree[1];
    const double *points = nurbs_surface_points(sections->hull),
                 *weights = nurbs_surface_weights(sections->hull),
                 *knots = nurbs_surface_knots(sections->hull, 1);
    for (size_t i = 0; i < nu; i++)
        for (size_t j = 0; j < nv; j++) {
            size_t from = i * nv + (upwards ? nv - 1 - j : j);
            double w = weights ? weights[from] : 1, *h = sections->net + 4 * (i * nv + j);
            for (size_t c = 0; c < 3; c++)
                h[c] = w * points[3 * from + c];
            h[3] = w;
        }
    sections->slack = 0;
    for (size_t k = 0; k < nu * nv; k++)
        sections->slack = fmax(sections->slack, 1e-13 * fabs(points[3 * k + 2]));
    double first = knots[0], length = knots[nk] - knots[0];
    for (size_t k = 0; k <= nk; k++)
        sections->knots_v[k] =
            upwards ? (knots[nk] - knots[nk - k]) / length : (knots[k] - first) / length;
    for (size_t k = 0; k <= (size_t)sections->degree[1]; k++) {
        sections->knots_v[k] = 0;
        sections->knots_v[nk - k] = 1;
    }
}

/* Mean z of the last control points of all sections against that of the first ones. */
static int runs_upwards(const nurbs_surface *hull)
{
    size_t nu = nurbs_surface_size(hull, 0), nv = nurbs_surface_size(hull, 1);
    const double *points = nurbs_surface_points(hull);
    double rise = 0;
    for (size_t i = 0; i < nu; i++)
        rise += points[3 * (i * nv + nv - 1) + 2] - points[3 * i * nv + 2];
    return rise > 0;
}

nurbs_status cut_create(const nurbs_surface *hull, double level, cut *sections)
{
    size_t nu = nurbs_surface_size(hull, 0), nv = nurbs_surface_size(hull, 1);
    *sections = (cut){.hull = hull, .level = level, .size = {nu, nv}};
    for (int d = 0; d < 2; d++)
        sections->degree[d] = nurbs_surface_degree(hull, d);
    sections->knots_u = nurbs_surface_knots(hull, 0);
    size_t knots = nv + (size_t)sections->degree[1] + 1, scans = SCANS_PER_SPAN * nv + 1;
    sections->knots_v = malloc(knots * sizeof(double));
    sections->net = malloc(4 * nu * nv * sizeof(double));
    sections->polygon = malloc(8 * nv * sizeof(double));
    sections->scan = malloc(scans * sizeof(double));
    if (!sections->knots_v || !sections->net || !sections->polygon || !sections->scan) {
        cut_free(sections);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to cut %zu x %zu control points", nu, nv);
    }
    sections->along = sections->polygon + 4 * nv;
    load_net(sections, runs_upwards(hull));
    double *t = sections->knots_v;
    for (size_t k = (size_t)sections->degree[1]; k < nv; k++)
        for (size_t s = 0; s < SCANS_PER_SPAN && t[k + 1] > t[k]; s++)
            sections->scan[sections->scans++] =
                t[k] + (t[k + 1] - t[k]) * (double)s / SCANS_PER_SPAN;
    sections->scan[sections->scans++] = 1;
    return NURBS_OK;
}

void cut_free(cut *sections)
{
    free(sections->knots_v);
    free(sections->net);
    free(sections->polygon);
    free(sections->scan);
    sections->knots_v = sections->net = sections->polygon = sections->scan = NULL;
}

/* Rows weighted by the basis functions in u: the control polygon of a section or its derivative. */
static void blend_rows(const cut *sections, size_t span, const double *basis, double *polygon)
{
    size_t p = (size_t)sections->degree[0], row = 4 * sections->size[1];
    const double *net = sections->net + (span - p) * row;
    memset(polygon, 0, row * sizeof *polygon);
    for (size_t k = 0; k <= p; k++)
        for (size_t c = 0; c < row; c++)
            polygon[c] += basis[k] * net[k * row + c];
}

/* Homogeneous value and, if wanted, derivative of a section curve at v. */
static void section_value(const cut *sections, const double *polygon, double v, size_t *hint,
                          double value[4], double derivative[4])
{
    int q = sections->degree[1];
    double basis[2 * (NURBS_MAX_DEGREE + 1)];
    size_t span = nurbs_basis_span(q, sections->size[1], sections->knots_v, v, hint);
    if (derivative)
        nurbs_basis_derivatives(q, sections->knots_v, span, v, 1, basis);
    else
        nurbs_basis(q, sections->knots_v, span, v, basis);
    const double *h = polygon + 4 * (span - (size_t)q);
    for (int c = 0; c < 4; c++) {
        value[c] = 0;
        for (int k = 0; k <= q; k++)
            value[c] += basis[k] * h[4 * k + c];
        if (derivative) {
            derivative[c] = 0;
            for (int k = 0; k <= q; k++)
                derivative[c] += basis[q + 1 + k] * h[4 * k + c];
        }
    }
}

/* z - level and its derivative along the section. */
static double height(const cut *sections, double v, size_t *hint, double *slope)
{
    double h[4], d[4];
    section_value(sections, sections->polygon, v, hint, h, slope ? d : NULL);
    if (slope)
        *slope = (d[2] * h[3] - h[2] * d[3]) / (h[3] * h[3]);
    return h[2] / h[3] - sections->level;
}

/* Newton's method inside [above, below], bisection when it leaves the bracket. */
static double refine_crossing(const cut *sections, double above, double below)
{
    size_t hint = 0;
    double v = 0.5 * (above + below);
    if (height(sections, above, &hint, NULL) <= 0)
        return above;
    for (int k = 0; k < 100 && below - above > 0; k++) {
        double slope, f = height(sections, v, &hint, &slope);
        if (f == 0)
            return v;
        if (f > 0)
            above = v;
        else
            below = v;
        double next = v - f / slope;
        if (!(next > above && next < below))
            next = 0.5 * (above + below);
        if (fabs(next - v) < 4e-16)
            return next;
        v = next;
    }
    return v;
}

static cut_kind polygon_kind(const cut *sections)
{
    const double *h = sections->polygon;
    size_t changes = 0;
    int before = h[2] - sections->level * h[3] >= -sections->slack;
    if (!before)
        return CUT_BELOW;
    for (size_t j = 1; j < sections->size[1]; j++) {
        int above = h[4 * j + 2] - sections->level * h[4 * j + 3] >= 0;
        changes += above != before;
        before = above;
    }
    return changes == 0 ? CUT_ABOVE : changes == 1 ? CUT_CROSSES : CUT_SEVERAL;
}

/* The same from points of the curve. */
static cut_kind scan_section(const cut *sections, double *crossing)
{
    size_t changes = 0, at = 0, hint = 0;
    int before = 1;
    for (size_t k = 1; k < sections->scans; k++) {
        int above = height(sections, sections->scan[k], &hint, NULL) >= 0;
        if (above != before) {
            changes++;
            at = k;
        }
        before = above;
    }
    if (changes == 0)
        return CUT_ABOVE;
    if (changes > 1)
        return CUT_SEVERAL;
    *crossing = refine_crossing(sections, sections->scan[at - 1], sections->scan[at]);
    return CUT_CROSSES;
}

cut_kind cut_section(cut *sections, double u, double *crossing)
{
    double basis[NURBS_MAX_DEGREE + 1];
    size_t span =
        nurbs_basis_span(sections->degree[0], sections->size[0], sections->knots_u, u, NULL);
    nurbs_basis(sections->degree[0], sections->knots_u, span, u, basis);
    blend_rows(sections, span, basis, sections->polygon);
    *crossing = 1;
    /* The curve crosses the plane at most as often as its control polygon does. */
    cut_kind kind = polygon_kind(sections);
    if (kind == CUT_CROSSES)
        *crossing = refine_crossing(sections, 0, 1);
    return kind == CUT_SEVERAL ? scan_section(sections, crossing) : kind;
}

static double section_parameter(double crossing, double w)
{
    return w >= 1 ? 1 : crossing + w * (1 - crossing);
}

void cut_points(const cut *sections, double crossing, size_t n, const double *w, double *out)
{
    size_t hint = 0;
    for (size_t k = 0; k < n; k++) {
        double h[4];
        section_value(sections, sections->polygon, section_parameter(crossing, w[k]), &hint, h,
                      NULL);
        for (size_t c = 0; c < 3; c++)
            out[3 * k + c] = h[c] / h[3];
        if (w[k] <= 0)
            out[3 * k + 2] = sections->level;
    }
}

/* S_v and one-sided S_u at v; `along` is the polygon of the derivative with respect to u. */
static void tangents(const cut *sections, const double *along, double v, size_t *hint, double su[3],
                     double sv[3])
{
    double h[4], hv[4], hu[4];
    section_value(sections, sections->polygon, v, hint, h, hv);
    section_value(sections, along, v, hint, hu, NULL);
    for (int c = 0; c < 3; c++) {
        su[c] = (hu[c] - h[c] / h[3] * hu[3]) / h[3];
        sv[c] = (hv[c] - h[c] / h[3] * hv[3]) / h[3];
    }
}

void cut_derivative(cut *sections, double u, cut_side side, double crossing, size_t n,
                    const double *w, double *out)
{
    int p = sections->degree[0];
    size_t order = (size_t)p + 1, hint = 0,
           span = nurbs_basis_span(p, sections->size[0], sections->knots_u, u, NULL);
    while (side == CUT_LEFT && span > (size_t)p && sections->knots_u[span] >= u)
        span--;
    double basis[2 * (NURBS_MAX_DEGREE + 1)], su[3], sv[3];
    double *along = sections->along;
    nurbs_basis_derivatives(p, sections->knots_u, span, u, 1, basis);
    blend_rows(sections, span, basis, sections->polygon);
    blend_rows(sections, span, basis + order, along);
    tangents(sections, along, crossing, &hint, su, sv);
    double drift = sv[2] != 0 ? -su[2] / sv[2] : 0;
    for (size_t k = 0; k < n; k++) {
        tangents(sections, along, section_parameter(crossing, w[k]), &hint, su, sv);
        for (size_t c = 0; c < 3; c++)
            out[3 * k + c] = su[c] + sv[c] * drift * (1 - w[k]);
    }
}

double cut_profile(const cut *sections, double u)
{
    double basis[NURBS_MAX_DEGREE + 1], z = 0, weight = 0;
    size_t p = (size_t)sections->degree[0], nv = sections->size[1],
           span =
               nurbs_basis_span(sections->degree[0], sections->size[0], sections->knots_u, u, NULL);
    nurbs_basis(sections->degree[0], sections->knots_u, span, u, basis);
    for (size_t k = 0; k <= p; k++) {
        const double *h = sections->net + 4 * ((span - p + k + 1) * nv - 1);
        z += basis[k] * h[2];
        weight += basis[k] * h[3];
    }
    return z / weight - sections->level;
}
