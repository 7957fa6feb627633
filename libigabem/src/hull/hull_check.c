/* What a hull must not have: points above the water, points across the centre plane, folds, normals
 * that vanish. Every refusal says where. */
#include "core/error.h"
#include "hull/hull.h"

#include <nurbs/section.h>

#include <math.h>
#include <stdlib.h>

enum { SPLITS = 4 /* sample intervals per knot span */ };

static const double CLEARANCE = 1e-6;       /* of the extent: above z = 0, across y = 0 */
static const double SUBMERGENCE = 1e-4;     /* of the extent: least depth of a closed body */
static const double NORMAL_FRACTION = 1e-8; /* of the patch's mean area element */

/* Ends and SPLITS-1 interior points of every span. Creates *at. */
static size_t sample_points(const struct hull_patch *patch, int direction, double **at)
{
    int degree = nurbs_surface_degree(patch->surface, direction);
    size_t size = nurbs_surface_size(patch->surface, direction), n = 0;
    const double *knots = nurbs_surface_knots(patch->surface, direction);
    *at = malloc((size * SPLITS + 1) * sizeof **at);
    if (!*at)
        return 0;
    for (size_t s = (size_t)degree; s < size; s++) {
        double h = knots[s + 1] - knots[s];
        for (int i = 0; h > 0 && i < SPLITS; i++)
            (*at)[n++] = knots[s] + h * i / SPLITS;
    }
    (*at)[n++] = patch->domain[direction][1];
    return n;
}

static igabem_status check_positions(const struct igabem_hull *hull, size_t p, size_t nu,
                                     const double *u, size_t nv, const double *v,
                                     const double *triples)
{
    double clearance = CLEARANCE * hull->extent;
    for (size_t k = 0; k < nu * nv; k++) {
        const double *s = triples + 9 * k;
        double at_u = u[k / nv], at_v = v[k % nv];
        if (!isfinite(s[0]) || !isfinite(s[1]) || !isfinite(s[2]))
            return igabem_fail(IGABEM_ERROR_GEOMETRY,
                               "patch %zu: no finite point at u = %.6g, v = %.6g", p, at_u, at_v);
        if (s[2] > clearance)
            return igabem_fail(IGABEM_ERROR_GEOMETRY,
                               "patch %zu: (%.6g, %.6g, %.6g) at u = %.6g, v = %.6g lies %.3g m "
                               "above the still water, expected a hull cut at z = 0",
                               p, s[0], s[1], s[2], at_u, at_v, s[2]);
        if (hull->symmetric && s[1] < -clearance)
            return igabem_fail(IGABEM_ERROR_GEOMETRY,
                               "patch %zu: (%.6g, %.6g, %.6g) at u = %.6g, v = %.6g lies across "
                               "the centre plane, expected y >= 0 on a half hull",
                               p, s[0], s[1], s[2], at_u, at_v);
    }
    return IGABEM_OK;
}

static igabem_status check_normals(const struct igabem_hull *hull, size_t p, size_t nu,
                                   const double *u, size_t nv, const double *v,
                                   const double *triples)
{
    const struct hull_patch *patch = &hull->patches[p];
    double mean = 0.0, normal[3], area;
    for (size_t k = 0; k < nu * nv; k++) {
        hull_normal(patch, triples + 9 * k, normal, &area);
        mean += area / (double)(nu * nv);
    }
    for (size_t i = 1; i + 1 < nu; i++)
        for (size_t j = 1; j + 1 < nv; j++) {
            const double *s = triples + 9 * (i * nv + j);
            hull_normal(patch, s, normal, &area);
            if (!(area > NORMAL_FRACTION * mean))
                return igabem_fail(IGABEM_ERROR_GEOMETRY,
                                   "patch %zu: the normal vanishes at u = %.6g, v = %.6g, point "
                                   "(%.6g, %.6g, %.6g)",
                                   p, u[i], v[j], s[0], s[1], s[2]);
        }
    return IGABEM_OK;
}

static igabem_status check_fold(const struct igabem_hull *hull, size_t p)
{
    double uv[2] = {0, 0}, at[3] = {0, 0, 0};
    nurbs_status status = nurbs_surface_check_fold(hull->patches[p].surface, uv);
    if (!status)
        return IGABEM_OK;
    if (status != NURBS_ERROR_GEOMETRY)
        return hull_nurbs_fail(status, "looking for folds");
    if (nurbs_surface_eval(hull->patches[p].surface, 0, 1, uv, at))
        return hull_nurbs_fail(status, "looking for folds");
    return igabem_fail(IGABEM_ERROR_GEOMETRY,
                       "patch %zu is folded at u = %.6g, v = %.6g, point (%.6g, %.6g, %.6g)", p,
                       uv[0], uv[1], at[0], at[1], at[2]);
}

/* Bounds of hull and patch, from the samples. */
static void widen(struct igabem_hull *hull, struct hull_patch *patch, size_t n,
                  const double *triples)
{
    patch->side[0] = INFINITY;
    patch->side[1] = -INFINITY;
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 3; k++) {
            double at = triples[9 * i + (size_t)k];
            hull->lower[k] = fmin(hull->lower[k], at);
            hull->upper[k] = fmax(hull->upper[k], at);
            patch->side[0] = k == 1 ? fmin(patch->side[0], at) : patch->side[0];
            patch->side[1] = k == 1 ? fmax(patch->side[1], at) : patch->side[1];
        }
}

static igabem_status check_patch(struct igabem_hull *hull, size_t p)
{
    struct hull_patch *patch = &hull->patches[p];
    double *u = NULL, *v = NULL, *triples = NULL;
    size_t nu = sample_points(patch, 0, &u), nv = sample_points(patch, 1, &v);
    igabem_status status = IGABEM_OK;
    if (nu && nv)
        triples = malloc(nu * nv * 9 * sizeof *triples);
    if (!triples) {
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory to check patch %zu", p);
    } else {
        nurbs_status evaluated = nurbs_surface_eval_grid(patch->surface, 1, nu, u, nv, v, triples);
        if (evaluated)
            status = hull_nurbs_fail(evaluated, "checking a patch");
    }
    if (!status)
        widen(hull, patch, nu * nv, triples);
    if (!status)
        status = check_positions(hull, p, nu, u, nv, v, triples);
    if (!status)
        status = check_normals(hull, p, nu, u, nv, v, triples);
    if (!status)
        status = check_fold(hull, p);
    free(u);
    free(v);
    free(triples);
    return status;
}

igabem_status hull_check(struct igabem_hull *hull)
{
    for (size_t p = 0; p < hull->n; p++) {
        igabem_status status = check_patch(hull, p);
        if (status)
            return status;
    }
    return IGABEM_OK;
}

igabem_status hull_check_submergence(const struct igabem_hull *hull)
{
    if (!hull->surface_piercing && hull->upper[2] > -SUBMERGENCE * hull->extent)
        return igabem_fail(IGABEM_ERROR_GEOMETRY,
                           "the body comes within %.3g m of the still water but no edge lies on "
                           "it, expected an edge in z = 0 or a depth of at least %.3g m",
                           fmax(0.0, -hull->upper[2]), SUBMERGENCE * hull->extent);
    return IGABEM_OK;
}
