/* Which way the patches face, and what each of their edges is. */
#include "error.h"
#include "hull.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    EDGE_SAMPLES = 65, /* points of the polyline that stands for an edge when edges are matched */
    ORIENT_GAUSS = 4
};

/* Relative to the extent of the body. */
static const double PLANE_TOLERANCE = 1e-6; /* an edge this close to a plane lies in it */
static const double JOIN_TOLERANCE = 1e-4;  /* and this close to another edge is shared with it */
static const double TRANSOM_REACH = 0.05; /* an open edge this close to the aft end is a transom */

/* Gauss nodes over all knot spans of one direction. Creates *nodes and *weights. */
static int span_rule(const struct hull_patch *patch, int direction, size_t points, size_t *n,
                     double **nodes, double **weights)
{
    int degree = nurbs_surface_degree(patch->surface, direction);
    size_t size = nurbs_surface_size(patch->surface, direction);
    const double *knots = nurbs_surface_knots(patch->surface, direction);
    double x[64], w[64];
    *nodes = malloc(size * points * sizeof **nodes);
    *weights = malloc(size * points * sizeof **weights);
    *n = 0;
    if (!*nodes || !*weights || nurbs_gauss_legendre(points, x, w))
        return 0;
    for (size_t s = (size_t)degree; s < size; s++) {
        double a = knots[s], h = knots[s + 1] - knots[s];
        for (size_t i = 0; h > 0 && i < points; i++) {
            (*nodes)[*n] = a + h * x[i];
            (*weights)[(*n)++] = h * w[i];
        }
    }
    return 1;
}

/* The moments Int n_k (p_k - c_k) dS of a patch with its raw normal, and its bounding box. */
static igabem_status patch_flux(const struct hull_patch *patch, const double centre[3],
                                double flux[3], double lower[3], double upper[3])
{
    size_t nu, nv;
    double *u = NULL, *wu = NULL, *v = NULL, *wv = NULL, *out = NULL;
    igabem_status status = IGABEM_OK;
    if (!span_rule(patch, 0, ORIENT_GAUSS, &nu, &u, &wu) ||
        !span_rule(patch, 1, ORIENT_GAUSS, &nv, &v, &wv) ||
        !(out = malloc(nu * nv * 9 * sizeof *out))) {
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory to sample a patch");
        goto done;
    }
    nurbs_status evaluated = nurbs_surface_eval_grid(patch->surface, 1, nu, u, nv, v, out);
    if (evaluated) {
        status = hull_nurbs_fail(evaluated, "sampling a patch");
        goto done;
    }
    for (size_t i = 0; i < nu; i++)
        for (size_t j = 0; j < nv; j++) {
            const double *s = out + 9 * (i * nv + j);
            double normal[3], area;
            hull_normal(patch, s, normal, &area);
            for (int k = 0; k < 3; k++) {
                flux[k] += wu[i] * wv[j] * area * normal[k] * (s[k] - centre[k]);
                lower[k] = fmin(lower[k], s[k]);
                upper[k] = fmax(upper[k], s[k]);
            }
        }
done:
    free(u);
    free(wu);
    free(v);
    free(wv);
    free(out);
    return status;
}

static igabem_status bounding_box(struct igabem_hull *hull)
{
    static const double corners[4][2] = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
    const double origin[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        hull->lower[k] = INFINITY;
        hull->upper[k] = -INFINITY;
    }
    for (size_t p = 0; p < hull->n; p++) {
        double flux[3] = {0, 0, 0};
        igabem_status status =
            patch_flux(&hull->patches[p], origin, flux, hull->lower, hull->upper);
        if (status)
            return status;
        for (int c = 0; c < 4; c++) {
            const struct hull_patch *patch = &hull->patches[p];
            double uv[2] = {patch->domain[0][corners[c][0] > 0],
                            patch->domain[1][corners[c][1] > 0]};
            double at[3];
            nurbs_status evaluated = nurbs_surface_eval(patch->surface, 0, 1, uv, at);
            if (evaluated)
                return hull_nurbs_fail(evaluated, "a corner of a patch");
            for (int k = 0; k < 3; k++) {
                hull->lower[k] = fmin(hull->lower[k], at[k]);
                hull->upper[k] = fmax(hull->upper[k], at[k]);
            }
        }
    }
    hull->extent = hull->upper[0] - hull->lower[0];
    if (!(hull->extent > 0) || !isfinite(hull->extent))
        return igabem_fail(IGABEM_ERROR_GEOMETRY,
                           "the patches extend from x = %g to %g m, expected a positive length",
                           hull->lower[0], hull->upper[0]);
    return IGABEM_OK;
}

/* Outwards is where the flux of the position vector is positive. The y flux decides for the side of
 * a half hull (its closing planes y = 0 and z = 0 add nothing to it); a bottom, deck or transom
 * face that has next to none is decided by z, then x, about the middle of the body. */
igabem_status hull_orient(struct igabem_hull *hull)
{
    igabem_status status = bounding_box(hull);
    if (status)
        return status;
    double centre[3];
    for (int k = 0; k < 3; k++)
        centre[k] = 0.5 * (hull->lower[k] + hull->upper[k]);
    if (hull->symmetric)
        centre[1] = 0.0;
    if (hull->upper[2] > -PLANE_TOLERANCE * hull->extent)
        centre[2] = 0.0;
    for (size_t p = 0; p < hull->n; p++) {
        struct hull_patch *patch = &hull->patches[p];
        double flux[3] = {0, 0, 0}, lower[3] = {0, 0, 0}, upper[3] = {0, 0, 0};
        status = patch_flux(patch, centre, flux, lower, upper);
        if (status)
            return status;
        double largest = fmax(fabs(flux[0]), fmax(fabs(flux[1]), fabs(flux[2])));
        if (!(largest > 0))
            return igabem_fail(IGABEM_ERROR_GEOMETRY, "patch %zu has no area, expected a surface",
                               p);
        double deciding = fabs(flux[1]) > 0.05 * largest   ? flux[1]
                          : fabs(flux[2]) > 0.05 * largest ? flux[2]
                                                           : flux[0];
        patch->sign = deciding < 0 ? -1.0 : 1.0;
    }
    return IGABEM_OK;
}

struct edge_points {
    double at[EDGE_SAMPLES][3];
};

static igabem_status sample_edges(const struct igabem_hull *hull, struct edge_points *edges)
{
    for (size_t p = 0; p < hull->n; p++)
        for (int e = 0; e < HULL_EDGES; e++) {
            double uv[EDGE_SAMPLES][2];
            for (int i = 0; i < EDGE_SAMPLES; i++)
                hull_edge_parameters(&hull->patches[p], e, i / (EDGE_SAMPLES - 1.0), uv[i]);
            nurbs_status status =
                nurbs_surface_eval(hull->patches[p].surface, 0, EDGE_SAMPLES, uv[0],
                                   edges[p * HULL_EDGES + (size_t)e].at[0]);
            if (status)
                return hull_nurbs_fail(status, "an edge of a patch");
        }
    return IGABEM_OK;
}

/* Largest |coordinate| along an edge. */
static double farthest(const struct edge_points *edge, int coordinate)
{
    double largest = 0.0;
    for (int i = 0; i < EDGE_SAMPLES; i++)
        largest = fmax(largest, fabs(edge->at[i][coordinate]));
    return largest;
}

static double edge_size(const struct edge_points *edge)
{
    double size = 0.0;
    for (int i = 1; i < EDGE_SAMPLES; i++)
        for (int k = 0; k < 3; k++)
            size = fmax(size, fabs(edge->at[i][k] - edge->at[0][k]));
    return size;
}

static double point_segment(const double p[3], const double a[3], const double b[3])
{
    double along = 0, length = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        along += (p[k] - a[k]) * (b[k] - a[k]);
        length += (b[k] - a[k]) * (b[k] - a[k]);
    }
    double t = length > 0 ? fmin(1.0, fmax(0.0, along / length)) : 0.0;
    for (int k = 0; k < 3; k++) {
        double d = p[k] - a[k] - t * (b[k] - a[k]);
        square += d * d;
    }
    return sqrt(square);
}

/* Index of the first sample of an edge that no other edge comes near, or -1. */
static int first_unshared(const struct igabem_hull *hull, const struct edge_points *edges,
                          size_t which, double tolerance)
{
    for (int i = 0; i < EDGE_SAMPLES; i++) {
        int shared = 0;
        for (size_t other = 0; !shared && other < hull->n * HULL_EDGES; other++) {
            const struct edge_points *o = &edges[other];
            if (other == which ||
                hull->patches[other / HULL_EDGES].edge[other % HULL_EDGES] == HULL_EDGE_COLLAPSED)
                continue;
            for (int j = 0; !shared && j + 1 < EDGE_SAMPLES; j++)
                shared = point_segment(edges[which].at[i], o->at[j], o->at[j + 1]) <= tolerance;
        }
        if (!shared)
            return i;
    }
    return -1;
}

static igabem_status settle_free_edge(struct igabem_hull *hull, const struct edge_points *edges,
                                      size_t which)
{
    static const char *const names[HULL_EDGES] = {"u first", "u last", "v first", "v last"};
    const struct edge_points *edge = &edges[which];
    struct hull_patch *patch = &hull->patches[which / HULL_EDGES];
    /* Ends of an edge always touch the neighbouring edges: look at the middle as well. */
    int loose = first_unshared(hull, edges, which, JOIN_TOLERANCE * hull->extent);
    if (loose < 0) {
        patch->edge[which % HULL_EDGES] = HULL_EDGE_JOINED;
        return IGABEM_OK;
    }
    double foremost = -INFINITY;
    for (int i = 0; i < EDGE_SAMPLES; i++)
        foremost = fmax(foremost, edge->at[i][0]);
    if (foremost > hull->lower[0] + TRANSOM_REACH * hull->extent)
        return igabem_fail(
            IGABEM_ERROR_GEOMETRY,
            "patch %zu, edge %s: open at (%.6g, %.6g, %.6g): off y = 0 by up to %.2g m, off z = 0 "
            "by up to %.2g m, shared with no other edge and not at the stern",
            which / HULL_EDGES, names[which % HULL_EDGES], edge->at[loose][0], edge->at[loose][1],
            edge->at[loose][2], farthest(edge, 1), farthest(edge, 2));
    patch->edge[which % HULL_EDGES] = HULL_EDGE_OPEN;
    hull->transom = 1;
    return IGABEM_OK;
}

igabem_status hull_classify_edges(struct igabem_hull *hull)
{
    size_t n = hull->n * HULL_EDGES;
    struct edge_points *edges = malloc(n * sizeof *edges);
    if (!edges)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu edges", n);
    igabem_status status = sample_edges(hull, edges);
    double tolerance = PLANE_TOLERANCE * hull->extent;
    for (size_t e = 0; !status && e < n; e++) {
        enum hull_edge *kind = &hull->patches[e / HULL_EDGES].edge[e % HULL_EDGES];
        if (edge_size(&edges[e]) <= tolerance)
            *kind = HULL_EDGE_COLLAPSED;
        else if (farthest(&edges[e], 2) <= tolerance)
            *kind = HULL_EDGE_WATERLINE;
        else if (hull->symmetric && farthest(&edges[e], 1) <= tolerance)
            *kind = HULL_EDGE_CENTRE;
        else
            *kind = HULL_EDGE_OPEN;
        if (*kind == HULL_EDGE_WATERLINE)
            hull->surface_piercing = 1;
    }
    for (size_t e = 0; !status && e < n; e++)
        if (hull->patches[e / HULL_EDGES].edge[e % HULL_EDGES] == HULL_EDGE_OPEN)
            status = settle_free_edge(hull, edges, e);
    free(edges);
    return status;
}
