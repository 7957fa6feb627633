/* Where the hull lies, how its patches meet, and which way they face. */
#include "core/error.h"
#include "hull/hull.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>

enum { ORIENT_GAUSS = 4 };

static const double JOIN_TOLERANCE = 1e-4; /* of the extent */
static const double LEAST_VOLUME = 1e-9;   /* of extent times area: less is none */
static const double SHORT_JOINT = 0.02;    /* of the shorter edge */
static const double MINOR_JOINT = 0.05;    /* of the shorter edge, as nurbs_topology_orient() */

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

/* Integrals over a patch with its raw normal n, and its bounding box. */
struct patch_flux {
    double area;
    double normal[3];          /* Int n dS */
    double volume;             /* Int (y n_y + z n_z) dS */
    double lower[3], upper[3]; /* of the quadrature points */
};

static void add_point(const struct hull_patch *patch, const double triples[9], double weight,
                      struct patch_flux *flux)
{
    double normal[3], area;
    hull_normal(patch, triples, normal, &area);
    area *= weight;
    flux->area += area;
    flux->volume += area * (normal[1] * triples[1] + normal[2] * triples[2]);
    for (int k = 0; k < 3; k++) {
        flux->normal[k] += area * normal[k];
        flux->lower[k] = fmin(flux->lower[k], triples[k]);
        flux->upper[k] = fmax(flux->upper[k], triples[k]);
    }
}

static igabem_status find_flux(const struct hull_patch *patch, struct patch_flux *flux)
{
    size_t nu, nv;
    double *u = NULL, *wu = NULL, *v = NULL, *wv = NULL, *out = NULL;
    igabem_status status = IGABEM_OK;
    *flux = (struct patch_flux){.lower = {INFINITY, INFINITY, INFINITY},
                                .upper = {-INFINITY, -INFINITY, -INFINITY}};
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
        for (size_t j = 0; j < nv; j++)
            add_point(patch, out + 9 * (i * nv + j), wu[i] * wv[j], flux);
done:
    free(u);
    free(wu);
    free(v);
    free(wv);
    free(out);
    return status;
}

static igabem_status add_corners(const struct hull_patch *patch, struct patch_flux *flux)
{
    for (int corner = 0; corner < 4; corner++) {
        const double uv[2] = {patch->domain[0][corner / 2], patch->domain[1][corner % 2]};
        double at[3];
        nurbs_status evaluated = nurbs_surface_eval(patch->surface, 0, 1, uv, at);
        if (evaluated)
            return hull_nurbs_fail(evaluated, "a corner of a patch");
        for (int k = 0; k < 3; k++) {
            flux->lower[k] = fmin(flux->lower[k], at[k]);
            flux->upper[k] = fmax(flux->upper[k], at[k]);
        }
    }
    return IGABEM_OK;
}

igabem_status hull_bounds(struct igabem_hull *hull)
{
    for (int k = 0; k < 3; k++) {
        hull->lower[k] = INFINITY;
        hull->upper[k] = -INFINITY;
    }
    for (size_t p = 0; p < hull->n; p++) {
        struct hull_patch *patch = &hull->patches[p];
        struct patch_flux flux;
        igabem_status status = find_flux(patch, &flux);
        if (!status)
            status = add_corners(patch, &flux);
        if (status)
            return status;
        if (!(flux.area > 0))
            return igabem_fail(IGABEM_ERROR_GEOMETRY, "patch %zu has no area, expected a surface",
                               p);
        patch->side[0] = flux.lower[1];
        patch->side[1] = flux.upper[1];
        for (int k = 0; k < 3; k++) {
            hull->lower[k] = fmin(hull->lower[k], flux.lower[k]);
            hull->upper[k] = fmax(hull->upper[k], flux.upper[k]);
        }
    }
    hull->extent = hull->upper[0] - hull->lower[0];
    if (!(hull->extent > 0) || !isfinite(hull->extent))
        return igabem_fail(IGABEM_ERROR_GEOMETRY,
                           "the patches extend from x = %g to %g m, expected a positive length",
                           hull->lower[0], hull->upper[0]);
    return IGABEM_OK;
}

double hull_join_tolerance(const struct igabem_hull *hull)
{
    return JOIN_TOLERANCE * hull->extent;
}

igabem_status hull_topology(const struct igabem_hull *hull, nurbs_topology *topology)
{
    nurbs_patches *list;
    *topology = (nurbs_topology){0};
    if (hull->n == 1)
        return IGABEM_OK;
    nurbs_status status = nurbs_patches_create(&list);
    for (size_t p = 0; p < hull->n && !status; p++)
        status = nurbs_patches_add(list, hull->patches[p].surface);
    if (!status)
        status = nurbs_patches_topology(list, hull_join_tolerance(hull), topology);
    nurbs_patches_free(list);
    return status ? hull_nurbs_fail(status, "how the patches meet") : IGABEM_OK;
}

/* Joints within either side. Both sides meet in the centre plane, where more than two patches may
 * run together. */
static size_t joints_within_sides(const struct igabem_hull *hull, const nurbs_topology *topology,
                                  nurbs_joint *joint)
{
    size_t n = 0;
    for (size_t j = 0; j < topology->joints; j++) {
        const nurbs_joint *from = &topology->joint[j];
        if (hull_same_side(&hull->patches[from->edge[0] / 4], &hull->patches[from->edge[1] / 4]))
            joint[n++] = *from;
    }
    return n;
}

/* Signs relative to the first patch of each connected part. */
static igabem_status relative_signs(const struct igabem_hull *hull, const nurbs_topology *topology,
                                    int *sign, size_t *part, size_t *parts)
{
    sign[0] = 1;
    part[0] = 0;
    *parts = 1;
    if (hull->n == 1)
        return IGABEM_OK;
    nurbs_topology sides = *topology;
    sides.joint = malloc((topology->joints + 1) * sizeof *sides.joint);
    if (!sides.joint)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu shared edges", topology->joints);
    sides.joints = joints_within_sides(hull, topology, sides.joint);
    nurbs_status status = nurbs_topology_orient(&sides, sign, part, parts);
    free(sides.joint);
    return status ? hull_nurbs_fail(status, "orientation") : IGABEM_OK;
}

/* A connected part closes at y = 0 and z = 0, where (0, y, z) has no normal component: outwards its
 * flux is twice the volume. Far below the water it closes without them, and z counts from its top:
 * errors of quadrature grow with the depth. */
static igabem_status turn_outwards(struct igabem_hull *hull, const int *sign, const size_t *part,
                                   size_t parts)
{
    double *volume = calloc(2 * parts, sizeof *volume), *area = volume + parts;
    if (!volume)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu parts", parts);
    igabem_status status = IGABEM_OK;
    double level = -hull->upper[2] > hull->upper[2] - hull->lower[2] ? hull->upper[2] : 0.0;
    for (size_t p = 0; p < hull->n && !status; p++) {
        struct patch_flux flux;
        status = find_flux(&hull->patches[p], &flux);
        volume[part[p]] += sign[p] * (flux.volume - level * flux.normal[2]);
        area[part[p]] += flux.area;
    }
    for (size_t p = 0; p < hull->n && !status; p++) {
        double enclosed = volume[part[p]];
        if (!(fabs(enclosed) > LEAST_VOLUME * hull->extent * area[part[p]]))
            status = igabem_fail(IGABEM_ERROR_GEOMETRY,
                                 "patch %zu and those joined to it enclose no volume with y = 0 "
                                 "and z = 0: is a patch given twice?",
                                 p);
        hull->patches[p].sign = enclosed < 0 ? -sign[p] : sign[p];
    }
    free(volume);
    return status;
}

igabem_status hull_orient(struct igabem_hull *hull, const nurbs_topology *topology)
{
    size_t parts, *part = malloc(hull->n * sizeof *part);
    int *sign = malloc(hull->n * sizeof *sign);
    igabem_status status =
        part && sign ? relative_signs(hull, topology, sign, part, &parts)
                     : igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu patches", hull->n);
    if (!status)
        status = turn_outwards(hull, sign, part, parts);
    if (!status)
        status = hull_check_overlap(hull, part, parts);
    free(part);
    free(sign);
    return status;
}

static double overlap(const nurbs_joint *a, int end_a, const nurbs_joint *b, int end_b)
{
    double from = fmax(fmin(a->from[end_a], a->to[end_a]), fmin(b->from[end_b], b->to[end_b]));
    double to = fmin(fmax(a->from[end_a], a->to[end_a]), fmax(b->from[end_b], b->to[end_b]));
    return to - from;
}

/* Edges that part at a small angle, the sides of a narrow face, run together for a while. */
static int is_minor(const nurbs_topology *topology, const nurbs_joint *joint)
{
    return joint->length < MINOR_JOINT * fmin(topology->edge[joint->edge[0]].length,
                                              topology->edge[joint->edge[1]].length);
}

/* An edge belongs to two patches at most; that of a third one, or one in the water plane, comes of
 * patches that overlap. */
static igabem_status check_edge(const struct igabem_hull *hull, const nurbs_topology *topology,
                                size_t e, const nurbs_joint *joint, size_t joints)
{
    const nurbs_edge *edge = &topology->edge[e];
    const struct hull_patch *patch = &hull->patches[edge->patch];
    double range = edge->range[1] - edge->range[0];
    for (size_t j = 0; j < joints; j++) {
        int at = joint[j].edge[1] == e;
        if (joint[j].edge[at] != e || joint[j].length < SHORT_JOINT * edge->length)
            continue;
        size_t other = joint[j].edge[!at] / 4;
        if (patch->edge[edge->side] == HULL_EDGE_WATERLINE &&
            hull->patches[other].edge[joint[j].edge[!at] % 4] == HULL_EDGE_WATERLINE)
            return igabem_fail(IGABEM_ERROR_GEOMETRY,
                               "patches %zu and %zu share the waterline at (%.6g, %.6g, %.6g): do "
                               "they overlap?",
                               edge->patch, other, joint[j].at[0], joint[j].at[1], joint[j].at[2]);
        for (size_t k = j + 1; k < joints && !is_minor(topology, &joint[j]); k++) {
            int also = joint[k].edge[1] == e;
            if (joint[k].edge[also] == e && !is_minor(topology, &joint[k]) &&
                overlap(&joint[j], at, &joint[k], also) > SHORT_JOINT * range)
                return igabem_fail(IGABEM_ERROR_GEOMETRY,
                                   "patches %zu, %zu and %zu share an edge at (%.6g, %.6g, %.6g), "
                                   "expected two: do they overlap?",
                                   edge->patch, other, joint[k].edge[!also] / 4, joint[k].at[0],
                                   joint[k].at[1], joint[k].at[2]);
        }
    }
    return IGABEM_OK;
}

igabem_status hull_check_joints(const struct igabem_hull *hull, const nurbs_topology *topology)
{
    nurbs_joint *joint = malloc((topology->joints + 1) * sizeof *joint);
    if (!joint)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu shared edges", topology->joints);
    size_t joints = joints_within_sides(hull, topology, joint);
    igabem_status status = IGABEM_OK;
    for (size_t e = 0; e < topology->edges && !status; e++)
        status = check_edge(hull, topology, e, joint, joints);
    free(joint);
    return status;
}
