/* Sectional areas of a hull, by triangles: overhangs, bulbs ahead of the stem and any number of
 * patches are no special cases. */
#include "core/error.h"
#include "hull/hull.h"

#include <nurbs/particulars.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FINE = 12 /* divisions of a knot span */ };

/* Parameters that divide every knot span of one direction in FINE parts; at may be NULL. Returns
 * how many. */
static size_t fine_parameters(const nurbs_surface *surface, int d, double *at)
{
    size_t size = nurbs_surface_size(surface, d), n = 0;
    size_t degree = (size_t)nurbs_surface_degree(surface, d);
    const double *knots = nurbs_surface_knots(surface, d);
    for (size_t s = degree; s < size; s++)
        for (int i = 0; knots[s + 1] > knots[s] && i < FINE; i++, n++)
            if (at)
                at[n] = knots[s] + (knots[s + 1] - knots[s]) * i / FINE;
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

/* Adds twice the areas of one patch; part[n] is scratch. */
static nurbs_status add_patch(const nurbs_surface *surface, size_t n, const double *x, double *part,
                              double *area)
{
    size_t nu = fine_parameters(surface, 0, NULL), nv = fine_parameters(surface, 1, NULL);
    double *u = malloc((nu + nv + 3 * nu * nv) * sizeof *u);
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for sections of %zu points", nu * nv);
    double *v = u + nu, *xyz = v + nv, total = 0;
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
    /* The sign of the patch's own orientation: the areas of a hull are positive. */
    for (size_t i = 0; i < n; i++)
        total += part[i];
    for (size_t i = 0; !status && i < n; i++)
        area[i] += 2.0 * (total < 0 ? -part[i] : part[i]);
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
    double *part = malloc((n + 1) * sizeof *part);
    if (!part)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu sections", n);
    memset(area, 0, n * sizeof *area);
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < nurbs_patches_count(hull->light) && !status; k++)
        status = add_patch(nurbs_patches_get(hull->light, k), n, x, part, area);
    free(part);
    return status;
}
