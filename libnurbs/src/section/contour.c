/* Plane sections by marching squares in parameter space. Every crossing of a cell's edge is refined
 * on the surface, so the lines are exact at their points and neighbouring cells share them. */
#include "core/error.h"

#include <nurbs/section.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PARTS = 64 };

/* Edges are numbered: those along u first (from node (i,j) to (i+1,j)), then those along v. */
typedef struct march {
    const nurbs_surface *surface;
    double normal[3], offset;
    size_t n[2];
    double *t[2];
    double *height; /* [n[0]][n[1]] */
    size_t edges;
    size_t *partner; /* [edges][2]: the edges that share a segment with it, or none */
    double *uv, *points;
} march;

#define NONE ((size_t)-1)

static size_t edge_along_u(const march *m, size_t i, size_t j)
{
    return i * m->n[1] + j;
}

static size_t edge_along_v(const march *m, size_t i, size_t j)
{
    return (m->n[0] - 1) * m->n[1] + i * (m->n[1] - 1) + j;
}

static size_t divide(const nurbs_surface *surface, int d, int parts, double *t)
{
    const double *knots = nurbs_surface_knots(surface, d);
    size_t size = nurbs_surface_size(surface, d), count = 0;
    for (size_t k = (size_t)nurbs_surface_degree(surface, d); k < size; k++)
        for (int s = 0; s < parts && knots[k + 1] > knots[k]; s++)
            t[count++] = knots[k] + (knots[k + 1] - knots[k]) * s / parts;
    t[count++] = knots[size];
    return count;
}

static void march_free(march *m)
{
    free(m->t[0]);
    free(m->t[1]);
    free(m->height);
    free(m->partner);
    free(m->uv);
}

static nurbs_status march_create(const nurbs_surface *surface, const double normal[3],
                                 double offset, int parts, march *m)
{
    *m = (march){.surface = surface, .offset = offset};
    memcpy(m->normal, normal, sizeof m->normal);
    for (int d = 0; d < 2; d++) {
        m->t[d] = malloc(((size_t)parts * nurbs_surface_size(surface, d) + 1) * sizeof(double));
        if (m->t[d])
            m->n[d] = divide(surface, d, parts, m->t[d]);
    }
    size_t nodes = m->n[0] * m->n[1];
    m->edges = (m->n[0] ? m->n[0] - 1 : 0) * m->n[1] + m->n[0] * (m->n[1] ? m->n[1] - 1 : 0);
    m->height = malloc((3 * nodes + 1) * sizeof(double));
    m->partner = malloc((2 * m->edges + 1) * sizeof(size_t));
    m->uv = malloc((5 * m->edges + 1) * sizeof(double));
    if (!m->t[0] || !m->t[1] || !m->height || !m->partner || !m->uv)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to cut a surface into %zu cells", nodes);
    m->points = m->uv + 2 * m->edges;
    for (size_t k = 0; k < 2 * m->edges; k++)
        m->partner[k] = NONE;
    nurbs_status status =
        nurbs_surface_eval_grid(surface, 0, m->n[0], m->t[0], m->n[1], m->t[1], m->height);
    for (size_t k = 0; k < nodes && status == NURBS_OK; k++) {
        const double *p = m->height + 3 * k;
        m->height[k] = normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] - offset;
    }
    return status;
}

/* The crossing on the edge from a to b, where the heights differ in sign: regula falsi (Illinois)
 * to rounding. */
static void refine(const march *m, const double a[2], const double b[2], double fa, double fb,
                   double uv[2], double point[3])
{
    double low = 0, high = 1;
    for (int k = 0; k < 60; k++) {
        double s = fb != fa ? low + (high - low) * fa / (fa - fb) : 0.5 * (low + high);
        uv[0] = a[0] + s * (b[0] - a[0]);
        uv[1] = a[1] + s * (b[1] - a[1]);
        if (nurbs_surface_eval(m->surface, 0, 1, uv, point) != NURBS_OK)
            return;
        double f =
            m->normal[0] * point[0] + m->normal[1] * point[1] + m->normal[2] * point[2] - m->offset;
        if (f == 0 || high - low < 1e-15)
            return;
        if ((f >= 0) == (fa >= 0)) {
            low = s;
            fa = f;
            fb *= 0.5;
        } else {
            high = s;
            fb = f;
            fa *= 0.5;
        }
    }
}

/* Number of the edge between nodes (i,j) and (i,j) + one step in direction d when the surface
 * crosses there (its point is then filled), else NONE. */
static size_t crossing(march *m, size_t i, size_t j, int d)
{
    size_t at = i * m->n[1] + j, next = d ? at + 1 : at + m->n[1],
           edge = d ? edge_along_v(m, i, j) : edge_along_u(m, i, j);
    double fa = m->height[at], fb = m->height[next];
    if ((fa >= 0) == (fb >= 0))
        return NONE;
    if (m->partner[2 * edge] == NONE) {
        const double a[2] = {m->t[0][i], m->t[1][j]},
                     b[2] = {m->t[0][d ? i : i + 1], m->t[1][d ? j + 1 : j]};
        refine(m, a, b, fa, fb, m->uv + 2 * edge, m->points + 3 * edge);
    }
    return edge;
}

static void join(march *m, size_t a, size_t b)
{
    m->partner[m->partner[2 * a] == NONE ? 2 * a : 2 * a + 1] = b;
    m->partner[m->partner[2 * b] == NONE ? 2 * b : 2 * b + 1] = a;
}

/* One cell: two crossings are joined; four by the sign at the middle. */
static void march_cell(march *m, size_t i, size_t j)
{
    size_t edge[4] = {crossing(m, i, j, 0), crossing(m, i + 1, j, 1), crossing(m, i, j + 1, 0),
                      crossing(m, i, j, 1)};
    size_t found[4], count = 0;
    for (int k = 0; k < 4; k++)
        if (edge[k] != NONE)
            found[count++] = edge[k];
    if (count == 2)
        join(m, found[0], found[1]);
    if (count != 4)
        return;
    const double *h = m->height + i * m->n[1] + j;
    double middle = h[0] + h[1] + h[m->n[1]] + h[m->n[1] + 1];
    int with_next = (middle >= 0) != (h[0] >= 0); /* the corner (i,j) is cut off */
    join(m, edge[0], edge[with_next ? 3 : 1]);
    join(m, edge[2], edge[with_next ? 1 : 3]);
}

/* Walks from `start` until the line ends or closes; order[] gets the edges. Marks them. */
static size_t walk(const march *m, size_t start, unsigned char *seen, size_t *order)
{
    size_t count = 0, at = start, before = NONE;
    while (at != NONE && !seen[at]) {
        seen[at] = 1;
        order[count++] = at;
        size_t next = m->partner[2 * at] != before || before == NONE ? m->partner[2 * at]
                                                                     : m->partner[2 * at + 1];
        if (next != NONE && seen[next] && next != start)
            next = m->partner[2 * at + 1];
        before = at;
        at = next;
    }
    if (at == start && count > 2)
        order[count++] = start;
    return count;
}

static int is_crossed(const march *m, size_t edge)
{
    return m->partner[2 * edge] != NONE;
}

static nurbs_status collect(const march *m, nurbs_contour *contour)
{
    size_t total = 0, used = 0;
    for (size_t k = 0; k < m->edges; k++)
        total += is_crossed(m, k) ? 1 : 0;
    unsigned char *seen = calloc(m->edges + 1, 1);
    size_t *order = malloc((2 * total + 2) * sizeof *order);
    contour->first = malloc((total + 2) * sizeof *contour->first);
    contour->points = malloc((6 * total + 1) * sizeof *contour->points);
    contour->uv = malloc((4 * total + 1) * sizeof *contour->uv);
    if (!seen || !order || !contour->first || !contour->points || !contour->uv) {
        free(seen);
        free(order);
        nurbs_contour_free(contour);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", total);
    }
    contour->first[0] = 0;
    /* Open lines from one of their ends, then closed ones. */
    for (int closed = 0; closed < 2; closed++)
        for (size_t k = 0; k < m->edges; k++) {
            if (!is_crossed(m, k) || seen[k] || (!closed && m->partner[2 * k + 1] != NONE))
                continue;
            size_t count = walk(m, k, seen, order);
            for (size_t i = 0; i < count; i++, used++) {
                memcpy(contour->points + 3 * used, m->points + 3 * order[i], 3 * sizeof(double));
                memcpy(contour->uv + 2 * used, m->uv + 2 * order[i], 2 * sizeof(double));
            }
            contour->first[++contour->lines] = used;
        }
    free(seen);
    free(order);
    return NURBS_OK;
}

void nurbs_contour_free(nurbs_contour *contour)
{
    if (!contour)
        return;
    free(contour->first);
    free(contour->points);
    free(contour->uv);
    *contour = (nurbs_contour){0};
}

/* Cells a knot span for lines without visible corners: surfaces of few spans need more. */
static int fine_parts(const nurbs_surface *surface)
{
    enum { CELLS = 128, LEAST = 6 };
    size_t spans = nurbs_surface_size(surface, 0) - (size_t)nurbs_surface_degree(surface, 0),
           across = nurbs_surface_size(surface, 1) - (size_t)nurbs_surface_degree(surface, 1);
    size_t parts = CELLS / (across < spans ? across : spans);
    return parts < LEAST ? LEAST : parts > MAX_PARTS ? MAX_PARTS : (int)parts;
}

nurbs_status nurbs_surface_contour(const nurbs_surface *surface, const double normal[3],
                                   double offset, int parts, nurbs_contour *contour)
{
    NURBS_NEED(surface && normal && contour);
    march m;
    *contour = (nurbs_contour){0};
    if (parts < 0 || parts > MAX_PARTS)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%d parts a knot span, expected 0 to %d", parts,
                          MAX_PARTS);
    double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    if (!(isfinite(length) && length > 0 && isfinite(offset)))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "plane with normal (%g, %g, %g) and offset %g",
                          normal[0], normal[1], normal[2], offset);
    nurbs_status status =
        march_create(surface, normal, offset, parts ? parts : fine_parts(surface), &m);
    for (size_t i = 0; i + 1 < m.n[0] && status == NURBS_OK; i++)
        for (size_t j = 0; j + 1 < m.n[1]; j++)
            march_cell(&m, i, j);
    if (status == NURBS_OK)
        status = collect(&m, contour);
    march_free(&m);
    return status;
}
