/* Sectional areas of a hull, by triangles: overhangs, bulbs ahead of the stem and any number of
 * patches are no special cases. */
#include "core/error.h"
#include "hull/hull.h"
#include "hydrostatics/hydro_parts.h"

#include <nurbs/particulars.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Divisions of a knot span, of a direction at least: the area between chords and a parabola of n
 * divisions is 1/n^2 of the whole. */
enum { SPAN_PARTS = 12, LEAST_PARTS = 256 };

/* Parameters that divide the knot spans of one direction alike; at may be NULL. Returns how many.
 */
static size_t fine_parameters(const nurbs_surface *surface, int d, double *at)
{
    size_t size = nurbs_surface_size(surface, d), n = 0, spans = 0, parts;
    size_t degree = (size_t)nurbs_surface_degree(surface, d);
    const double *knots = nurbs_surface_knots(surface, d);
    for (size_t s = degree; s < size; s++)
        spans += knots[s + 1] > knots[s];
    parts = (LEAST_PARTS + spans - 1) / spans;
    parts = parts < SPAN_PARTS ? SPAN_PARTS : parts;
    for (size_t s = degree; s < size; s++)
        for (size_t i = 0; knots[s + 1] > knots[s] && i < parts; i++, n++)
            if (at)
                at[n] = knots[s] + (knots[s + 1] - knots[s]) * (double)i / (double)parts;
    if (at)
        at[n] = knots[size];
    return n + 1;
}

/* Where the plane x = station meets an edge of a triangle; returns 1, or 0 if it does not. */
static int crossing(const double a[3], const double b[3], double station, double yz[2])
{
    if ((a[0] <= station) == (b[0] <= station))
        return 0;
    double s = (station - a[0]) / (b[0] - a[0]);
    yz[0] = a[1] + s * (b[1] - a[1]);
    yz[1] = a[2] + s * (b[2] - a[2]);
    return 1;
}

/* Adds the signed area y dz that the section through one triangle bounds with the centre plane; the
 * sign follows the orientation of the triangle, so that overhangs subtract. */
static void slice(const double a[3], const double b[3], const double c[3], size_t n,
                  const double *x, double *area)
{
    double low = fmin(a[0], fmin(b[0], c[0])), high = fmax(a[0], fmax(b[0], c[0]));
    /* The section of a surface with normal n runs along n x e_x = (0, n_z, -n_y): dz ~ n_y. */
    double ny = (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]);
    for (size_t i = 0; i < n; i++) {
        if (x[i] < low || x[i] > high)
            continue;
        double p[3][2];
        int k = crossing(a, b, x[i], p[0]);
        k += crossing(b, c, x[i], p[k]);
        if (k < 2)
            k += crossing(c, a, x[i], p[k]);
        if (k == 2)
            area[i] += 0.5 * fabs(p[0][1] - p[1][1]) * (p[0][0] + p[1][0]) * (ny > 0 ? 1.0 : -1.0);
    }
}

/* Adds `share` of the areas of one patch; part[n] is scratch. */
static nurbs_status add_patch(const nurbs_surface *surface, double share, size_t n, const double *x,
                              double *part, double *area)
{
    size_t nu = fine_parameters(surface, 0, NULL), nv = fine_parameters(surface, 1, NULL);
    double *u = malloc((nu + nv + 3 * nu * nv) * sizeof *u);
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for sections of %zu points", nu * nv);
    double *v = u + nu, *xyz = v + nv;
    fine_parameters(surface, 0, u);
    fine_parameters(surface, 1, v);
    memset(part, 0, n * sizeof *part);
    nurbs_status status = nurbs_surface_eval_grid(surface, 0, nu, u, nv, v, xyz);
    for (size_t i = 0; !status && i + 1 < nu; i++)
        for (size_t j = 0; j + 1 < nv; j++) {
            const double *a = xyz + 3 * (i * nv + j), *b = a + 3 * nv, *c = b + 3, *d = a + 3;
            slice(a, b, c, n, x, part);
            slice(a, c, d, n, x, part);
        }
    free(u);
    for (size_t i = 0; !status && i < n; i++)
        area[i] += share * part[i];
    return status;
}

nurbs_status nurbs_hull_section_areas(const nurbs_hull *hull, size_t n, const double *x,
                                      double *area)
{
    if (!hull || (n && (!x || !area)))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "hull, places or areas are NULL");
    for (size_t i = 0; i < n; i++)
        if (!isfinite(x[i]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "section %zu lies at x = %g", i, x[i]);
    size_t patches = nurbs_patches_count(hull->light);
    const nurbs_surface **list = malloc((patches + 1) * sizeof(const nurbs_surface *));
    double *part = malloc((n + 1) * sizeof *part);
    int *sign = malloc((patches + 1) * sizeof *sign);
    nurbs_status status = list && part && sign
                              ? NURBS_OK
                              : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu sections", n);
    for (size_t k = 0; k < patches && !status; k++)
        list[k] = nurbs_patches_get(hull->light, k);
    if (!status)
        status = outward_signs(patches, list, 0, sign);
    for (size_t i = 0; i < n && !status; i++)
        area[i] = 0;
    /* Both sides: the other one of a half is its mirror image. */
    for (size_t k = 0; k < patches && !status; k++)
        status = add_patch(list[k], sign[k] * (hull->half ? 2.0 : 1.0), n, x, part, area);
    free(list);
    free(part);
    free(sign);
    return status;
}
