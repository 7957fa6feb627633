/* Edges of patches that run together: samples of the shorter edge, their closest points on the
 * longer one, stretches of samples within the tolerance with ends found by bisection. */
#include "core/error.h"

#include <nurbs/basis.h>
#include <nurbs/invert.h>
#include <nurbs/modify.h>
#include <nurbs/topology.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PER_SPAN = 32, LEAST_SAMPLES = 129, BISECTIONS = 50 };

/* An edge as a curve with samples along it. */
typedef struct sampled_edge {
    nurbs_curve *curve;
    size_t n;
    double *t, *points, *along; /* along: arc length up to the sample, by chords */
    double low[3], high[3];
} sampled_edge;

typedef struct finder {
    double tolerance;
    size_t count;
    sampled_edge *edge;
    nurbs_topology *found;
    size_t room;
} finder;

static double distance(const double *a, const double *b)
{
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

static void sample_parameters(sampled_edge *edge)
{
    const double *t = nurbs_curve_knots(edge->curve);
    size_t p = (size_t)nurbs_curve_degree(edge->curve), size = nurbs_curve_size(edge->curve),
           spans = 0, count = 0;
    for (size_t k = p; k < size; k++)
        spans += t[k + 1] > t[k];
    size_t parts = edge->n / spans;
    for (size_t k = p; k < size; k++)
        for (size_t i = 0; i < parts && t[k + 1] > t[k]; i++)
            edge->t[count++] = t[k] + (t[k + 1] - t[k]) * (double)i / (double)parts;
    edge->t[count++] = t[size];
    edge->n = count;
}

static nurbs_status sample_edge(const nurbs_surface *surface, int side, double tolerance,
                                sampled_edge *edge, nurbs_edge *about)
{
    int d = side / 2;
    const double *knots = nurbs_surface_knots(surface, d);
    double value = side % 2 ? knots[nurbs_surface_size(surface, d)] : knots[0];
    nurbs_status status = nurbs_surface_iso_curve(surface, d, value, &edge->curve);
    if (status != NURBS_OK)
        return status;
    size_t samples = PER_SPAN * nurbs_curve_size(edge->curve);
    edge->n = samples > LEAST_SAMPLES ? samples : LEAST_SAMPLES;
    edge->t = malloc(5 * (edge->n + 1) * sizeof *edge->t);
    if (!edge->t)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu samples of an edge", edge->n);
    edge->points = edge->t + edge->n + 1;
    edge->along = edge->points + 3 * (edge->n + 1);
    sample_parameters(edge);
    status = nurbs_curve_eval(edge->curve, 0, edge->n, edge->t, edge->points);
    double reach = 0;
    for (size_t k = 0; k < edge->n && status == NURBS_OK; k++) {
        const double *p = edge->points + 3 * k;
        edge->along[k] = k ? edge->along[k - 1] + distance(p, p - 3) : 0;
        reach = fmax(reach, distance(p, edge->points));
        for (int c = 0; c < 3; c++) {
            edge->low[c] = k ? fmin(edge->low[c], p[c]) : p[c];
            edge->high[c] = k ? fmax(edge->high[c], p[c]) : p[c];
        }
    }
    about->range[0] = edge->t[0];
    about->range[1] = edge->t[edge->n - 1];
    about->length = edge->along[edge->n - 1];
    about->collapsed = reach <= tolerance;
    return status;
}

static int boxes_touch(const finder *f, size_t a, size_t b)
{
    const sampled_edge *e = &f->edge[a], *g = &f->edge[b];
    for (int c = 0; c < 3; c++)
        if (e->low[c] > g->high[c] + 2 * f->tolerance || g->low[c] > e->high[c] + 2 * f->tolerance)
            return 0;
    return 1;
}

/* Between an inside sample and the outside one next to it: the parameter where the distance passes
 * the tolerance. */
static nurbs_status find_end(const finder *f, size_t a, size_t b, double inside, double outside,
                             double *end)
{
    nurbs_status status = NURBS_OK;
    for (int k = 0; k < BISECTIONS && status == NURBS_OK; k++) {
        double middle = 0.5 * (inside + outside), p[3], u, away = 0;
        status = nurbs_curve_eval(f->edge[a].curve, 0, 1, &middle, p);
        if (status == NURBS_OK)
            status = nurbs_curve_closest(f->edge[b].curve, 1, p, &u, &away);
        if (away <= f->tolerance)
            inside = middle;
        else
            outside = middle;
    }
    *end = inside;
    return status;
}

/* Direction in which the boundary of a patch runs along an edge with the patch on its left: with u
 * on the first v and the last u. */
static int boundary_sign(int side)
{
    return side == 1 || side == 2 ? 1 : -1;
}

static nurbs_status check_sides(const finder *f, double at[2], nurbs_joint *joint)
{
    double d[2][6];
    for (int e = 0; e < 2; e++) {
        nurbs_status status = nurbs_curve_eval(f->edge[joint->edge[e]].curve, 1, 1, &at[e], d[e]);
        if (status != NURBS_OK)
            return status;
    }
    double along = d[0][3] * d[1][3] + d[0][4] * d[1][4] + d[0][5] * d[1][5];
    joint->consistent = along * boundary_sign((int)(joint->edge[0] % 4)) *
                            boundary_sign((int)(joint->edge[1] % 4)) <
                        0;
    return NURBS_OK;
}

static nurbs_status add_joint(finder *f, const nurbs_joint *joint)
{
    nurbs_topology *found = f->found;
    if (found->joints == f->room) {
        size_t room = f->room ? 2 * f->room : 16;
        nurbs_joint *larger = realloc(found->joint, room * sizeof *larger);
        if (!larger)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu shared edges", room);
        found->joint = larger;
        f->room = room;
    }
    found->joint[found->joints++] = *joint;
    found->gap = fmax(found->gap, joint->gap);
    found->inconsistent += !joint->consistent;
    return NURBS_OK;
}

/* Samples first ... last of edge a lie on edge b. */
static nurbs_status add_stretch(finder *f, size_t a, size_t b, size_t first, size_t last,
                                const double *away)
{
    const sampled_edge *edge = &f->edge[a];
    nurbs_joint joint = {.edge = {a, b}, .from = {edge->t[first], 0}, .to = {edge->t[last], 0}};
    size_t middle = (first + last) / 2;
    double p[9], u[3], at[2] = {edge->t[middle], 0};
    nurbs_status status = NURBS_OK;
    if (first > 0)
        status = find_end(f, a, b, edge->t[first], edge->t[first - 1], &joint.from[0]);
    if (status == NURBS_OK && last + 1 < edge->n)
        status = find_end(f, a, b, edge->t[last], edge->t[last + 1], &joint.to[0]);
    const double ends[2] = {joint.from[0], joint.to[0]};
    if (status == NURBS_OK)
        status = nurbs_curve_eval(edge->curve, 0, 2, ends, p);
    if (status != NURBS_OK)
        return status;
    joint.length = edge->along[last] - edge->along[first] + distance(p, edge->points + 3 * first) +
                   distance(p + 3, edge->points + 3 * last);
    if (!(joint.length > 10 * f->tolerance))
        return NURBS_OK;
    memcpy(p + 6, edge->points + 3 * middle, 3 * sizeof *p);
    memcpy(joint.at, p + 6, sizeof joint.at);
    status = nurbs_curve_closest(f->edge[b].curve, 3, p, u, NULL);
    if (status != NURBS_OK)
        return status;
    joint.from[1] = u[0];
    joint.to[1] = u[1];
    at[1] = u[2];
    for (size_t k = first; k <= last; k++)
        joint.gap = fmax(joint.gap, away[k]);
    status = check_sides(f, at, &joint);
    return status == NURBS_OK ? add_joint(f, &joint) : status;
}

/* Two edges of the same patch meet in a corner and may run within the tolerance near it; only
 * opposite ones are joined (a closed patch). */
static int may_join(const finder *f, size_t a, size_t b)
{
    const nurbs_edge *e = f->found->edge;
    if (e[a].collapsed || e[b].collapsed || (a / 4 == b / 4 && a % 4 / 2 != b % 4 / 2))
        return 0;
    return boxes_touch(f, a, b);
}

static nurbs_status join_pair(finder *f, size_t a, size_t b)
{
    if (f->found->edge[b].length < f->found->edge[a].length) {
        size_t swapped = a;
        a = b;
        b = swapped;
    }
    const sampled_edge *edge = &f->edge[a];
    double *u = malloc(2 * edge->n * sizeof *u), *away = u + edge->n;
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu samples of an edge", edge->n);
    nurbs_status status = nurbs_curve_closest(f->edge[b].curve, edge->n, edge->points, u, away);
    for (size_t first = 0, last; first < edge->n && status == NURBS_OK; first = last + 1) {
        last = first;
        if (away[first] > f->tolerance)
            continue;
        while (last + 1 < edge->n && away[last + 1] <= f->tolerance)
            last++;
        status = add_stretch(f, a, b, first, last, away);
    }
    free(u);
    return status;
}

typedef struct stretch {
    double from, to;
} stretch;

static int by_start(const void *a, const void *b)
{
    double x = ((const stretch *)a)->from, y = ((const stretch *)b)->from;
    return (x > y) - (x < y);
}

/* Arc length of an edge up to a parameter. */
static double length_to(const sampled_edge *edge, double t)
{
    size_t k = 1;
    while (k + 1 < edge->n && edge->t[k] < t)
        k++;
    double share = (t - edge->t[k - 1]) / (edge->t[k] - edge->t[k - 1]);
    return edge->along[k - 1] + fmin(fmax(share, 0), 1) * (edge->along[k] - edge->along[k - 1]);
}

/* Length of the union of all stretches on every edge. */
static nurbs_status sum_joined(finder *f)
{
    nurbs_topology *found = f->found;
    stretch *parts = malloc((2 * found->joints + 1) * sizeof *parts);
    if (!parts)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu shared edges", found->joints);
    for (size_t k = 0; k < found->edges; k++) {
        size_t n = 0;
        for (size_t j = 0; j < found->joints; j++)
            for (int e = 0; e < 2; e++)
                if (found->joint[j].edge[e] == k) {
                    double a = length_to(&f->edge[k], found->joint[j].from[e]),
                           b = length_to(&f->edge[k], found->joint[j].to[e]);
                    parts[n++] = (stretch){fmin(a, b), fmax(a, b)};
                }
        qsort(parts, n, sizeof *parts, by_start);
        double reached = 0;
        for (size_t i = 0; i < n; i++) {
            found->edge[k].joined += fmax(parts[i].to - fmax(parts[i].from, reached), 0);
            reached = fmax(reached, parts[i].to);
        }
    }
    free(parts);
    return NURBS_OK;
}

static nurbs_status find_joints(const nurbs_patches *patches, finder *f)
{
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < f->count && status == NURBS_OK; k++) {
        f->found->edge[k] = (nurbs_edge){.patch = k / 4, .side = (int)(k % 4)};
        status = sample_edge(nurbs_patches_get(patches, k / 4), (int)(k % 4), f->tolerance,
                             &f->edge[k], &f->found->edge[k]);
    }
    for (size_t a = 0; a < f->count && status == NURBS_OK; a++)
        for (size_t b = a + 1; b < f->count && status == NURBS_OK; b++)
            if (may_join(f, a, b))
                status = join_pair(f, a, b);
    return status == NURBS_OK ? sum_joined(f) : status;
}

nurbs_status nurbs_patches_topology(const nurbs_patches *patches, double tolerance,
                                    nurbs_topology *topology)
{
    NURBS_NEED(patches && topology);
    *topology = (nurbs_topology){0};
    if (!(isfinite(tolerance) && tolerance > 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "tolerance %g, expected a length > 0", tolerance);
    finder f = {.tolerance = tolerance, .count = 4 * nurbs_patches_count(patches)};
    f.found = topology;
    f.edge = calloc(f.count + 1, sizeof *f.edge);
    topology->edge = calloc(f.count + 1, sizeof *topology->edge);
    topology->edges = f.count;
    nurbs_status status = NURBS_OK;
    if (!f.edge || !topology->edge)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu edges", f.count);
    else
        status = find_joints(patches, &f);
    for (size_t k = 0; f.edge && k < f.count; k++) {
        nurbs_curve_free(f.edge[k].curve);
        free(f.edge[k].t);
    }
    free(f.edge);
    if (status != NURBS_OK)
        nurbs_topology_free(topology);
    return status;
}

void nurbs_topology_free(nurbs_topology *topology)
{
    if (!topology)
        return;
    free(topology->edge);
    free(topology->joint);
    *topology = (nurbs_topology){0};
}
