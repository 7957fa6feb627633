/* Edges of a mesh, and its orientation. */
#include "core/error.h"
#include "core/vector.h"
#include "mesh/mesh.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct half_edge {
    size_t low, high, slot; /* slot: 3 triangle + k */
} half_edge;

static int by_vertices(const void *a, const void *b)
{
    const half_edge *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return (x->slot > y->slot) - (x->slot < y->slot);
}

static nurbs_status find_edges(nurbs_mesh *mesh)
{
    size_t n = 3 * mesh->triangles;
    half_edge *half = malloc(n * sizeof *half);
    mesh->side = malloc(n * sizeof *mesh->side);
    mesh->edge = malloc(n * sizeof *mesh->edge);
    if (!half || !mesh->side || !mesh->edge) {
        free(half);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu edges", n);
    }
    for (size_t k = 0; k < n; k++) {
        size_t a = mesh->corner[k], b = mesh->corner[k / 3 * 3 + (k + 1) % 3];
        half[k] = (half_edge){a < b ? a : b, a < b ? b : a, k};
    }
    qsort(half, n, sizeof *half, by_vertices);
    for (size_t k = 0; k < n; k++) {
        mesh_edge *edge = mesh->edges ? &mesh->edge[mesh->edges - 1] : NULL;
        if (!edge || edge->vertex[0] != half[k].low || edge->vertex[1] != half[k].high) {
            edge = &mesh->edge[mesh->edges++];
            *edge = (mesh_edge){.vertex = {half[k].low, half[k].high}};
        }
        if (edge->count < 2)
            edge->triangle[edge->count] = half[k].slot / 3;
        edge->count++;
        mesh->side[half[k].slot] = mesh->edges - 1;
    }
    free(half);
    return NURBS_OK;
}

/* Whether a triangle runs along an edge from its smaller to its larger vertex. */
static bool runs_up(const nurbs_mesh *mesh, size_t triangle, size_t edge)
{
    const size_t *c = mesh->corner + 3 * triangle;
    for (int k = 0; k < 3; k++)
        if (c[k] == mesh->edge[edge].vertex[0] && c[(k + 1) % 3] == mesh->edge[edge].vertex[1])
            return true;
    return false;
}

static void turn_triangle(nurbs_mesh *mesh, size_t triangle)
{
    size_t *c = mesh->corner + 3 * triangle, *s = mesh->side + 3 * triangle, swapped = c[1];
    c[1] = c[2];
    c[2] = swapped;
    swapped = s[0];
    s[0] = s[2];
    s[2] = swapped;
}

/* Six times the volume between a triangle and the place `from`. */
static double cone_volume(const nurbs_mesh *mesh, size_t triangle, const double from[3])
{
    double a[3], b[3], c[3], n[3];
    const size_t *corner = mesh->corner + 3 * triangle;
    minus3(mesh->points + 3 * corner[0], from, a);
    minus3(mesh->points + 3 * corner[1], from, b);
    minus3(mesh->points + 3 * corner[2], from, c);
    cross3(b, c, n);
    return dot3(a, n);
}

/* One connected piece: list[first] on. Every triangle is turned like the one that reached it. */
static nurbs_status walk(nurbs_mesh *mesh, size_t start, unsigned char *seen, size_t *list,
                         size_t *count)
{
    *count = 1;
    list[0] = start;
    seen[start] = 1;
    for (size_t k = 0; k < *count; k++)
        for (int i = 0; i < 3; i++) {
            size_t edge = mesh->side[3 * list[k] + (size_t)i];
            const mesh_edge *e = &mesh->edge[edge];
            if (e->count != 2)
                continue;
            size_t other = e->triangle[e->triangle[0] == list[k]];
            bool alike = runs_up(mesh, other, edge) != runs_up(mesh, list[k], edge);
            if (seen[other] && !alike) {
                const double *p = mesh->points + 3 * e->vertex[0];
                return nurbs_fail(NURBS_ERROR_GEOMETRY,
                                  "the triangles beside the edge at x = %g, y = %g, z = %g cannot "
                                  "be turned alike",
                                  p[0], p[1], p[2]);
            }
            if (seen[other])
                continue;
            if (!alike)
                turn_triangle(mesh, other);
            seen[other] = 1;
            list[(*count)++] = other;
        }
    return NURBS_OK;
}

/* A piece that encloses a negative volume, closed towards its own middle in y = 0 and at its top,
 * is turned. The place to measure from: middle of its length, y = 0, its highest z, so that what is
 * open there counts for nothing. */
static void turn_outwards(nurbs_mesh *mesh, size_t count, const size_t *list)
{
    double low = 0, high = 0, from[3] = {0, 0, 0}, volume = 0;
    bool first = true;
    for (size_t k = 0; k < 3 * count; k++) {
        const double *p = mesh->points + 3 * mesh->corner[3 * list[k / 3] + k % 3];
        low = first || p[0] < low ? p[0] : low;
        high = first || p[0] > high ? p[0] : high;
        from[2] = first || p[2] > from[2] ? p[2] : from[2];
        first = false;
    }
    from[0] = 0.5 * (low + high);
    for (size_t k = 0; k < count; k++)
        volume += cone_volume(mesh, list[k], from);
    for (size_t k = 0; k < count && volume < 0; k++)
        turn_triangle(mesh, list[k]);
}

nurbs_status mesh_connect(nurbs_mesh *mesh)
{
    nurbs_status status = find_edges(mesh);
    unsigned char *seen = calloc(mesh->triangles, 1);
    size_t *list = malloc(mesh->triangles * sizeof *list), count;
    if (status == NURBS_OK && (!seen || !list))
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu triangles", mesh->triangles);
    for (size_t k = 0; k < mesh->triangles && status == NURBS_OK; k++) {
        if (seen[k])
            continue;
        status = walk(mesh, k, seen, list, &count);
        if (status == NURBS_OK)
            turn_outwards(mesh, count, list);
    }
    free(seen);
    free(list);
    return status;
}
